//! The nearest-neighbor field: for every patch that reaches into the hole, the source patch most like it
//! (`PatchMatch`).
//!
//! Strips of fixed height are searched side by side and see each other's last state, so threads change
//! nothing.

use rayon::prelude::*;

use super::Cell;
use super::level::Level;
use super::patch::Patch;
use super::patch::RADIUS;
use crate::random::Random;

/// Rows of a strip.
const STRIP: usize = 16;

/// The cost of a match that nobody has looked at.
const UNSEEN: f32 = 1e12;

/// The best sources known for all targets; what other cells hold means nothing.
#[derive(Debug)]
pub(super) struct Field {
    /// Center of the source patch.
    pub(super) nearest: Vec<u32>,
    /// Difference of the patches, plus the price of the rows between them, plus that of repetition.
    pub(super) cost: Vec<f32>,
    /// Number of targets that each source was the nearest of when the costs were last taken.
    uses: Vec<u16>,
}

/// How to sweep.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sweep {
    /// From the last cell to the first, handing matches up and left instead of down and right.
    pub(super) backward: bool,
    /// Cells around a match within which random others are tried.
    pub(super) reach: usize,
    pub(super) seed: u64,
}

impl Field {
    /// A field of random sources; there must be some.
    pub(super) fn random(level: &Level, seed: u64) -> Self {
        Self::from_fn(level, |cell| {
            (level.random_source(cell / level.width, &mut Random::new(seed, cell as u64)), UNSEEN)
        })
    }

    /// The field of twice the size; matches that are no sources there become random ones.
    pub(super) fn enlarged(&self, width: usize, level: &Level, seed: u64) -> Self {
        Self::from_fn(level, |cell| {
            // Margins are as wide on both levels.
            let (x, y) = (cell % level.width - RADIUS, cell / level.width - RADIUS);
            let coarse = (y / 2 + RADIUS) * width + x / 2 + RADIUS;
            let from = self.nearest[coarse] as usize;
            let fine = |coarse: usize, odd: usize| (2 * coarse + odd).saturating_sub(RADIUS);
            let source = fine(from / width, y % 2) * level.width + fine(from % width, x % 2);
            if self.cost[coarse] < UNSEEN && level.is_source.get(source) == Some(&true) {
                (source as u32, self.cost[coarse])
            } else {
                (level.random_source(y + RADIUS, &mut Random::new(seed, cell as u64)), UNSEEN)
            }
        })
    }

    fn from_fn(level: &Level, of_target: impl Fn(usize) -> (u32, f32) + Sync) -> Self {
        let (mut nearest, mut cost) = (Vec::new(), Vec::new());
        level
            .is_target
            .par_iter()
            .enumerate()
            .map(|(cell, target)| if *target { of_target(cell) } else { (0, UNSEEN) })
            .unzip_into_vecs(&mut nearest, &mut cost);
        Self { nearest, cost, uses: vec![0; level.cells.len()] }
    }

    /// Takes the costs anew after the level's holes have changed, and counts what is copied how often.
    pub(super) fn measure(&mut self, level: &Level) {
        self.uses.fill(0);
        for (nearest, target) in self.nearest.iter().zip(&level.is_target) {
            if *target {
                let uses = &mut self.uses[*nearest as usize];
                *uses = uses.saturating_add(1);
            }
        }
        let uses = &self.uses;
        self.cost.par_iter_mut().zip(&self.nearest).enumerate().with_min_len(1024).for_each(
            |(cell, (cost, nearest))| {
                if level.is_target[cell] {
                    let mut search = Search::new(level, uses, cell, 0, f32::INFINITY);
                    search.offer(*nearest as usize);
                    *cost = search.cost;
                }
            },
        );
    }

