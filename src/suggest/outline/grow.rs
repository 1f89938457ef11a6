//! A region grown from a stroke or a click: water, sky, ground.
//!
//! It spreads from cell to neighboring cell while color goes on as it did (a running mean is handed on, so slow gradients are
//! followed), stays of the stroke's kind, is no rougher than the stroke, and crosses no edge that is strong for the
//! stroke's own texture. Each piece of the stroke speaks for what grows from it: one stroke may cross several matters.

use std::collections::VecDeque;

use glam::{UVec2, Vec3};
use rayon::prelude::*;

use super::guided::upsampled;
use super::parts::fill_holes;
use super::scaled::Scaled;
use super::stroke::for_each_near;
use super::{Bound, OutlineError, Stroke};
use crate::picture::{Mask, Picture, PixelRect};

/// Most cells that are looked at.
const MOST_CELLS: u32 = 1 << 19;

/// Cells to each side that texture is judged by.
const REACH: usize = 2;

/// Noise of colors that is always borne, 0–1: standard deviation.
const NOISE: f32 = 0.012;

/// How much of the difference to the running mean a cell hands on.
const DRIFT: f32 = 0.06;

/// Bounds in units of the stroke's own: difference to the running mean, step to the neighbor, roughness.
const FROM_MEAN: f32 = 3.0;
const STEP: f32 = 3.0;
const ROUGHNESS: f32 = 1.6;

/// How far from the stroke's colors a gradient may lead, 0–1, besides what the stroke itself spans.
const FAR: f32 = 0.25;

/// Holes of less than this share of all cells are filled.
const HOLE: f64 = 0.001;

/// How a region grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrowOptions {
    /// What it takes for the region to stop, against what the stroke shows: 1 is usual, more grows on. Used as 0.1–10, 1
    /// when not finite.
    pub tolerance: f64,
    /// A line that the region does not cross, and the side that it stays on: water and ground stay below the horizon
    /// (better: the waterline), sky above it. A line of points that are not finite or fall together is none.
    pub bound: Option<Bound>,
}

impl Default for GrowOptions {
    fn default() -> Self {
        Self { tolerance: 1.0, bound: None }
    }
}

/// The region around a stroke (of either side), of the picture's size, soft along its border.
///
/// # Errors
///
/// [`OutlineError::NothingMarked`] when no pixel lies under the stroke, [`OutlineError::BeyondBound`] when none of them is on
/// the bound's side.
pub fn grow(picture: &Picture, stroke: &Stroke, options: GrowOptions) -> Result<Mask, OutlineError> {
    let tolerance =
        if options.tolerance.is_finite() { options.tolerance.clamp(0.1, 10.0) as f32 } else { 1.0 };
    let size = picture.size();
    let whole = PixelRect { min: UVec2::ZERO, max: size };
    let scaled = Scaled::new(picture, whole, MOST_CELLS);
    let is_allowed: Vec<bool> = (0..scaled.colors.len())
        .map(|cell| options.bound.is_none_or(|bound| bound.holds(scaled.pixel(cell))))
        .collect();
    let mut inside = vec![false; scaled.colors.len()];
    let mut pieces: Vec<Vec<usize>> = Vec::new();
    let mut is_drawn = false;
    for piece in stroke.pieces() {
        let mut cells = Vec::new();
        for_each_near(size, &piece, stroke.reach(), |x, y, _| {
            let Some(cell) = scaled.cell(x, y) else { return };
            is_drawn = true;
            if is_allowed[cell] && !inside[cell] {
                inside[cell] = true;
                cells.push(cell);
            }
        });
        pieces.push(cells);
    }
    pieces.retain(|cells| !cells.is_empty());
    if pieces.is_empty() {
        return Err(if is_drawn { OutlineError::BeyondBound } else { OutlineError::NothingMarked });
    }
    let matter = Matter::of(&scaled);
    let kinds: Vec<Kind> = pieces.par_iter().map(|cells| Kind::of(&matter, cells, tolerance)).collect();
    spread(&matter, &kinds, &pieces, &is_allowed, &mut inside);
    let most = (HOLE * inside.len() as f64) as usize;
    fill_holes(matter.width, &mut inside, most);
    Ok(upsampled(picture, &scaled, &inside))
}

/// What each cell is like.
#[derive(Debug)]
struct Matter {
    width: usize,
    height: usize,
    /// Mean color of three by three cells.
    colors: Vec<Vec3>,
    /// Standard deviation of color around the cell, 0–1.
    roughness: Vec<f32>,
}

