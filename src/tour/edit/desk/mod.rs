//! The desk: a draft with its files. What was marked is never lost.
//!
//! A tour is written beside and renamed, what was there before is kept as a version, and between saves a recovery file
//! follows the marks. A desk overwrites no file that it has not written or read itself. Comments of a tour written by
//! hand do not come through a save; they stay in its version.

mod error;
mod files;
mod open;
mod recent;
mod recovery;
mod save;
mod versions;

pub use error::DeskError;
pub(super) use files::free_name;
pub use open::Opened;
pub use recent::{MOST_RECENT, Recent};
pub use recovery::Recovered;
pub use save::{Replace, Saved};
pub use versions::{MOST_VERSIONS, Version};

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::picture::DecodedPicture;
use crate::tour::TourFile;

use super::{Draft, Edit, EditError, History, Masks, Title};

/// A draft, its history, its picture and its files.
#[derive(Debug)]
pub struct Desk {
    draft: Draft,
    history: History,
    picture: Option<Arc<DecodedPicture>>,
    files: Files,
}

/// What the desk knows of its files.
#[derive(Debug)]
struct Files {
    /// The tour's file, which a new tour does not have yet.
    tour: PathBuf,
    /// What it says, as last read or written.
    text: Option<String>,
    /// The picture's file, once it is found.
    picture: Option<PathBuf>,
    /// Pictures that were on the desk, by the name the tour had for them: steps that are undone bring them back.
    seen: BTreeMap<String, (PathBuf, Arc<DecodedPicture>)>,
    /// Masks as their files have them; others have no file, or an older one.
    masks: Masks,
    /// The desk's masks and the names their files have: those of another tour are never overwritten.
    mask_names: BTreeMap<String, String>,
    recovery: Recovery,
}

/// The recovery file of this desk.
#[derive(Debug, Default)]
struct Recovery {
    path: Option<PathBuf>,
    /// The revision that it holds.
    revision: u64,
    /// When it was written, in the seconds of [`Desk::autosave`].
    written: Option<f64>,
    packed: recovery::Packed,
    /// Whether this desk wrote it; one that was taken stays until its marks are saved.
    is_own: bool,
}

impl Desk {
    /// What is being marked.
    #[must_use]
    pub fn draft(&self) -> &Draft {
        &self.draft
    }

    /// The document that is being marked.
    #[must_use]
    pub fn tour(&self) -> &TourFile {
        &self.draft.tour
    }

    /// The steps that can be undone and redone, and whether all is saved.
    #[must_use]
    pub fn history(&self) -> &History {
        &self.history
    }

    /// The picture; `None` when its file has moved, until [`find_picture`](Self::find_picture).
    #[must_use]
    pub fn picture(&self) -> Option<&Arc<DecodedPicture>> {
        self.picture.as_ref()
    }

    /// The tour's file, where [`save`](Self::save) writes; a new tour's is not there yet.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.files.tour
    }

    /// Whether the tour has never been saved.
    #[must_use]
    pub fn is_new(&self) -> bool {
        self.files.text.is_none()
    }

    /// Whether every change stands in the tour's file.
    #[must_use]
    pub fn is_saved(&self) -> bool {
        self.history.is_saved()
    }

    /// Whether a crash would lose nothing: every change stands in the tour's file or in the recovery file.
    #[must_use]
    pub fn is_kept(&self) -> bool {
        let Recovery { path, revision, .. } = &self.files.recovery;
        self.is_saved() || (path.is_some() && *revision == self.history.revision())
    }

    /// Does an edit; see [`History::apply`].
    ///
    /// # Errors
    /// As [`Edit::apply`]; nothing has changed then.
    pub fn apply(&mut self, edit: &Edit) -> Result<bool, EditError> {
        self.history.apply(edit, &mut self.draft)
    }

    /// Begins a step of several edits; see [`History::begin_gesture`].
    pub fn begin_gesture(&mut self) {
        self.history.begin_gesture();
    }

    /// Ends it.
    pub fn end_gesture(&mut self) {
        self.history.end_gesture();
    }

    /// Takes it back, as Escape does.
    ///
    /// # Errors
    /// As [`History::cancel_gesture`].
    pub fn cancel_gesture(&mut self) -> Result<(), EditError> {
        let done = self.history.cancel_gesture(&mut self.draft);
        self.follow_picture();
        done
    }

    /// Undoes the last step; its title.
    ///
    /// # Errors
    /// As [`History::undo`].
    pub fn undo(&mut self) -> Result<Option<Title>, EditError> {
        let done = self.history.undo(&mut self.draft);
        self.follow_picture();
        done
    }

    /// Does again what was undone last; its title.
    ///
    /// # Errors
    /// As [`History::redo`].
    pub fn redo(&mut self) -> Result<Option<Title>, EditError> {
        let done = self.history.redo(&mut self.draft);
        self.follow_picture();
        done
    }
}

#[cfg(test)]
mod tests;
