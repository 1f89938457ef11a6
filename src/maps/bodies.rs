//! Bodies are not flat: the water sees a hull from below, and a waterline that bulges towards the viewer.
//!
//! What looks like the body and not like the background beside it is taken from the background: into the body's mirror
//! image below its contact line, into the body's own mask above it, as far as its rectangle's margin reaches.

use glam::IVec2;
use rayon::prelude::*;

use super::Grid;
use super::coverage::{Coverage, grow};
use super::mirror::mirrored;
use super::visible::meets;
use super::zones::{Zones, fringe, seen_owner};
use crate::picture::Picture;
use crate::picture::PicturePoint;
use crate::scene::Role;
use crate::scene::TourScene;
use crate::scene::margin_px;

/// How much closer, in color, a texel must be to the body than to the background to be taken for the body.
const BODY_LIKENESS: f32 = 0.6;

/// Texels that differ less than this from the background beside them belong to it, RGB distance in codes.
const BACKGROUND_LIKE: f32 = 14.0;

/// Lets each billboard take in the parts of its body that its mask does not show, and returns who the water shows where
/// then (as [`seen_owner`]).
pub(super) fn take_in_bodies(
    scene: &TourScene,
    picture: &Picture,
    coverage: &mut Coverage,
    zones: &mut Zones,
) -> Grid<u8> {
    let size = picture.size();
    let owner = seen_owner(scene, coverage, zones);
    let reach = (margin_px(size) - fringe(size) - 1).max(0);
    let by_billboard = covered_by_billboards(scene, zones);
    for (index, zone) in zones.iter_mut().enumerate() {
        let Some(zone) = zone.as_mut().filter(|_| scene.components[index].role == Role::Billboard) else {
            continue;
        };
        let near = grow(&zone.coverage, reach, size);
        let body = Body { scene, picture, owner: &owner, index: index as u8, near, reach };
        let surface = &scene.components[index].surface;
        let below = |pixel: IVec2| {
            let point = PicturePoint::pixel_center(pixel.x.into(), pixel.y.into());
            mirrored(scene, surface, point).is_some()
        };
        let mut edge = rim(&zone.grown);
        edge.extend(rim(&coverage.grown[index]));
        let mut asked = Grid::filled(IVec2::ZERO, size, false);
        for _ in 0..reach {
            let mut beside = Vec::new();
            for pixel in edge {
                for step in [IVec2::X, IVec2::Y, IVec2::NEG_X, IVec2::NEG_Y] {
                    let pixel = pixel + step;
                    // Undecided are what the water shows of a backdrop, and the mirror image's own fringe.
                    let undecided = coverage.water.get(pixel) == Some(true)
                        && (by_billboard.get(pixel) == Some(false) || zone.grown.get(pixel) == Some(1));
                    if let Some(cell) = asked.index(pixel).filter(|&cell| undecided && !asked.cells[cell]) {
                        asked.cells[cell] = true;
                        beside.push(pixel);
                    }
                }
            }
            edge = beside.into_par_iter().filter(|&pixel| body.claims(pixel)).collect();
            for &pixel in &edge {
                if below(pixel) {
                    set(&mut zone.coverage, pixel);
                } else if meets(scene, index, pixel) {
                    coverage.give(index, pixel);
                }
            }
        }
        close(&mut zone.coverage, |pixel| coverage.water.get(pixel) == Some(true));
        zone.grown = grow(&zone.coverage, fringe(size), size);
    }
    seen_owner(scene, coverage, zones)
}

/// Pixels of the picture that a billboard's mirror image or its fringe covers.
fn covered_by_billboards(scene: &TourScene, zones: &Zones) -> Grid<bool> {
    let mut covered = Grid::filled(IVec2::ZERO, scene.camera.intrinsics.size, false);
    for (component, zone) in scene.components.iter().zip(zones.iter()) {
        let Some(zone) = zone.as_ref().filter(|_| component.role == Role::Billboard) else { continue };
        for (cell, _) in zone.grown.cells.iter().enumerate().filter(|(_, covers)| **covers > 0) {
            if let Some(at) = covered.index(zone.grown.pixel(cell)) {
                covered.cells[at] = true;
            }
        }
    }
    covered
}

