//! `bands`: a tour whose background is cut at the distances that the mirror image tells.

use std::io;
use std::io::Write;
use std::path::Path;
use std::path::PathBuf;
use std::process::ExitCode;

use bevy_picture_tour::assemble::BandError;
use bevy_picture_tour::assemble::BandedTour;
use bevy_picture_tour::assemble::CutOptions;
use bevy_picture_tour::assemble::cut_bands;
use bevy_picture_tour::picture::PngPixels;
use bevy_picture_tour::picture::save_png;
use bevy_picture_tour::tour::RelativePath;

use crate::args::BandsArguments;
use crate::depth;
use crate::failure::Failure;
use crate::open;

/// Ending of tour files.
const ENDING: &str = ".tour.ron";

/// Writes a tour with bands beside the one that is named.
///
/// # Errors
///
/// [`Failure::Problems`] of the tour; [`Failure::CannotRun`] where nothing can be cut or written. No file is changed then.
pub(crate) fn run(arguments: &BandsArguments) -> Result<ExitCode, Failure> {
    let cannot = Failure::CannotRun;
    let path = &arguments.tour;
    let disk = open::on_disk(path)?;
    let out = match &arguments.out {
        Some(out) => out.clone(),
        None => path.with_file_name(format!("{}.bands{ENDING}", stem(path)?)),
    };
    if folder(&out).canonicalize().ok() != folder(path).canonicalize().ok() {
        return Err(cannot(format!(
            "{} would not find its picture there; name a file in the folder of {}",
            out.display(),
            path.display()
        )));
    }
    if out.exists() && !arguments.force {
        return Err(cannot(format!(
            "{} is already there; name another file with --out, or replace it with --force",
            out.display()
        )));
    }
    // A folder of its own: masks that are already there may be somebody's work, and other tours name them.
    let names = std::iter::once(String::new()).chain((2..).map(|i| format!("_{i}")));
    let stem = stem(&out)?;
    let masks = names
        .map(|end| format!("{stem}.masks{end}"))
        .find(|name| !folder(&out).join(name).exists())
        .unwrap_or_default();
    let options = CutOptions {
        folder: RelativePath::new(&masks).map_err(|error| {
            cannot(format!("{masks:?} cannot stand in a tour: {error}; name another --out"))
        })?,
        anew: arguments.anew,
    };
    let source = disk.source().map_err(Failure::Problems)?;
    let bar = open::bar("measuring the mirror image");
    let cut = cut_bands(&disk.tour, &source, &options, &|share| {
        bar.set_position((100.0 * share) as u64);
        true
    });
    bar.finish_and_clear();
    let cut = cut.map_err(|error| match error {
        BandError::Problems(problems) => Failure::Problems(problems),
        BandError::HasBands => {
            cannot(format!("{} has bands already; --anew cuts its background anew", path.display()))
        }
        error => cannot(format!("{}: {error}", path.display())),
    })?;
    write(&cut, &out, &folder(&out).join(&masks))
        .map_err(|error| cannot(format!("{} cannot be written ({error})", out.display())))?;

    let mut stdout = io::stdout().lock();
    let standing = cut.bands.iter().filter(|band| band.distance.is_finite()).count();
    match standing {
        1 => writeln!(stdout, "the background stands at one distance and stays whole")?,
        count => writeln!(stdout, "the background is cut into {count} bands, far to near")?,
    }
    depth::table_of_bands(&depth::told(&cut.bands)).write(&mut stdout)?;
    writeln!(stdout, "wrote {}; comments of the old file are not copied", out.display())?;
    Ok(ExitCode::SUCCESS)
}

/// Writes masks and tour, or neither: the tour comes last, and without it the masks' new folder goes again.
fn write(cut: &BandedTour, out: &Path, masks: &Path) -> io::Result<()> {
    if cut.masks.is_empty() {
        return cut.tour.save(out);
    }
    std::fs::create_dir(masks)?;
    let mask_files = cut.masks.iter().try_for_each(|(path, mask)| {
        save_png(&path.in_folder(&folder(out)), mask.size(), PngPixels::Gray(mask.values()))
            .map_err(io::Error::other)
    });
    let written = mask_files.and_then(|()| cut.tour.save(out));
    if written.is_err() {
        // The error that led here is the one to tell.
        let _ = std::fs::remove_dir_all(masks);
    }
    written
}

/// The folder that a file is in.
fn folder(path: &Path) -> PathBuf {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new(".")).to_owned()
}

/// A tour file's name without its ending.
fn stem(path: &Path) -> Result<String, Failure> {
    let name = path.file_name().and_then(|name| name.to_str());
    let stem = name.map(|name| name.strip_suffix(ENDING).unwrap_or(name.split('.').next().unwrap_or(name)));
    stem.filter(|stem| !stem.is_empty()).map(str::to_owned).ok_or_else(|| {
        Failure::CannotRun(format!(
            "{} is no name for a tour; name one that ends in {ENDING}",
            path.display()
        ))
    })
}
