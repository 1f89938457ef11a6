//! The picture's pixels in memory.
//!
//! Row by row, the top row first, 8-bit sRGB codes. At least one pixel; width × height values, always.

use glam::UVec2;

use super::PictureError;

/// The one still picture: 8-bit sRGB, row-major, top-left pixel first.
#[derive(Clone, PartialEq, Eq)]
pub struct Picture {
    size: UVec2,
    pixels: Vec<[u8; 3]>,
}

/// A block of whole pixels, from `min` up to but without `max`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelRect {
    /// Column and row of the top-left pixel inside.
    pub min: UVec2,
    /// One past the last column and row.
    pub max: UVec2,
}

impl PixelRect {
    /// Width and height, in pixels; 0 where `max` is not beyond `min`.
    #[must_use]
    pub fn size(self) -> UVec2 {
        self.max.saturating_sub(self.min)
    }
}

impl std::fmt::Debug for Picture {
    /// The size alone: nobody reads millions of pixels.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Picture").field("size", &self.size).finish_non_exhaustive()
    }
}

impl Picture {
    /// A picture of `size` pixels with these sRGB codes.
    ///
    /// # Errors
    ///
    /// [`PictureError::WrongCount`] when there are not exactly width × height pixels, or none at all.
    pub fn new(size: UVec2, pixels: Vec<[u8; 3]>) -> Result<Self, PictureError> {
        check_count(size, pixels.len())?;
        Ok(Self { size, pixels })
    }

    /// Width and height, in pixels.
    #[must_use]
    pub const fn size(&self) -> UVec2 {
        self.size
    }

    /// The sRGB codes of the pixel in column `x`, row `y`.
    ///
    /// # Panics
    ///
    /// When the pixel lies outside.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 3] {
        self.pixels[index(self.size, x, y)]
    }

    /// All pixels, row by row from the top left.
    #[must_use]
    pub fn pixels(&self) -> &[[u8; 3]] {
        &self.pixels
    }

    /// The rows, top first.
    pub fn rows(&self) -> std::slice::ChunksExact<'_, [u8; 3]> {
        self.pixels.chunks_exact(self.size.x as usize)
    }

    /// The part inside `rect`, or `None` when that holds no pixel or reaches beyond the picture.
    #[must_use]
    pub fn crop(&self, rect: PixelRect) -> Option<Self> {
        let size = rect.size();
        if size.min_element() == 0 || rect.max.cmpgt(self.size).any() {
            return None;
        }
        let columns = rect.min.x as usize..rect.max.x as usize;
        let rows = self.rows().skip(rect.min.y as usize).take(size.y as usize);
        Some(Self { size, pixels: rows.flat_map(|row| &row[columns.clone()]).copied().collect() })
    }
}

/// Holds that `count` values fill `size`, and that there is at least one.
pub(super) fn check_count(size: UVec2, count: usize) -> Result<(), PictureError> {
    if count == 0 || count as u64 != u64::from(size.x) * u64::from(size.y) {
        return Err(PictureError::WrongCount { size, count });
    }
    Ok(())
}

/// Where the pixel in column `x`, row `y` stands among all.
pub(super) fn index(size: UVec2, x: u32, y: u32) -> usize {
    // Without this a column too far right would quietly be one of the next row.
    assert!(x < size.x && y < size.y, "pixel ({x}, {y}) lies outside a picture of {} x {}", size.x, size.y);
    y as usize * size.x as usize + x as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    fn four_by_three() -> Picture {
        Picture::new(UVec2::new(4, 3), (0..12).map(|i| [i, 0, 0]).collect()).unwrap()
    }

    #[test]
    fn pixels_count_along_rows_from_the_top_left() {
        let picture = four_by_three();
        assert_eq!(picture.pixel(0, 0), [0, 0, 0]);
        assert_eq!(picture.pixel(3, 1), [7, 0, 0]);
        assert_eq!(picture.rows().len(), 3);
    }

    #[test]
    fn a_crop_keeps_what_is_inside() {
        let crop = four_by_three().crop(PixelRect { min: UVec2::new(1, 1), max: UVec2::new(3, 3) }).unwrap();
        assert_eq!(crop.size(), UVec2::new(2, 2));
        assert_eq!(crop.pixels(), [[5, 0, 0], [6, 0, 0], [9, 0, 0], [10, 0, 0]]);
    }

    #[test]
    fn a_crop_of_nothing_or_beyond_the_picture_is_none() {
        let picture = four_by_three();
        assert!(picture.crop(PixelRect { min: UVec2::new(2, 1), max: UVec2::new(2, 3) }).is_none());
        assert!(picture.crop(PixelRect { min: UVec2::new(3, 3), max: UVec2::new(1, 1) }).is_none());
        assert!(picture.crop(PixelRect { min: UVec2::ZERO, max: UVec2::new(5, 3) }).is_none());
    }

    #[test]
    fn pixels_must_fill_the_size() {
        assert!(Picture::new(UVec2::new(2, 2), vec![[0; 3]; 3]).is_err());
        assert!(Picture::new(UVec2::ZERO, Vec::new()).is_err());
    }

    #[test]
    #[should_panic(expected = "pixel (4, 0) lies outside a picture of 4 x 3")]
    fn a_column_too_far_right_is_not_the_next_row() {
        let _ = four_by_three().pixel(4, 0);
    }
}
