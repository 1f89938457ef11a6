//! The recovery file: what was marked and not saved, for after a crash.
//!
//! `.lake.tour.ron.recovery` beside `lake.tour.ron` holds the document and all masks that it names, so that it needs
//! no other file but the picture. A desk never overwrites what another one left: with two windows on a tour the second writes `.recovery.2`.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use serde::{Deserialize, Serialize};

use crate::picture::Mask;
use crate::tour::edit::{Draft, Masks, PackedMask};
use crate::tour::{TourFile, read, write_whole};

use super::DeskError;
use super::files::{hidden, mask_names};

/// So many recovery files of one tour are looked for.
const MOST: usize = 9;

/// What an interrupted session left.
#[derive(Clone, Debug)]
pub struct Recovered {
    pub(super) path: PathBuf,
    /// When it was written, if the system knows.
    pub modified: Option<SystemTime>,
    /// The document.
    pub tour: TourFile,
    /// The masks that it names.
    pub masks: Masks,
}

#[derive(Serialize, Deserialize)]
struct Contents {
    tour: TourFile,
    masks: BTreeMap<String, PackedMask>,
}

/// The recovery file of a number, from 0.
fn file(tour: &Path, number: usize) -> PathBuf {
    match number {
        0 => hidden(tour, ".recovery"),
        _ => hidden(tour, &format!(".recovery.{}", number + 1)),
    }
}

/// Where a desk can write without overwriting what another one left.
pub(super) fn free_file(tour: &Path) -> PathBuf {
    let free = (0..MOST).map(|number| file(tour, number)).find(|path| !path.exists());
    free.unwrap_or_else(|| file(tour, MOST - 1))
}

/// Masks as they were packed last, so that only those that were painted since are packed anew.
pub(super) type Packed = BTreeMap<String, (Arc<Mask>, PackedMask)>;

/// Writes the document and the masks that it names.
pub(super) fn write(path: &Path, draft: &Draft, packed: &mut Packed) -> Result<(), DeskError> {
    let masks = mask_names(&draft.tour).into_iter().filter_map(|name| {
        let mask = draft.masks.get(&name)?;
        match packed.get(&name) {
            Some((old, _)) if Arc::ptr_eq(old, mask) => {}
            _ => drop(packed.insert(name.clone(), (mask.clone(), PackedMask::new(mask)))),
        }
        let packed = packed[&name].1.clone();
        Some((name, packed))
    });
    let contents = Contents { masks: masks.collect(), tour: draft.tour.clone() };
    let text = read::options().to_string(&contents).map_err(std::io::Error::other);
    text.and_then(|text| write_whole(path, text.as_bytes())).map_err(DeskError::write(path))
}

/// What interrupted sessions left of a tour, newest first. What cannot be read is put aside and told.
pub(super) fn find(tour: &Path, problems: &mut Vec<DeskError>) -> Vec<Recovered> {
    let mut found = Vec::new();
    for path in (0..MOST).map(|number| file(tour, number)).filter(|path| path.exists()) {
        match read_file(&path) {
            Ok(recovered) => found.push(recovered),
            Err(reason) => {
                let mut aside = path.clone().into_os_string();
                aside.push(".broken");
                let aside = PathBuf::from(aside);
                let path = if fs::rename(&path, &aside).is_ok() { aside } else { path };
                problems.push(DeskError::BrokenRecovery { path, reason });
            }
        }
    }
    found.sort_by_key(|recovered: &Recovered| std::cmp::Reverse(recovered.modified));
    found
}

fn read_file(path: &Path) -> Result<Recovered, String> {
    let text = fs::read_to_string(path).map_err(|error| error.to_string())?;
    let contents: Contents = read::options().from_str(&text).map_err(|error| error.to_string())?;
    let mut masks = Masks::default();
    for (name, mask) in contents.masks {
        masks.load(name, mask.unpack().map_err(|error| error.to_string())?);
    }
    let modified = path.metadata().and_then(|metadata| metadata.modified()).ok();
    Ok(Recovered { path: path.to_owned(), modified, tour: contents.tour, masks })
}
