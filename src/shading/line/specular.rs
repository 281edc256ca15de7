//! What a Phong lobe sees of a line.

use glam::DVec3;

use super::frame::{LineFrame, Path};
use crate::math::chebyshev::ChebyshevLobe;
use crate::math::special::{cosine_power_mean, panels, refined_panels};

impl LineFrame {
    /// ∫ max(0, r·w)ᵐ/rᶠ ds; see [`super::line_phong`].
    pub(super) fn phong(&self, r: DVec3, m: f64, falloff: f64) -> f64 {
        let Some(lit) = self.above(r) else { return 0.0 };
        if falloff == 2.0 {
            let lobe = lit.projected(r);
            return lobe.amplitude.powf(m)
                * lit.angle_over_d()
                * cosine_power_mean(m, lobe.angle_at(&lit, lit.a), lit.angle());
        }
        lit.lobe_integral(r, falloff, |cos| cos.max(0.0).powf(m))
    }

    /// [`Self::phong`] with cosᵐ in the plane of p and the line replaced by its Chebyshev fit.
    ///
    /// A line that is seen under less than a thousandth of the lobe's width, which may be end on, where that plane is
    /// nobody's, fades to its value in the middle.
    ///
    /// **Source:** [`crate::refs::POULIN_AMANATIDES_1990`], §4.1. **Method error:** at most 0.001 of ∫ ds/r² for m in
    /// 1…1000 (`closed_form::line`).
    pub(super) fn chebyshev(&self, r: DVec3, falloff: f64, m: f64, fit: &ChebyshevLobe) -> f64 {
        let Some(lit) = self.above(r) else { return 0.0 };
        let seen = lit.projected(r);
        let (from, to) = (seen.angle_at(&lit, lit.a), seen.angle_at(&lit, lit.b));
        let trust = (to - from) / (1e-3 * fit.cut());
        let power = seen.amplitude.powf(m);
        if trust >= 1.0 {
            return (power * lit.fit_integral(&seen, fit, [from, to], falloff)).max(0.0);
        }
        let middle = lit.foot + 0.5 * (lit.a + lit.b) * lit.axis;
        let peak = (r.dot(middle) / middle.length()).max(0.0).powf(m);
        let value = fit.value(0.5 * (from + to)).max(0.0);
        (peak + trust.max(0.0) * (power * value - peak)) * lit.falloff_integral(falloff)
    }

    /// ∫ fit(φ)/rᶠ ds, a side of the lobe's middle at a time; `ends` are the angles of a and b.
    fn fit_integral(&self, seen: &ProjectedLobe, fit: &ChebyshevLobe, ends: [f64; 2], falloff: f64) -> f64 {
        let [from, to] = ends;
        if falloff == 2.0 {
            return (fit.integral(to) - fit.integral(from)) / self.d;
        }
        let side = |low: f64, high: f64| {
            if to <= low || from >= high {
                return 0.0;
            }
            let a = if from < low { seen.place_at(self, low) } else { self.a };
            let b = if to > high { seen.place_at(self, high) } else { self.b };
            let path = Path::of(&self.between(a, b));
            panels(0.0, path.end, 2.0, |y| {
                let (distance, s) = path.at(y);
                fit.value(seen.angle_at(self, s)) * distance.powf(1.0 - falloff)
            })
        };
        side(-fit.cut(), 0.0) + side(0.0, fit.cut())
    }

    /// ∫ g(r·w)/rᶠ ds over y, ds = r dy, halving panels until 1e-15 of the whole stands.
    fn lobe_integral(&self, r: DVec3, falloff: f64, g: impl Fn(f64) -> f64) -> f64 {
        let (base, slope) = (r.dot(self.foot), r.dot(self.axis));
        let path = Path::of(self);
        let scale = self.length * self.least_distance().powf(-falloff);
        refined_panels(0.0, path.end, 0.5, 1e-15 * scale, |y| {
            let (distance, s) = path.at(y);
            g((base + s * slope) / distance) * distance.powf(1.0 - falloff)
        })
    }

    /// r projected on the plane of p and the line.
    fn projected(&self, r: DVec3) -> ProjectedLobe {
        let toward_foot = if self.d > 0.0 { self.foot / self.d } else { self.axis.any_orthonormal_vector() };
        let (across, along) = (r.dot(toward_foot), r.dot(self.axis));
        ProjectedLobe { across, along, amplitude: (across * across + along * along).sqrt().min(1.0) }
    }

    /// The point of least angle to r, relative to p.
    ///
    /// Of two ends whose cosines are the same to a millionth, as those of a line seen end on, it is the nearer.
    ///
    /// **Source:** [`crate::refs::PICOTT_1992`], eq. (7) and app. B, taken only where it is a maximum between the ends.
    pub fn nearest(&self, r: DVec3) -> DVec3 {
        let (base, slope) = (r.dot(self.foot), r.dot(self.axis));
        // cos = (base + s·slope)/√(d² + s²) is stationary at s = slope·d²/base, a maximum for base > 0.
        let at = |s: f64| self.foot + s * self.axis;
        if base > 0.0 {
            let s = slope * self.d * self.d / base;
            if self.a < s && s < self.b {
                return at(s);
            }
        }
        let (cos_a, cos_b) = ((base + self.a * slope) / self.r_a, (base + self.b * slope) / self.r_b);
        let same = (cos_a - cos_b).abs() <= 1e-6 * cos_a.abs();
        let a_is_best = if same { self.r_a <= self.r_b } else { cos_a > cos_b };
        at(if a_is_best { self.a } else { self.b })
    }
}

/// The projection of a lobe's axis on the plane of p and a line.
struct ProjectedLobe {
    /// Its parts towards the foot and along the axis.
    across: f64,
    along: f64,
    /// Its length.
    amplitude: f64,
}

impl ProjectedLobe {
    /// The angle from the projection to the line's point at s.
    fn angle_at(&self, line: &LineFrame, s: f64) -> f64 {
        (self.across * s - self.along * line.d).atan2(self.across * line.d + self.along * s)
    }

    /// The line's point at an angle from the projection that it crosses.
    fn place_at(&self, line: &LineFrame, angle: f64) -> f64 {
        let tan = angle.tan();
        line.d * (self.along + self.across * tan) / (self.across - self.along * tan)
    }
}
