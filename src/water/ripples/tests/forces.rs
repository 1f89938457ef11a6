//! Touches, pressures and displacements move the surface as much as they must, and no further.

use super::*;

#[test]
fn nothing_makes_it_explode() {
    for solver in [DEEP, PLAIN] {
        let size = 64;
        let mut ripples = open(solver, size, 0.2, 5.0);
        let covered = Footprint::from_outline(vec![DVec2::ZERO, DVec2::X, DVec2::new(1.0, 1.0)]).unwrap();
        let covered = covered.cover(&ripples.grid);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0] {
            ripples.touch(DVec2::ZERO, 0.5, bad);
            ripples.press(&covered, bad);
            ripples.displace(&covered, bad);
        }
        ripples.touch(DVec2::NAN, 0.5, 1.0);
        ripples.touch(DVec2::ZERO, f64::NAN, 1.0);
        ripples.touch(DVec2::splat(1e300), 0.5, 1.0);
        ripples.touch(DVec2::ZERO, 0.5, f64::NAN);
        assert!(ripples.is_still());
        for _ in 0..600 {
            ripples.touch(DVec2::ZERO, 0.1, 1e30);
            ripples.touch(DVec2::new(0.5, 0.0), 1e30, -1e30);
            ripples.press(&covered, 1e30);
            ripples.displace(&covered, -1e30);
            ripples.step();
            let limit = 2.0 * 0.2 + 1e-5;
            assert!(ripples.height.iter().all(|height| height.abs() <= limit));
        }
        assert!(ripples.texels().iter().flatten().all(|value| value.is_finite()));
    }
}

#[test]
fn one_touch_makes_gentle_waves() {
    for solver in [DEEP, PLAIN] {
        for radius in [0.1, 0.5, 2.0] {
            let mut ripples = open(solver, 128, 0.15, 5.0);
            ripples.touch(DVec2::ZERO, radius, -1e9);
            let mut steepest: f32 = 0.0;
            for _ in 0..120 {
                ripples.step();
                let slopes = ripples.texels().iter().map(|texel| Vec2::new(texel[1], texel[2]).length());
                steepest = slopes.fold(steepest, f32::max);
            }
            assert!((0.02..0.6).contains(&steepest), "{solver:?} radius {radius}: {steepest}");
        }
    }
}

#[test]
fn a_touch_moves_the_middle_as_asked() {
    for solver in [DEEP, PLAIN] {
        let mut ripples = open(solver, 128, 0.1, 1000.0);
        ripples.touch(DVec2::splat(0.05), 2.0, -0.1);
        ripples.step();
        let speed = f64::from(ripples.height_at(DVec2::splat(0.05))) * 60.0;
        assert!((speed + 0.1).abs() < 0.01, "{solver:?}: {speed} m/s");
    }
}

#[test]
fn a_pressure_kept_up_pushes_the_surface_down() {
    for solver in [DEEP, PLAIN] {
        let mut ripples = open(solver, 128, 0.2, 1000.0);
        let mut patch = CellWeights::default();
        for cell in 0..128 * 128 {
            let off = ripples.grid.center(cell % 128, cell / 128).length();
            patch.push(cell, (-0.5 * off * off).exp() as f32);
        }
        // Pressed harder and harder for half a minute, so that few waves are made.
        for step in 0..3000 {
            ripples.press(&patch, 98.1 * (f64::from(step) / 1800.0).min(1.0));
            ripples.step();
        }
        let rise = ripples.height_at(DVec2::ZERO) - ripples.height_at(DVec2::new(5.0, 0.0));
        assert!((rise + 0.01).abs() < 0.001, "{solver:?}: {rise} m instead of −0.01 m");
    }
}

#[test]
fn displaced_water_comes_up() {
    for solver in [DEEP, PLAIN] {
        let mut ripples = open(solver, 128, 0.2, 1000.0);
        let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(DVec2::from);
        let covered = Footprint::from_outline(square.to_vec()).unwrap().cover(&ripples.grid);
        ripples.displace(&covered, 0.6);
        let volume = ripples.height.iter().map(|height| f64::from(*height)).sum::<f64>() * 0.04;
        assert!((volume - 0.01).abs() < 1e-6, "{solver:?}: {volume} m³");
        ripples.displace(&covered, -0.6);
        assert!(ripples.height.iter().all(|height| height.abs() < 1e-9));
    }
}

#[test]
fn a_cell_is_pressed_as_what_covers_it_wholly_is() {
    let corner = DVec2::splat(0.5);
    let square = [DVec2::ZERO, DVec2::new(0.5, 0.0), corner, DVec2::new(0.0, 0.5)];
    let [mut covered, mut alone] = [open(DEEP, 32, 0.5, 5.0), open(DEEP, 32, 0.5, 5.0)];
    let cover = Footprint::from_outline(square.to_vec()).unwrap().cover(covered.grid());
    covered.press(&cover, 300.0);
    alone.press_cell(16 * 32 + 16, 300.0);
    assert!(alone.potential[16 * 32 + 16] < 0.0);
    assert_eq!(covered.potential, alone.potential);
    let mut still = open(DEEP, 32, 0.5, 5.0);
    for (cell, pressure) in [(32 * 32, 300.0), (7, f64::NAN), (7, 0.0)] {
        still.press_cell(cell, pressure);
        assert!(still.is_still(), "{pressure} Pa on cell {cell}");
    }
}
