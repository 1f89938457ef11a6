//! The full method: pitch, roll and as many depths as there are planes, from all evidence at once (README, "Full").
//!
//! Start from lines that vote, fit, leave out the pairs that do not agree, and fit again until the same pairs stay.

use super::AnnotatedPair;
use super::Annotations;
use super::BackgroundHint;
use super::FocalLength;
use super::PairPlane;
use super::PairReport;
use super::Scale;
use super::Solution;
use super::SolveError;
use super::Support;
use super::convergence;
use super::fit::fit;
use super::judge::judge;
use super::judge::own_dip;
use super::metric;
use super::pair::dip_at;
use super::residual::Evidence;
use super::residual::FocalPrior;
use super::residual::LN_BACKGROUND_DIP;
use super::residual::LN_FOCAL;
use super::residual::LN_HEIGHT_RATIO;
use super::residual::PITCH;
use super::residual::PRINCIPAL_X;
use super::residual::PRINCIPAL_Y;
use super::residual::ROLL;
use super::residual::Source;
use super::residual::UNKNOWNS;
use super::residual::Unknowns;
use super::summary;

/// What is taken for granted of pictures in general.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Guesses {
    /// A usual focal length.
    Used,
    /// Nothing; for tests of what a picture itself shows.
    #[cfg(test)]
    Dropped,
}

/// Focal length of a usual lens, as part of the picture's diagonal: 23 to 46 mm on 35 mm film within one deviation.
const USUAL_FOCAL: f64 = 0.75;
/// Standard deviation of its natural logarithm.
const USUAL_LN_DEVIATION: f64 = 0.35;
/// Shortest and longest focal length that is believed, in widths of the uncropped picture.
const FOCAL_RANGE: [f64; 2] = [0.2, 8.0];
/// Fewest pairs that show roll and nadir.
const FEWEST_PAIRS: usize = 2;
/// Leaving out and taking back pairs stops after this many rounds.
const ROUNDS: usize = 5;

/// A guess of the focal length without any knowledge of the camera, pixels.
pub(super) fn usual_focal(annotations: &Annotations) -> f64 {
    USUAL_FOCAL * annotations.uncropped_size.as_dvec2().length()
}

/// Solves checked annotations.
pub(super) fn solve(annotations: &Annotations, guesses: Guesses) -> Result<Solution, SolveError> {
    let found = annotations.pairs.len();
    if annotations.horizon.is_none() && found < FEWEST_PAIRS {
        return Err(SolveError::NothingToSolveFrom { found });
    }
    let (focal_px, focal_prior, range) = focal_knowledge(annotations, guesses);
    let free_focal = !matches!(annotations.focal, FocalLength::Known(_));
    let start = convergence::start(annotations, focal_px, free_focal);

    let mut unknowns = [0.0; UNKNOWNS];
    unknowns[LN_FOCAL] = start.focal_px.ln().clamp(range[0], range[1]);
    unknowns[PITCH] = start.pitch;
    unknowns[ROLL] = start.roll;
    let given_ratio = given_height_ratio(annotations);
    unknowns[LN_HEIGHT_RATIO] = given_ratio.unwrap_or(1.0).ln();
    start_ratios(annotations, &mut unknowns, given_ratio.is_none());

    let evidence = |kept: Vec<bool>| {
        let fitted = fitted(annotations, &kept, given_ratio.is_none());
        Evidence { annotations, kept, focal_prior, ln_focal_range: range, fitted }
    };
    let mut current = evidence(vec![true; found]);
    unknowns = fit_above_water(&current, unknowns);
    let mut pairs = judge_all(annotations, &unknowns);
    for _ in 0..ROUNDS {
        let kept: Vec<bool> = pairs.iter().map(|pair| pair.kept).collect();
        if kept == current.kept {
            break;
        }
        let agreeing = kept.iter().filter(|kept| **kept).count();
        if annotations.horizon.is_none() && agreeing < FEWEST_PAIRS {
            return Err(SolveError::PairsDisagree { agreeing, found });
        }
        current = evidence(kept);
        if !current.fitted[LN_HEIGHT_RATIO] {
            // What spoke of it may just have been left out.
            unknowns[LN_HEIGHT_RATIO] = given_ratio.unwrap_or(1.0).ln();
        }
        unknowns = fit_above_water(&current, unknowns);
        pairs = judge_all(annotations, &unknowns);
    }
    let parameters = metric::parameters(annotations, &unknowns, &current.kept)?;
    for (report, kept) in pairs.iter_mut().zip(&current.kept) {
        report.kept = *kept;
        report.depth = report.depth.map(|depth| depth * parameters.height);
    }
    let report = summary::report(&current, &unknowns, &parameters, pairs);
    Ok(Solution { parameters, report })
}

/// Reports on all pairs, with depths in camera heights.
fn judge_all(annotations: &Annotations, unknowns: &Unknowns) -> Vec<PairReport> {
    let lens = metric::lens(annotations, unknowns);
    annotations.pairs.iter().map(|pair| judge(annotations, &lens, unknowns, 1.0, pair)).collect()
}

