//! Sums over boxes around every cell of a grid.

use rayon::prelude::*;

/// Sum of the values within `rx` columns and `ry` rows of each cell; beyond the grid is nothing.
pub(super) fn box_sum(width: usize, values: &[f32], rx: usize, ry: usize) -> Vec<f32> {
    let height = values.len() / width;
    let mut along = vec![0.0; values.len()];
    along.par_chunks_mut(width).zip(values.par_chunks(width)).for_each(|(sums, row)| {
        let mut sum: f64 = row.iter().take(rx).map(|&v| f64::from(v)).sum();
        for x in 0..width {
            if let Some(&entering) = row.get(x + rx) {
                sum += f64::from(entering);
            }
            sums[x] = sum as f32;
            if x >= rx {
                sum -= f64::from(row[x - rx]);
            }
        }
    });
    let mut sums = vec![0.0; values.len()];
    sums.par_chunks_mut(width).enumerate().for_each(|(y, sums)| {
        for other in y.saturating_sub(ry)..=(y + ry).min(height - 1) {
            for (sum, value) in sums.iter_mut().zip(&along[other * width..][..width]) {
                *sum += value;
            }
        }
    });
    sums
}
