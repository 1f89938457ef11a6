//! How long the reference tracer takes for a frame of the demo at 640 × 360, one sample, all cores.
//!
//! What must hold: over 10 frames a second on two cores. Beside it, in the same run: a plain copy of the frame's pixels
//! through linear light and back, the least that any renderer does; and the view from elsewhere, where nothing is cached.
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use std::hint::black_box;
use std::path::Path;

use bevy_picture_tour::assemble::{TourSource, assemble};
use bevy_picture_tour::camera::{CameraPose, PinholeCamera};
use bevy_picture_tour::maps::MapOptions;
use bevy_picture_tour::picture::color::{linear_from_srgb3, srgb_from_linear3};
use bevy_picture_tour::trace::Reference;
use criterion::{Criterion, Throughput};
use glam::{DVec3, UVec2};

const SIZE: UVec2 = UVec2::new(640, 360);

fn main() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lake/lake.tour.ron");
    let source = TourSource::open(&path).unwrap_or_else(|problems| panic!("{problems}"));
    let built = assemble(&source, &MapOptions::default(), &|_, _| true).unwrap();
    let own = built.scene.camera;
    let home = PinholeCamera { intrinsics: own.intrinsics.scaled_to(SIZE), ..own };
    let elsewhere = CameraPose::from_angles(DVec3::new(1.44, 2.3, -1.2), 0.07, 0.0, 0.0);
    let elsewhere = PinholeCamera { pose: elsewhere, ..home };
    let reference = Reference::new(&built.scene, &built.maps);
    let frame = reference.render(&home, 1);

    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("trace 640 x 360");
    group.throughput(Throughput::Elements(u64::from(SIZE.x) * u64::from(SIZE.y)));
    group.sample_size(20);
    group.bench_function("plain copy in linear light", |bencher| {
        bencher.iter(|| -> Vec<[u8; 3]> {
            black_box(frame.pixels())
                .iter()
                .map(|pixel| srgb_from_linear3(linear_from_srgb3(*pixel)))
                .collect()
        });
    });
    group.bench_function("first view", |bencher| bencher.iter(|| reference.render(black_box(&home), 1)));
    group.bench_function("from elsewhere", |bencher| {
        bencher.iter(|| reference.render(black_box(&elsewhere), 1));
    });
    group.finish();
    criterion.final_summary();
}
