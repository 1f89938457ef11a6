//! Facts about what a moving hull does to the water.

use std::f64::consts::TAU;

use glam::DVec2;

use super::*;
use crate::tour::Floating;
use crate::water::ripples::RippleGrid;

fn hull(length: f64, beam: f64, draft: f64) -> Hull {
    let floating = Floating {
        draft,
        length: Some(length),
        beam: Some(beam),
        mass: None,
        heave_damping: None,
        roll_damping: None,
        heave_period_seconds: None,
        roll_period_seconds: None,
    };
    Hull::new(&floating, 4.0)
}

#[test]
fn a_wake_s_pressure_is_elongated_along_the_hull() {
    let wake = Wake::new(&hull(5.0, 1.6, 0.4));
    let heading = 0.8;
    let patch = wake.pressure(DVec2::new(2.0, -8.0), heading, 2.0);
    let peak = patch.at(patch.center);
    // U²/2g = 0.204 m against 0.3 · 0.4 m.
    let head = 0.203_943 * 0.12 / (0.203_943 + 0.12);
    assert!((peak / (DENSITY * GRAVITY * head) - 1.0).abs() < 1e-4, "{peak} Pa");
    assert!((0.1..=0.3).contains(&(head / 0.4)), "{head} m for a draft of 0.4 m");
    for (way, reach) in [(ahead(heading), 1.25), (starboard(ahead(heading)), 0.4)] {
        let ratio = patch.at(patch.center + reach * way) / peak;
        assert!((ratio - (-0.5_f64).exp()).abs() < 1e-9, "{ratio} at one reach");
    }
    let grid = RippleGrid { origin: DVec2::new(-6.0, -16.0), cell: 0.15, size: 128 };
    let mut sum = 0.0;
    patch.press(&grid, |index, pascals| {
        let cell = DVec2::new((index % 128) as f64, (index / 128) as f64);
        assert!((pascals - patch.at(grid.origin + 0.15 * (cell + 0.5))).abs() < 1e-9);
        sum += pascals * 0.15 * 0.15;
    });
    let whole = peak * TAU * 1.25 * 0.4;
    assert!((sum / whole - 1.0).abs() < 0.002, "{sum} N instead of {whole} N");
    let still = wake.pressure(DVec2::ZERO, 0.0, 0.0);
    assert_eq!(still.at(DVec2::ZERO), 0.0);
    assert_eq!(wake.pressure(DVec2::NAN, 0.0, 2.0).head, 0.0);
}

#[test]
fn a_toy_boat_presses_with_its_whole_force() {
    let patch = Wake::new(&hull(0.3, 0.1, 0.03)).pressure(DVec2::new(0.03, 0.11), 0.7, 1.0);
    let grid = RippleGrid { origin: DVec2::splat(-9.6), cell: 0.15, size: 128 };
    let mut sum = 0.0;
    patch.press(&grid, |_, pascals| sum += pascals * 0.15 * 0.15);
    let whole = patch.at(patch.center) * TAU * patch.reach.element_product();
    assert!((sum / whole - 1.0).abs() < 0.01, "{sum} N instead of {whole} N");
}

#[test]
fn what_a_wake_displaces_sums_to_nothing() {
    let wake = Wake::new(&hull(5.0, 1.6, 0.4));
    // Also where half of it is beyond the grid.
    for center in [DVec2::new(0.0, 0.0), DVec2::new(-9.5, 3.33)] {
        let grid = RippleGrid { origin: DVec2::splat(-9.6), cell: 0.15, size: 128 };
        let patch = wake.pressure(center, 0.5, 2.0);
        let (mut sum, mut sizes, mut bow) = (0.0, 0.0, 0.0);
        patch.displace(&grid, 2.0, |index, rate| {
            sum += rate;
            sizes += rate.abs();
            let at = grid.origin + 0.15 * DVec2::new((index % 128) as f64 + 0.5, (index / 128) as f64 + 0.5);
            bow += rate * (at - center).dot(ahead(0.5));
        });
        assert!(sum.abs() < 1e-12 * sizes, "{sum} of {sizes} m/s are made");
        assert!(bow > 0.0, "the water rises before the bow");
    }
}
