//! One, two or four viewports in a pane, with dividers to drag between them.

use egui::{Color32, CursorIcon, Rect, Sense, Ui, WidgetInfo, pos2, vec2};

use crate::editor::session::Session;

/// Between two viewports, points.
const GAP: f32 = 3.0;
/// A divider stays this far from the pane's edges, as a share.
const MARGIN: f32 = 0.15;

/// Where the viewports are.
pub fn places(whole: Rect, count: usize, [x, y]: [f32; 2]) -> Vec<Rect> {
    let middle = whole.min + vec2(x, y) * whole.size();
    let gap = vec2(0.5 * GAP, 0.5 * GAP);
    let [before, after] = [middle - gap, middle + gap];
    let place = |x: [f32; 2], y: [f32; 2]| Rect::from_min_max(pos2(x[0], y[0]), pos2(x[1], y[1]));
    let (left, right) = ([whole.left(), before.x], [after.x, whole.right()]);
    let (upper, lower) = ([whole.top(), before.y], [after.y, whole.bottom()]);
    let full = [whole.top(), whole.bottom()];
    match count {
        2 => vec![place(left, full), place(right, full)],
        4 => vec![place(left, upper), place(right, upper), place(left, lower), place(right, lower)],
        _ => vec![whole],
    }
}

/// Let the dividers between viewports be dragged; a double click centres one.
pub fn dividers(ui: &mut Ui, whole: Rect, session: &mut Session) {
    let axes: &[usize] = match session.views.count() {
        2 => &[0],
        4 => &[0, 1],
        _ => &[],
    };
    for axis in axes {
        let share = session.views.dividers[*axis];
        let at = whole.min + share * whole.size();
        let (grip, cursor, name) = match axis {
            0 => {
                let size = vec2(3.0 * GAP, whole.height());
                (Rect::from_center_size(pos2(at.x, whole.center().y), size), CursorIcon::ResizeHorizontal, "columns")
            }
            _ => {
                let size = vec2(whole.width(), 3.0 * GAP);
                (Rect::from_center_size(pos2(whole.center().x, at.y), size), CursorIcon::ResizeVertical, "rows")
            }
        };
        let response = ui.interact(grip, ui.scope_id().with(("divider", axis)), Sense::click_and_drag());
        let response = response.on_hover_cursor(cursor);
        let label = format!("Divider of viewport {name}");
        response.widget_info(|| WidgetInfo::slider(true, f64::from(share), &label));
        if let Some(pos) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            let share = (pos - whole.min) / whole.size();
            session.views.dividers[*axis] = share[*axis].clamp(MARGIN, 1.0 - MARGIN);
        }
        if response.double_clicked() {
            session.views.dividers[*axis] = 0.5;
        }
        if response.hovered() || response.dragged() {
            ui.painter().rect_filled(grip.shrink2(vec2(GAP, GAP)), 0.0, Color32::from_white_alpha(60));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn viewports_share_the_pane_without_overlap() {
        let whole = Rect::from_min_max(pos2(10.0, 20.0), pos2(810.0, 620.0));
        assert_eq!(places(whole, 1, [0.5; 2]), [whole], "one has it all");
        for count in [2, 4] {
            let places = places(whole, count, [0.4, 0.6]);
            assert_eq!(places.len(), count, "as many as were asked for");
            let area: f32 = places.iter().map(|rect| rect.area()).sum();
            assert!(area > 0.98 * whole.area() && area < whole.area(), "{count} cover {area}: {places:?}");
            for (i, a) in places.iter().enumerate() {
                assert!(whole.contains_rect(*a), "{a} is inside");
                assert!(places[..i].iter().all(|b| !a.intersects(*b)), "{a} is apart from the others");
            }
        }
    }
}
