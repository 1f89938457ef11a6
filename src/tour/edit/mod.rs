//! Marking a tour: every change is an [`Edit`] that can be undone, on a [`Draft`] that may be incomplete.
//!
//! A [`Draft`] is the document ([`TourFile`], unchecked) and its masks. [`Edit::apply`] changes it and
//! gives the inverse; [`History`] keeps inverses as steps to undo and redo; a [`Desk`](desk::Desk) has it all with its files.
//! A refused edit has changed nothing. No window, no clock and no random choice is in here; time is an argument.

mod address;
mod apply;
pub mod desk;
mod error;
mod finite;
mod history;
mod kind;
mod masks;
mod names;
mod part;
mod snap;
mod title;
mod touched;

pub use address::{LineAt, ListEdit, Named, PlaceAt, PointAt, RegionAt};
pub use error::EditError;
pub use history::History;
pub use kind::Edit;
pub use masks::{MaskPatch, Masks, PackedMask};
pub use part::Restored;
pub use snap::snap;
pub use title::{Action, Thing, Title};

use super::TourFile;

/// What is being marked: the document, perhaps incomplete, and the masks it names.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {
    /// The document.
    pub tour: TourFile,
    /// The masks that the document names, by their paths.
    pub masks: Masks,
}

impl Draft {
    /// A draft without masks.
    #[must_use]
    pub fn new(tour: TourFile) -> Self {
        Self { tour, masks: Masks::default() }
    }
}

#[cfg(test)]
mod tests;
