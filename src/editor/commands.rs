//! Everything that can be done by menu, key or toolbar: one list, so that all three agree.

use std::path::PathBuf;

use egui::{Key, KeyboardShortcut, Modifiers};

use super::app::App;
use super::edits;
use super::files::Then;
use super::presets::Preset;
use super::session::{Framing, Item, Session, Tool};
use crate::analysis::methods_for;
use crate::light::{self, Cap, Directional, Disk, Line, Point, Sky, Sphere};
use crate::scene::{PlotKind, Scene};
use crate::shading::Method;
use crate::surface;

/// Something the user can ask for.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Start an empty document.
    New,
    /// Choose a scene to open.
    Open,
    /// Open that scene.
    OpenFile(PathBuf),
    /// Open a scene that comes with the program.
    OpenExample(Preset),
    /// Write the document to its file.
    Save,
    /// Write the document to a file to be chosen.
    SaveAs,
    /// Close the window.
    Quit,
    /// Take back the last step.
    Undo,
    /// Do again what was taken back.
    Redo,
    /// Copy what is selected.
    Duplicate,
    /// Delete what is selected.
    Delete,
    /// Select all lights and surfaces.
    SelectAll,
    /// Select nothing.
    SelectNone,
    /// Add a light of a shape.
    AddLight(LightKind),
    /// Give the light of that name another pattern.
    ReplacePattern(String),
    /// Add the lights of a preset.
    InsertPreset(Preset),
    /// Add a surface.
    AddSurface(SurfaceKind),
    /// Give the surface of that name another mesh.
    ReplaceMesh(String),
    /// Add a material.
    AddMaterial,
    /// Add a plot.
    AddPlot(PlotKind),
    /// Take a tool.
    Tool(Tool),
    /// Shade the viewport by a method.
    Method(Method),
    /// Bring what is selected into view.
    Focus,
    /// Bring everything into view.
    FrameAll,
    /// Look through the scene's camera.
    ResetView,
    /// Make the view the scene's camera.
    SaveView,
    /// Show or hide the lights themselves.
    ToggleEmitters,
    /// Let surfaces cast shadows or not.
    ToggleShadows,
    /// Show or hide the ground grid.
    ToggleGrid,
    /// Switch grid snap.
    ToggleSnap,
    /// Put all panes where they were at first.
    ResetLayout,
    /// Switch between the dark and the light theme.
    ToggleTheme,
    /// Show the list of keys.
    Keys,
}

/// A shape of light that can be added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightKind {
    /// A square.
    Polygon,
    /// A rectangle with a pattern.
    Textured,
    /// A line.
    Line,
    /// A disk.
    Disk,
    /// A sphere.
    Sphere,
    /// A cap of directions.
    Cap,
    /// A sky.
    Sky,
    /// A point.
    Point,
    /// Parallel light.
    Directional,
}

/// A surface that can be added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceKind {
    /// The ground.
    Plane,
    /// A ball.
    Sphere,
    /// A box.
    Box,
    /// A square.
    Square,
    /// A disk.
    Disk,
    /// A cylinder.
    Cylinder,
    /// A cone.
    Cone,
    /// Balls on balls.
    Sphereflake,
    /// A tetrahedron of tetrahedra.
    Tetrahedron,
    /// A curved sheet.
    Patch,
    /// Triangles from a file.
    Mesh,
}

impl LightKind {
    /// All of them, in menu order.
    pub const ALL: [Self; 9] = [
        Self::Polygon,
        Self::Disk,
        Self::Textured,
        Self::Line,
        Self::Sphere,
        Self::Sky,
        Self::Cap,
        Self::Point,
        Self::Directional,
    ];

    /// The kind of a light's shape.
    pub fn of(shape: &light::Shape) -> Self {
        match shape {
            light::Shape::Polygon(_) => Self::Polygon,
            light::Shape::Disk(_) => Self::Disk,
            light::Shape::Textured(_) => Self::Textured,
            light::Shape::Line(_) => Self::Line,
            light::Shape::Sphere(_) => Self::Sphere,
            light::Shape::Sky(_) => Self::Sky,
            light::Shape::Cap(_) => Self::Cap,
            light::Shape::Point(_) => Self::Point,
            light::Shape::Directional(_) => Self::Directional,
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Polygon => "Polygon",
            Self::Disk => "Disk",
            Self::Textured => "Textured…",
            Self::Line => "Line",
            Self::Sphere => "Sphere",
            Self::Sky => "Sky",
            Self::Cap => "Cap",
            Self::Point => "Point",
            Self::Directional => "Directional",
        }
    }

