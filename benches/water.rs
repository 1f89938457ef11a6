//! The water's shader: a frame whose lake mirrors eight billboards, against the same view with the lake as a plain
//! textured plane, and with waves, ripples and swaying posts. Each may take three times as long as the one before at most.

use std::sync::Arc;

use bevy::prelude::Transform;
use bevy_picture_tour::assemble::TourSource;
use bevy_picture_tour::camera::{CameraPose, PinholeCamera};
use bevy_picture_tour::headless::HeadlessTour;
use bevy_picture_tour::picture::PicturePoint;
use bevy_picture_tour::tour::{
    Background, BackgroundPlace, Document, FocalLength, GroundArea, Jonswap, Motion, Object, Region, Sea,
    Support, Sway, SwayKind, Tour, WaterArea,
};
use criterion::{Criterion, criterion_group, criterion_main};
use glam::{DVec3, UVec2};

const SIZE: UVec2 = UVec2::new(960, 540);
const SHORE: f64 = 297.0;

/// World A1's picture with eight posts marked on it, its lake as water or as ground.
fn source(is_water: bool, moves: bool) -> Arc<TourSource> {
    let point = PicturePoint::new;
    let mut tour = Document::new("input.png".to_owned());
    tour.camera.horizon = Some([point(0.0, 270.0), point(960.0, 270.0)]);
    tour.camera.focal_length = FocalLength::Known(800.0);
    let lake = || {
        Region::Polygon(
            [(0.0, SHORE), (960.0, SHORE), (960.0, 540.0), (0.0, 540.0)].map(|(x, y)| point(x, y)).into(),
        )
    };
    if is_water {
        tour.water = Some(WaterArea { region: lake(), pairs: Vec::new() });
    } else {
        tour.ground = Some(GroundArea { region: lake(), height_above_water: 0.0 });
    }
    tour.background = Background {
        place: Some(BackgroundPlace::Contact(vec![point(0.0, SHORE), point(960.0, SHORE)])),
        bands: Vec::new(),
    };
    for i in 0..8_u32 {
        let (left, foot) = (60.0 + 110.0 * f64::from(i), 330.0 + 12.0 * f64::from(i * 5 % 8));
        let corners = [(left, 180.0), (left + 70.0, 180.0), (left + 70.0, foot), (left, foot)];
        tour.objects.push(Object {
            name: format!("post {i}"),
            support: if is_water { Support::Water } else { Support::Ground },
            outline: Region::Polygon(corners.map(|(x, y)| point(x, y)).into()),
            contact: [point(left, foot), point(left + 70.0, foot)],
            turns_to_camera: false,
            motion: if moves { Motion::Sway(Sway::of_kind(SwayKind::Trunk)) } else { Motion::Static },
        });
    }
    if moves {
        tour.wind.speed = 5.0;
        tour.waves.sea = Sea::Jonswap(Jonswap::default());
    }
    let tour = Tour::check(tour).expect("the marks are sound");
    let picture = |_: &_| Ok(include_bytes!("../tests/data/a1/input.png").to_vec());
    Arc::new(TourSource::read(&tour, &picture).expect("the picture reads"))
}

fn frames(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("frame_960x540");
    group.sample_size(20);
    let frames = [
        ("plain_textured_plane", false, false),
        ("mirroring_8_billboards", true, false),
        ("everything_moves", true, true),
    ];
    for (name, is_water, moves) in frames {
        let mut tour =
            HeadlessTour::new(source(is_water, moves), SIZE, Transform::default()).expect("a GPU renders");
        let own = tour.solved().expect("the tour is shown").scene.camera;
        let mut step = 0.0;
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                step += 0.01;
                if moves {
                    tour.go_to(Some(step));
                }
                let aside = DVec3::X * f64::sin(step);
                let pose = CameraPose { position: own.pose.position + aside, ..own.pose };
                tour.render(&PinholeCamera { pose, ..own }).expect("a frame")
            });
        });
    }
    group.finish();
}

criterion_group!(benches, frames);
criterion_main!(benches);
