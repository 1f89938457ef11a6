//! Spreads sparse evidence over a picture: alike neighbors believe alike, edges of color stop it.
//!
//! The values minimize Σ c·(s − e)² + Σ w·(s − s′)² over all pixels with evidence e of weight c and all pairs of
//! neighbors s, s′, w falling with the difference of their colors (the energy of Levin, Lischinski and Weiss 2004),
//! found by successive over-relaxation in a fixed order: the number of cores does not matter.

use super::colors::Colors;

/// Evidence of one pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Evidence {
    /// −1 to 1.
    pub(super) value: f32,
    /// 0 or more; 1 outweighs one alike neighbor.
    pub(super) weight: f32,
}

/// Codes by which neighbors may differ and still believe each other.
const ALIKE: f32 = 9.0;
/// What an edge lets through.
const LEAK: f32 = 0.003;
const ROUNDS: usize = 160;
const OVER: f32 = 1.85;

/// Values −1 to 1, one for each pixel of `colors`.
pub(super) fn spread(colors: &Colors, evidence: &[Evidence]) -> Vec<f32> {
    let (width, height) = (colors.width, colors.height);
    let link = |a: usize, b: usize| {
        let off = (colors.values[a] - colors.values[b]).length_squared();
        (-off / (2.0 * ALIKE * ALIKE)).exp() + LEAK
    };
    let right: Vec<f32> =
        (0..width * height).map(|i| if i % width + 1 < width { link(i, i + 1) } else { 0.0 }).collect();
    let below: Vec<f32> = (0..width * height)
        .map(|i| if i + width < width * height { link(i, i + width) } else { 0.0 })
        .collect();
    let mut values: Vec<f32> = evidence.iter().map(|e| e.value * e.weight.min(1.0)).collect();
    let update = |values: &mut [f32], i: usize| {
        let Evidence { value, weight } = evidence[i];
        let (mut sum, mut total) = (value * weight, weight);
        let mut take = |link: f32, other: usize| {
            sum += link * values[other];
            total += link;
        };
        if !i.is_multiple_of(width) {
            take(right[i - 1], i - 1);
        }
        if i % width + 1 < width {
            take(right[i], i + 1);
        }
        if i >= width {
            take(below[i - width], i - width);
        }
        if i + width < width * height {
            take(below[i], i + width);
        }
        let next = sum / total.max(1e-6);
        values[i] = (values[i] + OVER * (next - values[i])).clamp(-1.0, 1.0);
    };
    for round in 0..ROUNDS {
        if round % 2 == 0 {
            (0..width * height).for_each(|i| update(&mut values, i));
        } else {
            (0..width * height).rev().for_each(|i| update(&mut values, i));
        }
    }
    values
}
