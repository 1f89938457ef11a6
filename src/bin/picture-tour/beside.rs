//! A tour's file and the new masks beside it, written together or not at all.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use bevy_picture_tour::picture::{Mask, PngPixels, save_png};
use bevy_picture_tour::tour::{RelativePath, TOUR_ENDING, Tour};

use crate::failure::Failure;
use crate::leftover;

/// Refuses to replace a file unless that is asked for.
pub(crate) fn refuse_existing(out: &Path, force: bool) -> Result<(), Failure> {
    if out.exists() && !force {
        return Err(Failure::CannotRun(format!(
            "{} is already there; name another file with --out, or replace it with --force",
            out.display()
        )));
    }
    Ok(())
}

/// Refuses to write over what a tour is made of: its own file, and those that it names.
pub(crate) fn refuse_own(
    file: Option<&Path>,
    tour: &Tour,
    outs: impl IntoIterator<Item = PathBuf>,
) -> Result<(), Failure> {
    let Some(file) = file else { return Ok(()) };
    let named = tour.files().into_iter().map(|(_, name)| name.in_folder(folder(file)));
    let own: Vec<PathBuf> =
        named.chain([file.to_owned()]).filter_map(|own| own.canonicalize().ok()).collect();
    // What cannot be found is not there yet.
    match outs.into_iter().find(|out| out.canonicalize().is_ok_and(|out| own.contains(&out))) {
        Some(out) => Err(Failure::CannotRun(format!(
            "{} belongs to the tour; name another file or folder",
            out.display()
        ))),
        None => Ok(()),
    }
}

/// The name of a folder for the masks of the tour at `out` that is not there yet: masks that are there may be somebody's
/// work, and other tours name them.
pub(crate) fn new_masks_folder(out: &Path) -> Result<RelativePath, Failure> {
    let stem = stem(out)?;
    let names = std::iter::once(String::new()).chain((2..).map(|number| format!("_{number}")));
    let name = names
        .map(|end| format!("{stem}.masks{end}"))
        .find(|name| !folder(out).join(name).exists())
        .unwrap_or_default();
    RelativePath::new(&name).map_err(|error| {
        Failure::CannotRun(format!("{name:?} cannot stand in a tour: {error}; name another --out"))
    })
}

/// Writes masks and tour, or neither: the tour comes last, and without it the masks' new folder goes again. Gives the
/// folders of masks that were made for a tour which stood there before, and are gone with it.
pub(crate) fn write(
    tour: &Tour,
    masks: &[(RelativePath, Mask)],
    masks_folder: &RelativePath,
    out: &Path,
) -> Result<Vec<PathBuf>, Failure> {
    let made_before = leftover::made_for(out, &stem(out)?);
    write_both(tour, masks, masks_folder, out)?;
    Ok(leftover::remove(made_before))
}

fn write_both(
    tour: &Tour,
    masks: &[(RelativePath, Mask)],
    masks_folder: &RelativePath,
    out: &Path,
) -> Result<(), Failure> {
    let cannot = |error: &dyn std::fmt::Display| {
        Failure::CannotRun(format!(
            "{} cannot be written ({error}); name another file with --out",
            out.display()
        ))
    };
    if masks.is_empty() {
        return tour.save(out).map_err(|error| cannot(&error));
    }
    let new_folder = masks_folder.in_folder(folder(out));
    std::fs::create_dir(&new_folder).map_err(|error| cannot(&error))?;
    let written = masks
        .iter()
        .try_for_each(|(path, mask)| {
            save_png(&path.in_folder(folder(out)), mask.size(), PngPixels::Gray(mask.values()))
                .map_err(|error| cannot(&error))
        })
        .and_then(|()| {
            let names = masks.iter().filter_map(|(path, _)| path.as_str().rsplit('/').next());
            leftover::list(&new_folder, names).map_err(|error| cannot(&error))
        })
        .and_then(|()| tour.save(out).map_err(|error| cannot(&error)));
    if written.is_err() {
        // The error that led here is the one to tell.
        let _ = std::fs::remove_dir_all(new_folder);
    }
    written
}

/// Says which folders of masks are gone.
pub(crate) fn tell_gone(gone: &[PathBuf], out: &mut impl Write) -> io::Result<()> {
    gone.iter()
        .try_for_each(|folder| writeln!(out, "removed {}, which no tour names any more", folder.display()))
}

/// The folder that a file is in.
pub(crate) fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A tour file's name without its ending.
pub(crate) fn stem(path: &Path) -> Result<String, Failure> {
    let name = path.file_name().and_then(|name| name.to_str());
    let stem =
        name.map(|name| name.strip_suffix(TOUR_ENDING).unwrap_or(name.split('.').next().unwrap_or(name)));
    stem.filter(|stem| !stem.is_empty()).map(str::to_owned).ok_or_else(|| {
        Failure::CannotRun(format!(
            "{} is no name for a tour; name one that ends in {TOUR_ENDING}",
            path.display()
        ))
    })
}
