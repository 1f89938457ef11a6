//! The tour's background, bands and sky as the scene's backdrops, each with its mask.
//!
//! Exactly one has no mask, or none: it shows wherever no other does. That is the band without a region; else the
//! background, where the tour says where it stands or has no bands; else the sky.

use super::TourSource;
use crate::picture::Mask;
use crate::scene::BackdropPlace;
use crate::scene::BackdropPlan;
use crate::scene::Role;
use crate::scene::TourScene;
use crate::solve::SceneParameters;
use crate::tour::BackgroundPlace;

/// All backdrops, in the tour's order.
pub(super) fn backdrops(
    source: &TourSource,
    parameters: &SceneParameters,
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
    let said = background.place.is_some() || background.bands.is_empty();
    if said && !taken {
        let place = match background.place {
            Some(BackgroundPlace::Infinity) => BackdropPlace::Infinity,
            _ => BackdropPlace::Distance(parameters.background_distance),
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
