//! The water's surface as the tracer asks for it.

use glam::{DVec2, DVec3};

/// The water's surface at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaterPoint {
    /// Meters above the resting water.
    pub height: f64,
    /// Unit normal, y up.
    pub normal: DVec3,
}

/// Height and normal of the water anywhere, at one moment.
pub trait WaterSurface: Sync {
    /// The surface at a point (x, z) of the world, meters.
    fn at(&self, ground: DVec2) -> WaterPoint;
}

/// Water at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StillWater;

impl WaterSurface for StillWater {
    fn at(&self, _ground: DVec2) -> WaterPoint {
        WaterPoint { height: 0.0, normal: DVec3::Y }
    }
}
