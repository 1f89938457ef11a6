//! The receding plane in a heap of shifts: what a line through the columns' shifts explains better than frontal planes do.

use super::planes::{Plane, Sample, is_near, tolerance};

/// A plane whose shift changes by less than this part of its mean stands frontally, as the scene has it.
const LEAST_CHANGE: f64 = 0.25;
/// And by less than so many of the steps that are not seen.
const LEAST_STEPS: f64 = 4.0;
/// Columns in which shifts are heaped, and heaps of each that are looked at.
const COLUMNS: usize = 96;
const HEAPS: usize = 3;
/// Fewer samples are no heap.
const LEAST_HEAP: usize = 4;
/// A plane goes on behind what hides so many columns of it, and is seen in so many.
const HIDDEN_COLUMNS: usize = 12;
const LEAST_COLUMNS: usize = 8;

/// Samples of one column with nearly the same shift.
#[derive(Clone, Copy, Debug)]
struct Heap {
    column: usize,
    across: f64,
    shift: f64,
    count: f64,
    /// How far its samples may be from a plane.
    tolerance: f64,
    /// What the nearest step leaves of it, squared pixels a sample.
    step: f64,
}

/// The receding plane that leaves least of what frontal ones at these `steps` leave; less than `apart` pixels is not seen.
pub(super) fn receding_plane(samples: &[Sample], steps: &[f64], apart: f64) -> Option<Plane> {
    let (low, high) = samples
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| (low.min(s.across), high.max(s.across)));
    let width = (high - low) / COLUMNS as f64;
    if !(width > 0.0 && width.is_finite()) {
        return None;
    }
    let column_of = |across: f64| (((across - low) / width) as usize).min(COLUMNS - 1);
    let mut columns: Vec<Vec<Sample>> = vec![Vec::new(); COLUMNS];
    samples.iter().for_each(|sample| columns[column_of(sample.across)].push(*sample));
    let heaps: Vec<Heap> = columns
        .iter_mut()
        .enumerate()
        .flat_map(|(column, samples)| heaps(column, samples, steps, apart))
        .collect();
    let mut best: Option<(f64, [usize; 2], Plane)> = None;
    for (i, a) in heaps.iter().enumerate() {
        for b in heaps[i..].iter().filter(|b| b.column >= a.column + LEAST_COLUMNS) {
            let slope = (b.shift - a.shift) / (b.across - a.across);
            let plane = Plane { at_zero: a.shift - slope * a.across, slope, reach: [a.across, b.across] };
            if !changes_enough(&plane, apart) {
                continue;
            }
            let Some((gain, run)) = run(&heaps, &plane, a.column) else { continue };
            if run[1] >= b.column && best.as_ref().is_none_or(|best| gain > best.0) {
                best = Some((gain, run, plane));
            }
        }
    }
    let (_, run, mut plane) = best?;
    plane.reach = [low + width * run[0] as f64, low + width * (run[1] + 1) as f64];
    for _ in 0..3 {
        let own: Vec<Sample> = samples.iter().copied().filter(|s| is_near(&plane, s, apart)).collect();
        plane = Plane::through(&own, plane.reach)?;
    }
    changes_enough(&plane, apart).then_some(plane)
}

fn changes_enough(plane: &Plane, apart: f64) -> bool {
    let [left, right] = plane.reach.map(|end| plane.shift(end));
    let change = (right - left).abs();
    left.min(right) > 0.0 && change > LEAST_CHANGE * 0.5 * (left + right) && change > LEAST_STEPS * apart
}

/// What a plane takes away from what steps leave, along the columns around `start` that show it, and their first and last.
fn run(heaps: &[Heap], plane: &Plane, start: usize) -> Option<(f64, [usize; 2])> {
    let mut gains = [None; COLUMNS];
    for heap in heaps {
        let off = (heap.shift - plane.shift(heap.across)).abs();
        if off <= heap.tolerance {
            *gains[heap.column].get_or_insert(0.0) += heap.count * (heap.step - off * off);
        }
    }
    // As far as what is taken away grows, over what hides a few columns.
    let half = |columns: &mut dyn Iterator<Item = usize>| {
        let (mut sum, mut hidden, mut best, mut count) = (0.0, 0, (0.0, start), 0);
        for column in columns {
            match gains[column] {
                Some(gain) => {
                    (sum, hidden, count) = (sum + gain, 0, count + 1);
                    if sum > best.0 {
                        best = (sum, column);
                    }
                }
                None => hidden += 1,
            }
            if hidden > HIDDEN_COLUMNS {
                break;
            }
        }
        (best, count)
    };
    let ((right_gain, right), right_count) = half(&mut (start..COLUMNS));
    let ((left_gain, left), left_count) = half(&mut (0..start).rev());
    let left = left.min(start);
    (right_count + left_count >= LEAST_COLUMNS).then_some((left_gain + right_gain, [left, right]))
}

/// The largest heaps of a column's samples.
fn heaps(column: usize, samples: &mut Vec<Sample>, steps: &[f64], apart: f64) -> Vec<Heap> {
    samples.sort_by(|a, b| a.shift.total_cmp(&b.shift));
    let mut found: Vec<Heap> = Vec::new();
    for _ in 0..HEAPS {
        // The window with the most samples.
        let (mut first, mut most) = (0, 0..0);
        for (last, sample) in samples.iter().enumerate() {
            let reach = 2.0 * tolerance(sample, apart);
            while sample.shift - samples[first].shift > reach {
                first += 1;
            }
            if last + 1 - first > most.len() {
                most = first..last + 1;
            }
        }
        if most.len() < LEAST_HEAP {
            break;
        }
        let own: Vec<Sample> = samples.drain(most).collect();
        let mean = |of: &dyn Fn(&Sample) -> f64| own.iter().map(of).sum::<f64>() / own.len() as f64;
        let shift = mean(&|s| s.shift);
        let step = steps.iter().map(|step| (step - shift).powi(2)).fold(f64::INFINITY, f64::min);
        let tolerance = mean(&|s| tolerance(s, apart));
        let across = mean(&|s| s.across);
        found.push(Heap { column, across, shift, count: own.len() as f64, tolerance, step });
    }
    found
}
