//! Adaptive quadrature of the defining integrals, with error bounds. Shares no code with the closed forms.
//!
//! Each light is integrated in coordinates in which nothing is singular, and split wherever the integrand or its
//! derivative jumps: at both horizons, at vertices, and about the lobe's peak, which sampling alone may miss.

mod disk;
mod line;
mod polygon;
mod sphere;
mod textured;

pub use disk::disk_reference;
pub use line::line_reference;
pub use polygon::polygon_reference;
pub use sphere::{cap_reference, sky_reference, sphere_reference};
pub use textured::{Luminance, rectangle_reference, textured_reference};

use std::f64::consts::PI;
use std::sync::atomic::{AtomicBool, Ordering};

use glam::DVec3;

use super::{Lobe, Response, ShadingPoint};
use crate::light::Emitter;
use crate::math::quadrature::{Estimate, Tolerance};

/// [`Response`] with bounds on its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BoundedResponse {
    /// See [`Response::irradiance`].
    pub irradiance: Estimate,
    /// See [`Response::specular`].
    pub specular: Estimate,
}

impl BoundedResponse {
    /// The values alone.
    pub fn response(&self) -> Response {
        Response { irradiance: self.irradiance.value, specular: self.specular.value }
    }
}

impl From<Response> for BoundedResponse {
    /// Without bounds.
    fn from(response: Response) -> Self {
        let [irradiance, specular] =
            [response.irradiance, response.specular].map(|value| Estimate { value, error: 0.0 });
        Self { irradiance, specular }
    }
}

/// The weight of a direction in every integral here: max(0, axis·ω)ᵐ above up to two horizons, or a lobe's density
/// above one.
#[derive(Clone, Copy, Debug)]
pub struct Kernel<'a> {
    /// Unit direction of the peak, or near it; of a cosine the normal of a horizon too.
    pub axis: DVec3,
    /// The exponent m ≥ 1 of the cosine, or one whose cosine is as wide as the lobe.
    pub exponent: f64,
    /// Normal of the surface's horizon.
    pub horizon: Option<DVec3>,
    /// The lobe, where it is no cosine.
    lobe: Option<&'a Lobe>,
    /// The error sought in the outer and in the inner integral.
    tolerances: [Tolerance; 2],
    /// Where to split about the peak, in widths 1/√m.
    splits: &'static [f64],
    /// Set when the integral is not wanted any more.
    cancel: Option<&'a AtomicBool>,
}

/// Doubling from the lobe's width, so that each piece sees its tail.
const SPLITS: &[f64] = &[0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0];
/// As few as a quick integral needs.
const QUICK_SPLITS: &[f64] = &[0.0, 2.0, 6.0];

impl<'a> Kernel<'a> {
    /// Lambert's cosine about the normal n.
    pub fn cosine(n: DVec3) -> Self {
        Self::cosine_power(n, 1.0)
    }

    /// The cosine about an axis to the power m.
    pub fn cosine_power(axis: DVec3, m: f64) -> Self {
        Self { axis, exponent: m, horizon: None, lobe: None, tolerances: [OUTER, INNER], splits: SPLITS, cancel: None }
    }

    /// The Phong lobe about r of exponent m, above the horizon of n.
    pub fn lobe(r: DVec3, m: f64, n: DVec3) -> Self {
        Self { horizon: Some(n), ..Self::cosine_power(r, m) }
    }

    /// The density of a lobe that is no cosine, seen from where r is mirrored to.
    pub fn density(r: DVec3, lobe: &'a Lobe, n: DVec3) -> Self {
        Self { lobe: Some(lobe), ..Self::lobe(r, lobe.cosine_exponent().max(1.0), n) }
    }

    /// The weight of a unit direction above both horizons, and what the rounding of the direction does to it.
    fn weight(&self, direction: DVec3) -> Estimate {
        if let (Some(lobe), Some(n)) = (self.lobe, self.horizon) {
            let value = lobe.density(n, self.axis, direction);
            return Estimate { value, error: 16.0 * f64::EPSILON * (self.exponent + 4.0) * value };
        }
        let cosine = self.axis.dot(direction).max(0.0);
        let power = cosine.powf(self.exponent - 1.0);
        Estimate { value: power * cosine, error: 4.0 * f64::EPSILON * self.exponent * power }
    }

    /// Normals of the horizons.
    fn horizons(&self) -> impl Iterator<Item = DVec3> {
        let of_axis = self.lobe.is_none().then_some(self.axis);
        of_axis.into_iter().chain(self.horizon)
    }

    /// Whether a direction is above both horizons.
    fn sees(&self, direction: DVec3) -> bool {
        self.horizons().all(|normal| normal.dot(direction) >= 0.0)
    }

