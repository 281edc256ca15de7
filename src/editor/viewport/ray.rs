//! Half-lines from the eye, and where they come close to things.

use glam::DVec3;

/// A half-line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Unit direction.
    pub direction: DVec3,
}

/// Below this sine of the angle between ray and axis, or ray and plane, a drag would leap: no answer is given.
const LEAST_SINE: f64 = 0.02;

impl Ray {
    /// The point at distance `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }

    /// Distance along the ray to the plane through `point` with unit `normal`; `None` behind the eye or when the
    /// plane is seen edge-on.
    pub fn plane_distance(&self, point: DVec3, normal: DVec3) -> Option<f64> {
        let cosine = self.direction.dot(normal);
        if cosine.abs() < 1e-9 {
            return None;
        }
        let t = (point - self.origin).dot(normal) / cosine;
        (t > 0.0 && t.is_finite()).then_some(t)
    }

    /// Where the ray meets the plane through `point` with unit `normal`.
    pub fn on_plane(&self, point: DVec3, normal: DVec3) -> Option<DVec3> {
        self.plane_distance(point, normal).map(|t| self.at(t))
    }

    /// As [`Self::on_plane`], but `None` too where the plane is seen so flatly that a drag on it would leap.
    pub fn drag_on_plane(&self, point: DVec3, normal: DVec3) -> Option<DVec3> {
        (self.direction.dot(normal).abs() >= LEAST_SINE).then(|| self.on_plane(point, normal)).flatten()
    }

    /// Signed distance from `point` along the unit `axis` to the point of that axis closest to the ray's line.
    ///
    /// s = (w × d) · (a × d) / ‖a × d‖² with w from `point` to the ray's origin; `None` where the ray runs along the axis.
    pub fn closest_on_axis(&self, point: DVec3, axis: DVec3) -> Option<f64> {
        let across = axis.cross(self.direction);
        if across.length() < LEAST_SINE {
            return None;
        }
        let s = (self.origin - point).cross(self.direction).dot(across) / across.length_squared();
        s.is_finite().then_some(s)
    }

    /// Distance along the ray to a sphere's nearest point in front of the eye.
    pub fn sphere_distance(&self, center: DVec3, radius: f64) -> Option<f64> {
        let to_center = center - self.origin;
        let along = to_center.dot(self.direction);
        let miss = to_center.cross(self.direction).length();
        if miss > radius {
            return None;
        }
        let half_chord = ((radius - miss) * (radius + miss)).sqrt();
        [along - half_chord, along + half_chord].into_iter().find(|t| *t > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ray(origin: [f64; 3], to: [f64; 3]) -> Ray {
        let origin = DVec3::from(origin);
        Ray { origin, direction: (DVec3::from(to) - origin).normalize() }
    }

    #[test]
    fn the_closest_point_of_an_axis_is_where_the_common_perpendicular_ends() {
        let ray = ray([3.0, -4.0, 5.0], [0.5, 1.0, -0.25]);
        let (point, axis) = (DVec3::new(0.2, 0.1, 0.3), DVec3::new(1.0, 2.0, -0.5).normalize());
        let s = ray.closest_on_axis(point, axis).expect("not parallel");
        let on_axis = point + s * axis;
        let on_ray = ray.at((on_axis - ray.origin).dot(ray.direction));
        let between = on_axis - on_ray;
        assert!(between.dot(axis).abs() < 1e-12, "perpendicular to the axis: {}", between.dot(axis));
        assert!(between.dot(ray.direction).abs() < 1e-12, "perpendicular to the ray");
    }

    #[test]
    fn a_ray_along_the_axis_has_no_closest_point() {
        let ray = ray([0.0, 0.0, 5.0], [0.0, 0.0, 0.0]);
        assert_eq!(ray.closest_on_axis(DVec3::ZERO, DVec3::Z), None, "parallel");
    }

    #[test]
    fn planes_are_met_in_front_only() {
        let down = ray([1.0, 2.0, 3.0], [1.0, 2.0, 0.0]);
        assert_eq!(down.on_plane(DVec3::ZERO, DVec3::Z), Some(DVec3::new(1.0, 2.0, 0.0)), "in front");
        assert_eq!(down.on_plane(DVec3::new(0.0, 0.0, 4.0), DVec3::Z), None, "behind");
        assert_eq!(down.on_plane(DVec3::ZERO, DVec3::X), None, "parallel");
    }

    #[test]
    fn a_sphere_is_met_at_its_near_side_or_from_inside_at_its_far_side() {
        let ahead = ray([0.0, -5.0, 0.0], [0.0, 0.0, 0.0]);
        assert!((ahead.sphere_distance(DVec3::ZERO, 1.0).expect("hit") - 4.0).abs() < 1e-12, "near side");
        let inside = ray([0.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        assert!((inside.sphere_distance(DVec3::ZERO, 2.0).expect("hit") - 2.0).abs() < 1e-12, "from inside");
        assert_eq!(ahead.sphere_distance(DVec3::new(0.0, -9.0, 0.0), 1.0), None, "behind");
        assert_eq!(ahead.sphere_distance(DVec3::new(2.0, 0.0, 0.0), 1.0), None, "beside");
    }
}
