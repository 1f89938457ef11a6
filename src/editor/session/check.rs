//! What the draft amounts to now: its problems, its solution, and the tour that is shown of it.

use std::sync::Arc;

use glam::DVec2;

use bevy::tasks::{AsyncComputeTaskPool, Task, futures::check_ready};

use super::Session;
use crate::assemble::{TourSource, annotations};
use crate::picture::{DecodedPicture, PicturePoint};
use crate::solve::{Solution, SolveError, solve};
use crate::tour::edit::Draft;
use crate::tour::{Problem, RelativePath, Tour};

/// Seconds without an edit after which the tour is built anew.
const QUIET_SECONDS: f64 = 0.35;

/// What is known of a revision of the draft.
#[derive(Debug, Default)]
pub(super) struct Checked {
    pub(super) revision: u64,
    pub(super) problems: Vec<Problem>,
    pub(super) solved: Option<Result<Solution, SolveError>>,
    source: Option<Arc<TourSource>>,
}

/// The check at work, and when the draft changed last.
#[derive(Debug, Default)]
pub(super) struct Checking {
    running: Option<Task<Checked>>,
    seen: Option<u64>,
    changed_at: f64,
    shown: Option<u64>,
}

impl Session {
    /// Keeps the check up to date; gives the tour to be shown when there is another one and nobody is at work.
    pub(super) fn check(&mut self, now: f64) -> Option<Arc<TourSource>> {
        let desk = self.desk.as_ref()?;
        let revision = desk.history().revision();
        let checking = &mut self.checking;
        if checking.seen != Some(revision) {
            (checking.seen, checking.changed_at) = (Some(revision), now);
        }
        if let Some(done) = checking.running.as_mut().and_then(check_ready) {
            checking.running = None;
            self.checked = done;
        }
        let is_old = self.checked.revision != revision || self.checked.is_empty();
        if is_old && checking.running.is_none() {
            let (draft, picture) = (desk.draft().clone(), desk.picture().cloned());
            checking.running = Some(
                AsyncComputeTaskPool::get()
                    .spawn(async move { checked(revision, &draft, picture.as_deref()) }),
            );
        }
        let is_quiet = now - checking.changed_at >= QUIET_SECONDS && !desk.history().in_gesture();
        if is_old || !is_quiet || checking.shown == Some(revision) {
            return None;
        }
        checking.shown = Some(revision);
        self.checked.source.clone()
    }
}

impl Checked {
    fn is_empty(&self) -> bool {
        self.solved.is_none() && self.source.is_none() && self.problems.is_empty()
    }
}

/// Checks and solves a draft.
fn checked(revision: u64, draft: &Draft, picture: Option<&DecodedPicture>) -> Checked {
    let mut checked = Checked { revision, ..Checked::default() };
    let tour = match Tour::check(draft.tour.clone()) {
        Ok(tour) => tour,
        Err(problems) => {
            checked.problems = problems.0;
            return checked;
        }
    };
    let Some(picture) = picture else { return checked };
    match TourSource::of(&tour, picture.clone(), &|place, file| mask_of(draft, place, file)) {
        Ok(source) => {
            checked.solved =
                Some(solve(&annotations(&source)).map(|solution| in_document(solution, &tour, &source)));
            checked.source = Some(Arc::new(source));
        }
        Err(problems) => checked.problems = problems.0,
    }
    checked
}

fn mask_of(draft: &Draft, place: &str, file: &RelativePath) -> Result<crate::picture::Mask, Box<Problem>> {
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
