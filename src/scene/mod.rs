//! The scene in meters: the framework (water, ground, background) and the billboards that stand in it.
//!
//! World: x right, y up, −z into the picture; resting water at y = 0; the picture was taken from (0, h, 0). The water
//! is the plane y = 0 itself and no component; everything else is one. Component 0 is always the last layer, the
//! farthest of what closes the scene: a ray that misses everything sees it at infinity.

mod arrangement;
mod backdrop;
mod bounds;
mod build;
mod order;
mod surface;

pub use arrangement::{Arrangement, Meeting, Placement, RestPoint};
pub use backdrop::{BackdropPlace, BackdropPlan};
pub use bounds::{BEYOND_BORDER, CameraBounds};
pub use build::{BillboardPlan, MAX_COMPONENTS, ScenePlan, build, margin_px};
pub use order::near_to_far;
pub use surface::{Level, Surface, Wall, mirror};

use crate::camera::PinholeCamera;

/// What a component is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The farthest backdrop: opaque wherever it stands above the water.
    LastLayer,
    /// A nearer backdrop, as a far shore before mountains: it goes on behind what hides it and beyond the border.
    Band,
    /// The land one could walk on, a level plane.
    Ground,
    /// Something that stands upright in the water or on the ground.
    Billboard,
}

/// One plane of the scene with everything the picture shows on it.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneComponent {
    /// The name in the tour file, "background", "sky" or "ground".
    pub name: String,
    /// What it is for.
    pub role: Role,
    /// Where it rests.
    pub surface: Surface,
    /// Whether it turns towards a camera that moves around it.
    pub turns_to_camera: bool,
}

/// Everything that is geometry: the picture's own camera and the planes it looks at.
#[derive(Clone, Debug, PartialEq)]
pub struct TourScene {
    /// The camera that took the picture, at (0, h, 0); its size is the picture's.
    pub camera: PinholeCamera,
    /// Whether there is water at y = 0.
    pub water: bool,
    /// The last layer first, the ground (if any) second, then the bands far to near, then the billboards in the tour's
    /// order.
    pub components: Vec<SceneComponent>,
    /// Where a camera may go.
    pub bounds: CameraBounds,
}

impl TourScene {
    /// The last layer.
    #[must_use]
    pub fn last_layer(&self) -> &SceneComponent {
        &self.components[0]
    }

    /// The ground's index, if there is any.
    #[must_use]
    pub fn ground(&self) -> Option<usize> {
        self.components.iter().position(|component| component.role == Role::Ground)
    }

    /// All components in the order of drawing, near to far as seen from `position` (meters; only x and z matter).
    #[must_use]
    pub fn near_to_far(&self, position: glam::DVec3) -> Vec<usize> {
        self.arranged_for(position, &[]).near_to_far
    }

    /// The billboards and bands of an order of drawing.
    pub fn walls_of(&self, order: &[usize]) -> impl Iterator<Item = usize> {
        order
            .iter()
            .copied()
            .filter(|&index| matches!(self.components[index].role, Role::Billboard | Role::Band))
    }
}
