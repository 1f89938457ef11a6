//! From the unknowns, which are ratios and angles, to meters.
//!
//! Everything here is a function of the unknowns, so that the deviations of heights and distances follow from theirs.

use super::AnnotatedPair;
use super::Annotations;
use super::BackgroundHint;
use super::FocalLength;
use super::PairPlane;
use super::Scale;
use super::SceneParameters;
use super::SolveError;
use super::Support;
use super::judge::own_dip;
use super::level::TiltedLens;
use super::pair::dip_at;
use super::residual::CONTACT_DEVIATION_PX;
use super::residual::LN_FOCAL;
use super::residual::LN_HEIGHT_RATIO;
use super::residual::PITCH;
use super::residual::ROLL;
use super::residual::Unknowns;
use super::residual::background_dip;
use super::residual::height_ratio;
use super::residual::principal;
use crate::picture::PicturePoint;

/// Depth of a background nobody marked, in camera heights.
const ASSUMED_DISTANCE: f64 = 60.0;
/// Depths this close, relatively, belong to one background.
const SAME_DEPTH: f64 = 0.1;

/// Where the background's distance comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum BackgroundSource {
    /// Typed in.
    Given,
    /// The median of this many contact points.
    Contact(usize),
    /// Pairs that were said to lie on it.
    Pairs,
    /// Free pairs that agree.
    FreePairs(usize),
    /// The farther half of free pairs that do not.
    FarPairs(usize),
    /// Nothing says.
    Assumed,
}

/// The lens that `unknowns` describe.
pub(super) fn lens(annotations: &Annotations, unknowns: &Unknowns) -> TiltedLens {
    TiltedLens::new(
        unknowns[LN_FOCAL].exp(),
        principal(annotations, unknowns),
        unknowns[PITCH],
        unknowns[ROLL],
    )
}

/// The parameters in meters.
pub(super) fn parameters(
    annotations: &Annotations,
    unknowns: &Unknowns,
    kept: &[bool],
) -> Result<SceneParameters, SolveError> {
    let lens = lens(annotations, unknowns);
    let (height, ground_height) = heights(annotations, &lens, unknowns)?;
    let (dip, _) = seen_background_dip(annotations, &lens, unknowns, kept);
    let background_distance = match annotations.background {
        BackgroundHint::Distance(meters) => meters,
        BackgroundHint::Contact(_) | BackgroundHint::FromPairs | BackgroundHint::Open => height / dip,
    };
    // Not the exponential of a logarithm, which may differ in the last bit.
    let focal_px = if let FocalLength::Known(px) = annotations.focal { px } else { lens.focal_px };
    Ok(SceneParameters {
        focal_px,
        principal: principal(annotations, unknowns),
        pitch: unknowns[PITCH],
        roll: unknowns[ROLL],
        height,
        ground_height,
        background_distance,
    })
}

/// Heights of the camera and of the ground above the water, meters.
fn heights(
    annotations: &Annotations,
    lens: &TiltedLens,
    unknowns: &Unknowns,
) -> Result<(f64, f64), SolveError> {
    let ratio = height_ratio(unknowns);
    let from_above_ground = |above_ground: f64| {
        let height = annotations.ground_height.map_or(above_ground * ratio, |ground| above_ground + ground);
        (height, height - above_ground)
    };
    match annotations.scale {
        Scale::HeightAboveWater { meters, .. } => {
            Ok((meters, annotations.ground_height.unwrap_or(meters - meters / ratio)))
        }
        Scale::HeightAboveGround(meters) => Ok(from_above_ground(meters)),
        Scale::Length { on, from, to, meters } => {
            let plane = &annotations.planes[on];
            let useless = || SolveError::UselessLength { plane: plane.name.clone(), meters };
            // With the ratio at 1 a plane's dip is in heights above its own support.
            let mut on_support = *unknowns;
            on_support[LN_HEIGHT_RATIO] = 0.0;
            let place = |point: PicturePoint| {
                let level = lens.level(point);
                let plane = dip_at(annotations, lens, &on_support, PairPlane::Plane(on), level.x)?;
                (plane.dip > 0.0).then(|| level.extend(-1.0) / plane.dip)
            };
            let length = place(from).ok_or_else(useless)?.distance(place(to).ok_or_else(useless)?);
            let above_support = meters / length;
            if !above_support.is_finite() {
                return Err(useless());
            }
            match plane.support {
                Support::Ground => Ok(from_above_ground(above_support)),
                Support::Water => {
                    let ground = annotations.ground_height.unwrap_or(above_support - above_support / ratio);
                    Ok((above_support, ground))
                }
            }
        }
    }
}

