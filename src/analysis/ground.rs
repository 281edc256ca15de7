//! Points on the ground of a scene, at which methods are compared.

use std::fmt;

use glam::{DVec2, DVec3};

use crate::light::Light;
use crate::render::{Geometry, Thing};
use crate::scene::Scene;
use crate::shading::ShadingPoint;
use crate::surface::{Material, Shape, Surface};

/// Shape of the picture through which the camera looks.
const ASPECT: DVec2 = DVec2::new(16.0, 9.0);

/// How many points of the picture are tried for one that is wanted.
const TRIES: usize = 8;

/// The least share of the wanted points that makes a ground seen.
const SEEN: f64 = 0.125;

/// How far beyond the light farthest out the neighbourhood reaches, as a multiple of that light's height.
const REACH: f64 = 2.0;

/// Points on the ground, and what was taken for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground {
    /// The points, each with its normal and direction to the eye.
    pub points: Vec<ShadingPoint>,
    /// Their material.
    pub material: Material,
    /// Name of the plane; none for z = 0, which stands in where a scene has no plane.
    pub plane: Option<String>,
    /// Which part of the plane the points cover.
    pub extent: Extent,
}

/// A part of a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// What the camera sees of it in a picture of 16:9, with points spread evenly over the picture.
    Seen,
    /// A square about the lights, where the camera sees too little, with points spread evenly over it.
    Square {
        /// The middle.
        center: DVec3,
        /// Half a side in metres.
        half: f64,
    },
}

impl Ground {
    /// About `count` points on the first plane of a scene, or on z = 0; none where the scene has no material.
    ///
    /// The points are a deterministic low-discrepancy set: the same scene always has the same.
    pub fn new(scene: &Scene, count: usize) -> Option<Self> {
        let found = scene.surfaces.iter().position(|surface| matches!(surface.shape, Shape::Plane {}));
        let mut with_ground = scene.clone();
        let index = found.unwrap_or(scene.surfaces.len());
        if found.is_none() {
            with_ground.surfaces.push(level_ground(scene)?);
        }
        let surface = &with_ground.surfaces[index];
        let seen = seen(&with_ground, index, count);
        let (extent, points) = if seen.len() as f64 >= SEEN * count as f64 {
            (Extent::Seen, seen)
        } else {
            near_lights(scene, surface, count)
        };
        Some(Self {
            points,
            material: scene.material(&surface.material)?.clone(),
            plane: found.map(|_| surface.name.clone()),
            extent,
        })
    }
}

impl fmt::Display for Ground {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.plane {
            Some(name) => write!(f, "plane `{name}`, ")?,
            None => f.write_str("z = 0, as the scene has no plane, ")?,
        }
        match self.extent {
            Extent::Seen => f.write_str("what the camera sees of it")?,
            Extent::Square { center, half } => write!(
                f,
                "{0} m x {0} m about ({1}, {2}, {3}), as the camera sees too little of it",
                rounded(2.0 * half),
                rounded(center.x),
                rounded(center.y),
                rounded(center.z)
            )?,
        }
        write!(f, "; {} points", self.points.len())
    }
}

/// To millimetres.
fn rounded(length: f64) -> f64 {
    (1e3 * length).round() / 1e3
}

/// The plane z = 0 of the scene's first material.
fn level_ground(scene: &Scene) -> Option<Surface> {
    Some(Surface {
        name: String::new(),
        material: scene.materials.first()?.name.clone(),
        position: DVec3::ZERO,
        rotation_deg: DVec3::ZERO,
        scale: DVec3::ONE,
        shape: Shape::Plane {},
    })
}

/// The points of a surface that the camera sees, at most `count`.
fn seen(scene: &Scene, surface: usize, count: usize) -> Vec<ShadingPoint> {
    let geometry = Geometry::new(scene);
    let camera = scene.camera;
    let meets = |share: DVec2| {
        let at = share * ASPECT;
        let direction = camera.ray_direction(at.x, at.y, ASPECT.x, ASPECT.y);
        let seen = geometry.nearest(camera.eye, direction)?;
        (seen.thing == Thing::Surface(surface)).then(|| seen.shading_point(direction))
    };
    spread().take(TRIES * count).filter_map(meets).take(count).collect()
}

