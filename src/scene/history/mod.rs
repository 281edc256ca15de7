//! Undo and redo of gestures.

mod change;
mod retouch;

use std::collections::VecDeque;
use std::sync::Arc;

use super::Scene;
use change::Change;

/// Steps that can be undone may take this much memory together, bytes; beyond it, the oldest are forgotten.
pub const MOST_HISTORY_BYTES: usize = 200_000_000;

/// A scene and its past: one labelled step a gesture.
///
/// A gesture is `begin`, any number of `edit`s, then `commit` or `abort`. An `edit` outside a gesture is a step of its
/// own. A step keeps what it changed, be it one light of many or a few texels of a picture.
#[derive(Clone, Debug)]
pub struct History {
    current: Arc<Scene>,
    undo: VecDeque<Step>,
    /// Memory that the steps in `undo` take.
    undo_bytes: usize,
    redo: Vec<Step>,
    gesture: Option<Gesture>,
    saved: Arc<Scene>,
}

/// What leads to another scene, and the name of what led away from it.
#[derive(Clone, Debug)]
struct Step {
    label: String,
    change: Change,
    bytes: usize,
}

/// A gesture under way, and the scene before it.
#[derive(Clone, Debug)]
struct Gesture {
    label: String,
    before: Arc<Scene>,
}

impl History {
    /// A history that starts, unmodified, at `scene`.
    pub fn new(scene: Scene) -> Self {
        let current = Arc::new(scene);
        Self {
            saved: Arc::clone(&current),
            current,
            undo: VecDeque::new(),
            undo_bytes: 0,
            redo: Vec::new(),
            gesture: None,
        }
    }

    /// A history that starts at `scene`, which differs from what was `saved`.
    pub fn changed(scene: Scene, saved: &Arc<Scene>) -> Self {
        Self { saved: Arc::clone(saved), ..Self::new(scene) }
    }

