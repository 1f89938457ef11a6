//! The lines where backdrops meet the water and the ground ends at them, which run between the centers of texels.
//!
//! Above such a line one thing is seen, below it another; between the last texel of the one and the first of the other both maps
//! would fade into nothing, and what is far behind would shine through as a line. Each therefore goes on by one texel: where no
//! ray through the center of a pixel of the first view reaches it, or in the color that the picture has there.

use glam::IVec2;
use rayon::prelude::*;

use super::coverage::{Coverage, is_above_contact};
use super::{Grid, Layer};
use crate::picture::{Picture, PicturePoint};
use crate::scene::{Role, Surface, TourScene};

/// Lets the texture maps of backdrops go on below the waterline.
pub(super) fn prolong_textures(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    textures: &mut [Layer],
) {
    let order = scene.near_to_far(scene.camera.pose.position);
    for (index, layer) in textures.iter_mut().enumerate().filter(|(index, _)| has_waterline(scene, *index)) {
        let is_hidden = |pixel: IVec2| {
            let mut nearer = order.iter().take_while(|&&other| other != index);
            nearer.any(|&other| coverage.grown[other].get(pixel).is_some_and(|covered| covered > 0))
        };
        for [dry, wet] in seam(layer, |pixel| is_above_contact(scene, index, pixel)) {
            let alpha = layer.cells[dry][3];
            let pixel = layer.pixel(wet);
            let texel = &mut layer.cells[wet];
            if texel[3] >= alpha {
                continue;
            }
            if coverage.water.index(pixel).is_some() && !is_hidden(pixel) {
                let [r, g, b] = picture.pixel(pixel.x as u32, pixel.y as u32);
                *texel = [r, g, b, alpha];
            }
            texel[3] = alpha;
        }
    }
}

/// Lets the ground's texture map, once it is lifted, go on beyond the ground's far end.
pub(super) fn prolong_ground(scene: &TourScene, textures: &mut [Layer]) {
    for (index, layer) in textures.iter_mut().enumerate() {
        if scene.components[index].role == Role::Ground {
            for [far, near] in seam(layer, |pixel| is_beyond(scene, index, pixel)) {
                if layer.cells[far][3] < layer.cells[near][3] {
                    layer.cells[far] = layer.cells[near];
                }
            }
        }
    }
}

/// A backdrop's coverage, which goes on below the waterline.
pub(super) fn prolonged(scene: &TourScene, index: usize, coverage: &Grid<u8>) -> Grid<u8> {
    let mut prolonged = coverage.clone();
    for [dry, wet] in seam(coverage, |pixel| is_above_contact(scene, index, pixel)) {
        prolonged.cells[wet] = coverage.cells[wet].max(coverage.cells[dry]);
    }
    prolonged
}

/// Lets the reflection maps of backdrops go on above the waterline.
pub(super) fn prolong_reflections(scene: &TourScene, layers: &mut [Option<Layer>]) {
    for (index, layer) in layers.iter_mut().enumerate() {
        let Some(layer) = layer.as_mut().filter(|_| has_waterline(scene, index)) else { continue };
        for [dry, wet] in seam(layer, |pixel| is_above_contact(scene, index, pixel)) {
            if layer.cells[dry][3] < layer.cells[wet][3] {
                layer.cells[dry] = layer.cells[wet];
            }
        }
    }
}

fn has_waterline(scene: &TourScene, index: usize) -> bool {
    scene.water && matches!(scene.components[index].role, Role::LastLayer | Role::Band)
}

/// Whether a pixel's ray leaves a level component over its far end.
fn is_beyond(scene: &TourScene, index: usize, pixel: IVec2) -> bool {
    let Surface::Level(level) = scene.components[index].surface else { return false };
    let ray = scene.camera.ray(PicturePoint::pixel_center(pixel.x.into(), pixel.y.into()));
    level.meet_plane(ray).is_none_or(|t| ray.at(t).z < level.low.y)
}

/// Per column of a map the last cell that `is_upper` holds for, and the one below it; it holds for all cells above.
fn seam<T: Copy + Send + Sync>(layer: &Grid<T>, is_upper: impl Fn(IVec2) -> bool + Sync) -> Vec<[usize; 2]> {
    let end = layer.origin + layer.size.as_ivec2();
    (layer.origin.x..end.x)
        .into_par_iter()
        .filter_map(|x| {
            let (mut low, mut high) = (layer.origin.y, end.y);
            while low < high {
                let middle = low + (high - low) / 2;
                if is_upper(IVec2::new(x, middle)) {
                    low = middle + 1;
                } else {
                    high = middle;
                }
            }
            let (upper, lower) =
                layer.index(IVec2::new(x, high - 1)).zip(layer.index(IVec2::new(x, high)))?;
            Some([upper, lower])
        })
        .collect()
}
