//! Weather that is changed at run time and follows gently.

use super::{FASTEST_WIND, sound_speed};
use crate::tour::Wind;

/// Time in which two thirds of a change have come, seconds.
const EASE_SECONDS: f64 = 1.0;

/// The same for the direction of the waves, which are slower than the wind that turns them.
const TURN_SECONDS: f64 = 4.0;

/// Multiples of these after which a change has come wholly.
const DONE: f64 = 6.0;

/// How many times as high as the wind raises them waves may be asked to be.
pub const HIGHEST_WAVES: f64 = 4.0;

/// The wind, and how high its waves are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weather {
    /// The wind.
    pub wind: Wind,
    /// How many times as high as this wind raises them the waves are: 0 (none) to [`HIGHEST_WAVES`].
    pub waves: f64,
}

impl From<Wind> for Weather {
    fn from(wind: Wind) -> Self {
        Self { wind, waves: 1.0 }
    }
}

/// The weather as a function of time and of one time-stamped change. It never jumps, and it arrives exactly, also at 0.
///
/// Speed, direction (the shorter way round), gusts and waves ease; seed and period belong to what was built from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChangingWeather {
    before: Weather,
    after: Weather,
    /// Where waves were turned to before.
    waves_before_deg: f64,
    since: f64,
}

impl ChangingWeather {
    /// Weather that has always been as it is.
    #[must_use]
    pub fn steady(weather: Weather) -> Self {
        Self { before: weather, after: weather, waves_before_deg: weather.wind.direction_deg, since: 0.0 }
    }

    /// What the weather is on its way to, or is.
    #[must_use]
    pub fn target(&self) -> Weather {
        self.after
    }

    /// Lets the weather turn to another, from what it is at `seconds`, and says whether it does. Numbers are brought into
    /// their ranges, what is none stays as it was; asking for the weather it already turns to, or at no finite time, does
    /// nothing.
    pub fn change(&mut self, seconds: f64, weather: Weather) -> bool {
        let number = |value: f64, old: f64| if value.is_finite() { value } else { old };
        let (wind, old) = (weather.wind, self.after.wind);
        let wind = Wind {
            speed: sound_speed(number(wind.speed, old.speed)).min(FASTEST_WIND),
            direction_deg: number(wind.direction_deg, old.direction_deg),
            gusts: number(wind.gusts, old.gusts).clamp(0.0, 1.0),
            ..old
        };
        let weather =
            Weather { wind, waves: number(weather.waves, self.after.waves).clamp(0.0, HIGHEST_WAVES) };
        let changes = weather != self.after && seconds.is_finite();
        if changes {
            let waves_before_deg = self.waves_direction_deg(seconds);
            *self = Self { before: self.at(seconds), after: weather, waves_before_deg, since: seconds };
        }
        changes
    }

    /// The weather at a time; before the last change it is what it was just then.
    #[must_use]
    pub fn at(&self, seconds: f64) -> Weather {
        let kept = kept((seconds - self.since) / EASE_SECONDS);
        if kept <= 0.0 {
            return self.after;
        }
        let (before, after) = (self.before.wind, self.after.wind);
        let wind = Wind {
            speed: after.speed + kept * (before.speed - after.speed),
            direction_deg: between(before.direction_deg, after.direction_deg, kept),
            gusts: after.gusts + kept * (before.gusts - after.gusts),
            ..after
        };
        Weather { wind, waves: self.after.waves + kept * (self.before.waves - self.after.waves) }
    }

    /// The wind's direction that waves have followed to at a time, degrees. It takes them four times as long.
    #[must_use]
    pub fn waves_direction_deg(&self, seconds: f64) -> f64 {
        let kept = kept((seconds - self.since) / TURN_SECONDS);
        between(self.waves_before_deg, self.after.wind.direction_deg, kept)
    }
}

/// The direction, in degrees, of which `kept` is still the old one, the shorter way round; the new one itself in the end.
fn between(before: f64, after: f64, kept: f64) -> f64 {
    if kept > 0.0 { after + kept * ((before - after + 180.0).rem_euclid(360.0) - 180.0) } else { after }
}

/// Which part of the old weather is left: 1 before the change, then an exponential that ends.
///
/// An exponential forgets where it started, so a slider that is dragged, one change a frame, is followed as well.
fn kept(since: f64) -> f64 {
    let end = (-DONE).exp();
    if since.is_nan() { 0.0 } else { (((-since.max(0.0)).exp() - end) / (1.0 - end)).max(0.0) }
}
