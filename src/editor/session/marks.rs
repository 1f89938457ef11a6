//! Marks that the machine helps to make: regions grown and refined, strokes painted, ways along edges, whole drafts.

use std::sync::Arc;

use glam::UVec2;

use super::Session;
use super::job::Finish;
use crate::assemble::{DraftedTour, draft_tour};
use crate::editor::{BrushStroke, Ghost, Step, SuggestWhat, Suggestion};
use crate::picture::{DecodedPicture, Mask, Picture, PicturePoint};
use crate::suggest::outline::{
    Brush, BrushMode, GrowBound, GrowOptions, LiveWire, MaskCanvas, ObjectHints, Side, Stroke, contact_line,
    grab_cut, grow, simplified,
};
use crate::suggest::{Part, Remark};
use crate::tour::edit::{Edit, MaskPatch, PackedMask, RegionAt};
use crate::tour::{Motion, Region, RelativePath};

/// How far a traced way may be simplified, picture pixels.
const TRACE_TOLERANCE: f64 = 1.5;

/// The way along edges that is being traced.
#[derive(Debug, Default)]
pub(super) struct Tracing {
    /// Prepared for a picture.
    wire: Option<LiveWire>,
    anchor: Option<PicturePoint>,
    pub(super) way: Vec<PicturePoint>,
}

/// How many outlines that were found are remembered together with what was said.
const OUTLINES: usize = 32;

/// What was said about an object's outline, and what was found: of use while the object has that outline, or has it again.
#[derive(Clone, Debug)]
pub(super) struct Outlining {
    object: usize,
    corners: Option<[PicturePoint; 2]>,
    strokes: Vec<Stroke>,
    /// The outline before the first stroke, where no box began.
    earlier: Option<Mask>,
    found: PackedMask,
}

impl Session {
    fn picture(&self) -> Option<Arc<DecodedPicture>> {
        self.desk.as_ref()?.picture().cloned()
    }

    /// Pixels of the picture's file per pixel of the document.
    fn scale(&self, picture: &Picture) -> f64 {
        let marked = self.desk.as_ref().and_then(|desk| desk.tour().picture.size);
        marked.map_or(1.0, |size| f64::from(picture.size().x) / f64::from(size.x.max(1)))
    }

    /// The mask that a region is, drawn from its polygon if it is one.
    fn mask_of(&self, at: RegionAt, size: UVec2, scale: f64) -> Option<Mask> {
        let desk = self.desk.as_ref()?;
        match at.get(desk.tour())? {
            Region::Mask(name) => desk.draft().masks.get(name).map(|mask| (**mask).clone()),
            Region::Polygon(corners) => {
                let corners: Vec<PicturePoint> =
                    corners.iter().map(|corner| PicturePoint(corner.0 * scale)).collect();
                Mask::from_polygon(size, &corners).ok()
            }
        }
    }

    /// What a region's mask is called.
    fn name_of(&self, at: RegionAt) -> String {
        let Some(desk) = &self.desk else { return String::new() };
        if let Some(Region::Mask(name)) = at.get(desk.tour()) {
            return name.clone();
        }
        let tour = desk.tour();
        let of = match at {
            RegionAt::Water => "water",
            RegionAt::Ground => "ground",
            RegionAt::Sky => "sky",
            RegionAt::Band(index) => tour.background.bands.get(index).map_or("band", |band| &band.name),
            RegionAt::Object(index) => tour.objects.get(index).map_or("object", |object| &object.name),
        };
        desk.free_mask_name(of)
    }

    /// Sets a region to a mask.
    fn set_mask(&mut self, at: RegionAt, mask: &Mask) {
        let name = self.name_of(at);
        let region = Some(Region::Mask(name.clone()));
        self.edit(&Edit::Many(vec![
            Edit::Mask { name, mask: Some(PackedMask::new(mask)) },
            Edit::Region { at, region },
        ]));
    }

    /// Grows a region from a stroke, and sets it; what was there before stays in it.
    pub(super) fn grow_region(&mut self, at: RegionAt, stroke: &BrushStroke) {
        let Some(picture) = self.picture() else { return };
        let scale = self.scale(&picture.picture);
        let (stroke, bound) = (scaled(stroke, scale), self.bound_of(at, scale));
        let earlier = self.mask_of(at, picture.picture.size(), scale);
        let title = self.studio.language.text().work.growing;
        self.start(title, move |_| {
            let options = GrowOptions { tolerance: 1.0, bound };
            let grown = grow(&picture.picture, &stroke, options);
            Box::new(move |session: &mut Self| match grown {
                Ok(grown) => {
                    let mask = joined(earlier, &grown, stroke.side);
                    session.set_mask(at, &mask);
                }
                Err(error) => session.fail(&error),
            })
        });
    }

    /// The side of the horizon that a region stays on.
    fn bound_of(&self, at: RegionAt, scale: f64) -> Option<GrowBound> {
        let line = self.desk.as_ref()?.tour().camera.horizon?.map(|end| PicturePoint(end.0 * scale));
        match at {
            RegionAt::Water | RegionAt::Ground => Some(GrowBound { line, is_above: false }),
            RegionAt::Sky => Some(GrowBound { line, is_above: true }),
            RegionAt::Band(_) | RegionAt::Object(_) => None,
        }
    }

