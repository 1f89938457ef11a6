//! `GrabCut`: an object's mask from a box, a few strokes, or an earlier mask (Rother, Kolmogorov, Blake 2004; notes §3.2).
//!
//! Each side is a mixture of colors at their places; fitting the mixtures and cutting the grid take turns until the energy
//! falls no more. The rounds run on few cells, then the border is cut once on up to a million; the mask has the
//! picture's size.

use rayon::prelude::*;

use super::grid::{Grid, Weights};
use super::guided::upsampled;
use super::hints::ObjectHints;
use super::mend::mended;
use super::mixture::Mixture;
use super::parts::{fill_holes, parts};
use super::{OutlineError, Side};
use crate::picture::{Mask, Picture, PixelRect};

/// Most cells of the rounds, and of the last cut.
const ROUND_CELLS: u32 = 1 << 17;
const MOST_CELLS: u32 = 1 << 20;

/// Most rounds of fitting and cutting; they end before when a round gains less than `LEAST_GAIN` of the energy.
const ROUNDS: usize = 5;
const LEAST_GAIN: f64 = 1e-3;

/// An object that fills less of what is not certain is sought again from the next guess.
const LEAST_SHARE: f64 = 0.1;

/// Parts with less than this share of the object's largest one are specks.
const SPECK: f64 = 0.002;

/// Parts of the two mixtures: surroundings are of more kinds than an object.
const PARTS: [usize; 2] = [10, 6];

/// Seeds of the two mixtures.
const SEEDS: [u64; 2] = [1, 2];

/// An object cut out.
#[derive(Clone, Debug, PartialEq)]
pub struct Cutout {
    /// Its coverage, soft along the border for about two cells.
    pub mask: Mask,
    /// The energy after each round, which never rises. (The last cut, on finer cells, has another one.)
    pub energies: Vec<f64>,
    /// The part of the picture that was looked at.
    pub rect: PixelRect,
    /// Pixels along a side of a cell of the last cut: 1 when nothing had to be scaled down.
    pub factor: u32,
}

/// Finds the object that the hints mean. `progress` is told the share done, 0–1, and the step, and stops the work by
/// returning `false`.
///
/// # Errors
///
/// [`OutlineError::NothingMarked`] without a box in the picture, a stroke on the object, or an earlier mask;
/// [`OutlineError::BeyondBound`] when the marks lie beyond the bound;
/// [`OutlineError::NothingStandsOut`] when all or nothing seems to be the object; [`OutlineError::WrongSize`];
/// [`OutlineError::Cancelled`].
pub fn grab_cut(
    picture: &Picture,
    hints: &ObjectHints,
    progress: &dyn Fn(f32, &str) -> bool,
) -> Result<Cutout, OutlineError> {
    let step =
        |share: f32, what: &str| if progress(share, what) { Ok(()) } else { Err(OutlineError::Cancelled) };
    step(0.0, "looking at the colors")?;
    let rect = hints.rect(picture.size())?;
    let coarse = Grid::new(picture, hints, rect, ROUND_CELLS);
    let mut rounds = None;
    // Who has drawn on an object has seen the guess, and it may be as small as the strokes say.
    let is_stroked = hints.strokes.iter().any(|stroke| stroke.side == Side::Inside);
    let guesses = hints.first_labels(picture.size(), &coarse);
    for (guess, begin) in guesses.iter().zip([0.05, 0.35]) {
        let found = run_rounds(&coarse, guess, &|share| progress(begin + 0.3 * share, "cutting out"))?;
        let is_likely = found
            .as_ref()
            .is_some_and(|rounds| is_stroked || coarse.share_of_free(&rounds.inside) >= LEAST_SHARE);
        rounds = found.or(rounds);
        if is_likely {
            break;
        }
    }
    let Rounds { mut inside, mixtures, energies } = rounds.ok_or(OutlineError::NothingStandsOut)?;
    step(0.7, "cutting finely")?;
    let mut fine = Grid::new(picture, hints, rect, MOST_CELLS);
    // Strokes alone do not say how far the object reaches; it hangs together with them. A box or an earlier mask does.
    let is_alone = hints.corners.is_none() && hints.earlier.is_none();
    let is_marked: Vec<bool> = fine.known.iter().map(|known| is_alone && *known == Some(true)).collect();
    if fine.scaled.factor < coarse.scaled.factor {
        fine.keep_far_from_border(&coarse.scaled, &inside);
        let costs = fine.costs(&mixtures);
        inside = fine.cut(&costs, &|| progress(0.7, "cutting finely")).ok_or(OutlineError::Cancelled)?;
    }
    drop_specks(fine.scaled.width, &mut inside, &is_marked);
    if hints.is_solid {
        let all = inside.len();
        fill_holes(fine.scaled.width, &mut inside, all);
    }
    if !inside.contains(&true) {
        return Err(OutlineError::NothingStandsOut);
    }
    step(0.95, "following the border")?;
    let mask = match hints.earlier {
        Some(earlier) if !hints.strokes.is_empty() => mended(picture, &fine, earlier, &inside),
        _ => upsampled(picture, &fine.scaled, &inside),
    };
    step(1.0, "done")?;
    Ok(Cutout { mask, energies, rect, factor: fine.scaled.factor })
}

