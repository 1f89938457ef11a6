//! What reads, what does not, and what is said about it.

mod refused;

use glam::UVec2;

use crate::picture::PicturePoint;

use super::*;

/// Every section and every kind of value.
const FULL: &str = r#"// A full tour.
Tour(
  version: 1,
  picture: (file: "lake.png", size: (1920, 1080), medium: Painting, crop: (left: 100, top: 50, width: 1800, height: 1000)),
  camera: (
    horizon: ((0, 482.7), (1920, 480)),
    principal_point: (960, 540),
    focal_length: Between(1500, 1700.5),
    scale: Length(on: "boat", from: (900, 740), to: (1300, 740), meters: 3.2),
    method: Paper,
  ),
  water: (
    region: Polygon([(0, 517), (1920, 516), (1920, 1080), (0, 1080)]),
    pairs: [
      (point: (826.6, 684.4), reflection: (827.0, 837.5), on: "boat", name: "mast"),
      (point: (672, 314.8), reflection: (674.3, 696.3), on: "far shore"),
      (point: (700, 300), reflection: (700, 700), on: "background"),
    ],
  ),
  ground: (region: Mask("masks/ground.png"), height_above_water: 0.67),
  background: (
    place: Distance(90),
    bands: [
      (name: "far shore", region: Mask("masks/farshore.png"), place: Contact([(0, 517), (1920, 516)])),
      (name: "mountains", place: Infinity),
    ],
  ),
  sky: (region: Mask("masks/sky.png"), drift: (speed: 1.5, direction_deg: 10)),
  objects: [
    (name: "boat", support: Water, outline: Mask("masks/boat.png"), contact: ((856, 742.8), (1321, 742.8)),
      motion: Course(waypoints: [(0, -11), (5.5, -20)], speed: 1.2, draft: 0.2, closed: true)),
    (name: "tree", support: Ground, outline: Polygon([(0, 100), (300, 100), (150, 540)]), contact: ((100, 542), (200, 542)),
      turns_to_camera: true, motion: Sway(kind: Trunk, root: (150, 540), tip: (150, 100), damping: 0.1)),
    (name: "buoy", support: Water, outline: Mask("masks/buoy.png"), contact: ((400, 700), (420, 700)),
      motion: Floating(draft: 0.3, mass: 40)),
    (name: "ship", support: Water, outline: Mask("masks/ship.png"), contact: ((500, 600), (620, 590)),
      motion: Recorded(poses: "ship.json", looped: true)),
  ],
  wind: (speed: 4, direction_deg: 30, gusts: 0.5, seed: 7),
  waves: (sea: Recorded(first: "waves/0001.png", count: 200, frames_per_second: 25, height: 0.5, area: (40, 40)), ripples: false),
  path: (
    keyframes: [(position: (0, 1.8, 0), seconds: 0), (position: (1, 1.5, -2), yaw_deg: 4, pitch_deg: -2, roll_deg: 1, seconds: 5, hold: 1, easing: Linear)],
    looped: true,
  ),
)
"#;

/// The example of the format's description.
fn example() -> &'static str {
    let readme = include_str!("../README.md");
    let start = readme.find("```ron\n").unwrap() + 7;
    &readme[start..start + readme[start..].find("```").unwrap()]
}

fn problems(text: &str) -> Vec<Problem> {
    Tour::read(text).expect_err("the text has problems").0
}

/// The problems of [`FULL`] with one passage exchanged.
fn problems_with(old: &str, new: &str) -> Vec<Problem> {
    assert_eq!(FULL.matches(old).count(), 1, "{old} is not once in the example");
    problems(&FULL.replace(old, new))
}

/// The one problem, at a way, with a message that holds all of `words`.
fn only(problems: &[Problem], path: &str, words: &[&str]) {
    let shown = Problems(problems.to_vec()).to_string();
    assert_eq!(problems.len(), 1, "{shown}");
    assert_eq!(problems[0].place.path, path, "{shown}");
    assert!(problems[0].place.line.is_some(), "{shown}");
    for word in words {
        assert!(shown.contains(word), "{word} is not in: {shown}");
    }
}

#[test]
fn what_is_written_reads_the_same() {
    for text in [FULL, example()] {
        let tour = Tour::read(text).unwrap();
        let written = tour.write();
        assert_eq!(Tour::read(&written).unwrap(), tour, "{written}");
        assert_eq!(Tour::check(tour.to_file()).unwrap(), tour);
    }
    for sea in ["Octaves(max_height: 0.1, octaves: 4)", "Jonswap(depth: 3)", "Jonswap()", "Calm"] {
        let text = example().replace("wind: (", &format!("waves: (sea: {sea}),\n  wind: ("));
        let tour = Tour::read(&text).unwrap();
        assert_eq!(Tour::read(&tour.write()).unwrap(), tour, "{}", tour.write());
    }
}

#[test]
fn defaults_are_not_written() {
    let mut file = TourFile::new("lake.png".into());
    file.camera.horizon = Some([PicturePoint::new(0.0, 40.0), PicturePoint::new(100.0, 40.0)]);
    file.water = Some(WaterArea { region: Region::Mask("water.png".into()), pairs: Vec::new() });
    let tour = Tour::check(file).unwrap();
    let text = tour.write();
    for absent in ["wind", "waves", "objects", "pairs", "scale", "None", "Some"] {
        assert!(!text.contains(absent), "{absent} is in {text}");
    }
    assert_eq!(tour.scale(), (Scale::HeightAboveWater(ASSUMED_HEIGHT), true));
}

