//! Which pixel of the picture belongs to which component, and where the water is seen.
//!
//! Masks in files are visible coverage. Above the background's contact line everything that nothing else covers is
//! background; below it, it is water, unless the masks leave it to the background (what hangs under the contact line).

use glam::{IVec2, UVec2};
use rayon::prelude::*;

use super::Grid;
use super::beyond::frame;
use super::fill::push_pull;
use crate::picture::Mask;
use crate::picture::PicturePoint;
use crate::scene::Surface;
use crate::scene::TourScene;
use crate::scene::margin_px;

/// The masks of a tour, all of the picture's size.
#[derive(Clone, Copy, Debug)]
pub struct TourMasks<'a> {
    /// Visible water; without it all that is left below the background's contact line is water.
    pub water: Option<&'a Mask>,
    /// Visible ground.
    pub ground: Option<&'a Mask>,
    /// Visible coverage of each billboard, in the scene's order.
    pub billboards: &'a [Mask],
}

/// Who covers what.
#[derive(Clone, Debug)]
pub(super) struct Coverage {
    /// Per component its own coverage 0–255: visible where it is seen, guessed where a billboard hides it.
    pub alpha: Vec<Grid<u8>>,
    /// Per component the coverage grown by the fringe: where its layer answers for the picture's colors.
    pub grown: Vec<Grid<u8>>,
    /// Pixels whose ray meets the background before the water.
    pub above: Grid<bool>,
    /// Pixels that show nothing but water.
    pub water: Grid<bool>,
    /// Pixels that show nothing but the component: bits by component index, 0–63.
    pub pure: Grid<u64>,
}

/// Coverage this near to nothing or to everything is that: renderers and compressors leave dust in masks.
const DUST: u8 = 6;

/// Width of the fringe in which a mask's own edge is not trusted, pixels per pixel of picture width.
const FRINGE: f64 = 0.001;

impl Coverage {
    pub(super) fn of(scene: &TourScene, masks: &TourMasks) -> Self {
        let size = scene.camera.intrinsics.size;
        let above = above_contact(scene, size);
        let fringe = (FRINGE * f64::from(size.x)).round().max(1.0) as i32;
        let ground = scene.ground();
        let first_billboard = if ground.is_some() { 2 } else { 1 };

        // A scene may have left out the last ones.
        let count = scene.components.len() - first_billboard;
        let billboards: Vec<Grid<u8>> = masks.billboards.iter().take(count).map(boxed).collect();
        let hidden = Grid::from_fn(IVec2::ZERO, size, |pixel| {
            billboards.iter().map(|grid| u32::from(grid.get(pixel).unwrap_or(0))).sum::<u32>().min(255) as u8
        });
        let [background_alpha, ground_alpha] = framework_alpha(scene, masks, &above, &hidden);
        let mut alpha = vec![background_alpha];
        if ground.is_some() {
            alpha.push(ground_alpha);
        }
        alpha.extend(billboards);

        let grown: Vec<Grid<u8>> = alpha
            .iter()
            .enumerate()
            .map(
                |(index, grid)| if index < first_billboard { grid.clone() } else { grow(grid, fringe, size) },
            )
            .collect();
        let water = Grid::from_fn(IVec2::ZERO, size, |pixel| {
            scene.water
                && !above.get(pixel).unwrap_or(true)
                && grown.iter().all(|grid| grid.get(pixel).unwrap_or(0) == 0)
        });
        let pure = Grid::from_fn(IVec2::ZERO, size, |pixel| {
            let covers = |index: usize| grown[index].get(pixel).unwrap_or(0) > 0;
            let nothing_else = |own: usize| (0..grown.len()).all(|other| other <= own || !covers(other));
            let mut bits = 0;
            for (index, grid) in alpha.iter().enumerate() {
                // Billboards overlap in any order, so each excludes all others; the framework lies under them.
                let alone = if index < first_billboard {
                    nothing_else(index)
                } else {
                    (first_billboard..grown.len()).all(|other| other == index || !covers(other))
                };
                if alone && grid.get(pixel).unwrap_or(0) >= 250 {
                    bits |= 1 << index;
                }
            }
            bits
        });
        Self { alpha, grown, above, water, pure }
    }

