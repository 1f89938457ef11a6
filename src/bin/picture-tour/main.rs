//! The program `picture-tour`: a command line around the library.
//!
//! Exit status: 0 done, 1 problems found in a tour, 2 could not run. Results go to stdout, errors to stderr.

mod args;
mod auto;
mod bake;
mod bands;
mod beside;
mod check;
mod demo;
mod depth;
mod edit;
mod failure;
mod film;
mod frames;
mod leftover;
mod log;
mod new;
mod open;
mod play;
mod render;
mod renderer;
mod report;
mod sheet;
mod table;
mod views;

use std::io::Write;
use std::process::ExitCode;

use clap::Parser;

use crate::args::Arguments;
use crate::args::Command;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match arguments.command {
        None => play::run(arguments.tour),
        Some(Command::Play { tour }) => play::run(tour),
        Some(Command::Edit { file }) => edit::run(file),
        Some(Command::Render(arguments)) => render::run(&arguments),
        Some(Command::Check { tour, json, sheet, depth }) => {
            check::run(tour.as_deref(), json, &check::Drawings { sheet, depth })
        }
        Some(Command::Bands(arguments)) => bands::run(&arguments),
        Some(Command::New(arguments)) => new::run(&arguments),
        Some(Command::Bake { tour, force }) => bake::run(&tour, force),
    };
    done.unwrap_or_else(|failure| {
        // When stderr is closed as well there is nobody left to tell.
        let _ = write!(std::io::stderr().lock(), "{failure}");
        failure.exit_code()
    })
}
