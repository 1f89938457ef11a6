//! Code that stirs the water: rain on the lake, a drop every few frames. The pointer does it too.
//!
//! `cargo run --release --features app --example stir_water`

use bevy::prelude::*;
use bevy_picture_tour::prelude::*;

fn main() -> AppExit {
    App::new()
        .add_plugins((DefaultPlugins, PictureTourPlugin))
        .add_systems(Startup, |mut commands: Commands, assets: Res<AssetServer>| {
            commands.spawn(PictureTour(assets.load("lake/lake.tour.ron")));
            commands.spawn(TourCamera::default());
        })
        .add_systems(Update, rain.before(PictureTourSystems::Simulate))
        .run()
}

/// A drop every fourth frame, somewhere on the near water.
fn rain(tours: Query<Entity, With<TourMotion>>, mut drops: MessageWriter<TouchWater>, mut frame: Local<u32>) {
    *frame += 1;
    for tour in tours.iter().filter(|_| frame.is_multiple_of(4)) {
        let number = *frame as f32;
        let at = Vec2::new(12.0 * (0.618 * number).fract() - 6.0, -6.0 - 16.0 * (0.414 * number).fract());
        drops.write(TouchWater { tour, at, radius: 0.25, impulse: -0.4 });
    }
}
