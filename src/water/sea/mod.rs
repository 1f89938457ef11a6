//! The waves of the wind, or of another simulator's frames, in two tiles that repeat over the water, and in time.
//!
//! [`SeaSurface`] holds the sea of one moment; [`SeaSurface::update`] moves it to any other, in any order, without
//! allocating. All kinds of sea come as the same two [`SeaTile`]s. It is a function of options, seed (or [`SeaFrames`]),
//! time and gain.

mod covariance;
pub(crate) mod fetch;
mod recorded;
mod resample;
mod spectrum;
mod spread;
mod synthesis;
mod tile;
mod waves;

use std::ops::{Add, AddAssign};

use glam::{DVec2, Vec2};

use crate::tour::{self, Wind};
use crate::wind::HIGHEST_WAVES;

pub use covariance::SlopeCovariance;
pub use recorded::{FRAME_SIDES, FrameError, SeaFrames};
pub use tile::{LEVELS, SeaTile};
pub use waves::Waves;

use recorded::Replay;
use synthesis::Synthesis;

use super::RoundError;

/// Texels along a tile's side.
pub const TEXELS: usize = 128;

/// The most waves across a tile: one every 3.2 texels.
const FINEST: i32 = 40;

/// Mean square slope beyond which a gale raises waves no further, since they would break.
const BREAKING: f64 = 0.04;

/// The water's surface at one place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WaveSample {
    /// Meters above the resting water.
    pub height: f32,
    /// ∂height/∂x and ∂height/∂z.
    pub slope: Vec2,
    /// How far the water that rests here is carried along x and z, meters.
    pub displacement: Vec2,
    /// Potential of the velocity at the surface, m²/s.
    pub potential: f32,
}

impl Add for WaveSample {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            height: self.height + other.height,
            slope: self.slope + other.slope,
            displacement: self.displacement + other.displacement,
            potential: self.potential + other.potential,
        }
    }
}

impl AddAssign for WaveSample {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

/// The sea at one moment.
///
/// Lengths and phases belong to the wind of the tour, and stay; a wind that changes makes the waves higher or lower
/// ([`gain`](Self::gain)) and [turns](Self::turn) them, without moving one. A recorded sea does not follow the wind. A sea
/// begins flat.
#[derive(Clone, Debug)]
pub struct SeaSurface {
    source: Source,
    tiles: [SeaTile; 2],
    gain: f64,
}

/// What fills the tiles.
#[derive(Clone, Debug)]
enum Source {
    Wind { waves: Waves, synthesis: Box<Synthesis>, nominal_speed: f64, steepest_gain: f64, turned: f64 },
    Recorded(Replay),
}

impl SeaSurface {
    /// The sea of a tour's options; `None` when there is none, or when it was [recorded](Self::recorded).
    ///
    /// Whatever the options leave open follows from the wind: `H_s = 0.4 · 1.6·10⁻³ U (F/g)^½` and
    /// `T_p = 0.286 U^⅓ F^⅓ g^(−⅔)` with a fetch F of 1 km (Hasselmann et al. 1973; the 0.4 stands for the shelter of an
    /// inland water). At 4 m/s that is 0.026 m and 0.99 s. A tour that starts without wind gets the waves of 4 m/s, to be
    /// raised when wind comes up.
    #[must_use]
    pub fn new<P>(options: &tour::Sea<P>, wind: &Wind) -> Option<Self> {
        let waves = match options {
            tour::Sea::Calm | tour::Sea::Recorded(_) => return None,
            tour::Sea::Octaves(octaves) => Waves::octaves(octaves, wind),
            tour::Sea::Jonswap(jonswap) => Waves::jonswap(jonswap, wind),
        };
        let tiles = [SeaTile::new(&waves, 0), SeaTile::new(&waves, 1)];
        let synthesis = Box::new(Synthesis::new(&waves));
        let nominal_speed = fetch::nominal_speed(wind);
        let steepest_gain = (BREAKING / waves.slope_covariance().total()).sqrt();
        let source = Source::Wind { waves, synthesis, nominal_speed, steepest_gain, turned: 0.0 };
        Some(Self { source, tiles, gain: 0.0 })
    }

    /// The sea of a simulator's frames, joined by straight lines in time; `None` when there is no frame.
    #[must_use]
    pub fn recorded(frames: SeaFrames) -> Option<Self> {
        let replay = Replay::new(frames)?;
        Some(Self { tiles: replay.tiles(), source: Source::Recorded(replay), gain: 0.0 })
    }

