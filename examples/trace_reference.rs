//! The reference image of a tour, traced on the CPU; needs neither Bevy nor a GPU.
//!
//! `cargo run --release --features app --example trace_reference -- OUT.png`
//! (`--no-default-features` instead of `--features app` builds it without Bevy.)
#![expect(clippy::print_stdout, reason = "a program prints")]

use std::path::{Path, PathBuf};

use bevy_picture_tour::assemble::{TourSource, assemble};
use bevy_picture_tour::camera::{CameraPose, PinholeCamera};
use bevy_picture_tour::maps::MapOptions;
use bevy_picture_tour::picture::{PngPixels, save_png};
use bevy_picture_tour::trace::Reference;
use glam::DVec3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = std::env::args().nth(1).map_or_else(|| PathBuf::from("reference.png"), PathBuf::from);
    let source = TourSource::open(Path::new("assets/lake/lake.tour.ron"))?;
    let built = assemble(&source, &MapOptions::default(), &|share, step| {
        println!("{:3.0} %  {step}", 100.0 * share);
        true
    })?;
    let own = built.scene.camera;
    let pose = CameraPose { position: own.pose.position + DVec3::new(1.2, 0.6, -1.0), ..own.pose };
    let picture = Reference::new(&built.scene, &built.maps).render(&PinholeCamera { pose, ..own }, 4);
    save_png(&out, picture.size(), PngPixels::Rgb(picture.pixels()))?;
    println!("{}", out.display());
    Ok(())
}
