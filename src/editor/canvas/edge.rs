//! Edges of outlines, contact lines and courses: the one under the pointer, where a new corner can be put in.

use crate::picture::PicturePoint;
use crate::tour::Motion;
use crate::tour::edit::{Edit, LineAt, PointAt};

use super::super::work::Work;
use super::handle::Handle;

/// What an edge belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Owner {
    Line(LineAt),
    /// The course of the object of this index, seen on the water.
    Course(usize),
}

/// A place on an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OnEdge {
    pub(super) owner: Owner,
    /// The index that a corner put in here gets.
    pub(super) index: usize,
    pub(super) at: PicturePoint,
}

impl OnEdge {
    /// The edit that puts a corner here.
    pub(super) fn insert(self, work: &Work<'_>) -> Option<Edit> {
        let Self { owner, index, at } = self;
        match owner {
            Owner::Line(line) => Some(Edit::InsertPoint { line, index, point: at }),
            Owner::Course(object) => {
                let Motion::Course(mut course) = work.tour.objects.get(object)?.motion.clone() else {
                    return None;
                };
                course.waypoints.insert(index.min(course.waypoints.len()), work.water_at(at)?);
                Some(Edit::Motion { object, motion: Motion::Course(course) })
            }
        }
    }

    /// The handle that such a corner has.
    pub(super) fn handle(self) -> Handle {
        match self.owner {
            Owner::Line(line) => Handle::Mark(PointAt::On(line, self.index)),
            Owner::Course(object) => Handle::Waypoint(object, self.index),
        }
    }
}

/// The nearest place on a line of points within `reach` pixels of a point; a closed one's last point joins its first.
pub(super) fn nearest(
    owner: Owner,
    points: &[PicturePoint],
    is_closed: bool,
    to: PicturePoint,
    reach: f64,
) -> Option<(f64, OnEdge)> {
    let joined = is_closed && points.len() > 2;
    let edges = if joined { points.len() } else { points.len().saturating_sub(1) };
    (0..edges)
        .map(|i| {
            let (a, b) = (points[i].0, points[(i + 1) % points.len()].0);
            let along = b - a;
            let part = ((to.0 - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            let at = if part.is_finite() { a + along * part } else { a };
            (at.distance(to.0), OnEdge { owner, index: i + 1, at: PicturePoint(at) })
        })
        .filter(|(distance, _)| *distance <= reach)
        .min_by(|a, b| a.0.total_cmp(&b.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tour::edit::{PlaceAt, RegionAt};

    #[test]
    fn the_last_side_of_an_outline_takes_a_corner_at_its_end_and_an_open_line_has_no_such_side() {
        let points = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)].map(|(x, y)| PicturePoint::new(x, y));
        let outline = Owner::Line(LineAt::Region(RegionAt::Water));
        let (distance, found) = nearest(outline, &points, true, PicturePoint::new(4.0, 5.0), 3.0).unwrap();
        assert_eq!(found.index, 3);
        assert!((distance - 0.5_f64.sqrt()).abs() < 1e-9, "{distance}");
        let open = Owner::Line(LineAt::Place(PlaceAt::Background));
        assert_eq!(nearest(open, &points, false, PicturePoint::new(4.0, 5.0), 3.0), None);
        let (_, found) = nearest(open, &points, false, PicturePoint::new(4.0, 1.0), 3.0).unwrap();
        assert_eq!((found.index, found.at), (1, PicturePoint::new(4.0, 0.0)));
    }
}
