//! The depth of an object against that of its contact line.

use super::median;
use crate::depth::map::DepthMap;
use crate::picture::{Mask, PicturePoint};

/// Fewer known pixels say nothing of an object, and neither does less than this part of it.
const LEAST_PIXELS: usize = 50;
const LEAST_SHARE: f64 = 0.1;
/// A difference of so many standard deviations is one.
const DIFFERENT: f64 = 3.0;
/// Parts of an object this far from its plane, as part of its distance, are no error of the foot: bodies have depth
/// (`solve` allows as much).
const BODY: f64 = 0.05;

/// What an object's mirror image says of its contact line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Agreement {
    /// Both put it at the same distance.
    Agrees,
    /// The object is flat, and stands elsewhere than its foot was marked.
    WrongFoot,
    /// Parts of it lie far before or behind its plane.
    NotFlat,
    /// Too little of its mirror image is known.
    Unknown,
}

/// An object's distance by its mirror image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectDepth {
    /// Median of distance by mirror image over distance by contact line, pixel by pixel; NaN if nothing is known.
    pub ratio: f64,
    /// Standard deviation of that ratio, the horizon's share included.
    pub deviation: f64,
    /// How far its parts stray from its plane: robust standard deviation of the same ratio over the object.
    pub spread: f64,
    /// Part of its pixels whose distance is known.
    pub known: f64,
    /// What follows.
    pub agreement: Agreement,
}

/// Compares what stands on a contact line with it. `contact` are the line's two ends in the picture, with their depths
/// in meters along −z, as the solver or the scene puts them.
#[must_use]
pub fn object_depth(map: &DepthMap, mask: &Mask, contact: [(PicturePoint, f64); 2]) -> ObjectDepth {
    let unknown = ObjectDepth {
        ratio: f64::NAN,
        deviation: f64::INFINITY,
        spread: f64::NAN,
        known: 0.0,
        agreement: Agreement::Unknown,
    };
    let [(left, near), (right, far)] = contact;
    let sound = near > 0.0 && far > 0.0 && near.is_finite() && far.is_finite();
    if mask.size() != map.size || !sound {
        return unknown;
    }
    let width = map.size.x as usize;
    let run = right.x() - left.x();
    // Along a line seen in perspective 1/depth is linear.
    let by_contact = |pixel: usize| {
        let x = (pixel % width) as f64 + 0.5;
        let t = if run.abs() > 1e-6 { (x - left.x()) / run } else { 0.5 };
        1.0 / ((1.0 - t) / near + t / far)
    };
    let covered: Vec<usize> = (0..map.distance.len()).filter(|&i| mask.values()[i] > 127).collect();
    let known: Vec<usize> =
        covered.iter().copied().filter(|&i| map.is_known(i) && by_contact(i) > 0.0).collect();
    let share = known.len() as f64 / covered.len().max(1) as f64;
    let mut ratios: Vec<f64> = known.iter().map(|&i| f64::from(map.distance[i]) / by_contact(i)).collect();
    let mut deviations: Vec<f64> =
        known.iter().map(|&i| f64::from(map.deviation[i]) / f64::from(map.distance[i])).collect();
    let (Some(ratio), Some(own)) = (median(&mut ratios), median(&mut deviations)) else { return unknown };
    let mut off: Vec<f64> = ratios.iter().map(|other| (other - ratio).abs()).collect();
    let spread = 1.48 * median(&mut off).unwrap_or(f64::NAN);
    let deviation = ratio * own;
    let agreement = if known.len() < LEAST_PIXELS || share < LEAST_SHARE {
        Agreement::Unknown
    } else if spread > DIFFERENT * deviation.max(BODY) {
        Agreement::NotFlat
    } else if (ratio - 1.0).abs() > DIFFERENT * deviation.hypot(BODY) {
        Agreement::WrongFoot
    } else {
        Agreement::Agrees
    };
    ObjectDepth { ratio, deviation, spread, known: share, agreement }
}
