//! A light's row: name, quantity and unit, colour, links, solo, mute.

use std::cell::Cell;

use egui::containers::menu::{MenuButton, MenuConfig, SubMenuButton};
use egui::{Button, DragValue, Popup, PopupCloseBehavior, Rect, RichText, Sense, Stroke, Ui, Visuals, vec2};
use egui_material_icons::icons;

use super::{Ask, Drag, How, INDENT, Named, Outliner, ROW, clicks, display_color, hover_text, icon};
use crate::editor::commands::{Command, ListCommand};
use crate::editor::light_list::{scale_emission, set_emission};
use crate::editor::panes::look::quantity_name;
use crate::editor::panes::{icon_button, inspector, links};
use crate::editor::session::{Item, Session};
use crate::editor::theme;
use crate::editor::units::{self, Unit};
use crate::light::Light;

/// Width of a quantity's value and of its unit, points.
const AMOUNT: [f32; 2] = [56.0, 36.0];
/// Width of what stands behind a name beside the quantity, points.
const BUTTONS: f32 = 64.0;
/// A name has at least this room before the quantity is left out, points.
const LEAST_NAME: f32 = 56.0;

impl Outliner {
    /// The row of a light, and where it is.
    pub(super) fn light_row(&mut self, ui: &mut Ui, session: &mut Session, index: usize, asked: &mut Vec<Ask>) -> Rect {
        let scene = session.scene().clone();
        let Some(light) = scene.lights.get(index) else { return Rect::NOTHING };
        let item = Item::Light(index);
        let row = ui.push_id(item, |ui| {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0;
                ui.add_space(if light.group.is_some() { 4.0 + INDENT } else { 4.0 });
                icon(ui, &scene, item);
                ui.add_space(2.0);
                if self.name_field(ui, &Named::Item(item), asked) {
                    return;
                }
                let buttons = BUTTONS + if light.only.is_some() { 20.0 } else { 0.0 };
                let amount = AMOUNT[0] + AMOUNT[1] + 4.0;
                let has_amount = ui.available_width() - buttons - amount >= LEAST_NAME;
                let width = ui.available_width() - buttons - if has_amount { amount } else { 0.0 };
                name(ui, session, index, width, asked);
                if has_amount {
                    self.amount(ui, session, index, light);
                    unit(ui, session, index, light);
                }
                self.swatch(ui, session, index, light);
                if light.only.is_some() {
                    link(ui, session, index, light);
                }
                buttons_of(ui, session, &light.name, &session.lights_with(index), light.muted, asked);
            })
        });
        row.inner.response.rect
    }

    /// The quantity, to drag or type; with others selected, a drag scales them too, and a number goes to all.
    fn amount(&mut self, ui: &mut Ui, session: &mut Session, index: usize, light: &Light) {
        let (kind, value) = (light.quantity.kind(), light.quantity.value());
        let typed: Cell<Option<(Unit, f64)>> = Cell::default();
        let mut edited = value;
        let drag = DragValue::new(&mut edited)
            .speed((0.01 * value.abs()).max(0.01))
            .range(0.0..=1e12)
            .clamp_existing_to_range(false)
            .custom_formatter(|value, _| short(value))
            .custom_parser(|text| {
                let (number, unit) = units::parse(text)?;
                let unit = unit.unwrap_or(Unit::Of(kind));
                let value = units::stated(light, unit, number)?.in_quantity(kind)?;
                typed.set(Some((unit, number.max(0.0))));
                Some(value)
            })
            .update_while_editing(false);
        let name = format!("{} of {}", quantity_name(kind), light.name);
        let unit = kind.unit();
        let hint =
            format!("{} in {unit}: drag, or click and type; 800 lm or 120 lx at 1 m do too", quantity_name(kind));
        let response = ui.add_sized(vec2(AMOUNT[0], ROW - 2.0), drag).on_hover_text(hint).accessible_name(name);
        let drags = response.dragged();
        if !drags && short(edited) == short(value) {
            // A click in and out of the field keeps the digits that it does not show.
            return;
        }
        let lights = session.lights_with(index);
        self.gesture.apply(session, &response, "Change emission", |scene| {
            if drags && value > 0.0 {
                scale_emission(scene, &lights, edited / value);
            } else {
                let (unit, number) = typed.get().unwrap_or((Unit::Of(kind), edited));
                set_emission(scene, &lights, unit, number);
            }
        });
    }

    /// The light's colour, and a popup to change it.
    fn swatch(&mut self, ui: &mut Ui, session: &mut Session, index: usize, light: &Light) {
        let (rect, response) = ui.allocate_exact_size(vec2(16.0, ROW), Sense::click());
        let edge = if response.hovered() { ui.visuals().strong_text_color() } else { ui.visuals().weak_text_color() };
        ui.painter().circle(rect.center(), 6.0, display_color(light.tint.rgb()), Stroke::new(1.0, edge));
        let name = format!("Tint of {}", light.name);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, &name));
        let response = response.on_hover_text("Colour or temperature");
        let popup = Popup::from_toggle_button_response(&response);
        popup.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
            let lights = session.lights_with(index);
            inspector::tint_popup(ui, session, &mut self.gesture, &lights);
        });
    }
}

/// The name: click selects, a double click renames, a drag moves.
fn name(ui: &mut Ui, session: &mut Session, index: usize, width: f32, asked: &mut Vec<Ask>) {
    let scene = session.scene().clone();
    let (item, light) = (Item::Light(index), &scene.lights[index]);
    let text = RichText::new(&light.name);
    let text = if is_dimmed(session, light) { text.weak() } else { text };
    let label = Button::selectable(session.selection.contains(item), text).truncate().right_text("");
    let label = label.min_size(vec2(width, ROW)).sense(Sense::click_and_drag());
    let response = ui.add_sized(vec2(width, ROW), label).on_hover_text(hover_text(&scene, item));
    let response = response.accessible_name(&light.name);
    clicks(ui, &response, item, asked);
    if response.drag_started() {
        asked.push(Ask::Drag(Drag { lights: session.lights_with(index), group: None }));
    }
    if response.hovered() {
        "Click selects, Shift a range, Ctrl one more; drag, or Alt and an arrow key, moves"
            .clone_into(&mut session.hint);
    }
    response.context_menu(|ui| menu(ui, session, index, asked));
}

