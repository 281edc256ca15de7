//! What a point sees of a disk: the directions within an elliptic cone.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::light::DiskEmitter;

/// Nearer to the disk's plane than this part of its farthest point's distance, a point is in the plane.
const FLAT: f64 = 1e-14;

/// Nearer to the disk's axis than this part of that distance, a point is on the axis.
const ROUND: f64 = 1e-14;

/// The directions in (X/tan α)² + (Y/tan β)² < Z², Z > 0, in axes of its own; α ≤ β.
///
/// X and Z lie in the plane of symmetry of p and the disk, which cuts it in a diameter: Z halves the angle 2α that the
/// diameter subtends, and tan β = R/(√(l₁l₂) cos α), l₁ and l₂ the distances to the diameter's ends (derived here, from
/// the cone's quadratic form). The rim's unit directions are (sin α cos t, sin β sin t, √(cos²α cos²t + cos²β sin²t)).
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    /// Unit axes X, Y, Z, right-handed.
    pub(super) axes: [DVec3; 3],
    pub(super) sin_a: f64,
    pub(super) cos_a: f64,
    pub(super) sin_b: f64,
    pub(super) cos_b: f64,
}

impl Cone {
    /// The cone of a disk seen from `p`; none from its plane.
    pub(super) fn new(light: &DiskEmitter, p: DVec3) -> Option<Self> {
        let to_center = light.center - p;
        let height = light.normal.dot(to_center);
        let ahead = if height < 0.0 { -light.normal } else { light.normal };
        let lateral = to_center - height * light.normal;
        let (height, aside, radius) = (height.abs(), lateral.length(), light.radius);
        let (l_1, l_2) = ((aside - radius).hypot(height), (aside + radius).hypot(height));
        if height <= FLAT * l_2 {
            return None;
        }
        // What is left of `to_center` near the axis has lost its direction.
        let across = if aside > ROUND * l_2 {
            (lateral - lateral.dot(ahead) * ahead).normalize()
        } else {
            ahead.any_orthonormal_vector()
        };
        let product = l_1 * l_2;
        let sin_2a = 2.0 * radius * height / product;
        let cos_2a = ((aside - radius) * (aside + radius) + height * height) / product;
        let (sin_a, cos_a) = if cos_2a >= 0.0 {
            let cosine = (0.5 * (1.0 + cos_2a)).sqrt();
            (0.5 * sin_2a / cosine, cosine)
        } else {
            let sine = (0.5 * (1.0 - cos_2a)).sqrt();
            (sine, 0.5 * sin_2a / sine)
        };
        // Unit vectors to the diameter's ends, along `across` and `ahead`.
        let (u_1, u_2) = ([(aside - radius) / l_1, height / l_1], [(aside + radius) / l_2, height / l_2]);
        let [z_across, z_ahead] = if cos_2a >= 0.0 {
            unit([u_1[0] + u_2[0], u_1[1] + u_2[1]])
        } else {
            let [x, y] = unit([u_2[0] - u_1[0], u_2[1] - u_1[1]]);
            [-y, x]
        };
        let narrow = product.sqrt() * cos_a;
        let slant = radius.hypot(narrow);
        Some(Self {
            axes: [z_ahead * across - z_across * ahead, ahead.cross(across), z_across * across + z_ahead * ahead],
            sin_a,
            cos_a,
            sin_b: radius / slant,
            cos_b: narrow / slant,
        })
    }

    /// A vector in the cone's axes.
    pub(super) fn local(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        DVec3::new(v.dot(x), v.dot(y), v.dot(z))
    }

    /// Where a horizon of local normal n cuts the rim.
    pub(super) fn cut(&self, n: DVec3) -> Cut {
        let (x, y) = (self.sin_a * self.cos_b * n.x, self.cos_a * self.sin_b * n.y);
        let z = self.cos_a * self.cos_b * n.z;
        let amplitude = x.hypot(y);
        if z >= amplitude {
            Cut::Above
        } else if z <= -amplitude {
            Cut::Below
        } else {
            let cos = -z / amplitude;
            let sin = ((amplitude - z) * (amplitude + z)).sqrt() / amplitude;
            Cut::Across(Chord { axis: [x / amplitude, y / amplitude], amplitude, sin, cos })
        }
    }
}

impl Cone {
    /// The part of the rim above a horizon, an interval of the angle t of the rim's directions.
    pub(super) fn rim_above(&self, cut: Cut) -> [f64; 2] {
        let Cut::Across(chord) = cut else { return [0.0, TAU] };
        let [from, to] = chord.ends().map(|[cos, sin]| (sin * self.cos_a).atan2(cos * self.cos_b));
        let width = (to - from).rem_euclid(TAU);
        // Rounding must not make a whole rim of none.
        let width = match (chord.cos > 0.0, width > PI) {
            (true, true) => 0.0,
            (false, false) => TAU,
            _ => width,
        };
        [from, from + width]
    }

    /// The unit direction to a point of the unit circle that stands for the rim.
    pub(super) fn direction(&self, [cos, sin]: [f64; 2]) -> DVec3 {
        let (wide, narrow) = (self.sin_b * self.cos_a, self.sin_a * self.cos_b);
        DVec3::new(narrow * cos, wide * sin, self.cos_a * self.cos_b).normalize()
    }
}

impl Chord {
    /// cos and sin of τ − γ and of τ + γ.
    pub(super) fn ends(&self) -> [[f64; 2]; 2] {
        let [x, y] = self.axis;
        let (cos, sin) = (self.cos, self.sin);
        [[x * cos + y * sin, y * cos - x * sin], [x * cos - y * sin, y * cos + x * sin]]
    }
}

fn unit([x, y]: [f64; 2]) -> [f64; 2] {
    let length = x.hypot(y);
    [x / length, y / length]
}

/// How a horizon lies to the rim.
#[derive(Clone, Copy, Debug)]
pub(super) enum Cut {
    /// All of the disk is above it.
    Above,
    /// None is.
    Below,
    /// It cuts the disk along a chord.
    Across(Chord),
}

/// A chord of the disk that the cone makes of a cut Z = 1, scaled to the unit disk: the points with cos(t − τ) = cos γ.
/// The rim above the horizon is |t − τ| < γ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chord {
    /// cos τ and sin τ.
    pub(super) axis: [f64; 2],
    /// cos α cos β √((tan α nₓ)² + (tan β n_y)²).
    pub(super) amplitude: f64,
    /// sin γ ≥ 0.
    pub(super) sin: f64,
    /// cos γ.
    pub(super) cos: f64,
}
