//! Ripples: what touches, bodies and wakes raise on the near water, on a grid of cells.
//!
//! [`Ripples`] steps at a fixed rate and is a function of its steps and of what was done between them. Heights are bounded,
//! energy does not grow unless something acts, and water that has come to rest is exactly 0 and costs nothing.

mod dispersive;
mod follow;
mod footprint;
mod grid;
mod options;
mod sample;
mod source;
mod wave_equation;

use std::f64::consts::LN_2;

use super::DENSITY;

pub use footprint::{Footprint, FootprintError};
pub use grid::{CellWeights, RippleError, RippleGrid};
pub use options::{RippleOptions, RippleSolver};

use dispersive::Dispersive;
use source::Limits;
use wave_equation::WaveEquation;

/// Heights (meters) and potentials (m²/s) below which water is at rest.
const REST: [f32; 2] = [5e-6, 2e-5];

/// Waves on a grid of cells.
///
/// The state is a height η in meters and the potential φ at the surface in m²/s, whose slope is the water's velocity.
#[derive(Clone, Debug)]
pub struct Ripples {
    grid: RippleGrid,
    options: RippleOptions,
    solver: Solver,
    limits: Limits,
    mask: Vec<f32>,
    /// Share of cells that is water, counted in cells.
    water: f64,
    /// What is left of each cell after a step: mask, damping, sponge.
    kept: Vec<f32>,
    height: Vec<f32>,
    potential: Vec<f32>,
    /// Heights before the last step, and those that are shown when that is neither one nor the other.
    before: Vec<f32>,
    between: Vec<f32>,
    /// How much of the last step is taken back in what is shown, 0 to 1.
    lag: f32,
    /// Mean height and potential of the water, to be taken off in the next step.
    mean: [f32; 2],
    is_still: bool,
    texels: Vec<[f32; 4]>,
    texels_are_old: bool,
    /// How much is shown at each place along a side.
    fade: Vec<f32>,
    /// Cells of walls that are near enough to water to throw waves back.
    banks: Vec<u32>,
}

#[derive(Clone, Debug)]
enum Solver {
    Dispersive(Dispersive),
    WaveEquation(WaveEquation),
}

impl Ripples {
    /// Still water. `mask` has a value per cell, row by row: 0 is wall, 1 is water, what lies between swallows waves like a
    /// beach.
    ///
    /// # Errors
    ///
    /// A grid, an option or a mask that cannot be used.
    pub fn new(grid: RippleGrid, options: RippleOptions, mask: &[f32]) -> Result<Self, RippleError> {
        grid.check()?;
        options.check(&grid)?;
        let step = options.step_seconds;
        let solver = match options.solver {
            RippleSolver::Dispersive { depth } => Solver::Dispersive(Dispersive::new(&grid, depth, step)),
            RippleSolver::WaveEquation { speed } => {
                Solver::WaveEquation(WaveEquation::new(&grid, speed, step))
            }
        };
        let cells = grid.cells();
        let mut ripples = Self {
            grid,
            options,
            solver,
            limits: Limits::new(&grid, &options),
            mask: Vec::new(),
            water: 0.0,
            kept: vec![0.0; cells],
            height: vec![0.0; cells],
            potential: vec![0.0; cells],
            before: vec![0.0; cells],
            between: vec![0.0; cells],
            lag: 0.0,
            mean: [0.0; 2],
            is_still: true,
            texels: vec![[0.0; 4]; cells],
            texels_are_old: true,
            fade: sample::fade(grid.size),
            banks: Vec::new(),
        };
        ripples.set_mask(mask)?;
        Ok(ripples)
    }

    /// Takes other walls; waves where a wall comes to stand end.
    ///
    /// # Errors
    ///
    /// A mask of another size, or with a value outside 0 to 1.
    pub fn set_mask(&mut self, mask: &[f32]) -> Result<(), RippleError> {
        if mask.len() != self.grid.cells() {
            return Err(RippleError::MaskSize { found: mask.len(), expected: self.grid.cells() });
        }
        if let Some(cell) = mask.iter().position(|value| !(0.0..=1.0).contains(value)) {
            return Err(RippleError::MaskValue { cell, value: mask[cell] });
        }
        self.mask.clear();
        self.mask.extend_from_slice(mask);
        self.water = mask.iter().map(|value| f64::from(*value)).sum();
        let step = self.options.step_seconds;
        let damping = (-LN_2 * step / self.options.half_life_seconds).exp() as f32;
        let sponge = match &mut self.solver {
            Solver::Dispersive(_) => Dispersive::sponge(&self.grid, step),
            Solver::WaveEquation(solver) => {
                solver.set_mask(mask);
                // Its border is open.
                vec![1.0; self.grid.size]
            }
        };
        let size = self.grid.size;
        for (cell, (kept, mask)) in self.kept.iter_mut().zip(mask).enumerate() {
            *kept = mask * damping * sponge[cell % size] * sponge[cell / size];
        }
        self.banks = source::banks(size, mask);
        self.texels_are_old = true;
        Ok(())
    }

