//! Layers with their mip levels, for views that show them smaller than the picture did.
//!
//! A texel of level k stands for 2^k × 2^k texels of the layer, counted from its first one; the last may stand for fewer.
//! Colors of a layer are straight, those of its levels premultiplied (notes §5.6), both as sRGB codes of linear light: graphics
//! cards interpolate levels as they are stored, and what covers nearly nothing, in whatever color, must not tint what is beside
//! it. What covers nothing at all is black there.

use glam::{DVec2, IVec2, UVec2, Vec4};
use rayon::prelude::*;

use super::grid::snap;
use super::{Grid, Layer};
use crate::picture::PicturePoint;
use crate::picture::color::linear_from_srgb;
use crate::picture::color::srgb_from_linear;

/// How many times a layer is halved.
pub const MIP_LEVELS: usize = 4;

/// Pixels by which a layer's borders are prolonged on every side: a texel of the coarsest level. Maps are prolonged where they
/// are read too, and what covers something just inside a transparent border must not get into that.
pub const GUTTER: u32 = 1 << MIP_LEVELS;

/// A layer and what remains of it when it is halved [`MIP_LEVELS`] times.
#[derive(Clone, Debug, PartialEq)]
pub struct Mipmapped {
    /// The layer itself, in the picture's pixels.
    pub layer: Layer,
    /// Levels 1 to [`MIP_LEVELS`], premultiplied; cells are counted from the layer's first, and origins mean nothing.
    pub coarser: Vec<Layer>,
}

/// Size of level `level` of a layer of a size: halves are rounded up.
#[must_use]
pub fn mip_size(size: UVec2, level: usize) -> UVec2 {
    UVec2::new(size.x.div_ceil(1 << level), size.y.div_ceil(1 << level))
}

/// The level to read where a screen pixel covers `texels` texels along a side. Up to 1.15 it is the layer itself, from 2
/// on the level whose texels are as large; between, the two are mixed. Twin of `mip_level` in `tour.wgsl`.
#[must_use]
pub fn mip_level(texels: f64) -> f32 {
    let octaves = texels.log2() as f32;
    let level = if octaves >= 1.0 { octaves } else { 1.25 * (octaves - 0.2) };
    level.clamp(0.0, MIP_LEVELS as f32)
}

impl From<Layer> for Mipmapped {
    /// The layer, prolonged by a [`GUTTER`] on all sides, and its levels.
    fn from(layer: Layer) -> Self {
        Self::with_gutters(&layer, |_, _| {})
    }
}

impl Mipmapped {
    /// A layer as it is, and its levels.
    #[must_use]
    pub fn levels_of(layer: Layer) -> Self {
        Self::mended(layer, |_, _| {})
    }

    /// The layer, prolonged by a [`GUTTER`] on all sides, and its levels, each mended by `mend` (called with the level from 1
    /// on and its cells, whose first is that of the layer) before it is halved.
    #[must_use]
    pub(super) fn with_gutters(layer: &Layer, mend: impl Fn(usize, &mut Layer)) -> Self {
        Self::mended(with_gutters(layer), mend)
    }

    fn mended(layer: Layer, mend: impl Fn(usize, &mut Layer)) -> Self {
        let mut coarser: Vec<Layer> = Vec::with_capacity(MIP_LEVELS);
        for level in 1..=MIP_LEVELS {
            let mut next = match coarser.last() {
                Some(finer) => halved(finer, linear),
                None => halved(&layer, |texel| premultiplied(linear(texel))),
            };
            mend(level, &mut next);
            coarser.push(next);
        }
        Self { layer, coarser }
    }

    /// The columns of a layer with gutters from `first` on, a multiple of [`GUTTER`], and of its levels: `width` of them, or as
    /// many as there are, at least one.
    #[must_use]
    pub(crate) fn columns(&self, first: u32, width: u32) -> Self {
        let first = first.min((self.layer.size.x.max(1) - 1) / GUTTER * GUTTER);
        let width = width.clamp(1, (self.layer.size.x - first).max(1));
        let cut = |level: usize| {
            let from = self.level(level);
            let size = mip_size(UVec2::new(width, self.layer.size.y), level);
            let origin = from.origin + IVec2::new(first as i32, 0);
            let start = IVec2::new((first >> level) as i32, 0) - origin;
            Layer::from_fn(origin, size, |pixel| from.get(pixel + start + from.origin).unwrap_or_default())
        };
        Self { layer: cut(0), coarser: (1..=MIP_LEVELS).map(cut).collect() }
    }

