//! Meshes that shine: those that are flat, with one outline.

use std::collections::BTreeMap;

use glam::{DAffine3, DVec2, DVec3};

use super::light::{rigid, tidy};
use super::prim::{Prim, Value};
use super::stage::{Found, Reader};
use crate::light::{Light, Polygon, Quantity, QuantityKind, Shape};
use crate::math::frame::{deg_from_rotation, facing};

/// How far corners may lie off their plane, as a share of the mesh's size.
const FLAT: f64 = 1e-6;

/// Outlines with more corners are not read.
const MOST_CORNERS: usize = 4096;

/// A flat mesh in the world.
struct Flat {
    /// Its outline, in the sense of its faces.
    corners: Vec<DVec3>,
    /// To where it shines.
    normal: DVec3,
    /// The middle of the corners.
    position: DVec3,
    /// How far the farthest lies from there.
    size: f64,
}

/// Faces by the corners' indices.
type Faces = Vec<Vec<usize>>;

impl Reader<'_> {
    /// A flat mesh as a polygon; it shines to where its faces turn counter-clockwise.
    pub(super) fn mesh_light(&mut self, found: &Found<'_>, world_from_light: &DAffine3) -> Option<Light> {
        let prim = found.prim;
        let Flat { corners, normal, position, size } = match flat(prim, world_from_light) {
            Ok(flat) => flat,
            Err(why) => {
                self.remark_on(prim, prim.line, &format!("{why}; it is left out"));
                return None;
            }
        };
        // The mesh's own frame where that lies in its plane, so that its corners stay as they are.
        let (own, _) = rigid(world_from_light);
        let has_own_axes = (own.z_axis + normal).length() < FLAT;
        let is_in_plane = (world_from_light.translation - position).dot(normal).abs() <= FLAT * size;
        let rotation = if has_own_axes { own } else { facing(-normal) };
        let origin = if has_own_axes && is_in_plane { world_from_light.translation } else { position };
        let local = |p: &DVec3| {
            let p = rotation.transpose() * (*p - origin);
            DVec2::new(p.x, p.y)
        };
        let two_sided = prim.is_on("doubleSided");
        let polygon = Polygon { vertices: corners.iter().map(local).collect(), two_sided };
        if let Err(wrong) = polygon.check() {
            self.remark_on(prim, prim.line, &format!("has an outline that is no polygon: {wrong}; it is left out"));
            return None;
        }
        let stage_area = polygon.area() / (self.metres * self.metres);
        let luminance = self.normalized(prim, self.strength(prim), Some(stage_area));
        if two_sided {
            self.remark_on(prim, prim.line, "is double-sided, and shines to both sides here");
        }
        let mut light = Light::new("", Shape::Polygon(polygon));
        (light.position, light.rotation_deg) = (tidy(origin), tidy(deg_from_rotation(rotation)));
        (light.quantity, light.tint) = (Quantity::new(QuantityKind::Luminance, luminance), self.tint(prim));
        light.group = prim.group();
        self.remark_on_extras(prim);
        Some(light)
    }
}

/// The outline of a mesh that could be a polygon; or why there is none.
fn flat(prim: &Prim, world_from_light: &DAffine3) -> Result<Flat, &'static str> {
    let (points, faces) = faces_of(prim).ok_or("has no faces that could shine")?;
    let outline = outline(&faces).ok_or("has no single outline, so that it is no polygon")?;
    if outline.len() > MOST_CORNERS {
        return Err("has more corners than a polygon should");
    }
    let place = |i: &usize| world_from_light.transform_point3(points[*i]);
    let corners: Vec<DVec3> = outline.iter().map(place).collect();
    let mirrored = world_from_light.matrix3.determinant() < 0.0;
    let left_handed = prim.property("orientation").is_some_and(|p| p.value.text() == Some("leftHanded"));
    let lit = if mirrored != left_handed { -vector_area(&corners) } else { vector_area(&corners) };
    let normal = lit.try_normalize().ok_or("has no area")?;
    let position = corners.iter().sum::<DVec3>() / corners.len() as f64;
    let size = corners.iter().map(|corner| corner.distance(position)).fold(0.0, f64::max);
    let off = faces.iter().flatten().map(|i| (place(i) - position).dot(normal).abs()).fold(0.0, f64::max);
    if off <= FLAT * size {
        Ok(Flat { corners, normal, position, size })
    } else {
        Err("is not flat, so that it is no polygon")
    }
}

/// A mesh's points and faces, where they fit each other.
fn faces_of(prim: &Prim) -> Option<(Vec<DVec3>, Faces)> {
    let list = |name: &str| prim.property(name).and_then(|property| property.value.list());
    let points: Vec<DVec3> = list("points")?.iter().map(Value::vector).collect::<Option<_>>()?;
    let index = |value: &Value| whole(value).filter(|index| *index < points.len());
    let indices: Vec<usize> = list("faceVertexIndices")?.iter().map(index).collect::<Option<_>>()?;
    let mut rest = indices.as_slice();
    let mut faces = Vec::new();
    for count in list("faceVertexCounts")? {
        let (face, others) = rest.split_at_checked(whole(count)?)?;
        faces.push(face.to_vec());
        rest = others;
    }
    (!faces.is_empty()).then_some((points, faces))
}

/// A count or an index.
#[expect(clippy::cast_possible_truncation, reason = "a whole number of 32 bits")]
fn whole(value: &Value) -> Option<usize> {
    let number = value.number()?;
    (number.fract() == 0.0 && (0.0..f64::from(u32::MAX)).contains(&number)).then_some(number as usize)
}

/// The corners around all faces in their sense: the edges that one face alone has, where they are one ring.
fn outline(faces: &Faces) -> Option<Vec<usize>> {
    let edges: Vec<(usize, usize)> =
        faces.iter().flat_map(|face| (0..face.len()).map(move |i| (face[i], face[(i + 1) % face.len()]))).collect();
    let known: std::collections::BTreeSet<_> = edges.iter().copied().collect();
    let rim: Vec<_> = edges.iter().filter(|(a, b)| !known.contains(&(*b, *a))).copied().collect();
    let next: BTreeMap<usize, usize> = rim.iter().copied().collect();
    let first = rim.first()?.0;
    let mut ring = vec![first];
    let mut at = *next.get(&first)?;
    while at != first && ring.len() <= rim.len() {
        ring.push(at);
        at = *next.get(&at)?;
    }
    (ring.len() == rim.len() && next.len() == rim.len()).then_some(ring)
}

fn vector_area(corners: &[DVec3]) -> DVec3 {
    let Some(&origin) = corners.first() else { return DVec3::ZERO };
    0.5 * corners.windows(2).map(|edge| (edge[0] - origin).cross(edge[1] - origin)).sum::<DVec3>()
}
