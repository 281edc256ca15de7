//! The program's window: it puts menu, toolbar, panes and status bar together, and passes commands on.

use std::path::Path;

use egui::{CentralPanel, Frame, Margin, Panel, Ui, ViewportCommand};

use super::commands::{self, Command};
use super::dialogs::Dialogs;
use super::drops;
use super::exporting::Exporting;
use super::files::{Files, Then};
use super::folders::Folders;
use super::library::thumbnails::Thumbnails;
use super::panes::{
    self, Choice, Keys, Layout, Library, Messages, Outcome, Palette, Pane, Panes, Recover, Views, Work,
};
use super::recovery::{Offer, Recovery};
use super::session::Session;
use super::theme;
use super::viewport::Viewport;
use crate::gpu::Stats;
use crate::scene;

/// Where the arrangement of panes is kept between runs; another number where old arrangements no longer fit.
const LAYOUT_KEY: &str = "layout-3";
/// Where the recent files are kept between runs.
const RECENT_KEY: &str = "recent";
/// Where it is kept that the first steps need not be shown again.
const STEPS_KEY: &str = "first-steps-done";

/// See the [module](self).
pub struct App {
    /// The open document.
    pub session: Session,
    /// Files and dialogs under way.
    pub files: Files,
    /// How files are chosen.
    pub dialogs: Box<dyn Dialogs>,
    layout: Layout,
    views: Views,
    messages: Messages,
    /// The open export dialog.
    pub(super) exporting: Option<Exporting>,
    keys: Option<Keys>,
    palette: Option<Palette>,
    recovery: Recovery,
    /// What was not saved when the program ended before, and has not been decided on.
    offers: Vec<Offer>,
    first_steps: bool,
    title: String,
}

impl App {
    /// A window on the scene at `path`, or on the one that shows what the program is for.
    pub fn new(
        cc: &eframe::CreationContext<'_>,
        path: Option<&Path>,
        dialogs: Box<dyn Dialogs>,
        folders: &Folders,
    ) -> Self {
        theme::install(&cc.egui_ctx);
        let recent = cc.storage.and_then(|storage| eframe::get_value(storage, RECENT_KEY));
        let layout = cc.storage.and_then(|storage| eframe::get_value(storage, LAYOUT_KEY));
        // Where nothing is kept between runs, they would be shown at every start.
        let is_new = cc.storage.is_some_and(|storage| eframe::get_value::<bool>(storage, STEPS_KEY).is_none());
        let (recovery, offers) = Recovery::new(folders.recovery());
        let mut app = Self {
            session: Session::new(scene::first_light(), None),
            files: Files::new(recent.unwrap_or_default()),
            dialogs,
            layout: layout.unwrap_or_default(),
            views: Views {
                viewport: cc.wgpu_render_state.as_ref().map(Viewport::new),
                library: Library::new(folders),
                thumbnails: Thumbnails::new(folders.thumbnails()),
                ..Views::default()
            },
            messages: Messages::default(),
            exporting: None,
            keys: None,
            palette: None,
            recovery,
            offers,
            first_steps: is_new && path.is_none(),
            title: String::new(),
        };
        if let Some(path) = path {
            app.open(path);
        }
        app
    }

    /// Put all panes where they were at first.
    pub fn reset_layout(&mut self) {
        self.layout = Layout::default();
    }

    /// Bring a pane to the front of its tabs.
    pub fn show_pane(&mut self, pane: Pane) {
        self.layout.reveal(pane);
    }

    /// The curves that have been asked for, and those that have been shown.
    pub fn plot_work(&self) -> Work {
        self.views.plots.work()
    }

