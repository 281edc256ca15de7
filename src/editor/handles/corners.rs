//! Corners of a polygon chosen, added and deleted.

use egui::{Color32, Key, Modifiers, Painter, Pos2, Response, Stroke, Ui, vec2};
use glam::DVec2;

use super::{Handle, segment_distance};
use crate::editor::session::{Item, Session};
use crate::editor::tools::polygon::is_simple;
use crate::editor::viewport::projection::Projection;
use crate::light::{Light, Polygon, Shape};

/// An edge can be clicked within this distance, points.
const REACH: f32 = 8.0;
/// A polygon seen at a smaller sine than this is too flat to be edited.
const LEAST_FACING: f64 = 0.05;
/// Radius of the ring about the chosen corner, points.
const RING: f32 = 8.0;

/// A corner of a polygonal light: the light's place in the scene's list, and the corner's in the light's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner {
    /// Index of the light.
    pub light: usize,
    /// Index of its vertex.
    pub vertex: usize,
}

impl Session {
    /// The corner that keys act on: one of the light selected last.
    pub fn corner(&self) -> Option<Corner> {
        let corner = self.chosen_corner?;
        let polygon = self.selected_polygon().filter(|_| self.selection.primary() == Some(Item::Light(corner.light)));
        polygon.filter(|polygon| corner.vertex < polygon.vertices.len()).map(|_| corner)
    }

    /// Take the chosen corner away; where that may not be, the user is told.
    pub fn delete_corner(&mut self) {
        let Some(corner) = self.corner() else { return };
        let change = |polygon: &mut Polygon| {
            polygon.vertices.remove(corner.vertex);
        };
        let count = self.selected_polygon().map_or(0, |polygon| polygon.vertices.len());
        if count <= 3 {
            self.failed("A polygon needs at least three corners");
        } else if self.reshape(corner.light, "Delete vertex", change) {
            self.chosen_corner = None;
        } else {
            self.failed("Without this corner edges would cross");
        }
    }

    /// Add a corner on the edge that begins at a vertex, and choose it.
    fn split(&mut self, light: usize, edge: usize, at: DVec2) {
        let has_edge = self.selected_polygon().is_some_and(|polygon| edge < polygon.vertices.len());
        if !has_edge || self.selection.primary() != Some(Item::Light(light)) {
            return;
        }
        if self.reshape(light, "Add vertex", |polygon| polygon.vertices.insert(edge + 1, at)) {
            self.chosen_corner = Some(Corner { light, vertex: edge + 1 });
        } else {
            self.failed("There is no room for a corner there");
        }
    }

    /// Add a corner in the middle of an edge, and choose it.
    fn split_middle(&mut self, light: usize, edge: usize) {
        let middle = self.selected_polygon().and_then(|polygon| {
            let next = (edge + 1) % polygon.vertices.len().max(1);
            Some(polygon.vertices.get(edge)?.midpoint(*polygon.vertices.get(next)?))
        });
        if let Some(middle) = middle {
            self.split(light, edge, middle);
        }
    }

    /// Change a polygon's outline as one step; whether it may be so.
    fn reshape(&mut self, light: usize, label: &str, change: impl FnOnce(&mut Polygon)) -> bool {
        let Some(Shape::Polygon(polygon)) = self.scene().lights.get(light).map(|light| &light.shape) else {
            return false;
        };
        let mut polygon = polygon.clone();
        change(&mut polygon);
        let simple = is_simple(&polygon.vertices);
        if simple {
            self.edit(label, |scene| scene.lights[light].shape = Shape::Polygon(polygon));
        }
        simple
    }

    fn selected_polygon(&self) -> Option<&Polygon> {
        let Some(Item::Light(index)) = self.selection.primary() else { return None };
        match &self.scene().lights.get(index)?.shape {
            Shape::Polygon(polygon) => Some(polygon),
            _ => None,
        }
    }

    fn selected_polygonal_light(&self) -> Option<(usize, &Light)> {
        let Some(Item::Light(index)) = self.selection.primary() else { return None };
        self.selected_polygon().and_then(|_| Some((index, self.scene().lights.get(index)?)))
    }
}

