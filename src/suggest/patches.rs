//! Correlation of small patches of a gray picture with each other, upright or upside down.
//!
//! A patch is centered on a pixel. Its mean and its contrast do not matter to the correlation: water dims what it
//! shows, and by how much differs from place to place.

use glam::DVec2;

use super::gray::Gray;
use super::symmetry::vertex;

/// Patch rows are kept this wide, zeros at the end, so that they multiply in whole registers.
const LANE: usize = 8;

/// A gray picture with what every patch of one size needs.
pub(super) struct Patches {
    width: usize,
    height: usize,
    half: [usize; 2],
    /// Values of a row of the picture, and room at its end.
    stride: usize,
    values: Vec<f32>,
    /// Standard deviation of the patch about each pixel; 0 at the border.
    contrast: Vec<f32>,
}

/// One patch, ready to be compared.
pub(super) struct Template {
    /// Row by row, mean 0, length 1, each row padded with zeros.
    values: Vec<f32>,
}

impl Patches {
    /// Patches that reach `half` pixels to the sides and up and down from their center.
    pub(super) fn new(gray: &Gray, half: [usize; 2]) -> Self {
        let (width, height) = (gray.width, gray.height);
        let padded = (2 * half[0] + 1).next_multiple_of(LANE);
        let stride = width + padded;
        // About the middle gray, which keeps sums of squares exact enough.
        let mut values = vec![0.0; stride * height];
        for (to, from) in values.chunks_exact_mut(stride).zip(gray.values.chunks_exact(width)) {
            to.iter_mut().zip(from).for_each(|(to, from)| *to = from - 128.0);
        }
        let contrast = contrasts(&values, stride, width, height, half);
        Self { width, height, half, stride, values, contrast }
    }

    fn padded(&self) -> usize {
        (2 * self.half[0] + 1).next_multiple_of(LANE)
    }

    pub(super) fn rows(&self) -> usize {
        self.height
    }

    fn pixels(&self) -> f32 {
        ((2 * self.half[0] + 1) * (2 * self.half[1] + 1)) as f32
    }

    /// Standard deviation of the patch about a pixel, gray levels; 0 where it does not fit in.
    pub(super) fn contrast(&self, x: isize, y: isize) -> f32 {
        let inside = x >= 0 && y >= 0 && (x as usize) < self.width && (y as usize) < self.height;
        if inside { self.contrast[y as usize * self.width + x as usize] } else { 0.0 }
    }

    /// The patch about a pixel, upside down if asked; `None` where its contrast is below `least`.
    pub(super) fn template(&self, x: isize, y: isize, flipped: bool, least: f32) -> Option<Template> {
        let contrast = self.contrast(x, y);
        if contrast < least.max(1e-3) {
            return None;
        }
        let (left, top) = (x as usize - self.half[0], y as usize - self.half[1]);
        let (wide, high) = (2 * self.half[0] + 1, 2 * self.half[1] + 1);
        let row = |k: usize| &self.values[(top + k) * self.stride + left..][..wide];
        let mean = (0..high).flat_map(row).sum::<f32>() / self.pixels();
        let share = 1.0 / (contrast * self.pixels().sqrt());
        let mut values = vec![0.0; self.padded() * high];
        for (k, to) in values.chunks_exact_mut(self.padded()).enumerate() {
            let from = row(if flipped { high - 1 - k } else { k });
            to.iter_mut().zip(from).for_each(|(to, from)| *to = (from - mean) * share);
        }
        Some(Template { values })
    }

    /// Correlation with the patch about a pixel, −1 to 1; −1 where that has less contrast than `least`.
    pub(super) fn score(&self, template: &Template, x: isize, y: isize, least: f32) -> f32 {
        let contrast = self.contrast(x, y);
        if contrast < least.max(1e-3) {
            return -1.0;
        }
        let (left, top) = (x as usize - self.half[0], y as usize - self.half[1]);
        let padded = self.padded();
        let mut sums = [0.0; LANE];
        for (k, own) in template.values.chunks_exact(padded).enumerate() {
            let other = &self.values[(top + k) * self.stride + left..][..padded];
            for (own, other) in own.as_chunks::<LANE>().0.iter().zip(other.as_chunks::<LANE>().0) {
                for i in 0..LANE {
                    sums[i] += own[i] * other[i];
                }
            }
        }
        sums.iter().sum::<f32>() / (contrast * self.pixels().sqrt())
    }

    /// The place within `reach` pixels of a pixel that looks most like a template.
    pub(super) fn peak(
        &self,
        template: &Template,
        (x, y): (isize, isize),
        reach: isize,
        least: f32,
    ) -> Option<Peak> {
        let width = 2 * reach + 1;
        let scores: Vec<f32> = (0..width * width)
            .map(|i| self.score(template, x - reach + i % width, y - reach + i / width, least))
            .collect();
        let best = (0..scores.len()).max_by(|&a, &b| scores[a].total_cmp(&scores[b]))?;
        let score = scores[best];
        if score <= -1.0 {
            return None;
        }
        let width = width as usize;
        let (column, row) = (best % width, best / width);
        let seen = |score: f32| (score > -1.0).then_some(score);
        let along_x = |x: usize| (x < width).then(|| scores[row * width + x]).and_then(seen);
        let along_y = |y: usize| scores.get(y * width + column).copied().and_then(seen);
        let bend = |i: usize, along: &dyn Fn(usize) -> Option<f32>| {
            let sides = i.checked_sub(1).and_then(along).zip(along(i + 1));
            sides.map_or(0.0, |(a, b)| (2.0 * score - a - b).max(0.0))
        };
        let corner = DVec2::new((x - reach) as f64, (y - reach) as f64) + 0.5;
        Some(Peak {
            pixel: (x - reach + column as isize, y - reach + row as isize),
            at: corner + DVec2::new(vertex(column, along_x), vertex(row, along_y)),
            score,
            bends: [bend(column, &along_x), bend(row, &along_y)],
        })
    }
}

/// Where a template fits best.
pub(super) struct Peak {
    pub(super) pixel: (isize, isize),
    /// Between pixels.
    pub(super) at: DVec2,
    pub(super) score: f32,
    /// By how much the score falls beside the peak: minus its second difference along x and y.
    pub(super) bends: [f32; 2],
}

/// Standard deviations of all patches, from sums over rectangles.
fn contrasts(values: &[f32], stride: usize, width: usize, height: usize, [hx, hy]: [usize; 2]) -> Vec<f32> {
    let mut sums = vec![[0.0_f64; 2]; (width + 1) * (height + 1)];
    for y in 0..height {
        let mut row = [0.0; 2];
        for x in 0..width {
            let value = f64::from(values[y * stride + x]);
            row = [row[0] + value, row[1] + value * value];
            let above = sums[y * (width + 1) + x + 1];
            sums[(y + 1) * (width + 1) + x + 1] = [above[0] + row[0], above[1] + row[1]];
        }
    }
    let pixels = ((2 * hx + 1) * (2 * hy + 1)) as f64;
    let mut contrasts = vec![0.0; width * height];
    for y in hy..height.saturating_sub(hy) {
        for x in hx..width.saturating_sub(hx) {
            let at = |x: usize, y: usize| sums[y * (width + 1) + x];
            let (l, r, t, b) = (x - hx, x + hx + 1, y - hy, y + hy + 1);
            let sum = |i: usize| at(r, b)[i] - at(l, b)[i] - at(r, t)[i] + at(l, t)[i];
            let mean = sum(0) / pixels;
            contrasts[y * width + x] = (sum(1) / pixels - mean * mean).max(0.0).sqrt() as f32;
        }
    }
    contrasts
}
