//! Pictures and masks at another size.

use glam::UVec2;
use image::imageops::{FilterType, resize, thumbnail};
use image::{ImageBuffer, Luma, Rgb};

use super::{Mask, Picture};

impl Picture {
    /// Averages of the codes over what each pixel of a smaller size covers.
    pub(crate) fn shrunk_to(&self, size: UVec2) -> Self {
        let whole = self.size();
        let view = ImageBuffer::<Rgb<u8>, _>::from_raw(whole.x, whole.y, self.pixels().as_flattened());
        let small = view.map(|view| thumbnail(&view, size.x.max(1), size.y.max(1)));
        let pixels = small.map(|small| small.pixels().map(|pixel| pixel.0).collect());
        pixels.and_then(|pixels| Self::new(size.max(UVec2::ONE), pixels).ok()).unwrap_or_else(|| self.clone())
    }
}

impl Mask {
    /// Averages of the coverage over what each pixel of a smaller size covers.
    pub(crate) fn shrunk_to(&self, size: UVec2) -> Self {
        self.resized(size, |view, size| thumbnail(view, size.x, size.y))
    }

    /// The coverage between the pixels, linearly, at a larger size.
    pub(crate) fn enlarged_to(&self, size: UVec2) -> Self {
        self.resized(size, |view, size| resize(view, size.x, size.y, FilterType::Triangle))
    }

    fn resized(
        &self,
        size: UVec2,
        to: impl Fn(&ImageBuffer<Luma<u8>, &[u8]>, UVec2) -> ImageBuffer<Luma<u8>, Vec<u8>>,
    ) -> Self {
        let (whole, size) = (self.size(), size.max(UVec2::ONE));
        let view = ImageBuffer::<Luma<u8>, _>::from_raw(whole.x, whole.y, self.values());
        let other = view.and_then(|view| Self::new(size, to(&view, size).into_raw()).ok());
        // Buffers have the sizes that are asked for.
        other.unwrap_or_else(|| self.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_averaged_and_a_mask_keeps_its_coverage() {
        let size = UVec2::new(12, 6);
        let pixels = (0..72).map(|i| if i % 3 == 0 { [90, 30, 0] } else { [0, 30, 255] }).collect();
        let small = Picture::new(size, pixels).unwrap().shrunk_to(UVec2::new(4, 2));
        assert_eq!((small.size(), small.pixel(3, 1)), (UVec2::new(4, 2), [30, 30, 170]));
        let values = (0..72).map(|i| if i % 12 < 6 { 255 } else { 0 }).collect();
        let mask = Mask::new(size, values).unwrap();
        let small = mask.shrunk_to(UVec2::new(4, 2));
        assert_eq!(small.values(), [255, 255, 0, 0, 255, 255, 0, 0]);
        let large = small.enlarged_to(size);
        assert_eq!((large.size(), large.get(1, 3), large.get(10, 3)), (size, 255, 0));
        assert!((large.get(5, 3) + large.get(6, 3)).abs_diff(255) <= 2, "{:?}", large.values());
    }
}
