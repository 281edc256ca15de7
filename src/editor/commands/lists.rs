//! Commands of the list of lights and of variants.

use egui::{Key, KeyboardShortcut, Modifiers};

use crate::editor::session::Session;

/// What is done to the list of lights, and to variants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ListCommand {
    /// Make the selected lights a group.
    Group,
    /// Take the selected lights out of their groups.
    Ungroup,
    /// Move the selected lights up in the list.
    MoveUp,
    /// Move them down.
    MoveDown,
    /// Store the lights as a new variant.
    StoreVariant,
    /// Store the lights in the active variant.
    UpdateVariant,
    /// Show the variant before the active one.
    PreviousVariant,
    /// Show the next one.
    NextVariant,
    /// Show the variant of that place.
    Variant(usize),
}

impl ListCommand {
    /// Variants that have a key of their own.
    pub const KEYED_VARIANTS: usize = 4;

    /// What it is called.
    pub(super) fn label(self, session: &Session) -> String {
        let fixed = match self {
            Self::Group => "Group",
            Self::Ungroup => "Ungroup",
            Self::MoveUp => "Move up in the list",
            Self::MoveDown => "Move down in the list",
            Self::StoreVariant => "Store lights as a variant",
            Self::UpdateVariant => "Update the variant",
            Self::PreviousVariant => "Previous variant",
            Self::NextVariant => "Next variant",
            Self::Variant(index) => {
                let variant = session.scene().variants.get(index);
                return variant.map_or_else(|| format!("Variant {}", index + 1), |variant| variant.name.clone());
            }
        };
        fixed.to_owned()
    }

    /// Its key.
    pub(super) fn shortcut(self) -> Option<KeyboardShortcut> {
        let (modifiers, key) = match self {
            Self::Group => (Modifiers::COMMAND, Key::G),
            Self::Ungroup => (Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::G),
            Self::MoveUp => (Modifiers::ALT, Key::ArrowUp),
            Self::MoveDown => (Modifiers::ALT, Key::ArrowDown),
            Self::StoreVariant | Self::UpdateVariant => return None,
            Self::PreviousVariant => (Modifiers::NONE, Key::PageUp),
            Self::NextVariant => (Modifiers::NONE, Key::PageDown),
            Self::Variant(index) => (Modifiers::NONE, *[Key::F5, Key::F6, Key::F7, Key::F8].get(index)?),
        };
        Some(KeyboardShortcut::new(modifiers, key))
    }

    /// Whether it can be done now.
    pub(super) fn enabled(self, session: &Session) -> bool {
        let scene = session.scene();
        match self {
            Self::Group | Self::MoveUp | Self::MoveDown => !session.selected_lights().is_empty(),
            Self::Ungroup => {
                let lights = session.selected_lights();
                lights.iter().filter_map(|i| scene.lights.get(*i)).any(|light| light.group.is_some())
            }
            Self::StoreVariant => true,
            Self::UpdateVariant => session.active_variant().is_some() && scene.differs_from_variant(),
            Self::PreviousVariant | Self::NextVariant => !scene.variants.is_empty(),
            Self::Variant(index) => index < scene.variants.len(),
        }
    }

    /// Do it.
    pub(super) fn run(self, session: &mut Session) {
        match self {
            Self::Group => session.group_selection(),
            Self::Ungroup => session.ungroup_selection(),
            Self::MoveUp | Self::MoveDown => session.shift_selection(self == Self::MoveUp),
            Self::StoreVariant => session.store_variant(),
            Self::UpdateVariant => session.active_variant().into_iter().for_each(|i| session.update_variant(i)),
            Self::PreviousVariant | Self::NextVariant => session.step_variant(self == Self::NextVariant),
            Self::Variant(index) => session.switch_variant(index),
        }
    }
}
