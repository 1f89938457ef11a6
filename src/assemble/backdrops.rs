//! The tour's background, bands and sky as the scene's backdrops, each with its mask.
//!
//! Exactly one has no mask, or none: it shows wherever no other does. That is the band without a region; else the
//! background, where the tour says where it stands or has no bands; else the sky. Where sky is all that is seen above the
//! water, as on the open sea, there is no background either.

use super::{TourSource, background_mask};
use crate::picture::Mask;
use crate::scene::BackdropPlace;
use crate::scene::BackdropPlan;
use crate::scene::Role;
use crate::scene::TourScene;
use crate::solve::Solution;
use crate::tour::{BackgroundPlace, Carrier};

/// All backdrops, in the tour's order.
pub(super) fn backdrops(
    source: &TourSource,
    solution: &Solution,
    remarks: &mut Vec<String>,
) -> Vec<BackdropPlan> {
    let background = &source.tour.background;
    let backdrop = |name: &str, place| BackdropPlan { name: name.to_owned(), place };
    let mut found: Vec<BackdropPlan> = background
        .bands
        .iter()
        .map(|band| {
            let place = match &band.place {
                BackgroundPlace::Distance(meters) => BackdropPlace::Distance(*meters),
                BackgroundPlace::Contact(points) => BackdropPlace::Contact(points.clone()),
                BackgroundPlace::Infinity => BackdropPlace::Infinity,
            };
            backdrop(&band.name, place)
        })
        .collect();
    let taken = background.bands.iter().any(|band| band.region.is_none());
    let said = background.place.is_some() || background.bands.is_empty() && !is_open(source);
    if said && !taken {
        let place = match background.place {
            Some(BackgroundPlace::Infinity) => BackdropPlace::Infinity,
            _ => BackdropPlace::Distance(solution.parameters.background_distance),
        };
        found.push(backdrop("background", place));
    } else if said && background.place.is_some() {
        remarks.push(
            "a band without a region shows wherever no other band does, so `background.place` only helps to solve; \
             give that band a region to have both"
                .to_owned(),
        );
    }
    let rest = said || taken;
    let (sky, has_region) = (source.tour.sky.is_some(), source.sky.is_some());
    // Without anything else to show what the bands leave, that is the sky.
    if has_region || !rest {
        found.push(backdrop("sky", BackdropPlace::Infinity));
    } else if sky {
        remarks.push(
            "nothing tells the sky from the background, so the sky stays a part of it; give `sky` a `region`"
                .to_owned(),
        );
    }
    found
}

/// Less of the picture than this is no land: masks leave slivers between them.
const LEAST_LAND: f64 = 0.005;

/// Whether nothing tells how far a background stands, and the sky's mask leaves nothing that could be one.
pub(super) fn is_open(source: &TourSource) -> bool {
    let tour = &source.tour;
    let pairs = tour.water.iter().flat_map(|water| &water.pairs);
    // Pairs on nothing in particular tell of a background.
    let is_told = tour.background.place.is_some()
        || !tour.background.bands.is_empty()
        || pairs.into_iter().any(|pair| !matches!(tour.carrier(pair), Some(Carrier::Object(_))));
    if source.sky.is_none() || is_told {
        return false;
    }
    let land = background_mask(source);
    let covered: f64 = land.values().iter().map(|&covered| f64::from(covered) / 255.0).sum();
    covered < LEAST_LAND * land.values().len() as f64
}

/// Visible coverage of a scene's backdrops, in the scene's order; `None` for the one that shows wherever nothing else
/// does.
pub(super) fn masks<'a>(source: &'a TourSource, scene: &TourScene) -> Vec<Option<&'a Mask>> {
    let band = |name: &str| {
        let index = source.tour.background.bands.iter().position(|band| band.name == name)?;
        source.bands.get(index)?.as_ref()
    };
    scene
        .components
        .iter()
        .filter(|component| matches!(component.role, Role::LastLayer | Role::Band))
        .map(|component| {
            band(&component.name).or_else(|| source.sky.as_ref().filter(|_| component.name == "sky"))
        })
        .collect()
}
