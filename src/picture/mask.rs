//! Coverage masks: how much of each pixel something fills.
//!
//! A mask has its picture's size and at least one pixel. Outside the picture nothing is known; sampling gives 0 there,
//! growing and shrinking leave it out.

use std::ops::Range;

use glam::{DVec2, UVec2};
use image::imageops::{FilterType, resize};
use image::{GrayImage, Luma};
use rayon::prelude::*;

use super::raster::{check_count, index};
use super::{PictureError, PicturePoint, PixelRect};

/// Coverage 0–1 for each pixel of a picture, kept as 0–255.
#[derive(Clone, PartialEq, Eq)]
pub struct Mask {
    size: UVec2,
    coverage: Vec<u8>,
}

/// Scan lines a pixel row in [`Mask::from_polygon`]: a power of two above 8, so that level edges on half and quarter
/// pixels come out exact. Along the lines coverage is exact for any edge.
const LINES: u32 = 16;

impl std::fmt::Debug for Mask {
    /// The size alone: nobody reads millions of pixels.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Mask").field("size", &self.size).finish_non_exhaustive()
    }
}

impl Mask {
    /// A mask of `size` pixels, row by row from the top left; 0 is no coverage, 255 all of the pixel.
    ///
    /// # Errors
    ///
    /// [`PictureError::WrongCount`] when there are not exactly width × height values, or none at all.
    pub fn new(size: UVec2, coverage: Vec<u8>) -> Result<Self, PictureError> {
        check_count(size, coverage.len())?;
        Ok(Self { size, coverage })
    }

    /// The inside of a closed polygon, antialiased. Where it overlaps itself the even-odd rule holds.
    ///
    /// Corners may lie outside the picture. Fewer than three, or one that is not finite, give an empty mask.
    ///
    /// # Errors
    ///
    /// [`PictureError::WrongCount`] when `size` holds no pixel.
    pub fn from_polygon(size: UVec2, corners: &[PicturePoint]) -> Result<Self, PictureError> {
        check_count(size, size.x as usize * size.y as usize)?;
        let mut coverage = vec![0; size.x as usize * size.y as usize];
        let is_polygon = corners.len() >= 3 && corners.iter().all(|corner| corner.0.is_finite());
        if is_polygon {
            let after = corners.iter().cycle().skip(1);
            let edges: Vec<_> = corners.iter().zip(after).map(|(a, b)| (a.0, b.0)).collect();
            let rows = coverage.par_chunks_mut(size.x as usize).enumerate();
            rows.for_each(|(y, row)| fill_row(y as f64, row, &edges));
        }
        Ok(Self { size, coverage })
    }

    /// Width and height, in pixels.
    #[must_use]
    pub const fn size(&self) -> UVec2 {
        self.size
    }

    /// All values, 0–255, row by row from the top left.
    #[must_use]
    pub fn values(&self) -> &[u8] {
        &self.coverage
    }

    /// The values of a block of pixels, row by row from its top left; `None` when there is no pixel in it or it reaches
    /// beyond the mask.
    #[must_use]
    pub fn block(&self, block: PixelRect) -> Option<Vec<u8>> {
        let rows = self.rows_of(block)?;
        Some(rows.flat_map(|row| &self.coverage[row]).copied().collect())
    }

    /// Replaces the values of a block of pixels. Nothing changes, and it says no, unless there is one for each of its
    /// pixels and all of them lie in the mask.
    pub(crate) fn set_block(&mut self, block: PixelRect, values: &[u8]) -> bool {
        let Some(rows) = self.rows_of(block) else { return false };
        let size = block.size();
        if size.x as usize * size.y as usize != values.len() {
            return false;
        }
        for (row, values) in rows.zip(values.chunks_exact(size.x as usize)) {
            self.coverage[row].copy_from_slice(values);
        }
        true
    }

    /// Where the rows of a block stand among the values.
    fn rows_of(&self, block: PixelRect) -> Option<impl Iterator<Item = Range<usize>> + use<>> {
        let inside = block.min.cmplt(block.max).all() && block.max.cmple(self.size).all();
        let width = self.size.x as usize;
        inside.then(|| {
            (block.min.y as usize..block.max.y as usize)
                .map(move |y| y * width + block.min.x as usize..y * width + block.max.x as usize)
        })
    }

    /// Coverage of the pixel in column `x`, row `y`, 0–255.
    ///
    /// # Panics
    ///
    /// When the pixel lies outside.
    #[must_use]
    pub fn get(&self, x: u32, y: u32) -> u8 {
        self.coverage[index(self.size, x, y)]
    }

    /// Coverage of the pixel in column `x`, row `y`, 0–1.
    ///
    /// # Panics
    ///
    /// When the pixel lies outside.
    #[must_use]
    pub fn coverage(&self, x: u32, y: u32) -> f32 {
        f32::from(self.get(x, y)) / 255.0
    }

