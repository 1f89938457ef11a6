//! The tour in the window: shown, dropped in, read again when its file changes. A broken one leaves the last good one.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use bevy::camera_controller::free_camera::{FreeCamera, FreeCameraState};
use bevy::prelude::*;
use bevy::tasks::futures::check_ready;
use bevy::window::{FileDragAndDrop, PrimaryWindow};
use bevy_picture_tour::plugin::{
    Guide, PictureTour, TourAsset, TourCamera, TourCameraState, TourFailed, TourReady,
};
use bevy_picture_tour::tour::Tour;

use super::overlay::Overlay;
use crate::failure::Failure;
use crate::open;

/// Seconds between two looks at the tour's files.
const LOOK_EVERY: f32 = 0.5;

/// The tour in the window.
#[derive(Resource)]
pub(super) struct Current {
    path: Option<PathBuf>,
    /// Whether it is another tour than the one that is still shown.
    is_another: bool,
    name: String,
    asset: TourAsset,
    handle: Handle<TourAsset>,
    /// When the newest of its files was written, as far as it was read.
    written: Option<SystemTime>,
    seconds: f32,
    reading: Option<blocking::Task<Reread>>,
}

/// A tour file that was read, when it was begun, and what came of it.
struct Reread {
    path: PathBuf,
    began: SystemTime,
    opened: Result<open::Opened, Failure>,
}

impl Current {
    pub(super) fn new(path: Option<PathBuf>, name: String, asset: TourAsset) -> Self {
        let written = path.as_deref().and_then(|path| newest(path, asset.tour()));
        Self {
            path,
            is_another: false,
            name,
            asset,
            handle: Handle::default(),
            written,
            seconds: 0.0,
            reading: None,
        }
    }

    fn read(&mut self, path: PathBuf) {
        self.reading = Some(blocking::unblock(move || {
            let began = SystemTime::now();
            let opened = open::open(Some(&path));
            Reread { path, began, opened }
        }));
    }
}

/// When the newest of a tour's files was written.
fn newest(path: &Path, tour: &Tour) -> Option<SystemTime> {
    let folder = path.parent()?;
    let files = tour.files().into_iter().map(|(_, file)| file.in_folder(folder));
    let written = |file: PathBuf| std::fs::metadata(file).and_then(|metadata| metadata.modified()).ok();
    files.chain([path.to_owned()]).filter_map(written).max()
}

pub(super) fn show_first(
    mut commands: Commands,
    mut current: ResMut<Current>,
    mut tours: ResMut<Assets<TourAsset>>,
    mut overlay: ResMut<Overlay>,
) {
    current.handle = tours.add(current.asset.clone());
    commands.spawn(PictureTour(current.handle.clone()));
    overlay.say("Drag to look, wheel to step in, P for the path, H for all keys.");
}

/// A tour file dropped into the window.
pub(super) fn take_dropped(mut drops: MessageReader<FileDragAndDrop>, mut current: ResMut<Current>) {
    for drop in drops.read() {
        if let FileDragAndDrop::DroppedFile { path_buf, .. } = drop {
            current.read(path_buf.clone());
        }
    }
}

/// Reads the tour again when one of its files was written.
pub(super) fn watch(mut current: ResMut<Current>, time: Res<Time>) {
    let current = &mut *current;
    current.seconds += time.delta_secs();
    if current.seconds < LOOK_EVERY || current.reading.is_some() {
        return;
    }
    current.seconds = 0.0;
    let Some(path) = current.path.clone() else { return };
    let written = newest(&path, current.asset.tour());
    if written.is_some() && written != current.written {
        current.written = written;
        current.read(path);
    }
}

/// Takes over a tour that was read, or tells what is wrong with it.
pub(super) fn take_reread(
    mut current: ResMut<Current>,
    mut tours: ResMut<Assets<TourAsset>>,
    mut overlay: ResMut<Overlay>,
) {
    let Some(Reread { path, began, opened }) = current.reading.as_mut().and_then(check_ready) else { return };
    current.reading = None;
    match opened {
        Ok(opened) => {
            // What was written while it was read is read again.
            current.written = newest(&path, opened.asset.tour()).map(|written| written.min(began));
            if current.path.as_ref() != Some(&path) {
                current.is_another = true;
            }
            current.path = Some(path);
            current.name = opened.name;
            current.asset = opened.asset.clone();
            overlay.problem = None;
            if tours.insert(&current.handle, opened.asset).is_err() {
                overlay.say("The tour could not be replaced; start the program anew with it.");
            }
        }
        // The shown tour's own file: the message stays until it is mended. Another one's: it fades.
        Err(failure) if current.path.as_ref() == Some(&path) => tell(&mut overlay, &failure.to_string()),
        Err(failure) => overlay.say(failure.to_string().trim_end()),
    }
}

/// The window's title for a tour; the demo has no path.
pub(super) fn title(path: Option<&Path>) -> String {
    format!("{} - picture tour", path.map_or("lake (demo)".into(), Path::to_string_lossy))
}

/// A tour is shown: another one is entered from its own place, under its own title.
pub(super) fn ready(
    ready: On<TourReady>,
    mut current: ResMut<Current>,
    mut overlay: ResMut<Overlay>,
    mut windows: Query<&mut Window, With<PrimaryWindow>>,
    mut cameras: Query<(Entity, &mut TourCamera, &mut TourCameraState)>,
    mut commands: Commands,
) {
    overlay.problem = None;
    if std::mem::take(&mut current.is_another) {
        for mut window in &mut windows {
            window.title = title(current.path.as_deref());
        }
        for (entity, mut camera, mut state) in &mut cameras {
            camera.guide = Guide::Visitor;
            // Without a pose it arrives anew.
            state.pose = None;
            commands.entity(entity).remove::<(FreeCamera, FreeCameraState)>();
        }
    }
    if ready.preview {
        overlay
            .say("A preview: what is hidden and beyond the frame is still being painted. H shows the keys.");
    } else if current.path.is_some() {
        overlay.say(format!("{} - H shows the keys.", current.name));
    }
}

pub(super) fn failed(failed: On<TourFailed>, current: Res<Current>, mut overlay: ResMut<Overlay>) {
    tell(&mut overlay, &format!("{}: {}", current.name, failed.error));
}

/// On the screen until it is mended, and on stderr.
fn tell(overlay: &mut Overlay, problem: &str) {
    use std::io::Write as _;
    // A closed stderr is no reason to stop.
    let _ = writeln!(std::io::stderr().lock(), "{}", problem.trim_end());
    overlay.problem = Some(problem.trim_end().to_owned());
}
