//! What commands are called, and what they mean.

use super::{Command, upper_first};
use crate::editor::edits;
use crate::editor::session::{Session, Tool};

/// A heading of the list of keys and of the palette.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Category {
    /// Documents.
    File,
    /// The selection, and steps taken back.
    Edit,
    /// New lights.
    Light,
    /// What else is added to a scene.
    Add,
    /// What the mouse does.
    Tool,
    /// What the viewport shows.
    View,
    /// The program itself.
    Window,
}

impl Category {
    /// All of them, in the order in which they are listed.
    pub const ALL: [Self; 7] = [Self::File, Self::Edit, Self::Light, Self::Add, Self::Tool, Self::View, Self::Window];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::File => "File",
            Self::Edit => "Edit",
            Self::Light => "Lights",
            Self::Add => "Add",
            Self::Tool => "Tools",
            Self::View => "View",
            Self::Window => "Window",
        }
    }
}

impl Command {
    /// What it is called in menus, the list of keys and tooltips.
    pub fn label(&self, session: &Session) -> String {
        let with = |verb: &str, step: Option<&str>| match step {
            Some(step) => format!("{verb} {}", lower_first(step)),
            None => verb.to_owned(),
        };
        match self {
            Self::Undo => with("Undo", session.history.undo_label()),
            Self::Redo => with("Redo", session.history.redo_label()),
            Self::Delete if session.corner().is_some() => "Delete vertex".to_owned(),
            Self::OpenFile(path) => path.display().to_string(),
            Self::OpenExample(preset) | Self::InsertPreset(preset) => preset.title(),
            Self::InsertFile(path) => path.display().to_string(),
            Self::Select(item) => format!("Select {}", item.name(session.scene()).unwrap_or_default()),
            Self::AddLight(kind) => kind.label().to_owned(),
            Self::AddSurface(kind) => kind.label(),
            Self::Outline(kind) => kind.name().to_owned(),
            Self::AddPlot(kind) => upper_first(edits::kind_name(*kind)),
            Self::Method(method) => method.to_string(),
            Self::List(command) => command.label(session),
            Self::ShowPane(pane) => format!("Show {}", pane.title().to_lowercase()),
            Self::ViewMode(mode) => mode.label().to_owned(),
            Self::ToggleTheme => "Switch dark/light theme".to_owned(),
            _ => self.fixed_label().to_owned(),
        }
    }

