//! `bake`: all layers of a tour in one file beside it.

use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

use bevy_picture_tour::bake;
use bevy_picture_tour::maps::HALO_LIFT;
use bevy_picture_tour::maps::MapOptions;

use crate::failure::Failure;
use crate::open;
use crate::open::Opened;

/// Bakes a tour, unless a fresh baked file is there already.
///
/// # Errors
///
/// The tour's problems; or a file that cannot be written, in which case an older one stays as it was.
pub(crate) fn run(path: &Path, force: bool) -> Result<ExitCode, Failure> {
    let disk = open::on_disk(path)?;
    let baked = bake::baked_path(path);
    if !force && open::fresh_bake(path, &disk).is_ok() {
        writeln!(std::io::stdout().lock(), "{} is fresh; --force bakes it again", baked.display())?;
        return Ok(ExitCode::SUCCESS);
    }
    let fingerprint = || {
        bake::fingerprint(&disk.tour, &MapOptions::default(), &|file| disk.read(file))
            .map_err(Failure::CannotRun)
    };
    // Asked before the files are decoded: what changes in between makes another one. Their problems are told first.
    let before = fingerprint();
    let source = Arc::new(disk.source().map_err(Failure::Problems)?);
    let before = before?;
    let opened = Opened { name: path.display().to_string(), asset: Arc::clone(&source).into() };
    let built = opened.assemble(&|| false)?;
    if fingerprint()? != before {
        return Err(Failure::CannotRun(format!(
            "a file of {} changed while it was baked; bake again",
            path.display()
        )));
    }
    bake::save(&baked, &disk.tour, &source, &built, before).map_err(|error| {
        Failure::CannotRun(format!(
            "{} cannot be written ({error}); an older one stays as it was; free some space, or bake a copy of the tour \
             in a folder that may be written to",
            baked.display()
        ))
    })?;
    let mut stdout = std::io::stdout().lock();
    for (component, maps) in built.scene.components.iter().zip(&built.maps.components) {
        if maps.mean_lift > HALO_LIFT {
            writeln!(
                stdout,
                "\"{}\" will show a halo when the camera moves: what is filled in behind it does not match",
                component.name
            )?;
        }
    }
    let size = std::fs::metadata(&baked).map_or(0, |metadata| metadata.len());
    writeln!(
        stdout,
        "{}: {} components, {:.1} MB",
        baked.display(),
        built.maps.components.len(),
        size as f64 / 1e6
    )?;
    Ok(ExitCode::SUCCESS)
}
