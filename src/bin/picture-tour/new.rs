//! `new`: a tour file to start from.

use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::path::PathBuf;
use std::process::ExitCode;

use bevy_picture_tour::picture::decode_picture;
use bevy_picture_tour::tour::RelativePath;
use bevy_picture_tour::tour::Tour;
use glam::UVec2;

use crate::args::NewArguments;
use crate::auto;
use crate::beside;
use crate::failure::Failure;

/// Writes a tour file for a picture.
pub(crate) fn run(arguments: &NewArguments) -> Result<ExitCode, Failure> {
    let picture = &arguments.picture;
    let name = picture.display().to_string();
    let cannot = |reason: String| Failure::CannotRun(reason);
    let bytes = std::fs::read(picture)
        .map_err(|error| cannot(format!("the picture {name} cannot be read ({error}); check the path")))?;
    let decoded = decode_picture(&bytes, &name).map_err(|error| cannot(error.to_string()))?;

    let out = arguments.out.clone().unwrap_or_else(|| picture.with_extension("tour.ron"));
    let relative = relative_to_folder_of(picture, &out).map_err(cannot)?;
    beside::refuse_existing(&out, arguments.force)?;
    let size = decoded.picture.size();
    if arguments.auto {
        auto::write(&decoded, &relative, &out)?;
        let next = "fly through it, and mend what is not to be trusted";
        return tell(&decoded.notes, &out, &relative, size, next);
    }
    let text = Tour::template(relative.as_str(), size);
    if Tour::read(&text).is_err() {
        return Err(cannot(format!(
            "{name} has {} x {} pixels; use one of at least 20 on each side",
            size.x, size.y
        )));
    }
    write(&out, &text, arguments.force)?;
    let next = "open it in a text editor; set the horizon, the water, and some reflection pairs";
    tell(&decoded.notes, &out, &relative, size, next)
}

/// Says what was written, and what to do next.
fn tell(
    notes: &[String],
    out: &Path,
    relative: &RelativePath,
    size: UVec2,
    next: &str,
) -> Result<ExitCode, Failure> {
    let mut stdout = std::io::stdout().lock();
    for note in notes {
        writeln!(stdout, "note: {note}")?;
    }
    let out = out.display();
    writeln!(stdout, "wrote {out} for {relative} ({} x {} px)", size.x, size.y)?;
    writeln!(stdout, "next: {next}")?;
    writeln!(stdout, "then: picture-tour check \"{out}\"    tells what is wrong and how well it is solved")?;
    writeln!(stdout, "      picture-tour \"{out}\"          flies through it")?;
    Ok(ExitCode::SUCCESS)
}

/// The picture's path as a tour at `out` writes it.
fn relative_to_folder_of(picture: &Path, out: &Path) -> Result<RelativePath, String> {
    let shown = picture.display();
    let folder = |path: &Path| -> Result<PathBuf, String> {
        let folder = beside::folder(path);
        folder
            .canonicalize()
            .map_err(|error| format!("the folder {} cannot be used ({error})", folder.display()))
    };
    let file = picture.file_name().ok_or_else(|| format!("{shown} names no file"))?;
    let (picture_folder, out_folder) = (folder(picture)?, folder(out)?);
    let below = picture_folder.strip_prefix(&out_folder).map_err(|_| {
        format!(
            "a tour in {} cannot name {shown}, which is not below it; put the tour into the picture's folder or \
             above it",
            out_folder.display()
        )
    })?;
    let steps: Option<Vec<&str>> =
        below.iter().chain(std::iter::once(file)).map(std::ffi::OsStr::to_str).collect();
    let path = steps.ok_or_else(|| format!("the path {shown} is not Unicode; rename the picture"))?.join("/");
    RelativePath::new(&path)
        .map_err(|error| format!("{path:?} cannot stand in a tour: {error}; rename the picture"))
}

fn write(out: &Path, text: &str, force: bool) -> Result<(), Failure> {
    // Asked for already, unless somebody else writes at this very moment.
    let file = File::options().write(true).create(true).truncate(true).create_new(!force).open(out);
    file.and_then(|mut file| file.write_all(text.as_bytes())).map_err(|error| {
        Failure::CannotRun(format!(
            "{} cannot be written ({error}); name another file with --out",
            out.display()
        ))
    })
}