    /// One step of [`RippleOptions::step_seconds`].
    pub fn step(&mut self) {
        self.look_back(0.0);
        if self.is_still {
            return;
        }
        self.before.copy_from_slice(&self.height);
        match &mut self.solver {
            Solver::Dispersive(solver) => solver.step(&mut self.height, &mut self.potential),
            Solver::WaveEquation(solver) => solver.step(&mut self.height, &mut self.potential),
        }
        self.settle();
        self.texels_are_old = true;
    }

    /// Takes the mean off, damps, bounds, and finds out whether the water has come to rest.
    fn settle(&mut self) {
        let mut is_at_rest = true;
        let fields = [&mut self.height, &mut self.potential];
        let limits = self.limits.state();
        for (index, field) in fields.into_iter().enumerate() {
            let (sum, peak) = settle(field, &self.kept, self.mean[index], limits[index]);
            self.mean[index] = if self.water > 0.0 { (sum / self.water) as f32 } else { 0.0 };
            is_at_rest &= peak < REST[index];
        }
        if is_at_rest {
            self.still();
        }
    }

    /// Stops all waves at once.
    pub fn still(&mut self) {
        self.height.fill(0.0);
        self.potential.fill(0.0);
        self.before.fill(0.0);
        self.look_back(0.0);
        self.mean = [0.0; 2];
        self.is_still = true;
        self.texels_are_old = true;
    }

    /// Whether the water is exactly at rest everywhere.
    #[must_use]
    pub fn is_still(&self) -> bool {
        self.is_still
    }

    /// Where its cells are.
    #[must_use]
    pub fn grid(&self) -> &RippleGrid {
        &self.grid
    }

    /// How it was made.
    #[must_use]
    pub fn options(&self) -> &RippleOptions {
        &self.options
    }

    /// Energy of the waves in joules. A whole transform for the dispersive solver: for inspection, not for frames.
    #[must_use]
    pub fn energy(&self) -> f64 {
        let (grid, heights, potentials) = (&self.grid, &self.height[..], &self.potential[..]);
        DENSITY
            * match (&self.solver, self.options.solver) {
                (Solver::Dispersive(solver), RippleSolver::Dispersive { depth }) => {
                    solver.energy(grid, depth, heights, potentials)
                }
                (Solver::WaveEquation(solver), _) => solver.energy(grid, heights, potentials),
                _ => 0.0,
            }
    }
}

/// Takes a mean off values, keeps as much of them as is told, within a limit; their sum and the greatest size.
fn settle(values: &mut [f32], kept: &[f32], mean: f32, limit: f32) -> (f64, f32) {
    const LANES: usize = 8;
    let (mut total, mut peaks) = (0.0, [0.0_f32; LANES]);
    // Sums in several lanes, so that the loop runs in vectors, and over few values, so that they stay exact. The
    // least grid has 256 cells.
    for (values, kept) in values.chunks_exact_mut(256).zip(kept.chunks_exact(256)) {
        for (value, kept) in values.iter_mut().zip(kept) {
            let left = (*value - mean) * kept;
            // Not `clamp`, whose care for NaN costs half of the loop.
            let left = if left < limit { left } else { limit };
            *value = if left > -limit { left } else { -limit };
        }
        let mut sums = [0.0_f32; LANES];
        for values in values.as_chunks::<LANES>().0 {
            for i in 0..LANES {
                sums[i] += values[i];
                peaks[i] = if values[i].abs() > peaks[i] { values[i].abs() } else { peaks[i] };
            }
        }
        total += f64::from(sums.iter().sum::<f32>());
    }
    (total, peaks.into_iter().fold(0.0, f32::max))
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod wake_tests;
