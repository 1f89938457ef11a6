//! Closed-form matting (Levin, Lischinski, Weiss 2008) over the unknown cells only.
//!
//! Within each 3×3 window alpha is taken as an affine function of color; the squared errors of all windows
//! plus a data term are least where `(L + D) α = D α₀`. L is kept as 25 numbers for each unknown cell.
//! Windows that leave the picture or touch foreign cells are left out, so a cell without windows takes the
//! data term's value.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::palette::outer;

/// Variance of color that a window ignores, on colors of 0–1 (ε of the paper).
const EPSILON: f64 = 1e-6;

/// Reach of the matting Laplacian: two cells in a window are at most two apart.
const REACH: usize = 2;
const SIDE: usize = 2 * REACH + 1;

/// What is known of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cell {
    /// Its alpha, 0–1, is certain.
    Known(f32),
    /// Its alpha is sought: near `alpha`, with `weight` against the windows' errors, above 0.
    Unknown { alpha: f32, weight: f32 },
    /// Takes no part.
    Foreign,
}

/// Mean and regularized inverse covariance of a window's colors.
#[derive(Clone, Copy, Debug)]
struct Window {
    mean: DVec3,
    inverse: DMat3,
}

/// The linear system. Values live in numbered slots, row by row: the unknown cells and everything in reach of
/// them, so the cells in reach of an unknown one lie in five runs of five slots.
#[derive(Debug)]
pub(super) struct System {
    /// Cell of each unknown.
    pub cells: Vec<u32>,
    rows: Vec<Row>,
    slots: usize,
    /// Right side, and a first guess, for each unknown.
    pub right: Vec<f32>,
    pub guess: Vec<f32>,
}

/// One equation: where its five runs of slots begin and what each slot's value counts.
#[derive(Clone, Copy, Debug)]
struct Row {
    runs: [u32; SIDE],
    factors: [[f32; SIDE]; SIDE],
}

impl System {
    /// The equations of all unknown cells of a picture of `colors`, `width` to a row.
    pub(super) fn new(width: usize, colors: &[[f32; 3]], cells: &[Cell]) -> Self {
        let height = cells.len() / width;
        let unknown: Vec<u32> = (0..cells.len())
            .filter(|&i| matches!(cells[i], Cell::Unknown { .. }))
            .map(|i| i as u32)
            .collect();

        // A frame of REACH cells, so that runs never leave the grid.
        let framed = width + 2 * REACH;
        let mut slot_of = vec![u32::MAX; framed * (height + 2 * REACH)];
        for &cell in &unknown {
            let corner = cell as usize / width * framed + cell as usize % width;
            for row in 0..SIDE {
                slot_of[corner + row * framed..][..SIDE].fill(0);
            }
        }
        let mut slots = 0;
        for slot in slot_of.iter_mut().filter(|slot| **slot == 0) {
            *slot = slots;
            slots += 1;
        }
        let framed_cells: Vec<u32> =
            (0..slot_of.len()).filter(|&i| slot_of[i] != u32::MAX).map(|i| i as u32).collect();
        let windows: Vec<Option<Window>> = framed_cells
            .par_iter()
            .map(|&framed_cell| {
                let (x, y) = (framed_cell as usize % framed, framed_cell as usize / framed);
                let inside = (REACH + 1..width + REACH - 1).contains(&x)
                    && (REACH + 1..height + REACH - 1).contains(&y);
                inside.then(|| window(width, colors, cells, (y - REACH) * width + x - REACH)).flatten()
            })
            .collect();

        let rows: Vec<(Row, f32, f32)> = unknown
            .par_iter()
            .map(|&cell| {
                let (x, y) = (cell as usize % width, cell as usize / width);
                let runs = std::array::from_fn(|row| slot_of[(y + row) * framed + x]);
                equation(width, colors, cells, &windows, cell as usize, runs)
            })
            .collect();
        Self {
            cells: unknown,
            slots: slots as usize,
            right: rows.iter().map(|row| row.1).collect(),
            guess: rows.iter().map(|row| row.2).collect(),
            rows: rows.into_iter().map(|row| row.0).collect(),
        }
    }

