//! The bar of what drawing tools are set to: the work plane, what is made, and what drawing sticks to.

use egui::{ComboBox, DragValue, Response, TextEdit, Ui};
use egui_material_icons::icons;

use super::outline::{Outline, OutlineKind};
use super::work_plane::PlaneKind;
use crate::editor::panes::icon_button;
use crate::editor::session::{Session, Tool};
use crate::editor::theme;

/// Where planes may lie, metres.
const REACH: std::ops::RangeInclusive<f64> = -1000.0..=1000.0;
/// A list of all kinds fits without scrolling, points.
const ALL_KINDS: f32 = 300.0;

/// Show what the tool in hand can be set to; what drawing and dragging stick to is shown always.
pub fn show(ui: &mut Ui, session: &mut Session) {
    if session.tool.draws() {
        plane(ui, session);
        ui.separator();
        if session.tool == Tool::Outline {
            outline(ui, &mut session.outline);
            ui.separator();
        }
    }
    snaps(ui, session);
}

/// Which plane, where it is, and to which side lights on it shine.
fn plane(ui: &mut Ui, session: &mut Session) {
    let mut kind = session.work_plane.kind;
    let combo = ComboBox::from_id_salt("work plane").selected_text(kind.name()).width(96.0).height(ALL_KINDS);
    let response = combo.show_ui(ui, |ui| {
        for other in PlaneKind::ALL {
            ui.selectable_value(&mut kind, other, other.name()).on_hover_text(other.hint());
        }
    });
    named(response.response, "Work plane", "The plane on which lights are drawn  (Q)");
    if kind != session.work_plane.kind {
        session.work_plane.choose(kind, &session.view.camera);
    }
    let plane = &mut session.work_plane;
    match plane.kind {
        PlaneKind::Level => metres(ui, &mut plane.height, "Work plane height", "Height above the ground, m"),
        PlaneKind::Front => metres(ui, &mut plane.y, "Work plane Y", "Where the plane is along Y, m"),
        PlaneKind::Side => metres(ui, &mut plane.x, "Work plane X", "Where the plane is along X, m"),
        PlaneKind::Facing => {
            let angle = DragValue::new(&mut plane.azimuth_deg).speed(0.5).range(-180.0..=180.0).suffix("°");
            named(ui.add(angle), "Work plane direction", "Where the plane faces, degrees from X to Y");
            let hint = "How far the plane is from the world’s origin, the way it faces, m";
            metres(ui, &mut plane.offset, "Work plane offset", hint);
        }
        PlaneKind::Surface => metres(ui, &mut plane.gap, "Work plane gap", "How far off the surface, m"),
    }
    let hint = "Lights shine to the other side of the plane";
    toggle(ui, icons::ICON_FLIP, &mut plane.flip, "Flip lit side", hint);
}

/// What the outline tool makes.
fn outline(ui: &mut Ui, outline: &mut Outline) {
    let combo = ComboBox::from_id_salt("outline").selected_text(outline.kind.name()).width(112.0).height(ALL_KINDS);
    let response = combo.show_ui(ui, |ui| {
        for kind in OutlineKind::ALL {
            ui.selectable_value(&mut outline.kind, kind, kind.name()).on_hover_text(kind.hint());
        }
    });
    named(response.response, "Outline", outline.kind.hint());
    match outline.kind {
        OutlineKind::Rectangle | OutlineKind::Disk => {}
        OutlineKind::Regular => count(ui, &mut outline.sides, 3, "sides", "Sides"),
        OutlineKind::Circle => count(ui, &mut outline.segments, 8, "sides", "Sides of the circle"),
        OutlineKind::Star => {
            count(ui, &mut outline.points, 3, "points", "Points of the star");
            share(ui, &mut outline.inner, "inner", "Inner radius", "Inner radius, % of the outer");
        }
        OutlineKind::Ell | OutlineKind::Tee => {
            share(ui, &mut outline.stroke, "stroke", "Stroke width", "Width of the strokes, % of the shorter side");
        }
        OutlineKind::Letter => letter(ui, &mut outline.letter),
    }
}

/// What drawing and dragging stick to.
fn snaps(ui: &mut Ui, session: &mut Session) {
    let draws = session.tool.draws();
    let plane = &mut session.work_plane;
    toggle(ui, icons::ICON_GRID_ON, &mut plane.snap, "Snap to grid", "G; Ctrl switches it while drawing");
    let grid = DragValue::new(&mut plane.grid).speed(0.005).range(0.001..=10.0).suffix(" m");
    named(ui.add_enabled(plane.snap || !draws, grid), "Grid spacing", "Grid spacing, m");
    if draws {
        let hint = "Snap to corners of lights and surfaces";
        toggle(ui, icons::ICON_POINT_SCAN, &mut plane.to_corners, "Snap to corners", hint);
    }
}

fn named(response: Response, name: &str, hint: &str) {
    response.on_hover_text(hint).accessible_name(name);
}

fn metres(ui: &mut Ui, value: &mut f64, name: &str, hint: &str) {
    named(ui.add(DragValue::new(value).speed(0.01).range(REACH).suffix(" m")), name, hint);
}

fn count(ui: &mut Ui, value: &mut u32, least: u32, unit: &str, name: &str) {
    let number = DragValue::new(value).speed(0.05).range(least..=128).suffix(format!(" {unit}"));
    named(ui.add(number), name, name);
}

fn share(ui: &mut Ui, value: &mut f64, unit: &str, name: &str, hint: &str) {
    let mut percent = 100.0 * *value;
    let number = DragValue::new(&mut percent).speed(0.2).range(5.0..=95.0).fixed_decimals(0);
    let response = ui.add(number.prefix(format!("{unit} ")).suffix(" %"));
    if response.changed() {
        *value = percent / 100.0;
    }
    named(response, name, hint);
}

/// One character: what is typed takes the place of what was there.
fn letter(ui: &mut Ui, letter: &mut char) {
    let mut text = letter.to_string();
    let response = ui.add(TextEdit::singleline(&mut text).desired_width(22.0));
    if let Some(typed) = text.chars().rev().find(|c| c.is_alphanumeric() && c != letter).filter(|_| response.changed())
    {
        *letter = typed.to_uppercase().next().unwrap_or(typed);
    }
    named(response, "Letter", "Which letter or digit");
}

fn toggle(ui: &mut Ui, icon: egui_material_icons::MaterialIcon, on: &mut bool, name: &str, hint: &str) {
    let color = if *on { theme::accent(ui.visuals()) } else { ui.visuals().weak_text_color() };
    if icon_button(ui, icon, color, name).on_hover_text(hint).clicked() {
        *on ^= true;
    }
}