    /// The work under way, off this thread, that will change what is shown; `None` when there is none.
    pub fn busy_with(&self) -> Option<&'static str> {
        let work = [
            (self.files.is_waiting(), "files"),
            (self.exporting.as_ref().is_some_and(Exporting::is_busy), "an export"),
            (self.views.plots.is_busy(), "curves"),
            (self.views.thumbnails.is_busy(), "thumbnails"),
            (self.recovery.is_busy(), "the recovery file"),
            (self.views.viewport.as_ref().is_some_and(Viewport::is_busy), "measures"),
        ];
        work.into_iter().find_map(|(is_busy, with)| is_busy.then_some(with))
    }

    /// How often the viewport's picture was redone, by steps; none without a device to draw on.
    pub fn picture_stats(&self) -> Option<Stats> {
        self.views.viewport.as_ref().map(Viewport::stats)
    }

    /// Show or hide the list of keys.
    pub fn toggle_keys(&mut self) {
        self.keys = if self.keys.is_some() { None } else { Some(Keys::default()) };
    }

    /// Show the command palette.
    pub fn open_palette(&mut self) {
        self.palette = Some(Palette::default());
    }

    /// Show what to try first.
    pub fn show_first_steps(&mut self) {
        self.first_steps = true;
    }

    /// Ask in the library what the preset of the selected lights shall be called.
    pub fn name_preset(&mut self) {
        self.show_pane(Pane::Library);
        self.views.library.name_selection(&self.session);
    }

    /// Files dropped on the window, and the window asked to close.
    fn handle_events(&mut self, ctx: &egui::Context) {
        self.take_drops(ctx);
        let closing = ctx.input(|input| input.viewport().close_requested());
        if closing && !self.files.may_close && self.session.history.is_modified() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.files.guard = Some(Then::Quit);
        }
        self.poll_dialogs(ctx);
        self.poll_writing();
        if self.files.guard.is_none() && self.offers.is_empty() && self.exporting.is_none() {
            commands::run_shortcuts(self, ctx);
        }
        if let Some(failure) = self.recovery.update(ctx, &self.session) {
            self.session.failed(failure);
        }
    }

    fn bars(&mut self, ui: &mut Ui) -> Vec<Command> {
        let bar = |ui: &Ui| Frame::new().fill(ui.visuals().panel_fill).inner_margin(Margin::symmetric(8, 3));
        let mut chosen = Vec::new();
        Panel::top("menu").frame(bar(ui)).show(ui, |ui| {
            chosen.extend(panes::menu_bar(ui, &self.session, &self.files, &mut self.views.thumbnails));
        });
        Panel::top("toolbar").frame(bar(ui)).show(ui, |ui| chosen.extend(panes::toolbar(ui, &mut self.session)));
        Panel::bottom("status").frame(bar(ui)).show(ui, |ui| self.status(ui));
        chosen
    }

    fn status(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            if let Some(name) = self.files.written() {
                ui.colored_label(theme::accent(ui.visuals()), format!("Exporting {name}…"));
                if ui.small_button("Cancel export").on_hover_text("Nothing of it is left").clicked() {
                    self.files.cancel_writing();
                }
            }
            ui.label(if self.session.hint.is_empty() { "Ready" } else { self.session.hint.as_str() });
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let scene = self.session.scene();
                let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
                ui.weak(format!("{}, {}", count(scene.lights.len(), "light"), count(scene.surfaces.len(), "surface")));
                if self.session.has_solo() {
                    ui.colored_label(theme::accent(ui.visuals()), "solo");
                }
            });
        });
    }

    fn panes(&mut self, ui: &mut Ui) -> Vec<Command> {
        let gaps = Frame::new().fill(ui.visuals().extreme_bg_color);
        CentralPanel::default()
            .frame(gaps)
            .show(ui, |ui| {
                self.views.problems.update(&self.session);
                let mut panes = Panes { session: &mut self.session, views: &mut self.views, commands: Vec::new() };
                self.layout.show(&mut panes, ui);
                if panes.views.painter.end_frame(panes.session) {
                    ui.ctx().request_repaint();
                }
                panes.commands
            })
            .inner
    }

    fn overlays(&mut self, ctx: &egui::Context) {
        if let Some(then) = self.files.guard.clone() {
            match panes::ask_unsaved(ctx, &self.session.title()) {
                Some(Choice::Save) => self.save_then(ctx, Some(then)),
                Some(Choice::Discard) => self.go_on(ctx, then),
                Some(Choice::Cancel) => self.files.guard = None,
                None => {}
            }
        }
        self.ask_recover(ctx);
        if let Some(exporting) = &mut self.exporting {
            match panes::ask_export(ctx, exporting, &self.session) {
                Some(true) => self.order_export(ctx),
                Some(false) => self.exporting = None,
                // What was changed is looked at in the same frame: there may be no other.
                None => exporting.update(ctx, &self.session),
            }
        }
        if self.keys.as_mut().is_some_and(|keys| keys.show(ctx, &self.session)) {
            self.keys = None;
        }
        if self.first_steps && self.offers.is_empty() {
            self.first_steps = !panes::first_steps(ctx);
        }
        if let Some(palette) = &mut self.palette {
            match palette.show(ctx, &self.session) {
                Outcome::Open => {}
                Outcome::Closed => self.palette = None,
                Outcome::Chosen(command) => {
                    self.palette = None;
                    command.run(self, ctx);
                }
            }
        }
        if let Some(command) = self.messages.show(ctx, &mut self.session) {
            command.run(self, ctx);
        }
        if let Some(hint) = drops::hint(ctx) {
            panes::drop_hint(ctx, hint);
        }
    }

    /// Offer what was not saved when the program ended, one after the other.
    fn ask_recover(&mut self, ctx: &egui::Context) {
        let Some(offer) = self.offers.first() else { return };
        let thumbnail = self.views.thumbnails.get(ctx, &offer.source());
        let Some(answer) = panes::ask_recover(ctx, offer, thumbnail) else { return };
        let offer = self.offers.remove(0);
        match answer {
            Recover::Open => {
                self.recover(&offer);
                // What was left goes when the same work has been written aside anew.
                self.recovery.adopt(&offer, &self.session);
                self.offers.clear();
            }
            Recover::Discard => offer.discard(),
            Recover::Later => self.offers.clear(),
        }
        ctx.request_repaint();
    }

    /// The window's title, when it has changed.
    fn update_title(&mut self, ctx: &egui::Context) {
        let mark = if self.session.history.is_modified() { "*" } else { "" };
        let title = format!("{}{mark} - Softbox", self.session.title());
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        let before = self.session.glance();
        self.handle_events(&ctx);
        let mut chosen = self.bars(ui);
        // Whatever the pointer is over says what it would do.
        let shown_hint = std::mem::take(&mut self.session.hint);
        chosen.extend(self.panes(ui));
        chosen.append(&mut self.session.asked);
        if !chosen.is_empty() {
            ctx.request_repaint();
        }
        for command in chosen {
            command.run(self, &ctx);
        }
        self.overlays(&ctx);
        self.update_title(&ctx);
        // What one pane has changed, those drawn before it show in the next frame.
        if self.session.hint != shown_hint || self.session.glance() != before {
            ctx.request_repaint();
        }
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        eframe::set_value(storage, LAYOUT_KEY, &self.layout);
        eframe::set_value(storage, RECENT_KEY, &self.files.recent);
        if !self.first_steps {
            eframe::set_value(storage, STEPS_KEY, &true);
        }
    }

    fn on_exit(&mut self) {
        self.recovery.close();
    }
}
