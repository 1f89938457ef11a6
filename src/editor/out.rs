//! What comes out of a frame: requests in the order in which they are to be carried out, and flags for the caller.
//!
//! An edit made while a button or an arrow key is held belongs to one gesture: [`Request::BeginGesture`] stands before
//! the first such edit, [`Request::EndGesture`] after the last one, so that a drag is one step to undo.

use std::path::PathBuf;

use glam::{UVec2, Vec2};

use crate::picture::PicturePoint;
use crate::tour::edit::{Edit, RegionAt};

/// What the user wants done. The first five are for `tour::edit::History`.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// Change the draft.
    Edit(Edit),
    /// The edits that follow are one step.
    BeginGesture,
    /// That step is complete.
    EndGesture,
    /// Take back what the gesture has changed, and end it.
    CancelGesture,
    /// Undo the last step.
    Undo,
    /// Do again what was undone last.
    Redo,

    /// Ask for a picture or tour and open it.
    OpenDialog,
    /// Open this file.
    Open(PathBuf),
    /// Ask where the tour's picture is now; all marks stay.
    FindPicture,
    /// Write the tour, a new one beside its picture as `<picture>.tour.ron`.
    Save,
    /// Ask for a name and write the tour there.
    SaveAs,
    /// The user wants to leave: close at once when all is saved, else ask [`Question::Unsaved`](super::Question::Unsaved).
    Close,
    /// Save, then close.
    SaveAndClose,
    /// Close without saving.
    CloseUnsaved,
    /// Leave everything as it is; the question is answered.
    Stay,
    /// Write the tour although its file has changed meanwhile.
    SaveOver,
    /// Go back to this one of [`View::versions`](super::View::versions).
    TakeVersion(usize),
    /// Go on with the recovered marks.
    Recover,
    /// Forget the recovered marks.
    DiscardRecovery,
    /// The message was read.
    DismissMessage,
    /// Stop the work of this number.
    CancelTask(u64),

    /// Let the machine propose something.
    Suggest(SuggestWhat),
    /// The suggestion was taken (its edits were requested before this) or refused: show it no more.
    DropSuggestion(u64),
    /// The path along edges from the last corner to the pointer, for [`View::traced`](super::View::traced).
    Trace {
        /// The last corner.
        from: PicturePoint,
        /// Where the pointer is.
        to: PicturePoint,
    },
    /// Find an object's outline inside a box (`GrabCut`) and set it.
    RefineBox {
        /// Which object.
        object: usize,
        /// Two opposite corners.
        corners: [PicturePoint; 2],
    },
    /// Find or mend an outline by a stroke, or a click (one point), inside or outside of it: a region grows from strokes
    /// inside until one outside says what it is not; then, and for objects, strokes are cut apart (`GrabCut`).
    RefineStroke {
        /// Whose outline.
        at: RegionAt,
        /// What was drawn.
        stroke: BrushStroke,
    },
    /// This region, a first guess of the machine, is right.
    TakeGuess(RegionAt),
    /// Paint on a region's mask, or erase; a polygon becomes a mask first. Inside a gesture.
    Paint {
        /// Which region.
        at: RegionAt,
        /// The piece drawn since the last one.
        stroke: BrushStroke,
        /// 0 (soft) to 1 (hard).
        hardness: f64,
    },

    /// Put the flying camera where the picture was taken.
    FlyHome,
    /// Put the flying camera at this keyframe.
    FlyTo(usize),
    /// Show the path at this many seconds from its start.
    ShowPathAt(f64),
    /// Play the path from where it is shown, or stop.
    PlayPath(bool),
}

/// What the machine can propose when asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SuggestWhat {
    /// All of a first draft.
    Everything,
    /// Horizon and waterline from the mirror symmetry.
    Horizon,
    /// The regions of water, sky and ground.
    Regions,
    /// Reflection pairs.
    Pairs,
    /// An object's contact line from the lower edge of its outline.
    Contact(usize),
}

/// A stroke drawn on the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct BrushStroke {
    /// Its way, at least one point.
    pub points: Vec<PicturePoint>,
    /// Half its width, picture pixels.
    pub radius: f64,
    /// Whether it says "this is it" (or paints); otherwise "this is not" (or erases).
    pub inside: bool,
}

