//! A line about the foot of the perpendicular from a point, and its irradiance there.

use glam::DVec3;

use crate::light::LineEmitter;
use crate::math::special::{asin_excess, panels};
use crate::shading::point::CONTACT;

/// A line as seen from a point: `foot + s·axis`, a ≤ s ≤ b.
#[derive(Clone, Copy, Debug)]
pub struct LineFrame {
    pub(super) foot: DVec3,
    pub(super) axis: DVec3,
    pub(super) d: f64,
    pub(super) a: f64,
    pub(super) b: f64,
    /// b − a, which the difference does not give for short lines far away.
    pub(super) length: f64,
    /// Distances of the ends.
    pub(super) r_a: f64,
    pub(super) r_b: f64,
}

impl LineFrame {
    /// The frame of a light about `p`; none for a line of no length and where `p` touches it.
    pub fn new(light: &LineEmitter, p: DVec3) -> Option<Self> {
        let (to_a, to_b) = (light.a - p, light.b - p);
        let along = light.b - light.a;
        let length = along.length();
        if length < CONTACT {
            return None;
        }
        let axis = along / length;
        // The foot is found from the nearer end, so that its rounding is that of the shorter vector.
        let (foot, a, b) = if to_a.length_squared() < to_b.length_squared() {
            let a = to_a.dot(axis);
            (to_a - a * axis, a, a + length)
        } else {
            let b = to_b.dot(axis);
            (to_b - b * axis, b - length, b)
        };
        let square = foot.length_squared();
        let (r_a, r_b) = ((square + a * a).sqrt(), (square + b * b).sqrt());
        let frame = Self { foot, axis, d: square.sqrt(), a, b, length, r_a, r_b };
        (frame.least_distance() >= CONTACT).then_some(frame)
    }

    /// Distance to the line, however far it is extended.
    pub fn distance(&self) -> f64 {
        self.d
    }

    /// Distance of its nearest point.
    pub(super) fn least_distance(&self) -> f64 {
        if self.a <= 0.0 && self.b >= 0.0 { self.d } else { self.r_a.min(self.r_b) }
    }

    /// The part where n·w > 0.
    pub fn above(self, n: DVec3) -> Option<Self> {
        let (base, slope) = (n.dot(self.foot), n.dot(self.axis));
        let (at_a, at_b) = (base + self.a * slope, base + self.b * slope);
        if at_a <= 0.0 && at_b <= 0.0 {
            return None;
        }
        if at_a >= 0.0 && at_b >= 0.0 {
            return Some(self);
        }
        let length = self.length * (at_a.max(at_b) / (at_a - at_b).abs());
        let clipped =
            if at_a < 0.0 { self.between(self.b - length, self.b) } else { self.between(self.a, self.a + length) };
        (length > 0.0).then_some(Self { length, ..clipped })
    }

    /// The part between two places on the line.
    pub(super) fn between(self, a: f64, b: f64) -> Self {
        let reach = |s: f64| (self.d * self.d + s * s).sqrt();
        let (r_a, r_b) = (if a == self.a { self.r_a } else { reach(a) }, if b == self.b { self.r_b } else { reach(b) });
        Self { a, b, length: b - a, r_a, r_b, ..self }
    }

    /// ∫ (n·w)/rᶠ ds of a frame clipped by n already; see [`super::line_irradiance`].
    pub(super) fn irradiance(&self, n: DVec3, falloff: f64) -> f64 {
        let (base, slope) = (n.dot(self.foot), n.dot(self.axis));
        let Self { a, b, length, r_a, r_b, .. } = *self;
        let sum = if falloff == 2.0 {
            length * ((base + a * slope) * r_b + (base + b * slope) * r_a) / (r_a * r_b * self.opening())
        } else if falloff == 0.0 {
            base * self.asinh_difference() + slope * length * (a + b) / (r_a + r_b)
        } else if falloff == 1.0 {
            base * self.angle_over_d() + slope * self.log_ratio()
        } else if falloff == 3.0 {
            base * self.fourth_power_integral() + 0.5 * slope * length * (a + b) / (r_a * r_a * r_b * r_b)
        } else {
            let path = Path::of(self);
            panels(0.0, path.end, 2.0, |y| {
                let (r, s) = path.at(y);
                (base + s * slope) * r.powf(-falloff)
            })
        };
        sum.max(0.0)
    }