    /// Improves all matches once, from their neighbors' and at random.
    pub(super) fn sweep(&mut self, level: &Level, sweep: Sweep) {
        let width = level.width;
        // The row that each strip's first row (in the order of the sweep) looks at, as it is now.
        let edge = |strip: usize| {
            let row = if sweep.backward { Some((strip + 1) * STRIP) } else { (strip * STRIP).checked_sub(1) };
            row.and_then(|row| self.nearest.get(row * width..(row + 1) * width)).map(<[u32]>::to_vec)
        };
        let edges: Vec<_> = (0..level.height.div_ceil(STRIP)).map(edge).collect();
        let uses = &self.uses;
        let strips = self
            .nearest
            .par_chunks_mut(STRIP * width)
            .zip(self.cost.par_chunks_mut(STRIP * width))
            .zip(&edges);
        strips.enumerate().for_each(|(strip, ((nearest, cost), edge))| {
            let first = strip * STRIP * width;
            for step in 0..nearest.len() {
                let at = if sweep.backward { nearest.len() - 1 - step } else { step };
                let cell = first + at;
                if !level.is_target[cell] {
                    continue;
                }
                let mut search = Search::new(level, uses, cell, nearest[at], cost[at]);
                let beside = |at: usize| nearest.get(at).copied();
                let in_edge = || edge.as_ref().map(|edge| edge[cell % width]);
                let is_target = |cell: usize| level.is_target[cell];
                if sweep.backward {
                    if is_target(cell + 1) {
                        search.offer_from(beside(at + 1), |source| source - 1);
                    }
                    if is_target(cell + width) {
                        search.offer_from(beside(at + width).or_else(in_edge), |source| source - width);
                    }
                } else {
                    if is_target(cell - 1) {
                        search.offer_from(beside(at - 1), |source| source + 1);
                    }
                    if is_target(cell - width) {
                        let above = at.checked_sub(width).and_then(beside);
                        search.offer_from(above.or_else(in_edge), |source| source + width);
                    }
                }
                search.look_around(sweep.reach, &mut Random::new(sweep.seed, cell as u64));
                (nearest[at], cost[at]) = (search.source, search.cost);
            }
        });
    }
}

/// The search for one target.
struct Search<'a> {
    level: &'a Level,
    uses: &'a [u16],
    patch: Patch,
    row: usize,
    source: u32,
    cost: f32,
}

impl<'a> Search<'a> {
    fn new(level: &'a Level, uses: &'a [u16], cell: usize, source: u32, cost: f32) -> Self {
        let patch = Patch::new(level, cell, |cell| level.cells[cell] != Cell::Foreign);
        Self { level, uses, patch, row: cell / level.width, source, cost }
    }

    /// Takes the candidate if it is a source and better.
    fn offer(&mut self, candidate: usize) {
        if self.level.is_source.get(candidate) != Some(&true) {
            return;
        }
        // One use is the target's own where the candidate is its match; elsewhere one more is no stamp yet.
        let price = self.level.price(self.row, candidate, self.uses[candidate].saturating_sub(1));
        if price < self.cost {
            let cost = price + self.patch.difference(self.level, candidate, self.cost - price);
            if cost < self.cost {
                (self.source, self.cost) = (candidate as u32, cost);
            }
        }
    }

    /// Takes what continues a neighbor's match.
    fn offer_from(&mut self, neighbor: Option<u32>, continued: impl Fn(usize) -> usize) {
        if let Some(neighbor) = neighbor {
            let candidate = continued(neighbor as usize);
            if candidate != self.source as usize {
                self.offer(candidate);
            }
        }
    }

    /// Tries one random source in each of ever smaller squares around the best.
    fn look_around(&mut self, mut reach: usize, random: &mut Random) {
        let width = self.level.width;
        while reach > 0 {
            let (x, y) = (self.source as usize % width, self.source as usize / width);
            let mut near = |at: usize, limit: usize| {
                let low = at.saturating_sub(reach);
                low + random.below((at + reach + 1).min(limit) - low)
            };
            let candidate = near(y, self.level.height) * width + near(x, width);
            self.offer(candidate);
            reach /= 2;
        }
    }
}
