//! What cells are compared by at full size: color and how busy the picture is around them.
//!
//! Texture keeps fine grain from being replaced by flat color, which differs little from it in the mean.

use rayon::prelude::*;

use super::Cell;
use super::code_from_linear;
use super::patch::{Feature, STEPS};

/// Cells from the center to the rim of the square over which slopes are averaged.
const REACH: usize = 8;

/// Weight of lightness, as (r + 2g + b) / 4.
const LUMA: f32 = 1.2;

/// Weight of r − g and b − g: another light on the same matter changes them less than another matter does.
const CHROMA: f32 = 1.7;

/// Weight of slopes.
const WEIGHT: f32 = 3.0;

/// Features of all cells; holes and foreign cells have zero.
pub(super) fn features(width: usize, colors: &[[f32; 3]], cells: &[Cell]) -> Vec<Feature> {
    let mut features: Vec<Feature> = (0..cells.len())
        .into_par_iter()
        .with_min_len(4096)
        .map(|at| {
            let mut feature = [0; 8];
            if cells[at] == Cell::Source {
                let [r, g, b] = colors[at].map(|value| STEPS * code_from_linear(value));
                let compared = [LUMA * (r + 2.0 * g + b) / 4.0, CHROMA * (r - g), CHROMA * (b - g)];
                for (feature, value) in feature.iter_mut().zip(compared) {
                    *feature = value.round() as i16;
                }
            }
            feature
        })
        .collect();
    let sums = row_sums(width, cells, &features);
    let height = cells.len() / width;
    features.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        for (x, feature) in row.iter_mut().enumerate() {
            if cells[y * width + x] == Cell::Source {
                let mut sum = [0_u32; 3];
                for from in y.saturating_sub(REACH)..(y + REACH + 1).min(height) {
                    for (sum, part) in sum.iter_mut().zip(sums[from * width + x]) {
                        *sum += u32::from(part);
                    }
                }
                for (feature, slopes) in feature[3..].iter_mut().zip([sum[0], sum[1]]) {
                    let mean = slopes as f32 / sum[2].max(1) as f32;
                    *feature = (WEIGHT * mean).round().min(255.0 * STEPS) as i16;
                }
            }
        }
    });
    features
}

/// Sums of the slopes to the right, of those downward, and their number, over each cell's part of its row.
fn row_sums(width: usize, cells: &[Cell], features: &[Feature]) -> Vec<[u16; 3]> {
    let slopes = |cell: usize| {
        let (right, below) = (cell + 1, cell + width);
        let known = |cell: usize| cells.get(cell) == Some(&Cell::Source);
        if right % width == 0 || !known(cell) || !known(right) || !known(below) {
            return [0; 3];
        }
        let luma = |cell: usize| features[cell][0];
        [luma(cell).abs_diff(luma(right)), luma(cell).abs_diff(luma(below)), 1]
    };
    let mut sums = vec![[0; 3]; cells.len()];
    sums.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        let slopes: Vec<[u16; 3]> = (0..width).map(|x| slopes(y * width + x)).collect();
        for (x, sum) in row.iter_mut().enumerate() {
            for slope in &slopes[x.saturating_sub(REACH)..(x + REACH + 1).min(width)] {
                for (sum, slope) in sum.iter_mut().zip(slope) {
                    *sum += slope;
                }
            }
        }
    });
    sums
}
