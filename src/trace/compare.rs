//! How alike two pictures are: PSNR, SSIM and differences of codes.
//!
//! Everything is measured on 8-bit sRGB codes. SSIM is that of Wang et al. 2004 on luma, with windows at every pixel;
//! beyond the frame the picture is continued by its mirror image, edge pixels repeated.

use glam::UVec2;
use rayon::prelude::*;

use crate::picture::{Mask, Picture};

/// Coverage from which on a pixel is counted by [`Comparison::over`]: above one half.
const COUNTED: u8 = 128;

/// Pictures or masks that cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// The sizes differ.
    #[error("a picture of {} x {} pixels cannot be compared with one of {} x {}; render both at one size", first.x, first.y, second.x, second.y)]
    SizesDiffer {
        /// Size of the first picture.
        first: UVec2,
        /// Size of the second picture, or of the mask.
        second: UVec2,
    },
    /// The mask covers no pixel by more than half, so there is no figure.
    #[error("the mask covers no pixel by more than half, so there is nothing to compare")]
    NothingCounted,
}

/// The figures of one comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// How many pixels were counted.
    pub pixels: u64,
    /// Peak signal-to-noise ratio in dB, all three channels together; infinite when nothing differs.
    pub psnr: f64,
    /// Mean structural similarity, 1 when nothing differs.
    pub ssim: f64,
    /// The largest difference of any channel, in codes.
    pub max_code_difference: u8,
    /// The mean absolute difference over all channels, in codes.
    pub mean_difference: f64,
    /// How many pixels have each difference of their worst channel.
    worst: [u64; 256],
}

impl Comparison {
    /// Compares all pixels.
    ///
    /// # Errors
    ///
    /// [`CompareError::SizesDiffer`].
    pub fn of(first: &Picture, second: &Picture) -> Result<Self, CompareError> {
        Self::compare(first, second, |_| true)
    }

    /// Compares the pixels that `mask` covers by more than half. SSIM windows look beyond the mask's edge.
    ///
    /// # Errors
    ///
    /// [`CompareError::SizesDiffer`], also for the mask, and [`CompareError::NothingCounted`].
    pub fn over(first: &Picture, second: &Picture, mask: &Mask) -> Result<Self, CompareError> {
        check_sizes(first.size(), mask.size())?;
        Self::compare(first, second, |i| mask.values()[i] >= COUNTED)
    }

    /// The share of pixels, 0–1, whose worst channel differs by at most `codes`.
    #[must_use]
    pub fn share_within(&self, codes: u8) -> f64 {
        self.worst[..=usize::from(codes)].iter().sum::<u64>() as f64 / self.pixels as f64
    }

    fn compare(
        first: &Picture,
        second: &Picture,
        counts: impl Fn(usize) -> bool,
    ) -> Result<Self, CompareError> {
        check_sizes(first.size(), second.size())?;
        let ssim_map = ssim_map(first, second);
        let mut worst = [0; 256];
        let (mut sum, mut squares, mut ssim) = (0_u64, 0_u64, 0.0);
        let pairs = first.pixels().iter().zip(second.pixels()).zip(ssim_map).enumerate();
        for (_, ((a, b), similarity)) in pairs.filter(|(i, _)| counts(*i)) {
            let differences = [0, 1, 2].map(|channel| a[channel].abs_diff(b[channel]));
            let [r, g, b] = differences.map(u64::from);
            sum += r + g + b;
            squares += r * r + g * g + b * b;
            ssim += similarity;
            worst[r.max(g).max(b) as usize] += 1;
        }
        let pixels: u64 = worst.iter().sum();
        if pixels == 0 {
            return Err(CompareError::NothingCounted);
        }
        let values = 3.0 * pixels as f64;
        Ok(Self {
            pixels,
            psnr: 10.0 * (255.0 * 255.0 * values / squares as f64).log10(),
            ssim: ssim / pixels as f64,
            max_code_difference: worst.iter().rposition(|count| *count > 0).unwrap_or(0) as u8,
            mean_difference: sum as f64 / values,
            worst,
        })
    }
}

fn check_sizes(first: UVec2, second: UVec2) -> Result<(), CompareError> {
    if first == second { Ok(()) } else { Err(CompareError::SizesDiffer { first, second }) }
}

/// Taps to either side of the middle one: windows of 11 × 11.
const REACH: usize = 5;
/// Standard deviation of the Gaussian window, in pixels.
const SIGMA: f64 = 1.5;
/// (0.01 · 255)² and (0.03 · 255)², which keep flat and dark windows from dividing by zero.
const C1: f64 = 6.502_5;
const C2: f64 = 58.522_5;