    /// Lets a recorded sea run so much faster or slower that a whole number of rounds takes `loop_seconds`; that of the
    /// wind repeats after its period anyhow.
    ///
    /// # Errors
    ///
    /// When it would have to run more than twice as fast.
    pub fn fit_rounds(&mut self, loop_seconds: f64) -> Result<(), RoundError> {
        match &mut self.source {
            Source::Wind { .. } => Ok(()),
            Source::Recorded(replay) => replay.fit(loop_seconds),
        }
    }

    /// How many times as high as tabulated the waves are in a wind of `wind_speed` m/s: 0 without wind, 1 in the
    /// tour's own, and in proportion between, as `H_s ∝ U` at a given fetch (Hasselmann et al. 1973), up to where
    /// waves break. Those of a recorded sea always are as high as recorded: 1.
    #[must_use]
    pub fn gain(&self, wind_speed: f64) -> f64 {
        match &self.source {
            Source::Wind { nominal_speed, .. } => self.sound_gain(wind_speed / nominal_speed),
            Source::Recorded(_) => 1.0,
        }
    }

    /// Lets the sea run `degrees` to the left (from +x towards −z) of where it runs in the tour's own wind, from the next
    /// [`update`](Self::update) on. It is a function of the angle alone: each wave keeps its length, its way and its phase
    /// and is only as high as a sea that runs so makes it; the significant height stays. A recorded sea does not turn; an
    /// angle that is no number is 0. Costs about an update where the angle is another, and allocates nothing.
    pub fn turn(&mut self, degrees: f64) {
        let whole = (degrees + 180.0).rem_euclid(360.0) - 180.0;
        let degrees = if whole.is_finite() { whole } else { 0.0 };
        if let Source::Wind { waves, synthesis, turned, .. } = &mut self.source
            && *turned != degrees
        {
            *turned = degrees;
            waves.turn(degrees);
            synthesis.take_amplitudes(waves);
            for (index, tile) in self.tiles.iter_mut().enumerate() {
                tile.tabulate_lost(waves, index);
            }
        }
    }

    /// Moves the sea to `seconds`, any time, with waves `gain` times as high as tabulated. A gain that is no number is 0, a
    /// time that is none is the start.
    pub fn update(&mut self, seconds: f64, gain: f64) {
        let was_flat = self.gain == 0.0;
        self.gain = self.sound_gain(gain);
        if self.gain > 0.0 {
            match &mut self.source {
                Source::Wind { waves, synthesis, .. } => {
                    let turn = (seconds / waves.period).rem_euclid(1.0);
                    let turn = if turn.is_nan() { 0.0 } else { turn };
                    synthesis.run(turn, self.gain as f32, &mut self.tiles);
                }
                Source::Recorded(replay) => replay.run(seconds, self.gain, &mut self.tiles[0]),
            }
        } else if !was_flat {
            self.tiles.iter_mut().for_each(SeaTile::flatten);
        }
    }

    /// The large and the small tile, which are to be added. A recorded sea has its frames in the first; the other is flat.
    #[must_use]
    pub fn tiles(&self) -> &[SeaTile; 2] {
        &self.tiles
    }

    /// The surface at (x, z) in meters, at the moment of the last [`update`](Self::update), interpolated in the tiles;
    /// still water where `xz` is not finite.
    #[must_use]
    pub fn sample(&self, xz: DVec2) -> WaveSample {
        if self.gain == 0.0 || !xz.is_finite() {
            return WaveSample::default();
        }
        self.tiles[0].sample(xz) + self.tiles[1].sample(xz)
    }

    /// The single waves of the wind; `None` of a recorded sea.
    #[must_use]
    pub fn waves(&self) -> Option<&Waves> {
        match &self.source {
            Source::Wind { waves, .. } => Some(waves),
            Source::Recorded(_) => None,
        }
    }

    /// The gain of the last [`update`](Self::update).
    #[must_use]
    pub fn present_gain(&self) -> f64 {
        self.gain
    }

    /// Covariance, at a gain of 1, of the slopes of waves too short for the tiles (of 5 cm and more, for a JONSWAP
    /// sea); grows with the gain's square. 0 of a recorded sea.
    #[must_use]
    pub fn hidden_covariance(&self) -> SlopeCovariance {
        self.waves().map_or(SlopeCovariance::default(), |waves| waves.hidden)
    }

    fn sound_gain(&self, gain: f64) -> f64 {
        let most = match &self.source {
            Source::Wind { steepest_gain, .. } => *steepest_gain,
            Source::Recorded(_) => HIGHEST_WAVES,
        };
        // A comparison with NaN is false.
        if gain > 0.0 { gain.min(most) } else { 0.0 }
    }
}

#[cfg(test)]
mod recorded_tests;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod turning_tests;
