//! Pointing at the plane on which lights are drawn.

use glam::{DVec2, DVec3};

use crate::editor::session::WorkPlane;
use crate::editor::viewport::ray::Ray;

/// Seen at a smaller sine than this, the work plane is too flat to point at.
const LEAST_SINE: f64 = 0.02;
/// Further from the eye than this, in metres, so is it.
const REACH: f64 = 1000.0;

/// The point of the work plane under the pointer, on its grid where `snap` says so.
pub fn point_at(ray: &Ray, plane: &WorkPlane, snap: bool) -> Option<DVec2> {
    let height = DVec3::new(0.0, 0.0, plane.height);
    let seen_well = ray.direction.z.abs() >= LEAST_SINE;
    let t = ray.plane_distance(height, DVec3::Z).filter(|t| seen_well && *t < REACH)?;
    let p = ray.at(t).truncate();
    Some(if snap { snapped(p, plane.grid) } else { p })
}

/// Whether a tool sticks to the grid: as the work plane says, or the other way round while `toggle` is held.
pub fn sticks(plane: &WorkPlane, toggle: bool) -> bool {
    plane.snap != toggle
}

/// The grid point nearest to `p`; `p` itself on a grid without spacing.
pub fn snapped(p: DVec2, grid: f64) -> DVec2 {
    DVec2::new(snapped_to(p.x, grid), snapped_to(p.y, grid))
}

/// The multiple of `step` nearest to `value`; `value` itself when `step` is not positive.
pub fn snapped_to(value: f64, step: f64) -> f64 {
    if step > 0.0 {
        // Dividing by a rounded reciprocal gives 0.3 where multiplying 3 × 0.1 gives 0.30000000000000004.
        let per_unit = step.recip();
        let whole = per_unit.round();
        let steps = (value / step).round();
        if (per_unit - whole).abs() < 1e-9 * whole { steps / whole } else { steps * step }
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pointing_down_meets_the_plane_at_its_height_and_grid() {
        let plane = WorkPlane { height: 2.0, snap: true, grid: 0.5 };
        let ray = Ray { origin: DVec3::new(0.3, 0.6, 5.0), direction: DVec3::NEG_Z };
        assert_eq!(point_at(&ray, &plane, true), Some(DVec2::new(0.5, 0.5)), "on the grid");
        assert_eq!(point_at(&ray, &plane, false), Some(DVec2::new(0.3, 0.6)), "free");
    }

    #[test]
    fn pointing_at_the_sky_or_the_horizon_meets_nothing() {
        let plane = WorkPlane { height: 2.0, snap: false, grid: 0.1 };
        let up = Ray { origin: DVec3::new(0.0, 0.0, 5.0), direction: DVec3::Z };
        let flat = Ray { origin: DVec3::new(0.0, 0.0, 5.0), direction: DVec3::new(1.0, 0.0, -0.01).normalize() };
        assert_eq!(point_at(&up, &plane, false), None, "up");
        assert_eq!(point_at(&flat, &plane, false), None, "seen flatly");
    }

    #[test]
    fn snapped_values_are_the_decimals_one_would_type() {
        assert_eq!(snapped_to(0.31, 0.1), 0.3, "tenths");
        assert_eq!(snapped_to(-1.26, 0.25), -1.25, "quarters");
        assert_eq!(snapped_to(7.2, 3.0), 6.0, "whole metres");
        assert_eq!(snapped_to(7.2, 0.0), 7.2, "no grid");
    }
}
