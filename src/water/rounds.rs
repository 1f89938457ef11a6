//! Whole rounds of what repeats by itself, in the time after which everything else repeats.

/// Most by which something may run faster than it should, to fit a loop.
pub(super) const MOST_HASTE: f64 = 2.0;

/// Why something recorded cannot repeat after a given time.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RoundError {
    /// It would have to run too fast.
    #[error(
        "a round takes {round_seconds:.1} s, which fits no loop of {loop_seconds} s; make the loop at least {least_seconds:.1} s long"
    )]
    LoopTooShort {
        /// Time of a round as recorded.
        round_seconds: f64,
        /// The loop asked for.
        loop_seconds: f64,
        /// The shortest loop that would do.
        least_seconds: f64,
    },
    /// It stops at its end.
    #[error("the recording stops at its end and does not repeat; write `looped: true`")]
    NoRounds,
}

/// How many times as fast as it should something must run for whole rounds of it to fit `loop_seconds`: at most
/// `most` times, never less than half. The error is the shortest loop that would do, in seconds.
pub(super) fn haste_of_whole_rounds(round: f64, loop_seconds: f64, most: f64) -> Result<f64, f64> {
    let rounds = (loop_seconds / round).round().max(1.0);
    let haste = rounds * round / loop_seconds;
    if haste > 0.0 && haste <= most { Ok(haste) } else { Err(round / most) }
}

/// As [`haste_of_whole_rounds`], for a recording, at most [`MOST_HASTE`] times.
pub(super) fn haste_of_recording(round_seconds: f64, loop_seconds: f64) -> Result<f64, RoundError> {
    haste_of_whole_rounds(round_seconds, loop_seconds, MOST_HASTE)
        .map_err(|least_seconds| RoundError::LoopTooShort { round_seconds, loop_seconds, least_seconds })
}
