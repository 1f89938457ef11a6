//! How the energy of a sea spreads around the direction in which it runs: a smooth function of the angle, so that a sea can
//! turn.

use std::f64::consts::PI;

/// Density of waves that run against the wind, as a share of the greatest along it (notes §7.1: 0.05 to 0.2).
const OPPOSING: f64 = 0.05;

/// Degrees between the rays of a fan, and from its middle to its outermost full one (notes §7.1).
pub(super) const RAY_SPACING: f64 = 25.0;
const FAN_HALF_ANGLE: f64 = 50.0;

/// Degrees by which a ray may be off its place and still be full, or none.
const PLAY: f64 = 0.5;

/// A spread around a direction. Shares are relative.
#[derive(Clone, Copy, Debug)]
pub(super) enum Spread {
    /// cos²ˢ, and a little against the wind.
    Cosine {
        /// s.
        exponent: f64,
    },
    /// Rays [`RAY_SPACING`] apart, of which five count fully where one of them is the middle; as the middle passes on, one
    /// comes while another goes, with the same energy in all.
    Fan,
}

impl Spread {
    /// The share of waves at an angle of this cosine to the middle, 0 to 1.
    pub(super) fn share(self, cosine: f64) -> f64 {
        let cosine = cosine.clamp(-1.0, 1.0);
        match self {
            Self::Cosine { exponent } => {
                let share = if cosine < 0.0 { OPPOSING } else { 1.0 };
                share * cosine.abs().powf(2.0 * exponent)
            }
            Self::Fan => {
                let past = cosine.acos().to_degrees() - FAN_HALF_ANGLE - PLAY;
                0.5 * (1.0 + (PI * (past / (RAY_SPACING - 2.0 * PLAY)).clamp(0.0, 1.0)).cos())
            }
        }
    }
}
