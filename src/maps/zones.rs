//! Where each component's mirror image lies in the picture's water, and what it hides of farther ones.
//!
//! A zone is the mirrored mask; `bodies.rs` adds what only the water sees of a body.

use std::ops::{Deref, DerefMut};

use glam::{DVec3, IVec2, UVec2};

use super::Grid;
use super::beyond::frame;
use super::coverage::{Coverage, grow, is_mirrored};
use super::mirror::mirrored;
use super::seam::prolonged;
use crate::picture::PicturePoint;
use crate::scene::Role;
use crate::scene::Surface;
use crate::scene::TourScene;
use crate::scene::mirror;

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

/// Zones of all components.
pub(super) struct Zones {
    /// In the scene's order; the last layer has none, it lies behind everything.
    list: Vec<Option<Zone>>,
    /// Walls near to far as the first view draws them.
    walls: Vec<usize>,
}

impl Deref for Zones {
    type Target = [Option<Zone>];

    fn deref(&self) -> &Self::Target {
        &self.list
    }
}

impl DerefMut for Zones {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.list
    }
}

/// Zones of all components.
pub(super) fn zones(scene: &TourScene, coverage: &Coverage) -> Zones {
    let size = scene.camera.intrinsics.size;
    let fringe = fringe(size);
    let list = scene
        .components
        .iter()
        .enumerate()
        .map(|(index, component)| {
            if index == 0 || !scene.water || !is_mirrored(&component.surface) {
                return None;
            }
            let alpha = match component.role {
                Role::Band => &prolonged(scene, index, &coverage.alpha[index]),
                _ => &coverage.alpha[index],
            };
            let (low, high) = mirror_box(scene, &component.surface, alpha)?;
            let zone = Grid::from_fn(low, (high - low).as_uvec2(), |pixel| {
                let point = PicturePoint::pixel_center(pixel.x.into(), pixel.y.into());
                mirrored(scene, &component.surface, point)
                    .map_or(0, |found| (255.0 * alpha.coverage(found.direct)).round() as u8)
            });
            // Bodies still grow in theirs.
            let zone = if component.role == Role::Band { covered_rows(zone) } else { zone };
            Some(Zone { grown: grow(&zone, fringe, size), coverage: zone })
        })
        .collect();
    let order = scene.near_to_far(scene.camera.pose.position);
    Zones { list, walls: scene.walls_of(&order).collect() }
}

/// The rows of a zone that cover anything, and a free one above and below where there is one: a band's box is the
/// whole frame.
fn covered_rows(zone: Grid<u8>) -> Grid<u8> {
    let rows = || zone.cells.chunks(zone.size.x.max(1) as usize);
    let covers = |row: &[u8]| row.iter().any(|&covered| covered > 0);
    let (Some(first), Some(last)) = (rows().position(covers), rows().rposition(covers)) else {
        return Grid::filled(zone.origin, UVec2::ONE, 0);
    };
    let (first, last) = (first.saturating_sub(1), (last + 1).min(zone.size.y as usize - 1));
    let width = zone.size.x as usize;
    Grid {
        origin: zone.origin + IVec2::new(0, first as i32),
        size: UVec2::new(zone.size.x, (last + 1 - first) as u32),
        cells: zone.cells[first * width..(last + 1) * width].to_vec(),
    }
}

/// Width of the fringe in pixels.
pub(super) fn fringe(size: UVec2) -> i32 {
    (MIRROR_FRINGE * f64::from(size.x)).round().max(2.0) as i32
}

