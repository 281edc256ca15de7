//! The open document and what the editor knows about it: selection, tool, view, plots shown, and messages.
//!
//! The document itself changes only through [`Session::edit`] and the gesture calls, so that every change is an undo
//! step. Everything else here is the editor's own and is not saved with the scene.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec2;

use super::commands::Command;
use super::handles::corners::Corner;
use super::handles::frame::Transform;
use super::handles::place::Place;
use super::plotting::PlotState;
pub use super::selection::{Item, Selection};
use super::tools::outline::Outline;
use super::tools::work_plane::WorkPlane;
use super::variants;
pub use super::views::{ViewMode, ViewState, Views};
use crate::analysis::Rectangle;
use crate::light::pattern::Image;
use crate::light::{Light, Shape};
use crate::scene::{Camera, History, Scene};

/// What the mouse does in the viewport.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tool {
    /// Select, move and reshape.
    #[default]
    Move,
    /// Select and rotate.
    Rotate,
    /// Select and scale.
    Scale,
    /// Draw a polygonal light.
    Polygon,
    /// Draw a linear light.
    Line,
    /// Draw a spherical light.
    Sphere,
    /// Draw a rectangular light with a pattern.
    Textured,
    /// Make a light of a chosen outline.
    Outline,
    /// Turn lights to a point.
    Aim,
    /// Place a light so that its light falls on a point.
    Place(Place),
}

/// What the viewport is asked to bring into view; it knows how large it is, so it moves the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Framing {
    /// What is selected.
    Selection,
    /// Everything.
    All,
}

/// Where illuminance is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// Whether it is, in every viewport; those of illuminance always show it.
    pub shown: bool,
    /// On which rectangle.
    pub rectangle: Rectangle,
}

impl Measure {
    /// A rectangle on the ground where a camera looks, about half as large as that is far.
    pub fn before(camera: &Camera) -> Self {
        let side = (0.4 * camera.eye.distance(camera.target)).clamp(0.1, 100.0);
        let side = (2.0 * side).round().max(1.0) / 2.0;
        let center = camera.target.with_z(0.0);
        Self { shown: false, rectangle: Rectangle { center, size: DVec2::splat(side) } }
    }
}

/// Something to tell the user once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Notice {
    /// It worked.
    Done(String),
    /// It worked, and may not have been meant: it can be undone.
    Undoable(String),
    /// It did not, and why.
    Failed(String),
    /// The document was not saved, and why; it can be saved elsewhere.
    Unsaved(String),
}

/// See the [module](self).
#[derive(Debug)]
pub struct Session {
    /// The document and its past.
    pub history: History,
    /// The file it was loaded from or saved to.
    pub path: Option<PathBuf>,
    /// What is selected.
    pub selection: Selection,
    /// What the mouse does in the viewport.
    pub tool: Tool,
    /// How the active viewport looks at the scene.
    pub view: ViewState,
    /// The other viewports.
    pub views: Views,
    /// Where illuminance is measured.
    pub measure: Measure,
    /// The exposure shall be set by what is seen; the active viewport does so when it knows.
    pub wants_exposure: bool,
    /// What the viewport shall bring into view when it is shown next; it takes the request.
    pub framing: Option<Framing>,
    /// Where lights are drawn.
    pub work_plane: WorkPlane,
    /// Along which axes and about which point handles act.
    pub transform: Transform,
    /// What the outline tool makes.
    pub outline: Outline,
    /// The corner of a polygon that was chosen last; [`Self::corner`] says whether it still counts.
    pub chosen_corner: Option<Corner>,
    /// Whether something is being drawn: digits are its dimensions.
    pub is_drawing: bool,
    /// What the plot pane shows.
    pub plots: PlotState,
    /// What the mouse would do now; set by whatever it is over, shown in the status bar.
    pub hint: String,
    /// Messages that have not been shown yet.
    pub notices: Vec<Notice>,
    /// Groups of lights whose lights are not listed.
    pub closed_groups: BTreeSet<String>,
    /// Commands asked for where none can be run; they are, at the end of the frame.
    pub asked: Vec<Command>,
    /// What is under the pointer in the viewport.
    pub under_pointer: Option<Item>,
    /// The user's own presets are others than those that were read.
    pub library_changed: bool,
    /// A pattern that is being painted.
    pub live: Option<LivePattern>,
    /// The pane under the pointer has keys of its own, which are not commands' keys there; set anew in every frame.
    pub pane_keys: bool,
    solo: BTreeSet<String>,
    shown: Vec<Shown>,
}

/// What a light shows while its pattern is being painted.
#[derive(Clone, Debug)]
pub struct LivePattern {
    /// The light's name.
    pub light: String,
    /// What is painted, in few texels.
    pub image: Image,
}

