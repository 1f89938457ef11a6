//! Saving, autosaving and closing.
//!
//! Order of a save: the old tour becomes a version, then masks, then the picture's copy if one is needed, then the tour's
//! file, each whole or not at all; the recovery file goes last. Whatever interrupts it, one of them has every mark.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ron::ser::PrettyConfig;

use crate::picture::{PngPixels, encode_png, folder_of};
use crate::tour::edit::Masks;
use crate::tour::{RelativePath, TOUR_ENDING, TourFile, VERSION, read, write_whole};

use super::files::{ending, free_name, mask_names, recordings, rename_masks};
use super::open::tour_name;
use super::{Desk, DeskError, recovery, versions};

/// What to do with a file that another window or program has written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Replace {
    /// Leaves it and tells.
    Never,
    /// Replaces it; it is kept as a version.
    Always,
}

/// What a save did besides.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Saved {
    /// Files of other simulators that the tour names and that are not in its new folder.
    pub left_behind: Vec<String>,
}

impl Desk {
    /// Writes tour and masks. What stood there before is kept as a version.
    ///
    /// # Errors
    /// When another program wrote the file (unless it is to be replaced), or it cannot be written: the old one is then
    /// as it was and nothing on the desk is lost.
    pub fn save(&mut self, replace: Replace) -> Result<Saved, DeskError> {
        self.end_gesture();
        let path = self.files.tour.clone();
        let known = self.files.text.clone();
        if replace == Replace::Never && path.exists() {
            let there = fs::read(&path).map_err(DeskError::read(&path))?;
            if known.as_ref().map(String::as_bytes) != Some(&there[..]) {
                return Err(DeskError::ChangedOnDisk { path });
            }
        }
        let names = self.files.mask_names.clone();
        self.write(&path, names)
    }

    /// Writes tour and masks as another tour, which the desk goes on with; `.tour.ron` is added where the name lacks it.
    ///
    /// In another folder the picture is copied beside it. A file that is there is replaced (the dialog has asked) and kept
    /// as a version; masks of other tours in the folder are not touched.
    ///
    /// # Errors
    /// When something cannot be written; the desk then goes on with the old tour.
    pub fn save_as(&mut self, path: &Path) -> Result<Saved, DeskError> {
        self.end_gesture();
        let path = Self::file_of(path);
        if path.is_dir() {
            return Err(DeskError::IsFolder { path });
        }
        let names = if path == self.files.tour { self.files.mask_names.clone() } else { BTreeMap::new() };
        self.write(&path, names)
    }

