//! Opening a picture or a tour, finding a picture that has moved, and taking what a crash left.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::UVec2;

use crate::picture::{DecodedPicture, Mask, decode_picture, folder_of};
use crate::tour::edit::part::Part;
use crate::tour::edit::{Draft, Edit, EditError, History, Masks, PackedMask, Restored};
use crate::tour::{Problem, Problems, RelativePath, TOUR_ENDING, TourFile, read};

use super::files::{ending, free_name, mask_names, read_masks};
use super::{Desk, DeskError, Files, Recovered, Recovery, Version, recovery, versions};

/// How much the proportions of a picture may differ from those that were marked: 1 px in 1000, as the document's checks.
const ASPECT_TOLERANCE: f64 = 1e-3;

/// What was opened.
#[derive(Debug)]
pub struct Opened {
    /// The desk.
    pub desk: Desk,
    /// What interrupted sessions left of this tour, newest first: to be [taken](Desk::recover) or [refused](Recovered::discard).
    pub recovered: Vec<Recovered>,
    /// A tour of the picture that was there already, when a picture was opened.
    pub existing_tour: Option<PathBuf>,
    /// What is not as it should be in a document that could be read all the same: unknown fields, which a save would drop.
    pub notes: Vec<Problem>,
    /// Files that could not be had: a picture that has moved, masks that are gone, a broken recovery file. All marks are
    /// there.
    pub problems: Vec<DeskError>,
}

impl Desk {
    /// Opens a tour (a file that ends in `.ron`) or, from any other file, a new tour of a picture.
    ///
    /// # Errors
    /// When the file is a folder, cannot be read, or is neither a tour nor a picture. A tour opens when it reads at all:
    /// it may be incomplete or have wrong values, and its picture and masks may be gone.
    pub fn open(path: &Path) -> Result<Opened, DeskError> {
        let bytes = fs::read(path).map_err(DeskError::read(path))?;
        let is_tour = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ron"));
        if is_tour { Self::open_tour(path, &bytes) } else { Self::open_picture(path, &bytes) }
    }

    fn open_picture(path: &Path, bytes: &[u8]) -> Result<Opened, DeskError> {
        let picture = decode_picture(bytes, &path.display().to_string())?;
        let name = tour_name(path)?;
        let tour_of = |name: &str| folder_of(path).join(format!("{}{TOUR_ENDING}", stem(name)));
        let tour = free_name(stem(&name), "", |name| tour_of(name).exists());
        let existing = tour_of(&name);
        let mut file = TourFile::new(name);
        file.picture.size = Some(picture.picture.size());
        let mut problems = Vec::new();
        let tour = folder_of(path).join(format!("{tour}{TOUR_ENDING}"));
        let recovered = recovery::find(&tour, &mut problems);
        let files = Files {
            tour,
            text: None,
            picture: Some(path.to_owned()),
            seen: BTreeMap::new(),
            masks: Masks::default(),
            mask_names: BTreeMap::new(),
            recovery: Recovery::default(),
        };
        // There is nothing yet that closing would lose.
        let history = History::new(true);
        let desk = Self { draft: Draft::new(file), history, picture: Some(Arc::new(picture)), files };
        let existing_tour = existing.exists().then_some(existing);
        Ok(Opened { desk, recovered, existing_tour, notes: Vec::new(), problems })
    }

