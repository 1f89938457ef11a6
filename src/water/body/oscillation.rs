//! One damped oscillation towards a target, stepped exactly for a target that stands still during the step.

use std::f64::consts::TAU;

/// A damped oscillation x″ + 2ζω x′ + ω² (x − target) = 0 with a fixed step; right for any damping and step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillation {
    /// What a step makes of (x − target, x′), by rows.
    step: [[f64; 2]; 2],
}

impl Oscillation {
    /// An oscillation of an undamped period (seconds, above 0) and damping ratio (not below 0), with steps of `dt` seconds.
    #[must_use]
    pub fn new(period: f64, damping: f64, dt: f64) -> Self {
        let natural = TAU / period;
        let decay = damping * natural;
        // cos and sin(x)/x of the damped frequency; hyperbolic beyond critical damping. The decay goes into the
        // exponentials there, or strong damping would overflow.
        let square = natural * natural * (1.0 - damping * damping);
        let angle = square.abs().sqrt() * dt;
        let (even, odd) = if angle < 1e-6 {
            ((-decay * dt).exp(), dt * (-decay * dt).exp())
        } else if square > 0.0 {
            let fade = (-decay * dt).exp();
            (fade * angle.cos(), fade * dt * angle.sin() / angle)
        } else {
            let (slow, fast) = ((angle - decay * dt).exp(), (-angle - decay * dt).exp());
            (0.5 * (slow + fast), dt * 0.5 * (slow - fast) / angle)
        };
        Self { step: [[even + decay * odd, odd], [-natural * natural * odd, even - decay * odd]] }
    }

    /// Position and speed after one step.
    #[must_use]
    pub fn step(&self, [position, speed]: [f64; 2], target: f64) -> [f64; 2] {
        let away = position - target;
        let [[a, b], [c, d]] = self.step;
        [target + a * away + b * speed, c * away + d * speed]
    }
}
