//! From the TOUR on the command line to what the library makes of it.

use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use bevy_picture_tour::assemble::AssembleError;
use bevy_picture_tour::assemble::AssembledTour;
use bevy_picture_tour::assemble::TourOnDisk;
use bevy_picture_tour::assemble::assemble;
use bevy_picture_tour::bake;
use bevy_picture_tour::bake::Baked;
use bevy_picture_tour::bake::NotFresh;
use bevy_picture_tour::maps::MapOptions;
use bevy_picture_tour::plugin::TourAsset;
use bevy_picture_tour::tour::Problem;
use bevy_picture_tour::tour::Problems;
use glam::UVec2;
use indicatif::ProgressBar;
use indicatif::ProgressStyle;

use crate::demo;
use crate::failure::Failure;

/// A tour to be shown.
#[derive(Debug)]
pub(crate) struct Opened {
    /// What messages call it.
    pub(crate) name: String,
    /// The tour with its picture and masks, or baked.
    pub(crate) asset: TourAsset,
}

/// Opens a tour: a baked one; baked, if a fresh baked file lies beside it; else with its files; the demo when there is no
/// path. A stale or broken baked file is told on stderr.
///
/// # Errors
///
/// [`Failure::CannotRun`] when the tour file itself cannot be opened, [`Failure::Problems`] when something is wrong
/// with what it says.
pub(crate) fn open(tour: Option<&Path>) -> Result<Opened, Failure> {
    let Some(path) = tour else {
        let source = demo::source().map_err(Failure::Problems)?;
        return Ok(Opened { name: demo::NAME.to_owned(), asset: Arc::new(source).into() });
    };
    let name = path.display().to_string();
    if path.extension().is_some_and(|extension| extension == "baked") {
        let cannot = |reason: String| Failure::CannotRun(format!("{name} cannot be opened: {reason}"));
        let bytes = std::fs::read(path).map_err(|error| cannot(format!("{error}; check the path")))?;
        let asset = bake::decode(&bytes).map_err(|error| cannot(error.to_string()))?.into();
        return Ok(Opened { name, asset });
    }
    let disk = on_disk(path)?;
    let asset = match fresh_bake(path, &disk) {
        Ok(baked) => baked.into(),
        Err(reason) => {
            if let Some(reason) = reason {
                // When stderr is closed nobody listens; the tour is built all the same.
                let _ = writeln!(std::io::stderr().lock(), "picture-tour: {reason}");
            }
            Arc::new(disk.source().map_err(Failure::Problems)?).into()
        }
    };
    Ok(Opened { name, asset })
}

/// Reads a tour's document.
///
/// # Errors
///
/// As [`open`].
pub(crate) fn on_disk(path: &Path) -> Result<TourOnDisk, Failure> {
    let name = path.display();
    let readable = File::open(path).and_then(|file| file.metadata());
    match readable {
        Err(error) => Err(Failure::CannotRun(format!(
            "{name} cannot be opened ({error}); check the path, or write a tour with `picture-tour new PICTURE`"
        ))),
        Ok(metadata) if metadata.is_dir() => {
            Err(Failure::CannotRun(format!("{name} is a folder; name the .tour.ron file in it")))
        }
        Ok(_) => TourOnDisk::open(path).map_err(Failure::Problems),
    }
}

/// The baked tour beside a tour's file; or why there is none to use, unless it was never made.
pub(crate) fn fresh_bake(path: &Path, disk: &TourOnDisk) -> Result<Baked, Option<String>> {
    let baked = bake::baked_path(path);
    let Ok(bytes) = std::fs::read(&baked) else { return Err(None) };
    let fresh = bake::fresh(&bytes, &disk.tour, &MapOptions::default(), &|file| disk.read(file));
    let fresh = fresh.map_err(|reason| match reason {
        // Told when the tour is built.
        NotFresh::Unread(_) => None,
        reason => Some(format!("{} is not used: {reason}", baked.display())),
    })?;
    // Likewise.
    Ok(fresh.with_recordings(disk.recordings().map_err(|_| None)?))
}

impl Opened {
    /// The size of the picture that is used, pixels.
    pub(crate) fn picture_size(&self) -> UVec2 {
        match &self.asset {
            TourAsset::Source(source, _) => source.picture.size(),
            TourAsset::Built(_, built) => built.scene.camera.intrinsics.size,
        }
    }

    /// What was baked; or else solves the picture and builds the maps, and asks `stop` between the steps.
    ///
    /// # Errors
    ///
    /// [`Failure::Problems`] when the marks do not fix a camera, [`Failure::CannotRun`] when stopped.
    pub(crate) fn assemble(&self, stop: &dyn Fn() -> bool) -> Result<Arc<AssembledTour>, Failure> {
        let (source, options) = match &self.asset {
            TourAsset::Built(_, built) => return Ok(Arc::clone(built)),
            TourAsset::Source(source, options) => (source, options),
        };
        let bar = bar("");
        let progress = |share: f32, step: &str| {
            bar.set_position((100.0 * share) as u64);
            bar.set_message(step.to_owned());
            !stop()
        };
        let assembled = assemble(source, options, &progress);
        bar.finish_and_clear();
        assembled.map(Arc::new).map_err(|error| match error {
            AssembleError::Cancelled => Failure::CannotRun("stopped before the scene was built".to_owned()),
            error => self.unsolved(&error.to_string()),
        })
    }

    /// The failure of a tour whose marks do not fix a camera, for the reason that the solver gives.
    pub(crate) fn unsolved(&self, reason: &str) -> Failure {
        // The solver's sentences end with what to do.
        let (message, advice) = reason.rsplit_once("; ").unwrap_or((reason, ""));
        let problem = Problem::new("", "", message, advice);
        Failure::Problems(Problems::from(problem).with_file(&self.name))
    }
}

/// A progress bar of 100 steps on stderr, where somebody looks at it.
pub(crate) fn bar(message: &'static str) -> ProgressBar {
    let bar = ProgressBar::new(100).with_style(style("{msg:>46} [{bar:30}] {elapsed}")).with_message(message);
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}

/// A progress bar's look; indicatif's own where the template does not read.
pub(crate) fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .progress_chars("=> ")
}
