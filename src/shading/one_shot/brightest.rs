//! Where on the light's plane a cosine lobe finds it brightest.

use glam::DVec2;

/// A point at a height over the plane of a pattern, all in texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The point's projection on the plane.
    pub foot: DVec2,
    /// Its distance from the plane, more than 0.
    pub height: f64,
}

/// A cosine lobe's axis as a pattern's plane sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Unit direction of its part along the plane.
    pub along: DVec2,
    /// Length of that part.
    pub tangential: f64,
    /// Its part away from the plane: −1 looks straight at it.
    pub away: f64,
}

/// A point of the plane as the viewer sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Where it is.
    pub place: DVec2,
    /// From the foot to it.
    pub step: DVec2,
    /// Distance from the viewer.
    pub distance: f64,
    /// Cosine at the light over the squared distance.
    pub falloff: f64,
    /// Cosine of its direction to the lobe's axis.
    pub cosine: f64,
}

impl Axis {
    /// The axis of a vector's parts along and away from the plane.
    pub fn new(along: DVec2, away: f64) -> Self {
        Self { along: along.normalize_or_zero(), tangential: along.length(), away }
    }
}

impl View {
    /// A point of the plane.
    pub fn spot(&self, place: DVec2, axis: &Axis) -> Spot {
        let step = place - self.foot;
        let distance = step.length().hypot(self.height);
        let cosine = (step.dot(axis.along) * axis.tangential - self.height * axis.away) / distance;
        Spot { place, step, distance, falloff: self.height / (distance * distance * distance), cosine }
    }

    /// The point of the plane that maximises cos(ω, light's normal)·cosᵐ(ω, axis)/distance²: [`brightest_step`] from
    /// the foot along the axis. None where it runs to infinity.
    pub fn brightest(&self, axis: &Axis, m: f64) -> Option<Spot> {
        let t = brightest_step(axis.tangential, axis.away, m);
        (t < FARTHEST).then(|| self.spot(self.foot + t * self.height * axis.along, axis))
    }
}

/// The greatest step, in heights. Beyond it the light is below 1e-17 of a facing axis' one.
pub const FARTHEST: f64 = 1e6;

/// How far from the foot, in heights, a lobe about an axis with those parts along the plane and away from it finds the
/// plane brightest, at most [`FARTHEST`].
///
/// The positive root of 3N_x t² − (m+3)N_z t − m N_x = 0, where the derivative along the axis is zero.
///
/// **Source:** [`crate::refs::ONE_SHOT`], eq. (9), (10) and appendices A and B, without their angles.
/// **Domain:** any m > 0. For an axis away from the plane the root runs to infinity as N_x goes to 0.
/// **Twin:** `shaders/one_shot.wgsl`.
pub fn brightest_step(tangential: f64, away: f64, m: f64) -> f64 {
    let b = (m + 3.0) * away;
    let root = b.hypot((12.0 * m).sqrt() * tangential);
    if away <= 0.0 {
        return if root - b > 0.0 { 2.0 * m * tangential / (root - b) } else { 0.0 };
    }
    if b + root < FARTHEST * 6.0 * tangential { (b + root) / (6.0 * tangential) } else { FARTHEST }
}
