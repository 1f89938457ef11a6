//! What the masks show of each component, and what it is behind whatever hides it.
//!
//! Shares of a pixel never sum to more than one; what no mask claims goes to the backdrop that has none, and below its
//! contact line, where the water mask leaves it free, to the nearest backdrop.

use glam::{IVec2, UVec2};

use super::Grid;
use super::beyond::{across, beyond_border};
use super::coverage::{ALONE, TourMasks, is_above_contact};
use super::fill::membrane;
use super::skyline::prolong;
use crate::picture::Mask;
use crate::picture::{PicturePoint, distances};
use crate::scene::Role;
use crate::scene::TourScene;
use crate::scene::margin_px;

/// A hidden border is guessed from what is nearer than this, pixels; behind wider things only a band's upper one.
const FARTHEST: f32 = 64.0;

/// A pixel is known, not guessed, while what is nearer hides less of it than this.
pub(super) const HIDDEN: u32 = 5;

/// Rows above a contact line that an antialiased mask leaves in part to the water.
const LAST: i32 = 2;

/// Visible coverage of every component inside the picture, 0–255, in the scene's order.
pub(super) fn visible(scene: &TourScene, masks: &TourMasks) -> Vec<Grid<u8>> {
    let size = scene.camera.intrinsics.size;
    let mut seen: Vec<Grid<u8>> = Vec::with_capacity(scene.components.len());
    let (mut backdrops, mut billboards) = (masks.backdrops.iter(), masks.billboards.iter());
    for component in &scene.components {
        let mask = match component.role {
            Role::LastLayer | Role::Band => backdrops.next().copied().flatten(),
            Role::Ground => masks.ground,
            Role::Billboard => billboards.next().copied(),
        };
        seen.push(mask.map_or_else(|| Grid::filled(IVec2::ZERO, UVec2::ZERO, 0), boxed));
    }
    let count = seen.len();
    let by = |role: Role| (0..count).filter(move |&index| scene.components[index].role == role);
    let backdrops = std::iter::once(0).chain(by(Role::Band));
    let rest = backdrops.zip(&masks.backdrops).find(|(_, mask)| mask.is_none()).map_or(0, |(index, _)| index);
    let claiming: Vec<usize> = (0..count).filter(|&index| index != rest).collect();
    let billboards: Vec<usize> = by(Role::Billboard).collect();
    let nearest_backdrop = by(Role::Band).next_back().unwrap_or(0);
    let ground = scene.ground();
    let code = |grid: &Grid<u8>, pixel: IVec2| u32::from(grid.get(pixel).unwrap_or(0));

    // What is left of the ground where no point of the ground's plane is seen goes to the backdrop.
    let on_ground = |pixel: IVec2| ground.is_some_and(|index| meets(scene, index, pixel));
    let leftover = Grid::from_fn(IVec2::ZERO, size, |pixel| {
        let claimed: u32 = claiming.iter().map(|&index| code(&seen[index], pixel)).sum();
        let at = pixel.as_uvec2();
        let water = match masks.water {
            _ if is_above_contact(scene, rest, pixel) => 0,
            Some(mask) => u32::from(mask.without_dust(at.x, at.y)),
            None => 255,
        };
        255_u32.saturating_sub(claimed + water) as u8
    });
    let lost_ground = Grid::from_fn(IVec2::ZERO, size, |pixel| match ground {
        Some(index) if !on_ground(pixel) => seen[index].get(pixel).unwrap_or(0),
        _ => 0,
    });
    // Antialiased masks leave slivers between them everywhere; only what somewhere near is mostly free hangs under the
    // contact line.
    let near = |grid: &Grid<u8>, pixel: IVec2| {
        (-1..=1)
            .flat_map(|dy| (-1..=1).map(move |dx| IVec2::new(dx, dy)))
            .any(|step| grid.get(pixel + step).unwrap_or(0) > 127)
    };
    let billboards_at = |pixel: IVec2| billboards.iter().map(|&index| code(&seen[index], pixel)).sum::<u32>();
    let rest_seen = Grid::from_fn(IVec2::ZERO, size, |pixel| {
        if is_above_contact(scene, rest, pixel) { leftover.get(pixel).unwrap_or(0) } else { 0 }
    });
    let hanging = Grid::from_fn(IVec2::ZERO, size, |pixel| {
        let below = !is_above_contact(scene, rest, pixel);
        let mut share = 0;
        if below && near(&leftover, pixel) {
            share += code(&leftover, pixel);
        }
        if near(&lost_ground, pixel) {
            share += code(&lost_ground, pixel);
        }
        share.min(255) as u8
    });
    if let Some(index) = ground {
        seen[index] = Grid::from_fn(IVec2::ZERO, size, |pixel| {
            let own = if on_ground(pixel) { code(&seen[index], pixel) } else { 0 };
            own.min(255_u32.saturating_sub(billboards_at(pixel))) as u8
        });
    }
    seen[rest] = rest_seen;
    let caught = &seen[nearest_backdrop];
    seen[nearest_backdrop] = Grid::from_fn(IVec2::ZERO, size, |pixel| {
        (code(caught, pixel) + code(&hanging, pixel)).min(255) as u8
    });
    if scene.water {
        let bands: Vec<usize> = by(Role::Band).collect();
        for index in bands {
            seen[index] = down_to_the_water(scene, &seen, index);
        }
    }
    seen
}

