//! `render`: views, a path or a loop, as PNG frames or as a film.

use std::io::Write;
use std::path::Path;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering;

use bevy_picture_tour::camera::Fit;
use bevy_picture_tour::camera::PinholeCamera;
use bevy_picture_tour::camera::fitted;
use bevy_picture_tour::picture::PngPixels;
use bevy_picture_tour::picture::save_png;
use glam::UVec2;
use indicatif::ProgressBar;

use crate::args::MAX_SIDE;
use crate::args::RenderArguments;
use crate::beside;
use crate::failure::Failure;
use crate::film::{self, Film};
use crate::frames::{self, Frame};
use crate::open;
use crate::renderer::Renderer;

/// Whether Ctrl-C was pressed.
static STOP: AtomicBool = AtomicBool::new(false);

/// Renders what the arguments ask for.
pub(crate) fn run(arguments: &RenderArguments) -> Result<ExitCode, Failure> {
    watch_for_ctrl_c()?;
    let opened = open::open(arguments.tour.as_deref())?;
    let mut frames = frames::planned(arguments, opened.asset.tour())?;
    let own = |outs: Vec<PathBuf>| beside::refuse_own(arguments.tour.as_deref(), opened.asset.tour(), outs);
    own(vec![arguments.out.clone()])?;
    let folder = folder_of(&arguments.out, &mut frames)?;
    let is_film = film::is_film(&arguments.out);
    if is_film && !arguments.path && arguments.loop_seconds.is_none() {
        return Err(Failure::CannotRun(
            "a film needs something that goes on; add --path or --loop SECONDS, or name a folder with --out"
                .to_owned(),
        ));
    }
    if !is_film {
        prepare_folder(&folder)?;
        // Now that the folder is there its files can be told from others.
        own(frames.iter().map(|frame| folder.join(&frame.file)).collect())?;
    }
    let size = arguments.size.unwrap_or(opened.picture_size()).min(UVec2::splat(MAX_SIDE));
    let stop = || STOP.load(Ordering::Relaxed);
    // Before the work, in case that it cannot be made.
    let mut film = is_film.then(|| Film::start(&arguments.out, size, arguments.fps)).transpose()?;
    let mut renderer = Renderer::new(opened, size, arguments.samples, arguments.reference, &stop)?;
    if let Some(seconds) = arguments.loop_seconds {
        renderer.repeat_after(frames::loop_length(seconds, arguments.fps))?;
    }
    let taken_by = renderer.taken_by();
    let intrinsics = fitted(&taken_by.intrinsics, size, Fit::Cover).intrinsics;

    let bar = ProgressBar::new(frames.len() as u64)
        .with_style(open::style("{msg:>26} [{bar:30}] {pos}/{len}, {eta} left"));
    for (done, frame) in frames.iter().enumerate() {
        if stop() {
            bar.finish_and_clear();
            return Err(Failure::CannotRun(format!(
                "stopped; {done} of {} frames are done{}",
                frames.len(),
                if is_film { String::new() } else { format!(", whole, in {}", folder.display()) }
            )));
        }
        bar.set_message(frame.file.clone());
        let camera = PinholeCamera { intrinsics, pose: frame.pose.unwrap_or(taken_by.pose) };
        let picture = renderer.render(&camera, frame.seconds)?;
        if let Some(film) = &mut film {
            film.add(&picture)?;
        } else {
            save_png(&folder.join(&frame.file), picture.size(), PngPixels::Rgb(picture.pixels()))
                .map_err(|error| Failure::CannotRun(error.to_string()))?;
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    film.map_or(Ok(()), Film::finish)?;
    let frames = match frames.as_slice() {
        [only] => only.file.clone(),
        frames => format!("{} frames", frames.len()),
    };
    writeln!(
        std::io::stdout().lock(),
        "{frames} of {} x {} px in {}",
        size.x,
        size.y,
        if is_film { arguments.out.display() } else { folder.display() }
    )?;
    Ok(ExitCode::SUCCESS)
}

/// The folder that frames are written to; one frame alone may be named as a file.
fn folder_of(out: &Path, frames: &mut [Frame]) -> Result<PathBuf, Failure> {
    let is_png = out.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
    let Some(name) = out.file_name().filter(|_| is_png && !out.is_dir()) else { return Ok(out.to_owned()) };
    match frames {
        [only] => only.file = name.to_string_lossy().into_owned(),
        frames => {
            return Err(Failure::CannotRun(format!(
                "{} frames do not fit into {}; name a folder with --out, or FILE.mp4 or FILE.webm for a film",
                frames.len(),
                out.display()
            )));
        }
    }
    Ok(beside::folder(out).to_owned())
}

/// Lets the first Ctrl-C end the work after the frame at hand, and a second one at once.
fn watch_for_ctrl_c() -> Result<(), Failure> {
    let pressed = || {
        if STOP.swap(true, Ordering::Relaxed) {
            std::process::exit(2);
        }
    };
    ctrlc::set_handler(pressed)
        .map_err(|error| Failure::CannotRun(format!("Ctrl-C cannot be watched for ({error}); start again")))
}

/// Makes the folder for the frames, and finds out early whether it can be written to.
fn prepare_folder(folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).and_then(|()| tempfile::tempfile_in(folder)).map(drop).map_err(|error| {
        Failure::CannotRun(format!(
            "frames cannot be written to {} ({error}); name a folder that may be written to with --out",
            folder.display()
        ))
    })
}
