//! What stands in the scene: name, outline, contact line, and how it moves.
//!
//! Every number of a motion may be left out; the motion's kind then supplies it.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::picture::PicturePoint;

use super::annotation::Region;
use super::file::is_default;
use super::relative_path::RelativePath;

/// Something upright that stands in water or on the ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Object<P = RelativePath> {
    /// Its name, different from every other name.
    pub name: String,
    /// What it stands on.
    pub support: Support,
    /// Where it is visible.
    pub outline: Region<P>,
    /// Left and right foot, where it meets its support. Feet at different depths make a yawed wall.
    pub contact: [PicturePoint; 2],
    /// Whether it turns towards a camera that moves around it.
    #[serde(default, skip_serializing_if = "is_default")]
    pub turns_to_camera: bool,
    /// How it moves.
    #[serde(default, skip_serializing_if = "Motion::is_static")]
    pub motion: Motion<P>,
}

/// What an object stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Support {
    /// The resting water.
    Water,
    /// The ground.
    Ground,
}

/// How an object moves.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Motion<P = RelativePath> {
    /// Not at all; in water, waves bend around it.
    #[default]
    Static,
    /// It sways in the wind.
    Sway(Sway),
    /// It floats at anchor and follows the waves.
    Floating(Floating),
    /// It sails along a course.
    Course(Course),
    /// Another simulator's poses drive it.
    Recorded(Recorded<P>),
}

impl<P> Motion<P> {
    /// Whether it never moves.
    #[must_use]
    pub fn is_static(&self) -> bool {
        matches!(self, Self::Static)
    }
}

/// How a plant sways. Numbers left out are those of its kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sway {
    /// What sways.
    pub kind: SwayKind,
    /// Where it is fixed; the middle of the contact line when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub root: Option<PicturePoint>,
    /// Its far end; the outline's top above the root when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip: Option<PicturePoint>,
    /// Natural frequency, 0.02 to 10 hertz.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Damping ratio, 0.01 to 1. Small rings long, large follows the gusts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<f64>,
    /// Root mean square of the tip's way as a fraction of the length, 0 to 0.2, in a wind of 5 m/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub amplitude: Option<f64>,
    /// Time after which the motion repeats, 4 to 120 seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period_seconds: Option<f64>,
    /// Seed of its randomness; derived from the name and the wind's seed when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
}

/// What sways: a preset of frequency, damping and amplitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SwayKind {
    /// A tree of 10 to 20 m.
    Trunk,
    /// Branches or a bush.
    Branch,
    /// Reeds.
    Reed,
    /// Grass.
    Grass,
}

/// How a body floats. Numbers left out follow from draft and contact line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Floating {
    /// How deep it sits in the water, 0.01 to 20 meters.
    pub draft: f64,
    /// Along its keel, 0.1 to 400 meters; from the contact line when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<f64>,
    /// Across its keel, 0.1 to 100 meters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beam: Option<f64>,
    /// Kilograms, above 0; what it displaces when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass: Option<f64>,
    /// Damping ratio of heave and pitch, 0.01 to 2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heave_damping: Option<f64>,
    /// Damping ratio of roll, 0.01 to 2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roll_damping: Option<f64>,
    /// Natural period of heave, 0.2 to 60 seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heave_period_seconds: Option<f64>,
    /// Natural period of roll, 0.2 to 60 seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roll_period_seconds: Option<f64>,
}

impl Floating {
    /// A body that sits so deep in the water, meters; all else follows from it.
    #[must_use]
    pub fn of_draft(draft: f64) -> Self {
        Self {
            draft,
            length: None,
            beam: None,
            mass: None,
            heave_damping: None,
            roll_damping: None,
            heave_period_seconds: None,
            roll_period_seconds: None,
        }
    }
}

impl Sway {
    /// A plant of a kind, with all its numbers.
    #[must_use]
    pub fn of_kind(kind: SwayKind) -> Self {
        Self {
            kind,
            root: None,
            tip: None,
            frequency_hz: None,
            damping: None,
            amplitude: None,
            period_seconds: None,
            seed: None,
        }
    }
}

/// A way over the water.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Course {
    /// At least two points, in the order of travel.
    pub waypoints: Vec<Waypoint>,
    /// Meters per second, above 0, at most 30.
    pub speed: f64,
    /// How deep the body sits in the water, 0.01 to 20 meters.
    pub draft: f64,
    /// Along its keel, 0.1 to 400 meters; from the contact line when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<f64>,
    /// Whether it returns from the last point to the first, again and again.
    #[serde(default, skip_serializing_if = "is_default")]
    pub closed: bool,
}

/// A point of the resting water, in meters: x to the right, z towards the viewer (the scene lies at negative z).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Waypoint(pub DVec2);

/// Poses made by another simulator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recorded<P = RelativePath> {
    /// A JSON list of `{seconds, position, yaw_deg, pitch_deg, roll_deg}`, relative to where the object rests.
    pub poses: P,
    /// Whether it starts over at its end.
    #[serde(default, skip_serializing_if = "is_default")]
    pub looped: bool,
}
