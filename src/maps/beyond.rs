//! Beyond the picture's border: maps reach a bit further, so that a camera may move without seeing where they end.
//!
//! Coverage outside is folded in from inside (mirrored at the border, the lowest row prolonged: what lies at one's feet goes
//! on); colors are filled like any hole, and counted as missing.

use glam::{IVec2, UVec2};

use crate::scene::BEYOND_BORDER;

/// How far maps reach below the lower border, as a share of the picture's height: what a camera sees that looks further down or steps back.
const BELOW: f64 = 0.25;

/// The pixels that maps of a picture of `size` may have: low corner, and high corner (exclusive).
pub(super) fn frame(size: UVec2) -> (IVec2, IVec2) {
    let share = |share: f64, pixels: u32| (share * f64::from(pixels)).round() as i32;
    let low = -IVec2::new(share(BEYOND_BORDER, size.x), share(BEYOND_BORDER, size.y));
    (low, IVec2::new(size.x as i32 - low.x, size.y as i32 + share(BELOW, size.y)))
}

/// The pixel of the picture that stands for one outside: mirrored at the border, below the picture its lowest row.
pub(super) fn folded(pixel: IVec2, size: UVec2) -> IVec2 {
    let fold = |x: i32, size: u32| {
        let (size, period) = (size as i32, 2 * size as i32);
        let x = x.rem_euclid(period);
        if x < size { x } else { period - 1 - x }
    };
    IVec2::new(fold(pixel.x, size.x), fold(pixel.y.min(size.y as i32 - 1), size.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folding_mirrors_at_the_border_and_keeps_the_inside() {
        let size = UVec2::new(10, 6);
        assert_eq!(folded(IVec2::new(3, 5), size), IVec2::new(3, 5));
        assert_eq!(folded(IVec2::new(-1, -3), size), IVec2::new(0, 2));
        assert_eq!(folded(IVec2::new(10, 8), size), IVec2::new(9, 5));
    }
}
