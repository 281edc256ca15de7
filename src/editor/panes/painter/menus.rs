//! The menus above the canvas: a new one, presets, and what changes all of it.

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{DragValue, PopupCloseBehavior, Ui};

use super::sheet::Sheet;
use crate::light::pattern::paint::{Canvas, Preset, adjust};

/// Resolutions of the longer side that are offered.
const SIDES: [usize; 5] = [64, 128, 256, 512, 1024];

/// What is chosen in the menus.
#[derive(Debug)]
pub(super) struct Menus {
    /// Texels of a new canvas's longer side.
    side: usize,
    /// A new canvas's value.
    value: f32,
    preset: Preset,
    /// The preset's numbers.
    numbers: Vec<f64>,
    /// What the sheet was last shown.
    proposed: Option<(Preset, Vec<f64>)>,
    /// Standard deviation of the blur, texels.
    blur: f64,
    brightness: f32,
}

/// What a menu has done to the sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Done {
    /// It shows something that may still be given up.
    Proposed,
    /// It is to be kept; what the undo step is called.
    Kept(&'static str),
    /// It is given up.
    GivenUp,
}

impl Default for Menus {
    fn default() -> Self {
        let preset = Preset::default();
        let numbers = defaults(preset);
        Self { side: 256, value: 0.0, preset, numbers, proposed: None, blur: 4.0, brightness: 0.5 }
    }
}

fn defaults(preset: Preset) -> Vec<f64> {
    preset.parameters().iter().map(|parameter| parameter.default).collect()
}

impl Menus {
    /// Show the menus of a sheet for a light whose width is `aspect` times its height; what was done, if anything.
    pub(super) fn show(&mut self, ui: &mut Ui, sheet: &mut Sheet, aspect: f64) -> Option<Done> {
        let mut done = None;
        menu(ui, "New", "Start from an even canvas, or change the resolution", |ui| {
            self.new_menu(ui, sheet, aspect, &mut done);
        });
        let open = menu(ui, "Presets", "Window, leaves, ring, checker, stripes, gradient, softbox falloff", |ui| {
            self.preset_menu(ui, sheet, aspect, &mut done);
        });
        if !open && sheet.is_proposed() && done.is_none() {
            done = Some(Done::GivenUp);
        }
        menu(ui, "Adjust", "Blur, invert, mirror, rotate, brightness", |ui| self.adjust_menu(ui, sheet, &mut done));
        done
    }

    fn new_menu(&mut self, ui: &mut Ui, sheet: &mut Sheet, aspect: f64, done: &mut Option<Done>) {
        ui.weak("Texels of the longer side");
        ui.horizontal(|ui| {
            for side in SIDES {
                let response = ui.selectable_label(self.side == side, side.to_string());
                if response.on_hover_text("The shorter side follows from the light’s").clicked() {
                    self.side = side;
                }
            }
        });
        ui.horizontal(|ui| {
            ui.weak("Value");
            let value = DragValue::new(&mut self.value).speed(0.01).range(0.0..=1.0);
            ui.add(value)
                .on_hover_text("Of every texel; 0 is black, 1 the light’s full luminance")
                .accessible_name("New pattern value");
        });
        let size = size_of(self.side, aspect);
        ui.separator();
        if ui.button(format!("New {} × {}", size[0], size[1])).on_hover_text("Replaces the pattern").clicked() {
            sheet.propose(Canvas::filled(size, [self.value; 3]));
            *done = Some(Done::Kept("New pattern"));
            ui.close();
        }
        let resize = ui.button(format!("Resize to {} × {}", size[0], size[1]));
        if resize.on_hover_text("The same picture in other texels; the light’s flux stays").clicked() {
            sheet.propose(adjust::resized(sheet.base(), size));
            *done = Some(Done::Kept("Resize pattern"));
            ui.close();
        }
    }

