//! What the wind raises on a small inland water, for whatever a tour's options leave open.
//!
//! The relations are those of the JONSWAP experiment for a wind that has blown long enough over a fetch F (Hasselmann
//! et al. 1973): `g H_s/U² = 1.6·10⁻³ (gF/U²)^½` and `g T_p/U = 0.286 (gF/U²)^⅓`, with U in m/s. Trees and banks shelter
//! an inland water, so that its waves are as long but lower: heights are taken [`SHELTER`] times. At 3 to 5 m/s this
//! gives what calm lakes have (notes §7.1): heights of 0.01 to 0.1 m, periods of 0.6 to 1.5 s, rms slopes of 0.02 to 0.08.

use std::f64::consts::TAU;

use super::super::{GRAVITY, angular_frequency};
use crate::tour::{Jonswap, Octaves, Wind};

/// Meters of open water that the wind has blown over.
const FETCH: f64 = 1000.0;

/// Height of waves on a sheltered water over that on an open one. Chosen, so that slopes are those of calm lakes.
const SHELTER: f64 = 0.4;

/// A significant height is at most this share of the peak's wavelength where only one of them is given.
const STEEPNESS: f64 = 0.035;

/// The wind whose waves are tabulated when the tour starts without wind, m/s.
const LIGHT_BREEZE: f64 = 4.0;

/// The wind that shape and phases of the waves belong to, m/s: the tour's own.
pub(super) fn nominal_speed(wind: &Wind) -> f64 {
    if wind.speed > 0.0 && wind.speed.is_finite() { wind.speed } else { LIGHT_BREEZE }
}

/// Significant height and longest wavelength that octaves have in a tour's own wind, meters: those given, else the wind's.
pub(crate) fn of_octaves(options: &Octaves, wind: &Wind) -> (f64, f64) {
    let deep = f64::INFINITY;
    // A wavelength given alone fits the height to it, as a peak period does.
    let given = options.wavelength.map(|length| TAU / angular_frequency(TAU / length, deep));
    let (height, period) = height_and_period(nominal_speed(wind), options.max_height, given, deep);
    (height, options.wavelength.unwrap_or_else(|| TAU / wave_number(TAU / period, deep)))
}

/// Significant height in meters and period of the highest waves in seconds that a JONSWAP sea has in a tour's own wind:
/// those given, else the wind's.
pub(crate) fn of_jonswap(options: &Jonswap, wind: &Wind) -> (f64, f64) {
    height_and_period(nominal_speed(wind), options.max_height, options.peak_period_seconds, options.depth)
}

/// Significant height and the period of the highest waves: those given, else from a wind of `speed` m/s, in meters
/// and seconds. What is absent is fitted to what is given, so that no wave stands steeper than water can.
pub(super) fn height_and_period(
    speed: f64,
    height: Option<f64>,
    period: Option<f64>,
    depth: f64,
) -> (f64, f64) {
    let raised = SHELTER * 1.6e-3 * speed * (FETCH / GRAVITY).sqrt();
    // A breath of wind would raise waves too short for what the other numbers take for granted.
    let usual = 0.286 * (speed.max(1.5) * FETCH).cbrt() * GRAVITY.powf(-2.0 / 3.0);
    match (height, period) {
        (Some(height), Some(period)) => (height, period),
        (None, Some(period)) => {
            let longest = TAU / wave_number(TAU / period, depth);
            (raised.min(STEEPNESS * longest), period)
        }
        (height, None) => {
            let height = height.unwrap_or(raised);
            let shortest = (height / STEEPNESS).max(1e-6);
            (height, usual.max(TAU / angular_frequency(TAU / shortest, depth)))
        }
    }
}

/// The wave number at which [`angular_frequency`] is `frequency` (rad/s), rad/m, by bisection of its logarithm.
pub(super) fn wave_number(frequency: f64, depth: f64) -> f64 {
    let (mut low, mut high) = (-14.0_f64, 10.0_f64);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if angular_frequency(middle.exp(), depth) < frequency {
            low = middle;
        } else {
            high = middle;
        }
    }
    low.exp()
}
