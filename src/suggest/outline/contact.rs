//! Where an object meets what it stands on, from the lower edge of its mask.
//!
//! The mask alone is looked at: its main part, each column's lowest covered point. A broad foot (a boat, a wall, perhaps at
//! an angle) gives the line that most of the edge lies on; a narrow one (a trunk) gives a level line as wide as the foot.
//! A body's near side hangs a little below the line that a careful person would draw (notes §5.2); so does what is
//! proposed here.

use glam::DVec2;

use super::parts::parts;
use crate::picture::{Mask, PicturePoint};

/// How far from the line the edge may be and still lie on it, as a share of the object's height, and at least, pixels.
const NEAR: f64 = 0.03;
const LEAST_NEAR: f64 = 1.5;

/// Share of its columns that a broad foot touches with.
const BROAD: f64 = 0.35;

/// Steeper lines are sides of the object.
const STEEPEST: f64 = 0.6;

/// A part this large against the largest one that stands above it is the object, and the largest one its mirror image.
const MIRRORED: f64 = 0.5;

/// Rounds of the robust fit.
const ROUNDS: usize = 8;

/// A proposed contact line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactLine {
    /// Left and right foot.
    pub feet: [PicturePoint; 2],
    /// How far to trust it, 0–1: the share of the object's width that touches the line, as its square root; half of that
    /// where the mask ends at the picture's lower frame and the true foot may lie beyond.
    pub confidence: f64,
}

/// Proposes the contact line of an object; `None` for a mask in which no pixel is half covered.
#[must_use]
pub fn contact_line(mask: &Mask) -> Option<ContactLine> {
    let edge = LowerEdge::of(mask)?;
    let near = (NEAR * edge.height).max(LEAST_NEAR);
    let width = edge.points.len() as f64;
    let broad = edge.broadest_line(near).map(|line| edge.fitted(line, near));
    let touching = |line: &Line| edge.points.iter().filter(|p| line.off(**p).abs() <= near).count() as f64;
    let line = match broad {
        Some(line) if touching(&line) >= BROAD * width => line,
        _ => edge.level_foot(near),
    };
    let touch = edge.points.iter().filter(|point| line.off(**point).abs() <= near);
    let (left, right) = touch.fold((f64::INFINITY, f64::NEG_INFINITY), |(left, right), point| {
        (left.min(point.x - 0.5), right.max(point.x + 0.5))
    });
    let share = (touching(&line) / width).sqrt();
    let feet = [left, right].map(|x| PicturePoint::new(x, line.at(x)));
    Some(ContactLine { feet, confidence: if edge.is_cut_off { 0.5 * share } else { share } })
}

/// A line that is no upright one.
#[derive(Clone, Copy, Debug)]
struct Line {
    through: DVec2,
    slope: f64,
}

impl Line {
    fn at(&self, x: f64) -> f64 {
        self.through.y + self.slope * (x - self.through.x)
    }

    /// How far a point lies below the line, pixels.
    fn off(&self, point: DVec2) -> f64 {
        point.y - self.at(point.x)
    }
}

/// The lowest covered point of each column that the object has.
#[derive(Debug)]
struct LowerEdge {
    points: Vec<DVec2>,
    /// Of the object, pixels.
    height: f64,
    /// Whether a good part of it lies on the picture's lower frame.
    is_cut_off: bool,
}

impl LowerEdge {
    fn of(mask: &Mask) -> Option<Self> {
        let [width, height] = [mask.size().x as usize, mask.size().y as usize];
        let values = mask.values();
        let (part_of, counts) = parts(width, |cell| values[cell] >= 128, values.len());
        let part = main_part(width, &part_of, &counts)?;
        let mut points = Vec::new();
        let mut top = height;
        for x in 0..width {
            let column = |y: usize| part_of[y * width + x] == part;
            let Some(last) = (0..height).rev().find(|y| column(*y)) else { continue };
            top = top.min((0..height).find(|y| column(*y)).unwrap_or(last));
            // Between pixel centers where coverage is soft.
            let value = |y: usize| f64::from(values.get(y * width + x).copied().unwrap_or(0));
            let beyond = (value(last) - 127.5) / (value(last) - value(last + 1)).max(1.0);
            let y = (last as f64 + 0.5 + beyond.clamp(0.0, 1.0)).min(height as f64);
            points.push(DVec2::new(x as f64 + 0.5, y));
        }
        let lowest = points.iter().map(|point| point.y).fold(0.0, f64::max);
        let at_frame = points.iter().filter(|point| point.y > height as f64 - 1.0).count();
        Some(Self { height: lowest - top as f64, is_cut_off: at_frame * 10 > points.len(), points })
    }

