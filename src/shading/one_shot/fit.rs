//! The radius of one-shot's kernel, fitted to a light.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;
use rayon::prelude::*;

use super::brightest::{Axis, View};
use super::grid::SIDE;
use super::{Kernel, Prefiltered};

/// Where the light is looked at from: heights over its centroid, tilts of the axis, azimuths of the tilt.
///
/// Heights are the middles of equal parts of 0 to 5 longest sides; tilts run from facing to parallel.
///
/// **Source:** [`crate::refs::ONE_SHOT`], §3.1. **Deviation:** the paper has exponents 1 and 3; of narrower lobes than
/// its 3 the greatest tilt is 90°·√(4/(n+1)), in proportion to the lobe's width: else the mean would be that of points
/// of view from which the lobe misses the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Samples {
    /// Heights.
    pub heights: u32,
    /// Tilts; a single one faces the light.
    pub tilts: u32,
    /// Azimuths.
    pub azimuths: u32,
}

impl Samples {
    /// What lights are fitted with.
    pub const FEW: Self = Self { heights: 8, tilts: 5, azimuths: 3 };

    /// All points of view for an exponent.
    fn views(self, exponent: f64) -> impl Iterator<Item = (f64, f64, f64)> {
        let share = |i: u32, count: u32| f64::from(i) / f64::from(count);
        let greatest_tilt = FRAC_PI_2 * (4.0 / (exponent + 1.0)).sqrt().min(1.0);
        (0..self.heights).flat_map(move |i| {
            let height = FARTHEST * (f64::from(i) + 0.5) / f64::from(self.heights);
            (0..self.tilts).flat_map(move |j| {
                let tilt = greatest_tilt * share(j, self.tilts.saturating_sub(1).max(1));
                (0..self.azimuths).map(move |k| (height, tilt, TAU * share(k, self.azimuths)))
            })
        })
    }
}

/// The greatest height of a sample, in longest sides of the pattern.
const FARTHEST: f64 = 5.0;

/// What looks at the light: cos about the normal, or cosⁿ about the mirror direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Component {
    /// The normal's cosine; its factor is α = r/|pt|.
    Diffuse,
    /// The lobe of an exponent n; its factor is β = n·r/|pt|.
    Specular(f64),
}

impl Component {
    /// The exponent of its cosine.
    pub fn exponent(self) -> f64 {
        match self {
            Self::Diffuse => 1.0,
            Self::Specular(n) => n,
        }
    }

    /// What r/|pt| is multiplied by.
    fn unit(self) -> f64 {
        match self {
            Self::Diffuse => 1.0,
            Self::Specular(n) => n,
        }
    }
}

/// One point of view of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Height over the centroid, in longest sides.
    pub height: f64,
    /// Angle from facing.
    pub tilt: f64,
    /// Azimuth of the tilt.
    pub azimuth: f64,
    /// The α or β that makes one-shot exact here.
    pub factor: f64,
    /// ∫ L cosⁿ dω, of luminance 1.
    pub exact: f64,
    /// One-shot's answer with the mean factor less the exact one.
    pub error: f64,
}

/// The factor of a light, and what it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The mean of the samples' factors: α or β.
    pub mean: f64,
    /// The samples, azimuth by azimuth for each tilt, tilt by tilt for each height.
    pub samples: Vec<Sample>,
}

impl Fit {
    /// Mean and greatest |error|.
    pub fn errors(&self) -> (f64, f64) {
        let sizes = self.samples.iter().map(|sample| sample.error.abs());
        (sizes.clone().sum::<f64>() / self.samples.len().max(1) as f64, sizes.fold(0.0, f64::max))
    }
}

/// α or β of a pattern as the paper has it: the mean of what makes single points of view exact.
///
/// **Source:** [`crate::refs::ONE_SHOT`], §3.1, §3.2.
/// **Method:** the exact value by the midpoint rule on texels that shrink with height and exponent; the radius from
/// eq. (5) by bisection.
pub fn fit(pattern: &Prefiltered, kernel: Kernel, component: Component, samples: Samples) -> Fit {
    let one = |(height, tilt, azimuth): (f64, f64, f64)| {
        let (view, axis) = look(pattern, height, tilt, azimuth);
        let exact = integral(pattern, &view, &axis, component.exponent());
        let factor = component.unit() * exact_radius(pattern, kernel, &view, &axis, component.exponent(), exact);
        Sample { height, tilt, azimuth, factor, exact, error: 0.0 }
    };
    let views: Vec<_> = samples.views(component.exponent()).collect();
    let mut samples: Vec<Sample> = views.into_par_iter().map(one).collect();
    let mean = samples.iter().map(|sample| sample.factor).sum::<f64>() / samples.len().max(1) as f64;
    let share = mean / component.unit();
    samples.par_iter_mut().for_each(|sample| {
        sample.error = error_at(pattern, kernel, component, sample, |distance| share * distance);
    });
    Fit { mean, samples }
}

