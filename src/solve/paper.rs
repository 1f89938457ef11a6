//! The paper's method: a level camera, reflected points on one plane, the focal length from elsewhere.
//!
//! The paper minimizes over focal length f, distance d and camera height `h_w`. Its objective shrinks to nothing as
//! d and `h_w` do (README, "Paper"), so only what it really shows, the background's waterline, is taken from it, in closed form.

use glam::DVec2;

use super::AnnotatedPair;
use super::Annotations;
use super::BackgroundHint;
use super::FocalLength;
use super::Label;
use super::Method;
use super::PairPlane;
use super::PairReport;
use super::ParameterReport;
use super::Scale;
use super::SceneParameters;
use super::Solution;
use super::SolveError;
use super::SolveReport;
use super::full::given_height_ratio;
use super::full::usual_focal;
use super::judge::judge;
use super::metric;
use super::residual::CONTACT_DEVIATION_PX;
use super::residual::LN_BACKGROUND_DIP;
use super::residual::LN_FOCAL;
use super::residual::LN_HEIGHT_RATIO;
use super::residual::PRINCIPAL_Y;
use super::residual::UNKNOWNS;
use super::summary::assumed;
use super::summary::given;
use crate::picture::PicturePoint;

/// The paper's residuals of one pair, in the unit of `distance` and `height` (notes §1.1; the paper's section on camera
/// parameters): `((u − u′)·d/f, (v + v′)·d/f + 2·h_w)`.
///
/// `point` and `reflection` are in pixels from the principal point, v *up*; the camera is level.
#[must_use]
pub fn paper_residual(
    point: [f64; 2],
    reflection: [f64; 2],
    focal_px: f64,
    distance: f64,
    height: f64,
) -> [f64; 2] {
    let pixel = distance / focal_px;
    [(point[0] - reflection[0]) * pixel, (point[1] + reflection[1]) * pixel + 2.0 * height]
}

/// The paper's objective, the sum of squares of [`paper_residual`] over `pairs` of point and reflection.
///
/// Here for reading and testing. It must not be handed to an optimizer: scaling `distance` and `height` by s scales it
/// by s², so that its least value is 0 at the camera itself, whatever the picture.
#[must_use]
pub fn paper_objective(pairs: &[([f64; 2], [f64; 2])], focal_px: f64, distance: f64, height: f64) -> f64 {
    let square = |(point, reflection): &([f64; 2], [f64; 2])| {
        DVec2::from_array(paper_residual(*point, *reflection, focal_px, distance, height)).length_squared()
    };
    pairs.iter().map(square).sum()
}

/// Solves checked annotations.
pub(super) fn solve(annotations: &Annotations) -> Result<Solution, SolveError> {
    let horizon_y = horizon_row(annotations);
    let used = pairs_used(annotations);
    let found = annotations.pairs.len();
    if annotations.horizon.is_none() && !used.contains(&true) {
        return Err(SolveError::NothingToSolveFrom { found });
    }
    let focal_px = match annotations.focal {
        FocalLength::Known(px) | FocalLength::Prior { px, .. } => px,
        FocalLength::Between(shortest, longest) => (shortest * longest).sqrt(),
        FocalLength::Unknown => usual_focal(annotations),
    };
    let ratio = given_height_ratio(annotations).unwrap_or(1.0);
    let mut unknowns = [0.0; UNKNOWNS];
    unknowns[LN_FOCAL] = focal_px.ln();
    unknowns[LN_HEIGHT_RATIO] = ratio.ln();
    unknowns[PRINCIPAL_Y] = (horizon_y - annotations.principal.y()) / f64::from(annotations.size.x);

    let waterline = waterline(annotations, &used, horizon_y);
    let dip = waterline.map(|(below, _)| below / focal_px).filter(|dip| *dip > 0.0);
    unknowns[LN_BACKGROUND_DIP] = dip.unwrap_or(f64::NAN).ln();
    // The waterline stands for all the pairs it was made of, whatever plane they were marked on.
    let mut parameters = metric::parameters(annotations, &unknowns, &vec![false; found])?;
    if let (Some(dip), BackgroundHint::FromPairs | BackgroundHint::Contact(_)) =
        (dip, &annotations.background)
    {
        parameters.background_distance = parameters.height / dip;
    }

    let lens = metric::lens(annotations, &unknowns);
    let judged = |(pair, &used): (&AnnotatedPair, &bool)| {
        let mut of_plane = pair.clone();
        if used && dip.is_some() {
            of_plane.on = PairPlane::Background;
        }
        let mut report = judge(annotations, &lens, &unknowns, parameters.height, &of_plane);
        report.kept = used;
        if !used && report.remark.is_none() {
            report.remark = Some("the paper's method takes the background's pairs only".to_owned());
        }
        report
    };
    let pairs = annotations.pairs.iter().zip(&used).map(judged).collect();

    let report = report(annotations, &parameters, waterline.filter(|_| dip.is_some()), pairs);
    Ok(Solution { parameters, report })
}

