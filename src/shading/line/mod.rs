//! Linear lights.
//!
//! Everything happens in the frame of the foot of the perpendicular from the point to the light's line: the light is
//! the points `foot + s·axis` with s from a to b, at the distances √(d² + s²), d = ‖foot‖. Written in a, b and their
//! distances, nothing cancels when the point comes near the line.
//!
//! A tube of radius ϱ and luminance 1 emits 2ϱ sin ψ a metre, sin ψ = d/r: it is 2ϱd times a line of falloff f + 1.

mod frame;
mod specular;

pub use frame::LineFrame;

use glam::DVec3;

use super::point::falloff_response;
use super::{Method, PhongLobe, Response, ShadingPoint, cluster};
use crate::light::LineEmitter;

/// Response to a line of intensity per metre 1, or to a tube of luminance 1, by a method.
pub fn respond(light: &LineEmitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    match method {
        Method::PointCluster(points) => return cluster::line_cluster(light, points, at, lobe),
        Method::Point => return line_point(light, at, lobe),
        _ => {}
    }
    let Some(visible) = LineFrame::new(light, at.p).and_then(|line| line.above(at.n)) else {
        return Response::default();
    };
    let r = at.mirror();
    let Decay { gain, falloff } = Decay::of(light, &visible);
    let specular = match method {
        Method::Chebyshev { degree, levels } => {
            let fit = lobe.chebyshev(degree, levels);
            lobe.normalisation() * gain * visible.chebyshev(r, falloff, lobe.exponent(), fit)
        }
        Method::NearestPoint => {
            let nearest = visible.nearest(r);
            let intensity = light.length() * light.intensity_along(nearest);
            falloff_response(nearest, intensity, light.falloff, nearest, r, lobe).specular
        }
        _ => lobe.normalisation() * gain * visible.phong(r, lobe.exponent(), falloff),
    };
    Response { irradiance: gain * visible.irradiance(at.n, falloff), specular }
}

/// Irradiance at `p` from a line of intensity per metre 1, or from a tube of luminance 1.
///
/// E = ∫ max(0, n·w)/rᶠ ds = (n·foot) J + (n·axis) K,  J = ∫ ds/rᶠ⁺¹,  K = ∫ s ds/rᶠ⁺¹,  over the part above n's horizon
///
/// For f = 2 that is L(n·A/r_a + n·B/r_b)/(r_a r_b + A·B) with A, B from p to the ends. J and K have closed forms for
/// f = 0, 1, 2, 3; for other f they are integrated over y with ds = r dy, where 1/rᶠ is entire, 24 Gauss–Legendre
/// nodes a panel of width 2: the remainder is below 1e-15. A tube is 2ϱd times a line of falloff f + 1: for f = 2 and
/// x between the ends, E = ϱ (n·foot/d²)[x + d(b/r_b² − a/r_a²)] + ϱd (n·axis)(b² − a²)/(r_a r_b)².
///
/// **Source:** [`crate::refs::POULIN_AMANATIDES_1990`], §3; [`crate::refs::PICOTT_1992`], eq. (3) and app. A; the
/// forms, and the tube's, derived here. **Units:** cd/m → lx for f = 2; cd/m² → lx for a tube.
/// **Domain:** unit `n`; 0 for a line of no length and for `p` within [`super::point::CONTACT`] of the light; finite on
/// the light's axis.
/// **Accuracy:** 2e-15 of |B−A|/dᶠ, relative 5e-14, with near, far, short, long and axial lights among the cases;
/// tubes 3e-13 of 2ϱ|B−A|/dᶠ (`closed_form::line`). **Twin:** `shaders/line.wgsl`.
pub fn line_irradiance(light: &LineEmitter, p: DVec3, n: DVec3) -> f64 {
    let plain = light.falloff == 2.0 && light.tube.is_none();
    let by_ends = if plain { irradiance_by_ends(light, p, n) } else { None };
    by_ends.unwrap_or_else(|| {
        let visible = LineFrame::new(light, p).and_then(|line| line.above(n));
        visible.map_or(0.0, |visible| {
            let Decay { gain, falloff } = Decay::of(light, &visible);
            gain * visible.irradiance(n, falloff)
        })
    })
}