    /// Gives a pixel to a billboard, if its layer reaches there.
    pub(super) fn give(&mut self, index: usize, pixel: IVec2) {
        let (Some(alpha), Some(grown)) = (self.alpha[index].index(pixel), self.grown[index].index(pixel))
        else {
            return;
        };
        self.alpha[index].cells[alpha] = 255;
        self.grown[index].cells[grown] = 255;
        if let Some(cell) = self.water.index(pixel) {
            self.water.cells[cell] = false;
            self.pure.cells[cell] = 1 << index;
        }
    }
}

/// Pixels whose ray meets the background before the water; all of them without water.
fn above_contact(scene: &TourScene, size: UVec2) -> Grid<bool> {
    Grid::from_fn(IVec2::ZERO, size, |pixel| is_above_contact(scene, pixel))
}

/// Whether a pixel's ray, of the picture or beyond, meets the background before the water.
pub(super) fn is_above_contact(scene: &TourScene, pixel: IVec2) -> bool {
    let ray = scene.camera.ray(PicturePoint::pixel_center(pixel.x.into(), pixel.y.into()));
    if !scene.water || ray.direction.y >= 0.0 {
        return true;
    }
    let to_water = -ray.origin.y / ray.direction.y;
    scene.background().surface.meet_plane(ray).is_some_and(|t| t <= to_water)
}

/// Coverage of background and ground, guessed behind billboards from what is seen around them.
fn framework_alpha(
    scene: &TourScene,
    masks: &TourMasks,
    above: &Grid<bool>,
    hidden: &Grid<u8>,
) -> [Grid<u8>; 2] {
    let size = scene.camera.intrinsics.size;
    let ground_surface = scene.ground().map(|index| scene.components[index].surface);
    let background = scene.background().surface;
    // Shares of [background below its contact line, ground] among what is not hidden.
    let (visible, known): (Vec<[f32; 2]>, Vec<f32>) = hidden
        .cells
        .par_iter()
        .enumerate()
        .map(|(index, &hidden_by)| {
            let pixel = hidden.pixel(index).as_uvec2();
            let coverage = |mask: Option<&Mask>| {
                mask.map_or(0.0, |mask| f32::from(dusted(mask.get(pixel.x, pixel.y))) / 255.0)
            };
            let seen = 1.0 - f32::from(hidden_by) / 255.0;
            let ground = coverage(masks.ground).min(seen);
            let rest = match masks.water {
                Some(_) => (seen - coverage(masks.water) - ground).max(0.0),
                None => 0.0,
            };
            let shares = if seen > 0.0 { [rest / seen, ground / seen] } else { [0.0; 2] };
            (shares, f32::from(u8::from(seen > 0.98)))
        })
        .unzip();
    let mut shares = visible.clone();
    push_pull(size.x as usize, &mut shares, &known);

    let code = |share: f32| (255.0 * share.clamp(0.0, 1.0)).round() as u8;
    // A guessed border is drawn sharp; a seen one keeps its mask's softness.
    let guessed = |share: f32| ((share - 0.5) * 4.0 + 0.5).clamp(0.0, 1.0);
    let pick = |index: usize, channel: usize| {
        if known[index] == 1.0 { visible[index][channel] } else { guessed(shares[index][channel]) }
    };
    let before_background = |pixel: IVec2| {
        ground_surface.is_some_and(|surface| {
            let ray = scene.camera.ray(PicturePoint::pixel_center(pixel.x.into(), pixel.y.into()));
            surface
                .meet(ray)
                .is_some_and(|t| background.meet_plane(ray).is_none_or(|to_background| t < to_background))
        })
    };
    let width = size.x as usize;
    let ground = Grid::from_fn(IVec2::ZERO, size, |pixel| {
        let share = pick(pixel.y as usize * width + pixel.x as usize, 1);
        if share > 0.0 && before_background(pixel) { code(share) } else { 0 }
    });
    let background = Grid::from_fn(IVec2::ZERO, size, |pixel| {
        let index = pixel.y as usize * width + pixel.x as usize;
        if above.cells[index] {
            return 255;
        }
        // Antialiased masks leave slivers between them everywhere; only what somewhere near is mostly background, or
        // ground that has no place on the ground's plane, hangs under the contact line.
        let near = |channel: usize| {
            (-1..=1)
                .flat_map(|dy| (-1..=1).map(move |dx| IVec2::new(dx, dy)))
                .any(|step| above.index(pixel + step).is_some_and(|near| pick(near, channel) > 0.5))
        };
        let mut share = if near(0) { pick(index, 0) } else { 0.0 };
        if ground.cells[index] == 0 && near(1) {
            share += pick(index, 1);
        }
        code(share)
    });
    [background, ground]
}

