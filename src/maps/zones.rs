//! Where each component's mirror image lies in the picture's water, and what it hides of farther ones.
//!
//! A zone starts as the mirrored mask. Real bodies are not flat: the water sees a hull from below, so a zone takes in
//! what looks like the body and not like the background beside it, within the margin that its rectangle has.

use glam::{IVec2, UVec2};

use super::Grid;
use super::coverage::{Coverage, grow, is_mirrored};
use super::mirror::mirrored;
use crate::picture::Picture;
use crate::picture::PicturePoint;
use crate::scene::Role;
use crate::scene::Surface;
use crate::scene::TourScene;
use crate::scene::margin_px;
use crate::scene::mirror;

/// How far reflection maps reach below the picture's lower border, as a share of its height: what a camera sees that
/// looks further down or steps back.
const BELOW_FRAME: f64 = 0.25;

/// Width of the band around a mirrored outline that is given to the nearer component, per pixel of picture width. Real
/// bodies are not flat: their mirror image leaves the mirrored mask by some pixels.
const MIRROR_FRINGE: f64 = 0.003;

/// Where the component's mirror image lies in the picture, and what it hides of farther ones.
pub(super) struct Zone {
    /// Coverage of the mirror image.
    pub coverage: Grid<u8>,
    /// The same with its fringe.
    pub grown: Grid<u8>,
}

/// Zones of all components; the background's is empty, it is the last layer everywhere.
pub(super) fn zones(scene: &TourScene, coverage: &Coverage) -> Vec<Option<Zone>> {
    let size = scene.camera.intrinsics.size;
    let fringe = fringe(size);
    scene
        .components
        .iter()
        .enumerate()
        .map(|(index, component)| {
            if index == 0 || !scene.water || !is_mirrored(&component.surface) {
                return None;
            }
            let (low, high) = mirror_box(scene, &component.surface)?;
            let alpha = &coverage.alpha[index];
            let zone = Grid::from_fn(low, (high - low).as_uvec2(), |pixel| {
                let point = PicturePoint::pixel_center(pixel.x.into(), pixel.y.into());
                mirrored(scene, &component.surface, point)
                    .map_or(0, |found| (255.0 * alpha.coverage(found.direct)).round() as u8)
            });
            let frame = reach_below(size);
            Some(Zone { grown: grow(&zone, fringe, frame), coverage: zone })
        })
        .collect()
}

fn fringe(size: UVec2) -> i32 {
    (MIRROR_FRINGE * f64::from(size.x)).round().max(2.0) as i32
}

/// The size of the picture with the strip below it that reflection maps cover.
pub(super) fn reach_below(size: UVec2) -> UVec2 {
    UVec2::new(size.x, size.y + (BELOW_FRAME * f64::from(size.y)) as u32)
}

/// The box of pixels in which a surface's mirror image can lie, low and high corner.
fn mirror_box(scene: &TourScene, surface: &Surface) -> Option<(IVec2, IVec2)> {
    let frame = reach_below(scene.camera.intrinsics.size).as_ivec2();
    let Surface::Wall(wall) = surface else {
        return Some((IVec2::ZERO, frame));
    };
    let (mut low, mut high) = (IVec2::MAX, IVec2::MIN);
    for s in wall.span {
        for y in [0.0, wall.rise[1]] {
            let seen = scene.camera.project(mirror(wall.point(s, y)))?.0.clamp(
                glam::DVec2::splat(-1e6),
                glam::DVec2::splat(1e6),
            );
            low = low.min(seen.floor().as_ivec2() - 2);
            high = high.max(seen.ceil().as_ivec2() + 2);
        }
    }
    let (low, high) = (low.max(IVec2::ZERO), high.min(frame));
    low.cmplt(high).all().then_some((low, high))
}

/// The components whose fringe covers a water pixel, far to near, with the parameters that order them.
pub(super) fn stack_at(scene: &TourScene, zones: &[Option<Zone>], pixel: IVec2) -> Vec<usize> {
    let mut stack: Vec<(f64, usize)> = zones
        .iter()
        .enumerate()
        .filter_map(|(index, zone)| {
            zone.as_ref().filter(|zone| zone.grown.get(pixel).unwrap_or(0) > 0)?;
            let point = PicturePoint::pixel_center(pixel.x.into(), pixel.y.into());
            let found = mirrored(scene, &scene.components[index].surface, point)?;
            Some((found.parameter, index))
        })
        .collect();
    stack.sort_by(|a, b| b.0.total_cmp(&a.0));
    stack.into_iter().map(|(_, index)| index).collect()
}

