//! How much room lights take.

use glam::DVec3;

use crate::light::{Emitter, Light};

/// A sphere around things.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Centre.
    pub center: DVec3,
    /// Radius in metres.
    pub radius: f64,
}

/// What a symbol without extent counts as, metres.
const SYMBOL_RADIUS: f64 = 0.25;

impl Ball {
    /// The ball about the middle of the points' bounding box; `None` of no points.
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Option<Self> {
        let points: Vec<DVec3> = points.into_iter().filter(|p| p.is_finite()).collect();
        let first = *points.first()?;
        let (min, max) = points.iter().fold((first, first), |(min, max), p| (min.min(*p), max.max(*p)));
        let center = min.midpoint(max);
        let radius = points.iter().map(|p| p.distance(center)).fold(0.0, f64::max);
        Some(Self { center, radius: radius.max(SYMBOL_RADIUS) })
    }
}

/// Corners of a disk's outline.
const RIM: u32 = 64;

/// The outline of a flat light; `None` of others.
pub fn outline(light: &Light) -> Option<Vec<DVec3>> {
    match light.emitter() {
        Emitter::Polygon(polygon) => Some(polygon.vertices),
        Emitter::Disk(disk) => Some(disk.rim(RIM).collect()),
        Emitter::Textured(textured) => Some(textured.corners().to_vec()),
        _ => None,
    }
}

/// Points that span a light: the ball around them holds it.
pub fn light_points(light: &Light) -> Vec<DVec3> {
    match light.emitter() {
        Emitter::Polygon(_) | Emitter::Disk(_) | Emitter::Textured(_) => outline(light).unwrap_or_default(),
        Emitter::Line(line) => vec![line.a, line.b],
        Emitter::Sphere(sphere) => {
            let reach = DVec3::splat(sphere.radius / 3.0_f64.sqrt());
            vec![sphere.center - reach, sphere.center + reach]
        }
        Emitter::Cap(_) | Emitter::Sky(_) | Emitter::Point(_) | Emitter::Directional(_) => vec![light.position],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_holds_its_points_and_nothing_gives_none() {
        let ball = Ball::around([DVec3::ZERO, DVec3::new(2.0, 0.0, 0.0)]).expect("points");
        assert_eq!(ball, Ball { center: DVec3::X, radius: 1.0 }, "about the middle");
        assert_eq!(Ball::around([]), None, "nothing");
    }

    #[test]
    fn a_single_point_still_has_room_around_it() {
        let ball = Ball::around([DVec3::ONE]).expect("a point");
        assert!(ball.radius > 0.0, "radius {}", ball.radius);
    }
}
