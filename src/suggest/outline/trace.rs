//! From a mask to polygons: outlines that stay editable.
//!
//! Borders are found by marching squares at half coverage, exact to a fraction of a pixel on soft masks, and thinned out
//! by Douglas & Peucker (1973). A thinned polygon never crosses itself. Open lines are thinned out in the same way.

use glam::DVec2;

use super::stroke::distance_to_segment;
use crate::picture::{Mask, PicturePoint};
use crate::tour::geometry;

/// Coverage at which the border runs.
const LEVEL: f64 = 127.5;

/// Halvings of the tolerance before a polygon that crosses itself is left as it was.
const HALVINGS: u32 = 6;

/// A border of a mask.
#[derive(Clone, Debug, PartialEq)]
pub struct TracedOutline {
    /// Its corners in order; the last is joined to the first.
    pub corners: Vec<PicturePoint>,
    /// Square pixels inside it.
    pub area: f64,
    /// Whether it encloses a hole, and not a part of the mask.
    pub is_hole: bool,
}

/// All borders of a mask, the largest first, with corners that are off by at most `tolerance` pixels (0 keeps them all; so do
/// negative numbers and NaN). What touches the picture's frame is closed along it.
#[must_use]
pub fn outlines_of(mask: &Mask, tolerance: f64) -> Vec<TracedOutline> {
    let mut outlines: Vec<_> = borders(mask)
        .into_iter()
        .map(|corners| {
            let corners = simplified(&corners, tolerance);
            let area = signed_area(&corners);
            TracedOutline { corners, area: area.abs(), is_hole: area < 0.0 }
        })
        .filter(|outline| outline.corners.len() >= 3)
        .collect();
    outlines.sort_by(|a, b| b.area.total_cmp(&a.area));
    outlines
}

/// The outer border of a mask's largest part, as a polygon that is off by at most `tolerance` pixels; `None` for an empty
/// mask. Holes and other parts are lost.
#[must_use]
pub fn polygon_of(mask: &Mask, tolerance: f64) -> Option<Vec<PicturePoint>> {
    outlines_of(mask, tolerance).into_iter().find(|outline| !outline.is_hole).map(|outline| outline.corners)
}

/// A closed polygon with fewer corners, all of them its own; what is left out lies within `tolerance` pixels of a side. A
/// polygon that does not cross itself never comes to.
fn simplified(corners: &[PicturePoint], tolerance: f64) -> Vec<PicturePoint> {
    let is_fine = corners.len() > 3 && corners.iter().all(|corner| corner.0.is_finite());
    // NaN keeps all corners, too.
    if !is_fine || tolerance.is_nan() || tolerance <= 0.0 {
        return corners.to_vec();
    }
    let points: Vec<DVec2> = corners.iter().map(|corner| corner.0).collect();
    for halving in 0..=HALVINGS {
        let kept = kept(&points, tolerance / f64::from(1_u32 << halving));
        if kept.len() >= 3 && geometry::crossing(&kept).is_none() {
            return kept;
        }
    }
    corners.to_vec()
}

/// An open line with fewer points, in their order, its two ends among them; what is left out lies within `tolerance` pixels of
/// what stays. Points that are not finite, and a tolerance that is not above 0, leave it as it is.
#[must_use]
pub fn simplified_line(points: &[PicturePoint], tolerance: f64) -> Vec<PicturePoint> {
    let is_fine = points.len() > 2 && points.iter().all(|point| point.0.is_finite());
    if !is_fine || tolerance.is_nan() || tolerance <= 0.0 {
        return points.to_vec();
    }
    let points: Vec<DVec2> = points.iter().map(|point| point.0).collect();
    thinned(&points, &[0, points.len() - 1], tolerance)
}

/// The corners that Douglas & Peucker keep of a closed polygon.
fn kept(points: &[DVec2], tolerance: f64) -> Vec<PicturePoint> {
    // A ring has no ends: cut it at a corner and at the one farthest from it, the first being the one farthest from the
    // middle, so that it is a real corner.
    let middle = points.iter().sum::<DVec2>() / points.len() as f64;
    let farthest = |from: DVec2| {
        let distances = points.iter().map(|point| point.distance_squared(from)).enumerate();
        distances.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index)
    };
    let first = farthest(middle);
    let ring: Vec<DVec2> = points[first..].iter().chain(&points[..=first]).copied().collect();
    let second = (farthest(points[first]) + points.len() - first) % points.len();
    let mut kept = thinned(&ring, &[0, second, ring.len() - 1], tolerance);
    // The first corner again.
    kept.pop();
    kept
}

