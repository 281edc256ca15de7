//! What lies over the panes: the questions about unsaved work, and what to try first.

use egui::{Align2, Color32, Id, Modal, RichText, vec2};

use crate::editor::recovery::{Offer, age};

/// The answer to the question about unsaved work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Save, then go on.
    Save,
    /// Go on without saving.
    Discard,
    /// Stay.
    Cancel,
}

/// Ask what to do with unsaved work; the answer, once there is one.
pub fn ask_unsaved(ctx: &egui::Context, title: &str) -> Option<Choice> {
    let modal = Modal::new(Id::unique("unsaved")).show(ctx, |ui| {
        ui.set_width(340.0);
        ui.heading(format!("Save changes to “{title}”?"));
        ui.add_space(4.0);
        ui.label("Your changes will be lost if you don’t save them.");
        ui.add_space(10.0);
        let mut choice = None;
        ui.horizontal(|ui| {
            let discard = ui.button("Discard").clicked();
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let save = egui::Button::new(RichText::new("Save").strong()).fill(ui.visuals().selection.bg_fill);
                choice = [(ui.add(save).clicked(), Choice::Save), (ui.button("Cancel").clicked(), Choice::Cancel)]
                    .into_iter()
                    .find_map(|(clicked, choice)| clicked.then_some(choice));
            });
            if discard {
                choice = Some(Choice::Discard);
            }
        });
        choice
    });
    if modal.should_close() { Some(Choice::Cancel) } else { modal.inner }
}

/// The answer to the question about work that was not saved when the program ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recover {
    /// Open it.
    Open,
    /// Delete it.
    Discard,
    /// Ask again at the next start.
    Later,
}

/// Ask what to do with work that was not saved; the answer, once there is one.
pub fn ask_recover(ctx: &egui::Context, offer: &Offer, thumbnail: Option<&egui::TextureHandle>) -> Option<Recover> {
    let modal = Modal::new(Id::unique("recover")).show(ctx, |ui| {
        ui.set_width(380.0);
        ui.heading(format!("Recover “{}”?", offer.title));
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            if let Some(texture) = thumbnail {
                ui.add(egui::Image::new((texture.id(), vec2(128.0, 80.0))).corner_radius(4));
            }
            ui.vertical(|ui| {
                ui.set_max_width(240.0);
                ui.label("Softbox was not closed properly. This is what was not saved then:");
                ui.weak(age(offer.time));
                if let Some(path) = &offer.path {
                    ui.weak(path.display().to_string());
                }
            });
        });
        ui.add_space(10.0);
        let mut choice = None;
        ui.horizontal(|ui| {
            if ui.button("Discard work").on_hover_text("Delete what was not saved").clicked() {
                choice = Some(Recover::Discard);
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let recover = egui::Button::new(RichText::new("Recover").strong()).fill(ui.visuals().selection.bg_fill);
                if ui.add(recover).clicked() {
                    choice = Some(Recover::Open);
                }
                if ui.button("Ask later").clicked() {
                    choice = Some(Recover::Later);
                }
            });
        });
        choice
    });
    if modal.should_close() { Some(Recover::Later) } else { modal.inner }
}

/// How much of the window's width the inspector has at first.
const INSPECTOR_SHARE: f32 = 0.24;

/// What to try first; whether it was dismissed.
pub fn first_steps(ctx: &egui::Context) -> bool {
    const STEPS: [(&str, &str); 4] = [
        ("Drag", "a corner of the window light: all curves below follow"),
        ("P", "draws another light, corner by corner"),
        ("Library", "below has lights and scenes: drag a light into the view"),
        ("F1", "shows all keys, Ctrl+P finds any command"),
    ];
    // Over the right of the view, where it hides no light.
    let from_right = INSPECTOR_SHARE * ctx.content_rect().width() + 16.0;
    let area = egui::Area::new(Id::unique("first steps")).anchor(Align2::RIGHT_TOP, vec2(-from_right, 128.0));
    area.show(ctx, |ui| {
        egui::Frame::popup(ui.style())
            .inner_margin(10)
            .show(ui, |ui| {
                ui.set_max_width(330.0);
                ui.label(RichText::new("Try").strong());
                egui::Grid::new("steps").num_columns(2).spacing(vec2(10.0, 3.0)).show(ui, |ui| {
                    for (what, does) in STEPS {
                        ui.label(RichText::new(what).monospace().strong());
                        ui.label(does);
                        ui.end_row();
                    }
                });
                ui.button("Got it").on_hover_text("Do not show this again").clicked()
            })
            .inner
    })
    .inner
}

/// What a file held over the window would do when it is let go.
pub fn drop_hint(ctx: &egui::Context, text: &str) {
    let rect = ctx.content_rect();
    let painter = ctx.layer_painter(egui::LayerId::new(egui::Order::Foreground, Id::unique("drop")));
    painter.rect_filled(rect, 0.0, Color32::from_black_alpha(150));
    painter.text(rect.center(), Align2::CENTER_CENTER, text, egui::FontId::proportional(20.0), Color32::WHITE);
}
