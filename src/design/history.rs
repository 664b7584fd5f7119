//! Undo and redo: a stack of shared snapshots of the document.
//!
//! Everything that changes a document goes through [`History::edit`] or a gesture (begin, any number of previews,
//! commit or cancel). A gesture is one step, however many previews it had; one that changes nothing leaves none.

use super::{Design, EditError};
use std::sync::Arc;

/// Steps that can be undone. A snapshot of a large design is about 100 kB, so this many stay below 100 MB.
pub const UNDO_LIMIT: usize = 500;

/// The document being edited, and how it came to be.
#[derive(Clone, Debug)]
pub struct History {
    current: Arc<Design>,
    undo: Vec<Step>,
    redo: Vec<Step>,
    gesture: Option<Step>,
    saved: Option<Arc<Design>>,
}

/// A change by its name, and the document on its other side.
#[derive(Clone, Debug)]
struct Step {
    label: String,
    other: Arc<Design>,
}

impl History {
    /// Starts from a document as it is on the disk, so that it counts as saved.
    pub fn new(design: Design) -> Self {
        let current = Arc::new(design);
        Self { saved: Some(current.clone()), current, undo: Vec::new(), redo: Vec::new(), gesture: None }
    }

    /// The document, with the preview of a running gesture.
    pub fn current(&self) -> &Arc<Design> {
        &self.current
    }

    /// Changes the document as one step. On an error, or if the outcome is not a valid design, nothing has happened.
    /// A running gesture is committed first.
    ///
    /// # Errors
    /// What the change or the validation says.
    pub fn edit<T>(
        &mut self,
        label: impl Into<String>,
        change: impl FnOnce(&mut Design) -> Result<T, EditError>,
    ) -> Result<T, EditError> {
        self.commit();
        let before = self.current.clone();
        let result = self.change(change)?;
        self.push(Step { label: label.into(), other: before });
        Ok(result)
    }

    /// Changes the document as part of the step before: what follows from it is taken back with it. On an error nothing has happened.
    /// A running gesture is committed first.
    ///
    /// # Errors
    /// What the change or the validation says.
    pub fn amend<T>(&mut self, change: impl FnOnce(&mut Design) -> Result<T, EditError>) -> Result<T, EditError> {
        self.commit();
        self.change(change)
    }

    /// Begins a gesture. A running one is committed first.
    pub fn begin(&mut self, label: impl Into<String>) {
        self.commit();
        self.gesture = Some(Step { label: label.into(), other: self.current.clone() });
    }

    /// Changes the document within a gesture, on top of the previews so far. Outside a gesture it is refused
    /// ([`EditError::NoGesture`]). On an error the preview before it stays.
    ///
    /// # Errors
    /// [`EditError::NoGesture`], or what the change or the validation says.
    pub fn preview<T>(&mut self, change: impl FnOnce(&mut Design) -> Result<T, EditError>) -> Result<T, EditError> {
        if self.gesture.is_none() {
            return Err(EditError::NoGesture);
        }
        self.change(change)
    }

    /// [`Self::preview`] on top of the document as it was when the gesture began, in the place of the previews so far: nothing adds up.
    ///
    /// # Errors
    /// [`EditError::NoGesture`], or what the change or the validation says; the preview before it stays then.
    pub fn preview_anew<T>(
        &mut self,
        change: impl FnOnce(&mut Design) -> Result<T, EditError>,
    ) -> Result<T, EditError> {
        let Some(start) = &self.gesture else { return Err(EditError::NoGesture) };
        let before = std::mem::replace(&mut self.current, start.other.clone());
        let result = self.change(change);
        if result.is_err() {
            self.current = before;
        }
        result
    }

    /// Ends a gesture as one step; true if it left one. Without a gesture nothing happens.
    pub fn commit(&mut self) -> bool {
        self.gesture.take().is_some_and(|start| self.push(start))
    }

    /// Ends a gesture as if it had not been.
    pub fn cancel(&mut self) {
        if let Some(start) = self.gesture.take() {
            self.current = start.other;
        }
    }

    pub fn in_gesture(&self) -> bool {
        self.gesture.is_some()
    }

    /// Takes back the last step and returns its label. During a gesture it cancels that and no more.
    pub fn undo(&mut self) -> Option<String> {
        if let Some(gesture) = &self.gesture {
            let label = gesture.label.clone();
            self.cancel();
            return Some(label);
        }
        Self::travel(&mut self.current, &mut self.undo, &mut self.redo)
    }

    /// Repeats the step taken back last and returns its label; `None` during a gesture.
    pub fn redo(&mut self) -> Option<String> {
        if self.gesture.is_some() {
            return None;
        }
        Self::travel(&mut self.current, &mut self.redo, &mut self.undo)
    }

    /// The label of the step that [`History::undo`] would take back.
    pub fn undo_label(&self) -> Option<&str> {
        self.gesture.as_ref().or(self.undo.last()).map(|step| step.label.as_str())
    }

    /// The label of the step that [`History::redo`] would repeat.
    pub fn redo_label(&self) -> Option<&str> {
        self.redo.last().filter(|_| self.gesture.is_none()).map(|step| step.label.as_str())
    }

    /// Whether the document differs from the one last saved.
    pub fn is_modified(&self) -> bool {
        !self.saved.as_ref().is_some_and(|saved| Arc::ptr_eq(saved, &self.current) || **saved == *self.current)
    }

    /// The document as it is now has been saved.
    pub fn mark_saved(&mut self) {
        self.saved = Some(self.current.clone());
    }

    /// The document exists nowhere but here (a new one): modified until it is saved.
    pub fn mark_unsaved(&mut self) {
        self.saved = None;
    }

