//! Flat bands from a depth map: a few upright planes, frontal or receding, each with what of the picture stands on it.
//!
//! As many as the depth supports and no more. A pixel takes the band of what it belongs to, by the distances measured in
//! it, by color, edges, and what it stands on. The masks are soft, follow the picture's edges, and sum to 1 wherever anything is banded.

mod cluster;
mod pieces;
mod planes;
mod receding;
mod soften;
mod spread;

use glam::DVec2;
use rayon::prelude::*;

use self::planes::{Plane, Sample, planes};
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
/// Shifts are averaged over squares, so many to the picture's width.
const PARTS: usize = 40;
/// Known pixels err together over this many, so that so many count as one.
const TOGETHER: f64 = 400.0;

/// A part of the background on one upright plane.
#[derive(Clone, Debug)]
pub struct DepthBand {
    /// Visible coverage.
    pub mask: Mask,
    /// Meters along −z, the mean of what a receding band shows; infinite for the sky.
    pub distance: f64,
    /// Standard deviation of the band's mean distance, the horizon's share included; infinite for the sky.
    pub deviation: f64,
    /// Where the plane meets the water as the camera that was given has it, from the mask's left end to its right one;
    /// `None` for the sky.
    pub contact: Option<[PicturePoint; 2]>,
    /// Whether the plane recedes along its contact line; else it is frontal.
    pub recedes: bool,
    /// Part of the band's pixels of which its distance was measured; the others belong to it by color, edges and what is below.
    pub measured: f64,
    /// The step from the next farther band, in pixels of shift over its standard deviation; `None` for the farthest, and
    /// where one of them recedes.
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
    let level = Level::of(camera);
    let across = |pixel: usize| {
        let point = PicturePoint::pixel_center((pixel % width) as i64, (pixel / width) as i64);
        level.place(point).map_or(f64::NAN, |at| at.x)
    };
    let sample =
        |pixel: usize| Sample { across: across(pixel), shift: shift(pixel), variance: variance(pixel) };
    let samples: Vec<Sample> = known.par_iter().map(|&pixel| sample(pixel)).collect();
    let most = options.most.clamp(1, MOST);
    let found = planes(&samples, most, options.least_step_px.max(MEASURED_PX), map.sky.is_some());
    if found.is_empty() {
        return Vec::new();
    }
    // Label 0 is the sky, the others count from far to near.
    let sky = |pixel: usize| map.sky.as_ref().is_some_and(|sky| sky.values()[pixel] > 127);
    let seeds: Vec<Option<u8>> = (0..count)
        .into_par_iter()
        .map(|pixel| match () {
            () if !inside(pixel) => None,
            () if sky(pixel) => Some(0),
            () if is_known(pixel) => nearest(&found, &sample(pixel)).map(|plane| plane as u8 + 1),
            () => None,
        })
        .collect();
    let seeds = without_few(seeds, found.len() + 1);
    // Prolonged, a receding plane would run to the horizon on one side and past the camera on the other.
    let bounds: Vec<[f64; 2]> = found.iter().map(Plane::bounds).collect();
    let may = |pixel: usize, label: usize| {
        let plane = label.checked_sub(1).filter(|&plane| found[plane].recedes());
        plane.is_none_or(|plane| (bounds[plane][0]..=bounds[plane][1]).contains(&across(pixel)))
    };
    let labels = spread(width, picture.pixels(), &inside, &may, &seeds);
    let guide =
        Guide::of(width, picture.pixels().par_iter().map(|&c| luma(c.map(f32::from)) / 255.0).collect());
    // A measured pixel of another band is an outlier: it says nothing of any.
    let agrees = |pixel: usize, label: u8| labels[pixel] == Some(label) && seeds[pixel] == Some(label);
    let used: Vec<u8> =
        (0..=found.len() as u8).filter(|&label| (0..count).any(|pixel| agrees(pixel, label))).collect();
    let soft: Vec<Vec<f32>> = used
        .iter()
        .map(|&label| {
            guide.soften(&labels.iter().map(|&l| f32::from(u8::from(l == Some(label)))).collect::<Vec<_>>())
        })
        .collect();
    let total: Vec<f32> = (0..count).map(|pixel| soft.iter().map(|mask| mask[pixel]).sum()).collect();
    let middle = camera.intrinsics.principal.y();
    let mut made: Vec<DepthBand> = Vec::new();
    // Mean shift and its variance, of the last frontal one.
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
        let pixels: Vec<usize> = (0..count).filter(|&pixel| own(pixel)).collect();
        let (mean, own_variance) = match label {
            0 => (0.0, 0.0),
            _ => (mean(width, &pixels, &measured, &shift), mean_variance(&measured, &variance)),
        };
        let plane = label.checked_sub(1).map(|plane| found[usize::from(plane)]);
        let recedes = plane.is_some_and(|plane| plane.recedes());
        let plane = plane
            .map(|plane| if recedes { refined(plane, &measured, &sample) } else { Plane::frontal(mean) });
        let step = before
            .filter(|_| !recedes)
            .map(|(other, variance)| (mean - other) / (variance + own_variance).sqrt().max(1e-6));
        before = Some((mean, own_variance)).filter(|_| !recedes);
        let deviation_px = (own_variance + 4.0 * map.horizon.deviation_px.powi(2)).sqrt();
        let distance = map.one_pixel / mean;
        made.push(DepthBand {
            contact: mask.bounds().zip(plane).and_then(|(bounds, plane)| {
                let [first, last] = plane.bounds();
                let end = |column: u32| {
                    let across =
                        level.place(PicturePoint::new(f64::from(column), middle))?.x.clamp(first, last);
                    level.picture_point(DVec2::new(across, -0.5 * plane.shift(across)))
                };
                Some([end(bounds.min.x)?, end(bounds.max.x)?])
            }),
            recedes,
            mask,
            distance,
            deviation: if label == 0 { f64::INFINITY } else { distance * deviation_px / mean },
            measured: measured.len() as f64 / pixels.len().max(1) as f64,
            step,
        });
    }
    made
}

