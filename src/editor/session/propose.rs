//! What the machine proposes: the first draft of a picture that was just opened, and suggestions when asked.
//!
//! A draft is in pixels of the picture's file; what comes to the desk is in the document's.

use std::sync::Arc;

use super::Session;
use super::job::Finish;
use crate::assemble::{DraftedTour, draft_tour};
use crate::editor::{Ghost, Step, SuggestWhat, Suggestion};
use crate::picture::DecodedPicture;
use crate::suggest::{Part, Remark};
use crate::tour::edit::{Edit, ListEdit, PackedMask, PlaceAt, RegionAt};
use crate::tour::{ReflectionPair, Region, RelativePath, TourFile};

/// Pairs whose points are nearer to each other's than this are the same, pixels of the document.
const SAME_PAIR: f64 = 3.0;

impl Session {
    /// Lets the machine propose: all at once, or a part of it.
    pub(super) fn suggest(&mut self, what: SuggestWhat) {
        let Some(picture) = self.picture() else { return };
        if let SuggestWhat::Contact(object) = what {
            let (scale, size) = (self.scale(&picture.picture), picture.picture.size());
            if let Some(mask) = self.mask_of(RegionAt::Object(object), size, scale) {
                self.set_contact(object, &mask, scale);
            }
            return;
        }
        self.draft(picture, move |session, drafted| session.propose(&drafted, what));
    }

    /// Drafts the tour of a picture that was just opened, and takes the draft: one step, to be undone. Whoever has marked
    /// something meanwhile is asked.
    pub(super) fn begin_with_a_draft(&mut self) {
        let (Some(picture), Some(desk)) = (self.picture(), &self.desk) else { return };
        let revision = desk.history().revision();
        self.draft(picture, move |session, drafted| {
            let Some(desk) = &session.desk else { return };
            if desk.history().revision() != revision {
                return session.propose(&drafted, SuggestWhat::Everything);
            }
            let edits = edits_of(&in_document(&drafted, desk.tour()), &drafted, desk.tour(), |_| true);
            session.edit(&Edit::Many(edits));
            let words = session.studio.language.text().session;
            session.tell(words.drafted, words.drafted_advice);
            if !session.studio.canvas.is_busy() {
                session.studio.go_to(Step::Horizon);
            }
        });
    }

    fn draft(
        &mut self,
        picture: Arc<DecodedPicture>,
        then: impl FnOnce(&mut Self, DraftedTour) + Send + 'static,
    ) {
        let Some(desk) = &self.desk else { return };
        let file = desk.tour().picture.file.clone();
        let folder = desk.free_mask_folder("draft");
        let title = self.studio.language.text().session.looking;
        self.start(title, move |progress| -> Finish {
            let folder = match RelativePath::new(&folder) {
                Ok(folder) => folder,
                Err(error) => return Box::new(move |session: &mut Self| session.fail(&error)),
            };
            let doing = |share: f32, step: &str| progress.doing(share, step);
            let drafted = draft_tour(&picture.picture, picture.lens, file, &folder, &doing);
            Box::new(move |session: &mut Self| match drafted {
                Ok(drafted) => then(session, drafted),
                Err(error) => session.fail(&error),
            })
        });
    }

    /// Shows parts of a draft as suggestions.
    fn propose(&mut self, drafted: &DraftedTour, what: SuggestWhat) {
        let asked = |kind: SuggestWhat| what == SuggestWhat::Everything || what == kind;
        let parts = [
            (Part::Horizon, Step::Horizon, SuggestWhat::Horizon),
            (Part::Water, Step::Water, SuggestWhat::Regions),
            (Part::Sky, Step::Ground, SuggestWhat::Regions),
            (Part::Ground, Step::Ground, SuggestWhat::Regions),
            (Part::Background, Step::Ground, SuggestWhat::Regions),
            (Part::Pairs, Step::Pairs, SuggestWhat::Pairs),
        ];
        let Some(there) = self.desk.as_ref().map(|desk| desk.tour().clone()) else { return };
        let tour = in_document(drafted, &there);
        let mut nothing = true;
        for (part, step, _) in parts.into_iter().filter(|(.., kind)| asked(*kind)) {
            let edits = edits_of(&tour, drafted, &there, |other| other == part);
            let Some(remark) = drafted.trust.iter().find(|remark| remark.part == part) else { continue };
            if edits.is_empty() {
                continue;
            }
            nothing = false;
            self.suggestions.retain(|old| old.step != step || old.title != part.to_string());
            let suggestion = suggestion(self.new_id(), step, remark, edits, &tour);
            self.suggestions.push(suggestion);
        }
        if nothing {
            let reason =
                drafted.trust.iter().map(|remark| remark.sentence.as_str()).next().unwrap_or_default();
            let words = self.studio.language.text().session;
            let told = format!("{}: {reason}", words.nothing_found);
            self.tell(&told, "");
        }
    }
}

