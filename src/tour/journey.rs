//! The camera's path through the scene.
//!
//! Positions are in world space: meters, x right, y above the resting water, −z into the picture, which was taken from
//! (0, h, 0). Angles are in degrees, as in every file.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::camera::CameraPose;

use super::file::is_default;
use crate::camera;
use crate::camera::Easing;

/// Where the camera goes by itself.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CameraPath {
    /// At least one.
    pub keyframes: Vec<Keyframe>,
    /// Whether it goes on from the last keyframe to the first, again and again.
    #[serde(default, skip_serializing_if = "is_default")]
    pub looped: bool,
}

impl CameraPath {
    /// The way itself; `None` for a path without stations, which no checked tour has.
    #[must_use]
    pub fn way(&self) -> Option<camera::CameraPath> {
        let station = |keyframe: &Keyframe| camera::Keyframe {
            pose: keyframe.pose(),
            arrive: keyframe.seconds,
            hold: keyframe.hold,
            easing: keyframe.easing,
        };
        camera::CameraPath::new(self.keyframes.iter().map(station).collect(), self.looped)
    }
}

/// One station of the path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Keyframe {
    /// Meters; y is the height above the resting water, above 0.
    pub position: DVec3,
    /// Above 0 turns left.
    #[serde(default, skip_serializing_if = "is_default")]
    pub yaw_deg: f64,
    /// Above 0 looks up, −90 to 90.
    #[serde(default, skip_serializing_if = "is_default")]
    pub pitch_deg: f64,
    /// Above 0 tips the camera to its left.
    #[serde(default, skip_serializing_if = "is_default")]
    pub roll_deg: f64,
    /// Time to get here from the keyframe before, 0 to 3600. The first keyframe's counts only in a looped path.
    pub seconds: f64,
    /// Time to stay, 0 to 3600 seconds.
    #[serde(default, skip_serializing_if = "is_default")]
    pub hold: f64,
    /// How the way here is spread over its time.
    #[serde(default, skip_serializing_if = "is_default")]
    pub easing: Easing,
}

impl Keyframe {
    /// Where the camera stands and looks at this station.
    #[must_use]
    pub fn pose(&self) -> CameraPose {
        CameraPose::from_angles(
            self.position,
            self.yaw_deg.to_radians(),
            self.pitch_deg.to_radians(),
            self.roll_deg.to_radians(),
        )
    }
}
