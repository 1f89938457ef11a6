//! What can be grasped in the picture: each has a place, a name, an edit that moves it and perhaps one that removes it.

use glam::DVec2;

use crate::picture::{Mask, PicturePoint};
use crate::tour::edit::{Edit, LineAt, ListEdit, PlaceAt, PointAt, RegionAt};
use crate::tour::geometry::contains;
use crate::tour::{Motion, Region};

use super::super::text::{Text, with};
use super::super::work::Work;
use super::super::{Step, Studio};

/// Something that can be dragged in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Handle {
    /// A point of the document.
    Mark(PointAt),
    /// A waypoint of a boat, seen on the water: (object, waypoint).
    Waypoint(usize, usize),
}

impl Handle {
    /// Where it is in the picture; `None` when it is not there (any more).
    pub(crate) fn at(self, work: &Work<'_>) -> Option<PicturePoint> {
        match self {
            Self::Mark(point) => point.get(work.tour),
            Self::Waypoint(object, index) => {
                let Motion::Course(course) = &work.tour.objects.get(object)?.motion else { return None };
                work.seen_at(*course.waypoints.get(index)?)
            }
        }
    }

    /// The edit that moves it; `None` where it cannot be, as a waypoint above the horizon.
    pub(crate) fn moved(self, to: PicturePoint, work: &Work<'_>) -> Option<Edit> {
        match self {
            Self::Mark(at) => Some(Edit::MovePoint { at, to }),
            Self::Waypoint(object, index) => {
                let Motion::Course(mut course) = work.tour.objects.get(object)?.motion.clone() else {
                    return None;
                };
                *course.waypoints.get_mut(index)? = work.water_at(to)?;
                Some(Edit::Motion { object, motion: Motion::Course(course) })
            }
        }
    }

    /// The edit that removes it, or what it is part of; `None` for what cannot be without it.
    pub(crate) fn removed(self, work: &Work<'_>) -> Option<Edit> {
        match self {
            Self::Mark(PointAt::Horizon(_)) => Some(Edit::Horizon(None)),
            Self::Mark(PointAt::PrincipalPoint) => Some(Edit::PrincipalPoint(None)),
            Self::Mark(PointAt::Scale(_)) => Some(Edit::Scale(None)),
            Self::Mark(PointAt::Pair(pair) | PointAt::Reflection(pair)) => {
                Some(Edit::Pairs(ListEdit::Remove(pair)))
            }
            Self::Mark(PointAt::On(line, index)) => {
                let fewest = match line {
                    LineAt::Region(_) => 3,
                    LineAt::Place(_) => 2,
                };
                (line.get(work.tour)?.len() > fewest).then_some(Edit::RemovePoint { line, index })
            }
            Self::Mark(PointAt::Foot(..)) => None,
            Self::Mark(PointAt::SwayRoot(object) | PointAt::SwayTip(object)) => {
                let Motion::Sway(mut sway) = work.tour.objects.get(object)?.motion.clone() else {
                    return None;
                };
                if matches!(self, Self::Mark(PointAt::SwayRoot(_))) {
                    sway.root = None;
                } else {
                    sway.tip = None;
                }
                Some(Edit::Motion { object, motion: Motion::Sway(sway) })
            }
            Self::Waypoint(object, index) => {
                let Motion::Course(mut course) = work.tour.objects.get(object)?.motion.clone() else {
                    return None;
                };
                if course.waypoints.len() <= 2 || index >= course.waypoints.len() {
                    return None;
                }
                course.waypoints.remove(index);
                Some(Edit::Motion { object, motion: Motion::Course(course) })
            }
        }
    }

    /// What it is called, as "Horizon, left end".
    pub(crate) fn name(self, work: &Work<'_>) -> String {
        let t = work.text;
        let numbered = |template: &str, index: usize| with(template, index + 1);
        match self {
            Self::Mark(PointAt::Horizon(0)) => t.mark.horizon_left.into(),
            Self::Mark(PointAt::Horizon(_)) => t.mark.horizon_right.into(),
            Self::Mark(PointAt::PrincipalPoint) => t.mark.principal_point.into(),
            Self::Mark(PointAt::Scale(end)) => numbered(t.mark.length_end, end),
            Self::Mark(PointAt::Pair(pair)) => numbered(t.mark.pair_point, pair),
            Self::Mark(PointAt::Reflection(pair)) => numbered(t.mark.pair_reflection, pair),
            Self::Mark(PointAt::On(line, index)) => {
                format!("{}, {}", line_name(line, work), numbered(t.mark.corner, index))
            }
            Self::Mark(PointAt::Foot(object, 0)) => {
                format!("{}, {}", object_name(object, work), t.mark.left_foot)
            }
            Self::Mark(PointAt::Foot(object, _)) => {
                format!("{}, {}", object_name(object, work), t.mark.right_foot)
            }
            Self::Mark(PointAt::SwayRoot(object)) => {
                format!("{}, {}", object_name(object, work), t.mark.sway_root)
            }
            Self::Mark(PointAt::SwayTip(object)) => {
                format!("{}, {}", object_name(object, work), t.mark.sway_tip)
            }
            Self::Waypoint(object, index) => {
                format!("{}, {}", object_name(object, work), numbered(t.mark.waypoint, index))
            }
        }
    }
}

fn object_name<'a>(object: usize, work: &Work<'a>) -> &'a str {
    work.tour.objects.get(object).map_or("", |object| &object.name)
}

