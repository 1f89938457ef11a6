//! Outlines found in a box and mended by strokes, one after the other: each begins with what was said before.

use super::Session;
use super::job::Job;
use super::marks::scaled;
use crate::editor::BrushStroke;
use crate::picture::{Mask, PicturePoint};
use crate::suggest::outline::{ObjectHints, Stroke, grab_cut};
use crate::tour::Motion;
use crate::tour::edit::{PackedMask, RegionAt};

/// How many outlines that were found are remembered together with what was said.
const OUTLINES: usize = 32;

/// An outline that is to be found.
#[derive(Debug)]
pub(super) struct Refinement {
    /// The object's name.
    object: String,
    corners: Option<[PicturePoint; 2]>,
    stroke: Option<BrushStroke>,
}

/// What was said about an object's outline, and what was found: of use while the object has that outline, or has it again.
#[derive(Clone, Debug)]
pub(super) struct Outlining {
    /// The object's name.
    object: String,
    corners: Option<[PicturePoint; 2]>,
    strokes: Vec<Stroke>,
    /// The outline before the first stroke, where no box began.
    earlier: Option<Mask>,
    found: PackedMask,
}

impl Session {
    /// Finds an object's outline in a box or by one more stroke, and sets it.
    pub(super) fn refine(
        &mut self,
        object: usize,
        corners: Option<[PicturePoint; 2]>,
        stroke: Option<BrushStroke>,
    ) {
        let named = self.desk.as_ref().and_then(|desk| desk.tour().objects.get(object));
        if let Some(object) = named.map(|object| object.name.clone()) {
            self.later.push_back(Refinement { object, corners, stroke });
            self.refine_next();
        }
    }

    /// Begins with the next outline that waits, unless one is being found.
    pub(super) fn refine_next(&mut self) {
        if self.jobs.iter().any(Job::is_refinement) {
            return;
        }
        let (Some(picture), Some(refinement)) = (self.picture(), self.later.pop_front()) else { return };
        let Refinement { object: name, corners, stroke } = refinement;
        let Some(object) = self.object_of(&name) else { return self.refine_next() };
        let (scale, size) = (self.scale(&picture.picture), picture.picture.size());
        let boxed = corners.map(|corners| corners.map(|corner| PicturePoint(corner.0 * scale)));
        let drawn = stroke.map(|stroke| scaled(&stroke, scale));
        // A box begins anew; a stroke is one more of those before it, unless the outline is another by now.
        let mask = if boxed.is_some() { None } else { self.mask_of(RegionAt::Object(object), size, scale) };
        let packed = mask.as_ref().map(PackedMask::new);
        let is_same = |before: &&Outlining| before.object == name && packed.as_ref() == Some(&before.found);
        let (corners, mut strokes, earlier) = match self.outlinings.iter().rev().find(is_same) {
            Some(before) => (before.corners, before.strokes.clone(), before.earlier.clone()),
            None => (boxed, Vec::new(), mask),
        };
        strokes.extend(drawn);
        let motion = self.desk.as_ref().and_then(|desk| desk.tour().objects.get(object)).map(|o| &o.motion);
        let is_solid = !matches!(motion, Some(Motion::Sway(_)));
        let title = self.studio.language.text().session.outlining;
        self.start(title, move |progress| {
            let hints = ObjectHints { corners, strokes: &strokes, earlier: earlier.as_ref(), is_solid };
            let cut = grab_cut(&picture.picture, &hints, &|share, _| progress.at(share));
            Box::new(move |session: &mut Self| {
                let Some(object) = session.object_of(&name) else { return };
                match cut {
                    Ok(cut) => {
                        session.set_mask(RegionAt::Object(object), &cut.mask);
                        if boxed.is_some() {
                            session.set_contact(object, &cut.mask, scale);
                        }
                        let found = PackedMask::new(&cut.mask);
                        let outlining = Outlining { object: name, corners, strokes, earlier, found };
                        session.outlinings.push_back(outlining);
                        if session.outlinings.len() > OUTLINES {
                            session.outlinings.pop_front();
                        }
                    }
                    Err(error) => session.fail(&error),
                }
            })
        });
        if let Some(job) = self.jobs.last_mut() {
            job.mark_refinement();
        }
    }

    /// The number that an object has now.
    fn object_of(&self, name: &str) -> Option<usize> {
        self.desk.as_ref()?.tour().objects.iter().position(|object| object.name == name)
    }
}