    /// Finds an object's outline in a box or by one more stroke, and sets it.
    pub(super) fn refine(
        &mut self,
        object: usize,
        corners: Option<[PicturePoint; 2]>,
        stroke: Option<&BrushStroke>,
    ) {
        let Some(picture) = self.picture() else { return };
        let (scale, size) = (self.scale(&picture.picture), picture.picture.size());
        let at = RegionAt::Object(object);
        let boxed = corners.map(|corners| corners.map(|corner| PicturePoint(corner.0 * scale)));
        let drawn = stroke.map(|stroke| scaled(stroke, scale));
        // A box begins anew; a stroke is one more of those before it, unless the outline is another by now.
        let mask = if boxed.is_some() { None } else { self.mask_of(at, size, scale) };
        let packed = mask.as_ref().map(PackedMask::new);
        let is_same = |before: &&Outlining| before.object == object && packed.as_ref() == Some(&before.found);
        let (corners, mut strokes, earlier) = match self.outlinings.iter().rev().find(is_same) {
            Some(before) => (before.corners, before.strokes.clone(), before.earlier.clone()),
            None => (boxed, Vec::new(), mask),
        };
        strokes.extend(drawn);
        let motion = self.desk.as_ref().and_then(|desk| desk.tour().objects.get(object)).map(|o| &o.motion);
        let is_solid = !matches!(motion, Some(Motion::Sway(_)));
        let title = self.studio.language.text().work.outlining;
        self.start(title, move |progress| {
            let hints = ObjectHints { corners, strokes: &strokes, earlier: earlier.as_ref(), is_solid };
            let cut = grab_cut(&picture.picture, &hints, &|share, _| progress.at(share));
            Box::new(move |session: &mut Self| match cut {
                Ok(cut) => {
                    session.set_mask(at, &cut.mask);
                    if boxed.is_some() {
                        session.set_contact(object, &cut.mask, scale);
                    }
                    let found = PackedMask::new(&cut.mask);
                    session.outlinings.push_back(Outlining { object, corners, strokes, earlier, found });
                    if session.outlinings.len() > OUTLINES {
                        session.outlinings.pop_front();
                    }
                }
                Err(error) => session.fail(&error),
            })
        });
    }

    fn set_contact(&mut self, object: usize, mask: &Mask, scale: f64) {
        if let Some(line) = contact_line(mask) {
            let contact = line.feet.map(|foot| PicturePoint(foot.0 / scale));
            self.edit(&Edit::Contact { object, contact });
        }
    }

    /// Paints a piece of a stroke on a region's mask; a polygon becomes a mask first.
    pub(super) fn paint(&mut self, at: RegionAt, stroke: &BrushStroke, hardness: f64) {
        let Some(picture) = self.picture() else { return };
        let (scale, size) = (self.scale(&picture.picture), picture.picture.size());
        let drawn = self.desk.as_ref().and_then(|desk| at.get(desk.tour()));
        if !matches!(drawn, Some(Region::Mask(_))) {
            let mask = self
                .mask_of(at, size, scale)
                .or_else(|| Mask::new(size, vec![0; picture.picture.pixels().len()]).ok());
            if let Some(mask) = mask {
                self.set_mask(at, &mask);
            }
        }
        let (name, Some(mask)) = (self.name_of(at), self.mask_of(at, size, scale)) else { return };
        let stroke = scaled(stroke, scale);
        let mode = if stroke.side == Side::Inside { BrushMode::Paint } else { BrushMode::Erase };
        let mut canvas = MaskCanvas::new(&mask);
        let Some(changed) = canvas.draw(&Brush { radius: stroke.radius, hardness, mode }, &stroke.points)
        else {
            return;
        };
        if let Some(patch) = MaskPatch::of(&canvas.mask(), changed.rect()) {
            self.edit(&Edit::Paint { name, patch });
        }
    }

    /// Looks for the way along edges between two points.
    pub(super) fn trace(&mut self, from: PicturePoint, to: PicturePoint) {
        let Some(picture) = self.picture() else { return };
        let scale = self.scale(&picture.picture);
        let wire = self.tracing.wire.get_or_insert_with(|| LiveWire::new(&picture.picture));
        if self.tracing.anchor != Some(from) {
            wire.anchor(PicturePoint(from.0 * scale));
            self.tracing.anchor = Some(from);
        }
        let way = wire.path_to(PicturePoint(to.0 * scale));
        self.tracing.way = simplified(&way, TRACE_TOLERANCE)
            .into_iter()
            .map(|point| PicturePoint(point.0 / scale))
            .collect();
    }

    /// Forgets what was prepared for another picture.
    pub(super) fn forget_picture(&mut self) {
        self.tracing = Tracing::default();
        self.outlinings.clear();
    }

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

