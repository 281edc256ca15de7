//! Surfaces as UsdGeom prims, and their materials.

use std::collections::HashMap;

use glam::DVec3;

use super::text::{Text, list, number, placed, quoted, triple};
use crate::export::facets::{PATCH_SHARE, PLANE_REACH, SIDES, facets};
use crate::export::gloss::gloss;
use crate::surface::{Material, Placed, Primitive, Shape, Surface, Triangle};

/// A material as a UsdPreviewSurface of the specular workflow.
pub(super) fn material(text: &mut Text, material: &Material, name: &str, path: &str) {
    text.open("Material", name, &[format!("displayName = {}", quoted(&material.name))]);
    text.attribute("token", "outputs:surface.connect", &format!("<{path}/Shader.outputs:surface>"));
    text.open("Shader", "Shader", &[]);
    text.attribute("uniform token", "info:id", "\"UsdPreviewSurface\"");
    text.attribute("color3f", "inputs:diffuseColor", &triple(material.diffuse));
    let (specular, roughness) = match gloss(material) {
        // Its microfacets' slope is the square of its roughness.
        Some(gloss) => (gloss.reflectance, gloss.alpha.sqrt()),
        None => (DVec3::ZERO, 1.0),
    };
    text.attribute("float", "inputs:roughness", &number(roughness));
    text.attribute("color3f", "inputs:specularColor", &triple(specular));
    text.attribute("int", "inputs:useSpecularWorkflow", "1");
    text.declaration("token", "outputs:surface");
    text.close();
    text.close();
}

/// A surface with its material; what changes on the way.
pub(super) fn surface(text: &mut Text, surface: &Surface, name: &str, material: Option<&str>) -> Option<String> {
    let mut metadata = vec![format!("displayName = {}", quoted(&surface.name))];
    if material.is_some() {
        metadata.push("prepend apiSchemas = [\"MaterialBindingAPI\"]".to_owned());
    }
    let operations = |scale| placed(surface.position, surface.rotation_deg, scale);
    let mut solid = |kind: &str, attributes: &[(&str, String)], scale: DVec3| {
        text.open(kind, name, &metadata);
        for (name, value) in attributes {
            let kind = if value.starts_with('"') { "uniform token" } else { "double" };
            text.attribute(kind, name, value);
        }
        bind(text, material);
        text.transform(&operations(scale));
        text.close();
    };
    let axis = ("axis", "\"Z\"".to_owned());
    match surface.shape {
        Shape::Sphere { radius } => solid("Sphere", &[("radius", number(radius))], surface.scale),
        Shape::Box { size } => solid("Cube", &[("size", number(1.0))], surface.scale * size),
        Shape::Cylinder { radius, height } => {
            solid("Cylinder", &[axis, ("height", number(height)), ("radius", number(radius))], surface.scale);
        }
        Shape::Cone { radius, height } => {
            solid("Cone", &[axis, ("height", number(height)), ("radius", number(radius))], surface.scale);
        }
        Shape::Sphereflake { .. } => balls(text, surface, name, &metadata, material),
        _ => {
            let parts = Placed::parts(surface);
            let triangles: Vec<_> = parts.iter().flat_map(facets).collect();
            text.open("Mesh", name, &metadata);
            mesh(text, &triangles);
            bind(text, material);
            text.close();
        }
    }
    match surface.shape {
        Shape::Plane {} => Some(format!("is {} m wide, not infinite", 2.0 * PLANE_REACH)),
        Shape::Disk { .. } => Some(format!("has {SIDES} sides")),
        Shape::Patch { .. } => Some(format!("is a mesh within {PATCH_SHARE} of its size")),
        Shape::Mesh(_) | Shape::Tetrahedron { .. } => {
            Some("its corners are in single precision, in the world's frame".to_owned())
        }
        _ => None,
    }
}

/// Lit on both sides, and of that material.
fn bind(text: &mut Text, material: Option<&str>) {
    text.attribute("uniform bool", "doubleSided", "1");
    if let Some(path) = material {
        text.attribute("rel", "material:binding", &format!("<{path}>"));
    }
}

/// Many balls, as instances of one.
fn balls(text: &mut Text, surface: &Surface, name: &str, metadata: &[String], material: Option<&str>) {
    let parts = Placed::parts(surface);
    let to_local = surface.world_from_surface().inverse();
    let balls = parts.iter().filter_map(|part| match part.primitive() {
        Primitive::Sphere { radius } => Some((to_local.transform_point3(part.world_from_local().translation), *radius)),
        _ => None,
    });
    let balls: Vec<_> = balls.collect();
    text.open("PointInstancer", name, metadata);
    if let Some(path) = material {
        text.attribute("rel", "material:binding", &format!("<{path}>"));
    }
    text.attribute("point3f[]", "positions", &list(balls.iter().map(|(center, _)| triple(*center))));
    text.attribute("int[]", "protoIndices", &list(balls.iter().map(|_| "0".to_owned())));
    text.attribute("rel", "prototypes", &format!("<{}/Surfaces/{name}/Ball>", super::ROOT));
    text.attribute("float3[]", "scales", &list(balls.iter().map(|(_, radius)| triple(DVec3::splat(*radius)))));
    text.transform(&placed(surface.position, surface.rotation_deg, surface.scale));
    text.open("Sphere", "Ball", &[]);
    text.attribute("uniform bool", "doubleSided", "1");
    text.attribute("double", "radius", "1");
    text.close();
    text.close();
}

/// Triangles, with the corners that they share written once.
fn mesh(text: &mut Text, triangles: &[Triangle]) {
    let mut known: HashMap<[u64; 3], usize> = HashMap::new();
    let mut points: Vec<DVec3> = Vec::new();
    let mut indices = Vec::new();
    for corner in triangles.iter().flat_map(|triangle| triangle.corners) {
        let index = *known.entry(corner.to_array().map(f64::to_bits)).or_insert_with(|| {
            points.push(corner);
            points.len() - 1
        });
        indices.push(index.to_string());
    }
    faces(text, &points, vec!["3".to_owned(); triangles.len()], indices);
    if triangles.iter().any(|triangle| triangle.normals.is_some()) {
        let normals = triangles.iter().flat_map(|triangle| {
            let [a, b, c] = triangle.corners;
            triangle.normals.unwrap_or([(b - a).cross(c - a).normalize_or_zero(); 3])
        });
        let value = format!("{} (\n    interpolation = \"faceVarying\"\n)", list(normals.map(triple)));
        text.attribute("normal3f[]", "normals", &value);
    }
}

/// The points and faces of a mesh.
pub(super) fn faces(text: &mut Text, points: &[DVec3], counts: Vec<String>, indices: Vec<String>) {
    let bounds =
        points.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
    if !points.is_empty() {
        text.attribute("float3[]", "extent", &list([triple(bounds.0), triple(bounds.1)]));
    }
    text.attribute("int[]", "faceVertexCounts", &list(counts));
    text.attribute("int[]", "faceVertexIndices", &list(indices));
    text.attribute("point3f[]", "points", &list(points.iter().copied().map(triple)));
    text.attribute("uniform token", "subdivisionScheme", "\"none\"");
}