/// The plane that a sample is nearest to.
fn nearest(planes: &[Plane], sample: &Sample) -> Option<usize> {
    let off = |plane: &Plane| plane.off(sample.across, sample.shift);
    let best = planes.iter().enumerate().min_by(|a, b| off(a.1).total_cmp(&off(b.1)));
    best.filter(|(_, plane)| off(plane).is_finite()).map(|(index, _)| index)
}

/// A receding plane by all that was measured of its band.
fn refined(plane: Plane, measured: &[usize], sample: &dyn Fn(usize) -> Sample) -> Plane {
    let samples: Vec<Sample> = measured.iter().map(|&pixel| sample(pixel)).collect();
    Plane::through(&samples, plane.reach).unwrap_or(plane)
}

/// Shifts are never known better than this, pixels.
const MEASURED_PX: f64 = 0.1;

/// Mean shift of a band's pixels by those that were measured: parts of the picture count as much as the band covers of
/// them. What is nearer and lower is mirrored more freely, and so measured more often, than what is farther off.
fn mean(width: usize, pixels: &[usize], measured: &[usize], shift: &dyn Fn(usize) -> f64) -> f64 {
    let side = (width / PARTS).max(1);
    let columns = width.div_ceil(side);
    let part = |pixel: usize| pixel / width / side * columns + pixel % width / side;
    let count = pixels.last().map_or(0, |&last| part(last / width * width + width - 1) + 1);
    // Pixels, measured ones, and the sum of their shifts.
    let mut parts = vec![[0.0; 3]; count];
    pixels.iter().for_each(|&pixel| parts[part(pixel)][0] += 1.0);
    for &pixel in measured {
        let [_, count, sum] = &mut parts[part(pixel)];
        (*count, *sum) = (*count + 1.0, *sum + shift(pixel));
    }
    let known = parts.iter().filter(|[_, count, _]| *count > 0.0);
    let (all, sum) = known.fold((0.0, 0.0), |(all, sum), [pixels, count, shifts]| {
        (all + pixels, sum + pixels * shifts / count)
    });
    sum / f64::max(all, 1.0)
}

/// Variance of the mean shift of some pixels.
fn mean_variance(measured: &[usize], variance: &dyn Fn(usize) -> f64) -> f64 {
    let count = measured.len().max(1) as f64;
    let own = measured.iter().map(|&pixel| variance(pixel)).sum::<f64>() / count;
    own / (count / TOGETHER).max(1.0)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_seldom_measured_counts_as_much_as_it_is_seen() {
        // Of ten rows every pixel was measured, of ten more one in each part, and of the rest none.
        let pixels: Vec<usize> = (0..25 * 80).collect();
        let is_first = |pixel: usize| (pixel % 80).is_multiple_of(2) && (pixel / 80).is_multiple_of(2);
        let measured: Vec<usize> = (0..20 * 80).filter(|&pixel| pixel < 10 * 80 || is_first(pixel)).collect();
        let found = mean(80, &pixels, &measured, &|pixel| if pixel < 10 * 80 { 10.0 } else { 20.0 });
        assert!((found - 15.0).abs() < 1e-9, "{found}");
    }
}
