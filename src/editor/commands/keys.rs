//! The keys of commands.

use egui::{Event, Key, KeyboardShortcut, Modifiers};

use super::{Command, ListCommand};
use crate::editor::app::App;
use crate::editor::handles::place::Place;
use crate::editor::panes::Pane;
use crate::editor::session::Tool;
use crate::editor::tools::typed;

impl Command {
    /// Commands without a key that the palette offers, besides those that add something and the view's methods.
    pub const UNKEYED: &[Self] = &[
        Self::SelectNone,
        Self::AddMaterial,
        Self::SavePreset,
        Self::Export,
        Self::ExportLights,
        Self::List(ListCommand::StoreVariant),
        Self::List(ListCommand::UpdateVariant),
        Self::ResetView,
        Self::SaveView,
        Self::ToggleEmitters,
        Self::ToggleGrid,
        Self::EditPattern,
        Self::LinkViews,
        Self::AutoExposure,
        Self::ShowPane(Pane::Plots),
        Self::Library,
        Self::ShowPane(Pane::Problems),
        Self::ShowPane(Pane::Variants),
        Self::FirstSteps,
        Self::ResetLayout,
        Self::ToggleTheme,
    ];

    /// All commands that have a key, in the order of the list of keys.
    pub const KEYED: &[Self] = &[
        Self::New,
        Self::Open,
        Self::Save,
        Self::SaveAs,
        Self::Quit,
        Self::Undo,
        Self::Redo,
        Self::Duplicate,
        Self::Delete,
        Self::SelectAll,
        Self::Tool(Tool::Move),
        Self::Tool(Tool::Rotate),
        Self::Tool(Tool::Scale),
        Self::Tool(Tool::Polygon),
        Self::Tool(Tool::Line),
        Self::Tool(Tool::Sphere),
        Self::Tool(Tool::Aim),
        Self::Tool(Tool::Place(Place::Highlight)),
        Self::Tool(Tool::Place(Place::Diffuse)),
        Self::Tool(Tool::Place(Place::Rim)),
        Self::Tool(Tool::Textured),
        Self::Tool(Tool::Outline),
        Self::NextPlane,
        Self::Viewports(1),
        Self::Viewports(2),
        Self::Viewports(4),
        Self::ToggleMeasure,
        Self::Focus,
        Self::FrameAll,
        Self::ToggleShadows,
        Self::ToggleSnap,
        Self::ToggleAxes,
        Self::NextPivot,
        Self::List(ListCommand::Group),
        Self::List(ListCommand::Ungroup),
        Self::List(ListCommand::MoveUp),
        Self::List(ListCommand::MoveDown),
        Self::List(ListCommand::PreviousVariant),
        Self::List(ListCommand::NextVariant),
        Self::List(ListCommand::Variant(0)),
        Self::List(ListCommand::Variant(1)),
        Self::List(ListCommand::Variant(2)),
        Self::List(ListCommand::Variant(3)),
        Self::ToggleMute,
        Self::ToggleSolo,
        Self::ZoomIn,
        Self::ZoomOut,
        Self::ZoomReset,
        Self::Palette,
        Self::Keys,
    ];