fn line_name(line: LineAt, work: &Work<'_>) -> String {
    match line {
        LineAt::Region(at) => region_name(at, work),
        LineAt::Place(PlaceAt::Background) => work.text.mark.background_contact.into(),
        LineAt::Place(PlaceAt::Band(band)) => region_name(RegionAt::Band(band), work),
    }
}

/// What a region is called.
pub(crate) fn region_name(at: RegionAt, work: &Work<'_>) -> String {
    let t: &Text = work.text;
    match at {
        RegionAt::Water => t.mark.water.into(),
        RegionAt::Ground => t.mark.ground.into(),
        RegionAt::Sky => t.mark.sky.into(),
        RegionAt::Band(band) => {
            work.tour.background.bands.get(band).map_or_else(String::new, |band| band.name.clone())
        }
        RegionAt::Object(object) => object_name(object, work).into(),
    }
}

/// Whether a region has any shape.
pub(crate) fn is_drawn(at: RegionAt, work: &Work<'_>) -> bool {
    let region = at.get(work.tour);
    region.is_some_and(|region| !matches!(region, Region::Polygon(corners) if corners.is_empty()))
}

/// The lines with corners that belong to a step.
pub(crate) fn lines(step: Step, object: Option<usize>, work: &Work<'_>) -> Vec<LineAt> {
    let bands = 0..work.tour.background.bands.len();
    match step {
        Step::Horizon | Step::Pairs | Step::Motion => Vec::new(),
        Step::Water => vec![LineAt::Region(RegionAt::Water)],
        Step::Ground => [LineAt::Region(RegionAt::Ground), LineAt::Region(RegionAt::Sky)]
            .into_iter()
            .chain([LineAt::Place(PlaceAt::Background)])
            .chain(bands.clone().map(|band| LineAt::Region(RegionAt::Band(band))))
            .chain(bands.map(|band| LineAt::Place(PlaceAt::Band(band))))
            .collect(),
        Step::Objects => object.map(|object| LineAt::Region(RegionAt::Object(object))).into_iter().collect(),
    }
}

/// The handles that a step shows, each with its place.
pub(crate) fn handles(studio: &Studio, work: &Work<'_>) -> Vec<(Handle, PicturePoint)> {
    let tour = work.tour;
    let mut handles = Vec::new();
    for line in lines(studio.step, studio.object, work) {
        let corners = line.get(tour).map_or(0, <[_]>::len);
        handles.extend((0..corners).map(|index| Handle::Mark(PointAt::On(line, index))));
    }
    let marks: Vec<PointAt> = match studio.step {
        Step::Horizon => vec![
            PointAt::Scale(0),
            PointAt::Scale(1),
            PointAt::PrincipalPoint,
            PointAt::Horizon(0),
            PointAt::Horizon(1),
        ],
        Step::Water | Step::Ground => Vec::new(),
        Step::Objects => studio
            .object
            .iter()
            .flat_map(|object| [PointAt::Foot(*object, 0), PointAt::Foot(*object, 1)])
            .collect(),
        Step::Pairs => {
            let pairs = tour.water.as_ref().map_or(0, |water| water.pairs.len());
            (0..pairs).flat_map(|pair| [PointAt::Pair(pair), PointAt::Reflection(pair)]).collect()
        }
        Step::Motion => studio
            .object
            .iter()
            .flat_map(|object| [PointAt::SwayRoot(*object), PointAt::SwayTip(*object)])
            .collect(),
    };
    handles.extend(marks.into_iter().map(Handle::Mark));
    if let (Step::Motion, Some(object)) = (studio.step, studio.object)
        && let Some(Motion::Course(course)) = tour.objects.get(object).map(|object| &object.motion)
    {
        handles.extend((0..course.waypoints.len()).map(|index| Handle::Waypoint(object, index)));
    }
    handles.into_iter().filter_map(|handle| Some((handle, handle.at(work)?))).collect()
}

/// The object in whose outline a point lies, the smallest of several.
pub(crate) fn object_at(point: PicturePoint, work: &Work<'_>) -> Option<usize> {
    let objects = work.tour.objects.iter().enumerate();
    objects
        .filter(|(_, object)| covers(&object.outline, point, work))
        .min_by(|a, b| area(&a.1.outline, work).total_cmp(&area(&b.1.outline, work)))
        .map(|(index, _)| index)
}

/// Whether a region covers a point of the document; a mask does where it covers more than half.
pub(super) fn covers(region: &Region<String>, point: PicturePoint, work: &Work<'_>) -> bool {
    match region {
        Region::Polygon(corners) => contains(corners, point),
        Region::Mask(name) => work.draft.masks.get(name).is_some_and(|mask| {
            let scaled = point.0 * mask_pixels(mask, work);
            mask.sample(PicturePoint(scaled)) > 0.5
        }),
    }
}

/// How large a region is, square pixels of the document; 0 for a mask that is not there.
fn area(region: &Region<String>, work: &Work<'_>) -> f64 {
    match region {
        Region::Polygon(corners) => {
            let sides = corners.iter().zip(corners.iter().cycle().skip(1));
            sides.map(|(a, b)| (a.0 - corners[0].0).perp_dot(b.0 - corners[0].0)).sum::<f64>().abs() / 2.0
        }
        Region::Mask(name) => work.draft.masks.get(name).map_or(0.0, |mask| {
            let covered: u64 = mask.values().iter().map(|value| u64::from(*value)).sum();
            covered as f64 / 255.0 / mask_pixels(mask, work).element_product()
        }),
    }
}

/// Pixels of a mask, which has the size of the picture's file, per pixel of the document.
fn mask_pixels(mask: &Mask, work: &Work<'_>) -> DVec2 {
    mask.size().as_dvec2() / work.size.as_dvec2()
}
