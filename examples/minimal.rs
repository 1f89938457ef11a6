//! A window, a tour, a camera: the least a game needs.
//!
//! `cargo run --release --features app --example minimal`

use bevy::prelude::*;
use bevy_picture_tour::prelude::*;

fn main() -> AppExit {
    App::new()
        .add_plugins((DefaultPlugins, PictureTourPlugin))
        .add_systems(Startup, |mut commands: Commands, assets: Res<AssetServer>| {
            commands.spawn(PictureTour(assets.load("lake/lake.tour.ron")));
            commands.spawn(TourCamera::default());
        })
        .add_observer(|failed: On<TourFailed>| error!("{}", failed.error))
        .run()
}
