//! The menu bar and the toolbar.

use std::path::Path;

use egui::{Button, Id, Ui, vec2};
use egui_material_icons::MaterialIcon;
use egui_material_icons::icons;

use crate::editor::commands::{Command, LightKind, SurfaceKind, view_methods};
use crate::editor::files::Files;
use crate::editor::handles::place::Place;
use crate::editor::handles::{self, frame::Pivot};
use crate::editor::library::Source;
use crate::editor::library::thumbnails::Thumbnails;
use crate::editor::presets;
use crate::editor::session::{Session, Tool, ViewMode};
use crate::editor::theme;
use crate::editor::tools::options;
use crate::editor::tools::outline::OutlineKind;
use crate::scene::PlotKind;

/// The menu bar; the command that was chosen.
pub fn menu_bar(ui: &mut Ui, session: &Session, files: &Files, thumbnails: &mut Thumbnails) -> Option<Command> {
    let mut chosen = None;
    egui::MenuBar::new().ui(ui, |ui| {
        ui.menu_button("File", |ui| file_menu(ui, session, files, thumbnails, &mut chosen));
        ui.menu_button("Edit", |ui| {
            use Command::{Delete, Duplicate, Redo, SelectAll, SelectNone, Undo};
            entries(ui, session, &[Undo, Redo], &mut chosen);
            ui.separator();
            entries(ui, session, &[Duplicate, Delete, SelectAll, SelectNone], &mut chosen);
            ui.separator();
            entries(ui, session, &[Command::ToggleAxes], &mut chosen);
            ui.menu_button("Pivot", |ui| entries(ui, session, &Pivot::ALL.map(Command::Pivot), &mut chosen));
            ui.menu_button("Place light", |ui| {
                let placing = Tool::ALL.into_iter().filter(|tool| tool.places());
                entries(ui, session, &placing.map(Command::Tool).collect::<Vec<_>>(), &mut chosen);
            });
            ui.separator();
            entries(ui, session, &[Command::ToggleMute, Command::ToggleSolo, Command::SavePreset], &mut chosen);
        });
        ui.menu_button("Add", |ui| {
            ui.menu_button("Light", |ui| entries(ui, session, &LightKind::ALL.map(Command::AddLight), &mut chosen));
            ui.menu_button("Outline", |ui| {
                entries(ui, session, &OutlineKind::ALL.map(Command::Outline), &mut chosen);
            });
            ui.menu_button("Surface", |ui| {
                entries(ui, session, &SurfaceKind::ALL.map(Command::AddSurface), &mut chosen);
            });
            entry(ui, session, &Command::AddMaterial, &mut chosen);
            ui.menu_button("Plot", |ui| {
                let kinds = [PlotKind::Tilt, PlotKind::View, PlotKind::Line, PlotKind::Distance];
                entries(ui, session, &kinds.map(Command::AddPlot), &mut chosen);
            });
        });
        ui.menu_button("View", |ui| view_menu(ui, session, &mut chosen));
        ui.menu_button("Help", |ui| {
            entries(ui, session, &[Command::Palette, Command::Keys, Command::FirstSteps], &mut chosen)
        });
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let mark = if session.history.is_modified() { " *" } else { "" };
            ui.weak(format!("{}{mark}", session.title()));
        });
    });
    chosen
}

fn file_menu(ui: &mut Ui, session: &Session, files: &Files, thumbnails: &mut Thumbnails, chosen: &mut Option<Command>) {
    entries(ui, session, &[Command::New, Command::Open], chosen);
    ui.menu_button("Open recent", |ui| {
        if files.recent.is_empty() {
            ui.weak("none yet");
        }
        for path in &files.recent {
            recent(ui, path, thumbnails, chosen);
        }
    });
    ui.menu_button("Open example", |ui| {
        for preset in presets::SCENES {
            entry(ui, session, &Command::OpenExample(*preset), chosen);
        }
    });
    ui.menu_button("Insert preset", |ui| {
        for preset in presets::LIGHTS {
            entry(ui, session, &Command::InsertPreset(*preset), chosen);
        }
    });
    ui.separator();
    entries(ui, session, &[Command::Save, Command::SaveAs, Command::Export], chosen);
    ui.separator();
    entry(ui, session, &Command::Quit, chosen);
}

