//! A color mixture that knows the place: Gaussians over place and color together, each with a full covariance.
//!
//! A landscape has other colors above than below, and water repeats an object's own colors beneath it; a mixture of colors
//! alone takes one for the other (notes §3.2 extended). A sample belongs to the one part that explains it best, as in
//! `GrabCut`. Its cost is −ln of the density of its color given its place, up to a constant: where a side was seen says
//! which colors to expect there, not how likely the side is.

use rayon::prelude::*;

use crate::random::Random;

/// Column and row, scaled, then red, green, blue as 0–1.
pub(super) type Sample = [f32; WIDTH];

/// Numbers of a sample, and those that tell its place.
const WIDTH: usize = 5;
const PLACES: usize = 2;

/// Entries of a triangle of a matrix with its diagonal.
const TRIANGLE: usize = WIDTH * (WIDTH + 1) / 2;

/// Variance of a color's noise on a scale of 0–1: two sRGB codes.
const COLOR_NOISE: f64 = (2.0 / 255.0) * (2.0 / 255.0);

/// How far, as a share, a color is expected to reach beyond the places where it was seen: marks do not cover everything.
const REACH: f64 = 0.1;

/// How much places count against colors when clusters are sought: all across what was pointed at as much as this step of
/// color.
pub(super) const PLACE: f32 = 0.3;

/// Samples summed up in one go; fixed, so that sums do not depend on the number of cores.
const CHUNK: usize = 1 << 14;

/// Samples and rounds of the k-means that begins a mixture.
const SAMPLE: usize = 8192;
const ROUNDS: usize = 12;

/// A mixture of Gaussians.
#[derive(Clone, Debug)]
pub(super) struct Mixture {
    parts: Vec<Part>,
}

#[derive(Clone, Copy, Debug)]
struct Part {
    mean: Sample,
    /// Rows of the lower triangle of L⁻¹/√2, with L Lᵀ the covariance.
    whitening: [f32; TRIANGLE],
    /// What does not depend on the sample: for its place, for its color there.
    bases: [f32; 2],
}

/// Weighted sums over samples.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    weight: f64,
    first: [f64; WIDTH],
    /// Rows of the lower triangle.
    second: [f64; TRIANGLE],
}

/// Where an entry of a lower triangle is kept.
const fn at(row: usize, column: usize) -> usize {
    row * (row + 1) / 2 + column
}

impl Sums {
    fn add(&mut self, other: &Self) {
        self.weight += other.weight;
        self.first.iter_mut().zip(other.first).for_each(|(sum, more)| *sum += more);
        self.second.iter_mut().zip(other.second).for_each(|(sum, more)| *sum += more);
    }

    fn add_sample(&mut self, sample: &Sample, weight: f32) {
        let sample = sample.map(f64::from);
        let weight = f64::from(weight);
        self.weight += weight;
        for row in 0..WIDTH {
            self.first[row] += weight * sample[row];
            for column in 0..=row {
                self.second[at(row, column)] += weight * sample[row] * sample[column];
            }
        }
    }

    fn part(&self, total: f64) -> Part {
        let mean = self.first.map(|sum| sum / self.weight);
        let noise: [f64; WIDTH] = std::array::from_fn(noise);
        // Cholesky's factor L, then its inverse, both in place of the covariance.
        let mut lower = [0.0; TRIANGLE];
        for row in 0..WIDTH {
            for column in 0..=row {
                let mut rest = self.second[at(row, column)] / self.weight - mean[row] * mean[column];
                rest -= (0..column).map(|k| lower[at(row, k)] * lower[at(column, k)]).sum::<f64>();
                lower[at(row, column)] = if row == column {
                    // Rounding may take a variance below nothing, never below its noise.
                    (rest.max(0.0) + noise[row]).sqrt()
                } else {
                    rest / lower[at(column, column)]
                };
            }
        }
        let mut inverse = [0.0; TRIANGLE];
        for column in 0..WIDTH {
            for row in column..WIDTH {
                let done: f64 = (column..row).map(|k| lower[at(row, k)] * inverse[at(k, column)]).sum();
                let unit = if row == column { 1.0 } else { 0.0 };
                inverse[at(row, column)] = (unit - done) / lower[at(row, row)];
            }
        }
        let base = |rows: std::ops::Range<usize>| -> f64 {
            let row_base = |row: usize| {
                let trace: f64 =
                    (0..=row).map(|column| noise[column] * inverse[at(row, column)].powi(2)).sum();
                lower[at(row, row)].ln() + 0.5 * trace
            };
            rows.map(row_base).sum()
        };
        let bases = [base(0..PLACES) - (self.weight / total).ln(), base(PLACES..WIDTH)];
        let whitening = inverse.map(|value| (value * std::f64::consts::FRAC_1_SQRT_2) as f32);
        Part { mean: mean.map(|value| value as f32), whitening, bases: bases.map(|base| base as f32) }
    }
}

/// Variance added to a number of a sample.
fn noise(index: usize) -> f64 {
    if index < PLACES { (REACH * f64::from(PLACE)).powi(2) } else { COLOR_NOISE }
}

