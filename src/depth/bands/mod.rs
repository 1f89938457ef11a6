//! Flat bands from a depth map: upright planes at a few distances, each with what of the picture stands on it.
//!
//! As many as the depth supports and no more. A pixel takes the band of what it belongs to, by the distances measured in
//! it, by color, edges, and what it stands on. The masks are soft, follow the picture's edges, and sum to 1 wherever anything is banded.

mod cluster;
mod pieces;
mod soften;
mod spread;

use glam::DVec2;
use rayon::prelude::*;

use self::cluster::cluster;
use self::soften::Guide;
use self::spread::spread;
use super::frame::{Level, luma};
use super::map::DepthMap;
use super::plane::box_sum;
use crate::camera::PinholeCamera;
use crate::picture::{Mask, Picture, PicturePoint};

/// How to cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandOptions {
    /// Most bands, the sky not counted; 8 at most are made.
    pub most: usize,
    /// Least difference of two bands' shifts, pixels of the picture: smaller ones are not seen.
    pub least_step_px: f64,
}

impl Default for BandOptions {
    fn default() -> Self {
        Self { most: MOST, least_step_px: 1.5 }
    }
}

const MOST: usize = 8;
/// A step is real when it is this many times as large as its standard deviation.
const REAL: f64 = 3.0;
/// A band with less than this part of what is banded is an outlier.
const LEAST_SHARE: f64 = 0.01;
/// Outlines are overstepped by one part in so many of the picture's width.
const BEYOND_OUTLINE: usize = 80;
/// Known pixels err together over this many, so that so many count as one.
const TOGETHER: f64 = 400.0;

/// A part of the background at one distance.
#[derive(Clone, Debug)]
pub struct DepthBand {
    /// Visible coverage.
    pub mask: Mask,
    /// Meters along −z; infinite for the sky.
    pub distance: f64,
    /// Standard deviation of the band's mean distance, the horizon's share included; infinite for the sky.
    pub deviation: f64,
    /// Where the plane meets the water, from the mask's left end to its right one; `None` for the sky.
    pub contact: Option<[PicturePoint; 2]>,
    /// Part of the band's pixels whose distance was measured; the others belong to it by color and edges.
    pub measured: f64,
    /// The step from the next farther band, in pixels of shift over its standard deviation; `None` for the farthest.
    pub step: Option<f64>,
}

impl DepthBand {
    /// Whether the step from the next farther band is more than chance.
    #[must_use]
    pub fn is_real(&self) -> bool {
        self.step.is_none_or(|step| step >= REAL)
    }
}