/// The background's camera height / depth as the picture shows it, whatever distance was typed in.
pub(super) fn seen_background_dip(
    annotations: &Annotations,
    lens: &TiltedLens,
    unknowns: &Unknowns,
    kept: &[bool],
) -> (f64, BackgroundSource) {
    let given = matches!(annotations.background, BackgroundHint::Distance(_));
    if let BackgroundHint::Contact(points) = &annotations.background {
        let dips = points.iter().map(|&point| -lens.level(point).y).filter(|dip| *dip > 0.0).collect();
        if let Some((dip, count)) = median(dips) {
            return (dip, BackgroundSource::Contact(count));
        }
    }
    let mut pairs = annotations.pairs.iter().zip(kept).filter(|(_, kept)| **kept).map(|(pair, _)| pair);
    if pairs.clone().any(|pair| pair.on == PairPlane::Background) {
        let dip = background_dip(unknowns);
        return (dip, if given { BackgroundSource::Given } else { BackgroundSource::Pairs });
    }
    if given {
        return (1.0 / ASSUMED_DISTANCE, BackgroundSource::Given);
    }
    let mut dips = Vec::new();
    pairs
        .by_ref()
        .filter(|pair| pair.on == PairPlane::Free)
        .for_each(|pair| dips.extend(own_dip(lens, pair)));
    dips.sort_by(f64::total_cmp);
    let Some((middle, count)) = median(dips.clone()) else {
        return (1.0 / ASSUMED_DISTANCE, BackgroundSource::Assumed);
    };
    let alike: Vec<f64> =
        dips.iter().copied().filter(|dip| (middle / dip - 1.0).abs() <= SAME_DEPTH).collect();
    if 2 * alike.len() > count {
        let count = alike.len();
        return (median(alike).map_or(middle, |(dip, _)| dip), BackgroundSource::FreePairs(count));
    }
    // The least dips are the farthest.
    dips.truncate(count.div_ceil(2));
    let count = dips.len();
    (median(dips).map_or(middle, |(dip, _)| dip), BackgroundSource::FarPairs(count))
}

/// Relative variance that the marked points themselves add to the background's dip.
pub(super) fn background_click_variance(
    annotations: &Annotations,
    lens: &TiltedLens,
    dip: f64,
    source: BackgroundSource,
) -> f64 {
    let relative = |px: f64, count: usize| (px / (lens.focal_px * dip)).powi(2) / count as f64;
    match source {
        BackgroundSource::Given | BackgroundSource::Pairs | BackgroundSource::Assumed => 0.0,
        BackgroundSource::Contact(count) => relative(CONTACT_DEVIATION_PX, count),
        BackgroundSource::FreePairs(count) | BackgroundSource::FarPairs(count) => {
            let of_pair =
                |pair: &AnnotatedPair| pair.point_deviation_px.hypot(pair.reflection_deviation_px[1]);
            let largest = annotations.pairs.iter().map(of_pair).fold(0.0, f64::max);
            relative(largest / 2.0, count)
        }
    }
}

/// The middle value and how many there are; `None` of nothing.
fn median(mut values: Vec<f64>) -> Option<(f64, usize)> {
    values.sort_by(f64::total_cmp);
    let count = values.len();
    let upper = *values.get(count / 2)?;
    let lower = values[(count - 1) / 2];
    Some(((lower + upper) / 2.0, count))
}
