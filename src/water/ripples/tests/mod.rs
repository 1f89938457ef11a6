//! Ripples rest, travel, turn back at walls and die away as they must.

mod forces;
mod waves;

use std::f64::consts::{PI, TAU};

use glam::{DVec2, Vec2};

use super::super::{GRAVITY, angular_frequency};
use super::*;

pub(super) const DEEP: RippleSolver = RippleSolver::Dispersive { depth: 50.0 };
const PLAIN: RippleSolver = RippleSolver::WaveEquation { speed: 2.0 };

fn options(solver: RippleSolver, half_life_seconds: f64) -> RippleOptions {
    RippleOptions { solver, half_life_seconds, ..RippleOptions::default() }
}

/// A grid around the origin that is all water.
pub(super) fn open(solver: RippleSolver, size: usize, cell: f64, half_life: f64) -> Ripples {
    let grid = RippleGrid::around(DVec2::ZERO, cell, size);
    Ripples::new(grid, options(solver, half_life), &vec![1.0; size * size]).unwrap()
}

/// A mask that is wall where `is_wall` says so of a column and row.
fn walled(size: usize, is_wall: impl Fn(usize, usize) -> bool) -> Vec<f32> {
    (0..size * size).map(|cell| if is_wall(cell % size, cell / size) { 0.0 } else { 1.0 }).collect()
}

/// Sets a packet of waves that runs along +x, of `length` meters, a few of them, around `x`, a cm high.
fn send_packet(ripples: &mut Ripples, x: f64, length: f64) {
    let k = TAU / length;
    let size = ripples.grid.size;
    let omega = match ripples.options.solver {
        RippleSolver::Dispersive { depth } => angular_frequency(k, depth),
        RippleSolver::WaveEquation { speed } => speed * k,
    };
    for cell in 0..size * size {
        let off = ripples.grid.center(cell % size, cell / size).x - x;
        let envelope = 0.01 * (-0.5 * (off / length).powi(2)).exp();
        let (sine, cosine) = (k * off).sin_cos();
        ripples.height[cell] = (envelope * cosine) as f32;
        ripples.potential[cell] = (envelope * GRAVITY / omega * sine) as f32;
    }
    ripples.stir();
}

fn run(ripples: &mut Ripples, seconds: f64) {
    for _ in 0..(60.0 * seconds).round() as usize {
        ripples.step();
    }
}

#[test]
fn still_water_stays_exactly_still() {
    for solver in [DEEP, PLAIN] {
        let mut ripples = open(solver, 64, 0.2, 5.0);
        for _ in 0..100_000 {
            ripples.step();
        }
        assert!(ripples.is_still() && ripples.height.iter().all(|height| *height == 0.0));
        // Also when it has to be computed.
        for _ in 0..200 {
            ripples.is_still = false;
            match &mut ripples.solver {
                Solver::Dispersive(solver) => solver.step(&mut ripples.height, &mut ripples.potential),
                Solver::WaveEquation(solver) => solver.step(&mut ripples.height, &mut ripples.potential),
            }
            assert!(ripples.height.iter().chain(&ripples.potential).all(|value| *value == 0.0));
        }
    }
}

#[test]
fn touched_water_comes_to_rest_exactly() {
    for solver in [DEEP, PLAIN] {
        let mut ripples = open(solver, 64, 0.2, 1.0);
        ripples.touch(DVec2::ZERO, 0.5, -0.3);
        assert!(!ripples.is_still());
        run(&mut ripples, 0.5);
        assert!(ripples.height.iter().any(|height| height.abs() > 1e-3));
        run(&mut ripples, 30.0);
        assert!(ripples.is_still() && ripples.height.iter().all(|height| *height == 0.0));
        assert!(ripples.texels().iter().all(|texel| *texel == [0.0, 0.0, 0.0, 1.0]));
    }
}