    /// The scene as it is now.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.current
    }

    /// Start a gesture; one that was still open is committed first.
    pub fn begin(&mut self, label: impl Into<String>) {
        self.commit();
        self.gesture = Some(Gesture { label: label.into(), before: Arc::clone(&self.current) });
    }

    /// Whether a gesture is open.
    pub fn in_gesture(&self) -> bool {
        self.gesture.is_some()
    }

    /// Change the scene within the open gesture, or as a step of its own called `label`.
    pub fn edit(&mut self, label: &str, change: impl FnOnce(&mut Scene)) {
        let standalone = self.gesture.is_none();
        if standalone {
            self.begin(label);
        }
        change(Arc::make_mut(&mut self.current));
        if standalone {
            self.commit();
        }
    }

    /// End the gesture. A gesture that changed nothing leaves no step.
    pub fn commit(&mut self) {
        let Some(Gesture { label, before }) = self.gesture.take() else { return };
        if *before == *self.current {
            // What counts as the same may still differ in the sign of a zero.
            self.current = before;
            return;
        }
        let change = Change::between(&before, &self.current);
        let bytes = label.len() + change.bytes(&self.current);
        self.redo.clear();
        self.push_undo(Step { label, change, bytes });
    }

    /// End the gesture and take back what it did.
    pub fn abort(&mut self) {
        if let Some(gesture) = self.gesture.take() {
            self.current = gesture.before;
        }
    }

    /// Take back the last step; its label, if there was one.
    pub fn undo(&mut self) -> Option<String> {
        self.commit();
        let mut step = self.undo.pop_back()?;
        self.undo_bytes -= step.bytes;
        step.change.swap(Arc::make_mut(&mut self.current));
        let label = step.label.clone();
        self.redo.push(step);
        Some(label)
    }

    /// Do again what was taken back last; its label, if there was one.
    pub fn redo(&mut self) -> Option<String> {
        self.commit();
        let mut step = self.redo.pop()?;
        step.change.swap(Arc::make_mut(&mut self.current));
        let label = step.label.clone();
        self.push_undo(step);
        Some(label)
    }

    /// Keep a step, and forget the oldest while all together take too much.
    fn push_undo(&mut self, step: Step) {
        self.undo_bytes += step.bytes;
        self.undo.push_back(step);
        while self.undo_bytes > MOST_HISTORY_BYTES
            && self.undo.len() > 1
            && let Some(oldest) = self.undo.pop_front()
        {
            self.undo_bytes -= oldest.bytes;
        }
    }

    /// Label of the step that [`Self::undo`] would take back.
    pub fn undo_label(&self) -> Option<&str> {
        self.undo.back().map(|step| step.label.as_str())
    }

    /// Label of the step that [`Self::redo`] would do again.
    pub fn redo_label(&self) -> Option<&str> {
        self.redo.last().map(|step| step.label.as_str())
    }

    /// How many steps can be undone, and the memory that they take, bytes.
    pub fn depth(&self) -> (usize, usize) {
        (self.undo.len(), self.undo_bytes)
    }

    /// Whether the scene differs from what was last saved.
    pub fn is_modified(&self) -> bool {
        !Arc::ptr_eq(&self.current, &self.saved) && *self.current != *self.saved
    }

    /// The scene as it is now has been saved.
    pub fn mark_saved(&mut self) {
        self.saved = Arc::clone(&self.current);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::pattern::{Channel, Image, Pattern};
    use crate::light::{Light, Shape, Textured};
    use crate::surface::Surface;
    use glam::DVec2;

    fn rename(history: &mut History, name: &str) {
        history.edit(&format!("Rename to {name}"), |scene| name.clone_into(&mut scene.name));
    }

    #[test]
    fn a_gesture_is_one_step_however_many_edits_it_has() {
        let mut history = History::new(Scene::default());
        history.begin("Drag");
        for name in ["a", "b", "c"] {
            rename(&mut history, name);
        }
        assert!(history.in_gesture(), "still dragging");
        history.commit();
        assert_eq!(history.undo().as_deref(), Some("Drag"), "one step back");
        assert_eq!(**history.scene(), Scene::default(), "to the start");
        assert_eq!(history.undo(), None, "there is no other step");
        assert_eq!(history.redo().as_deref(), Some("Drag"), "and forth");
        assert_eq!(history.scene().name, "c", "to the gesture's end");
    }

    #[test]
    fn an_aborted_or_idle_gesture_leaves_no_step_and_keeps_what_can_be_redone() {
        let mut history = History::new(Scene::default());
        rename(&mut history, "a");
        history.undo();
        history.begin("Drag");
        rename(&mut history, "b");
        history.abort();
        history.begin("Click");
        history.commit();
        assert_eq!(history.undo_label(), None, "nothing was done");
        assert_eq!(history.redo_label(), Some("Rename to a"), "redo is not lost");
        assert_eq!(history.scene().name, "", "the aborted edit is taken back");
    }

    #[test]
    fn a_new_step_ends_what_could_be_redone() {
        let mut history = History::new(Scene::default());
        rename(&mut history, "a");
        history.undo();
        rename(&mut history, "b");
        assert_eq!(history.redo_label(), None, "the other future is gone");
        assert_eq!(history.undo_label(), Some("Rename to b"), "the new one is there");
    }

    #[test]
    fn going_back_to_what_was_saved_is_unmodified() {
        let mut history = History::new(Scene::default());
        rename(&mut history, "a");
        history.mark_saved();
        rename(&mut history, "b");
        assert!(history.is_modified(), "b is not saved");
        rename(&mut history, "a");
        assert!(!history.is_modified(), "the same scene by another way");
        history.undo();
        history.undo();
        assert!(!history.is_modified(), "undone to the saved step");
        history.undo();
        assert!(history.is_modified(), "before it");
    }

    /// Twenty lights and as many surfaces.
    fn rich_scene() -> Scene {
        let mut scene = crate::scene::first_light();
        let (light, surface) = (scene.lights[0].clone(), scene.surfaces[1].clone());
        scene.lights = (0..20).map(|i| Light { name: format!("light {i}"), ..light.clone() }).collect();
        scene.surfaces = (0..20).map(|i| Surface { name: format!("ball {i}"), ..surface.clone() }).collect();
        scene
    }

    #[test]
    fn a_thousand_steps_fit_and_all_go_back_to_the_last_bit() {
        let start = rich_scene();
        let mut history = History::new(start.clone());
        for i in 0..1200_usize {
            history.edit("Edit", |scene| match i % 6 {
                0 => scene.lights[i % 7].position.x += 0.1,
                1 => scene.surfaces[i % 5].scale *= 1.01,
                2 => scene.lights.insert(i % 9, Light { name: format!("new {i}"), ..scene.lights[3].clone() }),
                3 => drop(scene.lights.remove(i % 11)),
                4 => scene.lights.swap(1, 12),
                _ => scene.display.exposure_ev += 0.1,
            });
        }
        let (steps, bytes) = history.depth();
        assert_eq!(steps, 1200, "none is forgotten");
        assert!(bytes < 5_000_000, "{bytes} bytes");
        let end = Scene::clone(history.scene());
        while history.undo().is_some() {}
        assert_eq!(format!("{:?}", history.scene()), format!("{start:?}"), "back to the start");
        while history.redo().is_some() {}
        assert_eq!(format!("{:?}", history.scene()), format!("{end:?}"), "and forth to the end");
        assert_eq!(history.depth(), (steps, bytes), "no more and no less");
    }

    #[test]
    fn undo_restores_even_the_sign_of_a_zero() {
        let mut history = History::new(rich_scene());
        history.edit("Mirror", |scene| {
            scene.lights[2].position.z = -0.0;
            scene.lights[4].position.z = 7.0;
        });
        history.edit("Mirror nothing", |scene| scene.lights[0].rotation_deg.y = -0.0);
        assert_eq!(history.undo().as_deref(), Some("Mirror"), "zeros of another sign are no step");
        assert_eq!(format!("{:?}", history.scene()), format!("{:?}", rich_scene()), "to the last bit");
    }

    /// A disk of the light's picture is repainted.
    fn stroke(scene: &mut Scene, i: usize) {
        const SIDE: usize = 512;
        let Shape::Textured(textured) = &mut scene.lights[0].shape else { panic!("a textured light") };
        let mut texels = textured.pattern.image.channels()[0].texels().to_vec();
        let (x, y) = (40 + i * 37 % 430, 40 + i * 53 % 430);
        for row in y - 24..y + 24 {
            // 120 texels long, 48 wide.
            for texel in &mut texels[row * SIDE..][x.saturating_sub(36)..(x + 84).min(SIDE)] {
                *texel = (1 + i % 97) as f32 / 97.0;
            }
        }
        textured.pattern.image = Image::Grey(Arc::new(Channel::new(SIDE, texels).expect("a picture")));
    }

    #[test]
    fn a_thousand_strokes_on_a_picture_of_512_by_512_fit() {
        let mut scene = rich_scene();
        let image = Image::Grey(Arc::new(Channel::new(512, vec![0.0; 512 * 512]).expect("a picture")));
        let pattern = Pattern::of_image("textures/painted.png", image);
        scene.lights[0].shape = Shape::Textured(Textured { size: DVec2::ONE, pattern, two_sided: false });
        let mut history = History::new(scene.clone());
        for i in 0..1000 {
            history.edit("Stroke", |scene| stroke(scene, i));
        }
        let (steps, bytes) = history.depth();
        assert_eq!(steps, 1000, "none is forgotten");
        assert!(bytes < 30_000_000, "{bytes} bytes");
        let end = Scene::clone(history.scene());
        while history.undo().is_some() {}
        assert_eq!(**history.scene(), scene, "back to black");
        while history.redo().is_some() {}
        assert_eq!(**history.scene(), end, "all strokes again");
    }

    #[test]
    fn what_would_take_too_much_memory_forgets_the_oldest_steps() {
        let picture = |i: usize| {
            let texels = (0..1 << 22).map(|k| ((k + i) % 7) as f32).collect();
            Pattern::of_image("a.png", Image::Grey(Arc::new(Channel::new(1 << 11, texels).expect("a picture"))))
        };
        let mut scene = rich_scene();
        scene.lights[0].shape = Shape::Textured(Textured { size: DVec2::ONE, pattern: picture(0), two_sided: false });
        let mut history = History::new(scene);
        for i in 1..16 {
            history.edit("Replace pattern", |scene| {
                if let Shape::Textured(textured) = &mut scene.lights[0].shape {
                    textured.pattern = picture(i);
                }
            });
        }
        let (steps, bytes) = history.depth();
        assert!(bytes <= MOST_HISTORY_BYTES, "{bytes} bytes");
        assert_eq!(steps, 11, "as many pictures of 16 MiB as fit");
    }
}
