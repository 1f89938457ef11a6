//! Cuts a tour's background into the bands that its mirror image shows.
//!
//! The document changes, nothing else: bands are written as a person would mark them, near ones first, the farthest
//! without a region, so that it shows whatever no other claims. What the mirror image does not support is not cut.

use glam::{DVec2, UVec2};

use super::measure::{background_mask, depth_options, measure_depth};
use super::{TourSource, annotations};
use crate::camera::PinholeCamera;
use crate::depth::{BandOptions, DepthBand, DepthError, DepthMap, bands, measure};
use crate::picture::{Mask, Picture, PicturePoint};
use crate::solve::{SolveError, solve};
use crate::tour::{
    Background, BackgroundPlace, Band, Crop, Problems, Region, RelativePath, Sky, Tour, TourFile,
};

/// A tour whose background was cut.
#[derive(Clone, Debug)]
pub struct BandedTour {
    /// The document: it names [`masks`](Self::masks).
    pub tour: Tour,
    /// Files to be written beside the tour before it is read, of the size of the picture before its crop.
    pub masks: Vec<(RelativePath, Mask)>,
    /// What was found, far to near, the sky first where there is one; each step between those
    /// that stand somewhere is more than chance. A background that stays whole is one.
    pub bands: Vec<DepthBand>,
}

