//! A sea of height fields that another simulator made, in the large tile alone.
//!
//! Whatever its frames measure, a tile has 128 × 128 texels of them. Slopes are those of i·k·H, never differences of
//! heights; the potential is that of linear waves on deep water, of which heights grow by |k|·φ (notes §7.1).

use std::ops::RangeInclusive;
use std::sync::Arc;

use glam::{DVec2, UVec2};
use rustfft::FftDirection;
use rustfft::num_complex::Complex32;

use super::super::fft::SquareFft;
use super::super::rounds::{RoundError, haste_of_recording};
use super::TEXELS;
use super::resample::{close_seams, resampled};
use super::tile::SeaTile;
use crate::tour::MOST_FRAMES;

/// Pixels that a frame may have on a side.
pub const FRAME_SIDES: RangeInclusive<u32> = 8..=4096;

/// Why a frame cannot be taken.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FrameError {
    /// There are enough.
    #[error("a recorded sea holds {MOST_FRAMES} frames at most; leave some out, or record a shorter loop")]
    TooMany,
    /// It has other pixels than the first.
    #[error(
        "the frame is {} x {} pixels, the first one is {} x {}; write all frames in one size",
        found.x, found.y, first.x, first.y
    )]
    OtherSize {
        /// Its width and height.
        found: UVec2,
        /// Those of the first frame.
        first: UVec2,
    },
    /// Its sides are out of [`FRAME_SIDES`], or it has another number of heights.
    #[error("{count} heights do not fill a frame of {} x {} pixels, each side 8 to 4096", size.x, size.y)]
    Size {
        /// Its width and height.
        size: UVec2,
        /// How many heights came.
        count: usize,
    },
    /// A height that is none, or absurd.
    #[error("a height of the frame is {0} m; write finite heights below 10 km")]
    NoHeight(f32),
}

/// The frames of a recorded sea; a clone shares them.
///
/// A frame is a map of the water before the picture's camera: its lower edge lies at z = 0, its upper one `area.y` meters
/// farther (towards −z), its middle at x = 0. It repeats beyond. Where opposite edges do not fit together, an eighth of the
/// side along each bends towards the other.
#[derive(Clone, Debug, PartialEq)]
pub struct SeaFrames {
    area: DVec2,
    frames_per_second: f64,
    size: UVec2,
    /// Meters above the resting water at a tile's texels.
    heights: Vec<Arc<[f32]>>,
}

impl SeaFrames {
    /// No frames yet, of water of `area` meters along x and z. Numbers that are none are 1; all are brought above 0.
    #[must_use]
    pub fn new(area: DVec2, frames_per_second: f64) -> Self {
        let sound = |number: f64, most: f64| if number.is_finite() { number.clamp(1e-3, most) } else { 1.0 };
        Self {
            area: DVec2::new(sound(area.x, 1e6), sound(area.y, 1e6)),
            frames_per_second: sound(frames_per_second, 1e4),
            size: UVec2::ZERO,
            heights: Vec::new(),
        }
    }

    /// Takes the next frame: heights in meters above the resting water, in rows from the far edge, each from the left.
    ///
    /// # Errors
    ///
    /// When there are enough already, or the frame has another size than the first, sides out of [`FRAME_SIDES`], or
    /// numbers that are no heights.
    pub fn push(&mut self, size: UVec2, mut heights: Vec<f32>) -> Result<(), FrameError> {
        if self.heights.len() >= MOST_FRAMES as usize {
            return Err(FrameError::TooMany);
        }
        let is_sound = FRAME_SIDES.contains(&size.x) && FRAME_SIDES.contains(&size.y);
        if !is_sound || heights.len() != size.x as usize * size.y as usize {
            return Err(FrameError::Size { size, count: heights.len() });
        }
        if !self.heights.is_empty() && size != self.size {
            return Err(FrameError::OtherSize { found: size, first: self.size });
        }
        let is_height = |height: &f32| height.is_finite() && height.abs() < 1e4;
        if let Some(height) = heights.iter().find(|&height| !is_height(height)) {
            return Err(FrameError::NoHeight(*height));
        }
        let [width, height] = size.to_array().map(|side| side as usize);
        close_seams(width, height, &mut heights);
        // The tile's first column lies at x = 0, the middle of the frame; its first row at z = 0, the frame's edge.
        self.heights.push(resampled(width, height, &heights, [0.5, 0.0]).into());
        self.size = size;
        Ok(())
    }

    /// How many frames there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.heights.len()
    }

    /// Seconds after which they start over.
    #[must_use]
    pub fn round_seconds(&self) -> f64 {
        self.heights.len() as f64 / self.frames_per_second
    }
}

