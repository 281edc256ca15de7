//! Undo and redo over snapshots of the scene.

use std::sync::Arc;

use super::Scene;

/// A scene and its past: one labelled step a gesture.
///
/// A gesture is `begin`, any number of `edit`s, then `commit` or `abort`. An `edit` outside a gesture is a step of its
/// own. Steps share what they did not change only as whole scenes; a snapshot is an `Arc`, so keeping one is free.
#[derive(Clone, Debug)]
pub struct History {
    current: Arc<Scene>,
    undo: Vec<Step>,
    redo: Vec<Step>,
    gesture: Option<Step>,
    saved: Arc<Scene>,
}

/// A scene to go back to, and the name of what led away from it.
#[derive(Clone, Debug)]
struct Step {
    label: String,
    scene: Arc<Scene>,
}

impl History {
    /// A history that starts, unmodified, at `scene`.
    pub fn new(scene: Scene) -> Self {
        let current = Arc::new(scene);
        Self { saved: Arc::clone(&current), current, undo: Vec::new(), redo: Vec::new(), gesture: None }
    }

    /// The scene as it is now.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.current
    }

    /// Start a gesture; one that was still open is committed first.
    pub fn begin(&mut self, label: impl Into<String>) {
        self.commit();
        self.gesture = Some(Step { label: label.into(), scene: Arc::clone(&self.current) });
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
        if let Some(step) = self.gesture.take()
            && *step.scene != *self.current
        {
            self.undo.push(step);
            self.redo.clear();
        }
    }

    /// End the gesture and take back what it did.
    pub fn abort(&mut self) {
        if let Some(step) = self.gesture.take() {
            self.current = step.scene;
        }
    }

    /// Take back the last step; its label, if there was one.
    pub fn undo(&mut self) -> Option<String> {
        self.commit();
        let Step { label, scene } = self.undo.pop()?;
        let undone = std::mem::replace(&mut self.current, scene);
        self.redo.push(Step { label: label.clone(), scene: undone });
        Some(label)
    }

    /// Do again what was taken back last; its label, if there was one.
    pub fn redo(&mut self) -> Option<String> {
        self.commit();
        let Step { label, scene } = self.redo.pop()?;
        let before = std::mem::replace(&mut self.current, scene);
        self.undo.push(Step { label: label.clone(), scene: before });
        Some(label)
    }

    /// Label of the step that [`Self::undo`] would take back.
    pub fn undo_label(&self) -> Option<&str> {
        self.undo.last().map(|step| step.label.as_str())
    }

    /// Label of the step that [`Self::redo`] would do again.
    pub fn redo_label(&self) -> Option<&str> {
        self.redo.last().map(|step| step.label.as_str())
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
}
