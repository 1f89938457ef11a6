//! A tour's numbers for another size of its picture, and for the part that is used.
//!
//! Everything in pixels goes along: points, focal lengths, the clouds' drift, the crop. Masks are not touched; they follow
//! the picture.

use glam::{DVec2, UVec2};

use crate::picture::PicturePoint;

use super::annotation::{BackgroundPlace, Crop, FocalLength, Region, Scale};
use super::file::Document;
use super::object::Motion;
use super::problem::{Problem, Problems};
use super::{Tour, check};

/// How far the two sides' enlargements may differ: 1 px in 1000.
const ASPECT_TOLERANCE: f64 = 1e-3;

impl Tour {
    /// Whether the picture, `actual` pixels large, is the one that the numbers refer to, perhaps enlarged.
    ///
    /// # Errors
    /// This returns a problem when the aspect differs by more than 1 px in 1000, or when the crop reaches beyond the
    /// picture.
    pub fn check_size(&self, actual: UVec2) -> Result<(), Problems> {
        let size = self.picture.size.unwrap_or(actual);
        let ratio = actual.as_dvec2() / size.as_dvec2();
        // A side that is rounded to whole pixels differs by up to one of them.
        let rounding = 1.0 / f64::from(actual.min_element().max(1));
        if (ratio.x / ratio.y - 1.0).abs() > ASPECT_TOLERANCE.max(rounding) {
            let message =
                format!("the picture has {} × {} pixels, which is another shape", actual.x, actual.y);
            let advice = format!(
                "write `size: ({}, {})` and mark anew, or use the picture it was marked on",
                actual.x, actual.y
            );
            return Err(
                Problem::new("picture.size", format!("({}, {})", size.x, size.y), message, advice).into()
            );
        }
        check::crop_problem(self.picture.crop, Some(size)).map_or(Ok(()), |problem| Err(problem.into()))
    }

    /// The same tour for its picture at `actual` pixels: a uniform enlargement of every number in pixels.
    #[must_use]
    pub fn scaled_to(&self, actual: UVec2) -> Self {
        let mut document = self.0.clone();
        let ratio = actual.as_dvec2() / self.picture.size.unwrap_or(actual).as_dvec2();
        document.picture.size = Some(actual);
        if ratio != DVec2::ONE {
            document.map_points(&mut |point| PicturePoint(point.0 * ratio));
            document.camera.focal_length = match document.camera.focal_length {
                FocalLength::Known(focal) => FocalLength::Known(focal * ratio.y),
                FocalLength::Between(least, most) => FocalLength::Between(least * ratio.y, most * ratio.y),
                other @ (FocalLength::Exif | FocalLength::Unknown) => other,
            };
            if let Some(drift) = document.sky.as_mut().and_then(|sky| sky.drift.as_mut()) {
                drift.speed *= ratio.y;
            }
            document.picture.crop = self.picture.crop.map(|crop| scaled_crop(crop, ratio, actual));
        }
        Self(document)
    }

    /// The part of the picture that is used, when the picture is `actual` pixels large; the whole without a crop.
    #[must_use]
    pub fn crop_in(&self, actual: UVec2) -> Crop {
        let whole = Crop { left: 0, top: 0, width: actual.x, height: actual.y };
        self.scaled_to(actual).picture.crop.unwrap_or(whole)
    }

    /// The tour in pixels of the part that is used of a picture `actual` pixels large.
    ///
    /// Its size is that part's, its principal point explicit (a crop's lies off-center), its crop gone: cut the picture
    /// and the masks by [`crop_in`](Self::crop_in).
    #[must_use]
    pub fn in_pixels_of(&self, actual: UVec2) -> Self {
        let mut document = self.scaled_to(actual).0;
        let center = PicturePoint(actual.as_dvec2() / 2.0);
        document.camera.principal_point.get_or_insert(center);
        if let Some(crop) = document.picture.crop.take() {
            let corner = DVec2::new(f64::from(crop.left), f64::from(crop.top));
            document.map_points(&mut |point| PicturePoint(point.0 - corner));
            document.picture.size = Some(UVec2::new(crop.width, crop.height));
        }
        Self(document)
    }
}

/// The crop at another size, kept within the picture.
fn scaled_crop(crop: Crop, ratio: DVec2, actual: UVec2) -> Crop {
    let corner = DVec2::new(f64::from(crop.left), f64::from(crop.top));
    let extent = DVec2::new(f64::from(crop.width), f64::from(crop.height));
    let from = (corner * ratio).round().as_uvec2().min(actual - UVec2::ONE);
    let to = ((corner + extent) * ratio).round().as_uvec2().clamp(from + UVec2::ONE, actual);
    Crop { left: from.x, top: from.y, width: to.x - from.x, height: to.y - from.y }
}

impl<P> Document<P> {
    /// Takes every picture point through `map`.
    fn map_points(&mut self, map: &mut dyn FnMut(PicturePoint) -> PicturePoint) {
        let mut each = |point: &mut PicturePoint| *point = map(*point);
        self.camera.horizon.iter_mut().flatten().for_each(&mut each);
        self.camera.principal_point.iter_mut().for_each(&mut each);
        if let Some(Scale::Length { from, to, .. }) = &mut self.camera.scale {
            each(from);
            each(to);
        }
        if let Some(water) = &mut self.water {
            water.region.corners().for_each(&mut each);
            for pair in &mut water.pairs {
                each(&mut pair.point);
                each(&mut pair.reflection);
            }
        }
        if let Some(ground) = &mut self.ground {
            ground.region.corners().for_each(&mut each);
        }
        self.background.place.iter_mut().flat_map(BackgroundPlace::points).for_each(&mut each);
        for band in &mut self.background.bands {
            band.region.iter_mut().flat_map(Region::corners).for_each(&mut each);
            band.place.points().for_each(&mut each);
        }
        if let Some(region) = self.sky.as_mut().and_then(|sky| sky.region.as_mut()) {
            region.corners().for_each(&mut each);
        }
        for object in &mut self.objects {
            object.outline.corners().for_each(&mut each);
            object.contact.iter_mut().for_each(&mut each);
            if let Motion::Sway(sway) = &mut object.motion {
                sway.root.iter_mut().chain(&mut sway.tip).for_each(&mut each);
            }
        }
    }
}

impl<P> Region<P> {
    fn corners(&mut self) -> std::slice::IterMut<'_, PicturePoint> {
        match self {
            Self::Polygon(corners) => corners.iter_mut(),
            Self::Mask(_) => [].iter_mut(),
        }
    }
}

impl BackgroundPlace {
    fn points(&mut self) -> std::slice::IterMut<'_, PicturePoint> {
        match self {
            Self::Contact(points) => points.iter_mut(),
            Self::Distance(_) | Self::Infinity => [].iter_mut(),
        }
    }
}
