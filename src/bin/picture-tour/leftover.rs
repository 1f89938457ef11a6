//! Masks that the program made for a tour which is replaced.
//!
//! A folder of made masks lists them with their hashes. What is listed, still as it was made, and in a folder that no tour
//! names any more is removed; whatever somebody has put there, painted over or uses elsewhere stays.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::beside;

/// The list in a folder of made masks, in the form of `b3sum`.
const LIST: &str = "made_by_picture_tour.b3";

/// Files larger than this are no tours, bytes.
const LARGEST_TOUR: u64 = 1 << 22;

/// Lists these files of a folder as made.
pub(crate) fn list<'a>(folder: &Path, names: impl Iterator<Item = &'a str>) -> io::Result<()> {
    let line = |name: &str| Ok(format!("{}  {name}\n", blake3::hash(&fs::read(folder.join(name))?)));
    let lines = names.map(line).collect::<io::Result<String>>()?;
    fs::write(folder.join(LIST), lines)
}

/// Folders of made masks, `stem.masks` and the like, that the tour at `out` names; to be asked before it is replaced.
pub(crate) fn made_for(out: &Path, stem: &str) -> Vec<PathBuf> {
    let text = fs::read_to_string(out).unwrap_or_default();
    let Ok(entries) = fs::read_dir(beside::folder(out)) else { return Vec::new() };
    let is_folder = |entry: &fs::DirEntry| entry.file_type().is_ok_and(|kind| kind.is_dir());
    let folders = entries.flatten().filter(is_folder).map(|entry| entry.path());
    folders
        .filter(|folder| {
            let name = folder.file_name().and_then(|name| name.to_str());
            name.is_some_and(|name| name.starts_with(&format!("{stem}.masks")) && is_named_in(&text, name))
                && folder.join(LIST).is_file()
        })
        .collect()
}

/// Removes what was made in these folders, where no tour names the folder any more. Gives those that are gone.
pub(crate) fn remove(folders: Vec<PathBuf>) -> Vec<PathBuf> {
    folders.into_iter().filter(|folder| !is_in_use(folder) && remove_made(folder)).collect()
}

/// Removes what is as it was made; whether that was all there was.
fn remove_made(folder: &Path) -> bool {
    let list = fs::read_to_string(folder.join(LIST)).unwrap_or_default();
    for (hash, name) in list.lines().filter_map(|line| line.split_once("  ")) {
        let file = folder.join(name);
        let is_here = Path::new(name).file_name().is_some_and(|last| last == name);
        let is_file = file.symlink_metadata().is_ok_and(|metadata| metadata.is_file());
        let is_as_made = || fs::read(&file).is_ok_and(|bytes| blake3::hash(&bytes).to_hex().as_str() == hash);
        if is_here && is_file && is_as_made() {
            // One that stays does no harm.
            let _ = fs::remove_file(&file);
        }
    }
    let _ = fs::remove_file(folder.join(LIST));
    // Not where something else is in it.
    fs::remove_dir(folder).is_ok()
}

/// Whether something that may be a tour names a folder: any file beside it, tours in the folders above it. What cannot be
/// read may.
fn is_in_use(folder: &Path) -> bool {
    let Ok(folder) = folder.canonicalize() else { return true };
    let Some(name) = folder.file_name().and_then(|name| name.to_str()) else { return true };
    folder.ancestors().skip(1).enumerate().any(|(above, place)| {
        let Ok(entries) = fs::read_dir(place) else { return true };
        entries.flatten().any(|entry| {
            let is_tour = entry.file_name().to_string_lossy().to_lowercase().contains(".ron");
            let Ok(metadata) = fs::metadata(entry.path()) else { return false };
            let may_name = metadata.is_file() && metadata.len() <= LARGEST_TOUR && (is_tour || above == 0);
            may_name
                && match fs::read(entry.path()) {
                    Ok(bytes) => {
                        let text = String::from_utf8_lossy(&bytes);
                        is_named_in(&text, name) || (is_tour && above == 0 && spells_by_number(&text))
                    }
                    Err(_) => true,
                }
        })
    })
}

/// Whether a text spells letters by their numbers, so that it may name what it does not show.
fn spells_by_number(text: &str) -> bool {
    text.contains("\\u") || text.contains("\\x")
}

/// Whether a text names something in a folder. Some file systems do not tell letters of different case apart.
fn is_named_in(text: &str, folder: &str) -> bool {
    text.to_lowercase().contains(&format!("{}/", folder.to_lowercase()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tour that names masks in a folder of two that were made, and the path of that folder.
    fn replaced(place: &Path) -> PathBuf {
        let folder = place.join("lake.masks");
        fs::create_dir(&folder).unwrap();
        for name in ["a.png", "b.png"] {
            fs::write(folder.join(name), name).unwrap();
        }
        list(&folder, ["a.png", "b.png"].into_iter()).unwrap();
        let out = place.join("lake.tour.ron");
        fs::write(&out, "(water: Mask(\"lake.masks/a.png\"))").unwrap();
        assert_eq!(made_for(&out, "lake"), std::slice::from_ref(&folder));
        fs::write(out, "(water: Mask(\"lake.masks_2/a.png\"))").unwrap();
        folder
    }

    #[test]
    fn what_was_made_goes_with_its_tour() {
        let place = tempfile::tempdir().unwrap();
        let folder = replaced(place.path());
        assert_eq!(remove(vec![folder.clone()]), std::slice::from_ref(&folder));
        assert!(!folder.exists());
    }

    #[test]
    fn what_somebody_has_put_there_or_painted_over_stays() {
        let place = tempfile::tempdir().unwrap();
        let folder = replaced(place.path());
        fs::write(folder.join("b.png"), "painted").unwrap();
        fs::write(folder.join("notes.txt"), "mine").unwrap();
        assert!(remove(vec![folder.clone()]).is_empty());
        let there = |name: &str| folder.join(name).exists();
        assert_eq!(["a.png", "b.png", "notes.txt", LIST].map(there), [false, true, true, false]);
    }

    #[test]
    fn what_another_tour_names_or_may_name_stays() {
        for (name, text) in [
            ("other.tour.ron", "(water: Mask(\"Lake.Masks/a.png\"))"),
            ("lake.tour.bak", "(water: Mask(\"lake.masks/a.png\"))"),
            ("escaped.tour.ron", "(water: Mask(\"lake.m\\u{61}sks/a.png\"))"),
            ("../above.tour.ron", "(water: Mask(\"sub/lake.masks/a.png\"))"),
        ] {
            let place = tempfile::tempdir().unwrap();
            let sub = place.path().join("sub");
            fs::create_dir(&sub).unwrap();
            let folder = replaced(&sub);
            fs::write(sub.join(name), text).unwrap();
            assert!(remove(vec![folder.clone()]).is_empty(), "{name}");
            assert!(folder.join("a.png").exists() && folder.join(LIST).exists(), "{name}");
        }
    }

    #[test]
    fn a_folder_without_a_list_is_nobody_s_to_remove() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("lake.masks");
        fs::create_dir(&folder).unwrap();
        let out = place.path().join("lake.tour.ron");
        fs::write(&out, "(water: Mask(\"lake.masks/a.png\"))").unwrap();
        assert!(made_for(&out, "lake").is_empty());
        // Nor does a list lead out of its folder.
        fs::write(place.path().join("mine.png"), "mine").unwrap();
        fs::write(folder.join(LIST), format!("{}  ../mine.png\n", blake3::hash(b"mine"))).unwrap();
        remove_made(&folder);
        assert!(place.path().join("mine.png").exists());
    }
}