    /// Level `level`, 0 being the layer itself.
    ///
    /// # Panics
    ///
    /// For levels above [`MIP_LEVELS`].
    #[must_use]
    pub fn level(&self, level: usize) -> &Layer {
        if level == 0 { &self.layer } else { &self.coarser[level - 1] }
    }

    /// Linear-light color and straight coverage at a point of the picture, read at a level from [`mip_level`]. Twin of
    /// `sharp` in `tour.wgsl`.
    #[must_use]
    pub fn sample(&self, point: PicturePoint, level: f32) -> [f32; 4] {
        if level <= 0.0 {
            return self.layer.sample(point);
        }
        let whole = (level.floor() as usize).min(MIP_LEVELS - 1);
        // Half a texel of the coarsest level that is read stays between the place and the border.
        let coarsest = (whole + 1).min(level.ceil() as usize);
        let margin = DVec2::splat(0.5 * f64::from(1_u32 << coarsest));
        let limit = (mip_size(self.layer.size, coarsest) << coarsest as u32).as_dvec2();
        let at = (snap(point).0 - self.layer.origin.as_dvec2()).clamp(margin, limit - margin);
        let finer = match whole {
            0 => premultiplied(Vec4::from(self.layer.sample(point))),
            _ => bilinear(self.level(whole), at / f64::from(1_u32 << whole)),
        };
        let coarser = bilinear(self.level(whole + 1), at / f64::from(2_u32 << whole));
        straight(finer.lerp(coarser, level - whole as f32)).to_array()
    }
}

/// Straight coverage from premultiplied; what covers nothing is black.
fn straight(texel: Vec4) -> Vec4 {
    (texel / texel.w.max(1e-6)).min(Vec4::ONE).with_w(texel.w)
}

fn premultiplied(texel: Vec4) -> Vec4 {
    (texel.w * texel).with_w(texel.w)
}

/// The mean of the four texels around a place; the border is prolonged.
fn bilinear(layer: &Layer, at: DVec2) -> Vec4 {
    let corner = (at - 0.5).floor();
    let part = (at - 0.5 - corner).as_vec2();
    let corner = corner.as_ivec2();
    let texel = |x: i32, y: i32| {
        let cell = (corner + IVec2::new(x, y)).clamp(IVec2::ZERO, layer.size.as_ivec2() - 1);
        linear(layer.cells[cell.y as usize * layer.size.x as usize + cell.x as usize])
    };
    texel(0, 0).lerp(texel(1, 0), part.x).lerp(texel(0, 1).lerp(texel(1, 1), part.x), part.y)
}

/// Linear light and coverage from their codes.
pub(super) fn linear([r, g, b, a]: [u8; 4]) -> Vec4 {
    Vec4::new(linear_from_srgb(r), linear_from_srgb(g), linear_from_srgb(b), f32::from(a) / 255.0)
}

fn with_gutters(layer: &Layer) -> Layer {
    let end = layer.origin + layer.size.as_ivec2() - 1;
    if layer.size.min_element() == 0 {
        return layer.clone();
    }
    Layer::from_fn(layer.origin - GUTTER as i32, layer.size + 2 * GUTTER, |pixel| {
        layer.get(pixel.clamp(layer.origin, end)).unwrap_or_default()
    })
}

/// A level of half the size, its texels premultiplied; `light_of` gives the light of those it is made from, premultiplied.
fn halved(layer: &Layer, light_of: impl Fn([u8; 4]) -> Vec4 + Sync) -> Layer {
    let size = mip_size(layer.size, 1);
    let (width, from) = (size.x as usize, layer.size);
    let mut cells = vec![[0; 4]; width * size.y as usize];
    cells.par_chunks_mut(width.max(1)).with_min_len(16).enumerate().for_each(|(row, cells)| {
        for (column, cell) in cells.iter_mut().enumerate() {
            let (mut light, mut count) = (Vec4::ZERO, 0.0);
            for y in [2 * row, 2 * row + 1].into_iter().filter(|&y| y < from.y as usize) {
                for x in [2 * column, 2 * column + 1].into_iter().filter(|&x| x < from.x as usize) {
                    light += light_of(layer.cells[y * from.x as usize + x]);
                    count += 1.0;
                }
            }
            *cell = codes(light / count);
        }
    });
    Grid { origin: layer.origin, size, cells }
}