    /// r_a r_b + A·B = r_a r_b (1 + cos x), x the angle between the ends.
    fn opening(&self) -> f64 {
        let (d_squared, a, b) = (self.d * self.d, self.a, self.b);
        let (product, ab) = (self.r_a * self.r_b, a * b);
        if ab >= 0.0 {
            product + d_squared + ab
        } else {
            d_squared * (1.0 + (d_squared + a * a + b * b) / (product - ab))
        }
    }

    /// x between the ends.
    pub(super) fn angle(&self) -> f64 {
        (self.d * self.length).atan2(self.d * self.d + self.a * self.b)
    }

    /// ∫ ds/r² = x/d.
    pub(super) fn angle_over_d(&self) -> f64 {
        if self.d > 0.0 { self.angle() / self.d } else { self.length / (self.r_a * self.r_b) }
    }

    /// ∫ ds/rᶠ.
    pub(super) fn falloff_integral(&self, falloff: f64) -> f64 {
        if falloff == 2.0 {
            return self.angle_over_d();
        }
        let path = Path::of(self);
        panels(0.0, path.end, 2.0, |y| path.at(y).0.powf(1.0 - falloff))
    }

    /// ∫ ds/r = asinh(b/d) − asinh(a/d) = ln((r_a + r_b + L)/(r_a + r_b − L)).
    fn asinh_difference(&self) -> f64 {
        let (a, b, d_squared) = (self.a.abs(), self.b.abs(), self.d * self.d);
        let excess = if self.a * self.b < 0.0 {
            d_squared / (self.r_a + a) + d_squared / (self.r_b + b)
        } else if a < b {
            self.r_a + a + d_squared / (self.r_b + b)
        } else {
            self.r_b + b + d_squared / (self.r_a + a)
        };
        (2.0 * self.length / excess).ln_1p()
    }

    /// ∫ s ds/r² = ln(r_b/r_a).
    fn log_ratio(&self) -> f64 {
        let difference = self.length * (self.a + self.b);
        if difference >= 0.0 {
            0.5 * (difference / (self.r_a * self.r_a)).ln_1p()
        } else {
            -0.5 * (-difference / (self.r_b * self.r_b)).ln_1p()
        }
    }

    /// ∫ ds/r⁴ = ½[(x − sin x)/d³ + t(1/r_a + 1/r_b)²/(1 + cos x)], t = sin x/d = L/(r_a r_b).
    fn fourth_power_integral(&self) -> f64 {
        let product = self.r_a * self.r_b;
        let t = self.length / product;
        let sin = t * self.d;
        let excess = if sin < 0.3 && self.d * self.d + self.a * self.b > 0.0 {
            t * t * t * asin_excess(sin)
        } else {
            (self.angle() - sin) / (self.d * self.d * self.d)
        };
        let sum = (self.r_a + self.r_b) / product;
        0.5 * (excess + t * sum * sum * product / self.opening())
    }
}

/// A line walked in y with ds = r dy: r = α eʸ + β e⁻ʸ, s = α eʸ − β e⁻ʸ from a at y = 0 to b at `end`.
pub(super) struct Path {
    alpha: f64,
    beta: f64,
    pub(super) end: f64,
}

impl Path {
    pub(super) fn of(line: &LineFrame) -> Self {
        let large = 0.5 * (line.r_a + line.a.abs());
        let small = 0.25 * line.d * line.d / large;
        let (alpha, beta) = if line.a >= 0.0 { (large, small) } else { (small, large) };
        Self { alpha, beta, end: line.asinh_difference() }
    }

    /// Distance and place on the line.
    pub(super) fn at(&self, y: f64) -> (f64, f64) {
        let growth = y.exp();
        let (up, down) = (self.alpha * growth, self.beta / growth);
        (up + down, up - down)
    }
}
