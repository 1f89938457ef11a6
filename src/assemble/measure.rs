//! Distances of a tour's picture by its mirror image, and what else the mirror image says of the tour's marks.

use glam::UVec2;

use super::{TourSource, annotations};
use crate::camera::PinholeCamera;
use crate::depth::{
    DepthError, DepthMap, DepthOptions, DepthPair, ObjectDepth, Waterline, measure, object_depth, pairs,
    waterline,
};
use crate::picture::{Mask, PicturePoint};
use crate::scene::{Surface, TourScene, Wall};
use crate::solve::{AnnotatedPair, PairPlane, Solution, SolveError, solve};

/// The most pairs that are looked for: more of them tell the same again.
const MOST_PAIRS: usize = 400;

/// Fewer pairs say no more than a person's marks.
const FEWEST_PAIRS: usize = 10;

/// Deviation of a pair's point, pixels. Its reflection's says all: it is that of one against the other.
const POINT_PX: f64 = 1e-3;

/// Measures the distances that the water's mirror image tells; `None` without water.
///
/// `camera` is the solved one. `progress` hears the share done, 0–1, and cancels with `false`.
///
/// # Errors
///
/// This returns an error when the camera looks so steeply that nothing can be matched, or when cancelled.
pub fn measure_depth(
    source: &TourSource,
    camera: &PinholeCamera,
    progress: &dyn Fn(f32) -> bool,
) -> Result<Option<DepthMap>, DepthError> {
    let Some(water) = &source.water else { return Ok(None) };
    measure(&source.picture, water, camera, camera.pose.position.y, &depth_options(source, 1.0), progress)
        .map(Some)
}

/// How a tour's picture is measured, where `scale` of its pixels make one that is looked at.
pub(super) fn depth_options(source: &TourSource, scale: f64) -> DepthOptions {
    // Without a mark the horizon follows from pairs, which are marked no better.
    let horizon_deviation_px = annotations(source).horizon_deviation_px / scale;
    DepthOptions { horizon_deviation_px, ..DepthOptions::default() }
}

/// What shows the background: everything but water, ground, objects, and the sky where it is marked.
#[must_use]
pub fn background_mask(source: &TourSource) -> Mask {
    let others = source.water.iter().chain(&source.ground).chain(&source.objects).chain(&source.sky);
    let size = source.picture.size();
    rest(size, others)
}

/// What some masks leave of a picture.
fn rest<'a>(size: UVec2, masks: impl Iterator<Item = &'a Mask>) -> Mask {
    let mut left = vec![255_u8; size.x as usize * size.y as usize];
    for mask in masks {
        for (left, &taken) in left.iter_mut().zip(mask.values()) {
            *left = left.saturating_sub(taken);
        }
    }
    // The picture has pixels, and `left` one value for each.
    Mask::new(size, left).unwrap_or_else(|_| unreachable!("a picture has at least one pixel"))
}

/// What a picture's mirror image says of the marks made on it.
#[derive(Clone, Debug)]
pub struct DepthHints {
    /// What stands upright, and whose distance is finite: objects in the tour's order, then what closes the scene.
    pub standing: Vec<StandingHint>,
    /// The far edge of the water, where enough of it is known.
    pub waterline: Option<Waterline>,
    /// Pairs that the mirror image shows.
    pub pairs: Vec<DepthPair>,
    /// The camera by the marks and all these pairs; `None` with few pairs, or where they fix none.
    pub by_pairs: Option<Solution>,
}

/// An upright component's distance by the marks, and by its mirror image.
#[derive(Clone, Debug)]
pub struct StandingHint {
    /// The component's name.
    pub name: String,
    /// Where its plane stands in the middle of what is seen of it, meters along −z.
    pub distance: f64,
    /// What its mirror image says to that.
    pub by_mirror: ObjectDepth,
}

/// Holds a tour's marks against the distances by its mirror image.
#[must_use]
pub fn hints(source: &TourSource, scene: &TourScene, map: &DepthMap) -> DepthHints {
    let wall = |name: &str| {
        scene.components.iter().find(|component| component.name == name).and_then(|component| match component
            .surface
        {
            Surface::Wall(wall) => Some(wall),
            Surface::Level(_) | Surface::Infinity => None,
        })
    };
    let hint = |name: &str, mask: &Mask| {
        let ends = ends(&scene.camera, &wall(name)?, mask)?;
        // Along a line seen in perspective 1/depth is linear.
        let distance = 2.0 / (1.0 / ends[0].1 + 1.0 / ends[1].1);
        let by_mirror = object_depth(map, mask, ends);
        Some(StandingHint { name: name.to_owned(), distance, by_mirror })
    };
    let tour = &source.tour;
    let objects = tour.objects.iter().zip(&source.objects).map(|(object, mask)| hint(&object.name, mask));
    let behind = background_mask(source);
    let marked: Vec<&Mask> = source.bands.iter().flatten().collect();
    let size = source.picture.size();
    let others = rest(size, std::iter::once(&behind));
    let left = rest(size, marked.into_iter().chain([&others]));
    let bands = tour.background.bands.iter().zip(&source.bands);
    let bands = bands.map(|(band, mask)| hint(&band.name, mask.as_ref().unwrap_or(&left)));
    let standing = objects.chain(bands).chain([hint("background", &left)]).flatten().collect();
    let (pairs, waterline) = match &source.water {
        Some(water) => (
            pairs(&source.picture, water, &scene.camera, map, MOST_PAIRS),
            waterline(map, water, &scene.camera),
        ),
        None => (Vec::new(), None),
    };
    let by_pairs = if pairs.len() < FEWEST_PAIRS { None } else { solve_with(source, &pairs).ok() };
    DepthHints { standing, waterline, pairs, by_pairs }
}

/// Solves a tour by its marks and by pairs found in its mirror image, each with the deviation that it was found with.
///
/// # Errors
///
/// This returns an error when all of that does not fix a camera.
pub fn solve_with(source: &TourSource, found: &[DepthPair]) -> Result<Solution, SolveError> {
    let mut marks = annotations(source);
    marks.pairs.extend(found.iter().enumerate().map(|(i, pair)| AnnotatedPair {
        name: format!("found pair {}", i + 1),
        point: pair.point,
        reflection: pair.reflection,
        on: PairPlane::Free,
        point_deviation_px: POINT_PX,
        reflection_deviation_px: pair.deviation_px,
    }));
    solve(&marks)
}

/// The depths of a wall below the left and right end of what is seen of it.
fn ends(camera: &PinholeCamera, wall: &Wall, mask: &Mask) -> Option<[(PicturePoint, f64); 2]> {
    let bounds = mask.bounds()?;
    let [left, right] = [bounds.min.x, bounds.max.x].map(|x| {
        let point = PicturePoint::new(f64::from(x), f64::from(bounds.max.y));
        let ray = camera.ray(point);
        wall.meet_plane(ray).map(|t| (point, -ray.at(t).z)).filter(|(_, depth)| *depth > 0.0)
    });
    Some([left?, right?])
}
