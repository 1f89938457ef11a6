//! Layers as textures: padded, with mip levels, and all reflection maps in one, so that the water's shader binds one.
//!
//! Maps keep their pixels unless the device's largest texture is too small; then all are scaled alike and the first
//! view is no longer exact, which the caller is told. Each map's block is a multiple of [`BLOCK`] texels, so that the
//! texels of its mip levels are its own.

use std::borrow::Cow;

use bevy::math::UVec2;

use crate::maps::{Layer, MIP_LEVELS, Mipmapped};

/// Texels of the layer that a texel of the coarsest mip level stands for, along a side.
const BLOCK: u32 = 1 << MIP_LEVELS;

/// Where a map lies in the atlas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Its first texel, a multiple of [`BLOCK`].
    pub at: UVec2,
    /// Texels per picture pixel, 1 unless everything had to be scaled.
    pub scale: f32,
}

/// A packed atlas.
pub(super) struct Atlas {
    pub texture: Texels,
    /// One entry a layer, `None` where there was none.
    pub places: Vec<Option<Place>>,
    /// Texels per picture pixel.
    pub scale: f32,
}

/// A texture's texels.
pub(super) struct Texels {
    /// Width and height, multiples of [`BLOCK`].
    pub size: UVec2,
    /// Mip levels, fine to coarse: sRGB codes with straight coverage, row by row.
    pub levels: Vec<Vec<[u8; 4]>>,
}

/// Packs maps in shelves, the tallest first, into a texture of at most `largest` texels a side.
pub(super) fn pack(maps: &[Option<&Mipmapped>], largest: u32) -> Atlas {
    let mut scale = 1.0_f32;
    loop {
        let sizes: Vec<Option<UVec2>> =
            maps.iter().map(|map| map.map(|map| padded(scaled_size(map.layer.size, scale)))).collect();
        // Nearly square first; as wide as may be before anything is scaled.
        let area: f64 = sizes.iter().flatten().map(|size| f64::from(size.x) * f64::from(size.y)).sum();
        let found = shelves(&sizes, (area.sqrt() as u32).min(largest), largest);
        if let Some((size, places)) = found.or_else(|| shelves(&sizes, largest, largest)) {
            let mut texture = Texels::new(size);
            for (map, at) in maps.iter().zip(&places) {
                if let (Some(map), Some(at)) = (map, at) {
                    texture.put(&scaled(map, scale), *at);
                }
            }
            let places = places.into_iter().map(|at| at.map(|at| Place { at, scale })).collect();
            return Atlas { texture, places, scale };
        }
        scale *= 0.8;
    }
}

impl Texels {
    /// One map alone, scaled where a device's textures of `largest` texels a side cannot hold it; and texels per picture
    /// pixel.
    pub(super) fn of(map: &Mipmapped, largest: u32) -> (Self, f32) {
        let longest = map.layer.size.max_element();
        let scale = if longest > largest { largest as f32 / longest as f32 } else { 1.0 };
        let map = scaled(map, scale);
        let mut texture = Self::new(padded(map.layer.size));
        texture.put(&map, UVec2::ZERO);
        (texture, scale)
    }

    fn new(size: UVec2) -> Self {
        let count = size.x as usize * size.y as usize;
        Self { size, levels: (0..=MIP_LEVELS).map(|level| vec![[0; 4]; count >> (2 * level)]).collect() }
    }

    /// Copies a map's levels to a place; what its block has beyond the map prolongs the map's border.
    fn put(&mut self, map: &Mipmapped, at: UVec2) {
        let block = padded(map.layer.size);
        for (level, texels) in self.levels.iter_mut().enumerate() {
            let from = map.level(level);
            let (width, own) = ((self.size.x >> level) as usize, from.size.x as usize);
            let [at, block] = [at, block].map(|size| UVec2::new(size.x >> level, size.y >> level));
            for row in 0..block.y {
                let source = row.min(from.size.y - 1) as usize * own;
                let start = (at.y + row) as usize * width + at.x as usize;
                let (texels, source) =
                    (&mut texels[start..start + block.x as usize], &from.cells[source..source + own]);
                texels[..own].copy_from_slice(source);
                texels[own..].fill(source[own - 1]);
            }
        }
    }
}

/// A size rounded up to whole blocks.
fn padded(size: UVec2) -> UVec2 {
    UVec2::new(size.x.next_multiple_of(BLOCK), size.y.next_multiple_of(BLOCK))
}

fn scaled_size(size: UVec2, scale: f32) -> UVec2 {
    (size.as_vec2() * scale).round().as_uvec2().max(UVec2::ONE)
}

/// Places for rectangles on shelves of a wanted width, and the size they need; `None` when they do not fit.
fn shelves(sizes: &[Option<UVec2>], wanted: u32, largest: u32) -> Option<(UVec2, Vec<Option<UVec2>>)> {
    let mut order: Vec<usize> = (0..sizes.len()).filter(|&index| sizes[index].is_some()).collect();
    order.sort_by_key(|&index| std::cmp::Reverse(sizes[index].map_or(0, |size| size.y)));
    let widest = sizes.iter().flatten().map(|size| size.x).max().unwrap_or(1);
    let width = widest.max(wanted).next_multiple_of(BLOCK).min(largest / BLOCK * BLOCK);
    let mut places = vec![None; sizes.len()];
    let (mut at, mut shelf) = (UVec2::ZERO, 0);
    for index in order {
        let Some(size) = sizes[index] else { continue };
        if at.x + size.x > width {
            at = UVec2::new(0, at.y + shelf);
            shelf = 0;
        }
        if size.x > width {
            return None;
        }
        places[index] = Some(at);
        at.x += size.x;
        shelf = shelf.max(size.y);
    }
    let height = (at.y + shelf).max(1);
    (height <= largest).then_some((UVec2::new(width.max(1), height), places))
}

