//! Opening, saving, recent files, and the guard that keeps unsaved work from being lost.

use std::path::{Path, PathBuf};

use super::app::App;
use super::dialogs::{Answer, Reply};
use super::edits;
use super::exporting::{Form, Ordered, scene_name, with_extension};
use super::jobs::Errand;
use super::presets::Preset;
use super::recovery::Offer;
use super::session::{Notice, Session};
use crate::analysis::Sheet;
use crate::export::Origin;
use crate::export::plot::PlotFormat;
use crate::import::usda;
use crate::render::Progress;
use crate::scene::{self, History, Scene};
use crate::surface::Shape;

/// How many recent files are kept.
const MOST_RECENT: usize = 10;

/// What replaces the open document.
#[derive(Clone, Debug, PartialEq)]
pub enum Then {
    /// An empty document.
    New,
    /// A scene that the user chooses.
    Choose,
    /// That scene.
    Open(PathBuf),
    /// A scene that comes with the program.
    Example(Preset),
    /// Nothing: the window closes.
    Quit,
}

/// What the file commands are waiting for.
#[derive(Debug, Default)]
pub struct Files {
    /// Scenes opened or saved last, the latest first.
    pub recent: Vec<PathBuf>,
    /// The document is modified, and the user must say whether to save it before this.
    pub guard: Option<Then>,
    /// What the export dialog asked for last.
    pub last_export: Option<Form>,
    /// Exports that are being written.
    writing: Vec<Writing>,
    /// A dialog is open.
    waiting: Option<(Answer, Purpose)>,
    /// The window may close without asking again.
    pub may_close: bool,
}

/// What an open dialog is for.
#[derive(Debug)]
enum Purpose {
    Open,
    /// Save, and then go on.
    Save(Option<Then>),
    /// Add a light with a pattern, or give another pattern to the light of that name.
    Pattern(Option<String>),
    /// Add a point light of an IES file, or give another file to the light of that name.
    Photometry(Option<String>),
    /// Add a surface with a mesh, or give another mesh to the surface of that name.
    Mesh(Option<String>),
    /// Write a plot.
    Plot(PlotFormat, Box<Sheet>),
    /// Write an export.
    Export(Box<Ordered>),
}

/// A file that is being written aside.
#[derive(Debug)]
struct Writing {
    path: PathBuf,
    errand: Errand<Result<(), String>>,
}

/// What to do where the desktop has no file dialogs.
const NO_DIALOG: &str = "This desktop shows no file dialog: install xdg-desktop-portal or zenity; scenes can be opened by \
                         dropping them on the window or from the command line, too";

impl Files {
    /// Nothing under way, and these files opened before.
    pub fn new(recent: Vec<PathBuf>) -> Self {
        Self { recent, ..Self::default() }
    }

    /// Whether a dialog is open, or a file is being written.
    pub fn is_waiting(&self) -> bool {
        self.waiting.is_some() || !self.writing.is_empty()
    }

    /// The name of the export that is being written.
    pub fn written(&self) -> Option<String> {
        self.writing.first().map(|writing| name_of(&writing.path))
    }

    /// Stop writing exports; nothing of them is left.
    pub fn cancel_writing(&mut self) {
        self.writing.clear();
    }

    fn remember(&mut self, path: &Path) {
        self.recent.retain(|other| other != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(MOST_RECENT);
    }
}

impl App {
    /// Leave the document for `then`; if it is modified, ask first.
    pub fn leave(&mut self, ctx: &egui::Context, then: Then) {
        if self.session.history.is_modified() {
            self.files.guard = Some(then);
        } else {
            self.go_on(ctx, then);
        }
    }

    /// Leave the document, whatever happens to it.
    pub fn go_on(&mut self, ctx: &egui::Context, then: Then) {
        self.files.guard = None;
        match then {
            Then::New => self.replace(starting_scene(), None),
            Then::Open(path) => self.open(&path),
            Then::Example(preset) => match preset.load() {
                Ok(scene) => self.replace(scene, None),
                Err(error) => self.session.failed(error.to_string()),
            },
            Then::Choose => {
                let answer = self.dialogs.open_scene(ctx, self.folder().as_deref());
                self.files.waiting = Some((answer, Purpose::Open));
            }
            Then::Quit => {
                self.files.may_close = true;
                ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            }
        }
    }