/// React to a click, on the handle `hot` where there is one, and to Backspace; whether the click has done its work.
///
/// A click on a vertex chooses it, one in the middle of an edge adds a corner there, with Alt anywhere on an edge.
pub fn update(
    ui: &Ui,
    response: &Response,
    session: &mut Session,
    hot: Option<(Item, Handle)>,
    projection: &Projection,
) -> bool {
    let backspace = || ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Backspace));
    if session.corner().is_some() && !ui.ctx().egui_wants_keyboard_input() && backspace() {
        session.delete_corner();
    }
    if response.secondary_clicked() {
        // The menu that opens is about the corner that was clicked, or about no corner.
        session.chosen_corner = match hot {
            Some((Item::Light(light), Handle::Vertex(vertex))) => Some(Corner { light, vertex }),
            _ => None,
        };
    }
    if !response.clicked() {
        return false;
    }
    let (alt, pos) = (ui.input(|input| input.modifiers.alt), response.interact_pointer_pos());
    if alt {
        let Some((light, edge, at)) = pos.and_then(|pos| edge_at(session, projection, pos)) else { return false };
        session.split(light, edge, at);
        return true;
    }
    match hot {
        Some((Item::Light(light), Handle::Vertex(vertex))) => {
            session.chosen_corner = Some(Corner { light, vertex });
            true
        }
        Some((Item::Light(light), Handle::Edge(edge))) => {
            session.split_middle(light, edge);
            true
        }
        _ => {
            session.chosen_corner = None;
            false
        }
    }
}

/// The edge of the selected polygon under the pointer, and the point of it nearest to that.
fn edge_at(session: &Session, projection: &Projection, pos: Pos2) -> Option<(usize, usize, DVec2)> {
    let (index, light) = session.selected_polygonal_light()?;
    let polygon = session.selected_polygon()?;
    let place = light.world_from_light();
    let on_screen = |v: DVec2| projection.project(place.transform_point3(v.extend(0.0)));
    let next = polygon.vertices.iter().cycle().skip(1);
    let near = polygon.vertices.iter().zip(next).enumerate().filter_map(|(i, (a, b))| {
        let distance = segment_distance([on_screen(*a)?, on_screen(*b)?], pos);
        (distance <= REACH).then_some((i, *a, *b, distance))
    });
    let (edge, a, b, _) = near.min_by(|(.., p), (.., q)| p.total_cmp(q))?;
    let met = projection.ray(pos).on_plane(light.position, place.matrix3.z_axis)?;
    let at = place.inverse().transform_point3(met).truncate();
    let share = (at - a).dot(b - a) / (b - a).length_squared();
    // To a millimetre, but on the edge where that runs along an axis.
    let on_edge = a.lerp(b, share.clamp(0.0, 1.0));
    let rounded = (on_edge * 1e3).round() / 1e3;
    let at = DVec2::select((a - b).abs().cmple(DVec2::splat(1e-12)), a, rounded);
    (at != a && at != b).then_some((index, edge, at))
}

/// What to do about a selected polygon that is seen edge-on, so that its corners cannot be moved.
pub fn edge_on_hint(session: &Session, projection: &Projection) -> Option<String> {
    let (_, light) = session.selected_polygonal_light()?;
    let to_eye = (projection.camera().eye - light.position).try_normalize()?;
    let facing = to_eye.dot(light.world_from_light().matrix3.z_axis).abs();
    (facing < LEAST_FACING).then(|| format!("{} is seen edge-on: orbit the view to edit its corners", light.name))
}

