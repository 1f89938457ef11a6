//! What a person marked in the picture, as the solver takes it.
//!
//! Plain data; all positions and deviations are in pixels of the picture as used (after a crop).
//! [`super::solve`] checks them before anything else.

use glam::UVec2;
use serde::{Deserialize, Serialize};

use crate::picture::{Lens, PicturePoint};
use crate::tour::Method;
use crate::tour::Support;

/// All evidence about one picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Annotations {
    /// Width and height of the picture as used, pixels.
    pub size: UVec2,
    /// Width and height before a crop, at the same scale; the focal length is guessed from its diagonal.
    pub uncropped_size: UVec2,
    /// Best guess of the principal point.
    pub principal: PicturePoint,
    /// Standard deviation of each coordinate of the principal point, pixels; 0 means known exactly.
    pub principal_deviation_px: f64,
    /// Two points of the horizon (the vanishing line of the water, not the far shore), apart sideways.
    pub horizon: Option<[PicturePoint; 2]>,
    /// Standard deviation of each of these points, pixels, above 0.
    pub horizon_deviation_px: f64,
    /// What is known of the focal length.
    pub focal: FocalLength,
    /// The one length that turns ratios into meters.
    pub scale: Scale,
    /// Vertical planes with contact line.
    pub planes: Vec<AnnotatedPlane>,
    /// What is known of the background's distance.
    pub background: BackgroundHint,
    /// Height of the ground above the water, meters, 0 or more, if it is known.
    pub ground_height: Option<f64>,
    /// Points where the background meets the ground; may be empty.
    pub ground_contact: Vec<PicturePoint>,
    /// Reflection pairs.
    pub pairs: Vec<AnnotatedPair>,
    /// How to solve.
    pub method: Method,
}

impl Annotations {
    /// Standard deviation of a marked horizon point unless the tour says otherwise, pixels.
    pub const HORIZON_DEVIATION_PX: f64 = 2.0;
    /// Standard deviation of the principal point of an uncropped picture, as part of its width.
    pub const PRINCIPAL_DEVIATION: f64 = 0.006;
}

/// What is known of the focal length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum FocalLength {
    /// Known, in pixels.
    Known(f64),
    /// Somewhere between two lengths in pixels.
    Between(f64, f64),
    /// Read from the file (EXIF).
    Prior {
        /// Pixels.
        px: f64,
        /// Standard deviation of its natural logarithm: 0.03 is 3 %.
        ln_deviation: f64,
    },
    /// Not known: guessed from the picture's diagonal.
    Unknown,
}

impl FocalLength {
    /// Deviation of ln f read from EXIF (notes §1.3).
    const EXIF_DEVIATION: f64 = 0.03;

    /// What a file's lens tells of a picture that is `size` pixels large before any crop; nothing where it is not known to
    /// show the whole frame.
    #[must_use]
    pub fn of_lens(lens: Option<Lens>, size: UVec2) -> Self {
        lens.filter(|lens| lens.whole_frame).map_or(Self::Unknown, |lens| Self::Prior {
            px: lens.focal_px(size),
            ln_deviation: Self::EXIF_DEVIATION,
        })
    }
}

/// The one length that turns ratios into meters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Scale {
    /// The camera's height above the water.
    HeightAboveWater {
        /// Meters, above 0.
        meters: f64,
        /// Whether it is a default rather than something a person knows.
        assumed: bool,
    },
    /// The camera's height above the ground, meters, above 0.
    HeightAboveGround(f64),
    /// A length on one of the planes.
    Length {
        /// Index of the plane in [`Annotations::planes`].
        on: usize,
        /// One end.
        from: PicturePoint,
        /// The other end.
        to: PicturePoint,
        /// Meters between them, above 0.
        meters: f64,
    },
}

/// A vertical plane through a contact line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AnnotatedPlane {
    /// As the tour calls it.
    pub name: String,
    /// What it stands on.
    pub support: Support,
    /// Left and right foot.
    pub contact: [PicturePoint; 2],
}

/// What is known of the background's distance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum BackgroundHint {
    /// Meters, above 0.
    Distance(f64),
    /// Points where the background meets the water, one or more.
    Contact(Vec<PicturePoint>),
    /// Whatever the reflection pairs say.
    FromPairs,
    /// There is none: the sky closes the scene. The report then leaves its distance out.
    Open,
}

/// Which plane a reflection pair lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum PairPlane {
    /// At a depth of its own.
    Free,
    /// Roughly on the plane with this index in [`Annotations::planes`].
    Plane(usize),
    /// On the background.
    Background,
}

/// A point and where the water shows it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AnnotatedPair {
    /// As the tour calls it.
    pub name: String,
    /// The point itself.
    pub point: PicturePoint,
    /// Its reflection.
    pub reflection: PicturePoint,
    /// Where the point lies.
    pub on: PairPlane,
    /// Standard deviation of each coordinate of the point, pixels, above 0.
    pub point_deviation_px: f64,
    /// Standard deviation of the reflection, pixels, above 0: sideways and lengthwise. Ripples blur a reflection mostly
    /// lengthwise.
    pub reflection_deviation_px: [f64; 2],
}

impl AnnotatedPair {
    /// A pair with the usual deviations: 1 px, and 3 px lengthwise for the reflection.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        point: PicturePoint,
        reflection: PicturePoint,
        on: PairPlane,
    ) -> Self {
        Self {
            name: name.into(),
            point,
            reflection,
            on,
            point_deviation_px: 1.0,
            reflection_deviation_px: [1.0, 3.0],
        }
    }
}
