//! Outlines found in a box, grown from a stroke and mended by more of them: each begins with what was said before.

use super::Session;
use super::job::Job;
use super::marks::scaled;
use crate::editor::BrushStroke;
use crate::picture::{Mask, PicturePoint};
use crate::suggest::outline::{Bound, GrowOptions, ObjectHints, Side, Stroke, grab_cut, grow};
use crate::tour::edit::{PackedMask, RegionAt};
use crate::tour::{Motion, TourFile};

/// How many outlines that were found are remembered together with what was said.
const OUTLINES: usize = 32;

/// What has an outline: bands and objects by name, since their numbers may change meanwhile.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Owner {
    Water,
    Ground,
    Sky,
    Band(String),
    Object(String),
}

/// An outline that is to be found.
#[derive(Debug)]
pub(super) struct Refinement {
    owner: Owner,
    corners: Option<[PicturePoint; 2]>,
    stroke: Option<BrushStroke>,
}

/// What was said about an outline, and what was found: of use while the owner has that outline, or has it again.
#[derive(Clone, Debug)]
pub(super) struct Outlining {
    owner: Owner,
    corners: Option<[PicturePoint; 2]>,
    strokes: Vec<Stroke>,
    /// The outline before the first stroke of a cut, where no box began.
    earlier: Option<Mask>,
    found: PackedMask,
}

impl Owner {
    fn of(at: RegionAt, tour: &TourFile) -> Option<Self> {
        Some(match at {
            RegionAt::Water => Self::Water,
            RegionAt::Ground => Self::Ground,
            RegionAt::Sky => Self::Sky,
            RegionAt::Band(index) => Self::Band(tour.background.bands.get(index)?.name.clone()),
            RegionAt::Object(index) => Self::Object(tour.objects.get(index)?.name.clone()),
        })
    }

    /// Where it is by now.
    fn place(&self, tour: &TourFile) -> Option<RegionAt> {
        match self {
            Self::Water => Some(RegionAt::Water),
            Self::Ground => Some(RegionAt::Ground),
            Self::Sky => Some(RegionAt::Sky),
            Self::Band(name) => {
                tour.background.bands.iter().position(|band| band.name == *name).map(RegionAt::Band)
            }
            Self::Object(name) => {
                tour.objects.iter().position(|object| object.name == *name).map(RegionAt::Object)
            }
        }
    }

    /// Whether it is grown while strokes say only where it is: a region is of one matter, an object of several.
    fn is_grown_from(&self, strokes: &[Stroke]) -> bool {
        !matches!(self, Self::Object(_)) && strokes.iter().all(|stroke| stroke.side == Side::Inside)
    }
}

impl Session {
    /// Finds an outline in a box or by one more stroke, and sets it.
    pub(super) fn refine(
        &mut self,
        at: RegionAt,
        corners: Option<[PicturePoint; 2]>,
        stroke: Option<BrushStroke>,
    ) {
        if let Some(owner) = self.desk.as_ref().and_then(|desk| Owner::of(at, desk.tour())) {
            self.later.push_back(Refinement { owner, corners, stroke });
            self.refine_next();
        }
    }