    fn open_tour(path: &Path, bytes: &[u8]) -> Result<Opened, DeskError> {
        let (text, tour, notes) = read_tour(path, bytes)?;
        let mut problems = Vec::new();
        let picture_file = RelativePath::new(&tour.picture.file)
            .map(|file| file.in_folder(folder_of(path)))
            .map_err(|_| DeskError::FileName { name: tour.picture.file.clone() });
        let picture = picture_file.and_then(|file| {
            let picture = read_picture(&file)?;
            check_shape(&file, &picture, tour.picture.size)?;
            Ok((file, picture))
        });
        let (picture_file, picture) = match picture {
            Ok((file, picture)) => (Some(file), Some(Arc::new(picture))),
            Err(problem) => {
                problems.push(problem);
                (None, None)
            }
        };
        let size = picture.as_ref().map(|picture| picture.picture.size()).or(tour.picture.size);
        let masks = read_masks(&tour, folder_of(path), size, &mut problems);
        // What says the same as the tour needs no question.
        let says_more = |left: &Recovered| {
            let mut kept = left.masks.iter();
            left.tour != tour || kept.any(|(name, mask)| masks.get(name) != Some(mask))
        };
        let (recovered, same): (Vec<_>, Vec<_>) =
            recovery::find(path, &mut problems).into_iter().partition(says_more);
        same.into_iter().for_each(|left| drop(left.discard()));
        let mask_names = mask_names(&tour).into_iter().map(|name| (name.clone(), name)).collect();
        let files = Files {
            tour: path.to_owned(),
            text: Some(text),
            picture: picture_file,
            seen: BTreeMap::new(),
            masks: masks.clone(),
            mask_names,
            recovery: Recovery::default(),
        };
        let desk = Self { draft: Draft { tour, masks }, history: History::new(true), picture, files };
        Ok(Opened { desk, recovered, existing_tour: None, notes, problems })
    }

    /// Takes the picture from another file; all marks stay, and masks follow its size. It can be undone.
    ///
    /// A file outside the tour's folder is copied into it when the tour is saved.
    ///
    /// # Errors
    /// When it cannot be read, or has another shape than the picture that was marked.
    pub fn find_picture(&mut self, path: &Path) -> Result<(), DeskError> {
        let picture = read_picture(path)?;
        check_shape(path, &picture, self.draft.tour.picture.size)?;
        let mut source = self.draft.tour.picture.clone();
        source.file = tour_name(path)?;
        source.size.get_or_insert(picture.picture.size());
        let size = picture.picture.size();
        let others = self.draft.masks.iter().filter(|(_, mask)| mask.size() != size);
        let resized = others.map(|(name, mask)| {
            let mask = PackedMask::new(&Mask::clone(mask).resized_to(size));
            Edit::Mask { name: name.to_owned(), mask: Some(mask) }
        });
        let edit = Edit::Many(std::iter::once(Edit::Picture(source)).chain(resized).collect());
        self.remember_picture();
        let is_elsewhere = !self.apply(&edit)? && self.files.picture.as_deref() != Some(path);
        (self.picture, self.files.picture) = (Some(Arc::new(picture)), Some(path.to_owned()));
        self.remember_picture();
        if is_elsewhere {
            // The document says the same, but its file is not where the document is.
            self.history.mark_unsaved();
        }
        Ok(())
    }

    /// Keeps the picture for steps that are undone.
    fn remember_picture(&mut self) {
        if let (Some(path), Some(picture)) = (&self.files.picture, &self.picture) {
            let name = self.draft.tour.picture.file.clone();
            self.files.seen.insert(name, (path.clone(), Arc::clone(picture)));
        }
    }

    /// Lays the picture on the desk that the document names.
    pub(super) fn follow_picture(&mut self) {
        let name = &self.draft.tour.picture.file;
        if let Some((path, picture)) = self.files.seen.get(name) {
            (self.picture, self.files.picture) = (Some(Arc::clone(picture)), Some(path.clone()));
        }
    }

    /// Takes what an interrupted session left. It can be undone, and the file goes with the next save.
    ///
    /// # Errors
    /// When the draft cannot be changed; the file is then still there.
    pub fn recover(&mut self, recovered: Recovered) -> Result<(), EditError> {
        self.put(recovered.tour, &recovered.masks)?;
        (self.files.recovery.path, self.files.recovery.is_own) = (Some(recovered.path), false);
        self.files.recovery.revision = self.history.revision();
        Ok(())
    }

    /// The versions of the tour that were kept, newest first.
    #[must_use]
    pub fn versions(&self) -> Vec<Version> {
        versions::list(self.path())
    }

