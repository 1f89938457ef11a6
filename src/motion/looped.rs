//! Tours that repeat after a given time, for films that loop: every period becomes a whole part of it.

use crate::tour::{Motion, Tour};

/// Shortest loop, seconds: shorter ones look like a machine.
pub const SHORTEST_LOOP: f64 = 8.0;

/// Longest loop, seconds: what begins anew is simulated to its end.
pub const LONGEST_LOOP: f64 = 3600.0;

/// Longest period of the tour's wind and plants, seconds.
const LONGEST_PERIOD: f64 = 120.0;

/// Why a tour cannot repeat after so many seconds.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LoopError {
    /// A loop that is too short, too long, or no number.
    #[error("a loop of {0} s cannot be made; ask for 8 s to 3600 s")]
    Length(f64),
    /// Something whose way does not fit.
    #[error("\"{name}\" does not fit a loop of {seconds} s: {reason}")]
    Mover {
        /// The object's name.
        name: String,
        /// The loop asked for.
        seconds: f64,
        /// Why, and what to do.
        reason: String,
    },
}

/// The tour with the periods of its wind and plants changed as little as makes them whole parts of `seconds`, but never
/// shortened where they can be lengthened.
pub(super) fn with_whole_periods(tour: &Tour, seconds: f64) -> Result<Tour, LoopError> {
    if !(SHORTEST_LOOP..=LONGEST_LOOP).contains(&seconds) {
        return Err(LoopError::Length(seconds));
    }
    let mut file = tour.to_file();
    file.wind.period_seconds = whole_part(seconds, file.wind.period_seconds);
    for object in &mut file.objects {
        if let Motion::Sway(sway) = &mut object.motion {
            sway.period_seconds = sway.period_seconds.map(|period| whole_part(seconds, period));
        }
    }
    // Periods stay in their range, so what was sound still is.
    Ok(Tour::check(file).unwrap_or_else(|_| tour.clone()))
}

/// The shortest whole part of a loop that is no shorter than `period`, if a period may be that long.
fn whole_part(seconds: f64, period: f64) -> f64 {
    seconds / (seconds / period).floor().max((seconds / LONGEST_PERIOD).ceil()).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_become_whole_parts_within_their_range() {
        for (seconds, period, expected) in [
            (20.0, 20.0, 20.0),
            (12.0, 20.0, 12.0),
            (10.0, 4.0, 5.0),
            (130.0, 120.0, 65.0),
            (3600.0, 20.0, 20.0),
        ] {
            assert_eq!(whole_part(seconds, period), expected, "a period of {period} s in {seconds} s");
        }
    }
}
