//! Ripples rest, travel, turn back at walls and die away as they must.

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
fn every_wave_has_its_own_frequency() {
    let (size, cell, depth) = (64, 0.25, 0.8);
    let grid = RippleGrid::around(DVec2::ZERO, cell, size);
    for (x, z) in [(1, 0), (3, 4), (0, 9), (20, 1), (32, 0)] {
        let wave_vector = TAU / grid.side() * DVec2::new(f64::from(x), f64::from(z));
        let wave =
            |cell: usize| wave_vector.dot(grid.center(cell % size, cell / size) - grid.center(0, 0)).cos();
        let mut heights: Vec<f32> = (0..size * size).map(|cell| wave(cell) as f32).collect();
        let mut potentials = vec![0.0; size * size];
        let mut solver = Dispersive::new(&grid, depth, 1.0 / 60.0);
        let omega = angular_frequency(wave_vector.length(), depth);
        for step in 1..=600 {
            solver.step(&mut heights, &mut potentials);
            let truth = (omega * f64::from(step) / 60.0).cos();
            for cell in [0, 77, 2049] {
                let found = f64::from(heights[cell]);
                let truth = truth * wave(cell);
                assert!((found - truth).abs() < 1e-4, "{x}, {z}, step {step}: {found} instead of {truth}");
            }
        }
    }
}

#[test]
fn a_closed_basin_swings_with_its_period() {
    let (size, speed) = (64, 2.0);
    let mask = walled(size, |column, row| [column, row].iter().any(|place| *place < 2 || *place >= size - 2));
    let grid = RippleGrid::around(DVec2::ZERO, 0.25, size);
    let mut ripples =
        Ripples::new(grid, options(RippleSolver::WaveEquation { speed }, 1000.0), &mask).unwrap();
    let basin = (size - 4) as f64 * grid.cell;
    for (cell, water) in mask.iter().enumerate() {
        let place = (cell % size) as f64 - 1.5;
        ripples.height[cell] = (0.01 * (PI * place * grid.cell / basin).cos()) as f32 * water;
    }
    ripples.stir();
    // The first time that the left bank falls through zero is after a quarter of 2·basin/c.
    let left = 32 * size + 2;
    let mut steps = 0.0;
    loop {
        let before = ripples.height[left];
        ripples.step();
        let after = ripples.height[left];
        if after <= 0.0 {
            steps += f64::from(before / (before - after));
            break;
        }
        steps += 1.0;
    }
    let quarter = steps / 60.0;
    let truth = 0.5 * basin / speed;
    assert!((quarter / truth - 1.0).abs() < 5e-3, "{quarter} s instead of {truth} s");
}

#[test]
fn volume_is_kept_in_a_basin() {
    let size = 64;
    let mask = walled(size, |column, row| column < 2 || row < 2 || column > 61 || row > 61);
    let grid = RippleGrid::around(DVec2::ZERO, 0.2, size);
    let mut ripples = Ripples::new(grid, options(PLAIN, 5.0), &mask).unwrap();
    ripples.touch(DVec2::new(1.0, 2.0), 1.0, -0.5);
    run(&mut ripples, 3.0);
    let mean = ripples.height.iter().map(|height| f64::from(*height)).sum::<f64>() / (60.0 * 60.0);
    assert!(mean.abs() < 1e-7, "mean {mean} m");
}

#[test]
fn energy_never_grows_by_itself() {
    let size = 128;
    let rock = |column: usize, row: usize| column.abs_diff(80).pow(2) + row.abs_diff(60).pow(2) < 100;
    for solver in [DEEP, PLAIN] {
        for half_life in [5.0, 1000.0] {
            let masks = [
                vec![1.0; size * size],
                walled(size, rock),
                walled(size, |column, _| column > 70),
                (0..size * size).map(|cell| (1.0 - (cell % size) as f32 / 100.0).max(0.0)).collect(),
            ];
            for mask in masks {
                let grid = RippleGrid::around(DVec2::ZERO, 0.15, size);
                let mut ripples = Ripples::new(grid, options(solver, half_life), &mask).unwrap();
                ripples.touch(DVec2::new(-1.0, 0.3), 0.8, -0.5);
                ripples.step();
                let mut last = ripples.energy();
                assert!(last > 0.01, "{last} J");
                for step in 0..60 {
                    run(&mut ripples, 1.0 / 6.0);
                    let now = ripples.energy();
                    assert!(now <= last * (1.0 + 1e-4), "{solver:?} step {step}: {now} J after {last} J");
                    last = now;
                }
            }
        }
    }
}

