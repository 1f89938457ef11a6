//! What drawn points become: pairs and objects with all that can be told from where they lie.

use glam::DVec2;

use crate::picture::PicturePoint;
use crate::tour::edit::{Edit, ListEdit};
use crate::tour::{Motion, Object, ReflectionPair, Region, Support};

use super::super::text::with;
use super::super::work::Work;
use super::handle::{covers, object_at};

/// Two points, the left one first.
pub(super) fn from_left([a, b]: [PicturePoint; 2]) -> [PicturePoint; 2] {
    if b.x() < a.x() { [b, a] } else { [a, b] }
}

/// A pair of two points; the lower one is the reflection. It is on the object or band in which the point lies.
pub(super) fn new_pair([a, b]: [PicturePoint; 2], work: &Work<'_>) -> Edit {
    let (point, reflection) = if a.y() <= b.y() { (a, b) } else { (b, a) };
    let object = object_at(point, work).map(|object| work.tour.objects[object].name.clone());
    let band = || {
        let on = |region: &Region<String>| covers(region, point, work);
        let bands = &work.tour.background.bands;
        bands.iter().find(|band| band.region.as_ref().is_some_and(on)).map(|band| band.name.clone())
    };
    let pairs = work.tour.water.as_ref().map_or(0, |water| water.pairs.len());
    let pair = ReflectionPair { point, reflection, on: object.or_else(band), name: None };
    Edit::Pairs(ListEdit::Insert(pairs, pair))
}

/// An object in an outline. It stands in the water if its feet do, else on the ground.
pub(super) fn new_object(outline: &[PicturePoint], work: &Work<'_>) -> Edit {
    let contact = lower_edge(outline);
    let middle = PicturePoint((contact[0].0 + contact[1].0) / 2.0);
    let on_ground = work.tour.ground.as_ref().is_some_and(|ground| covers(&ground.region, middle, work));
    let support = if on_ground || work.tour.water.is_none() { Support::Ground } else { Support::Water };
    let object = Object {
        name: free_name(work.text.mark.new_object, work),
        support,
        outline: Region::Polygon(outline.to_vec()),
        contact,
        turns_to_camera: false,
        motion: Motion::Static,
    };
    Edit::Objects(ListEdit::Insert(work.tour.objects.len(), object))
}

/// Left and right end of an outline's lowest twentieth, both on its lower edge's height.
fn lower_edge(outline: &[PicturePoint]) -> [PicturePoint; 2] {
    let ys = outline.iter().map(|corner| corner.y());
    let (top, bottom) =
        ys.fold((f64::INFINITY, f64::NEG_INFINITY), |(top, bottom), y| (top.min(y), bottom.max(y)));
    let level = bottom - (bottom - top) / 20.0;
    let sides = outline.iter().map(|a| a.0).zip(outline.iter().map(|b| b.0).cycle().skip(1));
    let crossing = |(a, b): (DVec2, DVec2)| {
        let part = (level - a.y) / (b.y - a.y);
        (0.0..=1.0).contains(&part).then_some(a.x + (b.x - a.x) * part)
    };
    let low = outline.iter().filter(|corner| corner.y() >= level).map(|corner| corner.x());
    let xs = low.chain(sides.filter_map(crossing));
    let (left, right) =
        xs.fold((f64::INFINITY, f64::NEG_INFINITY), |(left, right), x| (left.min(x), right.max(x)));
    [PicturePoint::new(left, bottom), PicturePoint::new(right.max(left + 1.0), bottom)]
}

/// A name like "object 2" that nothing has yet.
pub(super) fn free_name(template: &str, work: &Work<'_>) -> String {
    let tour = work.tour;
    let taken = |name: &String| {
        tour.objects.iter().any(|object| object.name == *name)
            || tour.background.bands.iter().any(|band| band.name == *name)
    };
    let mut number = 1;
    loop {
        let name = with(template, number);
        if !taken(&name) {
            return name;
        }
        number += 1;
    }
}
