//! How long the solver takes for ten pairs of world A1, level picture and full method.
//!
//! What must hold: under 1 ms. `focal known` is what people mark; `focal unknown` adds the lens to what is sought.
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use std::hint::black_box;
use std::path::Path;

use bevy_picture_tour::assemble::{TourSource, annotations};
use bevy_picture_tour::solve::{Annotations, FocalLength, solve};
use criterion::Criterion;

/// Ten of A1's twelve pairs, on each of its bodies and on the background.
fn ten_pairs() -> Annotations {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/a1/a1.tour.ron");
    let source = TourSource::open(&path).unwrap_or_else(|problems| panic!("{problems}"));
    let mut marked = annotations(&source);
    marked.pairs.remove(1);
    marked.pairs.remove(2);
    assert_eq!(marked.pairs.len(), 10, "pairs to solve from");
    marked
}

fn main() {
    let known = ten_pairs();
    let unknown = Annotations { focal: FocalLength::Unknown, ..known.clone() };
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("solve 10 pairs");
    group.bench_function("focal known", |bencher| bencher.iter(|| solve(black_box(&known)).unwrap()));
    group.bench_function("focal unknown", |bencher| bencher.iter(|| solve(black_box(&unknown)).unwrap()));
    group.finish();
    criterion.final_summary();
}