    /// Coverage at a point, 0–1: linear between pixel centers, level from the outermost centers to the frame, 0
    /// outside it.
    #[must_use]
    pub fn sample(&self, point: PicturePoint) -> f32 {
        let size = self.size.as_dvec2();
        // Written so that NaN is outside.
        if !(point.0.cmpge(DVec2::ZERO) & point.0.cmple(size)).all() {
            return 0.0;
        }
        let at = (point.0 - 0.5).clamp(DVec2::ZERO, size - 1.0);
        let (low, part) = (at.floor(), at.fract().as_vec2());
        let low = low.as_uvec2();
        let high = (low + 1).min(self.size - 1);
        let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
        let upper = mix(self.coverage(low.x, low.y), self.coverage(high.x, low.y), part.x);
        let lower = mix(self.coverage(low.x, high.y), self.coverage(high.x, high.y), part.x);
        mix(upper, lower, part.y)
    }

    /// Coverage this near to nothing or to everything is that: renderers and compressors leave dust in masks.
    pub const DUST: u8 = 6;

    /// Coverage of a pixel, 0–255, without [dust](Self::DUST).
    ///
    /// # Panics
    ///
    /// When the pixel lies outside.
    #[must_use]
    pub fn without_dust(&self, x: u32, y: u32) -> u8 {
        match self.get(x, y) {
            0..Self::DUST => 0,
            coverage if coverage > 255 - Self::DUST => 255,
            coverage => coverage,
        }
    }

    /// The smallest block of pixels that holds all coverage but [dust](Self::DUST); `None` when there is none.
    #[must_use]
    pub fn bounds(&self) -> Option<PixelRect> {
        let mut bounds: Option<PixelRect> = None;
        for (y, row) in (0..).zip(self.coverage.chunks_exact(self.size.x as usize)) {
            let covered = |value: &u8| *value >= Self::DUST;
            if let (Some(first), Some(last)) = (row.iter().position(covered), row.iter().rposition(covered)) {
                let (min, max) = (UVec2::new(first as u32, y), UVec2::new(last as u32 + 1, y + 1));
                let so_far = bounds.unwrap_or(PixelRect { min, max });
                bounds = Some(PixelRect { min: so_far.min.min(min), max: so_far.max.max(max) });
            }
        }
        bounds
    }

    /// The same mask at another size, both sides stretched to fit; linear, and averaged where it becomes smaller.
    ///
    /// # Panics
    ///
    /// When `size` holds no pixel.
    #[must_use]
    pub fn resized_to(self, size: UVec2) -> Self {
        assert!(size.min_element() > 0, "a mask has at least one pixel");
        if size == self.size {
            return self;
        }
        let image = GrayImage::from_fn(self.size.x, self.size.y, |x, y| Luma([self.get(x, y)]));
        let coverage = resize(&image, size.x, size.y, FilterType::Triangle).into_raw();
        Self { size, coverage }
    }
}

/// Fills one pixel row of a polygon: crossings of each scan line, sorted, bound its inside in pairs.
fn fill_row(y: f64, row: &mut [u8], edges: &[(DVec2, DVec2)]) {
    let near: Vec<_> = edges.iter().filter(|(a, b)| a.y.min(b.y) < y + 1.0 && a.y.max(b.y) > y).collect();
    if near.is_empty() {
        return;
    }
    let mut sums = vec![0.0; row.len()];
    let mut crossings = Vec::new();
    for line in 0..LINES {
        let y = y + (f64::from(line) + 0.5) / f64::from(LINES);
        crossings.clear();
        // Half-open, so that a corner on the line counts once.
        let crossing = near.iter().filter(|(a, b)| (a.y <= y) != (b.y <= y));
        crossings.extend(crossing.map(|(a, b)| a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y))));
        crossings.sort_unstable_by(f64::total_cmp);
        for [from, to] in crossings.as_chunks::<2>().0 {
            add_span(&mut sums, *from, *to);
        }
    }
    for (value, sum) in row.iter_mut().zip(sums) {
        *value = (sum * 255.0 / f64::from(LINES)).round() as u8;
    }
}

/// Adds to each pixel of a row how much of it lies between two columns.
fn add_span(sums: &mut [f64], from: f64, to: f64) {
    let (from, to) = (from.clamp(0.0, sums.len() as f64), to.clamp(0.0, sums.len() as f64));
    for (x, sum) in (from as usize..).zip(&mut sums[from as usize..to.ceil() as usize]) {
        *sum += to.min(x as f64 + 1.0) - from.max(x as f64);
    }
}

#[cfg(test)]
#[path = "mask_tests.rs"]
mod tests;
