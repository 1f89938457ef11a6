//! What a live-wire's link from pixel to pixel costs (Mortensen & Barrett 1995; notes §3.1).
//!
//! `0.43 f_Z + 0.43 f_D + 0.14 f_G`: off the crest of an edge, across the edge's direction, over weak contrast. Each
//! end of a link pays half, and edges have no sense of direction, so a link costs the same both ways. A link costs
//! 1–255.

use std::f32::consts::PI;

use glam::{DVec2, Vec3};
use rayon::prelude::*;

/// Shares of the three terms: crest, direction, contrast.
const CREST: f32 = 0.43;
const DIRECTION: f32 = 0.43;
const CONTRAST: f32 = 0.14;

/// What a straight link costs at most, over what its length alone costs; a diagonal one, √2 times that, stays in a byte.
const RANGE: f32 = 178.0;

/// Steps of the contrast and of the edge's direction.
const CONTRASTS: usize = 64;
const ANGLES: usize = 32;

/// Gradients below this are noise and have no crest, sRGB codes a pixel.
const NOISE: f32 = 1.5;

/// Share of pixels whose gradient counts as full contrast: the strongest edge of a picture says little of the others.
const FULL: f64 = 0.005;

/// Steps to the eight neighbors; each is followed or preceded by its opposite.
pub(super) const STEPS: [[i32; 2]; 8] =
    [[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [-1, -1], [-1, 1], [1, -1]];

/// What `f_Z` costs by how near the crest is: none within half a pixel, within 0.5, 0.35, 0.2 pixels of the center.
const OFF_CREST: [f32; 4] = [1.0, 0.6, 0.25, 0.0];

/// What a pixel's surroundings look like: nearness of the crest 0–3 (high bits) with contrast 0–63; the edge's direction in
/// 32nds of a half turn; how far off the crest is, in 128ths of a pixel along the edge's normal, from 128 on.
pub(super) type Feature = [u8; 3];

/// Where a pixel's crest is, from its center, pixels; zero without one.
pub(super) fn crest_offset([place, angle, offset]: Feature) -> DVec2 {
    let normal = DVec2::from_angle(f64::from(angle) / ANGLES as f64 * std::f64::consts::PI).perp();
    if place < 64 { DVec2::ZERO } else { normal * (f64::from(offset) - 128.0) / 128.0 }
}

/// Features of a picture of `width` pixels to a row.
pub(super) fn features(width: usize, pixels: &[[u8; 3]]) -> Vec<Feature> {
    let smooth = smoothed(width, pixels);
    let height = smooth.len() / width;
    let mut gradients = vec![[0.0_f32; 2]; smooth.len()];
    gradients.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        let [up, down] = [y.saturating_sub(1), (y + 1).min(height - 1)];
        for (x, gradient) in row.iter_mut().enumerate() {
            let [left, right] = [x.saturating_sub(1), (x + 1).min(width - 1)];
            let dx = (smooth[y * width + right] - smooth[y * width + left]) * 0.5;
            let dy = (smooth[down * width + x] - smooth[up * width + x]) * 0.5;
            // The channel that changes most: an edge between colors of one brightness is an edge.
            let squares = dx * dx + dy * dy;
            let channel = (0..3).max_by(|a, b| squares[*a].total_cmp(&squares[*b])).unwrap_or(0);
            *gradient = [dx[channel], dy[channel]];
        }
    });
    let lengths: Vec<f32> = gradients.par_iter().map(|[dx, dy]| dx.hypot(*dy)).collect();
    let full = full_contrast(&lengths);
    let mut features = vec![[0; 3]; smooth.len()];
    features.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        for (x, feature) in row.iter_mut().enumerate() {
            let here = y * width + x;
            let length = lengths[here];
            let [dx, dy] = gradients[here];
            let contrast = ((length / full).min(1.0) * (CONTRASTS - 1) as f32).round() as u8;
            let (crest, offset) = if length > NOISE {
                crest(&lengths, width, [x, y], [dx / length, dy / length])
            } else {
                (0, 0.0)
            };
            // The edge runs at right angles to the gradient.
            let turn = (-dx).atan2(dy) / PI;
            let bin = ((turn - turn.floor()) * ANGLES as f32).round() as usize;
            // An edge has no sense of direction, its normal has: each half turn taken off reverses it.
            let is_reversed = (turn.floor() != 0.0) != (bin == ANGLES);
            let angle = bin % ANGLES;
            let along_normal = if is_reversed { -offset } else { offset };
            *feature = [contrast | (crest << 6), angle as u8, (128.0 + 127.0 * along_normal).round() as u8];
        }
    });
    features
}

/// The picture smoothed by [1 4 6 4 1]/16 in both directions, sRGB codes.
fn smoothed(width: usize, pixels: &[[u8; 3]]) -> Vec<Vec3> {
    const WEIGHTS: [f32; 5] = [1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0];
    let height = pixels.len() / width;
    let mut smooth = vec![Vec3::ZERO; pixels.len()];
    smooth.par_chunks_mut(width).enumerate().for_each_init(Vec::new, |column_sums, (y, row)| {
        column_sums.clear();
        column_sums.resize(width + 4, Vec3::ZERO);
        for (weight, tap) in WEIGHTS.into_iter().zip(0_usize..) {
            let from = (y + tap).saturating_sub(2).min(height - 1);
            let source = &pixels[from * width..][..width];
            for (sum, pixel) in column_sums[2..].iter_mut().zip(source) {
                *sum += weight * Vec3::from(pixel.map(f32::from));
            }
        }
        let [first, last] = [column_sums[2], column_sums[width + 1]];
        column_sums[..2].fill(first);
        column_sums[width + 2..].fill(last);
        for (x, value) in row.iter_mut().enumerate() {
            *value = (0..5).map(|tap| WEIGHTS[tap] * column_sums[x + tap]).sum();
        }
    });
    smooth
}

