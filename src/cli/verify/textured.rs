//! Rectangles with the patterns of the reference files.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use anyhow::{Context as _, ensure};
use serde::Deserialize;

use super::cases::{Inputs, ReferenceFile};
use super::row_of;
use super::table::Row;
use crate::light::pattern::{Channel, Span};
use crate::light::{Emitter, TexturedEmitter};
use crate::math::interpolation::{CHEBYSHEV, Grid, NODES, even_weights};
use crate::math::quadrature::{Estimate, GaussLegendre};
use crate::math::spherical::triangle_solid_angle;
use crate::shading::reference::{Kernel, Luminance, rectangle_reference, textured_reference};
use crate::shading::textured::quadrature::{Distribution, Sought, integrate};
use crate::shading::textured::{cosine, reflection};
use crate::shading::{Lobe, Method, ShadingPoint, respond};

/// A pattern of the reference files, by shares u of the first edge and v of the second.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
pub(super) enum Pattern {
    /// `hi` on even squares, `lo` on odd ones.
    Checker { cells: u32, hi: f64, lo: f64 },
    /// From a to b along u.
    Gradient { a: f64, b: f64 },
    /// A bell about (u₀, v₀).
    Gaussian { u0: f64, v0: f64, sigma: f64, amp: f64 },
    /// A disk about (u₀, v₀).
    Disk { u0: f64, v0: f64, radius: f64, inside: f64, outside: f64 },
}

/// The rows of a file of textured rectangles; `None` for any other.
pub(super) fn rows(file: &ReferenceFile) -> anyhow::Result<Option<Vec<Row>>> {
    let (name, is_diffuse) = match file.model.as_str() {
        "textured_rect_diffuse" => ("textured_rect_diffuse", true),
        "textured_rect_phong" => ("textured_rect_phong", false),
        _ => return Ok(None),
    };
    let mut rows = Vec::new();
    for case in &file.cases {
        let asked = Asked::new(&case.inputs, is_diffuse).with_context(|| case.id.clone())?;
        let expected = case.expected;
        let allowed = 1e-6 * expected.abs() + 1e-9 * asked.scale();
        for (method, estimate) in [("exact", asked.exact()), ("reference", asked.reference())] {
            // A bound that is too wide counts like an error that is.
            let bound = if estimate.error <= allowed { estimate.error } else { 0.0 };
            row_of(&mut rows, name, method).judged(&case.id, estimate.value, expected, bound);
        }
        if let Some(image) = asked.image() {
            for method in [Method::PointCluster(16), Method::Point] {
                let value = asked.approximate(image.clone(), method);
                row_of(&mut rows, name, &format!("{method}, images")).measured(&case.id, value, expected);
            }
        }
    }
    Ok(Some(rows))
}

/// What a case asks.
struct Asked {
    /// White.
    light: TexturedEmitter,
    pattern: Pattern,
    at: ShadingPoint,
    /// None where the irradiance is asked for.
    lobe: Option<Lobe>,
}

impl Asked {
    fn new(inputs: &Inputs, is_diffuse: bool) -> anyhow::Result<Self> {
        let (row, column) = (Inputs::vector(inputs.eu, "eu")?, Inputs::vector(inputs.ev, "ev")?);
        let normal = row.cross(column).try_normalize().context("inputs `eu` and `ev` span no rectangle")?;
        let pattern = inputs.pattern.context("missing input `pattern`")?;
        let is_sound = match pattern {
            Pattern::Checker { cells, .. } => (1..=4096).contains(&cells),
            Pattern::Gaussian { sigma, .. } => sigma > 0.0,
            Pattern::Disk { radius, .. } => radius > 0.0,
            Pattern::Gradient { .. } => true,
        };
        ensure!(is_sound, "input `pattern` is out of range");
        // With the lobe's axis for a normal there is no second horizon.
        let axis = if is_diffuse { Inputs::direction(inputs.N, "N") } else { Inputs::direction(inputs.R, "R") }?;
        Ok(Self {
            light: TexturedEmitter {
                corner: Inputs::vector(inputs.corner, "corner")?,
                row,
                column,
                normal,
                two_sided: true,
                pattern: Arc::new(Channel::white()),
            },
            pattern,
            at: ShadingPoint { p: Inputs::vector(inputs.p, "p")?, n: axis, v: axis },
            lobe: if is_diffuse { None } else { Some(Lobe::new(inputs.exponent()?)) },
        })
    }

    /// The solid angle, or all that the kernel integrates to, if that is less.
    fn scale(&self) -> f64 {
        let [a, b, c, d] = self.light.corners().map(|corner| corner - self.at.p);
        let solid_angle = (triangle_solid_angle(a, b, c) + triangle_solid_angle(a, c, d)).abs();
        solid_angle.min(self.lobe.as_ref().map_or(PI, |lobe| TAU / (lobe.exponent() + 1.0)))
    }

