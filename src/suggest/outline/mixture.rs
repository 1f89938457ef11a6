//! Mixtures of Gaussians over color, with hard membership: `GrabCut`'s models of a side (Rother et al. 2004; notes §3.2).
//!
//! A color costs `−ln π + ½ ln det Σ + ½ (dᵀ Σ⁻¹ d + ε tr Σ⁻¹)`, minus log-likelihood but for a constant, of its
//! cheapest part; ε is the variance of a color's own noise. Fitted with `Σ = S + ε 1`, parts make the sum of their
//! members' costs exactly least, so that assigning and fitting in turn never raises it.

use glam::{DMat3, DVec3, Vec3};
use rayon::prelude::*;

/// Parts of a mixture.
pub(super) const PARTS: usize = 5;

/// Variance of a color's noise on a scale of 0–1: two sRGB codes.
const NOISE: f64 = (2.0 / 255.0) * (2.0 / 255.0);

/// Colors summed up in one go; fixed, so that sums do not depend on the number of cores.
const CHUNK: usize = 1 << 14;

/// Colors and rounds of the k-means that begins a mixture.
const SAMPLE: usize = 8192;
const ROUNDS: usize = 12;

/// A mixture of at most [`PARTS`] Gaussians.
#[derive(Clone, Debug)]
pub(super) struct Mixture {
    parts: Vec<Part>,
}

#[derive(Clone, Copy, Debug)]
struct Part {
    mean: Vec3,
    /// Upper triangle of ½ Σ⁻¹: xx, yy, zz, 2·xy, 2·xz, 2·yz.
    half_inverse: [f32; 6],
    /// What does not depend on the color.
    base: f32,
}

/// Sums over colors.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: f64,
    color: DVec3,
    /// xx, yy, zz, xy, xz, yz.
    square: [f64; 6],
}

impl Sums {
    fn add(&mut self, other: &Self) {
        self.count += other.count;
        self.color += other.color;
        for (sum, more) in self.square.iter_mut().zip(other.square) {
            *sum += more;
        }
    }

    fn add_color(&mut self, color: Vec3) {
        let c = color.as_dvec3();
        let square = [c.x * c.x, c.y * c.y, c.z * c.z, c.x * c.y, c.x * c.z, c.y * c.z];
        self.add(&Self { count: 1.0, color: c, square });
    }

    fn part(&self, total: f64) -> Part {
        let mean = self.color / self.count;
        let [xx, yy, zz, xy, xz, yz] = self.square.map(|sum| sum / self.count);
        let covariance = DMat3::from_cols(
            DVec3::new(xx - mean.x * mean.x, xy - mean.x * mean.y, xz - mean.x * mean.z),
            DVec3::new(xy - mean.x * mean.y, yy - mean.y * mean.y, yz - mean.y * mean.z),
            DVec3::new(xz - mean.x * mean.z, yz - mean.y * mean.z, zz - mean.z * mean.z),
        ) + DMat3::from_diagonal(DVec3::splat(NOISE));
        let inverse = covariance.inverse();
        let trace = inverse.x_axis.x + inverse.y_axis.y + inverse.z_axis.z;
        let half = [
            0.5 * inverse.x_axis.x,
            0.5 * inverse.y_axis.y,
            0.5 * inverse.z_axis.z,
            inverse.x_axis.y,
            inverse.x_axis.z,
            inverse.y_axis.z,
        ];
        let base = -(self.count / total).ln() + 0.5 * covariance.determinant().ln() + 0.5 * NOISE * trace;
        Part { mean: mean.as_vec3(), half_inverse: half.map(|value| value as f32), base: base as f32 }
    }
}

impl Part {
    fn cost(&self, color: Vec3) -> f32 {
        let d = color - self.mean;
        let [xx, yy, zz, xy, xz, yz] = self.half_inverse;
        self.base + d.x * (xx * d.x + xy * d.y + xz * d.z) + d.y * (yy * d.y + yz * d.z) + zz * d.z * d.z
    }
}

impl Mixture {
    /// The mixture of the colors for which `part_of` names a part, 0–4; `None` when there are none.
    pub(super) fn fit(colors: &[Vec3], part_of: impl Fn(usize) -> Option<u8> + Sync) -> Option<Self> {
        let chunks: Vec<[Sums; PARTS]> = colors
            .par_chunks(CHUNK)
            .enumerate()
            .map(|(chunk, colors)| {
                let mut sums = [Sums::default(); PARTS];
                for (cell, color) in (chunk * CHUNK..).zip(colors) {
                    if let Some(part) = part_of(cell) {
                        sums[usize::from(part)].add_color(*color);
                    }
                }
                sums
            })
            .collect();
        let mut sums = [Sums::default(); PARTS];
        for chunk in &chunks {
            sums.iter_mut().zip(chunk).for_each(|(sum, more)| sum.add(more));
        }
        let total: f64 = sums.iter().map(|sum| sum.count).sum();
        let parts: Vec<_> = sums.iter().filter(|sum| sum.count > 0.0).map(|sum| sum.part(total)).collect();
        (!parts.is_empty()).then_some(Self { parts })
    }

