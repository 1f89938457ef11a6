//! Voting: a cell becomes the mean of what all matched patches over it say, better matches counting more.

use rayon::prelude::*;

use super::Cell;
use super::field::Field;
use super::level::Level;
use super::patch::{COMPARED, RADIUS, SIDE};

/// Where the best should count nearly alone, how often a vote's weight shrinks by e from it to a middling
/// match.
///
/// High keeps grain, low hides the seams between pieces that fit badly.
const SHARPNESS: f32 = 12.0;

/// How the votes are weighed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ballot {
    /// All good matches count: agreement is found, at the price of blur.
    Mean,
    /// The best match counts nearly alone: as sharp as the sources.
    Best,
}

/// What the matched patches say of each of the `cells`, where `value` is what a source cell has to say.
///
/// The cells lie in the hole or touch it, so that their own match at least has something to say.
pub(super) fn voted<const C: usize>(
    level: &Level,
    field: &Field,
    cells: &[u32],
    ballot: Ballot,
    value: impl Fn(usize) -> [f32; C] + Sync,
) -> Vec<[f32; C]> {
    let of_cell = |cell: &u32| {
        let (x, y) = (*cell as usize % level.width, *cell as usize / level.width);
        let mut votes = [(0.0, 0); SIDE * SIDE];
        let mut count = 0;
        for target_y in y - RADIUS..=y + RADIUS {
            for target_x in x - RADIUS..=x + RADIUS {
                let target = target_y * level.width + target_x;
                if level.is_target[target] {
                    // The cell's place in the source patch is its place in the target patch.
                    let from = field.nearest[target] as usize + *cell as usize - target;
                    if level.cells[from] == Cell::Source {
                        votes[count] = (field.cost[target], from);
                        count += 1;
                    }
                }
            }
        }
        let votes = &mut votes[..count];
        let mut sum = [0.0; C];
        if votes.is_empty() {
            return sum;
        }
        let upper = (count * 3 / 4).min(count - 1);
        let (better, (spread, _), _) = votes.select_nth_unstable_by(upper, |a, b| a.0.total_cmp(&b.0));
        let best = better.iter().map(|vote| vote.0).fold(*spread, f32::min);
        let falloff = match ballot {
            Ballot::Best => SHARPNESS / (*spread - best).max(1.0),
            Ballot::Mean => 1.0 / spread.max(1.0),
        };
        let mut whole = 0.0;
        for (cost, from) in &*votes {
            let weight = (falloff * (best - cost)).exp();
            whole += weight;
            for (sum, said) in sum.iter_mut().zip(value(*from)) {
                *sum += weight * said;
            }
        }
        sum.map(|sum| sum / whole)
    };
    cells.par_iter().with_min_len(256).map(of_cell).collect()
}

/// Fills the level's holes by vote.
pub(super) fn fill(level: &mut Level, field: &Field, ballot: Ballot) {
    let votes: Vec<[f32; COMPARED]> = voted(level, field, &level.holes, ballot, |from| {
        std::array::from_fn(|channel| f32::from(level.features[from][channel]))
    });
    for (cell, vote) in level.holes.iter().zip(votes) {
        for (feature, said) in level.features[*cell as usize].iter_mut().zip(vote) {
            *feature = said.round() as i16;
        }
    }
}
