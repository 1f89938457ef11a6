//! What the water's mirror image tells: for `check`, as values and as tables; and as a picture.

use std::borrow::Cow;
use std::io;
use std::io::Write;
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
use crate::table::Table;

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

/// Writes what the mirror image tells.
pub(crate) fn write(out: &mut impl Write, mirror: &MirrorImage) -> io::Result<()> {
    if !mirror.found {
        return writeln!(
            out,
            "\nDistances by the mirror image: none; the water shows nothing that could be matched"
        );
    }
    writeln!(
        out,
        "\nDistances by the mirror image: known of {:.0} % of what is not water",
        100.0 * mirror.known
    )?;
    let mut table = Table::new(["", "by its mark", "mirrored", "±", "known", ""]);
    for Standing { name, distance, mirrored, known, verdict } in &mirror.standing {
        let [by, deviation] = match mirrored {
            Some(values) => values.map(meters),
            None => std::array::from_fn(|_| "?".to_owned()),
        };
        let remark = match *verdict {
            "wrong foot" => "they disagree: check its contact line or distance",
            "not flat" => "parts of it stand at other distances",
            "unknown" => "too little is known to tell",
            _ => "",
        };
        let known = format!("{:.0} %", 100.0 * known);
        table.row([name.clone(), meters(*distance), by, deviation, known, remark.to_owned()]);
    }
    table.write(out)?;
    if !mirror.bands.is_empty() {
        writeln!(out, "\nWhat the background shows, far to near (`picture-tour bands` cuts it so)")?;
        table_of_bands(&mirror.bands).write(out)?;
    }
    let mut lines = Vec::new();
    let [offset, deviation] = mirror.horizon_offset_px;
    let side = if offset < 0.0 { "higher" } else { "lower" };
    lines.push(format!(
        "it puts the horizon {:.1} ± {deviation:.1} px {side} than the solution does",
        offset.abs()
    ));
    if let Some([tilt, deviation]) = mirror.waterline_tilt_deg {
        lines.push(format!("leveled, the far waterline falls by {tilt:+.2} ± {deviation:.2}° to the right (a shore across the view: 0°)"));
    }
    if let Some(by) = &mirror.by_pairs {
        let [pitch, pitch_deviation] = by.pitch_deg;
        let [roll, roll_deviation] = by.roll_deg;
        lines.push(format!(
            "with {} more pairs found in it the pitch is {pitch:.3} ± {pitch_deviation:.3}° (by the marks {:.3}°), the \
             roll {roll:.3} ± {roll_deviation:.3}° ({:.3}°)",
            by.pairs, by.marked_pitch_deg, by.marked_roll_deg
        ));
    }
    for line in lines {
        writeln!(out, "  - {line}")?;
    }
    Ok(())
}

/// A length with as many digits as it may deserve.
fn meters(value: f64) -> String {
    let decimals = if value < 1.0 { 2 } else { 1 };
    format!("{value:.decimals$} m")
}

/// Bands as a table, in the order they come.
pub(crate) fn table_of_bands(bands: &[MeasuredBand]) -> Table<4> {
    let mut table = Table::new(["", "±", "measured", ""]);
    for band in bands {
        let distance = band.distance.map_or_else(|| "sky".to_owned(), meters);
        let deviation = band.deviation.map_or_else(|| "-".to_owned(), meters);
        let measured = format!("{:.0} %", 100.0 * band.measured);
        let remark = if band.real { "" } else { "cannot be told from the one before" };
        table.row([distance, deviation, measured, remark.to_owned()]);
    }
    table
}

/// Bands as they are told.
pub(crate) fn told(bands: &[DepthBand]) -> Vec<MeasuredBand> {
    bands.iter().map(MeasuredBand::of).collect()
}
