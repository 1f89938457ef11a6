//! The made scene is found again from its picture and its marks, and looks right from where nobody painted it.

use std::path::Path;

use bevy_picture_tour::assemble::{AssembledTour, TourSource, assemble};
use bevy_picture_tour::camera::{CameraPose, Intrinsics, PinholeCamera};
use bevy_picture_tour::maps::MapOptions;
use bevy_picture_tour::picture::PicturePoint;
use bevy_picture_tour::scene::Surface;
use bevy_picture_tour::solve::Label;
use bevy_picture_tour::trace::Reference;
use bevy_picture_tour::trace::compare::Comparison;
use glam::{DVec2, DVec3};

use crate::support::made_scene;

fn built() -> AssembledTour {
    assemble(&made_scene::source(), &MapOptions::PREVIEW, &|_, _| true)
        .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn marks_to_a_quarter_pixel_tell_distance_and_pitch() {
    let solution = built().solution;
    let found = solution.parameters;
    let off = (found.background_distance / made_scene::DISTANCE - 1.0).abs();
    assert!(
        off < 0.02,
        "the wall is at {} m instead of {} m",
        found.background_distance,
        made_scene::DISTANCE
    );
    let pitch = found.pitch.to_degrees();
    let expected = made_scene::PITCH_DEG;
    assert!((pitch - expected).abs() < 0.1, "pitch {pitch}° instead of {expected}°");
    let roll = found.roll.to_degrees();
    assert!(roll.abs() < 0.1, "roll {roll}° instead of 0°");
    assert_eq!(
        (found.focal_px, found.height),
        (made_scene::FOCAL_PX, made_scene::HEIGHT),
        "what was given stays"
    );

    let report = solution.report;
    let dropped: Vec<&str> =
        report.pairs.iter().filter(|pair| !pair.kept).map(|pair| pair.name.as_str()).collect();
    assert!(dropped.is_empty(), "{dropped:?} were dropped, but every pair is right");
    let label = report.parameter("background_distance").map(|parameter| parameter.label);
    assert_eq!(label, Some(Label::Measured), "seven pairs and a horizon tell the distance");
}

#[test]
fn bodies_stand_where_their_feet_are() {
    let scene = built().scene;
    for (name, depth) in [("post", 7.0), ("boat", 10.0)] {
        let component = scene.components.iter().find(|component| component.name == name);
        let Some(Surface::Wall(wall)) = component.map(|component| component.surface) else {
            panic!("{name} is no wall")
        };
        for end in wall.ends() {
            assert!(
                (end.y / -depth - 1.0).abs() < 0.03,
                "{name} stands at {} m instead of {depth} m",
                -end.y
            );
        }
    }
}

#[test]
fn the_first_view_is_the_picture() {
    let source = made_scene::source();
    let built = built();
    let first = Reference::new(&built.scene, &built.maps).render(&built.scene.camera, 1);
    let found = Comparison::of(&first, &source.picture).unwrap();
    let within = 100.0 * found.share_within(1);
    assert!(
        found.max_code_difference <= 1,
        "{} codes off at worst, {within} % within 1",
        found.max_code_difference
    );
}

#[test]
fn nothing_shines_through_between_two_pixels() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lake/lake.tour.ron");
    let source = TourSource::open(&path).unwrap();
    let built = assemble(&source, &MapOptions::PREVIEW, &|_, _| true).unwrap();
    let reference = Reference::new(&built.scene, &built.maps);
    let own = built.scene.camera;
    let size = own.intrinsics.size;
    for shift in [0.25, 0.5, 0.75] {
        // Row y then shows what lies between the middles of rows y and y + 1.
        let principal = PicturePoint(own.intrinsics.principal.0 - shift * DVec2::Y);
        let camera = PinholeCamera { intrinsics: Intrinsics { principal, ..own.intrinsics }, ..own };
        let frame = reference.render(&camera, 1);
        let is_off = |x: u32, y: u32| {
            let shown = frame.pixel(x, y);
            let near = [source.picture.pixel(x, y), source.picture.pixel(x, y + 1)];
            (0..3).any(|c| {
                let [low, high] = [near[0][c].min(near[1][c]), near[0][c].max(near[1][c])];
                shown[c] < low.saturating_sub(OFF) || shown[c] > high.saturating_add(OFF)
            })
        };
        for y in 0..size.y - 1 {
            let off = (0..size.x).filter(|&x| is_off(x, y)).count() as f64 / f64::from(size.x);
            assert!(off < 0.05, "row {y} + {shift}: {:.1} % are neither of the rows", 100.0 * off);
        }
    }
}

/// How far a color may be beyond both that it lies between, codes.
const OFF: u8 = 6;

#[test]
fn a_second_viewpoint_is_near_the_truth() {
    let source = made_scene::source();
    let built = built();
    let reference = Reference::new(&built.scene, &built.maps);
    let own = made_scene::camera();
    let pitch = made_scene::PITCH_DEG.to_radians();
    for (name, position, least) in [
        ("right", DVec3::new(0.7, made_scene::HEIGHT, 0.0), LEAST[0]),
        ("left and up", DVec3::new(-0.5, made_scene::HEIGHT + 0.3, 0.0), LEAST[1]),
        ("ahead", DVec3::new(0.2, made_scene::HEIGHT, -1.0), LEAST[2]),
    ] {
        let camera = PinholeCamera { pose: CameraPose::from_angles(position, 0.0, pitch, 0.0), ..own };
        let truth = made_scene::truth(&camera);
        let frame = reference.render(&camera, 4);
        let found = Comparison::of(&frame, &truth).unwrap().psnr;
        let flat = Comparison::of(&made_scene::flat(&camera, &source.picture), &truth).unwrap().psnr;
        assert!(
            found > least,
            "{name}: {found:.2} dB instead of at least {least} dB; a flat picture has {flat:.2} dB"
        );
        assert!(found > flat + 15.0, "{name}: {found:.2} dB, but a flat picture has {flat:.2} dB");
    }
}

/// What each move of the test above must reach, dB: measured (43.4, 43.7, 42.8), less one.
const LEAST: [f64; 3] = [42.4, 42.7, 41.8];
