//! Waves keep their frequencies, their volume and their energy; walls throw them back, beaches and borders swallow them.

use super::*;

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
