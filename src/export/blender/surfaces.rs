//! Surfaces and their materials for Blender.

use std::fmt::Write as _;

use glam::DVec3;

use super::{Writer, frame, text, tuple};
use crate::export::facets::{PLANE_REACH, facets};
use crate::export::gloss::{gloss, gloss_remark};
use crate::export::job::number;
use crate::export::{Fate, Remark};
use crate::scene::Scene;
use crate::surface::{Placed, Primitive, Shape, Surface, Triangle};

impl Writer<'_> {
    /// The surfaces, and the materials that they use.
    pub(super) fn surfaces(&mut self, scene: &Scene) {
        for material in &scene.materials {
            let surfaces: Vec<_> = scene.surfaces.iter().filter(|surface| surface.material == material.name).collect();
            if surfaces.is_empty() {
                continue;
            }
            let (alpha, specular) =
                gloss(material).map_or((1.0, DVec3::ZERO), |gloss| (gloss.alpha, gloss.reflectance));
            self.call("material", &[text(&material.name), tuple(material.diffuse), tuple(specular), number(alpha)]);
            for surface in surfaces {
                let mut changes: Vec<_> = self.surface(surface).into_iter().collect();
                changes.extend(gloss_remark(material));
                self.remarks.push(if changes.is_empty() {
                    Remark::surface(surface, Fate::Kept, "as it is")
                } else {
                    Remark::surface(surface, Fate::Changed, changes.join("; "))
                });
            }
        }
    }

    /// Writes a surface; what is not as it was.
    fn surface(&mut self, surface: &Surface) -> Option<String> {
        let parts = Placed::parts(surface);
        let mut triangles: Vec<Triangle> = Vec::new();
        for part in &parts {
            match part.primitive() {
                Primitive::Square { size } => self.flat(surface, part, 0.5 * size.x, 0.5 * size.y),
                Primitive::Plane => self.flat(surface, part, PLANE_REACH, PLANE_REACH),
                Primitive::Sphere { radius } => {
                    let mesh = format!("ball({}, {})", text(&surface.name), number(*radius));
                    let world = part.world_from_local();
                    self.put(surface, &mesh, &frame(world.matrix3, world.translation));
                }
                _ => triangles.extend(facets(part)),
            }
        }
        if !triangles.is_empty() {
            self.triangles(surface, &triangles);
        }
        match surface.shape {
            Shape::Plane {} => Some(format!("a square of {} m stands for the infinite plane", 2.0 * PLANE_REACH)),
            Shape::Sphere { .. } | Shape::Sphereflake { .. } => Some("64 by 32 smooth faces a ball".to_owned()),
            Shape::Square { .. } | Shape::Box { .. } | Shape::Mesh(_) | Shape::Tetrahedron { .. } => None,
            _ => Some(format!("{} triangles stand for it", triangles.len())),
        }
    }

    fn flat(&mut self, surface: &Surface, part: &Placed, x: f64, y: f64) {
        let mesh = format!("rectangle({}, ({}, {}))", text(&surface.name), number(2.0 * x), number(2.0 * y));
        let world = part.world_from_local();
        self.put(surface, &mesh, &frame(world.matrix3, world.translation));
    }

    /// A mesh in the world, smooth where all triangles have normals.
    fn triangles(&mut self, surface: &Surface, triangles: &[Triangle]) {
        let mut points = String::new();
        let mut normals = String::new();
        for triangle in triangles {
            for (i, corner) in triangle.corners.iter().enumerate() {
                let _ = write!(points, "{},", tuple(*corner));
                if let Some(corners) = triangle.normals {
                    let _ = write!(normals, "{},", tuple(corners[i]));
                }
            }
        }
        let is_smooth = triangles.iter().all(|triangle| triangle.normals.is_some());
        let normals = if is_smooth { format!("[{normals}]") } else { "None".to_owned() };
        let faces = format!("[(i, i + 1, i + 2) for i in range(0, {}, 3)]", 3 * triangles.len());
        let mesh = format!("polygons({}, [{points}], {faces}, {normals})", text(&surface.name));
        let identity = frame(glam::DMat3::IDENTITY, DVec3::ZERO);
        self.put(surface, &mesh, &identity);
    }

    fn put(&mut self, surface: &Surface, mesh: &str, matrix: &str) {
        self.call("surface", &[text(&surface.name), mesh.to_owned(), text(&surface.material), matrix.to_owned()]);
    }
}
