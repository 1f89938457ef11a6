//! What a source costs besides its difference: coming from another height, and being copied again and again.
//!
//! Prices are in squared 8-bit codes per patch, as differences are.

use super::level::Level;
use super::patch::{RADIUS, STEPS};

/// A row with less than this share of the fullest row's sources has none worth speaking of.
const SCARCE: f32 = 0.1;

/// How far patches for rows beyond all sources may come from for free, as a share of how far beyond those
/// are.
///
/// Less than 1, so that the nearest rows of sources are what such rows are filled from: skies and waters
/// change slowly.
const SLACK: f32 = 0.5;

/// Price of each further use of a source that has something to recognize.
const REPETITION: f32 = 1000.0;

/// More uses than this cost no more.
const MOST_USES: u16 = 16;

/// Sum of color differences across a patch, in 8-bit codes, from which on it is recognized wherever it is
/// copied to.
const RECOGNIZED: f32 = 80.0;

impl Level {
    /// The price of a source for a target in `row` when others copy that source already.
    pub(super) fn price(&self, row: usize, source: usize, others: u16) -> f32 {
        self.row_cost(row, source / self.width) + self.repetition_cost(source, others)
    }

    /// Pictures of land and water are stratified: what belongs at a height is found at that height.
    fn row_cost(&self, row: usize, source_row: usize) -> f32 {
        let far = (row.abs_diff(source_row) as f32 - self.slack[row]).max(0.0);
        self.row_price * far * far
    }

    /// Stamps show, unless they are flat.
    fn repetition_cost(&self, source: usize, others: u16) -> f32 {
        if others == 0 {
            return 0.0;
        }
        let across = |step: usize| {
            let (a, b) = (&self.features[source - step], &self.features[source + step]);
            (0..3).map(|channel| a[channel].abs_diff(b[channel])).sum::<u16>()
        };
        let contrast = f32::from(across(RADIUS) + across(RADIUS * self.width)) / STEPS;
        REPETITION * f32::from(others.min(MOST_USES)) * (contrast / RECOGNIZED).min(1.0)
    }
}

/// Each row's distance to a row that has sources, times [`SLACK`]; `row_starts` are the rows' first sources.
pub(super) fn slack(row_starts: &[u32]) -> Vec<f32> {
    let counts: Vec<f32> = row_starts.windows(2).map(|pair| (pair[1] - pair[0]) as f32).collect();
    let fullest = counts.iter().copied().fold(0.0, f32::max);
    let mut slack = vec![f32::INFINITY; counts.len()];
    let mut gap = f32::INFINITY;
    for row in (0..counts.len()).chain((0..counts.len()).rev()) {
        gap = if counts[row] > SCARCE * fullest { 0.0 } else { gap + SLACK };
        slack[row] = slack[row].min(gap);
    }
    slack
}
