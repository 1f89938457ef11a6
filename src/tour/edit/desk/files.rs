//! Names of files: those beside a tour, and those that a document names.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use crate::picture::{Mask, decode_mask, decode_picture, folder_of};
use crate::tour::edit::Masks;
use crate::tour::{Motion, Region, RelativePath, Sea, TourFile};

use super::DeskError;

/// A hidden file beside a tour: `.lake.tour.ron.recovery`.
pub(super) fn hidden(tour: &Path, suffix: &str) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(tour.file_name().unwrap_or_default());
    name.push(suffix);
    folder_of(tour).join(name)
}

/// The first of `boat.png`, `boat-2.png`, `boat-3.png`, … that is free; `ending` is the part that stays last.
pub(in crate::tour::edit) fn free_name(name: &str, ending: &str, taken: impl Fn(&str) -> bool) -> String {
    let stem = name.strip_suffix(ending).unwrap_or(name);
    let numbered = (2..).map(|number: u64| format!("{stem}-{number}{ending}"));
    let mut names = std::iter::once(format!("{stem}{ending}")).chain(numbered);
    names.find(|name| !taken(name)).unwrap_or_else(|| name.to_owned())
}

/// What a file's name ends with, with the dot: `.png`.
pub(super) fn ending(name: &str) -> &str {
    name.rfind('.').filter(|dot| !name[*dot..].contains('/')).map_or("", |dot| &name[dot..])
}

/// The masks that a document names, each once.
pub(super) fn mask_names(tour: &TourFile) -> Vec<String> {
    let mut tour = tour.clone();
    let mut names: Vec<String> = regions(&mut tour)
        .filter_map(|region| match region {
            Region::Mask(name) => Some(name.clone()),
            Region::Polygon(_) => None,
        })
        .collect();
    names.sort();
    names.dedup();
    names
}

/// The files of other simulators that a document names.
pub(super) fn recordings(tour: &TourFile) -> Vec<String> {
    let poses = tour.objects.iter().filter_map(|object| match &object.motion {
        Motion::Recorded(recorded) => Some(recorded.poses.clone()),
        _ => None,
    });
    let sea = match &tour.waves.sea {
        Sea::Recorded(sea) => Some(sea.first.clone()),
        _ => None,
    };
    poses.chain(sea).collect()
}

/// Gives masks other names.
pub(super) fn rename_masks(tour: &mut TourFile, name: impl Fn(&str) -> Option<String>) {
    for region in regions(tour) {
        if let Region::Mask(file) = region
            && let Some(name) = name(file)
        {
            *file = name;
        }
    }
}

fn regions(tour: &mut TourFile) -> impl Iterator<Item = &mut Region<String>> {
    let TourFile { water, ground, background, sky, objects, .. } = tour;
    let areas = water.iter_mut().map(|water| &mut water.region);
    let areas = areas.chain(ground.iter_mut().map(|ground| &mut ground.region));
    let areas = areas.chain(sky.iter_mut().filter_map(|sky| sky.region.as_mut()));
    let areas = areas.chain(background.bands.iter_mut().filter_map(|band| band.region.as_mut()));
    areas.chain(objects.iter_mut().map(|object| &mut object.outline))
}

/// Reads the masks that a document names; what cannot be read is told, and the document goes on naming it.
///
/// `size` is the picture's; when that is not known, masks have their own.
pub(super) fn read_masks(
    tour: &TourFile,
    folder: &Path,
    size: Option<glam::UVec2>,
    problems: &mut Vec<DeskError>,
) -> Masks {
    let mut masks = Masks::default();
    for name in mask_names(tour) {
        match read_mask(&name, folder, size) {
            Ok(mask) => masks.load(name, mask),
            Err(problem) => problems.push(problem),
        }
    }
    masks
}

fn read_mask(name: &str, folder: &Path, size: Option<glam::UVec2>) -> Result<Mask, DeskError> {
    let path = RelativePath::new(name).map_err(|_| DeskError::FileName { name: name.to_owned() })?;
    let path = path.in_folder(folder);
    let bytes = fs::read(&path).map_err(DeskError::read(&path))?;
    let size = match size {
        Some(size) => size,
        None => decode_picture(&bytes, name)?.picture.size(),
    };
    Ok(decode_mask(&bytes, name, size)?)
}
