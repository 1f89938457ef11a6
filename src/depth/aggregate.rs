//! Semi-global aggregation (Hirschmüller 2008): costs gathered along eight directions, so that neighbors agree on
//! shifts unless an edge parts them.
//!
//! Integers only: the sums are the same in any order.

use rayon::prelude::*;

use super::cost::{Costs, RowShifts, row_slices};
use super::view::{Kind, View};

/// What a change of shift by one pixel costs, as slopes have.
const STEP: i16 = 8;
/// What a jump costs where the picture is even, and at least.
const JUMP: f32 = 200.0;
const LEAST_JUMP: f32 = 50.0;

/// An edge of this many codes halves what a jump over it costs.
const EDGE: f32 = 8.0;

/// Neither a shift nor a sum reaches this.
const NEVER: i16 = i16::MAX / 2;

/// Sums over all directions, laid out as the costs are.
pub(super) fn aggregate(view: &View, costs: &Costs) -> Vec<i16> {
    let mut sums = vec![0_i16; costs.values.len()];
    along_rows(view, costs, &mut sums);
    for down in [true, false] {
        for aside in [-1, 0, 1] {
            along_columns(view, costs, &mut sums, down, aside);
        }
    }
    sums
}

/// The sums of the pixel before on one path.
#[derive(Clone)]
struct Path {
    /// By shift, from the least of all rows; `NEVER` where the pixel before had no cost.
    sums: Vec<i16>,
    least: i16,
    gray: f32,
    begun: bool,
}

impl Path {
    fn new(shifts: usize) -> Self {
        // One place more at both ends, so that every shift has neighbors.
        Self { sums: vec![NEVER; shifts + 2], least: 0, gray: 0.0, begun: false }
    }

    /// Goes on from `before` to a pixel, and adds what comes out to `into`.
    fn step(&mut self, before: &Self, first: usize, costs: &[u8], gray: f32, into: &mut [i16]) {
        let count = costs.len();
        let mut least = NEVER;
        if before.begun {
            let jump = (JUMP / (1.0 + (gray - before.gray).abs() / EDGE)).max(LEAST_JUMP) as i16;
            let far = before.least + jump;
            let from = &before.sums[first..first + count + 2];
            let own = &mut self.sums[first + 1..first + 1 + count];
            for i in 0..count {
                let near = from[i].min(from[i + 2]) + STEP;
                let best = from[i + 1].min(near).min(far);
                let sum = i16::from(costs[i]) + best - before.least;
                own[i] = sum;
                into[i] += sum;
                least = least.min(sum);
            }
        } else {
            for ((own, &cost), into) in self.sums[first + 1..].iter_mut().zip(costs).zip(into) {
                *own = i16::from(cost);
                *into += *own;
                least = least.min(*own);
            }
        }
        self.least = least;
        self.gray = gray;
        self.begun = true;
    }
}

/// The least shift of all rows, and how many there are from it to the largest.
fn all_shifts(rows: &[RowShifts]) -> (isize, usize) {
    let used = || rows.iter().filter(|row| row.count() > 0);
    let low = used().map(|row| row.low).min().unwrap_or(0);
    let high = used().map(|row| row.high).max().unwrap_or(0);
    (low, (high - low) as usize)
}

fn along_rows(view: &View, costs: &Costs, sums: &mut [i16]) {
    let slices = row_slices(&costs.rows, costs.width, sums);
    slices.into_par_iter().enumerate().for_each(|(row, into)| {
        let count = costs.rows[row].count();
        if count == 0 {
            return;
        }
        for rightward in [true, false] {
            let (mut before, mut now) = (Path::new(count), Path::new(count));
            for step in 0..view.width {
                let x = if rightward { step } else { view.width - 1 - step };
                let cell = row * view.width + x;
                if view.kinds[cell] == Kind::Direct {
                    let into = &mut into[x * count..][..count];
                    now.step(&before, 0, costs.at(row, x), view.gray[cell], into);
                } else {
                    now.begun = false;
                }
                std::mem::swap(&mut before, &mut now);
            }
        }
    });
}

fn along_columns(view: &View, costs: &Costs, sums: &mut [i16], down: bool, aside: isize) {
    let (lowest, shifts) = all_shifts(&costs.rows);
    let mut before = vec![Path::new(shifts); view.width];
    let mut now = before.clone();
    let mut slices = row_slices(&costs.rows, costs.width, sums);
    for step in 0..view.height {
        let row = if down { step } else { view.height - 1 - step };
        let count = costs.rows[row].count();
        if count == 0 {
            before.iter_mut().for_each(|path| path.begun = false);
            continue;
        }
        let first = (costs.rows[row].low - lowest) as usize;
        let pixels = slices[row].par_chunks_mut(count).zip(&mut now).enumerate().with_min_len(64);
        pixels.for_each(|(x, (into, now))| {
            let cell = row * view.width + x;
            if view.kinds[cell] != Kind::Direct {
                now.begun = false;
                return;
            }
            let from = usize::try_from(x as isize - aside).ok().and_then(|from| before.get(from));
            match from {
                Some(from) => now.step(from, first, costs.at(row, x), view.gray[cell], into),
                None => {
                    let none = Path { sums: Vec::new(), least: 0, gray: 0.0, begun: false };
                    now.step(&none, first, costs.at(row, x), view.gray[cell], into);
                }
            }
        });
        std::mem::swap(&mut before, &mut now);
    }
}