/// The unit, and a menu of the other ones that the shape has.
fn unit(ui: &mut Ui, session: &mut Session, index: usize, light: &Light) {
    let text = RichText::new(light.quantity.kind().unit()).small();
    let size = vec2(AMOUNT[1], ROW - 2.0);
    let kinds = light.shape.quantity_kinds();
    if kinds.len() < 2 {
        ui.add_sized(size, egui::Label::new(text.weak()).selectable(false));
        return;
    }
    let button = Button::new(text).frame(false).min_size(size);
    let (response, _) = MenuButton::from_button(button).ui(ui, |ui| {
        for kind in kinds {
            let text = format!("{} ({})", quantity_name(*kind), kind.unit());
            let entry = ui.selectable_label(*kind == light.quantity.kind(), text);
            if entry.on_hover_text("The same light in this unit; it stays when the light is resized").clicked() {
                let lights = session.lights_with(index);
                session.edit_lights("Change unit", &lights, |light| {
                    if light.shape.quantity_kinds().contains(kind) {
                        light.restate(*kind);
                    }
                });
                ui.close();
            }
        }
    });
    response.on_hover_text("Unit").accessible_name(format!("Unit of {}", light.name));
}

/// Which surfaces a light is linked to.
fn link(ui: &mut Ui, session: &mut Session, index: usize, light: &Light) {
    let text = links::text(session.scene(), &[index]);
    let color = theme::accent(ui.visuals());
    let button = Button::new(icons::ICON_LINK.rich_text().size(14.0).color(color)).frame(false);
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let lights = session.lights_with(index);
    let button = MenuButton::from_button(button.min_size(vec2(18.0, ROW))).config(config);
    let (response, _) = button.ui(ui, |ui| links::boxes(ui, session, &lights));
    response.on_hover_text(format!("Lights {text}")).accessible_name(format!("Links of {}", light.name));
}

/// Solo and mute of lights that are called `name` together.
pub(super) fn buttons_of(
    ui: &mut Ui,
    session: &Session,
    name: &str,
    lights: &[usize],
    muted: bool,
    asked: &mut Vec<Ask>,
) {
    let scene = session.scene();
    let solo = lights.iter().filter_map(|i| scene.lights.get(*i)).all(|light| session.is_solo(&light.name));
    let Colors { accent, weak, text } = Colors::of(ui.visuals());
    let solo_color = if solo { accent } else { weak };
    if icon_button(ui, icons::ICON_HEADPHONES, solo_color, &format!("Solo {name}")).clicked() {
        asked.push(Ask::Solo(lights.to_vec()));
    }
    let (icon, verb, color) =
        if muted { (icons::ICON_VISIBILITY_OFF, "Unmute", weak) } else { (icons::ICON_VISIBILITY, "Mute", text) };
    if icon_button(ui, icon, color, &format!("{verb} {name}")).clicked() {
        asked.push(Ask::Mute(lights.to_vec(), !muted));
    }
}

struct Colors {
    accent: egui::Color32,
    weak: egui::Color32,
    text: egui::Color32,
}

impl Colors {
    fn of(visuals: &Visuals) -> Self {
        Self { accent: theme::accent(visuals), weak: visuals.weak_text_color(), text: visuals.text_color() }
    }
}

fn menu(ui: &mut Ui, session: &mut Session, index: usize, asked: &mut Vec<Ask>) {
    let item = Item::Light(index);
    super::context_menu(ui, session, item, asked);
    ui.separator();
    let lights = session.lights_with(index);
    let muted = session.scene().lights.get(index).is_some_and(|light| light.muted);
    if ui.button(if muted { "Unmute" } else { "Mute" }).clicked() {
        asked.push(Ask::Mute(lights.clone(), !muted));
    }
    if ui.button("Solo").clicked() {
        asked.push(Ask::Solo(lights.clone()));
    }
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    SubMenuButton::new("Lights only").config(config).ui(ui, |ui| links::boxes(ui, session, &lights));
    ui.separator();
    for command in [ListCommand::Group, ListCommand::Ungroup].map(Command::List) {
        if ui.button(command.label(session)).clicked() {
            if !session.selection.contains(item) {
                asked.push(Ask::Select(vec![item], How::Only));
            }
            asked.push(Ask::Command(command));
        }
    }
}

/// Whether a light does not contribute to what is shown.
fn is_dimmed(session: &Session, light: &Light) -> bool {
    light.muted || (session.has_solo() && !session.is_solo(&light.name))
}

/// A number in four significant digits, whole from 1000 on.
fn short(value: f64) -> String {
    let digits = match value.abs() {
        v if v >= 1e6 => return format!("{value:.3e}"),
        v if v >= 1000.0 => 0,
        v if v >= 100.0 => 1,
        v if v >= 10.0 => 2,
        _ => 3,
    };
    let text = format!("{value:.digits$}");
    if digits > 0 { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_are_short_and_have_four_digits() {
        for (value, text) in [(1000.0, "1000"), (0.1254, "0.125"), (12.3456, "12.35"), (800.0, "800"), (0.0, "0")] {
            assert_eq!(short(value), text, "{value}");
        }
        assert_eq!(short(1.6e9), "1.600e9", "the sun");
    }
}
