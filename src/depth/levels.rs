//! Matches at several sizes, put together: fine where the water was still, coarse where it was rippled.
//!
//! Ripples smear a mirror image lengthwise and move its rows about. Each halving of the size halves both and doubles
//! the supports; where the fine match cannot be told from chance, the coarser ones speak, at their precision.

use rayon::prelude::*;

use super::contrast::Contrasts;
use super::matching::match_water;
use super::plane::box_sum;
use super::refine::refine;
use super::trust::{Trust, scores};
use super::view::{Kind, View};

/// Sizes that are matched, each half the one before.
pub(super) const LEVELS: usize = 3;
/// What is told from chance more surely than not.
pub(super) const TRUSTED: f32 = 0.5;
/// Half side of the box in which a level's success is judged, pixels.
const AROUND: usize = 16;
/// Where a level is trusted for this share of what is around, the coarser ones have nothing to add.
const SUCCESS: f32 = 0.25;

/// Shifts in pixels of the finest size, their standard deviations without the horizon's, and confidence 0–1.
#[derive(Debug)]
pub(super) struct Shifts {
    pub(super) shift: Vec<f32>,
    pub(super) deviation: Vec<f32>,
    pub(super) confidence: Vec<f32>,
}

/// Matches `view` with its water; shifts down to −`below` pixels are tried. `None` when `progress` says so.
pub(super) fn match_all(view: &View, below: f64, progress: &dyn Fn(f32) -> bool) -> Option<Shifts> {
    let mut views = vec![view.clone()];
    for level in 1..LEVELS {
        views.push(views[level - 1].halved());
    }
    let mut all: Option<Shifts> = None;
    // Coarse ones first: what they found is what finer ones fall back on.
    for level in (0..LEVELS).rev() {
        let view = &views[level];
        let scale = (1 << level) as f32;
        let least = -(below / f64::from(scale)).ceil() as isize;
        let contrasts = Contrasts::of(view);
        // The finest is the most work, and has enough cells for one try.
        let tries: &[usize] = if level == 0 { &[1] } else { &[1, 2] };
        let by_chance = |third: &usize| {
            let moved = contrasts.with_water_moved(view.width * third / 3, view.height);
            scores(view, &moved, &match_water(view, least, &moved))
        };
        let chance = tries.iter().map(by_chance).collect::<Vec<_>>().concat();
        // Every level is four times the work of the next.
        if !progress(0.25_f32.powi(level as i32) * 0.5) {
            return None;
        }
        let found = match_water(view, least, &contrasts);
        let scores = scores(view, &contrasts, &found);
        let trust = Trust::of(&scores, &chance, 1.0 / tries.len() as f32);
        let refined = refine(view, &contrasts, &found);
        let here = Shifts {
            shift: refined.shift.iter().map(|s| s * scale).collect(),
            deviation: refined.deviation.iter().map(|s| s * scale).collect(),
            confidence: scores.iter().map(|&score| trust.confidence(score)).collect(),
        };
        all = Some(match all {
            Some(coarser) => merged(view, here, &coarser),
            None => here,
        });
    }
    all
}

/// The finer shifts, and the coarser ones where hardly any of the finer are trusted.
fn merged(view: &View, mut finer: Shifts, coarser: &Shifts) -> Shifts {
    let (width, coarse_width) = (view.width, view.width / 2);
    let trusted = finer.confidence.iter().map(|&confidence| f32::from(u8::from(confidence >= TRUSTED)));
    let trusted = box_sum(width, &trusted.collect::<Vec<_>>(), AROUND, AROUND);
    let direct = box_sum(width, &view.weights(Kind::Direct), AROUND, AROUND);
    let Shifts { shift, deviation, confidence } = &mut finer;
    (shift, deviation, confidence).into_par_iter().enumerate().for_each(
        |(cell, (shift, deviation, confidence))| {
            let other = cell / width / 2 * coarse_width + cell % width / 2;
            let failure = 1.0 - trusted[cell] / (SUCCESS * direct[cell]).max(1.0);
            let coarse = coarser.confidence[other] * failure;
            if *confidence < TRUSTED && coarse > *confidence {
                *shift = coarser.shift[other];
                *deviation = coarser.deviation[other];
                *confidence = coarse;
            }
            if !(shift.is_finite() && deviation.is_finite()) {
                (*shift, *deviation, *confidence) = (f32::NAN, f32::NAN, 0.0);
            }
        },
    );
    finer
}
