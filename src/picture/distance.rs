//! Exact Euclidean distances on a grid, in linear time (Meijster 2000; Felzenszwalb & Huttenlocher 2012).
//!
//! Nothing lies outside the grid, so its border is no edge.

use rayon::prelude::*;

/// Square of a distance that no grid has.
const FAR: f32 = 1e12;

/// Distance in cells from each cell's center to the nearest center for which `is` holds; 1e6 where there is
/// none.
pub(crate) fn distances(width: usize, height: usize, is: impl Fn(usize) -> bool) -> Vec<f32> {
    // Along the columns first: down, then up.
    let mut distances: Vec<f32> =
        (0..width * height).map(|cell| if is(cell) { 0.0 } else { FAR.sqrt() }).collect();
    for cell in width..width * height {
        distances[cell] = distances[cell].min(distances[cell - width] + 1.0);
    }
    for cell in (width..width * height).rev() {
        distances[cell - width] = distances[cell - width].min(distances[cell] + 1.0);
    }
    distances.par_chunks_mut(width).for_each_init(Vec::new, |parabolas, row| {
        for distance in row.iter_mut() {
            *distance = (*distance * *distance).min(FAR);
        }
        lower_envelope(row, parabolas);
        for distance in row {
            *distance = distance.sqrt();
        }
    });
    distances
}

/// Replaces each value by the least of `values[q] + (p − q)²` over all places q. `parabolas` is room to work
/// in: those that are lowest somewhere, by apex, height and where each begins to be lowest.
fn lower_envelope(values: &mut [f32], parabolas: &mut Vec<(f32, f32, f32)>) {
    parabolas.clear();
    for (q, &height) in values.iter().enumerate().filter(|(_, height)| **height < FAR) {
        let q = q as f32;
        let mut from = f32::NEG_INFINITY;
        while let Some(&(apex, low, start)) = parabolas.last() {
            // Written by differences, which keeps wide grids exact.
            from = 0.5 * (q + apex + (height - low) / (q - apex));
            if from > start {
                break;
            }
            parabolas.pop();
            from = f32::NEG_INFINITY;
        }
        parabolas.push((q, height, from));
    }
    let mut lowest = 0;
    for (p, value) in values.iter_mut().enumerate() {
        let p = p as f32;
        while parabolas.get(lowest + 1).is_some_and(|next| next.2 < p) {
            lowest += 1;
        }
        if let Some(&(apex, height, _)) = parabolas.get(lowest) {
            *value = height + (p - apex) * (p - apex);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_the_nearest_cell() {
        let (width, height) = (31, 23);
        let is = |cell: usize| cell % 97 == 11;
        let found = distances(width, height, is);
        for (cell, found) in found.iter().enumerate() {
            let truth = (0..width * height)
                .filter(|&other| is(other))
                .map(|other| {
                    let dx = (cell % width) as f32 - (other % width) as f32;
                    let dy = (cell / width) as f32 - (other / width) as f32;
                    dx.hypot(dy)
                })
                .fold(f32::MAX, f32::min);
            assert!((found - truth).abs() < 1e-4, "cell {cell}: {found} instead of {truth}");
        }
    }

    #[test]
    fn without_cells_everything_is_far() {
        assert!(distances(5, 4, |_| false).iter().all(|&d| d > 1e5));
    }
}
