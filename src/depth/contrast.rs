//! Local contrast: what is left of brightness when gain and offset of the water are taken out.
//!
//! Two kinds, which fail in different places. Against its surroundings a pixel keeps all texture, but beside a strong
//! edge it carries the edge along; against what is like it in its surroundings (bilateral background subtraction,
//! Hirschmüller & Scharstein 2009) edges stay where they are, but coarse texture fades.

use rayon::prelude::*;

use super::plane::box_sum;
use super::view::{Kind, NOISE, View};

/// Half side of a pixel's surroundings.
const RADIUS: usize = 5;
/// Brightness this far off, in codes, is not like the pixel's.
const LIKENESS: f32 = 20.0;
/// What is left against its like is smaller; this makes both kinds count alike.
const AGAINST_LIKE: f32 = 1.5;

/// Contrasts of both kinds.
#[derive(Clone, Debug)]
pub(super) struct Contrasts {
    /// Of what is seen directly, row by row; 0 elsewhere.
    pub(super) direct: [Vec<f32>; 2],
    /// Of the water, column by column; 0 elsewhere.
    pub(super) water: [Vec<f32>; 2],
    /// 1 for water, else 0; column by column.
    pub(super) is_water: Vec<f32>,
}

impl Contrasts {
    pub(super) fn of(view: &View) -> Self {
        let by_column = |values: Vec<f32>| -> Vec<f32> {
            let (width, height) = (view.width, view.height);
            (0..values.len()).map(|i| values[i % height * width + i / height]).collect()
        };
        Self {
            direct: contrasts(view, Kind::Direct),
            water: contrasts(view, Kind::Water).map(by_column),
            is_water: by_column(view.weights(Kind::Water)),
        }
    }

    /// The contrast of the water where a pixel's mirror image stands for a shift, linear between rows; `None` where that
    /// is not water, or there is no shift.
    pub(super) fn water_at(&self, view: &View, cell: usize, shift: f32) -> Option<f32> {
        if shift.is_nan() {
            return None;
        }
        let (row, x) = (cell / view.width, cell % view.width);
        let whole = shift.floor();
        let upper = usize::try_from(view.mirror_row(row, whole as isize)).ok()?;
        if upper + 1 >= view.height {
            return None;
        }
        let at = x * view.height + upper;
        let [water, ..] = &self.water;
        let wet = self.is_water[at] > 0.0 && self.is_water[at + 1] > 0.0;
        wet.then(|| water[at] + (water[at + 1] - water[at]) * (shift - whole))
    }

    /// The same with the water moved sideways, round the frame, by so many columns of `height` pixels: a mirror image
    /// that cannot be right.
    pub(super) fn with_water_moved(&self, columns: usize, height: usize) -> Self {
        let mut moved = self.clone();
        for values in moved.water.iter_mut().chain([&mut moved.is_water]) {
            values.rotate_right(columns * height);
        }
        moved
    }
}

/// Both contrasts of the pixels of one kind, over the deviation of brightness around them.
fn contrasts(view: &View, kind: Kind) -> [Vec<f32>; 2] {
    let weights = view.weights(kind);
    let sums = |of: &(dyn Fn(f32) -> f32 + Sync)| {
        let values: Vec<f32> = view.gray.par_iter().zip(&weights).map(|(&g, &w)| w * of(g)).collect();
        box_sum(view.width, &values, RADIUS, RADIUS)
    };
    // Around the middle code, so that squares do not swamp deviations.
    let (count, sum) = (sums(&|_| 1.0), sums(&|g| g - 128.0));
    let square = sums(&|g| (g - 128.0) * (g - 128.0));
    (0..view.gray.len())
        .into_par_iter()
        .map(|cell| {
            if weights[cell] == 0.0 {
                return (0.0, 0.0);
            }
            let mean = sum[cell] / count[cell];
            let variance = (square[cell] / count[cell] - mean * mean).max(0.0);
            let per_code = 1.0 / (variance + NOISE * NOISE).sqrt();
            let around = (view.gray[cell] - 128.0 - mean) * per_code;
            (around, (view.gray[cell] - mean_of_like(view, &weights, cell)) * per_code * AGAINST_LIKE)
        })
        .unzip::<_, _, Vec<f32>, Vec<f32>>()
        .into()
}

/// Mean brightness of what is like a pixel around it.
fn mean_of_like(view: &View, weights: &[f32], cell: usize) -> f32 {
    let (row, x) = (cell / view.width, cell % view.width);
    let own = view.gray[cell];
    let (mut sum, mut count) = (0.0, 0.0);
    for y in row.saturating_sub(RADIUS)..=(row + RADIUS).min(view.height - 1) {
        let columns =
            y * view.width + x.saturating_sub(RADIUS)..y * view.width + (x + RADIUS + 1).min(view.width);
        for (gray, weight) in view.gray[columns.clone()].iter().zip(&weights[columns]) {
            let off = (gray - own) * (1.0 / LIKENESS);
            let like = 1.0 / (1.0 + off * off);
            sum += weight * like * like * gray;
            count += weight * like * like;
        }
    }
    sum / count
}
