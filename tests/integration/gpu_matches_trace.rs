//! The GPU's frames are those of the reference tracer, on world A1, wherever in the game the tour stands.

use std::io::Cursor;
use std::sync::Arc;

use bevy::asset::AssetPlugin;
use bevy::prelude::*;
use bevy::render::settings::WgpuLimits;
use bevy::render::settings::{WgpuSettings, WgpuSettingsPriority};
use bevy_picture_tour::assemble::TourSource;
use bevy_picture_tour::camera::{Intrinsics, PinholeCamera};
use bevy_picture_tour::headless::{HeadlessTour, headless_app, headless_app_with};
use bevy_picture_tour::motion::{Recordings, Simulation};
use bevy_picture_tour::picture::{Mask, Picture, PicturePoint, PngPixels, save_png};
use bevy_picture_tour::tour::{
    BackgroundPlace, Band, Course, Floating, Jonswap, Motion, Recorded, RecordedSea, Region, Sea, Sky,
    Support, Sway, SwayKind, Tour, TourFile, Waypoint, Wind,
};
use bevy_picture_tour::trace::Reference;
use bevy_picture_tour::trace::compare::Comparison;
use image::{ImageBuffer, ImageFormat, Luma};

use crate::support::{a1, adapter};

/// Mean difference of a frame, codes.
const MEAN: f64 = 0.25;
/// Share of a frame's pixels within 3 codes.
const WITHIN_3: f64 = 0.999;

/// Writes both frames to `target/differing/` for a person to look at.
fn keep(name: &str, frame: &Picture, expected: &Picture) {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("target/differing");
    std::fs::create_dir_all(&folder).unwrap();
    for (which, picture) in [("gpu", frame), ("reference", expected)] {
        let path = folder.join(format!("{name}_{which}.png"));
        save_png(&path, picture.size(), PngPixels::Rgb(picture.pixels())).unwrap();
    }
}

/// Holds the first view against the picture and eight others against the reference.
fn matches(name: &str, app: App, place: Transform) {
    let source = a1::source();
    let size = source.picture.size();
    let mut gpu =
        HeadlessTour::in_app(app, source.clone(), size, place).unwrap_or_else(|error| panic!("{error}"));
    let solved = gpu.solved().expect("the tour is shown");
    let own = solved.scene.camera;
    let reference = Reference::new(&solved.scene, &solved.maps);

    for (renderer, frame) in [("GPU", gpu.render(&own).unwrap()), ("reference", reference.render(&own, 1))] {
        let found = Comparison::of(&frame, &source.picture).unwrap();
        let within = 100.0 * found.share_within(1);
        assert!(
            found.max_code_difference <= 1,
            "{name}: the {renderer}'s first view is {} codes off at worst, {within} % within 1",
            found.max_code_difference
        );
    }
    let poses = a1::poses();
    assert_eq!(poses.len(), 8, "views of A1");
    for (i, pose) in poses.into_iter().enumerate() {
        let camera = PinholeCamera { pose, ..own };
        let (frame, expected) = (gpu.render(&camera).unwrap(), reference.render(&camera, 1));
        let found = Comparison::of(&frame, &expected).unwrap();
        let (mean, within) = (found.mean_difference, found.share_within(3));
        if mean >= MEAN || within < WITHIN_3 {
            keep(&format!("{name}_{}", i + 1), &frame, &expected);
        }
        assert!(mean < MEAN, "{name}, view {}: mean difference {mean:.4} codes, at most {MEAN}", i + 1);
        assert!(
            within >= WITHIN_3,
            "{name}, view {}: {within:.5} within 3 codes, at least {WITHIN_3}",
            i + 1
        );
    }
}

#[test]
fn at_the_game_s_origin() {
    let Some(_gpu) = adapter() else { return };
    matches("origin", headless_app().unwrap(), Transform::default());
}

#[test]
fn a_kilometer_from_the_game_s_origin() {
    let Some(_gpu) = adapter() else { return };
    let place = Transform::from_xyz(1000.0, 50.0, -700.0).with_rotation(Quat::from_rotation_y(0.7));
    matches("far", headless_app().unwrap(), place);
}

