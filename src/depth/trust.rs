//! How far a match can be trusted, judged by matches that cannot be right.
//!
//! The picture is matched a second time with its water moved sideways: what is found then is chance, and looks as
//! chance looks in this very picture. The share of chance among matches with the same score is the probability of
//! being wrong (target and decoy, Elias & Gygi 2007); its complement is the confidence.

use rayon::prelude::*;

use super::contrast::Contrasts;
use super::plane::box_sum;
use super::view::{Kind, View};

/// Half side of the box in which matches back each other, pixels.
const RADIUS: usize = 5;
/// Shifts back each other when they differ by no more, pixels.
const BACKING: f32 = 1.5;
/// Mean square of normalized gray values that is not yet texture.
const FAINT: f32 = 0.05;

/// The score of each pixel's match, 0–1: the share of its neighborhood that has its shift too, times the correlation
/// there; 0 where there is no match.
pub(super) fn scores(view: &View, contrasts: &Contrasts, shift: &[f32]) -> Vec<f32> {
    let correlation = correlation(view, contrasts, shift);
    let backing = backing(view, shift);
    backing.par_iter().zip(&correlation).map(|(b, c)| b * c.max(0.0)).collect()
}

/// The share of direct pixels around each that were matched with nearly its shift.
fn backing(view: &View, shift: &[f32]) -> Vec<f32> {
    let (width, height) = (view.width, view.height);
    let mut shares = vec![0.0; shift.len()];
    shares.par_chunks_mut(width).enumerate().for_each(|(row, shares)| {
        for x in 0..width {
            let own = shift[row * width + x];
            if own.is_nan() {
                continue;
            }
            let (mut backing, mut count) = (0, 0);
            for y in row.saturating_sub(RADIUS)..=(row + RADIUS).min(height - 1) {
                let columns = x.saturating_sub(RADIUS)..(x + RADIUS + 1).min(width);
                let range = y * width + columns.start..y * width + columns.end;
                for (other, kind) in shift[range.clone()].iter().zip(&view.kinds[range]) {
                    backing += i32::from((other - own).abs() <= BACKING);
                    count += i32::from(*kind == Kind::Direct);
                }
            }
            shares[x] = backing as f32 / count.max(1) as f32;
        }
    });
    shares
}

/// Correlation of the picture and its mirror image around each pixel, over matched pixels.
fn correlation(view: &View, contrasts: &Contrasts, shift: &[f32]) -> Vec<f32> {
    let pairs: Vec<Option<(f32, f32)>> = (0..shift.len())
        .into_par_iter()
        .map(|cell| {
            let mirrored = contrasts.water_at(view, cell, shift[cell])?;
            Some((contrasts.direct[0][cell], mirrored))
        })
        .collect();
    let sums = |of: &(dyn Fn(f32, f32) -> f32 + Sync)| {
        let values: Vec<f32> = pairs.par_iter().map(|pair| pair.map_or(0.0, |(a, b)| of(a, b))).collect();
        box_sum(view.width, &values, RADIUS, RADIUS)
    };
    let (count, ab) = (sums(&|_, _| 1.0), sums(&|a, b| a * b));
    let (aa, bb) = (sums(&|a, _| a * a), sums(&|_, b| b * b));
    (0..pairs.len())
        .map(|i| if pairs[i].is_some() { ab[i] / ((aa[i] * bb[i]).sqrt() + FAINT * count[i]) } else { 0.0 })
        .collect()
}

/// How many steps scores are sorted into.
const BINS: usize = 32;

/// From a match's score to its confidence.
#[derive(Clone, Debug)]
pub(super) struct Trust {
    /// Probability of being wrong, by score; never rises.
    wrong: [f32; BINS],
}

impl Trust {
    /// Compares the scores of matches with those of chance, each of which counts `worth` matches.
    pub(super) fn of(scores: &[f32], chance: &[f32], worth: f32) -> Self {
        let count = |scores: &[f32]| {
            let mut counts = [0.0_f32; BINS];
            for &score in scores.iter().filter(|&&score| score > 0.0) {
                counts[bin(score)] += 1.0;
            }
            counts
        };
        let (found, chance) = (count(scores), count(chance));
        let mut wrong = [1.0; BINS];
        let mut at_least: f32 = 0.0;
        let (mut top, mut all, mut by_chance) = (BINS, 0.0, 0.0);
        // From the best scores down, in groups of enough matches to judge.
        for bin in (0..BINS).rev() {
            all += found[bin];
            by_chance += worth * chance[bin];
            if all >= GROUP || bin == 0 {
                at_least = at_least.max(((by_chance + FEW) / (all + FEW)).min(1.0));
                wrong[bin..top].fill(at_least);
                (top, all, by_chance) = (bin, 0.0, 0.0);
            }
        }
        Self { wrong }
    }

    /// The probability, 0–1, that a match with this score is right.
    pub(super) fn confidence(&self, score: f32) -> f32 {
        if score > 0.0 { 1.0 - self.wrong[bin(score)] } else { 0.0 }
    }
}

/// Matches of one neighborhood: so many may always be chance that the tries of chance did not have.
const FEW: f32 = ((2 * RADIUS + 1) * (2 * RADIUS + 1)) as f32;

/// Matches that are judged together.
const GROUP: f32 = 10.0 * FEW;

fn bin(score: f32) -> usize {
    ((score * BINS as f32) as usize).min(BINS - 1)
}