    /// Takes a version back onto the desk. It can be undone; the file stays as it is until the next save.
    ///
    /// # Errors
    /// When the version's tour cannot be read.
    pub fn take_version(&mut self, version: &Version) -> Result<Vec<DeskError>, DeskError> {
        let bytes = fs::read(&version.path).map_err(DeskError::read(&version.path))?;
        let (_, tour, _) = read_tour(&version.path, &bytes)?;
        let size = self.picture.as_ref().map(|picture| picture.picture.size()).or(tour.picture.size);
        let mut problems = Vec::new();
        let masks = read_masks(&tour, folder_of(&version.path), size, &mut problems);
        self.put(tour, &masks)?;
        Ok(problems)
    }

    /// Puts another document, and some of its masks, in the place of this one, as a step.
    fn put(&mut self, tour: TourFile, masks: &Masks) -> Result<(), EditError> {
        let TourFile { version: _, picture, camera, water, ground, background, sky, objects, .. } = tour;
        let mut parts = vec![
            Part::Picture(picture),
            Part::Camera(camera),
            Part::Water(water),
            Part::Ground(ground),
            Part::Background(background),
            Part::Sky(sky),
            Part::Objects(objects),
            Part::Wind(tour.wind),
            Part::Waves(tour.waves),
            Part::Path(tour.path),
        ];
        let masks = masks.iter().map(|(name, mask)| (name.to_owned(), Some(PackedMask::new(mask))));
        parts.extend(masks.map(|(name, mask)| Part::Mask(name, mask)));
        self.remember_picture();
        self.apply(&Edit::Restore(Restored(parts)))?;
        self.follow_picture();
        Ok(())
    }
}

impl Recovered {
    /// Refuses it: its file is removed.
    ///
    /// # Errors
    /// When the file cannot be removed.
    pub fn discard(self) -> Result<(), DeskError> {
        fs::remove_file(&self.path).map_err(DeskError::write(&self.path))
    }
}

fn read_tour(path: &Path, bytes: &[u8]) -> Result<(String, TourFile, Vec<Problem>), DeskError> {
    let name = path.display().to_string();
    let fail = |problems: Vec<Problem>| DeskError::NoTour { problems: Problems(problems).with_file(&name) };
    let text = std::str::from_utf8(bytes).map_err(|_| {
        fail(vec![Problem::new("", "", "the file is no text, so it is no tour", "restore it from a version")])
    })?;
    let (tour, notes) = read::read(text.strip_prefix('\u{feff}').unwrap_or(text));
    match tour {
        Some(tour) => Ok((text.to_owned(), tour, Problems(notes).with_file(&name).0)),
        None => Err(fail(notes)),
    }
}

pub(super) fn read_picture(path: &Path) -> Result<DecodedPicture, DeskError> {
    let bytes = fs::read(path).map_err(DeskError::read(path))?;
    Ok(decode_picture(&bytes, &path.display().to_string())?)
}

/// Whether a picture can be the one that was marked, perhaps at another size.
fn check_shape(path: &Path, picture: &DecodedPicture, marked: Option<UVec2>) -> Result<(), DeskError> {
    let found = picture.picture.size();
    let expected = marked.unwrap_or(found);
    let ratio = found.as_dvec2() / expected.as_dvec2();
    // A side that is rounded to whole pixels differs by up to one of them.
    let rounding = 1.0 / f64::from(found.min_element());
    // Written so that a size of nothing is another shape.
    let same = (ratio.x / ratio.y - 1.0).abs() <= ASPECT_TOLERANCE.max(rounding);
    if same { Ok(()) } else { Err(DeskError::OtherShape { path: path.to_owned(), found, expected }) }
}

/// A file's name as a tour beside it names it.
pub(super) fn tour_name(path: &Path) -> Result<String, DeskError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    match RelativePath::new(&name) {
        Ok(_) => Ok(name),
        Err(_) => Err(DeskError::FileName { name }),
    }
}

fn stem(name: &str) -> &str {
    name.strip_suffix(ending(name)).filter(|stem| !stem.is_empty()).unwrap_or(name)
}