/// Cuts what `background` covers into bands, far to near; the sky, where there is one, comes first.
///
/// `background` leaves out the water and all that stands in front; it may hold far ground. A backdrop at one distance is
/// one band. There is none without a mirror image, and none where the sizes of picture, masks and map differ.
#[must_use]
pub fn bands(
    picture: &Picture,
    background: &Mask,
    water: &Mask,
    camera: &PinholeCamera,
    map: &DepthMap,
    options: &BandOptions,
) -> Vec<DepthBand> {
    let size = picture.size();
    if !map.has_mirror || map.size != size || background.size() != size || water.size() != size {
        return Vec::new();
    }
    let width = size.x as usize;
    let inside = |pixel: usize| background.values()[pixel] > 127;
    let shift = |pixel: usize| map.shift(f64::from(map.distance[pixel]));
    // The horizon's error moves all shifts alike, so it makes no band.
    let variance = |pixel: usize| {
        let whole = shift(pixel) * f64::from(map.deviation[pixel]) / f64::from(map.distance[pixel]);
        (whole * whole - 4.0 * map.horizon.deviation_px.powi(2)).max(MEASURED_PX * MEASURED_PX)
    };
    let count = width * size.y as usize;
    // What stands in front is matched a little beyond its outline.
    let in_front: Vec<f32> =
        (0..count).map(|i| f32::from(u8::from(!inside(i) && water.values()[i] <= 127))).collect();
    let reach = (size.x as usize / BEYOND_OUTLINE).max(1);
    let near = box_sum(width, &in_front, reach, reach);
    let is_known = |pixel: usize| inside(pixel) && map.is_known(pixel) && near[pixel] == 0.0;
    let known: Vec<usize> = (0..count).filter(|&pixel| is_known(pixel)).collect();
    let shifts: Vec<(f64, f64)> = known.iter().map(|&pixel| (shift(pixel), variance(pixel))).collect();
    let found = cluster(&shifts, options.most.clamp(1, MOST), options.least_step_px.max(MEASURED_PX));
    if found.centers.is_empty() {
        return Vec::new();
    }
    // Label 0 is the sky, the others count from far to near.
    let sky = |pixel: usize| map.sky.as_ref().is_some_and(|sky| sky.values()[pixel] > 127);
    let seeds: Vec<Option<u8>> = (0..count)
        .into_par_iter()
        .map(|pixel| match () {
            () if !inside(pixel) => None,
            () if sky(pixel) => Some(0),
            () if is_known(pixel) => Some(found.nearest(shift(pixel)) as u8 + 1),
            () => None,
        })
        .collect();
    let seeds = without_few(seeds, found.centers.len() + 1);
    let labels = spread(width, picture.pixels(), &inside, &seeds);
    let guide =
        Guide::of(width, picture.pixels().par_iter().map(|&c| luma(c.map(f32::from)) / 255.0).collect());
    // A measured pixel of another band is an outlier: it says nothing of any.
    let agrees = |pixel: usize, label: u8| labels[pixel] == Some(label) && seeds[pixel] == Some(label);
    let used: Vec<u8> = (0..=found.centers.len() as u8)
        .filter(|&label| (0..count).any(|pixel| agrees(pixel, label)))
        .collect();
    let soft: Vec<Vec<f32>> = used
        .iter()
        .map(|&label| {
            guide.soften(&labels.iter().map(|&l| f32::from(u8::from(l == Some(label)))).collect::<Vec<_>>())
        })
        .collect();
    let total: Vec<f32> = (0..count).map(|pixel| soft.iter().map(|mask| mask[pixel]).sum()).collect();
    let level = Level::of(camera);
    let middle = camera.intrinsics.principal.y();
    let mut made: Vec<DepthBand> = Vec::new();
    let mut before: Option<(f64, f64)> = None;
    for (mask, &label) in soft.iter().zip(&used) {
        let own = |pixel: usize| labels[pixel] == Some(label);
        let coverage = (0..count).map(|pixel| {
            let part = mask[pixel] / total[pixel].max(1e-3);
            (part * f32::from(background.values()[pixel])).round() as u8
        });
        let Ok(mask) = Mask::new(size, coverage.collect()) else { continue };
        let measured: Vec<usize> =
            known.iter().copied().filter(|&pixel| label > 0 && agrees(pixel, label)).collect();
        let pixels = (0..count).filter(|&pixel| own(pixel)).count();
        let (mean, own_variance) = if label == 0 { (0.0, 0.0) } else { mean(&measured, &shift, &variance) };
        let step =
            before.map(|(other, variance)| (mean - other) / (variance + own_variance).sqrt().max(1e-6));
        before = Some((mean, own_variance));
        let deviation_px = (own_variance + 4.0 * map.horizon.deviation_px.powi(2)).sqrt();
        let distance = map.one_pixel / mean;
        made.push(DepthBand {
            contact: mask.bounds().filter(|_| label > 0).and_then(|bounds| {
                let below = map.horizon.offset_px + 0.5 * mean;
                let end = |column: u32| {
                    let across = level.place(PicturePoint::new(f64::from(column), middle))?.x;
                    level.picture_point(DVec2::new(across, -below))
                };
                Some([end(bounds.min.x)?, end(bounds.max.x)?])
            }),
            mask,
            distance,
            deviation: if label == 0 { f64::INFINITY } else { distance * deviation_px / mean },
            measured: measured.len() as f64 / pixels.max(1) as f64,
            step,
        });
    }
    made
}

/// Shifts are never known better than this, pixels.
const MEASURED_PX: f64 = 0.1;

/// Mean shift of some pixels, and its variance.
fn mean(pixels: &[usize], shift: &dyn Fn(usize) -> f64, variance: &dyn Fn(usize) -> f64) -> (f64, f64) {
    let count = pixels.len().max(1) as f64;
    let mean = pixels.iter().map(|&pixel| shift(pixel)).sum::<f64>() / count;
    let own = pixels.iter().map(|&pixel| variance(pixel)).sum::<f64>() / count;
    (mean, own / (count / TOGETHER).max(1.0))
}

/// Seeds without those labels that hardly any pixel has.
fn without_few(mut seeds: Vec<Option<u8>>, labels: usize) -> Vec<Option<u8>> {
    let mut counts = vec![0_usize; labels];
    for label in seeds.iter().flatten() {
        counts[usize::from(*label)] += 1;
    }
    let least = LEAST_SHARE * counts.iter().sum::<usize>() as f64;
    for seed in &mut seeds {
        *seed = seed.filter(|&label| counts[usize::from(label)] as f64 >= least);
    }
    seeds
}
