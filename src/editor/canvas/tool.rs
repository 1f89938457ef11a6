//! Tools: what clicks and drags on the picture make, once enough points are drawn.

use crate::picture::PicturePoint;
use crate::tour::edit::{Edit, ListEdit, PlaceAt, RegionAt};
use crate::tour::{BackgroundPlace, Band, Course, Motion, Region, Scale};

use super::super::work::Work;
use super::super::{Brush, BrushStroke, Request};
use super::handle::is_drawn;
use super::make::{free_name, from_left, new_object, new_pair};

/// What the pointer does on the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tool {
    /// Selects and moves handles.
    #[default]
    Select,
    /// Draws the horizon: two points.
    Horizon,
    /// Sets the principal point: one point.
    PrincipalPoint,
    /// Draws a known length on this object: two points.
    Length(usize),
    /// Draws the outline of a region.
    Region(RegionAt),
    /// Draws the outline of a new object.
    NewObject,
    /// Draws the outline of a new band of the background.
    NewBand,
    /// Draws this object's contact line: two points.
    Contact(usize),
    /// Draws where a background plane meets the water.
    BackgroundContact(PlaceAt),
    /// Marks a point and its reflection.
    Pair,
    /// Draws a box around this object, for its outline to be found in it.
    Box(usize),
    /// Draws strokes that say what is inside or outside of a region or an object.
    Stroke(RegionAt),
    /// Paints a region's mask.
    Brush(RegionAt),
    /// Draws this boat's course on the water.
    Course(usize),
}

/// How many points a tool takes, and how they come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Takes {
    /// One click.
    One,
    /// Two clicks, or a drag from one to the other.
    Two,
    /// Clicks until the user says that it is enough; at least so many.
    Many { least: usize },
    /// A drag; all of it at its end.
    Stroke,
    /// A drag; piece by piece.
    Pieces,
}

impl Tool {
    pub(super) fn takes(self) -> Option<Takes> {
        Some(match self {
            Self::Select => return None,
            Self::PrincipalPoint => Takes::One,
            Self::Horizon | Self::Length(_) | Self::Contact(_) | Self::Pair | Self::Box(_) => Takes::Two,
            Self::Region(_) | Self::NewObject | Self::NewBand => Takes::Many { least: 3 },
            Self::BackgroundContact(_) | Self::Course(_) => Takes::Many { least: 2 },
            Self::Stroke(_) => Takes::Stroke,
            Self::Brush(_) => Takes::Pieces,
        })
    }

    /// Whether it draws outlines, which may cling to the picture's edges.
    pub(super) fn draws_outline(self) -> bool {
        matches!(self, Self::Region(_) | Self::NewObject | Self::NewBand)
    }

    /// Whether it draws strokes with the brush's width.
    pub(crate) fn has_width(self) -> bool {
        matches!(self, Self::Stroke(_) | Self::Brush(_))
    }

    /// Whether it stays in the hand after it was used.
    pub(super) fn stays(self) -> bool {
        self == Self::Pair || self.has_width()
    }

