//! How viewports look at the scene: a state each, one of them active.

use glam::DVec3;

use crate::scene::Camera;
use crate::shading::Method;

/// Viewports, at most.
pub const MOST: usize = 4;

/// What a viewport shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ViewMode {
    /// What the camera sees.
    #[default]
    Picture,
    /// Two methods beside each other, with a divider to drag.
    Split,
    /// One method less another, in false colour.
    Difference,
    /// Illuminance in false colour, with isolines.
    Illuminance,
    /// Where one method is within 1, 5 and 10 % of another.
    Bands,
}

impl ViewMode {
    /// All of them, in menu order.
    pub const ALL: [Self; 5] = [Self::Picture, Self::Split, Self::Difference, Self::Illuminance, Self::Bands];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::Picture => "Picture",
            Self::Split => "Split",
            Self::Difference => "Difference",
            Self::Illuminance => "Illuminance",
            Self::Bands => "1, 5, 10 %",
        }
    }

    /// What it shows, in a sentence.
    pub fn hint(self) -> &'static str {
        match self {
            Self::Picture => "What the camera sees",
            Self::Split => "Two methods beside each other; drag the line between them",
            Self::Difference => "How much brighter one method is than another, in false colour",
            Self::Illuminance => "Illuminance (lx) in false colour, with isolines and a measuring rectangle",
            Self::Bands => "Where a point light, or another method, is within 1, 5 and 10 % of exact",
        }
    }

    /// Whether colours stand for numbers, so that the picture may be white.
    pub fn is_false_colour(self) -> bool {
        matches!(self, Self::Difference | Self::Illuminance | Self::Bands)
    }

    /// Whether it needs a second method.
    pub fn compares(self) -> bool {
        matches!(self, Self::Split | Self::Difference | Self::Bands)
    }
}

/// How a viewport looks at the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewState {
    /// Starts as the scene's camera and is written back only by [`Session::save_view`](super::Session::save_view).
    pub camera: Camera,
    /// What is shown.
    pub mode: ViewMode,
    /// By which method lights are shaded.
    pub method: Method,
    /// The method that it is compared with.
    pub against: Method,
    /// Where the second method begins, as a share of the width.
    pub split: f64,
    /// Differences are shares of the second method's luminance; else in cd/m².
    pub relative: bool,
    /// End of the scale of differences in cd/m² and as a share; where there is none it follows the picture.
    pub difference_ends: [Option<f64>; 2],
    /// End of the scale of illuminance, lx; where there is none it follows the picture.
    pub illuminance_end: Option<f64>,
    /// The scale of illuminance is logarithmic.
    pub logarithmic: bool,
    /// Lines where the illuminance passes round values.
    pub isolines: bool,
    /// Methods are compared by illuminance within 1, 5 and 10 %; else by what is seen, highlights and all.
    pub bands_of_illuminance: bool,
    /// Whether lights are seen themselves.
    pub show_emitters: bool,
    /// Surfaces cast shadows.
    pub show_shadows: bool,
    /// A picture that stands still is smoothed; where not, its first look stays, which spares a slow machine.
    pub refines: bool,
    /// Whether the ground grid is drawn.
    pub show_grid: bool,
    /// The place of the variant whose lights are shown; none for the scene's own lights.
    pub variant: Option<usize>,
    /// The place of the variant with which the lights that are shown are compared; where there is none, methods are.
    pub against_variant: Option<usize>,
}

impl ViewState {
    /// The exact picture through a camera.
    pub fn new(camera: Camera) -> Self {
        Self {
            camera,
            mode: ViewMode::Picture,
            method: Method::Exact,
            against: Method::Point,
            split: 0.5,
            relative: false,
            difference_ends: [None; 2],
            illuminance_end: None,
            logarithmic: false,
            isolines: true,
            bands_of_illuminance: true,
            show_emitters: true,
            show_shadows: true,
            refines: true,
            show_grid: true,
            variant: None,
            against_variant: None,
        }
    }

    /// Show something else. Differences and bands are of an approximation against `exact`.
    pub fn set_mode(&mut self, mode: ViewMode) {
        self.mode = mode;
        if self.against_variant.is_some() {
            return;
        }
        let judges = matches!(mode, ViewMode::Difference | ViewMode::Bands);
        if judges && self.method == Method::Exact {
            self.method = if self.against == Method::Exact { Method::Point } else { self.against };
            self.against = Method::Exact;
        } else if mode.compares() && self.method == self.against {
            self.against = if self.method == Method::Exact { Method::Point } else { Method::Exact };
        }
    }

    /// The end of the scale of differences in the unit that is shown.
    pub fn difference_end(&mut self) -> &mut Option<f64> {
        &mut self.difference_ends[usize::from(self.relative)]
    }
}

/// The viewports beside the active one, and how they are laid out.
#[derive(Clone, Debug, PartialEq)]
pub struct Views {
    /// Each viewport's state; the active one's is out of date.
    states: Vec<ViewState>,
    count: usize,
    /// Most that were ever shown.
    known: usize,
    active: usize,
    /// All look through the same camera.
    pub linked: bool,
    /// Where the dividers are, as shares of width and height.
    pub dividers: [f32; 2],
}

impl Default for Views {
    fn default() -> Self {
        Self { states: Vec::new(), count: 1, known: 1, active: 0, linked: true, dividers: [0.5; 2] }
    }
}

