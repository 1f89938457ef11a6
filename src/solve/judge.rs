//! Which pairs agree with a solution, and what to say of those that do not.

use glam::DVec2;

use super::AnnotatedPair;
use super::Annotations;
use super::PairReport;
use super::level::TiltedLens;
use super::pair::pair_residual;
use super::residual::Unknowns;

/// A pair is left out when it is off by more than this many standard deviations ...
const LARGEST_DEVIATIONS: f64 = 3.0;
/// ... and by more than this many pixels.
const LARGEST_PX: f64 = 4.0;

/// What became of `pair`; `height` is the camera's above the water, meters.
pub(super) fn judge(
    annotations: &Annotations,
    lens: &TiltedLens,
    unknowns: &Unknowns,
    height: f64,
    pair: &AnnotatedPair,
) -> PairReport {
    let residual = pair_residual(annotations, lens, unknowns, pair);
    let (point, reflection) = (lens.level(pair.point), lens.level(pair.reflection));
    let off = |expected: DVec2| lens.picture(expected).0.distance(pair.reflection.0);
    let sideways_px = off(DVec2::new(point.x, reflection.y));
    let residual_px = residual.dip.map_or(sideways_px, |dip| off(DVec2::new(point.x, -point.y - 2.0 * dip)));

    let beyond = |deviations: f64, px: f64| deviations.abs() > LARGEST_DEVIATIONS && px > LARGEST_PX;
    let crooked = beyond(residual.sideways, sideways_px);
    let wrong_length = residual.lengthwise.is_some_and(|lengthwise| beyond(lengthwise, residual_px));
    // The middle between a point and its reflection lies on the water below it, so never above the horizon.
    let above_px = (point.y + reflection.y) / 2.0 * lens.focal_px;
    let above_horizon = above_px > LARGEST_PX.max(LARGEST_DEVIATIONS * pair.reflection_deviation_px[1]);

    let remark = if crooked {
        Some(format!(
            "this reflection does not agree with the others by {residual_px:.0} px ({sideways_px:.0} px of it sideways)"
        ))
    } else if wrong_length {
        Some(format!("this reflection lies {residual_px:.0} px from where its plane's contact line puts it"))
    } else if above_horizon {
        Some(format!(
            "the middle between this point and its reflection lies {above_px:.0} px above the horizon"
        ))
    } else {
        None
    };
    PairReport {
        name: pair.name.clone(),
        residual_px,
        sideways_px,
        depth: own_dip(lens, pair).map(|dip| height / dip),
        kept: remark.is_none(),
        remark,
    }
}

/// Camera height / depth of the pair itself, whatever plane it is on; `None` when it is too far to tell.
pub(super) fn own_dip(lens: &TiltedLens, pair: &AnnotatedPair) -> Option<f64> {
    let dip = -(lens.level(pair.point).y + lens.level(pair.reflection).y) / 2.0;
    // A tenth of a pixel below the horizon is as good as on it.
    (dip * lens.focal_px > 0.1).then_some(dip)
}
