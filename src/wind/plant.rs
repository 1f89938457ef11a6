//! Plants in the wind: built once, then one [`SwayRecord`] a plant and frame, a function of time and wind alone.

use glam::{DVec2, Vec2, Vec4};

use super::gusts::Gusts;
use super::oscillator::{LoopedSignal, Oscillator};
use super::preset::{ModePreset, preset};
use super::spectrum::NOMINAL_SPEED;
use super::sway::{SwayMode, SwayRecord, mode_motion};
use super::{heading_of_degrees, sound_speed};
use crate::random::Random;
use crate::tour::{Sway, Wind};

/// Wind speed towards which the growth of the motion levels off, m/s.
const LEVELING_SPEED: f64 = 15.0;

/// How much of its motion a plant shows in a plane that the wind crosses at a right angle.
const ACROSS: f64 = 0.6;

/// Half the crown's width in plant lengths.
const CROWN: f64 = 0.25;

/// Most radians of phase along the wind per plant length: waves over reeds are at least six plants long.
const MOST_PHASE: f64 = 1.0;

/// Farthest that a plant may stand or reach, meters.
const FARTHEST: f64 = 1e6;

/// Wave number of the phase noise times the size of its cells.
const NOISE_WAVE: f64 = 1.2;

/// Where a plant stands. Points (a, b) are meters in its component's plane: to the right along it, and up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Where it is fixed (a, b).
    pub root: DVec2,
    /// Its far end (a, b), apart from the root.
    pub tip: DVec2,
    /// The root's place on the water or ground (x, z), meters.
    pub place: DVec2,
    /// Unit vector (x, z) along the component's plane, to its right.
    pub along: DVec2,
}

/// Why a plant cannot sway.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlantError {
    /// A point that is none.
    #[error("the plant stands at {0:?}, which is no place in the scene; give finite numbers, in meters")]
    NoPlace(Stand),
    /// Root and tip are (almost) the same point.
    #[error("root and tip are {0} m apart; mark the tip at the plant's far end")]
    TooShort(f64),
}

/// A motion of a plant with what it does at each place.
#[derive(Clone, Debug, PartialEq)]
struct Mode {
    signal: LoopedSignal,
    /// Root mean square of the tip's way at 5 m/s, meters.
    rms: f64,
    /// Steepness (m/m) per meter of the signal's root mean square, and the steepness it is held to.
    steepness: f64,
    steepest: f64,
    /// Phase per meter to the right when the wind blows that way, and per meter up; radians.
    phase: DVec2,
    noise: Vec4,
}

/// A plant that sways.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    stand: Stand,
    modes: [Option<Mode>; 3],
}

impl Plant {
    /// A plant of a kind at a place. Numbers that `sway` leaves out are those of its kind, the period is the wind's, and the
    /// seed `seed`; see [`seed_of_name`]. Numbers out of their ranges are brought into them.
    ///
    /// # Errors
    ///
    /// When a number of `stand` is not finite or beyond 1000 km, or root and tip are less than a millimeter apart.
    pub fn new(stand: Stand, sway: &Sway, wind: &Wind, seed: u64) -> Result<Self, PlantError> {
        let Stand { root, tip, place, along } = stand;
        if [root, tip, place, along].iter().any(|point| !point.is_finite() || point.length() > FARTHEST) {
            return Err(PlantError::NoPlace(stand));
        }
        let length = root.distance(tip);
        if length < 1e-3 {
            return Err(PlantError::TooShort(length));
        }
        let kind = preset(sway.kind);
        let frequency = number(sway.frequency_hz, kind.frequency_hz, 0.02, 10.0);
        let damping = number(sway.damping, kind.damping, 0.01, 1.0);
        let amplitude = number(sway.amplitude, kind.amplitude, 0.0, 0.2) * length;
        let period =
            number(sway.period_seconds, number(Some(wind.period_seconds), 20.0, 4.0, 120.0), 4.0, 120.0);
        let mut random = Random::new(sway.seed.unwrap_or(seed), 3);
        let shares = kind.modes.iter().map(|mode| mode.share * mode.share).sum::<f64>().sqrt();
        let mut modes: [Option<Mode>; 3] = std::array::from_fn(|i| {
            let mode = &kind.modes[i];
            let oscillator =
                Oscillator { frequency_hz: frequency * mode.frequency, damping: damping * mode.damping };
            let (seed, noise_seed) = (random.next(), random.angle());
            (mode.share > 0.0).then(|| {
                let signal = LoopedSignal::new(oscillator, period, seed);
                let rms = length * mode.share / shares;
                Mode::new(mode, i > 0, signal, rms, length, oscillator.frequency_hz, noise_seed)
            })
        });
        // Modes share harmonics, so their squares do not quite add: what is wanted holds at the tip, together.
        let together = tip_rms(modes.iter().flatten(), (tip - root).as_vec2(), period);
        for mode in modes.iter_mut().flatten() {
            mode.rms *= amplitude / together.max(f64::MIN_POSITIVE);
        }
        Ok(Self { stand, modes })
    }

