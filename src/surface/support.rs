//! How far surfaces reach along a direction.

use glam::DVec3;

use super::{Placed, Primitive};

impl Placed {
    /// The greatest g·(x − p) over the points x of the primitive; of a patch, over its control points, which is no less.
    ///
    /// **Domain:** any g; infinite for the plane unless g is its normal's multiple.
    pub fn reach(&self, p: DVec3, g: DVec3) -> f64 {
        let world_from_local = self.world_from_local();
        let farthest = |points: &[DVec3]| {
            let heights = points.iter().map(|&x| g.dot(world_from_local.transform_point3(x) - p));
            heights.fold(f64::NEG_INFINITY, f64::max)
        };
        let local = world_from_local.matrix3.transpose() * g;
        let (across, along) = (local.truncate(), local.z);
        let from_center = match self.primitive() {
            Primitive::Plane => {
                if across.length() <= 1e-12 * local.length() {
                    0.0
                } else {
                    f64::INFINITY
                }
            }
            &Primitive::Sphere { radius } => radius * local.length(),
            &Primitive::Box { size } => 0.5 * size.dot(local.abs()),
            &Primitive::Square { size } => 0.5 * size.dot(across.abs()),
            &Primitive::Disk { radius } => radius * across.length(),
            &Primitive::Cylinder { radius, height } => radius * across.length() + 0.5 * height * along.abs(),
            &Primitive::Cone { radius, height } => {
                (0.5 * height * along).max(radius * across.length() - 0.5 * height * along)
            }
            Primitive::Triangle(triangle) => return farthest(&triangle.corners),
            Primitive::Patch(patch) => return farthest(&patch.control_points),
        };
        g.dot(world_from_local.translation - p) + from_center
    }
}
