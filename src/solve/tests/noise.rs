//! How well the focal length is recovered from clicks that scatter, against the table of notes/algorithms.md §1.4.
//!
//! 300 trials with fixed seeds for each cell, no guess of the focal length.

use super::Kind;
use super::Picture;
use super::Random;
use crate::solve::Annotations;
use crate::solve::Label;
use crate::solve::Solution;
use crate::solve::full;

const TRIALS: u64 = 300;

fn trial(pitch: f64, click_px: f64, kind: Kind, seed: u64) -> Annotations {
    let roll = Random::new(seed + 1000).between(-1.0, 1.0);
    // Looking down, as in the table.
    Picture { click_px, horizon_px: 2.0, kind, ..Picture::new(-pitch, roll) }.annotations(seed)
}

fn solved(annotations: &Annotations) -> Solution {
    full::solve(annotations, full::Guesses::Dropped).unwrap()
}

/// Median and half the 16..84 % range of ln(f / 1500), in percent.
fn spread(pitch: f64, click_px: f64, kind: Kind) -> (f64, f64) {
    let of = |seed| 100.0 * (solved(&trial(pitch, click_px, kind, seed)).parameters.focal_px / 1500.0).ln();
    let mut values: Vec<f64> = (0..TRIALS).map(of).collect();
    values.sort_by(f64::total_cmp);
    let at = |part: f64| values[(part * TRIALS as f64) as usize];
    (at(0.5), (at(0.84) - at(0.16)) / 2.0)
}

fn compare(kind: Kind, table: [(f64, f64, f64); 6]) {
    for (pitch, click_px, expected) in table {
        let (median, deviation) = spread(pitch, click_px, kind);
        eprintln_cell(kind, pitch, click_px, expected, deviation, median);
        assert!(
            (deviation / expected - 1.0).abs() < 0.35,
            "{kind:?}, {pitch} deg, {click_px} px: f scatters by {deviation:.2} %, the table says {expected} %"
        );
        assert!(
            median.abs() < 0.3 * expected.max(1.5),
            "{kind:?}, {pitch} deg, {click_px} px: median off by {median:.2} %"
        );
    }
}

#[expect(clippy::print_stderr, reason = "shown by `cargo test -- --nocapture` for the record")]
fn eprintln_cell(kind: Kind, pitch: f64, click_px: f64, expected: f64, deviation: f64, median: f64) {
    eprintln!(
        "{kind:?} {pitch:>4} deg {click_px} px: {deviation:.2} % (table {expected} %), median {median:+.2} %"
    );
}

#[test]
fn the_focal_length_of_free_pairs_scatters_as_the_table_says() {
    compare(
        Kind::Free,
        [
            (2.0, 0.5, 2.5),
            (2.0, 1.0, 4.2),
            (5.0, 0.5, 1.0),
            (5.0, 1.0, 1.7),
            (10.0, 0.5, 0.8),
            (10.0, 1.0, 1.3),
        ],
    );
}

#[test]
fn the_focal_length_of_pairs_on_one_wall_scatters_as_the_table_says() {
    compare(
        Kind::Wall,
        [
            (2.0, 0.5, 2.3),
            (2.0, 1.0, 3.5),
            (5.0, 0.5, 1.0),
            (5.0, 1.0, 1.4),
            (10.0, 0.5, 0.7),
            (10.0, 1.0, 1.2),
        ],
    );
}

#[test]
fn the_focal_length_of_standing_objects_scatters_as_the_table_says() {
    compare(
        Kind::Standing,
        [
            (2.0, 0.5, 2.6),
            (2.0, 1.0, 4.0),
            (5.0, 0.5, 1.0),
            (5.0, 1.0, 1.5),
            (10.0, 0.5, 0.6),
            (10.0, 1.0, 1.0),
        ],
    );
}

#[test]
fn a_level_picture_s_focal_length_is_assumed() {
    let labels: Vec<Label> = (0..TRIALS)
        .map(|seed| {
            let solution = crate::solve::solve(&trial(0.0, 1.0, Kind::Free, seed)).unwrap();
            solution.report.parameter("focal_px").unwrap().label
        })
        .collect();
    let wrong = labels.iter().filter(|label| **label == Label::Measured).count();
    let assumed = labels.iter().filter(|label| **label == Label::Assumed).count();
    assert!(wrong == 0, "{wrong} of {TRIALS} level pictures claim to measure f");
    assert!(
        assumed as f64 >= 0.95 * TRIALS as f64,
        "only {assumed} of {TRIALS} level pictures say f is assumed"
    );
}

#[test]
fn the_reported_deviation_covers_the_error() {
    for kind in [Kind::Free, Kind::Wall, Kind::Standing] {
        let inside = (0..TRIALS).filter(|&seed| {
            let solution = solved(&trial(5.0, 1.0, kind, seed));
            let deviation = solution.report.parameter("focal_px").unwrap().deviation.unwrap();
            (solution.parameters.focal_px - 1500.0).abs() < deviation
        });
        let covered = 100.0 * inside.count() as f64 / TRIALS as f64;
        eprintln_coverage(kind, covered);
        assert!(
            (56.0..80.0).contains(&covered),
            "{kind:?}: {covered:.0} % within one deviation, not 60 to 76 %"
        );
    }
}

#[expect(clippy::print_stderr, reason = "shown by `cargo test -- --nocapture` for the record")]
fn eprintln_coverage(kind: Kind, covered: f64) {
    eprintln!("{kind:?} 5 deg 1 px: {covered:.0} % within one reported deviation");
}
