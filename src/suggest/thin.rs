//! Thin things against the sky: twigs, masts, a spire's tip, which a small picture does not show.
//!
//! What is darker than all around it and narrower than a window stands out of the gray closing (the "black top hat"). It is no
//! sky where it hangs together with what is none; birds and the dark of clouds do not.

use rayon::prelude::*;

use super::gray::Gray;
use crate::picture::{Mask, Picture};

/// What is narrower than this share of the picture's height (each way from the middle) is thin.
const REACH: f64 = 0.012;
/// A thing is darker than the sky beside it by so many codes at least, and by so many times the sky's own unrest.
const LEAST: f32 = 12.0;
const UNREST: f32 = 4.0;

/// A mask of the sky without the thin things that hang together with what is none.
pub(super) fn without_thin(picture: &Picture, sky: Mask) -> Mask {
    let size = sky.size();
    let (width, height) = (size.x as usize, size.y as usize);
    let values = sky.values();
    // Nothing further below the sky has to be looked at than what it ends at.
    let last = values.chunks(width).rposition(|row| row.iter().any(|&value| value > 0)).unwrap_or(0);
    let rows = (last + 2).min(height);
    let reach = ((REACH * height as f64).round() as usize).max(2);
    let looked = (rows + 2 * reach).min(height);
    let mut gray = Gray::of(picture);
    gray.values.truncate(looked * width);
    gray.height = looked;
    let depth = top_hat(&gray, reach);
    let Some(unrest) =
        median(depth.iter().zip(values).filter(|(_, sky)| **sky > 200).map(|(depth, _)| *depth))
    else {
        return sky;
    };
    let least = LEAST.max(UNREST * unrest);
    let is_thin = |pixel: usize| values[pixel] >= 128 && depth[pixel] > 0.5 * least;
    let mut reached = vec![false; rows * width];
    let mut open: Vec<usize> = (0..rows * width).filter(|&pixel| values[pixel] < 128).collect();
    while let Some(pixel) = open.pop() {
        let (x, y) = (pixel % width, pixel / width);
        for row in y.saturating_sub(1)..(y + 2).min(rows) {
            for column in x.saturating_sub(1)..(x + 2).min(width) {
                let next = row * width + column;
                // Faint pixels are a thing's soft border; it goes on through dark ones.
                if !reached[next] && is_thin(next) {
                    reached[next] = true;
                    if depth[next] > least {
                        open.push(next);
                    }
                }
            }
        }
    }
    let mended = values.iter().enumerate().map(|(pixel, &value)| {
        if pixel >= reached.len() || !reached[pixel] {
            return value;
        }
        let covered = (depth[pixel] / least - 0.5).clamp(0.0, 1.0);
        (f32::from(value) * (1.0 - covered)).round() as u8
    });
    // As many as before.
    Mask::new(size, mended.collect()).unwrap_or(sky)
}

/// How much darker each pixel is than its closing by a square that reaches so far each way.
fn top_hat(gray: &Gray, reach: usize) -> Vec<f32> {
    let brightest = windowed(gray, reach, f32::max);
    let closed = windowed(&Gray { values: brightest, ..*gray }, reach, f32::min);
    closed.par_iter().zip(&gray.values).map(|(closed, value)| closed - value).collect()
}

/// The greatest or least value of the square around each pixel.
fn windowed(gray: &Gray, reach: usize, of: fn(f32, f32) -> f32) -> Vec<f32> {
    let Gray { width, height, ref values } = *gray;
    let mut across = vec![0.0; values.len()];
    across.par_chunks_mut(width).zip(values.par_chunks(width)).for_each(|(to, from)| {
        for (x, value) in to.iter_mut().enumerate() {
            let near = &from[x.saturating_sub(reach)..(x + reach + 1).min(width)];
            *value = near[1..].iter().fold(near[0], |a, &b| of(a, b));
        }
    });
    let mut both = vec![0.0; values.len()];
    both.par_chunks_mut(width).enumerate().for_each(|(y, to)| {
        let first = y.saturating_sub(reach);
        to.copy_from_slice(&across[first * width..][..width]);
        for row in first + 1..(y + reach + 1).min(height) {
            for (value, other) in to.iter_mut().zip(&across[row * width..][..width]) {
                *value = of(*value, *other);
            }
        }
    });
    both
}

/// The middle one; `None` of none.
fn median(values: impl Iterator<Item = f32>) -> Option<f32> {
    let mut values: Vec<f32> = values.collect();
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f32::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, UVec2};

    use super::*;
    use crate::suggest::tests::made::{noise, picture};

    const SIZE: UVec2 = UVec2::new(600, 400);

    /// A cloudy sky over a dark hill from row 250 on, with a mast of 5 pixels at x = 100, a twig of one pixel that slants from
    /// the hill at x = 300, and a bird at 450, 100.
    fn sky() -> (Picture, Mask) {
        let shown = picture(SIZE, |at| {
            let sky = 190.0 + 40.0 * noise(at, 60.0, 1) + 2.0 * noise(at, 1.5, 2);
            let twig =
                (at - DVec2::new(300.0, 250.0)).perp_dot(DVec2::new(1.0, -1.0).normalize()).abs() < 0.6;
            let is_dark = at.y > 250.0
                || at.y > 80.0 && (at.x - 100.0).abs() < 2.5
                || at.y > 150.0 && twig
                || (at - DVec2::new(450.0, 100.0)).abs().max_element() < 3.0;
            if is_dark { 60.0 } else { sky }
        });
        let mask = (0..SIZE.x * SIZE.y).map(|i| if i / SIZE.x < 250 { 255 } else { 0 });
        (shown, Mask::new(SIZE, mask.collect()).unwrap())
    }

    #[test]
    fn a_mast_and_a_twig_are_no_sky_and_a_bird_and_clouds_are() {
        let (shown, whole) = sky();
        let found = without_thin(&shown, whole.clone());
        assert!((82..250).all(|y| found.get(99, y) < 20 && found.get(108, y) == 255), "the mast");
        let twig = (152..248).filter(|&y| (0..3).any(|d| found.get(300 + 249 - y + d, y) < 90)).count();
        assert!(twig > 90, "{twig} of 96 rows of the twig");
        assert_eq!((found.get(450, 100), found.get(500, 200), found.get(10, 240)), (255, 255, 255));
        let changed = found.values().iter().zip(whole.values()).filter(|(a, b)| a != b).count();
        assert!(changed < 170 * 6 + 100 * 4 + 200, "{changed} pixels changed");
    }

    #[test]
    fn a_picture_without_sky_stays() {
        let (shown, _) = sky();
        let none = Mask::new(SIZE, vec![0; (SIZE.x * SIZE.y) as usize]).unwrap();
        assert_eq!(without_thin(&shown, none.clone()), none);
        let all = Mask::new(SIZE, vec![255; (SIZE.x * SIZE.y) as usize]).unwrap();
        assert_eq!(without_thin(&shown, all.clone()), all, "nothing is there to hang together with");
    }
}
