//! How to get to any time: the same state in whatever order times are asked for, by a bounded number of steps.

use super::STEP_SECONDS;
use super::Simulation;
use super::near_water::NearWater;
use crate::wind::ChangingWeather;
use crate::wind::Weather;

/// Steps after which water and bodies have forgotten what was: 20 s, four half-lives of ripples.
pub const MEMORY_STEPS: u64 = 1200;

/// Steps that share what was before them, when times are jumped to: 2 s, so that the memory is 18 s at least.
pub const BLOCK_STEPS: u64 = 120;

/// The same for loops, whose ends must meet: twelve half-lives.
const LOOP_MEMORY_STEPS: u64 = 3600;

/// The last step that is counted; at some ten thousand years, steps are still whole numbers in f64.
const LAST_STEP: f64 = (1_u64 << 44) as f64;

impl Simulation {
    /// Goes to `seconds` from the tour's start; what is before that, or no number, is the start. Between two steps, ripples
    /// and floating bodies are between where the steps leave them; all else is a function of time.
    ///
    /// Touches are forgotten, and the weather that was [set](Self::set_weather) last counts as having been so from the start.
    /// Nothing else of what was before counts, in whatever order times are asked for. Of water and bodies at most the last
    /// 20 s before that time are simulated, from the next whole [block](BLOCK_STEPS) of steps on, so that one time after the
    /// other is reached by stepping on. In the first 20 s of a tour this is what as many steps give, to the bit. A
    /// [looped](Self::looped) tour has gone on for a minute before its start.
    pub fn go_to(&mut self, seconds: f64) {
        let (rested_at, last, lag) = self.way_to(seconds);
        let goes_on =
            !self.touched && self.rested_at == rested_at && (rested_at..=last).contains(&self.steps);
        if !goes_on {
            self.touched = false;
            self.weather = ChangingWeather::steady(self.weather.target());
            (self.rested_at, self.steps, self.lag) = (rested_at, rested_at, 0.0);
            if let Some(near) = &mut self.near {
                near.ripples.still();
            }
            self.movers.rest();
            self.raise_sea();
        }
        while self.steps < last {
            self.advance();
        }
        if self.lag != lag {
            self.lag = lag;
            self.raise_sea();
            if let Some(near) = &mut self.near {
                near.ripples.look_back(lag);
            }
        }
        self.show();
    }

    /// The step at which everything rests so that it is as it should at `seconds`, the step that this lies in, and how much
    /// of that is still to come then.
    fn way_to(&self, seconds: f64) -> (u64, u64, f64) {
        let (rested_at, (last, lag)) = match self.loop_seconds {
            None => {
                let (last, lag) = step_of(seconds);
                let block = last.saturating_sub(MEMORY_STEPS).div_ceil(BLOCK_STEPS);
                (block * BLOCK_STEPS, (last, lag))
            }
            Some(round) => {
                let rounds = (LOOP_MEMORY_STEPS as f64 * STEP_SECONDS / round).ceil() * round;
                let within = if seconds.is_finite() { seconds.rem_euclid(round) } else { 0.0 };
                (step_of(rounds).0 - LOOP_MEMORY_STEPS, step_of(rounds + within))
            }
        };
        (if self.has_memory() { rested_at } else { last }, last, lag)
    }

    /// Whether water or bodies can be otherwise than at rest before anything is touched.
    fn has_memory(&self) -> bool {
        let Weather { wind, waves } = self.weather.target();
        let waves = self.sea.as_ref().is_some_and(|sea| waves * sea.gain(wind.speed) > 0.0);
        let is_walled = self.near.as_ref().is_some_and(NearWater::has_walls);
        self.movers.sail() || waves && (is_walled || self.movers.swim())
    }
}

/// The step that a time lies in, or ends, and how much of it is still to come then, 0 to below 1. What is no number is 0.
fn step_of(seconds: f64) -> (u64, f64) {
    let exact = (seconds / STEP_SECONDS).clamp(0.0, LAST_STEP);
    let nearest = exact.round();
    // The time of a frame is not quite a whole number of steps. A comparison with NaN is false.
    if (exact - nearest).abs() > 1e-3 {
        (exact.ceil() as u64, exact.ceil() - exact)
    } else {
        (nearest as u64, 0.0)
    }
}
