//! Angles of wakes.

use std::f64::consts::TAU;

use glam::DVec2;

use super::super::GRAVITY;
use super::tests::{DEEP, open};
use super::*;

/// Ripples behind a Gaussian pressure of deviation `deviation` m that has run along +x, and where it has come to.
fn wake(solver: RippleSolver, cell: f64, speed: f64, deviation: f64) -> (Ripples, f64) {
    let size = 256;
    let mut ripples = open(solver, size, cell, 1000.0);
    let side = ripples.grid.side();
    let mut x = -0.38 * side;
    while x < 0.32 * side {
        let center = ripples.grid.to_cells(DVec2::new(x, 0.0));
        let mut patch = CellWeights::default();
        let reach = 4.5 * deviation / cell;
        let places = |center: f64| (center - reach) as usize..(center + reach) as usize;
        for row in places(center.y) {
            for column in places(center.x) {
                let off = (DVec2::new(column as f64, row as f64) - center) * cell / deviation;
                patch.push(row * size + column, (-0.5 * off.length_squared()).exp() as f32);
            }
        }
        ripples.press(&patch, 50.0);
        ripples.step();
        x += speed / 60.0;
    }
    (ripples, x)
}

/// Angle of the line through the places (meters behind, meters aside), degrees, by least squares.
fn angle_of(places: &[DVec2]) -> f64 {
    let mean = places.iter().sum::<DVec2>() / places.len() as f64;
    let (mut xx, mut xz) = (0.0, 0.0);
    for place in places {
        xx += (place.x - mean.x).powi(2);
        xz += (place.x - mean.x) * (place.y - mean.y);
    }
    (xz / xx).atan().to_degrees()
}

/// Where the waves beside a wake are strongest, `aside` meters from its axis or more: for every column between two
/// distances behind, over `window` meters around.
fn ridge(ripples: &Ripples, x: f64, behind: [f64; 2], aside: f64, window: f64) -> Vec<DVec2> {
    let RippleGrid { size, cell, .. } = ripples.grid;
    let columns =
        (0..size).filter(|column| (behind[0]..behind[1]).contains(&(x - ripples.grid.center(*column, 0).x)));
    columns
        .map(|column| {
            let reach = (0.5 * window / cell) as usize;
            let energy = |row: usize| {
                let row = &ripples.height[row * size..][column - reach..=column + reach];
                row.iter().map(|height| height * height).sum::<f32>()
            };
            // Short of the sponge.
            let rows = size / 2 + (aside / cell) as usize..size * 85 / 100;
            let best = rows.max_by(|a, b| energy(*a).total_cmp(&energy(*b))).unwrap();
            let [a, b, c] = [best - 1, best, best + 1].map(|row| f64::from(energy(row)));
            let vertex = (0.5 * (a - c) / (a - 2.0 * b + c)).clamp(-0.5, 0.5);
            let center = ripples.grid.center(column, best);
            DVec2::new(x - center.x, center.y + vertex * cell)
        })
        .collect()
}

#[test]
fn a_wake_has_kelvins_angle() {
    for (speed, deviation) in [(1.5, 0.31), (2.0, 0.55)] {
        let froude = speed / (4.0 * GRAVITY * deviation).sqrt();
        assert!((0.3..0.5).contains(&froude), "{froude}");
        let (ripples, x) = wake(DEEP, 0.25, speed, deviation);
        // Over the distance between crests at the edge. Farther behind than half of the way there are no transverse
        // waves yet.
        let window = TAU * speed * speed / GRAVITY * (2.0_f64 / 3.0).sqrt();
        let angle = angle_of(&ridge(&ripples, x, [8.0, 20.0], 1.0, window));
        assert!((angle - 19.47).abs() < 1.0, "{angle}° at {speed} m/s");
    }
}

#[test]
fn a_wake_of_one_speed_has_machs_angle() {
    for (c, speed) in [(1.0, 2.0), (1.0, 3.0), (1.5, 2.5)] {
        let (ripples, x) = wake(RippleSolver::WaveEquation { speed: c }, 0.15, speed, 0.4);
        let angle = angle_of(&ridge(&ripples, x, [4.0, 12.0], 0.5, 0.0));
        let truth = (c / speed).asin().to_degrees();
        assert!((angle - truth).abs() < 1.0, "{angle}° instead of {truth}°");
    }
}
