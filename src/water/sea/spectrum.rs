//! The JONSWAP spectrum over water of finite depth (TMA), in frequency and in wave vectors (notes §7.1).
//!
//! Densities are relative: whoever draws waves from them scales the sum to the significant height, and spreads it over
//! directions.

use std::f64::consts::TAU;

use super::super::{GRAVITY, angular_frequency};
use super::fetch::wave_number;

/// Overshoot of JONSWAP's peak.
const GAMMA: f64 = 3.3;

/// A sea's energy over wave numbers, the same in all directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spectrum {
    /// Angular frequency of the peak, rad/s.
    peak: f64,
    /// Meters.
    depth: f64,
}

impl Spectrum {
    /// The spectrum with its peak at `peak_period` seconds.
    pub(super) fn new(peak_period: f64, depth: f64) -> Self {
        Self { peak: TAU / peak_period, depth }
    }

    /// Wave number of the peak, rad/m.
    pub(super) fn peak_wave_number(&self) -> f64 {
        wave_number(self.peak, self.depth)
    }

    /// Density over the angular frequency.
    pub(super) fn over_frequency(&self, frequency: f64) -> f64 {
        let relative = frequency / self.peak;
        let width = if relative <= 1.0 { 0.07 } else { 0.09 };
        let overshoot = (-0.5 * ((relative - 1.0) / width).powi(2)).exp();
        let shallow = frequency * (self.depth / GRAVITY).sqrt();
        // Kitaigorodskii's factor in Thompson and Vincent's form.
        let limit = match shallow {
            s if s <= 1.0 => 0.5 * s * s,
            s if s < 2.0 => 1.0 - 0.5 * (2.0 - s).powi(2),
            _ => 1.0,
        };
        limit * frequency.powi(-5) * (-1.25 * relative.powi(-4)).exp() * GAMMA.powf(overshoot)
    }

    /// Density over wave vectors of `k` rad/m: `S(ω) c_g/k`.
    pub(super) fn over_wave_vectors(&self, k: f64) -> f64 {
        let omega = |k| angular_frequency(k, self.depth);
        let group_speed = (omega(1.001 * k) - omega(0.999 * k)) / (0.002 * k);
        self.over_frequency(omega(k)) * group_speed / k
    }

    /// Mean square slope of all waves of `low` to `high` rad/m, per radian of directions.
    pub(super) fn mean_square_slope(&self, low: f64, high: f64) -> f64 {
        const RINGS: u32 = 64;
        let step = (high / low).ln().max(0.0) / f64::from(RINGS);
        let rings = (0..RINGS).map(|ring| {
            let k = low * (step * (f64::from(ring) + 0.5)).exp();
            k * k * self.over_wave_vectors(k) * k * k * step
        });
        rings.sum()
    }
}