/// Where fitting and cutting in turn have led.
#[derive(Debug)]
struct Rounds {
    inside: Vec<bool>,
    mixtures: [Mixture; 2],
    energies: Vec<f64>,
}

/// Fits and cuts in turn, beginning with a guess; nothing when a side has no cell.
fn run_rounds(
    grid: &Grid,
    guess: &[Option<bool>],
    progress: &dyn Fn(f32) -> bool,
) -> Result<Option<Rounds>, OutlineError> {
    let weights = grid.weights(guess);
    let mixture = |side: bool| {
        Mixture::clustered(&grid.samples, PARTS[usize::from(side)], SEEDS[usize::from(side)], |cell| {
            if guess[cell] == Some(side) { weights.of(grid, cell, side) } else { 0.0 }
        })
    };
    let (Some(outer), Some(inner)) = (mixture(false), mixture(true)) else { return Ok(None) };
    let mut rounds = Rounds { inside: Vec::new(), mixtures: [outer, inner], energies: Vec::new() };
    for round in 0..ROUNDS {
        let go_on = || progress(round as f32 / ROUNDS as f32);
        if !go_on() {
            return Err(OutlineError::Cancelled);
        }
        if round > 0 {
            let Some(mixtures) = refitted(grid, weights, &rounds.inside, &rounds.mixtures) else {
                return Ok(None);
            };
            rounds.mixtures = mixtures;
        }
        let costs = grid.costs(&rounds.mixtures);
        let inside = grid.cut(&costs, &go_on).ok_or(OutlineError::Cancelled)?;
        let energy = grid.energy(&costs, &inside);
        let last = rounds.energies.last().copied();
        if last.is_some_and(|last| energy > last) {
            break;
        }
        rounds.inside = inside;
        rounds.energies.push(energy);
        if last.is_some_and(|last| last - energy < LEAST_GAIN * energy.abs()) {
            break;
        }
    }
    Ok(Some(rounds))
}

/// The mixtures of both sides as labeled; `None` when a side is empty.
fn refitted(grid: &Grid, weights: Weights, inside: &[bool], mixtures: &[Mixture; 2]) -> Option<[Mixture; 2]> {
    let samples = &grid.samples;
    let part_of: Vec<u8> = samples
        .par_iter()
        .zip(inside)
        .map(|(sample, inside)| mixtures[usize::from(*inside)].cheapest(sample).0)
        .collect();
    let fit = |side: bool| {
        Mixture::fit(samples, |cell| {
            (inside[cell] == side).then(|| (part_of[cell], weights.of(grid, cell, side)))
        })
    };
    Some([fit(false)?, fit(true)?])
}

/// Takes away what is too small to be meant, or does not hang together with what is marked.
fn drop_specks(width: usize, inside: &mut [bool], is_marked: &[bool]) {
    let (part_of, counts) = parts(width, |cell| inside[cell], inside.len());
    let mut meant = vec![false; counts.len()];
    for (part, is_marked) in part_of.iter().zip(is_marked) {
        meant[*part as usize] |= *is_marked;
    }
    if !meant.contains(&true) {
        let most = counts.iter().copied().max().unwrap_or(0) as f64;
        meant = counts.iter().map(|count| *count as f64 >= SPECK * most).collect();
    }
    for (inside, part) in inside.iter_mut().zip(part_of) {
        *inside &= meant[part as usize];
    }
}

#[cfg(test)]
#[path = "grabcut_tests.rs"]
mod tests;
