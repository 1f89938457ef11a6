//! Alpha lift: layers over each other are the picture again, whatever the mask's quality (notes §3.4).
//!
//! A layer's coverage is raised no further than its color needs to stay a color; blending is in linear light, storage
//! in 8-bit sRGB with straight coverage.

use crate::picture::color::linear_from_srgb;
use crate::picture::color::srgb_from_linear;
use crate::picture::color::srgb_from_linear_f32;

/// Lays a stored texel over a linear-light color.
#[must_use]
pub(super) fn over(texel: [u8; 4], behind: [f32; 3]) -> [f32; 3] {
    let alpha = f32::from(texel[3]) / 255.0;
    std::array::from_fn(|c| alpha * linear_from_srgb(texel[c]) + (1.0 - alpha) * behind[c])
}

/// The texel that, laid over `behind`, shows `target` (sRGB codes), with a coverage of at least `alpha` (0–255).
///
/// Where `behind` is the target already, within half a code, a texel of coverage 0 stays as it is.
#[must_use]
pub(super) fn lifted(target: [u8; 3], behind: [f32; 3], alpha: u8) -> [u8; 4] {
    if alpha == 255 {
        return [target[0], target[1], target[2], 255];
    }
    if alpha == 0 && (0..3).all(|c| srgb_from_linear(behind[c]) == target[c]) {
        return [target[0], target[1], target[2], 0];
    }
    let wanted = target.map(linear_from_srgb);
    let mut needed = f32::from(alpha) / 255.0;
    for c in 0..3 {
        let (i, b) = (wanted[c], behind[c]);
        if i < b {
            needed = needed.max(1.0 - i / b);
        } else if i > b {
            needed = needed.max((i - b) / (1.0 - b));
        }
    }
    // A dark pixel under a bright, thin layer may lie between two codes: a little more coverage makes the steps finer.
    let first = (needed * 255.0).ceil().clamp(1.0, 255.0) as u8;
    let mut best = (f32::INFINITY, [0; 4]);
    for stored in first..=255 {
        let a = f32::from(stored) / 255.0;
        let (mut texel, mut worst) = ([0, 0, 0, stored], 0.0_f32);
        for c in 0..3 {
            let (code, off) = nearest_code(wanted[c], target[c], behind[c], a);
            texel[c] = code;
            worst = worst.max(off);
        }
        if worst < best.0 {
            best = (worst, texel);
        }
        if worst <= CLOSE {
            break;
        }
    }
    best.1
}

/// A blend this near to its target, in codes, is it on any device, whatever the rounding.
const CLOSE: f32 = 0.35;

/// The code whose blend comes nearest to `target`, and how far from it that is, in codes.
fn nearest_code(wanted: f32, target: u8, behind: f32, a: f32) -> (u8, f32) {
    let exact = srgb_from_linear(((wanted - (1.0 - a) * behind) / a).clamp(0.0, 1.0));
    let off = |code: u8| {
        let blend = a * linear_from_srgb(code) + (1.0 - a) * behind;
        (255.0 * srgb_from_linear_f32(blend) - f32::from(target)).abs()
    };
    [exact, exact.saturating_sub(1), exact.saturating_add(1)]
        .map(|code| (code, off(code)))
        .into_iter()
        .fold((exact, f32::INFINITY), |best, next| if next.1 < best.1 { next } else { best })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lifted_texel_over_anything_shows_the_target() {
        let mut state = 7_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        };
        let mut raised = 0.0;
        for _ in 0..20_000 {
            let target = [next(), next(), next()];
            let behind = [next(), next(), next()].map(linear_from_srgb);
            let alpha = next();
            let texel = lifted(target, behind, alpha);
            assert!(texel[3] >= alpha, "coverage sank from {alpha} to {}", texel[3]);
            let shown = over(texel, behind).map(srgb_from_linear);
            assert_eq!(shown, target, "{texel:?} over {behind:?}");
            raised += f32::from(texel[3] - alpha) / 255.0 / 20_000.0;
        }
        assert!(raised < 0.5, "lift raises coverage by {raised} on random colors");
    }
}
