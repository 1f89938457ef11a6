//! The drift of the clouds: two copies of the sky, half a period apart, one fading in while the other fades out.
//!
//! Each copy drifts from half a way behind its place in the picture to half a way ahead, and is invisible at both ends,
//! so nothing shows where it starts over. At time 0, and in a wind of 0, the picture is shown as it is.

use std::f64::consts::PI;

use glam::DVec2;

use super::{part_of_loop, sound_speed};
use crate::tour::{Drift, Wind};

/// Angle by which clouds move for each meter of wind, radians: those some 5 km away (notes §6.2: 0.2 to 2 px/s).
const RADIANS_PER_METER: f64 = 2e-4;

/// Wind speed towards which the drift's growth levels off, m/s: beyond it the two copies would visibly part.
const LEVELING_SPEED: f64 = 20.0;

/// How much slower clouds that come or go look than those that pass by, low in the sky.
const RECEDING: f64 = 0.3;

/// One copy of the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudCopy {
    /// How far it is moved, picture pixels: right, down.
    pub offset_px: DVec2,
    /// Its share of the color, 0 to 1.
    pub weight: f64,
}

impl CloudCopy {
    /// Clouds that stand where the picture shows them.
    pub const STILL: [Self; 2] =
        [Self { offset_px: DVec2::ZERO, weight: 1.0 }, Self { offset_px: DVec2::ZERO, weight: 0.0 }];
}

/// The drift of clouds that follow the wind, for a picture of a focal length in pixels: U / √(1 + (U/20)²) · 0.0002 rad/s
/// across. Clouds blown into the picture sink towards the horizon.
#[must_use]
pub fn drift_of_wind(wind: &Wind, focal_length_px: f64) -> Drift {
    let speed = sound_speed(wind.speed);
    let rate = RADIANS_PER_METER * speed / (1.0 + (speed / LEVELING_SPEED).powi(2)).sqrt();
    let across = super::heading_of_degrees(wind.direction_deg);
    let up_right = DVec2::new(across.x, RECEDING * across.y) * rate * focal_length_px.max(0.0);
    Drift { speed: up_right.length(), direction_deg: up_right.to_angle().to_degrees() }
}

/// The two copies at a time, for a loop of `period` seconds (above 0). The weights sum to 1; the first copy is the one
/// that has its own place at time 0. Offsets grow with the drift's speed, so changing it makes no jump.
#[must_use]
pub fn cloud_copies(drift: &Drift, period: f64, seconds: f64) -> [CloudCopy; 2] {
    let speed = if drift.speed.is_finite() { drift.speed.max(0.0) } else { 0.0 };
    if speed == 0.0 {
        return CloudCopy::STILL;
    }
    // The tour's direction is 90 upwards, which is where a heading's z is negative and a picture's y too.
    let way = super::heading_of_degrees(drift.direction_deg) * speed * period;
    let part = part_of_loop(seconds, period);
    let weight = (PI * part).cos().powi(2);
    // The first copy starts over at half the period, the second at its whole.
    let first = if part < 0.5 { part } else { part - 1.0 };
    [
        CloudCopy { offset_px: way * first, weight },
        CloudCopy { offset_px: way * (part - 0.5), weight: 1.0 - weight },
    ]
}
