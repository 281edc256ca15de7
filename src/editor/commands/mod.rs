//! Everything that can be done by menu, key, toolbar or palette: one list, so that all agree.
//!
//! A new command is a variant here with what it does ([`Command::run`]), its name and heading in `labels`, and its key, if
//! it has one, in `keys`.

mod keys;
mod kinds;
mod labels;
mod lists;

pub use keys::run_shortcuts;
pub use kinds::{LightKind, SurfaceKind};
pub use labels::Category;
pub use lists::ListCommand;

use std::path::PathBuf;

use super::app::App;
use super::edits;
use super::files::Then;
use super::handles::frame::{Axes, Pivot};
use super::panes::{self, Pane};
use super::presets::Preset;
use super::session::{Framing, Item, Session, Tool, ViewMode};
use super::tools::outline::OutlineKind;
use crate::analysis::{Sheet, methods_for};
use crate::export::plot::PlotFormat;
use crate::scene::{PlotKind, Scene};
use crate::shading::Method;

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
    /// Select one thing.
    Select(Item),
    /// Switch the selected lights off or on.
    ToggleMute,
    /// Show what the selected lights do alone, or no more.
    ToggleSolo,
    /// Add a light of a shape.
    AddLight(LightKind),
    /// Give the light of that name another pattern.
    ReplacePattern(String),
    /// Give the light of that name another IES file.
    ReplacePhotometry(String),
    /// Paint the pattern of the selected light.
    EditPattern,
    /// Add the lights of a preset.
    InsertPreset(Preset),
    /// Add the lights of a preset in a file.
    InsertFile(PathBuf),
    /// Keep the selected lights as a preset.
    SavePreset,
    /// Add a surface.
    AddSurface(SurfaceKind),
    /// Give the surface of that name another mesh.
    ReplaceMesh(String),
    /// Add a material.
    AddMaterial,
    /// Add a plot.
    AddPlot(PlotKind),
    /// Show what becomes of the scene in another program's format, and write it.
    Export,
    /// The same, of the selected lights.
    ExportLights,
    /// Write a plot as it is shown.
    ExportPlot(PlotFormat, Box<Sheet>),
    /// Bring a pane to the front.
    ShowPane(Pane),
    /// Take a tool.
    Tool(Tool),
    /// Take the tool that makes outlines of that kind.
    Outline(OutlineKind),
    /// Draw on the next kind of plane.
    NextPlane,
    /// Shade the viewport by a method.
    Method(Method),
    /// Show something else in the viewport.
    ViewMode(ViewMode),
    /// Show so many viewports: 1, 2 or 4.
    Viewports(usize),
    /// Let all viewports look through one camera or not.
    LinkViews,
    /// Set the exposure by what is seen.
    AutoExposure,
    /// Measure illuminance over a rectangle or not.
    ToggleMeasure,
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
    /// Switch between the world's axes and the selection's own.
    ToggleAxes,
    /// Turn and scale about another point.
    Pivot(Pivot),
    /// Turn and scale about the next point in the list.
    NextPivot,
    /// Put all panes where they were at first.
    ResetLayout,
    /// Switch between the dark and the light theme.
    ToggleTheme,
    /// Do something to the list of lights or to variants.
    List(ListCommand),
    /// Make everything in the window larger.
    ZoomIn,
    /// Make everything in the window smaller.
    ZoomOut,
    /// Show everything in the window at its usual size.
    ZoomReset,
    /// Bring the library to the front.
    Library,
    /// Find a command by its name.
    Palette,
    /// Show what to try first.
    FirstSteps,
    /// Show the list of keys.
    Keys,
}

/// The methods that the viewport offers: those of the scene's lights, `exact` first and `point` last, and fits of several
/// numbers of lights. `reference` is left to plots, as it is far too slow for a picture.
pub fn view_methods(scene: &Scene) -> Vec<Method> {
    let offered = |method| match method {
        Method::Reference => Vec::new(),
        Method::Fit(_) => [1, 2, 4, 8, 16].map(Method::Fit).to_vec(),
        method => vec![method],
    };
    methods_for(scene).into_iter().flat_map(offered).collect()
}

impl Command {
    /// Whether it can be done now.
    pub fn enabled(&self, session: &Session) -> bool {
        match self {
            Self::Undo => session.history.undo_label().is_some() || session.history.in_gesture(),
            Self::Redo => session.history.redo_label().is_some(),
            Self::Duplicate | Self::Delete | Self::Focus | Self::SelectNone => session.selection.primary().is_some(),
            Self::List(command) => command.enabled(session),
            Self::SavePreset | Self::ExportLights | Self::ToggleMute | Self::ToggleSolo => panes::has_lights(session),
            Self::OpenFile(path) | Self::InsertFile(path) => path.exists(),
            Self::EditPattern => session.selection.primary().is_some_and(|item| item.has_pattern(session.scene())),
            Self::LinkViews => session.views.count() > 1,
            _ => true,
        }
    }

    /// All that the palette offers but things of the scene and what comes with the program.
    pub fn all(session: &Session) -> Vec<Self> {
        let plots = [PlotKind::Tilt, PlotKind::View, PlotKind::Line, PlotKind::Distance];
        let methods = view_methods(session.scene());
        let others = Self::KEYED.iter().chain(Self::UNKEYED).cloned();
        let lights = LightKind::ALL.map(Self::AddLight);
        let surfaces = SurfaceKind::ALL.map(Self::AddSurface);
        let added = lights.into_iter().chain(surfaces).chain(plots.map(Self::AddPlot));
        let kinds = OutlineKind::ALL.map(Self::Outline).into_iter().chain(Pivot::ALL.map(Self::Pivot));
        let kinds = kinds.chain(ViewMode::ALL.map(Self::ViewMode));
        others.chain(added).chain(kinds).chain(methods.into_iter().map(Self::Method)).collect()
    }

