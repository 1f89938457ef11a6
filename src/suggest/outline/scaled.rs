//! A part of the picture at a size that can be worked on.
//!
//! A cell is the mean of `factor` × `factor` pixels, less where the part ends. Colors are sRGB codes as 0–1.

use glam::{UVec2, Vec3};
use rayon::prelude::*;

use crate::picture::{Picture, PixelRect};

/// A block of the picture, averaged.
#[derive(Clone, Debug)]
pub(super) struct Scaled {
    /// The block, never empty.
    pub rect: PixelRect,
    /// Pixels along a side of a cell, at least 1.
    pub factor: u32,
    /// Cells in a row and in a column.
    pub width: usize,
    pub height: usize,
    /// Row by row.
    pub colors: Vec<Vec3>,
}

impl Scaled {
    /// The block `rect`, which lies in the picture and holds a pixel, with at most `most` cells (nearly).
    pub(super) fn new(picture: &Picture, rect: PixelRect, most: u32) -> Self {
        let size = rect.size();
        let area = f64::from(size.x) * f64::from(size.y);
        let factor = (area / f64::from(most.max(1))).sqrt().ceil().max(1.0) as u32;
        let [width, height] = [size.x.div_ceil(factor) as usize, size.y.div_ceil(factor) as usize];
        let stride = picture.size().x as usize;
        let mut colors = vec![Vec3::ZERO; width * height];
        colors.par_chunks_mut(width).enumerate().for_each(|(row, cells)| {
            let top = rect.min.y + row as u32 * factor;
            for (column, cell) in cells.iter_mut().enumerate() {
                let left = rect.min.x + column as u32 * factor;
                let [right, bottom] = [(left + factor).min(rect.max.x), (top + factor).min(rect.max.y)];
                let mut sum = [0_u32; 3];
                for y in top..bottom {
                    let pixels = &picture.pixels()[y as usize * stride..][left as usize..right as usize];
                    for pixel in pixels {
                        for (sum, code) in sum.iter_mut().zip(pixel) {
                            *sum += u32::from(*code);
                        }
                    }
                }
                let count = (right - left) * (bottom - top);
                *cell = Vec3::from(sum.map(|sum| sum as f32)) / (255.0 * count as f32);
            }
        });
        Self { rect, factor, width, height, colors }
    }

    /// The cell that holds a pixel of the picture; `None` outside the block.
    pub(super) fn cell(&self, x: u32, y: u32) -> Option<usize> {
        let [min, max] = [self.rect.min, self.rect.max];
        let inside = x >= min.x && x < max.x && y >= min.y && y < max.y;
        inside
            .then(|| ((y - min.y) / self.factor) as usize * self.width + ((x - min.x) / self.factor) as usize)
    }

    /// The pixel in the middle of a cell.
    pub(super) fn pixel(&self, cell: usize) -> UVec2 {
        let corner = UVec2::new((cell % self.width) as u32, (cell / self.width) as u32) * self.factor;
        (self.rect.min + corner + self.factor / 2).min(self.rect.max - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_means_and_pixels_find_them() {
        let pixels = (0..35).map(|i| [i as u8; 3]).collect();
        let picture = Picture::new(UVec2::new(7, 5), pixels).unwrap();
        let rect = PixelRect { min: UVec2::new(1, 1), max: UVec2::new(6, 5) };
        let scaled = Scaled::new(&picture, rect, 6);
        assert_eq!((scaled.factor, scaled.width, scaled.height), (2, 3, 2));
        // Pixels 8, 9, 15, 16; the last column is one pixel wide: 12, 19.
        assert!((scaled.colors[0].x * 255.0 - 12.0).abs() < 1e-4);
        assert!((scaled.colors[2].x * 255.0 - 15.5).abs() < 1e-4);
        assert_eq!((scaled.cell(1, 1), scaled.cell(5, 4), scaled.cell(6, 4)), (Some(0), Some(5), None));
        assert_eq!(scaled.pixel(5), UVec2::new(5, 4));
    }
}
