//! Embedded ICC profiles: from a file's own color space to sRGB, relative colorimetric, at 16 bits.
//!
//! Colors that sRGB does not have are clipped, channel by channel.

use std::sync::Arc;

use moxcms::{ColorProfile, DataColorSpace, Layout, RenderingIntent, TransformExecutor, TransformOptions};

/// Red, green, blue and coverage, each 0–65535; gray pixels hold their value three times.
pub(super) type Rgba16 = [u16; 4];

/// The 8-bit code nearest to a 16-bit one.
pub(super) const fn code8(code16: u16) -> u8 {
    ((code16 as u32 + 128) / 257) as u8
}

/// Turns rows of pixels from a profile's color space to sRGB.
pub(super) struct ToSrgb {
    transform: Arc<dyn TransformExecutor<u16> + Send + Sync>,
    is_gray: bool,
}

impl ToSrgb {
    /// Reads a profile; `None` when it is sRGB, by whichever maker, and the codes are to be kept as they are.
    ///
    /// `is_gray` says whether the file holds gray values. Gray files with an RGB profile exist and are fine; the other
    /// way round is an error, as is a profile that cannot be read. The error says what is wrong with the profile.
    pub(super) fn new(icc: &[u8], is_gray: bool) -> Result<Option<Self>, String> {
        let profile = ColorProfile::new_from_slice(icc).map_err(|error| error.to_string())?;
        let layout = match profile.color_space {
            DataColorSpace::Rgb => Layout::Rgb,
            DataColorSpace::Gray if is_gray => Layout::Gray,
            other => {
                return Err(format!("it is for {other:?} values, which the file does not hold"));
            }
        };
        let options = TransformOptions {
            rendering_intent: RenderingIntent::RelativeColorimetric,
            prefer_fixed_point: false,
            ..TransformOptions::default()
        };
        let transform = profile
            .create_transform_16bit(layout, &ColorProfile::new_srgb(), Layout::Rgb, options)
            .map_err(|error| error.to_string())?;
        let converter = Self { transform, is_gray: layout == Layout::Gray };
        Ok((!converter.is_srgb()?).then_some(converter))
    }

    /// Converts pixels in place; their coverage stays.
    pub(super) fn convert(&self, pixels: &mut [Rgba16]) -> Result<(), String> {
        let from: Vec<u16> = if self.is_gray {
            pixels.iter().map(|pixel| pixel[0]).collect()
        } else {
            pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect()
        };
        let mut to = vec![0; pixels.len() * 3];
        self.transform.transform(&from, &mut to).map_err(|error| error.to_string())?;
        for (pixel, rgb) in pixels.iter_mut().zip(to.as_chunks::<3>().0) {
            pixel[..3].copy_from_slice(rgb);
        }
        Ok(())
    }

    /// Whether no color of a coarse lattice moves by more than one code. The profiles called sRGB differ by as much
    /// among themselves, and a file that is sRGB is to show its very codes.
    fn is_srgb(&self) -> Result<bool, String> {
        let pixel = |codes: [u16; 3]| [codes[0] * 257, codes[1] * 257, codes[2] * 257, u16::MAX];
        let before: Vec<Rgba16> = if self.is_gray {
            (0..=255).map(|code| pixel([code; 3])).collect()
        } else {
            let steps = || (0..=255).step_by(15);
            steps().flat_map(|r| steps().flat_map(move |g| steps().map(move |b| pixel([r, g, b])))).collect()
        };
        let mut after = before.clone();
        self.convert(&mut after)?;
        let codes = before.as_flattened().iter().zip(after.as_flattened());
        Ok(codes.into_iter().all(|(before, after)| code8(*before).abs_diff(code8(*after)) <= 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn converted(profile: &ColorProfile, is_gray: bool, codes: [u8; 3]) -> [u8; 3] {
        let to_srgb = ToSrgb::new(&profile.encode().unwrap(), is_gray).unwrap().unwrap();
        let [r, g, b] = codes.map(|code| u16::from(code) * 257);
        let mut pixels = [[r, g, b, 7]];
        to_srgb.convert(&mut pixels).unwrap();
        assert_eq!(pixels[0][3], 7, "coverage stays");
        [0, 1, 2].map(|i| code8(pixels[0][i]))
    }

    /// Display P3 and Adobe RGB to sRGB by their published primaries; both have sRGB's white point D65.
    fn by_hand(matrix: [[f64; 3]; 3], linear: impl Fn(f64) -> f64, codes: [u8; 3]) -> [f64; 3] {
        let light = codes.map(|code| linear(f64::from(code) / 255.0));
        matrix.map(|row| {
            let sum: f64 = (0..3).map(|i| row[i] * light[i]).sum();
            let sum = sum.clamp(0.0, 1.0);
            255.0 * if sum <= 0.003_130_8 { 12.92 * sum } else { 1.055 * sum.powf(1.0 / 2.4) - 0.055 }
        })
    }

    fn assert_near(found: [u8; 3], expected: [f64; 3]) {
        let worst = (0..3).map(|i| (f64::from(found[i]) - expected[i]).abs()).fold(0.0, f64::max);
        assert!(worst <= 1.0, "{found:?} instead of {expected:.2?}");
    }

    const COLORS: [[u8; 3]; 6] =
        [[128, 128, 128], [200, 120, 60], [60, 140, 90], [40, 80, 160], [250, 240, 20], [12, 10, 8]];

    #[test]
    fn display_p3_becomes_srgb() {
        const SRGB_FROM_P3: [[f64; 3]; 3] = [
            [1.224_940_18, -0.224_940_18, 0.0],
            [-0.042_056_95, 1.042_056_95, 0.0],
            [-0.019_637_55, -0.078_636_05, 1.098_273_60],
        ];
        let linear = |s: f64| {
            if s <= 0.040_45 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) }
        };
        let p3 = ColorProfile::new_display_p3();
        assert_eq!(converted(&p3, false, [255, 0, 0]), [255, 0, 0], "the reddest red is clipped");
        for codes in COLORS {
            assert_near(converted(&p3, false, codes), by_hand(SRGB_FROM_P3, linear, codes));
        }
    }

    #[test]
    fn adobe_rgb_becomes_srgb() {
        const SRGB_FROM_ADOBE: [[f64; 3]; 3] =
            [[1.398_283_84, -0.398_283_84, 0.0], [0.0, 1.0, 0.0], [0.0, -0.042_938_56, 1.042_938_56]];
        let adobe = ColorProfile::new_adobe_rgb();
        for codes in COLORS {
            assert_near(
                converted(&adobe, false, codes),
                by_hand(SRGB_FROM_ADOBE, |s| s.powf(563.0 / 256.0), codes),
            );
        }
    }

    #[test]
    fn a_gray_gamma_becomes_srgb() {
        let gamma = ColorProfile::new_gray_with_gamma(1.8);
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for code in [0, 20, 100, 180, 255] {
            assert_near(converted(&gamma, true, [code; 3]), by_hand(identity, |s| s.powf(1.8), [code; 3]));
        }
    }

    #[test]
    fn srgb_is_kept_and_wrong_profiles_are_told() {
        let new = |bytes: &[u8], is_gray| ToSrgb::new(bytes, is_gray).map(|converter| converter.is_some());
        assert_eq!(new(&ColorProfile::new_srgb().encode().unwrap(), false), Ok(false));
        assert!(new(b"no profile", false).is_err());
        assert!(
            new(&ColorProfile::new_gray_with_gamma(2.2).encode().unwrap(), false)
                .unwrap_err()
                .contains("Gray")
        );
    }
}
