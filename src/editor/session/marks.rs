//! Marks that the machine helps to make: strokes painted, ways along edges, contact lines.

use std::sync::Arc;

use glam::UVec2;

use super::Session;
use crate::editor::BrushStroke;
use crate::picture::{DecodedPicture, Mask, Picture, PicturePoint};
use crate::suggest::outline::{Brush, BrushMode, LiveWire, Side, Stroke, contact_line, simplified_line};
use crate::tour::Region;
use crate::tour::edit::desk::Desk;
use crate::tour::edit::{Edit, PackedMask, RegionAt};

/// How far a traced way may be simplified, picture pixels.
const TRACE_TOLERANCE: f64 = 1.5;

/// The way along edges that is being traced.
#[derive(Debug, Default)]
pub(super) struct Tracing {
    /// Prepared for a picture.
    wire: Option<LiveWire>,
    /// Whether it is being prepared.
    is_coming: bool,
    /// Where the way begins, pixels of the document.
    anchor: Option<PicturePoint>,
    /// The way as it was found: a point for each pixel, in pixels of the picture's file.
    found: Vec<PicturePoint>,
    /// The same thinned out, in pixels of the document.
    pub(super) way: Vec<PicturePoint>,
}

impl Session {
    pub(super) fn picture(&self) -> Option<Arc<DecodedPicture>> {
        self.desk.as_ref()?.picture().cloned()
    }

    /// Pixels of the picture's file per pixel of the document.
    pub(super) fn scale(&self, picture: &Picture) -> f64 {
        let marked = self.desk.as_ref().and_then(|desk| desk.tour().picture.size);
        marked.map_or(1.0, |size| f64::from(picture.size().x) / f64::from(size.x.max(1)))
    }

    /// The mask that a region is, drawn from its polygon if it is one.
    pub(super) fn mask_of(&self, at: RegionAt, size: UVec2, scale: f64) -> Option<Mask> {
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

    /// Takes a region that is a first guess for right: it gets a mask of its own.
    pub(super) fn take_guess(&mut self, at: RegionAt) {
        let Some(picture) = self.picture() else { return };
        let (scale, size) = (self.scale(&picture.picture), picture.picture.size());
        if let Some(mask) = self.mask_of(at, size, scale) {
            self.set_mask(at, &mask);
        }
    }

    /// What a region's mask is called; what is done to a first guess goes into another one.
    fn name_of(&self, at: RegionAt) -> String {
        let Some(desk) = &self.desk else { return String::new() };
        if let Some(Region::Mask(name)) = at.get(desk.tour()).filter(|_| !at.is_guess(desk.tour())) {
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
    pub(super) fn set_mask(&mut self, at: RegionAt, mask: &Mask) {
        let name = self.name_of(at);
        let region = Some(Region::Mask(name.clone()));
        self.edit(&Edit::Many(vec![
            Edit::Mask { name, mask: Some(PackedMask::new(mask)) },
            Edit::Region { at, region },
        ]));
    }

    pub(super) fn set_contact(&mut self, object: usize, mask: &Mask, scale: f64) {
        if let Some(line) = contact_line(mask) {
            let contact = line.feet.map(|foot| PicturePoint(foot.0 / scale));
            self.edit(&Edit::Contact { object, contact });
        }
    }

    /// Paints a piece of a stroke on a region's mask; a polygon becomes a mask first, and a first guess one of its own.
    pub(super) fn paint(&mut self, at: RegionAt, stroke: &BrushStroke, hardness: f64) {
        let Some(picture) = self.picture() else { return };
        let (scale, size) = (self.scale(&picture.picture), picture.picture.size());
        let Some(tour) = self.desk.as_ref().map(Desk::tour) else { return };
        if !matches!(at.get(tour), Some(Region::Mask(_))) || at.is_guess(tour) {
            let mask = self
                .mask_of(at, size, scale)
                .or_else(|| Mask::new(size, vec![0; picture.picture.pixels().len()]).ok());
            if let Some(mask) = mask {
                self.set_mask(at, &mask);
            }
        }
        let name = self.name_of(at);
        let stroke = scaled(stroke, scale);
        let mode = if stroke.side == Side::Inside { BrushMode::Paint } else { BrushMode::Erase };
        let brush = Brush { radius: stroke.radius, hardness, mode };
        let mask = self.desk.as_ref().and_then(|desk| desk.draft().masks.get(&name));
        if let Some(patch) = mask.and_then(|mask| brush.draw(mask, &stroke.points)) {
            self.edit(&Edit::Paint { name, patch });
        }
    }

    /// Looks for the way along edges between two points.
    pub(super) fn trace(&mut self, from: PicturePoint, to: PicturePoint) {
        let Some(picture) = self.picture() else { return };
        let scale = self.scale(&picture.picture);
        let Some(wire) = &mut self.tracing.wire else { return self.prepare_tracing(picture) };
        if self.tracing.anchor != Some(from) {
            // Where the shown way ends the next one begins: it was taken, and tells what the object's edge is like. From
            // anywhere else something new is drawn.
            if self.tracing.way.last() == Some(&from) {
                wire.learn_from(&self.tracing.found);
            } else {
                wire.forget();
            }
            wire.anchor(PicturePoint(from.0 * scale));
            self.tracing.anchor = Some(from);
        }
        self.tracing.found = wire.path_to(PicturePoint(to.0 * scale));
        self.tracing.way = simplified_line(&self.tracing.found, TRACE_TOLERANCE)
            .into_iter()
            .map(|point| PicturePoint(point.0 / scale))
            .collect();
    }

    /// Prepares a picture for ways along its edges, which takes seconds for a large one; until then there are none.
    fn prepare_tracing(&mut self, picture: Arc<DecodedPicture>) {
        if std::mem::replace(&mut self.tracing.is_coming, true) {
            return;
        }
        let title = self.studio.language.text().session.tracing;
        self.start(title, move |_| {
            let wire = LiveWire::new(&picture.picture);
            Box::new(move |session: &mut Self| {
                // Another picture may have come meanwhile.
                let is_same = session.picture().is_some_and(|now| Arc::ptr_eq(&now, &picture));
                session.tracing = Tracing { wire: is_same.then_some(wire), ..Tracing::default() };
            })
        });
    }

    /// Forgets what was prepared for another picture.
    pub(super) fn forget_picture(&mut self) {
        self.tracing = Tracing::default();
        self.outlinings.clear();
    }
}

/// A stroke in pixels of the picture's file.
pub(super) fn scaled(stroke: &BrushStroke, scale: f64) -> Stroke {
    let points: Vec<PicturePoint> = stroke.points.iter().map(|point| PicturePoint(point.0 * scale)).collect();
    let side = if stroke.inside { Side::Inside } else { Side::Outside };
    Stroke { points, radius: stroke.radius * scale, side }
}

#[cfg(test)]
mod tests {
    use super::*;

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
