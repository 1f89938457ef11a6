//! Brings masks of a small picture to the edges of the full one: the guided filter of He, Sun and Tang (2010).
//!
//! Inside each window the mask is taken to be a linear function of the picture's light, so it turns where that does.

use glam::UVec2;
use rayon::prelude::*;

use super::gray::Gray;
use crate::picture::{Mask, Picture};

/// A picture to whose edges masks are brought.
pub(super) struct Guide {
    /// The picture's size, and that at which it is filtered.
    whole: UVec2,
    size: UVec2,
    /// Pixels of the filtered size in one of the small picture; windows reach about so far.
    scale: f32,
    reach: usize,
    /// Light, 0–1, its mean and its variance in each window.
    light: Vec<f32>,
    mean: Vec<f32>,
    variance: Vec<f32>,
}

/// Pixels of the largest picture that is filtered as it is.
const MOST_PIXELS: f64 = 9e6;
/// Variance of light below which a window counts as plain.
const PLAIN: f32 = 4e-4;

impl Guide {
    /// `factor` is how many of the picture's pixels one of the small picture is wide.
    pub(super) fn new(picture: &Picture, factor: usize) -> Self {
        let whole = picture.size();
        let pixels = f64::from(whole.x) * f64::from(whole.y);
        let shrink = (pixels / MOST_PIXELS).sqrt().ceil().max(1.0) as usize;
        let gray = Gray::of(picture).shrunk(shrink);
        let size = UVec2::new(gray.width as u32, gray.height as u32);
        let light: Vec<f32> = gray.values.par_iter().map(|value| value / 255.0).collect();
        let reach = (factor / shrink).max(1);
        let squares: Vec<f32> = light.par_iter().map(|light| light * light).collect();
        let (mean, mut variance) =
            rayon::join(|| averages(&light, size, reach), || averages(&squares, size, reach));
        variance
            .par_iter_mut()
            .zip(&mean)
            .for_each(|(square, mean)| *square = (*square - mean * mean).max(0.0));
        let scale = factor as f32 / shrink as f32;
        Self { whole, size, scale, reach, light, mean, variance }
    }

    /// A soft mask from values −1 to 1 of a grid of the small picture's width and height: 0 where they are −0.2 or less,
    /// full from 0.2 on.
    pub(super) fn mask(&self, [width, height]: [usize; 2], values: &[f32]) -> Option<Mask> {
        let at = |x: usize, y: usize| values[y.min(height - 1) * width + x.min(width - 1)];
        let mut wide = vec![0.0; self.light.len()];
        wide.par_chunks_mut(self.size.x as usize).enumerate().for_each(|(j, row)| {
            let y = ((j as f32 + 0.5) / self.scale - 0.5).max(0.0);
            let (top, ty) = (y as usize, y.fract());
            for (i, value) in row.iter_mut().enumerate() {
                let x = ((i as f32 + 0.5) / self.scale - 0.5).max(0.0);
                let (left, tx) = (x as usize, x.fract());
                let mix = |y: usize| at(left, y) * (1.0 - tx) + at(left + 1, y) * tx;
                let mixed = mix(top) * (1.0 - ty) + mix(top + 1) * ty;
                *value = (0.5 + 2.5 * mixed).clamp(0.0, 1.0);
            }
        });
        let coverage = self.filtered(&wide).into_par_iter().map(|value| {
            // The filter rounds off what was sure; this makes it sure again.
            ((1.6 * (value - 0.5) + 0.5).clamp(0.0, 1.0) * 255.0).round() as u8
        });
        Some(Mask::new(self.size, coverage.collect()).ok()?.resized_to(self.whole))
    }

    fn filtered(&self, mask: &[f32]) -> Vec<f32> {
        let average = |values: &[f32]| averages(values, self.size, self.reach);
        let both: Vec<f32> = self.light.par_iter().zip(mask).map(|(light, mask)| light * mask).collect();
        let (mean, both) = rayon::join(|| average(mask), || average(&both));
        let (slope, offset): (Vec<f32>, Vec<f32>) = (0..mask.len())
            .into_par_iter()
            .map(|i| {
                let slope = (both[i] - self.mean[i] * mean[i]) / (self.variance[i] + PLAIN);
                (slope, mean[i] - slope * self.mean[i])
            })
            .unzip();
        let (slope, offset) = rayon::join(|| average(&slope), || average(&offset));
        (0..mask.len()).into_par_iter().map(|i| slope[i] * self.light[i] + offset[i]).collect()
    }
}

/// Means over squares that reach `reach` pixels to each side, as far as they lie inside.
fn averages(values: &[f32], size: UVec2, reach: usize) -> Vec<f32> {
    let (width, height) = (size.x as usize, size.y as usize);
    let mut across = vec![0.0_f32; values.len()];
    across.par_chunks_mut(width).zip(values.par_chunks(width)).for_each(|(to, from)| {
        let mut sum: f64 = from[..reach.min(width)].iter().map(|v| f64::from(*v)).sum();
        for x in 0..width {
            if x + reach < width {
                sum += f64::from(from[x + reach]);
            }
            if x > reach {
                sum -= f64::from(from[x - reach - 1]);
            }
            let count = (x + reach).min(width - 1) - x.saturating_sub(reach) + 1;
            to[x] = (sum / count as f64) as f32;
        }
    });
    let mut out = vec![0.0_f32; values.len()];
    // Bands of rows, each with its own running sums down the columns.
    let band = height.div_ceil(8).max(1);
    out.par_chunks_mut(width * band).enumerate().for_each(|(part, rows)| {
        let first = part * band;
        let mut sums = vec![0.0_f64; width];
        for y in first.saturating_sub(reach)..(first + reach).min(height) {
            sums.iter_mut().zip(&across[y * width..][..width]).for_each(|(sum, v)| *sum += f64::from(*v));
        }
        for (k, row) in rows.chunks_exact_mut(width).enumerate() {
            let y = first + k;
            if y + reach < height {
                let add = &across[(y + reach) * width..][..width];
                sums.iter_mut().zip(add).for_each(|(sum, v)| *sum += f64::from(*v));
            }
            if y > reach && k > 0 {
                let drop = &across[(y - reach - 1) * width..][..width];
                sums.iter_mut().zip(drop).for_each(|(sum, v)| *sum -= f64::from(*v));
            }
            let count = (y + reach).min(height - 1) - y.saturating_sub(reach) + 1;
            row.iter_mut().zip(&sums).for_each(|(to, sum)| *to = (*sum / count as f64) as f32);
        }
    });
    out
}