/// What a frame gives back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Out {
    /// What to do, in this order.
    pub requests: Vec<Request>,
    /// Whether the pointer is over the live tour, so that it may take the pointer and the keys of flight.
    pub pointer_over_tour: bool,
    /// Where it is over the tour's image, in physical pixels from the upper left corner.
    pub tour_pointer: Option<Vec2>,
    /// Whether keys go to a text or number that is being typed: the tour must not fly then.
    pub text_has_focus: bool,
    /// Size at which the live tour would be shown one to one, in physical pixels; zero where it is not shown.
    pub wanted_tour_size: UVec2,
    held: bool,
    in_gesture: bool,
    canceled: bool,
}

impl Out {
    /// Begins a frame: `held` while a button or arrow key is down, the rest as the frame before left it.
    pub(super) fn begin(held: bool, in_gesture: bool, canceled: bool) -> Self {
        Self { held, in_gesture, canceled, ..Self::default() }
    }

    /// Ends a frame; whether a gesture goes on, and whether it was canceled while something is still held.
    pub(super) fn end(&mut self) -> (bool, bool) {
        if self.in_gesture && !self.held {
            self.in_gesture = false;
            self.requests.push(Request::EndGesture);
        }
        // The frame in which the button is let go still belongs to what was canceled.
        (self.in_gesture, self.canceled && self.held)
    }

    /// Asks for an edit; one made while something is held is part of a gesture.
    pub(super) fn edit(&mut self, edit: Edit) {
        self.held_request(Request::Edit(edit));
    }

    /// The same for a request that makes edits in its turn.
    pub(super) fn held_request(&mut self, request: Request) {
        if self.canceled {
            return;
        }
        if self.held && !self.in_gesture {
            self.in_gesture = true;
            self.requests.push(Request::BeginGesture);
        }
        self.requests.push(request);
    }

    /// Asks for something that is no edit. To save ends a gesture; what is dragged on is another one then.
    pub(super) fn request(&mut self, request: Request) {
        let saves =
            matches!(request, Request::Save | Request::SaveAs | Request::SaveOver | Request::SaveAndClose);
        if saves && std::mem::take(&mut self.in_gesture) {
            self.requests.push(Request::EndGesture);
        }
        self.requests.push(request);
    }

    /// Takes a gesture back; what is still held changes nothing more. Tells whether there was one.
    pub(super) fn cancel(&mut self) -> bool {
        let was = self.in_gesture;
        if was {
            (self.in_gesture, self.canceled) = (false, true);
            self.requests.push(Request::CancelGesture);
        }
        was
    }

    /// The edits among the requests.
    pub fn edits(&self) -> impl Iterator<Item = &Edit> {
        self.requests.iter().filter_map(|request| match request {
            Request::Edit(edit) => Some(edit),
            _ => None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn held_edits_are_one_gesture_and_others_stand_alone() {
        let edit = Edit::LoopPath(true);
        let mut out = Out::begin(true, false, false);
        out.edit(edit.clone());
        out.edit(edit.clone());
        assert_eq!(out.end(), (true, false));
        assert_eq!(out.requests.first(), Some(&Request::BeginGesture));
        assert_eq!(out.edits().count(), 2);

        let mut out = Out::begin(false, true, false);
        out.edit(edit.clone());
        assert_eq!(out.end(), (false, false));
        assert_eq!(out.requests, [Request::Edit(edit.clone()), Request::EndGesture]);

        let mut out = Out::begin(false, false, false);
        out.edit(edit.clone());
        assert_eq!(out.end(), (false, false));
        assert_eq!(out.requests, [Request::Edit(edit)]);
    }

    #[test]
    fn after_cancel_nothing_changes_until_the_button_is_let_go() {
        let mut out = Out::begin(true, true, false);
        assert!(out.cancel());
        out.edit(Edit::LoopPath(true));
        let (in_gesture, canceled) = out.end();
        assert_eq!((in_gesture, canceled), (false, true));
        assert_eq!(out.requests, [Request::CancelGesture]);
        let mut out = Out::begin(false, in_gesture, canceled);
        out.edit(Edit::LoopPath(true));
        assert_eq!((out.end(), out.requests.len()), ((false, false), 0));
    }
}
