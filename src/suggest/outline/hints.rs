//! What a person says about where an object is, and what follows for each cell.

use glam::{DVec2, UVec2};
use rayon::prelude::*;

use super::grid::Grid;
use super::mixture::Mixture;
use super::scaled::Scaled;
use super::stroke::for_each_near;
use super::{OutlineError, Side, Stroke};
use crate::picture::{Mask, PicturePoint, PixelRect};

/// The surroundings of a box that are looked at, as a share of its sides, and at least, pixels.
const MARGIN: f64 = 0.5;
const LEAST_MARGIN: f64 = 24.0;

/// How much more a cell may cost than strokes do and still look like them, natural logarithm of a likelihood ratio.
const LIKE: f32 = 2.0;

/// What costs more on the outer side than this share of what is certainly there is at first taken for the object.
const USUAL: f64 = 0.9;

/// Seed of the mixture that tells what is strange.
const SEED: u64 = 3;

/// Parts of the mixtures of what is certainly outside, and of strokes on one side.
const OUTER_PARTS: usize = 10;
const STROKE_PARTS: usize = 4;

/// A side of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// Two points of the line.
    pub line: [PicturePoint; 2],
    /// Whether the region is the side of smaller y.
    pub is_above: bool,
}

impl Bound {
    pub(super) fn holds(&self, pixel: UVec2) -> bool {
        let [a, b] = self.line.map(|point| point.0);
        let along = (b - a) * (b.x - a.x).signum();
        let below = along.perp_dot(pixel.as_dvec2() + 0.5 - a);
        // Not a number for a line that is none.
        below.is_nan() || (if self.is_above { below <= 0.0 } else { below >= 0.0 })
    }

    /// The part of a block that may lie on that side: the rows with a pixel of it.
    fn clip(&self, rect: PixelRect) -> PixelRect {
        let is_held = |y: &u32| [rect.min.x, rect.max.x - 1].iter().any(|&x| self.holds(UVec2::new(x, *y)));
        let first = (rect.min.y..rect.max.y).find(is_held).unwrap_or(rect.max.y);
        let last = (first..rect.max.y).rfind(is_held).map_or(first, |last| last + 1);
        PixelRect { min: UVec2::new(rect.min.x, first), max: UVec2::new(rect.max.x, last) }
    }
}

/// What a person says about where an object or a region is.
#[derive(Clone, Copy, Debug, Default)]
pub struct ObjectHints<'a> {
    /// Two opposite corners of a box outside which nothing of the object is, unless a stroke on it reaches beyond.
    pub corners: Option<[PicturePoint; 2]>,
    /// Strokes on the object and beside it; later ones win.
    pub strokes: &'a [Stroke],
    /// A first guess, to be mended; with strokes, only in pieces that a stroke on their side touches.
    pub earlier: Option<&'a Mask>,
    /// Whether holes in it are filled: right for a house or a boat, wrong for foliage.
    pub is_solid: bool,
    /// A line that it does not cross, and the side that it stays on.
    pub bound: Option<Bound>,
}