    /// The pattern as an image, where it is one.
    fn image(&self) -> Option<Arc<Channel>> {
        let Pattern::Checker { cells, hi, lo } = self.pattern else { return None };
        Channel::of_shares(cells as usize, cells as usize, |u, v| {
            let cell = |share: f64| (share * f64::from(cells)).floor();
            if (cell(u) + cell(v)) % 2.0 == 0.0 { hi } else { lo }
        })
        .map(Arc::new)
    }

    fn exact(&self) -> Estimate {
        match self.image() {
            Some(image) => self.integrated(&*image),
            None => self.integrated(&self.pattern),
        }
    }

    fn integrated(&self, pattern: &impl Distribution) -> Estimate {
        let (light, at) = (&self.light, &self.at);
        match &self.lobe {
            None => integrate(light, pattern, at.p, &cosine(at.n), Sought::default()),
            Some(lobe) => {
                let normalised = integrate(light, pattern, at.p, &reflection(lobe, at), Sought::default());
                normalised * lobe.normalisation().recip()
            }
        }
    }

    fn reference(&self) -> Estimate {
        let kernel = match &self.lobe {
            None => Kernel::cosine(self.at.n),
            Some(lobe) => Kernel::cosine_power(self.at.n, lobe.exponent()),
        };
        match self.image() {
            Some(image) => {
                let light = TexturedEmitter { pattern: image, ..self.light.clone() };
                textured_reference(&light, self.at.p, &kernel)
            }
            None => rectangle_reference(&self.light, self.at.p, &kernel, &self.pattern),
        }
    }

    fn approximate(&self, image: Arc<Channel>, method: Method) -> f64 {
        let light = Emitter::Textured(TexturedEmitter { pattern: image, ..self.light.clone() });
        match &self.lobe {
            None => respond(&light, method, &self.at, &Lobe::new(1.0)).irradiance,
            Some(lobe) => respond(&light, method, &self.at, lobe).specular / lobe.normalisation(),
        }
    }
}

impl Distribution for Pattern {
    fn whole(&self) -> [Span; 2] {
        [Span::whole(1); 2]
    }

    fn weights(&self, columns: &Span, rows: &Span) -> Grid {
        match *self {
            Self::Checker { .. } => Grid::default(),
            Self::Gradient { .. } => separable(&gathered(columns, |u| self.value(u, 0.0)), &gathered(rows, |_| 1.0)),
            Self::Gaussian { u0, v0, sigma, amp } => {
                let bell = |x: f64| (-0.5 * (x / sigma).powi(2)).exp();
                separable(&gathered(columns, |u| amp * bell(u - u0)), &gathered(rows, |v| bell(v - v0)))
            }
            Self::Disk { u0, v0, radius, inside, outside } => {
                let even = even_weights(0.25 * outside * columns.length() * rows.length());
                let disk = disk_weights([u0, v0], radius, columns, rows);
                std::array::from_fn(|l| std::array::from_fn(|k| even[l][k] + (inside - outside) * disk[l][k]))
            }
        }
    }

    fn is_smooth(&self, columns: &Span, rows: &Span) -> bool {
        match *self {
            Self::Checker { .. } => false,
            Self::Gradient { .. } => true,
            Self::Gaussian { sigma, .. } => columns.length().max(rows.length()) <= sigma,
            Self::Disk { u0, v0, radius, .. } => {
                let ends = |span: &Span, center: f64| [span.lo - center, span.hi - center];
                let nearest = |[lo, hi]: [f64; 2]| if lo <= 0.0 && hi >= 0.0 { 0.0 } else { lo.abs().min(hi.abs()) };
                let farthest = |[lo, hi]: [f64; 2]| lo.abs().max(hi.abs());
                let (u, v) = (ends(columns, u0), ends(rows, v0));
                nearest(u).hypot(nearest(v)) >= radius || farthest(u).hypot(farthest(v)) <= radius
            }
        }
    }

    fn value(&self, u: f64, v: f64) -> f64 {
        match *self {
            Self::Checker { cells, hi, lo } => {
                let cell = |share: f64| (share * f64::from(cells)).floor();
                if (cell(u) + cell(v)) % 2.0 == 0.0 { hi } else { lo }
            }
            Self::Gradient { a, b } => a + (b - a) * u,
            Self::Gaussian { u0, v0, sigma, amp } => {
                amp * (-((u - u0).powi(2) + (v - v0).powi(2)) / (2.0 * sigma * sigma)).exp()
            }
            Self::Disk { u0, v0, radius, inside, outside } => {
                if (u - u0).hypot(v - v0) <= radius {
                    inside
                } else {
                    outside
                }
            }
        }
    }
}