/// Why a background is not cut.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BandError {
    /// Nothing mirrors.
    #[error("the tour has no water, so no mirror image tells distances; mark the water")]
    NoWater,
    /// The tour has bands, which stay as they are.
    #[error("the background has bands already")]
    HasBands,
    /// The mirror image is too poor.
    #[error("the water shows no mirror image of the background that could be matched; mark bands by hand")]
    NoMirror,
    /// Only this part of the background was measured, which says too little of the rest.
    #[error("only {:.0} % of the background could be measured by its mirror image; mark bands by hand", 100.0 * .0)]
    TooLittle(f64),
    /// The marks do not fix a camera.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// Nothing can be measured with this camera, or the work was cancelled.
    #[error(transparent)]
    Depth(#[from] DepthError),
    /// The folder's name cannot stand in a tour.
    #[error("{0:?} cannot stand in a tour; rename the tour")]
    Folder(String),
    /// The banded tour would have problems.
    #[error(transparent)]
    Problems(#[from] Problems),
}

/// With less of the background measured, its bands would be the colors' guess.
const LEAST_MEASURED: f64 = 0.2;

/// How to cut a tour's background.
#[derive(Clone, Debug)]
pub struct CutOptions {
    /// The folder of the masks, as the tour names it.
    pub folder: RelativePath,
    /// Whether to cut anew what has bands already.
    pub anew: bool,
}

/// Cuts the background of a tour by its mirror image.
///
/// `tour` is the document, `source` the same with its files read. A background at one distance stays whole: only its
/// distance is set. A sky becomes the tour's own, unless one is marked. Reflection pairs on the background move to the band
/// that they are on. `progress` hears the share done, 0–1, and cancels with `false`.
///
/// # Errors
///
/// See [`BandError`]; the tour is then best left as it is.
pub fn cut_bands(
    tour: &Tour,
    source: &TourSource,
    options: &CutOptions,
    progress: &dyn Fn(f32) -> bool,
) -> Result<BandedTour, BandError> {
    if !tour.background.bands.is_empty() && !options.anew {
        return Err(BandError::HasBands);
    }
    let cut = cut_once(tour, source, options, &|share| progress(0.5 * share))?;
    let on_background = |on: &Option<String>| on.as_deref().is_some_and(|on| is_of_background(tour, on));
    let pairs = source.tour.water.as_ref().map_or(&[][..], |water| &water.pairs);
    let is_flat = standing(&cut.bands).count() < 2 && !standing(&cut.bands).any(|band| band.recedes);
    if is_flat || !pairs.iter().any(|pair| on_background(&pair.on)) {
        return Ok(cut);
    }
    // Pairs at several distances were solved as if they had one, and all distances are measured with the camera that
    // gave.
    let mut file = source.tour.to_file();
    for pair in file.water.iter_mut().flat_map(|water| &mut water.pairs) {
        pair.on = pair.on.take().filter(|on| !is_of_background(tour, on));
    }
    let freed = TourSource { tour: Tour::check(file)?, ..source.clone() };
    cut_once(tour, &freed, options, &|share| progress(0.5 + 0.5 * share))
}

/// Whether a pair's `on` names the background or one of its bands.
fn is_of_background(tour: &Tour, on: &str) -> bool {
    on == "background" || tour.background.bands.iter().any(|band| band.name == on)
}

fn cut_once(
    tour: &Tour,
    source: &TourSource,
    options: &CutOptions,
    progress: &dyn Fn(f32) -> bool,
) -> Result<BandedTour, BandError> {
    let bands = measured_bands(source, MOST_PIXELS, progress)?;
    if standing(&bands).next().is_none() {
        return Err(BandError::NoMirror);
    }
    let share = measured_share(&bands);
    if share < LEAST_MEASURED {
        return Err(BandError::TooLittle(share));
    }
    let (file, masks) = written(tour, source, options, &bands)?;
    Ok(BandedTour { tour: Tour::check(file)?, masks, bands })
}

/// Pixels of the largest picture that is measured as it is: labels of every pixel and band take memory and time.
const MOST_PIXELS: f64 = 6e6;

/// The bands that a tour's mirror image shows; in a large picture they are looked for at a smaller size.
fn measured_bands(
    source: &TourSource,
    most_pixels: f64,
    progress: &dyn Fn(f32) -> bool,
) -> Result<Vec<DepthBand>, BandError> {
    let Some(water) = &source.water else { return Err(BandError::NoWater) };
    let whole = source.picture.size();
    let mut camera = solve(&annotations(source))?.parameters.camera(whole);
    let scale = (f64::from(whole.x) * f64::from(whole.y) / most_pixels).sqrt();
    if scale <= 1.0 {
        let map = measure_depth(source, &camera, progress)?.ok_or(BandError::NoWater)?;
        return Ok(real_bands(&source.picture, &background_mask(source), water, &camera, &map));
    }
    let size = (whole.as_dvec2() / scale).round().as_uvec2().max(UVec2::ONE);
    camera.intrinsics = camera.intrinsics.scaled_to(size);
    let (picture, water) = (source.picture.shrunk_to(size), water.shrunk_to(size));
    let options = depth_options(source, scale);
    let map = measure(&picture, &water, &camera, camera.pose.position.y, &options, progress)?;
    let mut found = real_bands(&picture, &background_mask(source).shrunk_to(size), &water, &camera, &map);
    for band in &mut found {
        band.mask = band.mask.enlarged_to(whole);
        let ratio = whole.as_dvec2() / size.as_dvec2();
        band.contact = band.contact.map(|line| line.map(|point| PicturePoint(point.0 * ratio)));
    }
    Ok(found)
}

/// Part of what stands somewhere whose distance was measured.
fn measured_share(bands: &[DepthBand]) -> f64 {
    let covered =
        |band: &DepthBand| band.mask.values().iter().map(|&coverage| f64::from(coverage)).sum::<f64>();
    let (measured, all) = standing(bands)
        .map(|band| (band.measured * covered(band), covered(band)))
        .fold((0.0, 0.0), |(measured, all), band| (measured + band.0, all + band.1));
    measured / all.max(1.0)
}

/// Bands whose steps are all more than chance.
fn real_bands(
    picture: &Picture,
    background: &Mask,
    water: &Mask,
    camera: &PinholeCamera,
    map: &DepthMap,
) -> Vec<DepthBand> {
    let mut options = BandOptions::default();
    loop {
        let found = bands(picture, background, water, camera, map, &options);
        // The farthest's step is that from the sky.
        if standing(&found).skip(1).all(DepthBand::is_real) {
            return found;
        }
        options.most = standing(&found).count() - 1;
    }
}

/// All but the sky, far to near.
fn standing(bands: &[DepthBand]) -> impl Iterator<Item = &DepthBand> {
    bands.iter().filter(|band| band.distance.is_finite())
}

/// The document with its bands, and their masks.
fn written(
    tour: &Tour,
    source: &TourSource,
    options: &CutOptions,
    bands: &[DepthBand],
) -> Result<(TourFile, Vec<(RelativePath, Mask)>), BandError> {
    let mut file = tour.to_file();
    let crop = tour.crop_in(source.uncropped_size);
    let mut masks = Vec::new();
    let mut region = |name: &str, mask: &Mask| {
        let path = format!("{}/{}.png", options.folder, name.replace(' ', "_"));
        let safe = RelativePath::new(&path).map_err(|_| BandError::Folder(path.clone()))?;
        masks.push((safe, uncropped(mask, crop, source.uncropped_size)));
        Ok::<_, BandError>(Region::Mask(path))
    };
    // What a person marked as sky stays it; else the one found becomes the tour's.
    if let Some(found) = bands.iter().find(|band| band.distance.is_infinite())
        && source.sky.is_none()
    {
        let drift = file.sky.and_then(|sky| sky.drift);
        file.sky = Some(Sky { region: Some(region("sky", &found.mask)?), drift });
    }
    let has_sky = file.sky.as_ref().is_some_and(|sky| sky.region.is_some());
    let standing: Vec<&DepthBand> = standing(bands).collect();
    file.background = Background::default();
    let mut names = Vec::new();
    match standing.as_slice() {
        [one] if !(one.recedes && has_sky) => {
            file.background.place = Some(BackgroundPlace::Distance(one.distance));
        }
        [farthest, nearer @ ..] => {
            let is_taken = |name: &str| tour.objects.iter().any(|object| object.name == name);
            let free = (1..).map(|i| format!("band {i}")).filter(|name| !is_taken(name));
            // Near ones first.
            for (band, name) in nearer.iter().rev().chain([farthest]).zip(free) {
                let line = contact_line(tour, source, band);
                // What has no region is prolonged without end: a receding plane has one, before the sky.
                let shows_the_rest = std::ptr::eq(*band, *farthest) && (line.is_none() || !has_sky);
                let region = if shows_the_rest { None } else { Some(region(&name, &band.mask)?) };
                let place = match line.filter(|_| !shows_the_rest) {
                    Some(line) => BackgroundPlace::Contact(line),
                    None => BackgroundPlace::Distance(band.distance),
                };
                file.background.bands.push(Band { name: name.clone(), region, place });
                names.push((name, *band));
            }
        }
        [] => {}
    }
    move_pairs(tour, source, &mut file, &names);
    Ok((file, masks))
}

/// Where a receding band meets the water, in the document's pixels; `None` for others, and where that is not below the
/// horizon that a person marked.
fn contact_line(tour: &Tour, source: &TourSource, band: &DepthBand) -> Option<Vec<PicturePoint>> {
    let line = band.contact.filter(|_| band.recedes)?;
    let uncropped = source.uncropped_size;
    let crop = tour.crop_in(uncropped);
    let corner = UVec2::new(crop.left, crop.top).as_dvec2();
    let ratio = tour.picture.size.map_or(DVec2::ONE, |size| size.as_dvec2() / uncropped.as_dvec2());
    let line = line.map(|point| PicturePoint((point.0 + corner) * ratio));
    let is_below = |point: &PicturePoint| {
        tour.camera.horizon.is_none_or(|[a, b]| {
            let part = (point.x() - a.x()) / (b.x() - a.x());
            point.y() > a.y() + part * (b.y() - a.y())
        })
    };
    line.iter().all(is_below).then(|| line.to_vec())
}

/// Puts the background's pairs on the bands that show their points.
fn move_pairs(tour: &Tour, source: &TourSource, file: &mut TourFile, names: &[(String, &DepthBand)]) {
    let (Some(water), Some(used)) = (&mut file.water, &source.tour.water) else { return };
    for (pair, used) in water.pairs.iter_mut().zip(&used.pairs) {
        if !pair.on.as_deref().is_some_and(|on| is_of_background(tour, on)) {
            continue;
        }
        let shows = |(_, band): &&(String, &DepthBand)| band.mask.sample(used.point) >= 0.5;
        let was_whole = pair.on.as_deref() == Some("background") && names.is_empty();
        // A point between bands is on none of them for sure.
        pair.on =
            if was_whole { pair.on.take() } else { names.iter().find(shows).map(|(name, _)| name.clone()) };
    }
}

/// A mask of the part that is used, as one of the whole picture.
fn uncropped(mask: &Mask, crop: Crop, size: UVec2) -> Mask {
    let mut values = vec![0; size.x as usize * size.y as usize];
    let width = mask.size().x as usize;
    for (row, part) in mask.values().chunks_exact(width).enumerate() {
        let start = (crop.top as usize + row) * size.x as usize + crop.left as usize;
        values[start..start + width].copy_from_slice(part);
    }
    // The count is right by construction.
    Mask::new(size, values).unwrap_or_else(|_| mask.clone())
}

#[cfg(test)]
#[path = "bands_tests.rs"]
mod tests;
