//! What a moving body does to the water (notes §7.4).

use glam::DVec2;

use super::hull::Hull;
use super::patch::PressurePatch;
use super::{GRAVITY, ahead};

/// Most pressure in meters of water, per draft.
const MOST_HEAD: f64 = 0.3;

/// The wake's source: a pressure p = ρ g a exp(−r²/2s²) elongated along the hull, s a quarter of length and beam.
///
/// a is the height to which water rises at the bow, U²/2g, leveling off at 0.3 of the draft; so a body at rest leaves
/// the water alone, and starting makes no ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wake {
    reach: DVec2,
    most_head: f64,
}

impl Wake {
    /// The wake of a hull.
    #[must_use]
    pub fn new(hull: &Hull) -> Self {
        Self { reach: DVec2::new(hull.length, hull.beam) / 4.0, most_head: MOST_HEAD * hull.draft }
    }

    /// The pressure when the hull's center is at `center` (x, z; meters), its bow points to `heading` (radians), and it
    /// makes `speed` (m/s) ahead or astern. Numbers that are none give no pressure.
    #[must_use]
    pub fn pressure(&self, center: DVec2, heading: f64, speed: f64) -> PressurePatch {
        let rise = speed * speed / (2.0 * GRAVITY);
        let head = rise * self.most_head / (rise + self.most_head);
        let sound = head.is_finite() && center.is_finite() && heading.is_finite();
        let (center, heading, head) = if sound { (center, heading, head) } else { (DVec2::ZERO, 0.0, 0.0) };
        PressurePatch { center, ahead: ahead(heading), reach: self.reach, head, tilt: DVec2::ZERO }
    }
}
