//! Holds the whole road against a world with known answers: solves it from its annotations, renders views that the
//! picture never saw, and prints how far they are from the truth.
//!
//! `cargo run --release --features app --example evaluate -- WORLD_DIR [--reference] [--known-focal]
//! [--bands auto|none] [--method paper] [--fill smooth] [--out DIR] [--json FILE]`
#![expect(clippy::print_stdout, reason = "a program prints")]

mod uncovered;
mod world;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use bevy_picture_tour::assemble::{AssembledTour, CutOptions, TourSource, assemble, cut_bands};
use bevy_picture_tour::camera::PinholeCamera;
use bevy_picture_tour::headless::HeadlessTour;
use bevy_picture_tour::maps::{Fill, MapOptions, Method};
use bevy_picture_tour::picture::{Picture, PngPixels, encode_png, save_png};
use bevy_picture_tour::plugin::TourAsset;
use bevy_picture_tour::tour::{RelativePath, Tour};
use bevy_picture_tour::trace::Reference;
use bevy_picture_tour::trace::compare::Comparison;
use clap::Parser;
use serde_json::{Value, json};

use world::World;

/// Measures a world with known answers.
#[derive(Parser)]
struct Args {
    /// The world's folder, with its `scene.json`.
    world: PathBuf,
    /// Renders with the reference tracer instead of the GPU.
    #[arg(long)]
    reference: bool,
    /// Tells the solver the focal length: a level picture does not show it.
    #[arg(long)]
    known_focal: bool,
    /// Where the background's bands come from.
    #[arg(long, value_enum, default_value_t = Bands::File)]
    bands: Bands,
    /// How reflection maps are made.
    #[arg(long, value_enum, default_value_t = MethodName::Ours)]
    method: MethodName,
    /// How holes are filled.
    #[arg(long, value_enum, default_value_t = FillName::Patches)]
    fill: FillName,
    /// Writes the frames here.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Writes the figures here, as JSON.
    #[arg(long)]
    json: Option<PathBuf>,
}

/// The first views are moves by 10 % of the nearest object's distance, to the left and to the right.
const SMALL_MOVES: usize = 2;

/// Where the background's bands come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Bands {
    /// What `scene.json` says.
    File,
    /// What the picture's mirror image shows.
    Auto,
    /// One plane for the whole background.
    None,
}

/// How reflection maps are made.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum MethodName {
    /// They know what the water showed, and predict the rest.
    Ours,
    /// The paper's: read from the filled picture.
    Paper,
}

/// How holes are filled.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum FillName {
    /// Patches of what the component shows elsewhere.
    Patches,
    /// A smooth mean of what is around.
    Smooth,
}

impl Args {
    fn options(&self) -> MapOptions {
        let fill = match self.fill {
            FillName::Patches => Fill::Patches,
            FillName::Smooth => Fill::Smooth,
        };
        match self.method {
            MethodName::Ours => MapOptions { fill, ..MapOptions::default() },
            MethodName::Paper => MapOptions { method: Method::Paper, fill, paint_beyond: false },
        }
    }
}

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let args = Args::parse();
    let world = World::open(&args.world)?;
    let tour = world.tour(args.known_focal, args.bands == Bands::File)?;
    let mut source = TourSource::read(&tour, &|file| world.read(file.as_str()))?;
    if args.bands == Bands::Auto {
        source = with_bands(&world, &tour, &source)?;
    }
    let source = Arc::new(source);
    let started = Instant::now();
    let built = Arc::new(assemble(&source, &args.options(), &|_, _| true)?);
    let seconds_for_maps = started.elapsed().as_secs_f64();
    for remark in built.remarks.iter().chain(&built.solution.report.remarks) {
        println!("remark: {remark}");
    }

    let mut renderer = Renderer::new(&args, &source, &built)?;
    let name = if args.reference { "reference" } else { "gpu" };
    let own = built.scene.camera;
    let first = renderer.render(&own)?;
    let exact = Comparison::of(&first, &source.picture)?;
    println!(
        "first view ({name}): at most {} codes off, {:.4} % within 1",
        exact.max_code_difference,
        100.0 * exact.share_within(1)
    );
    keep(&args, "first_view", &first)?;

    let made_up = uncovered::made_up(&built.maps, &source.picture);
    let showing_made_up = Reference::new(&built.scene, &made_up);
    let mut uncovered = Vec::new();
    let mut views = Vec::new();
    let started = Instant::now();
    let mut rendering = 0.0;
    for view in &world.views {
        let before = started.elapsed().as_secs_f64();
        let camera = PinholeCamera { pose: view.pose, ..own };
        let frame = renderer.render(&camera)?;
        rendering += started.elapsed().as_secs_f64() - before;
        let truth = world.picture(&view.file)?;
        let all = Comparison::of(&frame, &truth)?;
        let water = match &view.water_mask {
            Some(mask) => Comparison::over(&frame, &truth, &world.mask(mask, truth.size())?).ok(),
            None => None,
        };
        let water = water.map(|water| (water.psnr, water.ssim));
        println!("{}  {}", view.file, figures(all.psnr, all.ssim, water));
        if uncovered.len() < SMALL_MOVES {
            let mask = uncovered::mask(&showing_made_up.render(&camera, 1));
            let found = mask.and_then(|mask| Comparison::over(&frame, &truth, &mask).ok());
            if let Some(found) = &found {
                println!("  {} px that the move uncovers: {:.2} dB", found.pixels, found.psnr);
            }
            uncovered.push(found.map(|found| (found.pixels, found.psnr)));
        }
        keep(&args, &view.name(), &frame)?;
        views.push((all.psnr, all.ssim, water));
    }
    let mean = mean_of(views.iter());
    println!("mean of {} views  {}", views.len(), figures(mean.0, mean.1, mean.2));
    let safe = mean_of(views.iter().enumerate().filter(|(i, _)| ![4, 7].contains(i)).map(|(_, view)| view));
    println!(
        "mean without views 5 and 8, which a wrong focal length spoils  {}",
        figures(safe.0, safe.1, safe.2)
    );

    let solver = solver(&world, &built);
    let per_view = if views.is_empty() { 0.0 } else { rendering / views.len() as f64 };
    println!("maps {seconds_for_maps:.2} s, a view {per_view:.3} s");
    if let Some(path) = &args.json {
        let report = json!({
            "world": world.name,
            "renderer": name,
            "first_view": {
                "max_code_difference": exact.max_code_difference,
                "share_within_1": exact.share_within(1),
            },
            "views": world.views.iter().zip(&views).map(|(view, found)| {
                let mut entry = entry(found);
                entry["file"] = json!(view.file);
                entry
            }).collect::<Vec<_>>(),
            "uncovered_by_small_moves": uncovered.iter().flatten().map(|(pixels, psnr)| {
                json!({ "pixels": pixels, "psnr": psnr })
            }).collect::<Vec<_>>(),
            "mean": entry(&mean),
            "mean_without_5_and_8": entry(&safe),
            "solver": solver,
            "seconds": { "maps": seconds_for_maps, "per_view": per_view },
        });
        std::fs::write(path, serde_json::to_string_pretty(&report)?)?;
    }
    Ok(())
}

