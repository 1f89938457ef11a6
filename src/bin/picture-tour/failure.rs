//! What keeps the program from doing what it was asked, and the exit status it then has.

use std::fmt;
use std::io;
use std::process::ExitCode;

use bevy_picture_tour::tour::Problems;

/// Why the program ends early. Written, it is whole lines for stderr.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The tour has problems, which were not told yet.
    Problems(Problems),
    /// What was asked for cannot be done: a sentence that says what to do instead.
    CannotRun(String),
    /// Whoever read the output has heard enough (`… | head -1`), which is no fault.
    Closed,
}

impl Failure {
    /// 0 done, 1 problems found, 2 could not run.
    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            Self::Closed => ExitCode::SUCCESS,
            Self::Problems(_) => ExitCode::from(1),
            Self::CannotRun(_) => ExitCode::from(2),
        }
    }
}

/// For results written to stdout.
impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe {
            return Self::Closed;
        }
        Self::CannotRun(format!("the output could not be written ({error}); check where it goes to"))
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Problems(problems) => {
                for problem in &problems.0 {
                    writeln!(f, "{problem}")?;
                }
                let count = problems.0.len();
                writeln!(f, "{count} problem{} found", if count == 1 { "" } else { "s" })
            }
            Self::CannotRun(reason) => writeln!(f, "picture-tour: {reason}"),
            Self::Closed => Ok(()),
        }
    }
}