/// What a band shows, with all of the pixels above its contact line that it shows most of: their water is no farther than
/// the band, so nothing shines through.
fn down_to_the_water(scene: &TourScene, seen: &[Grid<u8>], index: usize) -> Grid<u8> {
    let own = &seen[index];
    Grid::from_fn(own.origin, own.size, |pixel| {
        let shown = own.get(pixel).unwrap_or(0);
        let is_last = || {
            is_above_contact(scene, index, pixel) && !is_above_contact(scene, index, pixel + LAST * IVec2::Y)
        };
        if !(128..255).contains(&shown) || !is_last() {
            return shown;
        }
        let all: u32 = seen.iter().map(|grid| u32::from(grid.get(pixel).unwrap_or(0))).sum();
        (u32::from(shown) + 255_u32.saturating_sub(all)) as u8
    })
}

/// Coverage of every component in the maps' frame, guessed where something nearer hides it.
///
/// `order` is that of the first view, near to far. The last layer covers everything above its contact line.
pub(super) fn completed(
    scene: &TourScene,
    order: &[usize],
    seen: &[Grid<u8>],
    above: &Grid<bool>,
) -> Vec<Grid<u8>> {
    let size = scene.camera.intrinsics.size;
    let mut alpha = seen.to_vec();
    let mut hidden: Grid<u8> = Grid::filled(IVec2::ZERO, size, 0);
    for &index in order {
        let own = &seen[index];
        let whole = match scene.components[index].role {
            Role::Billboard => {
                behind(own, &hidden, own.origin, own.size, |pixel| is_above_contact(scene, index, pixel))
            }
            Role::Ground => behind(own, &hidden, IVec2::ZERO, size, |pixel| meets(scene, index, pixel)),
            Role::Band => {
                let mut whole =
                    behind(own, &hidden, IVec2::ZERO, size, |pixel| is_above_contact(scene, index, pixel));
                let is_above = |pixel| is_above_contact(scene, index, pixel);
                prolong(&mut whole, own, &hidden, FARTHEST as i32, is_above);
                stand(&mut whole, &hidden, is_above);
                whole
            }
            Role::LastLayer => {
                behind(own, &hidden, IVec2::ZERO, size, |pixel| is_above_contact(scene, index, pixel))
            }
        };
        alpha[index] = match scene.components[index].role {
            Role::Billboard => beyond_border(&whole, size),
            Role::Ground => whole,
            Role::Band => across(&whole, size),
            Role::LastLayer => Grid::from_fn(IVec2::ZERO, size, |pixel| {
                if above.get(pixel).unwrap_or(true) { 255 } else { whole.get(pixel).unwrap_or(0) }
            }),
        };
        for cell in 0..own.cells.len() {
            if let Some(at) = hidden.index(own.pixel(cell)) {
                hidden.cells[at] = hidden.cells[at].saturating_add(own.cells[cell]);
            }
        }
    }
    alpha
}

