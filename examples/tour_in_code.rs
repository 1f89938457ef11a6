//! A tour without a file: a picture painted by a loop, a few marks, and a camera on rails.
//!
//! `cargo run --release --features app --example tour_in_code`

use std::sync::Arc;

use bevy::math::{DVec3, UVec2};
use bevy::prelude::*;
use bevy_picture_tour::assemble::TourSource;
use bevy_picture_tour::picture::{PicturePoint, PngPixels, encode_png};
use bevy_picture_tour::prelude::*;
use bevy_picture_tour::tour::{
    Background, BackgroundPlace, CameraPath, Document, FocalLength, Keyframe, Motion, Object, Region,
    Support, Tour, WaterArea,
};

const SIZE: UVec2 = UVec2::new(640, 360);
const HORIZON: f64 = 150.0;
const SHORE: f64 = 165.0;

fn main() -> Result<AppExit, Box<dyn std::error::Error>> {
    let source = Arc::new(source()?);
    Ok(App::new()
        .add_plugins((DefaultPlugins, PictureTourPlugin))
        .add_systems(Startup, move |mut commands: Commands, mut tours: ResMut<Assets<TourAsset>>| {
            commands.spawn(PictureTour(tours.add(TourAsset::from(Arc::clone(&source)))));
            commands.spawn(TourCamera { guide: Guide::Path, ..default() });
        })
        .run())
}

/// The tour and its picture, checked like a file's.
fn source() -> Result<TourSource, Box<dyn std::error::Error>> {
    let point = PicturePoint::new;
    let mut tour = Document::new("painted.png".to_owned());
    tour.camera.horizon = Some([point(0.0, HORIZON), point(640.0, HORIZON)]);
    tour.camera.focal_length = FocalLength::Known(600.0);
    let lake = [(0.0, SHORE), (640.0, SHORE), (640.0, 360.0), (0.0, 360.0)];
    tour.water =
        Some(WaterArea { region: Region::Polygon(lake.map(|(x, y)| point(x, y)).into()), pairs: Vec::new() });
    tour.background = Background {
        place: Some(BackgroundPlace::Contact(vec![point(0.0, SHORE), point(640.0, SHORE)])),
        bands: Vec::new(),
    };
    let post = [(300.0, 120.0), (330.0, 120.0), (330.0, 250.0), (300.0, 250.0)];
    tour.objects.push(Object {
        name: "post".to_owned(),
        support: Support::Water,
        outline: Region::Polygon(post.map(|(x, y)| point(x, y)).into()),
        contact: [point(300.0, 250.0), point(330.0, 250.0)],
        turns_to_camera: false,
        motion: Motion::Static,
    });
    let keyframe = |x: f64| Keyframe {
        position: DVec3::new(x, 1.7, 0.0),
        yaw_deg: 0.0,
        pitch_deg: -2.9,
        roll_deg: 0.0,
        seconds: 3.0,
        hold: 0.0,
        easing: default(),
    };
    tour.path = Some(CameraPath { keyframes: vec![keyframe(-1.0), keyframe(1.0)], looped: true });
    let png = encode_png(SIZE, PngPixels::Rgb(&paint()))?;
    Ok(TourSource::read(&Tour::check(tour)?, &|_| Ok(png.clone()))?)
}

/// Sky, hills, their mirror image and a post in the water.
fn paint() -> Vec<[u8; 3]> {
    let color = |x: f64, y: f64, post_end: f64| {
        let hill = 90.0 + 30.0 * (x / 70.0).sin() + 8.0 * (x / 13.0).sin();
        match () {
            () if (300.0..330.0).contains(&x) && (120.0..post_end).contains(&y) => [112.0, 84.0, 58.0],
            () if y > hill => [54.0, 92.0 + 20.0 * (x / 9.0).sin(), 60.0],
            () => [120.0 + y * 0.6, 170.0 + y * 0.4, 232.0],
        }
    };
    let pixel = |x: f64, y: f64| {
        let direct = y < SHORE || ((300.0..330.0).contains(&x) && y < 250.0);
        // The hills mirror about their shore, the post about its own foot.
        let [up, post] = [2.0 * SHORE - y, 2.0 * 250.0 - y];
        let color = match direct {
            true => color(x, y, 250.0),
            false if (300.0..330.0).contains(&x) && post > 120.0 => color(x, post, 250.0).map(|c| 0.7 * c),
            false => color(x, up.max(0.0), 0.0).map(|c| 0.7 * c),
        };
        color.map(|c| c as u8)
    };
    (0..SIZE.y).flat_map(|y| (0..SIZE.x).map(move |x| pixel(f64::from(x), f64::from(y)))).collect()
}
