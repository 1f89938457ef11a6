//! Gusts: a slow looped envelope that travels with the wind, so that plants downwind get it later.

use std::f64::consts::TAU;

use glam::DVec2;

use super::part_of_loop;
use crate::random::Random;

/// How many harmonics of the loop make the envelope.
const HARMONICS: usize = 4;

/// Speed of a gust's front, m/s. It is fixed: with the wind's own speed, every change of wind would sweep the fronts
/// over far plants.
const FRONT_SPEED: f64 = 8.0;

/// The envelope of the gusts over one loop. Its mean square is 1 at any gustiness, so gusts change when a plant moves
/// much, not how much it moves in the mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Gusts {
    harmonics: [DVec2; HARMONICS],
    mean_square: f64,
    period: f64,
}

impl Gusts {
    /// The gusts of a seed with a loop of `period` seconds (above 0).
    #[must_use]
    pub fn new(seed: u64, period: f64) -> Self {
        let mut random = Random::new(seed, 2);
        let harmonics: [DVec2; HARMONICS] =
            std::array::from_fn(|h| DVec2::from_angle(random.angle()) / (h + 1) as f64);
        let mut gusts = Self { harmonics, mean_square: 0.0, period };
        let peak = (0..256).map(|i| gusts.excess(f64::from(i) / 256.0 * period).abs()).fold(0.0, f64::max);
        gusts.harmonics = gusts.harmonics.map(|harmonic| harmonic / peak);
        gusts.mean_square = 0.5 * gusts.harmonics.iter().map(|h| h.length_squared()).sum::<f64>();
        gusts
    }

    /// Factor of the wind's effect at a time, at a place `downwind` meters along the wind: not below 0, at most 2.
    /// `gustiness` is 0 (always 1) to 1.
    #[must_use]
    pub fn at(&self, seconds: f64, downwind: f64, gustiness: f64) -> f64 {
        let gustiness = if gustiness.is_nan() { 0.0 } else { gustiness.clamp(0.0, 1.0) };
        let swing = 1.0 + gustiness * self.excess(seconds - downwind / FRONT_SPEED);
        (swing / (1.0 + gustiness * gustiness * self.mean_square).sqrt()).clamp(0.0, 2.0)
    }

    /// The envelope by itself: mean 0, from −1 to 1.
    fn excess(&self, seconds: f64) -> f64 {
        let turn = DVec2::from_angle(TAU * part_of_loop(seconds, self.period));
        self.harmonics.iter().rev().fold(DVec2::ZERO, |sum, &harmonic| turn.rotate(sum + harmonic)).x
    }
}
