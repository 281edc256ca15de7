//! The plane on which lights are drawn: where it is, how it is pointed at, and which way lights on it shine.

use glam::{DMat3, DVec2, DVec3};

use crate::editor::viewport::ray::Ray;
use crate::math::frame::deg_from_rotation;
use crate::scene::Camera;
use crate::surface::{Hit, Surface};

/// Seen at a smaller sine than this, the work plane is too flat to point at.
const LEAST_SINE: f64 = 0.02;
/// Further from the eye than this, in metres, so is it.
const REACH: f64 = 1000.0;
/// What lies nearer to an upright plane than this share of the eye's distance lies in it.
const IN_PLANE: f64 = 0.02;

/// Which plane lights are drawn on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PlaneKind {
    /// Level, at a height.
    #[default]
    Level,
    /// Upright along X and Z.
    Front,
    /// Upright along Y and Z.
    Side,
    /// Upright, facing the view as it was when this plane was chosen.
    Facing,
    /// On the surface that is pointed at.
    Surface,
}

/// The plane on which lights are drawn, and what drawing sticks to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorkPlane {
    /// Which plane.
    pub kind: PlaneKind,
    /// Of the level plane: height above the ground, metres.
    pub height: f64,
    /// Of the plane along X and Z: its Y, metres.
    pub y: f64,
    /// Of the plane along Y and Z: its X, metres.
    pub x: f64,
    /// Of the plane that faces the view: where its normal points, degrees from X to Y.
    pub azimuth_deg: f64,
    /// Of the plane that faces the view: how far along its normal it is from the world's origin, metres.
    pub offset: f64,
    /// Of the plane on a surface: the surface's tangent plane where it was pointed at last.
    pub tangent: Option<Frame>,
    /// Of the plane on a surface: how far off the surface, metres.
    pub gap: f64,
    /// Lights shine to the other side than they would.
    pub flip: bool,
    /// Whether what is drawn or dragged sticks to the grid.
    pub snap: bool,
    /// Grid spacing, metres.
    pub grid: f64,
    /// Whether what is drawn sticks to corners of lights and surfaces.
    pub to_corners: bool,
}

/// A plane with axes: its points are told by how far along `u` and `v` they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The point of coordinates 0, 0.
    pub origin: DVec3,
    /// Unit vector of the first coordinate.
    pub u: DVec3,
    /// Unit vector of the second coordinate, perpendicular to the first.
    pub v: DVec3,
}

/// A plane that is drawn on, and the side to which lights on it shine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Canvas {
    /// The plane.
    pub frame: Frame,
    /// Whether lights shine along its normal, not against it.
    pub forward: bool,
}

impl PlaneKind {
    /// All of them, in the order in which a key goes through them.
    pub const ALL: [Self; 5] = [Self::Level, Self::Front, Self::Side, Self::Facing, Self::Surface];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Level => "Level",
            Self::Front => "Upright XZ",
            Self::Side => "Upright YZ",
            Self::Facing => "Facing view",
            Self::Surface => "On surface",
        }
    }

    /// What it is.
    pub fn hint(self) -> &'static str {
        match self {
            Self::Level => "A level plane at a height; lights on it shine down",
            Self::Front => "An upright plane along X and Z",
            Self::Side => "An upright plane along Y and Z",
            Self::Facing => "An upright plane through what the view looks at, facing it",
            Self::Surface => "The surface under the pointer; lights on it shine away from it",
        }
    }
}

impl Default for WorkPlane {
    fn default() -> Self {
        Self {
            kind: PlaneKind::default(),
            height: 2.0,
            y: 0.0,
            x: 0.0,
            azimuth_deg: -90.0,
            offset: 0.0,
            tangent: None,
            gap: 0.01,
            flip: false,
            snap: true,
            grid: 0.1,
            to_corners: true,
        }
    }
}

