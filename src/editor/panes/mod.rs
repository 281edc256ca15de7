//! The panes, and how they share the window.

mod bars;
mod context;
mod export;
mod gesture;
mod inspector;
mod keys;
mod layout;
mod library;
mod links;
mod look;
mod menu;
mod messages;
mod outliner;
mod overlays;
mod painter;
mod palette;
mod plots;
mod problems;
mod renaming;
mod variants;

pub(super) use context::view_menu;
pub(super) use export::ask_export;
pub use inspector::Inspector;
pub use keys::Keys;
pub use layout::Layout;
pub use library::Library;
pub(super) use library::has_lights;
pub use menu::{menu_bar, toolbar};
pub use messages::Messages;
pub use outliner::Outliner;
pub use overlays::{Choice, Recover, ask_recover, ask_unsaved, drop_hint, first_steps};
pub use painter::Painter;
pub use palette::{Outcome, Palette};
pub use plots::{Plots, Work};
pub use problems::Problems;
pub use variants::Variants;

use egui::{Button, Color32, Response, Ui, WidgetText, vec2};
use egui_material_icons::MaterialIcon;
use egui_tiles::{SimplificationOptions, TileId, Tiles, UiResponse};

use super::commands::Command;
use super::library::thumbnails::Thumbnails;
use super::session::Session;
use super::viewport::Viewport;

/// One pane of the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Pane {
    /// The picture.
    Viewport,
    /// The list of what is in the scene.
    Outliner,
    /// The numbers of what is selected.
    Inspector,
    /// Curves at a probe.
    Plots,
    /// The pattern of a textured light.
    Painter,
    /// What is wrong.
    Problems,
    /// Named states of the lights.
    Variants,
    /// Presets and scenes.
    Library,
}

impl Pane {
    /// What its tab says.
    pub fn title(self) -> &'static str {
        match self {
            Self::Viewport => "View",
            Self::Outliner => "Outliner",
            Self::Inspector => "Inspector",
            Self::Plots => "Plots",
            Self::Painter => "Painter",
            Self::Problems => "Problems",
            Self::Variants => "Variants",
            Self::Library => "Library",
        }
    }
}

/// The panes' own state.
#[derive(Default)]
pub struct Views {
    /// The view into the scene; none without a device to draw on.
    pub viewport: Option<Viewport>,
    /// The list of what is in the scene.
    pub outliner: Outliner,
    /// The numbers of what is selected.
    pub inspector: Inspector,
    /// Curves at a probe.
    pub plots: Plots,
    /// What is wrong.
    pub problems: Problems,
    /// The pattern of a textured light.
    pub painter: Painter,
    /// Named states of the lights.
    pub variants: Variants,
    /// Presets and scenes.
    pub library: Library,
    /// Their small pictures.
    pub thumbnails: Thumbnails,
}

/// What the panes are shown with, and what they ask for.
pub struct Panes<'a> {
    /// The document.
    pub session: &'a mut Session,
    /// The panes' own state.
    pub views: &'a mut Views,
    /// Commands asked for in a pane.
    pub commands: Vec<Command>,
}

impl egui_tiles::Behavior<Pane> for Panes<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, _tile_id: TileId, pane: &mut Pane) -> UiResponse {
        ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
        match pane {
            Pane::Viewport => {
                if let Some(viewport) = &mut self.views.viewport {
                    viewport.show(ui, self.session);
                }
            }
            Pane::Outliner => self.commands.extend(self.views.outliner.show(ui, self.session)),
            Pane::Inspector => self.commands.extend(self.views.inspector.show(ui, self.session)),
            Pane::Plots => self.commands.extend(self.views.plots.show(ui, self.session)),
            Pane::Problems => self.commands.extend(self.views.problems.show(ui, self.session)),
            Pane::Painter => self.commands.extend(self.views.painter.show(ui, self.session)),
            Pane::Variants => self.commands.extend(self.views.variants.show(ui, self.session)),
            Pane::Library => {
                let Views { library, thumbnails, .. } = self.views;
                self.commands.extend(library.show(ui, self.session, thumbnails));
            }
        }
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> WidgetText {
        match (pane, self.views.problems.count()) {
            (Pane::Problems, count @ 1..) => format!("{} ({count})", pane.title()).into(),
            _ => pane.title().into(),
        }
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions { all_panes_must_have_tabs: true, ..SimplificationOptions::default() }
    }

    fn gap_width(&self, _style: &egui::Style) -> f32 {
        layout::GAP
    }

    fn min_size(&self) -> f32 {
        80.0
    }

    fn tab_bar_color(&self, visuals: &egui::Visuals) -> Color32 {
        visuals.extreme_bg_color
    }

    fn tab_bg_color(
        &self,
        visuals: &egui::Visuals,
        _: &Tiles<Pane>,
        _: TileId,
        state: &egui_tiles::TabState,
    ) -> Color32 {
        if state.active { visuals.panel_fill } else { Color32::TRANSPARENT }
    }

    fn tab_outline_stroke(
        &self,
        _: &egui::Visuals,
        _: &Tiles<Pane>,
        _: TileId,
        _: &egui_tiles::TabState,
    ) -> egui::Stroke {
        egui::Stroke::NONE
    }
}

/// A small button that is only an icon, found by `name`.
pub(in crate::editor) fn icon_button(ui: &mut Ui, icon: MaterialIcon, color: Color32, name: &str) -> Response {
    let button = Button::new(icon.rich_text().size(15.0).color(color)).frame(false).min_size(vec2(20.0, 20.0));
    ui.add(button).on_hover_text(name).accessible_name(name)
}
