//! The first guess, at the coarsest level: the hole is closed layer by layer, like an onion grown inward.
//!
//! Each cell takes the center of the source patch that fits best to what is known around the cell by then.

use rayon::prelude::*;

use super::Cell;
use super::field::Field;
use super::level::Level;
use super::patch::Patch;
use crate::random::Random;

/// Comparisons at most; beyond, sources are skipped evenly.
const COMPARISONS: usize = 20_000_000;

/// The cost of a source that continues what was copied beside the cell is taken times this: large pieces look
/// best.
const CONTINUED: f32 = 0.5;

/// Fills the level's holes and says where from.
pub(super) fn fill(level: &mut Level, seed: u64) -> Field {
    let mut field = Field::random(level, seed);
    let mut known: Vec<bool> = level.cells.iter().map(|cell| *cell == Cell::Source).collect();
    let mut uses = vec![0; level.cells.len()];
    let mut left = level.holes.clone();
    let skip = (level.holes.len() * level.sources.len()).div_ceil(COMPARISONS).max(1);
    while !left.is_empty() {
        let (mut layer, inside): (Vec<u32>, _) =
            left.iter().partition(|cell| neighbors(level.width, **cell as usize).any(|near| known[near]));
        left = inside;
        // What touches nothing known, enclosed by foreign cells, is filled by rows alone.
        if layer.is_empty() {
            layer = std::mem::take(&mut left);
        }
        let found: Vec<u32> = layer
            .par_iter()
            .map(|cell| {
                Guess { level, known: &known, field: &field, uses: &uses }.best_source(
                    *cell as usize,
                    skip,
                    Random::new(seed, u64::from(*cell)),
                )
            })
            .collect();
        for (cell, source) in layer.iter().zip(found) {
            level.features[*cell as usize] = level.features[source as usize];
            known[*cell as usize] = true;
            field.nearest[*cell as usize] = source;
            uses[source as usize] += 1;
        }
    }
    field
}

/// What is known while the hole is being closed.
struct Guess<'a> {
    level: &'a Level,
    known: &'a [bool],
    field: &'a Field,
    uses: &'a [u16],
}

impl Guess<'_> {
    /// The source whose patch fits best to the known cells around `cell`; every `skip`th is tried.
    fn best_source(&self, cell: usize, skip: usize, mut random: Random) -> u32 {
        let level = self.level;
        let patch = Patch::new(level, cell, |cell| self.known[cell]);
        let row = cell / level.width;
        let cost = |source: usize, limit: f32| {
            let price = level.price(row, source, self.uses[source]);
            if price < limit { price + patch.difference(level, source, limit - price) } else { f32::INFINITY }
        };
        let mut best = (level.random_source(row, &mut random), f32::INFINITY);
        for near in neighbors(level.width, cell) {
            let continued = self.field.nearest[near] as usize + cell - near;
            let filled = self.known[near] && level.cells[near] == Cell::Hole;
            if filled && level.is_source[continued] {
                let cost = CONTINUED * cost(continued, f32::INFINITY);
                if cost < best.1 {
                    best = (continued as u32, cost);
                }
            }
        }
        for source in level.sources.iter().skip(random.below(skip)).step_by(skip) {
            let cost = cost(*source as usize, best.1);
            if cost < best.1 {
                best = (*source, cost);
            }
        }
        best.0
    }
}

/// The eight cells around an inner cell.
fn neighbors(width: usize, cell: usize) -> impl Iterator<Item = usize> {
    [cell - width, cell, cell + width]
        .into_iter()
        .flat_map(|middle| middle - 1..=middle + 1)
        .filter(move |at| *at != cell)
}
