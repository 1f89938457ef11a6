//! The picture's own camera as the place where maps are read.

use glam::{DMat3, DVec3};

use crate::camera::PinholeCamera;
use crate::picture::PicturePoint;

/// Projects points and directions of the world into the picture, points behind its camera too: those land far outside,
/// where a map's border is prolonged. Twin of `see` in `tour.wgsl`.
pub(super) struct Eye {
    position: DVec3,
    picture_from_direction: DMat3,
}

/// Least view depth; points nearer or behind are treated as this far ahead.
const LEAST_DEPTH: f64 = 1e-3;

impl Eye {
    pub(super) fn of(camera: &PinholeCamera) -> Self {
        Self { position: camera.pose.position, picture_from_direction: camera.picture_from_world_direction() }
    }

    /// Where a point of the world is in the picture, and its view depth there, meters.
    pub(super) fn see(&self, point: DVec3) -> (PicturePoint, f64) {
        self.see_far(point - self.position)
    }

    /// Where a point infinitely far in a direction is in the picture, and the view depth of the direction itself.
    pub(super) fn see_far(&self, direction: DVec3) -> (PicturePoint, f64) {
        let seen = self.picture_from_direction * direction;
        let depth = seen.z.max(LEAST_DEPTH);
        (PicturePoint(seen.truncate() / depth), depth)
    }
}