    /// Open a scene file in place of the document.
    pub fn open(&mut self, path: &Path) {
        match scene::load(path) {
            Ok(scene) => {
                self.files.remember(path);
                self.replace(scene, Some(path.to_owned()));
            }
            Err(error) => self.session.failed(error.to_string()),
        }
    }

    /// Save to the document's file, or ask where.
    pub fn save(&mut self, ctx: &egui::Context) {
        self.save_then(ctx, None);
    }

    /// Ask where to save.
    pub fn save_as(&mut self, ctx: &egui::Context) {
        self.ask_where(ctx, None);
    }

    /// Save, and if that worked go on.
    pub fn save_then(&mut self, ctx: &egui::Context, then: Option<Then>) {
        self.files.guard = None;
        match self.session.path.clone() {
            Some(path) => self.write(ctx, &path, then),
            None => self.ask_where(ctx, then),
        }
    }

    /// Take the answer of a dialog, if one has come.
    pub fn poll_dialogs(&mut self, ctx: &egui::Context) {
        let Some((answer, _)) = &self.files.waiting else { return };
        let Some(reply) = answer.poll() else { return };
        let Some((_, purpose)) = self.files.waiting.take() else { return };
        match (reply, purpose) {
            (Reply::Cancelled, _) => {}
            (Reply::Unavailable, _) => self.session.failed(NO_DIALOG),
            (Reply::Chosen(path), Purpose::Open) => self.open(&path),
            (Reply::Chosen(path), Purpose::Save(then)) => {
                self.write(ctx, &with_extension(&path, "toml"), then);
            }
            (Reply::Chosen(path), Purpose::Pattern(light)) => self.use_pattern(&path, light.as_deref()),
            (Reply::Chosen(path), Purpose::Photometry(light)) => self.use_photometry(&path, light.as_deref()),
            (Reply::Chosen(path), Purpose::Mesh(surface)) => self.use_mesh(&path, surface.as_deref()),
            (Reply::Chosen(path), Purpose::Plot(format, sheet)) => self.write_plot(ctx, &path, format, sheet),
            (Reply::Chosen(path), Purpose::Export(ordered)) => self.write_export(ctx, &path, *ordered),
        }
    }

    /// Say what has been written aside, and what has not.
    pub fn poll_writing(&mut self) {
        self.files.writing.retain(|Writing { path, errand }| match errand.poll() {
            None => true,
            Some(Ok(())) => {
                self.session.done(format!("Exported {}", path.display()));
                false
            }
            Some(Err(error)) => {
                self.session.failed(format!("{} was not exported: {error}", name_of(path)));
                false
            }
        });
    }

    /// Write files aside; `path` is the main one.
    pub(super) fn write_aside(
        &mut self,
        ctx: &egui::Context,
        path: PathBuf,
        write: impl FnOnce(&Progress) -> Result<(), String> + Send + 'static,
    ) {
        self.files.writing.push(Writing { path, errand: Errand::start(ctx, write) });
    }

    /// Ask where to write an export that would be called `name`.
    pub(super) fn ask_where_to_export(&mut self, ctx: &egui::Context, name: &str, ordered: Ordered) {
        let answer = self.dialogs.export(ctx, self.folder().as_deref(), name);
        self.files.waiting = Some((answer, Purpose::Export(Box::new(ordered))));
    }

    /// Ask for a picture: for a new light, or for the light of that name.
    pub fn choose_pattern(&mut self, ctx: &egui::Context, light: Option<String>) {
        let answer = self.dialogs.open_picture(ctx, self.folder().as_deref());
        self.files.waiting = Some((answer, Purpose::Pattern(light)));
    }

    pub(super) fn use_pattern(&mut self, path: &Path, light: Option<&str>) {
        match (scene::import_pattern(path, self.session.path.as_deref()), light) {
            (Ok(pattern), None) => self.session.add_light(edits::textured(pattern)),
            (Ok(pattern), Some(name)) => self.session.replace_pattern(name, pattern),
            (Err(error), _) => self.session.failed(error),
        }
    }

