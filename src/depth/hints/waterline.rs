//! Where the shore meets the water, by the depth of what stands there.

use glam::DVec2;

use super::median;
use crate::camera::PinholeCamera;
use crate::depth::frame::Level;
use crate::depth::map::DepthMap;
use crate::picture::{Mask, PicturePoint};

/// What stands within this part of the picture's height above the water's edge stands at the edge.
const ABOVE: f64 = 0.02;
/// Fewer columns with a known edge are no line.
const LEAST_COLUMNS: usize = 16;

/// The far edge of the water.
#[derive(Clone, Debug, PartialEq)]
pub struct Waterline {
    /// Where the mirror image meets what it mirrors, from left to right, at most one point a column.
    pub points: Vec<PicturePoint>,
    /// Slope of the line in the leveled picture, radians, > 0 falling to the right. 0 for a shore that runs across the
    /// view, if the camera's roll is right.
    pub tilt: f64,
    /// Its standard deviation, radians.
    pub deviation: f64,
}

/// The far waterline: below the depth of the lowest known pixels over the water's upper edge. `None` where there are
/// too few, or where sizes differ.
#[must_use]
pub fn waterline(map: &DepthMap, water: &Mask, camera: &PinholeCamera) -> Option<Waterline> {
    if water.size() != map.size || camera.intrinsics.size != map.size {
        return None;
    }
    let (width, height) = (map.size.x as usize, map.size.y as usize);
    let level = Level::of(camera);
    let above = ((ABOVE * height as f64) as usize).max(2);
    let edge = |x: usize| {
        let first = (0..height).find(|row| water.values()[row * width + x] > 127)?;
        let known = (first.saturating_sub(above)..first).filter(|row| map.is_known(row * width + x));
        let mut shifts: Vec<f64> =
            known.map(|row| map.shift(f64::from(map.distance[row * width + x]))).collect();
        let shift = median(&mut shifts)?;
        let across = level.place(PicturePoint::pixel_center(x as i64, first as i64))?.x;
        Some(DVec2::new(across, -(map.horizon.offset_px + 0.5 * shift)))
    };
    let line: Vec<DVec2> = (0..width).filter_map(edge).collect();
    if line.len() < LEAST_COLUMNS {
        return None;
    }
    // Theil and Sen's slope, of every point with the one half the line farther on.
    let half = line.len() / 2;
    let mut slopes: Vec<f64> = (0..line.len() - half)
        .map(|i| line[i + half] - line[i])
        .filter(|run| run.x > 0.0)
        .map(|run| -run.y / run.x)
        .collect();
    let slope = median(&mut slopes)?;
    let mut off: Vec<f64> = slopes.iter().map(|other| (other - slope).abs()).collect();
    // Columns next to each other err together; the line has about so many independent places.
    let places = (line.len() / (2 * above)).max(1) as f64;
    let spread = 1.48 * median(&mut off)?;
    Some(Waterline {
        points: line.iter().filter_map(|&at| level.picture_point(at)).collect(),
        tilt: slope.atan(),
        deviation: spread / places.sqrt(),
    })
}
