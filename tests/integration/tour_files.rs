//! Every tour of the repository reads, opens with its files, and is written back unchanged in meaning.

use std::path::{Path, PathBuf};

use bevy_picture_tour::assemble::TourSource;
use bevy_picture_tour::tour::Tour;

/// Every `*.tour.ron` below `folder`.
fn tours_below(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut found = Vec::new();
    for entry in entries {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(tours_below(&path));
        } else if path.to_string_lossy().ends_with(".tour.ron") {
            found.push(path);
        }
    }
    found
}

#[test]
fn every_tour_of_the_repository_is_sound() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let assets = tours_below(&root.join("assets"));
    assert!(!assets.is_empty(), "assets/ has no *.tour.ron, but the demo should be there");
    for path in assets.into_iter().chain(tours_below(&root.join("tests/data"))) {
        let text = std::fs::read_to_string(&path).unwrap();
        let tour = Tour::read(&text).unwrap_or_else(|problems| panic!("{}: {problems}", path.display()));
        let written = tour.write();
        let again = Tour::read(&written).unwrap_or_else(|problems| panic!("{problems}\n{written}"));
        assert_eq!(again, tour, "{} is not the same once it is written", path.display());
        assert_eq!(again.write(), written, "{} is written differently each time", path.display());
        TourSource::open(&path).unwrap_or_else(|problems| panic!("{problems}"));
    }
}