impl ObjectHints<'_> {
    /// Low and high corner of the box within the picture; `None` without one that holds a pixel.
    fn box_in(&self, size: UVec2) -> Option<[DVec2; 2]> {
        let [a, b] = self.corners?.map(|corner| corner.0);
        let limit = size.as_dvec2();
        let [low, high] = [a.min(b), a.max(b)].map(|corner| corner.clamp(DVec2::ZERO, limit));
        if !a.is_finite() || !b.is_finite() || (high - low).min_element() < 1.0 {
            return None;
        }
        // Who draws on the object beyond the box has drawn the box too small.
        let strokes = self.strokes.iter().filter(|stroke| stroke.side == Side::Inside);
        let points = strokes.flat_map(|stroke| stroke.points.iter().map(|point| (point.0, stroke.reach())));
        let reached = points
            .filter(|(point, _)| point.is_finite())
            .fold([low, high], |[low, high], (at, reach)| [low.min(at - reach), high.max(at + reach)]);
        Some(reached.map(|corner| corner.clamp(DVec2::ZERO, limit)))
    }

    /// The block of the picture to look at, never empty.
    pub(super) fn rect(&self, size: UVec2) -> Result<PixelRect, OutlineError> {
        let rect = self.unbound_rect(size)?;
        let rect = self.bound.map_or(rect, |bound| bound.clip(rect));
        if rect.size().min_element() == 0 { Err(OutlineError::BeyondBound) } else { Ok(rect) }
    }

    fn unbound_rect(&self, size: UVec2) -> Result<PixelRect, OutlineError> {
        if let Some(mask) = self.earlier
            && mask.size() != size
        {
            return Err(OutlineError::WrongSize { mask: mask.size(), picture: size });
        }
        let whole = PixelRect { min: UVec2::ZERO, max: size };
        if let Some([low, high]) = self.box_in(size) {
            let margin = ((high - low) * MARGIN).max(DVec2::splat(LEAST_MARGIN));
            let min = (low - margin).floor().max(DVec2::ZERO).as_uvec2();
            return Ok(PixelRect { min, max: (high + margin).ceil().min(size.as_dvec2()).as_uvec2() });
        }
        if let Some(bounds) = self.earlier.and_then(Mask::bounds) {
            let margin = (bounds.size() / 4).max(UVec2::splat(LEAST_MARGIN as u32));
            let mut rect =
                PixelRect { min: bounds.min.saturating_sub(margin), max: (bounds.max + margin).min(size) };
            // What is stroked now lies beyond the mask when it had missed something.
            for point in
                self.strokes.iter().flat_map(|stroke| &stroke.points).filter(|point| point.0.is_finite())
            {
                let pixel = point.0.clamp(DVec2::ZERO, size.as_dvec2() - 1.0).as_uvec2();
                rect.min = rect.min.min(pixel.saturating_sub(margin));
                rect.max = rect.max.max((pixel + margin).min(size));
            }
            return Ok(rect);
        }
        let is_marked =
            self.strokes.iter().any(|stroke| stroke.side == Side::Inside && !stroke.points.is_empty());
        if !is_marked {
            return Err(OutlineError::NothingMarked);
        }
        // Strokes beside the object enclose it; without one it may be anywhere.
        if self.strokes.iter().any(|stroke| stroke.side == Side::Outside) {
            let points =
                self.strokes.iter().flat_map(|stroke| &stroke.points).filter(|point| point.0.is_finite());
            let corners = points.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], point| {
                [low.min(point.0), high.max(point.0)]
            });
            let hints = ObjectHints { corners: Some(corners.map(PicturePoint)), ..*self };
            if hints.box_in(size).is_some() {
                return hints.unbound_rect(size);
            }
        }
        Ok(whole)
    }

    /// What places are told in shares of, pixels: the box, or all that is looked at.
    pub(super) fn extent(&self, size: UVec2, rect: PixelRect) -> DVec2 {
        self.box_in(size).map_or(rect.size().as_dvec2(), |[low, high]| high - low)
    }

    /// What is certain of each cell, and whether a stroke says so.
    pub(super) fn known(&self, size: UVec2, scaled: &Scaled) -> (Vec<Option<bool>>, Vec<bool>) {
        let mut known = vec![None; scaled.colors.len()];
        let mut is_stroked = vec![false; known.len()];
        if let Some([low, high]) = self.box_in(size) {
            for (cell, known) in known.iter_mut().enumerate() {
                let center = scaled.pixel(cell).as_dvec2() + 0.5;
                if !(center.cmpge(low) & center.cmple(high)).all() {
                    *known = Some(false);
                }
            }
        }
        for stroke in self.strokes {
            for_each_near(size, &stroke.points, stroke.reach(), |x, y, _| {
                if let Some(cell) = scaled.cell(x, y) {
                    known[cell] = Some(stroke.side == Side::Inside);
                    is_stroked[cell] = true;
                }
            });
        }
        if let Some(bound) = self.bound {
            for (cell, known) in known.iter_mut().enumerate() {
                if !bound.holds(scaled.pixel(cell)) {
                    // The line says so, not the stroke that crosses it.
                    (*known, is_stroked[cell]) = (Some(false), false);
                }
            }
        }
        (known, is_stroked)
    }

    /// First guesses for each cell, the likeliest first; `None` for cells of which nothing is guessed.
    pub(super) fn first_labels(&self, size: UVec2, grid: &Grid) -> Vec<Vec<Option<bool>>> {
        let Grid { scaled, known, .. } = grid;
        let with = |guess: &dyn Fn(usize) -> Option<bool>| {
            known.iter().enumerate().map(|(cell, known)| known.or_else(|| guess(cell))).collect()
        };
        if let Some(mask) = self.earlier {
            let is_in = |pixel: UVec2| mask.get(pixel.x, pixel.y) >= 128;
            return vec![with(&|cell| Some(is_in(scaled.pixel(cell))))];
        }
        if self.box_in(size).is_some() {
            let strange = strange(grid).map(|strange| with(&|cell| Some(strange[cell])));
            return strange.into_iter().chain([with(&|_| Some(true))]).collect();
        }
        // Strokes on both sides speak for themselves; without one beside the object, all the rest is beside it.
        let is_outside_known = known.contains(&Some(false));
        vec![with(&|_| (!is_outside_known).then_some(false))]
    }
}

