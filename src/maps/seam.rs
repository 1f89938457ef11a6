//! The lines where backdrops meet the water and the ground ends at them, which run between the centers of texels.
//!
//! Above such a line one thing is seen, below it another; between the last texel of the one and the first of the other both maps
//! would fade into nothing, and what is far behind would shine through as a line. Each therefore goes on by one texel: where no
//! ray through the center of a pixel of the first view reaches it, or in the color that the picture has there. Mip levels do so
//! by their own texels.

use glam::{IVec2, UVec2, Vec3, Vec4};
use rayon::prelude::*;

use super::coverage::{Coverage, is_above_contact};
use super::mipmaps::{codes, linear};
use super::{GUTTER, Grid, Layer, Mipmapped};
use crate::picture::{Picture, PicturePoint};
use crate::scene::{Role, Surface, TourScene};

/// Lets the texture maps of backdrops go on below the waterline.
pub(super) fn prolong_textures(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    textures: &mut [Layer],
) {
    for (index, layer) in textures.iter_mut().enumerate().filter(|(index, _)| has_waterline(scene, *index)) {
        let seen = Seen::past(scene, picture, coverage, index);
        for [dry, wet] in seam(layer, |pixel| is_above_contact(scene, index, pixel)) {
            let alpha = layer.cells[dry][3];
            if layer.cells[wet][3] < alpha {
                if let Some(color) = seen.color(layer.pixel(wet), 1) {
                    layer.cells[wet] = codes(color.extend(1.0));
                }
                layer.cells[wet][3] = alpha;
            }
        }
    }
}

/// What the picture shows of the water before a backdrop.
struct Seen<'a> {
    picture: &'a Picture,
    coverage: &'a Coverage,
    /// The components that are nearer.
    nearer: Vec<usize>,
}

impl<'a> Seen<'a> {
    fn past(scene: &TourScene, picture: &'a Picture, coverage: &'a Coverage, index: usize) -> Self {
        let order = scene.near_to_far(scene.camera.pose.position);
        let nearer = order.into_iter().take_while(|&other| other != index).collect();
        Self { picture, coverage, nearer }
    }

    /// The mean light of the pixels in a square of `side` pixels that nothing nearer is on; `None` without one.
    fn color(&self, corner: IVec2, side: i32) -> Option<Vec3> {
        let is_free = |pixel: &IVec2| {
            let covers =
                |&other: &usize| self.coverage.grown[other].get(*pixel).is_some_and(|covered| covered > 0);
            self.coverage.water.index(*pixel).is_some() && !self.nearer.iter().any(covers)
        };
        let square = (0..side * side).map(|i| corner + IVec2::new(i % side, i / side));
        let (sum, count) = square.filter(is_free).fold((Vec4::ZERO, 0.0), |(sum, count), pixel| {
            let [r, g, b] = self.picture.pixel(pixel.x as u32, pixel.y as u32);
            (sum + linear([r, g, b, 255]), count + 1.0)
        });
        (count > 0.0).then(|| (sum / count).truncate())
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

/// A texture map with its mip levels, in which what goes on by a texel does so too.
pub(super) fn texture_levels(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    index: usize,
    layer: &Layer,
) -> Mipmapped {
    let origin = layer.origin - GUTTER as i32;
    let seen = Seen::past(scene, picture, coverage, index);
    Mipmapped::with_gutters(layer, |level, texels| {
        if scene.components[index].role == Role::Ground {
            prolong_up(texels, level, |cell| is_beyond(scene, index, origin + cell));
        } else if has_waterline(scene, index) {
            let side = 1 << level;
            let is_dry = |texel: IVec2| is_above_contact(scene, index, origin + middle(texel, level));
            for [dry, wet] in seam_cells(texels.size, is_dry) {
                let corner = origin + side * (texels.pixel(wet) - texels.origin);
                go_on(&mut texels.cells, dry, wet, seen.color(corner, side));
            }
        }
    })
}

/// A reflection map with its mip levels, in which what goes on by a texel does so too.
pub(super) fn reflection_levels(scene: &TourScene, index: usize, layer: &Layer) -> Mipmapped {
    let origin = layer.origin - GUTTER as i32;
    Mipmapped::with_gutters(layer, |level, texels| {
        if has_waterline(scene, index) {
            prolong_up(texels, level, |cell| is_above_contact(scene, index, origin + cell));
        }
    })
}

/// Lets what is below a line go on above it by a texel of a mip level; `is_upper` is asked about cells of the finest level.
fn prolong_up(texels: &mut Layer, level: usize, is_upper: impl Fn(IVec2) -> bool + Sync) {
    for [upper, lower] in seam_cells(texels.size, |texel| is_upper(middle(texel, level))) {
        go_on(&mut texels.cells, lower, upper, None);
    }
}

/// The cell of the finest level in the middle of a mip level's texel.
fn middle(texel: IVec2, level: usize) -> IVec2 {
    let side = 1 << level;
    side * texel + side / 2
}

/// Lets a texel, premultiplied, cover as much as the one beside it: in a color if there is one, else in that of the one beside
/// it as far as it did not.
fn go_on(texels: &mut [[u8; 4]], from: usize, to: usize, color: Option<Vec3>) {
    let [own, beside] = [linear(texels[to]), linear(texels[from])];
    if own.w < beside.w {
        texels[to] = codes(match color {
            Some(color) => beside.w * color.extend(1.0),
            None => own + (1.0 - own.w / beside.w) * beside,
        });
    }
}

/// Whether a pixel's ray leaves a level component over its far end.
fn is_beyond(scene: &TourScene, index: usize, pixel: IVec2) -> bool {
    let Surface::Level(level) = scene.components[index].surface else { return false };
    let ray = scene.camera.ray(PicturePoint::pixel_center(pixel.x.into(), pixel.y.into()));
    level.meet_plane(ray).is_none_or(|t| ray.at(t).z < level.low.y)
}

/// Per column of a map the last cell that `is_upper` holds for, and the one below it; it holds for all cells above.
fn seam<T: Copy + Send + Sync>(layer: &Grid<T>, is_upper: impl Fn(IVec2) -> bool + Sync) -> Vec<[usize; 2]> {
    seam_cells(layer.size, |cell| is_upper(layer.origin + cell))
}

/// The same, asking about cells counted from the first one.
fn seam_cells(size: UVec2, is_upper: impl Fn(IVec2) -> bool + Sync) -> Vec<[usize; 2]> {
    let size = size.as_ivec2();
    (0..size.x)
        .into_par_iter()
        .filter_map(|x| {
            let (mut low, mut high) = (0, size.y);
            while low < high {
                let middle = low + (high - low) / 2;
                if is_upper(IVec2::new(x, middle)) {
                    low = middle + 1;
                } else {
                    high = middle;
                }
            }
            let index = |y: i32| (y * size.x + x) as usize;
            (high > 0 && high < size.y).then(|| [index(high - 1), index(high)])
        })
        .collect()
}
