//! Soft masks that follow the picture's edges: a guided filter (He, Sun & Tang 2013).

use rayon::prelude::*;

use crate::depth::plane::box_sum;

/// Half side of the filter's boxes, pixels.
const RADIUS: usize = 3;
/// Variance of brightness, 0–1, below which nothing is an edge.
const EVEN: f32 = 3e-4;

/// A guide's own sums, which all masks of a picture share.
pub(super) struct Guide {
    width: usize,
    guide: Vec<f32>,
    count: Vec<f32>,
    mean: Vec<f32>,
    variance: Vec<f32>,
}

impl Guide {
    /// `guide` is the picture's brightness, 0–1.
    pub(super) fn of(width: usize, guide: Vec<f32>) -> Self {
        let sum = |values: &[f32]| box_sum(width, values, RADIUS, RADIUS);
        let count = sum(&vec![1.0; guide.len()]);
        let mean: Vec<f32> = sum(&guide).iter().zip(&count).map(|(sum, count)| sum / count).collect();
        let squares = sum(&guide.iter().map(|g| g * g).collect::<Vec<_>>());
        let variance =
            (0..guide.len()).map(|i| (squares[i] / count[i] - mean[i] * mean[i]).max(0.0)).collect();
        Self { width, guide, count, mean, variance }
    }

    /// A mask, 0–1, as a local line of the guide.
    pub(super) fn soften(&self, mask: &[f32]) -> Vec<f32> {
        let mean = |values: &[f32]| -> Vec<f32> {
            box_sum(self.width, values, RADIUS, RADIUS)
                .iter()
                .zip(&self.count)
                .map(|(sum, n)| sum / n)
                .collect()
        };
        let level = mean(mask);
        let product = mean(&mask.iter().zip(&self.guide).map(|(m, g)| m * g).collect::<Vec<_>>());
        let (slope, offset): (Vec<f32>, Vec<f32>) = (0..mask.len())
            .into_par_iter()
            .map(|i| {
                let slope = (product[i] - level[i] * self.mean[i]) / (self.variance[i] + EVEN);
                (slope, level[i] - slope * self.mean[i])
            })
            .unzip();
        let (slope, offset) = (mean(&slope), mean(&offset));
        (0..mask.len()).map(|i| (slope[i] * self.guide[i] + offset[i]).clamp(0.0, 1.0)).collect()
    }
}
