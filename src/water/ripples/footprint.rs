//! Where a body stands in the water: a closed outline from the contact line that the picture shows (notes §7.5).
//!
//! Only the near side is seen. The far side is its mirror image over the chord between the contact line's ends; a contact
//! line so straight that this would be a sliver gets half an ellipse-like arc behind it.

use std::f64::consts::PI;

use glam::DVec2;

use super::grid::{CellWeights, RippleGrid};

/// Bulge over chord below which a mirrored contact line would be a sliver.
const SLIVER: f64 = 0.15;

/// Segments of the side that is made up.
const SEGMENTS: usize = 48;

/// Samples along a cell's side.
const SAMPLES: usize = 4;

/// A closed outline on the water, (x, z) in meters.
#[derive(Clone, Debug, PartialEq)]
pub struct Footprint {
    /// With a positive area by the shoelace formula in (x, z).
    outline: Vec<DVec2>,
}

/// Why a contact line encloses nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FootprintError {
    /// A coordinate is not finite.
    #[error("a point of the outline is not a finite number")]
    NotFinite,
    /// Too few points, or no area.
    #[error("the outline encloses no water: it needs two ends apart from each other, or three corners")]
    Empty,
}

impl Footprint {
    /// A footprint with these corners.
    ///
    /// # Errors
    ///
    /// No area, or a number that is not finite.
    pub fn from_outline(mut outline: Vec<DVec2>) -> Result<Self, FootprintError> {
        if !outline.iter().all(|point| point.is_finite()) {
            return Err(FootprintError::NotFinite);
        }
        let area = area(&outline);
        if !area.is_finite() || area == 0.0 {
            return Err(FootprintError::Empty);
        }
        if area < 0.0 {
            outline.reverse();
        }
        Ok(Self { outline })
    }

    /// The footprint behind a contact line, as seen from a point: `contact` from end to end in meters. A straight one becomes
    /// `breadth` times its chord deep (0.2 for boats, 0.35 for rocks; kept to 0.01 to 1).
    ///
    /// # Errors
    ///
    /// No two ends apart, or a number that is not finite.
    pub fn from_contact(contact: &[DVec2], seen_from: DVec2, breadth: f64) -> Result<Self, FootprintError> {
        let (&[start, ..], &[.., end]) = (contact, contact) else { return Err(FootprintError::Empty) };
        if !contact.iter().all(|point| point.is_finite()) || !seen_from.is_finite() || !breadth.is_finite() {
            return Err(FootprintError::NotFinite);
        }
        let chord = end - start;
        let across = chord.perp().try_normalize().ok_or(FootprintError::Empty)?;
        let middle = 0.5 * (start + end);
        let behind = if (middle - seen_from).dot(across) < 0.0 { -across } else { across };
        let offset = |point: DVec2| (point - start).dot(behind);
        let bulge = contact.iter().map(|point| offset(*point).abs()).fold(0.0, f64::max);
        let is_sliver = bulge < SLIVER * chord.length();

        let mut outline = contact.to_vec();
        let length = length(contact);
        for segment in (1..SEGMENTS).rev() {
            let share = segment as f64 / SEGMENTS as f64;
            let point = along(contact, share * length);
            let off = offset(point);
            outline.push(if is_sliver {
                let arc = breadth.clamp(0.01, 1.0) * chord.length() * (PI * share).sin();
                point + (off.abs() - off + arc) * behind
            } else {
                point - 2.0 * off * behind
            });
        }
        Self::from_outline(outline)
    }

    /// Its corners, in order.
    #[must_use]
    pub fn outline(&self) -> &[DVec2] {
        &self.outline
    }

    /// Square meters.
    #[must_use]
    pub fn area(&self) -> f64 {
        area(&self.outline)
    }

