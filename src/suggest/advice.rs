//! Where one more reflection pair would help most.
//!
//! What pairs tell worst is how reflections lean, and with it pitch and focal length: its information is Σ L²·(u − ū)²,
//! L the way from a point to its reflection and ū the mean column by L² (notes §1.2, §2.2 step 5). So long pairs near the
//! left and the right border count most; with such on both sides, nearer and farther ones tell the depths.

use glam::{DVec2, UVec2};

use crate::picture::PicturePoint;
use crate::tour::ReflectionPair;

/// Where to mark one more pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// The part of the picture to look for its upper point in: top left and bottom right corner.
    pub region: [PicturePoint; 2],
    /// By which factor the lean would be known better, above 1; infinite where it is not known at all.
    pub gain: f64,
    /// What to do, one sentence without a full stop.
    pub sentence: String,
}

/// Columns and rows of the places among which the best is chosen.
const COLUMNS: usize = 6;
const ROWS: usize = 4;
/// A pair that helps less is not worth the trouble.
const LEAST_GAIN: f64 = 1.08;

/// Where one more pair would tell most, given those there are and the row `axis` of the mirror axis; `None` where
/// none would help by a twelfth, or no point above the axis can show its reflection inside the picture.
#[must_use]
pub fn advise(pairs: &[ReflectionPair], axis: f64, size: UVec2) -> Option<Advice> {
    let size = size.as_dvec2();
    if !(axis > 0.0 && axis < size.y) {
        return None;
    }
    let known: Vec<DVec2> = pairs
        .iter()
        .map(|pair| DVec2::new(pair.point.x(), pair.reflection.y() - pair.point.y()))
        .filter(|pair| pair.is_finite())
        .collect();
    let before = information(&known);
    // Reflections of what stands higher fall below the frame.
    let top = (2.0 * axis - size.y).max(0.0);
    let cell = DVec2::new(size.x / COLUMNS as f64, (axis - top) / ROWS as f64);
    let places = (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| (column, row)));
    let gains = places.map(|(column, row)| {
        let corner = DVec2::new(0.0, top) + cell * DVec2::new(column as f64, row as f64);
        let middle = corner + cell / 2.0;
        let mut with = known.clone();
        with.push(DVec2::new(middle.x, 2.0 * (axis - middle.y)));
        // Of the first pair alone, long ones are the best.
        let after = information(&with) + 1e-6 * with.last().map_or(0.0, |pair| pair.y * pair.y);
        (after, corner)
    });
    let (after, corner) = gains.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let gain = if before > 0.0 { (after / before).sqrt() } else { f64::INFINITY };
    if gain < LEAST_GAIN {
        return None;
    }
    let part = |share: f64, names: [&'static str; 3]| names[((share * 3.0) as usize).min(2)];
    let middle = corner + cell / 2.0;
    let side = part(middle.x / size.x, ["near the left border", "in the middle", "near the right border"]);
    let height = part((middle.y - top) / (axis - top), ["high up", "half way up", "just above the water"]);
    let better = if gain.is_finite() {
        format!("would tell the camera's tilt {:.0} % better", 100.0 * (gain - 1.0))
    } else {
        "would tell the camera's tilt, which nothing tells yet".to_owned()
    };
    Some(Advice {
        region: [PicturePoint(corner), PicturePoint(corner + cell)],
        gain,
        sentence: format!("one more pair {side}, of something {height}, {better}"),
    })
}

/// Σ L²·(u − ū)² of pairs (column, length).
fn information(pairs: &[DVec2]) -> f64 {
    let weight: f64 = pairs.iter().map(|pair| pair.y * pair.y).sum();
    if weight <= 0.0 {
        return 0.0;
    }
    let mean = pairs.iter().map(|pair| pair.y * pair.y * pair.x).sum::<f64>() / weight;
    pairs.iter().map(|pair| (pair.y * (pair.x - mean)).powi(2)).sum()
}