#[test]
fn points_and_texels_agree_and_fade() {
    let mut ripples = open(DEEP, 64, 0.25, 5.0);
    ripples.touch(DVec2::new(0.4, -0.7), 1.0, 0.4);
    run(&mut ripples, 2.0);
    let texels = ripples.texels().to_vec();
    let mut greatest: f32 = 0.0;
    for (cell, texel) in texels.iter().enumerate() {
        let center = ripples.grid.center(cell % 64, cell / 64);
        let height = ripples.height_at(center);
        assert!((height - texel[0]).abs() < 1e-6, "{height} {texel:?}");
        assert!((ripples.slope_at(center) - Vec2::new(texel[1], texel[2])).length() < 1e-6, "{texel:?}");
        greatest = greatest.max(height.abs());
    }
    assert!(greatest > 1e-3);
    let xz = DVec2::new(1.3, 0.2);
    let difference = |step: DVec2| (ripples.height_at(xz + step) - ripples.height_at(xz - step)) / 0.5;
    let slope = Vec2::new(difference(0.25 * DVec2::X), difference(0.25 * DVec2::Y));
    assert!((ripples.slope_at(xz) - slope).length() < 1e-5, "{slope}");
    for outside in [DVec2::splat(7.99), DVec2::new(-9.0, 0.0), DVec2::NAN, DVec2::INFINITY] {
        assert_eq!(ripples.height_at(outside).abs(), 0.0);
    }
    assert!(texels[..64].iter().all(|texel| texel[0].abs() < 1e-9));
}

#[test]
fn waves_stay_where_they_are_when_the_grid_moves() {
    let size = 64;
    let mut ripples = open(DEEP, size, 0.25, 5.0);
    ripples.touch(DVec2::new(0.4, -0.7), 1.0, 0.4);
    run(&mut ripples, 1.0);
    let places = [(0.1, 0.2), (-1.3, -2.0), (2.2, 1.0)].map(DVec2::from);
    let before = places.map(|xz| (ripples.height_at(xz), ripples.slope_at(xz)));
    assert!(before.iter().any(|(height, _)| height.abs() > 1e-3));
    let mask = vec![1.0; size * size];
    ripples.follow(7, -4, &mask).unwrap();
    for (xz, (height, slope)) in places.iter().zip(before) {
        assert!((ripples.height_at(*xz) - height).abs() < 1e-7);
        assert!((ripples.slope_at(*xz) - slope).length() < 1e-6);
    }
    ripples.follow(i32::MAX, i32::MIN, &mask).unwrap();
    assert!(ripples.height.iter().all(|height| *height == 0.0));
}

#[test]
fn it_says_where_water_is() {
    let grid = RippleGrid::around(DVec2::ZERO, 0.5, 16);
    let mask = walled(16, |column, _| column < 8);
    let ripples = Ripples::new(grid, options(DEEP, 5.0), &mask).unwrap();
    for (x, z, water) in [
        (0.01, 0.0, true),
        (-0.01, 0.0, false),
        (3.99, -3.99, true),
        (4.01, 0.0, false),
        (1.0, 4.01, false),
        (1.0, -4.01, false),
        (f64::NAN, 0.0, false),
        (1.0, f64::INFINITY, false),
    ] {
        assert_eq!(ripples.is_water(DVec2::new(x, z)), water, "at ({x}, {z})");
    }
}

#[test]
fn the_same_is_done_again() {
    for solver in [DEEP, PLAIN] {
        let once = || {
            let mut ripples = open(solver, 64, 0.2, 5.0);
            for step in 0..100 {
                ripples.touch(DVec2::new(0.02 * f64::from(step), 0.3), 0.4, -0.2);
                ripples.step();
            }
            ripples.height
        };
        assert_eq!(once(), once());
    }
}

#[test]
fn what_cannot_be_used_is_refused() {
    let grid = RippleGrid::around(DVec2::ZERO, 0.2, 64);
    let water = vec![1.0; 64 * 64];
    let new = |grid, options| Ripples::new(grid, options, &water).map(drop);
    assert_eq!(new(RippleGrid { size: 48, ..grid }, options(DEEP, 5.0)), Err(RippleError::Size(48)));
    for cell in [0.0, f64::NAN, -1.0, f64::INFINITY] {
        assert!(matches!(new(RippleGrid { cell, ..grid }, options(DEEP, 5.0)), Err(RippleError::Grid(_))));
    }
    for solver in [
        RippleSolver::Dispersive { depth: 0.0 },
        RippleSolver::WaveEquation { speed: f64::NAN },
        RippleSolver::WaveEquation { speed: 21.0 },
    ] {
        assert!(matches!(new(grid, options(solver, 5.0)), Err(RippleError::Option { .. })), "{solver:?}");
    }
    assert!(matches!(new(grid, options(DEEP, 0.0)), Err(RippleError::Option { .. })));
    let mut ripples = Ripples::new(grid, options(DEEP, 5.0), &water).unwrap();
    assert_eq!(ripples.set_mask(&water[1..]), Err(RippleError::MaskSize { found: 4095, expected: 4096 }));
    let mut odd = water;
    odd[7] = f32::NAN;
    assert!(matches!(ripples.set_mask(&odd), Err(RippleError::MaskValue { cell: 7, .. })));
}
