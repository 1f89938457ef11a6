//! What keeps a tour from being baked, or a baked one from being read.

use crate::solve::SolveError;

/// Why there is no baked tour.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BakeError {
    /// Another kind of file, or one that was transferred as text.
    #[error("this is not a baked tour; make one with `picture-tour bake`, and copy it as binary data")]
    NotBaked,
    /// Written by an older or newer program.
    #[error(
        "the baked tour has format {found}, and this program reads format {readable}; bake again with \
         `picture-tour bake`"
    )]
    OtherVersion {
        /// The file's format.
        found: u32,
        /// The format that this program reads and writes.
        readable: u32,
    },
    /// The file ends too early.
    #[error(
        "the baked tour ends early, {found} bytes where {needed} should be; copy it anew, or bake again with \
         `picture-tour bake`"
    )]
    Truncated {
        /// Bytes of the file, or of the layers at its end.
        found: u64,
        /// Bytes that should be there at least.
        needed: u64,
    },
    /// A byte is not what was written.
    #[error("the baked tour is damaged ({0}); copy it anew, or bake again with `picture-tour bake`")]
    Damaged(String),
    /// The header is as it was written, but says nothing this program knows.
    #[error("the baked tour's header does not read ({0}); bake again with `picture-tour bake`")]
    Header(String),
    /// The header's numbers contradict each other or what it describes.
    #[error("the baked tour's sizes do not add up ({0}); bake again with `picture-tour bake`")]
    Sizes(String),
    /// What was marked cannot be solved any more.
    #[error("the baked tour cannot be solved ({0}); bake again with `picture-tour bake`")]
    Solve(#[from] SolveError),
    /// More than a file holds.
    #[error("the tour is too large to be baked ({0}); scale its picture down")]
    TooLarge(String),
    /// The tour is not the one that its source was read for.
    #[error(
        "the tour and its picture do not belong together; read the picture anew for this tour, then bake"
    )]
    OtherTour,
}
