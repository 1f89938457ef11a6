//! Texture maps: what each component shows directly, filled where something hides it.

use glam::IVec2;
use rayon::prelude::*;

use super::beyond::{folded, frame};
use super::coverage::{Coverage, is_above_contact};
use super::fill::push_pull;
use super::reflection::{backdrop_from_water, composite, linear};
use super::tint::Tint;
use super::zones::stack_at;
use super::{Grid, Layer, Zone, lift};
use crate::picture::Picture;
use crate::picture::color::srgb_from_linear;
use crate::scene::Role;
use crate::scene::TourScene;

/// The direct colors of a component, linear light, filled over its whole layer.
///
/// Backdrops take from the water what the lens did not see; the rest is push-pull.
pub(super) fn filled_colors(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    tint: &Tint,
    owner: &Grid<u8>,
    index: usize,
) -> Grid<[f32; 3]> {
    let role = scene.components[index].role;
    let area = &coverage.grown[index];
    let low = area.origin.max(IVec2::ZERO);
    let high = (area.origin + area.size.as_ivec2()).min(picture.size().as_ivec2()).max(low + 1);
    let pure = |pixel: IVec2| coverage.is_pure(index, pixel);
    let mut colors = Grid::from_fn(low, (high - low).as_uvec2(), |pixel| {
        if pure(pixel) { linear(picture, pixel) } else { [0.0; 3] }
    });
    let mut known: Vec<f32> = (0..colors.cells.len())
        .into_par_iter()
        .map(|cell| f32::from(u8::from(pure(colors.pixel(cell)))))
        .collect();
    if matches!(role, Role::LastLayer | Role::Band) && scene.water {
        fill_from_water(scene, picture, coverage, tint, owner, index, &mut colors, &mut known);
    }
    push_pull(colors.size.x as usize, &mut colors.cells, &known);
    let (low, high) = match role {
        Role::LastLayer | Role::Ground => frame(picture.size()),
        Role::Band | Role::Billboard => (area.origin, area.origin + area.size.as_ivec2()),
    };
    let inside = |pixel: IVec2| {
        let end = colors.origin + colors.size.as_ivec2() - 1;
        folded(pixel, picture.size()).clamp(colors.origin, end)
    };
    let mut wide =
        Grid::from_fn(low, (high - low).as_uvec2(), |pixel| colors.get(inside(pixel)).unwrap_or_default());
    if role != Role::Billboard {
        // Sky over sky: what is folded to the sides goes on, what would hang upside down from above does not.
        let known: Vec<f32> =
            (0..wide.cells.len()).map(|cell| f32::from(u8::from(wide.pixel(cell).y >= 0))).collect();
        push_pull(wide.size.x as usize, &mut wide.cells, &known);
    }
    wide
}

/// Fills what is hidden of a backdrop from its mirror image; the fit's local miss is taken out by a membrane, so that no seam
/// shows.
fn fill_from_water(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    tint: &Tint,
    owner: &Grid<u8>,
    index: usize,
    colors: &mut Grid<[f32; 3]>,
    known: &mut [f32],
) {
    let candidates = Grid::from_fn(colors.origin, colors.size, |pixel| {
        let stands =
            coverage.alpha[index].get(pixel).unwrap_or(0) > 0 && is_above_contact(scene, index, pixel);
        stands.then(|| backdrop_from_water(scene, picture, tint, owner, index, pixel)).flatten()
    });
    let mut misses = vec![[0.0; 3]; known.len()];
    let mut both = vec![0.0; known.len()];
    for (cell, candidate) in candidates.cells.iter().enumerate() {
        if let Some(candidate) = candidate
            && known[cell] == 1.0
        {
            misses[cell] = std::array::from_fn(|c| colors.cells[cell][c] - candidate[c]);
            both[cell] = 1.0;
        }
    }
    push_pull(colors.size.x as usize, &mut misses, &both);
    for (cell, candidate) in candidates.cells.iter().enumerate() {
        if let Some(candidate) = candidate
            && known[cell] == 0.0
        {
            colors.cells[cell] = std::array::from_fn(|c| (candidate[c] + misses[cell][c]).clamp(0.0, 1.0));
            known[cell] = 1.0;
        }
    }
}

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
        let alpha = coverage.alpha[index].get(pixel).unwrap_or_else(|| match scene.components[index].role {
            Role::Billboard | Role::Band => 0,
            Role::LastLayer if is_above_contact(scene, 0, pixel) => 255,
            Role::LastLayer | Role::Ground => beyond(coverage, index, pixel, picture),
        });
        [r, g, b, alpha]
    })
}

/// Coverage of a framework plane beyond the picture: that of the pixel which is folded there.
fn beyond(coverage: &Coverage, index: usize, pixel: IVec2, picture: &Picture) -> u8 {
    let inside = folded(pixel, picture.size());
    let hangs = !coverage.above.get(inside).unwrap_or(false);
    if index > 0 || hangs { coverage.alpha[index].get(inside).unwrap_or(0) } else { 0 }
}

/// Raises the nearest layer at every pixel until the first view shows the picture.
pub(super) fn lift_textures(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    zones: &[Option<Zone>],
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
                if above { [0.0; 3] } else { composite(reflections, &stack_at(scene, zones, pixel), pixel)? };
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