    /// Of the lines that run below everything, the one that most columns are near to.
    fn broadest_line(&self, near: f64) -> Option<Line> {
        // The lower side of the convex hull.
        let mut hull: Vec<DVec2> = Vec::new();
        for &point in &self.points {
            while let [.., a, b] = hull[..]
                && (b - a).perp_dot(point - a) >= 0.0
            {
                hull.pop();
            }
            hull.push(point);
        }
        let lines = hull.windows(2).map(|ends| {
            let way = ends[1] - ends[0];
            Line { through: ends[0], slope: way.y / way.x }
        });
        let count = |line: &Line| self.points.iter().filter(|p| line.off(**p) >= -2.0 * near).count();
        lines.filter(|line| line.slope.abs() <= STEEPEST).max_by_key(count)
    }

    /// A line moved to the middle of the edge near it, by weighted least squares (Tukey's weights); level where the
    /// edge tells no slope.
    fn fitted(&self, mut line: Line, near: f64) -> Line {
        // The hull's line lies below the edge: the first round looks mostly above it.
        line.through.y -= near;
        for _ in 0..ROUNDS {
            let weighted = self.points.iter().map(|point| {
                let off = (line.off(*point) / (2.0 * near)).clamp(-1.0, 1.0);
                (*point, (1.0 - off * off).powi(2))
            });
            let (mut total, mut sum) = (0.0, DVec2::ZERO);
            weighted.clone().for_each(|(point, weight)| {
                total += weight;
                sum += weight * point;
            });
            if total < 2.0 {
                break;
            }
            let middle = sum / total;
            let (mut square, mut both) = (0.0, 0.0);
            weighted.for_each(|(point, weight)| {
                let d = point - middle;
                square += weight * d.x * d.x;
                both += weight * d.x * d.y;
            });
            line = Line { through: middle, slope: if square > 0.0 { both / square } else { 0.0 } };
        }
        let rise = line.slope.abs() * self.points.len() as f64;
        if rise < LEAST_NEAR { Line { slope: 0.0, ..line } } else { line }
    }

    /// A level line through the lowest points.
    fn level_foot(&self, near: f64) -> Line {
        let lowest = self.points.iter().copied().max_by(|a, b| a.y.total_cmp(&b.y)).unwrap_or_default();
        let foot: Vec<f64> = self.points.iter().map(|p| p.y).filter(|y| lowest.y - y <= near).collect();
        let mean = foot.iter().sum::<f64>() / foot.len().max(1) as f64;
        Line { through: DVec2::new(lowest.x, mean), slope: 0.0 }
    }
}

/// The largest part, or the one above it that it seems to mirror.
fn main_part(width: usize, part_of: &[u32], counts: &[usize]) -> Option<u32> {
    let (largest, count) = counts.iter().copied().enumerate().skip(1).max_by_key(|(_, count)| *count)?;
    // Left, right, top, bottom (excluded) of each part.
    let mut boxes = vec![[usize::MAX, 0, usize::MAX, 0]; counts.len()];
    for (cell, part) in part_of.iter().enumerate() {
        let [left, right, top, bottom] = &mut boxes[*part as usize];
        let (x, y) = (cell % width, cell / width);
        (*left, *right) = ((*left).min(x), (*right).max(x + 1));
        (*top, *bottom) = ((*top).min(y), (*bottom).max(y + 1));
    }
    let below = boxes[largest];
    let is_mirrored = |part: &usize| {
        let [left, right, _, bottom] = boxes[*part];
        let common = right.min(below[1]).saturating_sub(left.max(below[0]));
        counts[*part] as f64 >= MIRRORED * count as f64
            && bottom <= below[2]
            && common * 2 > (right - left).max(below[1] - below[0])
    };
    Some((1..counts.len()).find(|part| *part != largest && is_mirrored(part)).unwrap_or(largest) as u32)
}

#[cfg(test)]
#[path = "contact_tests.rs"]
mod tests;