/// Weighted sums over a window: both lumas, their squares, their product.
type Moments = [f64; 5];

/// SSIM of the window around each pixel.
fn ssim_map(first: &Picture, second: &Picture) -> Vec<f64> {
    let width = first.size().x as usize;
    let height = first.size().y as usize;
    let weights = gaussian();
    let pairs = first.pixels().par_iter().zip(second.pixels());
    let moments: Vec<[f64; 2]> = pairs.map(|(a, b)| [luma(*a), luma(*b)]).collect();

    let mut map = vec![0.0; moments.len()];
    map.par_chunks_mut(width).enumerate().for_each_init(
        || vec![Moments::default(); width],
        |columns, (y, out)| {
            // Down the columns first, then along the row of sums: the window is separable.
            columns.fill(Moments::default());
            for (tap, weight) in weights.iter().enumerate() {
                let row = &moments[mirrored(y + tap, height) * width..][..width];
                for (sums, [a, b]) in columns.iter_mut().zip(row) {
                    add(sums, *weight, &[*a, *b, a * a, b * b, a * b]);
                }
            }
            for (x, out) in out.iter_mut().enumerate() {
                let mut sums = Moments::default();
                for (tap, weight) in weights.iter().enumerate() {
                    add(&mut sums, *weight, &columns[mirrored(x + tap, width)]);
                }
                *out = similarity(sums);
            }
        },
    );
    map
}

fn add(sums: &mut Moments, weight: f64, values: &Moments) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += weight * value;
    }
}

/// SSIM of one window from its moments.
fn similarity([a, b, aa, bb, ab]: Moments) -> f64 {
    let (variance_a, variance_b, covariance) = (aa - a * a, bb - b * b, ab - a * b);
    ((2.0 * a * b + C1) * (2.0 * covariance + C2)) / ((a * a + b * b + C1) * (variance_a + variance_b + C2))
}

/// Rec. 601 luma of codes, 0–255, as in the reference implementation.
fn luma([r, g, b]: [u8; 3]) -> f64 {
    0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b)
}