impl Matter {
    fn of(scaled: &Scaled) -> Self {
        let (width, height) = (scaled.width, scaled.height);
        let mean =
            |reach: usize, value: &(dyn Fn(usize) -> Vec3 + Sync)| box_means(width, height, reach, value);
        let colors = mean(1, &|cell| scaled.colors[cell]);
        let means = mean(REACH, &|cell| scaled.colors[cell]);
        let squares = mean(REACH, &|cell| scaled.colors[cell] * scaled.colors[cell]);
        let variance =
            means.par_iter().zip(&squares).map(|(mean, square)| (*square - *mean * *mean).element_sum());
        let roughness = variance.map(|variance| variance.max(0.0).sqrt()).collect();
        Self { width, height, colors, roughness }
    }
}

/// Means over the cells within `reach` of each cell in both directions.
fn box_means(width: usize, height: usize, reach: usize, value: &(dyn Fn(usize) -> Vec3 + Sync)) -> Vec<Vec3> {
    let mut means = vec![Vec3::ZERO; width * height];
    means.par_chunks_mut(width).enumerate().for_each_init(Vec::new, |columns, (y, row)| {
        columns.clear();
        columns.resize(width, Vec3::ZERO);
        let rows = y.saturating_sub(reach)..(y + reach + 1).min(height);
        let count = rows.len() as f32;
        for other in rows {
            for (x, column) in columns.iter_mut().enumerate() {
                *column += value(other * width + x);
            }
        }
        for (x, mean) in row.iter_mut().enumerate() {
            let near = &columns[x.saturating_sub(reach)..(x + reach + 1).min(width)];
            *mean = near.iter().sum::<Vec3>() / (count * near.len() as f32);
        }
    });
    means
}

/// What a piece of the stroke says of the region: bounds for its cells.
#[derive(Debug)]
struct Kind {
    /// A few of the stroke's colors.
    colors: Vec<Vec3>,
    far: f32,
    from_mean: f32,
    step: f32,
    roughness: f32,
}

impl Kind {
    fn of(matter: &Matter, seeds: &[usize], tolerance: f32) -> Self {
        // Less than half of it may be a speck or an edge that the stroke crosses.
        let usual = |mut values: Vec<f32>| {
            let middle = values.len() / 2;
            *values.select_nth_unstable_by(middle, f32::total_cmp).1
        };
        let roughness = usual(seeds.iter().map(|cell| matter.roughness[*cell]).collect()).max(NOISE);
        let steps = seeds.iter().filter(|cell| *cell % matter.width + 1 < matter.width);
        let steps =
            steps.map(|cell| matter.colors[*cell].distance(matter.colors[cell + 1])).collect::<Vec<_>>();
        let step = if steps.is_empty() { NOISE } else { usual(steps).max(NOISE) };
        let every = seeds.len().div_ceil(32);
        Self {
            colors: seeds.iter().step_by(every).map(|cell| matter.colors[*cell]).collect(),
            far: tolerance * FAR,
            from_mean: tolerance * FROM_MEAN * roughness,
            step: tolerance * STEP * step,
            roughness: tolerance * ROUGHNESS * roughness,
        }
    }

    fn is_like(&self, color: Vec3) -> bool {
        self.colors.iter().any(|own| own.distance_squared(color) <= self.far * self.far)
    }
}

/// Adds to `inside` what the pieces reach, in rings around them.
fn spread(matter: &Matter, kinds: &[Kind], pieces: &[Vec<usize>], is_allowed: &[bool], inside: &mut [bool]) {
    let (width, height) = (matter.width, matter.height);
    let seeds =
        kinds.iter().zip(pieces).flat_map(|(kind, cells)| cells.iter().map(move |cell| (kind, *cell)));
    let mut front: VecDeque<(&Kind, usize, Vec3)> =
        seeds.map(|(kind, cell)| (kind, cell, matter.colors[cell])).collect();
    while let Some((kind, cell, mean)) = front.pop_front() {
        let (x, y) = (cell % width, cell / width);
        let near = [
            (x > 0).then(|| cell - 1),
            (x + 1 < width).then(|| cell + 1),
            (y > 0).then(|| cell - width),
            (y + 1 < height).then(|| cell + width),
        ];
        for next in near.into_iter().flatten() {
            let color = matter.colors[next];
            let goes_on = !inside[next]
                && is_allowed[next]
                && matter.roughness[next] <= kind.roughness
                && color.distance(mean) <= kind.from_mean
                && color.distance(matter.colors[cell]) <= kind.step
                && kind.is_like(color);
            if goes_on {
                inside[next] = true;
                front.push_back((kind, next, mean.lerp(color, DRIFT)));
            }
        }
    }
}

#[cfg(test)]
#[path = "grow_tests.rs"]
mod tests;