/// [`line_irradiance`] for f = 2 without the foot, which a line seen under less than 168° does not need; none otherwise.
fn irradiance_by_ends(light: &LineEmitter, p: DVec3, n: DVec3) -> Option<f64> {
    let (mut a, mut b) = (light.a - p, light.b - p);
    let along = light.b - light.a;
    let (mut above_a, mut above_b) = (n.dot(a), n.dot(b));
    let mut visible = 1.0;
    if above_a.min(above_b) < 0.0 {
        if above_a.max(above_b) <= 0.0 {
            return Some(0.0);
        }
        visible = above_a.max(above_b) / (above_a - above_b).abs();
        if above_a < above_b {
            (a, above_a) = (b - visible * along, 0.0);
        } else {
            (b, above_b) = (a + visible * along, 0.0);
        }
    }
    let (r_a, r_b) = (a.length(), b.length());
    let product = r_a * r_b;
    let opening = product + a.dot(b);
    let sum = visible * along.length() * (above_a * r_b + above_b * r_a);
    (opening > 0.02 * product).then(|| sum / (product * opening))
}

/// The specular integral ∫ max(0, r·w)ᵐ/rᶠ ds over the part of a line above n's horizon, without (m+1)/(2π).
///
/// For f = 2 it is ampᵐ·(x/d)·mean of cosᵐφ over the angle x that the visible part subtends, amp being the length of r
/// projected on the plane of p and the line. For other f it is integrated over y with ds = r dy, in panels of 24
/// Gauss–Legendre nodes, each halved until that changes it by no more than 1e-15 of |B−A|/dᶠ. A tube is 2ϱd times a
/// line of falloff f + 1.
///
/// **Source:** [`crate::refs::POULIN_AMANATIDES_1990`], eq. (3); clipping by n from [`crate::refs::SNYDER_1996`], eq. 9.
/// **Domain:** unit `n` and `r`, any real m ≥ 1; as [`line_irradiance`] otherwise. **Units:** cd/m → cd/m².
/// **Accuracy:** f = 2: 1e-14 of |B−A|/d², relative 2e-12; tubes 3e-13 of 2ϱ|B−A|/d² (`closed_form::line`).
/// **Twin:** `shaders/line.wgsl`.
pub fn line_phong(light: &LineEmitter, p: DVec3, n: DVec3, r: DVec3, m: f64) -> f64 {
    LineFrame::new(light, p).and_then(|line| line.above(n)).map_or(0.0, |visible| phong_of(light, &visible, r, m))
}

/// [`line_phong`] over r·w > 0 only, the domain of [`crate::refs::POULIN_AMANATIDES_1990`].
pub fn line_phong_lobe_only(light: &LineEmitter, p: DVec3, r: DVec3, m: f64) -> f64 {
    LineFrame::new(light, p).map_or(0.0, |line| phong_of(light, &line, r, m))
}

fn phong_of(light: &LineEmitter, line: &LineFrame, r: DVec3, m: f64) -> f64 {
    let Decay { gain, falloff } = Decay::of(light, line);
    gain * line.phong(r, m, falloff)
}

/// The line as one point light of its whole intensity towards the point, at its middle.
pub fn line_point(light: &LineEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    let to_light = light.middle() - at.p;
    let intensity = light.length() * light.intensity_along(to_light);
    falloff_response(to_light, intensity, light.falloff, at.n, at.mirror(), lobe)
}

/// The isotropic line that a light is `gain` times.
struct Decay {
    gain: f64,
    falloff: f64,
}

impl Decay {
    fn of(light: &LineEmitter, line: &LineFrame) -> Self {
        match light.tube {
            None => Self { gain: 1.0, falloff: light.falloff },
            Some(radius) => Self { gain: 2.0 * radius * line.distance(), falloff: light.falloff + 1.0 },
        }
    }
}
