//! Reference files of the schema `area-light-reference/1`, and what a case of each model asks.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

use anyhow::{Context as _, bail, ensure};
use glam::DVec3;
use serde::Deserialize;

use crate::light::{CapEmitter, DiskEmitter, Emitter, LineEmitter, PolygonEmitter, SkyEmitter, SphereEmitter};
use crate::math::quadrature::Estimate;
use crate::math::spherical::triangle_solid_angle;
use crate::shading::disk::disk_solid_angle;
use crate::shading::reference::{BoundedResponse, reference};
use crate::shading::sphere::Cap;
use crate::shading::{Method, PhongLobe, Response, ShadingPoint, respond};

const SCHEMA: &str = "area-light-reference/1";

/// A reference file.
#[derive(Debug, Deserialize)]
pub(super) struct ReferenceFile {
    schema: String,
    pub(super) model: String,
    pub(super) cases: Vec<Case>,
}

/// One case; what its inputs are depends on the model.
#[derive(Debug, Deserialize)]
pub(super) struct Case {
    pub(super) id: String,
    pub(super) inputs: Inputs,
    pub(super) expected: f64,
    expected_nclip: Option<f64>,
    f64_rounding_rel: Option<f64>,
}

/// The inputs of every model. Directions may have any length.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
#[expect(non_snake_case, reason = "the names of the schema")]
pub(super) struct Inputs {
    pub(super) p: Option<DVec3>,
    pub(super) N: Option<DVec3>,
    pub(super) R: Option<DVec3>,
    L: Option<DVec3>,
    A: Option<DVec3>,
    B: Option<DVec3>,
    center: Option<DVec3>,
    radius: Option<f64>,
    sigma: Option<f64>,
    n: Option<f64>,
    decay: Option<f64>,
    kind: Option<String>,
    light_normal: Option<DVec3>,
    vertices: Option<Vec<DVec3>>,
    pub(super) corner: Option<DVec3>,
    pub(super) eu: Option<DVec3>,
    pub(super) ev: Option<DVec3>,
    pub(super) pattern: Option<super::textured::Pattern>,
}

/// One number that the core has to give.
#[derive(Debug)]
pub(super) struct Check {
    /// The model, as the table names it.
    pub(super) name: &'static str,
    pub(super) light: Emitter,
    pub(super) at: ShadingPoint,
    pub(super) lobe: PhongLobe,
    /// Which part of the response is asked for, and what it is multiplied by to be in the file's normalisation.
    pub(super) part: Part,
    pub(super) factor: f64,
    pub(super) expected: f64,
    /// The scale S of the case, in the file's normalisation.
    pub(super) scale: f64,
}

/// A part of a response.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Irradiance,
    Specular,
}

impl Part {
    fn of(self, response: &Response) -> f64 {
        match self {
            Self::Irradiance => response.irradiance,
            Self::Specular => response.specular,
        }
    }

    fn of_bounded(self, response: &BoundedResponse) -> Estimate {
        match self {
            Self::Irradiance => response.irradiance,
            Self::Specular => response.specular,
        }
    }
}

impl ReferenceFile {
    /// Reads a file, and refuses other schemas and empty ones.
    pub(super) fn read(path: &Path) -> anyhow::Result<Self> {
        let name = path.display();
        let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {name}"))?;
        let mut json = serde_json::Deserializer::from_str(&text);
        let file: Self =
            serde_path_to_error::deserialize(&mut json).with_context(|| format!("{name} is no reference file"))?;
        ensure!(file.schema == SCHEMA, "{name} has the schema `{}`, not `{SCHEMA}`", file.schema);
        ensure!(!file.cases.is_empty(), "{name} has no cases");
        Ok(file)
    }
}

impl Case {
    /// Relative change of the answer when the inputs are rounded about p.
    pub(super) fn rounding(&self) -> f64 {
        self.f64_rounding_rel.unwrap_or(0.0)
    }
}

impl Inputs {
    pub(super) fn vector(value: Option<DVec3>, name: &str) -> anyhow::Result<DVec3> {
        value.filter(|v| v.is_finite()).with_context(|| format!("missing input `{name}`"))
    }

    fn number(value: Option<f64>, name: &str) -> anyhow::Result<f64> {
        value.with_context(|| format!("missing input `{name}`"))
    }

    pub(super) fn direction(value: Option<DVec3>, name: &str) -> anyhow::Result<DVec3> {
        Self::vector(value, name)?.try_normalize().with_context(|| format!("input `{name}` is no direction"))
    }

    pub(super) fn exponent(&self) -> anyhow::Result<f64> {
        let m = Self::number(self.n, "n")?;
        ensure!(m >= 1.0, "input `n` is {m}, below 1");
        Ok(m)
    }