    /// The file that [`save_as`](Self::save_as) writes for a name.
    #[must_use]
    pub fn file_of(path: &Path) -> PathBuf {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let is_tour = Path::new(&*name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ron"));
        if is_tour { path.to_owned() } else { path.with_file_name(format!("{name}{TOUR_ENDING}")) }
    }

    fn write(&mut self, path: &Path, mut names: BTreeMap<String, String>) -> Result<Saved, DeskError> {
        let folder = folder_of(path);
        let moved = path != self.files.tour;
        fs::create_dir_all(folder).map_err(DeskError::write(folder))?;
        versions::keep(path)?;

        let mut tour = self.draft.tour.clone();
        tour.version = VERSION;
        let mut masks = if moved { Masks::default() } else { self.files.masks.clone() };
        let picture = self.copy_picture(folder, &mut tour)?;
        for name in mask_names(&tour) {
            let Some(mask) = self.draft.masks.get(&name) else { continue };
            if !names.contains_key(&name) {
                let taken =
                    |file: &str| folder.join(file).exists() || names.values().any(|other| other == file);
                names.insert(name.clone(), free_name(&name, ending(&name), taken));
            }
            let Ok(file) = RelativePath::new(&names[&name]).map(|file| file.in_folder(folder)) else {
                continue;
            };
            let written = masks.get(&name).is_some_and(|saved| Arc::ptr_eq(saved, mask));
            if !written || !file.exists() {
                let png = encode_png(mask.size(), PngPixels::Gray(mask.values()))?;
                fs::create_dir_all(folder_of(&file)).map_err(DeskError::write(folder_of(&file)))?;
                write_whole(&file, &png).map_err(DeskError::write(&file))?;
                masks.exchange(&name, Some(mask.clone()));
            }
        }
        rename_masks(&mut tour, |name| names.get(name).cloned());

        let config = PrettyConfig::new().new_line("\n").indentor("  ");
        let text = read::options().to_string_pretty(&tour, config).map_err(std::io::Error::other);
        let text = text.map_err(DeskError::write(path))? + "\n";
        write_whole(path, text.as_bytes()).map_err(DeskError::write(path))?;

        let left = recordings(&tour).into_iter().filter(|name| moved && !folder.join(name).exists());
        self.remove_recovery();
        path.clone_into(&mut self.files.tour);
        (self.files.text, self.files.mask_names) = (Some(text), names);
        self.files.masks = masks;
        self.files.picture = picture.or(self.files.picture.take());
        self.history.mark_saved();
        Ok(Saved { left_behind: left.collect() })
    }

    /// Sees to it that the picture is below the tour's folder, and that the tour names it there; its file.
    fn copy_picture(&self, folder: &Path, tour: &mut TourFile) -> Result<Option<PathBuf>, DeskError> {
        let Some(from) = &self.files.picture else { return Ok(None) };
        // What the tour names may be a link that leads elsewhere; it stays one.
        let named = RelativePath::new(&tour.picture.file).ok().map(|name| name.in_folder(folder));
        if named.is_some_and(|named| is_same_file(&named, from)) {
            return Ok(None);
        }
        if let Some(name) = name_below(from, folder) {
            tour.picture.file = name;
            return Ok(None);
        }
        let bytes = fs::read(from).map_err(DeskError::read(from))?;
        let name = tour_name(from)?;
        let differs = |name: &str| {
            let there = folder.join(name);
            there.exists() && fs::read(there).ok().as_ref() != Some(&bytes)
        };
        let name = free_name(&name, ending(&name), differs);
        let to = folder.join(&name);
        if !to.exists() {
            write_whole(&to, &bytes).map_err(DeskError::write(&to))?;
        }
        tour.picture.file = name;
        Ok(Some(to))
    }

    /// Writes the recovery file when something has changed since and it was last written `every` seconds ago or more.
    /// Tells whether it wrote. `now` is in seconds of any steady clock.
    ///
    /// # Errors
    /// When it cannot be written: the marks are then on the desk only, and the user had better save elsewhere.
    pub fn autosave(&mut self, now: f64, every: f64) -> Result<bool, DeskError> {
        if self.history.is_saved() {
            if self.files.recovery.is_own {
                self.remove_recovery();
            }
            return Ok(false);
        }
        let state = &mut self.files.recovery;
        // A clock that was set back must not stop it.
        let early = state.written.is_some_and(|written| (now - written).abs() < every);
        if early || (state.path.is_some() && state.revision == self.history.revision()) {
            return Ok(false);
        }
        // Also after a failure it waits, so that a full disk is not tried at every frame.
        state.written = Some(now);
        let path = state.path.clone().unwrap_or_else(|| recovery::free_file(&self.files.tour));
        recovery::write(&path, &self.draft, &mut state.packed)?;
        (state.path, state.revision, state.is_own) = (Some(path), self.history.revision(), true);
        Ok(true)
    }

    /// Closes the desk and removes its recovery file: what is not saved is given up, as the user was asked. What was
    /// recovered and undone again stays to be offered.
    pub fn close(mut self) {
        if self.files.recovery.is_own || !self.is_saved() {
            self.remove_recovery();
        }
    }

    /// Removes the recovery file that this desk wrote or took. One that stays is offered again, which loses nothing.
    fn remove_recovery(&mut self) {
        if let Some(path) = self.files.recovery.path.take() {
            let _stays = fs::remove_file(path);
        }
    }

    /// A path for a new mask that neither the draft nor the tour's folder has: `masks/boat.png`, `masks/boat-2.png`, …
    #[must_use]
    pub fn free_mask_name(&self, of: &str) -> String {
        let folder = folder_of(&self.files.tour);
        self.draft.masks.free_name_besides(of, |name| folder.join(name).exists())
    }

    /// A path for a folder of new masks that neither the draft nor the tour's folder has: `masks/draft`, `masks/draft-2`, …
    #[must_use]
    pub fn free_mask_folder(&self, of: &str) -> String {
        let folder = folder_of(&self.files.tour);
        let holds_masks = |name: &str| {
            let mut masks = self.draft.masks.iter();
            masks.any(|(mask, _)| mask.strip_prefix(name).is_some_and(|rest| rest.starts_with('/')))
        };
        free_name(&format!("masks/{of}"), "", |name| holds_masks(name) || folder.join(name).exists())
    }
}

fn is_same_file(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// The name of a file below a folder, as a tour there names it.
fn name_below(file: &Path, folder: &Path) -> Option<String> {
    let (file, folder) = (file.canonicalize().ok()?, folder.canonicalize().ok()?);
    let steps = file.strip_prefix(folder).ok()?.iter().map(|step| step.to_str());
    let name = steps.collect::<Option<Vec<_>>>()?.join("/");
    RelativePath::new(&name).is_ok().then_some(name)
}