    /// Center of its area, (x, z) in meters.
    #[must_use]
    pub fn centroid(&self) -> DVec2 {
        // From a corner, which keeps far places exact.
        let origin = self.outline[0];
        let sum: DVec2 = edges(&self.outline)
            .map(|(a, b)| {
                let (a, b) = (a - origin, b - origin);
                a.perp_dot(b) * (a + b)
            })
            .sum();
        origin + sum / (6.0 * self.area())
    }

    /// The same, turned about a point by `turn` radians (from +x to +z) and then shifted.
    #[must_use]
    pub fn moved(&self, about: DVec2, turn: f64, shift: DVec2) -> Self {
        let turn = DVec2::from_angle(turn);
        Self {
            outline: self.outline.iter().map(|point| about + turn.rotate(point - about) + shift).collect(),
        }
    }

    /// The cells that it covers, each with the share of its 4 × 4 samples that lie inside.
    #[must_use]
    pub fn cover(&self, grid: &RippleGrid) -> CellWeights {
        let mut weights = CellWeights::default();
        self.cover_into(grid, &mut weights);
        weights
    }

    /// As [`cover`](Self::cover), into weights that are there already.
    pub fn cover_into(&self, grid: &RippleGrid, weights: &mut CellWeights) {
        weights.clear();
        // In samples: sample i lies at i.
        let place = |point: DVec2| (point - grid.origin) / grid.cell * SAMPLES as f64 - 0.5;
        let samples = (grid.size * SAMPLES) as f64;
        let first = |value: f64| value.ceil().clamp(0.0, samples) as usize;
        let rows = self.outline.iter().map(|point| place(*point).y);
        let (low, high) = rows.fold((f64::MAX, f64::MIN), |(low, high), y| (low.min(y), high.max(y)));
        let mut counts = vec![0_u8; grid.size];
        let mut crossings: Vec<(f64, i32)> = Vec::new();
        for row in first(low) / SAMPLES..first(high).div_ceil(SAMPLES) {
            let (mut left, mut right) = (grid.size, 0);
            for sample in 0..SAMPLES {
                let y = (row * SAMPLES + sample) as f64;
                crossings.clear();
                for (a, b) in edges(&self.outline) {
                    let (a, b) = (place(a), place(b));
                    if (a.y <= y) != (b.y <= y) {
                        let x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
                        crossings.push((x, if a.y <= y { 1 } else { -1 }));
                    }
                }
                crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
                let mut winding = 0;
                for pair in crossings.windows(2) {
                    winding += pair[0].1;
                    if winding == 0 {
                        continue;
                    }
                    for column in first(pair[0].0)..first(pair[1].0) {
                        counts[column / SAMPLES] += 1;
                        left = left.min(column / SAMPLES);
                        right = right.max(column / SAMPLES + 1);
                    }
                }
            }
            for (column, count) in counts.iter_mut().enumerate().take(right).skip(left) {
                let count = std::mem::take(count);
                if count > 0 {
                    weights.push(row * grid.size + column, f32::from(count) / (SAMPLES * SAMPLES) as f32);
                }
            }
        }
    }
}

/// The corners of an outline, each with the next.
fn edges(outline: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> {
    outline.iter().zip(outline.iter().cycle().skip(1)).map(|(a, b)| (*a, *b))
}

/// Square meters by the shoelace formula.
fn area(outline: &[DVec2]) -> f64 {
    let Some(origin) = outline.first() else { return 0.0 };
    edges(outline).map(|(a, b)| 0.5 * (a - origin).perp_dot(b - origin)).sum()
}

/// Meters along a polyline.
fn length(line: &[DVec2]) -> f64 {
    line.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
}

/// The point so many meters along a polyline.
fn along(line: &[DVec2], meters: f64) -> DVec2 {
    let mut left = meters;
    for ends in line.windows(2) {
        let length = ends[0].distance(ends[1]);
        if left <= length && length > 0.0 {
            return ends[0].lerp(ends[1], left / length);
        }
        left -= length;
    }
    line[line.len() - 1]
}

#[cfg(test)]
#[path = "footprint_tests.rs"]
mod tests;
