//! The best shift of every pixel, seen from both sides.

use rayon::prelude::*;

use super::aggregate::aggregate;
use super::contrast::Contrasts;
use super::cost::Costs;
use super::view::{Kind, View};

/// Both sides agree when their shifts differ by no more, pixels.
const AGREEMENT: isize = 1;

/// The shifts on which both sides agree, in pixels; NaN where there is none. Shifts of at least `least` are tried.
pub(super) fn match_water(view: &View, least: isize, contrasts: &Contrasts) -> Vec<f32> {
    let costs = Costs::of(view, least, contrasts);
    let sums = aggregate(view, &costs);
    agreed(view, &costs, &sums, &contrasts.is_water)
}

/// The shifts on which both sides agree.
fn agreed(view: &View, costs: &Costs, sums: &[i16], is_water: &[f32]) -> Vec<f32> {
    let from_water = winners_of_water(view, costs, sums);
    let mut shifts = vec![f32::NAN; view.kinds.len()];
    shifts.par_chunks_mut(view.width).enumerate().for_each(|(row, shifts)| {
        let range = costs.rows[row];
        let count = range.count();
        for (x, shift) in shifts.iter_mut().enumerate() {
            if count < 3 || view.kinds[row * view.width + x] != Kind::Direct {
                continue;
            }
            let sums = &sums[range.start + x * count..][..count];
            let best = winner(sums);
            let s = range.low + best as isize;
            let mirrored = view.mirror_row(row, s) as usize;
            let cell = x * view.height + mirrored;
            if is_water[cell] == 0.0 || (from_water[cell] as isize - s).abs() > AGREEMENT {
                continue;
            }
            *shift = s as f32 + between(sums, best);
        }
    });
    shifts
}

/// Where the least sum stands; the first of several.
fn winner(sums: &[i16]) -> usize {
    let least = sums.iter().copied().min().unwrap_or(0);
    sums.iter().position(|&sum| sum == least).unwrap_or(0)
}

/// Where the parabola through the least sum and its neighbors is lowest, −½ … ½ from the least.
fn between(sums: &[i16], best: usize) -> f32 {
    if best == 0 || best + 1 >= sums.len() {
        return 0.0;
    }
    let [a, b, c] = [sums[best - 1], sums[best], sums[best + 1]].map(f32::from);
    let bend = a - 2.0 * b + c;
    if bend > 0.0 { (0.5 * (a - c) / bend).clamp(-0.5, 0.5) } else { 0.0 }
}

/// The best shift for every pixel of the mirror image, column by column; far from any shift where there is none.
fn winners_of_water(view: &View, costs: &Costs, sums: &[i16]) -> Vec<i32> {
    let mut winners = vec![i32::MIN / 2; view.kinds.len()];
    winners.par_chunks_mut(view.height).enumerate().for_each_init(
        || vec![i16::MAX; view.height],
        |least, (x, winners)| {
            least.fill(i16::MAX);
            for (row, range) in costs.rows.iter().enumerate() {
                let count = range.count();
                if count == 0 || view.kinds[row * view.width + x] != Kind::Direct {
                    continue;
                }
                for (s, &sum) in (range.low..).zip(&sums[range.start + x * count..][..count]) {
                    let Ok(mirrored) = usize::try_from(view.mirror_row(row, s)) else { continue };
                    if mirrored < view.height && sum < least[mirrored] {
                        least[mirrored] = sum;
                        winners[mirrored] = s as i32;
                    }
                }
            }
        },
    );
    winners
}
