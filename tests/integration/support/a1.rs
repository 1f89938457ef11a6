//! World A1 of `tests/data/a1`: its tour, and the poses of its eight other views.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use bevy_picture_tour::assemble::TourSource;
use bevy_picture_tour::camera::CameraPose;
use glam::DVec3;
use serde_json::Value;

/// The folder with the world's files.
pub(crate) fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/a1")
}

/// The tour with its picture and masks.
pub(crate) fn source() -> Arc<TourSource> {
    let path = folder().join("a1.tour.ron");
    Arc::new(TourSource::open(&path).unwrap_or_else(|problems| panic!("{problems}")))
}

/// The poses of the eight views, in the tour's space.
pub(crate) fn poses() -> Vec<CameraPose> {
    let text = std::fs::read_to_string(folder().join("scene.json")).unwrap();
    let scene: Value = serde_json::from_str(&text).unwrap();
    let number = |value: &Value| value.as_f64().expect("a number should stand here");
    // The world's origin is the camera; the tour's is the water below it.
    let height = number(&scene["camera"]["height_above_water"]);
    let views = scene["views"].as_array().expect("scene.json should list its views");
    views
        .iter()
        .map(|view| {
            let [x, y, z] = [0, 1, 2].map(|axis| number(&view["position"][axis]));
            let [yaw, pitch, roll] =
                ["yaw_deg", "pitch_deg", "roll_deg"].map(|angle| number(&view[angle]).to_radians());
            CameraPose::from_angles(DVec3::new(x, y + height, z), yaw, pitch, roll)
        })
        .collect()
}
