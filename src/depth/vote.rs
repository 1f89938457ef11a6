//! Shifts that keep to the picture's edges: every pixel asks its neighbors of like color.
//!
//! Supports reach over silhouettes, so that a strip of sky around a tree moves with the tree, and leave gaps. Neighbors
//! count as much as they are alike, near, trusted, and as they have texture of their own: a smooth pixel beside a strong
//! edge was matched by that edge, which is not its.

use std::f32::consts::TAU;

use rayon::prelude::*;

use super::levels::Shifts;
use super::plane::box_sum;
use super::view::{Kind, View};

/// How far neighbors are asked, pixels, and how many.
const REACH: f32 = 20.0;
const ASKED: usize = 96;
/// Colors this far apart, in codes, are not alike.
const ALIKE: f32 = 32.0;
/// Half side of what a pixel's match was made with.
const WITH: usize = 6;
/// Brightness farther off than this, in codes, is something else.
const LIKE: f32 = 20.0;
/// As part of what a pixel was matched with, this much texture of its own counts half.
const LITTLE: f32 = 0.1;
/// Standard deviation of a pixel's noise against those next to it, codes. Lower than what contrasts are held against: where
/// more is taken for noise, nothing in haze has a say but its edge, which then speaks for what lies behind it too.
const NOISE: f32 = 1.0;
/// Votes that make up full confidence; one is a trusted neighbor of the same color.
const ENOUGH: f32 = 0.8;

/// Bins of shifts: fine near 0, in proportion farther off.
const BINS: usize = 96;
const LINEAR: f32 = 3.0;
const PER_E: f32 = 14.0;

/// Takes the shift on which most of a pixel's likes agree.
pub(super) fn vote(view: &View, shifts: &Shifts) -> Shifts {
    let evidence = evidence(view);
    let asked: Vec<(isize, isize, f32)> = (1..ASKED)
        .map(|i| {
            // A sunflower's pattern covers the disk evenly.
            let part = (i as f32 / ASKED as f32).sqrt();
            let angle = TAU * 0.618_034 * i as f32;
            let (x, y) = (part * REACH * angle.cos(), part * REACH * angle.sin());
            (x.round() as isize, y.round() as isize, 1.0 - 0.75 * part * part)
        })
        .collect();
    let voted: Vec<(f32, f32, f32)> = (0..view.kinds.len())
        .into_par_iter()
        .map(|cell| {
            if view.kinds[cell] == Kind::Direct {
                elect(view, shifts, &evidence, &asked, cell)
            } else {
                (f32::NAN, f32::NAN, 0.0)
            }
        })
        .collect();
    Shifts {
        shift: voted.iter().map(|v| v.0).collect(),
        deviation: voted.iter().map(|v| v.1).collect(),
        confidence: voted.iter().map(|v| v.2).collect(),
    }
}

/// The part of what a pixel was matched with that is its own texture, 0–1.
fn evidence(view: &View) -> Vec<f32> {
    let sums = |power: i32| {
        let of = |(g, kind): (&f32, &Kind)| if *kind == Kind::Direct { (g - 128.0).powi(power) } else { 0.0 };
        let values: Vec<f32> = view.gray.par_iter().zip(&view.kinds).map(of).collect();
        box_sum(view.width, &values, WITH, WITH)
    };
    let (count, sum, squares) = (sums(0), sums(1), sums(2));
    let noise = NOISE * NOISE;
    (0..count.len())
        .into_par_iter()
        .map(|cell| {
            let count = count[cell].max(1.0);
            let with = (squares[cell] / count - (sum[cell] / count).powi(2)).max(0.0);
            let part = (own_variance(view, cell) - noise * 0.5).max(0.0) / (with + noise);
            part / (part + LITTLE)
        })
        .collect()
}

/// Variance of brightness among a pixel and those next to it that are like it: an edge to something else is no texture.
fn own_variance(view: &View, cell: usize) -> f32 {
    let (row, x) = (cell / view.width, cell % view.width);
    let own = view.gray[cell];
    let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for y in row.saturating_sub(1)..=(row + 1).min(view.height - 1) {
        for column in x.saturating_sub(1)..=(x + 1).min(view.width - 1) {
            let off = view.gray[y * view.width + column] - own;
            if off.abs() <= LIKE {
                count += 1.0;
                sum += off;
                squares += off * off;
            }
        }
    }
    squares / count - (sum / count) * (sum / count)
}

fn elect(
    view: &View,
    shifts: &Shifts,
    evidence: &[f32],
    asked: &[(isize, isize, f32)],
    cell: usize,
) -> (f32, f32, f32) {
    let (row, x) = ((cell / view.width) as isize, (cell % view.width) as isize);
    let color = view.channels.each_ref().map(|values| values[cell]);
    let mut votes = [(0.0_f32, 0.0_f32, 0.0_f32); BINS];
    let (mut all, mut trust) = (0.0, 0.0);
    let mut add = |other: usize, weight: f32| {
        let confidence = shifts.confidence[other];
        if confidence > 0.0 {
            let off: f32 =
                view.channels.iter().zip(color).map(|(v, c)| (v[other] - c) * (v[other] - c)).sum();
            let alike = (1.0 - off / (ALIKE * ALIKE)).max(0.0);
            let weight = weight * alike * alike * evidence[other];
            let shift = shifts.shift[other];
            let (count, sum, squares) = &mut votes[bin(shift)];
            *count += weight * confidence;
            *sum += weight * confidence * shift;
            *squares += weight * confidence * shift * shift;
            all += weight;
            trust += weight * confidence;
        }
    };
    add(cell, 2.0);
    for &(dx, dy, weight) in asked {
        let (x, y) = (x + dx, row + dy);
        if x >= 0 && y >= 0 && (x as usize) < view.width && (y as usize) < view.height {
            let other = y as usize * view.width + x as usize;
            if view.kinds[other] == Kind::Direct {
                add(other, weight);
            }
        }
    }
    // Three bins in a row, so that no border parts what belongs together.
    let three = |i: usize| votes[i - 1].0 + votes[i].0 + votes[i + 1].0;
    let Some(best) = (1..BINS - 1).max_by(|&a, &b| three(a).total_cmp(&three(b)).then(b.cmp(&a))) else {
        return (f32::NAN, f32::NAN, 0.0);
    };
    let count = three(best);
    if count <= 0.0 {
        return (f32::NAN, f32::NAN, 0.0);
    }
    let confidence = count * count / (all * trust) * (all / ENOUGH).min(1.0);
    let own = shifts.shift[cell];
    // What the pixel itself found is finer than what its neighbors have in common.
    if own.is_finite() && shifts.confidence[cell] > 0.0 && bin(own).abs_diff(best) <= 1 {
        return (own, shifts.deviation[cell], confidence);
    }
    let sums =
        |of: fn(&(f32, f32, f32)) -> f32| votes[best - 1..best + 2].iter().map(of).sum::<f32>() / count;
    let mean = sums(|v| v.1);
    let deviation = (sums(|v| v.2) - mean * mean).max(0.0).sqrt();
    (mean, deviation.max(MADE_UP), confidence)
}

/// Standard deviation, in pixels, of what was only taken over from others, at least.
const MADE_UP: f32 = 0.25;

fn bin(shift: f32) -> usize {
    // In proportion to a shift beyond `LINEAR`, even below.
    let at = (shift / LINEAR).asinh() * PER_E + 16.0;
    (at.max(0.0) as usize).min(BINS - 1)
}
