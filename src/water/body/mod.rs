//! Bodies in the water: floating at anchor, sailing a course, or led by another simulator's poses (notes §7.3, §7.4).
//!
//! They see the water through [`WaterHeight`] and act on it through [`PressurePatch`]es. A body never moved on still water
//! stays at rest exactly. Headings are radians: 0 towards +x, π/2 towards −z, the angle of a turn to the left about y.
//!
//! [`Floating`](crate::tour::Floating) → [`Hull`] → [`FloatingBody`]; [`Course`](crate::tour::Course) → [`SailedCourse`];
//! poses in JSON → [`RecordedPoses`]. All yield a [`BodyPose`], which moves points of a body from their rest and back.

#[cfg(test)]
mod coupling_tests;
mod course;
#[cfg(test)]
mod course_tests;
mod curve;
mod floating;
mod hull;
mod oscillation;
mod patch;
mod pose;
mod recorded;
#[cfg(test)]
mod tests;
mod wake;
#[cfg(test)]
mod wake_tests;

pub use course::{AtEnd, CourseError, SailedCourse, Sailing};
pub use floating::FloatingBody;
pub use hull::Hull;
pub use oscillation::Oscillation;
pub use patch::PressurePatch;
pub use pose::{Berth, BodyPose, Facing, facing, rest_heading};
pub use recorded::{PosesError, RecordedPoses};
pub use wake::Wake;

use glam::DVec2;

use super::{DENSITY, GRAVITY};

/// The water's surface as bodies feel it, at one moment.
pub trait WaterHeight {
    /// Meters above the resting water at a point (x, z), meters.
    fn height(&self, xz: DVec2) -> f64;
}

impl<F: Fn(DVec2) -> f64> WaterHeight for F {
    fn height(&self, xz: DVec2) -> f64 {
        self(xz)
    }
}

/// Unit vector (x, z) of a heading.
fn ahead(heading: f64) -> DVec2 {
    DVec2::new(heading.cos(), -heading.sin())
}

/// Unit vector (x, z) to the right of unit vector `ahead`.
fn starboard(ahead: DVec2) -> DVec2 {
    DVec2::new(-ahead.y, ahead.x)
}

/// An angle brought between −π and π.
fn wrapped(angle: f64) -> f64 {
    (angle + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI
}

/// A number within its range, or the one to use where there is none.
fn number(value: Option<f64>, otherwise: f64, low: f64, high: f64) -> f64 {
    value.filter(|value| !value.is_nan()).unwrap_or(otherwise).clamp(low, high)
}
