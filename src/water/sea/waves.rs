//! The single waves of a sea: periodic in one of two square tiles, and in time.
//!
//! Wave vectors lie on the lattice of their tile and frequencies are multiples of 2π/T, so that tiles join without a
//! seam, everything repeats exactly after T, and a tile shows just what the sum of its waves is.
//!
//! A sea that turns changes amplitudes alone. Wave vectors, frequencies and phases stay, so that no crest jumps, and far
//! ones race no more than near ones.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use glam::{DVec2, IVec2};

use super::super::{GRAVITY, TENSION, angular_frequency};
use super::covariance::SlopeCovariance;
use super::fetch;
use super::spectrum::Spectrum;
use super::spread::{RAY_SPACING, Spread};
use super::tile::kept_by_mean;
use super::{FINEST, WaveSample};
use crate::random::Random;
use crate::tour::{Jonswap, Octaves, Wind};

/// Ratio of the tiles' sizes: the golden ratio's cube, so that the two never repeat together.
const RATIO: f64 = 4.236_067_977_499_79;

/// The rays of every octave, by their number from the tour's own direction: those that it shows, and those that come as it
/// turns. A circle is no whole number of them; the gap that is left lies opposite.
const RAYS: [RangeInclusive<i32>; 3] = [-2..=2, 3..=6, -7..=-3];

/// Amplitude of an octave over that of the one before.
const OCTAVE_GAIN: f64 = 0.55;

/// The shortest waves that roughen the water, meters: below it viscosity wins.
const SHORTEST: f64 = 0.05;

/// Directions into which the waves shorter than the tiles' are summed.
const SPOKES: u32 = 72;

/// A wave: amplitude · cos(k·x − ωt + phase).
#[derive(Clone, Copy, Debug)]
pub(super) struct Wave {
    /// Which of the two tiles it repeats in.
    pub(super) tile: usize,
    /// How many times it fits into that tile along x and along z.
    pub(super) cycles: IVec2,
    /// Unit vector (x, z) that it runs along, before that was rounded to the lattice.
    along: DVec2,
    /// Square of the amplitude where all energy ran this way, relative.
    energy: f64,
    /// Meters.
    pub(super) amplitude: f64,
    /// Radians.
    pub(super) phase: f64,
    /// How many times it swings in the sea's period.
    pub(super) harmonic: u32,
}

/// Waves too short for the tiles.
#[derive(Clone, Copy, Debug)]
struct ShortWaves {
    /// Rad/m, (x, z).
    wave_vector: DVec2,
    /// As a [`Wave`]'s.
    energy: f64,
}

/// All waves of a sea that the wind raises.
#[derive(Clone, Debug)]
pub struct Waves {
    /// Sides of the two tiles, meters.
    pub(super) sizes: [f64; 2],
    pub(super) waves: Vec<Wave>,
    short: Vec<ShortWaves>,
    spread: Spread,
    /// Where they run in the tour's own wind, degrees.
    direction_deg: f64,
    /// Significant height, meters.
    height: f64,
    /// What waves too short for the tiles add to the slopes.
    pub(super) hidden: SlopeCovariance,
    /// Seconds after which all repeats.
    pub(super) period: f64,
}

impl Waves {
    /// Octaves of sines, each a fan of waves around one direction (notes §7.1).
    pub(super) fn octaves(options: &Octaves, wind: &Wind) -> Self {
        let period = sound_period(wind);
        let (height, longest) = fetch::of_octaves(options, wind);
        let direction_deg = options.direction_deg.unwrap_or(wind.direction_deg);

        // Three octaves to a tile: 6, 12 and 24 waves across the large one, 5.7, 11.3 and 22.7 across the small one.
        let sizes = [6.0 * longest, 3.0 / RATIO * longest];
        let mut random = Random::new(wind.seed, 4);
        let (mut waves, mut short) = (Vec::new(), Vec::new());
        let octaves = |rays: RangeInclusive<i32>| {
            (0..options.octaves).flat_map(move |octave| rays.clone().map(move |ray| (octave, ray)))
        };
        for (octave, ray) in RAYS.into_iter().flat_map(octaves) {
            let wave_number = TAU / longest * f64::from(octave).exp2();
            let energy = OCTAVE_GAIN.powf(f64::from(octave)).powi(2);
            let angle = direction_deg.to_radians() + f64::from(ray) * RAY_SPACING.to_radians();
            let along = DVec2::new(angle.cos(), -angle.sin());
            let wave_vector = wave_number * along;
            let phase = random.angle();
            let tile = usize::from(octave >= 3);
            let cycles = (wave_vector * sizes[tile] / TAU).round().as_ivec2();
            if cycles.abs().max_element() > FINEST {
                short.push(ShortWaves { wave_vector, energy });
                continue;
            }
            let frequency = angular_frequency(lattice(sizes[tile], cycles).length(), f64::INFINITY);
            let harmonic = harmonic(options.speed_factor * frequency, period);
            // Only water that is to stand still does.
            let harmonic = if options.speed_factor > 0.0 { harmonic.max(1) } else { 0 };
            waves.push(Wave { tile, cycles, along, energy, amplitude: 0.0, phase, harmonic });
        }
        let (spread, hidden) = (Spread::Fan, SlopeCovariance::default());
        let mut waves = Self { sizes, waves, short, spread, direction_deg, height, hidden, period };
        waves.turn(0.0);
        waves
    }