    /// One sentence on how to use it.
    pub(crate) fn hint(self, work: &Work<'_>) -> &'static str {
        let t = work.text;
        match self {
            Self::Select => t.mark.hint_select,
            Self::Horizon => t.mark.hint_horizon,
            Self::PrincipalPoint => t.mark.hint_principal,
            Self::Length(_) => t.mark.hint_length,
            Self::Region(_) | Self::NewObject | Self::NewBand => t.mark.hint_outline,
            Self::Contact(_) => t.mark.hint_contact,
            Self::BackgroundContact(_) => t.mark.hint_background,
            Self::Pair => t.mark.hint_pair,
            Self::Box(_) => t.mark.hint_box,
            Self::Stroke(at) if !is_drawn(at, work) => t.mark.hint_grow,
            Self::Stroke(_) => t.mark.hint_stroke,
            Self::Brush(_) => t.mark.hint_brush,
            Self::Course(_) => t.mark.hint_course,
        }
    }

    /// What the drawn points ask for; nothing while they are too few.
    pub(super) fn finish(self, points: &[PicturePoint], brush: &Brush, work: &Work<'_>) -> Option<Request> {
        let two = || <[PicturePoint; 2]>::try_from(points).ok();
        let stroke = || {
            let stroke = BrushStroke { points: points.to_vec(), radius: brush.radius, inside: brush.inside };
            (!points.is_empty()).then_some(stroke)
        };
        let enough = match self.takes()? {
            Takes::Many { least } => points.len() >= least,
            _ => true,
        };
        if !enough {
            return None;
        }
        let outline = || Region::Polygon(points.to_vec());
        let edit = match self {
            Self::Select => return None,
            Self::Horizon => Edit::Horizon(Some(from_left(two()?))),
            Self::PrincipalPoint => Edit::PrincipalPoint(Some(*points.first()?)),
            Self::Length(object) => {
                let [from, to] = two()?;
                let on = work.tour.objects.get(object)?.name.clone();
                let meters = match &work.tour.camera.scale {
                    Some(Scale::Length { meters, .. }) => *meters,
                    _ => 1.0,
                };
                Edit::Scale(Some(Scale::Length { on, from, to, meters }))
            }
            Self::Region(at) => Edit::Region { at, region: Some(outline()) },
            Self::NewObject => new_object(points, work),
            Self::NewBand => {
                let bands = &work.tour.background.bands;
                let name = free_name(work.text.mark.new_band, work);
                let band = Band { name, region: Some(outline()), place: BackgroundPlace::Infinity };
                Edit::Bands(ListEdit::Insert(bands.len(), band))
            }
            Self::Contact(object) => Edit::Contact { object, contact: from_left(two()?) },
            Self::BackgroundContact(at) => {
                Edit::Place { at, place: Some(BackgroundPlace::Contact(points.to_vec())) }
            }
            Self::Pair => new_pair(two()?, work),
            Self::Box(object) => return Some(Request::RefineBox { object, corners: two()? }),
            Self::Stroke(at) => return Some(Request::RefineStroke { at, stroke: stroke()? }),
            Self::Brush(at) => {
                return Some(Request::Paint { at, stroke: stroke()?, hardness: brush.hardness });
            }
            Self::Course(object) => {
                let waypoints: Vec<_> = points.iter().filter_map(|point| work.water_at(*point)).collect();
                if waypoints.len() < 2 {
                    return None;
                }
                let course = match &work.tour.objects.get(object)?.motion {
                    Motion::Course(course) => Course { waypoints, ..course.clone() },
                    Motion::Floating(floating) => Course {
                        waypoints,
                        speed: 1.0,
                        draft: floating.draft,
                        length: floating.length,
                        closed: false,
                    },
                    _ => Course { waypoints, speed: 1.0, draft: 0.3, length: None, closed: false },
                };
                Edit::Motion { object, motion: Motion::Course(course) }
            }
        };
        Some(Request::Edit(edit))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::tests::Bench;
    use crate::tour::Support;

    fn points(points: &[(f64, f64)]) -> Vec<PicturePoint> {
        points.iter().map(|(x, y)| PicturePoint::new(*x, *y)).collect()
    }

    #[test]
    fn a_drawn_outline_becomes_an_object_that_stands_on_its_lower_edge() {
        let bench = Bench::pond();
        let drawn = points(&[(400.0, 250.0), (460.0, 250.0), (450.0, 400.0), (410.0, 400.0)]);
        let made = bench.with_work(|work| Tool::NewObject.finish(&drawn, &Brush::default(), work));
        let Some(Request::Edit(Edit::Objects(ListEdit::Insert(1, object)))) = made else {
            panic!("{made:?}");
        };
        assert_eq!((object.name.as_str(), object.support), ("object 1", Support::Water));
        let [left, right] = object.contact;
        assert!(
            left.y() == 400.0 && (left.x() - 409.5).abs() < 0.6 && (right.x() - 450.5).abs() < 0.6,
            "{left} {right}"
        );
    }

    #[test]
    fn a_pair_may_be_clicked_in_either_order_and_knows_what_it_is_on() {
        let bench = Bench::pond();
        // The pond's boat reaches from (600, 360) to (700, 420).
        for drawn in [points(&[(650.0, 380.0), (650.0, 450.0)]), points(&[(650.0, 450.0), (650.0, 380.0)])] {
            let made = bench.with_work(|work| Tool::Pair.finish(&drawn, &Brush::default(), work));
            let Some(Request::Edit(Edit::Pairs(ListEdit::Insert(_, pair)))) = made else {
                panic!("{made:?}");
            };
            assert_eq!((pair.point.y(), pair.reflection.y()), (380.0, 450.0));
            assert_eq!(pair.on.as_deref(), Some("boat"));
        }
    }

    #[test]
    fn a_course_above_the_horizon_is_no_course() {
        let bench = Bench::pond();
        let course = |drawn: &[PicturePoint]| {
            bench.with_work(|work| Tool::Course(0).finish(drawn, &Brush::default(), work))
        };
        assert_eq!(course(&points(&[(300.0, 100.0), (700.0, 500.0)])), None);
        let Some(Request::Edit(Edit::Motion { motion: Motion::Course(course), .. })) =
            course(&points(&[(300.0, 500.0), (700.0, 500.0)]))
        else {
            panic!("no course");
        };
        assert!(course.waypoints.iter().all(|waypoint| waypoint.0.y < 0.0), "{course:?}");
    }
}