impl Views {
    /// Viewports that are shown: 1, 2 or 4.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The viewport that keys and menus act on.
    pub fn active(&self) -> usize {
        self.active
    }

    /// Make another viewport the active one: what was `view` is put away, and the other's state takes its place.
    pub(super) fn activate(&mut self, index: usize, view: &mut ViewState) {
        if index < self.count && index != self.active {
            self.states.resize(MOST, *view);
            self.states[self.active] = *view;
            *view = self.states[index];
            self.active = index;
        }
    }

    /// Show so many viewports; the active one comes first. Those shown for the first time look like it, two with the
    /// method that it is compared with in the second, four from above, the front and the side.
    pub(super) fn set_count(&mut self, count: usize, view: &mut ViewState) {
        self.states.resize(MOST, *view);
        self.states[self.active] = *view;
        self.states.swap(0, self.active);
        self.active = 0;
        self.count = if matches!(count, 2 | MOST) { count } else { 1 };
        self.linked = self.count < MOST;
        for index in self.known..self.count {
            self.states[index] = *view;
            if self.count == 2 && view.mode == ViewMode::Picture {
                self.states[index].method = view.against;
            }
        }
        if self.known < MOST && self.count == MOST {
            for index in 1..MOST {
                self.states[index].camera = from_an_axis(&view.camera, index);
            }
        }
        self.known = self.known.max(self.count);
        self.link(view);
    }

    /// Give all viewports the active one's camera, where they are linked.
    pub(super) fn link(&mut self, view: &ViewState) {
        if self.linked {
            self.states.iter_mut().for_each(|state| state.camera = view.camera);
        }
    }

    /// Give all viewports a new document's camera.
    pub(super) fn look_afresh(&mut self, camera: Camera, view: &mut ViewState) {
        let linked = self.linked;
        let camera_of = |index| if linked || index == 0 { camera } else { from_an_axis(&camera, index) };
        for (index, state) in self.states.iter_mut().enumerate() {
            state.camera = camera_of(index);
        }
        view.camera = camera_of(self.active);
    }

    /// Set something for all viewports.
    pub fn for_all(&mut self, change: impl FnMut(&mut ViewState)) {
        self.states.iter_mut().for_each(change);
    }
}

/// A camera from above (1), the front (2) or the right (3), as far from its target.
fn from_an_axis(camera: &Camera, index: usize) -> Camera {
    // Not straight down, so that up is up.
    let direction = match index {
        1 => DVec3::new(0.0, -0.01, 1.0).normalize(),
        2 => DVec3::NEG_Y,
        _ => DVec3::X,
    };
    Camera { eye: camera.target + camera.eye.distance(camera.target) * direction, ..*camera }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_viewport_keeps_its_state_while_another_is_active() {
        let mut view = ViewState::new(Camera::default());
        let mut views = Views::default();
        views.set_count(2, &mut view);
        assert_eq!((views.count(), views.active(), view.method), (2, 0, Method::Exact), "the first stays");
        views.activate(1, &mut view);
        assert_eq!(view.method, Method::Point, "the second compares");
        view.show_grid = false;
        views.activate(0, &mut view);
        assert!(view.show_grid, "the first has its own");
        views.activate(1, &mut view);
        assert!(!view.show_grid, "and so has the second");
        views.activate(7, &mut view);
        assert_eq!(views.active(), 1, "there is no eighth");
        views.set_count(1, &mut view);
        assert_eq!((views.count(), views.active(), view.show_grid), (1, 0, false), "the active one remains");
        views.set_count(2, &mut view);
        views.activate(1, &mut view);
        assert!(view.show_grid, "and the other one comes back");
    }

    #[test]
    fn linked_viewports_share_a_camera_and_four_look_from_four_sides() {
        let mut view = ViewState::new(Camera::default());
        let mut views = Views::default();
        views.set_count(2, &mut view);
        view.camera.eye.x += 1.0;
        views.link(&view);
        let moved = view.camera;
        views.activate(1, &mut view);
        assert_eq!(view.camera, moved, "the second follows");
        views.set_count(4, &mut view);
        assert!(!views.linked, "four are apart");
        let mut eyes = Vec::new();
        for index in 0..4 {
            views.activate(index, &mut view);
            let distance = view.camera.eye.distance(view.camera.target);
            assert!((distance - moved.eye.distance(moved.target)).abs() < 1e-9, "as far away: {distance}");
            eyes.push(view.camera.eye);
        }
        let apart = |i: usize, j: usize| eyes[i].distance(eyes[j]) > 1.0;
        assert!(apart(0, 1) && apart(1, 2) && apart(2, 3) && apart(0, 3), "{eyes:?}");
    }

    #[test]
    fn an_approximation_is_judged_against_exact() {
        let mut view = ViewState::new(Camera::default());
        view.set_mode(ViewMode::Difference);
        assert_eq!((view.method, view.against), (Method::Point, Method::Exact), "point less exact");
        view.set_mode(ViewMode::Split);
        assert_eq!((view.method, view.against), (Method::Point, Method::Exact), "they stay");
        view.method = Method::Exact;
        view.set_mode(ViewMode::Split);
        assert_ne!(view.method, view.against, "something to compare");
    }
}