    /// A sea with the JONSWAP spectrum in two bands: the small tile begins at the wave number where the large one ends.
    pub(super) fn jonswap(options: &Jonswap, wind: &Wind) -> Self {
        let period = sound_period(wind);
        let (height, peak_period) = fetch::of_jonswap(options, wind);
        let spectrum = Spectrum::new(peak_period, options.depth);
        let size = 12.0 * TAU / spectrum.peak_wave_number();
        let sizes = [size, size / RATIO];
        let bands = bands(sizes);

        let mut random = Random::new(wind.seed, 4);
        let mut waves = Vec::new();
        for tile in 0..2 {
            let cell = (TAU / sizes[tile]).powi(2);
            for z in -FINEST..=FINEST {
                for x in -FINEST..=FINEST {
                    let cycles = IVec2::new(x, z);
                    let wave_vector = lattice(sizes[tile], cycles);
                    let k = wave_vector.length();
                    let phase = random.angle();
                    if (bands[tile][0]..bands[tile][1]).contains(&k) {
                        // Phases are drawn and amplitudes are not, so that every seed has the same height.
                        let energy = 2.0 * cell * spectrum.over_wave_vectors(k);
                        let harmonic = harmonic(angular_frequency(k, options.depth), period).max(1);
                        let along = wave_vector / k;
                        waves.push(Wave { tile, cycles, along, energy, amplitude: 0.0, phase, harmonic });
                    }
                }
            }
        }
        let turn = TAU / f64::from(SPOKES);
        let energy = 2.0 * turn * spectrum.mean_square_slope(bands[1][1], TAU / SHORTEST);
        let short = (0..SPOKES).map(|spoke| {
            let wave_vector = DVec2::from_angle(turn * f64::from(spoke));
            ShortWaves { wave_vector, energy }
        });
        let spread = Spread::Cosine { exponent: options.spreading };
        let direction_deg = options.direction_deg.unwrap_or(wind.direction_deg);
        let (short, hidden) = (short.collect(), SlopeCovariance::default());
        let mut waves = Self { sizes, waves, short, spread, direction_deg, height, hidden, period };
        waves.turn(0.0);
        waves
    }

    /// Spreads the energy around a direction `degrees` to the left of that in the tour's own wind. The significant height
    /// is the same in all.
    pub(super) fn turn(&mut self, degrees: f64) {
        let direction = (self.direction_deg + degrees).to_radians();
        let ahead = DVec2::new(direction.cos(), -direction.sin());
        let spread = self.spread;
        let amplitude = |along: DVec2, energy: f64| (energy * spread.share(along.dot(ahead))).sqrt();
        for wave in &mut self.waves {
            wave.amplitude = amplitude(wave.along, wave.energy);
        }
        self.hidden = SlopeCovariance::default();
        for ShortWaves { wave_vector, energy } in &self.short {
            self.hidden.add_wave(*wave_vector, amplitude(wave_vector.normalize_or_zero(), *energy));
        }
        let present = self.significant_height();
        let factor = if present > 0.0 { self.height / present } else { 0.0 };
        for wave in &mut self.waves {
            wave.amplitude *= factor;
        }
        self.hidden *= factor * factor;
    }