#[test]
fn what_turns_and_what_is_shown_small_is_drawn_alike() {
    let Some(_gpu) = adapter() else { return };
    let source = a1_with(|tour| tour.objects.iter_mut().for_each(|object| object.turns_to_camera = true));
    // A third of the picture's size reads mip levels between 1 and 2.
    let size = source.picture.size() / 3;
    let mut gpu = HeadlessTour::new(source, size, Transform::default()).unwrap();
    let solved = gpu.solved().expect("the tour is shown");
    let own = solved.scene.camera;
    let lens = own.intrinsics;
    let third =
        Intrinsics { focal_px: lens.focal_px / 3.0, principal: PicturePoint(lens.principal.0 / 3.0), size };
    let reference = Reference::new(&solved.scene, &solved.maps);
    let sideways = 0.3 * solved.scene.bounds.nearest;
    for (name, x) in [("own", 0.0), ("right", sideways), ("left", -sideways)] {
        let mut camera = PinholeCamera { intrinsics: third, ..own };
        camera.pose.position.x += x;
        let (frame, expected) = (gpu.render(&camera).unwrap(), reference.render(&camera, 1));
        let found = Comparison::of(&frame, &expected).unwrap();
        let (mean, within) = (found.mean_difference, found.share_within(3));
        if mean >= MEAN || within < WITHIN_3 {
            keep(&format!("turned_{name}"), &frame, &expected);
        }
        assert!(mean < MEAN, "{name}: mean difference {mean:.4} codes, at most {MEAN}");
        assert!(within >= WITHIN_3, "{name}: {within:.5} within 3 codes, at least {WITHIN_3}");
    }
}

#[test]
fn what_moves_is_drawn_alike() {
    let Some(_gpu) = adapter() else { return };
    let source = a1_with(|tour| {
        tour.wind = Wind { speed: 5.0, ..Wind::default() };
        tour.waves.sea = Sea::Jonswap(Jonswap::default());
        // The last thing in the water sails, to where it is seen from its other side.
        let last = tour.objects.iter().rposition(|object| object.support == Support::Water);
        for (index, object) in tour.objects.iter_mut().enumerate() {
            object.motion = match object.support {
                Support::Water if last == Some(index) => Motion::Course(there_and_back()),
                Support::Water => Motion::Floating(Floating::of_draft(0.2)),
                Support::Ground => {
                    Motion::Sway(Sway { amplitude: Some(0.02), ..Sway::of_kind(SwayKind::Trunk) })
                }
            };
        }
        let corners = [(0.0, 0.0), (960.0, 0.0), (960.0, 150.0), (0.0, 150.0)];
        let region = Region::Polygon(corners.map(|(x, y)| PicturePoint::new(x, y)).into());
        tour.sky = Some(Sky { region: Some(region), drift: None });
    });
    let size = source.picture.size();
    let mut gpu = HeadlessTour::new(source.clone(), size, Transform::default()).unwrap();
    let solved = gpu.solved().expect("the tour is shown");
    let own = solved.scene.camera;
    let land = solved.land(&source.tour);
    let (mut motion, remarks) =
        Simulation::new(&source.tour, &solved.scene, land.as_ref(), &source.recordings);
    assert!(remarks.is_empty(), "{remarks:?}");
    for (seconds, pose) in [0.0, 1.3, 4.0, 9.7, 19.5].into_iter().zip(a1::poses()) {
        let camera = PinholeCamera { pose, ..own };
        gpu.go_to(Some(seconds));
        motion.go_to(seconds);
        let water = motion.water();
        let expected = Reference::new(&solved.scene, &solved.maps)
            .with_water(&water)
            .at_moment(motion.moment())
            .render(&camera, 1);
        let frame = gpu.render(&camera).unwrap();
        let found = Comparison::of(&frame, &expected).unwrap();
        let (mean, within) = (found.mean_difference, found.share_within(6));
        if mean >= 0.5 || within < 0.995 {
            keep(&format!("moving_{seconds}"), &frame, &expected);
        }
        assert!(mean < 0.5, "at {seconds} s: mean difference {mean:.4} codes, at most 0.5");
        assert!(within >= 0.995, "at {seconds} s: {within:.5} within 6 codes, at least 0.995");
    }
    gpu.go_to(None);
    let found = Comparison::of(&gpu.render(&own).unwrap(), &source.picture).unwrap();
    assert!(found.max_code_difference <= 1, "still again, {} codes off", found.max_code_difference);
}

