//! Fills holes with what the picture shows elsewhere: multi-scale patch matching and voting.
//!
//! After Wexler et al. 2007, Barnes et al. 2009 and Newson et al. 2014. Cells that are no holes keep their
//! bits. The result depends on the input and the seed alone, not on threads.

mod blend;
mod field;
mod level;
mod patch;
mod peel;
mod price;
#[cfg(test)]
mod tests;
mod texture;
mod vote;
mod window;

use self::field::Field;
use self::field::Sweep;
use self::level::Level;
use self::vote::Ballot;
use self::window::Window;
use super::fill::push_pull;
use crate::random::Random;

/// Levels are halved while their shorter side stays at least this long.
const SMALLEST_SIDE: usize = 32;

/// A level with fewer source patches than this is too coarse.
const FEWEST_SOURCES: usize = 64;

/// What a cell of the picture is to a fill.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cell {
    /// Known, and may be copied.
    Source,
    /// To be filled.
    Hole,
    /// Belongs to something else: never copied, never compared, never changed.
    Foreign,
}

/// How to fill.
#[derive(Clone, Copy, Debug)]
pub(super) struct Options {
    /// Another seed gives another, equally likely fill.
    pub seed: u64,
    /// Price of a patch from the picture's other end, above or below, in squared 8-bit codes per patch.
    ///
    /// High keeps every row's own matter; 0 lets patches come from any height, as suits facades.
    pub stratification: f32,
    /// Halvings of the size at which the search ends; finer sizes only copy what it found.
    ///
    /// 0 is best, 1 costs a quarter.
    pub finest_level: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { seed: 0, stratification: 2e6, finest_level: 0 }
    }
}

/// Fills the holes of a picture of `width` and as many rows as `cells` has; `colors` are linear light, 0–1.
///
/// `progress` hears the share done, 0–1, and cancels with `false`. Returns whether the fill came to its end;
/// a canceled one leaves the colors as they were. Where no patch of 7 × 7 source cells is found, holes take a
/// smooth mean of the sources, or black when there are none.
///
/// # Panics
///
/// When `colors` and `cells` differ in length.
#[must_use]
pub(super) fn inpaint(
    width: usize,
    colors: &mut [[f32; 3]],
    cells: &[Cell],
    options: &Options,
    progress: &dyn Fn(f32) -> bool,
) -> bool {
    assert_eq!(colors.len(), cells.len(), "one cell per color");
    let Some(window) = Window::around_holes(width, cells) else {
        return true;
    };
    let part_cells = window.cut(cells, Cell::Foreign);
    let mut part = window.cut(colors, [0.0; 3]);
    let row_price = options.stratification / (cells.len() / width).pow(2) as f32;
    let features = texture::features(window.cut_width(), &part, &part_cells);
    let level = Level::new(window.cut_width(), part_cells, features, row_price);
    let holes = if level.sources.is_empty() {
        let weight = |cell: &Cell| f32::from(u8::from(*cell == Cell::Source));
        let weights: Vec<f32> = level.cells.iter().map(weight).collect();
        push_pull(window.cut_width(), &mut part, &weights);
        level.holes
    } else {
        let Some((level, field)) = matched(level, options, progress) else {
            return false;
        };
        copy_sources(&level, &field, &mut part);
        level.holes
    };
    for cell in holes {
        colors[window.in_picture(cell as usize)] = part[cell as usize];
    }
    true
}

/// Matches all sizes from the coarsest to the full one; `None` if canceled.
fn matched(full: Level, options: &Options, progress: &dyn Fn(f32) -> bool) -> Option<(Level, Field)> {
    let mut coarser = vec![full];
    while let Some(last) = coarser.last()
        && last.width.min(last.height) >= 2 * SMALLEST_SIDE
    {
        let next = last.reduced();
        if next.sources.len() < FEWEST_SOURCES {
            break;
        }
        coarser.push(next);
    }
    let effort = |depth: usize| {
        Schedule::new(depth, options.finest_level).sweeps() as f32 * 0.25_f32.powi(depth as i32)
    };
    let whole: f32 = (0..coarser.len()).map(effort).sum();
    let mut done = 0.0;
    let mut previous: Option<(usize, Field)> = None;
    while let Some(mut level) = coarser.pop() {
        let depth = coarser.len();
        let schedule = Schedule::new(depth, options.finest_level);
        let mut seeds = Random::new(options.seed, depth as u64);
        let mut field = match previous.take() {
            Some((width, field)) => {
                let field = field.enlarged(width, &level, seeds.next());
                vote::fill(&mut level, &field, Ballot::Mean);
                field
            }
            None => peel::fill(&mut level, seeds.next()),
        };
        for round in 0..schedule.rounds {
            if !progress((done / whole).min(1.0)) {
                return None;
            }
            field.measure(&level);
            for sweep in 0..schedule.sweeps_in(round) {
                let reach = schedule.reach.min(level.width.max(level.height));
                field.sweep(&level, Sweep { backward: sweep % 2 == 1, reach, seed: seeds.next() });
                done += 0.25_f32.powi(depth as i32);
            }
            let last = round + 1 == schedule.rounds;
            if last && depth == 0 {
                return Some((level, field));
            }
            let sharp = last && depth <= options.finest_level;
            vote::fill(&mut level, &field, if sharp { Ballot::Best } else { Ballot::Mean });
        }
        previous = Some((level.width, field));
    }
    None
}

/// How much work a level gets.
#[derive(Clone, Copy, Debug)]
struct Schedule {
    /// Rounds of matching and voting.
    rounds: usize,
    /// How far random search goes, in cells.
    reach: usize,
}

impl Schedule {
    fn new(depth: usize, finest_level: usize) -> Self {
        let (rounds, reach) = match depth.checked_sub(finest_level) {
            None => (1, 2),
            Some(0) => (3, usize::MAX),
            Some(1) => (5, usize::MAX),
            Some(_) => (12, usize::MAX),
        };
        Self { rounds, reach }
    }

    /// Sweeps over the field in a round; the first has most to find.
    fn sweeps_in(self, round: usize) -> usize {
        if round == 0 && self.rounds > 1 { 4 } else { 2 }
    }

    fn sweeps(self) -> usize {
        (0..self.rounds).map(|round| self.sweeps_in(round)).sum()
    }
}

/// Fills the holes of `colors` from its sources by the field, and blends the seam.
fn copy_sources(level: &Level, field: &Field, colors: &mut [[f32; 3]]) {
    let steps = blend::steps_out(level);
    let filled = vote::voted(level, field, &level.holes, Ballot::Best, |from| colors[from]);
    let seams: Vec<_> = steps
        .iter()
        .map(|(step, inside)| {
            // What lies beside the copied cells, as far as it is known.
            let continued = vote::voted(level, field, inside, Ballot::Best, |from| {
                let beside = from.wrapping_add_signed(*step);
                let [r, g, b] = colors[beside];
                if level.cells[beside] == Cell::Source { [r, g, b, 1.0] } else { [0.0; 4] }
            });
            (*step, inside.as_slice(), continued)
        })
        .collect();
    let rim = blend::rim(colors, &seams);
    for (cell, color) in level.holes.iter().zip(filled) {
        colors[*cell as usize] = color;
    }
    blend::blend(level, colors, rim);
}

/// A display-like 8-bit code of linear light: a square root stands in for sRGB's curve.
fn code_from_linear(light: f32) -> f32 {
    255.0 * light.clamp(0.0, 1.0).sqrt()
}

/// The inverse of [`code_from_linear`].
fn linear_from_code(code: f32) -> f32 {
    (code / 255.0).powi(2)
}