/// The part of a mask that is not empty, with a border of empty pixels that may lie outside the picture: one at least,
/// and below room for what its body shows between the mask and the contact line.
fn boxed(mask: &Mask) -> Grid<u8> {
    let Some(bounds) = mask.bounds() else {
        return Grid::filled(IVec2::ZERO, UVec2::ONE, 0);
    };
    let inside = mask.size().as_ivec2();
    let room = UVec2::new(2, 1 + margin_px(mask.size()) as u32);
    Grid::from_fn(bounds.min.as_ivec2() - 1, bounds.size() + room, |pixel| {
        let within = pixel.cmpge(IVec2::ZERO).all() && pixel.cmplt(inside).all();
        if within { dusted(mask.get(pixel.x as u32, pixel.y as u32)) } else { 0 }
    })
}

fn dusted(coverage: u8) -> u8 {
    match coverage {
        0..DUST => 0,
        _ if coverage > 255 - DUST => 255,
        _ => coverage,
    }
}

/// Coverage with a square fringe around it: cells within `radius` of any coverage get at least 1, inside the maps'
/// frame. Takes the same time whatever the radius.
pub(super) fn grow(grid: &Grid<u8>, radius: i32, picture: UVec2) -> Grid<u8> {
    let (least, most) = frame(picture);
    let low = (grid.origin - radius).max(least);
    let high = (grid.origin + grid.size.as_ivec2() + radius).min(most).max(low + 1);
    let (width, height) = ((high.x - low.x) as usize, (high.y - low.y) as usize);
    let own = |x: usize, y: usize| grid.get(low + IVec2::new(x as i32, y as i32)).unwrap_or(0);
    let reach = radius.max(0) as usize;
    let rows: Vec<bool> =
        (0..height).into_par_iter().flat_map_iter(|y| near_any(width, reach, |x| own(x, y) > 0)).collect();
    let columns: Vec<Vec<bool>> =
        (0..width).into_par_iter().map(|x| near_any(height, reach, |y| rows[y * width + x])).collect();
    Grid::from_fn(low, UVec2::new(width as u32, height as u32), |pixel| {
        let cell = (pixel - low).as_uvec2();
        let (x, y) = (cell.x as usize, cell.y as usize);
        own(x, y).max(u8::from(columns[x][y]))
    })
}

/// For each of `count` places whether `is` holds within `reach` of it.
fn near_any(count: usize, reach: usize, is: impl Fn(usize) -> bool) -> Vec<bool> {
    let mut before = Vec::with_capacity(count + 1);
    before.push(0_usize);
    for place in 0..count {
        before.push(before[place] + usize::from(is(place)));
    }
    (0..count)
        .map(|place| before[(place + reach + 1).min(count)] > before[place.saturating_sub(reach)])
        .collect()
}

/// Whether the surface is one that a mirrored ray can meet: upright, or level and above the water.
pub(super) fn is_mirrored(surface: &Surface) -> bool {
    !matches!(surface, Surface::Level(level) if level.height < 1e-3)
}