    /// The plant at a time in a wind. Of the wind's numbers speed, direction and gusts count; `gusts` must be its gusts.
    #[must_use]
    pub fn record(&self, seconds: f64, wind: &Wind, gusts: &Gusts) -> SwayRecord {
        let heading = heading_of_degrees(wind.direction_deg);
        let Stand { root, tip, place, along } = self.stand;
        let in_plane = heading.dot(along).clamp(-1.0, 1.0);
        let seen = (in_plane * in_plane + ACROSS * ACROSS * (1.0 - in_plane * in_plane)).sqrt();
        let level = strength(wind.speed) * seen * gusts.at(seconds, place.dot(heading), wind.gusts);
        let mode = |mode: &Option<Mode>| {
            mode.as_ref().map_or_else(SwayMode::default, |mode| mode.at(seconds, level, in_plane))
        };
        let length = root.distance(tip);
        let axis = (tip - root) / length;
        SwayRecord {
            stem: Vec4::from((root.as_vec2(), axis.as_vec2())),
            size: Vec4::new(length as f32, (CROWN * length) as f32, f32::from(level > 0.0), 0.0),
            bending: mode(&self.modes[0]),
            branches: mode(&self.modes[1]),
            leaves: mode(&self.modes[2]),
        }
    }
}

impl Mode {
    fn new(
        preset: &ModePreset,
        crown: bool,
        signal: LoopedSignal,
        rms: f64,
        length: f64,
        frequency_hz: f64,
        noise_seed: f64,
    ) -> Self {
        // The wind brings the motion from place to place; short phase waves would tear the plant.
        let carried = std::f64::consts::TAU * frequency_hz / NOMINAL_SPEED * length / MOST_PHASE;
        let along = MOST_PHASE / length * carried / (1.0 + carried * carried).sqrt();
        let phase = DVec2::new(along, preset.lag / length);
        let wave_number = NOISE_WAVE / (preset.cell * length);
        // Greatest slope and value of the mode shapes of `SwayRecord::displacement`. The noise's two waves are
        // perpendicular, so their slopes add as such; and where shape and phase change, cosine and sine weigh the two.
        let (slope, most) = if crown { (3.0 / length, 1.5) } else { (4.0 / 3.0 / length, 1.0) };
        let turning = phase.length() + preset.disorder * wave_number * std::f64::consts::SQRT_2;
        let steepness = signal.crest() * slope.hypot(most * turning);
        let noise = Vec4::new(preset.disorder as f32, wave_number as f32, noise_seed as f32, 0.0);
        Self { signal, rms, steepness, steepest: preset.steepest, phase, noise }
    }

    /// The mode at a time, for a wind whose effect is `level` times that of 5 m/s.
    fn at(&self, seconds: f64, level: f64, in_plane: f64) -> SwayMode {
        self.of_size(seconds, held(level * self.rms, self.steepest / self.steepness), in_plane)
    }

