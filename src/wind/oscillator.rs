//! A damped harmonic oscillator in the wind, as a signal that loops without a seam.
//!
//! The signal is complex (analytic): its real part at a place where the motion comes with a phase ψ is Re(x e^(−iψ)), so
//! one evaluation a frame serves the whole plant. Complex numbers are `DVec2`s, multiplied by `DVec2::rotate`.

use std::f64::consts::TAU;

use glam::DVec2;

use super::part_of_loop;
use super::spectrum::{NOMINAL_SPEED, velocity_power};
use crate::random::Random;

/// Multiples of the natural frequency above which the answer is left out; 0.1 % of its energy lies there.
const HIGHEST: f64 = 2.5;

/// Most oscillations in one loop. A faster oscillator repeats a whole number of times within the period.
const MOST_CYCLES: f64 = 48.0;

/// How many sets of phases are drawn, and the crest of the one to be kept: one whose phases happen to meet would stand
/// out once a loop, and the repetition with it.
const DRAWS: usize = 4;
const USUAL_CREST: f64 = 3.0;

/// A damped harmonic oscillator: x″ + 2ζω₀ x′ + ω₀² x = force per mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillator {
    /// Undamped natural frequency, hertz, above 0.
    pub frequency_hz: f64,
    /// Damping ratio ζ, above 0.
    pub damping: f64,
}

impl Oscillator {
    /// Complex answer to a unit force of a frequency, 1/s⁻² (notes §6.1).
    #[must_use]
    pub fn response(&self, frequency_hz: f64) -> DVec2 {
        let (natural, driven) = (TAU * self.frequency_hz, TAU * frequency_hz);
        let stiffness =
            DVec2::new(natural * natural - driven * driven, 2.0 * self.damping * natural * driven);
        DVec2::new(stiffness.x, -stiffness.y) / stiffness.length_squared()
    }
}

/// An oscillator's motion in the wind: looped, without a mean, its real part of root mean square 1.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopedSignal {
    /// Amplitude and phase of the harmonics, two by two: 1 and 2, 3 and 4, …
    harmonics: Vec<[DVec2; 2]>,
    period: f64,
    repeats: f64,
    crest: f64,
}

impl LoopedSignal {
    /// The motion of `oscillator` with a loop of `period` seconds (above 0); phases come from the seed.
    #[must_use]
    pub fn new(oscillator: Oscillator, period: f64, seed: u64) -> Self {
        let mut random = Random::new(seed, 1);
        let mut best = Self::drawn(oscillator, period, &mut random);
        for _ in 1..DRAWS {
            let other = Self::drawn(oscillator, period, &mut random);
            if (other.crest - USUAL_CREST).abs() < (best.crest - USUAL_CREST).abs() {
                best = other;
            }
        }
        best
    }

    fn drawn(oscillator: Oscillator, period: f64, random: &mut Random) -> Self {
        let cycles = oscillator.frequency_hz * period;
        let repeats = (cycles / MOST_CYCLES).ceil().max(1.0);
        let step = repeats / period;
        // A slow oscillator in a short loop has but a few harmonics; eight leave it some variety.
        let pairs = ((0.5 * HIGHEST * oscillator.frequency_hz / step).ceil() as usize).max(4);
        let mut harmonic = |j: usize| {
            let frequency = j as f64 * step;
            let force = (2.0 * velocity_power(frequency, NOMINAL_SPEED)).sqrt();
            force * DVec2::from_angle(random.angle()).rotate(oscillator.response(frequency))
        };
        let mut harmonics: Vec<[DVec2; 2]> =
            (0..pairs).map(|pair| [harmonic(2 * pair + 1), harmonic(2 * pair + 2)]).collect();
        let rms = (0.5 * harmonics.iter().flatten().map(|a| a.length_squared()).sum::<f64>()).sqrt();
        for harmonic in harmonics.iter_mut().flatten() {
            *harmonic /= rms;
        }
        let mut signal = Self { harmonics, period, repeats, crest: 0.0 };
        // Lengths change with the width of the resonance, far slower than the fastest harmonic.
        let samples = 8 * pairs;
        signal.crest = (0..samples)
            .map(|i| signal.at(i as f64 / samples as f64 * period / repeats).length())
            .fold(0.0, f64::max);
        signal
    }

    /// The complex signal at a time.
    #[must_use]
    pub fn at(&self, seconds: f64) -> DVec2 {
        let part = (part_of_loop(seconds, self.period) * self.repeats).fract();
        let turn = DVec2::from_angle(TAU * part);
        // Horner's rule, on even and odd harmonics by themselves so that two multiplications overlap.
        let twice = turn.rotate(turn);
        let mut sums = [DVec2::ZERO; 2];
        for pair in self.harmonics.iter().rev() {
            sums = [twice.rotate(sums[0]) + pair[0], twice.rotate(sums[1]) + pair[1]];
        }
        turn.rotate(sums[0] + turn.rotate(sums[1]))
    }

    /// The longest that the complex signal ever is, in root mean squares: about 3.
    #[must_use]
    pub fn crest(&self) -> f64 {
        self.crest
    }

    /// Frequency of the first harmonic, hertz.
    #[must_use]
    pub fn base_hz(&self) -> f64 {
        self.repeats / self.period
    }
}
