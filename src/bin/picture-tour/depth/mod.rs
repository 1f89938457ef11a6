//! What the water's mirror image tells: for `check`, as values; and as a picture. Tables of it are in `tables`.

mod tables;

pub(crate) use tables::table_of_bands;
pub(crate) use tables::write;

use std::borrow::Cow;
use std::path::Path;

use bevy_picture_tour::assemble::AssembledTour;
use bevy_picture_tour::assemble::StandingHint;
use bevy_picture_tour::assemble::TourSource;
use bevy_picture_tour::assemble::background_mask;
use bevy_picture_tour::assemble::hints;
use bevy_picture_tour::assemble::measure_depth;
use bevy_picture_tour::depth::Agreement;
use bevy_picture_tour::depth::BandOptions;
use bevy_picture_tour::depth::DepthBand;
use bevy_picture_tour::depth::bands;
use bevy_picture_tour::depth::paint;
use bevy_picture_tour::picture::PngPixels;
use bevy_picture_tour::picture::save_png;
use bevy_picture_tour::plugin::TourAsset;
use bevy_picture_tour::solve::Solution;
use serde::Serialize;

use crate::failure::Failure;
use crate::open;
use crate::open::Opened;

/// What the mirror image tells.
#[derive(Debug, Serialize)]
pub(crate) struct MirrorImage {
    /// Whether the water shows one; the rest is empty when it does not.
    pub(crate) found: bool,
    /// Part of what is not water whose distance is known.
    pub(crate) known: f64,
    /// How far it puts the horizon below the solved one, pixels, and the standard deviation.
    pub(crate) horizon_offset_px: [f64; 2],
    /// What stands upright, against its contact line.
    pub(crate) standing: Vec<Standing>,
    /// The bands that the background could be cut into, far to near.
    pub(crate) bands: Vec<MeasuredBand>,
    /// Slope of the far waterline against a level one, and its standard deviation; above 0 it falls to the right.
    pub(crate) waterline_tilt_deg: Option<[f64; 2]>,
    /// The camera with the pairs that the mirror image shows.
    pub(crate) by_pairs: Option<ByPairs>,
}

/// An upright component by its marks and by its mirror image.
#[derive(Debug, Serialize)]
pub(crate) struct Standing {
    pub(crate) name: String,
    /// By its contact line, meters.
    pub(crate) distance: f64,
    /// By its mirror image, and its standard deviation, meters; none where too little is known.
    pub(crate) mirrored: Option<[f64; 2]>,
    /// Part of it that is known.
    pub(crate) known: f64,
    /// `agrees`, `wrong foot`, `not flat` or `unknown`.
    pub(crate) verdict: &'static str,
}

/// A band that the mirror image shows.
#[derive(Debug, Serialize)]
pub(crate) struct MeasuredBand {
    /// Meters; none for the sky.
    pub(crate) distance: Option<f64>,
    pub(crate) deviation: Option<f64>,
    /// Part of it that was measured; the rest belongs to it by color and edges.
    pub(crate) measured: f64,
    /// Whether the step from the next farther one is more than chance.
    pub(crate) real: bool,
    /// Whether it recedes along its contact line.
    pub(crate) recedes: bool,
}

/// The camera by the marks and by all pairs that the mirror image shows.
#[derive(Debug, Serialize)]
pub(crate) struct ByPairs {
    pub(crate) pairs: usize,
    /// By marks and pairs, and standard deviation, degrees.
    pub(crate) pitch_deg: [f64; 2],
    pub(crate) roll_deg: [f64; 2],
    /// What the marks alone give.
    pub(crate) marked_pitch_deg: f64,
    pub(crate) marked_roll_deg: f64,
}

/// The files of a tour that was opened, also where a bake of it is used; `None` when there is nothing but a bake.
pub(crate) fn source_of<'a>(
    opened: &'a Opened,
    path: Option<&Path>,
) -> Result<Option<Cow<'a, TourSource>>, Failure> {
    match (&opened.asset, path) {
        (TourAsset::Source(source, _), _) => Ok(Some(Cow::Borrowed(source.as_ref()))),
        (TourAsset::Built(..), Some(path)) if path.extension().is_none_or(|ending| ending != "baked") => {
            open::on_disk(path)?.source().map(|source| Some(Cow::Owned(source))).map_err(Failure::Problems)
        }
        (TourAsset::Built(..), _) => Ok(None),
    }
}