/// Fits; ground that would lie below the water is put level with it.
fn fit_above_water(evidence: &Evidence<'_>, start: Unknowns) -> Unknowns {
    let fitted = fit(evidence, start);
    if fitted[LN_HEIGHT_RATIO] >= 0.0 || !evidence.fitted[LN_HEIGHT_RATIO] {
        return fitted;
    }
    let mut level = evidence.clone();
    level.fitted[LN_HEIGHT_RATIO] = false;
    let mut start = fitted;
    start[LN_HEIGHT_RATIO] = 0.0;
    fit(&level, start)
}

/// Where to start the focal length, what to hold it to, and the range of its logarithm.
fn focal_knowledge(annotations: &Annotations, guesses: Guesses) -> (f64, Option<FocalPrior>, [f64; 2]) {
    let range = FOCAL_RANGE.map(|widths| (widths * f64::from(annotations.uncropped_size.x)).ln());
    let prior = |px: f64, deviation, source| Some(FocalPrior { ln_focal: px.ln(), deviation, source });
    match annotations.focal {
        FocalLength::Known(px) => (px, None, [px.ln(); 2]),
        FocalLength::Between(shortest, longest) => {
            let middle = (shortest * longest).sqrt();
            // Standard deviation of an even distribution over the range.
            let deviation = (longest / shortest).ln() / 12.0_f64.sqrt();
            (middle, prior(middle, deviation, Source::Guess), [shortest.ln(), longest.ln()])
        }
        FocalLength::Prior { px, ln_deviation } => (px, prior(px, ln_deviation, Source::FocalInFile), range),
        FocalLength::Unknown => {
            let px = usual_focal(annotations);
            let held = guesses == Guesses::Used;
            (px, prior(px, USUAL_LN_DEVIATION, Source::Guess).filter(|_| held), range)
        }
    }
}

/// Camera height above water / above ground, if the tour says both.
pub(super) fn given_height_ratio(annotations: &Annotations) -> Option<f64> {
    let ground = annotations.ground_height?;
    match annotations.scale {
        Scale::HeightAboveWater { meters, .. } => Some(meters / (meters - ground)),
        Scale::HeightAboveGround(meters) => Some((meters + ground) / meters),
        Scale::Length { .. } => None,
    }
}

/// Which unknowns the kept evidence speaks of.
fn fitted(annotations: &Annotations, kept: &[bool], ratio_open: bool) -> [bool; UNKNOWNS] {
    let mut pairs = annotations.pairs.iter().zip(kept).filter(|(_, kept)| **kept).map(|(pair, _)| pair.on);
    let on_background = pairs.clone().any(|on| on == PairPlane::Background);
    let on_ground = pairs.any(|on| stands_on_ground(annotations, on));
    let meets_water =
        matches!(&annotations.background, BackgroundHint::Contact(points) if !points.is_empty());
    let background_meets_both = !annotations.ground_contact.is_empty() && (on_background || meets_water);

    let mut fitted = [false; UNKNOWNS];
    fitted[PITCH] = true;
    fitted[ROLL] = true;
    fitted[LN_FOCAL] = !matches!(annotations.focal, FocalLength::Known(_));
    fitted[PRINCIPAL_X] = annotations.principal_deviation_px > 0.0;
    fitted[PRINCIPAL_Y] = fitted[PRINCIPAL_X];
    fitted[LN_HEIGHT_RATIO] = ratio_open && (on_ground || background_meets_both);
    fitted[LN_BACKGROUND_DIP] = on_background || background_meets_both;
    fitted
}

fn stands_on_ground(annotations: &Annotations, on: PairPlane) -> bool {
    match on {
        PairPlane::Plane(index) => {
            annotations.planes.get(index).is_some_and(|plane| plane.support == Support::Ground)
        }
        PairPlane::Free | PairPlane::Background => false,
    }
}

/// Starts the ratio of heights and the background's dip at what single pairs say.
fn start_ratios(annotations: &Annotations, unknowns: &mut Unknowns, ratio_open: bool) {
    let lens = metric::lens(annotations, unknowns);
    let middle = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied()
    };
    let dips = annotations.pairs.iter().filter_map(|pair| Some((pair, own_dip(&lens, pair)?)));
    if ratio_open {
        let of_foot = |(pair, dip): (&AnnotatedPair, f64)| {
            let foot = dip_at(annotations, &lens, unknowns, pair.on, lens.level(pair.point).x)?;
            (stands_on_ground(annotations, pair.on) && foot.dip > 0.0).then(|| dip / foot.dip)
        };
        let ratio = middle(dips.clone().filter_map(of_foot).collect());
        unknowns[LN_HEIGHT_RATIO] = ratio.unwrap_or(1.0).clamp(1.0, 10.0).ln();
    }
    let on_background =
        dips.filter(|(pair, _)| pair.on == PairPlane::Background).map(|(_, dip)| dip).collect();
    let contact = match &annotations.background {
        BackgroundHint::Contact(points) => points.iter().map(|&point| -lens.level(point).y).collect(),
        BackgroundHint::Distance(_) | BackgroundHint::FromPairs | BackgroundHint::Open => Vec::new(),
    };
    let dip = middle(on_background).or_else(|| middle(contact)).unwrap_or(0.02);
    unknowns[LN_BACKGROUND_DIP] = dip.max(1e-4).ln();
}
