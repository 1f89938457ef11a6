//! Picture space: pixels, (0, 0) the outer corner of the top-left pixel, centers at +0.5, y down.

use glam::DVec2;
use serde::{Deserialize, Serialize};

/// A point of the picture, in pixels.
///
/// (0, 0) is the outer corner of the top-left pixel, pixel centers lie at +0.5, y points down. Points outside the
/// picture are legal: a contact line may run beyond the frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct PicturePoint(pub DVec2);

impl PicturePoint {
    /// The point at `x` pixels from the left and `y` pixels from the top.
    #[must_use]
    pub const fn new(x: f64, y: f64) -> Self {
        Self(DVec2::new(x, y))
    }

    /// The center of the pixel in column `i`, row `j`.
    #[must_use]
    pub fn pixel_center(i: i64, j: i64) -> Self {
        Self::new(i as f64 + 0.5, j as f64 + 0.5)
    }

    /// Pixels from the left edge.
    #[must_use]
    pub const fn x(self) -> f64 {
        self.0.x
    }

    /// Pixels from the top edge.
    #[must_use]
    pub const fn y(self) -> f64 {
        self.0.y
    }
}

impl std::fmt::Display for PicturePoint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "({:.1}, {:.1})", self.0.x, self.0.y)
    }
}
