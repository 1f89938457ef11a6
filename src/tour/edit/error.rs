//! Why an edit is refused. A refused edit has changed nothing.

use crate::tour::UnsafePath;

/// Why an edit is refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EditError {
    /// A number is not finite, or a point of the picture is absurdly far from it.
    #[error("{what} has a number that is not finite or out of reach")]
    NotFinite {
        /// What was set.
        what: &'static str,
    },
    /// The list has no such place.
    #[error("there is no {what} number {}", index + 1)]
    NoSuch {
        /// What was meant.
        what: &'static str,
        /// Its index, from 0.
        index: usize,
    },
    /// What was meant is not marked yet.
    #[error("{what} is not marked yet, so nothing of it can be changed")]
    Unmarked {
        /// What was meant.
        what: &'static str,
    },
    /// It belongs to something that cannot be without it.
    #[error("{what} cannot be left out; remove what it belongs to instead")]
    Needed {
        /// What was to be left out.
        what: &'static str,
    },
    /// Nothing has this name.
    #[error("nothing is called `{name}`")]
    UnknownName {
        /// The name.
        name: String,
    },
    /// The name is empty, or means something else.
    #[error("`{name}` cannot be a name; choose another one")]
    BadName {
        /// The name.
        name: String,
    },
    /// Another object or band has this name.
    #[error("the name `{name}` is taken; choose another one")]
    NameTaken {
        /// The name.
        name: String,
    },
    /// A path that a tour may not name.
    #[error("{path:?} cannot be named by a tour: {why}")]
    BadPath {
        /// The path.
        path: String,
        /// What is wrong with it.
        why: UnsafePath,
    },
    /// The mask is not there.
    #[error("there is no mask `{name}`")]
    NoMask {
        /// Its path.
        name: String,
    },
    /// The mask is still named by the document.
    #[error("the mask `{name}` is still used by {place}")]
    MaskInUse {
        /// Its path.
        name: String,
        /// Where the document names it.
        place: String,
    },
    /// The painted rectangle reaches beyond the mask, or holds other pixels than it has.
    #[error("the painted rectangle does not fit the mask `{name}`")]
    PatchMisfit {
        /// The mask's path.
        name: String,
    },
    /// Packed coverage that does not unpack.
    #[error("the packed coverage is damaged")]
    Damaged,
}
