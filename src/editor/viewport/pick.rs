//! What lies under the pointer.

use egui::Pos2;
use glam::{DAffine3, DVec2, DVec3};

use super::projection::Projection;
use super::ray::Ray;
use super::symbol::Symbol;
use crate::editor::handles::segment_distance;
use crate::editor::session::Item;
use crate::light::{Emitter, Light};
pub use crate::render::bounds::outline;
use crate::scene::Scene;
use crate::surface::{Bounds, Hit, Surface};
use crate::visibility::{Objects, Structure};

/// An outline or a symbol is meant within this distance on screen, points.
const REACH: f32 = 6.0;
/// A light's symbol is this large on screen, points.
pub const SYMBOL: f32 = 12.0;

/// The surfaces of a scene, prepared for rays; rebuilt only when they change.
#[derive(Debug)]
pub struct Solids {
    source: Vec<Surface>,
    objects: Objects,
    /// The box about each surface; none of an infinite plane.
    bounds: Vec<Option<Bounds>>,
}

impl Default for Solids {
    fn default() -> Self {
        Self { source: Vec::new(), objects: Objects::new(&[], Structure::default()), bounds: Vec::new() }
    }
}

impl Solids {
    /// Follow the document.
    pub fn update(&mut self, surfaces: &[Surface]) {
        if self.source != surfaces {
            self.source = surfaces.to_vec();
            self.objects = Objects::new(surfaces, Structure::default());
            self.bounds = vec![Some(Bounds::EMPTY); surfaces.len()];
            for (i, part) in self.objects.parts().iter().enumerate() {
                let bounds = &mut self.bounds[self.objects.surface_of(i)];
                *bounds = bounds.and_then(|bounds| Some(bounds.union(part.bounds()?)));
            }
        }
    }

    /// The surfaces as they were given.
    pub fn source(&self) -> &[Surface] {
        &self.source
    }

    /// The first surface that a ray meets.
    pub fn nearest(&self, ray: &Ray) -> Option<(usize, Hit)> {
        let (object, hit) = self.objects.nearest(ray.origin, ray.direction)?;
        Some((self.objects.surface_of(object), hit))
    }

    /// Whether some surface stands between the eye and `p`.
    pub fn hide(&self, eye: DVec3, p: DVec3) -> bool {
        // What `p` itself lies on does not hide it.
        self.objects.hides(eye, (1.0 - 1e-3) * (p - eye))
    }

    /// The corners of the box about a surface, counted in binary; none of an infinite plane.
    pub fn corners(&self, index: usize) -> Vec<DVec3> {
        let bounds = self.bounds.get(index).copied().flatten().filter(|bounds| bounds.min.is_finite());
        let Some(bounds) = bounds else { return Vec::new() };
        let pick = |corner: i32, bit: i32, axis: usize| {
            if corner & bit == 0 { bounds.min[axis] } else { bounds.max[axis] }
        };
        (0..8).map(|corner| DVec3::new(pick(corner, 1, 0), pick(corner, 2, 1), pick(corner, 4, 2))).collect()
    }
}

/// What is under `pos`: a light by its outline or symbol, else the nearest of lights' faces and surfaces.
pub fn pick(scene: &Scene, solids: &Solids, projection: &Projection, pos: Pos2) -> Option<Item> {
    if projection.is_empty() {
        return None;
    }
    let outlined = scene.lights.iter().enumerate().filter_map(|(i, light)| {
        let distance = outline_distance(light, projection, pos);
        (distance <= REACH).then_some((Item::Light(i), distance))
    });
    if let Some((item, _)) = outlined.min_by(|(_, a), (_, b)| a.total_cmp(b)) {
        return Some(item);
    }
    let ray = projection.ray(pos);
    let lights = scene.lights.iter().enumerate();
    let faces = lights.filter_map(|(i, light)| Some((Item::Light(i), face_distance(light, &ray)?)));
    let surface = solids.nearest(&ray).map(|(i, hit)| (Item::Surface(i), hit.t));
    faces.chain(surface).min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(item, _)| item)
}

/// Distance on screen from `pos` to a light's outline or symbol.
fn outline_distance(light: &Light, projection: &Projection, pos: Pos2) -> f32 {
    let segment = |a, b| projection.segment(a, b).map_or(f32::MAX, |segment| segment_distance(segment, pos));
    match light.emitter() {
        Emitter::Polygon(_) | Emitter::Disk(_) | Emitter::Textured(_) => {
            let outline = outline(light).unwrap_or_default();
            closed(&outline).map(|[a, b]| segment(a, b)).fold(f32::MAX, f32::min)
        }
        Emitter::Line(line) => segment(line.a, line.b),
        Emitter::Sphere(sphere) => {
            // However small it is on screen, a sphere can be clicked.
            projection.project(sphere.center).map_or(f32::MAX, |at| at.distance(pos))
        }
        Emitter::Cap(_) | Emitter::Sky(_) => {
            let symbol = Symbol::new(light, projection);
            let lines = symbol.lines(&light.shape).into_iter().map(|[a, b]| segment(a, b));
            lines.fold(symbol_distance(symbol.tip(), projection, pos), f32::min)
        }
        Emitter::Point(_) | Emitter::Directional(_) => symbol_distance(light.position, projection, pos),
    }
}

