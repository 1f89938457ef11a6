//! Fourier transforms of square grids in two dimensions: rows, transpose, rows.
//!
//! The result lies transposed in the other buffer, so that going there and back costs two transposes. Nothing is
//! allocated after construction.

use std::fmt;
use std::sync::Arc;

use rustfft::num_complex::Complex32;
use rustfft::{Fft, FftDirection, FftPlanner};

/// A planned transform of grids of one size in one direction, without a factor.
#[derive(Clone)]
pub(super) struct SquareFft {
    plan: Arc<dyn Fft<f32>>,
    scratch: Vec<Complex32>,
}

impl SquareFft {
    /// A transform of `size` × `size` cells.
    pub(super) fn new(size: usize, direction: FftDirection) -> Self {
        let plan = FftPlanner::new().plan_fft(size, direction);
        let scratch = vec![Complex32::ZERO; plan.get_inplace_scratch_len()];
        Self { plan, scratch }
    }

    /// Transforms `from` into `to`, transposed; `from` is destroyed.
    pub(super) fn process(&mut self, from: &mut [Complex32], to: &mut [Complex32]) {
        self.rows(from);
        self.finish(from, to);
    }

    /// As [`process`](Self::process), for a grid whose rows are zero but for the first and last few: those up to
    /// `reach` and as many, less one, before the end.
    pub(super) fn process_low_rows(&mut self, reach: usize, from: &mut [Complex32], to: &mut [Complex32]) {
        let size = self.plan.len();
        let (low, negative) = if 2 * reach < size { (reach + 1, size - reach) } else { (size, size) };
        self.rows(&mut from[..low * size]);
        self.rows(&mut from[negative * size..]);
        self.finish(from, to);
    }

    fn rows(&mut self, rows: &mut [Complex32]) {
        self.plan.process_with_scratch(rows, &mut self.scratch);
    }

    fn finish(&mut self, from: &[Complex32], to: &mut [Complex32]) {
        let size = self.plan.len();
        transpose::transpose(from, to, size, size);
        self.rows(to);
    }
}

impl fmt::Debug for SquareFft {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "SquareFft({0} x {0}, {1:?})", self.plan.len(), self.plan.fft_direction())
    }
}
