//! A body that follows the waves: heave, pitch and roll (notes §7.3).
//!
//! The water is sampled at 8 stations along the keel and 4 points across; their weighted mean and plane drive the body, so a
//! hull does not feel waves shorter than itself. The weights are those with which the body presses on the water. With others,
//! a hull and the waves it makes would excite each other. The state advances by steps of [`FloatingBody::DT`].

use glam::{DVec2, DVec3};

use super::hull::Hull;
use super::oscillation::Oscillation;
use super::patch::PressurePatch;
use super::pose::BodyPose;
use super::{WaterHeight, ahead, starboard};

/// Samples along the keel and across it.
const STATIONS: usize = 8;
const ACROSS: usize = 4;
const SAMPLES: usize = STATIONS * ACROSS;

/// Waves higher than this, meters, count as this high; a surface that is no number counts as resting.
const HIGHEST: f64 = 30.0;

/// On water that is still, smaller heights, angles and speeds than this (m, rad, 1/s) are none.
const UNSEEN: f64 = 1e-6;

/// Peak of the Gaussian that presses with the same force and moments as 1 on an ellipse. Their reach is the same: a
/// quarter of length and beam.
const GAUSSIAN: f64 = 2.0;

/// The plane that lies best in the water under a hull.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Plane {
    /// Meters above the resting water.
    height: f64,
    /// Rise per meter ahead and to starboard.
    slope: DVec2,
}

/// A floating body's state.
#[derive(Clone, Debug, PartialEq)]
pub struct FloatingBody {
    hull: Hull,
    /// Where the samples lie (ahead, to starboard; meters), and their weights, which sum to 1.
    samples: [(DVec2, f64); SAMPLES],
    /// Sum of weight times squared distance ahead, and to starboard.
    spread: DVec2,
    heaving: Oscillation,
    rolling: Oscillation,
    /// Value and speed of heave (m), pitch and roll (rad), before the last step and after it.
    before: [[f64; 2]; 3],
    now: [[f64; 2]; 3],
    water: Plane,
}

impl FloatingBody {
    /// Length of a step, seconds.
    pub const DT: f64 = 1.0 / 60.0;

    /// A hull at rest.
    #[must_use]
    pub fn new(hull: Hull) -> Self {
        let mut samples: [(DVec2, f64); SAMPLES] = std::array::from_fn(|i| {
            let place = DVec2::new(centered(i / ACROSS, STATIONS), centered(i % ACROSS, ACROSS));
            // Two reaches to each side, with the pressure's own weights.
            (place * DVec2::new(hull.length, hull.beam) / 2.0, (-2.0 * place.length_squared()).exp())
        });
        let sum: f64 = samples.iter().map(|(_, share)| share).sum();
        for (_, share) in &mut samples {
            *share /= sum;
        }
        let spread = samples.iter().map(|&(place, share)| share * place * place).sum();
        Self {
            samples,
            spread,
            heaving: Oscillation::new(hull.heave_period, hull.heave_damping, Self::DT),
            rolling: Oscillation::new(hull.roll_period, hull.roll_damping, Self::DT),
            before: [[0.0; 2]; 3],
            now: [[0.0; 2]; 3],
            water: Plane::default(),
            hull,
        }
    }

    /// Advances by one step. The waterline's center is at `center` (x, z), the bow points to `heading` (radians).
    pub fn step(&mut self, water: &(impl WaterHeight + ?Sized), center: DVec2, heading: f64) {
        self.water = self.plane(water, center, heading);
        let [heave, pitch, roll] = self.now;
        self.before = self.now;
        self.now = [
            self.heaving.step(heave, self.water.height),
            self.heaving.step(pitch, self.water.slope.x.atan()),
            self.rolling.step(roll, -self.water.slope.y.atan()),
        ];
        // Nobody sees less; without an end, it and its waves would keep each other awake for minutes.
        if self.water == Plane::default()
            && self.now.as_flattened().iter().all(|number| number.abs() < UNSEEN)
        {
            self.now = [[0.0; 2]; 3];
        }
    }

    /// How far it is from its rest, by its own motion: up, pitched and rolled; it stays where it is.
    #[must_use]
    pub fn pose(&self) -> BodyPose {
        self.pose_within_step(1.0)
    }

    /// The same at a part of the last step, from 0 (its start) to 1 (its end), for frames that come between steps.
    ///
    /// The curve has both ends' values and speeds, so frames faster than steps show no corners.
    #[must_use]
    pub fn pose_within_step(&self, part: f64) -> BodyPose {
        let part = if part.is_nan() { 1.0 } else { part.clamp(0.0, 1.0) };
        let [heave, pitch, roll] = std::array::from_fn(|i| {
            let ([from, leaving], [to, arriving]) = (self.before[i], self.now[i]);
            let left = 1.0 - part;
            let turns = left * leaving - part * arriving;
            let [old, new] = [left * left * (1.0 + 2.0 * part), part * part * (1.0 + 2.0 * left)];
            old * from + new * to + part * left * Self::DT * turns
        });
        BodyPose { position: DVec3::new(0.0, heave, 0.0), pitch, roll, ..BodyPose::default() }
    }

    /// The pressure with which it acts on the water since the last step: what it sits too deep, or too high, it pushes or
    /// draws. It is the reaction to the force and the moments that move it, and adds no water. 0 when it rests on still
    /// water, or follows a long wave.
    #[must_use]
    pub fn pressure(&self, center: DVec2, heading: f64) -> PressurePatch {
        let bow = ahead(heading);
        let [heave, pitch, roll] = self.now;
        PressurePatch {
            center,
            ahead: bow,
            reach: DVec2::new(self.hull.length, self.hull.beam) / 4.0,
            head: GAUSSIAN * (self.water.height - heave[0]),
            tilt: GAUSSIAN * (self.water.slope - DVec2::new(pitch[0].tan(), -roll[0].tan())),
        }
    }

    /// The hull.
    #[must_use]
    pub fn hull(&self) -> &Hull {
        &self.hull
    }

    /// The plane through the water under the hull, by least squares.
    fn plane(&self, water: &(impl WaterHeight + ?Sized), center: DVec2, heading: f64) -> Plane {
        let bow = ahead(heading);
        let right = starboard(bow);
        let mut plane = Plane::default();
        for &(place, share) in &self.samples {
            let height = water.height(center + place.x * bow + place.y * right);
            let height = if height.is_nan() { 0.0 } else { height.clamp(-HIGHEST, HIGHEST) };
            // The samples are symmetric, so mean and slopes do not mix.
            plane.height += share * height;
            plane.slope += share * height * place / self.spread;
        }
        plane
    }
}

/// Middle of the i-th of `count` equal parts of −1 to 1.
fn centered(i: usize, count: usize) -> f64 {
    (2 * i + 1) as f64 / count as f64 - 1.0
}
