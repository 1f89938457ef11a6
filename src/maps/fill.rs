//! Smooth fills. Push-pull: unknown cells take the weighted mean of what is known around them, at the finest scale that
//! knows any. Membrane: the same, relaxed at every scale until it hangs like a soap film.
//!
//! Known cells (weight 1) keep their values to the bit.

use rayon::prelude::*;

/// One level of the pyramid: values and how much of each is known, 0–1.
struct Level<const C: usize> {
    width: usize,
    height: usize,
    values: Vec<[f32; C]>,
    weights: Vec<f32>,
}

/// Fills the cells whose weight is below 1, in place; `values` and `weights` have `width · height` cells.
///
/// A cell of weight w keeps w of its own value. When nothing is known at all, everything becomes zero.
pub(super) fn push_pull<const C: usize>(width: usize, values: &mut [[f32; C]], weights: &[f32]) {
    fill(width, values, weights, 0);
}

/// Fills like [`push_pull`], by the solution of Laplace's equation: linear around a hole stays linear in it.
pub(super) fn membrane<const C: usize>(width: usize, values: &mut [[f32; C]], weights: &[f32]) {
    fill(width, values, weights, SWEEPS);
}

/// Relaxations of a membrane at each level; each level starts from the coarser one's solution.
const SWEEPS: usize = 12;

fn fill<const C: usize>(width: usize, values: &mut [[f32; C]], weights: &[f32], sweeps: usize) {
    if width == 0 || values.is_empty() {
        return;
    }
    let height = values.len() / width;
    let mut pyramid = vec![reduced(width, height, values, weights)];
    while let Some(last) = pyramid.last()
        && last.width * last.height > 1
    {
        pyramid.push(reduced(last.width, last.height, &last.values, &last.weights));
    }
    while let Some(coarse) = pyramid.pop() {
        match pyramid.last_mut() {
            Some(fine) => {
                expand(&coarse, fine.width, &mut fine.values, &fine.weights);
                relax(fine.width, &mut fine.values, &fine.weights, sweeps);
            }
            None => {
                expand(&coarse, width, values, weights);
                relax(width, values, weights, sweeps);
            }
        }
    }
}

/// Sets each cell of which nothing is known to the mean of its neighbors, `sweeps` times.
fn relax<const C: usize>(width: usize, values: &mut [[f32; C]], weights: &[f32], sweeps: usize) {
    if sweeps == 0 {
        return;
    }
    let height = values.len() / width;
    let unknown: Vec<usize> = (0..values.len()).filter(|&cell| weights[cell] <= 0.0).collect();
    let mut means: Vec<[f32; C]> = Vec::with_capacity(unknown.len());
    for _ in 0..sweeps {
        let now = &*values;
        unknown
            .par_iter()
            .with_min_len(2048)
            .map(|&cell| {
                let (x, y) = (cell % width, cell / width);
                let around = [
                    if x > 0 { cell - 1 } else { cell },
                    if x + 1 < width { cell + 1 } else { cell },
                    if y > 0 { cell - width } else { cell },
                    if y + 1 < height { cell + width } else { cell },
                ];
                std::array::from_fn(|c| 0.25 * around.iter().map(|&near| now[near][c]).sum::<f32>())
            })
            .collect_into_vec(&mut means);
        for (&cell, mean) in unknown.iter().zip(&means) {
            values[cell] = *mean;
        }
    }
}

/// Half the size: means weighted by what is known; one known cell of four makes the whole known.
fn reduced<const C: usize>(width: usize, height: usize, values: &[[f32; C]], weights: &[f32]) -> Level<C> {
    let (w, h) = (width.div_ceil(2), height.div_ceil(2));
    let (mut reduced, mut known) = (Vec::new(), Vec::new());
    (0..w * h)
        .into_par_iter()
        .with_min_len(4096)
        .map(|index| {
            let (x, y) = (index % w * 2, index / w * 2);
            let mut sum = [0.0; C];
            let mut weight = 0.0;
            for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                if x + i < width && y + j < height {
                    let from = (y + j) * width + x + i;
                    weight += weights[from];
                    for channel in 0..C {
                        sum[channel] += weights[from] * values[from][channel];
                    }
                }
            }
            if weight > 0.0 { (sum.map(|s| s / weight), weight.min(1.0)) } else { ([0.0; C], 0.0) }
        })
        .unzip_into_vecs(&mut reduced, &mut known);
    Level { width: w, height: h, values: reduced, weights: known }
}

/// Fills a level's unknown share from the bilinearly enlarged coarser one.
fn expand<const C: usize>(coarse: &Level<C>, width: usize, values: &mut [[f32; C]], weights: &[f32]) {
    values.par_iter_mut().with_min_len(4096).enumerate().for_each(|(index, value)| {
        let known = weights[index];
        if known >= 1.0 {
            return;
        }
        // The fine cell's center in coarse cells.
        let at = |fine: usize, limit: usize| {
            let c = (fine as f32 + 0.5) * 0.5 - 0.5;
            let low = c.floor();
            let last = limit as i32 - 1;
            ((low as i32).clamp(0, last) as usize, (low as i32 + 1).clamp(0, last) as usize, c - low)
        };
        let (x0, x1, px) = at(index % width, coarse.width);
        let (y0, y1, py) = at(index / width, coarse.height);
        let cell = |x: usize, y: usize| &coarse.values[y * coarse.width + x];
        let (a, b, c, d) = (cell(x0, y0), cell(x1, y0), cell(x0, y1), cell(x1, y1));
        for channel in 0..C {
            let top = a[channel] + px * (b[channel] - a[channel]);
            let bottom = c[channel] + px * (d[channel] - c[channel]);
            let filled = top + py * (bottom - top);
            value[channel] = known * value[channel] + (1.0 - known) * filled;
        }
    });
}

