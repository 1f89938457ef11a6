//! Soft edges for what was outlined by hand.
//!
//! A mask with soft edges of its own is a matte already, made by a renderer or a patient person, and stays as it is.

use glam::{IVec2, UVec2};
use rayon::prelude::*;

use super::coverage::is_above_contact;
use super::matte::{Matte, MatteInput, matte};
use super::{Edge, Grid, TourMasks};
use crate::picture::Mask;
use crate::picture::Picture;
use crate::picture::color::linear_from_srgb;
use crate::scene::Role;
use crate::scene::TourScene;

/// How far the true edge may lie from an outline drawn by hand, and from a mask that is all or nothing, in pixels per
/// pixel of picture width; measured on outlines with a known truth.
pub(super) const OUTLINED: f32 = 2.0 / 960.0;
const HARD: f32 = 1.0 / 960.0;

/// A mask whose edge has fewer partly covered pixels than this share of its length is all or nothing.
const SOFT_SHARE: f32 = 0.3;

/// Cells around a mask's box that a matte looks at, besides the band in which the edge may lie.
const AROUND: i32 = 12;

/// What stands in a tour, cut out softly.
pub(super) struct CutOut {
    /// Visible coverage of each billboard, in the scene's order.
    pub masks: Vec<Mask>,
    /// Per component its own colors without what shines through its edge, linear light; `None` for those not cut out here.
    pub colors: Vec<Option<Grid<[f32; 3]>>>,
}

/// Makes hard edges soft; `None` if canceled.
pub(super) fn cut_out(
    scene: &TourScene,
    picture: &Picture,
    masks: &TourMasks,
    progress: &dyn Fn(f32, &str) -> bool,
) -> Option<CutOut> {
    let billboards =
        (0..scene.components.len()).filter(|&index| scene.components[index].role == Role::Billboard);
    let count = masks.billboards.len() as f32;
    let mut cut = CutOut {
        masks: masks.billboards.iter().copied().cloned().collect(),
        colors: vec![None; scene.components.len()],
    };
    for (place, index) in billboards.enumerate() {
        let share = match masks.edges.get(place) {
            Some(Edge::Outlined) => OUTLINED,
            Some(Edge::Mask) if is_hard(masks.billboards[place]) => HARD,
            _ => continue,
        };
        let what = format!("cutting out: {}", scene.components[index].name);
        let go_on = |done: f32| progress((place as f32 + done) / count, &what);
        let radius = (share * picture.size().x as f32).max(1.0);
        let (mask, colors) = softened(scene, picture, masks, place, index, radius, &go_on)?;
        (cut.masks[place], cut.colors[index]) = (mask, colors);
    }
    Some(cut)
}

/// One mask with the soft edge that the picture shows within `radius` pixels of its own, and the object's own colors.
fn softened(
    scene: &TourScene,
    picture: &Picture,
    masks: &TourMasks,
    place: usize,
    index: usize,
    radius: f32,
    progress: &dyn Fn(f32) -> bool,
) -> Option<(Mask, Option<Grid<[f32; 3]>>)> {
    let mask = masks.billboards[place];
    let unchanged = || Some((mask.clone(), None));
    let Some(bounds) = mask.bounds() else { return unchanged() };
    let reach = radius.ceil() as i32 + AROUND;
    let low = (bounds.min.as_ivec2() - reach).max(IVec2::ZERO).as_uvec2();
    let high = (bounds.max.as_ivec2() + reach).min(mask.size().as_ivec2()).as_uvec2();
    let width = (high.x - low.x) as usize;
    let pixels: Vec<UVec2> =
        (low.y..high.y).flat_map(|y| (low.x..high.x).map(move |x| UVec2::new(x, y))).collect();
    let colors: Vec<[f32; 3]> =
        pixels.par_iter().map(|at| picture.pixel(at.x, at.y).map(linear_from_srgb)).collect();
    let coverage: Vec<u8> = pixels.par_iter().map(|at| mask.without_dust(at.x, at.y)).collect();
    // Where it meets its mirror image both sides look alike, and other objects may stand before it.
    let others = |at: &UVec2| {
        let covers = |(other, mask): (usize, &&Mask)| other != place && mask.get(at.x, at.y) >= 128;
        masks.billboards.iter().enumerate().any(covers)
    };
    let foreign: Vec<bool> =
        pixels.par_iter().map(|at| others(at) || !is_above_contact(scene, index, at.as_ivec2())).collect();
    let input = MatteInput {
        width,
        colors: &colors,
        mask: &coverage,
        inside: radius,
        outside: radius,
        foreign: Some(&foreign),
    };
    let Matte { alpha, foreground } = matte(&input, progress)?;
    let mut values = mask.values().to_vec();
    for (at, alpha) in pixels.iter().zip(alpha) {
        values[at.y as usize * mask.size().x as usize + at.x as usize] = alpha;
    }
    match Mask::new(mask.size(), values) {
        Ok(soft) if soft.bounds().is_some() => {
            let colors = Grid { origin: low.as_ivec2(), size: high - low, cells: foreground };
            Some((soft, Some(colors)))
        }
        // What is too faint to be seen at all stays the outline.
        _ => unchanged(),
    }
}

/// Whether a mask knows only all or nothing.
fn is_hard(mask: &Mask) -> bool {
    let size = mask.size();
    let (mut edge, mut partly) = (0_u32, 0_u32);
    for y in 0..size.y {
        for x in 0..size.x {
            let own = mask.without_dust(x, y);
            partly += u32::from(own > 0 && own < 255);
            let beside = (x + 1 < size.x && (mask.get(x + 1, y) >= 128) != (own >= 128))
                || (y + 1 < size.y && (mask.get(x, y + 1) >= 128) != (own >= 128));
            edge += u32::from(beside);
        }
    }
    edge > 0 && (partly as f32) < SOFT_SHARE * edge as f32
}
