//! `edit`: the studio in a window.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use bevy::asset::AssetPlugin;
use bevy::prelude::*;
use bevy::window::{ExitCondition, PresentMode, WindowCloseRequested, WindowPlugin};
use bevy::winit::{UpdateMode, WinitSettings};
use bevy_egui::{EguiPlugin, PrimaryEguiContext};
use bevy_picture_tour::editor::{EditorPlugin, Pace, Session};
use bevy_picture_tour::plugin::PictureTourPlugin;

use crate::failure::Failure;
use crate::log;
use crate::play::display;

/// Opens the studio on a picture or tour, or on its start page.
///
/// # Errors
///
/// Without a display or a graphics adapter.
pub(crate) fn run(file: Option<PathBuf>) -> Result<ExitCode, Failure> {
    if let Some(missing) = display::missing() {
        return Err(Failure::CannotRun(format!(
            "{missing}, and the studio needs one; `picture-tour new PICTURE --auto` drafts a tour without"
        )));
    }
    let folders = directories::ProjectDirs::from("", "", "picture-tour");
    let folder = folders.map_or_else(std::env::temp_dir, |folders| folders.data_dir().to_owned());
    let mut session = Session::new(&folder);
    if let Some(file) = file {
        // The window opens all the same and says what is wrong.
        session.open_when_ready(file);
    }
    let window = Window {
        title: "Picture tour".to_owned(),
        resolution: (1440, 860).into(),
        present_mode: PresentMode::AutoVsync,
        ..default()
    };
    let exit = App::new()
        .add_plugins((
            DefaultPlugins
                .set(WindowPlugin {
                    primary_window: Some(window),
                    exit_condition: ExitCondition::DontExit,
                    close_when_requested: false,
                    ..default()
                })
                .set(log::of_the_tour())
                .set(AssetPlugin { watch_for_changes_override: Some(false), ..default() }),
            EguiPlugin::default(),
            PictureTourPlugin,
            EditorPlugin,
        ))
        .insert_resource(ClearColor(Color::srgb_u8(20, 22, 26)))
        .insert_resource(session)
        .add_systems(Startup, |mut commands: Commands| {
            commands.spawn((Camera2d, PrimaryEguiContext));
        })
        .add_systems(Update, (leave, keep_pace))
        .run();
    Ok(match exit {
        AppExit::Success => ExitCode::SUCCESS,
        AppExit::Error(_) => ExitCode::from(2),
    })
}

/// Draws no more often than something changes; whatever the user does is drawn at once.
fn keep_pace(session: Res<Session>, mut settings: ResMut<WinitSettings>) {
    let mode = match session.pace() {
        Pace::Smooth => UpdateMode::Continuous,
        Pace::Watching => UpdateMode::reactive(Duration::from_millis(50)),
        Pace::Resting => UpdateMode::reactive(Duration::from_secs(4)),
    };
    if settings.focused_mode != mode {
        *settings = WinitSettings { focused_mode: mode, unfocused_mode: mode };
    }
}

/// Asks about unsaved work when the window is to close, and ends when the studio is left.
fn leave(
    mut session: ResMut<Session>,
    mut wishes: MessageReader<WindowCloseRequested>,
    mut exit: MessageWriter<AppExit>,
) {
    if wishes.read().count() > 0 {
        session.close();
    }
    if session.is_over() {
        exit.write(AppExit::Success);
    }
}
