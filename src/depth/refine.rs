//! Shifts to a fraction of a pixel: around each match a small plane of shifts that the gray values agree with best.
//!
//! Linearized as in Lucas & Kanade 1981: where the water changes by g per pixel of shift and differs by r from what is
//! mirrored, it asks for a shift of r/g more, with weight g². Neighbors across a step in depth take no part.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::contrast::Contrasts;
use super::view::View;

/// A plane is fitted to so many pixels to each side, each so far from the next.
const REACH: isize = 5;
const STRIDE: isize = 2;
/// Neighbors whose shift differs by more belong to something else, pixels.
const SAME: f32 = 1.5;
/// Weight of a pixel without any gradient, as a squared gradient: it keeps the shift that it has.
const EVEN: f64 = 0.01;
/// Stiffness of a plane against slopes, in pixels' weights times squared pixels: steep ones need evidence.
const STIFFNESS: f64 = 20.0;
/// Neighboring gray values tell the same: so many of them count as one.
const ALIKE: f64 = 4.0;
const ROUNDS: usize = 2;
/// With fewer places than this nothing is said of how large errors are.
const FEWEST: usize = 200;

/// Shifts and their standard deviations, pixels; NaN where there is no match.
#[derive(Debug)]
pub(super) struct Refined {
    pub(super) shift: Vec<f32>,
    pub(super) deviation: Vec<f32>,
}

/// What a pixel asks for.
#[derive(Clone, Copy)]
struct Wish {
    shift: f64,
    weight: f64,
    /// The squared gradient alone.
    gradient: f64,
    /// Squared difference of the gray values.
    unlike: f64,
}

/// Refines all shifts of a match.
pub(super) fn refine(view: &View, contrasts: &Contrasts, shift: &[f32]) -> Refined {
    let mut refined = Refined { shift: shift.to_vec(), deviation: vec![f32::NAN; shift.len()] };
    for _ in 0..ROUNDS {
        let before = std::mem::take(&mut refined.shift);
        let wish = |cell: usize| wish(view, contrasts, cell, before[cell]);
        let wishes: Vec<Option<Wish>> = (0..before.len()).into_par_iter().map(wish).collect();
        (refined.shift, refined.deviation) =
            (0..before.len())
                .into_par_iter()
                .map(|cell| {
                    if before[cell].is_nan() {
                        (f32::NAN, f32::NAN)
                    } else {
                        fit(view, &before, &wishes, cell)
                    }
                })
                .unzip();
    }
    let excess = excess(view, &refined);
    refined.deviation.par_iter_mut().for_each(|deviation| *deviation *= excess);
    refined
}

/// How much larger errors are than the planes' fits say, at least 1: pixels of a support err together, by ripples
/// wider than it or by a shape that is no plane.
///
/// Planes whose supports do not overlap err each for itself, so three in a row that should lie on one line show it.
fn excess(view: &View, refined: &Refined) -> f32 {
    let apart = (2 * REACH * STRIDE + 1) as usize;
    let mut found: Vec<f32> = (0..refined.shift.len())
        .into_par_iter()
        .filter(|cell| cell % view.width >= apart && cell % view.width + apart < view.width)
        .filter_map(|cell| {
            let three = [cell - apart, cell, cell + apart];
            let [a, b, c] = three.map(|i| refined.shift[i]);
            let [p, q, r] = three.map(|i| refined.deviation[i]);
            // NaN is not within.
            let one_surface = (a - b).abs() <= SAME && (b - c).abs() <= SAME;
            let off = (a - 2.0 * b + c).abs() / (p * p + 4.0 * q * q + r * r).sqrt();
            (one_surface && off.is_finite()).then_some(off)
        })
        .collect();
    if found.len() < FEWEST {
        return 1.0;
    }
    let middle = found.len() / 2;
    let median = *found.select_nth_unstable_by(middle, f32::total_cmp).1;
    // The median of a normal deviate's size.
    (median / 0.674).max(1.0)
}

fn wish(view: &View, contrasts: &Contrasts, cell: usize, shift: f32) -> Option<Wish> {
    let at = |s: f32| contrasts.water_at(view, cell, s).map(f64::from);
    let (less, more) = (at(shift - 1.0)?, at(shift + 1.0)?);
    let gradient = 0.5 * (more - less);
    let unlike = f64::from(contrasts.direct[0][cell]) - at(shift)?;
    let weight = gradient * gradient + EVEN;
    // One pixel is as far as a linear model reaches.
    let change = (gradient * unlike / weight).clamp(-1.0, 1.0);
    Some(Wish {
        shift: f64::from(shift) + change,
        weight,
        gradient: gradient * gradient,
        unlike: unlike * unlike,
    })
}

/// The plane around a pixel, read at the pixel, and its standard deviation.
fn fit(view: &View, shift: &[f32], wishes: &[Option<Wish>], cell: usize) -> (f32, f32) {
    let (row, x) = (cell / view.width, cell % view.width);
    let own = shift[cell];
    let (mut normal, mut right) = (DMat3::ZERO, DVec3::ZERO);
    let (mut count, mut gradients, mut unlike, mut squares) = (0.0, 0.0, 0.0, 0.0);
    for dy in -REACH..=REACH {
        for dx in -REACH..=REACH {
            let (y, column) = (row as isize + dy * STRIDE, x as isize + dx * STRIDE);
            if y < 0 || column < 0 || y >= view.height as isize || column >= view.width as isize {
                continue;
            }
            let (y, column) = (y as usize, column as usize);
            let other = y * view.width + column;
            let Some(wish) = wishes[other].filter(|_| (shift[other] - own).abs() <= SAME) else { continue };
            let place = DVec3::new(1.0, column as f64 - x as f64, y as f64 - row as f64);
            normal += DMat3::from_cols(place * place.x, place * place.y, place * place.z) * wish.weight;
            right += place * (wish.weight * wish.shift);
            squares += wish.weight * wish.shift * wish.shift;
            gradients += wish.gradient;
            unlike += wish.unlike;
            count += 1.0;
        }
    }
    if count < 3.0 {
        return (own, f32::NAN);
    }
    let weights = normal.x_axis.x;
    normal += DMat3::from_diagonal(DVec3::new(0.0, STIFFNESS * EVEN, STIFFNESS * EVEN));
    let plane = normal.inverse() * right;
    // How far the wishes stray from the plane, and what the gray values' disagreement alone explains.
    let stray = ((squares - plane.dot(right)) / weights).max(0.0);
    let explained = unlike / (gradients + EVEN * count);
    let variance = ALIKE * (stray + explained) / count + stray * SURFACE;
    (plane.x as f32, variance.sqrt() as f32)
}

/// Part of the stray that is the surface's own: trees are no planes.
const SURFACE: f64 = 0.1;