/// Measures what the mirror image tells, and draws it; `None` without water, or where nothing can be measured.
pub(crate) fn measured(
    source: &TourSource,
    tour: &AssembledTour,
    picture: Option<&Path>,
) -> Result<Option<MirrorImage>, Failure> {
    let camera = &tour.scene.camera;
    let bar = open::bar("measuring the mirror image");
    let map = measure_depth(source, camera, &|share| {
        bar.set_position((100.0 * share) as u64);
        true
    });
    bar.finish_and_clear();
    let Ok(Some(map)) = map else {
        return match picture {
            Some(path) => Err(Failure::CannotRun(format!(
                "{} cannot be drawn: without water below a horizon there is no mirror image",
                path.display()
            ))),
            None => Ok(None),
        };
    };
    if let Some(path) = picture {
        let painted = paint(&source.picture, &map);
        save_png(path, painted.size(), PngPixels::Rgb(painted.pixels()))
            .map_err(|error| Failure::CannotRun(error.to_string()))?;
    }
    let water = source.water.as_ref();
    let dry = water.map_or(0, |water| water.values().iter().filter(|&&coverage| coverage <= 127).count());
    let known = (0..map.distance.len()).filter(|&pixel| map.is_known(pixel)).count();
    let hints = hints(source, &tour.scene, &map);
    let bands = water.map_or_else(Vec::new, |water| {
        let behind = background_mask(source);
        bands(&source.picture, &behind, water, camera, &map, &BandOptions::default())
    });
    Ok(Some(MirrorImage {
        found: map.has_mirror,
        known: known as f64 / dry.max(1) as f64,
        horizon_offset_px: [map.horizon.offset_px, map.horizon.deviation_px],
        standing: hints.standing.iter().map(Standing::of).collect(),
        bands: bands.iter().map(MeasuredBand::of).collect(),
        waterline_tilt_deg: hints.waterline.map(|line| [line.tilt, line.deviation].map(f64::to_degrees)),
        by_pairs: hints.by_pairs.map(|by| ByPairs::of(hints.pairs.len(), &by, &tour.solution)),
    }))
}

impl Standing {
    fn of(hint: &StandingHint) -> Self {
        let by = hint.by_mirror;
        let verdict = match by.agreement {
            Agreement::Agrees => "agrees",
            Agreement::WrongFoot => "wrong foot",
            Agreement::NotFlat => "not flat",
            Agreement::Unknown => "unknown",
        };
        let mirrored = (by.agreement != Agreement::Unknown)
            .then_some([hint.distance * by.ratio, hint.distance * by.deviation]);
        Self { name: hint.name.clone(), distance: hint.distance, mirrored, known: by.known, verdict }
    }
}

impl MeasuredBand {
    fn of(band: &DepthBand) -> Self {
        let finite = |value: f64| Some(value).filter(|value| value.is_finite());
        Self {
            distance: finite(band.distance),
            deviation: finite(band.deviation),
            measured: band.measured,
            real: band.is_real(),
            recedes: band.recedes,
        }
    }
}

impl ByPairs {
    fn of(pairs: usize, by: &Solution, marked: &Solution) -> Self {
        let angle = |name: &str, value: f64| {
            let deviation = by.report.parameter(name).and_then(|parameter| parameter.deviation);
            [value.to_degrees(), deviation.unwrap_or(0.0).to_degrees()]
        };
        Self {
            pairs,
            pitch_deg: angle("pitch", by.parameters.pitch),
            roll_deg: angle("roll", by.parameters.roll),
            marked_pitch_deg: marked.parameters.pitch.to_degrees(),
            marked_roll_deg: marked.parameters.roll.to_degrees(),
        }
    }
}

/// Bands as they are told.
pub(crate) fn told(bands: &[DepthBand]) -> Vec<MeasuredBand> {
    bands.iter().map(MeasuredBand::of).collect()
}
