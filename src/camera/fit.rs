//! A picture in a window of another shape: with bars beside it, or cropped.
//!
//! Pixels stay square, and what is the picture's center stays in the window's center. A window of the picture's own
//! size changes no bit of its intrinsics.

use glam::UVec2;

use super::Intrinsics;
use crate::picture::PicturePoint;

/// How a picture's frame goes into a target of another shape.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Fit {
    /// All of the picture is seen; bars fill the rest.
    #[default]
    Contain,
    /// All of the target is filled; the picture's longer sides are cropped.
    Cover,
}

/// The part of a target that shows the picture, and its camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedView {
    /// Top-left pixel of the viewport in the target.
    pub viewport_min: UVec2,
    /// Pixels of the viewport, each side at least 1.
    pub viewport_size: UVec2,
    /// The lens as it is in the viewport; `size` is the viewport's.
    pub intrinsics: Intrinsics,
}

/// The view of `intrinsics`' frame in a target of `target` pixels. A side of 0 counts as 1.
///
/// A bar's width is whole pixels, and so `Contain` may crop less than half a pixel of the picture from two sides.
#[must_use]
pub fn fitted(intrinsics: &Intrinsics, target: UVec2, fit: Fit) -> FittedView {
    let (picture, target) = (intrinsics.size.max(UVec2::ONE), target.max(UVec2::ONE));
    // In integers, so that no rounding takes a pixel from a target of exactly the picture's shape.
    let (p, t) = (picture.as_u64vec2(), target.as_u64vec2());
    let narrower = t.x * p.y <= t.y * p.x;
    let ratio = target.as_dvec2() / picture.as_dvec2();
    let (viewport_size, scale) = match (fit, narrower) {
        (Fit::Contain, true) => (UVec2::new(target.x, (t.x * p.y / p.x) as u32), ratio.x),
        (Fit::Contain, false) => (UVec2::new((t.y * p.x / p.y) as u32, target.y), ratio.y),
        (Fit::Cover, true) => (target, ratio.y),
        (Fit::Cover, false) => (target, ratio.x),
    };
    let viewport_size = viewport_size.max(UVec2::ONE);
    let cropped = (viewport_size.as_dvec2() - picture.as_dvec2() * scale) / 2.0;
    FittedView {
        viewport_min: (target - viewport_size) / 2,
        viewport_size,
        intrinsics: Intrinsics {
            focal_px: intrinsics.focal_px * scale,
            principal: PicturePoint(intrinsics.principal.0 * scale + cropped),
            size: viewport_size,
        },
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;

    fn intrinsics() -> Intrinsics {
        Intrinsics {
            focal_px: 820.3,
            principal: PicturePoint::new(471.37, 280.11),
            size: UVec2::new(960, 540),
        }
    }

    #[test]
    fn the_picture_s_own_size_is_the_identity() {
        for fit in [Fit::Contain, Fit::Cover] {
            let view = fitted(&intrinsics(), UVec2::new(960, 540), fit);
            assert_eq!(view.viewport_min, UVec2::ZERO);
            assert_eq!(view.viewport_size, UVec2::new(960, 540));
            assert_eq!(view.intrinsics, intrinsics());
        }
    }

    #[test]
    fn bars_lie_above_and_below_or_beside() {
        let view = fitted(&intrinsics(), UVec2::new(1920, 1280), Fit::Contain);
        assert_eq!((view.viewport_min, view.viewport_size), (UVec2::new(0, 100), UVec2::new(1920, 1080)));
        assert_eq!(view.intrinsics, intrinsics().scaled_to(UVec2::new(1920, 1080)));
        let view = fitted(&intrinsics(), UVec2::new(1080, 270), Fit::Contain);
        assert_eq!((view.viewport_min, view.viewport_size), (UVec2::new(300, 0), UVec2::new(480, 270)));
    }

    /// Where the viewport shows the picture point `seen`.
    fn shown(view: &FittedView, seen: DVec2) -> DVec2 {
        let direction = intrinsics().direction_in_view(PicturePoint(seen));
        view.intrinsics.project_view(direction).unwrap().0
    }

    #[test]
    fn the_picture_s_center_is_the_viewport_s_and_corners_are_where_they_belong() {
        for target in [[1920, 1280], [1281, 333], [97, 1500], [960, 541], [7, 1]].map(UVec2::from) {
            for fit in [Fit::Contain, Fit::Cover] {
                let view = fitted(&intrinsics(), target, fit);
                let size = view.viewport_size.as_dvec2();
                let center = shown(&view, DVec2::new(480.0, 270.0));
                assert!(center.distance(size / 2.0) < 1e-9, "{center} is not the center of {size}");
                let outside = shown(&view, DVec2::ZERO);
                assert!(outside.max_element() < 1e-9, "{fit:?} {target}: the picture ends at {outside}");
                let longest = if fit == Fit::Contain { outside.min_element() } else { -0.4 };
                assert!(longest > -0.5, "{fit:?} {target}: {longest} px are cropped");
            }
        }
    }

    #[test]
    fn a_side_of_0_counts_as_1() {
        for fit in [Fit::Contain, Fit::Cover] {
            assert_eq!(fitted(&intrinsics(), UVec2::ZERO, fit), fitted(&intrinsics(), UVec2::ONE, fit));
            let view = fitted(&Intrinsics { size: UVec2::ZERO, ..intrinsics() }, UVec2::new(3, 5), fit);
            assert!(view.viewport_size.min_element() > 0 && view.intrinsics.focal_px.is_finite(), "{view:?}");
        }
    }
}