/// Distance on screen from `pos` to a small sun at `p`.
fn symbol_distance(p: DVec3, projection: &Projection, pos: Pos2) -> f32 {
    projection.project(p).map_or(f32::MAX, |at| (at.distance(pos) - SYMBOL).max(0.0))
}

/// Distance along the ray to a light's face.
fn face_distance(light: &Light, ray: &Ray) -> Option<f64> {
    match light.emitter() {
        Emitter::Polygon(_) | Emitter::Disk(_) | Emitter::Textured(_) => {
            polygon_distance(&outline(light)?, &light.world_from_light(), ray)
        }
        Emitter::Sphere(sphere) => ray.sphere_distance(sphere.center, sphere.radius),
        Emitter::Line(_) | Emitter::Cap(_) | Emitter::Sky(_) | Emitter::Point(_) | Emitter::Directional(_) => None,
    }
}

fn polygon_distance(outline: &[DVec3], world_from_light: &DAffine3, ray: &Ray) -> Option<f64> {
    let t = ray.plane_distance(*outline.first()?, world_from_light.matrix3.z_axis)?;
    let light_from_world = world_from_light.inverse();
    let local = |p: DVec3| light_from_world.transform_point3(p).truncate();
    let p = local(ray.at(t));
    let mut inside = false;
    for [a, b] in closed(outline) {
        let (a, b): (DVec2, DVec2) = (local(a), local(b));
        if (a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x {
            inside = !inside;
        }
    }
    inside.then_some(t)
}

/// The edges of a closed polygon.
pub fn closed(vertices: &[DVec3]) -> impl Iterator<Item = [DVec3; 2]> {
    vertices.iter().zip(vertices.iter().cycle().skip(1)).map(|(a, b)| [*a, *b])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::tools::new_light;
    use crate::scene::Camera;
    use crate::surface::Shape;
    use egui::{Rect, pos2};
    use glam::dvec2;

    fn ball(position: DVec3) -> Surface {
        Surface {
            name: "ball".to_owned(),
            material: "m".to_owned(),
            position,
            rotation_deg: DVec3::ZERO,
            scale: DVec3::ONE,
            shape: Shape::Sphere { radius: 0.5 },
        }
    }

    fn scene() -> Scene {
        let corners = [dvec2(-1.0, -1.0), dvec2(1.0, -1.0), dvec2(1.0, 1.0), dvec2(-1.0, 1.0)];
        let line = new_light::line([dvec2(-1.0, 2.0), dvec2(1.0, 2.0)], 1.0);
        let mut lights = vec![new_light::polygon(&corners, 2.0)];
        lights.extend(line);
        lights.extend(new_light::sphere(dvec2(2.0, 0.0), 0.5, 0.3));
        Scene { lights, surfaces: vec![ball(DVec3::new(0.0, 0.0, 0.5))], ..Scene::default() }
    }

    fn picked(eye: DVec3, at: DVec3) -> Option<Item> {
        let scene = scene();
        let camera = Camera { eye, target: DVec3::new(0.0, 0.0, 1.0), fov_deg: 50.0 };
        let projection = Projection::new(&camera, Rect::from_min_max(pos2(0.0, 0.0), pos2(800.0, 600.0)));
        let mut solids = Solids::default();
        solids.update(&scene.surfaces);
        pick(&scene, &solids, &projection, projection.project(at).expect("in sight"))
    }

    const FRONT: DVec3 = DVec3::new(0.5, -7.0, 3.0);

    #[test]
    fn each_thing_is_found_where_it_is_seen() {
        for (at, item, what) in [
            (DVec3::new(0.3, 0.4, 2.0), Some(Item::Light(0)), "the polygon's face"),
            (DVec3::new(1.0, 0.1, 2.0), Some(Item::Light(0)), "its edge"),
            (DVec3::new(0.6, 2.0, 1.0), Some(Item::Light(1)), "the line"),
            (DVec3::new(2.1, 0.0, 0.6), Some(Item::Light(2)), "the sphere"),
            (DVec3::new(0.1, -0.3, 0.6), Some(Item::Surface(0)), "the ball"),
            (DVec3::new(-3.0, 0.0, 0.0), None, "nothing"),
        ] {
            assert_eq!(picked(FRONT, at), item, "{what}");
        }
    }

    #[test]
    fn what_is_nearer_wins() {
        let above = DVec3::new(0.1, -0.1, 8.0);
        assert_eq!(picked(above, DVec3::new(0.2, 0.1, 0.5)), Some(Item::Light(0)), "the light hides the ball");
    }

    #[test]
    fn a_surface_hides_what_is_behind_it_and_not_itself() {
        let mut solids = Solids::default();
        solids.update(&[ball(DVec3::ZERO)]);
        let eye = DVec3::new(0.0, -5.0, 0.0);
        assert!(solids.hide(eye, DVec3::new(0.0, 2.0, 0.0)), "behind");
        assert!(!solids.hide(eye, DVec3::new(0.0, -0.5, 0.0)), "its own front");
        assert!(!solids.hide(eye, DVec3::new(1.0, 2.0, 0.0)), "beside");
    }
}
