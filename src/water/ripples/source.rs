//! What raises ripples: touches, pressure, displaced water, and the sea where it meets a wall.
//!
//! Whatever is asked for, one call adds a bounded amount, and what is no finite number adds nothing.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::super::{DENSITY, GRAVITY};
use super::grid::{CellWeights, RippleGrid};
use super::{RippleOptions, RippleSolver, Ripples};

/// The steepest water that one touch may raise, roughly.
const TOUCH_SLOPE: f64 = 0.3;

/// How far from water a wall still throws waves of the sea back, cells.
const BANK: usize = 4;

/// What the state and what is done to it may reach.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Meters.
    height: f64,
    /// m²/s.
    potential: f64,
}

impl Limits {
    /// Two cells of height, and what potential goes with that in the longest waves.
    pub(super) fn new(grid: &RippleGrid, options: &RippleOptions) -> Self {
        let height = 2.0 * grid.cell;
        let speed = match options.solver {
            RippleSolver::Dispersive { .. } => (GRAVITY * grid.side() / TAU).sqrt(),
            RippleSolver::WaveEquation { speed } => GRAVITY * grid.side() / (TAU * speed),
        };
        Self { height, potential: height * speed }
    }

    /// The greatest height and potential.
    pub(super) fn state(self) -> [f32; 2] {
        [self.height as f32, self.potential as f32]
    }
}

impl Ripples {
    /// Sets the water around a point moving up (or down, below 0) at `impulse` m/s, in a smooth bump that has fallen to an
    /// eighth at `radius` meters. Bumps are at least two cells and at most a quarter of the grid in radius, and so slow
    /// that the waves they make stay gentle.
    pub fn touch(&mut self, xz: DVec2, radius: f64, impulse: f64) {
        if !xz.is_finite() || !radius.is_finite() || !impulse.is_finite() || impulse == 0.0 {
            return;
        }
        let RippleGrid { cell, size, .. } = self.grid;
        let deviation = 0.5 * radius.clamp(2.0 * cell, 0.25 * self.grid.side());
        // The potential that moves the middle of a Gaussian bump at 1 m/s, and the greatest gentle one.
        let (unit, greatest) = match self.options.solver {
            RippleSolver::Dispersive { .. } => {
                (deviation / (0.5 * PI).sqrt(), TOUCH_SLOPE * deviation * (GRAVITY * deviation).sqrt())
            }
            RippleSolver::WaveEquation { speed } => (
                0.5 * GRAVITY * (deviation / speed).powi(2),
                TOUCH_SLOPE * GRAVITY * deviation * deviation / speed,
            ),
        };
        let potential = (unit * impulse).clamp(-greatest, greatest);
        let center = self.grid.to_cells(xz);
        let deviation = deviation / cell;
        let reach = 4.0 * deviation;
        let range = |center: f64| {
            // Casts saturate: what lies outside gives an empty range.
            let low = (center - reach).ceil().max(0.0) as usize;
            low..((center + reach).floor() + 1.0).clamp(0.0, size as f64) as usize
        };
        for row in range(center.y) {
            for column in range(center.x) {
                let off = DVec2::new(column as f64, row as f64) - center;
                let bump = (-0.5 * off.length_squared() / (deviation * deviation)).exp();
                let cell = row * size + column;
                self.potential[cell] += (potential * bump) as f32 * self.mask[cell];
                self.stir();
            }
        }
    }

    /// Presses on the water during the next step: φ −= dt·p/ρ, with `pressure` in pascals where a cell is wholly covered. A
    /// pressure kept up pushes the surface down by p/(ρg).
    pub fn press(&mut self, covered: &CellWeights, pressure: f64) {
        if !pressure.is_finite() || pressure == 0.0 || covered.is_empty() {
            return;
        }
        let fall = self.fall(pressure);
        for (cell, weight) in covered.iter() {
            // Weights of a larger grid may reach beyond this one.
            let Some(mask) = self.mask.get(cell) else { break };
            self.potential[cell] -= fall * weight * mask;
        }
        self.stir();
    }

    /// The same on one cell that is wholly covered, by its index. A cell beyond the grid takes nothing.
    pub fn press_cell(&mut self, cell: usize, pressure: f64) {
        let Some(&mask) = self.mask.get(cell) else { return };
        if !pressure.is_finite() || pressure == 0.0 {
            return;
        }
        self.potential[cell] -= self.fall(pressure) * mask;
        self.stir();
    }

    /// By how much a pressure lowers the potential in a step, m²/s.
    fn fall(&self, pressure: f64) -> f32 {
        let greatest = DENSITY * GRAVITY * self.limits.height;
        (self.options.step_seconds * pressure.clamp(-greatest, greatest) / DENSITY) as f32
    }

    /// Adds water (or takes it, below 0) during the next step, spread over what is covered: `rate` in m³/s.
    pub fn displace(&mut self, covered: &CellWeights, rate: f64) {
        let total = f64::from(covered.total());
        if !rate.is_finite() || rate == 0.0 || total <= 0.0 {
            return;
        }
        let rise = self.options.step_seconds * rate / (total * self.grid.cell * self.grid.cell);
        // A step's rise is small beside what the water may stand at.
        let rise = rise.clamp(-0.1 * self.limits.height, 0.1 * self.limits.height) as f32;
        for (cell, weight) in covered.iter() {
            let Some(mask) = self.mask.get(cell) else { break };
            self.height[cell] += rise * weight * mask;
        }
        self.stir();
    }

    /// Makes walls throw back the waves of the sea: adds −(1 − M)·(η, φ) of them in and along walls (notes §7.2), as `sea`
    /// tells them for a point (x, z), in meters and m²/s. To be called before each step. Only the dispersive solver takes it.
    pub fn throw_back(&mut self, mut sea: impl FnMut(DVec2) -> [f32; 2]) {
        if let RippleSolver::WaveEquation { .. } = self.options.solver {
            return;
        }
        let size = self.grid.size;
        let [highest, greatest] = self.limits.state();
        let mut stirred = false;
        for &cell in &self.banks {
            let cell = cell as usize;
            let [height, potential] = sea(self.grid.center(cell % size, cell / size));
            if height.is_finite() && potential.is_finite() && [height, potential] != [0.0; 2] {
                let wall = 1.0 - self.mask[cell];
                self.height[cell] -= wall * height.clamp(-highest, highest);
                self.potential[cell] -= wall * potential.clamp(-greatest, greatest);
                stirred = true;
            }
        }
        if stirred {
            self.stir();
        }
    }

    pub(super) fn stir(&mut self) {
        self.is_still = false;
        self.texels_are_old = true;
    }
}

/// Cells that are not all water and have water within reach.
pub(super) fn banks(size: usize, mask: &[f32]) -> Vec<u32> {
    let is_near_water = |cell: usize| {
        let (column, row) = (cell % size, cell / size);
        let columns = column.saturating_sub(BANK)..(column + BANK + 1).min(size);
        (row.saturating_sub(BANK)..(row + BANK + 1).min(size))
            .any(|row| columns.clone().any(|column| mask[row * size + column] > 0.0))
    };
    let cells = (0..mask.len()).filter(|&cell| mask[cell] < 1.0 && is_near_water(cell));
    cells.map(|cell| cell as u32).collect()
}