/// A map without as much of its left and right end as makes it fit a device's largest texture: what lies beyond the
/// picture's border goes first, before anything has to be scaled.
pub(super) fn trimmed(map: &Mipmapped, picture: UVec2, largest: u32) -> Cow<'_, Mipmapped> {
    let layer = &map.layer;
    if layer.size.x <= largest || picture.x > largest {
        return Cow::Borrowed(map);
    }
    let beside = ((largest - picture.x) / 2) as i32;
    // Texels of every level are kept whole, so it begins at a block's; what the picture shows itself must stay.
    let first = (-beside - layer.origin.x).max(0) as u32 / BLOCK * BLOCK;
    let width = largest / BLOCK * BLOCK;
    let [begin, end] = [0, picture.x as i32].map(|x| (x - layer.origin.x).max(0) as u32);
    let holds = |first: &u32| *first <= begin && first + width >= end;
    match [first, first + BLOCK].into_iter().find(holds) {
        Some(first) => Cow::Owned(map.columns(first, width)),
        None => Cow::Borrowed(map),
    }
}

/// A map at another scale, averaged in premultiplied linear light; the map itself at scale 1. Its levels are new ones, in
/// which seams do not go on.
fn scaled(map: &Mipmapped, scale: f32) -> Cow<'_, Mipmapped> {
    use crate::picture::PicturePoint;
    use crate::picture::color::srgb_from_linear;
    if scale == 1.0 {
        return Cow::Borrowed(map);
    }
    let layer = &map.layer;
    let scaled = Layer::from_fn(layer.origin, scaled_size(layer.size, scale), |pixel| {
        let texel = (pixel - layer.origin).as_dvec2();
        // Four taps spread over the texel's area.
        let mut sum = [0.0_f32; 4];
        for tap in [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)] {
            let at = (texel + bevy::math::DVec2::from(tap)) / f64::from(scale);
            let [r, g, b, a] = layer.sample(PicturePoint(at + layer.origin.as_dvec2()));
            sum = [sum[0] + a * r, sum[1] + a * g, sum[2] + a * b, sum[3] + a];
        }
        let weight = sum[3].max(1e-6);
        let [r, g, b] = [sum[0], sum[1], sum[2]].map(|x| srgb_from_linear(x / weight));
        [r, g, b, (sum[3] * 0.25 * 255.0).round() as u8]
    });
    // Its gutters are in it already.
    Cow::Owned(Mipmapped::levels_of(scaled))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maps::GUTTER;
    use bevy::math::IVec2;

    fn map(width: u32, height: u32, code: u8) -> Mipmapped {
        Mipmapped::levels_of(Layer::filled(IVec2::ZERO, UVec2::new(width, height), [code, code, code, 255]))
    }

    #[test]
    fn every_map_fills_its_blocks_in_every_level() {
        let maps = [map(100, 40, 1), map(30, 60, 2), map(7, 3, 3)];
        let atlas = pack(&[Some(&maps[0]), None, Some(&maps[1]), Some(&maps[2])], 2048);
        assert_eq!(atlas.scale, 1.0);
        assert_eq!(atlas.places[1], None);
        for (code, count) in [(1, 112 * 48), (2, 32 * 64), (3, 16 * 16)] {
            for (level, texels) in atlas.texture.levels.iter().enumerate() {
                let found = texels.iter().filter(|texel| texel[0] == code).count();
                assert_eq!(found, count >> (2 * level), "texels of map {code} in level {level}");
            }
        }
    }

    #[test]
    fn what_is_trimmed_keeps_all_that_the_picture_shows() {
        for (wide, beyond) in [(200, 40), (240, 37), (250, 41), (255, 33), (256, 48)] {
            let origin = IVec2::new(-beyond, 0);
            let size = UVec2::new(wide + 2 * beyond as u32, 20);
            let map = Mipmapped::from(Layer::filled(origin, size, [1, 2, 3, 255]));
            let found = trimmed(&map, UVec2::new(wide, 20), 256);
            let (left, right) = (found.layer.origin.x, found.layer.origin.x + found.layer.size.x as i32);
            assert!(left <= 0 && right >= wide as i32, "{left} to {right} of a picture {wide} px wide");
            assert!(found.layer.size.x <= 256 || wide > 240, "{} px for {wide}", found.layer.size.x);
        }
    }

    #[test]
    fn what_is_too_large_is_scaled_until_it_fits() {
        let big = map(300, 200, 9);
        let atlas = pack(&[Some(&big), Some(&big)], 256);
        let size = atlas.texture.size;
        assert!(atlas.scale < 1.0 && size.max_element() <= 256, "{size} at {}", atlas.scale);
        assert!(atlas.texture.levels[0].contains(&[9, 9, 9, 255]));
        // One with gutters, alone: a texture no larger than allowed, and texels where the scale says.
        let dot = Layer::from_fn(IVec2::ZERO, UVec2::splat(300), |pixel| {
            [9, 9, 9, if pixel == IVec2::splat(150) { 255 } else { 0 }]
        });
        let (texture, scale) = Texels::of(&dot.into(), 256);
        assert!(texture.size.max_element() <= 256, "{}", texture.size);
        let at = ((150.5 + GUTTER as f32) * scale) as usize;
        assert!(texture.levels[0][at * texture.size.x as usize + at][3] > 0, "nothing at {at}");
    }
}