/// One-shot's answer less the exact one at a sample, where the kernel's radius is that function of |pt|, in texels.
pub fn error_at(
    pattern: &Prefiltered,
    kernel: Kernel,
    component: Component,
    sample: &Sample,
    radius: impl Fn(f64) -> f64,
) -> f64 {
    let (view, axis) = look(pattern, sample.height, sample.tilt, sample.azimuth);
    let shot = view.brightest(&axis, component.exponent()).map_or(0.0, |spot| {
        let weight = spot.falloff * spot.cosine.max(0.0).powf(component.exponent());
        weight * pattern.true_sum(kernel, spot.place, radius(spot.distance))
    });
    shot - sample.exact
}

/// A viewer over the pattern's centroid.
fn look(pattern: &Prefiltered, height: f64, tilt: f64, azimuth: f64) -> (View, Axis) {
    let view = View { foot: pattern.centroid(), height: height * SIDE as f64 };
    (view, Axis::new(tilt.sin() * DVec2::from_angle(azimuth), -tilt.cos()))
}

/// r/|pt| with which one-shot is exact.
fn exact_radius(pattern: &Prefiltered, kernel: Kernel, view: &View, axis: &Axis, m: f64, exact: f64) -> f64 {
    let Some(spot) = view.brightest(axis, m) else { return 0.0 };
    let intensity = exact / (spot.falloff * spot.cosine.powf(m));
    let (mut low, mut high) = (0.0, spot.place.abs().max_element() + 2.0 * SIDE as f64);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if pattern.true_sum(kernel, spot.place, middle) < intensity {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high) / spot.distance
}

/// Of the interval that the radius is sought in.
const HALVINGS: u32 = 28;

/// Greatest side of a cell, in distances over √(m+3), which is the width of the integrand.
const FINENESS: f64 = 0.5;
/// The finest and coarsest cells' sides are these powers of two of a texel's.
const FINEST: i32 = -4;
const COARSEST: i32 = 3;
/// Cells whose weight is everywhere below this share of the greatest are taken as they are.
const NEGLIGIBLE: f64 = 1e-6;

/// ∫ L cosᵐ dω over the pattern: the midpoint rule on squares that are cut in four until they are fine enough.
fn integral(pattern: &Prefiltered, view: &View, axis: &Axis, m: f64) -> f64 {
    let weight = |place: DVec2, slack: f64| {
        let spot = view.spot(place, axis);
        spot.falloff * (spot.cosine + slack / spot.distance).clamp(0.0, 1.0).powf(m)
    };
    let mut cells = vec![Cell { center: DVec2::ZERO, level: SIDE.ilog2().cast_signed() }];
    let (mut sum, mut greatest) = (0.0, f64::MIN_POSITIVE);
    while let Some(cell) = cells.pop() {
        let luminance = pattern.mipmap().texel(cell.level, cell.center);
        if luminance == 0.0 {
            continue;
        }
        let (side, distance) = (f64::from(cell.level).exp2(), (cell.center - view.foot).length().hypot(view.height));
        let fine = cell.level <= COARSEST && side * (m + 3.0).sqrt() <= FINENESS * distance;
        let at_center = weight(cell.center, 0.0);
        greatest = at_center.max(greatest);
        if fine || cell.level == FINEST || weight(cell.center, side) < NEGLIGIBLE * greatest {
            sum += luminance * side * side * at_center;
        } else {
            cells.extend(cell.quarters());
        }
    }
    sum
}

/// A square of texels, or a part of one.
#[derive(Clone, Copy)]
struct Cell {
    center: DVec2,
    level: i32,
}

impl Cell {
    fn quarters(self) -> [Self; 4] {
        let quarter = 0.25 * f64::from(self.level).exp2();
        let corners = [DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0), DVec2::new(-1.0, 1.0), DVec2::ONE];
        corners.map(|corner| Self { center: self.center + quarter * corner, level: self.level - 1 })
    }
}
