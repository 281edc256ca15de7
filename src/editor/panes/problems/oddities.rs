//! What is allowed but likely not meant.

use std::path::Path;

use glam::{DVec3, Vec3Swizzles};

use super::{Row, Severity, exposure, place};
use crate::editor::session::Item;
use crate::editor::viewport::bounds::light_points;
use crate::light::{self, Emitter, Light};
use crate::scene::Scene;
use crate::surface::{Bounds, Material, ReflectionModel, Shape, Surface};

/// A plane is a ground where its normal is at most this far from upright, as a cosine.
const UPRIGHT: f64 = 0.7;
/// Distances below this are rounding, metres.
const SLACK: f64 = 1e-6;

/// All rules, over all things.
pub(super) fn oddities(scene: &Scene) -> Vec<Row> {
    let mut rows = Vec::new();
    let lit: Vec<_> = scene.lights.iter().enumerate().filter(|(_, light)| !light.muted).collect();
    for &(i, light) in &lit {
        let rules = [emits_nothing, below_ground, inside_solid, lights_nothing, faces_nothing];
        rows.extend(
            rules
                .into_iter()
                .find_map(|rule| rule(light, scene))
                .map(|(field, text)| Row::warning(Item::Light(i), field, text)),
        );
    }
    if lit.is_empty() && !scene.surfaces.is_empty() {
        let first = (!scene.lights.is_empty()).then_some(Item::Light(0));
        let text = if first.is_some() { "All lights are muted" } else { "There is no light: draw one by P, L or O" };
        rows.push(Row::warning(first, "Muted", text.to_owned()));
    }
    rows.extend(scene.materials.iter().enumerate().filter(|(_, material)| reflected(material) > 1.0 + SLACK).map(
        |(i, material)| {
            let text = format!("“{}” reflects more than it receives: k_d + k_s is above 1", material.name);
            Row::warning(Item::Material(i), "Diffuse k_d", text)
        },
    ));
    rows.extend(exposure::oddity(scene));
    rows
}

/// Files that the scene names and that are not where it will look for them.
pub(super) fn files(scene: &Scene, path: Option<&Path>) -> Vec<Row> {
    let patterns = scene.lights.iter().enumerate().filter_map(|(i, light)| match &light.shape {
        light::Shape::Textured(textured) => {
            let pattern = &textured.pattern;
            Some((Item::Light(i), "Pattern", pattern.file.as_str(), pattern.contents.0.is_empty()))
        }
        _ => None,
    });
    let meshes = scene.surfaces.iter().enumerate().filter_map(|(i, surface)| match &surface.shape {
        Shape::Mesh(mesh) => Some((Item::Surface(i), "Mesh", mesh.file.as_str(), mesh.contents.0.is_empty())),
        _ => None,
    });
    let folder = path.and_then(Path::parent);
    let missing = |file: &str| folder.is_some_and(|folder| !folder.join(file).is_file());
    let row = |(item, field, file, unread)| {
        let (severity, text) = match unread {
            true if folder.is_none() || missing(file) => {
                (Severity::Error, format!("`{file}` has not been read from a file: choose it again"))
            }
            false if missing(file) => {
                (Severity::Note, format!("`{file}` is not beside the scene’s file: saving puts it there"))
            }
            _ => return None,
        };
        Some(Row { severity, text, item: Some(item), field: Some(field) })
    };
    patterns.chain(meshes).filter_map(row).collect()
}

