//! sRGB codes and linear light.
//!
//! Pictures and files hold sRGB codes, arithmetic on light happens in linear values; 0 is black and 1 is white in both
//! float forms. Code to linear and back is the identity for all 256 codes.

use std::sync::LazyLock;

/// Linear light of an sRGB value; both 0–1. Values above 1 follow the same curve, negative ones its straight foot.
#[must_use]
pub fn linear_from_srgb_f32(srgb: f32) -> f32 {
    linear_from_srgb_f64(f64::from(srgb)) as f32
}

/// sRGB value of linear light; both 0–1. Values above 1 follow the same curve, negative ones its straight foot.
#[must_use]
pub fn srgb_from_linear_f32(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Linear light, 0–1, of an sRGB code.
#[must_use]
pub fn linear_from_srgb(code: u8) -> f32 {
    TABLES.linear[usize::from(code)]
}

/// The sRGB code nearest to linear light, as seen on the sRGB scale. Below 0 and NaN give 0, above 1 gives 255.
#[must_use]
pub fn srgb_from_linear(linear: f32) -> u8 {
    // `as` saturates and takes NaN to 0, so the index is always good.
    let code = TABLES.first_code[((linear * BINS as f32) as usize).min(BINS)];
    // No bin is wide enough for two steps, so one comparison finishes the rounding.
    code + u8::from(linear >= TABLES.step_up[usize::from(code)])
}

/// Linear light, 0–1, of three sRGB codes.
#[must_use]
pub fn linear_from_srgb3(codes: [u8; 3]) -> [f32; 3] {
    codes.map(linear_from_srgb)
}

/// The nearest sRGB codes of three linear values, as [`srgb_from_linear`] rounds.
#[must_use]
pub fn srgb_from_linear3(linear: [f32; 3]) -> [u8; 3] {
    linear.map(srgb_from_linear)
}

/// Bins of linear light. The curve rises by at most 12.92 · 255 codes for all of 0–1, so a bin of 1/4096 spans at
/// most 0.81 codes.
const BINS: usize = 4096;

struct Tables {
    /// Linear light of each code.
    linear: [f32; 256],
    /// The least linear value that rounds to the code above this one; NaN for 255, which nothing reaches.
    step_up: [f32; 256],
    /// The code that the lower end of each bin rounds to.
    first_code: Vec<u8>,
}

static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let linear_of = |code: f64| linear_from_srgb_f64(code / 255.0) as f32;
    let linear = std::array::from_fn(|code| linear_of(code as f64));
    let step_up =
        std::array::from_fn(|code| if code < 255 { linear_of(code as f64 + 0.5) } else { f32::NAN });
    let first_code = (0..=BINS).map(|bin| {
        let low = bin as f32 / BINS as f32;
        step_up.partition_point(|step| *step <= low) as u8
    });
    Tables { linear, step_up, first_code: first_code.collect() }
});

fn linear_from_srgb_f64(srgb: f64) -> f64 {
    if srgb <= 0.040_45 { srgb / 12.92 } else { ((srgb + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_survives_the_round_trip() {
        for code in 0..=255 {
            assert_eq!(srgb_from_linear(linear_from_srgb(code)), code);
        }
    }

    #[test]
    fn codes_are_rounded_as_the_formula_rounds() {
        for i in -1_000..1_001_000 {
            let linear = i as f32 * 1e-6;
            let exact = f64::from(linear).clamp(0.0, 1.0);
            let srgb =
                if exact <= 0.003_130_8 { exact * 12.92 } else { 1.055 * exact.powf(1.0 / 2.4) - 0.055 };
            let code = srgb_from_linear(linear);
            let off = (srgb * 255.0 - f64::from(code)).abs();
            assert!(off < 0.500_1, "{linear} became {code}, {off} codes off");
        }
    }

    #[test]
    fn values_without_a_code_are_clamped() {
        assert_eq!([-1.0, f32::NAN, 1.5, f32::INFINITY].map(srgb_from_linear), [0, 0, 255, 255]);
    }

    #[test]
    fn float_forms_are_inverse_and_known() {
        // Code 188 is the middle gray of light, near 0.5.
        assert!((linear_from_srgb_f32(188.0 / 255.0) - 0.502_886).abs() < 1e-5);
        for i in 0..=1000 {
            let linear = i as f32 / 1000.0;
            let back = linear_from_srgb_f32(srgb_from_linear_f32(linear));
            assert!((back - linear).abs() < 1e-5, "{linear} became {back}");
        }
    }
}
