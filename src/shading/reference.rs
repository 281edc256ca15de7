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
pub use sphere::{cap_reference, sphere_reference};
pub use textured::{Luminance, rectangle_reference, textured_reference};

use std::f64::consts::PI;

use glam::DVec3;

use super::{PhongLobe, Response, ShadingPoint};
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

/// max(0, axis·ω)ᵐ above up to two horizons: the weight of a direction in every integral here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel {
    /// Unit axis; directions below its horizon count nothing.
    pub axis: DVec3,
    /// The exponent m ≥ 1.
    pub exponent: f64,
    /// Normal of a second horizon.
    pub horizon: Option<DVec3>,
}

impl Kernel {
    /// Lambert's cosine about the normal n.
    pub fn cosine(n: DVec3) -> Self {
        Self { axis: n, exponent: 1.0, horizon: None }
    }

    /// The Phong lobe about r of exponent m, above the horizon of n.
    pub fn lobe(r: DVec3, m: f64, n: DVec3) -> Self {
        Self { axis: r, exponent: m, horizon: Some(n) }
    }

    /// The weight of a unit direction above both horizons, and what the rounding of the direction does to it.
    fn weight(&self, direction: DVec3) -> Estimate {
        let cosine = self.axis.dot(direction).max(0.0);
        let power = cosine.powf(self.exponent - 1.0);
        Estimate { value: power * cosine, error: 4.0 * f64::EPSILON * self.exponent * power }
    }

    /// Normals of the horizons.
    fn horizons(&self) -> impl Iterator<Item = DVec3> {
        std::iter::once(self.axis).chain(self.horizon)
    }

    /// Whether a direction is above both horizons.
    fn sees(&self, direction: DVec3) -> bool {
        self.horizons().all(|normal| normal.dot(direction) >= 0.0)
    }

    /// Angles about the peak at which to split: doubling from the lobe's width 1/√m, so that each piece sees its tail.
    fn peak_offsets(&self) -> impl Iterator<Item = f64> {
        let width = self.exponent.sqrt().recip();
        [0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0].into_iter().flat_map(move |offset| [-offset * width, offset * width])
    }
}

/// The error sought, and the evaluations that may be spent on it.
const OUTER: Tolerance = Tolerance { relative: 1e-8, absolute: 1e-300, panels: 160 };
const INNER: Tolerance = Tolerance { relative: 1e-10, absolute: 1e-300, panels: 40 };

/// Response of an emitter by quadrature.
///
/// **Method:** globally adaptive Gauss–Kronrod, over the light's directions in two nested integrals (polygon, sphere),
/// or along the light (line); point and directional lights are their own integrals.
/// **Accuracy:** the bound is 1e-7 of the value or less in ordinary cases; the budget keeps an evaluation to some
/// milliseconds, and where it is spent the bound is wider.
pub fn reference(emitter: &Emitter, at: &ShadingPoint, lobe: &PhongLobe) -> BoundedResponse {
    let (r, m) = (at.mirror(), lobe.exponent());
    let normalisation = (m + 1.0) / (2.0 * PI);
    let [cosine, phong] = [Kernel::cosine(at.n), Kernel::lobe(r, m, at.n)];
    let [irradiance, specular] = [cosine, phong].map(|kernel| match emitter {
        Emitter::Polygon(light) => polygon_reference(light, at.p, &kernel),
        Emitter::Line(light) => line_reference(light, at.p, &kernel),
        Emitter::Sphere(light) => sphere_reference(light, at.p, &kernel),
        Emitter::Disk(light) => disk_reference(light, at.p, &kernel),
        Emitter::Textured(light) => textured_reference(light, at.p, &kernel),
        Emitter::Cap(light) => cap_reference(light.to_center, light.half_angle, &kernel),
        Emitter::Sky(light) => {
            cap_reference(light.zenith, std::f64::consts::FRAC_PI_2, &kernel)
                * (light.uniform + light.cosine * 2.0 / 3.0)
        }
        Emitter::Point(light) => {
            let to_light = light.position - at.p;
            parallel(to_light.normalize_or_zero(), &kernel) * to_light.length_squared().max(f64::MIN_POSITIVE).recip()
        }
        Emitter::Directional(light) => parallel(light.to_light, &kernel),
    });
    BoundedResponse { irradiance, specular: specular * normalisation }
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
