//! `play`: a window to fly in. Without a display or a graphics adapter the path is rendered to files instead.

pub(crate) mod display;
mod flight;
mod overlay;
mod tours;
mod weather;

use std::path::PathBuf;
use std::process::ExitCode;

use bevy::asset::AssetPlugin;
use bevy::camera_controller::free_camera::FreeCameraPlugin;
use bevy::prelude::*;
use bevy::window::WindowPlugin;
use bevy_egui::{EguiPlugin, EguiPrimaryContextPass};
use bevy_picture_tour::plugin::{PictureTourPlugin, PictureTourSystems, TourAsset, TourCamera};

use crate::args::RenderArguments;
use crate::failure::Failure;
use crate::log;
use crate::open;
use crate::render;

/// Folder for the frames that stand in for a window, in the working folder.
const FRAMES: &str = "picture-tour-frames";

/// Opens a window on the tour, or on the demo.
///
/// # Errors
///
/// The tour's problems, before any window opens; or what keeps frames from being written when there is no display.
pub(crate) fn run(tour: Option<PathBuf>) -> Result<ExitCode, Failure> {
    let opened = open::open(tour.as_deref())?;
    // A tour that cannot be solved is told here, not in a black window.
    if let TourAsset::Source(source, _) = &opened.asset {
        let marks = bevy_picture_tour::assemble::annotations(source);
        if let Err(error) = bevy_picture_tour::solve::solve(&marks) {
            return Err(opened.unsolved(&error.to_string()));
        }
    }
    if let Some(missing) = display::missing() {
        return render_instead(tour, opened.asset.tour().path.is_some(), missing);
    }
    let name = opened.name.clone();
    let title = tours::title(tour.as_deref());
    let exit = App::new()
        .add_plugins((
            DefaultPlugins
                .set(WindowPlugin {
                    primary_window: Some(Window { title, resolution: (1280, 720).into(), ..default() }),
                    ..default()
                })
                .set(log::of_the_tour())
                .set(AssetPlugin { watch_for_changes_override: Some(false), ..default() }),
            EguiPlugin::default(),
            FreeCameraPlugin,
            PictureTourPlugin,
        ))
        .insert_resource(ClearColor(Color::BLACK))
        .insert_resource(tours::Current::new(tour, name, opened.asset))
        .init_resource::<overlay::Overlay>()
        .add_systems(
            Startup,
            (tours::show_first, |mut commands: Commands| {
                commands.spawn(TourCamera::default());
            }),
        )
        .add_systems(
            Update,
            (flight::read_keys, tours::take_dropped, tours::watch, tours::take_reread)
                .before(PictureTourSystems::Input),
        )
        .add_systems(EguiPrimaryContextPass, (overlay::show, weather::show))
        .add_observer(tours::ready)
        .add_observer(tours::failed)
        .run();
    Ok(match exit {
        AppExit::Success => ExitCode::SUCCESS,
        AppExit::Error(_) => ExitCode::from(2),
    })
}

/// Renders the path, or the first view of a tour without one, to files, and says why.
fn render_instead(tour: Option<PathBuf>, has_path: bool, missing: &str) -> Result<ExitCode, Failure> {
    use std::io::Write as _;
    let folder = PathBuf::from(FRAMES);
    // When stderr is closed nobody listens; the frames are written all the same.
    let _ = writeln!(
        std::io::stderr().lock(),
        "picture-tour: {missing}, so no window opens; the tour is rendered to {FRAMES}/ instead"
    );
    render::run(&RenderArguments::small_film(tour, folder, has_path))
}
