//! One wind for trees, clouds, water and boats, changed by the game: calm and a breeze take turns.
//!
//! `cargo run --release --features app --example wind_and_weather`

use bevy::prelude::*;
use bevy_picture_tour::prelude::*;

/// Seconds from one weather to the next.
const TURN: f32 = 12.0;

fn main() -> AppExit {
    App::new()
        .add_plugins((DefaultPlugins, PictureTourPlugin))
        .add_systems(Startup, |mut commands: Commands, assets: Res<AssetServer>| {
            commands.spawn(PictureTour(assets.load("lake/lake.tour.ron")));
            commands.spawn(TourCamera::default());
        })
        .add_systems(Update, change.before(PictureTourSystems::Simulate))
        .run()
}

/// Asks for another wind now and then; it changes gently by itself.
fn change(mut tours: Query<&mut TourWeather>, time: Res<Time>) {
    let breeze = (time.elapsed_secs() / TURN) as u32 % 2 == 1;
    for mut weather in &mut tours {
        let wanted = if breeze { 6.0 } else { 0.0 };
        if weather.wind.speed != wanted {
            weather.wind.speed = wanted;
        }
    }
}
