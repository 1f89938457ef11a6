//! The colors of an object and of what is around it, place by place.
//!
//! Colors on either side of a mask's edge are summed up in square blocks, so a Gaussian of either side's
//! colors is at hand around every place, and both move smoothly from place to place.

use glam::DMat3;
use glam::DVec3;
use glam::Vec3;
use rayon::prelude::*;

/// Standard deviation of color that means nothing, 0–1: noise, and what a Gaussian does not know of a side's
/// variety.
const NOISE: f64 = 0.07;

/// A Gaussian of less than this many cells is none.
const MIN_CELLS: f64 = 2.0;

/// Sums over a set of colors.
#[derive(Clone, Copy, Debug)]
struct Sums {
    count: f64,
    color: DVec3,
    square: DMat3,
}

/// Sums of the colors outside and inside.
type Sides = [Sums; 2];

const NOTHING: Sides = [Sums { count: 0.0, color: DVec3::ZERO, square: DMat3::ZERO }; 2];

/// The colors of both sides around each place.
#[derive(Debug)]
pub(super) struct Palette {
    /// Side of a block in cells, and blocks in a row and in a column.
    block: usize,
    width: usize,
    height: usize,
    /// Sums over three by three blocks, around each block.
    near: Vec<Sides>,
}

/// What a cell's color says of its side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Opinion {
    /// Logarithm of how much likelier the color is inside than outside.
    pub log_odds: f32,
    /// How far the two sides' colors differ: Bhattacharyya's distance of their Gaussians, 0 for the same.
    pub contrast: f32,
}

impl Palette {
    /// The colors of a picture, `width` to a row, in blocks of `block` cells a side; `inside` tells a cell's
    /// side, or `None` for a cell of neither.
    pub(super) fn of(
        width: usize,
        colors: &[[f32; 3]],
        block: usize,
        inside: impl Fn(usize) -> Option<bool> + Sync,
    ) -> Self {
        let rows = colors.len() / width;
        let (w, h) = (width.div_ceil(block), rows.div_ceil(block));
        let own: Vec<Sides> = (0..w * h)
            .into_par_iter()
            .map(|index| {
                let (x, y) = (index % w * block, index / w * block);
                let mut sides = NOTHING;
                for row in y..(y + block).min(rows) {
                    for column in x..(x + block).min(width) {
                        let cell = row * width + column;
                        if let Some(inside) = inside(cell) {
                            let color = Vec3::from_array(colors[cell]).as_dvec3();
                            let one = Sums { count: 1.0, color, square: outer(color) };
                            sides[usize::from(inside)].add(&one, 1.0);
                        }
                    }
                }
                sides
            })
            .collect();
        let near = (0..w * h)
            .into_par_iter()
            .map(|index| {
                let (x, y) = (index % w, index / w);
                let mut near = NOTHING;
                for row in y.saturating_sub(1)..(y + 2).min(h) {
                    for column in x.saturating_sub(1)..(x + 2).min(w) {
                        add(&mut near, &own[row * w + column], 1.0);
                    }
                }
                near
            })
            .collect();
        Self { block, width: w, height: h, near }
    }

    /// What a cell's color says; `None` where a side has no colors.
    pub(super) fn opinion(&self, x: usize, y: usize, color: [f32; 3]) -> Option<Opinion> {
        let [outside, inside] = self.at(x, y).map(|sums| sums.gaussian());
        let ((mean_out, cov_out), (mean_in, cov_in)) = (outside?, inside?);
        let color = Vec3::from_array(color).as_dvec3();
        let likelihood = |mean: DVec3, covariance: DMat3| {
            let off = color - mean;
            -0.5 * (off.dot(covariance.inverse() * off) + covariance.determinant().ln())
        };
        let both = (cov_in + cov_out) * 0.5;
        let off = mean_in - mean_out;
        let spread = both.determinant() / (cov_in.determinant() * cov_out.determinant()).sqrt();
        Some(Opinion {
            log_odds: (likelihood(mean_in, cov_in) - likelihood(mean_out, cov_out)) as f32,
            contrast: (0.125 * off.dot(both.inverse() * off) + 0.5 * spread.max(1.0).ln()) as f32,
        })
    }

    /// Sums around a cell, between the blocks' centers bilinear.
    fn at(&self, x: usize, y: usize) -> Sides {
        let place = |cell: usize, count: usize| {
            let at = ((cell as f64 + 0.5) / self.block as f64 - 0.5).clamp(0.0, count as f64 - 1.0);
            (at as usize, (at as usize + 1).min(count - 1), at.fract())
        };
        let (x0, x1, px) = place(x, self.width);
        let (y0, y1, py) = place(y, self.height);
        let mut sides = NOTHING;
        for (row, share) in [(y0, 1.0 - py), (y1, py)] {
            add(&mut sides, &self.near[row * self.width + x0], share * (1.0 - px));
            add(&mut sides, &self.near[row * self.width + x1], share * px);
        }
        sides
    }
}

impl Sums {
    fn add(&mut self, other: &Self, share: f64) {
        self.count += share * other.count;
        self.color += share * other.color;
        self.square += other.square * share;
    }

    /// Mean and covariance.
    fn gaussian(&self) -> Option<(DVec3, DMat3)> {
        (self.count >= MIN_CELLS).then(|| {
            let mean = self.color / self.count;
            let noise = DMat3::from_diagonal(DVec3::splat(NOISE * NOISE));
            (mean, self.square * (1.0 / self.count) - outer(mean) + noise)
        })
    }
}

fn add(sides: &mut Sides, other: &Sides, share: f64) {
    for (side, other) in sides.iter_mut().zip(other) {
        side.add(other, share);
    }
}

/// A vector times itself transposed.
pub(super) fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_color_is_told_by_the_side_that_has_it() {
        let width = 40;
        let colors: Vec<[f32; 3]> = (0..width * width)
            .map(|i| if i % width < 20 { [0.2, 0.2, 0.2 + 0.1 * (i as f32).sin()] } else { [0.6, 0.2, 0.2] })
            .collect();
        let palette = Palette::of(width, &colors, 5, |cell| Some(cell % width < 20));
        let of = |color| palette.opinion(19, 11, color).expect("both sides have colors");
        assert!(of([0.2, 0.2, 0.2]).log_odds > 3.0, "{:?}", of([0.2, 0.2, 0.2]));
        assert!(of([0.6, 0.2, 0.2]).log_odds < -3.0, "{:?}", of([0.6, 0.2, 0.2]));
        assert!(palette.opinion(0, 0, [0.2; 3]).is_none(), "there is nothing of the outside near the corner");
    }

    #[test]
    fn one_color_has_no_contrast() {
        let palette = Palette::of(20, &[[0.3; 3]; 400], 5, |cell| Some(cell % 20 < 10));
        let opinion = palette.opinion(10, 10, [0.3; 3]).expect("both sides have colors");
        assert!(opinion.contrast < 1e-6 && opinion.log_odds.abs() < 1e-4, "{opinion:?}");
    }
}
