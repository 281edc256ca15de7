//! Meshes that shine: those that are flat, with one outline.

use std::collections::BTreeMap;

use glam::{DAffine3, DVec2, DVec3};

use super::light::{rigid, tidy};
use super::prim::{Prim, Value};
use super::stage::{Found, Reader};
use crate::light::{Light, Polygon, Quantity, QuantityKind, Shape};
use crate::math::frame::deg_from_rotation;

/// How far corners may lie off their plane, as a share of the mesh's size.
const FLAT: f64 = 1e-6;

/// Faces by the corners' indices.
type Faces = Vec<Vec<usize>>;

impl Reader<'_> {
    /// A flat mesh as a polygon; it shines to where its faces turn counter-clockwise.
    pub(super) fn mesh_light(&mut self, found: &Found<'_>, world_from_light: &DAffine3) -> Option<Light> {
        let prim = found.prim;
        let Some((points, faces)) = faces_of(prim) else {
            self.remark_on(prim, prim.line, "has no faces that could shine; it is left out");
            return None;
        };
        let Some(outline) = outline(&faces) else {
            self.remark_on(prim, prim.line, "has no single outline, so that it is no polygon; it is left out");
            return None;
        };
        let corners: Vec<DVec3> = outline.iter().map(|i| world_from_light.transform_point3(points[*i])).collect();
        let mirrored = world_from_light.matrix3.determinant() < 0.0;
        let left_handed = prim.property("orientation").is_some_and(|p| p.value.text() == Some("leftHanded"));
        let lit = if mirrored != left_handed { -vector_area(&corners) } else { vector_area(&corners) };
        let Some(normal) = lit.try_normalize() else {
            self.remark_on(prim, prim.line, "has no area, and is left out");
            return None;
        };
        let (position, size) = middle(&corners);
        let used = faces.iter().flatten().map(|i| world_from_light.transform_point3(points[*i]));
        if used.map(|p| (p - position).dot(normal).abs()).fold(0.0, f64::max) > FLAT * size {
            self.remark_on(prim, prim.line, "is not flat, so that it is no polygon; it is left out");
            return None;
        }
        // The light's own axes where its normal is theirs, so that its corners stay as they are.
        let (own, _) = rigid(world_from_light);
        let rotation = if (own.z_axis + normal).length() < FLAT {
            own
        } else {
            let x = normal.any_orthonormal_vector();
            glam::DMat3::from_cols(x, (-normal).cross(x), -normal)
        };
        let origin = if (own.z_axis + normal).length() < FLAT
            && (world_from_light.translation - position).dot(normal).abs() <= FLAT * size
        {
            world_from_light.translation
        } else {
            position
        };
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
        light.group = prim.property("softbox:group").and_then(|group| group.value.text()).map(str::to_owned);
        self.remark_on_extras(prim);
        Some(light)
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

/// The middle of corners, and how far the farthest lies from it.
fn middle(corners: &[DVec3]) -> (DVec3, f64) {
    let middle = corners.iter().sum::<DVec3>() / corners.len().max(1) as f64;
    (middle, corners.iter().map(|corner| corner.distance(middle)).fold(0.0, f64::max))
}
