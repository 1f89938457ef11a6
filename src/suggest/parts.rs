//! Which matches belong together: parts of the picture at one distance share an axis.

use glam::DVec2;

use super::matching::Match;
use super::nadir::Nadir;

/// Corners of one part have axes this close to each other, share of the height; and stand this close, share of the width.
pub(super) const SAME_AXIS: f64 = 0.008;
const NEAR: f64 = 0.2;
/// Others that must agree with a corner, and the least share of its close neighbors (within half of `NEAR`) that must.
const SUPPORT: usize = 2;
const CLOSE_SHARE: f64 = 0.25;

/// The matches that lie on their line to the nadir and whose axis their neighbors share.
pub(super) fn agreeing(matches: &[Match], nadir: Nadir, tolerance: f64, size: DVec2) -> Vec<Match> {
    let straight: Vec<Match> =
        matches.iter().copied().filter(|m| nadir.off(m.point, m.image).abs() < tolerance).collect();
    let same = (SAME_AXIS * size.y).max(tolerance);
    let supported = |a: &&Match| {
        let (mut support, mut close, mut close_support) = (0_usize, 0_u32, 0_u32);
        for b in &straight {
            let apart = (a.point - b.point).abs();
            // Overlapping patches are no second witness.
            if apart.max_element() < 0.01 * size.y || apart.x > NEAR * size.x {
                continue;
            }
            let agrees = (a.axis() - b.axis()).abs() < same;
            let is_close = apart.max_element() < 0.5 * NEAR * size.x;
            support += usize::from(agrees);
            close += u32::from(is_close);
            close_support += u32::from(is_close && agrees);
        }
        support >= SUPPORT && f64::from(close_support) >= CLOSE_SHARE * f64::from(close)
    };
    straight.iter().filter(supported).copied().collect()
}

/// The axis with the most matches about it.
pub(super) fn commonest_axis(matches: &[Match], width: f64) -> f64 {
    let about = |axis: f64| matches.iter().map(Match::axis).filter(move |other| (other - axis).abs() < width);
    let best = matches.iter().map(Match::axis).max_by_key(|&axis| about(axis).count());
    best.map_or(0.0, |axis| {
        let mut near: Vec<f64> = about(axis).collect();
        near.sort_by(f64::total_cmp);
        near[near.len() / 2]
    })
}

/// The axes of the parts that mirror, the strongest first: those of matches that share one.
pub(super) fn parts(matches: &[Match], width: f64) -> Vec<f64> {
    let mut left = matches.to_vec();
    let mut axes = Vec::new();
    while left.len() > SUPPORT {
        let axis = commonest_axis(&left, width);
        let before = left.len();
        left.retain(|m| (m.axis() - axis).abs() >= width);
        if before - left.len() <= SUPPORT {
            break;
        }
        axes.push(axis);
    }
    axes
}
