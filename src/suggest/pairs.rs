//! Reflection pairs to propose: matches that the solver itself agrees with, spread over the picture.
//!
//! At most twenty, those that tell most about the camera first: long ones far to the sides (notes §2.2, step 5), and some
//! of every part that mirrors. No pair remains that [`crate::solve`] would leave out.

use glam::{DVec2, UVec2};

use super::matching::Match;
use super::reflection::Reflection;
use crate::picture::{Lens, PicturePoint};
use crate::solve::{
    AnnotatedPair, Annotations, BackgroundHint, FocalLength, PairPlane, Scale, Solution, solve,
};
use crate::tour::{ASSUMED_HEIGHT, Method, ReflectionPair};

/// Most pairs that are proposed.
pub const MOST_PAIRS: usize = 20;

/// A pair to propose.
#[derive(Clone, Debug, PartialEq)]
pub struct SuggestedPair {
    /// The pair as the tour would say it, on nothing named.
    pub pair: ReflectionPair,
    /// How alike its two ends look, 0–1.
    pub score: f64,
    /// Standard deviation of the reflection against the point, the larger of both directions, pixels.
    pub sigma_px: f64,
}

/// Pairs and the camera that they show.
#[derive(Clone, Debug)]
pub struct SuggestedPairs {
    /// At most [`MOST_PAIRS`], from the left to the right; the solution's report has them in the same order.
    pub pairs: Vec<SuggestedPair>,
    /// What the solver makes of them, without any horizon; `None` where they are fewer than two.
    pub solution: Option<Solution>,
}

/// Evidence that consists of these pairs alone, with deviations as they were measured.
pub(super) fn annotations(size: UVec2, lens: Option<Lens>, pairs: &[SuggestedPair]) -> Annotations {
    Annotations {
        size,
        uncropped_size: size,
        principal: PicturePoint(size.as_dvec2() / 2.0),
        principal_deviation_px: Annotations::PRINCIPAL_DEVIATION * f64::from(size.x),
        horizon: None,
        horizon_deviation_px: Annotations::HORIZON_DEVIATION_PX,
        focal: FocalLength::of_lens(lens, size),
        scale: Scale::HeightAboveWater { meters: ASSUMED_HEIGHT, assumed: true },
        planes: Vec::new(),
        background: BackgroundHint::FromPairs,
        ground_height: None,
        ground_contact: Vec::new(),
        pairs: pairs
            .iter()
            .enumerate()
            .map(|(i, pair)| {
                let ReflectionPair { point, reflection, .. } = pair.pair;
                AnnotatedPair {
                    point_deviation_px: pair.sigma_px / 2.0,
                    reflection_deviation_px: [pair.sigma_px, 2.0 * pair.sigma_px],
                    ..AnnotatedPair::new(format!("pair {}", i + 1), point, reflection, PairPlane::Free)
                }
            })
            .collect(),
        method: Method::Full,
    }
}

/// The same evidence as a tour's own solver takes it: with the deviations of marks made by hand.
fn as_marked(mut evidence: Annotations) -> Annotations {
    for pair in &mut evidence.pairs {
        *pair = AnnotatedPair::new(pair.name.clone(), pair.point, pair.reflection, pair.on);
    }
    evidence
}

/// Whether a tour's own solver keeps all pairs beside this horizon.
pub(super) fn agree_with(
    horizon: [PicturePoint; 2],
    size: UVec2,
    lens: Option<Lens>,
    pairs: &[SuggestedPair],
) -> bool {
    let mut evidence = as_marked(annotations(size, lens, pairs));
    evidence.horizon = Some(horizon);
    solve(&evidence).is_ok_and(|solution| solution.report.pairs.iter().all(|pair| pair.kept))
}

/// Chooses pairs among a reflection's matches. `lens` is what the picture's file says of its lens.
#[must_use]
pub fn suggest_pairs(reflection: &Reflection, size: UVec2, lens: Option<Lens>) -> SuggestedPairs {
    let mut left = reflection.matches.clone();
    // Each round leaves out at least one match, so this ends.
    loop {
        let mut chosen = spread(&left, size.as_dvec2());
        chosen.sort_by(|a, b| a.point.x.total_cmp(&b.point.x));
        let pairs: Vec<SuggestedPair> = chosen.iter().map(|m| suggested(reflection, m)).collect();
        let evidence = annotations(size, lens, &pairs);
        let (Ok(solution), Ok(marked)) = (solve(&evidence), solve(&as_marked(evidence))) else {
            return SuggestedPairs { pairs, solution: None };
        };
        let reports = solution.report.pairs.iter().zip(&marked.report.pairs);
        let kept: Vec<bool> = reports.map(|(measured, marked)| measured.kept && marked.kept).collect();
        if kept.iter().all(|kept| *kept) {
            return SuggestedPairs { pairs, solution: Some(solution) };
        }
        let refused = chosen.iter().zip(&kept).filter(|(_, kept)| !**kept).map(|(m, _)| *m);
        let refused: Vec<Match> = refused.collect();
        left.retain(|m| !refused.contains(m));
    }
}

fn suggested(reflection: &Reflection, m: &Match) -> SuggestedPair {
    let [point, image] = reflection.in_picture(m);
    SuggestedPair {
        pair: ReflectionPair { point, reflection: image, on: None, name: None },
        score: m.score.clamp(0.0, 1.0),
        sigma_px: m.deviation.max_element().max(LEAST_DEVIATION_PX),
    }
}

/// No match is better than this.
const LEAST_DEVIATION_PX: f64 = 0.2;

/// Matches far from each other in column, row and depth, the good ones and those of much information first.
fn spread(matches: &[Match], size: DVec2) -> Vec<Match> {
    // Axes of near parts differ more than those of far ones; a fiftieth of the height counts as much as half the width.
    let place = |m: &Match| [m.point.x / size.x, 0.5 * m.point.y / size.y, 25.0 * m.axis() / size.y];
    let apart = |a: &Match, b: &Match| {
        let (a, b) = (place(a), place(b));
        let square = |i: usize| (a[i] - b[i]).clamp(-0.5, 0.5).powi(2);
        (square(0) + square(1) + square(2)).sqrt()
    };
    let quality = |m: &Match| {
        let sure = m.score / (1.0 + m.deviation.max_element() / (0.002 * size.y));
        let telling = m.length() / size.y * (m.point.x / size.x - 0.5).abs();
        sure * (0.5 + telling)
    };
    let mut chosen: Vec<Match> = Vec::new();
    while chosen.len() < MOST_PAIRS.min(matches.len()) {
        let worth = |m: &Match| {
            let nearest = chosen.iter().map(|other| apart(m, other)).fold(0.5, f64::min);
            quality(m) * nearest
        };
        let best = matches.iter().max_by(|a, b| worth(a).total_cmp(&worth(b)));
        let Some(best) = best.filter(|best| worth(best) > 0.0) else { break };
        chosen.push(*best);
    }
    chosen
}