    /// Drafts the tour of a picture that was just opened, and takes the draft: one step, to be undone.
    pub(super) fn begin_with_a_draft(&mut self) {
        let Some(picture) = self.picture() else { return };
        self.draft(picture, |session, drafted| {
            session.edit(&Edit::Many(edits_of(&drafted, |_| true)));
            let words = session.studio.language.text().work;
            session.tell(words.drafted, words.drafted_advice);
            session.studio.go_to(Step::Horizon);
        });
    }

    fn draft(
        &mut self,
        picture: Arc<DecodedPicture>,
        then: impl FnOnce(&mut Self, DraftedTour) + Send + 'static,
    ) {
        let Some(desk) = &self.desk else { return };
        let file = desk.tour().picture.file.clone();
        let folder = desk.free_mask_name("draft").replace(".png", "");
        let title = self.studio.language.text().work.looking;
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
        let mut nothing = true;
        for (part, step, _) in parts.into_iter().filter(|(.., kind)| asked(*kind)) {
            let edits = edits_of(drafted, |other| other == part);
            let Some(remark) = drafted.trust.iter().find(|remark| remark.part == part) else { continue };
            if edits.is_empty() {
                continue;
            }
            nothing = false;
            self.suggestions.retain(|old| old.step != step || old.title != part.to_string());
            let suggestion = suggestion(self.new_id(), step, remark, edits, drafted);
            self.suggestions.push(suggestion);
        }
        if nothing {
            let reason =
                drafted.trust.iter().map(|remark| remark.sentence.as_str()).next().unwrap_or_default();
            let words = self.studio.language.text().work;
            let told = format!("{}: {reason}", words.nothing_found);
            self.tell(&told, "");
        }
    }
}

fn suggestion(id: u64, step: Step, remark: &Remark, edits: Vec<Edit>, drafted: &DraftedTour) -> Suggestion {
    let ghosts = match remark.part {
        Part::Horizon => drafted
            .tour
            .camera
            .horizon
            .map(|ends| Ghost::Line { points: ends.into(), closed: false })
            .into_iter()
            .collect(),
        Part::Pairs => {
            let pairs = drafted.tour.water.iter().flat_map(|water| &water.pairs);
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

/// What takes the wanted parts of a draft.
fn edits_of(drafted: &DraftedTour, wanted: impl Fn(Part) -> bool) -> Vec<Edit> {
    let tour = drafted.tour.to_file();
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
    if wanted(Part::Pairs)
        && let Some(water) = tour.water.as_ref().filter(|water| !water.pairs.is_empty())
    {
        let place = |(index, pair): (usize, &crate::tour::ReflectionPair)| {
            Edit::Pairs(crate::tour::edit::ListEdit::Insert(index, pair.clone()))
        };
        edits.extend(water.pairs.iter().enumerate().map(place));
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
    if wanted(Part::Background) {
        for (index, band) in tour.background.bands.iter().enumerate() {
            let mut bare = band.clone();
            bare.region = None;
            edits.push(Edit::Bands(crate::tour::edit::ListEdit::Insert(index, bare)));
            set(&mut edits, RegionAt::Band(index), band.region.as_ref());
        }
        if tour.background.place.is_some() {
            let at = crate::tour::edit::PlaceAt::Background;
            edits.push(Edit::Place { at, place: tour.background.place });
        }
    }
    edits
}

/// A stroke in pixels of the picture's file.
fn scaled(stroke: &BrushStroke, scale: f64) -> Stroke {
    let points: Vec<PicturePoint> = stroke.points.iter().map(|point| PicturePoint(point.0 * scale)).collect();
    let side = if stroke.inside { Side::Inside } else { Side::Outside };
    Stroke { points, radius: stroke.radius * scale, side }
}

/// A region with what was grown: added, or taken away.
fn joined(earlier: Option<Mask>, grown: &Mask, side: Side) -> Mask {
    let Some(earlier) = earlier.filter(|earlier| earlier.size() == grown.size()) else {
        return grown.clone();
    };
    let both = earlier.values().iter().zip(grown.values()).map(|(&old, &new)| match side {
        Side::Inside => old.max(new),
        Side::Outside => old.min(255 - new),
    });
    // As many as before.
    Mask::new(grown.size(), both.collect()).unwrap_or(earlier)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_grown_is_added_or_taken_away() {
        let size = UVec2::new(2, 1);
        let [old, new] = [[200, 0], [100, 255]].map(|values| Mask::new(size, values.into()).unwrap());
        assert_eq!(joined(Some(old.clone()), &new, Side::Inside).values(), [200, 255]);
        assert_eq!(joined(Some(old), &new, Side::Outside).values(), [155, 0]);
        assert_eq!(joined(None, &new, Side::Inside).values(), [100, 255]);
    }

    #[test]
    fn strokes_come_in_the_file_s_pixels() {
        let stroke = BrushStroke { points: vec![PicturePoint::new(3.0, 4.0)], radius: 2.0, inside: false };
        let found = scaled(&stroke, 2.0);
        assert_eq!(
            (found.points[0].0, found.radius, found.side),
            (glam::DVec2::new(6.0, 8.0), 4.0, Side::Outside)
        );
    }
}
