//! The Bevy plugin: tours as assets and entities, their materials, cameras and per-frame systems.
//!
//! Everything a frame does happens in the steps of [`PictureTourSystems`]; games put their own systems between them.

mod asset;
mod atlas;
pub(crate) mod background;
mod camera;
mod load;
mod material;
mod motion;
#[cfg(feature = "editor")]
mod rearrange;
mod records;
mod sort;
mod spawn;
mod stir;
mod views;

pub use asset::{BakedTourLoadError, TourAsset, TourLoadError};
pub use camera::{Guide, TourCamera, TourCameraState, TourPath, TourProjection};
pub use load::{PictureTour, TourBuilding, TourFailed, TourReady};
pub use material::ColorPolicy;
pub use motion::{ObjectMotion, TouchWater, TourMotion, TourWeather};
#[cfg(feature = "editor")]
pub(crate) use rearrange::Rearranging;
pub use spawn::{SolvedTour, TourPart};
pub use stir::TourPointer;

use bevy::asset::AssetEventSystems;
use bevy::prelude::*;
use bevy::transform::TransformSystems;

/// Adds tours to a game. Needs Bevy's default plugins (or assets, rendering and PBR materials).
#[derive(Clone, Copy, Debug, Default)]
pub struct PictureTourPlugin;

/// The steps of a frame, in this order, in `Update`.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PictureTourSystems {
    /// Takes over finished tours; reads keys, pointer, touch and gamepad into what each camera wishes. Set
    /// [`TourCamera::listens`] before it.
    Input,
    /// Steps water, wind and bodies. Write [`TouchWater`], change a tour's [`TourWeather`] and its parts' [`ObjectMotion`]
    /// before it; ask [`TourMotion`] for the water after it.
    Simulate,
    /// Moves cameras. Change a [`TourCameraState`]'s pose after it to have the last word.
    Move,
    /// Writes transforms from poses; materials follow after Bevy has propagated transforms.
    Upload,
}

impl Plugin for PictureTourPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins((material::plugin, sort::plugin, load::plugin)).add_message::<TouchWater>();
        app.init_resource::<stir::Stirring>();
        app.configure_sets(
            Update,
            (
                PictureTourSystems::Input,
                PictureTourSystems::Simulate,
                PictureTourSystems::Move,
                PictureTourSystems::Upload,
            )
                .chain(),
        );
        app.add_systems(
            Update,
            (
                (stir::stir, camera::read_devices).chain().in_set(PictureTourSystems::Input),
                (motion::change_weather, motion::change_objects, motion::advance)
                    .chain()
                    .in_set(PictureTourSystems::Simulate),
                camera::move_cameras.in_set(PictureTourSystems::Move),
                camera::place_cameras.in_set(PictureTourSystems::Upload),
            ),
        );
        // Before the frame's asset events: the records it writes are for this frame.
        app.add_systems(
            PostUpdate,
            views::look_at_tours.after(TransformSystems::Propagate).before(AssetEventSystems),
        );
    }
}