#[test]
fn recordings_are_drawn_alike() {
    let Some(_gpu) = adapter() else { return };
    let source = a1_with(|tour| {
        tour.waves.sea = Sea::Recorded(RecordedSea {
            first: "sea/09.png".into(),
            count: 2,
            frames_per_second: 1.0,
            height: 0.4,
            area: (9.0, 5.0),
        });
        let last = tour.objects.iter().rposition(|object| object.support == Support::Water).unwrap();
        tour.objects[last].motion = Motion::Recorded(Recorded { poses: "poses.json".into(), looped: true });
    });
    let recordings = Recordings::read(&source.tour, &|file| match file.as_str() {
        "poses.json" => Ok(POSES.into()),
        frame => Ok(wave(if frame == "sea/09.png" { 0.0 } else { 0.25 })),
    });
    let recordings = recordings.unwrap_or_else(|problems| panic!("{problems}"));
    let source = Arc::new(TourSource { recordings, ..(*source).clone() });
    let mut gpu = HeadlessTour::new(source.clone(), source.picture.size(), Transform::default()).unwrap();
    let solved = gpu.solved().expect("the tour is shown");
    let land = solved.land(&source.tour);
    let (mut motion, remarks) =
        Simulation::new(&source.tour, &solved.scene, land.as_ref(), &source.recordings);
    assert!(remarks.is_empty(), "{remarks:?}");
    for (seconds, pose) in [0.0, 0.7].into_iter().zip([solved.scene.camera.pose, a1::poses()[3]]) {
        let camera = PinholeCamera { pose, ..solved.scene.camera };
        gpu.go_to(Some(seconds));
        motion.go_to(seconds);
        let water = motion.water();
        let reference = || Reference::new(&solved.scene, &solved.maps);
        let moved = reference().with_water(&water).at_moment(motion.moment()).render(&camera, 1);
        let frame = gpu.render(&camera).unwrap();
        let found = Comparison::of(&frame, &moved).unwrap();
        let (mean, within) = (found.mean_difference, found.share_within(6));
        if mean >= 0.5 || within < 0.995 {
            keep(&format!("recorded_{seconds}"), &frame, &moved);
        }
        assert!(mean < 0.5, "at {seconds} s: mean difference {mean:.4} codes, at most 0.5");
        assert!(within >= 0.995, "at {seconds} s: {within:.5} within 6 codes, at least 0.995");
        let seen = Comparison::of(&moved, &reference().render(&camera, 1)).unwrap().mean_difference;
        assert!(seen > 1.0, "at {seconds} s only {seen:.3} codes tell the recordings from rest");
    }
}

/// Ahead, turned and tilted.
const POSES: &str = r#"[{"seconds": 0, "position": [0.1, 0.05, -0.4], "yaw_deg": 10, "roll_deg": 3},
    {"seconds": 1, "position": [0.4, 0.0, -0.9], "yaw_deg": 25, "pitch_deg": 2}, {"seconds": 2, "position": [0, 0, 0]}]"#;

/// A frame of 16-bit gray: two waves along and one down, so many turns on.
fn wave(turns: f64) -> Vec<u8> {
    let frame = ImageBuffer::from_fn(72, 40, |column, row| {
        let phase = f64::from(column) / 36.0 - f64::from(row) / 40.0 - turns;
        Luma([(32_767.5 + 20_000.0 * (std::f64::consts::TAU * phase).cos()) as u16])
    });
    let mut png = Cursor::new(Vec::new());
    frame.write_to(&mut png, ImageFormat::Png).unwrap();
    png.into_inner()
}

/// To the right and away, and back as the mirrored copy within 19 s.
fn there_and_back() -> Course {
    let waypoints = [(-0.6, -12.0), (2.0, -13.0)].map(|(x, z)| Waypoint((x, z).into()));
    Course { waypoints: waypoints.into(), speed: 1.5, draft: 0.2, length: None, closed: false }
}

#[test]
fn the_demo_s_first_view_is_its_picture() {
    let Some(_gpu) = adapter() else { return };
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lake/lake.tour.ron");
    let source = Arc::new(TourSource::open(&path).unwrap());
    let size = source.picture.size();
    let mut gpu = HeadlessTour::new(source.clone(), size, Transform::default()).unwrap();
    let solved = gpu.solved().expect("the tour is shown");
    let own = solved.scene.camera;
    let traced = Reference::new(&solved.scene, &solved.maps).render(&own, 1);
    for (renderer, frame) in [("GPU", gpu.render(&own).unwrap()), ("reference", traced)] {
        let found = Comparison::of(&frame, &source.picture).unwrap();
        assert!(found.max_code_difference <= 1, "the {renderer} is {} codes off", found.max_code_difference);
    }
}

