//! A name that is typed where a row was.

use egui::{Key, TextEdit, Ui};

/// The name being typed, and of what.
#[derive(Debug)]
pub(super) struct Renaming<W> {
    what: W,
    name: String,
    /// The field has had the focus, so losing it ends the edit.
    focused: bool,
}

impl<W: PartialEq> Renaming<W> {
    /// Begin with the name as it is.
    pub(super) fn new(what: W, name: String) -> Self {
        Self { what, name, focused: false }
    }

    /// The field in the place of the row of `what`, if that is being renamed; Enter or a click elsewhere takes what was
    /// typed, Esc does not.
    pub(super) fn show(renaming: &mut Option<Self>, ui: &mut Ui, what: &W, take: impl FnOnce(W, String)) -> bool {
        let Some(typed) = renaming.as_mut().filter(|renaming| renaming.what == *what) else { return false };
        let edit = TextEdit::singleline(&mut typed.name).desired_width(f32::INFINITY);
        let response = ui.add(edit).accessible_name("New name");
        if !typed.focused {
            response.request_focus();
            typed.focused = true;
        } else if response.lost_focus() {
            let cancelled = ui.input(|input| input.key_pressed(Key::Escape));
            if let Some(Self { what, name, .. }) = renaming.take().filter(|_| !cancelled) {
                take(what, name);
            }
        }
        true
    }
}
