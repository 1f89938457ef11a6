//! What can go wrong between a desk and its files. Each message says what happened and what can be done.

use std::io;
use std::path::{Path, PathBuf};

use glam::UVec2;

use crate::picture::PictureError;
use crate::tour::Problems;
use crate::tour::edit::EditError;

/// Why a file could not be opened, saved or recovered. What was marked is still there.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DeskError {
    /// A file or folder could not be read.
    #[error("{} could not be read ({source}); check that it is there and may be read", path.display())]
    Read {
        /// Which.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A file or folder could not be written.
    #[error(
        "{} could not be written ({source}); nothing that was marked is lost: free space, or save it elsewhere",
        path.display()
    )]
    Write {
        /// Which.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A folder stands where a file is expected.
    #[error("{} is a folder; choose a picture or a tour in it", path.display())]
    IsFolder {
        /// Which.
        path: PathBuf,
    },
    /// The text is no tour.
    #[error("{problems}")]
    NoTour {
        /// Everything that is wrong with it, with the file's name.
        problems: Problems,
    },
    /// The picture or mask cannot be used.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A tour cannot name this file.
    #[error("a tour cannot name {name:?}; rename the file to letters, digits, `-` and `_`")]
    FileName {
        /// The file's name.
        name: String,
    },
    /// Another picture than the one that was marked.
    #[error(
        "{} is {} x {} pixels, another shape than the {} x {} that were marked; choose the picture that was marked",
        path.display(), found.x, found.y, expected.x, expected.y
    )]
    OtherShape {
        /// The picture.
        path: PathBuf,
        /// Its size, pixels.
        found: UVec2,
        /// The size that was marked, pixels.
        expected: UVec2,
    },
    /// The tour's file is not as this desk left it: another window or program wrote it.
    #[error(
        "{} was changed by another window or program; save it under another name, or replace it (what stands there now \
         is kept as a version)", path.display()
    )]
    ChangedOnDisk {
        /// The tour.
        path: PathBuf,
    },
    /// What an interrupted session left cannot be read.
    #[error("{} cannot be read as a recovery file ({reason}); the tour was opened as it was saved", path.display())]
    BrokenRecovery {
        /// Where the file is now.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// An edit was refused.
    #[error(transparent)]
    Edit(#[from] EditError),
}

impl DeskError {
    pub(super) fn read(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| if path.is_dir() { Self::IsFolder { path } } else { Self::Read { path, source } }
    }

    pub(super) fn write(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Write { path, source }
    }
}
