//! `bands`: a tour whose background is cut at the distances that the mirror image tells.

use std::io;
use std::io::Write;
use std::process::ExitCode;

use bevy_picture_tour::assemble::BandError;
use bevy_picture_tour::assemble::CutOptions;
use bevy_picture_tour::assemble::cut_bands;
use bevy_picture_tour::tour::TOUR_ENDING;

use crate::args::BandsArguments;
use crate::beside;
use crate::depth;
use crate::failure::Failure;
use crate::open;

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
        None => path.with_file_name(format!("{}.bands{TOUR_ENDING}", beside::stem(path)?)),
    };
    if beside::folder(&out).canonicalize().ok() != beside::folder(path).canonicalize().ok() {
        return Err(cannot(format!(
            "{} would not find its picture there; name a file in the folder of {}",
            out.display(),
            path.display()
        )));
    }
    beside::refuse_existing(&out, arguments.force)?;
    let masks = beside::new_masks_folder(&out)?;
    let options = CutOptions { folder: masks.clone(), anew: arguments.anew };
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
    let gone = beside::write(&cut.tour, &cut.masks, &masks, &out)?;

    let mut stdout = io::stdout().lock();
    let standing = cut.bands.iter().filter(|band| band.distance.is_finite()).count();
    match standing {
        1 => writeln!(stdout, "the background stands at one distance and stays whole")?,
        count => writeln!(stdout, "the background is cut into {count} bands, far to near")?,
    }
    depth::table_of_bands(&depth::told(&cut.bands)).write(&mut stdout)?;
    writeln!(stdout, "wrote {}; comments of the old file are not copied", out.display())?;
    beside::tell_gone(&gone, &mut stdout)?;
    Ok(ExitCode::SUCCESS)
}
