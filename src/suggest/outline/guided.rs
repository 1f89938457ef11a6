//! From labels of cells to a mask of the picture's size that follows the picture (guided filter: He, Sun, Tang 2010;
//! notes §3.3).
//!
//! Along the border coverage is an affine function of color, fitted around each cell; between cells their functions
//! are blended. Away from the border coverage is the label.

use glam::{DMat3, DVec3, UVec2, Vec3};
use rayon::prelude::*;

use super::scaled::Scaled;
use crate::picture::{Mask, Picture};

/// Cells to each side over which a function is fitted: also how far from the border coverage may be soft.
const REACH: usize = 2;

/// Variance of color that means nothing, on a scale of 0–1.
const EPSILON: f64 = 4e-4;

/// How much steeper coverage rises than the fit, which blurs.
const STEEPER: f32 = 2.0;

/// Coverage as a function of color.
#[derive(Clone, Copy, Debug)]
struct Affine {
    slope: Vec3,
    base: f32,
}

/// The mask whose cells are labeled `inside`; nothing outside the block of `scaled`.
pub(super) fn upsampled(picture: &Picture, scaled: &Scaled, inside: &[bool]) -> Mask {
    let functions = functions(scaled, inside);
    let size = picture.size();
    let rect = scaled.rect;
    let mut coverage = vec![0; size.x as usize * size.y as usize];
    coverage
        .par_chunks_mut(size.x as usize)
        .zip(picture.pixels().par_chunks(size.x as usize))
        .enumerate()
        .for_each(|(y, (values, pixels))| {
            let y = y as u32;
            if y < rect.min.y || y >= rect.max.y {
                return;
            }
            for x in rect.min.x..rect.max.x {
                let color = Vec3::from(pixels[x as usize].map(f32::from)) / 255.0;
                let share = at(scaled, &functions, UVec2::new(x, y), color);
                let steep = (share - 0.5) * STEEPER + 0.5;
                values[x as usize] = (steep * 255.0).round() as u8;
            }
        });
    // One value for each pixel, as a mask needs.
    Mask::new(size, coverage).unwrap_or_else(|_| unreachable!("one value for each pixel of a picture"))
}

/// Coverage of a pixel: what the four nearest cells say, blended.
fn at(scaled: &Scaled, functions: &[Affine], pixel: UVec2, color: Vec3) -> f32 {
    let inside = (pixel - scaled.rect.min).as_vec2() + 0.5;
    let place = (inside / scaled.factor as f32 - 0.5).max(glam::Vec2::ZERO);
    let low = place.floor().as_uvec2();
    let [left, top] = [low.x as usize, low.y as usize].map(|index| index);
    let [left, top] = [left.min(scaled.width - 1), top.min(scaled.height - 1)];
    let [right, bottom] = [(left + 1).min(scaled.width - 1), (top + 1).min(scaled.height - 1)];
    let part = place.fract();
    let value = |x: usize, y: usize| {
        let function = functions[y * scaled.width + x];
        (function.slope.dot(color) + function.base).clamp(0.0, 1.0)
    };
    let row = |y: usize| value(left, y) * (1.0 - part.x) + value(right, y) * part.x;
    row(top) * (1.0 - part.y) + row(bottom) * part.y
}

/// One function a cell.
fn functions(scaled: &Scaled, inside: &[bool]) -> Vec<Affine> {
    let (width, height) = (scaled.width, scaled.height);
    let cells = 0..width * height;
    cells
        .into_par_iter()
        .map(|cell| {
            let (x, y) = (cell % width, cell / width);
            let rows = y.saturating_sub(REACH)..(y + REACH + 1).min(height);
            let columns = x.saturating_sub(REACH)..(x + REACH + 1).min(width);
            let near =
                || rows.clone().flat_map(|row| columns.clone().map(move |column| row * width + column));
            if near().all(|other| inside[other] == inside[cell]) {
                return Affine { slope: Vec3::ZERO, base: f32::from(u8::from(inside[cell])) };
            }
            let (mut count, mut sum, mut hits, mut both) = (0.0, DVec3::ZERO, 0.0, DVec3::ZERO);
            let mut square = DMat3::ZERO;
            for other in near() {
                let color = scaled.colors[other].as_dvec3();
                let hit = f64::from(u8::from(inside[other]));
                count += 1.0;
                sum += color;
                hits += hit;
                both += color * hit;
                square += DMat3::from_cols(color * color.x, color * color.y, color * color.z);
            }
            let (mean, share) = (sum / count, hits / count);
            let covariance = square * (1.0 / count)
                - DMat3::from_cols(mean * mean.x, mean * mean.y, mean * mean.z)
                + DMat3::from_diagonal(DVec3::splat(EPSILON));
            let slope = covariance.inverse() * (both / count - mean * share);
            Affine { slope: slope.as_vec3(), base: (share - slope.dot(mean)) as f32 }
        })
        .collect()
}
