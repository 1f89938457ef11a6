//! Colors of a picture to judge regions by: shrunk, in sRGB codes, with how rough each place is.

use glam::Vec3;
use rayon::prelude::*;

use crate::picture::Picture;

/// Colors, row by row from the top left, red, green, blue, 0–255.
#[derive(Clone, Debug)]
pub(super) struct Colors {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) values: Vec<Vec3>,
}

impl Colors {
    /// The picture averaged over blocks of `factor` × `factor` pixels.
    pub(super) fn of(picture: &Picture, factor: usize) -> Self {
        let size = picture.size();
        let (width, height) = ((size.x as usize / factor).max(1), (size.y as usize / factor).max(1));
        let factor = factor.min(size.min_element() as usize);
        let pixels = picture.pixels();
        let mut values = vec![Vec3::ZERO; width * height];
        let share = 1.0 / (factor * factor) as f32;
        values.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            for line in 0..factor {
                let from = &pixels[(y * factor + line) * size.x as usize..][..width * factor];
                for (value, block) in row.iter_mut().zip(from.chunks_exact(factor)) {
                    let sum: Vec3 = block.iter().map(|pixel| Vec3::from_array(pixel.map(f32::from))).sum();
                    *value += sum * share;
                }
            }
        });
        Self { width, height, values }
    }

    /// Mean difference from the neighbors two pixels away, codes.
    pub(super) fn roughness(&self) -> Vec<f32> {
        let at =
            |x: usize, y: usize| self.values[y.min(self.height - 1) * self.width + x.min(self.width - 1)];
        (0..self.values.len())
            .into_par_iter()
            .map(|i| {
                let (x, y) = (i % self.width, i / self.width);
                let own = self.values[i];
                let around =
                    [at(x + 2, y), at(x.saturating_sub(2), y), at(x, y + 2), at(x, y.saturating_sub(2))];
                around.iter().map(|other| (*other - own).length()).sum::<f32>() / 4.0
            })
            .collect()
    }

    /// The `count` commonest colors of a selection (k-means from evenly spaced ones); empty of nothing.
    pub(super) fn palette(&self, chosen: &[usize], count: usize) -> Vec<Vec3> {
        let mut by_light: Vec<Vec3> = chosen.iter().map(|&i| self.values[i]).collect();
        by_light.sort_by(|a, b| a.element_sum().total_cmp(&b.element_sum()));
        let mut palette: Vec<Vec3> = (0..count)
            .filter_map(|k| by_light.get((2 * k + 1) * by_light.len() / (2 * count)).copied())
            .collect();
        for _ in 0..6 {
            let mut sums = vec![(Vec3::ZERO, 0.0); palette.len()];
            for color in &by_light {
                if let Some((sum, number)) = nearest(&palette, *color).map(|(k, _)| &mut sums[k]) {
                    *sum += *color;
                    *number += 1.0;
                }
            }
            for (color, (sum, number)) in palette.iter_mut().zip(sums) {
                if number > 0.0 {
                    *color = sum / number;
                }
            }
        }
        palette
    }
}

/// The palette's color nearest to `color`, and how far it is, codes.
pub(super) fn nearest(palette: &[Vec3], color: Vec3) -> Option<(usize, f32)> {
    let far = palette.iter().map(|other| other.distance(color)).enumerate();
    far.min_by(|a, b| a.1.total_cmp(&b.1))
}
