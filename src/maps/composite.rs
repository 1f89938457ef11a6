//! Reflection maps over each other: at every water pixel of the first view they are the picture.

use glam::IVec2;

use super::coverage::Coverage;
use super::zones::Zones;
use super::{Grid, Layer, lift};
use crate::picture::Picture;
use crate::picture::color::{linear_from_srgb, srgb_from_linear};
use crate::scene::{Role, TourScene};

/// Sees to it that the layers over each other show the picture at every water pixel.
///
/// Around a billboard's mirror image what nothing explains stays with the backdrop behind it, so that a boat that sails
/// away takes no rim of old water along; elsewhere, and where colors end, the nearest mirror image is raised.
pub(super) fn lift_reflections(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    zones: &Zones,
    layers: &mut [Option<Layer>],
) {
    let edits = {
        let layers = &*layers;
        Grid::from_fn(IVec2::ZERO, picture.size(), |pixel| {
            if !coverage.water.get(pixel).unwrap_or(false) {
                return [None; 2];
            }
            let target = picture.pixel(pixel.x as u32, pixel.y as u32);
            let lifted = |mut stack: Vec<usize>| {
                let nearest = stack.pop()?;
                let alpha = layers[nearest].as_ref()?.get(pixel)?[3];
                let kept = (scene.components[nearest].role == Role::Billboard)
                    .then(|| left_behind(layers, nearest, &stack, pixel, target))
                    .flatten();
                let behind = match kept {
                    Some((_, [r, g, b, _])) => [r, g, b].map(linear_from_srgb),
                    None => composite(layers, &stack, pixel)?,
                };
                Some([kept, Some((nearest, lift::lifted(target, behind, alpha)))])
            };
            lifted(zones.stack_at(scene, pixel)).unwrap_or([None; 2])
        })
    };
    for (cell, texels) in edits.cells.iter().enumerate() {
        for (index, texel) in texels.iter().flatten() {
            if let Some(layer) = &mut layers[*index]
                && let Some(at) = layer.index(edits.pixel(cell))
            {
                layer.cells[at] = *texel;
            }
        }
    }
}

/// A mirror image covers no more than this of a texel whose rest is left to what lies behind it: beyond, rounding would be
/// made large.
const MOST_LEFT: f32 = 0.6;
/// How far from a texel its mirror image is asked for its own color, pixels.
const OWN_REACH: i32 = 4;

/// The opaque layer behind a billboard's mirror image, and the texel it must have for the picture to be seen there through
/// the mirror image's own color; `None` where there is none.
fn left_behind(
    layers: &[Option<Layer>],
    nearest: usize,
    far_to_near: &[usize],
    pixel: IVec2,
    target: [u8; 3],
) -> Option<(usize, [u8; 4])> {
    let layer = layers[nearest].as_ref()?;
    let alpha = f32::from(layer.get(pixel)?[3]) / 255.0;
    let under = far_to_near.last().copied().unwrap_or(0);
    if alpha > MOST_LEFT || (under != 0 && layers[under].as_ref()?.get(pixel)?[3] < 255) {
        return None;
    }
    if alpha == 0.0 {
        return Some((under, [target[0], target[1], target[2], 255]));
    }
    let own = own_color(layer, pixel)?;
    let rest: [f32; 3] =
        std::array::from_fn(|c| (linear_from_srgb(target[c]) - alpha * own[c]) / (1.0 - alpha));
    let [r, g, b] = rest.map(srgb_from_linear);
    rest.iter().all(|value| (0.0..=1.0).contains(value)).then_some((under, [r, g, b, 255]))
}

/// The color of the nearest texel that a layer covers wholly, linear light.
fn own_color(layer: &Layer, pixel: IVec2) -> Option<[f32; 3]> {
    let around =
        (-OWN_REACH..=OWN_REACH).flat_map(|y| (-OWN_REACH..=OWN_REACH).map(move |x| IVec2::new(x, y)));
    around
        .filter_map(|step| Some((step.length_squared(), layer.get(pixel + step)?)))
        .filter(|(_, texel)| texel[3] == 255)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, [r, g, b, _])| [r, g, b].map(linear_from_srgb))
}

/// What the water shows at a pixel of the first view: reflection layers over each other, linear light.
pub(super) fn composite(layers: &[Option<Layer>], far_to_near: &[usize], pixel: IVec2) -> Option<[f32; 3]> {
    let [r, g, b, _] = layers[0].as_ref()?.get(pixel)?;
    let mut color = [r, g, b].map(linear_from_srgb);
    for &index in far_to_near {
        if let Some(texel) = layers[index].as_ref().and_then(|layer| layer.get(pixel)) {
            color = lift::over(texel, color);
        }
    }
    Some(color)
}