    /// Number of slots.
    pub(super) fn slots(&self) -> usize {
        self.slots
    }

    /// Slot of an unknown.
    pub(super) fn slot(&self, unknown: usize) -> usize {
        self.rows[unknown].runs[REACH] as usize + REACH
    }

    /// What the equation of an unknown gives for the slots' values; slots that are not unknown must hold 0.
    pub(super) fn product(&self, unknown: usize, values: &[f32]) -> f32 {
        let row = &self.rows[unknown];
        let mut sum = [0.0; SIDE];
        for (&run, factors) in row.runs.iter().zip(&row.factors) {
            let values = &values[run as usize..run as usize + SIDE];
            for i in 0..SIDE {
                sum[i] += factors[i] * values[i];
            }
        }
        sum.iter().sum()
    }

    /// The factor of an unknown in its own equation, above 0.
    pub(super) fn diagonal(&self, unknown: usize) -> f32 {
        self.rows[unknown].factors[REACH][REACH]
    }
}

fn color(colors: &[[f32; 3]], cell: usize) -> DVec3 {
    glam::Vec3::from_array(colors[cell]).as_dvec3()
}

/// The nine cells of the window around a cell that is not on the border.
fn around(width: usize, center: usize) -> [usize; 9] {
    std::array::from_fn(|i| center + i / 3 * width + i % 3 - width - 1)
}

/// The window around a cell; `None` where it touches foreign cells.
fn window(width: usize, colors: &[[f32; 3]], cells: &[Cell], center: usize) -> Option<Window> {
    let nine = around(width, center);
    if nine.iter().any(|&cell| cells[cell] == Cell::Foreign) {
        return None;
    }
    let mean = nine.iter().map(|&cell| color(colors, cell)).sum::<DVec3>() / 9.0;
    let mut covariance = DMat3::from_diagonal(DVec3::splat(EPSILON / 9.0));
    for &cell in &nine {
        let off = color(colors, cell) - mean;
        covariance += outer(off) * (1.0 / 9.0);
    }
    Some(Window { mean, inverse: covariance.inverse() })
}

/// An unknown cell's equation, its right side and its first guess.
fn equation(
    width: usize,
    colors: &[[f32; 3]],
    cells: &[Cell],
    windows: &[Option<Window>],
    cell: usize,
    runs: [u32; SIDE],
) -> (Row, f32, f32) {
    let own = color(colors, cell);
    let mut factors = [[0.0_f64; SIDE]; SIDE];
    for center in 0..9 {
        let (cx, cy) = (center % 3, center / 3);
        let Some(window) = &windows[runs[cy + 1] as usize + cx + 1] else { continue };
        let weighted = window.inverse * (own - window.mean);
        let middle = cell + cy * width + cx - width - 1;
        for (i, &other) in around(width, middle).iter().enumerate() {
            let affinity = (1.0 + weighted.dot(color(colors, other) - window.mean)) / 9.0;
            factors[cy + i / 3][cx + i % 3] -= affinity;
        }
        factors[REACH][REACH] += 1.0;
    }
    let (mut right, mut guess) = (0.0, 0.0);
    if let Cell::Unknown { alpha, weight } = cells[cell] {
        factors[REACH][REACH] += f64::from(weight);
        right += f64::from(weight) * f64::from(alpha);
        guess = alpha;
    }
    // What is known moves to the right side.
    for (row, factors) in factors.iter_mut().enumerate() {
        for (column, factor) in factors.iter_mut().enumerate() {
            if *factor != 0.0
                && let Cell::Known(alpha) = cells[cell + row * width + column - REACH * width - REACH]
            {
                right -= *factor * f64::from(alpha);
                *factor = 0.0;
            }
        }
    }
    let factors = factors.map(|row| row.map(|factor| factor as f32));
    (Row { runs, factors }, right as f32, guess)
}
