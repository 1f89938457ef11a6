//! From the TOUR on the command line to what the library makes of it.

use std::fs::File;
use std::path::Path;
use std::time::Duration;

use bevy_picture_tour::assemble::AssembleError;
use bevy_picture_tour::assemble::AssembledTour;
use bevy_picture_tour::assemble::TourSource;
use bevy_picture_tour::assemble::assemble;
use bevy_picture_tour::tour::Problem;
use bevy_picture_tour::tour::Problems;
use indicatif::ProgressBar;
use indicatif::ProgressStyle;

use crate::demo;
use crate::failure::Failure;

/// A tour and its files.
#[derive(Debug)]
pub(crate) struct Opened {
    /// What messages call it.
    pub(crate) name: String,
    /// The tour with its picture and masks.
    pub(crate) source: TourSource,
}

/// Reads a tour and its files; the demo when there is no path.
///
/// # Errors
///
/// [`Failure::CannotRun`] when the tour file itself cannot be opened, [`Failure::Problems`] when something is wrong
/// with what it says.
pub(crate) fn open(tour: Option<&Path>) -> Result<Opened, Failure> {
    let Some(path) = tour else {
        let source = demo::source().map_err(Failure::Problems)?;
        return Ok(Opened { name: demo::NAME.to_owned(), source });
    };
    let name = path.display().to_string();
    let readable = File::open(path).and_then(|file| file.metadata());
    match readable {
        Err(error) => {
            return Err(Failure::CannotRun(format!(
                "{name} cannot be opened ({error}); check the path, or write a tour with `picture-tour new PICTURE`"
            )));
        }
        Ok(metadata) if metadata.is_dir() => {
            return Err(Failure::CannotRun(format!("{name} is a folder; name the .tour.ron file in it")));
        }
        Ok(_) => {}
    }
    let source = TourSource::open(path).map_err(Failure::Problems)?;
    Ok(Opened { name, source })
}

impl Opened {
    /// Solves the picture and builds the maps; `stop` is asked between the steps.
    ///
    /// # Errors
    ///
    /// [`Failure::Problems`] when the marks do not fix a camera, [`Failure::CannotRun`] when stopped.
    pub(crate) fn assemble(&self, stop: &dyn Fn() -> bool) -> Result<AssembledTour, Failure> {
        let bar = ProgressBar::new(100).with_style(style("{msg:>26} [{bar:30}]"));
        bar.enable_steady_tick(Duration::from_millis(100));
        let progress = |share: f32, step: &str| {
            bar.set_position((100.0 * share) as u64);
            bar.set_message(step.to_owned());
            !stop()
        };
        let assembled = assemble(&self.source, &progress);
        bar.finish_and_clear();
        assembled.map_err(|error| match error {
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

/// A progress bar's look; indicatif's own where the template does not read.
pub(crate) fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .progress_chars("=> ")
}