    /// Its key.
    pub fn shortcut(&self) -> Option<KeyboardShortcut> {
        const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);
        let (modifiers, key) = match self {
            Self::New => (Modifiers::COMMAND, Key::N),
            Self::Open => (Modifiers::COMMAND, Key::O),
            Self::Save => (Modifiers::COMMAND, Key::S),
            Self::SaveAs => (CTRL_SHIFT, Key::S),
            Self::Quit => (Modifiers::COMMAND, Key::Q),
            Self::Undo => (Modifiers::COMMAND, Key::Z),
            Self::Redo => (CTRL_SHIFT, Key::Z),
            Self::Duplicate => (Modifiers::COMMAND, Key::D),
            Self::Delete => (Modifiers::NONE, Key::Delete),
            Self::SelectAll => (Modifiers::COMMAND, Key::A),
            Self::Tool(Tool::Move) => (Modifiers::NONE, Key::W),
            Self::Tool(Tool::Rotate) => (Modifiers::NONE, Key::E),
            Self::Tool(Tool::Scale) => (Modifiers::NONE, Key::R),
            Self::Tool(Tool::Polygon) => (Modifiers::NONE, Key::P),
            Self::Tool(Tool::Line) => (Modifiers::NONE, Key::L),
            Self::Tool(Tool::Sphere) => (Modifiers::NONE, Key::O),
            Self::Tool(Tool::Aim) => (Modifiers::SHIFT, Key::A),
            Self::Tool(Tool::Place(Place::Highlight)) => (Modifiers::SHIFT, Key::H),
            Self::Tool(Tool::Place(Place::Diffuse)) => (Modifiers::SHIFT, Key::D),
            Self::Tool(Tool::Place(Place::Rim)) => (Modifiers::SHIFT, Key::R),
            Self::Tool(Tool::Textured) => (Modifiers::NONE, Key::T),
            Self::Tool(Tool::Outline) => (Modifiers::NONE, Key::N),
            Self::NextPlane => (Modifiers::NONE, Key::Q),
            Self::Viewports(1) => (Modifiers::ALT, Key::Num1),
            Self::Viewports(2) => (Modifiers::ALT, Key::Num2),
            Self::Viewports(4) => (Modifiers::ALT, Key::Num4),
            Self::ToggleMeasure => (Modifiers::NONE, Key::M),
            Self::Focus => (Modifiers::NONE, Key::F),
            Self::FrameAll => (Modifiers::NONE, Key::A),
            Self::ToggleShadows => (Modifiers::NONE, Key::H),
            Self::ToggleSnap => (Modifiers::NONE, Key::G),
            Self::ToggleAxes => (Modifiers::NONE, Key::X),
            Self::NextPivot => (Modifiers::NONE, Key::Period),
            Self::ToggleMute => (Modifiers::COMMAND, Key::M),
            Self::ToggleSolo => (CTRL_SHIFT, Key::M),
            Self::ZoomIn => (Modifiers::COMMAND, Key::Plus),
            Self::ZoomOut => (Modifiers::COMMAND, Key::Minus),
            Self::ZoomReset => (Modifiers::COMMAND, Key::Num0),
            Self::Palette => (Modifiers::COMMAND, Key::P),
            Self::Keys => (Modifiers::NONE, Key::F1),
            Self::List(command) => return command.shortcut(),
            _ => return None,
        };
        Some(KeyboardShortcut::new(modifiers, key))
    }

    /// Whether its key means the same while text is edited.
    fn works_while_typing(&self) -> bool {
        matches!(
            self,
            Self::New
                | Self::Open
                | Self::Save
                | Self::SaveAs
                | Self::Quit
                | Self::ZoomIn
                | Self::ZoomOut
                | Self::ZoomReset
                | Self::Palette
                | Self::Keys
        )
    }
}

/// Run the commands whose keys were pressed, in their order and as often as they were: a slow frame holds several. While
/// text is edited, most keys belong to the text.
pub fn run_shortcuts(app: &mut App, ctx: &egui::Context) {
    let typing = ctx.egui_wants_keyboard_input();
    let in_gesture = app.session.history.in_gesture();
    let drawing = app.session.is_drawing;
    // Letters that the pane under the pointer has for itself; it was shown in the last frame.
    let pane_keys = std::mem::take(&mut app.session.pane_keys);
    let mut pressed = Vec::new();
    ctx.input_mut(|input| {
        // Those with more modifiers first, since a key with fewer would match too.
        let mut keyed: Vec<_> = Command::KEYED.iter().filter_map(|c| c.shortcut().map(|s| (c, s))).collect();
        keyed.sort_by_key(|(_, shortcut)| std::cmp::Reverse(shortcut.modifiers.shift));
        // While something is dragged, plain keys belong to the drag.
        let dragging = in_gesture && input.pointer.primary_down();
        let is_panes = |s: &KeyboardShortcut| pane_keys && s.modifiers.is_none() && s.logical_key.name().len() == 1;
        keyed.retain(|(command, s)| {
            let free = !(dragging && !s.modifiers.command || is_panes(s));
            let typed = typing && !command.works_while_typing() || drawing && begins_dimension(s);
            free && !typed
        });
        input.events.retain(|event| {
            let Event::Key { key, modifiers, pressed: true, .. } = event else { return true };
            let is = |s: &KeyboardShortcut| s.logical_key == *key && modifiers.matches_logically(s.modifiers);
            let command = keyed.iter().find(|(_, shortcut)| is(shortcut)).map(|(command, _)| *command);
            pressed.extend(command);
            command.is_none()
        });
    });
    for command in pressed {
        if command.enabled(&app.session) {
            command.clone().run(app, ctx);
        }
    }
}

/// Whether a key begins a dimension while something is being drawn.
fn begins_dimension(shortcut: &KeyboardShortcut) -> bool {
    let mut symbol = shortcut.logical_key.symbol_or_name().chars();
    let single = symbol.next().filter(|_| symbol.next().is_none());
    let key = match shortcut.logical_key {
        Key::Minus => Some('-'),
        _ => single,
    };
    shortcut.modifiers.is_none() && key.is_some_and(typed::begins)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::session::Session;
    use crate::scene::Scene;

    #[test]
    fn every_keyed_command_has_a_label_and_a_key_of_its_own() {
        let session = Session::new(Scene::default(), None);
        let mut keys = Vec::new();
        for command in Command::KEYED {
            assert!(!command.label(&session).is_empty(), "{command:?} has no label");
            let shortcut = command.shortcut().expect("a keyed command has a key");
            assert!(!keys.contains(&shortcut), "{shortcut:?} of {command:?} is taken");
            keys.push(shortcut);
        }
    }
}
