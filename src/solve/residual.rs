//! The evidence as residuals in standard deviations.
//!
//! Every row is 0 where its annotation agrees with the unknowns and 1 where it is one standard deviation off, to first
//! order (Sampson). Rows come in the same order and number for any value of the unknowns.

use glam::DVec2;

use super::Annotations;
use super::BackgroundHint;
use super::PairPlane;
use super::level::TiltedLens;
use super::pair::pair_residual;
use crate::picture::PicturePoint;

/// How many unknowns there are at most.
pub(super) const UNKNOWNS: usize = 7;
/// Natural logarithm of the focal length in pixels.
pub(super) const LN_FOCAL: usize = 0;
/// Radians, as in `SceneParameters`.
pub(super) const PITCH: usize = 1;
/// Radians, as in `SceneParameters`.
pub(super) const ROLL: usize = 2;
/// Shift of the principal point from the annotated one, in picture widths.
pub(super) const PRINCIPAL_X: usize = 3;
/// The same downward.
pub(super) const PRINCIPAL_Y: usize = 4;
/// Natural logarithm of camera height above water / camera height above ground.
pub(super) const LN_HEIGHT_RATIO: usize = 5;
/// Natural logarithm of the background's dip, camera height above water / depth.
pub(super) const LN_BACKGROUND_DIP: usize = 6;

/// Values of all unknowns, also of those that are fixed.
pub(super) type Unknowns = [f64; UNKNOWNS];

/// Real bodies stand in front of or behind the plane of their contact line by about this part of its depth.
pub(super) const PLANE_DEPTH_DEVIATION: f64 = 0.05;
/// Standard deviation of a marked contact point, pixels.
pub(super) const CONTACT_DEVIATION_PX: f64 = 1.5;
/// Stiffness of the walls at the ends of a range, per unit beyond them.
const WALL: f64 = 100.0;
/// Where roll and pitch end, radians (20° and 60°).
pub(super) const LARGEST_ROLL: f64 = 0.349;
pub(super) const LARGEST_PITCH: f64 = 1.047;
/// What a camera's pitch and roll are where no horizon is marked, radians (20° and 5°): hand-held, roughly level.
pub(super) const PITCH_DEVIATION: f64 = 0.349;
pub(super) const ROLL_DEVIATION: f64 = 0.087;
/// So loose a guess that it only keeps a ratio finite when its evidence comes to nothing.
const LN_RATIO_DEVIATION: f64 = 1000.0;
const LN_BACKGROUND_DIP_GUESS: f64 = -4.0;
/// The background lies between half a camera height and 160 000 of them away.
const LN_DIP_RANGE: [f64; 2] = [-12.0, 0.7];
/// The camera is at most 1000 times as high above the water as above the ground, or the other way round.
const LARGEST_LN_RATIO: f64 = 6.9;

/// Where a row comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// A pair's two points are in line with the nadir.
    Pairs,
    /// A pair's two points lie as far above as below the water at its plane.
    Contacts,
    /// The horizon.
    Horizon,
    /// Where the background meets water and ground.
    Background,
    /// The focal length in the file.
    FocalInFile,
    /// The principal point.
    Principal,
    /// A guess, no observation.
    Guess,
    /// Keeps an unknown in its range.
    Wall,
}

impl Source {
    /// Whether single rows may be wrong by far, so that they must not pull in proportion.
    pub(super) const fn may_be_wrong(self) -> bool {
        matches!(self, Self::Pairs | Self::Contacts | Self::Horizon | Self::Background)
    }

    /// Whether it says something of this picture, rather than of pictures in general.
    pub(super) const fn is_observed(self) -> bool {
        !matches!(self, Self::Guess | Self::Wall)
    }
}

/// A guess or observation of `ln(focal_px)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FocalPrior {
    pub(super) ln_focal: f64,
    pub(super) deviation: f64,
    pub(super) source: Source,
}

/// What is to be fitted to what.
#[derive(Clone, Debug)]
pub(super) struct Evidence<'a> {
    pub(super) annotations: &'a Annotations,
    /// Which pairs take part.
    pub(super) kept: Vec<bool>,
    pub(super) focal_prior: Option<FocalPrior>,
    /// Shortest and longest `ln(focal_px)`.
    pub(super) ln_focal_range: [f64; 2],
    /// Which unknowns are fitted.
    pub(super) fitted: [bool; UNKNOWNS],
}

