//! The depth map: what a picture's mirror image says, pixel by pixel.

use glam::UVec2;

use crate::picture::Mask;

/// Distances of a picture's pixels, row by row from the top left, each with how far it can be trusted.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthMap {
    /// Width and height of the picture, pixels.
    pub size: UVec2,
    /// Meters along the camera's level heading, −z. Infinite where a mirror image was found as far below the horizon as
    /// the thing stands above, which is so for the sky and whatever cannot be told from it; NaN where nothing is known.
    pub distance: Vec<f32>,
    /// Standard deviation of each finite distance, meters, the horizon's share included, but not that of focal length and
    /// height, which scale all distances alike; infinite or NaN elsewhere.
    pub deviation: Vec<f32>,
    /// Probability, 0–1, that the distance is one at all, and not a chance resemblance; 0 where it is not known.
    pub confidence: Vec<f32>,
    /// Where the horizon is.
    pub horizon: HorizonOffset,
    /// The distance at which a mirror image stands one pixel farther below the horizon than its thing above: 2·f·h,
    /// meters times pixels (notes §1.1).
    pub one_pixel: f64,
    /// What is sky, where the picture shows one: by its look, unless its mirror image puts it nearer.
    pub sky: Option<Mask>,
    /// Whether the water shows a mirror image at all.
    pub has_mirror: bool,
}

/// How far below the camera's horizon the mirror image puts the true one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HorizonOffset {
    /// Pixels of the picture, > 0 downward.
    pub offset_px: f64,
    /// Its standard deviation, pixels.
    pub deviation_px: f64,
    /// Whether the sky's mirror image showed it, or only what was known before.
    pub measured: bool,
}

impl DepthMap {
    /// The confidence from which a distance is worth using: right more likely than not.
    pub const CONFIDENT: f32 = 0.5;

    /// A map that knows nothing.
    pub(super) fn unknown(size: UVec2, horizon: HorizonOffset, one_pixel: f64) -> Self {
        let count = size.x as usize * size.y as usize;
        Self {
            size,
            distance: vec![f32::NAN; count],
            deviation: vec![f32::NAN; count],
            confidence: vec![0.0; count],
            horizon,
            one_pixel,
            sky: None,
            has_mirror: false,
        }
    }

    /// Whether the distance of a pixel, by its index, is known.
    #[must_use]
    pub fn is_known(&self, pixel: usize) -> bool {
        self.confidence[pixel] >= Self::CONFIDENT
    }

    /// Whether a pixel's mirror image was found, and puts it beyond any distance that could be told.
    #[must_use]
    pub fn is_beyond(&self, pixel: usize) -> bool {
        self.distance[pixel] == f32::INFINITY
    }

    /// How far, in pixels, the mirror image of something at `distance` meters stands farther from the horizon than the
    /// thing itself.
    #[must_use]
    pub fn shift(&self, distance: f64) -> f64 {
        self.one_pixel / distance
    }
}