impl WorkPlane {
    /// Take another kind of plane; one that faces the view goes through what `camera` looks at.
    pub fn choose(&mut self, kind: PlaneKind, camera: &Camera) {
        self.kind = kind;
        match kind {
            PlaneKind::Facing => {
                let toward = camera.eye - camera.target;
                if toward.truncate().length() > 1e-9 * toward.length() {
                    // Whole degrees and centimetres, so that the numbers are short.
                    self.azimuth_deg = toward.y.atan2(toward.x).to_degrees().round();
                }
                let normal = upright(self.azimuth_deg, 0.0).normal();
                self.offset = snapped_to(camera.target.dot(normal), 0.01);
            }
            PlaneKind::Surface => self.tangent = None,
            PlaneKind::Level | PlaneKind::Front | PlaneKind::Side => {}
        }
    }

    /// Take the next kind of plane.
    pub fn cycle(&mut self, camera: &Camera) {
        let all = PlaneKind::ALL;
        let at = all.iter().position(|kind| *kind == self.kind).unwrap_or_default();
        self.choose(all[(at + 1) % all.len()], camera);
    }

    /// The plane; none on a surface as long as none has been pointed at.
    pub fn frame(&self) -> Option<Frame> {
        Some(match self.kind {
            PlaneKind::Level => Frame::level(self.height),
            PlaneKind::Front => Frame { origin: DVec3::new(0.0, self.y, 0.0), u: DVec3::X, v: DVec3::Z },
            PlaneKind::Side => Frame { origin: DVec3::new(self.x, 0.0, 0.0), u: DVec3::Y, v: DVec3::Z },
            PlaneKind::Facing => upright(self.azimuth_deg, self.offset),
            PlaneKind::Surface => {
                let frame = self.tangent?;
                Frame { origin: frame.origin + self.gap * frame.normal(), ..frame }
            }
        })
    }

    /// The plane to draw on. Lights shine down from a level plane, away from a surface, and from an upright plane to the
    /// side of what the camera looks at, or to the eye where that lies in the plane; or all the other way round.
    pub fn canvas(&self, camera: &Camera) -> Option<Canvas> {
        let frame = self.frame()?;
        let ahead = match self.kind {
            PlaneKind::Level => false,
            PlaneKind::Surface => true,
            PlaneKind::Front | PlaneKind::Side | PlaneKind::Facing => {
                let height = |p: DVec3| (p - frame.origin).dot(frame.normal());
                let target = height(camera.target);
                let in_plane = target.abs() <= IN_PLANE * camera.eye.distance(camera.target);
                (if in_plane { height(camera.eye) } else { target }) > 0.0
            }
        };
        Some(Canvas { frame, forward: ahead != self.flip })
    }
}

/// An upright plane whose normal points to an azimuth, so far along it from the origin.
fn upright(azimuth_deg: f64, offset: f64) -> Frame {
    let (sin, cos) = azimuth_deg.to_radians().sin_cos();
    Frame { origin: offset * DVec3::new(cos, sin, 0.0), u: DVec3::new(-sin, cos, 0.0), v: DVec3::Z }
}

impl Frame {
    /// The level plane at a height, along X and Y.
    pub fn level(height: f64) -> Self {
        Self { origin: DVec3::new(0.0, 0.0, height), u: DVec3::X, v: DVec3::Y }
    }

    /// The tangent plane of `surface` where a ray met it. Its axes are the surface's own where these lie in it, else one
    /// is level; its origin is the surface's, so that the grid lies the same wherever a flat surface is met.
    pub fn tangent(surface: &Surface, hit: &Hit, ray: &Ray) -> Self {
        let n = if hit.n.dot(ray.direction) > 0.0 { -hit.n } else { hit.n };
        let axes = surface.world_from_surface().matrix3;
        let own = [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| axis.normalize_or_zero());
        let level = DVec3::Z.cross(n).try_normalize().unwrap_or(DVec3::X);
        let u = own.into_iter().find(|axis| *axis != DVec3::ZERO && axis.dot(n).abs() < 1e-9).unwrap_or(level);
        let v = n.cross(u);
        // What is drawn on a wall stands upright.
        let (u, v) = if v.z < -1e-9 { (-u, -v) } else { (u, v) };
        let origin = surface.position + (hit.p - surface.position).dot(n) * n;
        Self { origin, u, v }
    }

