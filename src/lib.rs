//! Step into a picture: one still picture with water in it becomes a scene one can fly through.

pub mod picture;

pub mod camera;

pub mod tour;

pub mod solve;

pub mod scene;

pub mod maps;

pub mod assemble;

pub mod trace;

#[cfg(feature = "plugin")]
pub mod plugin;

#[cfg(all(feature = "plugin", not(target_arch = "wasm32")))]
pub mod headless;

/// What most games need.
#[cfg(feature = "plugin")]
pub mod prelude {
    pub use crate::camera::Fit;
    pub use crate::plugin::{
        ColorPolicy, Guide, PictureTour, PictureTourPlugin, PictureTourSystems, SolvedTour, TourAsset,
        TourCamera, TourCameraState, TourFailed, TourReady,
    };
}
