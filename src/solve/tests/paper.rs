//! The paper's method, and why its objective is not handed to an optimizer.

use nalgebra::SMatrix;

use super::Picture;
use super::Random;
use crate::solve::Annotations;
use crate::solve::FocalLength;
use crate::solve::Method;
use crate::solve::PairPlane;
use crate::solve::paper_objective;
use crate::solve::paper_residual;
use crate::solve::solve;

/// Ten pairs of a level picture, f = 1500 px, d = 60 m, `h_w` = 2 m, clicks scattering by `click_px`.
fn pairs(click_px: f64) -> Vec<([f64; 2], [f64; 2])> {
    let mut random = Random::new(5);
    let mut pair = || {
        let (u, v) = (random.between(-700.0, 700.0), random.between(0.0, 400.0));
        let mut click = |value: f64| value + random.normal(click_px);
        ([click(u), click(v)], [click(u), click(-v - 100.0)])
    };
    (0..10).map(|_| pair()).collect()
}

#[test]
fn the_paper_s_objective_shrinks_with_its_unknowns() {
    let pairs = pairs(1.0);
    let whole = paper_objective(&pairs, 1500.0, 60.0, 2.0);
    for s in [0.5, 0.1, 1e-3] {
        let shrunk = paper_objective(&pairs, 1500.0, 60.0 * s, 2.0 * s);
        assert!(
            (shrunk / (s * s * whole) - 1.0).abs() < 1e-12,
            "E scaled by {s} is {shrunk}, not {}",
            s * s * whole
        );
    }
    // The truth is no minimum: a world a thousand times smaller "fits" a million times better.
    assert!(paper_objective(&pairs, 1500.0, 0.06, 0.002) < 1e-5 * whole);
}

/// Singular values of the residuals' Jacobian by (ln f, ln d, ln `h_w`), times f / d so that they are pixels.
fn singular_values(click_px: f64) -> [f64; 3] {
    let pairs = pairs(click_px);
    let jacobian = SMatrix::<f64, 20, 3>::from_fn(|row, column| {
        let at = |step: f64| {
            let mut ln = [1500.0_f64.ln(), 60.0_f64.ln(), 2.0_f64.ln()];
            ln[column] += step;
            let (point, reflection) = pairs[row / 2];
            paper_residual(point, reflection, ln[0].exp(), ln[1].exp(), ln[2].exp())[row % 2] * 1500.0 / 60.0
        };
        (at(1e-6) - at(-1e-6)) / 2e-6
    });
    let mut values: Vec<f64> = jacobian.svd(false, false).singular_values.iter().copied().collect();
    values.sort_by(|a, b| b.total_cmp(a));
    [values[0], values[1], values[2]]
}

#[test]
fn the_paper_s_objective_shows_one_number_and_not_three() {
    let [first, second, third] = singular_values(0.0);
    assert!(second < 1e-6 * first && third < 1e-6 * first, "exact clicks: {first}, {second}, {third} px");
    let [first, second, third] = singular_values(1.0);
    assert!(second < 0.02 * first, "what noise adds is {second} of {first} px");
    assert!(third < 1e-6 * first, "f and d scaled together change {third} of {first} px");
}

fn level() -> Annotations {
    let mut annotations = Picture::new(0.0, 0.0).annotations(1);
    annotations.method = Method::Paper;
    annotations.focal = FocalLength::Known(1500.0);
    annotations
}

#[test]
fn the_paper_s_method_finds_the_waterline() {
    let mut annotations = level();
    annotations.background = crate::solve::BackgroundHint::FromPairs;
    for pair in &mut annotations.pairs {
        // All at 60 m: the waterline lies 1500 · 2 / 60 = 50 px below the horizon.
        pair.reflection = crate::picture::PicturePoint::new(pair.point.x(), 1200.0 - pair.point.y() + 100.0);
        pair.on = PairPlane::Background;
    }
    let solution = solve(&annotations).unwrap();
    let distance = solution.parameters.background_distance;
    assert!((distance - 60.0).abs() < 1e-9, "the background is at {distance} m, not 60 m");
    assert!(
        solution.report.pairs.iter().all(|pair| pair.kept && pair.residual_px < 1e-6),
        "{:?}",
        solution.report
    );
}
