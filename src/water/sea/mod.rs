//! The waves of the wind: a sea of many waves in two tiles that repeat over the water, and in time.
//!
//! [`SeaSurface`] holds the sea of one moment; [`SeaSurface::update`] moves it to any other, in any order, without
//! allocating. All kinds of sea come as the same two [`SeaTile`]s. It is a function of options, seed, time and gain.

mod covariance;
mod fetch;
mod spectrum;
mod synthesis;
mod tile;
mod waves;

use std::ops::{Add, AddAssign};

use glam::{DVec2, Vec2};

use crate::tour::{self, Wind};

pub use covariance::SlopeCovariance;
pub use tile::{LEVELS, SeaTile};

use synthesis::Synthesis;
use tile::kept_by_mean;
use waves::Waves;

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

/// The waves of the wind at one moment.
///
/// Shape and phases belong to the wind of the tour, and stay; a wind that changes makes the waves higher or lower
/// ([`gain`](Self::gain)) without moving them. A sea begins flat.
#[derive(Clone, Debug)]
pub struct SeaSurface {
    waves: Waves,
    synthesis: Synthesis,
    tiles: [SeaTile; 2],
    nominal_speed: f64,
    steepest_gain: f64,
    gain: f64,
}

impl SeaSurface {
    /// The sea of a tour's options; `None` when there is none, or when it was recorded.
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
        let synthesis = Synthesis::new(&waves);
        let nominal_speed = fetch::nominal_speed(wind);
        let mut sea =
            Self { waves, synthesis, tiles, nominal_speed, steepest_gain: f64::INFINITY, gain: 0.0 };
        sea.steepest_gain = (BREAKING / sea.slope_covariance().total()).sqrt();
        Some(sea)
    }

    /// How many times as high as tabulated the waves are in a wind of `wind_speed` m/s: 0 without wind, 1 in the
    /// tour's own, and in proportion between, as `H_s ∝ U` at a given fetch (Hasselmann et al. 1973), up to where
    /// waves break.
    #[must_use]
    pub fn gain(&self, wind_speed: f64) -> f64 {
        self.sound_gain(wind_speed / self.nominal_speed)
    }

    /// Moves the sea to `seconds`, any time, with waves `gain` times as high as tabulated. A gain that is no number is 0, a
    /// time that is none is the start.
    pub fn update(&mut self, seconds: f64, gain: f64) {
        let was_flat = self.gain == 0.0;
        self.gain = self.sound_gain(gain);
        if self.gain > 0.0 {
            let turn = (seconds / self.waves.period).rem_euclid(1.0);
            let turn = if turn.is_nan() { 0.0 } else { turn };
            self.synthesis.run(turn, self.gain as f32, &mut self.tiles);
        } else if !was_flat {
            self.tiles.iter_mut().for_each(SeaTile::flatten);
        }
    }

    /// The large and the small tile, which are to be added.
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

    /// The surface at (x, z) and any time at a gain of 1, by the sum over all waves: a few microseconds for octaves, a
    /// tenth of a millisecond for a JONSWAP sea.
    #[must_use]
    pub fn exact(&self, xz: DVec2, seconds: f64) -> WaveSample {
        self.waves.sum(xz, seconds)
    }

    /// Seconds after which the sea repeats.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.waves.period
    }

    /// The gain of the last [`update`](Self::update).
    #[must_use]
    pub fn present_gain(&self) -> f64 {
        self.gain
    }

    /// Four times the standard deviation of the height at a gain of 1, meters.
    #[must_use]
    pub fn significant_height(&self) -> f64 {
        4.0 * self.waves.variance().sqrt()
    }

    /// Covariance of all slopes at a gain of 1, those of waves too short for the tiles included; grows with the gain's square.
    #[must_use]
    pub fn slope_covariance(&self) -> SlopeCovariance {
        self.unresolved_covariance(DVec2::INFINITY)
    }

    /// Covariance, at a gain of 1, of the slopes of waves too short for the tiles (of 5 cm and more, for a JONSWAP
    /// sea); grows with the gain's square.
    #[must_use]
    pub fn hidden_covariance(&self) -> SlopeCovariance {
        self.waves.hidden
    }

    /// Covariance, at a gain of 1, of the slopes that vanish in the mean over a footprint of so many meters along x and
    /// z: what a pixel of that footprint must show as blur (notes §8.4). Includes waves too short for the tiles; grows
    /// with the gain's square. Sums over all waves: tabulate it, about 0.1 ms each.
    #[must_use]
    pub fn unresolved_covariance(&self, footprint: DVec2) -> SlopeCovariance {
        let mut covariance = self.waves.hidden;
        for wave in &self.waves.waves {
            let wave_vector = self.waves.wave_vector(wave);
            let kept = kept_by_mean(wave_vector, footprint);
            let mut whole = SlopeCovariance::default();
            whole.add_wave(wave_vector, wave.amplitude);
            covariance += whole * (1.0 - kept * kept);
        }
        covariance
    }

    fn sound_gain(&self, gain: f64) -> f64 {
        // A comparison with NaN is false.
        if gain > 0.0 { gain.min(self.steepest_gain) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests;