/// The box of pixels in which a surface's mirror image can lie, low and high corner; `None` when that is not in the
/// maps' frame.
fn mirror_box(scene: &TourScene, surface: &Surface, alpha: &Grid<u8>) -> Option<(IVec2, IVec2)> {
    let (least, most) = frame(scene.camera.intrinsics.size);
    // Where a corner lies behind the camera the image runs out of the frame somewhere.
    let (low, high) = mirrored_corners(scene, surface, alpha).map_or((least, most), |corners| {
        let near = |edge: f64| edge.clamp(-1e6, 1e6) as i32;
        corners.iter().fold((IVec2::MAX, IVec2::MIN), |(low, high), corner| {
            let [x, y] = [near(corner.x()), near(corner.y())];
            (low.min(IVec2::new(x, y) - 3), high.max(IVec2::new(x, y) + 3))
        })
    });
    let (low, high) = (low.max(least), high.min(most));
    low.cmplt(high).all().then_some((low, high))
}

/// Where the corners of a wall's part above the water, or of a level's covered part, are mirrored.
fn mirrored_corners(scene: &TourScene, surface: &Surface, alpha: &Grid<u8>) -> Option<Vec<PicturePoint>> {
    let points: Vec<DVec3> = match surface {
        Surface::Wall(wall) => {
            wall.span.iter().flat_map(|&s| [0.0, wall.rise[1]].map(|y| wall.point(s, y))).collect()
        }
        Surface::Level(_) => {
            let covered = |index: &usize| alpha.cells[*index] > 0;
            let pixels = || (0..alpha.cells.len()).filter(covered).map(|index| alpha.pixel(index));
            let (low, high) = (pixels().reduce(IVec2::min)?, pixels().reduce(IVec2::max)? + 1);
            let corner = |x: i32, y: i32| {
                let ray = scene.camera.ray(PicturePoint::new(x.into(), y.into()));
                surface.meet_plane(ray).map(|t| ray.at(t))
            };
            [(low.x, low.y), (high.x, low.y), (low.x, high.y), (high.x, high.y)]
                .into_iter()
                .map(|(x, y)| corner(x, y))
                .collect::<Option<_>>()?
        }
        Surface::Infinity => return None,
    };
    points.into_iter().map(|point| scene.camera.project(mirror(point))).collect()
}

impl Zones {
    /// The components whose fringe covers a water pixel, far to near as the tracer meets them: walls in the order of the
    /// first view, the level ground where its distance puts it.
    pub(super) fn stack_at(&self, scene: &TourScene, pixel: IVec2) -> Vec<usize> {
        let point = PicturePoint::pixel_center(pixel.x.into(), pixel.y.into());
        let met = |index: usize| {
            let zone = self.list[index].as_ref()?;
            let parameter = mirrored(scene, &scene.components[index].surface, point)?.parameter;
            Some((parameter, index, zone.grown.get(pixel).unwrap_or(0) > 0))
        };
        let mut ground = scene.ground().and_then(met).filter(|(.., covers)| *covers);
        let mut stack = Vec::new();
        // A wall hides the ground behind it, or is hidden, also where its layer is empty: so does the tracer.
        for (parameter, wall, covers) in self.walls.iter().filter_map(|&wall| met(wall)) {
            stack.extend(ground.take_if(|(nearer, ..)| *nearer < parameter).map(|(_, index, _)| index));
            stack.extend(covers.then_some(wall));
        }
        stack.extend(ground.map(|(_, index, _)| index));
        stack.reverse();
        stack
    }
}

/// Per picture pixel the component whose mirror image, and nothing else, the water shows there; 255 for none.
pub(super) fn seen_owner(scene: &TourScene, coverage: &Coverage, zones: &Zones) -> Grid<u8> {
    Grid::from_fn(IVec2::ZERO, scene.camera.intrinsics.size, |pixel| {
        if !coverage.water.get(pixel).unwrap_or(false) {
            return 255;
        }
        match zones.stack_at(scene, pixel).last() {
            None => 0,
            Some(&nearest) => {
                let covered = zones[nearest].as_ref().and_then(|zone| zone.coverage.get(pixel)).unwrap_or(0);
                if covered >= 250 { nearest as u8 } else { 255 }
            }
        }
    })
}
