//! Surfaces and their materials for Mitsuba.

use glam::{DAffine3, DMat4, DVec3};

use super::{Writer, rgb};
use crate::export::facets::{PLANE_REACH, even_scale, facets};
use crate::export::gloss::{gloss, gloss_remark};
use crate::export::job::number;
use crate::export::{Fate, Remark};
use crate::surface::{Material, Placed, Primitive, Shape, Surface};

impl Writer<'_> {
    /// A material, under the name that the scene gives it.
    pub(super) fn material(&mut self, material: &Material) {
        self.xml.open("bsdf", &[("type", "twosided"), ("id", &id(&material.name))]);
        let Blend { share, diffuse, specular, alpha, .. } = Blend::of(material);
        if share > 0.0 {
            self.xml.open("bsdf", &[("type", "blendbsdf")]);
            self.xml.value("float", "weight", &number(share));
            self.diffuse(diffuse);
            self.xml.open("bsdf", &[("type", "roughconductor")]);
            self.xml.value("string", "material", "none");
            self.xml.value("string", "distribution", "beckmann");
            self.xml.value("float", "alpha", &number(alpha));
            self.xml.value("rgb", "specular_reflectance", &rgb(specular));
            self.xml.close();
            self.xml.close();
        } else {
            self.diffuse(diffuse);
        }
        self.xml.close();
    }

    fn diffuse(&mut self, reflectance: DVec3) {
        self.xml.open("bsdf", &[("type", "diffuse")]);
        self.xml.value("rgb", "reflectance", &rgb(reflectance));
        self.xml.close();
    }

    /// A surface: shapes of Mitsuba's where it has them, a mesh beside the file elsewhere.
    pub(super) fn surface(&mut self, surface: &Surface, material: &Material) {
        self.xml.note(&format!("surface: {}", surface.name));
        let mut changes = Vec::new();
        if matches!(surface.shape, Shape::Plane {}) {
            changes.push(format!("a square of {} m stands for the infinite plane", 2.0 * PLANE_REACH));
        }
        let parts = Placed::parts(surface);
        let others: Vec<_> = parts.iter().filter(|part| !self.part(part, &material.name)).collect();
        let mesh: Vec<_> = others.into_iter().flat_map(facets).collect();
        if !mesh.is_empty() {
            let file = self.mesh_file(&surface.name, &mesh);
            let has_normals = mesh.iter().all(|triangle| triangle.normals.is_some());
            self.mesh(&file, has_normals, |writer| writer.xml.element("ref", &[("id", &id(&material.name))]));
            if !matches!(surface.shape, Shape::Mesh(_) | Shape::Tetrahedron { .. }) {
                changes.push(format!("{} triangles in {file} stand for it", mesh.len()));
            }
        }
        changes.extend(gloss_remark(material));
        changes.extend(Blend::of(material).remark());
        self.remarks.push(if changes.is_empty() {
            Remark::surface(surface, Fate::Kept, "as it is")
        } else {
            Remark::surface(surface, Fate::Changed, changes.join("; "))
        });
    }

    /// Whether a part has been written as a shape of Mitsuba's.
    fn part(&mut self, part: &Placed, material: &str) -> bool {
        let world = part.world_from_local();
        let scaled = |scale: DVec3| DMat4::from(*world * DAffine3::from_scale(scale));
        match (part.primitive(), even_scale(part)) {
            (Primitive::Plane, _) => self.stretched("rectangle", scaled(DVec3::splat(PLANE_REACH)), material),
            (Primitive::Square { size }, _) => self.stretched("rectangle", scaled((0.5 * *size).extend(1.0)), material),
            (Primitive::Box { size }, _) => self.stretched("cube", scaled(0.5 * *size), material),
            (Primitive::Disk { radius }, Some(_)) => self.stretched("disk", scaled(DVec3::splat(*radius)), material),
            (Primitive::Sphere { radius }, Some(scale)) => {
                self.shape("sphere", material, |writer| writer.ball(world.translation, scale * radius));
            }
            (Primitive::Cylinder { radius, height }, Some(scale)) => {
                let [low, high] = [-0.5, 0.5].map(|end| world.transform_point3(end * height * DVec3::Z));
                self.shape("cylinder", material, |writer| writer.cylinder(low, high, scale * radius));
                for end in [-0.5, 0.5] {
                    let cap = DAffine3::from_translation(end * height * DVec3::Z)
                        * DAffine3::from_scale(DVec3::splat(*radius));
                    self.stretched("disk", DMat4::from(*world * cap), material);
                }
            }
            _ => return false,
        }
        true
    }

    fn stretched(&mut self, kind: &str, world_from_shape: DMat4, material: &str) {
        self.shape(kind, material, |writer| writer.transform(&world_from_shape));
    }

    fn shape(&mut self, kind: &str, material: &str, inner: impl FnOnce(&mut Self)) {
        self.xml.open("shape", &[("type", kind)]);
        inner(self);
        self.xml.element("ref", &[("id", &id(material))]);
        self.xml.close();
    }
}

