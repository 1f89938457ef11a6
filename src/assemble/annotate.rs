//! What the solver needs of a tour.

use crate::solve::AnnotatedPair;
use crate::solve::AnnotatedPlane;
use crate::solve::Annotations;
use crate::solve::BackgroundHint;
use crate::solve::FocalLength;
use crate::solve::PairPlane;
use crate::solve::Scale;
use crate::tour;
use crate::tour::BackgroundPlace;
use crate::tour::Carrier;
use crate::tour::Medium;

use super::TourSource;
use super::backdrops::is_open;

/// Deviations of marks in pixels: a point; a reflection sideways; a reflection up and down, where ripples blur it.
const MARK_PX: f64 = 1.0;
const RIPPLED_PX: f64 = 3.0;

/// The tour's marks as the solver's annotations.
#[must_use]
pub fn annotations(source: &TourSource) -> Annotations {
    let tour = &source.tour;
    let size = source.picture.size();
    // A source's tour says it always: a crop's lies off its center.
    let principal =
        tour.camera.principal_point.unwrap_or(crate::picture::PicturePoint(size.as_dvec2() / 2.0));
    let width = f64::from(size.x);
    let (scale, assumed) = tour.scale();
    let plane_of = |name: &str| tour.objects.iter().position(|object| object.name == name);
    Annotations {
        size,
        uncropped_size: source.uncropped_size,
        principal,
        principal_deviation_px: Annotations::PRINCIPAL_DEVIATION * width,
        horizon: tour.camera.horizon,
        horizon_deviation_px: Annotations::HORIZON_DEVIATION_PX * (width / 1600.0).max(0.5),
        focal: focal(source),
        scale: match scale {
            tour::Scale::HeightAboveWater(meters) => Scale::HeightAboveWater { meters, assumed },
            tour::Scale::HeightAboveGround(meters) => Scale::HeightAboveGround(meters),
            tour::Scale::Length { on, from, to, meters } => {
                Scale::Length { on: plane_of(&on).unwrap_or(0), from, to, meters }
            }
        },
        planes: tour
            .objects
            .iter()
            .map(|object| AnnotatedPlane {
                name: object.name.clone(),
                support: object.support,
                contact: object.contact,
            })
            .collect(),
        background: background(source),
        ground_height: tour
            .ground
            .as_ref()
            .map(|ground| ground.height_above_water)
            .filter(|height| *height > 0.0 || tour.water.is_none()),
        ground_contact: Vec::new(),
        pairs: pairs(tour),
        method: tour.camera.method,
    }
}

fn focal(source: &TourSource) -> FocalLength {
    let is_photograph = source.tour.picture.medium == Medium::Photograph;
    match source.tour.camera.focal_length {
        tour::FocalLength::Known(px) => FocalLength::Known(px),
        tour::FocalLength::Between(low, high) => FocalLength::Between(low, high),
        tour::FocalLength::Exif if is_photograph => FocalLength::of_lens(source.lens, source.uncropped_size),
        tour::FocalLength::Exif | tour::FocalLength::Unknown => FocalLength::Unknown,
    }
}

/// The background's place, or its first band's.
fn background_place(tour: &tour::Tour) -> Option<&BackgroundPlace> {
    tour.background.place.as_ref().or(tour.background.bands.first().map(|band| &band.place))
}

fn background(source: &TourSource) -> BackgroundHint {
    match background_place(&source.tour) {
        None if is_open(source) => BackgroundHint::Open,
        Some(BackgroundPlace::Distance(meters)) => BackgroundHint::Distance(*meters),
        Some(BackgroundPlace::Contact(points)) => BackgroundHint::Contact(points.clone()),
        Some(BackgroundPlace::Infinity) | None => BackgroundHint::FromPairs,
    }
}

fn pairs(tour: &tour::Tour) -> Vec<AnnotatedPair> {
    let Some(water) = &tour.water else { return Vec::new() };
    water
        .pairs
        .iter()
        .enumerate()
        .map(|(i, pair)| AnnotatedPair {
            name: pair.name.clone().unwrap_or_else(|| match &pair.on {
                Some(on) => format!("pair {} on {on}", i + 1),
                None => format!("pair {}", i + 1),
            }),
            point: pair.point,
            reflection: pair.reflection,
            on: match tour.carrier(pair) {
                Some(Carrier::Object(index)) => PairPlane::Plane(index),
                Some(Carrier::Background) => PairPlane::Background,
                // A band stands somewhere else than the background.
                Some(Carrier::Band(_)) | None => PairPlane::Free,
            },
            point_deviation_px: MARK_PX,
            reflection_deviation_px: [MARK_PX, RIPPLED_PX],
        })
        .collect()
}