    /// The surface at (x, z) and any time at a gain of 1, by the sum over all waves: a few microseconds for octaves, a
    /// tenth of a millisecond for a JONSWAP sea.
    #[must_use]
    pub fn exact(&self, xz: DVec2, seconds: f64) -> WaveSample {
        let turn = (seconds / self.period).rem_euclid(1.0);
        let (mut height, mut slope, mut displacement, mut potential) = (0.0, DVec2::ZERO, DVec2::ZERO, 0.0);
        for wave in &self.waves {
            let wave_vector = self.wave_vector(wave);
            let turned = (f64::from(wave.harmonic) * turn).fract();
            let (sine, cosine) = (wave_vector.dot(xz) - TAU * turned + wave.phase).sin_cos();
            height += wave.amplitude * cosine;
            slope -= wave.amplitude * sine * wave_vector;
            displacement -= wave.amplitude * sine * wave_vector.normalize_or_zero();
            potential += self.potential(wave) * wave.amplitude * sine;
        }
        WaveSample {
            height: height as f32,
            slope: slope.as_vec2(),
            displacement: displacement.as_vec2(),
            potential: potential as f32,
        }
    }

    /// Radians per meter along x and z.
    pub(super) fn wave_vector(&self, wave: &Wave) -> DVec2 {
        lattice(self.sizes[wave.tile], wave.cycles)
    }

    /// Potential at the surface of a wave per meter of its height, a quarter of a swing later, m/s: `φ_t = −(g + (σ/ρ)k²) η`.
    pub(super) fn potential(&self, wave: &Wave) -> f64 {
        let frequency = TAU * f64::from(wave.harmonic) / self.period;
        let pull = GRAVITY + TENSION * self.wave_vector(wave).length_squared();
        // Waves that stand still, as real ones cannot, move no water.
        if wave.harmonic > 0 { pull / frequency } else { 0.0 }
    }

    /// Seconds after which the sea repeats.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Four times the standard deviation of the height at a gain of 1, meters.
    #[must_use]
    pub fn significant_height(&self) -> f64 {
        4.0 * self.variance().sqrt()
    }

    /// Covariance of all slopes at a gain of 1, those of waves too short for the tiles included; grows with the gain's square.
    #[must_use]
    pub fn slope_covariance(&self) -> SlopeCovariance {
        self.unresolved_covariance(DVec2::INFINITY)
    }

    /// Covariance, at a gain of 1, of the slopes that vanish in the mean over a footprint of so many meters along x and
    /// z: what a pixel of that footprint must show as blur (notes §8.4). Includes waves too short for the tiles; grows
    /// with the gain's square. Sums over all waves: tabulate it, about 0.1 ms each.
    #[must_use]
    pub fn unresolved_covariance(&self, footprint: DVec2) -> SlopeCovariance {
        let mut covariance = self.hidden;
        for wave in &self.waves {
            let wave_vector = self.wave_vector(wave);
            let kept = kept_by_mean(wave_vector, footprint);
            let mut whole = SlopeCovariance::default();
            whole.add_wave(wave_vector, wave.amplitude);
            covariance += whole * (1.0 - kept * kept);
        }
        covariance
    }

    /// Mean square of the height, m².
    fn variance(&self) -> f64 {
        self.waves.iter().map(|wave| 0.5 * wave.amplitude * wave.amplitude).sum()
    }
}

/// Wave numbers that each tile of a continuous spectrum holds, rad/m: at least 3 waves across the large tile, at most
/// one every 5.3 texels; in the small one at most one every 3.2.
pub(super) fn bands(sizes: [f64; 2]) -> [[f64; 2]; 2] {
    let seam = 24.0 * TAU / sizes[0];
    [[2.999 * TAU / sizes[0], seam], [seam, f64::from(FINEST) * TAU / sizes[1]]]
}

/// The wave vector that fits `cycles` times into a tile of `size` meters.
fn lattice(size: f64, cycles: IVec2) -> DVec2 {
    TAU / size * cycles.as_dvec2()
}

/// How many times a wave of `frequency` rad/s swings in a loop, rounded.
fn harmonic(frequency: f64, period: f64) -> u32 {
    (frequency * period / TAU).round() as u32
}

/// The loop's length in seconds. A checked tour's is sound already.
fn sound_period(wind: &Wind) -> f64 {
    if wind.period_seconds.is_finite() { wind.period_seconds.clamp(1.0, 3600.0) } else { 20.0 }
}