/// Points of the square about the feet of the lights that shine, seen by the camera, or, where it is beneath, from
/// above.
fn near_lights(scene: &Scene, surface: &Surface, count: usize) -> (Extent, Vec<ShadingPoint>) {
    let placed = surface.world_from_surface();
    let n = placed.matrix3.z_axis.normalize_or(DVec3::Z);
    let height = |p: DVec3| (p - placed.translation).dot(n);
    let lights: Vec<&Light> = scene.lights.iter().filter(|light| !light.muted).collect();
    let foot = |light: &Light| light.position - height(light.position) * n;
    let center = lights.iter().map(|light| foot(light)).sum::<DVec3>() / (lights.len().max(1) as f64);
    let reach = |light: &&Light| foot(light).distance(center) + REACH * height(light.position).abs();
    let half = lights.iter().map(reach).fold(1.0, f64::max);
    let (x, y) = n.any_orthonormal_pair();
    let eye = scene.camera.eye;
    let points = spread().take(count).map(|share| {
        let [u, v] = (half * (2.0 * share - 1.0)).to_array();
        let p = center + u * x + v * y;
        let v = if height(eye) > 0.0 { (eye - p).normalize_or(n) } else { n };
        ShadingPoint { p, n, v }
    });
    (Extent::Square { center, half }, points.collect())
}

/// Points spread evenly over the unit square, however many of them are taken.
///
/// **Source:** M. Roberts, *The Unreasonable Effectiveness of Quasirandom Sequences*, 2018: multiples of (1/g, 1/g²)
/// modulo 1, with g³ = g + 1.
fn spread() -> impl Iterator<Item = DVec2> {
    const STEP: DVec2 = DVec2::new(0.754_877_666_246_692_8, 0.569_840_290_998_053_3);
    (0_u32..).map(|i| (DVec2::splat(0.5) + f64::from(i) * STEP).fract())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lie_on_the_plane_that_the_camera_sees() {
        let scene = crate::scene::first_light();
        let ground = Ground::new(&scene, 200).unwrap();
        assert_eq!((ground.plane.as_deref(), ground.extent, ground.points.len()), (Some("floor"), Extent::Seen, 200));
        for at in &ground.points {
            assert!(at.p.z.abs() < 1e-9 && at.n == DVec3::Z, "{at:?}");
            let to_eye = (scene.camera.eye - at.p).normalize();
            assert!((at.v - to_eye).length() < 1e-9, "{at:?} is seen from {to_eye}");
        }
    }

    #[test]
    fn a_scene_without_a_plane_has_z_0_for_a_ground() {
        let mut scene = crate::scene::first_light();
        scene.surfaces.retain(|surface| !matches!(surface.shape, Shape::Plane {}));
        let ground = Ground::new(&scene, 100).unwrap();
        assert!(ground.plane.is_none() && ground.extent == Extent::Seen, "{ground}");
        assert!(ground.points.iter().all(|at| at.p.z.abs() < 1e-9), "{ground}");
        scene.materials.clear();
        scene.surfaces.clear();
        assert_eq!(Ground::new(&scene, 100), None, "nothing to shade");
    }

    #[test]
    fn a_ground_that_the_camera_misses_is_taken_about_the_lights() {
        let mut scene = crate::scene::first_light();
        scene.camera.target = scene.camera.eye + DVec3::Z;
        let ground = Ground::new(&scene, 100).unwrap();
        let Extent::Square { center, half } = ground.extent else { panic!("{ground}") };
        let light = &scene.lights[0];
        assert!((half - 2.0 * light.position.z).abs() < 1e-12 && center.z == 0.0, "{ground} under {light:?}");
        let inside = |at: &ShadingPoint| (at.p - center).abs().max_element() <= half && at.p.z == 0.0;
        assert!(ground.points.iter().all(inside), "{ground}");
        let [left, right] =
            [-1.0, 1.0].map(|side| ground.points.iter().filter(|at| (at.p - center).x * side > 0.0).count());
        assert!(left.abs_diff(right) <= 4, "{left} and {right} points a side");
    }
}
