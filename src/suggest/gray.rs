//! Gray values of a picture to measure in: shrunk by whole factors, blurred, turned level.
//!
//! Values are luma of the sRGB codes, 0–255. Coordinates are picture coordinates of the gray picture itself: pixel
//! (i, j) has its center at (i + 0.5, j + 0.5). Outside, the border's value goes on.

use glam::DVec2;
use rayon::prelude::*;

use crate::picture::Picture;

/// Gray values, row by row from the top left; at least one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Gray {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) values: Vec<f32>,
}

/// Rec. 601 weights of the sRGB codes.
fn luma([red, green, blue]: [u8; 3]) -> f32 {
    0.299 * f32::from(red) + 0.587 * f32::from(green) + 0.114 * f32::from(blue)
}

impl Gray {
    pub(super) fn of(picture: &Picture) -> Self {
        let size = picture.size();
        let values = picture.pixels().par_iter().map(|&pixel| luma(pixel)).collect();
        Self { width: size.x as usize, height: size.y as usize, values }
    }

    /// The part from `left` columns on, `width` wide, of row `y`.
    pub(super) fn span(&self, y: usize, left: usize, width: usize) -> &[f32] {
        &self.values[y * self.width + left..][..width]
    }

    /// Averaged over blocks of `factor` × `factor` pixels; what is left at the right and the bottom is cut off.
    pub(super) fn shrunk(&self, factor: usize) -> Self {
        let factor = factor.clamp(1, self.width.min(self.height));
        if factor == 1 {
            return self.clone();
        }
        let (width, height) = (self.width / factor, self.height / factor);
        let share = 1.0 / (factor * factor) as f32;
        let mut values = vec![0.0; width * height];
        values.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            for line in 0..factor {
                let from = self.span(y * factor + line, 0, width * factor);
                for (value, block) in row.iter_mut().zip(from.chunks_exact(factor)) {
                    *value += block.iter().sum::<f32>() * share;
                }
            }
        });
        Self { width, height, values }
    }

    /// Blurred by a Gaussian of `sigma` pixels.
    pub(super) fn blurred(&self, sigma: f32) -> Self {
        let reach = (3.0 * sigma).ceil() as isize;
        let weights: Vec<f32> = (-reach..=reach).map(|i| (-0.5 * (i as f32 / sigma).powi(2)).exp()).collect();
        let sum: f32 = weights.iter().sum();
        let weights: Vec<f32> = weights.iter().map(|weight| weight / sum).collect();
        let pass = |from: &[f32], step_is_row: bool| {
            let mut to = vec![0.0; from.len()];
            to.par_chunks_mut(self.width).enumerate().for_each(|(y, row)| {
                for (x, value) in row.iter_mut().enumerate() {
                    let at = |i: isize| {
                        let (x, y) = if step_is_row {
                            (x, (y as isize + i).clamp(0, self.height as isize - 1) as usize)
                        } else {
                            ((x as isize + i).clamp(0, self.width as isize - 1) as usize, y)
                        };
                        from[y * self.width + x]
                    };
                    *value = (-reach..=reach).zip(&weights).map(|(i, weight)| weight * at(i)).sum();
                }
            });
            to
        };
        let values = pass(&pass(&self.values, false), true);
        Self { width: self.width, height: self.height, values }
    }

    /// Value at a point, linear between pixel centers.
    pub(super) fn at(&self, point: DVec2) -> f32 {
        let limit = DVec2::new(self.width as f64, self.height as f64) - 1.0;
        let at = (point - 0.5).clamp(DVec2::ZERO, limit);
        let (x, y) = (at.x as usize, at.y as usize);
        let (tx, ty) = ((at.x - x as f64) as f32, (at.y - y as f64) as f32);
        let (right, below) = ((x + 1).min(self.width - 1), (y + 1).min(self.height - 1));
        let row = |y: usize| {
            let (a, b) = (self.values[y * self.width + x], self.values[y * self.width + right]);
            a + (b - a) * tx
        };
        let (upper, lower) = (row(y), row(below));
        upper + (lower - upper) * ty
    }

    /// The same picture turned about its center so that lines that rose to the *right by −tilt* become level: what
    /// [`Turn::picture`] takes from the leveled picture is read here.
    pub(super) fn leveled(&self, turn: Turn) -> Self {
        if turn.tilt == 0.0 {
            return self.clone();
        }
        let mut values = vec![0.0; self.values.len()];
        values.par_chunks_mut(self.width).enumerate().for_each(|(y, row)| {
            for (x, value) in row.iter_mut().enumerate() {
                *value = self.at(turn.picture(DVec2::new(x as f64 + 0.5, y as f64 + 0.5)));
            }
        });
        Self { width: self.width, height: self.height, values }
    }

    /// The turn about this picture's center.
    pub(super) fn turn(&self, tilt: f64) -> Turn {
        Turn { center: DVec2::new(self.width as f64, self.height as f64) / 2.0, tilt }
    }
}

/// A turn about a picture's center: between the picture as it is and one in which the mirror axis is level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    pub(super) center: DVec2,
    /// Radians; above 0 the axis falls to the right in the picture (its y grows with x).
    pub(super) tilt: f64,
}

impl Turn {
    /// A point of the leveled picture, in the picture.
    pub(super) fn picture(self, leveled: DVec2) -> DVec2 {
        self.center + DVec2::from_angle(self.tilt).rotate(leveled - self.center)
    }

    /// A point of the picture, in the leveled one.
    pub(super) fn level(self, point: DVec2) -> DVec2 {
        self.center + DVec2::from_angle(-self.tilt).rotate(point - self.center)
    }

    /// The same turn in a picture `factor` times as large.
    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { center: self.center * factor, tilt: self.tilt }
    }
}
