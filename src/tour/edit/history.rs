//! Steps to undo and redo, without limit.
//!
//! One call of [`History::apply`] is a step; between [`begin_gesture`](History::begin_gesture) and
//! [`end_gesture`](History::end_gesture) all of them together are one, and keep each part of the draft once.

use super::{Draft, Edit, EditError, Restored, Title};

/// The edits of a draft that can be undone and redone.
///
/// It is of use with one draft only, which nothing else may change.
#[derive(Debug, Default)]
pub struct History {
    past: Vec<Step>,
    future: Vec<Step>,
    /// The step that grows while a gesture lasts; `Some(None)` before its first edit.
    gesture: Option<Option<Step>>,
    revision: u64,
    /// The last state given to a step; states are never used twice.
    newest: u64,
    /// The state that is saved; 0 is the one at the beginning.
    saved: Option<u64>,
}

#[derive(Debug)]
struct Step {
    title: Title,
    back: Restored,
    /// The state after the step.
    state: u64,
}

impl History {
    /// The history of a draft that was just opened; `saved` tells whether its file says the same.
    #[must_use]
    pub fn new(saved: bool) -> Self {
        Self { saved: saved.then_some(0), ..Self::default() }
    }

    /// Does an edit. Tells whether it changed anything; only then it can be undone, and nothing more redone.
    ///
    /// # Errors
    /// As [`Edit::apply`]; draft and history are then as before.
    pub fn apply(&mut self, edit: &Edit, draft: &mut Draft) -> Result<bool, EditError> {
        let title = edit.title(&draft.tour);
        let Edit::Restore(back) = edit.apply(draft)? else { return Ok(false) };
        if back.is_shown_by(draft) {
            return Ok(false);
        }
        self.revision += 1;
        self.newest += 1;
        let state = self.newest;
        match &mut self.gesture {
            Some(Some(step)) => {
                step.back.keep_all(back);
                step.state = state;
            }
            Some(empty) => *empty = Some(Step { title, back, state }),
            None => self.finish(Step { title, back, state }),
        }
        Ok(true)
    }

    /// Begins a step of several edits: a drag, a brush stroke, a slider that is held. One that was begun before ends.
    pub fn begin_gesture(&mut self) {
        self.end_gesture();
        self.gesture = Some(None);
    }

    /// Ends the gesture; one without any change leaves no step.
    pub fn end_gesture(&mut self) {
        if let Some(step) = self.gesture.take().flatten() {
            self.finish(step);
        }
    }

    /// Takes back the gesture that is going on, as Escape does; nothing of it can be redone.
    ///
    /// # Errors
    /// When the draft was changed by something else meanwhile.
    pub fn cancel_gesture(&mut self, draft: &mut Draft) -> Result<(), EditError> {
        if let Some(step) = self.gesture.take().flatten() {
            step.back.put_back(draft)?;
            self.revision += 1;
        }
        Ok(())
    }

    /// Whether a gesture is going on.
    #[must_use]
    pub fn in_gesture(&self) -> bool {
        self.gesture.is_some()
    }

    /// Undoes the last step; its title, or `None` when there is none. A gesture that is going on ends first.
    ///
    /// # Errors
    /// When the draft was changed by something else meanwhile; nothing has changed then.
    pub fn undo(&mut self, draft: &mut Draft) -> Result<Option<Title>, EditError> {
        self.end_gesture();
        let Some(step) = self.past.last() else { return Ok(None) };
        let back = step.back.put_back(draft)?;
        let step = self.past.pop().map(|step| Step { back, ..step });
        self.revision += 1;
        let title = step.as_ref().map(|step| step.title.clone());
        self.future.extend(step);
        Ok(title)
    }

    /// Does again what was undone last; its title, or `None` when there is nothing.
    ///
    /// # Errors
    /// When the draft was changed by something else meanwhile; nothing has changed then.
    pub fn redo(&mut self, draft: &mut Draft) -> Result<Option<Title>, EditError> {
        self.end_gesture();
        let Some(step) = self.future.last() else { return Ok(None) };
        let back = step.back.put_back(draft)?;
        let step = self.future.pop().map(|step| Step { back, ..step });
        self.revision += 1;
        let title = step.as_ref().map(|step| step.title.clone());
        self.past.extend(step);
        Ok(title)
    }

    /// Whether there is something to undo.
    #[must_use]
    pub fn can_undo(&self) -> bool {
        self.undo_title().is_some()
    }

    /// Whether there is something to redo.
    #[must_use]
    pub fn can_redo(&self) -> bool {
        self.redo_title().is_some()
    }

    /// What undoing undoes.
    #[must_use]
    pub fn undo_title(&self) -> Option<&Title> {
        self.past().last()
    }

    /// What redoing does again.
    #[must_use]
    pub fn redo_title(&self) -> Option<&Title> {
        self.future.last().map(|step| &step.title)
    }

    /// The steps that can be undone, oldest first.
    pub fn past(&self) -> impl DoubleEndedIterator<Item = &Title> {
        self.past.iter().chain(self.gesture.iter().flatten()).map(|step| &step.title)
    }

    /// The steps that can be redone, the next one first.
    pub fn future(&self) -> impl Iterator<Item = &Title> {
        self.future.iter().rev().map(|step| &step.title)
    }

    /// Counts every change of the draft, also undoing; a view that saw this number shows the draft as it is.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Whether the file says what the draft says, also after undoing back to it.
    #[must_use]
    pub fn is_saved(&self) -> bool {
        self.saved == Some(self.state())
    }

    /// Tells that the file now says what the draft says.
    pub fn mark_saved(&mut self) {
        self.saved = Some(self.state());
    }

    /// Notes that no state's file says the same.
    pub fn mark_unsaved(&mut self) {
        self.saved = None;
    }

    /// Only now nothing more can be redone: a gesture may be cancelled.
    fn finish(&mut self, step: Step) {
        self.future.clear();
        self.past.push(step);
    }

    fn state(&self) -> u64 {
        let open = self.gesture.as_ref().and_then(Option::as_ref);
        open.or(self.past.last()).map_or(0, |step| step.state)
    }
}
