//! What the full method has to tell the user: disagreements in pixels, and what could not be seen in the picture.
//!
//! Each remark is one sentence that says what to look at, without a full stop.

use super::Annotations;
use super::BackgroundHint;
use super::FocalLength;
use super::Label;
use super::PairPlane;
use super::SceneParameters;
use super::Support;
use super::metric;
use super::metric::BackgroundSource;
use super::residual::Evidence;
use super::residual::LARGEST_PITCH;
use super::residual::LARGEST_ROLL;
use super::residual::LN_BACKGROUND_DIP;
use super::residual::Unknowns;
use super::residual::background_dip;
use super::summary::MEASURED_RATIO;

/// Below this pitch in radians (2°) a picture counts as level.
const LEVEL: f64 = 0.035;

struct Remarks<'a> {
    evidence: &'a Evidence<'a>,
    annotations: &'a Annotations,
    unknowns: &'a Unknowns,
    parameters: &'a SceneParameters,
}

/// All remarks on `unknowns`, which became `parameters`.
pub(super) fn remarks(
    evidence: &Evidence<'_>,
    unknowns: &Unknowns,
    parameters: &SceneParameters,
    focal_label: Label,
) -> Vec<String> {
    Remarks { evidence, annotations: evidence.annotations, unknowns, parameters }.all(focal_label)
}

impl Remarks<'_> {
    fn all(&self, focal_label: Label) -> Vec<String> {
        let mut remarks = Vec::new();
        remarks.extend(self.tilt_remark());
        remarks.extend(self.horizon_remark());
        remarks.extend(self.principal_remark());
        if focal_label == Label::Assumed && !matches!(self.annotations.focal, FocalLength::Known(_)) {
            let why = if self.parameters.pitch.abs() < LEVEL {
                "the picture looks level: its focal length cannot be seen in it"
            } else {
                "the annotations do not show the focal length"
            };
            remarks.push(format!("{why}; turning the head may swim; type it if you know it"));
        }
        remarks.extend(self.background_remarks());
        remarks
    }

    fn tilt_remark(&self) -> Option<String> {
        let SceneParameters { pitch, roll, .. } = *self.parameters;
        (pitch.abs() >= LARGEST_PITCH || roll.abs() >= LARGEST_ROLL).then(|| {
            let (pitch, roll) = (LARGEST_PITCH.to_degrees(), LARGEST_ROLL.to_degrees());
            format!("horizon and pairs ask for a camera tilted by more than {pitch:.0}° up or down or {roll:.0}° sideways: check them")
        })
    }

    fn horizon_remark(&self) -> Option<String> {
        let ends = self.annotations.horizon?;
        let lens = metric::lens(self.annotations, self.unknowns);
        // Pixels by which each marked end lies below the solved horizon.
        let below = ends.map(|end| {
            let (level, derivative) = lens.level_with_derivative(end);
            level.y / derivative.y_axis.y
        });
        let worst = if below[0].abs() > below[1].abs() { below[0] } else { below[1] };
        let limit = (2.0 * self.annotations.horizon_deviation_px).max(3.0);
        let side = if worst > 0.0 { "below" } else { "above" };
        (worst.abs() > limit).then(|| {
            format!("the marked horizon lies {:.0} px {side} where the reflections put it", worst.abs())
        })
    }

    fn principal_remark(&self) -> Option<String> {
        let shift = self.parameters.principal.0 - self.annotations.principal.0;
        let deviation = self.annotations.principal_deviation_px;
        (deviation > 0.0 && shift.length() > 1.5 * deviation).then(|| {
            format!(
                "horizon and reflections agree only if the lens pointed {:.0} px from the picture's middle: was it cropped, or is the horizon off?",
                shift.length()
            )
        })
    }

    fn background_remarks(&self) -> Vec<String> {
        let (annotations, distance) = (self.annotations, self.parameters.background_distance);
        let lens = metric::lens(annotations, self.unknowns);
        let (_, source) = metric::seen_background_dip(annotations, &lens, self.unknowns, &self.evidence.kept);
        let mut remarks = Vec::new();
        match source {
            BackgroundSource::Assumed if annotations.background == BackgroundHint::Open => {}
            BackgroundSource::Assumed => remarks.push(format!(
                "nothing shows how far the background is; {distance:.0} m are assumed: mark where it meets the water"
            )),
            BackgroundSource::FarPairs(count) => remarks.push(format!(
                "the reflection pairs do not lie at one depth; the background is put at {distance:.0} m, the middle of the {count} farthest"
            )),
            BackgroundSource::Given | BackgroundSource::Contact(_) | BackgroundSource::Pairs | BackgroundSource::FreePairs(_) => {}
        }
        let kept = annotations.pairs.iter().zip(&self.evidence.kept).filter(|(_, kept)| **kept);
        let has_pairs = kept.clone().any(|(pair, _)| pair.on == PairPlane::Background);
        if has_pairs && self.evidence.fitted[LN_BACKGROUND_DIP] {
            let by_pairs = self.parameters.height / background_dip(self.unknowns);
            if (by_pairs / distance).ln().abs() > 2.0 * MEASURED_RATIO {
                remarks.push(format!(
                    "the background's reflections put it at {by_pairs:.0} m, not {distance:.0} m"
                ));
            }
        }
        let marked = matches!(annotations.background, BackgroundHint::Contact(_));
        if marked && !matches!(source, BackgroundSource::Contact(_)) {
            remarks.push(
                "none of the points where the background meets the water is below the horizon".to_owned(),
            );
        }
        for plane in &annotations.planes {
            let level = match plane.support {
                Support::Water => 0.0,
                Support::Ground => self.parameters.ground_height,
            };
            let depths = plane.contact.map(|foot| self.parameters.depth_on_level(foot, level));
            match depths {
                [Some(left), Some(right)] if left.min(right) > distance => remarks.push(format!(
                    "{:?} stands {:.0} m away, beyond the background at {distance:.0} m",
                    plane.name,
                    left.min(right)
                )),
                [Some(_), Some(_)] => {}
                _ => remarks.push(format!("the contact line of {:?} is not below the horizon", plane.name)),
            }
        }
        remarks
    }
}
