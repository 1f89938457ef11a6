//! Texture maps: what each component shows directly, with its coverage; and the lift that makes them add up.

use glam::IVec2;

use super::beyond::folded;
use super::coverage::{Coverage, is_above_contact};
use super::reflection::composite;
use super::zones::Zones;
use super::{Grid, Layer, lift};
use crate::picture::Picture;
use crate::picture::color::srgb_from_linear;
use crate::scene::Role;
use crate::scene::TourScene;

/// A component's texture map before the lift: the picture where it shows the component alone, the fill elsewhere.
pub(super) fn texture_map(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    colors: &Grid<[f32; 3]>,
    index: usize,
) -> Layer {
    Layer::from_fn(colors.origin, colors.size, |pixel| {
        let [r, g, b] = if coverage.is_pure(index, pixel) {
            picture.pixel(pixel.x as u32, pixel.y as u32)
        } else {
            colors.get(pixel).unwrap_or_default().map(srgb_from_linear)
        };
        let alpha = layer_alpha(scene, coverage, index, pixel);
        [r, g, b, alpha]
    })
}

/// A layer's coverage at a pixel, 0–255; framework planes beyond the picture have that of the pixel folded there.
pub(super) fn layer_alpha(scene: &TourScene, coverage: &Coverage, index: usize, pixel: IVec2) -> u8 {
    let alpha = &coverage.alpha[index];
    alpha.get(pixel).unwrap_or_else(|| {
        let inside = folded(pixel, scene.camera.intrinsics.size);
        match scene.components[index].role {
            Role::Billboard | Role::Band => 0,
            Role::LastLayer if is_above_contact(scene, 0, pixel) => 255,
            // What is above the contact line there may hang under it here.
            Role::LastLayer if coverage.above.get(inside).unwrap_or(false) => 0,
            Role::LastLayer | Role::Ground => alpha.get(inside).unwrap_or(0),
        }
    })
}

/// Raises the nearest layer at every pixel until the first view shows the picture.
pub(super) fn lift_textures(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    zones: &Zones,
    textures: &mut [Layer],
    reflections: &[Option<Layer>],
) {
    let mut order = scene.near_to_far(scene.camera.pose.position);
    order.reverse();
    let edits = {
        let textures = &*textures;
        Grid::from_fn(IVec2::ZERO, picture.size(), |pixel| {
            let covers = |&&index: &&usize| coverage.grown[index].get(pixel).unwrap_or(0) > 0;
            let nearest = *order.iter().rev().find(covers)?;
            let above = coverage.above.get(pixel).unwrap_or(true);
            let mut behind =
                if above { [0.0; 3] } else { composite(reflections, &zones.stack_at(scene, pixel), pixel)? };
            for &index in order.iter().take_while(|&&index| index != nearest) {
                if let Some(texel) = textures[index].get(pixel) {
                    behind = lift::over(texel, behind);
                }
            }
            let target = picture.pixel(pixel.x as u32, pixel.y as u32);
            let alpha = textures[nearest].get(pixel)?[3];
            Some((nearest, lift::lifted(target, behind, alpha)))
        })
    };
    for (cell, edit) in edits.cells.iter().enumerate() {
        if let Some((nearest, texel)) = edit
            && let Some(at) = textures[*nearest].index(edits.pixel(cell))
        {
            textures[*nearest].cells[at] = *texel;
        }
    }
}

/// How much of a layer's coverage the lift added, mean over the texels it shows.
pub(super) fn mean_lift(layer: &Layer, before: &Grid<u8>) -> f32 {
    let (mut sum, mut count) = (0.0, 0);
    for (cell, texel) in layer.cells.iter().enumerate() {
        if let Some(own) = before.get(layer.pixel(cell)).filter(|_| texel[3] > 0) {
            sum += f32::from(texel[3].saturating_sub(own)) / 255.0;
            count += 1;
        }
    }
    if count > 0 { sum / count as f32 } else { 0.0 }
}
