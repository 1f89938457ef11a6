//! What keeps a picture from being solved.
//!
//! Every error names the annotation at fault and says what to mark or to change.

use crate::picture::PicturePoint;

/// Why the camera and the distances could not be found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// Neither a horizon nor enough pairs.
    #[error(
        "{found} reflection pairs and no horizon cannot place the camera; mark the horizon, or two reflection pairs"
    )]
    NothingToSolveFrom {
        /// Pairs that were marked.
        found: usize,
    },
    /// Without a horizon, the pairs must agree; fewer than two do.
    #[error(
        "only {agreeing} of {found} reflection pairs agree with each other; mark the horizon, or correct the pairs"
    )]
    PairsDisagree {
        /// Pairs that agree with the best camera found.
        agreeing: usize,
        /// Pairs that were marked.
        found: usize,
    },
    /// Two points of the horizon that lie above one another rather than side by side.
    #[error(
        "the horizon through {left} and {right} is steeper than 45°; mark it by two points that lie side by side"
    )]
    HorizonTooSteep {
        /// One end.
        left: PicturePoint,
        /// The other end.
        right: PicturePoint,
    },
    /// A pair or a length refers to a plane that is not there.
    #[error("{what} lies on plane {index}, but only {planes} planes are marked")]
    UnknownPlane {
        /// What refers to it.
        what: String,
        /// The index it names, from 0.
        index: usize,
        /// How many planes there are.
        planes: usize,
    },
    /// A number that must be above zero (or not below it) is not.
    #[error("{what} is {value}; it must be {must_be}")]
    OutOfRange {
        /// Which annotation.
        what: String,
        /// Its value.
        value: f64,
        /// What would be accepted.
        must_be: &'static str,
    },
    /// The known length cannot set the scale: its plane's foot is not below the horizon, or it has no extent.
    #[error(
        "the length of {meters} m on plane {plane:?} cannot set the scale; its plane must meet the water or ground below the horizon, and its ends must differ"
    )]
    UselessLength {
        /// Name of the plane.
        plane: String,
        /// The length given, meters.
        meters: f64,
    },
}
