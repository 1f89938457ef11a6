//! How long a tour takes from its files to being ready, by stages, on the demo (1920 × 1080, four bodies).
//!
//! Stages of one run are to be compared with each other: reading and decoding alone; distances by the mirror image,
//! which `check` and `bands` measure; maps with smooth fills, which a preview waits for; with patches inside the picture, and beyond it as well; everything.
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use std::cell::RefCell;
use std::collections::HashMap;
use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use bevy_picture_tour::assemble::{TourOnDisk, TourSource, assemble, measure_depth, place};
use bevy_picture_tour::maps::{MapOptions, Maps};
use bevy_picture_tour::picture::{Mask, decode_mask, decode_picture};
use bevy_picture_tour::tour::RelativePath;
use criterion::Criterion;

fn main() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lake");
    let file = folder.join("lake.tour.ron");
    let open = || TourSource::open(&file).unwrap_or_else(|problems| panic!("{problems}"));
    let source = open();
    let placed = place(&source).unwrap();
    let (scene, masks) = (&placed.scene, placed.masks(&source));
    let png = std::fs::read(folder.join("lake.png")).unwrap();

    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("maps of the demo");
    group.sample_size(10).measurement_time(Duration::from_secs(10));
    group.bench_function("decode the picture", |bencher| {
        bencher.iter(|| decode_picture(black_box(&png), "lake.png").unwrap());
    });
    group.bench_function("open: tour, picture and masks", |bencher| bencher.iter(open));
    group.bench_function("distances by the mirror image", |bencher| {
        bencher.iter(|| measure_depth(black_box(&source), &scene.camera, &|_| true).unwrap());
    });
    // What follows the hand while a mark is dragged in the studio: no map is built for it.
    let decoded = decode_picture(&png, "lake.png").unwrap();
    let tour = TourOnDisk::open(&file).unwrap().tour;
    let masks_at_hand = RefCell::new(HashMap::<String, Mask>::new());
    let mask_of = |_: &str, name: &RelativePath| {
        let read = || {
            decode_mask(
                &std::fs::read(name.in_folder(&folder)).unwrap(),
                name.as_str(),
                decoded.picture.size(),
            )
        };
        Ok(masks_at_hand.borrow_mut().entry(name.to_string()).or_insert_with(|| read().unwrap()).clone())
    };
    group.bench_function("a mark: check, solve, place", |bencher| {
        bencher.iter(|| place(&TourSource::of(&tour, decoded.clone(), &mask_of).unwrap()).unwrap());
    });
    let ways = [
        ("maps, smooth fills", MapOptions::PREVIEW),
        ("maps, patches inside the picture", MapOptions { paint_beyond: false, ..MapOptions::default() }),
        ("maps, patches inside and beyond", MapOptions::default()),
    ];
    for (name, options) in ways {
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                Maps::build(scene, black_box(&source.picture), &masks, &options, &|_, _| true).unwrap()
            });
        });
    }
    group.bench_function("from file to ready", |bencher| {
        bencher.iter(|| assemble(&open(), &MapOptions::default(), &|_, _| true).unwrap());
    });
    group.finish();
    criterion.final_summary();
}