    /// What it is, for who does not know it by its name.
    pub fn hint(self) -> &'static str {
        match self {
            Self::Polygon => "A flat light of any outline, such as a window or a softbox",
            Self::Disk => "A flat round light, such as a downlight or a porthole",
            Self::Textured => "A rectangle with a picture as its pattern: any outline, any distribution",
            Self::Line => "A linear light, such as a fluorescent tube",
            Self::Sphere => "A ball of light, such as a globe lamp",
            Self::Sky => "A hemisphere of light infinitely far away: uniform, cosine or overcast",
            Self::Cap => "A round patch of the sky infinitely far away, such as the sun behind haze",
            Self::Point => "All of the light at one point",
            Self::Directional => "Parallel light, such as a clear sun’s",
        }
    }

    /// The shape that a new light of this kind has; none where a file has to be chosen first.
    fn shape(self) -> Option<light::Shape> {
        Some(match self {
            Self::Textured => return None,
            Self::Polygon => light::Shape::Polygon(edits::rectangle(1.0, 1.0)),
            Self::Disk => light::Shape::Disk(Disk { radius: 0.4, two_sided: false }),
            Self::Cap => light::Shape::Cap(Cap { half_angle_deg: 15.0 }),
            Self::Sky => light::Shape::Sky(Sky::OVERCAST),
            Self::Line => light::Shape::Line(Line::isotropic(1.2)),
            Self::Sphere => light::Shape::Sphere(Sphere { radius: 0.2 }),
            Self::Point => light::Shape::Point(Point {}),
            Self::Directional => light::Shape::Directional(Directional {}),
        })
    }
}

impl SurfaceKind {
    /// All of them, in menu order.
    pub const ALL: [Self; 11] = [
        Self::Plane,
        Self::Sphere,
        Self::Box,
        Self::Square,
        Self::Disk,
        Self::Cylinder,
        Self::Cone,
        Self::Patch,
        Self::Mesh,
        Self::Sphereflake,
        Self::Tetrahedron,
    ];

    fn label(self) -> String {
        self.shape().map_or_else(|| "Mesh…".to_owned(), |shape| upper_first(shape.name()))
    }

    /// What it is, where its name does not say all.
    fn hint(self) -> Option<&'static str> {
        match self {
            Self::Patch => Some("A curved sheet, such as a sail: a bicubic Bézier patch"),
            Self::Mesh => Some("Triangles from an OBJ file"),
            Self::Sphereflake => Some("Balls on balls, to try shadows of many spheres"),
            Self::Tetrahedron => Some("Thousands of triangles, to try shadows of many"),
            _ => None,
        }
    }

    /// The shape that a new surface of this kind has; none where a file has to be chosen first.
    fn shape(self) -> Option<surface::Shape> {
        Some(match self {
            Self::Mesh => return None,
            Self::Patch => surface::Shape::Patch { control_points: Box::new(edits::sail()) },
            Self::Plane => surface::Shape::Plane {},
            Self::Sphere => surface::Shape::Sphere { radius: 0.5 },
            Self::Box => surface::Shape::Box { size: glam::DVec3::ONE },
            Self::Square => surface::Shape::Square { size: glam::DVec2::ONE },
            Self::Disk => surface::Shape::Disk { radius: 0.5 },
            Self::Cylinder => surface::Shape::Cylinder { radius: 0.5, height: 1.0 },
            Self::Cone => surface::Shape::Cone { radius: 0.5, height: 1.0 },
            Self::Sphereflake => surface::Shape::Sphereflake { depth: 2 },
            Self::Tetrahedron => surface::Shape::Tetrahedron { depth: 5 },
        })
    }
}

/// The methods that the viewport offers: those of the scene's lights, `exact` first and `point` last. `reference` is left
/// to plots, as it is far too slow for a picture.
pub fn view_methods(scene: &Scene) -> Vec<Method> {
    let mut methods = methods_for(scene);
    methods.retain(|method| *method != Method::Reference);
    methods
}