/// Pixels of the picture that lie within a rectangle's margin of a billboard or of its mirror image.
pub(super) fn by_body(scene: &TourScene, coverage: &Coverage, zones: &Zones) -> Grid<bool> {
    let size = scene.camera.intrinsics.size;
    let margin = margin_px(size);
    let mut by_body = Grid::filled(IVec2::ZERO, size, false);
    for (index, component) in scene.components.iter().enumerate() {
        if component.role != Role::Billboard {
            continue;
        }
        let mirrored = zones[index].as_ref().map(|zone| &zone.coverage);
        for covered in std::iter::once(&coverage.alpha[index]).chain(mirrored) {
            let near = grow(covered, margin, size);
            for (cell, _) in near.cells.iter().enumerate().filter(|(_, covered)| **covered > 0) {
                if let Some(cell) = by_body.index(near.pixel(cell)) {
                    by_body.cells[cell] = true;
                }
            }
        }
    }
    by_body
}

/// The covered cells that have an uncovered one beside them.
fn rim(grid: &Grid<u8>) -> Vec<IVec2> {
    let covered = |pixel: IVec2| grid.get(pixel).unwrap_or(0) > 0;
    (0..grid.cells.len())
        .map(|cell| grid.pixel(cell))
        .filter(|&pixel| {
            covered(pixel)
                && [IVec2::X, IVec2::Y, IVec2::NEG_X, IVec2::NEG_Y].iter().any(|&step| !covered(pixel + step))
        })
        .collect()
}

/// Fills cracks: cells that are mostly surrounded by covered ones, where `may` allows it.
fn close(grid: &mut Grid<u8>, may: impl Fn(IVec2) -> bool) {
    for _ in 0..4 {
        let around = |pixel: IVec2| {
            (0..9)
                .filter(|&i| i != 4)
                .filter(|i| grid.get(pixel + IVec2::new(i % 3 - 1, i / 3 - 1)).unwrap_or(0) > 127)
                .count()
        };
        let cracks: Vec<usize> = (0..grid.cells.len())
            .filter(|&cell| grid.cells[cell] < 128)
            .filter(|&cell| around(grid.pixel(cell)) >= 5 && may(grid.pixel(cell)))
            .collect();
        for cell in cracks {
            grid.cells[cell] = 255;
        }
    }
}

fn set(grid: &mut Grid<u8>, pixel: IVec2) {
    if let Some(cell) = grid.index(pixel) {
        grid.cells[cell] = 255;
    }
}

/// Whether the water shows a backdrop there.
fn is_backdrop(scene: &TourScene, owner: Option<u8>) -> bool {
    owner
        .and_then(|owner| scene.components.get(usize::from(owner)))
        .is_some_and(|component| matches!(component.role, Role::LastLayer | Role::Band))
}

/// Decides for one billboard whether a water texel shows its body.
struct Body<'a> {
    scene: &'a TourScene,
    picture: &'a Picture,
    owner: &'a Grid<u8>,
    index: u8,
    /// Where the background is not to be trusted.
    near: Grid<u8>,
    reach: i32,
}

impl Body<'_> {
    /// Whether the texel is much nearer to the body's colors than to the background's beside it.
    fn claims(&self, pixel: IVec2) -> bool {
        let [mut body, mut background] = [f32::INFINITY; 2];
        let stride = (self.reach / 5).max(1);
        // The background is stratified: rows near this one, wide to the sides.
        for dy in (-self.reach..=self.reach).step_by(stride as usize) {
            for dx in (-6 * self.reach..=6 * self.reach).step_by(stride as usize) {
                let at = pixel + IVec2::new(dx, dy);
                let owner = self.owner.get(at);
                if is_backdrop(self.scene, owner) {
                    if 2 * dy.abs() <= self.reach && self.near.get(at).unwrap_or(0) == 0 {
                        background = background.min(self.distance(pixel, at));
                    }
                } else if owner == Some(self.index) && dx.abs() <= 2 * self.reach {
                    body = body.min(self.distance(pixel, at));
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
