//! Patches of 7 × 7 cells and how much two of them differ.
//!
//! A cell is compared by five numbers in one row of eight, so that the inner loop is one vector operation per
//! cell.

use super::level::Level;

/// Cells from a patch's center to its rim.
pub(super) const RADIUS: usize = 3;

/// Cells along a patch's side.
pub(super) const SIDE: usize = 2 * RADIUS + 1;

/// Steps per 8-bit code in a [`Feature`]: flat gradients must not become terraces.
pub(super) const STEPS: f32 = 4.0;

/// Numbers that are compared: three of color and two of texture.
pub(super) const COMPARED: usize = 5;

/// The place of [`STRANGE`].
pub(super) const STRANGENESS: usize = COMPARED;

/// Tells foreign cells from all others, so that none is taken where a target has something to compare.
pub(super) const STRANGE: i16 = 4000;

/// What a cell is compared by: color and texture, in [`STEPS`] per 8-bit code.
pub(super) type Feature = [i16; 8];

/// A patch around a cell to fill, held against many source patches.
pub(super) struct Patch {
    values: [[Feature; SIDE]; SIDE],
    /// All bits where a cell counts, none where it does not.
    masks: [[Feature; SIDE]; SIDE],
    /// Squared 8-bit codes per unit of the sum, as if all cells had counted.
    scale: f32,
}

impl Patch {
    /// The patch around `center`, an inner cell, of which only what `counts` accepts is compared.
    pub(super) fn new(level: &Level, center: usize, counts: impl Fn(usize) -> bool) -> Self {
        let mut values = [[[0; 8]; SIDE]; SIDE];
        let mut masks = [[[0; 8]; SIDE]; SIDE];
        let mut counted = 0;
        for (j, (values, masks)) in values.iter_mut().zip(&mut masks).enumerate() {
            let start = center + j * level.width - RADIUS * (level.width + 1);
            for (i, (value, mask)) in values.iter_mut().zip(masks).enumerate() {
                if counts(start + i) {
                    *value = level.features[start + i];
                    *mask = [-1; 8];
                    counted += 1;
                }
            }
        }
        let whole = (SIDE * SIDE) as f32;
        Self { values, masks, scale: whole / counted.max(1) as f32 / (STEPS * STEPS) }
    }

    /// Sum of squared differences to the patch around `source`, in 8-bit codes; infinite once it reaches
    /// `limit`.
    ///
    /// A foreign cell in the source patch where a cell counts makes it worse than any that has none.
    pub(super) fn difference(&self, level: &Level, source: usize, limit: f32) -> f32 {
        // Within i32: the largest differences in all of 49 cells sum up to 1.4e9.
        let limit = (limit / self.scale) as i32;
        let mut sum = 0;
        let mut start = source - RADIUS * level.width - RADIUS;
        for (values, masks) in self.values.iter().zip(&self.masks) {
            let row = level.features[start..start + SIDE].as_flattened();
            for ((a, b), mask) in values.as_flattened().iter().zip(row).zip(masks.as_flattened()) {
                let difference = i32::from(a.wrapping_sub(*b) & mask);
                sum += difference * difference;
            }
            if sum > limit {
                return f32::INFINITY;
            }
            start += level.width;
        }
        sum as f32 * self.scale
    }
}