/// A draft in the document's pixels.
fn in_document(drafted: &DraftedTour, there: &TourFile) -> TourFile {
    match there.picture.size {
        Some(size) => drafted.tour.scaled_to(size).to_file(),
        None => drafted.tour.to_file(),
    }
}

fn suggestion(id: u64, step: Step, remark: &Remark, edits: Vec<Edit>, tour: &TourFile) -> Suggestion {
    let ghosts = match remark.part {
        Part::Horizon => {
            let line = |ends: [_; 2]| Ghost::Line { points: ends.into(), closed: false };
            tour.camera.horizon.map(line).into_iter().collect()
        }
        Part::Pairs => {
            let pairs = tour.water.iter().flat_map(|water| &water.pairs);
            pairs.map(|pair| Ghost::Pair(pair.point, pair.reflection)).collect()
        }
        _ => Vec::new(),
    };
    Suggestion {
        id,
        step,
        title: remark.part.to_string(),
        reason: remark.sentence.clone(),
        confidence: remark.confidence,
        edits,
        ghosts,
    }
}

/// What takes the wanted parts of a draft, whose tour is given in the document's pixels, to a document.
fn edits_of(
    tour: &TourFile,
    drafted: &DraftedTour,
    there: &TourFile,
    wanted: impl Fn(Part) -> bool,
) -> Vec<Edit> {
    let mut edits = Vec::new();
    let set = |edits: &mut Vec<Edit>, at: RegionAt, region: Option<&Region<String>>| {
        let Some(region) = region else { return };
        if let Region::Mask(name) = region
            && let Some((_, mask)) = drafted.masks.iter().find(|(path, _)| path.as_str() == name)
        {
            edits.push(Edit::Mask { name: name.clone(), mask: Some(PackedMask::new(mask)) });
        }
        edits.push(Edit::Region { at, region: Some(region.clone()) });
    };
    if wanted(Part::Horizon) && tour.camera.horizon.is_some() {
        edits.push(Edit::Horizon(tour.camera.horizon));
    }
    if wanted(Part::FocalLength) {
        edits.push(Edit::FocalLength(tour.camera.focal_length));
    }
    if wanted(Part::Water) {
        set(&mut edits, RegionAt::Water, tour.water.as_ref().map(|water| &water.region));
    }
    if wanted(Part::Pairs) {
        let known = there.water.as_ref().map_or(&[][..], |water| &water.pairs);
        let is_known = |pair: &ReflectionPair| {
            let near = |a: crate::picture::PicturePoint, b: crate::picture::PicturePoint| {
                a.0.distance(b.0) < SAME_PAIR
            };
            known.iter().any(|old| near(old.point, pair.point) && near(old.reflection, pair.reflection))
        };
        let found = tour.water.iter().flat_map(|water| &water.pairs).filter(|pair| !is_known(pair));
        let place =
            |(index, pair): (usize, &ReflectionPair)| Edit::Pairs(ListEdit::Insert(index, pair.clone()));
        edits.extend(found.enumerate().map(place));
    }
    if wanted(Part::Sky) {
        set(&mut edits, RegionAt::Sky, tour.sky.as_ref().and_then(|sky| sky.region.as_ref()));
    }
    if wanted(Part::Ground)
        && let Some(ground) = &tour.ground
    {
        set(&mut edits, RegionAt::Ground, Some(&ground.region));
        edits.push(Edit::GroundHeight(ground.height_above_water));
    }
    if wanted(Part::Background) && !tour.background.bands.is_empty() {
        // They replace those that are there, whose names and places they have.
        edits.extend(there.background.bands.iter().map(|_| Edit::Bands(ListEdit::Remove(0))));
        for (index, band) in tour.background.bands.iter().enumerate() {
            let mut bare = band.clone();
            bare.region = None;
            edits.push(Edit::Bands(ListEdit::Insert(index, bare)));
            set(&mut edits, RegionAt::Band(index), band.region.as_ref());
        }
    }
    if wanted(Part::Background) && tour.background.place.is_some() {
        edits.push(Edit::Place { at: PlaceAt::Background, place: tour.background.place.clone() });
    }
    edits
}
