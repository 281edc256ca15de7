//! The divider between two methods beside each other.

use egui::{Align2, Color32, CursorIcon, Rect, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::overlay;
use crate::editor::session::Session;

/// The divider is taken hold of within this distance, points.
const REACH: f32 = 6.0;
/// It stays this far from the edges, as a share of the width.
const MARGIN: f64 = 0.02;

/// Show the divider and the names of both methods; a drag moves it.
pub fn show(ui: &mut Ui, rect: Rect, session: &mut Session, name: &str) {
    let width = f64::from(rect.width());
    let x = |share: f64| rect.left() + points(share * width);
    let grip = Rect::from_x_y_ranges(x(session.view.split) - REACH..=x(session.view.split) + REACH, rect.y_range());
    let response =
        ui.interact(grip, ui.scope_id().with("split"), Sense::drag()).on_hover_cursor(CursorIcon::ResizeHorizontal);
    response.widget_info(|| WidgetInfo::slider(true, session.view.split, format!("Split{name}")));
    if let Some(pos) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        let share = f64::from(pos.x - rect.left()) / width;
        session.view.split = share.clamp(MARGIN, 1.0 - MARGIN);
    }
    if response.hovered() || response.dragged() {
        "Drag to compare the two methods".clone_into(&mut session.hint);
    }
    let at = x(session.view.split);
    let painter = ui.painter_at(rect);
    painter.vline(at, rect.y_range(), Stroke::new(3.0, Color32::from_black_alpha(140)));
    painter.vline(at, rect.y_range(), Stroke::new(1.5, Color32::WHITE));
    let knob = pos2(at, rect.center().y);
    painter.circle(knob, 9.0, Color32::WHITE, Stroke::new(1.0, Color32::from_black_alpha(160)));
    for side in [-1.0, 1.0] {
        let tip = knob + vec2(6.0 * side, 0.0);
        let arrow = vec![tip, knob + vec2(2.0 * side, -3.5), knob + vec2(2.0 * side, 3.5)];
        painter.add(egui::Shape::convex_polygon(arrow, Color32::from_gray(0x40), Stroke::NONE));
    }
    let y = rect.top() + 46.0;
    let [left, right] = names(session);
    overlay::label(&left, pos2(at - 10.0, y), Align2::RIGHT_TOP, Color32::WHITE, &painter);
    overlay::label(&right, pos2(at + 10.0, y), Align2::LEFT_TOP, Color32::WHITE, &painter);
}

/// What is on the left and on the right: methods, or variants.
fn names(session: &Session) -> [String; 2] {
    let (view, scene) = (&session.view, session.scene());
    let variant = |index: usize| scene.variants.get(index).map(|variant| variant.name.clone());
    let Some(right) = view.against_variant.and_then(variant) else {
        return [view.method, view.against].map(|method| method.to_string());
    };
    [view.variant.and_then(variant).unwrap_or_else(|| "lights as they are".to_owned()), right]
}

#[expect(clippy::cast_possible_truncation, reason = "egui's screen coordinates are f32")]
fn points(x: f64) -> f32 {
    x as f32
}