    fn preset_menu(&mut self, ui: &mut Ui, sheet: &mut Sheet, aspect: f64, done: &mut Option<Done>) {
        ui.horizontal(|ui| {
            ui.vertical(|ui| {
                for preset in Preset::ALL {
                    if ui.selectable_label(self.preset == preset, preset.name()).clicked() {
                        (self.preset, self.numbers) = (preset, defaults(preset));
                    }
                }
            });
            ui.separator();
            ui.vertical(|ui| {
                ui.set_min_width(170.0);
                egui::Grid::new("preset numbers").num_columns(2).show(ui, |ui| {
                    for (parameter, number) in self.preset.parameters().iter().zip(&mut self.numbers) {
                        ui.weak(parameter.name);
                        let (low, high) = (*parameter.range.start(), *parameter.range.end());
                        let speed = if parameter.whole { 0.1 } else { (high - low) / 300.0 };
                        let decimals = if parameter.whole { 0 } else { 3 };
                        let drag = DragValue::new(number)
                            .range(low..=high)
                            .speed(speed)
                            .max_decimals(decimals)
                            .suffix(parameter.unit);
                        ui.add(drag).accessible_name(format!("Preset {}", parameter.name.to_lowercase()));
                        ui.end_row();
                    }
                });
                ui.add_space(6.0);
                if ui.button("Use preset").on_hover_text("Replaces the pattern; Esc gives it up").clicked() {
                    *done = Some(Done::Kept(self.step()));
                    ui.close();
                }
            });
        });
        let wanted = Some((self.preset, self.numbers.clone()));
        if !sheet.is_proposed() || self.proposed != wanted {
            sheet.propose(self.preset.canvas(sheet.base().size(), aspect, &self.numbers));
            self.proposed = wanted;
            done.get_or_insert(Done::Proposed);
        }
    }

    /// Label of the undo step of the preset.
    fn step(&self) -> &'static str {
        match self.preset {
            Preset::Window => "Window pattern",
            Preset::Leaves => "Leaves pattern",
            Preset::Ring => "Ring pattern",
            Preset::Checker => "Checker pattern",
            Preset::Stripes => "Stripes pattern",
            Preset::Gradient => "Gradient pattern",
            Preset::Softbox => "Softbox pattern",
        }
    }

    fn adjust_menu(&mut self, ui: &mut Ui, sheet: &mut Sheet, done: &mut Option<Done>) {
        let mut apply = |sheet: &mut Sheet, canvas: Canvas, step: &'static str| {
            sheet.propose(canvas);
            *done = Some(Done::Kept(step));
        };
        if ui.button("Invert").on_hover_text("1 less each value").clicked() {
            apply(sheet, adjust::inverted(sheet.base()), "Invert pattern");
        }
        if ui.button("Mirror left–right").clicked() {
            apply(sheet, adjust::mirrored(sheet.base()), "Mirror pattern");
        }
        if ui.button("Mirror top–bottom").clicked() {
            apply(sheet, adjust::flipped(sheet.base()), "Mirror pattern");
        }
        if ui.button("Rotate 90°").on_hover_text("Clockwise; the light keeps its sides").clicked() {
            apply(sheet, adjust::turned(sheet.base()), "Rotate pattern");
        }
        ui.separator();
        ui.horizontal(|ui| {
            if ui.button("Blur").on_hover_text("The mean stays").clicked() {
                apply(sheet, adjust::blurred(sheet.base(), self.blur), "Blur pattern");
            }
            let blur = DragValue::new(&mut self.blur).speed(0.1).range(0.1..=256.0).max_decimals(2).suffix(" tx");
            ui.add(blur).on_hover_text("Standard deviation in texels").accessible_name("Blur radius");
        });
        ui.horizontal(|ui| {
            if ui.button("Brightness").on_hover_text("Each value times a factor").clicked() {
                apply(sheet, adjust::scaled(sheet.base(), self.brightness), "Change pattern brightness");
            }
            let factor = DragValue::new(&mut self.brightness).speed(0.01).range(0.01..=100.0).prefix("× ");
            ui.add(factor).on_hover_text("Factor").accessible_name("Brightness factor");
        });
    }
}

/// A menu that stays open while it is used; whether it is.
fn menu(ui: &mut Ui, label: &str, hint: &str, contents: impl FnOnce(&mut Ui)) -> bool {
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (response, inner) = MenuButton::new(label).config(config).ui(ui, contents);
    response.on_hover_text(hint).accessible_name(format!("{label} pattern"));
    inner.is_some()
}

/// Columns and rows for a light of that proportion, with square texels as nearly as that goes.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at least 1 and at most the side")]
fn size_of(side: usize, aspect: f64) -> [usize; 2] {
    let shorter = |ratio: f64| ((side as f64 * ratio).round() as usize).max(1);
    if aspect >= 1.0 { [side, shorter(aspect.recip())] } else { [shorter(aspect), side] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_are_as_square_as_they_can_be() {
        for (aspect, size) in [(1.0, [256, 256]), (2.0, [256, 128]), (0.6, [154, 256]), (1e4, [256, 1])] {
            assert_eq!(size_of(256, aspect), size, "{aspect} to 1");
        }
    }
}
