//! A wind that is changed at run time and follows gently.

use super::{FASTEST_WIND, sound_speed};
use crate::tour::Wind;

/// Time in which two thirds of a change have come, seconds.
const EASE_SECONDS: f64 = 1.0;

/// Multiples of [`EASE_SECONDS`] after which a change has come wholly.
const DONE: f64 = 6.0;

/// The wind as a function of time and of one time-stamped change. It never jumps, and it arrives exactly, also at 0.
///
/// Speed, direction (the shorter way round) and gusts ease; seed and period belong to what was built from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChangingWind {
    before: Wind,
    after: Wind,
    since: f64,
}

impl ChangingWind {
    /// A wind that has always blown as it does.
    #[must_use]
    pub fn steady(wind: Wind) -> Self {
        Self { before: wind, after: wind, since: 0.0 }
    }

    /// What the wind is on its way to, or is.
    #[must_use]
    pub fn target(&self) -> Wind {
        self.after
    }

    /// Lets the wind turn to `wind`, from what it is at `seconds`. Numbers are brought into their ranges; asking for
    /// the wind it already turns to, or at no finite time, does nothing.
    pub fn change(&mut self, seconds: f64, wind: Wind) {
        let number = |value: f64, old: f64| if value.is_finite() { value } else { old };
        let wind = Wind {
            speed: sound_speed(number(wind.speed, self.after.speed)).min(FASTEST_WIND),
            direction_deg: number(wind.direction_deg, self.after.direction_deg),
            gusts: number(wind.gusts, self.after.gusts).clamp(0.0, 1.0),
            ..self.after
        };
        if wind != self.after && seconds.is_finite() {
            *self = Self { before: self.at(seconds), after: wind, since: seconds };
        }
    }

    /// The wind at a time; before the last change it is what it was just then.
    #[must_use]
    pub fn at(&self, seconds: f64) -> Wind {
        let kept = kept((seconds - self.since) / EASE_SECONDS);
        if kept <= 0.0 {
            return self.after;
        }
        let (before, after) = (self.before, self.after);
        let back = (before.direction_deg - after.direction_deg + 180.0).rem_euclid(360.0) - 180.0;
        Wind {
            speed: after.speed + kept * (before.speed - after.speed),
            direction_deg: after.direction_deg + kept * back,
            gusts: after.gusts + kept * (before.gusts - after.gusts),
            ..after
        }
    }
}

/// Which part of the old wind is left: 1 before the change, then an exponential that ends.
///
/// An exponential forgets where it started, so a slider that is dragged, one change a frame, is followed as well.
fn kept(since: f64) -> f64 {
    let end = (-DONE).exp();
    if since.is_nan() { 0.0 } else { (((-since.max(0.0)).exp() - end) / (1.0 - end)).max(0.0) }
}
