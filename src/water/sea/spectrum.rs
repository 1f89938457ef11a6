//! The JONSWAP spectrum over water of finite depth (TMA), in frequency and in wave vectors (notes §7.1).
//!
//! Densities are relative: whoever draws waves from them scales the sum to the significant height.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::super::{GRAVITY, angular_frequency};
use super::fetch::wave_number;

/// Density of waves that run against the wind, as a share of the greatest along it (notes §7.1: 0.05 to 0.2).
const OPPOSING: f64 = 0.05;

/// Overshoot of JONSWAP's peak.
const GAMMA: f64 = 3.3;

/// A sea's energy over wave vectors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spectrum {
    /// Angular frequency of the peak, rad/s.
    peak: f64,
    /// Meters.
    depth: f64,
    /// Exponent s of cos²ˢ.
    spreading: f64,
    /// Unit vector (x, z) that the waves run along.
    direction: DVec2,
    /// Integral of the spread over the circle.
    circle: f64,
}

impl Spectrum {
    /// The spectrum with its peak at `peak_period` seconds.
    pub(super) fn new(peak_period: f64, depth: f64, spreading: f64, direction: DVec2) -> Self {
        let spectrum = Self { peak: TAU / peak_period, depth, spreading, direction, circle: 1.0 };
        const STEPS: u32 = 720;
        let circle = (0..STEPS).map(|step| {
            let angle = TAU * f64::from(step) / f64::from(STEPS);
            spectrum.spread(DVec2::from_angle(angle)) * TAU / f64::from(STEPS)
        });
        Self { circle: circle.sum(), ..spectrum }
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

    /// Density over wave vectors (x, z) in rad/m: `S(ω) D(θ) c_g/k`.
    pub(super) fn over_wave_vectors(&self, wave_vector: DVec2) -> f64 {
        let k = wave_vector.length();
        let omega = |k| angular_frequency(k, self.depth);
        let group_speed = (omega(1.001 * k) - omega(0.999 * k)) / (0.002 * k);
        self.over_frequency(omega(k)) * self.spread(wave_vector / k) / self.circle * group_speed / k
    }

    /// How much runs along a unit vector: 1 along the wind.
    fn spread(&self, along: DVec2) -> f64 {
        let cosine = along.dot(self.direction).clamp(-1.0, 1.0);
        let share = if cosine < 0.0 { OPPOSING } else { 1.0 };
        share * cosine.abs().powf(2.0 * self.spreading)
    }

    /// The integral of `weigh` times the density over all wave vectors of `low` to `high` rad/m.
    pub(super) fn integral(&self, low: f64, high: f64, mut weigh: impl FnMut(DVec2, f64)) {
        const RINGS: u32 = 64;
        const SPOKES: u32 = 72;
        let step = (high / low).ln().max(0.0) / f64::from(RINGS);
        for ring in 0..RINGS {
            let k = low * (step * (f64::from(ring) + 0.5)).exp();
            for spoke in 0..SPOKES {
                let wave_vector = k * DVec2::from_angle(2.0 * PI * f64::from(spoke) / f64::from(SPOKES));
                let area = k * k * step * TAU / f64::from(SPOKES);
                weigh(wave_vector, self.over_wave_vectors(wave_vector) * area);
            }
        }
    }
}
