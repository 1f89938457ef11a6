//! Which pixel of the picture belongs to which component, and where the water is seen.
//!
//! Masks in files are visible coverage; `visible.rs` says who shows where no mask does. What nothing covers below the last
//! layer's contact line is water.

use glam::{IVec2, UVec2};
use rayon::prelude::*;

use super::Grid;
use super::beyond::frame;
use super::visible;
use crate::picture::Mask;
use crate::picture::PicturePoint;
use crate::scene::Role;
use crate::scene::Surface;
use crate::scene::TourScene;

/// The masks of a tour, all of the picture's size.
#[derive(Clone, Debug)]
pub struct TourMasks<'a> {
    /// Visible water; without it all that is left below the contact line of the
    /// backdrop without a mask is water.
    pub water: Option<&'a Mask>,
    /// Visible ground.
    pub ground: Option<&'a Mask>,
    /// Visible coverage of each backdrop, in the scene's order (the last layer first); `None` for the one that shows
    /// wherever nothing else does.
    pub backdrops: Vec<Option<&'a Mask>>,
    /// Visible coverage of each billboard, in the scene's order.
    pub billboards: Vec<&'a Mask>,
    /// What is known of each billboard's edge.
    pub edges: Vec<Edge>,
    /// Whether each billboard can leave its place.
    pub moving: Vec<bool>,
}

/// What is known of a mask's edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// Drawn by hand: the picture shows where it really is.
    Outlined,
    /// As a mask file says: to be softened only where it is all or nothing.
    Mask,
    /// Computed.
    Exact,
}

/// Who covers what.
#[derive(Clone, Debug)]
pub(super) struct Coverage {
    /// Per component its own coverage 0–255: visible where it is seen, guessed where something nearer hides it.
    pub alpha: Vec<Grid<u8>>,
    /// Per component the coverage grown by the fringe: where its layer answers for the picture's colors.
    pub grown: Vec<Grid<u8>>,
    /// Pixels whose ray meets the last layer before the water.
    pub above: Grid<bool>,
    /// Pixels that show nothing but water.
    pub water: Grid<bool>,
    /// Pixels that show nothing but the component: bits by component index, 0–63.
    pub pure: Grid<u64>,
}

/// Width of the fringe in which a mask's own edge is not trusted, pixels per pixel of picture width.
const FRINGE: f64 = 0.001;

/// A pixel shows one component alone from this coverage on.
pub(super) const ALONE: u8 = 250;

impl Coverage {
    pub(super) fn of(scene: &TourScene, masks: &TourMasks) -> Self {
        let size = scene.camera.intrinsics.size;
        let above = Grid::from_fn(IVec2::ZERO, size, |pixel| is_above_contact(scene, 0, pixel));
        let fringe = (FRINGE * f64::from(size.x)).round().max(1.0) as i32;
        let order = scene.near_to_far(scene.camera.pose.position);
        let seen = visible::visible(scene, masks);
        let alpha = visible::completed(scene, &order, &seen, &above);

        let soft_edged = |index: usize| matches!(scene.components[index].role, Role::Billboard | Role::Band);
        let grow_all = |grids: &[Grid<u8>]| -> Vec<Grid<u8>> {
            let grown = |(index, grid): (usize, &Grid<u8>)| {
                if soft_edged(index) { grow(grid, fringe, size) } else { grid.clone() }
            };
            grids.iter().enumerate().map(grown).collect()
        };
        let grown = grow_all(&alpha);
        let seen_grown = grow_all(&seen);
        let water = Grid::from_fn(IVec2::ZERO, size, |pixel| {
            scene.water
                && !above.get(pixel).unwrap_or(true)
                && grown.iter().all(|grid| grid.get(pixel).unwrap_or(0) == 0)
        });
        let pure = Grid::from_fn(IVec2::ZERO, size, |pixel| {
            let mut bits = 0;
            for &index in &order {
                if seen[index].get(pixel).unwrap_or(0) >= ALONE {
                    bits |= 1 << index;
                }
                // Whatever stands behind this is not alone here.
                if seen_grown[index].get(pixel).unwrap_or(0) > 0 {
                    break;
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

    /// Whether a pixel shows the component and nothing else.
    pub(super) fn is_pure(&self, index: usize, pixel: IVec2) -> bool {
        self.pure.get(pixel).is_some_and(|bits| bits & (1 << index) != 0)
    }
}

/// Whether a pixel's ray, of the picture or beyond, meets a component's plane before the water; always without water.
pub(super) fn is_above_contact(scene: &TourScene, index: usize, pixel: IVec2) -> bool {
    let ray = scene.camera.ray(PicturePoint::pixel_center(pixel.x.into(), pixel.y.into()));
    if !scene.water || ray.direction.y >= 0.0 {
        return true;
    }
    let to_water = -ray.origin.y / ray.direction.y;
    scene.components[index].surface.meet_plane(ray).is_some_and(|t| t <= to_water)
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