/// A rule about a light: the field that it is about, and what is to be said.
type Oddity = Option<(&'static str, String)>;

fn emits_nothing(light: &Light, _: &Scene) -> Oddity {
    let field = place::label(light.quantity.kind().key())?;
    (light.strength() <= 0.0).then(|| (field, format!("“{}” emits nothing", light.name)))
}

fn below_ground(light: &Light, scene: &Scene) -> Oddity {
    let points = placed_points(light)?;
    let is_below = |surface: &&Surface| {
        let world = surface.world_from_surface();
        let normal = world.matrix3.z_axis.normalize_or_zero();
        let height = |p: &DVec3| (*p - world.translation).dot(normal);
        matches!(surface.shape, Shape::Plane {}) && normal.z > UPRIGHT && points.iter().all(|p| height(p) < -SLACK)
    };
    let ground = scene.surfaces.iter().find(is_below)?;
    Some(("Position", format!("“{}” is below “{}”", light.name, ground.name)))
}

fn inside_solid(light: &Light, scene: &Scene) -> Oddity {
    let points = placed_points(light)?;
    let solid = scene.surfaces.iter().find(|surface| {
        let local = surface.world_from_surface().inverse();
        points.iter().all(|p| is_inside(&surface.shape, local.transform_point3(*p)))
    })?;
    Some(("Position", format!("“{}” is inside “{}”, which lets no light out", light.name, solid.name)))
}

/// Whether a point of a surface's own frame is inside it.
fn is_inside(shape: &Shape, p: DVec3) -> bool {
    let across = p.xy().length();
    match *shape {
        Shape::Sphere { radius } => p.length() < radius,
        Shape::Box { size } => p.abs().cmplt(0.5 * size).all(),
        Shape::Cylinder { radius, height } => across < radius && p.z.abs() < 0.5 * height,
        Shape::Cone { radius, height } => p.z > -0.5 * height && across < radius * (0.5 - p.z / height),
        _ => false,
    }
}

fn lights_nothing(light: &Light, scene: &Scene) -> Oddity {
    let only = light.only.as_ref()?;
    let any = scene.surfaces.iter().any(|surface| only.contains(&surface.name));
    (!any).then(|| ("Lights", format!("“{}” is linked to no surface", light.name)))
}

fn faces_nothing(light: &Light, scene: &Scene) -> Oddity {
    let normal = match light.emitter() {
        Emitter::Polygon(emitter) if !emitter.two_sided => emitter.normal,
        Emitter::Disk(emitter) if !emitter.two_sided => emitter.normal,
        Emitter::Textured(emitter) if !emitter.two_sided => emitter.normal,
        _ => return None,
    };
    let is_lit = |surface: &Surface| match corners(surface) {
        Some(corners) => corners.iter().any(|corner| (*corner - light.position).dot(normal) > SLACK),
        None => {
            let world = surface.world_from_surface();
            let parallel = world.matrix3.z_axis.normalize_or_zero().cross(normal).length() < SLACK;
            !parallel || (world.translation - light.position).dot(normal) > SLACK
        }
    };
    let nothing = !scene.surfaces.is_empty() && !scene.surfaces.iter().any(is_lit);
    nothing.then(|| ("Rotation", format!("The lit side of “{}” faces no surface", light.name)))
}

/// Corners of a box around a surface, in the world; none of a plane.
pub(super) fn corners(surface: &Surface) -> Option<[DVec3; 8]> {
    let Bounds { min, max } = match &surface.shape {
        Shape::Mesh(mesh) => {
            mesh.triangles.iter().fold(Bounds::EMPTY, |all, one| all.union(Bounds::about(&one.corners)))
        }
        shape => shape.bounds()?,
    };
    let world = surface.world_from_surface();
    let corner = |i: usize| {
        DVec3::new(
            if i & 1 == 0 { min.x } else { max.x },
            if i & 2 == 0 { min.y } else { max.y },
            if i & 4 == 0 { min.z } else { max.z },
        )
    };
    Some(std::array::from_fn(|i| world.transform_point3(corner(i))))
}

/// Points that span a light; none of one infinitely far away.
fn placed_points(light: &Light) -> Option<Vec<DVec3>> {
    let far = matches!(light.shape, light::Shape::Cap(_) | light::Shape::Sky(_) | light::Shape::Directional(_));
    (!far).then(|| light_points(light))
}

/// Greatest component of what a material reflects at normal incidence.
fn reflected(material: &Material) -> f64 {
    let fresnel = match material.model {
        ReflectionModel::CookTorrance { reflectance, .. } => reflectance,
        _ => 1.0,
    };
    (material.diffuse + fresnel * material.specular).max_element()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::pattern::Pattern;
    use crate::light::{Disk, Quantity, QuantityKind, Sphere, Textured};
    use crate::scene::first_light;

    /// The first scene with one light in the place of its own.
    fn with(light: Light) -> Scene {
        Scene { lights: vec![light], ..first_light() }
    }

    fn globe(z: f64) -> Light {
        let position = DVec3::new(5.0, 5.0, z);
        Light { position, ..Light::new("globe", light::Shape::Sphere(Sphere { radius: 0.2 })) }
    }

    fn lamp(rotation_deg: DVec3) -> Light {
        let shape = light::Shape::Disk(Disk { radius: 0.5, two_sided: false });
        Light { position: DVec3::new(0.0, 0.0, 3.0), rotation_deg, ..Light::new("lamp", shape) }
    }

    #[track_caller]
    fn check(scene: &Scene, item: Option<Item>, expected: &str) {
        let rows = oddities(scene);
        assert!(rows.iter().any(|row| row.item == item && row.text.contains(expected)), "no {expected} in {rows:?}");
    }

    #[test]
    fn lights_in_the_ground_in_solids_and_turned_away_are_pointed_out() {
        let light = Some(Item::Light(0));
        check(&with(globe(-1.0)), light, "is below");
        assert!(!oddities(&with(globe(2.0))).iter().any(|row| row.item == light), "above the ground all is well");
        let mut boxed = with(globe(0.5));
        let size = DVec3::ONE;
        boxed.surfaces.push(Surface {
            position: DVec3::new(5.0, 5.0, 0.5),
            shape: Shape::Box { size },
            ..boxed.surfaces[0].clone()
        });
        check(&boxed, light, "is inside");
        check(&with(lamp(DVec3::new(180.0, 0.0, 0.0))), light, "faces no surface");
        assert!(!oddities(&with(lamp(DVec3::ZERO))).iter().any(|row| row.text.contains("faces")), "facing the ground");
        check(&with(Light { only: Some(Vec::new()), ..globe(2.0) }), light, "is linked to no surface");
        check(&with(Light { quantity: Quantity::new(QuantityKind::Flux, 0.0), ..globe(2.0) }), light, "emits nothing");
    }

    #[test]
    fn inside_is_told_from_outside_of_every_solid() {
        for (shape, inside, outside) in [
            (Shape::Sphere { radius: 1.0 }, DVec3::splat(0.5), DVec3::splat(0.6)),
            (Shape::Box { size: DVec3::ONE }, DVec3::splat(0.49), DVec3::splat(0.51)),
            (Shape::Cylinder { radius: 1.0, height: 1.0 }, DVec3::new(0.7, 0.7, 0.4), DVec3::new(0.8, 0.8, 0.0)),
            (Shape::Cone { radius: 1.0, height: 2.0 }, DVec3::new(0.4, 0.0, 0.0), DVec3::new(0.6, 0.0, 0.0)),
        ] {
            assert!(is_inside(&shape, inside) && !is_inside(&shape, outside), "{shape:?}");
        }
        assert!(!is_inside(&Shape::Plane {}, DVec3::NEG_Z), "a plane has no inside");
    }

    #[test]
    fn darkness_has_a_reason() {
        check(&with(Light { muted: true, ..globe(2.0) }), Some(Item::Light(0)), "All lights are muted");
        check(&Scene { lights: Vec::new(), ..first_light() }, None, "There is no light");
    }

    #[test]
    fn a_material_that_gains_energy_is_pointed_out() {
        let mut scene = first_light();
        scene.materials[0].diffuse = DVec3::splat(0.8);
        scene.materials[0].specular = DVec3::splat(0.3);
        check(&scene, Some(Item::Material(0)), "reflects more than it receives");
    }

    #[test]
    fn a_pattern_without_a_file_cannot_be_saved_and_one_elsewhere_will_be_copied() {
        let textured = |pattern| light::Shape::Textured(Textured { size: glam::DVec2::ONE, pattern, two_sided: false });
        let unread = with(Light::new("leaf", textured(Pattern::unread("leaf.png"))));
        assert_eq!(files(&unread, None)[0].severity, Severity::Error, "never read");
        let contents = crate::contents::Contents(vec![1].into());
        let read = with(Light::new("leaf", textured(Pattern { contents, ..Pattern::unread("leaf.png") })));
        assert_eq!(files(&read, None), [], "the scene has no file yet");
        let elsewhere = files(&read, Some(Path::new("/nowhere/scene.toml")));
        assert_eq!(elsewhere[0].severity, Severity::Note, "it will be put there");
    }
}