#[test]
fn the_template_reads() {
    for size in [UVec2::new(1920, 1080), UVec2::new(20, 20), UVec2::new(600, 4000)] {
        let text = Tour::template("my \"lake\".png", size);
        let tour = Tour::read(&text).unwrap_or_else(|problems| panic!("{problems}\n{text}"));
        assert_eq!((tour.picture.file.as_str(), tour.picture.size), ("my \"lake\".png", Some(size)));
        assert!(!text.contains('$'), "{text}");
    }
    let text = Tour::template("lake.png", UVec2::new(1920, 1080));
    // What is commented out reads as well once the slashes are gone.
    let is_value = |line: &str| ["(", ")", "  "].iter().any(|start| line.starts_with(start));
    let uncommented = |line: &str| match line.trim_start().strip_prefix("// ") {
        Some(rest) if line.starts_with(' ') && is_value(rest) => rest.to_owned() + "\n",
        _ => line.to_owned() + "\n",
    };
    let filled: String = text.lines().map(uncommented).collect();
    let tour = Tour::read(&filled).unwrap_or_else(|problems| panic!("{problems}\n{filled}"));
    assert_eq!(tour.objects.len(), 1);
}

#[test]
fn every_file_is_told_with_its_place() {
    let files = Tour::read(FULL).unwrap().files();
    let told: Vec<(&str, &str)> = files.iter().map(|(place, path)| (place.as_str(), path.as_str())).collect();
    assert_eq!(
        told,
        [
            ("picture.file", "lake.png"),
            ("ground.region", "masks/ground.png"),
            ("background.bands[0].region", "masks/farshore.png"),
            ("sky.region", "masks/sky.png"),
            ("objects[0].outline", "masks/boat.png"),
            ("objects[2].outline", "masks/buoy.png"),
            ("objects[3].outline", "masks/ship.png"),
            ("objects[3].motion.poses", "ship.json"),
            ("waves.sea.first", "waves/0001.png"),
        ]
    );
}

#[test]
fn masks_tell_dry_reflections() {
    let tour = Tour::read(FULL).unwrap();
    let found = tour.dry_reflections(&|point| if point.y() > 750.0 { 1.0 } else { 0.4 });
    let places: Vec<_> = found.iter().map(|problem| problem.place.path.as_str()).collect();
    assert_eq!(places, ["water.pairs[1].reflection", "water.pairs[2].reflection"]);
}

#[test]
fn a_pair_knows_its_carrier() {
    let tour = Tour::read(FULL).unwrap();
    let pairs = &tour.water.as_ref().unwrap().pairs;
    let carriers: Vec<_> = pairs.iter().map(|pair| tour.carrier(pair)).collect();
    assert_eq!(carriers, [Some(Carrier::Object(0)), Some(Carrier::Band(0)), Some(Carrier::Background)]);
}

#[test]
fn a_larger_scan_enlarges_every_number_in_pixels() {
    let tour = Tour::read(FULL).unwrap();
    let double = tour.scaled_to(UVec2::new(3840, 2160));
    assert_eq!(double.camera.horizon.unwrap()[0], PicturePoint::new(0.0, 965.4));
    assert_eq!(double.camera.focal_length, FocalLength::Between(3000.0, 3401.0));
    assert_eq!(double.objects[0].contact[0], PicturePoint::new(1712.0, 1485.6));
    assert_eq!(double.picture.crop, Some(Crop { left: 200, top: 100, width: 3600, height: 2000 }));
    assert_eq!(double.scaled_to(UVec2::new(1920, 1080)), tour);
    Tour::check(double.to_file()).expect("an enlarged tour is as sound");

    assert!(tour.check_size(UVec2::new(3840, 2160)).is_ok());
    assert!(tour.check_size(UVec2::new(961, 540)).is_ok());
    let problem = tour.check_size(UVec2::new(1000, 1000)).unwrap_err();
    assert!(problem.to_string().contains("1000 × 1000"), "{problem}");
    let unsized_tour = Tour::read(&FULL.replace("size: (1920, 1080), ", "")).unwrap();
    assert!(unsized_tour.check_size(UVec2::new(100, 100)).is_err(), "the crop does not fit");
}

#[test]
fn a_crop_keeps_the_principal_point_of_the_whole() {
    let tour = Tour::read(&FULL.replace("    principal_point: (960, 540),\n", "")).unwrap();
    let actual = UVec2::new(3840, 2160);
    let cropped = tour.in_pixels_of(actual);
    assert_eq!(tour.crop_in(actual), Crop { left: 200, top: 100, width: 3600, height: 2000 });
    assert_eq!(cropped.picture.size, Some(UVec2::new(3600, 2000)));
    assert_eq!(cropped.camera.principal_point, Some(PicturePoint::new(1720.0, 980.0)));
    assert_eq!(cropped.objects[0].contact[0], PicturePoint::new(1512.0, 1385.6));
    assert_eq!(cropped.picture.crop, None);
}

#[test]
fn a_tour_is_saved_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lake.tour.ron");
    let tour = Tour::read(FULL).unwrap();
    std::fs::write(&path, "old").unwrap();
    tour.save(&path).unwrap();
    assert_eq!(Tour::read(&std::fs::read_to_string(&path).unwrap()).unwrap(), tour);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no other file stays behind");
    assert!(tour.save(&folder.path().join("none").join("x.ron")).is_err());
}
