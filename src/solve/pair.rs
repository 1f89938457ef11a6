//! One reflection pair: how far it is from what a lens and its plane expect.
//!
//! In leveled coordinates a point and its reflection have the same x, and lie as far above as below the water at their
//! plane (README, "Leveled coordinates").

use glam::DVec2;

use super::AnnotatedPair;
use super::Annotations;
use super::PairPlane;
use super::Support;
use super::level::TiltedLens;
use super::residual::CONTACT_DEVIATION_PX;
use super::residual::PLANE_DEPTH_DEVIATION;
use super::residual::Unknowns;
use super::residual::background_dip;
use super::residual::height_ratio;

/// Contact lines are prolonged by at most this part of their length.
const PROLONGED: f64 = 1.0;

/// A pair's two residuals.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PairResidual {
    /// Across the direction of reflection, in standard deviations.
    pub(super) sideways: f64,
    /// Along it, in standard deviations given `sideways`; `None` where no plane says how long the reflection must be.
    pub(super) lengthwise: Option<f64>,
    /// The dip of the pair's plane at the pair, if it has one that meets its support below the horizon.
    pub(super) dip: Option<f64>,
}

/// The residuals of one pair.
pub(super) fn pair_residual(
    annotations: &Annotations,
    lens: &TiltedLens,
    unknowns: &Unknowns,
    pair: &AnnotatedPair,
) -> PairResidual {
    let (point, by_point) = lens.level_with_derivative(pair.point);
    let (reflection, by_reflection) = lens.level_with_derivative(pair.reflection);
    let [sideways_px, lengthwise_px] = pair.reflection_deviation_px;
    let (px, py) = (by_point.x_axis * pair.point_deviation_px, by_point.y_axis * pair.point_deviation_px);
    let (rx, ry) = (by_reflection.x_axis * sideways_px, by_reflection.y_axis * lengthwise_px);

    let off = reflection.x - point.x;
    let variance = px.x * px.x + py.x * py.x + rx.x * rx.x + ry.x * ry.x;
    let sideways = off / variance.sqrt();
    let Some(plane) = dip_at(annotations, lens, unknowns, pair.on, point.x).filter(|plane| plane.dip > 0.0)
    else {
        return PairResidual { sideways, lengthwise: None, dip: None };
    };

    // The plane's dip changes along it, so moving the point sideways changes what is expected of its reflection.
    let along = |d: DVec2| d.y + 2.0 * plane.slope * d.x;
    let (px_along, py_along) = (along(px), along(py));
    let covariance = rx.x * rx.y + ry.x * ry.y - px.x * px_along - py.x * py_along;
    let along_variance = px_along * px_along
        + py_along * py_along
        + rx.y * rx.y
        + ry.y * ry.y
        + 4.0 * (plane.variance + (PLANE_DEPTH_DEVIATION * plane.dip).powi(2));
    let short = point.y + reflection.y + 2.0 * plane.dip;
    let rest = along_variance - covariance * covariance / variance;
    let lengthwise = (short - covariance / variance * off) / rest.sqrt();
    PairResidual { sideways, lengthwise: Some(lengthwise), dip: Some(plane.dip) }
}

/// How far below the horizon a plane meets the water.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaneDip {
    /// Camera height above water / depth.
    pub(super) dip: f64,
    /// Its change per leveled x; 0 for a frontal plane.
    pub(super) slope: f64,
    /// Variance of `dip` from marking the contact line.
    pub(super) variance: f64,
}

/// The dip of a pair's plane at leveled `x`; `None` for a free pair. It may come out 0 or less.
pub(super) fn dip_at(
    annotations: &Annotations,
    lens: &TiltedLens,
    unknowns: &Unknowns,
    on: PairPlane,
    x: f64,
) -> Option<PlaneDip> {
    match on {
        PairPlane::Free => None,
        PairPlane::Background => Some(PlaneDip { dip: background_dip(unknowns), slope: 0.0, variance: 0.0 }),
        PairPlane::Plane(index) => {
            let plane = annotations.planes.get(index)?;
            // A foot on the ground is nearer to the horizon than the water at the same depth.
            let ratio = match plane.support {
                Support::Water => 1.0,
                Support::Ground => height_ratio(unknowns),
            };
            let [(left, by_left), (right, _)] = plane.contact.map(|foot| lens.level_with_derivative(foot));
            let width = right.x - left.x;
            let (t, slope) = if width.abs() > 1e-3 {
                (((x - left.x) / width).clamp(-PROLONGED, 1.0 + PROLONGED), (right.y - left.y) / width)
            } else {
                (0.5, 0.0)
            };
            let foot_deviation = by_left.y_axis.y * CONTACT_DEVIATION_PX;
            let variance = (foot_deviation * ratio).powi(2) * (t * t + (1.0 - t) * (1.0 - t));
            Some(PlaneDip {
                dip: -ratio * (left.y + t * (right.y - left.y)),
                slope: -ratio * slope,
                variance,
            })
        }
    }
}