/// A scene that was open before: its picture, its name and its folder; greyed out where it is gone.
fn recent(ui: &mut Ui, path: &Path, thumbnails: &mut Thumbnails, chosen: &mut Option<Command>) {
    let exists = path.exists();
    let texture = if exists { thumbnails.get(ui.ctx(), &Source::file(path)) } else { None };
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let folder = path.parent().unwrap_or(Path::new("")).display().to_string();
    let size = vec2(48.0, 30.0);
    let button = match texture {
        Some(texture) => Button::new((egui::Image::new((texture.id(), size)).fit_to_exact_size(size), name.as_ref())),
        None => Button::new((icons::ICON_IMAGE.rich_text().size(30.0).weak(), name.as_ref())),
    };
    let button = button.min_size(vec2(220.0, 34.0));
    let response = ui.add_enabled(exists, button).accessible_name(path.display().to_string());
    let response = response.on_hover_text(&folder).on_disabled_hover_text(format!("It is not in {folder} any more"));
    if response.clicked() {
        *chosen = Some(Command::OpenFile(path.to_owned()));
    }
}

fn view_menu(ui: &mut Ui, session: &Session, chosen: &mut Option<Command>) {
    let methods: Vec<_> = view_methods(session.scene()).into_iter().map(Command::Method).collect();
    ui.menu_button("Shading method", |ui| entries(ui, session, &methods, chosen));
    ui.menu_button("Show in viewport", |ui| entries(ui, session, &ViewMode::ALL.map(Command::ViewMode), chosen));
    entries(ui, session, &[Command::AutoExposure, Command::ToggleMeasure], chosen);
    ui.separator();
    entries(ui, session, &[1, 2, 4].map(Command::Viewports), chosen);
    entry(ui, session, &Command::LinkViews, chosen);
    ui.separator();
    entries(ui, session, &[Command::Focus, Command::FrameAll, Command::ResetView, Command::SaveView], chosen);
    ui.separator();
    entries(
        ui,
        session,
        &[Command::ToggleEmitters, Command::ToggleShadows, Command::ToggleGrid, Command::ToggleSnap],
        chosen,
    );
    ui.separator();
    let window = [Command::ZoomIn, Command::ZoomOut, Command::ZoomReset, Command::ToggleTheme, Command::ResetLayout];
    entries(ui, session, &window, chosen);
}

/// Commands in a menu.
pub(super) fn entries(ui: &mut Ui, session: &Session, commands: &[Command], chosen: &mut Option<Command>) {
    for command in commands {
        entry(ui, session, command, chosen);
    }
}

/// One command in a menu, with its key, greyed out where it cannot be done.
fn entry(ui: &mut Ui, session: &Session, command: &Command, chosen: &mut Option<Command>) {
    let label = command.label(session);
    let mut button = match command {
        Command::AddLight(kind) => Button::new((light_icon(*kind).rich_text(), label.as_str())),
        _ => Button::new(label.as_str()),
    };
    button = button.selected(command.checked(session) == Some(true));
    if let Some(shortcut) = command.shortcut() {
        button = button.shortcut_text(ui.ctx().format_shortcut(&shortcut));
    }
    let mut response = ui.add_enabled(command.enabled(session), button).accessible_name(&label);
    if let Some(hint) = command.hint() {
        response = response.on_hover_text(hint);
    }
    if response.clicked() {
        *chosen = Some(command.clone());
    }
}

/// The toolbar; the command that was chosen. What does not fit in its row stands in a second one.
pub fn toolbar(ui: &mut Ui, session: &mut Session) -> Option<Command> {
    let mut chosen = None;
    let key = ui.scope_id().with(("width of the options", session.tool, session.outline.kind));
    // As wide as they were when they were last shown.
    let needed: f32 = ui.data(|data| data.get_temp(key)).unwrap_or_default();
    let mut fits = true;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for (icon, command) in [
            (icons::ICON_NOTE_ADD, Command::New),
            (icons::ICON_FOLDER_OPEN, Command::Open),
            (icons::ICON_SAVE, Command::Save),
        ] {
            tool_button(ui, session, icon, command, &mut chosen);
        }
        ui.separator();
        tool_button(ui, session, icons::ICON_UNDO, Command::Undo, &mut chosen);
        tool_button(ui, session, icons::ICON_REDO, Command::Redo, &mut chosen);
        ui.separator();
        for tool in Tool::ALL {
            tool_button(ui, session, tool_icon(tool), Command::Tool(tool), &mut chosen);
        }
        ui.separator();
        tool_button(ui, session, icons::ICON_CENTER_FOCUS_STRONG, Command::Focus, &mut chosen);
        tool_button(ui, session, icons::ICON_ZOOM_OUT_MAP, Command::FrameAll, &mut chosen);
        ui.separator();
        // What the tool in hand is set to comes last, so that nothing else moves; while drawing it needs all the room.
        fits = needed <= ui.available_width();
        if fits {
            tool_options(ui, session, key, &mut chosen);
        }
    });
    if !fits {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 3.0;
            tool_options(ui, session, key, &mut chosen);
        });
    }
    chosen
}