impl Part {
    /// What the sample's place costs, and its color there.
    fn costs(&self, sample: &Sample) -> [f32; 2] {
        let off: Sample = std::array::from_fn(|k| sample[k] - self.mean[k]);
        let mut costs = self.bases;
        for row in 0..WIDTH {
            let along: f32 = (0..=row).map(|column| self.whitening[at(row, column)] * off[column]).sum();
            costs[usize::from(row >= PLACES)] += along * along;
        }
        costs
    }
}

impl Mixture {
    /// The mixture of the samples for which `part_of` names a part and a weight; `None` when there are none.
    pub(super) fn fit(
        samples: &[Sample],
        part_of: impl Fn(usize) -> Option<(u8, f32)> + Sync,
    ) -> Option<Self> {
        let chunks: Vec<Vec<Sums>> = samples
            .par_chunks(CHUNK)
            .enumerate()
            .map(|(chunk, samples)| {
                let mut sums: Vec<Sums> = Vec::new();
                for (cell, sample) in (chunk * CHUNK..).zip(samples) {
                    if let Some((part, weight)) = part_of(cell) {
                        let part = usize::from(part);
                        if part >= sums.len() {
                            sums.resize(part + 1, Sums::default());
                        }
                        sums[part].add_sample(sample, weight);
                    }
                }
                sums
            })
            .collect();
        let mut sums: Vec<Sums> = Vec::new();
        for chunk in &chunks {
            if chunk.len() > sums.len() {
                sums.resize(chunk.len(), Sums::default());
            }
            sums.iter_mut().zip(chunk).for_each(|(sum, more)| sum.add(more));
        }
        let total: f64 = sums.iter().map(|sum| sum.weight).sum();
        let parts: Vec<_> = sums.iter().filter(|sum| sum.weight > 0.0).map(|sum| sum.part(total)).collect();
        (!parts.is_empty()).then_some(Self { parts })
    }

    /// A first mixture of at most `parts` parts, by k-means, of the samples to which `weight_of` gives a weight; `None`
    /// when there are none.
    pub(super) fn clustered(
        samples: &[Sample],
        parts: usize,
        seed: u64,
        weight_of: impl Fn(usize) -> f32 + Sync,
    ) -> Option<Self> {
        let members: Vec<usize> = (0..samples.len()).filter(|cell| weight_of(*cell) > 0.0).collect();
        let every = members.len().div_ceil(SAMPLE).max(1);
        let sample: Vec<_> =
            members.iter().step_by(every).map(|cell| (samples[*cell], weight_of(*cell))).collect();
        let centers = k_means(&sample, parts, seed);
        (!centers.is_empty()).then(|| {
            Self::fit(samples, |cell| {
                let weight = weight_of(cell);
                (weight > 0.0).then(|| (nearest(&centers, &samples[cell]).0 as u8, weight))
            })
        })?
    }

    /// The cheapest part of a sample, and what its color costs at its place.
    pub(super) fn cheapest(&self, sample: &Sample) -> (u8, f32) {
        let (mut best, mut cheapest_place) = ((0, f32::INFINITY), f32::INFINITY);
        for (part, [place, color]) in self.parts.iter().map(|part| part.costs(sample)).enumerate() {
            cheapest_place = cheapest_place.min(place);
            if place + color < best.1 {
                best = (part as u8, place + color);
            }
        }
        (best.0, best.1 - cheapest_place)
    }
}

/// The nearest center and its squared distance.
fn nearest(centers: &[Sample], sample: &Sample) -> (usize, f32) {
    let distances = centers.iter().map(|center| {
        let square = |k: usize| (center[k] - sample[k]) * (center[k] - sample[k]);
        square(0) + square(1) + square(2) + square(3) + square(4)
    });
    distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, f32::INFINITY))
}

/// Centers of at most `parts` clusters: begun far from each other (Arthur & Vassilvitskii 2007), then Lloyd's rounds.
fn k_means(samples: &[(Sample, f32)], parts: usize, seed: u64) -> Vec<Sample> {
    let mut random = Random::new(seed, 0);
    let mut centers: Vec<Sample> = Vec::new();
    for _ in 0..parts {
        let weight = |(sample, weight): &(Sample, f32)| {
            if centers.is_empty() { *weight } else { *weight * nearest(&centers, sample).1 }
        };
        let total: f32 = samples.iter().map(weight).sum();
        // Fewer samples than parts.
        if total <= 0.0 {
            break;
        }
        let mut left = random.unit() as f32 * total;
        let drawn = samples.iter().find(|sample| {
            left -= weight(sample);
            left < 0.0
        });
        let Some((center, _)) = drawn.or(samples.last()) else { break };
        let center = *center;
        centers.push(center);
    }
    for _ in 0..ROUNDS {
        let mut sums = vec![([0.0_f32; WIDTH], 0.0_f32); centers.len()];
        for (sample, weight) in samples {
            let (sum, count) = &mut sums[nearest(&centers, sample).0];
            sum.iter_mut().zip(sample).for_each(|(sum, value)| *sum += weight * value);
            *count += weight;
        }
        for (center, (sum, count)) in centers.iter_mut().zip(sums) {
            if count > 0.0 {
                *center = sum.map(|sum| sum / count);
            }
        }
    }
    centers
}

#[cfg(test)]
#[path = "mixture_tests.rs"]
mod tests;
