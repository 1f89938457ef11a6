//! What bad input gets: an error that names file and place and says what to do, through the door a program uses.
//!
//! Each case spoils one thing of a small tour on disk. What each stage says on its own is tested beside its code.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use bevy_picture_tour::assemble::{TourSource, assemble};
use bevy_picture_tour::maps::MapOptions;
use bevy_picture_tour::picture::{PngPixels, save_png};
use glam::UVec2;
use image::{ImageBuffer, Luma};

const TOUR: &str = r#"(
  version: 1,
  picture: (file: "lake.png", size: (64, 40)),
  camera: (
    horizon: ((0, 16), (64, 16)),
    focal_length: Known(60),
  ),
  water: (
    region: Mask("water.png"),
    pairs: [
      (point: (20, 10), reflection: (20, 26)),
      (point: (50, 12), reflection: (50, 24)),
    ],
  ),
  objects: [
    (
      name: "boat",
      support: Water,
      outline: Polygon([(28, 14), (40, 14), (40, 28), (28, 28)]),
      contact: ((28, 28), (40, 28)),
    ),
  ],
)
"#;

const SIZE: UVec2 = UVec2::new(64, 40);

/// Writes the sound tour: a gray gradient, water in its lower half.
fn write_sound(folder: &Path) {
    let pixels: Vec<[u8; 3]> = (0..SIZE.x * SIZE.y).map(|i| [(i / SIZE.x * 5) as u8; 3]).collect();
    save_png(&folder.join("lake.png"), SIZE, PngPixels::Rgb(&pixels)).unwrap();
    write_mask(&folder.join("water.png"), SIZE, 20);
    fs::write(folder.join("lake.tour.ron"), TOUR).unwrap();
}

/// A mask that is light from row `first` on.
fn write_mask(path: &Path, size: UVec2, first: u32) {
    let values: Vec<u8> = (0..size.x * size.y).map(|i| if i / size.x >= first { 255 } else { 0 }).collect();
    save_png(path, size, PngPixels::Gray(&values)).unwrap();
}

/// A PNG's first chunk alone: it says how large the picture is, and its pixels are missing.
fn png_header(width: u32, height: u32) -> Vec<u8> {
    let data = [&width.to_be_bytes(), &height.to_be_bytes(), [8, 2, 0, 0, 0].as_slice()].concat();
    let body = [b"IHDR".as_slice(), &data].concat();
    let crc = body.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(
            crc ^ u32::from(*byte),
            |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 },
        )
    });
    let length = (data.len() as u32).to_be_bytes();
    [b"\x89PNG\r\n\x1a\n".as_slice(), &length, &body, &(!crc).to_be_bytes()].concat()
}

/// Spoils a sound tour and returns what is said about it, as one text.
fn said(spoil: impl FnOnce(&Path)) -> String {
    let folder = tempfile::tempdir().unwrap();
    write_sound(folder.path());
    spoil(folder.path());
    let path = folder.path().join("lake.tour.ron");
    let begun = Instant::now();
    let problems = TourSource::open(&path).expect_err("what was spoiled should be an error");
    let seconds = begun.elapsed().as_secs_f64();
    assert!(seconds < 2.0, "it took {seconds} s to refuse this: {problems}");
    assert!(!problems.0.is_empty(), "an error without any problem");
    for line in problems.to_string().lines() {
        assert!(!line.trim_end().ends_with([';', ':']), "a message ends in nothing: {line}");
    }
    // Without the folder, whose name is another each time.
    problems.to_string().replace(&format!("{}/", folder.path().display()), "")
}

/// What is said when one passage of the tour is another.
fn said_with(old: &str, new: &str) -> String {
    assert_eq!(TOUR.matches(old).count(), 1, "{old} is not once in the tour");
    said(|folder| fs::write(folder.join("lake.tour.ron"), TOUR.replace(old, new)).unwrap())
}

/// What is said when a file has other bytes.
fn said_with_file(name: &str, bytes: &[u8]) -> String {
    said(|folder| fs::write(folder.join(name), bytes).unwrap())
}