    /// Unit normal: `u` and `v` turn counter-clockwise for who looks against it.
    pub fn normal(&self) -> DVec3 {
        self.u.cross(self.v)
    }

    /// The point of those coordinates.
    pub fn point(&self, p: DVec2) -> DVec3 {
        self.origin + p.x * self.u + p.y * self.v
    }

    /// The coordinates of the plane's point nearest to `p`.
    pub fn coordinates(&self, p: DVec3) -> DVec2 {
        let from_origin = p - self.origin;
        DVec2::new(from_origin.dot(self.u), from_origin.dot(self.v))
    }

    /// Where the plane is under the pointer; `None` where it is not, or is seen too flatly or too far away.
    pub fn meet(&self, ray: &Ray) -> Option<DVec2> {
        let normal = self.normal();
        let seen_well = ray.direction.dot(normal).abs() >= LEAST_SINE;
        let t = ray.plane_distance(self.origin, normal).filter(|t| seen_well && *t < REACH)?;
        Some(self.coordinates(ray.at(t)))
    }
}

impl From<f64> for Canvas {
    /// The level plane at a height, lit below.
    fn from(height: f64) -> Self {
        Self { frame: Frame::level(height), forward: false }
    }
}

impl Canvas {
    /// The unit direction in which a light on it shines.
    pub fn lit(&self) -> DVec3 {
        if self.forward { self.frame.normal() } else { -self.frame.normal() }
    }

    /// Rotation of a light on it: it shines along its −Z, and its Y runs up the plane.
    pub fn rotation_deg(&self) -> DVec3 {
        let z = -self.lit();
        let y = self.frame.v;
        let angles = deg_from_rotation(DMat3::from_cols(y.cross(z), y, z));
        // Without the dust of computing, and without negative zeros.
        (angles * 1e9).round() / 1e9 + DVec3::ZERO
    }

    /// A vector of the plane in the axes of a light on it.
    pub fn local(&self, p: DVec2) -> DVec2 {
        if self.forward { DVec2::new(-p.x, p.y) + DVec2::ZERO } else { p }
    }
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
    use crate::math::frame::rotation_from_deg;
    use crate::surface::Shape;

    fn camera(eye: [f64; 3], target: [f64; 3]) -> Camera {
        Camera { eye: eye.into(), target: target.into(), fov_deg: 40.0 }
    }

    fn down(at: [f64; 3]) -> Ray {
        Ray { origin: at.into(), direction: DVec3::NEG_Z }
    }

    #[test]
    fn pointing_down_meets_the_level_plane_at_its_height() {
        let p = Frame::level(2.0).meet(&down([0.3, 0.6, 5.0]));
        assert_eq!(p, Some(DVec2::new(0.3, 0.6)), "from above");
        let up = Ray { origin: DVec3::new(0.3, 0.6, 0.5), direction: DVec3::Z };
        assert_eq!(Frame::level(2.0).meet(&up), Some(DVec2::new(0.3, 0.6)), "from below");
    }

    #[test]
    fn pointing_away_or_along_the_plane_meets_nothing() {
        let up = Ray { origin: DVec3::new(0.0, 0.0, 5.0), direction: DVec3::Z };
        let flat = Ray { origin: DVec3::new(0.0, 0.0, 5.0), direction: DVec3::new(1.0, 0.0, -0.01).normalize() };
        assert_eq!(Frame::level(2.0).meet(&up), None, "away");
        assert_eq!(Frame::level(2.0).meet(&flat), None, "seen flatly");
    }

