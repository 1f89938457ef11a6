//! A boat and water that answers it: a small deep pool, solved mode by mode.

use std::f64::consts::TAU;

use glam::DVec2;

use super::*;
use crate::tour::Floating;
use crate::water::ripples::RippleGrid;

const SIZE: usize = 24;
const CELL: f64 = 0.5;

/// A periodic pool: heights and potentials by modes that stand in it, each an exact oscillator (notes §7.2).
struct Pool {
    /// cos and sin of each mode at each cell, of unit mean square; its angular frequency squared per gravity.
    modes: Vec<(Vec<f64>, f64)>,
    /// Height (m) and potential (m²/s) of each mode.
    states: Vec<[f64; 2]>,
    heights: Vec<f64>,
}

impl Pool {
    fn new() -> Self {
        let mut modes = vec![];
        let half = SIZE as i32 / 2;
        for m in 0..half {
            for n in -half + 1..half {
                if m == 0 && n <= 0 {
                    continue;
                }
                let wave = TAU / SIZE as f64 * DVec2::new(m.into(), n.into());
                for quarter in [0.0, 0.25 * TAU] {
                    let shape = (0..SIZE * SIZE).map(|cell| {
                        let at = DVec2::new((cell % SIZE) as f64, (cell / SIZE) as f64);
                        2.0_f64.sqrt() * (wave.dot(at) - quarter).cos()
                    });
                    modes.push((shape.collect(), wave.length() / CELL));
                }
            }
        }
        Self { states: vec![[0.0; 2]; modes.len()], modes, heights: vec![0.0; SIZE * SIZE] }
    }

    fn grid() -> RippleGrid {
        RippleGrid { origin: DVec2::ZERO, cell: CELL, size: SIZE }
    }

    /// One step under pressures (Pa) on the cells.
    fn step(&mut self, pressures: &[f64], dt: f64) {
        self.heights.fill(0.0);
        for ((shape, number), state) in self.modes.iter().zip(&mut self.states) {
            let pressure =
                shape.iter().zip(pressures).map(|(s, p)| s * p).sum::<f64>() / (SIZE * SIZE) as f64;
            let frequency = (GRAVITY * number).sqrt();
            let (sin, cos) = (frequency * dt).sin_cos();
            let [height, potential] = [state[0], state[1] - dt * pressure / DENSITY];
            *state = [
                cos * height + number / frequency * sin * potential,
                cos * potential - GRAVITY / frequency * sin * height,
            ];
            for (cell, s) in self.heights.iter_mut().zip(shape) {
                *cell += state[0] * s;
            }
        }
    }
}

impl WaterHeight for Pool {
    fn height(&self, xz: DVec2) -> f64 {
        let at = (xz / CELL - 0.5).rem_euclid(DVec2::splat(SIZE as f64));
        let (low, part) = (at.floor(), at.fract());
        let cell = |i: usize, j: usize| {
            self.heights[(low.y as usize + j) % SIZE * SIZE + (low.x as usize + i) % SIZE]
        };
        let row = |j| cell(0, j) + part.x * (cell(1, j) - cell(0, j));
        row(0) + part.y * (row(1) - row(0))
    }
}

#[test]
fn a_boat_and_its_own_waves_calm_down() {
    let floating = Floating {
        draft: 0.4,
        length: Some(5.0),
        beam: Some(2.0),
        mass: None,
        heave_damping: None,
        roll_damping: None,
        heave_period_seconds: None,
        roll_period_seconds: None,
    };
    let mut body = FloatingBody::new(Hull::new(&floating, 4.0));
    let (center, heading) = (DVec2::splat(6.1), 0.4);
    // Held 0.2 m up and rolled, then let go.
    for _ in 0..2000 {
        body.step(&|at: DVec2| 0.2 + 0.1 * (at.y - center.y), center, heading);
    }
    let mut pool = Pool::new();
    let mut pressures = vec![0.0; SIZE * SIZE];
    let mut most = [0.0_f64; 4];
    for i in 0..2400 {
        body.step(&pool, center, heading);
        pressures.fill(0.0);
        body.pressure(center, heading).press(&Pool::grid(), |cell, pascals| pressures[cell] = pascals);
        pool.step(&pressures, FloatingBody::DT);
        let highest = pool.heights.iter().fold(0.0_f64, |most, height| most.max(height.abs()));
        let quarter = &mut most[i / 600];
        *quarter = quarter.max(highest);
        if i == 12 {
            assert!(pool.height(center) > 0.0, "water is drawn up under a boat that is too high");
        }
    }
    assert!((0.01..0.4).contains(&most[0]), "waves of {} m by a boat let go 0.2 m up", most[0]);
    assert!(most[3] < 0.5 * most[0], "waves of {most:?} m in the four quarters");
    assert!(body.pose().position.y.abs() < 0.02, "still heaves by {} m", body.pose().position.y);
}
