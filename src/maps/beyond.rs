//! Beyond the picture's border: maps reach a bit further, so that a camera may move without seeing where they end.
//!
//! Coverage outside is folded in from inside (mirrored at the border, the lowest row prolonged: what lies at one's feet goes
//! on; what the upper border cuts off a band slopes off); colors are filled like any hole, and counted as missing.

use glam::{IVec2, UVec2};

use super::Grid;
use crate::picture::distances;
use crate::scene::{BEYOND_BORDER, margin_px};

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

/// How many pixels a slope that the upper border cuts off goes on for each one that it rises: as mountains' do.
const SLOPE: f32 = 2.0;
/// How high it rises at most, as a share of what there is above the border.
const SUMMIT: f32 = 0.7;
/// Ends of a row are nearer than this, pixels.
const NOWHERE: f32 = 1e5;
/// What is missing of the uppermost row over less than this share of the picture's width is a gap in a mask, not an end.
const GAP: f64 = 0.02;

/// A band's coverage across the whole frame: folded in from the sides, its uppermost row prolonged upwards, the less the
/// farther from where that ends.
pub(super) fn across(inside: &Grid<u8>, picture: UVec2) -> Grid<u8> {
    let (low, high) = frame(picture);
    let width = picture.x as usize;
    let rows = inside.cells.chunks(width.max(1));
    let covered: Vec<usize> =
        rows.enumerate().filter(|(_, row)| row.iter().any(|&c| c > 0)).map(|(y, _)| y).collect();
    let (Some(&first), Some(&last)) = (covered.first(), covered.last()) else {
        return Grid::filled(IVec2::ZERO, UVec2::ONE, 0);
    };
    // Free rows above and below, or sampling would prolong the coverage without end.
    let top = if first == 0 { low.y } else { first as i32 - 1 };
    let bottom = (last as i32 + 2 + margin_px(picture)).min(high.y);
    let extent = UVec2::new((high.x - low.x) as u32, (bottom - top) as u32);
    let covered = |x: i32, y: i32| {
        let beside = folded(IVec2::new(x, y), picture).x;
        inside.get(IVec2::new(beside, y.max(0))).unwrap_or(0)
    };
    let most = -SUMMIT * low.y as f32;
    let is_missing: Vec<bool> = (low.x..high.x).map(|x| covered(x, 0) < 128).collect();
    let runs = is_missing.chunk_by(|a, b| a == b);
    let is_end: Vec<bool> = runs
        .flat_map(|run| {
            std::iter::repeat_n(run[0] && run.len() as f64 >= GAP * f64::from(picture.x), run.len())
        })
        .collect();
    let to_end = distances(extent.x as usize, 1, |column| is_end[column]);
    Grid::from_fn(IVec2::new(low.x, top), extent, |pixel| {
        let own = covered(pixel.x, pixel.y);
        if pixel.y >= 0 {
            return own;
        }
        let to_end = to_end[(pixel.x - low.x) as usize];
        // What has no end in the picture has none above it.
        let rise =
            if to_end < NOWHERE { most * (1.0 - (-to_end / (SLOPE * most)).exp()) } else { f32::INFINITY };
        own.min((255.0 * (rise + pixel.y as f32).clamp(0.0, 1.0)) as u8)
    })
}

/// A billboard's coverage with what the picture's left, right and upper border cut off folded in, as far as maps reach.
pub(super) fn beyond_border(inside: &Grid<u8>, picture: UVec2) -> Grid<u8> {
    let (least, most) = frame(picture);
    let (mut low, mut high) = (inside.origin, inside.origin + inside.size.as_ivec2());
    let width = picture.x as i32;
    let touches = |column: i32| {
        (low.y..high.y).any(|y| inside.get(IVec2::new(column, y)).is_some_and(|covered| covered > 0))
    };
    let (left, right) = (touches(0), touches(width - 1));
    let top = (low.x..high.x).any(|x| inside.get(IVec2::new(x, 0)).is_some_and(|covered| covered > 0));
    // One free column ends the fold, or sampling would prolong it without end.
    if left {
        low.x = least.x;
    }
    if right {
        high.x = most.x;
    }
    if top {
        low.y = least.y;
    }
    Grid::from_fn(low, (high - low).as_uvec2(), |pixel| {
        let end = (left && pixel.x == low.x) || (right && pixel.x == high.x - 1) || (top && pixel.y == low.y);
        let beside = folded(pixel, picture).x;
        let row = if top && pixel.y < 0 { folded(pixel, picture).y } else { pixel.y };
        if end { 0 } else { inside.get(IVec2::new(beside, row)).unwrap_or(0) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_upper_border_cuts_off_ends_in_a_slope() {
        let size = UVec2::new(600, 300);
        let inside =
            Grid::from_fn(IVec2::ZERO, size, |pixel| if (200..400).contains(&pixel.x) { 255 } else { 0 });
        let whole = across(&inside, size);
        for up in [5, 10, 20] {
            let row: Vec<i32> = (0..600).filter(|&x| whole.get(IVec2::new(x, -up)) == Some(255)).collect();
            let ends = [row.first(), row.last()].map(|end| *end.expect("it goes on"));
            assert!(
                ends[0] >= 200 + 2 * up && ends[0] + ends[1] == 599,
                "{ends:?} at {up} px above the border"
            );
        }
        let summit = -(SUMMIT * 300.0 * BEYOND_BORDER as f32).ceil() as i32;
        assert!((0..600).all(|x| whole.get(IVec2::new(x, summit)) == Some(0)), "a hill without end");
        // Pixels that a soft mask left out are no end.
        let mut speckled = inside.clone();
        for x in [250, 251, 330] {
            speckled.cells[x] = 90;
        }
        let speckled = across(&speckled, size);
        assert!([248, 253, 329].iter().all(|&x| speckled.get(IVec2::new(x, -10)) == Some(255)), "a notch");
        // What has no end in the picture has none above.
        let wall = across(&Grid::filled(IVec2::ZERO, size, 255), size);
        assert!(wall.get(IVec2::new(5, -5)).unwrap_or(255) == 255);
    }

    #[test]
    fn folding_mirrors_at_the_border_and_keeps_the_inside() {
        let size = UVec2::new(10, 6);
        assert_eq!(folded(IVec2::new(3, 5), size), IVec2::new(3, 5));
        assert_eq!(folded(IVec2::new(-1, -3), size), IVec2::new(0, 2));
        assert_eq!(folded(IVec2::new(10, 8), size), IVec2::new(9, 5));
    }
}