impl Command {
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
        Self::Focus,
        Self::FrameAll,
        Self::ToggleShadows,
        Self::ToggleSnap,
        Self::Keys,
    ];

    /// What it is called in menus, the list of keys and tooltips.
    pub fn label(&self, session: &Session) -> String {
        let with = |verb: &str, step: Option<&str>| match step {
            Some(step) => format!("{verb} {}", lower_first(step)),
            None => verb.to_owned(),
        };
        match self {
            Self::Undo => with("Undo", session.history.undo_label()),
            Self::Redo => with("Redo", session.history.redo_label()),
            Self::OpenFile(path) => path.display().to_string(),
            Self::OpenExample(preset) | Self::InsertPreset(preset) => preset.title(),
            Self::AddLight(kind) => kind.label().to_owned(),
            Self::AddSurface(kind) => kind.label(),
            Self::AddPlot(kind) => upper_first(edits::kind_name(*kind)),
            Self::Method(method) => method.to_string(),
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
            Self::ReplacePattern(_) | Self::ReplaceMesh(_) => "Replace…",
            Self::Tool(Tool::Move) => "Move",
            Self::Tool(Tool::Rotate) => "Rotate",
            Self::Tool(Tool::Scale) => "Scale",
            Self::Tool(Tool::Polygon) => "Draw polygon",
            Self::Tool(Tool::Line) => "Draw line",
            Self::Tool(Tool::Sphere) => "Draw sphere",
            Self::Focus => "Focus selection",
            Self::FrameAll => "Show all",
            Self::ResetView => "View through scene camera",
            Self::SaveView => "Make view the scene camera",
            Self::ToggleEmitters => "Show lights",
            Self::ToggleShadows => "Show shadows",
            Self::ToggleGrid => "Show grid",
            Self::ToggleSnap => "Snap to grid",
            Self::ResetLayout => "Reset layout",
            Self::Keys => "Keys",
            _ => "",
        }
    }

    /// What it means, where the label does not say all.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::AddLight(kind) => Some(kind.hint()),
            Self::AddSurface(kind) => kind.hint(),
            _ => None,
        }
    }

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
            Self::Focus => (Modifiers::NONE, Key::F),
            Self::FrameAll => (Modifiers::NONE, Key::A),
            Self::ToggleShadows => (Modifiers::NONE, Key::H),
            Self::ToggleSnap => (Modifiers::NONE, Key::G),
            Self::Keys => (Modifiers::NONE, Key::F1),
            _ => return None,
        };
        Some(KeyboardShortcut::new(modifiers, key))
    }

    /// Whether its key means the same while text is edited.
    fn works_while_typing(&self) -> bool {
        matches!(self, Self::New | Self::Open | Self::Save | Self::SaveAs | Self::Quit | Self::Keys)
    }

    /// Whether it can be done now.
    pub fn enabled(&self, session: &Session) -> bool {
        match self {
            Self::Undo => session.history.undo_label().is_some() || session.history.in_gesture(),
            Self::Redo => session.history.redo_label().is_some(),
            Self::Duplicate | Self::Delete | Self::Focus | Self::SelectNone => session.selection.primary().is_some(),
            _ => true,
        }
    }

    /// For what is on or off, or one of several: whether it is on.
    pub fn checked(&self, session: &Session) -> Option<bool> {
        match self {
            Self::Tool(tool) => Some(session.tool == *tool),
            Self::Method(method) => Some(session.view.method == *method),
            Self::ToggleEmitters => Some(session.view.show_emitters),
            Self::ToggleShadows => Some(session.view.show_shadows),
            Self::ToggleGrid => Some(session.view.show_grid),
            Self::ToggleSnap => Some(session.work_plane.snap),
            _ => None,
        }
    }

    /// Do it. An open gesture ends first, so that it stays a step of its own.
    pub fn run(self, app: &mut App, ctx: &egui::Context) {
        app.session.commit();
        let session = &mut app.session;
        match self {
            Self::New => app.leave(ctx, Then::New),
            Self::Open => app.leave(ctx, Then::Choose),
            Self::OpenFile(path) => app.leave(ctx, Then::Open(path)),
            Self::OpenExample(preset) => app.leave(ctx, Then::Example(preset)),
            Self::Save => app.save(ctx),
            Self::SaveAs => app.save_as(ctx),
            Self::Quit => app.leave(ctx, Then::Quit),
            Self::Undo => session.undo(),
            Self::Redo => session.redo(),
            Self::Duplicate => session.duplicate_selection(),
            Self::Delete => session.delete_selection(),
            Self::SelectAll => {
                let scene = session.scene();
                let lights = (0..scene.lights.len()).map(Item::Light);
                let surfaces = (0..scene.surfaces.len()).map(Item::Surface);
                session.selection.set(surfaces.chain(lights));
            }
            Self::SelectNone => session.selection.clear(),
            Self::AddLight(kind) => match kind.shape() {
                Some(shape) => session.add_light(edits::new_light(shape)),
                None => app.choose_pattern(ctx, None),
            },
            Self::ReplacePattern(light) => app.choose_pattern(ctx, Some(light)),
            Self::InsertPreset(preset) => app.insert_preset(preset),
            Self::AddSurface(kind) => match kind.shape() {
                Some(shape) => session.add_surface(shape),
                None => app.choose_mesh(ctx, None),
            },
            Self::ReplaceMesh(surface) => app.choose_mesh(ctx, Some(surface)),
            Self::AddMaterial => session.add_material(),
            Self::AddPlot(kind) => session.add_plot(kind),
            Self::Tool(tool) => session.tool = tool,
            Self::Method(method) => session.view.method = method,
            Self::Focus => session.framing = Some(Framing::Selection),
            Self::FrameAll => session.framing = Some(Framing::All),
            Self::ResetView => session.reset_view(),
            Self::SaveView => session.save_view(),
            Self::ToggleEmitters => session.view.show_emitters ^= true,
            Self::ToggleShadows => session.view.show_shadows ^= true,
            Self::ToggleGrid => session.view.show_grid ^= true,
            Self::ToggleSnap => session.work_plane.snap ^= true,
            Self::ResetLayout => app.reset_layout(),
            Self::ToggleTheme => {
                let other = if ctx.theme() == egui::Theme::Dark { egui::Theme::Light } else { egui::Theme::Dark };
                ctx.set_theme(other);
            }
            Self::Keys => app.toggle_keys(),
        }
    }
}