/// World A1 marked otherwise.
fn a1_with(change: impl FnOnce(&mut TourFile)) -> Arc<TourSource> {
    let source = a1::source();
    let mut file = source.tour.to_file();
    change(&mut file);
    let tour = Tour::check(file).unwrap();
    let mask = |region: &Region| match region {
        Region::Polygon(corners) => Mask::from_polygon(source.picture.size(), corners).unwrap(),
        Region::Mask(file) => panic!("{file} is not drawn here"),
    };
    let bands = tour.background.bands.iter().map(|band| band.region.as_ref().map(mask)).collect();
    let sky = tour.sky.as_ref().and_then(|sky| sky.region.as_ref()).map(mask);
    Arc::new(TourSource { tour, bands, sky, ..(*source).clone() })
}

/// The GPU against the tracer at the first view and another, and both against the picture.
fn is_drawn_alike(source: Arc<TourSource>) {
    let size = source.picture.size();
    let mut gpu = HeadlessTour::new(source.clone(), size, Transform::default()).unwrap();
    let solved = gpu.solved().expect("the tour is shown");
    let reference = Reference::new(&solved.scene, &solved.maps);
    for (i, pose) in [solved.scene.camera.pose, a1::poses()[3]].into_iter().enumerate() {
        let camera = PinholeCamera { pose, ..solved.scene.camera };
        let found = Comparison::of(&gpu.render(&camera).unwrap(), &reference.render(&camera, 1)).unwrap();
        let within = found.share_within(3);
        assert!(within >= WITHIN_3, "view {i}: {within:.5} within 3 codes, at least {WITHIN_3}");
    }
    let first = reference.render(&solved.scene.camera, 1);
    let found = Comparison::of(&first, &source.picture).unwrap();
    assert!(found.max_code_difference <= 1, "the first view is {} codes off", found.max_code_difference);
}

#[test]
fn a_background_at_infinity_is_drawn_alike() {
    let Some(_gpu) = adapter() else { return };
    is_drawn_alike(a1_with(|file| file.background.place = Some(BackgroundPlace::Infinity)));
}

#[test]
fn bands_before_a_sky_are_drawn_alike() {
    let Some(_gpu) = adapter() else { return };
    let polygon = |corners: &[(f64, f64)]| {
        Region::Polygon(corners.iter().map(|&(x, y)| PicturePoint::new(x, y)).collect())
    };
    let source = a1_with(|file| {
        // A shore that recedes to the right, mountains behind it, and a sky with a slanted border.
        file.background.place = None;
        let shore = [(0.0, 230.0), (960.0, 250.0), (960.0, 284.0), (0.0, 284.0)];
        let contact = [(20.0, 284.0), (940.0, 279.0)].map(|(x, y)| PicturePoint::new(x, y));
        file.background.bands = vec![
            Band {
                name: "shore".into(),
                region: Some(polygon(&shore)),
                place: BackgroundPlace::Contact(contact.into()),
            },
            Band { name: "mountains".into(), region: None, place: BackgroundPlace::Distance(400.0) },
        ];
        let region = Some(polygon(&[(0.0, 0.0), (960.0, 0.0), (960.0, 120.0), (0.0, 90.0)]));
        file.sky = Some(Sky { region, drift: None });
    });
    is_drawn_alike(source);
}

/// Set in the process that this test starts for itself.
const OWN_PROCESS: &str = "PICTURE_TOUR_TEST_OWN_PROCESS";

#[test]
fn with_the_limits_of_webgl2() {
    let Some(_gpu) = adapter() else { return };
    // In a process of its own: behind an app with other limits in the same one, the second app's pipelines were seen to
    // wait for their shaders for ever (Bevy 0.19.1; why is not known).
    if std::env::var_os(OWN_PROCESS).is_none() {
        let own = std::process::Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "gpu_matches_trace::with_the_limits_of_webgl2", "--nocapture"])
            .env(OWN_PROCESS, "1")
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&own.stdout) + String::from_utf8_lossy(&own.stderr);
        assert!(own.status.success() && said.contains("1 passed"), "{said}");
        return;
    }
    let settings = WgpuSettings {
        priority: WgpuSettingsPriority::WebGL2,
        limits: WgpuLimits::downlevel_webgl2_defaults(),
        ..default()
    };
    let app = headless_app_with(AssetPlugin::default(), settings).unwrap();
    matches("webgl2", app, Transform::default());
}