impl Evidence<'_> {
    /// The lens that the unknowns describe.
    pub(super) fn lens(&self, unknowns: &Unknowns) -> TiltedLens {
        TiltedLens::new(
            unknowns[LN_FOCAL].exp(),
            principal(self.annotations, unknowns),
            unknowns[PITCH],
            unknowns[ROLL],
        )
    }

    /// All rows, each with where it comes from.
    pub(super) fn rows(&self, unknowns: &Unknowns, mut emit: impl FnMut(Source, f64)) {
        let lens = self.lens(unknowns);
        for (pair, _) in self.annotations.pairs.iter().zip(&self.kept).filter(|(_, kept)| **kept) {
            let residual = pair_residual(self.annotations, &lens, unknowns, pair);
            emit(Source::Pairs, residual.sideways);
            if pair.on != PairPlane::Free {
                emit(Source::Contacts, residual.lengthwise.unwrap_or(0.0));
            }
        }
        if let Some(ends) = self.annotations.horizon {
            for end in ends {
                // Straight down from a level point at the same x, to first order, in pixels.
                let (level, derivative) = lens.level_with_derivative(end);
                let off = level.y / derivative.y_axis.y;
                emit(Source::Horizon, off / self.annotations.horizon_deviation_px);
            }
        }
        if self.fitted[LN_BACKGROUND_DIP] {
            self.background_rows(&lens, unknowns, &mut emit);
        }
        self.prior_rows(unknowns, &mut emit);
    }

    /// Where the background meets water and ground, compared with its dip.
    fn background_rows(&self, lens: &TiltedLens, unknowns: &Unknowns, emit: &mut impl FnMut(Source, f64)) {
        let dip = background_dip(unknowns);
        let mut compare = |points: &[PicturePoint], ratio: f64| {
            for &point in points {
                let (level, derivative) = lens.level_with_derivative(point);
                let deviation =
                    (ratio * derivative.y_axis.y * CONTACT_DEVIATION_PX).hypot(PLANE_DEPTH_DEVIATION * dip);
                emit(Source::Background, (dip + ratio * level.y) / deviation);
            }
        };
        if let BackgroundHint::Contact(points) = &self.annotations.background {
            compare(points, 1.0);
        }
        compare(&self.annotations.ground_contact, height_ratio(unknowns));
        emit(Source::Guess, (unknowns[LN_BACKGROUND_DIP] - LN_BACKGROUND_DIP_GUESS) / LN_RATIO_DEVIATION);
        let [farthest, nearest] = LN_DIP_RANGE;
        emit(Source::Wall, beyond(unknowns[LN_BACKGROUND_DIP], farthest, nearest));
    }

    fn prior_rows(&self, unknowns: &Unknowns, emit: &mut impl FnMut(Source, f64)) {
        if self.fitted[LN_FOCAL] {
            if let Some(prior) = self.focal_prior {
                emit(prior.source, (unknowns[LN_FOCAL] - prior.ln_focal) / prior.deviation);
            }
            let [shortest, longest] = self.ln_focal_range;
            emit(Source::Wall, beyond(unknowns[LN_FOCAL], shortest, longest));
        }
        if self.fitted[PRINCIPAL_X] {
            let widths = f64::from(self.annotations.size.x) / self.annotations.principal_deviation_px;
            emit(Source::Principal, unknowns[PRINCIPAL_X] * widths);
            emit(Source::Principal, unknowns[PRINCIPAL_Y] * widths);
        }
        if self.annotations.horizon.is_none() {
            emit(Source::Guess, unknowns[PITCH] / PITCH_DEVIATION);
            emit(Source::Guess, unknowns[ROLL] / ROLL_DEVIATION);
        }
        emit(Source::Wall, beyond(unknowns[PITCH], -LARGEST_PITCH, LARGEST_PITCH));
        emit(Source::Wall, beyond(unknowns[ROLL], -LARGEST_ROLL, LARGEST_ROLL));
        if self.fitted[LN_HEIGHT_RATIO] {
            emit(Source::Guess, unknowns[LN_HEIGHT_RATIO] / LN_RATIO_DEVIATION);
            emit(Source::Wall, beyond(unknowns[LN_HEIGHT_RATIO], -LARGEST_LN_RATIO, LARGEST_LN_RATIO));
        }
    }
}

fn beyond(value: f64, least: f64, most: f64) -> f64 {
    WALL * (value - value.clamp(least, most))
}

/// Camera height above water / above ground; a search that strays comes back from the end of the range.
pub(super) fn height_ratio(unknowns: &Unknowns) -> f64 {
    unknowns[LN_HEIGHT_RATIO].clamp(-LARGEST_LN_RATIO, LARGEST_LN_RATIO).exp()
}

/// Camera height above water / depth of the background, within its range.
pub(super) fn background_dip(unknowns: &Unknowns) -> f64 {
    let [farthest, nearest] = LN_DIP_RANGE;
    unknowns[LN_BACKGROUND_DIP].clamp(farthest, nearest).exp()
}

/// The principal point that the unknowns describe.
pub(super) fn principal(annotations: &Annotations, unknowns: &Unknowns) -> PicturePoint {
    let shift = DVec2::new(unknowns[PRINCIPAL_X], unknowns[PRINCIPAL_Y]) * f64::from(annotations.size.x);
    PicturePoint(annotations.principal.0 + shift)
}
