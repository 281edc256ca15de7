//! `softbox probe`: irradiance and radiance at given points.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::{Context, anyhow, bail};
use glam::DVec3;

use super::shadows::ShadowArgs;
use super::{Outcome, files};
use crate::analysis;
use crate::render::{MethodChoice, Outgoing, Reflection, prepare};
use crate::scene::Scene;
use crate::shading::ShadingPoint;

/// Irradiance (lx) and radiance (cd/m²) at points, as CSV on standard output.
///
/// The points are CSV with the header x,y,z,nx,ny,nz,vx,vy,vz: position, normal, direction to the eye. Normal and
/// direction need not be of unit length; lines that begin with # are skipped.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scene file.
    scene: PathBuf,
    /// CSV file of points, or - for standard input.
    #[arg(short, long, value_name = "FILE")]
    points: PathBuf,
    /// A method as in `render`, approx, or all for every method that one of the lights has.
    #[arg(short, long, default_value = "exact", value_name = "METHOD")]
    method: Methods,
    /// Material of the points; the scene's first where it is not given.
    #[arg(long, value_name = "NAME")]
    material: Option<String>,
    #[command(flatten)]
    shadows: ShadowArgs,
}

/// Which methods answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Methods {
    All,
    One(MethodChoice),
}

impl FromStr for Methods {
    type Err = <MethodChoice as FromStr>::Err;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        if name == "all" { Ok(Self::All) } else { name.parse().map(Self::One) }
    }
}

impl Methods {
    fn choices(self, scene: &Scene) -> Vec<MethodChoice> {
        match self {
            Self::All => analysis::methods_for(scene).into_iter().map(MethodChoice::Method).collect(),
            Self::One(choice) => vec![choice],
        }
    }
}

/// The columns of the points, in their order.
const POINT_COLUMNS: [&str; 9] = ["x", "y", "z", "nx", "ny", "nz", "vx", "vy", "vz"];

/// The columns of the answer.
const ANSWER_HEADER: &str = "method,x,y,z,irradiance_r,irradiance_g,irradiance_b,radiance_r,radiance_g,radiance_b";

/// Answer each point as it is read, with a row a method.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    let scene = files::load(&args.scene)?;
    let reflection = Reflection::new(files::material(&scene, &args.scene, args.material.as_deref())?);
    let choices = args.method.choices(&scene);
    let lightings: Vec<_> =
        choices.into_iter().map(|choice| (choice, prepare(&scene, choice, args.shadows.shadows()).1)).collect();
    let mut rows = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .flexible(true)
        .from_reader(open(&args.points)?);
    let name =
        if args.points == Path::new("-") { "standard input".to_owned() } else { args.points.display().to_string() };
    if rows.headers().with_context(|| name.clone())?.iter().ne(POINT_COLUMNS) {
        bail!("{name}:1: the header must be {}", POINT_COLUMNS.join(","));
    }
    let mut out = io::BufWriter::new(io::stdout().lock());
    writeln!(out, "{ANSWER_HEADER}")?;
    let mut row = csv::StringRecord::new();
    while rows.read_record(&mut row).with_context(|| name.clone())? {
        let line = row.position().map_or(0, csv::Position::line);
        let at = point(&row).map_err(|problem| anyhow!("{name}:{line}: {problem}"))?;
        for (choice, lighting) in &lightings {
            write_answer(&mut out, choice, at.p, &lighting.outgoing(&reflection, &at))?;
        }
    }
    out.flush()?;
    Ok(Outcome::Done)
}

fn open(path: &Path) -> anyhow::Result<Box<dyn Read>> {
    if path == Path::new("-") {
        return Ok(Box::new(io::stdin()));
    }
    let file = File::open(path).with_context(|| path.display().to_string())?;
    Ok(Box::new(file))
}

/// The point of a row.
fn point(row: &csv::StringRecord) -> Result<ShadingPoint, String> {
    let mut numbers = [0.0; POINT_COLUMNS.len()];
    if row.len() != numbers.len() {
        return Err(format!("a row has {} numbers, this one has {}", numbers.len(), row.len()));
    }
    for ((number, field), column) in numbers.iter_mut().zip(row).zip(POINT_COLUMNS) {
        *number = field
            .parse()
            .ok()
            .filter(|number: &f64| number.is_finite())
            .ok_or_else(|| format!("{column}: must be a finite number, but is `{field}`"))?;
    }
    let [x, y, z, nx, ny, nz, vx, vy, vz] = numbers;
    let unit = |v: DVec3, what| v.try_normalize().ok_or_else(|| format!("{what}: must not be the zero vector"));
    Ok(ShadingPoint {
        p: DVec3::new(x, y, z),
        n: unit(DVec3::new(nx, ny, nz), "nx,ny,nz")?,
        v: unit(DVec3::new(vx, vy, vz), "vx,vy,vz")?,
    })
}

/// A row of the answer, each number with the 17 digits that bring it back to the last bit.
fn write_answer(out: &mut impl Write, choice: &MethodChoice, p: DVec3, outgoing: &Outgoing) -> io::Result<()> {
    write!(out, "{choice}")?;
    for number in [p, outgoing.irradiance, outgoing.radiance].iter().flat_map(|vector| vector.to_array()) {
        write!(out, ",{number:.16e}")?;
    }
    writeln!(out)
}
