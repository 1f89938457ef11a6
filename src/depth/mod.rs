//! Distances from the mirror image: the water as a second camera.
//!
//! A picture with a mirror image in it holds two views of the same shore: the direct one, and one from a camera as far
//! below the water as the real one is above it. In the leveled picture a point v above the horizon at distance z is
//! seen again −v − s, with s = 2·f·h/z (notes §1.1): matching the picture with itself, flipped about its horizon, gives
//! a distance for every match. What cannot be told from chance stays unknown.

mod aggregate;
mod bands;
mod contrast;
mod cost;
mod frame;
mod hints;
mod horizon;
mod levels;
mod map;
mod matching;
mod paint;
mod plane;
mod refine;
mod sky;
#[cfg(test)]
pub(crate) mod tests;
mod trust;
mod view;
mod visibility;
mod vote;

pub use bands::{BandOptions, DepthBand, bands};
pub use hints::{Agreement, DepthPair, ObjectDepth, Waterline, object_depth, pairs, waterline};
pub use map::{DepthMap, HorizonOffset};
pub use paint::paint;

use rayon::prelude::*;

use self::frame::Frame;
use self::levels::{LEVELS, match_all};
use crate::camera::PinholeCamera;
use crate::picture::{Mask, Picture, PicturePoint};

/// How to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthOptions {
    /// Standard deviation of the camera's horizon, pixels of the picture, above 0.
    pub horizon_deviation_px: f64,
    /// Pixels at which the picture is matched; larger ones are matched at a smaller size. Time grows with its 1.5th
    /// power.
    pub pixels: usize,
}

impl Default for DepthOptions {
    fn default() -> Self {
        Self { horizon_deviation_px: 2.0, pixels: 560_000 }
    }
}

/// Why there is no depth map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DepthError {
    /// The camera is none, or looks so steeply that no horizon is near its picture.
    #[error("the camera has no focal length, or looks too steeply up or down to level its picture")]
    Camera,
    /// The height above the water is not a length.
    #[error("the camera's height above the water should be a length above 0, not {0}")]
    Height(f64),
    /// Picture, mask and camera are not of one size.
    #[error("the water's mask and the camera should have the picture's size")]
    Size,
    /// The options cannot be used.
    #[error("the horizon's standard deviation should be above 0 and finite, not {0}")]
    Horizon(f64),
    /// `progress` asked to stop.
    #[error("cancelled")]
    Cancelled,
}

/// Shifts nearer to 0 than this many standard deviations are those of the sky.
const BEYOND: f64 = 2.0;
/// Less of what is seen directly than this is no mirror image, but a few pixels that look alike.
const LEAST_MIRRORED: f64 = 0.01;

/// Measures distances of what a picture shows directly.
///
/// `camera` is the one that took the picture (yaw does not matter), `height` its height above the water in meters.
/// `progress` hears the share done, 0–1, and cancels with `false`. The same input gives the same map, to the bit,
/// whatever the number of cores.
///
/// # Errors
///
/// This returns an error when the camera or the height cannot be used, when sizes differ, or when the work was
/// cancelled. A picture without a mirror image is no error: its map knows nothing and says so.
pub fn measure(
    picture: &Picture,
    water: &Mask,
    camera: &PinholeCamera,
    height: f64,
    options: &DepthOptions,
    progress: &dyn Fn(f32) -> bool,
) -> Result<DepthMap, DepthError> {
    let known = options.horizon_deviation_px;
    if !(height > 0.0 && height.is_finite()) {
        return Err(DepthError::Height(height));
    }
    if !(known > 0.0 && known.is_finite()) {
        return Err(DepthError::Horizon(known));
    }
    let size = picture.size();
    if water.size() != size || camera.intrinsics.size != size {
        return Err(DepthError::Size);
    }
    let frame = Frame::new(camera, options.pixels.max(1) as f64, 1 << (LEVELS - 1))?;
    let scale = frame.picture_scale();
    let view = frame.view(picture, water);
    let one_pixel = 2.0 * camera.intrinsics.focal_px * height;
    // Shifts as far below 0 as the horizon may be wrong.
    let below = (2.0 * 3.0 * known / scale).min(view.height as f64);
    let shifts =
        match_all(&view, below, &|share| progress(0.05 + 0.9 * share)).ok_or(DepthError::Cancelled)?;
    let (leveled, is_sky) = horizon::horizon(&view, &shifts, known / scale);
    let seen = visibility::Seen::of(&view, &shifts);
    let shifts = vote::vote(&view, &shifts, &seen);
    let horizon = HorizonOffset {
        offset_px: leveled.offset_px * scale,
        deviation_px: leveled.deviation_px * scale,
        measured: leveled.measured,
    };
    let mut map = DepthMap::unknown(size, horizon, one_pixel);
    let pixels = (&mut map.distance, &mut map.deviation, &mut map.confidence).into_par_iter().enumerate();
    pixels.for_each(|(pixel, (distance, deviation, confidence))| {
        let (x, y) = ((pixel % size.x as usize) as i64, (pixel / size.x as usize) as i64);
        let Some(cell) = frame.cell(PicturePoint::pixel_center(x, y)) else { return };
        if water.values()[pixel] > 127 || shifts.shift[cell].is_nan() || is_sky[cell] {
            return;
        }
        let shift = (f64::from(shifts.shift[cell]) - 2.0 * leveled.offset_px) * scale;
        let own = f64::from(shifts.deviation[cell]) * scale;
        let deviation_px = own.hypot(2.0 * horizon.deviation_px);
        if shift < BEYOND * deviation_px {
            if shifts.confidence[cell] >= DepthMap::CONFIDENT {
                (*distance, *deviation) = (f32::INFINITY, f32::INFINITY);
            }
            return;
        }
        let meters = one_pixel / shift;
        *distance = meters as f32;
        *deviation = (meters * deviation_px / shift) as f32;
        *confidence = shifts.confidence[cell];
    });
    let direct = water.values().iter().filter(|&&coverage| coverage <= 127).count();
    let mirrored =
        (0..map.distance.len()).filter(|&pixel| map.is_known(pixel) || map.is_beyond(pixel)).count();
    map.has_mirror = mirrored as f64 >= LEAST_MIRRORED * direct as f64 && mirrored > 0;
    if !map.has_mirror {
        return Ok(DepthMap::unknown(size, horizon, one_pixel));
    }
    let sky = (0..map.distance.len()).map(|pixel| {
        let (x, y) = ((pixel % size.x as usize) as i64, (pixel / size.x as usize) as i64);
        let cell = frame.cell(PicturePoint::pixel_center(x, y));
        let is_sky =
            map.is_beyond(pixel) || cell.is_some_and(|cell| is_sky[cell]) && water.values()[pixel] <= 127;
        if is_sky && !map.is_known(pixel) { 255 } else { 0 }
    });
    let sky: Vec<u8> = sky.collect();
    map.sky = Mask::new(size, sky).ok().filter(|sky| sky.bounds().is_some());
    progress(1.0);
    Ok(map)
}
