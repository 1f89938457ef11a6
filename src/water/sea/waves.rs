//! The single waves of a sea: periodic in one of two square tiles, and in time.
//!
//! Wave vectors lie on the lattice of their tile and frequencies are multiples of 2π/T, so that tiles join without a
//! seam, everything repeats exactly after T, and a tile shows just what the sum of its waves is.

use std::f64::consts::TAU;

use glam::{DVec2, IVec2};

use super::super::{GRAVITY, TENSION, angular_frequency};
use super::covariance::SlopeCovariance;
use super::fetch;
use super::spectrum::Spectrum;
use super::tile::kept_by_mean;
use super::{FINEST, WaveSample};
use crate::tour::{Jonswap, Octaves, Wind};
use crate::wind::Random;

/// Ratio of the tiles' sizes: the golden ratio's cube, so that the two never repeat together.
const RATIO: f64 = 4.236_067_977_499_79;

/// Waves of every octave, and how far the outermost run from the wind, degrees.
const FAN: usize = 5;
const FAN_HALF_ANGLE: f64 = 50.0;

/// Amplitude of an octave over that of the one before.
const OCTAVE_GAIN: f64 = 0.55;

/// The shortest waves that roughen the water, meters: below it viscosity wins.
const SHORTEST: f64 = 0.05;

/// A wave: amplitude · cos(k·x − ωt + phase).
#[derive(Clone, Copy, Debug)]
pub(super) struct Wave {
    /// Which of the two tiles it repeats in.
    pub(super) tile: usize,
    /// How many times it fits into that tile along x and along z.
    pub(super) cycles: IVec2,
    /// Meters.
    pub(super) amplitude: f64,
    /// Radians.
    pub(super) phase: f64,
    /// How many times it swings in the sea's period.
    pub(super) harmonic: u32,
}

/// All waves of a sea that the wind raises.
#[derive(Clone, Debug)]
pub struct Waves {
    /// Sides of the two tiles, meters.
    pub(super) sizes: [f64; 2],
    pub(super) waves: Vec<Wave>,
    /// What waves too short for the tiles add to the slopes.
    pub(super) hidden: SlopeCovariance,
    /// Seconds after which all repeats.
    pub(super) period: f64,
}

impl Waves {
    /// Octaves of sines, each a fan of waves around one direction (notes §7.1).
    pub(super) fn octaves(options: &Octaves, wind: &Wind) -> Self {
        let period = sound_period(wind);
        // A wavelength given alone fits the height to it, as a peak period does.
        let given = options.wavelength.map(|length| TAU / angular_frequency(TAU / length, f64::INFINITY));
        let speed = fetch::nominal_speed(wind);
        let (height, peak_period) = fetch::height_and_period(speed, options.max_height, given, f64::INFINITY);
        let longest =
            options.wavelength.unwrap_or_else(|| TAU / fetch::wave_number(TAU / peak_period, f64::INFINITY));
        let direction = options.direction_deg.unwrap_or(wind.direction_deg).to_radians();

        // Three octaves to a tile: 6, 12 and 24 waves across the large one, 5.7, 11.3 and 22.7 across the small one.
        let sizes = [6.0 * longest, 3.0 / RATIO * longest];
        let mut random = Random::new(wind.seed, 4);
        let mut drawn = Vec::new();
        let mut hidden = SlopeCovariance::default();
        for octave in 0..options.octaves {
            let wave_number = TAU / longest * f64::from(octave).exp2();
            let amplitude = OCTAVE_GAIN.powf(f64::from(octave));
            for ray in 0..FAN {
                let share = 2.0 * ray as f64 / (FAN - 1) as f64 - 1.0;
                let angle = direction + share * FAN_HALF_ANGLE.to_radians();
                let wave_vector = wave_number * DVec2::new(angle.cos(), -angle.sin());
                let phase = random.angle();
                let tile = usize::from(octave >= 3);
                let cycles = (wave_vector * sizes[tile] / TAU).round().as_ivec2();
                if cycles.abs().max_element() > FINEST {
                    hidden.add_wave(wave_vector, amplitude);
                    continue;
                }
                let frequency = angular_frequency(lattice(sizes[tile], cycles).length(), f64::INFINITY);
                let harmonic = harmonic(options.speed_factor * frequency, period);
                // Only water that is to stand still does.
                let harmonic = if options.speed_factor > 0.0 { harmonic.max(1) } else { 0 };
                drawn.push(Wave { tile, cycles, amplitude, phase, harmonic });
            }
        }
        Self { sizes, waves: drawn, hidden, period }.scaled_to(height)
    }

    /// A sea with the JONSWAP spectrum in two bands: the small tile begins at the wave number where the large one ends.
    pub(super) fn jonswap(options: &Jonswap, wind: &Wind) -> Self {
        let period = sound_period(wind);
        let (height, peak_period) = fetch::height_and_period(
            fetch::nominal_speed(wind),
            options.max_height,
            options.peak_period_seconds,
            options.depth,
        );
        let direction = options.direction_deg.unwrap_or(wind.direction_deg).to_radians();
        let along = DVec2::new(direction.cos(), -direction.sin());
        let spectrum = Spectrum::new(peak_period, options.depth, options.spreading, along);
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
                    let phase = random.angle();
                    if (bands[tile][0]..bands[tile][1]).contains(&wave_vector.length()) {
                        // Phases are drawn and amplitudes are not, so that every seed has the same height.
                        let amplitude = (2.0 * cell * spectrum.over_wave_vectors(wave_vector)).sqrt();
                        let frequency = angular_frequency(wave_vector.length(), options.depth);
                        let harmonic = harmonic(frequency, period).max(1);
                        waves.push(Wave { tile, cycles, amplitude, phase, harmonic });
                    }
                }
            }
        }
        let mut hidden = SlopeCovariance::default();
        spectrum.integral(bands[1][1], TAU / SHORTEST, |wave_vector, variance| {
            hidden.add_wave(wave_vector, (2.0 * variance).sqrt());
        });
        Self { sizes, waves, hidden, period }.scaled_to(height)
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

    /// The same waves, all as much higher as makes the significant height `height` meters.
    fn scaled_to(mut self, height: f64) -> Self {
        let present = self.significant_height();
        let factor = if present > 0.0 { height / present } else { 0.0 };
        for wave in &mut self.waves {
            wave.amplitude *= factor;
        }
        self.hidden *= factor * factor;
        self
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
