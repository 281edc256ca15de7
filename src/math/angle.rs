//! Angles between vectors.

use glam::DVec3;

/// The angle between two vectors of any length, 0…π; 0 when either is zero.
///
/// θ = atan2(‖u × v‖, u · v), which keeps full accuracy at both ends, where the arccosine of a dot product loses half
/// of its digits.
pub fn angle_between(u: DVec3, v: DVec3) -> f64 {
    u.cross(v).length().atan2(u.dot(v))
}