    #[test]
    fn every_plane_is_met_where_it_is_and_its_light_shines_to_its_lit_side() {
        let camera = camera([3.0, -6.0, 2.0], [0.5, 0.25, 1.0]);
        let mut plane = WorkPlane { y: 2.5, x: -1.5, height: 3.0, ..WorkPlane::default() };
        for kind in PlaneKind::ALL {
            for flip in [false, true] {
                plane.choose(kind, &camera);
                plane.flip = flip;
                plane.tangent = Some(Frame::level(0.0));
                let canvas = plane.canvas(&camera).expect("a plane");
                let p = canvas.frame.point(DVec2::new(0.7, 1.3));
                let ray = Ray { origin: camera.eye, direction: (p - camera.eye).normalize() };
                let met = canvas.frame.meet(&ray).expect("seen");
                assert!(met.distance(DVec2::new(0.7, 1.3)) < 1e-9, "{kind:?}: {met}");
                let axes = rotation_from_deg(canvas.rotation_deg());
                assert!(axes.z_axis.distance(-canvas.lit()) < 1e-8, "{kind:?} {flip}: shines along −Z");
                let placed = axes * canvas.local(DVec2::new(0.7, 1.3)).extend(0.0);
                assert!(placed.distance(p - canvas.frame.origin) < 1e-8, "{kind:?} {flip}: {placed}");
            }
        }
    }

    #[test]
    fn lights_shine_down_and_from_upright_planes_at_what_is_looked_at() {
        let camera = camera([0.0, -6.0, 2.0], [0.0, 0.0, 1.0]);
        let lit = |kind: PlaneKind, y: f64| {
            let mut plane = WorkPlane { y, ..WorkPlane::default() };
            plane.choose(kind, &camera);
            plane.canvas(&camera).expect("a plane").lit()
        };
        assert_eq!(lit(PlaneKind::Level, 0.0), DVec3::NEG_Z, "level");
        assert_eq!(lit(PlaneKind::Front, 2.0), DVec3::NEG_Y, "behind the subject, at it");
        assert_eq!(lit(PlaneKind::Front, -2.0), DVec3::Y, "before the subject, at it");
        assert_eq!(lit(PlaneKind::Front, 0.0), DVec3::NEG_Y, "through the subject, at the eye");
        assert!(lit(PlaneKind::Facing, 0.0).distance(DVec3::NEG_Y) < 1e-12, "facing the view, at the eye");
    }

    #[test]
    fn a_facing_plane_goes_through_what_is_looked_at_in_short_numbers() {
        let mut plane = WorkPlane::default();
        plane.choose(PlaneKind::Facing, &camera([4.0, 4.01, 2.0], [1.0, 1.0, 0.5]));
        assert_eq!((plane.azimuth_deg, plane.offset), (45.0, 1.41), "whole degrees, centimetres");
        plane.choose(PlaneKind::Facing, &camera([1.0, 1.0, 9.0], [1.0, 1.0, 0.5]));
        assert_eq!(plane.azimuth_deg, 45.0, "looking straight down turns it no further");
    }

    #[test]
    fn on_a_wall_v_runs_up_and_the_grid_does_not_depend_on_where_it_was_met() {
        let wall = Surface {
            name: "wall".to_owned(),
            material: String::new(),
            position: DVec3::new(0.0, 0.0, 1.0),
            rotation_deg: DVec3::ZERO,
            scale: DVec3::ONE,
            shape: Shape::Box { size: DVec3::splat(2.0) },
        };
        for (n, seen_along) in [(DVec3::X, DVec3::NEG_X), (DVec3::NEG_Y, DVec3::Y), (DVec3::NEG_X, DVec3::X)] {
            let ray = Ray { origin: -5.0 * seen_along, direction: seen_along };
            let tangent = |p: DVec3| Frame::tangent(&wall, &Hit { t: 1.0, p, n }, &ray);
            let frame = tangent(DVec3::Z + n);
            assert_eq!(frame, tangent(DVec3::Z + n + 0.3 * frame.u + 0.2 * frame.v), "{n}");
            assert!(frame.v.distance(DVec3::Z) < 1e-12 && frame.normal().distance(n) < 1e-12, "{n}: {frame:?}");
        }
    }

    #[test]
    fn snapped_values_are_the_decimals_one_would_type() {
        assert_eq!(snapped_to(0.31, 0.1), 0.3, "tenths");
        assert_eq!(snapped_to(-1.26, 0.25), -1.25, "quarters");
        assert_eq!(snapped_to(7.2, 3.0), 6.0, "whole metres");
        assert_eq!(snapped_to(7.2, 0.0), 7.2, "no grid");
    }
}
