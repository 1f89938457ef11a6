//! An object's own colors where the picture mixes them with what is behind: fast multi-level foreground
//! estimation (Germer, Uelwer, Conrad, Harmeling 2020).
//!
//! From one cell to the full size, each level starts from the coarser one and balances `α F + (1 − α) B = I`
//! against smoothness of F and B, which holds across an edge of alpha more than along flat alpha. All colors
//! are linear light. Large levels work only near edges of alpha: elsewhere the picture shows one of the two,
//! and nobody sees the other.

use glam::DVec3;
use glam::Vec3;
use rayon::prelude::*;

/// How much smoothness counts where alpha does not change.
const SMOOTHNESS: f32 = 1e-5;

/// Levels of up to this many cells a side are swept often and all over, larger ones rarely and near edges.
const SMALL: usize = 32;
const SWEEPS_SMALL: usize = 10;
const SWEEPS_LARGE: usize = 3;

/// How far from edges of alpha large levels work, in cells.
const NEAR: usize = 3;

/// Foreground and background color of a cell.
type Pair = [Vec3; 2];

/// A picture and its alpha, seen at a lower resolution.
struct Level<'a> {
    colors: &'a [[f32; 3]],
    alpha: &'a [f32],
    /// The picture's column of each column here, and the first cell of the picture's row of each row here.
    columns: Vec<usize>,
    rows: Vec<usize>,
}

/// Foreground colors 0–1 of every cell, `width` to a row; where alpha (0–1) is zero they continue those
/// nearby. `None` when `progress`, which gets the share done, says so.
pub(super) fn foreground(
    width: usize,
    colors: &[[f32; 3]],
    alpha: &[f32],
    progress: &dyn Fn(f32) -> bool,
) -> Option<Vec<[f32; 3]>> {
    let height = alpha.len() / width;
    let count = (width.max(height) as f32).log2().ceil() as i32;
    let mut pairs = vec![[mean(colors, alpha, |a| a), mean(colors, alpha, |a| 1.0 - a)]];
    let mut before = (1, 1);
    for number in 0..=count {
        let share = if count > 0 { number as f32 / count as f32 } else { 1.0 };
        let side = |full: usize| (full as f32).powf(share).round() as usize;
        // The last level is the picture to the cell, whatever rounding says.
        let (w, h) = if number == count { (width, height) } else { (side(width), side(height)) };
        let level = Level {
            colors,
            alpha,
            columns: (0..w).map(|x| (2 * x + 1) * width / (2 * w)).collect(),
            rows: (0..h).map(|y| (2 * y + 1) * height / (2 * h) * width).collect(),
        };
        pairs = level.begun(before, &pairs);
        before = (w, h);
        let small = w.max(h) <= SMALL;
        let cells: Vec<usize> =
            (0..w * h).into_par_iter().filter(|&cell| small || level.is_near_edge(cell)).collect();
        for _ in 0..if small { SWEEPS_SMALL } else { SWEEPS_LARGE } {
            let balanced: Vec<Pair> = cells.par_iter().map(|&cell| level.balanced(&pairs, cell)).collect();
            for (&cell, balanced) in cells.iter().zip(balanced) {
                pairs[cell] = balanced;
            }
        }
        // Each level takes about four times as long as the one before.
        if !progress(4.0_f32.powi(number - count)) {
            return None;
        }
    }
    Some(pairs.into_par_iter().map(|[foreground, _]| foreground.to_array()).collect())
}

/// Mean color by a weight of alpha.
fn mean(colors: &[[f32; 3]], alpha: &[f32], weight: impl Fn(f32) -> f32) -> Vec3 {
    let (mut sum, mut total) = (DVec3::ZERO, 1e-9);
    for (&color, &alpha) in colors.iter().zip(alpha) {
        let weight = f64::from(weight(alpha));
        sum += weight * Vec3::from_array(color).as_dvec3();
        total += weight;
    }
    (sum / total).as_vec3()
}

impl Level<'_> {
    fn sample(&self, x: usize, y: usize) -> usize {
        self.rows[y] + self.columns[x]
    }

    fn split(&self, cell: usize) -> (usize, usize) {
        (cell % self.columns.len(), cell / self.columns.len())
    }

    /// The coarser level's pairs at this size; where the picture shows one of the two, that one is known.
    fn begun(&self, (width, height): (usize, usize), coarse: &[Pair]) -> Vec<Pair> {
        let (w, h) = (self.columns.len(), self.rows.len());
        (0..w * h)
            .into_par_iter()
            .with_min_len(4096)
            .map(|cell| {
                let (x, y) = self.split(cell);
                let [foreground, background] = coarse[y * height / h * width + x * width / w];
                let sample = self.sample(x, y);
                let color = Vec3::from_array(self.colors[sample]);
                match self.alpha[sample] {
                    1.0 => [color, background],
                    0.0 => [foreground, color],
                    _ => [foreground, background],
                }
            })
            .collect()
    }

    /// Whether alpha is mixed here or changes nearby.
    fn is_near_edge(&self, cell: usize) -> bool {
        let (x, y) = self.split(cell);
        let own = self.alpha[self.sample(x, y)];
        let differs = |x: usize, y: usize| {
            let inside = x < self.columns.len() && y < self.rows.len();
            inside && self.alpha[self.sample(x, y)] != own
        };
        let is_mixed = own > 0.0 && own < 1.0;
        is_mixed
            || [1, NEAR].into_iter().any(|step| {
                differs(x.wrapping_sub(step), y)
                    || differs(x + step, y)
                    || differs(x, y.wrapping_sub(step))
                    || differs(x, y + step)
            })
    }

    /// The colors that are best for a cell while its four neighbors keep theirs.
    fn balanced(&self, pairs: &[Pair], cell: usize) -> Pair {
        let (x, y) = self.split(cell);
        let sample = self.sample(x, y);
        let alpha = self.alpha[sample];
        let mut total = 0.0;
        let mut near = [Vec3::ZERO; 2];
        let mut add = |x: usize, y: usize| {
            if x < self.columns.len() && y < self.rows.len() {
                let weight = SMOOTHNESS + (self.alpha[self.sample(x, y)] - alpha).abs();
                let pair = &pairs[y * self.columns.len() + x];
                total += weight;
                near[0] += weight * pair[0];
                near[1] += weight * pair[1];
            }
        };
        add(x.wrapping_sub(1), y);
        add(x + 1, y);
        add(x, y.wrapping_sub(1));
        add(x, y + 1);
        if total == 0.0 {
            return pairs[cell];
        }
        // With both at their neighbors' mean, what the color lacks is split as alpha says: the solution of
        // the paper's two equations, without their cancellation.
        let (foreground, background) = (near[0] / total, near[1] / total);
        let rest = 1.0 - alpha;
        let lack = Vec3::from_array(self.colors[sample]) - alpha * foreground - rest * background;
        let lack = lack / (alpha * alpha + rest * rest + total);
        [foreground + alpha * lack, background + rest * lack].map(|color| color.clamp(Vec3::ZERO, Vec3::ONE))
    }
}