/// Run the commands whose keys were pressed. While text is edited, most keys belong to the text.
pub fn run_shortcuts(app: &mut App, ctx: &egui::Context) {
    let typing = ctx.egui_wants_keyboard_input();
    let pressed: Vec<&Command> = ctx.input_mut(|input| {
        // Those with more modifiers first, since a key with fewer would match too.
        let mut keyed: Vec<_> = Command::KEYED.iter().filter_map(|c| c.shortcut().map(|s| (c, s))).collect();
        keyed.sort_by_key(|(_, shortcut)| std::cmp::Reverse(shortcut.modifiers.shift));
        keyed.retain(|(command, s)| (!typing || command.works_while_typing()) && input.consume_shortcut(s));
        keyed.into_iter().map(|(command, _)| command).collect()
    });
    for command in pressed {
        if command.enabled(&app.session) {
            command.clone().run(app, ctx);
        }
    }
}

fn lower_first(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_lowercase().chain(chars).collect())
}

fn upper_first(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn the_view_offers_the_methods_of_the_scenes_lights_from_exact_to_point() {
        assert_eq!(view_methods(&Scene::default()), [Method::Exact], "an empty scene");
        let lights = LightKind::Sphere.shape().map(edits::new_light).into_iter().collect();
        let methods = view_methods(&Scene { lights, ..Scene::default() });
        assert_eq!(methods.first(), Some(&Method::Exact), "first");
        assert_eq!(methods.last(), Some(&Method::Point), "last");
        assert!(methods.contains(&Method::Hermite1) && !methods.contains(&Method::Reference), "{methods:?}");
    }

    #[test]
    fn undo_names_the_step_it_would_take_back() {
        let mut session = Session::new(Scene::default(), None);
        assert!(!Command::Undo.enabled(&session), "nothing to undo");
        session.add_material();
        assert_eq!(Command::Undo.label(&session), "Undo add material", "label");
    }
}