    /// Ask for an IES file: for a new light, or for the light of that name.
    pub fn choose_photometry(&mut self, ctx: &egui::Context, light: Option<String>) {
        let answer = self.dialogs.open_photometry(ctx, self.folder().as_deref());
        self.files.waiting = Some((answer, Purpose::Photometry(light)));
    }

    /// Add a point light with the intensities of a file, or give them to the light of that name.
    pub(super) fn use_photometry(&mut self, path: &Path, light: Option<&str>) {
        match (scene::import_photometry(path, self.session.path.as_deref()), light) {
            (Ok(photometry), None) => self.session.add_light(edits::measured(photometry)),
            (Ok(photometry), Some(name)) => self.session.replace_photometry(name, photometry),
            (Err(error), _) => self.session.failed(error),
        }
    }

    /// Ask for an OBJ file: for a new surface, or for the surface of that name.
    pub fn choose_mesh(&mut self, ctx: &egui::Context, surface: Option<String>) {
        let answer = self.dialogs.open_mesh(ctx, self.folder().as_deref());
        self.files.waiting = Some((answer, Purpose::Mesh(surface)));
    }

    /// Add a surface with the mesh of a file, or give it to the surface of that name.
    pub(super) fn use_mesh(&mut self, path: &Path, surface: Option<&str>) {
        match (scene::import_mesh(path, self.session.path.as_deref()), surface) {
            (Ok(mesh), None) => self.session.add_surface(Shape::Mesh(mesh)),
            (Ok(mesh), Some(name)) => self.session.replace_mesh(name, mesh),
            (Err(error), _) => self.session.failed(error),
        }
    }

    /// Ask where to write a plot.
    pub fn export_plot(&mut self, ctx: &egui::Context, format: PlotFormat, sheet: Box<Sheet>) {
        let safe = |c: char| if c.is_alphanumeric() { c } else { '-' };
        let stem: String = sheet.plot.name.chars().map(safe).collect();
        let name = format!("{}.{}", stem.to_lowercase(), format.extension());
        let answer = self.dialogs.export(ctx, self.folder().as_deref(), &name);
        self.files.waiting = Some((answer, Purpose::Plot(format, sheet)));
    }

    /// Write a plot whole, or not at all.
    fn write_plot(&mut self, ctx: &egui::Context, path: &Path, format: PlotFormat, sheet: Box<Sheet>) {
        let path = with_extension(path, format.extension());
        let scene = scene_name(&self.session);
        self.write_aside(ctx, path.clone(), move |_| {
            let origin = Origin { scene: &scene };
            let bytes = format.write(std::slice::from_ref(&*sheet), origin).map_err(|error| error.to_string())?;
            scene::replace_file(&path, &bytes).map_err(|error| error.to_string())
        });
    }

    /// Add the lights of a preset to the document.
    pub fn insert_preset(&mut self, preset: Preset) {
        match preset.load() {
            Ok(scene) => self.insert_scene(&preset.title(), &scene),
            Err(error) => self.session.failed(error.to_string()),
        }
    }

    /// Add the lights of a preset in a file to the document.
    pub fn insert_file(&mut self, path: &Path) {
        match scene::load(path) {
            Ok(scene) => {
                let stem = path.file_stem().unwrap_or_default().to_string_lossy();
                let title = if scene.name.is_empty() { stem.into_owned() } else { scene.name.clone() };
                self.insert_scene(&title, &scene);
            }
            Err(error) => self.session.failed(error.to_string()),
        }
    }

    /// Add the UsdLux lights of a stage to the document, and say what is not as it was there.
    pub(super) fn insert_stage(&mut self, path: &Path) {
        match usda::read_file(path) {
            Ok(imported) => {
                self.insert_scene(&imported.scene.name, &imported.scene);
                if let Some(first) = imported.remarks.first() {
                    let more = imported.remarks.len() - 1;
                    let others = if more > 0 {
                        format!(" (and {more} more, which `softbox import` lists)")
                    } else {
                        String::new()
                    };
                    self.session.done(format!("Not all is as it was: line {first}{others}"));
                }
            }
            Err(error) => self.session.failed(format!("{}: {error}", path.display())),
        }
    }