#[test]
fn posts_and_slits_add_no_energy() {
    let size = 128;
    for solver in [DEEP, PLAIN] {
        for posts in [|x: usize, z: usize| (7 * x + 13 * z) % 11 < 3, |x, z| x % 9 < 2 || z % 7 < 1] {
            let grid = RippleGrid::around(DVec2::ZERO, 0.15, size);
            let mut ripples = Ripples::new(grid, options(solver, 1000.0), &walled(size, posts)).unwrap();
            ripples.touch(DVec2::new(-1.0, 0.3), 0.8, -0.5);
            ripples.step();
            let first = ripples.energy();
            for step in 0..120 {
                run(&mut ripples, 1.0 / 6.0);
                let now = ripples.energy();
                assert!(now <= first * (1.0 + 1e-4), "{solver:?} step {step}: {now} J after {first} J");
            }
        }
    }
}

#[test]
fn walls_throw_waves_back() {
    let (size, cell) = (256, 0.15);
    for (solver, length, seconds) in
        [(DEEP, 2.0, 16.0), (DEEP, 3.0, 13.0), (PLAIN, 2.0, 8.0), (PLAIN, 4.0, 8.0)]
    {
        let grid = RippleGrid::around(DVec2::ZERO, cell, size);
        // A wall from x = 4 m on.
        let mask = walled(size, |column, _| grid.center(column, 0).x > 4.0);
        let mut ripples = Ripples::new(grid, options(solver, 1000.0), &mask).unwrap();
        send_packet(&mut ripples, -4.0, length);
        // A strip along the middle, left alone by borders.
        let strip = |ripples: &Ripples| -> f64 {
            ripples.height[128 * size..129 * size].iter().map(|height| f64::from(*height).powi(2)).sum()
        };
        let before = strip(&ripples);
        run(&mut ripples, seconds);
        let ratio = (strip(&ripples) / before).sqrt();
        assert!((0.9..1.05).contains(&ratio), "{solver:?} {length} m: amplitude ratio {ratio}");
    }
}

#[test]
fn a_beach_swallows_waves() {
    let (size, cell) = (256, 0.15);
    for solver in [DEEP, PLAIN] {
        let grid = RippleGrid::around(DVec2::ZERO, cell, size);
        let left = |breadth: f64| -> f64 {
            let mask = (0..size * size).map(|cell| {
                let to_shore = 4.0 + breadth - grid.center(cell % size, 0).x;
                (to_shore / breadth).clamp(0.0, 1.0) as f32
            });
            let mask: Vec<_> = mask.collect();
            let mut ripples = Ripples::new(grid, options(solver, 1000.0), &mask).unwrap();
            send_packet(&mut ripples, -3.0, 2.0);
            run(&mut ripples, if solver == DEEP { 16.0 } else { 7.0 });
            ripples.height[128 * size..129 * size].iter().map(|height| f64::from(*height).powi(2)).sum()
        };
        let ratio = (left(4.0) / left(0.01)).sqrt();
        assert!(ratio < 0.8, "{solver:?}: {ratio} of what a wall throws back");
    }
}

#[test]
fn waves_leave_the_grid() {
    for (solver, length) in [(DEEP, 1.0), (DEEP, 2.0), (DEEP, 4.0), (DEEP, 6.0), (PLAIN, 2.0), (PLAIN, 4.0)] {
        let mut ripples = open(solver, 256, 0.15, 1000.0);
        send_packet(&mut ripples, 0.0, length);
        let before = ripples.energy();
        run(&mut ripples, 45.0);
        let left = (ripples.energy() / before).sqrt();
        assert!(left < 0.1, "{solver:?} {length} m: amplitude left {left}");
    }
}

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
fn walls_cast_the_sea_back() {
    let (size, cell, length) = (256, 0.15, 3.0);
    let grid = RippleGrid::around(DVec2::ZERO, cell, size);
    let mask = walled(size, |column, _| grid.center(column, 0).x > 6.0);
    let mut ripples = Ripples::new(grid, options(DEEP, 1000.0), &mask).unwrap();
    let k = TAU / length;
    let omega = angular_frequency(k, 50.0);
    for step in 0..1200 {
        let time = f64::from(step) / 60.0;
        ripples.throw_back(|xz| {
            let (sine, cosine) = (k * xz.x - omega * time).sin_cos();
            [0.01 * cosine, 0.01 * GRAVITY / omega * sine].map(|value| value as f32)
        });
        ripples.step();
    }
    let row = &ripples.height[128 * size..129 * size];
    let before = (0..size).filter(|column| (0.0..4.0).contains(&grid.center(*column, 0).x));
    let thrown = before.map(|column| row[column].abs()).fold(0.0, f32::max);
    assert!((thrown / 0.01 - 1.0).abs() < 0.1, "{thrown} m");
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
