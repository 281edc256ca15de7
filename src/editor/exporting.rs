//! Exports: what is asked for, what becomes of each thing, worked out aside, and files written aside.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::app::App;
use super::jobs::Errand;
use super::session::Session;
use crate::export::{Exported, Job, Options, Target, export};
use crate::render::{MethodChoice, Progress};
use crate::scene::{self, Scene};

/// What the dialog asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Form {
    /// What to write.
    pub target: Target,
    /// The names of the lights; all that are not muted where there is no list.
    pub lights: Option<BTreeSet<String>>,
    /// Whether surfaces and their materials go along.
    pub surfaces: bool,
    /// What only some targets look at.
    pub options: Options,
}

/// A form, filled in for a scene.
#[derive(Clone, Debug)]
struct Request {
    scene: Arc<Scene>,
    /// The name of the scene's file.
    scene_name: String,
    /// The name of the file to be written, without its extension.
    stem: String,
    form: Form,
}

impl PartialEq for Request {
    /// Scenes are told apart by identity: every edit makes another.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && (&self.scene_name, &self.stem, &self.form) == (&other.scene_name, &other.stem, &other.form)
    }
}

/// The open dialog.
#[derive(Debug)]
pub struct Exporting {
    /// What is asked for.
    pub form: Form,
    /// Whether things may be lost.
    pub anyway: bool,
    request: Option<Request>,
    errand: Option<Errand<Result<Exported, String>>>,
    found: Option<Result<Arc<Exported>, String>>,
}

impl Form {
    /// The form as it is at first: everything, seen by the view's method.
    fn new(session: &Session) -> Self {
        let options = Options { method: MethodChoice::Method(session.view.method), ..Options::default() };
        Self { target: Target::ALL[0], lights: None, surfaces: true, options }
    }
}

impl Request {
    fn new(session: &Session, form: Form, stem: &str) -> Self {
        Self { scene: Arc::clone(session.scene()), scene_name: scene_name(session), stem: stem.to_owned(), form }
    }

    /// The files and what becomes of each thing.
    fn answer(&self, progress: &Progress) -> Result<Exported, String> {
        let Form { target, ref lights, surfaces, options } = self.form;
        let lights: Option<Vec<String>> = lights.as_ref().map(|names| names.iter().cloned().collect());
        let (scene, scene_name, stem) = (&*self.scene, self.scene_name.as_str(), self.stem.as_str());
        let job = Job { scene, scene_name, stem, target, lights: lights.as_deref(), surfaces, options };
        export(&job, progress).map_err(|error| error.to_string())
    }
}

impl Exporting {
    /// A dialog for these lights, or for the whole scene.
    pub fn new(session: &Session, last: Option<Form>, lights: Option<BTreeSet<String>>) -> Self {
        let form = last.unwrap_or_else(|| Form::new(session));
        let surfaces = lights.is_none() && form.surfaces;
        let form = Form { lights, surfaces, ..form };
        Self { form, anyway: false, request: None, errand: None, found: None }
    }

    /// Look anew at what becomes of each thing where something else is asked for; what is overtaken is given up.
    pub fn update(&mut self, ctx: &egui::Context, session: &Session) {
        let request = Request::new(session, self.form.clone(), &stem(session));
        if self.request.as_ref() != Some(&request) {
            self.request = Some(request.clone());
            self.found = None;
            self.anyway = false;
            self.errand = Some(Errand::start(ctx, move |progress| request.answer(progress)));
        }
        if let Some(found) = self.errand.as_ref().and_then(Errand::poll) {
            self.found = Some(found.map(Arc::new));
            self.errand = None;
            ctx.request_repaint();
        }
    }

    /// What becomes of each thing, or why there is no export; `None` while that is being worked out.
    pub fn found(&self) -> Option<Result<&Exported, &str>> {
        self.found.as_ref().map(|found| found.as_deref().map_err(String::as_str))
    }

    /// Whether the files may be written.
    pub fn is_ready(&self) -> bool {
        self.found().is_some_and(|found| found.is_ok_and(|exported| self.anyway || !exported.has_losses()))
    }

    /// Whether it is being worked out what becomes of each thing.
    pub fn is_busy(&self) -> bool {
        self.errand.is_some()
    }
}

/// What is to be written once it is known where.
#[derive(Clone, Debug)]
pub struct Ordered {
    request: Request,
    found: Arc<Exported>,
}

impl App {
    /// Show the dialog, for the selected lights or for the whole scene.
    pub fn open_export(&mut self, only_selected: bool) {
        let session = &self.session;
        let selected = session.selected_lights().into_iter().filter_map(|i| session.scene().lights.get(i));
        let names = only_selected.then(|| selected.map(|light| light.name.clone()).collect());
        self.exporting = Some(Exporting::new(session, self.files.last_export.clone(), names));
    }

    /// Ask where to put what the dialog asks for.
    pub(super) fn order_export(&mut self, ctx: &egui::Context) {
        let Some(Exporting { request: Some(request), found: Some(Ok(found)), .. }) = self.exporting.take() else {
            return;
        };
        self.files.last_export = Some(Form { lights: None, ..request.form.clone() });
        let name = format!("{}.{}", request.stem, request.form.target.extension());
        self.ask_where_to_export(ctx, &name, Ordered { request, found });
    }

    /// Write what was ordered, aside: all files or none.
    pub(super) fn write_export(&mut self, ctx: &egui::Context, path: &Path, ordered: Ordered) {
        let Ordered { request, found } = ordered;
        let path = with_extension(path, request.form.target.extension());
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        self.write_aside(ctx, path.clone(), move |progress| {
            // Files name each other: under another name they are others.
            let exported =
                if stem == request.stem { found } else { Arc::new(Request { stem, ..request }.answer(progress)?) };
            let files = exported.placed(&path);
            scene::replace_files(&files).map_err(|(path, error)| format!("{}: {error}", path.display()))
        });
    }
}

/// `path` with that extension, where it has none.
pub fn with_extension(path: &Path, extension: &str) -> PathBuf {
    if path.extension().is_none() { path.with_extension(extension) } else { path.to_owned() }
}

/// What files that are written name as their scene.
pub(super) fn scene_name(session: &Session) -> String {
    let file = session.path.as_deref().and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
    file.unwrap_or_else(|| session.title())
}

/// What the file to be written is called at first, without its extension.
fn stem(session: &Session) -> String {
    let of_file = session.path.as_deref().and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
    of_file.unwrap_or_else(|| session.title().to_lowercase().replace(' ', "-"))
}
