//! Strokes: polylines with a radius, and the pixels near them.
//!
//! Points that are not finite are left out; what lies outside the picture covers nothing.

use glam::{DVec2, UVec2};

use crate::picture::{PicturePoint, PixelRect};

/// A segment of a stroke is cut into so many pieces at most: its ends may lie anywhere.
const MOST_PIECES: f64 = 1000.0;

/// Which side of an outline something is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// It belongs to the object.
    Inside,
    /// It does not.
    Outside,
}

/// A line drawn by hand; a single point is a click.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Its points in order, picture pixels.
    pub points: Vec<PicturePoint>,
    /// Half its width, pixels; taken as at least 0.5, as 0.5 when not finite.
    pub radius: f64,
    /// What it says of the pixels under it.
    pub side: Side,
}

impl Stroke {
    /// A stroke on the object.
    #[must_use]
    pub const fn inside(points: Vec<PicturePoint>, radius: f64) -> Self {
        Self { points, radius, side: Side::Inside }
    }

    /// A stroke beside the object.
    #[must_use]
    pub const fn outside(points: Vec<PicturePoint>, radius: f64) -> Self {
        Self { points, radius, side: Side::Outside }
    }

    /// The radius as it is used.
    pub(super) fn reach(&self) -> f64 {
        if self.radius.is_finite() { self.radius.max(0.5) } else { 0.5 }
    }

    /// The stroke cut into pieces about as long as it is wide; a click is one.
    pub(super) fn pieces(&self) -> Vec<Vec<PicturePoint>> {
        let points: Vec<DVec2> = self.points.iter().map(|point| point.0).filter(|p| p.is_finite()).collect();
        if let [click] = points[..] {
            return vec![vec![PicturePoint(click)]];
        }
        let cut = |ends: &[DVec2]| {
            let (a, b) = (ends[0], ends[1]);
            let count = (a.distance(b) / (2.0 * self.reach())).ceil().clamp(1.0, MOST_PIECES) as usize;
            let at = move |i: usize| PicturePoint(a.lerp(b, i as f64 / count as f64));
            (0..count).map(move |i| vec![at(i), at(i + 1)])
        };
        points.windows(2).flat_map(cut).collect()
    }
}

/// The block of pixels whose centers may lie within `reach` of a segment; `None` when there is none.
fn block_near(size: UVec2, a: DVec2, b: DVec2, reach: f64) -> Option<PixelRect> {
    let limit = size.as_dvec2();
    let low = (a.min(b) - reach - 0.5).ceil().clamp(DVec2::ZERO, limit).as_uvec2();
    let high = ((a.max(b) + reach - 0.5).floor() + 1.0).clamp(DVec2::ZERO, limit).as_uvec2();
    let block = PixelRect { min: low, max: high };
    (block.size().min_element() > 0).then_some(block)
}

/// Distance of a point from the segment `a` to `b`.
pub(super) fn distance_to_segment(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let share = (p - a).dot(along) / along.length_squared();
    // NaN when the segment is a point.
    let nearest = if share > 0.0 { a + along * share.min(1.0) } else { a };
    p.distance(nearest)
}

/// The segments of a polyline; a click is one of no length.
fn segments(points: &[PicturePoint]) -> impl Iterator<Item = (DVec2, DVec2)> {
    let finite = || points.iter().map(|point| point.0).filter(|point| point.is_finite());
    let is_click = finite().nth(1).is_none();
    finite().zip(finite().skip(usize::from(!is_click)))
}

/// The block of all pixels whose centers may lie within `reach` of a polyline; `None` when there is none.
pub(super) fn block_near_line(size: UVec2, points: &[PicturePoint], reach: f64) -> Option<PixelRect> {
    let blocks = segments(points).filter_map(|(a, b)| block_near(size, a, b, reach));
    blocks.reduce(|a, b| PixelRect { min: a.min.min(b.min), max: a.max.max(b.max) })
}

/// Calls `at` with column, row and distance in pixels for each pixel whose center lies within `reach` of a polyline. Pixels
/// near several segments come several times.
pub(super) fn for_each_near(
    size: UVec2,
    points: &[PicturePoint],
    reach: f64,
    mut at: impl FnMut(u32, u32, f64),
) {
    for (a, b) in segments(points) {
        let Some(block) = block_near(size, a, b, reach) else { continue };
        for y in block.min.y..block.max.y {
            for x in block.min.x..block.max.x {
                let center = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let distance = distance_to_segment(center, a, b);
                if distance <= reach {
                    at(x, y, distance);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_click_covers_a_disc_and_a_stroke_a_capsule() {
        let size = UVec2::new(60, 40);
        let count = |points: &[PicturePoint], reach| {
            let mut seen = vec![false; 2400];
            for_each_near(size, points, reach, |x, y, _| seen[(y * 60 + x) as usize] = true);
            seen.iter().filter(|seen| **seen).count() as f64
        };
        let [a, b] = [PicturePoint::new(20.0, 20.0), PicturePoint::new(40.0, 20.0)];
        let disc = std::f64::consts::PI * 64.0;
        assert!((count(&[a], 8.0) - disc).abs() < 8.0, "{} against {disc}", count(&[a], 8.0));
        assert!((count(&[a, b], 8.0) - disc - 320.0).abs() < 8.0);
        assert_eq!(count(&[PicturePoint::new(f64::NAN, 3.0)], 8.0), 0.0);
        assert_eq!(count(&[PicturePoint::new(-1e30, 3.0), PicturePoint::new(-1e29, 3.0)], 8.0), 0.0);
        assert_eq!(count(&[], 8.0), 0.0);
    }
}
