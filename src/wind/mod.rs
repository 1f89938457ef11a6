//! One wind for plants and clouds: stochastic motion textures (Chuang et al. 2005; notes §6).
//!
//! Everything is a function of time, seed and wind: frames may come in any order, every motion repeats without a seam,
//! and a wind of 0 is the still picture to the bit. Only amplitudes depend on the wind's speed, so changing it makes
//! nothing skip; [`ChangingWeather`] lets it change gently.
//!
//! [`Plants`] turns time and wind into one [`SwayRecord`] a plant; [`SwayRecord::rest_point`] and its twin in
//! `sway.wgsl` undo the motion of a point. [`cloud_copies`] moves the sky.

mod change;
mod clouds;
mod gusts;
mod oscillator;
mod plant;
pub(crate) mod preset;
mod spectrum;
mod sway;
#[cfg(test)]
mod sway_tests;
#[cfg(test)]
mod tests;

pub use change::{ChangingWeather, HIGHEST_WAVES, Weather};
pub use clouds::{CloudCopy, cloud_copies, drift_of_wind};
pub use gusts::Gusts;
pub use oscillator::{LoopedSignal, Oscillator};
pub use plant::{Plant, PlantError, Plants, Stand, seed_of_name, strength};
pub use spectrum::velocity_power;
pub use sway::{SwayMode, SwayRecord};

use glam::DVec2;

/// The fastest wind, m/s; faster ones count as this.
pub const FASTEST_WIND: f64 = 60.0;

/// Speed of a wind as it is used, m/s: 0 to [`FASTEST_WIND`]; what is no number counts as 0.
fn sound_speed(speed: f64) -> f64 {
    if speed.is_nan() { 0.0 } else { speed.clamp(0.0, FASTEST_WIND) }
}

/// Unit vector (x, z) of a direction in degrees: 0 towards +x, 90 towards −z. What is no number counts as 0.
fn heading_of_degrees(direction_deg: f64) -> DVec2 {
    let angle = if direction_deg.is_finite() { direction_deg.to_radians() } else { 0.0 };
    DVec2::new(angle.cos(), -angle.sin())
}

/// Which part of a loop of `period` seconds a time is at, 0 to below 1. What is no number counts as 0.
///
/// It stays in f64, where the step of a year's seconds is 4 ns.
fn part_of_loop(seconds: f64, period: f64) -> f64 {
    let part = seconds.rem_euclid(period) / period;
    if part < 1.0 { part } else { 0.0 }
}
