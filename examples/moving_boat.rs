//! A game that sails a boat of the picture: the arrow keys (or W A S D) steer it, `Space` sends it on a course of its own.
//!
//! `cargo run --release --features app --example moving_boat`

use bevy::math::DVec3;
use bevy::prelude::*;
use bevy_picture_tour::prelude::*;
use bevy_picture_tour::tour::{Course, Motion, Waypoint};
use bevy_picture_tour::water::body::BodyPose;

/// Meters per second, and degrees per second.
const SPEED: f64 = 1.5;
const TURN: f64 = 40.0;

fn main() -> AppExit {
    App::new()
        .add_plugins((DefaultPlugins, PictureTourPlugin))
        .add_systems(Startup, |mut commands: Commands, assets: Res<AssetServer>| {
            commands.spawn(PictureTour(assets.load("lake/lake.tour.ron")));
            // The keys are the boat's.
            commands.spawn(TourCamera { listens: false, ..default() });
        })
        .add_systems(Update, sail.before(PictureTourSystems::Simulate))
        .run()
}

/// Moves the rowing boat, whose bow is on the left where it rests, and lets the water rise to it and its wake run.
fn sail(
    mut boats: Query<(&Name, &mut ObjectMotion, &ChildOf)>,
    tours: Query<&TourMotion>,
    mut touches: MessageWriter<TouchWater>,
    keys: Res<ButtonInput<KeyCode>>,
    time: Res<Time>,
    mut pose: Local<BodyPose>,
) {
    let Some((_, mut boat, root)) = boats.iter_mut().find(|(name, ..)| name.as_str() == "rowing boat") else {
        return;
    };
    if keys.just_pressed(KeyCode::Space) {
        let waypoints = [(0.9, -11.3), (-3.0, -12.5), (-2.0, -16.0), (3.0, -14.0)];
        *boat = ObjectMotion::Own(Motion::Course(Course {
            waypoints: waypoints.map(|(x, z)| Waypoint((x, z).into())).into(),
            speed: 1.0,
            draft: 0.15,
            length: Some(3.2),
            closed: true,
        }));
        return;
    }
    let held = |names: [KeyCode; 2]| f64::from(u8::from(keys.any_pressed(names)));
    let ahead = held([KeyCode::ArrowUp, KeyCode::KeyW]) - held([KeyCode::ArrowDown, KeyCode::KeyS]);
    let left = held([KeyCode::ArrowLeft, KeyCode::KeyA]) - held([KeyCode::ArrowRight, KeyCode::KeyD]);
    if ahead == 0.0 && left == 0.0 && !matches!(*boat, ObjectMotion::Led(_)) {
        return;
    }
    let seconds = time.delta_secs_f64();
    pose.yaw += (left * TURN * seconds).to_radians();
    let bow = DVec3::new(-pose.yaw.cos(), 0.0, pose.yaw.sin());
    pose.position += ahead * SPEED * seconds * bow;
    if let Ok(motion) = tours.get(root.parent()) {
        let at = bevy::math::DVec2::new(0.9 + pose.position.x, -11.3 + pose.position.z);
        pose.position.y = motion.water_at(at).height;
        if ahead != 0.0 {
            touches.write(TouchWater { tour: root.parent(), at: at.as_vec2(), radius: 0.5, impulse: -0.1 });
        }
    }
    *boat = ObjectMotion::Led(pose.faced());
}