    fn change<T>(&mut self, change: impl FnOnce(&mut Design) -> Result<T, EditError>) -> Result<T, EditError> {
        let mut design = Design::clone(&self.current);
        let result = change(&mut design)?;
        let same_body = design.mesh == self.current.mesh && design.outline == self.current.outline;
        if same_body {
            design.validate_beside_body()?
        } else {
            design.validate()?
        }
        // A change that changes nothing keeps the snapshot, so that whoever watches it has nothing to do.
        if design != *self.current {
            self.current = Arc::new(design);
        }
        Ok(result)
    }

    /// Records a step that began at `start`; false if it changed nothing.
    fn push(&mut self, start: Step) -> bool {
        if Arc::ptr_eq(&start.other, &self.current) || *start.other == *self.current {
            self.current = start.other;
            return false;
        }
        self.redo.clear();
        self.undo.push(start);
        if self.undo.len() > UNDO_LIMIT {
            self.undo.remove(0);
        }
        true
    }

    fn travel(current: &mut Arc<Design>, from: &mut Vec<Step>, to: &mut Vec<Step>) -> Option<String> {
        let step = from.pop()?;
        let here = std::mem::replace(current, step.other);
        to.push(Step { label: step.label.clone(), other: here });
        Some(step.label)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::sample;
    use super::*;
    use crate::design::edit;

    fn move_first_target(to: [f64; 2]) -> impl FnOnce(&mut Design) -> Result<(), EditError> {
        move |design| edit::move_target(design, 0, 0, to)
    }

    #[test]
    fn previews_from_the_beginning_do_not_add_up() {
        let mut history = History::new(sample());
        let by = |d: f64| {
            move |design: &mut Design| {
                let [x, y] = design.poses[0].targets[0].to;
                edit::move_target(design, 0, 0, [x + d, y])
            }
        };
        assert_eq!(history.preview_anew(by(1.0)), Err(EditError::NoGesture));
        history.begin("Move target");
        for d in [1.0, 2.0, 3.0] {
            history.preview_anew(by(d)).unwrap();
        }
        assert!(history.preview_anew(by(f64::NAN)).is_err());
        assert_eq!(history.current().poses[0].targets[0].to, [23.0, 70.0]);
        assert!(history.commit());
        history.undo();
        assert_eq!(**history.current(), sample());
    }

    #[test]
    fn what_follows_from_a_step_is_taken_back_and_repeated_with_it() {
        let mut history = History::new(sample());
        let start = history.current().clone();
        history.edit("Move target", move_first_target([1.0, 3.0])).unwrap();
        history.amend(move_first_target([2.0, 3.0])).unwrap();
        let end = history.current().clone();
        assert_eq!(history.undo().as_deref(), Some("Move target"));
        assert!(Arc::ptr_eq(history.current(), &start));
        history.redo();
        assert!(Arc::ptr_eq(history.current(), &end) && history.redo().is_none());
    }

    #[test]
    fn a_drag_is_one_step() {
        let mut history = History::new(sample());
        let start = history.current().clone();
        history.begin("Move target");
        for i in 0..20 {
            history.preview(move_first_target([f64::from(i), 3.0])).expect("a valid move");
        }
        assert!(history.commit());
        let end = history.current().clone();
        assert!(history.is_modified());
        assert_eq!(history.undo().as_deref(), Some("Move target"));
        assert!(Arc::ptr_eq(history.current(), &start) && !history.is_modified());
        assert_eq!(history.undo(), None);
        assert_eq!(history.redo_label(), Some("Move target"));
        assert_eq!(history.redo().as_deref(), Some("Move target"));
        assert!(Arc::ptr_eq(history.current(), &end));
    }

    #[test]
    fn an_unchanged_gesture_leaves_no_step() {
        let mut history = History::new(sample());
        let (start, to) = (history.current().clone(), history.current().poses[0].targets[0].to);
        history.begin("Move target");
        history.preview(move_first_target([1.0, 1.0])).expect("a valid move");
        history.preview(move_first_target(to)).expect("a valid move");
        assert!(!history.commit());
        assert!(Arc::ptr_eq(history.current(), &start));
        assert_eq!(history.undo_label(), None);
    }

    #[test]
    fn a_cancelled_gesture_keeps_what_could_be_redone() {
        let mut history = History::new(sample());
        history.edit("One", move_first_target([1.0, 2.0])).expect("a valid move");
        history.undo();
        history.begin("Two");
        history.preview(move_first_target([5.0, 5.0])).expect("a valid move");
        assert_eq!(history.undo().as_deref(), Some("Two"));
        assert_eq!(*history.current().as_ref(), sample());
        assert_eq!(history.redo_label(), Some("One"));
    }

    #[test]
    fn a_refused_edit_changes_nothing() {
        let mut history = History::new(sample());
        let start = history.current().clone();
        assert!(history.edit("Bad", move_first_target([f64::NAN, 0.0])).is_err());
        assert!(history.preview(|_| Ok(())).is_err(), "no gesture is running");
        let invalid = history.edit("Worse", |design| {
            design.pins[0].stiffness = -1.0;
            Ok(())
        });
        assert!(matches!(invalid, Err(EditError::Invalid(e)) if e.at == "pins[0].stiffness"));
        assert!(Arc::ptr_eq(history.current(), &start));
        assert_eq!(history.undo_label(), None);
    }

    #[test]
    fn the_oldest_steps_are_forgotten() {
        let mut history = History::new(sample());
        for i in 0..UNDO_LIMIT + 10 {
            history.edit("Move", move_first_target([i as f64, 0.5])).expect("a valid move");
        }
        assert_eq!(std::iter::from_fn(|| history.undo()).count(), UNDO_LIMIT);
    }
}