/// The gradient that counts as full contrast.
fn full_contrast(lengths: &[f32]) -> f32 {
    let mut counts = [0_usize; 1024];
    for length in lengths {
        counts[((length * 4.0) as usize).min(1023)] += 1;
    }
    let most = (lengths.len() as f64 * FULL) as usize;
    let mut above = 0;
    let bin = (0..1024).rev().find(|bin| {
        above += counts[*bin];
        above > most
    });
    (bin.unwrap_or(0) as f32 / 4.0).max(4.0 * NOISE)
}

/// How near a pixel's center is to where the gradient is longest along its own direction (there the second derivative
/// crosses zero), 0–3, and how far along the gradient that is, pixels.
fn crest(lengths: &[f32], width: usize, [x, y]: [usize; 2], along: [f32; 2]) -> (u8, f32) {
    let height = lengths.len() / width;
    let at = |x: f32, y: f32| {
        let [x, y] = [x.clamp(0.0, (width - 1) as f32), y.clamp(0.0, (height - 1) as f32)];
        let [i, j] = [x as usize, y as usize];
        let [right, down] = [(i + 1).min(width - 1), (j + 1).min(height - 1)];
        let [px, py] = [x.fract(), y.fract()];
        let row = |j: usize| lengths[j * width + i] * (1.0 - px) + lengths[j * width + right] * px;
        row(j) * (1.0 - py) + row(down) * py
    };
    let here = lengths[y * width + x];
    let [x, y] = [x as f32, y as f32];
    let [before, after] = [at(x - along[0], y - along[1]), at(x + along[0], y + along[1])];
    let bend = 2.0 * here - before - after;
    // The top of the parabola through the three. An edge between two pixels has its crest in both.
    let offset = 0.5 * (after - before) / bend;
    match offset.abs() {
        off if bend <= 0.0 || off > 0.5001 => (0, 0.0),
        off if off > 0.35 => (1, offset),
        off if off > 0.2 => (2, offset),
        _ => (3, offset),
    }
}

/// The picture at half size, and its pixels in a row.
pub(super) fn halved(width: usize, pixels: &[[u8; 3]]) -> (usize, Vec<[u8; 3]>) {
    let height = pixels.len() / width;
    let half = width.div_ceil(2);
    let mut smaller = vec![[0; 3]; half * height.div_ceil(2)];
    smaller.par_chunks_mut(half).enumerate().for_each(|(y, row)| {
        let rows = [2 * y, (2 * y + 1).min(height - 1)].map(|y| &pixels[y * width..][..width]);
        for (x, pixel) in row.iter_mut().enumerate() {
            let columns = [2 * x, (2 * x + 1).min(width - 1)];
            *pixel = std::array::from_fn(|channel| {
                let sum: u16 = rows.iter().flat_map(|row| columns.map(|x| u16::from(row[x][channel]))).sum();
                ((sum + 2) / 4) as u8
            });
        }
    });
    (half, smaller)
}

/// What features cost, as tables: half a link each.
#[derive(Clone, Debug)]
pub(super) struct Prices {
    /// Crest and contrast, by a feature's first byte.
    place: [u16; 256],
    /// Edge's direction against the link's.
    turn: [[u16; 8]; ANGLES],
}

impl Prices {
    /// Prices by which the strongest contrast is the cheapest.
    pub(super) fn plain() -> Self {
        Self::with_contrast(|contrast| 1.0 - contrast)
    }

    /// Prices by which contrasts are the cheaper the more often `seen` has them, half and half with the plain ones.
    pub(super) fn trained(seen: &[Feature]) -> Self {
        let mut counts = [0.0_f32; CONTRASTS];
        for feature in seen {
            // A contrast speaks for those near it.
            let middle = i32::from(feature[0] & 63);
            for off in -4..=4 {
                if let Some(count) = counts.get_mut((middle + off) as usize) {
                    *count += 1.0 - off.abs() as f32 / 5.0;
                }
            }
        }
        let most = counts.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
        Self::with_contrast(|contrast| {
            let usual = counts[(contrast * (CONTRASTS - 1) as f32).round() as usize] / most;
            0.5 * (1.0 - contrast) + 0.5 * (1.0 - usual)
        })
    }

    fn with_contrast(price: impl Fn(f32) -> f32) -> Self {
        let half = |share: f32| (share * RANGE * 0.5).round() as u16;
        Self {
            place: std::array::from_fn(|feature| {
                let contrast = (feature & 63) as f32 / (CONTRASTS - 1) as f32;
                half(CREST * OFF_CREST[feature >> 6] + CONTRAST * price(contrast).clamp(0.0, 1.0))
            }),
            turn: std::array::from_fn(|angle| {
                let edge = angle as f32 / ANGLES as f32 * PI;
                STEPS.map(|[dx, dy]| {
                    let off = ((dy as f32).atan2(dx as f32) - edge).rem_euclid(PI);
                    half(DIRECTION * off.min(PI - off) / (PI / 2.0))
                })
            }),
        }
    }

    /// Cost of the link from `a` along step `step` to `b`, 1–255; the same from `b` back to `a`.
    pub(super) fn link(&self, a: Feature, b: Feature, step: usize) -> u8 {
        let half =
            |[place, angle, _]: Feature| self.place[usize::from(place)] + self.turn[usize::from(angle)][step];
        let straight = 1 + half(a) + half(b);
        // 181/128 is √2.
        (if step < 4 { straight } else { (straight * 181 + 64) >> 7 }).min(255) as u8
    }
}