/// Which cells are likely inside: those that look like strokes on the object, and those that look neither like strokes
/// beside it nor like what is certainly outside; `None` when nothing is certainly outside.
fn strange(grid: &Grid) -> Option<Vec<bool>> {
    let Grid { samples, known, is_stroked, .. } = grid;
    let costs_of = |mixture: &Mixture| -> Vec<f32> {
        samples.par_iter().map(|sample| mixture.cheapest(sample).1).collect()
    };
    let outer = Mixture::clustered(samples, OUTER_PARTS, SEED, |cell| {
        f32::from(u8::from(known[cell] == Some(false)))
    })?;
    let costs = costs_of(&outer);
    let limit = quantile(&costs, USUAL, |cell| known[cell] == Some(false))?;
    // What strokes look like, wherever else it may be, and how unlike it the strokes themselves are at most.
    let stroked = |side: bool| {
        let is_member = |cell: usize| is_stroked[cell] && known[cell] == Some(side);
        let mixture =
            Mixture::clustered(samples, STROKE_PARTS, SEED, |cell| f32::from(u8::from(is_member(cell))))?;
        let costs = costs_of(&mixture);
        Some((quantile(&costs, USUAL, is_member)? + LIKE, costs))
    };
    let [beside, on] = [stroked(false), stroked(true)];
    let cost = |side: &Option<(f32, Vec<f32>)>, cell: usize| {
        side.as_ref().map_or(f32::INFINITY, |(_, costs)| costs[cell])
    };
    let is_inside = |cell: usize| {
        let [beside_cost, on_cost] = [&beside, &on].map(|side| cost(side, cell));
        if on_cost < costs[cell].min(beside_cost) {
            return true;
        }
        let is_beside =
            beside.as_ref().is_some_and(|(limit, _)| beside_cost < *limit && beside_cost < on_cost);
        costs[cell] > limit && !is_beside
    };
    Some((0..costs.len()).map(is_inside).collect())
}

/// The cost that a share of the members stays below; `None` without a member.
fn quantile(costs: &[f32], share: f64, is_member: impl Fn(usize) -> bool) -> Option<f32> {
    let mut members: Vec<f32> =
        (0..costs.len()).filter(|cell| is_member(*cell)).map(|cell| costs[cell]).collect();
    members.sort_unstable_by(f32::total_cmp);
    members.get((members.len().saturating_sub(1) as f64 * share) as usize).copied()
}