/// The mean of the square of cells up to `reach` around each, which ends at the border.
pub(super) fn box_mean(width: usize, values: &[[f32; 3]], reach: usize) -> Vec<[f32; 3]> {
    let height = values.len() / width.max(1);
    let mut rows = vec![[0.0; 3]; values.len()];
    rows.par_chunks_mut(width.max(1)).zip(values.par_chunks(width.max(1))).for_each(|(means, row)| {
        running_mean(reach, width, |x| row[x], |x, mean| means[x] = mean);
    });
    // Columns become rows of a transposed grid, so that they too are made on all cores.
    let mut columns = vec![[0.0; 3]; values.len()];
    columns.par_chunks_mut(height.max(1)).enumerate().for_each(|(x, means)| {
        running_mean(reach, height, |y| rows[y * width + x], |y, mean| means[y] = mean);
    });
    (0..values.len()).into_par_iter().map(|cell| columns[cell % width * height + cell / width]).collect()
}

/// Means over up to `reach` places to both sides, by a sum in f64 that runs along.
fn running_mean(
    reach: usize,
    count: usize,
    value: impl Fn(usize) -> [f32; 3],
    mut found: impl FnMut(usize, [f32; 3]),
) {
    let mut sum = [0.0_f64; 3];
    let add = |place: usize, sign: f64, sum: &mut [f64; 3]| {
        sum.iter_mut().zip(value(place)).for_each(|(sum, value)| *sum += sign * f64::from(value));
    };
    (0..reach.min(count)).for_each(|place| add(place, 1.0, &mut sum));
    for place in 0..count {
        if place + reach < count {
            add(place + reach, 1.0, &mut sum);
        }
        if place > reach {
            add(place - reach - 1, -1.0, &mut sum);
        }
        let number = (place + reach + 1).min(count) - place.saturating_sub(reach);
        found(place, sum.map(|sum| (sum / number as f64) as f32));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_cells_keep_their_bits_and_a_hole_stays_within_its_rim() {
        let (w, h) = (37, 23);
        let mut values: Vec<[f32; 1]> = (0..w * h).map(|i| [0.2 + 0.01 * (i % w) as f32]).collect();
        let weights: Vec<f32> = (0..w * h)
            .map(|i| if (10..20).contains(&(i % w)) && (5..15).contains(&(i / w)) { 0.0 } else { 1.0 })
            .collect();
        let before = values.clone();
        for (value, weight) in values.iter_mut().zip(&weights) {
            if *weight == 0.0 {
                *value = [9.0];
            }
        }
        push_pull(w, &mut values, &weights);
        for i in 0..w * h {
            if weights[i] == 1.0 {
                assert_eq!(values[i], before[i], "cell {i} changed");
            } else {
                assert!(values[i][0] > 0.25 && values[i][0] < 0.45, "cell {i} became {}", values[i][0]);
            }
        }
    }

    #[test]
    fn a_membrane_keeps_a_slope_and_push_pull_does_not() {
        let (w, h) = (64, 48);
        let hole = |i: usize| (20..44).contains(&(i % w)) && (12..30).contains(&(i / w));
        let slope = |i: usize| 0.3 * (i % w) as f32 - 0.7 * (i / w) as f32;
        let weights: Vec<f32> = (0..w * h).map(|i| if hole(i) { 0.0 } else { 1.0 }).collect();
        let worst = |fill: &dyn Fn(&mut [[f32; 1]])| {
            let mut values: Vec<[f32; 1]> =
                (0..w * h).map(|i| [if hole(i) { 0.0 } else { slope(i) }]).collect();
            fill(&mut values);
            values.iter().enumerate().map(|(i, v)| (v[0] - slope(i)).abs()).fold(0.0, f32::max)
        };
        let soap = worst(&|values| membrane(w, values, &weights));
        let mean = worst(&|values| push_pull(w, values, &weights));
        assert!(soap < 0.35 && mean > 2.0 * soap, "off by {soap} (membrane) and {mean} (push-pull)");
    }

    #[test]
    fn nothing_known_becomes_zero() {
        let mut values = vec![[3.0, 4.0]; 12];
        push_pull(4, &mut values, &[0.0; 12]);
        assert!(values.iter().all(|v| *v == [0.0, 0.0]));
    }

    #[test]
    fn a_box_mean_is_the_mean_of_the_cells_around() {
        let (width, height) = (7, 5);
        let values: Vec<[f32; 3]> =
            (0..width * height).map(|i| [(i * i % 11) as f32, i as f32, 1.0]).collect();
        let means = box_mean(width, &values, 2);
        for y in 0..height {
            for x in 0..width {
                let around: Vec<f32> = (y.saturating_sub(2)..(y + 3).min(height))
                    .flat_map(|y| (x.saturating_sub(2)..(x + 3).min(width)).map(move |x| (x, y)))
                    .map(|(x, y)| values[y * width + x][0])
                    .collect();
                let expected = around.iter().sum::<f32>() / around.len() as f32;
                let [first, _, one] = means[y * width + x];
                assert!((first - expected).abs() < 1e-5 && one == 1.0, "({x}, {y}): {first} for {expected}");
            }
        }
    }
}