    /// A first mixture of the colors for which `is_member` holds, by k-means; `None` when there are none.
    pub(super) fn clustered(
        colors: &[Vec3],
        seed: u64,
        is_member: impl Fn(usize) -> bool + Sync,
    ) -> Option<Self> {
        let members: Vec<Vec3> =
            (0..colors.len()).filter(|cell| is_member(*cell)).map(|cell| colors[cell]).collect();
        let every = members.len().div_ceil(SAMPLE).max(1);
        let sample: Vec<Vec3> = members.iter().copied().step_by(every).collect();
        let centers = k_means(&sample, seed);
        (!centers.is_empty())
            .then(|| Self::fit(&members, |cell| Some(nearest(&centers, members[cell]).0 as u8)))?
    }

    /// The cheapest part of a color and its cost.
    pub(super) fn cheapest(&self, color: Vec3) -> (u8, f32) {
        let costs = self.parts.iter().map(|part| part.cost(color));
        let mut best = (0, f32::INFINITY);
        for (part, cost) in costs.enumerate() {
            if cost < best.1 {
                best = (part as u8, cost);
            }
        }
        best
    }
}

/// The nearest center and its squared distance.
fn nearest(centers: &[Vec3], color: Vec3) -> (usize, f32) {
    let distances = centers.iter().map(|center| center.distance_squared(color));
    distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, f32::INFINITY))
}

/// Centers of at most [`PARTS`] clusters: begun far from each other (Arthur & Vassilvitskii 2007), then Lloyd's rounds.
fn k_means(colors: &[Vec3], seed: u64) -> Vec<Vec3> {
    let mut state = seed;
    let mut centers: Vec<Vec3> = Vec::new();
    for _ in 0..PARTS {
        let weight = |color: &Vec3| if centers.is_empty() { 1.0 } else { nearest(&centers, *color).1 };
        let total: f32 = colors.iter().map(weight).sum();
        // Fewer colors than parts.
        if total <= 0.0 {
            break;
        }
        let mut left = splitmix(&mut state) * total;
        let drawn = colors.iter().find(|color| {
            left -= weight(color);
            left < 0.0
        });
        let Some(center) = drawn.or(colors.last()) else { break };
        let center = *center;
        centers.push(center);
    }
    for _ in 0..ROUNDS {
        let mut sums = vec![(Vec3::ZERO, 0.0_f32); centers.len()];
        for color in colors {
            let (sum, count) = &mut sums[nearest(&centers, *color).0];
            *sum += *color;
            *count += 1.0;
        }
        for (center, (sum, count)) in centers.iter_mut().zip(sums) {
            if count > 0.0 {
                *center = sum / count;
            }
        }
    }
    centers
}

/// A number from 0 to below 1 (splitmix64).
fn splitmix(state: &mut u64) -> f32 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut bits = *state;
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((bits ^ (bits >> 31)) >> 40) as f32 / (1_u32 << 24) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two clouds of 500 colors, around (0.2, 0.2, 0.2) and (0.8, 0.5, 0.2).
    fn clouds() -> Vec<Vec3> {
        let mut state = 7;
        let mut noise = || Vec3::from_array(std::array::from_fn(|_| 0.1 * (splitmix(&mut state) - 0.5)));
        let middles = [Vec3::splat(0.2), Vec3::new(0.8, 0.5, 0.2)];
        (0..1000).map(|i| middles[i % 2] + noise()).collect()
    }

    #[test]
    fn a_color_is_cheap_where_it_is_common() {
        let colors = clouds();
        let [first, second] =
            [0, 1].map(|side| Mixture::clustered(&colors, 1, |cell| cell % 2 == side).unwrap());
        for (i, color) in colors.iter().enumerate() {
            let [own, other] = if i % 2 == 0 { [&first, &second] } else { [&second, &first] };
            assert!(own.cheapest(*color).1 + 10.0 < other.cheapest(*color).1, "color {i}");
        }
    }

    #[test]
    fn assigning_and_fitting_in_turn_never_raises_the_cost() {
        let colors = clouds();
        let mut mixture = Mixture::clustered(&colors, 3, |_| true).unwrap();
        let cost = |mixture: &Mixture| colors.iter().map(|c| f64::from(mixture.cheapest(*c).1)).sum::<f64>();
        let mut last = cost(&mixture);
        for round in 0..10 {
            mixture = Mixture::fit(&colors, |cell| Some(mixture.cheapest(colors[cell]).0)).unwrap();
            let now = cost(&mixture);
            assert!(now <= last + 1e-2, "round {round}: {now} after {last}");
            last = now;
        }
    }

    #[test]
    fn one_color_is_no_singularity_and_none_is_no_mixture() {
        let mixture = Mixture::clustered(&[Vec3::splat(0.5); 40], 1, |_| true).unwrap();
        assert!(mixture.cheapest(Vec3::splat(0.5)).1.is_finite());
        assert!(mixture.cheapest(Vec3::splat(0.5)).1 + 100.0 < mixture.cheapest(Vec3::splat(0.6)).1);
        assert!(Mixture::clustered(&[Vec3::splat(0.5); 40], 1, |_| false).is_none());
    }
}