/// The report: what the method takes from elsewhere is given or assumed, only the waterline is measured.
fn report(
    annotations: &Annotations,
    parameters: &SceneParameters,
    waterline: Option<(f64, f64)>,
    pairs: Vec<PairReport>,
) -> SolveReport {
    let SceneParameters { focal_px, height, ground_height, background_distance, .. } = *parameters;
    let mut remarks = Vec::new();
    let focal = match annotations.focal {
        FocalLength::Known(_) => given("focal_px", focal_px),
        FocalLength::Prior { ln_deviation, .. } => ParameterReport {
            deviation: Some(ln_deviation * focal_px),
            from: vec!["focal length in the file"],
            ..given("focal_px", focal_px)
        },
        FocalLength::Between(..) | FocalLength::Unknown => {
            remarks.push(
                "a level picture does not show its focal length; turning the head may swim; type it if you know it"
                    .to_owned(),
            );
            assumed("focal_px", focal_px)
        }
    };
    let height = match annotations.scale {
        Scale::HeightAboveWater { assumed: true, .. } => assumed("height", height),
        Scale::HeightAboveWater { .. } | Scale::HeightAboveGround(_) | Scale::Length { .. } => {
            given("height", height)
        }
    };
    let ground = annotations
        .ground_height
        .map_or_else(|| assumed("ground_height", ground_height), |meters| given("ground_height", meters));
    let background = match (&annotations.background, waterline) {
        (BackgroundHint::Distance(meters), waterline) => {
            let by_pairs = waterline.map(|(below, _)| parameters.height * focal_px / below);
            remarks.extend(by_pairs.filter(|by_pairs| (by_pairs / meters).ln().abs() > 0.2).map(
                |by_pairs| {
                    format!("the background's reflections put it at {by_pairs:.0} m, not {meters:.0} m")
                },
            ));
            Some(given("background_distance", *meters))
        }
        (BackgroundHint::Open, _) => None,
        (BackgroundHint::Contact(_) | BackgroundHint::FromPairs, Some((below, deviation))) => {
            Some(distance_report(background_distance, deviation / below, annotations))
        }
        (BackgroundHint::Contact(_) | BackgroundHint::FromPairs, None) => {
            remarks.push(format!(
                "nothing below the horizon shows how far the background is; {background_distance:.0} m are assumed"
            ));
            Some(assumed("background_distance", background_distance))
        }
    };
    let (pitch, roll) = (assumed("pitch", 0.0), assumed("roll", 0.0));
    SolveReport {
        method: Method::Paper,
        parameters: [focal, pitch, roll, height, ground].into_iter().chain(background).collect(),
        pairs,
        remarks,
    }
}

/// The row of the horizon in the picture's middle, or that of the principal point.
fn horizon_row(annotations: &Annotations) -> f64 {
    annotations.horizon.map_or(annotations.principal.y(), |[left, right]| {
        let t = (annotations.principal.x() - left.x()) / (right.x() - left.x());
        left.y() + t * (right.y() - left.y())
    })
}

/// Which pairs make the waterline: those on the background, or else all free ones.
fn pairs_used(annotations: &Annotations) -> Vec<bool> {
    let on = |wanted: PairPlane| annotations.pairs.iter().map(move |pair| pair.on == wanted);
    if on(PairPlane::Background).any(|is| is) {
        on(PairPlane::Background).collect()
    } else {
        on(PairPlane::Free).collect()
    }
}

/// How far the background's waterline lies below the horizon, and its deviation, pixels: the mean of the middles, or
/// of the contact points where there is no pair.
fn waterline(annotations: &Annotations, used: &[bool], horizon_y: f64) -> Option<(f64, f64)> {
    let (mut rows, mut variance) = (Vec::new(), 0.0);
    for (pair, _) in annotations.pairs.iter().zip(used).filter(|(_, used)| **used) {
        rows.push((pair.point.y() + pair.reflection.y()) / 2.0 - horizon_y);
        variance += pair.point_deviation_px.hypot(pair.reflection_deviation_px[1]).powi(2) / 4.0;
    }
    if let (BackgroundHint::Contact(points), true) = (&annotations.background, rows.is_empty()) {
        rows.extend(points.iter().map(|point: &PicturePoint| point.y() - horizon_y));
        variance = rows.len() as f64 * CONTACT_DEVIATION_PX * CONTACT_DEVIATION_PX;
    }
    let count = rows.len() as f64;
    let mean = rows.iter().sum::<f64>() / count;
    (!rows.is_empty())
        .then(|| (mean, (variance / count / count).sqrt().hypot(annotations.horizon_deviation_px)))
}

fn distance_report(value: f64, relative: f64, annotations: &Annotations) -> ParameterReport {
    let label = match (relative, annotations.focal) {
        (_, FocalLength::Between(..) | FocalLength::Unknown) => Label::Weak,
        (relative, _) if relative <= 0.1 => Label::Measured,
        (relative, _) if relative <= 0.35 => Label::Weak,
        _ => Label::Assumed,
    };
    let points = if annotations.pairs.is_empty() { "background contact" } else { "reflection pairs" };
    let from = vec![points, "horizon"];
    ParameterReport { name: "background_distance", value, deviation: Some(relative * value), label, from }
}
