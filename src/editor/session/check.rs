//! What the draft amounts to now: its problems, its solution, and the tour that is shown of it.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError, Weak};

use glam::DVec2;

use bevy::tasks::futures::check_ready;

use super::Session;
use crate::assemble::{PlacedTour, TourSource, place, read_beside};
use crate::motion::Recordings;
use crate::picture::{DecodedPicture, Mask, PicturePoint};
use crate::plugin::background::{Task, begin};
use crate::solve::{Solution, SolveError};
use crate::tour::edit::Draft;
use crate::tour::{Motion, Problem, Problems, RelativePath, Sea, Tour, TourFile};

/// Seconds without an edit after which the tour is built anew.
const QUIET_SECONDS: f64 = 0.35;

/// What is known of a revision of the draft.
#[derive(Debug, Default)]
pub(super) struct Checked {
    /// The revision that was checked, and whether there was a picture.
    of: Option<(u64, bool)>,
    pub(super) problems: Vec<Problem>,
    pub(super) solved: Option<Result<Solution, SolveError>>,
    placed: Option<Arc<PlacedTour>>,
    source: Option<Arc<TourSource>>,
    looks: Option<Looks>,
}

/// All that maps depend on.
#[derive(Clone, Debug)]
struct Looks {
    /// Without anything that moves.
    tour: TourFile,
    /// Which objects move, however they do.
    movers: Vec<bool>,
    /// Only to tell whether they are the same: a mask that is held is copied when it is painted on.
    masks: Vec<Weak<Mask>>,
    picture: Arc<DecodedPicture>,
}

impl Looks {
    fn of(draft: &Draft, picture: &Arc<DecodedPicture>) -> Self {
        let mut tour = draft.tour.clone();
        let movers = tour.movers();
        (tour.wind, tour.waves, tour.path) = Default::default();
        tour.objects.iter_mut().for_each(|object| object.motion = Motion::Static);
        if let Some(sky) = &mut tour.sky {
            sky.drift = None;
        }
        let masks = draft.masks.iter().map(|(_, mask)| Arc::downgrade(mask)).collect();
        Self { tour, movers, masks, picture: Arc::clone(picture) }
    }
}

impl PartialEq for Looks {
    fn eq(&self, other: &Self) -> bool {
        let same_masks = self.masks.len() == other.masks.len()
            && self.masks.iter().zip(&other.masks).all(|(a, b)| Weak::ptr_eq(a, b));
        let same_movers = self.movers == other.movers;
        same_masks && same_movers && Arc::ptr_eq(&self.picture, &other.picture) && self.tour == other.tour
    }
}

/// What is to be shown of the draft.
#[derive(Debug)]
pub(super) enum News {
    /// Its planes, while it is being changed.
    Placed(Arc<PlacedTour>),
    /// What moves in it; it looks as it did.
    Moving(Arc<TourSource>),
    /// All of it.
    Whole(Arc<TourSource>),
}

/// The check at work, and when the draft changed last.
#[derive(Debug, Default)]
pub(super) struct Checking {
    running: Option<Task<Checked>>,
    seen: Option<u64>,
    changed_at: f64,
    shown: Option<u64>,
    /// What all that is shown looks like; `None` while its planes are where newer marks put them.
    looks: Option<Looks>,
    /// Recordings that were read, and what they are of.
    recorded: Arc<Mutex<Option<(Recorded, Recordings)>>>,
}

impl Session {
    /// Whether the draft is being checked, or what is shown is older than it.
    pub(super) fn is_checking(&self) -> bool {
        let Some(desk) = &self.desk else { return false };
        self.checking.running.is_some() || self.checking.shown != Some(desk.history().revision())
    }