impl Luminance for Pattern {
    fn at(&self, u: f64, v: f64) -> f64 {
        self.value(u, v)
    }

    fn breaks_along(&self, v: f64) -> Vec<f64> {
        match *self {
            Self::Checker { cells, .. } => (1..cells).map(|i| f64::from(i) / f64::from(cells)).collect(),
            Self::Gradient { .. } => Vec::new(),
            Self::Gaussian { u0, sigma, .. } => bell_breaks(u0, sigma),
            Self::Disk { u0, v0, radius, .. } => {
                let half = (radius * radius - (v - v0).powi(2)).max(0.0).sqrt();
                vec![u0 - half, u0 + half]
            }
        }
    }

    fn breaks_across(&self) -> Vec<f64> {
        match *self {
            Self::Gaussian { v0, sigma, .. } => bell_breaks(v0, sigma),
            Self::Disk { v0, radius, .. } => vec![v0 - radius, v0 + radius],
            _ => self.breaks_along(0.0),
        }
    }
}

/// Where to look at a bell so that it is not missed.
fn bell_breaks(center: f64, sigma: f64) -> Vec<f64> {
    [-4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0].map(|offset| center + offset * sigma).into()
}

/// ∫ f ℓ_k over a part of an axis, f a polynomial or at most as narrow as the files' bells.
fn gathered(span: &Span, f: impl Fn(f64) -> f64) -> [f64; NODES] {
    let mut sums = [0.0; NODES];
    for (x, weight) in GaussLegendre::new(48).nodes() {
        let share = 0.5 * span.length() * weight * f(span.at(*x));
        for (sum, basis) in sums.iter_mut().zip(CHEBYSHEV.basis(*x)) {
            *sum += share * basis;
        }
    }
    sums
}

fn separable(columns: &[f64; NODES], rows: &[f64; NODES]) -> Grid {
    rows.map(|row| columns.map(|column| row * column))
}

/// ∫ ℓ_k ℓ_l over what a disk covers of a part.
///
/// With u = u₀ + r sin θ the ends v₀ ± r cos θ of a column are smooth in θ, and so is everything between the angles at
/// which they pass the part's edges.
fn disk_weights(center: [f64; 2], radius: f64, columns: &Span, rows: &Span) -> Grid {
    let angle = |offset: f64| {
        let sine = (offset / radius).clamp(-1.0, 1.0);
        sine.atan2((1.0 - sine * sine).sqrt())
    };
    let mut angles = vec![angle(columns.lo - center[0]), angle(columns.hi - center[0])];
    let (first, last) = (angles[0], angles[1]);
    for edge in [rows.lo - center[1], rows.hi - center[1]].into_iter().filter(|edge| edge.abs() < radius) {
        let half = angle((radius * radius - edge * edge).sqrt());
        angles.extend([-half, half].into_iter().filter(|angle| first < *angle && *angle < last));
    }
    angles.sort_by(f64::total_cmp);
    let rule = GaussLegendre::new(40);
    let local = |span: &Span, x: f64| (2.0 * x - span.lo - span.hi) / span.length();
    let mut grid = Grid::default();
    for ends in angles.windows(2) {
        let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
        for (x, weight) in rule.nodes() {
            let (sine, cosine) = (middle + half * x).sin_cos();
            let bottom = rows.lo.max(center[1] - radius * cosine);
            let top = rows.hi.min(center[1] + radius * cosine);
            if bottom >= top {
                continue;
            }
            let share = weight * half * radius * cosine * 0.5 * rows.length();
            let of_rows = CHEBYSHEV.basis_integrals(local(rows, bottom), local(rows, top));
            let of_columns = CHEBYSHEV.basis(local(columns, center[0] + radius * sine));
            for (sums, of_row) in grid.iter_mut().zip(of_rows) {
                for (sum, of_column) in sums.iter_mut().zip(of_columns) {
                    *sum += share * of_row * of_column;
                }
            }
        }
    }
    grid
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_a_disk_sum_to_what_it_covers() {
        let [left, right] = Span::whole(1).halves().expect("halves");
        let sum =
            |columns: &Span, rows: &Span| disk_weights([0.5, 0.5], 0.5, columns, rows).iter().flatten().sum::<f64>();
        let whole = Span::whole(1);
        assert!((sum(&whole, &whole) - 0.25 * PI).abs() < 1e-14, "the whole disk");
        assert!((sum(&left, &whole) - 0.125 * PI).abs() < 1e-14, "its half");
        assert!((sum(&right, &left) - 0.0625 * PI).abs() < 1e-14, "its quarter");
    }
}
