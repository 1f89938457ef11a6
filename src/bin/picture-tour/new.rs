//! `new`: a tour file to start from.

use std::fs::File;
use std::io::ErrorKind;
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
    let size = decoded.picture.size();
    if arguments.auto {
        auto::write(&decoded, &relative, &out, arguments.force)?;
        return tell(
            &decoded.notes,
            &out,
            &relative,
            size,
            "fly through it, and mend what is not to be trusted",
        );
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
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
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
    let mut options = File::options();
    let options = if force { options.create(true).truncate(true) } else { options.create_new(true) };
    options.write(true).open(out).and_then(|mut file| file.write_all(text.as_bytes())).map_err(|error| {
        Failure::CannotRun(if error.kind() == ErrorKind::AlreadyExists {
            format!(
                "{} is already there; name another file with --out, or replace it with --force",
                out.display()
            )
        } else {
            format!("{} cannot be written ({error}); name another file with --out", out.display())
        })
    })
}