    /// Keeps the check up to date; gives its planes when it is new, and all of it once nobody has changed it for a moment.
    pub(super) fn check(&mut self, now: f64) -> Option<News> {
        let desk = self.desk.as_ref()?;
        let revision = desk.history().revision();
        let checking = &mut self.checking;
        if checking.seen != Some(revision) {
            (checking.seen, checking.changed_at) = (Some(revision), now);
        }
        let mut news = None;
        if let Some(done) = checking.running.as_mut().and_then(check_ready) {
            checking.running = None;
            if checking.shown.is_some() && done.looks != checking.looks {
                news = done.placed.clone().map(News::Placed);
                // Also what is taken back is to be shown anew: its planes are elsewhere now.
                checking.looks = None;
            }
            self.checked = done;
        }
        let wanted = (revision, desk.picture().is_some());
        let is_old = self.checked.of != Some(wanted);
        if is_old && checking.running.is_none() {
            let (draft, picture) = (desk.draft().clone(), desk.picture().cloned());
            let folder = desk.path().parent().unwrap_or(Path::new("")).to_owned();
            let recorded = RecordedFiles { folder, read: Arc::clone(&checking.recorded) };
            checking.running = Some(begin(move || {
                let of = Some(wanted);
                Checked { of, ..checked(&draft, picture.as_ref(), &recorded) }
            }));
        }
        let is_quiet = now - checking.changed_at >= QUIET_SECONDS && !desk.history().in_gesture();
        if is_old || !is_quiet || checking.shown == Some(revision) {
            return news;
        }
        checking.shown = Some(revision);
        let source = self.checked.source.clone()?;
        let same = checking.looks.is_some() && self.checked.looks == checking.looks;
        checking.looks.clone_from(&self.checked.looks);
        Some(if same { News::Moving(source) } else { News::Whole(source) })
    }
}

/// Checks, solves and places a draft.
fn checked(draft: &Draft, picture: Option<&Arc<DecodedPicture>>, recorded: &RecordedFiles) -> Checked {
    let mut checked = Checked::default();
    let tour = match Tour::check(draft.tour.clone()) {
        Ok(tour) => tour,
        Err(problems) => {
            checked.problems = problems.0;
            return checked;
        }
    };
    let Some(picture) = picture else { return checked };
    let source =
        TourSource::of(&tour, DecodedPicture::clone(picture), &|place, file| mask_of(draft, place, file));
    match source.and_then(|source| Ok(TourSource { recordings: recorded.of(&tour)?, ..source })) {
        Ok(source) => {
            let (solved, placed) = match place(&source) {
                Ok(placed) => (Ok(placed.solution.clone()), Some(Arc::new(placed))),
                Err(error) => (Err(error), None),
            };
            checked.solved = Some(solved.map(|solution| in_document(solution, &tour, &source)));
            checked.placed = placed;
            checked.source = Some(Arc::new(source));
            checked.looks = Some(Looks::of(draft, picture));
        }
        Err(problems) => checked.problems = problems.0,
    }
    checked
}

/// The files of recorded water and bodies, read once.
#[derive(Clone, Debug)]
struct RecordedFiles {
    folder: PathBuf,
    read: Arc<Mutex<Option<(Recorded, Recordings)>>>,
}

/// What of a tour is recorded.
type Recorded = (PathBuf, Sea, Vec<Motion>);

impl RecordedFiles {
    fn of(&self, tour: &Tour) -> Result<Recordings, Problems> {
        let motions = tour.objects.iter().map(|object| &object.motion);
        let motions = motions.filter(|motion| matches!(motion, Motion::Recorded(_))).cloned().collect();
        let wanted = (self.folder.clone(), tour.waves.sea.clone(), motions);
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        match &*read {
            Some((recorded, recordings)) if *recorded == wanted => Ok(recordings.clone()),
            _ => {
                let recordings = Recordings::read(tour, &|file| read_beside(&self.folder, file))?;
                *read = Some((wanted, recordings.clone()));
                Ok(recordings)
            }
        }
    }
}

fn mask_of(draft: &Draft, place: &str, file: &RelativePath) -> Result<Mask, Box<Problem>> {
    let missing = || {
        let advice = "draw the region anew, or put the mask's file back";
        Box::new(Problem::new(place, format!("\"{file}\""), "the mask is not there", advice))
    };
    draft.masks.get(file.as_str()).map(|mask| (**mask).clone()).ok_or_else(missing)
}

/// The solution in the document's pixels: those of the whole picture, at the size that its numbers refer to.
fn in_document(mut solution: Solution, tour: &Tour, source: &TourSource) -> Solution {
    let actual = source.uncropped_size;
    let crop = tour.crop_in(actual);
    let corner = DVec2::new(f64::from(crop.left), f64::from(crop.top));
    let scale = tour.picture.size.map_or(1.0, |size| f64::from(size.x) / f64::from(actual.x));
    let parameters = &mut solution.parameters;
    parameters.principal = PicturePoint((parameters.principal.0 + corner) * scale);
    parameters.focal_px *= scale;
    solution
}
