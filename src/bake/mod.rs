//! Baked tours: all layers of an assembled tour in one file, written once and loaded fast.
//!
//! Building maps takes many seconds, reading them back a fraction of one. `NAME.tour.baked` lies beside
//! `NAME.tour.ron`; its [`Fingerprint`] says of which tour, files and options it was made, so a stale one is
//! known without decoding anything.
//!
//! Numbers are little-endian. Every byte is under a BLAKE3 hash:
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `89 50 54 42 0d 0a 1a 0a`, the last four to notice a transfer as text |
//! | 4 | [`FORMAT_VERSION`] |
//! | 32 | the fingerprint |
//! | 8 | the header's length |
//! | 32 | hash of all bytes before this and of the header |
//! | … | the header in RON: tour, annotations, scene plan, remarks, tint, each layer's place, size and hash |
//! | … | the layers in the header's order, texture before reflection: RGBA8 cells of all mip levels, fine to coarse, one block of LZ4 each |
//!
//! What is quick to derive is derived again from what was marked: the solution by [`crate::solve`], the
//! planes by [`crate::scene`].

mod error;
mod fingerprint;
mod header;
mod read;
mod write;

pub use error::BakeError;
pub use fingerprint::{Fingerprint, fingerprint};
pub use header::{FORMAT_VERSION, fingerprint_of};
pub use read::decode;
pub use write::{encode, save};

use std::path::{Path, PathBuf};

use glam::UVec2;

use crate::assemble::AssembledTour;
use crate::maps::MapOptions;
use crate::motion::Recordings;
use crate::tour::RelativePath;
use crate::tour::Tour;

/// A baked tour, read back.
#[derive(Clone, Debug, PartialEq)]
pub struct Baked {
    /// Of what it was made.
    pub fingerprint: Fingerprint,
    /// The tour in pixels of the part of the picture that is used, as a
    /// [`TourSource`](crate::assemble::TourSource) has it.
    pub tour: Tour,
    /// What was baked: plan and maps to the bit; the solution is solved again. Without recordings.
    pub built: AssembledTour,
    /// Width and height of the used part of the picture, pixels.
    pub picture_size: UVec2,
    /// Width and height of the whole picture, pixels.
    pub uncropped_size: UVec2,
}

impl Baked {
    /// The same maps for the tour as its file says it now, which must have the same [`fingerprint()`]: wind,
    /// waves, path and how objects move are not part of that, and may have changed since.
    #[must_use]
    pub fn with_tour(mut self, tour: &Tour) -> Self {
        self.tour = tour.in_pixels_of(self.uncropped_size);
        self.built.turn_as_marked(&self.tour);
        self
    }

    /// The same tour with the recordings that its document names, which are not baked.
    #[must_use]
    pub fn with_recordings(mut self, recordings: Recordings) -> Self {
        self.built.recordings = recordings;
        self
    }
}

/// Why a baked tour is not used. Its text says what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NotFresh {
    /// Made of something else.
    #[error("it is stale: the tour, its files or this program changed since; run `picture-tour bake` again")]
    Stale,
    /// It cannot be read.
    #[error(transparent)]
    Broken(#[from] BakeError),
    /// A file that the tour names cannot be read.
    #[error("{0}")]
    Unread(String),
}

/// Reads a tour's baked file if it is fresh: made of this tour, these files and options, by this program. `read` gets a
/// path relative to the tour's folder.
///
/// # Errors
///
/// Why it is not used.
pub fn fresh(
    bytes: &[u8],
    tour: &Tour,
    options: &MapOptions,
    read: &dyn Fn(&RelativePath) -> Result<Vec<u8>, String>,
) -> Result<Baked, NotFresh> {
    if fingerprint_of(bytes)? != fingerprint(tour, options, read).map_err(NotFresh::Unread)? {
        return Err(NotFresh::Stale);
    }
    Ok(decode(bytes)?.with_tour(tour))
}

/// Where a tour's baked file lies: `lake.tour.baked` beside `lake.tour.ron`.
#[must_use]
pub fn baked_path(tour: &Path) -> PathBuf {
    tour.with_extension("baked")
}

#[cfg(test)]
mod tests;