impl LivePattern {
    /// Give it to the light that it is of.
    fn show(&self, lights: &mut [Light]) {
        let light = lights.iter_mut().find(|light| light.name == self.light);
        if let Some(Shape::Textured(textured)) = light.map(|light| &mut light.shape) {
            textured.pattern.image = self.image.clone();
        }
    }
}

impl PartialEq for LivePattern {
    /// Images are told apart by identity.
    fn eq(&self, other: &Self) -> bool {
        self.light == other.light && self.image.is_same(&other.image)
    }
}

/// The scene with a variant's lights, solo and what is being painted applied, and what it was made from.
#[derive(Debug)]
struct Shown {
    source: Arc<Scene>,
    variant: Option<usize>,
    solo: BTreeSet<String>,
    live: Option<LivePattern>,
    scene: Arc<Scene>,
}

/// What panes show, at one moment.
#[derive(Clone, Debug)]
pub struct Glance {
    scene: Arc<Scene>,
    selection: Selection,
    tool: Tool,
    transform: Transform,
    view: ViewState,
    views: Views,
    measure: Measure,
}

impl PartialEq for Glance {
    /// Scenes are told apart by identity: every edit makes another.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.selection == other.selection
            && self.tool == other.tool
            && self.transform == other.transform
            && self.view == other.view
            && self.views == other.views
            && self.measure == other.measure
    }
}

impl Tool {
    /// All tools, in toolbar order.
    pub const ALL: [Self; 12] = [
        Self::Move,
        Self::Rotate,
        Self::Scale,
        Self::Polygon,
        Self::Line,
        Self::Sphere,
        Self::Textured,
        Self::Outline,
        Self::Aim,
        Self::Place(Place::Highlight),
        Self::Place(Place::Diffuse),
        Self::Place(Place::Rim),
    ];

    /// Whether it turns or places lights by a point of the scene.
    pub fn places(self) -> bool {
        matches!(self, Self::Aim | Self::Place(_))
    }

    /// Whether it draws a new light.
    pub fn draws(self) -> bool {
        matches!(self, Self::Polygon | Self::Line | Self::Sphere | Self::Textured | Self::Outline)
    }
}

impl ViewState {
    /// Follow the variant that is shown from one state of the document to another.
    pub fn follow(&mut self, from: &Scene, to: &Scene) {
        for variant in [&mut self.variant, &mut self.against_variant] {
            *variant = variant.and_then(|index| variants::follow(index, from, to));
        }
    }
}

impl Session {
    /// An unmodified document.
    pub fn new(scene: Scene, path: Option<PathBuf>) -> Self {
        let view = ViewState::new(scene.camera);
        Self {
            history: History::new(scene),
            path,
            selection: Selection::default(),
            tool: Tool::default(),
            view,
            views: Views::default(),
            measure: Measure::before(&view.camera),
            wants_exposure: false,
            framing: None,
            work_plane: WorkPlane::default(),
            transform: Transform::default(),
            outline: Outline::default(),
            chosen_corner: None,
            is_drawing: false,
            plots: PlotState::default(),
            hint: String::new(),
            notices: Vec::new(),
            closed_groups: BTreeSet::new(),
            asked: Vec::new(),
            under_pointer: None,
            library_changed: false,
            live: None,
            pane_keys: false,
            solo: BTreeSet::new(),
            shown: Vec::new(),
        }
    }

    /// What panes show, to see whether it has changed.
    pub fn glance(&self) -> Glance {
        Glance {
            scene: Arc::clone(self.history.scene()),
            selection: self.selection.clone(),
            tool: self.tool,
            transform: self.transform,
            view: self.view,
            views: self.views.clone(),
            measure: self.measure,
        }
    }

    /// Make a viewport the one that keys and menus act on.
    pub fn activate_view(&mut self, index: usize) {
        self.views.activate(index, &mut self.view);
    }

    /// Show so many viewports: 1, 2 or 4.
    pub fn set_view_count(&mut self, count: usize) {
        self.views.set_count(count, &mut self.view);
    }

    /// Do something as if that viewport were the active one.
    pub fn with_view<R>(&mut self, index: usize, act: impl FnOnce(&mut Self) -> R) -> R {
        let active = self.views.active();
        self.activate_view(index);
        let result = act(self);
        self.activate_view(active);
        result
    }

    /// Let linked viewports follow the active one.
    pub fn link_views(&mut self) {
        self.views.link(&self.view);
    }

    /// Look as the viewports of another document did, but through this one's camera.
    pub fn look_like(&mut self, view: ViewState, views: Views) {
        let camera = self.scene().camera;
        (self.view, self.views) = (view, views);
        self.views.look_afresh(camera, &mut self.view);
    }

    /// The document as it is.
    pub fn scene(&self) -> &Arc<Scene> {
        self.history.scene()
    }