    fn polygon(&self) -> anyhow::Result<PolygonEmitter> {
        let vertices = self.vertices.clone().context("missing input `vertices`")?;
        ensure!(vertices.len() >= 3, "input `vertices` has fewer than 3 corners");
        let corner = vertices[0];
        let doubled: DVec3 = vertices.windows(2).map(|edge| (edge[0] - corner).cross(edge[1] - corner)).sum();
        let normal = doubled.try_normalize().context("input `vertices` lies on a line")?;
        Ok(PolygonEmitter { vertices, normal, two_sided: true })
    }

    fn line(&self, falloff: f64) -> anyhow::Result<LineEmitter> {
        Ok(LineEmitter { a: Self::vector(self.A, "A")?, b: Self::vector(self.B, "B")?, falloff, tube: None })
    }

    fn sphere(&self) -> anyhow::Result<SphereEmitter> {
        let radius = Self::number(self.radius, "radius")?;
        ensure!(radius > 0.0, "input `radius` is {radius}, not positive");
        Ok(SphereEmitter { center: Self::vector(self.center, "center")?, radius })
    }

    fn disk(&self) -> anyhow::Result<DiskEmitter> {
        let radius = Self::number(self.radius, "radius")?;
        ensure!(radius > 0.0, "input `radius` is {radius}, not positive");
        let normal = Self::direction(self.light_normal, "light_normal")?;
        Ok(DiskEmitter { center: Self::vector(self.center, "center")?, normal, radius, two_sided: true })
    }

    fn sky(&self) -> anyhow::Result<SkyEmitter> {
        let (uniform, cosine) = match self.kind.as_deref() {
            Some("const") => (1.0, 0.0),
            Some("cos") => (0.0, 1.0),
            Some("cie") => (1.0 / 3.0, 2.0 / 3.0),
            Some(other) => bail!("input `kind` is `{other}`, not const, cos or cie"),
            None => bail!("missing input `kind`"),
        };
        Ok(SkyEmitter { zenith: Self::direction(self.L, "L")?, uniform, cosine })
    }

    fn cap(&self) -> anyhow::Result<CapEmitter> {
        let half_angle = Self::number(self.sigma, "sigma")?;
        ensure!((0.0..=FRAC_PI_2).contains(&half_angle), "input `sigma` is {half_angle}, not from 0 to π/2");
        Ok(CapEmitter { to_center: Self::direction(self.L, "L")?, half_angle })
    }
}

/// What a case of a model asks; `None` for a model that is not built.
pub(super) fn checks(model: &str, case: &Case) -> anyhow::Result<Option<Vec<Check>>> {
    let inputs = &case.inputs;
    let light = match model {
        "polygon_lambert" | "polygon_phong" | "polygon_phong_nclip" => Emitter::Polygon(inputs.polygon()?),
        "linear_diffuse" => Emitter::Line(inputs.line(Inputs::number(inputs.decay, "decay")?)?),
        "linear_phong" => Emitter::Line(inputs.line(2.0)?),
        "sphere_lambert" | "sphere_phong" => Emitter::Sphere(inputs.sphere()?),
        "subhemi_lambert" | "subhemi_phong" => Emitter::Cap(inputs.cap()?),
        "hemi_lambert" | "hemi_phong" => Emitter::Sky(inputs.sky()?),
        "disk_diffuse" | "disk_phong" => Emitter::Disk(inputs.disk()?),
        _ => return Ok(None),
    };
    let p = match light {
        Emitter::Sky(_) | Emitter::Cap(_) => DVec3::ZERO,
        _ => Inputs::vector(inputs.p, "p")?,
    };
    let facing = |name, axis: DVec3, expected| {
        let at = ShadingPoint { p, n: axis, v: axis };
        check(name, light.clone(), at, expected)
    };
    let diffuse = |name| Ok::<_, anyhow::Error>(facing(name, Inputs::direction(inputs.N, "N")?, case.expected));
    // With the lobe's axis for a normal there is no second horizon.
    let lobe_only = |name| -> anyhow::Result<Check> {
        Ok(facing(name, Inputs::direction(inputs.R, "R")?, case.expected).specular(inputs.exponent()?))
    };
    let above_surface = |name, expected| -> anyhow::Result<Check> {
        let (n, r) = (Inputs::direction(inputs.N, "N")?, Inputs::direction(inputs.R, "R")?);
        let at = ShadingPoint { p, n, v: 2.0 * n.dot(r) * n - r };
        Ok(check(name, light.clone(), at, expected).specular(inputs.exponent()?))
    };
    Ok(Some(match model {
        "polygon_lambert" => vec![diffuse("polygon_lambert")?],
        "polygon_phong" => vec![lobe_only("polygon_phong")?],
        "polygon_phong_nclip" => vec![above_surface("polygon_phong_nclip", case.expected)?],
        "linear_diffuse" => vec![diffuse("linear_diffuse")?],
        "linear_phong" => {
            let above = case.expected_nclip.context("missing field `expected_nclip`")?;
            vec![lobe_only("linear_phong")?, above_surface("linear_phong nclip", above)?]
        }
        "sphere_lambert" => vec![diffuse("sphere_lambert")?],
        "sphere_phong" => vec![lobe_only("sphere_phong")?],
        "subhemi_lambert" => vec![diffuse("subhemi_lambert")?],
        "subhemi_phong" => vec![lobe_only("subhemi_phong")?],
        "hemi_lambert" => vec![diffuse("hemi_lambert")?],
        "hemi_phong" => vec![lobe_only("hemi_phong")?],
        "disk_diffuse" => vec![diffuse("disk_diffuse")?],
        "disk_phong" => vec![lobe_only("disk_phong")?],
        other => bail!("no inputs for the model `{other}`"),
    }))
}