    /// Begins with the next outline that waits, unless one is being found.
    pub(super) fn refine_next(&mut self) {
        if self.jobs.iter().any(Job::is_refinement) {
            return;
        }
        let (Some(picture), Some(refinement)) = (self.picture(), self.later.pop_front()) else { return };
        let Refinement { owner, corners, stroke } = refinement;
        let Some(at) = self.place_of(&owner) else { return self.refine_next() };
        let (scale, size) = (self.scale(&picture.picture), picture.picture.size());
        let boxed = corners.map(|corners| corners.map(|corner| PicturePoint(corner.0 * scale)));
        let drawn = stroke.map(|stroke| scaled(&stroke, scale));
        // A box begins anew; a stroke is one more of those before it, unless the outline is another by now.
        let mask = if boxed.is_some() { None } else { self.mask_of(at, size, scale) };
        let packed = mask.as_ref().map(PackedMask::new);
        let is_same = |before: &&Outlining| before.owner == owner && packed.as_ref() == Some(&before.found);
        let (corners, mut strokes, earlier) = match self.outlinings.iter().rev().find(is_same) {
            Some(before) if owner.is_grown_from(&before.strokes) => (None, before.strokes.clone(), mask),
            Some(before) => (before.corners, before.strokes.clone(), before.earlier.clone()),
            None => (boxed, Vec::new(), mask),
        };
        strokes.extend(drawn);
        let bound = self.bound_of(at, scale);
        let motion = self.desk.as_ref().and_then(|desk| match at {
            RegionAt::Object(object) => desk.tour().objects.get(object).map(|object| &object.motion),
            _ => None,
        });
        let is_solid = motion.is_some_and(|motion| !matches!(motion, Motion::Sway(_)));
        let words = self.studio.language.text().session;
        let is_grown = owner.is_grown_from(&strokes);
        self.start(if is_grown { words.growing } else { words.outlining }, move |progress| {
            let hints =
                ObjectHints { corners, strokes: &strokes, earlier: earlier.as_ref(), is_solid, bound };
            let found = match strokes.last().filter(|_| is_grown) {
                Some(stroke) => grow(&picture.picture, stroke, GrowOptions { bound, ..Default::default() })
                    .map(|grown| joined(earlier.as_ref(), grown)),
                None => {
                    grab_cut(&picture.picture, &hints, &|share, _| progress.at(share)).map(|cut| cut.mask)
                }
            };
            Box::new(move |session: &mut Self| {
                let Some(at) = session.place_of(&owner) else { return };
                match found {
                    Ok(mask) => {
                        session.set_mask(at, &mask);
                        if let (RegionAt::Object(object), Some(_)) = (at, boxed) {
                            session.set_contact(object, &mask, scale);
                        }
                        let found = PackedMask::new(&mask);
                        session.outlinings.push_back(Outlining { owner, corners, strokes, earlier, found });
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

    fn place_of(&self, owner: &Owner) -> Option<RegionAt> {
        owner.place(self.desk.as_ref()?.tour())
    }

    /// The side of the horizon that a region stays on.
    fn bound_of(&self, at: RegionAt, scale: f64) -> Option<Bound> {
        let line = self.desk.as_ref()?.tour().camera.horizon?.map(|end| PicturePoint(end.0 * scale));
        match at {
            RegionAt::Water | RegionAt::Ground => Some(Bound { line, is_above: false }),
            RegionAt::Sky => Some(Bound { line, is_above: true }),
            RegionAt::Band(_) | RegionAt::Object(_) => None,
        }
    }
}

/// A region with what was grown.
fn joined(earlier: Option<&Mask>, grown: Mask) -> Mask {
    let Some(earlier) = earlier.filter(|earlier| earlier.size() == grown.size()) else { return grown };
    let both = earlier.values().iter().zip(grown.values()).map(|(&old, &new)| old.max(new));
    // As many as before.
    Mask::new(grown.size(), both.collect()).unwrap_or(grown)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec2;

    #[test]
    fn what_is_grown_is_added() {
        let size = UVec2::new(2, 1);
        let [old, new] = [[200, 0], [100, 255]].map(|values| Mask::new(size, values.into()).unwrap());
        assert_eq!(joined(Some(&old), new.clone()).values(), [200, 255]);
        assert_eq!(joined(None, new).values(), [100, 255]);
    }

    #[test]
    fn a_region_is_cut_once_a_stroke_says_what_it_is_not() {
        let on = Stroke::inside(vec![PicturePoint::new(1.0, 1.0)], 1.0);
        let beside = Stroke::outside(vec![PicturePoint::new(9.0, 9.0)], 1.0);
        assert!(Owner::Water.is_grown_from(&[on.clone(), on.clone()]));
        assert!(!Owner::Water.is_grown_from(&[on.clone(), beside, on.clone()]));
        assert!(!Owner::Object("boat".into()).is_grown_from(&[on]));
    }
}
