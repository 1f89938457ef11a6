//! Conjugate gradients with Jacobi's preconditioner.
//!
//! Sums are taken over fixed chunks in a fixed order: the result is the same to the bit on any number of
//! threads.

use rayon::prelude::*;

use super::closed_form::System;

/// Unknowns a thread takes at once.
const CHUNK: usize = 4096;

/// The solution's residual is this part of the right side's norm.
const TOLERANCE: f64 = 1e-6;

/// Steps after which the solution is taken as it is.
const MAX_STEPS: usize = 2000;

/// Solves the system from its own guess; `progress` gets the share done and says whether to go on. `None` if
/// not.
pub(super) fn solve(system: &System, progress: &dyn Fn(f32) -> bool) -> Option<Vec<f32>> {
    let count = system.cells.len();
    let mut solution = system.guess.clone();
    let mut direction = vec![0.0_f32; system.slots()];
    for (unknown, &value) in solution.iter().enumerate() {
        direction[system.slot(unknown)] = value;
    }
    let mut product = vec![0.0_f32; count];
    multiply(system, &direction, &mut product);
    let mut residual: Vec<f32> =
        system.right.iter().zip(&product).map(|(right, product)| right - product).collect();
    let scale: Vec<f32> = (0..count).map(|unknown| 1.0 / system.diagonal(unknown)).collect();

    let goal = TOLERANCE * TOLERANCE * weighted(&system.right, &scale);
    let first = weighted(&residual, &scale);
    let mut error = first;
    for (unknown, (&r, &s)) in residual.iter().zip(&scale).enumerate() {
        direction[system.slot(unknown)] = r * s;
    }
    for step in 0..MAX_STEPS {
        if error <= goal {
            break;
        }
        // The error falls about exponentially.
        let done = (error / first).ln() / (goal / first).ln();
        if step % 8 == 0 && !progress(done.clamp(0.0, 1.0) as f32) {
            return None;
        }
        let curvature = multiply(system, &direction, &mut product);
        if curvature <= 0.0 {
            break;
        }
        let length = (error / curvature) as f32;
        let before = error;
        error = advance(system, length, &direction, &product, &scale, &mut solution, &mut residual);
        let keep = (error / before) as f32;
        for (unknown, (&r, &s)) in residual.iter().zip(&scale).enumerate() {
            let slot = &mut direction[system.slot(unknown)];
            *slot = r * s + keep * *slot;
        }
    }
    Some(solution)
}

/// Multiplies the system with a direction; returns the product's inner product with the direction.
fn multiply(system: &System, direction: &[f32], product: &mut [f32]) -> f64 {
    let sums: Vec<f64> = product
        .par_chunks_mut(CHUNK)
        .enumerate()
        .map(|(chunk, product)| {
            let mut sum = 0.0;
            for (i, product) in product.iter_mut().enumerate() {
                let unknown = chunk * CHUNK + i;
                *product = system.product(unknown, direction);
                sum += f64::from(*product) * f64::from(direction[system.slot(unknown)]);
            }
            sum
        })
        .collect();
    sums.iter().sum()
}

/// One step along the direction; returns the preconditioned square of the residual.
fn advance(
    system: &System,
    length: f32,
    direction: &[f32],
    product: &[f32],
    scale: &[f32],
    solution: &mut [f32],
    residual: &mut [f32],
) -> f64 {
    let sums: Vec<f64> = solution
        .par_chunks_mut(CHUNK)
        .zip(residual.par_chunks_mut(CHUNK))
        .enumerate()
        .map(|(chunk, (solution, residual))| {
            let first = chunk * CHUNK;
            for (i, (solution, residual)) in solution.iter_mut().zip(residual.iter_mut()).enumerate() {
                *solution += length * direction[system.slot(first + i)];
                *residual -= length * product[first + i];
            }
            weighted(residual, &scale[first..first + residual.len()])
        })
        .collect();
    sums.iter().sum()
}

/// Sum of squares, each times its scale.
fn weighted(values: &[f32], scale: &[f32]) -> f64 {
    values
        .iter()
        .zip(scale)
        .map(|(&value, &scale)| f64::from(value) * f64::from(value) * f64::from(scale))
        .sum()
}