    /// The document as it is shown: where lights are soloed, all others are muted; a pattern that is being painted is
    /// the light's.
    ///
    /// The same `Arc` is returned until something changes.
    pub fn shown(&mut self) -> Arc<Scene> {
        self.shown_with(None)
    }

    /// [`Self::shown`] as a view looks at it: with the lights of a variant where the view is of one.
    pub fn shown_for(&mut self, view: &ViewState) -> Arc<Scene> {
        self.shown_with(view.variant)
    }

    /// What a view compares [`Self::shown_for`] with: the same, but for the lights where it compares those.
    pub fn shown_against(&mut self, view: &ViewState) -> Arc<Scene> {
        self.shown_with(view.against_variant.or(view.variant))
    }

    /// The document as it is shown, with the lights of the variant of that place.
    fn shown_with(&mut self, variant: Option<usize>) -> Arc<Scene> {
        let source = Arc::clone(self.history.scene());
        self.solo.retain(|name| source.all_lights().any(|light| light.name == *name));
        let (solo, live) = (&self.solo, &self.live);
        self.shown.retain(|shown| Arc::ptr_eq(&shown.source, &source) && shown.solo == *solo && shown.live == *live);
        let lights = variant.and_then(|index| source.variants.get(index)).map(|variant| &variant.lights);
        if solo.is_empty() && lights.is_none() && live.is_none() {
            return source;
        }
        if let Some(shown) = self.shown.iter().find(|shown| shown.variant == variant) {
            return Arc::clone(&shown.scene);
        }
        let mut scene = Scene::clone(&source);
        if let Some(lights) = lights {
            scene.lights.clone_from(lights);
        } else if let Some(live) = live {
            live.show(&mut scene.lights);
        }
        for light in scene.lights.iter_mut().filter(|_| !solo.is_empty()) {
            light.muted |= !solo.contains(&light.name);
        }
        let scene = Arc::new(scene);
        let (solo, live) = (solo.clone(), live.clone());
        self.shown.push(Shown { source, variant, solo, live, scene: Arc::clone(&scene) });
        scene
    }

    /// Change the document: within the open gesture, or as one undo step called `label`.
    pub fn edit(&mut self, label: &str, change: impl FnOnce(&mut Scene)) {
        self.with_history(|history| history.edit(label, change));
    }

    /// Start a gesture: all edits until [`Self::commit`] are one undo step.
    pub fn begin(&mut self, label: &str) {
        self.history.begin(label);
    }

    /// End the gesture.
    pub fn commit(&mut self) {
        self.history.commit();
    }

    /// End the gesture and take back what it did.
    pub fn abort(&mut self) {
        self.with_history(History::abort);
    }

    /// Take back the last step.
    pub fn undo(&mut self) {
        self.with_history(|history| history.undo());
    }

    /// Do again what was taken back last.
    pub fn redo(&mut self) {
        self.with_history(|history| history.redo());
    }

    /// Change the history, and let the selection follow.
    fn with_history<R>(&mut self, change: impl FnOnce(&mut History) -> R) {
        let before = Arc::clone(self.history.scene());
        change(&mut self.history);
        let after = self.history.scene();
        self.selection.follow(&before, after);
        self.view.follow(&before, after);
        self.views.for_all(|view| view.follow(&before, after));
    }

    /// Whether any light is soloed.
    pub fn has_solo(&self) -> bool {
        !self.solo.is_empty()
    }

    /// Whether the light of that name is soloed.
    pub fn is_solo(&self, name: &str) -> bool {
        self.solo.contains(name)
    }

    /// Solo the light of that name, or stop doing so.
    pub fn toggle_solo(&mut self, name: &str) {
        if !self.solo.remove(name) {
            self.solo.insert(name.to_owned());
        }
    }

    /// Look at the scene through its own camera.
    pub fn reset_view(&mut self) {
        self.view.camera = self.scene().camera;
    }

    /// Make the view the scene's camera.
    pub fn save_view(&mut self) {
        let camera = self.view.camera;
        self.edit("Set camera", |scene| scene.camera = camera);
    }

    /// Tell the user that something worked.
    pub fn done(&mut self, text: impl Into<String>) {
        self.notices.push(Notice::Done(text.into()));
    }

    /// Tell the user what was done to the document, and let them take it back at once.
    pub fn undoable(&mut self, text: impl Into<String>) {
        self.notices.push(Notice::Undoable(text.into()));
    }

    /// Tell the user that something did not work.
    pub fn failed(&mut self, text: impl Into<String>) {
        self.notices.push(Notice::Failed(text.into()));
    }

    /// The document's name for people: its file's, or its own, or "Untitled".
    pub fn title(&self) -> String {
        let file = self.path.as_deref().and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
        match file {
            Some(name) => name,
            None if self.scene().name.is_empty() => "Untitled".to_owned(),
            None => self.scene().name.clone(),
        }
    }
}
