//! How much softer the picture's water shows things than they are: its ripples smear a mirror image upright.
//!
//! A ripple of slope s moves what it mirrors by 2·f·s·D/(z + D) pixels up or down, z the water's distance and D that from
//! there to what is mirrored (notes §8.4). The slope is the one that makes predictions as sharp, along columns, as what
//! is seen; still water leaves them as they are.

use glam::{DVec2, IVec2};
use rayon::prelude::*;

use super::coverage::Coverage;
use super::mirror::mirrored;
use super::reflection::linear;
use super::{Grid, Tint};
use crate::picture::Picture;
use crate::picture::PicturePoint;
use crate::picture::color::srgb_from_linear_f32;
use crate::scene::TourScene;

/// Root mean square slopes that are tried, besides none.
const SLOPES: [f32; 9] = [0.0005, 0.001, 0.002, 0.004, 0.007, 0.012, 0.02, 0.035, 0.06];

/// Predictions must be this much sharper than what is seen before they are softened: fits are not better.
const SHARPER: f32 = 1.25;

/// Steps beyond this many codes count as this many: a mast that is off by a pixel says nothing about sharpness.
const MOST_STEP: f32 = 24.0;

/// Fewer steps than this say nothing.
const LEAST_STEPS: f64 = 500.0;

/// Blur under this many pixels does not show.
const LEAST_BLUR: f32 = 0.3;

/// Standard deviation of the blur, pixels, for what lies `behind` the water by this share of the ray.
pub(super) fn blur_px(scene: &TourScene, slope: f32, behind: f32) -> f32 {
    2.0 * scene.camera.intrinsics.focal_px as f32 * slope * behind
}

/// The mean of colors around a place along its column, weighted by a Gaussian.
pub(super) fn softened(colors: &Grid<[f32; 3]>, at: PicturePoint, deviation: f32) -> [f32; 3] {
    if deviation < LEAST_BLUR {
        return colors.sample(at);
    }
    mean_along_column(deviation, |up| Some(colors.sample(PicturePoint(at.0 + DVec2::new(0.0, up)))))
        .unwrap_or_default()
}

/// The Gaussian mean of what `color` gives for offsets in pixels; `None` where it gives too little.
fn mean_along_column(deviation: f32, color: impl Fn(f64) -> Option<[f32; 3]>) -> Option<[f32; 3]> {
    // Up to 33 taps over ±2.5 deviations.
    let taps = ((2.5 * deviation).ceil() as i32).clamp(1, 16);
    let step = 2.5 * deviation / taps as f32;
    let (mut sum, mut weights, mut all) = ([0.0; 3], 0.0, 0.0);
    for tap in -taps..=taps {
        let offset = tap as f32 * step;
        let weight = (-0.5 * (offset / deviation).powi(2)).exp();
        all += weight;
        if let Some(color) = color(f64::from(offset)) {
            weights += weight;
            (0..3).for_each(|c| sum[c] += weight * color[c]);
        }
    }
    (weights > 0.7 * all).then(|| sum.map(|x| x / weights))
}

/// The root mean square slope of the picture's ripples, 0 for still water.
pub(super) fn fit_slope(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    owner: &Grid<u8>,
    tint: &Tint,
) -> f32 {
    let size = picture.size();
    let step = (f64::from(size.x) * f64::from(size.y) / 40_000.0).sqrt().max(1.0) as usize;
    let columns: Vec<i32> = (0..size.x as i32).step_by(step).collect();
    // For every slope (none first), how much predictions bend along columns, how much what is seen does, and in how many
    // places that was found.
    let sums = columns
        .par_iter()
        .map(|&x| {
            let mut sums = [[0.0_f64; 3]; SLOPES.len() + 1];
            for y in (0..size.y as i32 - 1).step_by(step) {
                let changes = changes(scene, picture, coverage, owner, tint, IVec2::new(x, y));
                for (sum, change) in sums.iter_mut().zip(changes.into_iter().flatten()) {
                    let [predicted, seen] = change.map(|change| f64::from(change.min(MOST_STEP)).powi(2));
                    *sum = [sum[0] + predicted, sum[1] + seen, sum[2] + 1.0];
                }
            }
            sums
        })
        .collect::<Vec<_>>()
        .into_iter()
        .reduce(|all, column| std::array::from_fn(|i| std::array::from_fn(|j| all[i][j] + column[i][j])));
    let Some(sums) = sums else { return 0.0 };
    let sharper = |i: usize| (sums[i][0] / sums[i][1].max(1e-6)).sqrt() as f32;
    let known = sums.iter().take_while(|sum| sum[2] >= LEAST_STEPS).count();
    if known == 0 || sharper(0) < SHARPER {
        return 0.0;
    }
    // Between the last slope that leaves predictions too sharp and the first that does not.
    let Some(first) = (1..known).find(|&i| sharper(i) <= 1.0) else {
        // Rougher than all that could be tried.
        return if known > 1 { SLOPES[known - 2] } else { 0.0 };
    };
    let share = (sharper(first - 1) - 1.0) / (sharper(first - 1) - sharper(first)).max(1e-6);
    let low = if first == 1 { 0.0 } else { SLOPES[first - 2] };
    low + share.clamp(0.0, 1.0) * (SLOPES[first - 1] - low)
}

/// By how many codes of green a pixel differs from the mean of those above and below it, predicted and seen, for every slope
/// whose blur stays within what the picture shows of the component.
fn changes(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    owner: &Grid<u8>,
    tint: &Tint,
    pixel: IVec2,
) -> Option<Vec<[f32; 2]>> {
    // Slow changes survive any blur, so what is measured is bent over a few pixels.
    let apart = IVec2::new(0, (picture.size().x / 480).max(1) as i32);
    let column = [pixel - apart, pixel, pixel + apart];
    let component = owner.get(pixel).filter(|&component| component != 255)?;
    if column.iter().any(|&pixel| owner.get(pixel) != Some(component)) {
        return None;
    }
    let component = usize::from(component);
    let surface = &scene.components[component].surface;
    let color = |at: DVec2| {
        let pixel = at.floor().as_ivec2();
        coverage.is_pure(component, pixel).then(|| linear(picture, pixel))
    };
    let code = |color: [f32; 3]| 255.0 * srgb_from_linear_f32(color[1]);
    let [above, middle, below] = column
        .map(|pixel| mirrored(scene, surface, PicturePoint::pixel_center(pixel.x.into(), pixel.y.into())));
    let places = [above?, middle?, below?];
    let bend = |[a, b, c]: [[f32; 3]; 3]| (code(b) - 0.5 * (code(a) + code(c))).abs();
    let seen = bend(column.map(|pixel| linear(picture, pixel)));
    let predicted = |slope: f32| {
        let [above, middle, below] = places.map(|found| {
            let blur = blur_px(scene, slope, found.behind);
            let direct = if blur < LEAST_BLUR {
                color(found.direct.0)
            } else {
                mean_along_column(blur, |up| color(found.direct.0 + DVec2::new(0.0, up)))
            };
            direct.map(|direct| tint.mirrored(direct, found.grazing))
        });
        Some(bend([above?, middle?, below?]))
    };
    let slopes = std::iter::once(0.0).chain(SLOPES);
    Some(slopes.map_while(|slope| Some([predicted(slope)?, seen])).collect())
}