/// Codes of light and coverage. (Nobody asks for those of no texel.)
pub(super) fn codes(light: Vec4) -> [u8; 4] {
    let [r, g, b] = [light.x, light.y, light.z].map(srgb_from_linear);
    [r, g, b, (255.0 * light.w).round() as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_half_transparent_edge_gets_no_dark_fringe() {
        // Opaque red beside transparent green: the mean is half as much red (code 188), not olive.
        let layer = Layer::from_fn(IVec2::ZERO, UVec2::new(4, 2), |pixel| {
            if (pixel.x + pixel.y) % 2 == 0 { [255, 0, 0, 255] } else { [0, 255, 0, 0] }
        });
        let map = Mipmapped::levels_of(layer);
        assert_eq!(map.coarser[0].cells, [[188, 0, 0, 128]; 2]);
        assert_eq!(map.coarser.len(), MIP_LEVELS);
    }

    #[test]
    fn a_bright_texel_that_covers_nearly_nothing_does_not_shine_between_levels() {
        // As the alpha lift leaves beside an outline: dark and opaque on the left, white at 1/255 in the column beside it.
        let layer = Layer::from_fn(IVec2::ZERO, UVec2::new(16, 4), |pixel| match pixel.x {
            0..8 => [30, 30, 30, 255],
            8..10 => [255, 255, 255, 1],
            _ => [30, 30, 30, 0],
        });
        let map = Mipmapped::levels_of(layer);
        let dark = linear_from_srgb(30);
        for level in [0.3, 0.7, 1.0, 1.5, 2.0, 3.0] {
            for x in 0..64 {
                let [r, _, _, a] = map.sample(PicturePoint::new(0.25 * f64::from(x), 2.0), level);
                let excess = a * (r - dark);
                assert!(excess < 0.006, "{excess} of white too much at {x}/4, level {level}");
            }
        }
    }

    #[test]
    fn halving_keeps_the_light() {
        // Black and white average to half of the light (code 188), not to half of the code.
        let layer = Layer::from_fn(IVec2::ZERO, UVec2::new(5, 3), |pixel| {
            let code = if (pixel.x + pixel.y) % 2 == 0 { 255 } else { 0 };
            [code, code, code, 255]
        });
        let map = Mipmapped::levels_of(layer);
        assert_eq!(map.coarser[0].size, UVec2::new(3, 2));
        assert_eq!(map.coarser[0].cells[0], [188, 188, 188, 255]);
        let [r, _, _, a] = map.sample(PicturePoint::new(2.0, 1.0), 1.0);
        assert!((r - 0.5).abs() < 0.01 && a == 1.0, "{r} of the light, coverage {a}");
    }

    #[test]
    fn nothing_of_a_layer_gets_into_its_prolonged_border() {
        // A dot one pixel inside the border.
        let layer = Layer::from_fn(IVec2::new(5, 7), UVec2::new(9, 9), |pixel| {
            [9, 9, 9, if pixel == IVec2::new(6, 11) { 255 } else { 0 }]
        });
        let map = Mipmapped::from(layer);
        assert_eq!(map.layer.origin, IVec2::new(5 - 16, 7 - 16));
        for level in [0.0, 1.0, 2.5, 4.0] {
            assert_eq!(map.sample(PicturePoint::new(-200.0, 11.5), level)[3], 0.0, "level {level}");
        }
        assert!(map.sample(PicturePoint::new(6.5, 11.5), 3.0)[3] > 0.0);
    }

    #[test]
    fn columns_keep_the_texels_of_every_level() {
        let layer = Layer::from_fn(IVec2::new(-40, 3), UVec2::new(200, 33), |pixel| {
            [(pixel.x * 7 + pixel.y * 3) as u8, 0, pixel.y as u8, 255]
        });
        let whole = Mipmapped::from(layer);
        let part = whole.columns(48, 100);
        assert_eq!(
            (part.layer.origin, part.layer.size),
            (IVec2::new(-40 - 16 + 48, 3 - 16), UVec2::new(100, 65))
        );
        for level in [0.0, 1.0, 2.0, 2.5] {
            let at = PicturePoint::new(31.3, 17.2);
            assert_eq!(part.sample(at, level), whole.sample(at, level), "level {level}");
        }
        let last = whole.columns(1000, 1000);
        assert_eq!((last.layer.origin.x, last.layer.size.x), (-56 + 224, 232 - 224));
    }

    #[test]
    fn the_first_view_reads_the_layer_itself() {
        assert_eq!(mip_level(1.0), 0.0);
        assert_eq!(mip_level(0.3), 0.0);
        assert_eq!(mip_level(0.0), 0.0);
        assert!((mip_level(2.0) - 1.0).abs() < 1e-6 && (mip_level(1.99) - 0.99).abs() < 0.02);
        assert_eq!(mip_level(1e9), MIP_LEVELS as f32);
    }
}
