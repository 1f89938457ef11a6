//! The last versions of a tour: its file and its masks as they were before each save.
//!
//! `.lake.tour.ron.versions/1/` is the newest, `5` the oldest. A hidden folder keeps the tour's own folder tidy, and a
//! version holds its masks, without which it would not be one; the picture, which no edit changes, is not kept.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::picture::folder_of;
use crate::tour::{RelativePath, read};

use super::DeskError;
use super::files::{hidden, mask_names};

/// How many versions are kept.
pub const MOST_VERSIONS: usize = 5;

/// A version that was kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Version {
    /// 1 is the newest.
    pub number: usize,
    /// Its tour file; the masks are below the same folder.
    pub path: PathBuf,
    /// When it was saved, if the system knows.
    pub modified: Option<SystemTime>,
}

/// The versions of a tour, newest first.
pub(super) fn list(tour: &Path) -> Vec<Version> {
    let name = tour.file_name().unwrap_or_default();
    let paths = (1..=MOST_VERSIONS).map(|number| (number, place(tour, &number.to_string()).join(name)));
    let there = paths.filter(|(_, path)| path.is_file());
    let modified = |path: &Path| path.metadata().and_then(|metadata| metadata.modified()).ok();
    there.map(|(number, path)| Version { number, modified: modified(&path), path }).collect()
}

/// Keeps what is on the disk, if a tour is there, as version 1; the oldest goes.
pub(super) fn keep(tour: &Path) -> Result<(), DeskError> {
    if !tour.exists() {
        return Ok(());
    }
    let new = place(tour, "new");
    let kept = copy(tour, &new).and_then(|()| rotate(tour, &new));
    kept.map_err(DeskError::write(&new))
}

/// Copies, since other programs may write into a linked file.
fn copy(tour: &Path, to: &Path) -> io::Result<()> {
    remove(to)?;
    fs::create_dir_all(to)?;
    let copy = to.join(tour.file_name().unwrap_or_default());
    fs::copy(tour, &copy)?;
    // When it was saved tells versions apart; a file system that cannot keep that shall not keep a tour from being saved.
    let saved = tour.metadata()?.modified();
    let _kept = saved.and_then(|saved| fs::File::options().write(true).open(&copy)?.set_modified(saved));
    let text = String::from_utf8_lossy(&fs::read(tour)?).into_owned();
    let names = read::read(&text).0.map_or_else(Vec::new, |tour| mask_names(&tour));
    for mask in names.iter().filter_map(|name| RelativePath::new(name).ok()) {
        let (from, to) = (mask.in_folder(folder_of(tour)), mask.in_folder(to));
        // A mask that is gone cannot be kept, which shall not keep the tour from being saved.
        if from.is_file() {
            fs::create_dir_all(folder_of(&to))?;
            fs::copy(from, to)?;
        }
    }
    Ok(())
}

fn rotate(tour: &Path, new: &Path) -> io::Result<()> {
    let numbered = |number: usize| place(tour, &number.to_string());
    remove(&numbered(MOST_VERSIONS))?;
    for number in (1..MOST_VERSIONS).rev().filter(|number| numbered(*number).exists()) {
        fs::rename(numbered(number), numbered(number + 1))?;
    }
    fs::rename(new, numbered(1))
}

fn place(tour: &Path, name: &str) -> PathBuf {
    hidden(tour, ".versions").join(name)
}

fn remove(folder: &Path) -> io::Result<()> {
    if folder.exists() { fs::remove_dir_all(folder) } else { Ok(()) }
}
