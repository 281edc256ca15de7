//! Surfaces and their materials for Radiance.

use std::fmt::Write as _;

use glam::DVec3;

use super::{Writer, xyz};
use crate::export::facets::{PLANE_REACH, box_faces, even_scale, facets};
use crate::export::job::{number, one_line};
use crate::export::{Fate, Remark};
use crate::scene::Scene;
use crate::surface::{Material, Placed, Primitive, ReflectionModel, Shape, Surface};

impl Writer<'_> {
    /// The surfaces, and the materials that they use.
    pub(super) fn surfaces(&mut self, scene: &Scene) {
        for material in &scene.materials {
            if !scene.surfaces.iter().any(|surface| surface.material == material.name) {
                continue;
            }
            let _ = writeln!(self.text, "\n# material: {}", one_line(&material.name));
            let name = self.names.of(&format!("{}_material", material.name));
            self.material(&name, material);
            for surface in scene.surfaces.iter().filter(|surface| surface.material == material.name) {
                self.surface(&name, surface, material);
            }
        }
    }

    /// Lambert's reflection, and the model's own lobe as a function for what the direct calculation aims at.
    fn material(&mut self, name: &str, material: &Material) {
        let diffuse = material.diffuse;
        if material.specular == DVec3::ZERO {
            self.primitive("void", "plastic", name, &[], &format!("{} 0 0", xyz(diffuse)));
            return;
        }
        let (lobe, arguments) = match material.model {
            ReflectionModel::Phong {} => ("phong", vec![material.exponent]),
            ReflectionModel::Blinn {} => ("blinn", vec![material.exponent]),
            ReflectionModel::CookTorrance { roughness, reflectance } => ("cook_torrance", vec![roughness, reflectance]),
            ReflectionModel::Lafortune { tangential, normal } => {
                ("lafortune", vec![material.exponent, tangential, normal])
            }
        };
        let channels = ["r", "g", "b"].map(|channel| format!("{lobe}_{channel}"));
        let functions = self.functions.clone();
        let words: Vec<_> =
            ["0"; 6].into_iter().chain(channels.iter().map(String::as_str)).chain([functions.as_str()]).collect();
        let own: Vec<_> = arguments.into_iter().map(number).collect();
        let numbers = format!("{0} {0} 0 0 0 {1} {2}", xyz(diffuse), xyz(material.specular), own.join(" "));
        self.primitive("void", "BRTDfunc", name, &words, &numbers);
    }

    fn surface(&mut self, material_name: &str, surface: &Surface, material: &Material) {
        let _ = writeln!(self.text, "# surface: {}", one_line(&surface.name));
        let name = self.names.of(&surface.name);
        let mut changes = Vec::new();
        let mut triangles = 0;
        for part in Placed::parts(surface) {
            if !self.part(&part, material_name, &name) {
                let facets = facets(&part);
                triangles += facets.len();
                facets.iter().for_each(|facet| self.face(material_name, &name, &facet.corners));
            }
        }
        match &surface.shape {
            Shape::Plane {} => {
                changes.push(format!("a square of {} m stands for the infinite plane", 2.0 * PLANE_REACH))
            }
            Shape::Mesh(mesh) if mesh.triangles.iter().all(|triangle| triangle.normals.is_none()) => {}
            Shape::Mesh(_) => changes.push("its triangles look flat".to_owned()),
            Shape::Tetrahedron { .. } => {}
            _ if triangles > 0 => changes.push(format!("{triangles} flat triangles stand for it")),
            _ => {}
        }
        if material.specular != DVec3::ZERO {
            changes.push(format!("its {} highlight is of lights only, not of what glows", material.model.name()));
        }
        self.remarks.push(if changes.is_empty() {
            Remark::surface(surface, Fate::Kept, "as it is")
        } else {
            Remark::surface(surface, Fate::Changed, changes.join("; "))
        });
    }

    /// Whether a part has been written as a shape of Radiance's.
    fn part(&mut self, part: &Placed, material: &str, name: &str) -> bool {
        let world = part.world_from_local();
        let at = |x: f64, y: f64, z: f64| world.transform_point3(DVec3::new(x, y, z));
        let up = world.matrix3.z_axis.normalize_or_zero();
        let square = |x: f64, y: f64| [at(-x, -y, 0.0), at(x, -y, 0.0), at(x, y, 0.0), at(-x, y, 0.0)];
        match (part.primitive(), even_scale(part)) {
            (Primitive::Plane, _) => self.face(material, name, &square(PLANE_REACH, PLANE_REACH)),
            (Primitive::Square { size }, _) => self.face(material, name, &square(0.5 * size.x, 0.5 * size.y)),
            (Primitive::Box { size }, _) => {
                for face in box_faces(0.5 * *size) {
                    self.face(material, name, &face.map(|corner| world.transform_point3(corner)));
                }
            }
            (Primitive::Disk { radius }, Some(scale)) => {
                self.ring(material, name, world.translation, up, scale * radius)
            }
            (Primitive::Sphere { radius }, Some(scale)) => {
                let shape = format!("{} {}", xyz(world.translation), number(scale * radius));
                self.primitive(material, "sphere", name, &[], &shape);
            }
            (Primitive::Cylinder { radius, height }, Some(scale)) => {
                let [low, high] = [-0.5, 0.5].map(|end| at(0.0, 0.0, end * height));
                let shape = format!("{} {} {}", xyz(low), xyz(high), number(scale * radius));
                self.primitive(material, "cylinder", name, &[], &shape);
                self.ring(material, name, low, -up, scale * radius);
                self.ring(material, name, high, up, scale * radius);
            }
            (Primitive::Cone { radius, height }, Some(scale)) => {
                let [base, apex] = [-0.5, 0.5].map(|end| at(0.0, 0.0, end * height));
                let shape = format!("{} {} {} 0", xyz(base), xyz(apex), number(scale * radius));
                self.primitive(material, "cone", name, &[], &shape);
                self.ring(material, name, base, -up, scale * radius);
            }
            _ => return false,
        }
        true
    }

    fn ring(&mut self, material: &str, name: &str, center: DVec3, normal: DVec3, radius: f64) {
        let shape = format!("{} {} 0 {}", xyz(center), xyz(normal), number(radius));
        self.primitive(material, "ring", name, &[], &shape);
    }
}
