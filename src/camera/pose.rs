//! Where a camera stands and looks.

use glam::{DQuat, DVec3, EulerRot};
use serde::{Deserialize, Serialize};

/// Position and rotation of a camera in the world.
///
/// Rotation is world-from-view, Ry(yaw)·Rx(pitch)·Rz(roll): yaw > 0 turns left, pitch > 0 looks up, roll > 0 tips the
/// camera to its left (the picture turns clockwise).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraPose {
    /// Meters; y is the height above the resting water.
    pub position: DVec3,
    /// World from view, of unit length.
    pub rotation: DQuat,
}

impl CameraPose {
    /// A pose from angles in radians.
    #[must_use]
    pub fn from_angles(position: DVec3, yaw: f64, pitch: f64, roll: f64) -> Self {
        Self { position, rotation: DQuat::from_euler(EulerRot::YXZ, yaw, pitch, roll) }
    }

    /// Yaw, pitch and roll in radians.
    #[must_use]
    pub fn angles(&self) -> (f64, f64, f64) {
        self.rotation.to_euler(EulerRot::YXZ)
    }
}
