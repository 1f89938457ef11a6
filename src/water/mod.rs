//! Water that moves: [`sea`] (the waves of the wind), [`ripples`] (what touches and bodies raise) and [`body`] (what floats
//! and sails), as functions of seed, step and time.
//!
//! Tour space: meters, x right, y up, −z into the picture; resting water is y = 0, and a point of it is (x, z). The
//! two add up: heights, slopes and displacements are sums of theirs, as in linear wave theory.

mod fft;

pub mod body;
pub mod ripples;
mod rounds;
pub mod sea;
mod surface;

pub use rounds::RoundError;
pub use surface::{MovingWater, StillWater, WaterPoint, WaterSurface};

/// Acceleration of gravity, m/s².
pub const GRAVITY: f64 = 9.806_65;

/// Surface tension over density of clean water at 20 °C, m³/s².
const TENSION: f64 = 7.28e-5;

/// Kilograms in a cubic meter of water.
pub const DENSITY: f64 = 1000.0;

/// Angular frequency of waves of `wave_number` rad/m on water `depth` meters deep, rad/s (notes §7.1).
fn angular_frequency(wave_number: f64, depth: f64) -> f64 {
    let k = wave_number;
    ((GRAVITY * k + TENSION * k.powi(3)) * (k * depth).tanh()).sqrt()
}
