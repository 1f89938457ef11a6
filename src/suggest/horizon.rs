//! The horizon that a reflection allows, with an honest deviation.
//!
//! A part that mirrors at distance z has its axis f·h/z below the horizon (notes §2.1), so the highest axis bounds the
//! horizon from above it and, being that of something tens to thousands of camera heights away, from below too. In a
//! pitched picture the reflections' lean towards the nadir says how far the horizon lies from the middle (notes §1.3 A, B:
//! a = w·f²), as well as the focal length is known. Both are joined by adding up the likelihood row by row.

use glam::UVec2;

use super::nadir::Nadir;
use super::pairs::SuggestedPairs;
use super::reflection::Reflection;
use crate::picture::PicturePoint;
use crate::solve::Annotations;

/// A horizon to propose.
#[derive(Clone, Debug, PartialEq)]
pub struct SuggestedHorizon {
    /// Where it meets the picture's left and right border.
    pub ends: [PicturePoint; 2],
    /// Standard deviation of its height in the picture, pixels.
    pub deviation_px: f64,
    /// Whether it may be believed, 0–1.
    pub confidence: f64,
    /// Where it comes from, one sentence.
    pub reason: String,
}

/// Far parts stand this many camera heights away: a pond's bank to mountains beyond a lake.
const FAR: [f64; 2] = [15.0, 2000.0];
/// Where the horizon of a picture without any clue lies, share of its height, and the deviation: half of all
/// photographs with a horizon have it between 35 % and 55 %.
const USUAL: [f64; 2] = [0.45, 0.15];
/// Steps in which likelihoods are added up.
const STEPS: usize = 4000;

/// The horizon by what is usual, for a picture in which nothing tells it.
#[must_use]
pub fn usual_horizon(size: UVec2) -> SuggestedHorizon {
    let [row, deviation] = USUAL.map(|share| share * f64::from(size.y));
    SuggestedHorizon {
        ends: [0.0, f64::from(size.x)].map(|x| PicturePoint::new(x, row)),
        deviation_px: deviation,
        confidence: 0.05,
        reason: format!(
            "nothing in the picture tells the horizon; it is put at {:.0} % of the height, as in most pictures",
            100.0 * USUAL[0]
        ),
    }
}

/// The horizon that a reflection and its pairs allow.
#[must_use]
pub fn suggest_horizon(reflection: &Reflection, pairs: &SuggestedPairs, size: UVec2) -> SuggestedHorizon {
    let (width, height) = (f64::from(size.x), f64::from(size.y));
    let middle = width / 2.0;
    let usual_focal = 0.75 * size.as_dvec2().length();
    let camera = pairs.solution.as_ref().map(|solution| solution.parameters);
    let focal = camera.map_or(usual_focal, |camera| camera.focal_px);

    // By the lean of the reflections.
    let by_lean = camera.and_then(|camera| {
        let [left, right] = camera.camera(size).horizon()?;
        let row = (left.y() + right.y()) / 2.0;
        let solution = pairs.solution.as_ref()?;
        let ln_focal = solution.report.parameter("focal_px")?.deviation.unwrap_or(focal) / focal;
        let from_axis = row - camera.principal.y();
        let nadir = Nadir::deviation(&reflection.matches, SIDEWAYS_PX.max(0.0005 * height));
        let center = Annotations::PRINCIPAL_DEVIATION * width;
        let deviation = (focal * focal * nadir).hypot(2.0 * from_axis * ln_focal).hypot(center);
        Some((row, deviation, (right.y() - left.y()) / width))
    });
    let slope = by_lean.map_or(reflection.axis.slope(), |(_, _, slope)| {
        // Few or short pairs tell the roll badly.
        if pairs.pairs.len() >= 4 { slope } else { reflection.axis.slope() }
    });

    // By the farthest part: its axis as the solver levels it, or as it is seen.
    let highest = camera
        .and_then(|camera| {
            let horizon = by_lean?.0;
            let reports = &pairs.solution.as_ref()?.report.pairs;
            let mut below: Vec<f64> = reports
                .iter()
                .map(|pair| pair.depth.map_or(0.0, |depth| focal * camera.height / depth))
                .collect();
            below.sort_by(f64::total_cmp);
            // One pair may be wrong.
            let second = *below.get(1)?;
            (second > 0.0).then_some(horizon + second)
        })
        .unwrap_or_else(|| reflection.highest_axis(middle));
    let [nearest, farthest] = FAR.map(|heights| focal / heights);
    let (usual, usual_deviation) = (USUAL[0] * height, 3.0 * USUAL[1] * height);
    let log_likelihood = |below: f64| {
        let row = highest - below;
        let lean = by_lean.map_or(0.0, |(expected, deviation, _)| ((row - expected) / deviation).powi(2));
        -0.5 * (lean + ((row - usual) / usual_deviation).powi(2))
    };
    // Even in the logarithm of the distance: as likely between 50 and 100 m as between 500 and 1000 m.
    let distances = (0..STEPS).map(|i| {
        let part = (i as f64 + 0.5) / STEPS as f64;
        farthest * (nearest / farthest).powf(part)
    });
    let most = distances.clone().map(log_likelihood).fold(f64::NEG_INFINITY, f64::max);
    let mut sum = 0.0;
    let sums: Vec<(f64, f64)> = distances
        .map(|below| {
            sum += (log_likelihood(below) - most).exp();
            (below, sum)
        })
        .collect();
    // The middle, and half of what holds 68 %: few large distances do not drag it along.
    let quantile =
        |part: f64| sums[sums.partition_point(|(_, so_far)| *so_far < part * sum).min(STEPS - 1)].0;
    let below = quantile(0.5);
    let deviation_px = (0.5 * (quantile(0.84) - quantile(0.16))).hypot(AXIS_PX);
    let row = highest - below;
    let ends = [0.0, width].map(|x| PicturePoint::new(x, row + slope * (x - middle)));
    let lean_px = by_lean.map_or(f64::INFINITY, |(_, deviation, _)| deviation);
    let reason = if lean_px < 2.0 * deviation_px {
        format!(
            "{below:.0} px above the axis of the farthest part, by that and by where the reflections lean to; \
             good to about {deviation_px:.0} px"
        )
    } else {
        format!(
            "{below:.0} px above the axis of the farthest part, a guess of its distance; good to about \
             {deviation_px:.0} px: move it if you see the true horizon"
        )
    };
    let confidence = reflection.axis.confidence * (0.01 * height / deviation_px).min(1.0);
    SuggestedHorizon { ends, deviation_px, confidence, reason }
}

/// How exactly images are found sideways at least, and the highest axis, pixels.
const SIDEWAYS_PX: f64 = 0.3;
const AXIS_PX: f64 = 0.5;