/// The tour with the bands that its mirror image shows.
fn with_bands(world: &World, tour: &Tour, source: &TourSource) -> Result<TourSource, Failure> {
    let options = CutOptions { folder: RelativePath::new("found")?, anew: false };
    let started = Instant::now();
    let cut = cut_bands(tour, source, &options, &|_| true)?;
    println!("bands found in {:.2} s, far to near:", started.elapsed().as_secs_f64());
    for band in &cut.bands {
        println!("  {:.1} ± {:.1} m, {:.0} % measured", band.distance, band.deviation, 100.0 * band.measured);
    }
    let read = |file: &RelativePath| match cut.masks.iter().find(|(path, _)| path == file) {
        Some((_, mask)) => {
            encode_png(mask.size(), PngPixels::Gray(mask.values())).map_err(|error| error.to_string())
        }
        None => world.read(file.as_str()),
    };
    Ok(TourSource::read(&cut.tour, &read)?)
}

/// PSNR and SSIM over the frame, and over water pixels if there are any.
type Figures = (f64, f64, Option<(f64, f64)>);

fn figures(psnr: f64, ssim: f64, water: Option<(f64, f64)>) -> String {
    let water =
        water.map_or_else(|| "no water".to_owned(), |(psnr, ssim)| format!("{psnr:6.2} dB {ssim:.4}"));
    format!("whole {psnr:6.2} dB {ssim:.4}   water {water}")
}

fn entry((psnr, ssim, water): &Figures) -> Value {
    json!({ "psnr": psnr, "ssim": ssim, "psnr_water": water.map(|w| w.0), "ssim_water": water.map(|w| w.1) })
}

fn mean_of<'a>(views: impl Iterator<Item = &'a Figures>) -> Figures {
    let views: Vec<&Figures> = views.collect();
    let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len().max(1) as f64;
    let water: Vec<(f64, f64)> = views.iter().filter_map(|view| view.2).collect();
    (
        mean(views.iter().map(|view| view.0).collect()),
        mean(views.iter().map(|view| view.1).collect()),
        (!water.is_empty())
            .then(|| (mean(water.iter().map(|w| w.0).collect()), mean(water.iter().map(|w| w.1).collect()))),
    )
}

/// What the solver found, against the truth.
fn solver(world: &World, built: &AssembledTour) -> Value {
    let mut found = serde_json::Map::new();
    for parameter in &built.solution.report.parameters {
        let Some(truth) = world.truth(parameter.name) else { continue };
        let deviation = parameter.deviation.map_or_else(|| "unknown".to_owned(), |sd| format!("{sd:.4}"));
        println!(
            "{:20} {:10.4}  truth {truth:10.4}  ± {deviation}  {:?}",
            parameter.name, parameter.value, parameter.label
        );
        found.insert(
            parameter.name.to_owned(),
            json!({
                "value": parameter.value,
                "truth": truth,
                "deviation": parameter.deviation,
                "label": parameter.label,
            }),
        );
    }
    Value::Object(found)
}

enum Renderer<'a> {
    Gpu(Box<HeadlessTour>),
    Reference(Reference<'a>),
}

impl<'a> Renderer<'a> {
    fn new(args: &Args, source: &TourSource, built: &'a Arc<AssembledTour>) -> Result<Self, Failure> {
        if args.reference {
            return Ok(Self::Reference(Reference::new(&built.scene, &built.maps)));
        }
        let size = source.picture.size();
        let tour = TourAsset::Built(Box::new(source.tour.clone()), Arc::clone(built));
        Ok(Self::Gpu(Box::new(HeadlessTour::new(tour, size, bevy::prelude::Transform::default())?)))
    }

    fn render(&mut self, camera: &PinholeCamera) -> Result<Picture, Failure> {
        Ok(match self {
            Self::Gpu(headless) => headless.render(camera)?,
            Self::Reference(reference) => reference.render(camera, 1),
        })
    }
}

fn keep(args: &Args, name: &str, frame: &Picture) -> Result<(), Failure> {
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder)?;
        save_png(&folder.join(format!("{name}.png")), frame.size(), PngPixels::Rgb(frame.pixels()))?;
    }
    Ok(())
}
