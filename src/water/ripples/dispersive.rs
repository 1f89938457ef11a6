//! Linear water waves of any length on water of finite depth: every wave vector is turned by its own frequency, exactly.
//!
//! `η_t = K φ` and `φ_t = −g η` with K = k tanh(kh) (eWave; notes §7.2). With both fields in one complex grid z = η + iφ, a
//! step is one forward and one inverse transform. It is stable for any step, and the grid is periodic.

use std::f64::consts::TAU;

use glam::DVec2;
use rustfft::FftDirection;
use rustfft::num_complex::Complex32;

use super::super::fft::SquareFft;
use super::super::{GRAVITY, TENSION, angular_frequency};
use super::grid::RippleGrid;

/// Share of a border that swallows waves: an eighth of the grid on either side.
const SPONGE: f64 = 0.125;

/// Damping at the outermost cells, 1/s.
const SPONGE_DAMPING: f64 = 5.0;

/// What a step does to each wave vector, with the transforms' factor: with z the value and w that of the opposite wave
/// vector, z ← (same − i·quarter) z − i·opposite·w̄.
#[derive(Clone, Debug, Default)]
struct Turns {
    same: Vec<f32>,
    quarter: Vec<f32>,
    opposite: Vec<f32>,
}

#[derive(Clone, Debug)]
pub(super) struct Dispersive {
    size: usize,
    forward: SquareFft,
    inverse: SquareFft,
    turns: Turns,
    cells: Vec<Complex32>,
    spectrum: Vec<Complex32>,
    /// Two rows of the spectrum, backwards.
    backwards: [Vec<Complex32>; 2],
}

impl Dispersive {
    /// Steps of `step` seconds on water `depth` meters deep.
    pub(super) fn new(grid: &RippleGrid, depth: f64, step: f64) -> Self {
        let size = grid.size;
        let factor = 1.0 / (size * size) as f64;
        let mut turns = Turns::default();
        for k in wave_numbers(grid) {
            let omega = angular_frequency(k, depth);
            let (sine, cosine) = (omega * step).sin_cos();
            // The mean stays: it is volume.
            let share = if omega > 0.0 { sine / omega } else { 0.0 };
            let [raise, press] = couplings(k, depth).map(|coupling| share * coupling);
            turns.same.push((factor * cosine) as f32);
            turns.quarter.push((factor * 0.5 * (press + raise)) as f32);
            turns.opposite.push((factor * 0.5 * (press - raise)) as f32);
        }
        Self {
            size,
            forward: SquareFft::new(size, FftDirection::Forward),
            inverse: SquareFft::new(size, FftDirection::Inverse),
            turns,
            cells: vec![Complex32::ZERO; grid.cells()],
            spectrum: vec![Complex32::ZERO; grid.cells()],
            backwards: [vec![Complex32::ZERO; size], vec![Complex32::ZERO; size]],
        }
    }

    /// What is left of a wave after a step at each place along a side.
    pub(super) fn sponge(grid: &RippleGrid, step: f64) -> Vec<f32> {
        let width = SPONGE * grid.size as f64;
        let kept = (0..grid.size).map(|place| {
            let to_border = 0.5 + place.min(grid.size - 1 - place) as f64;
            let depth = (1.0 - to_border / width).max(0.0);
            (-step * SPONGE_DAMPING * depth * depth).exp() as f32
        });
        kept.collect()
    }

    /// One step.
    pub(super) fn step(&mut self, heights: &mut [f32], potentials: &mut [f32]) {
        for ((cell, height), potential) in self.cells.iter_mut().zip(&*heights).zip(&*potentials) {
            *cell = Complex32::new(*height, *potential);
        }
        self.forward.process(&mut self.cells, &mut self.spectrum);
        self.turn();
        self.inverse.process(&mut self.spectrum, &mut self.cells);
        for ((cell, height), potential) in self.cells.iter().zip(heights).zip(potentials) {
            *height = cell.re;
            *potential = cell.im;
        }
    }

    /// Turns all wave vectors. The spectrum lies transposed, which changes nothing: only lengths count.
    fn turn(&mut self) {
        let size = self.size;
        let [backwards, opposite_backwards] = &mut self.backwards;
        for row in 0..=size / 2 {
            let opposite = (size - row) % size;
            reverse(&self.spectrum[row * size..][..size], backwards);
            reverse(&self.spectrum[opposite * size..][..size], opposite_backwards);
            self.turns.apply(row, &mut self.spectrum[row * size..][..size], opposite_backwards);
            if opposite != row {
                self.turns.apply(row, &mut self.spectrum[opposite * size..][..size], backwards);
            }
        }
    }

    /// Energy of the waves over the density of water, m⁵/s².
    pub(super) fn energy(&self, grid: &RippleGrid, depth: f64, heights: &[f32], potentials: &[f32]) -> f64 {
        let size = self.size;
        let mut transform = self.forward.clone();
        let mut spectra = [heights, potentials].into_iter().map(|field| {
            let mut from: Vec<_> = field.iter().map(|value| Complex32::new(*value, 0.0)).collect();
            let mut to = from.clone();
            transform.process(&mut from, &mut to);
            to
        });
        let (Some(heights), Some(potentials)) = (spectra.next(), spectra.next()) else { return 0.0 };
        let sum = wave_numbers(grid).zip(heights).zip(potentials).map(|((k, height), potential)| {
            let [raise, press] = couplings(k, depth);
            press * f64::from(height.norm_sqr()) + raise * f64::from(potential.norm_sqr())
        });
        0.5 * (grid.cell / size as f64).powi(2) * sum.sum::<f64>()
    }
}

impl Turns {
    /// Turns a row, or its opposite, given the other one backwards.
    fn apply(&self, row: usize, values: &mut [Complex32], backwards: &[Complex32]) {
        let range = row * values.len()..(row + 1) * values.len();
        let [same, quarter, opposite] =
            [&self.same, &self.quarter, &self.opposite].map(|table| &table[range.clone()]);
        let turns = same.iter().zip(quarter).zip(opposite);
        for ((z, w), ((same, quarter), opposite)) in values.iter_mut().zip(backwards).zip(turns) {
            *z = Complex32 {
                re: same * z.re + quarter * z.im - opposite * w.im,
                im: same * z.im - quarter * z.re - opposite * w.re,
            };
        }
    }
}

/// Copies a row so that each wave number takes its opposite's place.
fn reverse(row: &[Complex32], backwards: &mut [Complex32]) {
    backwards[0] = row[0];
    for (to, from) in backwards[1..].iter_mut().zip(row[1..].iter().rev()) {
        *to = *from;
    }
}

/// How fast a potential raises the surface, K in 1/m, and a height the potential, g + (σ/ρ)k² in m/s².
fn couplings(k: f64, depth: f64) -> [f64; 2] {
    [if k > 0.0 { k * (k * depth).tanh() } else { 0.0 }, GRAVITY + TENSION * k * k]
}

/// Wave numbers in the transform's order, rad/m.
fn wave_numbers(grid: &RippleGrid) -> impl Iterator<Item = f64> {
    let size = grid.size;
    let unit = TAU / grid.side();
    let cycles = move |index: usize| index.min(size - index) as f64;
    (0..size * size).map(move |place| unit * DVec2::new(cycles(place % size), cycles(place / size)).length())
}
