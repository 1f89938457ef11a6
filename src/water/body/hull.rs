//! A hull's measures, and how it answers waves: what the tour says, and what follows from it.

use std::f64::consts::{PI, TAU};

use super::{DENSITY, GRAVITY, number};
use crate::tour::Course;
use crate::tour::Floating;

/// Water that swings along, as a share of the hull's mass (notes §7.3: 0.5 to 1).
const ADDED_MASS: f64 = 0.7;

/// Beam per length where the tour has none: that of a rowing boat.
const SLENDERNESS: f64 = 0.3;

/// Radius of gyration of roll, per beam.
const ROLL_GYRATION: f64 = 0.4;

/// Least metacentric height, per beam; a narrow deep hull is ballasted, or it would lie on its side.
const LEAST_STABILITY: f64 = 0.05;

/// A hull with an elliptic waterline. All its numbers are finite and above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hull {
    /// Along its keel, meters.
    pub length: f64,
    /// Across its keel, meters.
    pub beam: f64,
    /// How deep it sits, meters.
    pub draft: f64,
    /// Kilograms.
    pub mass: f64,
    /// Natural period of heave and pitch, seconds. Slender hulls swing alike in both, as mass and waterline are spread
    /// alike along the keel.
    pub heave_period: f64,
    /// Damping ratio of heave and pitch.
    pub heave_damping: f64,
    /// Natural period of roll, seconds.
    pub roll_period: f64,
    /// Damping ratio of roll.
    pub roll_damping: f64,
}

impl Hull {
    /// The hull of a floating body; `contact_length` (meters) is its length where the tour has none.
    ///
    /// Where the tour has none, mass is that of the water displaced by the waterline's area times the draft, heave's period
    /// 2π√(1.7 m / (ρ g A)), roll's 2π · 0.4 beam / √(g GM) with GM = beam² A / (16 V) (center of gravity at that of
    /// buoyancy), damping 0.15 and 0.08 (notes §7.3). Numbers out of their ranges are brought into them.
    #[must_use]
    pub fn new(floating: &Floating, contact_length: f64) -> Self {
        let length = number(floating.length, number(Some(contact_length), 4.0, 0.1, 400.0), 0.1, 400.0);
        let beam = number(floating.beam, SLENDERNESS * length, 0.1, 100.0);
        let draft = number(Some(floating.draft), 0.3, 0.01, 20.0);
        let area = PI / 4.0 * length * beam;
        let mass = number(floating.mass, DENSITY * area * draft, 0.1, 1e9);
        let volume = mass / DENSITY;
        let heave = TAU * ((1.0 + ADDED_MASS) * volume / (GRAVITY * area)).sqrt();
        let stability = (beam * beam * area / (16.0 * volume)).max(LEAST_STABILITY * beam);
        let roll = TAU * ROLL_GYRATION * beam / (GRAVITY * stability).sqrt();
        Self {
            length,
            beam,
            draft,
            mass,
            heave_period: number(floating.heave_period_seconds, heave, 0.2, 60.0),
            heave_damping: number(floating.heave_damping, 0.15, 0.01, 2.0),
            roll_period: number(floating.roll_period_seconds, roll, 0.2, 60.0),
            roll_damping: number(floating.roll_damping, 0.08, 0.01, 2.0),
        }
    }

    /// The hull of a body that sails a course, which says its draft and perhaps its length.
    #[must_use]
    pub fn of_course(course: &Course, contact_length: f64) -> Self {
        let afloat = Floating {
            draft: course.draft,
            length: course.length,
            beam: None,
            mass: None,
            heave_damping: None,
            roll_damping: None,
            heave_period_seconds: None,
            roll_period_seconds: None,
        };
        Self::new(&afloat, contact_length)
    }
}