    fn insert_scene(&mut self, title: &str, scene: &Scene) {
        self.session.insert_lights(&format!("Insert {title}"), scene);
        self.session.undoable(format!("Inserted {title}"));
    }

    /// Open work that was not saved when the program ended. It is a changed document until it is saved.
    pub(super) fn recover(&mut self, offer: &Offer) {
        match offer.load() {
            Ok(scene) => {
                let saved = offer.path.as_deref().and_then(|path| scene::load(path).ok()).unwrap_or_default();
                self.replace(saved, offer.path.clone());
                self.session.history = History::changed(scene, self.session.scene());
                self.session.reset_view();
                self.session.done(format!("Recovered {}", offer.title));
            }
            Err(error) => self.session.failed(error.to_string()),
        }
    }

    fn replace(&mut self, scene: Scene, path: Option<PathBuf>) {
        let old = std::mem::replace(&mut self.session, Session::new(scene, path));
        self.session.notices = old.notices;
        self.session.work_plane = old.work_plane;
        self.session.outline = old.outline;
        self.session.look_like(old.view, old.views);
    }

    fn ask_where(&mut self, ctx: &egui::Context, then: Option<Then>) {
        let name = match &self.session.path {
            Some(path) => path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            None => format!("{}.toml", self.session.title().to_lowercase().replace(' ', "-")),
        };
        let answer = self.dialogs.save_scene(ctx, self.folder().as_deref(), &name);
        self.files.waiting = Some((answer, Purpose::Save(then)));
    }

    fn write(&mut self, ctx: &egui::Context, path: &Path, then: Option<Then>) {
        let source = self.session.path.clone().unwrap_or_else(|| path.to_owned());
        let saved = self.session.history.saved().clone();
        let saved = (source == path).then_some(&*saved);
        // Painted patterns get their files, so that what is saved is what is open.
        let painted = scene::with_painted_files(self.session.scene(), path, saved);
        if let Ok(Some(painted)) = painted {
            self.session.history.amend(|scene| *scene = painted);
        }
        match scene::save_over(self.session.scene(), path, &source, saved) {
            Ok(()) => {
                self.session.history.mark_saved();
                self.session.path = Some(path.to_owned());
                self.session.done(format!("Saved {}", self.session.title()));
                self.files.remember(path);
                if let Some(then) = then {
                    self.go_on(ctx, then);
                }
            }
            Err(error) => self.session.notices.push(Notice::Unsaved(error.to_string())),
        }
    }

    /// Where dialogs start: by the document, or by the scene that was open last.
    fn folder(&self) -> Option<PathBuf> {
        let path = self.session.path.as_ref().or(self.files.recent.first())?;
        path.parent().filter(|folder| folder.is_dir()).map(Path::to_owned)
    }
}

fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// What *New* starts with: a floor, a ball and a box, and no light yet.
pub fn starting_scene() -> Scene {
    use crate::surface::{Material, ReflectionModel, Surface};
    use glam::DVec3;
    let surface = |name: &str, position: DVec3, shape| Surface {
        name: name.to_owned(),
        material: "plaster".to_owned(),
        position,
        rotation_deg: DVec3::ZERO,
        scale: DVec3::ONE,
        shape,
    };
    Scene {
        materials: vec![Material {
            name: "plaster".to_owned(),
            diffuse: DVec3::splat(0.5),
            specular: DVec3::splat(0.2),
            model: ReflectionModel::default(),
            exponent: 32.0,
        }],
        surfaces: vec![
            surface("floor", DVec3::ZERO, Shape::Plane {}),
            surface("ball", DVec3::new(-0.7, 0.0, 0.5), Shape::Sphere { radius: 0.5 }),
            surface("box", DVec3::new(0.8, 0.2, 0.4), Shape::Box { size: DVec3::splat(0.8) }),
        ],
        ..Scene::default()
    }
}
