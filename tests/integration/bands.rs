//! Distances by the mirror image, from files to files: what `check` tells of them, and what `bands` cuts.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use bevy_picture_tour::assemble::{CutOptions, TourSource, assemble, cut_bands};
use bevy_picture_tour::maps::MapOptions;
use bevy_picture_tour::picture::{PngPixels, decode_picture, encode_png, save_png};
use bevy_picture_tour::tour::{BackgroundPlace, RelativePath};
use bevy_picture_tour::trace::Reference;
use bevy_picture_tour::trace::compare::Comparison;
use glam::UVec2;
use serde_json::Value;

use crate::support::a1;

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_picture-tour"));
    command.current_dir(folder).args(arguments).stdin(Stdio::null()).output().unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Copies a folder with its folders.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let to = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &to);
        } else {
            fs::copy(entry.path(), to).unwrap();
        }
    }
}

/// The names of a folder's entries, in order.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_flat_background_stays_whole_and_gets_its_distance() {
    let source = a1::source();
    let options = CutOptions { folder: RelativePath::new("found").unwrap(), anew: false };
    let found = cut_bands(&source.tour, &source, &options, &|_| true).unwrap();
    let Some(BackgroundPlace::Distance(meters)) = found.tour.background.place else {
        panic!("{:?}", found.tour.background)
    };
    assert!((meters / 120.0 - 1.0).abs() < 0.03, "{meters} m instead of 120");
    assert!(found.tour.background.bands.is_empty() && found.masks.is_empty());
}

#[test]
fn check_tells_and_draws_what_the_mirror_image_shows() {
    let folder = tempfile::tempdir().unwrap();
    copy(&a1::folder(), folder.path());
    let checked = run(folder.path(), &["check", "a1.tour.ron", "--json", "--depth", "depth.png"]);
    assert_eq!(checked.status.code(), Some(0), "{}", stderr(&checked));
    let report: Value = serde_json::from_slice(&checked.stdout).unwrap();
    let mirror = &report["mirror_image"];
    assert_eq!(mirror["found"], true);
    for standing in mirror["standing"].as_array().unwrap() {
        assert!(["agrees", "unknown"].contains(&standing["verdict"].as_str().unwrap()), "{standing}");
    }
    let names: Vec<_> = mirror["standing"].as_array().unwrap().iter().map(|s| &s["name"]).collect();
    assert_eq!(names, ["house", "tree", "rock", "boat", "background"]);
    assert!(mirror["by_pairs"]["pairs"].as_u64().unwrap() >= 100, "{mirror}");
    let png = fs::read(folder.path().join("depth.png")).unwrap();
    let painted = decode_picture(&png, "depth.png").unwrap().picture;
    assert!(painted.size().x == 960 && painted.size().y > 540, "{}", painted.size());
}

#[test]
fn the_demo_cut_anew_still_shows_its_picture() {
    let folder = tempfile::tempdir().unwrap();
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lake"), folder.path());
    let before = names(folder.path());

    let refused = run(folder.path(), &["bands", "lake.tour.ron"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("--anew"), "{}", stderr(&refused));
    assert_eq!(names(folder.path()), before, "nothing is left of what was refused");

    let made = run(folder.path(), &["bands", "lake.tour.ron", "--anew"]);
    assert_eq!(made.status.code(), Some(0), "{}", stderr(&made));
    let path = folder.path().join("lake.bands.tour.ron");
    let source = TourSource::open(&path).unwrap_or_else(|problems| panic!("{problems}"));
    let count = source.tour.background.bands.len();
    assert!((2..=8).contains(&count), "{count} bands");
    assert_eq!(source.bands.iter().flatten().count(), count - 1, "the farthest has no region");

    let built = assemble(&source, &MapOptions::PREVIEW, &|_, _| true).unwrap();
    let seen = Reference::new(&built.scene, &built.maps).render(&built.scene.camera, 1);
    let first = Comparison::of(&seen, &source.picture).unwrap();
    assert!(first.max_code_difference <= 1, "{} codes off", first.max_code_difference);

    let again = run(folder.path(), &["bands", "lake.tour.ron", "--anew"]);
    assert!(again.status.code() == Some(2) && stderr(&again).contains("--force"), "{}", stderr(&again));

    // The masks that were made go with the tour that named them, and nothing else does.
    let before = names(folder.path());
    let forced = run(folder.path(), &["bands", "lake.tour.ron", "--anew", "--force"]);
    assert_eq!(forced.status.code(), Some(0), "{}", stderr(&forced));
    let renamed = |name: String| if name == "lake.bands.masks" { format!("{name}_2") } else { name };
    let after: Vec<String> = before.into_iter().map(renamed).collect();
    assert_eq!(names(folder.path()), after);
    assert!(TourSource::open(&path).is_ok());
}

#[test]
fn where_nothing_can_be_matched_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let size = UVec2::new(96, 54);
    let even = vec![[120, 130, 140]; 96 * 54];
    save_png(&folder.path().join("fog.png"), size, PngPixels::Rgb(&even)).unwrap();
    assert_eq!(run(folder.path(), &["new", "fog.png"]).status.code(), Some(0));
    let before = names(folder.path());

    let refused = run(folder.path(), &["bands", "fog.tour.ron"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("no mirror image"), "{}", stderr(&refused));
    assert_eq!(names(folder.path()), before);

    let text = String::from_utf8(run(folder.path(), &["check", "fog.tour.ron"]).stdout).unwrap();
    assert!(text.contains("Distances by the mirror image: none"), "{text}");

    let png = encode_png(size, PngPixels::Rgb(&even)).unwrap();
    fs::write(folder.path().join("fog.png"), &png[..png.len() / 2]).unwrap();
    let broken = run(folder.path(), &["bands", "fog.tour.ron"]);
    assert_eq!(broken.status.code(), Some(1), "{}", stderr(&broken));
    fs::create_dir(folder.path().join("other")).unwrap();
    let elsewhere = run(folder.path(), &["bands", "fog.tour.ron", "--out", "other/fog.tour.ron"]);
    assert!(elsewhere.status.code() == Some(2) && stderr(&elsewhere).contains("picture"), "{elsewhere:?}");
    assert_eq!(run(folder.path(), &["bands", "nowhere.tour.ron"]).status.code(), Some(2));
}