/// What the tool in hand is set to; how wide that is goes to `key`.
fn tool_options(ui: &mut Ui, session: &mut Session, key: Id, chosen: &mut Option<Command>) {
    let start = ui.cursor().left();
    if !session.tool.draws() {
        tool_button(ui, session, icons::ICON_CROP_SQUARE, Command::Viewports(1), chosen);
        tool_button(ui, session, icons::ICON_SPLITSCREEN_RIGHT, Command::Viewports(2), chosen);
        tool_button(ui, session, icons::ICON_GRID_VIEW, Command::Viewports(4), chosen);
        ui.separator();
        handles::toolbar::show(ui, session, chosen);
        ui.separator();
    }
    options::show(ui, session);
    let width = ui.min_rect().right() - start;
    if ui.data(|data| data.get_temp(key)) != Some(width) {
        ui.data_mut(|data| data.insert_temp(key, width));
        ui.ctx().request_repaint();
    }
}

fn tool_button(ui: &mut Ui, session: &Session, icon: MaterialIcon, command: Command, chosen: &mut Option<Command>) {
    let label = command.label(session);
    let key = command.shortcut().map(|shortcut| ui.ctx().format_shortcut(&shortcut));
    let hover = key.map_or_else(|| label.clone(), |key| format!("{label}  ({key})"));
    let on = command.checked(session) == Some(true);
    let text = icon.rich_text().size(17.0);
    let text = if on { text.color(theme::accent(ui.visuals())) } else { text };
    let button = Button::selectable(on, text).min_size(vec2(28.0, 26.0));
    let response = ui.add_enabled(command.enabled(session), button).on_hover_text(hover);
    if response.accessible_name(label).clicked() {
        *chosen = Some(command);
    }
}

/// The icon of a shape of light.
pub(super) fn light_icon(kind: LightKind) -> MaterialIcon {
    match kind {
        LightKind::Polygon => icons::ICON_PENTAGON,
        LightKind::Disk => icons::ICON_ADJUST,
        LightKind::Textured => icons::ICON_TEXTURE,
        LightKind::Line => icons::ICON_HORIZONTAL_RULE,
        LightKind::Sphere => icons::ICON_LENS,
        LightKind::Cap => icons::ICON_WB_TWILIGHT,
        LightKind::Sky => icons::ICON_CLOUD,
        LightKind::Point => icons::ICON_FLARE,
        LightKind::Measured => icons::ICON_TRACK_CHANGES,
        LightKind::Directional => icons::ICON_SUNNY,
    }
}

fn tool_icon(tool: Tool) -> MaterialIcon {
    match tool {
        Tool::Move => icons::ICON_OPEN_WITH,
        Tool::Rotate => icons::ICON_360,
        Tool::Scale => icons::ICON_RESIZE,
        Tool::Polygon => icons::ICON_PENTAGON,
        Tool::Line => icons::ICON_SHAPE_LINE,
        Tool::Sphere => icons::ICON_CIRCLE,
        Tool::Aim => icons::ICON_MY_LOCATION,
        Tool::Place(Place::Highlight) => icons::ICON_AUTO_AWESOME,
        Tool::Place(Place::Diffuse) => icons::ICON_LIGHT_MODE,
        Tool::Place(Place::Rim) => icons::ICON_BEDTIME,
        Tool::Textured => icons::ICON_TEXTURE,
        Tool::Outline => icons::ICON_INTERESTS,
    }
}
