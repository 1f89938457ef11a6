//! A game's own things in a tour's space: a buoy in the lake, lit by the game's light, hidden by the boat in front of it
//! and hiding the shore behind it.
//!
//! `cargo run --release --features app --example mixed_scene`

use bevy::prelude::*;
use bevy_picture_tour::prelude::*;

/// Bobs up and down.
#[derive(Component)]
struct Buoy;

fn main() -> AppExit {
    App::new()
        .add_plugins((DefaultPlugins, PictureTourPlugin))
        .add_systems(Startup, set_up)
        .add_systems(Update, bob.in_set(PictureTourSystems::Move))
        .run()
}

fn set_up(
    mut commands: Commands,
    assets: Res<AssetServer>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    // A tour stands anywhere in the game's world; what is spawned below it is in the tour's meters.
    let place = Transform::from_xyz(40.0, 3.0, -20.0).with_rotation(Quat::from_rotation_y(0.6));
    let tour = commands.spawn((PictureTour(assets.load("lake/lake.tour.ron")), place)).id();
    commands.spawn((TourCamera::default(), Msaa::Sample4));
    commands.spawn((
        DirectionalLight { illuminance: 6_000.0, ..default() },
        Transform::from_xyz(3.0, 6.0, 4.0).looking_at(Vec3::ZERO, Vec3::Y),
    ));
    let red = materials.add(StandardMaterial { base_color: Color::srgb(0.9, 0.2, 0.1), ..default() });
    // At 9 m before the boat (11.3 m), at 14 m behind it.
    for (x, z) in [(-1.6, -9.0), (0.9, -14.0), (5.0, -25.0)] {
        commands.spawn((
            Buoy,
            Mesh3d(meshes.add(Sphere::new(0.35))),
            MeshMaterial3d(red.clone()),
            Transform::from_xyz(x, 0.1, z),
            ChildOf(tour),
        ));
    }
}

fn bob(time: Res<Time>, mut buoys: Query<&mut Transform, With<Buoy>>) {
    for mut transform in &mut buoys {
        transform.translation.y = 0.1 + 0.06 * (1.6 * time.elapsed_secs() + transform.translation.x).sin();
    }
}
