//! The list of keys, and of what the mouse does.

use egui::{Id, Modal, RichText, Ui, vec2};

use crate::editor::commands::{Category, Command};
use crate::editor::session::Session;

/// What keys and mouse do where no command says it, by place.
const GESTURES: &[(&str, &[(&str, &str)])] = &[
    (
        "In the view",
        &[
            ("Alt + left drag, middle drag", "Orbit"),
            ("Shift + middle drag", "Pan"),
            ("Wheel", "Zoom towards the pointer"),
            ("Click, Shift + click", "Select, add to the selection"),
            ("Right click", "What can be done here"),
            ("Double click on a light", "Bring it into view"),
        ],
    ),
    (
        "While dragging",
        &[
            ("Ctrl", "Snap to the grid, or not"),
            ("Shift", "Move in fine steps"),
            ("1.5, Enter", "Set the amount"),
            ("Esc", "Take the drag back"),
        ],
    ),
    (
        "While drawing",
        &[
            ("Enter, double click, first corner", "Close the polygon"),
            ("Backspace", "Take a corner back"),
            ("Digits", "Type the length, Tab for the angle"),
            ("Esc", "Cancel"),
        ],
    ),
    (
        "In the library",
        &[("Double click, Enter", "Insert a light, open a scene"), ("Drag into the view", "Insert a light there")],
    ),
    (
        "In numbers",
        &[("Drag", "Change"), ("Shift + drag", "Change in fine steps"), ("Double click, Enter", "Type a number")],
    ),
];

/// The list of all keys, and what is searched in it.
#[derive(Debug, Default)]
pub struct Keys {
    query: String,
    focused: bool,
}

impl Keys {
    /// Show the list; whether it should close.
    pub fn show(&mut self, ctx: &egui::Context, session: &Session) -> bool {
        let modal = Modal::new(Id::unique("keys")).show(ctx, |ui| {
            ui.set_width(520.0);
            ui.horizontal(|ui| {
                ui.heading("Keys");
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    let field = egui::TextEdit::singleline(&mut self.query).hint_text("Search").desired_width(200.0);
                    let field = ui.add(field).accessible_name("Search keys");
                    if !std::mem::replace(&mut self.focused, true) {
                        field.request_focus();
                    }
                });
            });
            ui.separator();
            egui::ScrollArea::vertical()
                .max_height(440.0)
                .auto_shrink([false, true])
                .show(ui, |ui| self.list(ui, session));
            ui.separator();
            ui.button("Close").clicked()
        });
        modal.inner || modal.should_close()
    }

    fn list(&self, ui: &mut Ui, session: &Session) {
        let mut found = false;
        for category in Category::ALL {
            let commands = Command::KEYED.iter().filter(|command| command.category() == category);
            let rows = commands.filter_map(|command| {
                let key = ui.ctx().format_shortcut(&command.shortcut()?);
                Some((key, command.label(session)))
            });
            found |= self.section(ui, category.label(), rows.collect());
        }
        for (heading, gestures) in GESTURES {
            let rows = gestures.iter().map(|(gesture, does)| ((*gesture).to_owned(), (*does).to_owned()));
            found |= self.section(ui, heading, rows.collect());
        }
        if !found {
            ui.weak("No key does that.");
        }
    }

    /// The rows under a heading that the search leaves; whether there are any.
    fn section(&self, ui: &mut Ui, heading: &str, rows: Vec<(String, String)>) -> bool {
        let query = self.query.to_lowercase();
        let fits = |(key, does): &(String, String)| {
            let text = format!("{heading} {key} {does}").to_lowercase();
            query.split_whitespace().all(|word| text.contains(word))
        };
        let rows: Vec<_> = rows.into_iter().filter(fits).collect();
        if rows.is_empty() {
            return false;
        }
        ui.add_space(6.0);
        ui.label(RichText::new(heading).strong());
        egui::Grid::new(heading).num_columns(2).min_col_width(210.0).spacing(vec2(12.0, 3.0)).show(ui, |ui| {
            for (key, does) in rows {
                ui.label(RichText::new(key).monospace());
                ui.label(does);
                ui.end_row();
            }
        });
        true
    }
}