    /// For what is on or off, or one of several: whether it is on.
    pub fn checked(&self, session: &Session) -> Option<bool> {
        match self {
            Self::Tool(tool) => Some(session.tool == *tool),
            Self::Outline(kind) => Some(session.tool == Tool::Outline && session.outline.kind == *kind),
            Self::Method(method) => Some(session.view.method == *method),
            Self::ViewMode(mode) => Some(session.view.mode == *mode),
            Self::Viewports(count) => Some(session.views.count() == *count),
            Self::LinkViews => Some(session.views.linked),
            Self::ToggleMeasure => Some(session.measure.shown),
            Self::ToggleEmitters => Some(session.view.show_emitters),
            Self::ToggleShadows => Some(session.view.show_shadows),
            Self::ToggleGrid => Some(session.view.show_grid),
            Self::ToggleSnap => Some(session.work_plane.snap),
            Self::ToggleAxes => Some(session.transform.axes == Axes::Local),
            Self::Pivot(pivot) => Some(session.transform.pivot == *pivot),
            Self::ToggleMute => Some(session.all_selected(|session, index| session.scene().lights[index].muted)),
            Self::ToggleSolo => {
                Some(session.all_selected(|session, index| session.is_solo(&session.scene().lights[index].name)))
            }
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
            Self::Select(item) => {
                session.selection.set([item]);
                if let Item::Plot(index) = item {
                    session.plots.active = index;
                }
            }
            Self::ToggleMute => session.toggle_mute_selection(),
            Self::ToggleSolo => session.toggle_solo_selection(),
            Self::AddLight(kind) => match kind.shape() {
                Some(shape) => session.add_light(edits::new_light(shape)),
                None if kind == LightKind::Measured => app.choose_photometry(ctx, None),
                None => app.choose_pattern(ctx, None),
            },
            Self::ReplacePattern(light) => app.choose_pattern(ctx, Some(light)),
            Self::ReplacePhotometry(light) => app.choose_photometry(ctx, Some(light)),
            Self::EditPattern => app.show_pane(Pane::Painter),
            Self::InsertPreset(preset) => app.insert_preset(preset),
            Self::InsertFile(path) => app.insert_file(&path),
            Self::SavePreset => app.name_preset(),
            Self::AddSurface(kind) => match kind.shape() {
                Some(shape) => session.add_surface(shape),
                None => app.choose_mesh(ctx, None),
            },
            Self::ReplaceMesh(surface) => app.choose_mesh(ctx, Some(surface)),
            Self::AddMaterial => session.add_material(),
            Self::AddPlot(kind) => session.add_plot(kind),
            Self::Export => app.open_export(false),
            Self::ExportLights => app.open_export(true),
            Self::ExportPlot(format, sheet) => app.export_plot(ctx, format, sheet),
            Self::ShowPane(pane) => app.show_pane(pane),
            Self::Tool(tool) => session.tool = tool,
            Self::Outline(kind) => {
                session.tool = Tool::Outline;
                session.outline.kind = kind;
            }
            Self::NextPlane => session.work_plane.cycle(&session.view.camera),
            Self::Method(method) => session.view.method = method,
            Self::ViewMode(mode) => session.view.set_mode(mode),
            Self::Viewports(count) => session.set_view_count(count),
            Self::LinkViews => {
                session.views.linked ^= true;
                session.link_views();
            }
            Self::AutoExposure => session.wants_exposure = true,
            Self::ToggleMeasure => session.measure.shown ^= true,
            Self::Focus => session.framing = Some(Framing::Selection),
            Self::FrameAll => session.framing = Some(Framing::All),
            Self::ResetView => session.reset_view(),
            Self::SaveView => session.save_view(),
            Self::ToggleEmitters => session.view.show_emitters ^= true,
            Self::ToggleShadows => session.view.show_shadows ^= true,
            Self::ToggleGrid => session.view.show_grid ^= true,
            Self::ToggleSnap => session.work_plane.snap ^= true,
            Self::ToggleAxes => session.transform.axes = session.transform.axes.other(),
            Self::Pivot(pivot) => session.transform.pivot = pivot,
            Self::NextPivot => session.transform.pivot = session.transform.pivot.next(),
            Self::ResetLayout => app.reset_layout(),
            Self::ToggleTheme => {
                let other = if ctx.theme() == egui::Theme::Dark { egui::Theme::Light } else { egui::Theme::Dark };
                ctx.set_theme(other);
            }
            Self::List(command) => command.run(session),
            Self::ZoomIn => egui::gui_zoom::zoom_in(ctx),
            Self::ZoomOut => egui::gui_zoom::zoom_out(ctx),
            Self::ZoomReset => ctx.set_zoom_factor(1.0),
            Self::Library => app.show_pane(Pane::Library),
            Self::Palette => app.open_palette(),
            Self::FirstSteps => app.show_first_steps(),
            Self::Keys => app.toggle_keys(),
        }
    }
}

fn upper_first(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_palette_has_every_command_once_with_a_name_of_its_own() {
        let session = Session::new(Scene::default(), None);
        let all = Command::all(&session);
        for (i, command) in all.iter().enumerate() {
            assert!(!command.label(&session).is_empty(), "{command:?} has no label");
            assert!(!all[..i].contains(command), "{command:?} is there twice");
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
}