/// A ring about the chosen corner, and a plus where a click would add one: in the middle of the edge under the pointer.
pub fn paint(
    session: &Session,
    hot: Option<(Item, Handle)>,
    color: Color32,
    projection: &Projection,
    painter: &Painter,
) {
    let Some((_, light)) = session.selected_polygonal_light() else { return };
    let Some(polygon) = session.selected_polygon() else { return };
    let place = light.world_from_light();
    let on_screen = |v: DVec2| projection.project(place.transform_point3(v.extend(0.0)));
    let chosen = session.corner().and_then(|corner| polygon.vertices.get(corner.vertex));
    if let Some(at) = chosen.and_then(|vertex| on_screen(*vertex)) {
        painter.circle_stroke(at, RING, Stroke::new(3.5, Color32::from_black_alpha(150)));
        painter.circle_stroke(at, RING, Stroke::new(2.0, color));
    }
    let Some((_, Handle::Edge(edge))) = hot else { return };
    let ends = [edge, (edge + 1) % polygon.vertices.len().max(1)].map(|i| polygon.vertices.get(i));
    if let [Some(a), Some(b)] = ends
        && let Some(at) = on_screen(a.midpoint(*b))
    {
        painter.circle(at, RING, color, Stroke::new(1.5, Color32::from_black_alpha(190)));
        for arm in [vec2(4.5, 0.0), vec2(0.0, 4.5)] {
            painter.line_segment([at - arm, at + arm], Stroke::new(2.0, Color32::BLACK));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::tools::new_light;
    use crate::scene::{Camera, Scene};
    use egui::{Rect, pos2};
    use glam::{DVec3, dvec2};

    fn session(corners: &[DVec2]) -> Session {
        let scene = Scene { lights: vec![new_light::polygon(corners, 2.0)], ..Scene::default() };
        let mut session = Session::new(scene, None);
        session.selection.set([Item::Light(0)]);
        session
    }

    fn square() -> Session {
        session(&[dvec2(-1.0, -1.0), dvec2(1.0, -1.0), dvec2(1.0, 1.0), dvec2(-1.0, 1.0)])
    }

    fn projection(eye: DVec3) -> Projection {
        let camera = Camera { eye, target: DVec3::new(0.0, 0.0, 2.0), fov_deg: 40.0 };
        Projection::new(&camera, Rect::from_min_max(pos2(0.0, 0.0), pos2(800.0, 600.0)))
    }

    #[test]
    fn a_corner_is_deleted_in_one_step_but_never_the_third() {
        let mut session = square();
        session.chosen_corner = Some(Corner { light: 0, vertex: 1 });
        session.delete_corner();
        assert_eq!(session.selected_polygon().map(|polygon| polygon.vertices.len()), Some(3), "three are left");
        assert_eq!(session.history.undo_label(), Some("Delete vertex"), "one step");
        session.chosen_corner = Some(Corner { light: 0, vertex: 1 });
        session.delete_corner();
        assert_eq!(session.selected_polygon().map(|polygon| polygon.vertices.len()), Some(3), "no fewer");
        assert_eq!(session.notices.len(), 1, "and the user is told");
    }

    #[test]
    fn a_corner_without_which_edges_would_cross_stays() {
        // Without its fourth corner the third edge would run through the notch.
        let mut session = session(&[
            dvec2(0.0, 0.0),
            dvec2(4.0, 0.0),
            dvec2(4.0, 3.0),
            dvec2(2.0, 4.0),
            dvec2(0.0, 3.0),
            dvec2(2.0, 3.5),
        ]);
        session.chosen_corner = Some(Corner { light: 0, vertex: 3 });
        session.delete_corner();
        assert_eq!(session.selected_polygon().map(|polygon| polygon.vertices.len()), Some(6), "it stays");
        assert_eq!(session.notices.len(), 1, "and the user is told");
    }

    #[test]
    fn an_edge_is_split_where_it_is_pointed_at() {
        let mut session = square();
        let projection = projection(DVec3::new(2.0, -4.0, 7.0));
        let pos = projection.project(DVec3::new(0.25, -1.0, 2.0)).expect("in sight");
        let (light, edge, at) = edge_at(&session, &projection, pos).expect("on an edge");
        assert!(at.distance(dvec2(0.25, -1.0)) < 1e-9, "{at}");
        session.split(light, edge, at);
        let polygon = session.selected_polygon().expect("a polygon");
        assert_eq!(polygon.vertices.len(), 5, "{polygon:?}");
        assert_eq!(session.corner(), Some(Corner { light: 0, vertex: edge + 1 }), "chosen");
        assert_eq!(edge_at(&session, &projection, pos2(5.0, 5.0)), None, "beside");
    }

    #[test]
    fn only_a_polygon_seen_edge_on_is_said_to_be() {
        let session = square();
        assert!(edge_on_hint(&session, &projection(DVec3::new(0.0, -6.0, 2.1))).is_some(), "from the side");
        assert_eq!(edge_on_hint(&session, &projection(DVec3::new(0.0, -6.0, 5.0))), None, "from above");
    }

    #[test]
    fn the_chosen_corner_is_forgotten_with_its_light() {
        let mut session = square();
        session.chosen_corner = Some(Corner { light: 0, vertex: 2 });
        assert!(session.corner().is_some(), "chosen");
        session.selection.clear();
        assert_eq!(session.corner(), None, "its light is not selected");
    }
}
