//! Step into a picture: one still picture with water in it becomes a scene one can fly through.
//!
//! In a game: [`prelude`], [`plugin`]. Without a window: `headless`. The method itself, without Bevy, in the
//! order of its data: [`tour`] (the document) → [`solve`] (the camera), [`suggest`] (what the machine proposes) → [`depth`] (distances from the mirror image) →
//! [`scene`] (planes in meters) → [`maps`] (what is on them), all run by [`assemble`], kept by [`bake`]; beside it [`wind`]
//! and [`water`], joined by [`motion`] (what moves in a scene) → [`trace`] (the reference image).
//! [`picture`] and [`camera`] stand below them all.
//!
//! Pictures: pixels, (0, 0) the outer corner of the top-left one, y down. World: meters, x right, y up, −z into the
//! picture, resting water at y = 0; the picture was taken from (0, h, 0). Rotations are world-from-view,
//! Ry(yaw)·Rx(pitch)·Rz(roll), in radians; degrees stand in files and on screens only.

mod random;

pub mod picture;

pub mod camera;

pub mod tour;

pub mod solve;

pub mod suggest;

pub mod depth;

pub mod scene;

pub mod maps;

pub mod wind;

pub mod water;

pub mod motion;

pub mod assemble;

pub mod bake;

pub mod trace;

#[cfg(feature = "plugin")]
pub mod plugin;

#[cfg(all(feature = "plugin", not(target_arch = "wasm32")))]
pub mod headless;

#[cfg(all(feature = "editor", not(target_arch = "wasm32")))]
pub mod editor;

/// What most games need.
#[cfg(feature = "plugin")]
pub mod prelude {
    pub use crate::camera::Fit;
    pub use crate::plugin::{
        ColorPolicy, Guide, ObjectMotion, PictureTour, PictureTourPlugin, PictureTourSystems, SolvedTour,
        TouchWater, TourAsset, TourCamera, TourCameraState, TourFailed, TourMotion, TourReady, TourWeather,
    };
}