    /// The mode at a time, for a root mean square of `rms` meters.
    fn of_size(&self, seconds: f64, rms: f64, in_plane: f64) -> SwayMode {
        let way = rms * self.signal.at(seconds);
        let phase = Vec2::new((self.phase.x * in_plane) as f32, self.phase.y as f32);
        SwayMode { motion: Vec4::from((way.as_vec2(), phase)), noise: self.noise }
    }
}

/// Root mean square of the way sideways of a tip at `from_root`, meters, of modes together.
fn tip_rms<'a>(modes: impl Iterator<Item = &'a Mode> + Clone, from_root: Vec2, period: f64) -> f64 {
    const SAMPLES: u32 = 1024;
    let squares: f64 = (0..SAMPLES)
        .map(|i| {
            let seconds = f64::from(i) / f64::from(SAMPLES) * period;
            let way: f32 = modes
                .clone()
                .map(|mode| mode_motion(&mode.of_size(seconds, mode.rms, 0.0), from_root).x)
                .sum();
            f64::from(way).powi(2)
        })
        .sum();
    (squares / f64::from(SAMPLES)).sqrt()
}

/// An amplitude held below a limit: as it is up to some 0.8 of it, then ever closer to it.
fn held(amplitude: f64, limit: f64) -> f64 {
    let sixteenth = (amplitude / limit).powi(16);
    amplitude / (1.0 + sixteenth).powf(1.0 / 16.0)
}

/// The plants of a tour and their records, which are overwritten in place.
#[derive(Clone, Debug, PartialEq)]
pub struct Plants {
    plants: Vec<Plant>,
    gusts: Gusts,
    records: Vec<SwayRecord>,
}

impl Plants {
    /// These plants at rest. Seed and period of `wind` make the gusts.
    #[must_use]
    pub fn new(plants: Vec<Plant>, wind: &Wind) -> Self {
        let gusts = Gusts::new(wind.seed, number(Some(wind.period_seconds), 20.0, 4.0, 120.0));
        let mut all = Self { plants: Vec::new(), gusts, records: Vec::new() };
        plants.into_iter().for_each(|plant| all.push(plant));
        all
    }

    /// One more, at rest.
    pub fn push(&mut self, plant: Plant) {
        self.records.push(plant.record(0.0, &Wind::default(), &self.gusts));
        self.plants.push(plant);
    }

    /// One less; those after it move up.
    ///
    /// # Panics
    ///
    /// Where there is no plant of this index.
    pub fn remove(&mut self, index: usize) {
        self.plants.remove(index);
        self.records.remove(index);
    }

    /// Moves the plants to a time in a wind and gives their records, in their order.
    pub fn update(&mut self, seconds: f64, wind: &Wind) -> &[SwayRecord] {
        for (record, plant) in self.records.iter_mut().zip(&self.plants) {
            *record = plant.record(seconds, wind, &self.gusts);
        }
        &self.records
    }

    /// The records of the last update.
    #[must_use]
    pub fn records(&self) -> &[SwayRecord] {
        &self.records
    }
}

/// How strongly a wind moves plants, compared with one of 5 m/s: exactly 0 in a calm, 1 at 5 m/s, 3 at 10, 9.4 at 60.
///
/// Drag grows with the square of the speed until leaves and branches give way and line up with the wind; written as
/// U² / (U² + 15²), which is smooth and bounded.
#[must_use]
pub fn strength(speed: f64) -> f64 {
    let drag = |speed: f64| speed * speed / (speed * speed + LEVELING_SPEED * LEVELING_SPEED);
    drag(sound_speed(speed)) / drag(NOMINAL_SPEED)
}

/// The seed of something named, for a wind's seed: other for every name (FNV-1a, then splitmix64).
#[must_use]
pub fn seed_of_name(name: &str, wind_seed: u64) -> u64 {
    let hash = name.bytes().fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3)
    });
    Random::new(hash, wind_seed).next()
}

/// A number within its range, or the one to use where there is none.
fn number(value: Option<f64>, otherwise: f64, low: f64, high: f64) -> f64 {
    value.filter(|value| !value.is_nan()).map_or(otherwise, |value| value.clamp(low, high))
}
