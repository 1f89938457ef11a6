//! How the wind's speed varies: the velocity spectrum that drives every plant.

/// Length of the wind's eddies in the spectrum, meters.
///
/// Simiu and Scanlan's engineering form has 50 z for a height z. That bends the spectrum far below what plants answer,
/// where gusts (see [`Gusts`](super::Gusts)) take over; a short length keeps each plant's peak at its own resonance.
/// Only the spectrum's shape counts, as responses are normalized (notes §6.1).
const EDDY: f64 = 1.0;

/// The mean speed that shapes the spectrum, m/s. It is fixed, so that a change of wind changes amplitudes only.
pub(super) const NOMINAL_SPEED: f64 = 5.0;

/// Power of the wind's speed at a frequency (hertz, not below 0) and mean speed (m/s, above 0), up to a factor:
/// v / (1 + κ f/v)^(5/3) (notes §6.1).
#[must_use]
pub fn velocity_power(frequency_hz: f64, mean_speed: f64) -> f64 {
    mean_speed / (1.0 + EDDY * frequency_hz / mean_speed).powf(5.0 / 3.0)
}
