//! The horizon from the sky's mirror image: the sky has no shift.
//!
//! If the true horizon lies o pixels below the assumed one, every shift comes out 2·o too large; the sky shows 2·o
//! itself.

use std::collections::BTreeSet;

use super::levels::{Shifts, TRUSTED};
use super::map::HorizonOffset;
use super::plane::box_sum;
use super::sky::looks_like_sky;
use super::view::{Kind, View};

/// Independent places, as squares of this side in pixels.
const PLACE: usize = 32;
const LEAST_PLACES: usize = 6;
/// Half side of the box in which a place is judged to be sky or land, pixels.
const AROUND: usize = 24;
/// Less of the sky matched than this, in its upper or lower half, is no sky, but what stands before it.
const LEAST_MATCHED: f64 = 0.3;
/// What a sky's shift is known to at best, pixels: clouds are not at infinity.
const CLOUDS: f64 = 0.2;
/// Shifts this far from the sky's are not the sky's, pixels.
const FLAT: f64 = 0.7;
/// An offset beyond so many deviations of what was known is not the horizon's.
const PLAUSIBLE: f64 = 2.5;

/// The offset of the horizon, in leveled pixels, given that it was known to `known` pixels, and which pixels are sky:
/// none where what looks like a sky stands at a distance.
pub(super) fn horizon(view: &View, shifts: &Shifts, known: f64) -> (HorizonOffset, Vec<bool>) {
    let is_sky = looks_like_sky(view);
    let trusted = |cell: usize| is_sky[cell] && shifts.confidence[cell] >= TRUSTED;
    let shift = |cell: usize| f64::from(shifts.shift[cell]);
    match sky_shift(view, shifts, &is_sky) {
        Some(sky) if (0.5 * sky.shift).abs() <= PLAUSIBLE * known => {
            let (by_sky, by_known) = ((0.5 * sky.deviation).powi(-2), known.powi(-2));
            let horizon = HorizonOffset {
                offset_px: 0.5 * sky.shift * by_sky / (by_sky + by_known),
                deviation_px: (by_sky + by_known).powf(-0.5),
                measured: true,
            };
            let before = |cell: usize| trusted(cell) && shift(cell) - sky.shift > FLAT;
            (horizon, without(view, &is_sky, &before))
        }
        found => {
            let horizon = HorizonOffset { offset_px: 0.0, deviation_px: known, measured: false };
            // A painted backdrop: its sky hangs at a distance.
            let painted = found.is_some();
            (horizon, if painted { vec![false; is_sky.len()] } else { without(view, &is_sky, &trusted) })
        }
    }
}

/// The sky without places where most of it is `before` the sky: not just its edge, which is matched with what it ends
/// at.
fn without(view: &View, is_sky: &[bool], before: &dyn Fn(usize) -> bool) -> Vec<bool> {
    let sums = |is: &dyn Fn(usize) -> bool| {
        let values: Vec<f32> = (0..is_sky.len()).map(|cell| f32::from(u8::from(is(cell)))).collect();
        box_sum(view.width, &values, AROUND, AROUND)
    };
    let (all, before) = (sums(&|cell| is_sky[cell]), sums(before));
    (0..is_sky.len()).map(|cell| is_sky[cell] && 2.0 * before[cell] < all[cell]).collect()
}

/// A shift and its standard deviation, pixels.
struct SkyShift {
    shift: f64,
    deviation: f64,
}

/// The shift on which the sky agrees, if it was matched as a whole.
fn sky_shift(view: &View, shifts: &Shifts, is_sky: &[bool]) -> Option<SkyShift> {
    let trusted = |cell: usize| is_sky[cell] && shifts.confidence[cell] >= TRUSTED;
    let mut found: Vec<f64> =
        (0..is_sky.len()).filter(|&cell| trusted(cell)).map(|cell| f64::from(shifts.shift[cell])).collect();
    found.sort_by(f64::total_cmp);
    // Some mountain may have slipped in: the sky is what most of it agrees on.
    let mode = densest(&found)?;
    let mut agreed: Vec<f64> = found.iter().copied().filter(|shift| (shift - mode).abs() <= FLAT).collect();
    let places: BTreeSet<(usize, usize)> = (0..is_sky.len())
        .filter(|&cell| trusted(cell))
        .map(|cell| (cell % view.width / PLACE, cell / view.width / PLACE))
        .collect();
    if 2 * agreed.len() < found.len()
        || places.len() < LEAST_PLACES
        || !reaches_up(view, is_sky, mode, &trusted)
    {
        return None;
    }
    let shift = median(&mut agreed);
    let mut off: Vec<f64> = agreed.iter().map(|other| (other - shift).abs()).collect();
    let spread = 1.48 * median(&mut off);
    let mut deviations: Vec<f64> = (0..is_sky.len())
        .filter(|&cell| trusted(cell))
        .map(|cell| f64::from(shifts.deviation[cell]))
        .collect();
    let own = median(&mut deviations);
    let deviation = (own * own + spread * spread / places.len() as f64 + CLOUDS * CLOUDS).sqrt();
    Some(SkyShift { shift, deviation })
}

/// Whether the sky was matched in its upper half as well as in its lower one, as far as its mirror image is to be seen.
///
/// A mountain taken for sky has the true sky above it, which is even and not matched.
fn reaches_up(view: &View, is_sky: &[bool], shift: f64, trusted: &dyn Fn(usize) -> bool) -> bool {
    let (mut seen, mut matched) = ([0_usize; 2], [0_usize; 2]);
    for x in 0..view.width {
        let is_mirrored = |row: &usize| {
            let mirrored = usize::try_from(view.mirror_row(*row, shift.round() as isize)).ok();
            is_sky[row * view.width + x]
                && mirrored.is_some_and(|m| m < view.height && view.kinds[m * view.width + x] == Kind::Water)
        };
        let rows: Vec<usize> = (0..view.height).filter(is_mirrored).collect();
        for (i, row) in rows.iter().enumerate() {
            let half = usize::from(2 * i >= rows.len());
            seen[half] += 1;
            matched[half] += usize::from(trusted(row * view.width + x));
        }
    }
    matched.iter().zip(seen).all(|(&matched, seen)| matched as f64 >= LEAST_MATCHED * seen as f64)
}

/// Where sorted values are densest: the middle of the shortest half, of its shortest half, and so on.
fn densest(sorted: &[f64]) -> Option<f64> {
    let mut values = sorted;
    while values.len() > 3 {
        let half = values.len().div_ceil(2);
        let width = |from: &usize| values[from + half - 1] - values[*from];
        let from = (0..=values.len() - half).min_by(|a, b| width(a).total_cmp(&width(b))).unwrap_or(0);
        values = &values[from..from + half];
    }
    values.get(values.len() / 2).copied()
}

fn median(values: &mut [f64]) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}
