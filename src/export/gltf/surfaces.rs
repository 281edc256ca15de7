//! Surfaces as meshes, materials as metallic-roughness.

use glam::{DAffine3, DVec3};
use serde_json::{Value, json};

use super::{Document, color_and_strength, placed, tidy};
use crate::export::facets::local_facets;
use crate::export::gloss::gloss;
use crate::export::{Fate, Remark};
use crate::scene::Scene;
use crate::surface::{Material, Placed, Primitive, ReflectionModel, Shape, Surface, Triangle};

/// glTF's share of light that a dielectric reflects at normal incidence.
const DIELECTRIC: f64 = 0.04;

/// Half an edge, in metres, of the square that stands for an infinite plane: viewers look at everything that there is.
const PLANE: f64 = 50.0;

const FLOAT: u32 = 5126;
const ARRAY_BUFFER: u32 = 34962;
const SPECULAR: &str = "KHR_materials_specular";

/// The surfaces of a document.
#[derive(Debug, Default)]
pub(super) struct Geometry {
    /// Root nodes.
    pub(super) nodes: Vec<usize>,
    pub(super) remarks: Vec<Remark>,
}

/// Adds the surfaces of a scene; those of one shape and material share a mesh.
pub(super) fn add(scene: &Scene, document: &mut Document) -> Geometry {
    let mut geometry = Geometry::default();
    let mut materials: Vec<(&str, usize)> = Vec::new();
    let mut meshes = Vec::new();
    for surface in &scene.surfaces {
        let Some(material) = scene.material(&surface.material) else { continue };
        let known = materials.iter().find(|(name, _)| *name == material.name).map(|(_, index)| *index);
        let index = known.unwrap_or_else(|| {
            if uses_specular(material) {
                document.extensions.insert(SPECULAR.to_owned(), Value::Null);
            }
            let index = document.put("materials", metallic_roughness(material));
            materials.push((&material.name, index));
            index
        });
        let children: Vec<_> = instances(surface)
            .into_iter()
            .filter_map(|(shape, frame)| {
                let mesh = mesh(&shape, index, &mut meshes, document)?;
                Some(instance(&frame, mesh, document))
            })
            .collect();
        let fate = if children.is_empty() { Fate::Lost } else { Fate::Changed };
        geometry.remarks.push(Remark::surface(surface, fate, what(surface, material, children.is_empty())));
        if !children.is_empty() {
            let mut root = placed(DVec3::ZERO, glam::DQuat::IDENTITY);
            root["name"] = json!(surface.name);
            root["children"] = json!(children);
            geometry.nodes.push(document.put("nodes", root));
        }
    }
    geometry
}

/// What a mesh is of.
#[derive(Clone, Debug, PartialEq)]
enum Solid {
    One(Primitive),
    /// In the world.
    Triangles(Vec<Triangle>),
}

/// The parts of a surface, each with its frame; triangles are one part.
fn instances(surface: &Surface) -> Vec<(Solid, DAffine3)> {
    let (mut parts, mut triangles) = (Vec::new(), Vec::new());
    for part in Placed::parts(surface) {
        match part.primitive() {
            Primitive::Triangle(triangle) => triangles.push(*triangle),
            primitive => parts.push((Solid::One(primitive.clone()), *part.world_from_local())),
        }
    }
    if !triangles.is_empty() {
        parts.push((Solid::Triangles(triangles), DAffine3::IDENTITY));
    }
    parts
}

/// A node of a mesh; by a matrix, as scales may differ along the axes.
fn instance(frame: &DAffine3, mesh: usize, document: &mut Document) -> usize {
    let mut node = json!({ "mesh": mesh });
    if *frame != DAffine3::IDENTITY {
        node["matrix"] = json!(tidy(glam::DMat4::from(*frame).to_cols_array()));
    }
    document.put("nodes", node)
}

/// A mesh of that material, a known one or a new one; none of what has no area.
fn mesh(
    solid: &Solid,
    material: usize,
    known: &mut Vec<(Solid, usize, usize)>,
    document: &mut Document,
) -> Option<usize> {
    if let Some((.., mesh)) = known.iter().find(|(other, of, _)| *of == material && other == solid) {
        return Some(*mesh);
    }
    let triangles = match solid {
        Solid::One(Primitive::Plane) => local_facets(&Primitive::Square { size: glam::DVec2::splat(2.0 * PLANE) }),
        Solid::One(primitive) => local_facets(primitive),
        Solid::Triangles(triangles) => triangles.clone(),
    };
    let corners: Vec<_> = triangles.iter().filter_map(with_normals).flatten().collect();
    if corners.is_empty() {
        return None;
    }
    let positions: Vec<_> = corners.iter().map(|(p, _)| *p).collect();
    let normals: Vec<_> = corners.iter().map(|(_, n)| *n).collect();
    let attributes = json!({
        "POSITION": accessor(&positions, true, document),
        "NORMAL": accessor(&normals, false, document),
    });
    let primitives = json!([{ "attributes": attributes, "material": material }]);
    let mesh = document.put("meshes", json!({ "primitives": primitives }));
    known.push((solid.clone(), material, mesh));
    Some(mesh)
}

