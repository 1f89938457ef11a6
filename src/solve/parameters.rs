//! What a solved picture is: the camera's lens, tilt and heights, and how far the background lies.
//!
//! World, view and angles are those of [`crate::camera`]: resting water at y = 0, −z into the picture, pitch > 0 looks
//! up, yaw is 0. Depths are meters along −z, so they do not depend on where the camera points.

use glam::{DVec3, UVec2};
use serde::Serialize;

use crate::camera::CameraPose;
use crate::camera::Intrinsics;
use crate::camera::PinholeCamera;
use crate::picture::PicturePoint;

/// The numbers a tour needs of its picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SceneParameters {
    /// Focal length, pixels, above 0.
    pub focal_px: f64,
    /// Where the optical axis meets the picture.
    pub principal: PicturePoint,
    /// Pitch of the camera, radians; above 0 looks up.
    pub pitch: f64,
    /// Roll of the camera, radians, as in [`CameraPose`].
    pub roll: f64,
    /// Height of the camera above the resting water, meters, above 0 (the paper's `h_w`).
    pub height: f64,
    /// Height of the ground above the resting water, meters, 0 or more (the paper's `h_w − h_c`).
    pub ground_height: f64,
    /// Depth of the background plane, meters along −z (the paper's d).
    pub background_distance: f64,
}

impl SceneParameters {
    /// The camera that took the picture: above the origin, yaw 0. `size` is the picture's, in pixels.
    #[must_use]
    pub fn camera(&self, size: UVec2) -> PinholeCamera {
        PinholeCamera {
            intrinsics: Intrinsics { focal_px: self.focal_px, principal: self.principal, size },
            pose: CameraPose::from_angles(DVec3::new(0.0, self.height, 0.0), 0.0, self.pitch, self.roll),
        }
    }

    /// Depth, in meters along −z, of what `point` shows if it lies on the resting water.
    ///
    /// `None` on and above the horizon.
    #[must_use]
    pub fn depth_on_water(&self, point: PicturePoint) -> Option<f64> {
        self.depth_on_level(point, 0.0)
    }

    /// Depth, in meters along −z, of what `point` shows if it lies `level_height` meters above the resting water.
    ///
    /// `None` where the ray through `point` never comes to that height.
    #[must_use]
    pub fn depth_on_level(&self, point: PicturePoint, level_height: f64) -> Option<f64> {
        let depth = -self.camera(UVec2::ONE).on_level(point, level_height)?.z;
        (depth > 0.0).then_some(depth)
    }
}
