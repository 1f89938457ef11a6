//! Frames without a window: a camera that leans aside, on the GPU, into PNG files.
//!
//! `cargo run --release --features app --example headless_frames -- OUT_DIR`
#![expect(clippy::print_stdout, reason = "a program prints")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use bevy::prelude::Transform;
use bevy_picture_tour::assemble::TourSource;
use bevy_picture_tour::camera::{CameraPose, PinholeCamera};
use bevy_picture_tour::headless::HeadlessTour;
use bevy_picture_tour::picture::{PngPixels, save_png};
use glam::{DVec3, UVec2};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).map_or_else(|| PathBuf::from("frames"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    let source = Arc::new(TourSource::open(Path::new("assets/lake/lake.tour.ron"))?);
    let size = UVec2::new(960, 540);
    let mut tour = HeadlessTour::new(source, size, Transform::default())?;
    let own = tour.solved().ok_or("the tour is not ready")?.scene.camera;
    for frame in 0..5 {
        let aside = DVec3::X * (0.5 * f64::from(frame) - 1.0);
        let pose = CameraPose { position: own.pose.position + aside, ..own.pose };
        let picture = tour.render(&PinholeCamera { intrinsics: own.intrinsics.scaled_to(size), pose })?;
        let path = folder.join(format!("frame_{frame}.png"));
        save_png(&path, size, PngPixels::Rgb(picture.pixels()))?;
        println!("{}", path.display());
    }
    Ok(())
}
