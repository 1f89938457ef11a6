//! Covariance of slopes: what water that is too fine to be seen still does to a reflection (notes §8.4).

use std::ops::{AddAssign, Mul, MulAssign};

use glam::DVec2;

/// Covariance of the slope's x and z components, without unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SlopeCovariance {
    /// Variance of ∂height/∂x.
    pub xx: f64,
    /// Covariance of the two slopes.
    pub xz: f64,
    /// Variance of ∂height/∂z.
    pub zz: f64,
}

impl SlopeCovariance {
    /// Mean square of the whole slope.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.xx + self.zz
    }

    /// Adds a wave of `amplitude` meters with a wave vector in rad/m.
    pub(super) fn add_wave(&mut self, wave_vector: DVec2, amplitude: f64) {
        let half = 0.5 * amplitude * amplitude;
        self.xx += half * wave_vector.x * wave_vector.x;
        self.xz += half * wave_vector.x * wave_vector.y;
        self.zz += half * wave_vector.y * wave_vector.y;
    }
}

impl AddAssign for SlopeCovariance {
    fn add_assign(&mut self, other: Self) {
        self.xx += other.xx;
        self.xz += other.xz;
        self.zz += other.zz;
    }
}

impl MulAssign<f64> for SlopeCovariance {
    fn mul_assign(&mut self, factor: f64) {
        *self = *self * factor;
    }
}

impl Mul<f64> for SlopeCovariance {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { xx: factor * self.xx, xz: factor * self.xz, zz: factor * self.zz }
    }
}
