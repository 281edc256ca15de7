//! Messages: what happened, shown for a while in the corner of the window.

use std::time::{Duration, Instant};

use egui::{Align2, Id, Key, vec2};

use crate::editor::commands::Command;
use crate::editor::session::{Notice, Session};
use crate::editor::theme;

/// How long a message that something worked is shown.
const DONE_SECONDS: u64 = 4;
/// How long one is shown that can still be undone by its button.
const UNDO_SECONDS: u64 = 8;

/// Messages on show.
#[derive(Debug, Default)]
pub struct Messages {
    shown: Vec<Shown>,
}

/// A message, since when it is shown, and how many steps could be undone then.
#[derive(Debug)]
struct Shown {
    notice: Notice,
    since: Instant,
    steps: usize,
}

/// What was done with a message.
enum Act {
    Dismiss,
    Run(Command),
}

impl Shown {
    /// How much longer it is shown; none for what stays until it is dismissed.
    fn left(&self, now: Instant) -> Option<Duration> {
        let seconds = match self.notice {
            Notice::Done(_) => DONE_SECONDS,
            Notice::Undoable(_) => UNDO_SECONDS,
            Notice::Failed(_) | Notice::Unsaved(_) => return None,
        };
        Some(Duration::from_secs(seconds).saturating_sub(now.duration_since(self.since)))
    }

    /// Whether it has had its time, or its step is not the last one any more.
    fn is_over(&self, now: Instant, steps: usize) -> bool {
        self.left(now).is_some_and(|left| left.is_zero())
            || (matches!(self.notice, Notice::Undoable(_)) && steps != self.steps)
    }
}

impl Messages {
    /// Take the session's new messages and show all that are due; what went wrong stays until dismissed. A command may be
    /// asked for.
    pub fn show(&mut self, ctx: &egui::Context, session: &mut Session) -> Option<Command> {
        let now = Instant::now();
        let (steps, _) = session.history.depth();
        self.shown.extend(session.notices.drain(..).map(|notice| Shown { notice, since: now, steps }));
        self.shown.retain(|shown| !shown.is_over(now, steps));
        if let Some(next) = self.shown.iter().filter_map(|shown| shown.left(now)).min() {
            ctx.request_repaint_after(next);
        }
        if self.shown.is_empty() {
            return None;
        }
        let mut act = None;
        egui::Area::new(Id::unique("messages")).anchor(Align2::RIGHT_BOTTOM, vec2(-12.0, -36.0)).show(ctx, |ui| {
            for (index, shown) in self.shown.iter().enumerate() {
                if let Some(done) = message(ui, index, &shown.notice) {
                    act = Some((index, done));
                }
            }
        });
        // Esc dismisses the latest.
        if act.is_none() && ctx.input(|input| input.key_pressed(Key::Escape)) {
            act = Some((self.shown.len() - 1, Act::Dismiss));
        }
        let (index, act) = act?;
        self.shown.remove(index);
        ctx.request_repaint();
        match act {
            Act::Dismiss => None,
            Act::Run(command) => Some(command),
        }
    }
}

/// One message; what was done with it.
fn message(ui: &mut egui::Ui, index: usize, notice: &Notice) -> Option<Act> {
    use egui_material_icons::icons::{ICON_CHECK_CIRCLE, ICON_CLOSE, ICON_ERROR};
    let (accent, error) = (theme::accent(ui.visuals()), ui.visuals().error_fg_color);
    let (icon, color, text, button) = match notice {
        Notice::Done(text) => (ICON_CHECK_CIRCLE, accent, text, None),
        Notice::Undoable(text) => (ICON_CHECK_CIRCLE, accent, text, Some(("Undo this", Command::Undo))),
        Notice::Failed(text) => (ICON_ERROR, error, text, None),
        Notice::Unsaved(text) => (ICON_ERROR, error, text, Some(("Save elsewhere…", Command::SaveAs))),
    };
    let mut act = None;
    egui::Frame::popup(ui.style()).inner_margin(8).show(ui, |ui| {
        ui.set_max_width(460.0);
        ui.horizontal(|ui| {
            ui.label(icon.rich_text().color(color).size(17.0));
            ui.vertical(|ui| {
                ui.set_max_width(400.0);
                ui.label(text);
                if let Some((label, command)) = button
                    && ui.button(label).clicked()
                {
                    act = Some(Act::Run(command));
                }
            });
            let close = egui::Button::new(ICON_CLOSE.rich_text()).frame(false);
            let close = ui.add(close).on_hover_text("Dismiss");
            if close.accessible_name(format!("Dismiss message {}", index + 1)).clicked() {
                act = Some(Act::Dismiss);
            }
        });
    });
    act
}