/// The name of a material in the file.
fn id(material: &str) -> String {
    format!("material {material}")
}

/// A material as a share of microfacets and a share of diffuse reflection.
struct Blend {
    share: f64,
    diffuse: DVec3,
    specular: DVec3,
    alpha: f64,
    /// What everything was multiplied by, so that no channel reflects more than it gets.
    dimming: f64,
}

impl Blend {
    fn of(material: &Material) -> Self {
        let gloss = gloss(material);
        let specular = gloss.map_or(DVec3::ZERO, |gloss| gloss.reflectance);
        let [most_specular, most_diffuse] = [specular.max_element(), material.diffuse.max_element()];
        let sum = most_specular + most_diffuse;
        let dimming = sum.max(1.0).recip();
        let share = if sum > 0.0 { most_specular / sum } else { 0.0 };
        let part = |color: DVec3, share: f64| {
            if share > 0.0 { (dimming / share * color).min(DVec3::ONE) } else { DVec3::ZERO }
        };
        Self {
            share,
            diffuse: part(material.diffuse, 1.0 - share),
            specular: part(specular, share),
            alpha: gloss.map_or(1.0, |gloss| gloss.alpha),
            dimming,
        }
    }

    fn remark(&self) -> Option<String> {
        (self.dimming < 1.0).then(|| {
            format!("reflects more than it gets: dimmed to {:.3}, lower its diffuse or specular", self.dimming)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::ReflectionModel;

    #[track_caller]
    fn check(diffuse: DVec3, specular: DVec3, dimming: f64) {
        let model = ReflectionModel::default();
        let material = Material { name: "m".to_owned(), diffuse, specular, model, exponent: 32.0 };
        let blend = Blend::of(&material);
        let sum = [(1.0 - blend.share) * blend.diffuse, blend.share * blend.specular];
        for (found, expected) in sum.into_iter().zip([diffuse, specular]) {
            assert!((found - dimming * expected).abs().max_element() < 1e-15, "{found} of {expected}");
        }
        assert!(blend.diffuse.max(blend.specular).max_element() <= 1.0, "no channel reflects more than it gets");
        assert_eq!(blend.remark().is_some(), dimming < 1.0, "says so where it is dimmed");
    }

    #[test]
    fn a_blend_reflects_what_the_material_does() {
        check(DVec3::new(0.5, 0.4, 0.3), DVec3::new(0.2, 0.1, 0.3), 1.0);
        check(DVec3::new(0.5, 0.4, 0.3), DVec3::ZERO, 1.0);
        check(DVec3::ZERO, DVec3::splat(0.9), 1.0);
        check(DVec3::ZERO, DVec3::ZERO, 1.0);
        check(DVec3::splat(0.8), DVec3::splat(0.8), 0.625);
    }
}