/// Per picture pixel the component whose mirror image, and nothing else, the water shows there; 255 for none.
pub(super) fn seen_owner(scene: &TourScene, coverage: &Coverage, zones: &[Option<Zone>]) -> Grid<u8> {
    Grid::from_fn(IVec2::ZERO, scene.camera.intrinsics.size, |pixel| {
        if !coverage.water.get(pixel).unwrap_or(false) {
            return 255;
        }
        match stack_at(scene, zones, pixel).last() {
            None => 0,
            Some(&nearest) => {
                let covered = zones[nearest].as_ref().and_then(|zone| zone.coverage.get(pixel)).unwrap_or(0);
                if covered >= 250 { nearest as u8 } else { 255 }
            }
        }
    })
}

/// How much closer, in color, a texel must be to the body than to the background to be taken for the body.
const BODY_LIKENESS: f32 = 0.6;

/// Texels that differ less than this from the background beside them belong to it, RGB distance in codes.
const BACKGROUND_LIKE: f32 = 14.0;

/// Lets the billboards' zones take in the parts of their bodies that only the water sees.
pub(super) fn take_in_bodies(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    zones: &mut [Option<Zone>],
) {
    let size = picture.size();
    let reach = margin_px(size) - fringe(size) - 1;
    for index in 0..zones.len() {
        if scene.components[index].role != Role::Billboard || zones[index].is_none() {
            continue;
        }
        let owner = seen_owner(scene, coverage, zones);
        let Some(zone) = &mut zones[index] else { continue };
        let body = Body { picture, owner: &owner, index: index as u8, near: grow(&zone.coverage, reach, size), reach };
        let mut edge: Vec<IVec2> = zone
            .grown
            .cells
            .iter()
            .enumerate()
            .filter(|&(_, &cell)| cell > 0)
            .map(|(cell, _)| zone.grown.pixel(cell))
            .collect();
        for pixel in &edge {
            // The fringe itself is undecided: it is the body's where it looks like it.
            if zone.coverage.get(*pixel) == Some(0) && coverage.water.get(*pixel) == Some(true) && body.claims(*pixel) {
                set(&mut zone.coverage, *pixel);
            }
        }
        edge.retain(|pixel| zone.coverage.get(*pixel).unwrap_or(0) > 0);
        for _ in 0..reach {
            let mut next = Vec::new();
            for pixel in edge {
                for step in [IVec2::X, IVec2::Y, IVec2::NEG_X, IVec2::NEG_Y] {
                    let beside = pixel + step;
                    if zone.coverage.get(beside) == Some(0) && owner.get(beside) == Some(0) && body.claims(beside) {
                        set(&mut zone.coverage, beside);
                        next.push(beside);
                    }
                }
            }
            edge = next;
        }
        zone.grown = grow(&zone.coverage, fringe(size), reach_below(size));
    }
}

fn set(grid: &mut Grid<u8>, pixel: IVec2) {
    if let Some(cell) = grid.index(pixel) {
        grid.cells[cell] = 255;
    }
}

/// Decides for one billboard whether a water texel shows its body.
struct Body<'a> {
    picture: &'a Picture,
    owner: &'a Grid<u8>,
    index: u8,
    /// Where the background is not to be trusted.
    near: Grid<u8>,
    reach: i32,
}

impl Body<'_> {
    fn claims(&self, pixel: IVec2) -> bool {
        let [mut body, mut background] = [f32::INFINITY; 2];
        let stride = (self.reach / 8).max(1);
        // The background is stratified: rows near this one, wide to the sides.
        for dy in (-self.reach..=self.reach).step_by(stride as usize) {
            for dx in (-6 * self.reach..=6 * self.reach).step_by(stride as usize) {
                let at = pixel + IVec2::new(dx, dy);
                match self.owner.get(at) {
                    Some(0) if 2 * dy.abs() <= self.reach && self.near.get(at).unwrap_or(0) == 0 => {
                        background = background.min(self.distance(pixel, at));
                    }
                    Some(owner) if owner == self.index && dx.abs() <= 2 * self.reach => {
                        body = body.min(self.distance(pixel, at));
                    }
                    _ => {}
                }
            }
        }
        background.is_finite() && background > BACKGROUND_LIKE && body < BODY_LIKENESS * background
    }

    /// RGB distance of two pixels in codes.
    fn distance(&self, a: IVec2, b: IVec2) -> f32 {
        let [a, b] = [a, b].map(|at| self.picture.pixel(at.x as u32, at.y as u32));
        (0..3).map(|c| (f32::from(a[c]) - f32::from(b[c])).powi(2)).sum::<f32>().sqrt()
    }
}