/// Holds that a message starts at this line of the tour and has all words, place and advice among them.
fn names(said: &str, line: u32, words: &[&str]) {
    let start = format!("lake.tour.ron:{line}:");
    assert!(said.starts_with(&start), "it does not start with {start}: {said}");
    for word in words {
        assert!(said.contains(word), "{word:?} is not in: {said}");
    }
}

#[test]
fn the_tour_that_is_spoiled_is_sound() {
    let folder = tempfile::tempdir().unwrap();
    write_sound(folder.path());
    let source = TourSource::open(&folder.path().join("lake.tour.ron"));
    let source = source.unwrap_or_else(|problems| panic!("{problems}"));
    assemble(&source, &MapOptions::default(), &|_, _| true).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn a_tour_that_cannot_be_read_says_so() {
    let gone = said(|folder| fs::remove_file(folder.join("lake.tour.ron")).unwrap());
    for word in ["lake.tour.ron", "cannot be read", "picture-tour new"] {
        assert!(gone.contains(word), "{word:?} is not in: {gone}");
    }
    let tour = "lake.tour.ron";
    names(&said_with_file(tour, b"Dear reader, this is a letter."), 1, &["no tour file", "picture-tour new"]);
    names(&said_with_file(tour, b""), 1, &["empty", "picture-tour new"]);
    let cut = TOUR.find("pairs").unwrap();
    names(&said_with_file(tour, &TOUR.as_bytes()[..cut]), 9, &["ends in the middle"]);
    let binary = said_with_file(tour, &[0x89, b'P', b'N', b'G', 0xff, 0xfe]);
    assert!(binary.contains("lake.tour.ron") && binary.contains("cannot be read"), "{binary}");
}

#[test]
fn versions_fields_and_numbers_are_told_with_line_and_advice() {
    names(&said_with("version: 1", "version: 2"), 2, &["version", "newer version of the program"]);
    names(&said_with("horizon:", "horizont:"), 5, &["camera.horizont", "`horizon`"]);
    names(&said_with("(20, 10)", "(NaN, 10)"), 11, &["water.pairs[0].point", "finite"]);
    let two = said_with("[(28, 14), (40, 14), (40, 28), (28, 28)]", "[(28, 14), (40, 14)]");
    names(&two, 19, &["objects[0].outline", "three corners"]);
    let above = said_with("reflection: (20, 26)", "reflection: (20, 12)");
    names(&above, 11, &["water.pairs[0].reflection", "above the horizon"]);
    let foot = said_with("contact: ((28, 28), (40, 28))", "contact: ((28, 14), (40, 28))");
    names(&foot, 20, &["objects[0].contact[0]", "above the horizon"]);
}

#[test]
fn a_reflection_on_dry_land_is_told_from_the_mask() {
    let dry = said(|folder| write_mask(&folder.join("water.png"), SIZE, 25));
    names(&dry, 12, &["water.pairs[1].reflection", "dry land"]);
}

#[test]
fn neither_pairs_nor_horizon_is_told_by_what_to_mark() {
    let text = TOUR
        .replace("    horizon: ((0, 16), (64, 16)),\n", "")
        .replace("      (point: (20, 10), reflection: (20, 26)),\n", "")
        .replace("      (point: (50, 12), reflection: (50, 24)),\n", "");
    let none = said_with_file("lake.tour.ron", text.as_bytes());
    names(&none, 4, &["camera.horizon", "mark the horizon"]);
}

#[test]
fn pictures_that_are_none_are_refused_by_name() {
    let gone = said(|folder| fs::remove_file(folder.join("lake.png")).unwrap());
    names(&gone, 3, &["picture.file", "lake.png", "put the file beside the tour"]);
    let text = said_with_file("lake.png", b"This is a text, whatever it is called.");
    names(&text, 3, &["picture.file", "lake.png", "save it as PNG, JPEG, TIFF or WebP"]);
    names(&said_with_file("lake.png", b""), 3, &["picture.file", "lake.png"]);
    let half = {
        let folder = tempfile::tempdir().unwrap();
        write_sound(folder.path());
        let bytes = fs::read(folder.path().join("lake.png")).unwrap();
        bytes[..bytes.len() / 2].to_vec()
    };
    names(&said_with_file("lake.png", &half), 3, &["picture.file", "lake.png", "damaged"]);
}

#[test]
fn sizes_out_of_bounds_are_refused_before_decoding() {
    names(&said_with_file("lake.png", &png_header(0, 40)), 3, &["picture.file", "0 x 40 pixels"]);
    let begun = Instant::now();
    let large = said_with_file("lake.png", &png_header(60_000, 60_000));
    names(&large, 3, &["picture.file", "60000 x 60000 pixels", "scale it down"]);
    assert!(begun.elapsed() < Duration::from_millis(500), "{:?} to refuse a header", begun.elapsed());
    names(&said_with_file("water.png", &png_header(60_000, 60_000)), 9, &["water.region", "scale it down"]);
}

#[test]
fn masks_that_do_not_fit_are_refused_by_name() {
    let other = said(|folder| write_mask(&folder.join("water.png"), UVec2::new(30, 30), 15));
    names(&other, 9, &["water.region", "water.png", "30 x 30", "64 x 40"]);
    let gone = said(|folder| fs::remove_file(folder.join("water.png")).unwrap());
    names(&gone, 9, &["water.region", "water.png", "put the file beside the tour"]);
    let empty = said(|folder| {
        let tour = TOUR.replace("Polygon([(28, 14), (40, 14), (40, 28), (28, 28)])", "Mask(\"boat.png\")");
        fs::write(folder.join("lake.tour.ron"), tour).unwrap();
        write_mask(&folder.join("boat.png"), SIZE, 40);
    });
    names(&empty, 19, &["objects[0].outline", "covers nothing"]);
    let shape = said_with("size: (64, 40)", "size: (64, 64)");
    names(&shape, 3, &["picture.size", "64 × 40"]);
}

/// The sound tour with a boat and a sea that were recorded, their files beside it.
fn recorded(folder: &Path) {
    let contact = "contact: ((28, 28), (40, 28))";
    let waves = "  waves: (sea: Recorded(first: \"sea/08.png\", count: 3, frames_per_second: 10, height: 0.2, area: (8, 5))),\n)\n";
    let tour = TOUR.replace(contact, &format!("{contact}, motion: Recorded(poses: \"boat.json\")"));
    let end = tour.rfind(')').unwrap();
    fs::write(folder.join("lake.tour.ron"), format!("{}{waves}", &tour[..end])).unwrap();
    fs::write(folder.join("boat.json"), r#"[{"seconds": 0, "position": [0, 0, 0]}]"#).unwrap();
    fs::create_dir(folder.join("sea")).unwrap();
    for name in ["08", "09", "10"] {
        write_frame(&folder.join(format!("sea/{name}.png")), 16, 10);
    }
}

/// A frame of 16-bit gray.
fn write_frame(path: &Path, width: u32, height: u32) {
    ImageBuffer::from_fn(width, height, |x, y| Luma([(900 * x + 70 * y) as u16])).save(path).unwrap();
}

/// What is said when something of the recorded tour is spoiled.
fn said_of_recorded(spoil: impl FnOnce(&Path)) -> String {
    said(|folder| {
        recorded(folder);
        spoil(folder);
    })
}

#[test]
fn recordings_that_cannot_be_used_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    write_sound(folder.path());
    recorded(folder.path());
    let open = || TourSource::open(&folder.path().join("lake.tour.ron"));
    let source = open().unwrap_or_else(|problems| panic!("{problems}"));
    assert_eq!(source.recordings.sea.unwrap().count(), 3);
    assert!(source.notes.is_empty(), "{:?}", source.notes);
    // Eight bits are read, and told.
    let gray: Vec<u8> = (0..160).collect();
    save_png(&folder.path().join("sea/09.png"), UVec2::new(16, 10), PngPixels::Gray(&gray)).unwrap();
    let notes = open().unwrap().notes;
    assert!(notes.len() == 1 && notes[0].contains("8 bits"), "{notes:?}");

    let gone = said_of_recorded(|folder| fs::remove_file(folder.join("sea/09.png")).unwrap());
    names(&gone, 23, &["waves.sea.first", "sea/09.png", "put the file"]);
    let other = said_of_recorded(|folder| write_frame(&folder.join("sea/10.png"), 20, 10));
    names(&other, 23, &["waves.sea.first", "sea/10.png", "20 x 10", "16 x 10", "in one size"]);
    let small = said_of_recorded(|folder| write_frame(&folder.join("sea/08.png"), 7, 10));
    names(&small, 23, &["waves.sea.first", "sea/08.png", "7 x 10", "8 to 4096 pixels"]);
    let large =
        said_of_recorded(|folder| fs::write(folder.join("sea/08.png"), png_header(5000, 10)).unwrap());
    names(&large, 23, &["sea/08.png", "5000 x 10", "8 to 4096 pixels"]);
    let text = said_of_recorded(|folder| fs::write(folder.join("sea/08.png"), "no frame").unwrap());
    names(&text, 23, &["waves.sea.first", "sea/08.png", "text file"]);
    let json = said_of_recorded(|folder| fs::write(folder.join("boat.json"), "[{\"seconds\": 0").unwrap());
    names(&json, 20, &["objects[0].motion.poses", "boat.json", "do not read", "write a list"]);
    let none = said_of_recorded(|folder| fs::write(folder.join("boat.json"), "[]").unwrap());
    names(&none, 20, &["objects[0].motion.poses", "boat.json", "empty", "at least one"]);
    let many = said_of_recorded(|folder| {
        let tour = fs::read_to_string(folder.join("lake.tour.ron")).unwrap();
        fs::write(folder.join("lake.tour.ron"), tour.replace("count: 3", "count: 5000")).unwrap();
    });
    names(&many, 23, &["waves.sea.count", "5000", "4096"]);
    let uncounted = said_of_recorded(|folder| {
        let tour = fs::read_to_string(folder.join("lake.tour.ron")).unwrap();
        fs::write(folder.join("lake.tour.ron"), tour.replace("sea/08.png", "sea/frame.png")).unwrap();
    });
    names(&uncounted, 23, &["waves.sea.first", "no digits", "sea/0001.png"]);
    // All at once, the picture's among them.
    let all = said_of_recorded(|folder| {
        for file in ["water.png", "boat.json", "sea/09.png"] {
            fs::remove_file(folder.join(file)).unwrap();
        }
    });
    for word in ["water.region", "objects[0].motion.poses", "waves.sea.first"] {
        assert!(all.contains(word), "{word:?} is not in: {all}");
    }
}

#[test]
fn a_path_that_leaves_the_folder_is_not_read() {
    let place = tempfile::tempdir().unwrap();
    let inside = place.path().join("tour");
    fs::create_dir(&inside).unwrap();
    write_sound(place.path());
    write_sound(&inside);
    for path in ["../lake.png", "masks/../../lake.png", "/etc/hostname", "https://example.org/lake.png"] {
        fs::write(inside.join("lake.tour.ron"), TOUR.replace("\"lake.png\"", &format!("{path:?}"))).unwrap();
        let problems =
            TourSource::open(&inside.join("lake.tour.ron")).expect_err("the path leaves the folder");
        let said = problems.to_string();
        for word in ["lake.tour.ron:3:", "picture.file", path, "below the tour's folder"] {
            assert!(said.contains(word), "{word:?} is not in: {said}");
        }
    }
}

#[test]
fn several_mistakes_in_files_are_told_at_once() {
    let both = said(|folder| {
        write_mask(&folder.join("water.png"), UVec2::new(30, 30), 15);
        let tour = TOUR.replace("Polygon([(28, 14), (40, 14), (40, 28), (28, 28)])", "Mask(\"none.png\")");
        fs::write(folder.join("lake.tour.ron"), tour).unwrap();
    });
    assert_eq!(both.lines().count(), 2, "two problems, a line each: {both}");
    names(&both, 9, &["water.region", "lake.tour.ron:19:", "objects[0].outline", "none.png"]);
}
