//! Vertices and edges of polygons: where their handles are, and what dragging them does.

use glam::{DAffine3, DVec2, DVec3};

use super::drag::Change;
use super::pull::Pull;
use super::subject::Subject;
use super::{Handle, Outline, REACH, Spot, dot};
use crate::editor::tools::polygon::is_simple;
use crate::editor::viewport::projection::Projection;
use crate::light::{Polygon, Shape};

/// The handles on a polygon's vertices, then those on its edges.
pub(super) fn spots(polygon: &Polygon, world_from_light: &DAffine3, projection: &Projection, spots: &mut Vec<Spot>) {
    let corners: Vec<DVec3> =
        polygon.vertices.iter().map(|v| world_from_light.transform_point3(v.extend(0.0))).collect();
    spots.extend(corners.iter().enumerate().filter_map(|(i, p)| dot(Handle::Vertex(i), *p, projection)));
    let next = corners.iter().cycle().skip(1);
    spots.extend(corners.iter().zip(next).enumerate().filter_map(|(i, (a, b))| {
        let [on_a, on_b] = [projection.project(*a)?, projection.project(*b)?];
        // No room between the vertices' dots: no handle.
        let at = (on_a.distance(on_b) > 6.0 * REACH).then(|| projection.project(a.midpoint(*b))).flatten()?;
        Some(Spot { handle: Handle::Edge(i), outline: Outline::Diamond(at) })
    }));
}

/// A polygon's vertex moved in its plane.
pub(super) fn vertex(pull: &Pull<'_>, start: &Subject, index: usize) -> Option<Change> {
    reshaped(start, |polygon, world_from_light| {
        let vertex = polygon.vertices.get(index)?;
        let shift = pull.shift_in_plane(world_from_light, *vertex)?;
        let moved = pull.caught_in_plane(world_from_light, *vertex + shift);
        *polygon.vertices.get_mut(index)? = moved;
        Some(())
    })
}

/// A polygon's edge moved along its normal, in its plane.
pub(super) fn edge(pull: &Pull<'_>, start: &Subject, index: usize) -> Option<Change> {
    reshaped(start, |polygon, world_from_light| {
        let next = (index + 1) % polygon.vertices.len().max(1);
        let (a, b) = (*polygon.vertices.get(index)?, *polygon.vertices.get(next)?);
        let normal = (b - a).perp().try_normalize()?;
        let middle = a.midpoint(b);
        let along_normal = |shift: DVec2| shift.dot(normal) * normal;
        let shift = along_normal(pull.shift_in_plane(world_from_light, middle)?);
        let shift = along_normal(pull.snapped_in_plane(world_from_light, middle + shift) - middle);
        polygon.vertices[index] += shift;
        polygon.vertices[next] += shift;
        Some(())
    })
}

/// A polygon changed by `change`, refused where it crosses itself.
fn reshaped(start: &Subject, change: impl FnOnce(&mut Polygon, &DAffine3) -> Option<()>) -> Option<Change> {
    let Subject::Light(light) = start else { return None };
    let mut light = light.clone();
    let world_from_light = light.world_from_light();
    let Shape::Polygon(polygon) = &mut light.shape else { return None };
    change(polygon, &world_from_light)?;
    let simple = is_simple(&polygon.vertices);
    let subject = Subject::Light(light);
    Some(if simple { Change::To(subject) } else { Change::Refused(subject) })
}