/// The corners of a triangle with unit normals; none where it has no area.
fn with_normals(triangle: &Triangle) -> Option<[(DVec3, DVec3); 3]> {
    let [a, b, c] = triangle.corners;
    let flat = (b - a).cross(c - a).try_normalize()?;
    let normals = triangle.normals.unwrap_or([flat; 3]);
    Some([0, 1, 2].map(|i| (triangle.corners[i], normals[i].normalize_or(flat))))
}

/// The accessor of vectors, in single precision, as glTF has no other.
fn accessor(vectors: &[DVec3], with_bounds: bool, document: &mut Document) -> usize {
    let offset = document.buffer.len();
    let single: Vec<_> = vectors.iter().map(|v| v.as_vec3()).collect();
    for vector in &single {
        vector.to_array().iter().for_each(|x| document.buffer.extend(x.to_le_bytes()));
    }
    let length = document.buffer.len() - offset;
    let view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": length, "target": ARRAY_BUFFER });
    let view = document.put("bufferViews", view);
    let mut accessor = json!({ "bufferView": view, "componentType": FLOAT, "count": vectors.len(), "type": "VEC3" });
    if with_bounds {
        let least = single.iter().copied().fold(glam::Vec3::INFINITY, glam::Vec3::min);
        let greatest = single.iter().copied().fold(glam::Vec3::NEG_INFINITY, glam::Vec3::max);
        accessor["min"] = json!(tidy(least.as_dvec3().to_array()));
        accessor["max"] = json!(tidy(greatest.as_dvec3().to_array()));
    }
    document.put("accessors", accessor)
}

/// Whether its reflectance at normal incidence is another than glTF's.
fn uses_specular(material: &Material) -> bool {
    gloss(material).is_none_or(|gloss| gloss.reflectance != DVec3::splat(DIELECTRIC))
}

/// A material without metal: its diffuse colour, microfacets as wide as its highlight, and their reflectance.
///
/// glTF's α is the square of its roughness.
fn metallic_roughness(material: &Material) -> Value {
    let gloss = gloss(material);
    let base = material.diffuse.clamp(DVec3::ZERO, DVec3::ONE);
    let roughness = gloss.map_or(1.0, |gloss| gloss.alpha.clamp(0.0, 1.0).sqrt());
    let mut written = json!({
        "name": material.name,
        "doubleSided": true,
        "pbrMetallicRoughness": {
            "baseColorFactor": tidy([base.x, base.y, base.z, 1.0]),
            "metallicFactor": 0.0,
            "roughnessFactor": roughness,
        },
    });
    if uses_specular(material) {
        let specular = match gloss {
            None => json!({ "specularFactor": 0.0 }),
            Some(gloss) => {
                let (color, strength) = color_and_strength(gloss.reflectance / DIELECTRIC);
                json!({ "specularColorFactor": color.map(|channel| channel * strength) })
            }
        };
        written["extensions"] = json!({ SPECULAR: specular });
    }
    written
}

/// What becomes of a surface.
fn what(surface: &Surface, material: &Material, is_empty: bool) -> String {
    if is_empty {
        return "has no area, and is left out".to_owned();
    }
    let mesh = match surface.shape {
        Shape::Plane {} => format!("is a square of {} m instead of an infinite plane", 2.0 * PLANE),
        Shape::Box { .. } | Shape::Square { .. } | Shape::Mesh(_) | Shape::Tetrahedron { .. } => {
            "is a mesh as it is".to_owned()
        }
        _ => "is a mesh of facets".to_owned(),
    };
    let material_text = match (gloss(material), material.model) {
        (None, _) => "its material is diffuse only, by a specular factor of 0".to_owned(),
        (Some(gloss), ReflectionModel::CookTorrance { .. }) => {
            format!("its Cook-Torrance highlight is one of GGX microfacets of roughness {:.3}", gloss.alpha.sqrt())
        }
        (Some(gloss), model) => format!(
            "its {} highlight is one of GGX microfacets of roughness {:.3}, as wide",
            model.name(),
            gloss.alpha.sqrt()
        ),
    };
    let clipped = if material.diffuse.max_element() > 1.0 { "; its diffuse colour is cut at 1" } else { "" };
    format!("{mesh}; {material_text}{clipped}")
}
