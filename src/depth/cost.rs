//! How unlike the picture and its mirror image are, for every pixel seen directly and every shift.
//!
//! The shift s of a point is how much farther below the horizon its mirror image stands than it stands above:
//! s = 2·f·h/z (notes §1.1). A thing above the water stands at −s/2 or higher, so every row has its own range.

use rayon::prelude::*;

use super::contrast::Contrasts;
use super::view::{Kind, View};

/// Differences of contrast beyond this say no more.
const TRUNCATION: f32 = 3.0;
/// The largest cost of a pixel.
const LARGEST: f32 = 60.0;
/// What a shift costs that nothing speaks for or against: more than a fair match, less than a contradiction.
const UNKNOWN: u8 = 30;
/// What a shift costs with which a pixel would hang over open water: branches do, most things do not.
const FLOATING: u8 = 15;
/// How far things hang over the water before that counts, as one part in so many of their shift.
const OVERHANG: isize = 4;
/// Rows of water below a pixel that show it does not stand there.
const OPEN_WATER: usize = 3;

/// The shifts of one row.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowShifts {
    /// The least shift, and one past the largest.
    pub(super) low: isize,
    pub(super) high: isize,
    /// Where the row's costs begin.
    pub(super) start: usize,
}

impl RowShifts {
    pub(super) fn count(&self) -> usize {
        (self.high - self.low).max(0) as usize
    }
}

/// Costs of all pixels, row by row, pixel by pixel, shift by shift.
#[derive(Debug)]
pub(super) struct Costs {
    pub(super) width: usize,
    pub(super) rows: Vec<RowShifts>,
    pub(super) values: Vec<u8>,
}

impl Costs {
    /// Compares what is seen directly with what the water shows, for shifts of at least `least`.
    pub(super) fn of(view: &View, least: isize, contrasts: &Contrasts) -> Self {
        let mut start = 0;
        let rows: Vec<RowShifts> = (0..view.height)
            .map(|row| {
                let any = view.kinds[row * view.width..][..view.width].contains(&Kind::Direct);
                let above = view.horizon - row as isize;
                let first = view.mirror_row(row, 0);
                let low = least.max(least + 1 - 2 * above).max(-first);
                // The mirror image must lie inside.
                let high = if any { view.height as isize - first } else { low };
                let shifts = RowShifts { low, high: high.max(low), start };
                start += shifts.count() * view.width;
                shifts
            })
            .collect();
        let mut costs = Self { width: view.width, rows, values: vec![0; start] };
        let standing = standing(view);
        let rows = costs.rows.clone();
        row_slices(&rows, view.width, &mut costs.values).into_par_iter().enumerate().for_each(
            |(row, into)| {
                fill_row(view, row, rows[row], contrasts, &standing[row * view.width..][..view.width], into);
            },
        );
        costs
    }

    /// The costs of one pixel.
    pub(super) fn at(&self, row: usize, column: usize) -> &[u8] {
        let shifts = self.rows[row];
        &self.values[shifts.start + column * shifts.count()..][..shifts.count()]
    }
}

/// One slice for each row's pixels and shifts.
pub(super) fn row_slices<'a, T>(rows: &[RowShifts], width: usize, values: &'a mut [T]) -> Vec<&'a mut [T]> {
    let mut rest = values;
    let mut slices = Vec::with_capacity(rows.len());
    for row in rows {
        let (own, others) = rest.split_at_mut(row.count() * width);
        slices.push(own);
        rest = others;
    }
    slices
}

/// How unlike one pixel's column is, shift by shift, and which shifts can be compared at all (1, else 0).
#[derive(Clone)]
struct Unlike {
    values: Vec<f32>,
    weights: Vec<f32>,
}

fn fill_row(
    view: &View,
    row: usize,
    shifts: RowShifts,
    contrasts: &Contrasts,
    standing: &[isize],
    into: &mut [u8],
) {
    let count = shifts.count();
    if count == 0 {
        return;
    }
    let first = view.mirror_row(row, shifts.low) as usize;
    // Three columns make a pixel's support; the directions of the aggregation do the rest.
    let mut columns = vec![Unlike { values: vec![0.0; count], weights: vec![0.0; count] }; 3];
    for ahead in 0..=view.width {
        let column = &mut columns[ahead % 3];
        column.values.fill(0.0);
        column.weights.fill(0.0);
        if ahead < view.width && view.kinds[row * view.width + ahead] == Kind::Direct {
            let [a, b] = contrasts.direct.each_ref().map(|values| values[row * view.width + ahead]);
            let range = ahead * view.height + first..ahead * view.height + first + count;
            let [water_a, water_b] = contrasts.water.each_ref().map(|values| &values[range.clone()]);
            let is_water = &contrasts.is_water[range];
            for i in 0..count {
                let unlike = (a - water_a[i]).abs().min(TRUNCATION) + (b - water_b[i]).abs().min(TRUNCATION);
                column.values[i] = is_water[i] * unlike;
                column.weights[i] = is_water[i];
            }
        }
        let Some(x) = ahead.checked_sub(1) else { continue };
        if view.kinds[row * view.width + x] != Kind::Direct {
            continue;
        }
        let into = &mut into[x * count..][..count];
        let [own, left, right] = [x % 3, (x + 2) % 3, ahead % 3].map(|i| &columns[i]);
        for (i, cost) in into.iter_mut().enumerate() {
            let unlike = own.values[i] + left.values[i] + right.values[i];
            let weight = own.weights[i] + left.weights[i] + right.weights[i];
            let mean = unlike * (0.5 * LARGEST / TRUNCATION) / weight.max(1.0);
            *cost = if own.weights[i] > 0.0 { mean as u8 } else { UNKNOWN };
        }
        let hanging = (standing[x].saturating_add(1).saturating_sub(shifts.low)).clamp(0, count as isize);
        for cost in &mut into[hanging as usize..] {
            *cost += FLOATING;
        }
    }
}

/// The largest shift of each pixel with which it stands on what is seen below it, and not on air over open water.
fn standing(view: &View) -> Vec<isize> {
    let mut largest = vec![isize::MAX; view.kinds.len()];
    for x in 0..view.width {
        let (mut run, mut limit) = (0, isize::MAX);
        for row in (0..view.height).rev() {
            let cell = row * view.width + x;
            run = if view.kinds[cell] == Kind::Water { run + 1 } else { 0 };
            if run >= OPEN_WATER {
                // Water seen in this row is at −s/2.
                limit = 2 * (row as isize + 1 - view.horizon).max(0);
                limit += 2 + limit / OVERHANG;
            }
            largest[cell] = limit;
        }
    }
    largest
}