/// Whether a pixel's ray meets a component's plane within its bounds.
pub(super) fn meets(scene: &TourScene, index: usize, pixel: IVec2) -> bool {
    let ray = scene.camera.ray(PicturePoint::pixel_center(pixel.x.into(), pixel.y.into()));
    scene.components[index].surface.meet(ray).is_some()
}

/// A component's coverage in a box of the picture, guessed wherever `hidden` covers it and `may` allows: its border
/// goes on as a membrane of signed distances says, so that a straight one stays straight.
fn behind(
    own: &Grid<u8>,
    hidden: &Grid<u8>,
    origin: IVec2,
    extent: UVec2,
    may: impl Fn(IVec2) -> bool + Sync,
) -> Grid<u8> {
    let code = |grid: &Grid<u8>, pixel: IVec2| u32::from(grid.get(pixel).unwrap_or(0));
    let states = Grid::from_fn(origin, extent, |pixel| {
        let known = hidden.get(pixel).is_some_and(|hidden| u32::from(hidden) < HIDDEN);
        (known, code(own, pixel) > 127)
    });
    let known: Vec<f32> = states.cells.iter().map(|(known, _)| f32::from(u8::from(*known))).collect();
    if known.iter().all(|&known| known == 1.0) {
        return Grid::from_fn(origin, extent, |pixel| own.get(pixel).unwrap_or(0));
    }
    let width = extent.x as usize;
    let to = |inside: bool| -> Vec<f32> {
        let is = |cell: usize| states.cells[cell] == (true, inside);
        distances(width, extent.y as usize, is).into_iter().map(|distance| distance.min(FARTHEST)).collect()
    };
    let (to_covered, to_free) = (to(true), to(false));
    let mut signed: Vec<[f32; 1]> =
        to_free.iter().zip(&to_covered).map(|(free, covered)| [free - covered]).collect();
    membrane(width, &mut signed, &known);
    Grid::from_fn(origin, extent, |pixel| {
        let cell = (pixel - origin).as_uvec2();
        let cell = cell.y as usize * width + cell.x as usize;
        if known[cell] == 1.0 || !may(pixel) {
            return own.get(pixel).unwrap_or(0);
        }
        (255.0 * (0.5 * signed[cell][0] + 0.5).clamp(0.0, 1.0)).round() as u8
    })
}

/// Lets a band stand on its contact line: where it is hidden, what is guessed of it goes down to `is_above`'s end.
fn stand(whole: &mut Grid<u8>, hidden: &Grid<u8>, is_above: impl Fn(IVec2) -> bool) {
    let (low, high) = (whole.origin, whole.origin + whole.size.as_ivec2());
    for x in low.x..high.x {
        let mut above = 0;
        for y in low.y..high.y {
            let pixel = IVec2::new(x, y);
            let Some(cell) = whole.index(pixel) else { continue };
            let is_hidden = hidden.get(pixel).is_some_and(|hidden| hidden >= ALONE);
            if is_hidden && whole.cells[cell] < above && is_above(pixel) {
                whole.cells[cell] = above;
            }
            above = whole.cells[cell];
        }
    }
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
        if within { mask.without_dust(pixel.x as u32, pixel.y as u32) } else { 0 }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_guessed_of_a_band_goes_down_to_its_foot_where_it_is_hidden() {
        let column =
            |cells: [u8; 6]| Grid { origin: IVec2::ZERO, size: UVec2::new(1, 6), cells: cells.to_vec() };
        let stood = |cells: [u8; 6], hidden: [u8; 6]| {
            let mut whole = column(cells);
            stand(&mut whole, &column(hidden), |pixel| pixel.y < 5);
            whole.cells
        };
        assert_eq!(stood([0, 255, 200, 0, 0, 0], [0, 0, 255, 255, 255, 255]), [0, 255, 255, 255, 255, 0]);
        assert_eq!(
            stood([0, 255, 200, 0, 0, 0], [0, 0, 255, 0, 255, 255]),
            [0, 255, 255, 0, 0, 0],
            "what is seen to be free stays free"
        );
    }
}
