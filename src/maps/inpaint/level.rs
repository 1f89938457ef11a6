//! One size of the picture: what its cells are, how they are compared, where patches may come from and go to.
//!
//! A margin of foreign cells, a patch's radius wide, surrounds all others. Colors of coarser levels are means
//! of source cells alone, so nothing foreign ever enters a comparison.

use rayon::prelude::*;

use super::Cell;
use super::patch::{COMPARED, Feature, RADIUS, STRANGE, STRANGENESS};
use super::price::slack;
use crate::random::Random;

/// The picture at one size.
#[derive(Debug)]
pub(super) struct Level {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) cells: Vec<Cell>,
    /// Holes' features change as they are filled.
    pub(super) features: Vec<Feature>,
    /// Hole cells, in order.
    pub(super) holes: Vec<u32>,
    /// Centers of patches to copy from, in order; see [`sources`].
    pub(super) sources: Vec<u32>,
    /// Whether a cell is among the sources.
    pub(super) is_source: Vec<bool>,
    /// Whether a cell's patch reaches into the hole, so that it must be matched; foreign ones are not.
    pub(super) is_target: Vec<bool>,
    /// Index of each row's first source, and the number of sources.
    row_starts: Vec<u32>,
    /// How far a patch may come from another row for free, in cells, per row.
    pub(super) slack: Vec<f32>,
    /// Price of a patch from a row one cell further away, in squared 8-bit codes.
    pub(super) row_price: f32,
}

impl Level {
    /// Finds sources and targets; `row_price` is the price of one row squared.
    pub(super) fn new(width: usize, cells: Vec<Cell>, mut features: Vec<Feature>, row_price: f32) -> Self {
        let height = cells.len() / width;
        let listed = |flags: &[bool]| {
            (0..flags.len() as u32).into_par_iter().filter(|cell| flags[*cell as usize]).collect::<Vec<u32>>()
        };
        let flags = |wanted: Cell| cells.par_iter().map(|cell| *cell == wanted).collect::<Vec<bool>>();
        let is_hole = flags(Cell::Hole);
        let holes = listed(&is_hole);
        let near_hole = grown(width, &is_hole);
        let is_target: Vec<bool> =
            near_hole.par_iter().zip(&cells).map(|(near, cell)| *near && *cell != Cell::Foreign).collect();
        let is_source = sources(width, &cells, &near_hole);
        let sources = listed(&is_source);
        let row_starts: Vec<u32> = (0..=height)
            .map(|y| sources.partition_point(|source| (*source as usize) < y * width) as u32)
            .collect();
        features.par_iter_mut().zip(&cells).filter(|(_, cell)| **cell == Cell::Foreign).for_each(
            |(feature, _)| {
                *feature = [0; 8];
                feature[STRANGENESS] = STRANGE;
            },
        );
        let slack = slack(&row_starts);
        Self {
            width,
            height,
            cells,
            features,
            holes,
            sources,
            is_source,
            is_target,
            row_starts,
            slack,
            row_price,
        }
    }

    /// The same picture at half the size.
    ///
    /// A cell with any hole in it is a hole; else it is a source if at least half of it is.
    pub(super) fn reduced(&self) -> Self {
        let halved = |size: usize| (size - 2 * RADIUS).div_ceil(2) + 2 * RADIUS;
        let (width, height) = (halved(self.width), halved(self.height));
        let (cells, features) = (0..width * height)
            .into_par_iter()
            .map(|at| {
                // Cells of the margin have children in or beyond it; those beyond are left out.
                let (x, y) = (at % width * 2, at / width * 2);
                let children = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)]
                    .into_iter()
                    .filter(|(x, y)| {
                        (RADIUS..self.width + RADIUS).contains(x)
                            && (RADIUS..self.height + RADIUS).contains(y)
                    })
                    .map(|(x, y)| (y - RADIUS) * self.width + x - RADIUS);
                let count = |wanted| children.clone().filter(|child| self.cells[*child] == wanted).count();
                let (sources, holes) = (count(Cell::Source), count(Cell::Hole));
                if holes > 0 {
                    return (Cell::Hole, [0; 8]);
                }
                let known = |child: usize| i32::from(self.cells[child] == Cell::Source);
                let mean = mean(children.clone().map(|child| (&self.features[child], known(child))));
                let cell =
                    if sources > 0 && 2 * sources >= children.count() { Cell::Source } else { Cell::Foreign };
                (cell, mean)
            })
            .unzip();
        Self::new(width, cells, features, 4.0 * self.row_price)
    }

    /// Any source from rows near `row`; there must be sources.
    pub(super) fn random_source(&self, row: usize, random: &mut Random) -> u32 {
        let reach = self.height / 16 + self.slack[row] as usize;
        let first = self.row_starts[row.saturating_sub(reach)] as usize;
        let end = self.row_starts[(row + reach + 1).min(self.height)] as usize;
        let near = &self.sources[first..end];
        let sources = if near.is_empty() { &self.sources } else { near };
        sources[random.below(sources.len())]
    }
}

/// Whether cells are centers of patches to copy from: source cells without a hole in their patch.
///
/// Foreign cells in the patch do no harm where the target has some too, so that a shore fits a shore; but
/// slivers into which no patch of source cells alone fits are left out.
fn sources(width: usize, cells: &[Cell], near_hole: &[bool]) -> Vec<bool> {
    let other: Vec<bool> = cells.par_iter().map(|cell| *cell != Cell::Source).collect();
    let whole: Vec<bool> = grown(width, &other).into_par_iter().map(|near_other| !near_other).collect();
    let covered = grown(width, &whole);
    (0..cells.len())
        .into_par_iter()
        .map(|cell| covered[cell] && cells[cell] == Cell::Source && !near_hole[cell])
        .collect()
}

/// Mean of features with weights; zero where the weights are.
fn mean<'a>(weighted: impl Iterator<Item = (&'a Feature, i32)>) -> Feature {
    let (mut sum, mut whole) = ([0_i32; 8], 0);
    for (feature, weight) in weighted {
        whole += weight;
        for channel in 0..COMPARED {
            sum[channel] += weight * i32::from(feature[channel]);
        }
    }
    sum.map(|sum| if whole > 0 { ((sum + whole / 2) / whole) as i16 } else { 0 })
}

/// Flags spread by a patch's radius in all directions.
fn grown(width: usize, flags: &[bool]) -> Vec<bool> {
    let height = flags.len() / width;
    let mut wide = vec![false; flags.len()];
    wide.par_chunks_mut(width).zip(flags.par_chunks(width)).for_each(|(wide, row)| {
        for (x, wide) in wide.iter_mut().enumerate() {
            *wide = row[x.saturating_sub(RADIUS)..(x + RADIUS + 1).min(width)].contains(&true);
        }
    });
    let mut grown = vec![false; flags.len()];
    grown.par_chunks_mut(width).enumerate().for_each(|(y, grown)| {
        for from in y.saturating_sub(RADIUS)..(y + RADIUS + 1).min(height) {
            for (grown, wide) in grown.iter_mut().zip(&wide[from * width..(from + 1) * width]) {
                *grown |= wide;
            }
        }
    });
    grown
}