    /// Angles about the peak at which to split.
    fn peak_offsets(&self) -> impl Iterator<Item = f64> {
        let width = self.exponent.sqrt().recip();
        self.splits.iter().flat_map(move |split| [-split * width, split * width])
    }

    /// Whether the integral is not wanted any more.
    fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed))
    }

    /// The error sought in an outer integral.
    fn outer(&self) -> Tolerance {
        self.tolerances[0]
    }

    /// The error sought in an inner integral.
    fn inner(&self) -> Tolerance {
        self.tolerances[1]
    }
}

/// The error sought, and the evaluations that may be spent on it.
const OUTER: Tolerance = Tolerance { relative: 1e-8, absolute: 1e-300, panels: 160 };
const INNER: Tolerance = Tolerance { relative: 1e-10, absolute: 1e-300, panels: 40 };

/// What methods seek that have no closed form for a lobe.
const QUICK: [Tolerance; 2] = [
    Tolerance { relative: 1e-5, absolute: 1e-300, panels: 40 },
    Tolerance { relative: 1e-6, absolute: 1e-300, panels: 12 },
];

/// Response of an emitter by quadrature.
///
/// **Method:** globally adaptive Gauss–Kronrod, over the light's directions in two nested integrals (polygon, sphere),
/// or along the light (line); point and directional lights are their own integrals.
/// **Accuracy:** the bound is 1e-7 of the value or less in ordinary cases; the budget keeps an evaluation to some
/// milliseconds, and where it is spent the bound is wider.
pub fn reference(emitter: &Emitter, at: &ShadingPoint, lobe: &Lobe) -> BoundedResponse {
    bounded(emitter, at, lobe, None)
}

/// [`reference()`], given up when `cancel` is set meanwhile: over a large pattern it takes seconds.
pub fn reference_unless(
    emitter: &Emitter,
    at: &ShadingPoint,
    lobe: &Lobe,
    cancel: &AtomicBool,
) -> Option<BoundedResponse> {
    let response = bounded(emitter, at, lobe, Some(cancel));
    (!cancel.load(Ordering::Relaxed)).then_some(response)
}

fn bounded(emitter: &Emitter, at: &ShadingPoint, lobe: &Lobe, cancel: Option<&AtomicBool>) -> BoundedResponse {
    let irradiance = integral(emitter, at.p, &Kernel { cancel, ..Kernel::cosine(at.n) });
    let specular = if lobe.is_cosine() {
        let (seen, factor) = lobe.seen(at);
        let kernel = Kernel { cancel, ..Kernel::lobe(seen.mirror(), lobe.exponent(), at.n) };
        integral(emitter, at.p, &kernel) * (factor * (lobe.exponent() + 1.0) / (2.0 * PI))
    } else {
        integral(emitter, at.p, &Kernel { cancel, ..Kernel::density(at.mirror(), lobe, at.n) })
    };
    BoundedResponse { irradiance, specular }
}

/// The specular response for a lobe that is no cosine, with a relative error of some 1e-5 in ordinary cases.
pub fn quick_specular(emitter: &Emitter, at: &ShadingPoint, lobe: &Lobe) -> Estimate {
    let kernel = Kernel::density(at.mirror(), lobe, at.n);
    integral(emitter, at.p, &Kernel { tolerances: QUICK, splits: QUICK_SPLITS, ..kernel })
}

/// ∫ L(ω) weight(ω) dω over an emitter of unit strength.
fn integral(emitter: &Emitter, p: DVec3, kernel: &Kernel) -> Estimate {
    match emitter {
        Emitter::Polygon(light) => polygon_reference(light, p, kernel),
        Emitter::Line(light) => line_reference(light, p, kernel),
        Emitter::Sphere(light) => sphere_reference(light, p, kernel),
        Emitter::Disk(light) => disk_reference(light, p, kernel),
        Emitter::Textured(light) => textured_reference(light, p, kernel),
        Emitter::Cap(light) => cap_reference(light.to_center, light.half_angle, kernel),
        Emitter::Sky(light) => sky_reference(light, kernel),
        Emitter::Point(light) => {
            let to_light = light.position - p;
            let illuminance = light.intensity(-to_light) / to_light.length_squared().max(f64::MIN_POSITIVE);
            parallel(to_light.normalize_or_zero(), kernel) * illuminance
        }
        Emitter::Directional(light) => parallel(light.to_light, kernel),
    }
}

/// The weight of a single direction.
fn parallel(direction: DVec3, kernel: &Kernel) -> Estimate {
    if kernel.sees(direction) { kernel.weight(direction) } else { Estimate::default() }
}

/// The intervals between sorted breaks within [lo, hi].
fn split(lo: f64, hi: f64, breaks: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut ends: Vec<f64> = breaks.into_iter().filter(|x| lo < *x && *x < hi).collect();
    ends.extend([lo, hi]);
    ends.sort_by(f64::total_cmp);
    ends
}
