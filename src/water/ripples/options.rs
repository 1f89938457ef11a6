//! How ripples are computed.

use super::grid::{RippleError, RippleGrid};

/// Which equation ripples obey.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RippleSolver {
    /// Water waves: long ones run faster than short ones, so that wakes have Kelvin's angle.
    Dispersive {
        /// Depth of the water, 0.01 to 10 000 meters.
        depth: f64,
    },
    /// The wave equation: all waves run alike. Some four times cheaper.
    WaveEquation {
        /// Their speed, 0.01 to 20 m/s.
        speed: f64,
    },
}

/// How ripples are computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RippleOptions {
    /// The equation.
    pub solver: RippleSolver,
    /// Seconds a step, 1/1000 to 1/10.
    pub step_seconds: f64,
    /// Seconds in which waves lose half of their height, 0.1 to 1000.
    pub half_life_seconds: f64,
}

impl Default for RippleOptions {
    fn default() -> Self {
        Self {
            solver: RippleSolver::Dispersive { depth: 20.0 },
            step_seconds: 1.0 / 60.0,
            half_life_seconds: 5.0,
        }
    }
}

impl RippleOptions {
    pub(super) fn check(&self, grid: &RippleGrid) -> Result<(), RippleError> {
        let (name, value, low, high, range) = match self.solver {
            RippleSolver::Dispersive { depth } => ("depth", depth, 0.01, 1e4, "0.01 to 10 000 meters"),
            RippleSolver::WaveEquation { speed } => ("speed", speed, 0.01, 20.0, "0.01 to 20 m/s"),
        };
        let checks = [
            (name, value, low, high, range),
            ("step_seconds", self.step_seconds, 1e-3, 0.1, "0.001 to 0.1 seconds"),
            ("half_life_seconds", self.half_life_seconds, 0.1, 1e3, "0.1 to 1000 seconds"),
        ];
        for (name, value, low, high, range) in checks {
            if !(low..=high).contains(&value) {
                return Err(RippleError::Option { name, value, range });
            }
        }
        if let RippleSolver::WaveEquation { speed } = self.solver {
            let cells = speed * self.step_seconds / grid.cell;
            if cells > 8.0 {
                let range = "so low that a wave passes at most 8 cells a step";
                return Err(RippleError::Option { name, value: speed, range });
            }
        }
        Ok(())
    }
}