/// A diffuse check in the file's normalisation.
fn check(name: &'static str, light: Emitter, at: ShadingPoint, expected: f64) -> Check {
    let size = size(&light, at.p);
    let (factor, scale) = match Normalisation::of(&light) {
        Normalisation::Line => (1.0, size),
        Normalisation::Bare => (1.0, size.min(PI)),
        Normalisation::Share => (PI.recip(), (size / PI).min(1.0)),
    };
    Check { name, light, at, lobe: PhongLobe::new(1.0), part: Part::Irradiance, factor, expected, scale }
}

/// What the integrals in a file are multiplied by.
#[derive(Clone, Copy, Debug)]
enum Normalisation {
    /// Nothing; the scale has no bound.
    Line,
    /// Nothing.
    Bare,
    /// 1/π or (m+1)/(2π), which makes all of the light 1.
    Share,
}

impl Normalisation {
    fn of(light: &Emitter) -> Self {
        match light {
            Emitter::Line(_) => Self::Line,
            Emitter::Disk(_) => Self::Bare,
            _ => Self::Share,
        }
    }
}

impl Check {
    /// The same for a specular lobe.
    fn specular(self, m: f64) -> Self {
        let normalisation = (m + 1.0) / (2.0 * PI);
        let size = size(&self.light, self.at.p);
        let (factor, scale) = match Normalisation::of(&self.light) {
            Normalisation::Line => (normalisation.recip(), size),
            Normalisation::Bare => (normalisation.recip(), size.min(normalisation.recip())),
            Normalisation::Share => (1.0, (size * normalisation).min(1.0)),
        };
        Self { lobe: PhongLobe::new(m), part: Part::Specular, factor, scale, ..self }
    }

    /// The methods that differ for this part, `reference` aside.
    pub(super) fn methods(&self) -> &'static [Method] {
        const CLUSTER: Method = Method::PointCluster(16);
        match (&self.light, self.part) {
            (Emitter::Polygon(_), Part::Specular) => {
                &[Method::Exact, Method::NearestPoint, Method::NearestPointPicott, CLUSTER, Method::Point]
            }
            (Emitter::Line(_), Part::Specular) => {
                &[Method::Exact, Method::CHEBYSHEV, Method::NearestPoint, CLUSTER, Method::Point]
            }
            (Emitter::Sphere(_) | Emitter::Cap(_), Part::Irradiance) => {
                &[Method::Exact, Method::Hermite1, Method::Hermite2, CLUSTER, Method::Point]
            }
            (Emitter::Sky(_), _) => &[Method::Exact, Method::Point],
            (Emitter::Point(_) | Emitter::Directional(_), _) => &[Method::Exact],
            _ => &[Method::Exact, CLUSTER, Method::Point],
        }
    }

    /// A method's answer.
    pub(super) fn value(&self, method: Method) -> f64 {
        self.part.of(&respond(&self.light, method, &self.at, &self.lobe)) * self.factor
    }

    /// The answer by quadrature, and its bound.
    pub(super) fn estimate(&self) -> Estimate {
        self.part.of_bounded(&reference(&self.light, &self.at, &self.lobe)) * self.factor
    }
}

/// The solid angle of a light, or |B−A|/dᶠ of a line at the least distance d.
fn size(light: &Emitter, p: DVec3) -> f64 {
    match light {
        Emitter::Polygon(light) => {
            let corner = light.vertices[0] - p;
            let fan = light.vertices.windows(2).map(|edge| triangle_solid_angle(corner, edge[0] - p, edge[1] - p));
            fan.sum::<f64>().abs()
        }
        Emitter::Line(light) => {
            let along = light.b - light.a;
            let t = ((p - light.a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            along.length() / (light.a + t * along).distance(p).powf(light.falloff)
        }
        Emitter::Sphere(light) => {
            let ratio_squared = light.radius * light.radius / light.center.distance_squared(p);
            2.0 * PI * ratio_squared / (1.0 + (1.0 - ratio_squared).max(0.0).sqrt())
        }
        Emitter::Disk(light) => disk_solid_angle(light, p),
        Emitter::Sky(_) => 2.0 * PI,
        Emitter::Cap(light) => Cap::new(light.to_center, light.half_angle).solid_angle(),
        Emitter::Textured(_) | Emitter::Point(_) | Emitter::Directional(_) => 0.0,
    }
}