    /// The labels that depend on nothing.
    fn fixed_label(&self) -> &'static str {
        match self {
            Self::New => "New",
            Self::Open => "Open…",
            Self::Save => "Save",
            Self::SaveAs => "Save as…",
            Self::Quit => "Quit",
            Self::Duplicate => "Duplicate",
            Self::Delete => "Delete",
            Self::SelectAll => "Select all",
            Self::SelectNone => "Select none",
            Self::AddMaterial => "Material",
            Self::ReplacePattern(_) | Self::ReplacePhotometry(_) | Self::ReplaceMesh(_) => "Replace…",
            Self::EditPattern => "Edit pattern",
            Self::Tool(Tool::Move) => "Move",
            Self::Tool(Tool::Rotate) => "Rotate",
            Self::Tool(Tool::Scale) => "Scale",
            Self::Tool(Tool::Polygon) => "Draw polygon",
            Self::Tool(Tool::Line) => "Draw line",
            Self::Tool(Tool::Sphere) => "Draw sphere",
            Self::Tool(Tool::Aim) => "Aim at",
            Self::Tool(Tool::Place(place)) => place.label(),
            Self::Tool(Tool::Textured) => "Draw textured rectangle",
            Self::Tool(Tool::Outline) => "Draw outline",
            Self::NextPlane => "Next work plane",
            Self::Viewports(2) => "Two viewports",
            Self::Viewports(4) => "Four viewports",
            Self::Viewports(_) => "One viewport",
            Self::LinkViews => "Link cameras",
            Self::AutoExposure => "Auto exposure",
            Self::ToggleMeasure => "Measure illuminance",
            Self::Focus => "Focus selection",
            Self::FrameAll => "Show all",
            Self::ResetView => "View through scene camera",
            Self::SaveView => "Make view the scene camera",
            Self::ToggleEmitters => "Show lights",
            Self::ToggleShadows => "Show shadows",
            Self::ToggleGrid => "Show grid",
            Self::ToggleSnap => "Snap to grid",
            Self::ToggleAxes => "Local axes",
            Self::Pivot(pivot) => pivot.label(),
            Self::NextPivot => "Next pivot",
            Self::ResetLayout => "Reset layout",
            Self::SavePreset => "Save selection as preset…",
            Self::ToggleMute => "Mute",
            Self::ToggleSolo => "Solo",
            Self::ZoomIn => "Larger interface",
            Self::ZoomOut => "Smaller interface",
            Self::ZoomReset => "Usual interface size",
            Self::Library => "Show library",
            Self::Palette => "Find a command…",
            Self::FirstSteps => "First steps",
            Self::Keys => "Keys",
            Self::Export => "Export…",
            Self::ExportLights => "Export selected lights…",
            Self::ExportPlot(..) => "Export plot",
            _ => "",
        }
    }

    /// What it means, where the label does not say all.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::AddLight(kind) => Some(kind.hint()),
            Self::AddSurface(kind) => kind.hint(),
            Self::Tool(Tool::Aim) => Some("Turn the selected lights to a point of the scene"),
            Self::Tool(Tool::Place(place)) => Some(place.hint()),
            Self::ToggleAxes => Some("Handles move and turn along the selection's own axes"),
            Self::Outline(kind) => Some(kind.hint()),
            Self::SavePreset => Some("Keep the selected lights, to insert them into other scenes"),
            Self::ToggleMute => Some("Switch the selected lights off or on; nothing is shaded again"),
            Self::ToggleSolo => Some("Show the selected lights without the others; this is not saved"),
            Self::SaveView => Some("Saved with the scene, and used when it is rendered"),
            Self::Palette => Some("Any command, preset or thing in the scene, by a few letters"),
            Self::ResetLayout => Some("Put all panes where they were at first"),
            Self::ViewMode(mode) => Some(mode.hint()),
            Self::Export => Some("For another program; first it is said what is kept, changed and lost"),
            Self::ExportLights => Some("The selected lights for another program"),
            Self::LinkViews => Some("All viewports look through the same camera"),
            Self::AutoExposure => Some("All but the brightest 1 % of the picture shows without clipping"),
            Self::ToggleMeasure => Some("Least, mean and greatest illuminance and uniformity over a rectangle"),
            _ => None,
        }
    }

    /// Under which heading the list of keys and the palette have it.
    pub fn category(&self) -> Category {
        match self {
            Self::New
            | Self::Open
            | Self::OpenFile(_)
            | Self::OpenExample(_)
            | Self::Save
            | Self::SaveAs
            | Self::Export
            | Self::ExportLights
            | Self::ExportPlot(..)
            | Self::Quit => Category::File,
            Self::Undo
            | Self::Redo
            | Self::Duplicate
            | Self::Delete
            | Self::SelectAll
            | Self::SelectNone
            | Self::Select(_) => Category::Edit,
            Self::AddLight(_)
            | Self::ReplacePattern(_)
            | Self::ReplacePhotometry(_)
            | Self::EditPattern
            | Self::InsertPreset(_)
            | Self::InsertFile(_)
            | Self::List(_)
            | Self::SavePreset
            | Self::ToggleMute
            | Self::ToggleSolo => Category::Light,
            Self::AddSurface(_) | Self::ReplaceMesh(_) | Self::AddMaterial | Self::AddPlot(_) => Category::Add,
            Self::Tool(_)
            | Self::Outline(_)
            | Self::NextPlane
            | Self::ToggleSnap
            | Self::ToggleAxes
            | Self::Pivot(_)
            | Self::NextPivot => Category::Tool,
            Self::Method(_)
            | Self::ViewMode(_)
            | Self::Viewports(_)
            | Self::LinkViews
            | Self::AutoExposure
            | Self::ToggleMeasure
            | Self::Focus
            | Self::FrameAll
            | Self::ResetView
            | Self::SaveView
            | Self::ToggleEmitters
            | Self::ToggleShadows
            | Self::ToggleGrid => Category::View,
            Self::ZoomIn
            | Self::ZoomOut
            | Self::ZoomReset
            | Self::Library
            | Self::Palette
            | Self::FirstSteps
            | Self::ResetLayout
            | Self::ToggleTheme
            | Self::ShowPane(_)
            | Self::Keys => Category::Window,
        }
    }
}

fn lower_first(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_lowercase().chain(chars).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn undo_names_the_step_it_would_take_back() {
        let mut session = Session::new(Scene::default(), None);
        assert!(!Command::Undo.enabled(&session), "nothing to undo");
        session.add_material();
        assert_eq!(Command::Undo.label(&session), "Undo add material", "label");
    }
}