/// Frames that run.
#[derive(Clone, Debug)]
pub(super) struct Replay {
    frames: SeaFrames,
    /// How much faster time runs than it should, to fit a loop.
    haste: f64,
    forward: SquareFft,
    inverse: SquareFft,
    /// Heights, and how fast they grow.
    heights: Vec<Complex32>,
    /// Their spectra; then the slopes.
    spectra: Vec<Complex32>,
    potentials: Vec<Complex32>,
    room: Vec<Complex32>,
}

impl Replay {
    /// At least one frame; `None` for none.
    pub(super) fn new(frames: SeaFrames) -> Option<Self> {
        let empty = vec![Complex32::ZERO; TEXELS * TEXELS];
        (frames.count() > 0).then(|| Self {
            frames,
            haste: 1.0,
            forward: SquareFft::new(TEXELS, FftDirection::Forward),
            inverse: SquareFft::new(TEXELS, FftDirection::Inverse),
            heights: empty.clone(),
            spectra: empty.clone(),
            potentials: empty.clone(),
            room: empty,
        })
    }

    /// The tiles that it shows itself in: the frames, and nothing.
    pub(super) fn tiles(&self) -> [SeaTile; 2] {
        [SeaTile::flat(self.frames.area), SeaTile::flat(self.frames.area)]
    }

    /// Runs so fast that whole rounds fit a loop.
    pub(super) fn fit(&mut self, loop_seconds: f64) -> Result<(), RoundError> {
        // One frame stands still in any loop.
        if self.frames.count() > 1 {
            self.haste = haste_of_recording(self.frames.round_seconds(), loop_seconds)?;
        }
        Ok(())
    }

    /// Fills the tile with the sea at any time, heights `gain` times.
    pub(super) fn run(&mut self, seconds: f64, gain: f64, tile: &mut SeaTile) {
        let rate = self.frames.frames_per_second * self.haste;
        // Reduced by the round itself, so that loops close to the bit.
        let round = self.frames.count() as f64 / rate;
        let place = if seconds.is_finite() { seconds.rem_euclid(round) * rate } else { 0.0 };
        let index = (place as usize).min(self.frames.count() - 1);
        let share = (place - index as f64) as f32;
        let [from, to] = [index, (index + 1) % self.frames.count()].map(|index| &self.frames.heights[index]);
        let (gain32, growth) = (gain as f32, (gain * rate) as f32);
        for (cell, (from, to)) in self.heights.iter_mut().zip(from.iter().zip(to.iter())) {
            let step = to - from;
            *cell = Complex32::new(gain32 * (from + share * step), growth * step);
        }
        self.room.copy_from_slice(&self.heights);
        self.forward.process(&mut self.room, &mut self.spectra);
        self.fill_slopes(tile.size());
        self.inverse.process(&mut self.room, &mut self.spectra);
        self.inverse.process(&mut self.potentials, &mut self.room);
        let fields = self.heights.iter().zip(&self.spectra).zip(&self.room);
        tile.refill(
            fields.map(|((height, slope), potential)| {
                ([height.re, slope.re, slope.im, potential.re], [0.0; 2])
            }),
        );
        tile.measure_lost(gain);
    }

    /// Turns the spectrum of heights + i·growth into that of the slopes along x + i·along z, and that of the potential.
    fn fill_slopes(&mut self, size: DVec2) {
        let unit = std::f64::consts::TAU / size;
        let half = TEXELS / 2;
        let factor = 1.0 / (TEXELS * TEXELS) as f32;
        let number = |place: usize| if place > half { place as f64 - TEXELS as f64 } else { place as f64 };
        // The finest wave has no slope at the texels.
        let slope_number = |place: usize| if place == half { 0.0 } else { number(place) };
        for x in 0..TEXELS {
            for z in 0..TEXELS {
                let place = x * TEXELS + z;
                let opposite = (TEXELS - x) % TEXELS * TEXELS + (TEXELS - z) % TEXELS;
                let (here, there) = (self.spectra[place], self.spectra[opposite].conj());
                let height = (here + there) * (0.5 * factor);
                let growth = (here - there) * Complex32::new(0.0, -0.5 * factor);
                let [kx, kz] =
                    [unit.x * slope_number(x), unit.y * slope_number(z)].map(|number| number as f32);
                self.room[place] = height * Complex32::new(-kz, kx);
                let length = DVec2::new(unit.x * number(x), unit.y * number(z)).length() as f32;
                self.potentials[place] = if length > 0.0 { growth / length } else { Complex32::ZERO };
            }
        }
    }
}
