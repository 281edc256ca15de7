//! Colours to pick: bars of colours to drag along.

use egui::accesskit::Role;
use egui::ecolor::Hsva;
use egui::{Color32, Mesh, Popup, PopupCloseBehavior, Response, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2};
use glam::DVec3;

use super::look::plain_color;

/// Size of a bar, points.
const SIZE: [f32; 2] = [150.0, 14.0];
/// Width of a button that is a colour, points.
const BUTTON: f32 = 40.0;
/// Colours along a bar.
const STEPS: u16 = 32;
/// Below this saturation a colour has no hue to speak of.
const GREY: f32 = 1e-3;
/// The saturation that grey gets with a hue.
const PALE: f32 = 0.3;

/// A bar of colours to click or drag along; where that is, from 0 to 1.
pub(super) fn bar(ui: &mut Ui, name: &str, at: f64, mut color_at: impl FnMut(f64) -> Color32) -> (Response, f64) {
    let (rect, mut response) = ui.allocate_exact_size(SIZE.into(), Sense::click_and_drag());
    let mut mesh = Mesh::default();
    for i in 0..=STEPS {
        let share = f32::from(i) / f32::from(STEPS);
        let (x, color) = (egui::lerp(rect.x_range(), share), color_at(share.into()));
        mesh.colored_vertex(pos2(x, rect.top()), color);
        mesh.colored_vertex(pos2(x, rect.bottom()), color);
        if i > 0 {
            let first = 2 * u32::from(i) - 2;
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first + 1, first + 2, first + 3);
        }
    }
    let mut picked = at.clamp(0.0, 1.0);
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged() || response.clicked()) {
        picked = f64::from((pointer.x - rect.left()) / rect.width()).clamp(0.0, 1.0);
        response.mark_changed();
    }
    ui.painter().add(mesh);
    let edge = if response.hovered() { ui.visuals().strong_text_color() } else { ui.visuals().weak_text_color() };
    ui.painter().rect_stroke(rect, 2.0, Stroke::new(1.0, edge), StrokeKind::Outside);
    let x = egui::lerp(rect.x_range(), to_f32(picked));
    let mark = egui::Rect::from_center_size(pos2(x, rect.center().y), vec2(4.0, rect.height() + 4.0));
    ui.painter().rect(mark, 1.0, Color32::WHITE, Stroke::new(1.0, Color32::BLACK), StrokeKind::Outside);
    response.widget_info(|| WidgetInfo { value: Some(picked), ..WidgetInfo::labeled(Role::Slider, true, name) });
    (response, picked)
}

/// Bars for hue and saturation and, where it matters, brightness, of a colour in linear Rec. 709. One response for all.
pub(super) fn color(ui: &mut Ui, rgb: &mut DVec3, with_brightness: bool) -> Response {
    let key = ui.scope_id().with("hue");
    let mut hsv = Hsva::from_rgb(rgb.as_vec3().to_array());
    if hsv.s < GREY {
        // Grey has none: it was this before it became grey.
        hsv.h = ui.data(|data| data.get_temp(key)).unwrap_or(hsv.h);
    }
    let before = hsv;
    let parts: [(&str, Part, Hsva); 3] = [
        ("Hue", |hsv| &mut hsv.h, Hsva { s: 1.0, v: 1.0, ..hsv }),
        ("Saturation", |hsv| &mut hsv.s, Hsva { v: 1.0, ..hsv }),
        ("Value", |hsv| &mut hsv.v, hsv),
    ];
    let mut inner = ui.vertical(|ui| {
        for (name, part, mut shade) in parts.into_iter().take(if with_brightness { 3 } else { 2 }) {
            let at = f64::from(*part(&mut hsv));
            let (response, picked) = bar(ui, name, at, |share| {
                *part(&mut shade) = to_f32(share);
                plain_color(DVec3::from_array(shade.to_rgb().map(f64::from)))
            });
            if response.changed() {
                *part(&mut hsv) = to_f32(picked);
            }
            response.on_hover_text(name);
        }
    });
    if hsv != before {
        if hsv.h != before.h && hsv.s < GREY {
            hsv.s = PALE;
        }
        ui.data_mut(|data| data.insert_temp(key, hsv.h));
        *rgb = DVec3::from_array(hsv.to_rgb().map(f64::from));
        inner.response.mark_changed();
    }
    inner.response
}

/// A colour, and at a click the bars to change it. One response for all.
pub(super) fn color_button(ui: &mut Ui, name: &str, hint: &str, rgb: &mut DVec3) -> Response {
    let (rect, button) = ui.allocate_exact_size(vec2(BUTTON, ui.spacing().interact_size.y), Sense::click());
    let edge = ui.style().interact(&button).bg_stroke;
    ui.painter().rect(rect, 3.0, plain_color(*rgb), edge, StrokeKind::Inside);
    button.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    let button = button.on_hover_text(hint);
    let popup = Popup::from_toggle_button_response(&button).close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    popup.show(|ui| color(ui, rgb, true)).map_or(button, |shown| shown.inner)
}

/// One of the three numbers of a colour.
type Part = fn(&mut Hsva) -> &mut f32;

#[expect(clippy::cast_possible_truncation, reason = "a place on the screen")]
fn to_f32(share: f64) -> f32 {
    share as f32
}