/// Weights of a window's row, 1 in all.
fn gaussian() -> [f64; 2 * REACH + 1] {
    let weights = std::array::from_fn(|tap| {
        let distance = (tap as f64 - REACH as f64) / SIGMA;
        (-0.5 * distance * distance).exp()
    });
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

/// Where tap `padded` of a line lies that was continued by [`REACH`] values on either side: … c b a | a b c … .
fn mirrored(padded: usize, length: usize) -> usize {
    // One period is the line and its mirror image; a line shorter than the reach is crossed several times.
    let at = (padded as isize - REACH as isize).rem_euclid(2 * length as isize) as usize;
    at.min(2 * length - 1 - at)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of smooth waves, changed by `change` codes of noise that looks random but is not.
    fn waves(size: UVec2, change: u32) -> Picture {
        let pixel = |i: u32| {
            let (x, y) = ((i % size.x) as f32, (i / size.x) as f32);
            [0, 1, 2].map(|channel| {
                let noise = (i * 3 + channel).wrapping_mul(2_654_435_761) >> 16;
                let wave = 120.0 + 60.0 * (0.3 * x + 0.2 * y + channel as f32).sin();
                wave as u8 + (noise % (change + 1)) as u8
            })
        };
        Picture::new(size, (0..size.x * size.y).map(pixel).collect()).unwrap()
    }

    /// The definition, one window at a time in two dimensions.
    fn naive_ssim(first: &Picture, second: &Picture) -> f64 {
        let (width, height) = (first.size().x as i64, first.size().y as i64);
        let mirror = |at: i64, length: i64| {
            if at < 0 {
                -1 - at
            } else if at >= length {
                2 * length - 1 - at
            } else {
                at
            }
        };
        let mut total = 0.0;
        for y in 0..height {
            for x in 0..width {
                let (mut weight_sum, mut window) = (0.0, Vec::new());
                for dy in -5..=5_i64 {
                    for dx in -5..=5_i64 {
                        let weight = (-((dx * dx + dy * dy) as f64) / (2.0 * 1.5 * 1.5)).exp();
                        let at = (mirror(x + dx, width) as u32, mirror(y + dy, height) as u32);
                        let gray = |picture: &Picture| {
                            let [r, g, b] = picture.pixel(at.0, at.1).map(f64::from);
                            0.299 * r + 0.587 * g + 0.114 * b
                        };
                        weight_sum += weight;
                        window.push((weight, gray(first), gray(second)));
                    }
                }
                let mean = |value: &dyn Fn(f64, f64) -> f64| {
                    window.iter().map(|(weight, a, b)| weight * value(*a, *b)).sum::<f64>() / weight_sum
                };
                let (ma, mb) = (mean(&|a, _| a), mean(&|_, b| b));
                let va = mean(&|a, _| (a - ma).powi(2));
                let vb = mean(&|_, b| (b - mb).powi(2));
                let cov = mean(&|a, b| (a - ma) * (b - mb));
                let (c1, c2) = ((0.01_f64 * 255.0).powi(2), (0.03_f64 * 255.0).powi(2));
                total +=
                    (2.0 * ma * mb + c1) * (2.0 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
            }
        }
        total / (width * height) as f64
    }

    #[test]
    fn a_picture_is_itself() {
        let picture = waves(UVec2::new(31, 17), 9);
        let same = Comparison::of(&picture, &picture).unwrap();
        assert_eq!(same.psnr, f64::INFINITY);
        assert!((same.ssim - 1.0).abs() < 1e-12, "{}", same.ssim);
        assert_eq!((same.max_code_difference, same.mean_difference, same.pixels), (0, 0.0, 31 * 17));
        assert_eq!(same.share_within(0), 1.0);
    }

    #[test]
    fn known_differences_have_known_figures() {
        let size = UVec2::new(4, 2);
        let black = Picture::new(size, vec![[0; 3]; 8]).unwrap();
        let mut pixels = vec![[0; 3]; 8];
        (pixels[1], pixels[6]) = ([3, 0, 0], [0, 4, 5]);
        let found = Comparison::of(&black, &Picture::new(size, pixels).unwrap()).unwrap();
        // Squares 9 + 16 + 25 = 50 over 24 values.
        let psnr = 10.0 * (65_025.0 / (50.0 / 24.0_f64)).log10();
        assert!((found.psnr - psnr).abs() < 1e-9, "{} dB instead of {psnr} dB", found.psnr);
        assert_eq!(found.max_code_difference, 5);
        assert_eq!(found.mean_difference, 0.5);
        assert_eq!([0, 3, 4, 5].map(|codes| found.share_within(codes)), [0.75, 0.875, 0.875, 1.0]);
    }

    #[test]
    fn ssim_is_as_defined() {
        // The second size is smaller than a window, yet no side is mirrored twice.
        for size in [UVec2::new(40, 29), UVec2::new(6, 5)] {
            let (clean, noisy) = (waves(size, 0), waves(size, 40));
            let (found, expected) =
                (Comparison::of(&clean, &noisy).unwrap().ssim, naive_ssim(&clean, &noisy));
            assert!((found - expected).abs() < 1e-9, "{found} instead of {expected} at {size}");
            assert!(expected < 0.95, "the noise shows: {expected}");
        }
    }

    #[test]
    fn a_picture_of_one_pixel_has_an_ssim() {
        let gray = |code| Picture::new(UVec2::ONE, vec![[code; 3]]).unwrap();
        let (a, b) = (100.0, 110.0);
        let expected = (2.0 * a * b + C1) / (a * a + b * b + C1);
        let found = Comparison::of(&gray(100), &gray(110)).unwrap().ssim;
        assert!((found - expected).abs() < 1e-9, "{found} instead of {expected}");
    }

    #[test]
    fn only_pixels_covered_by_more_than_half_count() {
        let size = UVec2::new(3, 1);
        let first = Picture::new(size, vec![[10; 3], [10; 3], [10; 3]]).unwrap();
        let second = Picture::new(size, vec![[11; 3], [30; 3], [90; 3]]).unwrap();
        let mask = |values: [u8; 3]| Mask::new(size, values.to_vec()).unwrap();
        let found = Comparison::over(&first, &second, &mask([255, 128, 127])).unwrap();
        assert_eq!((found.pixels, found.max_code_difference, found.mean_difference), (2, 20, 10.5));
        let all = Comparison::over(&first, &second, &mask([255; 3])).unwrap();
        assert_eq!(all, Comparison::of(&first, &second).unwrap());
        assert_eq!(Comparison::over(&first, &second, &mask([127; 3])), Err(CompareError::NothingCounted));
    }

    #[test]
    fn sizes_must_agree() {
        let error = Comparison::of(&waves(UVec2::new(4, 3), 0), &waves(UVec2::new(3, 4), 0)).unwrap_err();
        assert!(error.to_string().contains("4 x 3 pixels cannot be compared with one of 3 x 4"), "{error}");
    }
}