/// The points that Douglas & Peucker keep of a line between some that stay in any case: their indices from 0 to the last,
/// in order.
fn thinned(line: &[DVec2], stay: &[usize], tolerance: f64) -> Vec<PicturePoint> {
    let mut keep = vec![false; line.len()];
    for index in stay {
        keep[*index] = true;
    }
    let mut spans: Vec<(usize, usize)> = stay.windows(2).map(|ends| (ends[0], ends[1])).collect();
    while let Some((from, to)) = spans.pop() {
        let off = |index: usize| distance_to_segment(line[index], line[from], line[to]);
        let worst = (from + 1..to).map(|index| (index, off(index))).max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((index, distance)) = worst
            && distance > tolerance
        {
            keep[index] = true;
            spans.extend([(from, index), (index, to)]);
        }
    }
    line.iter().zip(keep).filter(|(_, keep)| *keep).map(|(point, _)| PicturePoint(*point)).collect()
}

/// Square pixels inside, above 0 for a border that keeps the mask at its right hand (y points down).
fn signed_area(corners: &[PicturePoint]) -> f64 {
    let origin = corners.first().map_or(DVec2::ZERO, |corner| corner.0);
    let after = corners.iter().cycle().skip(1);
    corners.iter().zip(after).map(|(a, b)| (a.0 - origin).perp_dot(b.0 - origin)).sum::<f64>() / 2.0
}

/// Marching squares: closed borders with the mask at the right hand. Squares have pixel centers as corners and reach one pixel
/// beyond the frame, where the border is pushed back onto it.
fn borders(mask: &Mask) -> Vec<Vec<PicturePoint>> {
    let size = mask.size();
    // Squares count from (−1, −1); so do pixel centers, moved by one.
    let [width, height] = [size.x as usize + 1, size.y as usize + 1];
    let value = |(x, y): (usize, usize)| {
        let inside = x >= 1 && y >= 1 && x <= size.x as usize && y <= size.y as usize;
        if inside { f64::from(mask.values()[(y - 1) * size.x as usize + x - 1]) } else { 0.0 }
    };
    // A square's sides: top, right, bottom, left. A border that comes in over one goes out over another.
    let exit = |x: usize, y: usize, side: u8| -> Option<u8> {
        let corner = |k: u8| match (side + k) % 4 {
            0 => (x, y),
            1 => (x + 1, y),
            2 => (x + 1, y + 1),
            _ => (x, y + 1),
        };
        let is_in = |k: u8| value(corner(k)) > LEVEL;
        // With the mask at its right hand it comes in over a side whose first corner, clockwise, is in and whose
        // second one is out.
        if !is_in(0) || is_in(1) {
            return None;
        }
        let middle = || (0..4).map(|k| value(corner(k))).sum::<f64>() > 4.0 * LEVEL;
        let turn = match (is_in(2), is_in(3)) {
            // A saddle: its middle says which corners hang together.
            (true, false) if !middle() => 3,
            (true, _) => 1,
            (false, true) => 2,
            (false, false) => 3,
        };
        Some((side + turn) % 4)
    };
    let limit = size.as_dvec2();
    let crossing = |x: usize, y: usize, side: u8| {
        let [a, b] = match side {
            0 => [(x, y), (x + 1, y)],
            1 => [(x + 1, y), (x + 1, y + 1)],
            2 => [(x + 1, y + 1), (x, y + 1)],
            _ => [(x, y + 1), (x, y)],
        };
        let [from, to] = [a, b].map(|(x, y)| DVec2::new(x as f64 - 0.5, y as f64 - 0.5));
        let [low, high] = [a, b].map(value);
        let at = from + (to - from) * ((LEVEL - low) / (high - low));
        // Beyond the frame nothing is known: a pixel of the outermost row that is in reaches to the frame.
        let beyond = |p: DVec2| !(p.cmpge(DVec2::ZERO) & p.cmple(limit)).all();
        let [out, inner] = [beyond(from), beyond(to)];
        let at = match (out, inner) {
            (true, false) | (false, true) => (from + to) / 2.0,
            _ => at,
        };
        PicturePoint(at.clamp(DVec2::ZERO, limit))
    };
    let mut seen = vec![0_u8; width * height];
    let mut borders = Vec::new();
    for start in 0..width * height {
        for first in 0..4_u8 {
            let (mut x, mut y, mut side) = (start % width, start / width, first);
            let mut border = Vec::new();
            while seen[y * width + x] >> side & 1 == 0
                && let Some(exit) = exit(x, y, side)
            {
                seen[y * width + x] |= 1 << side;
                border.push(crossing(x, y, side));
                // What leaves over a side enters the next square over the opposite one.
                side = (exit + 2) % 4;
                match exit {
                    0 => y -= 1,
                    1 => x += 1,
                    2 => y += 1,
                    _ => x -= 1,
                }
            }
            if border.len() >= 3 {
                borders.push(border);
            }
        }
    }
    borders
}

#[cfg(test)]
#[path = "trace_tests.rs"]
mod tests;
