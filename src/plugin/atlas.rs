//! All reflection maps in one texture, so that the water's shader binds one.
//!
//! Maps keep their pixels unless the device's largest texture is too small; then all are scaled alike and the first
//! view is no longer exact, which the caller is told.

use bevy::math::{IVec2, UVec2};

use crate::maps::Layer;

/// Where a map lies in the atlas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Its first texel.
    pub at: UVec2,
    /// Texels per picture pixel, 1 unless everything had to be scaled.
    pub scale: f32,
}

/// A packed atlas.
pub(super) struct Atlas {
    /// Width and height in texels.
    pub size: UVec2,
    /// sRGB codes with straight coverage, row by row.
    pub texels: Vec<[u8; 4]>,
    /// One entry a layer, `None` where there was none.
    pub places: Vec<Option<Place>>,
    /// Texels per picture pixel.
    pub scale: f32,
}

/// Packs layers in shelves, the tallest first, into a texture of at most `largest` texels a side.
pub(super) fn pack(layers: &[Option<&Layer>], largest: u32) -> Atlas {
    let mut scale = 1.0_f32;
    loop {
        let sizes: Vec<Option<UVec2>> =
            layers.iter().map(|layer| layer.map(|layer| scaled_size(layer.size, scale))).collect();
        // Nearly square first; as wide as may be before anything is scaled.
        let area: f64 = sizes.iter().flatten().map(|size| f64::from(size.x) * f64::from(size.y)).sum();
        let found = shelves(&sizes, (area.sqrt() as u32).min(largest), largest);
        if let Some((size, places)) = found.or_else(|| shelves(&sizes, largest, largest)) {
            let mut texels = vec![[0; 4]; size.x as usize * size.y as usize];
            for (layer, at) in layers.iter().zip(&places) {
                if let (Some(layer), Some(at)) = (layer, at) {
                    copy(layer, scale, *at, size, &mut texels);
                }
            }
            let places = places.into_iter().map(|at| at.map(|at| Place { at, scale })).collect();
            return Atlas { size, texels, places, scale };
        }
        scale *= 0.8;
    }
}

pub(super) fn scaled_size(size: UVec2, scale: f32) -> UVec2 {
    (size.as_vec2() * scale).round().as_uvec2().max(UVec2::ONE)
}

/// Places for rectangles on shelves of a wanted width, and the size they need; `None` when they do not fit.
fn shelves(sizes: &[Option<UVec2>], wanted: u32, largest: u32) -> Option<(UVec2, Vec<Option<UVec2>>)> {
    let mut order: Vec<usize> = (0..sizes.len()).filter(|&index| sizes[index].is_some()).collect();
    order.sort_by_key(|&index| std::cmp::Reverse(sizes[index].map_or(0, |size| size.y)));
    let widest = sizes.iter().flatten().map(|size| size.x).max().unwrap_or(1);
    let width = widest.max(wanted).min(largest);
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

fn copy(layer: &Layer, scale: f32, at: UVec2, size: UVec2, texels: &mut [[u8; 4]]) {
    let scaled = scaled_layer(layer, scale);
    let (width, rows) = (scaled.0.x as usize, scaled.1.chunks_exact(scaled.0.x as usize));
    for (row, source) in rows.enumerate() {
        let start = (at.y as usize + row) * size.x as usize + at.x as usize;
        texels[start..start + width].copy_from_slice(source);
    }
}

/// A layer without as much of its left and right end as makes it fit a device's largest texture: what lies beyond the
/// picture's border goes first, before anything has to be scaled.
pub(super) fn trimmed(layer: &Layer, picture: UVec2, largest: u32) -> std::borrow::Cow<'_, Layer> {
    if layer.size.x <= largest || picture.x > largest {
        return std::borrow::Cow::Borrowed(layer);
    }
    let beside = (largest - picture.x) as i32 / 2;
    let low = layer.origin.x.max(-beside);
    let high = (layer.origin.x + layer.size.x as i32).min(picture.x as i32 + beside).max(low + 1);
    let origin = IVec2::new(low, layer.origin.y);
    let size = UVec2::new((high - low) as u32, layer.size.y);
    std::borrow::Cow::Owned(Layer::from_fn(origin, size, |pixel| layer.get(pixel).unwrap_or([0; 4])))
}

/// A layer's texels at another scale, averaged in premultiplied linear light; the texels themselves at scale 1.
pub(super) fn scaled_layer(layer: &Layer, scale: f32) -> (UVec2, std::borrow::Cow<'_, [[u8; 4]]>) {
    use crate::picture::PicturePoint;
    use crate::picture::color::srgb_from_linear;
    if scale == 1.0 {
        return (layer.size, (&layer.cells).into());
    }
    let size = scaled_size(layer.size, scale);
    let texels = (0..size.y)
        .flat_map(|y| (0..size.x).map(move |x| UVec2::new(x, y)))
        .map(|texel| {
            // Four taps spread over the texel's area.
            let mut sum = [0.0_f32; 4];
            for tap in [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)] {
                let at = (texel.as_dvec2() + bevy::math::DVec2::from(tap)) / f64::from(scale);
                let origin: IVec2 = layer.origin;
                let [r, g, b, a] = layer.sample(PicturePoint(at + origin.as_dvec2()));
                sum = [sum[0] + a * r, sum[1] + a * g, sum[2] + a * b, sum[3] + a];
            }
            let weight = sum[3].max(1e-6);
            let [r, g, b] = [sum[0], sum[1], sum[2]].map(|x| srgb_from_linear(x / weight));
            [r, g, b, (sum[3] * 0.25 * 255.0).round() as u8]
        })
        .collect();
    (size, texels)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layer(width: u32, height: u32, code: u8) -> Layer {
        Layer::filled(IVec2::ZERO, UVec2::new(width, height), [code, code, code, 255])
    }

    #[test]
    fn every_texel_of_every_layer_arrives_once() {
        let layers = [layer(100, 40, 1), layer(30, 60, 2), layer(7, 3, 3)];
        let atlas = pack(&[Some(&layers[0]), None, Some(&layers[1]), Some(&layers[2])], 2048);
        assert_eq!(atlas.scale, 1.0);
        assert_eq!(atlas.places[1], None);
        for (code, count) in [(1, 4000), (2, 1800), (3, 21)] {
            let found = atlas.texels.iter().filter(|texel| texel[0] == code).count();
            assert_eq!(found, count, "texels of layer {code}");
        }
    }

    #[test]
    fn what_is_too_large_is_scaled_until_it_fits() {
        let big = layer(300, 200, 9);
        let atlas = pack(&[Some(&big), Some(&big)], 256);
        assert!(atlas.scale < 1.0 && atlas.size.max_element() <= 256, "{} at {}", atlas.size, atlas.scale);
        assert!(atlas.texels.contains(&[9, 9, 9, 255]));
    }
}
