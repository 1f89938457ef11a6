//! Keys of the program, beyond those that a visitor's camera reads itself.

use bevy::camera_controller::free_camera::{FreeCamera, FreeCameraState};
use bevy::prelude::*;
use bevy_egui::input::EguiWantsInput;
use bevy_picture_tour::plugin::{Guide, SolvedTour, TourCamera, TourCameraState, TourMotion};

use super::overlay::Overlay;

/// `H` help, `V` weather, `Space` pause, `P` path, `F` free flight, `Esc` quit; an interface under the pointer has it to itself.
pub(super) fn read_keys(
    keys: Res<ButtonInput<KeyCode>>,
    wants: Res<EguiWantsInput>,
    touches: Res<Touches>,
    mut overlay: ResMut<Overlay>,
    mut cameras: Query<(
        Entity,
        &mut TourCamera,
        &mut TourCameraState,
        &mut Transform,
        Option<&mut FreeCameraState>,
    )>,
    tours: Query<&SolvedTour>,
    mut motions: Query<&mut TourMotion>,
    mut commands: Commands,
    mut exit: MessageWriter<AppExit>,
) {
    if keys.just_pressed(KeyCode::Escape) {
        exit.write(AppExit::Success);
    }
    if keys.just_pressed(KeyCode::KeyH) || keys.just_pressed(KeyCode::F1) {
        overlay.help = !overlay.help;
    }
    if keys.just_pressed(KeyCode::KeyV) {
        overlay.weather = !overlay.weather;
    }
    if keys.just_pressed(KeyCode::Space) {
        for mut motion in &mut motions {
            motion.paused = !motion.paused;
            overlay.say(if motion.paused { "Paused. Space goes on." } else { "" });
        }
    }
    for (entity, mut camera, mut state, mut transform, free) in &mut cameras {
        let listens = !wants.wants_any_pointer_input();
        if camera.listens != listens {
            camera.listens = listens;
        }
        if let Some(mut free) = free {
            // It turns with every touch, which belongs to the water.
            free.enabled = listens && touches.iter().next().is_none();
        }
        let wanted = match camera.guide {
            _ if keys.just_pressed(KeyCode::Home) => Guide::Visitor,
            Guide::Path if keys.just_pressed(KeyCode::KeyP) => Guide::Visitor,
            _ if keys.just_pressed(KeyCode::KeyP) => Guide::Path,
            Guide::Free if keys.just_pressed(KeyCode::KeyF) => Guide::Visitor,
            _ if keys.just_pressed(KeyCode::KeyF) => Guide::Free,
            same => same,
        };
        if wanted == camera.guide {
            continue;
        }
        camera.guide = wanted;
        state.path_seconds = 0.0;
        if wanted == Guide::Free {
            // `FreeCamera` knows no roll (the projection keeps it) and caches its own angles.
            let (yaw, pitch, _) = transform.rotation.to_euler(EulerRot::YXZ);
            transform.rotation = Quat::from_euler(EulerRot::YXZ, yaw, pitch, 0.0);
            let mut cached = FreeCameraState::default();
            (cached.yaw, cached.pitch) = (yaw, pitch);
            let scale = tours.iter().next().map_or(10.0, |tour| tour.scene.bounds.high.x as f32);
            commands.entity(entity).insert((
                FreeCamera { walk_speed: 0.4 * scale, run_speed: 1.6 * scale, ..default() },
                cached,
            ));
        } else {
            commands.entity(entity).remove::<(FreeCamera, FreeCameraState)>();
        }
        overlay.say(match wanted {
            Guide::Path => "On the tour's path. P leaves it.",
            Guide::Free => "Free flight: right mouse button looks, W A S D Q E fly. F leaves it.",
            Guide::Visitor | Guide::Still => "Drag to look, wheel to step in. Home glides back.",
        });
    }
}
