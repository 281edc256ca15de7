//! What lies over the panes: the question about unsaved work, the list of keys, and messages.

use std::time::{Duration, Instant};

use egui::{Align2, Id, Key, Modal, RichText, Ui, vec2};

use crate::editor::commands::Command;
use crate::editor::session::{Notice, Session};
use crate::editor::theme;

/// How long a message that something worked is shown.
const DONE_SECONDS: u64 = 4;

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

/// The list of keys; whether it should close.
pub fn keys(ctx: &egui::Context, session: &Session) -> bool {
    let modal = Modal::new(Id::unique("keys")).show(ctx, |ui| {
        ui.set_width(420.0);
        ui.heading("Keys");
        ui.add_space(6.0);
        ui.columns(2, |columns| {
            let half = Command::KEYED.len().div_ceil(2);
            for (column, commands) in columns.iter_mut().zip(Command::KEYED.chunks(half)) {
                key_table(column, session, commands);
            }
        });
        ui.add_space(6.0);
        ui.label(RichText::new("In the view").strong());
        for (gesture, does) in [
            ("Alt + left drag, middle drag", "orbit"),
            ("Shift + middle drag", "pan"),
            ("Wheel", "zoom"),
            ("Ctrl, Shift while dragging", "snap, drag fine"),
            ("1.5, Enter while dragging", "set the amount"),
            ("Enter, double-click, first vertex", "close the polygon"),
            ("Backspace, Esc", "take a vertex back, cancel"),
        ] {
            ui.horizontal(|ui| {
                ui.monospace(gesture);
                ui.weak(does);
            });
        }
        ui.add_space(8.0);
        ui.button("Close").clicked()
    });
    modal.inner || modal.should_close()
}

fn key_table(ui: &mut Ui, session: &Session, commands: &[Command]) {
    for command in commands {
        let Some(shortcut) = command.shortcut() else { continue };
        ui.horizontal(|ui| {
            let text = ui.ctx().format_shortcut(&shortcut);
            ui.add_sized(vec2(84.0, 18.0), egui::Label::new(RichText::new(text).monospace()));
            ui.label(command.label(session));
        });
    }
}

/// Messages on show.
#[derive(Debug, Default)]
pub struct Messages {
    shown: Vec<(Notice, Instant)>,
}

impl Messages {
    /// Take the session's new messages and show all that are due; what went wrong stays until dismissed.
    pub fn show(&mut self, ctx: &egui::Context, session: &mut Session) {
        let now = Instant::now();
        self.shown.extend(session.notices.drain(..).map(|notice| (notice, now)));
        let left = |since: Instant| Duration::from_secs(DONE_SECONDS).checked_sub(now.duration_since(since));
        self.shown.retain(|(notice, since)| matches!(notice, Notice::Failed(_)) || left(*since).is_some());
        if let Some(next) =
            self.shown.iter().filter(|(n, _)| matches!(n, Notice::Done(_))).filter_map(|(_, s)| left(*s)).min()
        {
            ctx.request_repaint_after(next);
        }
        if self.shown.is_empty() {
            return;
        }
        let mut dismissed = None;
        egui::Area::new(Id::unique("messages")).anchor(Align2::RIGHT_BOTTOM, vec2(-12.0, -36.0)).show(ctx, |ui| {
            for (index, (notice, _)) in self.shown.iter().enumerate() {
                if message(ui, index, notice) {
                    dismissed = Some(index);
                }
            }
        });
        // Esc dismisses the latest.
        if dismissed.is_none() && ctx.input(|input| input.key_pressed(Key::Escape)) {
            dismissed = self.shown.len().checked_sub(1);
        }
        if let Some(index) = dismissed {
            self.shown.remove(index);
            ctx.request_repaint();
        }
    }
}

/// One message; whether it was dismissed.
fn message(ui: &mut Ui, index: usize, notice: &Notice) -> bool {
    use egui_material_icons::icons::{ICON_CHECK_CIRCLE, ICON_CLOSE, ICON_ERROR};
    let (icon, color, text) = match notice {
        Notice::Done(text) => (ICON_CHECK_CIRCLE, theme::accent(ui.visuals()), text),
        Notice::Failed(text) => (ICON_ERROR, ui.visuals().error_fg_color, text),
    };
    egui::Frame::popup(ui.style())
        .inner_margin(8)
        .show(ui, |ui| {
            ui.set_max_width(460.0);
            ui.horizontal(|ui| {
                ui.label(icon.rich_text().color(color).size(17.0));
                ui.vertical(|ui| {
                    ui.set_max_width(400.0);
                    ui.label(text);
                });
                let close = egui::Button::new(ICON_CLOSE.rich_text()).frame(false);
                ui.add(close).accessible_name(format!("Dismiss message {}", index + 1)).clicked()
            })
            .inner
        })
        .inner
}
