//! What is marked in the picture: the camera's clues, water, ground, background and sky.
//!
//! Points and lengths are in picture pixels of the document's size unless a field says meters. Types that name files are
//! generic over the path `P`: a `String` as written, a [`RelativePath`] once checked.

use glam::UVec2;
use serde::{Deserialize, Serialize};

use crate::picture::PicturePoint;

use super::file::is_default;
use super::relative_path::RelativePath;

/// The picture and how much of it is used.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureSource<P = RelativePath> {
    /// The picture's file, relative to the tour's folder.
    pub file: P,
    /// Width and height in pixels to which every picture point of the document refers; the file's own when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<UVec2>,
    /// How the picture was made.
    #[serde(default, skip_serializing_if = "is_default")]
    pub medium: Medium,
    /// The part to use. The principal point stays that of the whole picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub crop: Option<Crop>,
}

/// How the picture was made. Only a photograph's EXIF says anything about the lens.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Medium {
    /// Taken by a camera; its EXIF may tell the focal length.
    #[default]
    Photograph,
    /// A reproduction of a painting; its EXIF is the copy camera's.
    Painting,
    /// A reproduction of a print or drawing.
    Print,
}

/// A part of the picture, in whole pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Crop {
    /// Pixels cut off at the left.
    #[serde(default)]
    pub left: u32,
    /// Pixels cut off at the top.
    #[serde(default)]
    pub top: u32,
    /// Pixels kept, above 0.
    pub width: u32,
    /// Pixels kept, above 0.
    pub height: u32,
}

/// What is known of the camera that took (or the eye that painted) the picture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct CameraNotes {
    /// Two points of the horizon, the vanishing line of the water; it may lie outside the frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub horizon: Option<[PicturePoint; 2]>,
    /// Where the optical axis meets the picture; the center of the uncropped picture when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub principal_point: Option<PicturePoint>,
    /// What is known of the focal length.
    #[serde(skip_serializing_if = "is_default")]
    pub focal_length: FocalLength,
    /// The one length that sets the scale; see [`Document::scale`](super::Document::scale) for what is assumed without it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale: Option<Scale>,
    /// Which solver to use.
    #[serde(skip_serializing_if = "is_default")]
    pub method: Method,
}

/// What is known of the focal length, in pixels of the document's picture size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum FocalLength {
    /// Exactly this, above 0.
    Known(f64),
    /// Somewhere between the two, both above 0, the lesser one first.
    Between(f64, f64),
    /// What the picture's EXIF says, as a prior; only for a photograph.
    Exif,
    /// Nothing is known; a usual lens is assumed where the pairs do not tell.
    #[default]
    Unknown,
}

/// The one length that sets the scale.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Scale {
    /// The camera's height above the resting water, meters.
    HeightAboveWater(f64),
    /// The camera's height above the ground, meters.
    HeightAboveGround(f64),
    /// A known length of an object, in the plane in which it stands.
    Length {
        /// The object's name.
        on: String,
        /// One end.
        from: PicturePoint,
        /// The other end.
        to: PicturePoint,
        /// Its length, meters.
        meters: f64,
    },
}

/// How the scene is solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Method {
    /// Pitch and roll, several depths, priors, robust.
    #[default]
    Full,
    /// The paper's: a level camera.
    Paper,
}

/// A part of the picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Region<P = RelativePath> {
    /// Inside these corners, at least three; the last is joined to the first.
    Polygon(Vec<PicturePoint>),
    /// Where a gray picture of the same size is light; gray is partial coverage.
    Mask(P),
}

/// The water and what mirrors in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaterArea<P = RelativePath> {
    /// Where water is visible.
    pub region: Region<P>,
    /// Points and their reflections.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pairs: Vec<ReflectionPair>,
}

/// A point on something and its reflection in the water.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReflectionPair {
    /// The point itself.
    pub point: PicturePoint,
    /// Where the water shows it.
    pub reflection: PicturePoint,
    /// What the point is on: an object's or a band's name, or `"background"`; unknown when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
    /// A name for reports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
}

/// The ground and how high it lies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GroundArea<P = RelativePath> {
    /// Where ground is visible.
    pub region: Region<P>,
    /// Meters, at least 0; 0 when there is no water.
    #[serde(default, skip_serializing_if = "is_default")]
    pub height_above_water: f64,
}

/// What closes the scene behind everything else.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Background<P = RelativePath> {
    /// Where it stands; found from the pairs when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<BackgroundPlace>,
    /// Parts of it that stand elsewhere, near ones first.
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    pub bands: Vec<Band<P>>,
}

impl<P> Default for Background<P> {
    fn default() -> Self {
        Self { place: None, bands: Vec::new() }
    }
}

impl<P> Background<P> {
    /// Whether nothing is said about the background.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.place.is_none() && self.bands.is_empty()
    }
}

/// A part of the background with its own place: a far shore, mountains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Band<P = RelativePath> {
    /// Its name, different from every other name.
    pub name: String,
    /// Where it is visible; all of the background that no other band claims when absent.
    #[serde(default = "none", skip_serializing_if = "Option::is_none")]
    pub region: Option<Region<P>>,
    /// Where it stands.
    pub place: BackgroundPlace,
}

/// Where a plane of the background stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum BackgroundPlace {
    /// This far from the camera, meters, above 0.
    Distance(f64),
    /// Where it meets the water (or ground): at least two points below the horizon.
    Contact(Vec<PicturePoint>),
    /// So far away that it never shows parallax.
    Infinity,
}

/// The sky: a layer at infinity whose clouds may drift.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sky<P = RelativePath> {
    /// Where it is visible; all that nothing else claims above the horizon when absent.
    #[serde(default = "none", skip_serializing_if = "Option::is_none")]
    pub region: Option<Region<P>>,
    /// How the clouds drift; they follow the wind when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drift: Option<Drift>,
}

/// How clouds drift in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drift {
    /// Picture pixels per second, 0 to 100.
    pub speed: f64,
    /// Where to: 0 to the right, 90 up.
    #[serde(default)]
    pub direction_deg: f64,
}

/// `None`, without asking that `P` has a default.
fn none<T>() -> Option<T> {
    None
}
