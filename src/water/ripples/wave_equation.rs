//! Waves of one speed c by leapfrog: for devices where transforms are too dear.
//!
//! `η_t = −h ∇²φ` and `φ_t = −g η` with h = c²/g, which is the wave equation. No flux passes between a cell and a wall, so
//! volume is kept exactly and walls mirror all; the grid's border lets waves out (first-order Mur; notes §7.2).
//! Between steps φ is half a step behind η.

use super::super::GRAVITY;
use super::grid::RippleGrid;

/// The greatest Courant number of a substep; the scheme is stable up to 1/√2.
const COURANT: f64 = 0.5;

#[derive(Clone, Debug)]
pub(super) struct WaveEquation {
    size: usize,
    substeps: usize,
    /// What a substep takes from the potential per meter of height: g·dt.
    fall: f32,
    /// What a potential's difference lifts in a substep, to the next cell along x and along z: h·dt/cell², or less
    /// into walls.
    flux: f32,
    flux_x: Vec<f32>,
    flux_z: Vec<f32>,
    /// Mur's factor (C − 1)/(C + 1).
    border: f32,
    /// The four sides' potentials before a substep, and what Mur's formula takes of them.
    before: Vec<[f32; 2]>,
    /// Whether each of their cells lets waves out: neither it nor its inner neighbor is a wall.
    is_open: Vec<bool>,
}

impl WaveEquation {
    /// Steps of `step` seconds for waves of `speed` m/s; the mask is to be set.
    pub(super) fn new(grid: &RippleGrid, speed: f64, step: f64) -> Self {
        let courant = speed * step / grid.cell;
        let substeps = (courant / COURANT).ceil().max(1.0);
        let courant = courant / substeps;
        let step = step / substeps;
        Self {
            size: grid.size,
            substeps: substeps as usize,
            fall: (GRAVITY * step) as f32,
            flux: (speed * speed / GRAVITY * step / (grid.cell * grid.cell)) as f32,
            flux_x: vec![0.0; grid.cells()],
            flux_z: vec![0.0; grid.cells()],
            border: ((courant - 1.0) / (courant + 1.0)) as f32,
            before: vec![[0.0; 2]; 4 * grid.size],
            is_open: vec![false; 4 * grid.size],
        }
    }

    /// Takes the walls: the flux between two cells is the product of what they let through.
    pub(super) fn set_mask(&mut self, mask: &[f32]) {
        let size = self.size;
        for cell in 0..mask.len() {
            let right = if cell % size + 1 < size { mask[cell + 1] } else { 0.0 };
            let below = mask.get(cell + size).copied().unwrap_or(0.0);
            self.flux_x[cell] = self.flux * mask[cell] * right;
            self.flux_z[cell] = self.flux * mask[cell] * below;
        }
        for (index, is_open) in self.is_open.iter_mut().enumerate() {
            *is_open = border_cells(size, index / size, index % size).iter().all(|cell| mask[*cell] > 0.0);
        }
    }

    /// One step, in as many substeps as it takes.
    pub(super) fn step(&mut self, heights: &mut [f32], potentials: &mut [f32]) {
        for _ in 0..self.substeps {
            self.remember_border(potentials);
            for (potential, height) in potentials.iter_mut().zip(&*heights) {
                *potential -= self.fall * height;
            }
            self.open_border(heights, potentials);
            self.flow(heights, potentials);
        }
    }

    /// Moves water along the differences of the potential.
    fn flow(&self, heights: &mut [f32], potentials: &[f32]) {
        let size = self.size;
        let inner = size..heights.len() - size;
        let rows = heights[inner.clone()].chunks_exact_mut(size);
        let here = potentials[inner.clone()].chunks_exact(size);
        let above = potentials.chunks_exact(size);
        let below = potentials[2 * size..].chunks_exact(size);
        let across = self.flux_x[inner.clone()].chunks_exact(size);
        let up = self.flux_z.chunks_exact(size);
        let down = self.flux_z[inner].chunks_exact(size);
        let rows = rows.zip(here).zip(above.zip(below)).zip(across.zip(up.zip(down)));
        for (((row, here), (above, below)), (across, (up, down))) in rows {
            // All cut to the inner columns, so that no index is checked in the loop.
            let count = size - 2;
            let row = &mut row[1..][..count];
            let (left, middle, right) = (&here[..count], &here[1..][..count], &here[2..][..count]);
            let (above, below) = (&above[1..][..count], &below[1..][..count]);
            let (before, after) = (&across[..count], &across[1..][..count]);
            let (up, down) = (&up[1..][..count], &down[1..][..count]);
            for i in 0..count {
                let potential = middle[i];
                row[i] -= before[i] * (left[i] - potential)
                    + after[i] * (right[i] - potential)
                    + up[i] * (above[i] - potential)
                    + down[i] * (below[i] - potential);
            }
        }
    }

    /// Keeps of every border cell its potential and what of Mur's formula is known before the substep.
    fn remember_border(&mut self, potentials: &[f32]) {
        let (size, factor) = (self.size, self.border);
        for (index, before) in self.before.iter_mut().enumerate() {
            let [cell, inner] = border_cells(size, index / size, index % size);
            *before = [potentials[cell], potentials[inner] - factor * potentials[cell]];
        }
    }

    /// Lets waves out: `φ' = φ_inner + (C − 1)/(C + 1) (φ'_inner − φ)`, and the height that goes with it.
    fn open_border(&self, heights: &mut [f32], potentials: &mut [f32]) {
        let (size, factor) = (self.size, self.border);
        for (index, ([old, known], is_open)) in self.before.iter().zip(&self.is_open).enumerate() {
            let [cell, inner] = border_cells(size, index / size, index % size);
            if *is_open {
                potentials[cell] = known + factor * potentials[inner];
                heights[cell] = (old - potentials[cell]) / self.fall;
            } else {
                heights[cell] = 0.0;
            }
        }
    }

    /// Energy of the waves inside the border over the density of water, m⁵/s²: the one that leapfrog keeps, between two
    /// half steps.
    pub(super) fn energy(&self, grid: &RippleGrid, heights: &[f32], potentials: &[f32]) -> f64 {
        let size = self.size;
        let is_inner =
            |cell: usize| [cell % size, cell / size].iter().all(|place| (1..size - 1).contains(place));
        let after = |cell: usize| f64::from(potentials[cell]) - f64::from(self.fall * heights[cell]);
        let flow = |cell: usize, next: usize, flux: &[f32]| {
            let difference = f64::from(potentials[next]) - f64::from(potentials[cell]);
            let share = if is_inner(next) { f64::from(flux[cell]) } else { 0.0 };
            share * difference * (after(next) - after(cell))
        };
        let energies = (0..grid.cells()).filter(|cell| is_inner(*cell)).map(|cell| {
            let flows = flow(cell, cell + 1, &self.flux_x) + flow(cell, cell + size, &self.flux_z);
            // A flux is h·dt/cell² and the fall g·dt.
            f64::from(heights[cell]).powi(2) + flows / f64::from(self.fall)
        });
        0.5 * GRAVITY * grid.cell * grid.cell * energies.sum::<f64>()
    }
}

/// The cell at a place along a side (left, right, upper, lower), and its inner neighbor.
fn border_cells(size: usize, side: usize, place: usize) -> [usize; 2] {
    let last = size - 1;
    match side {
        0 => [place * size, place * size + 1],
        1 => [place * size + last, place * size + last - 1],
        2 => [place, size + place],
        _ => [last * size + place, (last - 1) * size + place],
    }
}
