//! A background is cut as a person would mark it, or left alone.

use std::collections::HashMap;

use glam::{DVec2, DVec3, UVec2};

use super::*;
use crate::assemble::{hints, place};
use crate::depth::Agreement;
use crate::depth::tests::receding;
use crate::depth::tests::world::{Lake, camera, frontal};
use crate::picture::{PngPixels, encode_png};
use crate::scene::Surface;
use crate::tour::{Document, FocalLength, ReflectionPair, Scale, WaterArea};

const SIZE: UVec2 = UVec2::new(480, 270);

/// Walls, 2 m above still water.
fn lake(walls: &[(f64, f64, f64)]) -> Lake {
    let colors = [[90.0, 110.0, 70.0], [130.0, 135.0, 145.0]];
    let walls = walls.iter().zip(colors);
    let walls = walls.map(|(&(distance, height, jagged), color)| frontal(distance, height, jagged, color));
    Lake { camera: camera(2.0, -2.0, 0.0), walls: walls.collect(), slope: 0.0, clouds: true, mirror: true }
}

/// A shore before mountains.
fn two_walls() -> Lake {
    lake(&[(60.0, 3.0, 2.0), (150.0, 20.0, 6.0)])
}

type Files = HashMap<String, Vec<u8>>;

/// The tour of a lake as a person marks it, with a pair on each wall, and its files.
fn marked(lake: &Lake, change: impl FnOnce(&mut TourFile)) -> (Tour, TourSource, Files) {
    let shot = lake.shot();
    let camera = lake.camera;
    let mut file: TourFile = Document::new("lake.png".to_owned());
    file.picture.size = Some(SIZE);
    file.camera.horizon = camera.horizon();
    file.camera.focal_length = FocalLength::Known(camera.intrinsics.focal_px);
    file.camera.scale = Some(Scale::HeightAboveWater(camera.pose.position.y));
    // Low on the shore, and on the mountains above it.
    let pairs = lake.walls.iter().zip([0.3, 0.7]).map(|(wall, part)| {
        let at = DVec3::new(3.0, part * wall.height, wall.ends[0].y);
        let [point, reflection] =
            [at, at * DVec3::new(1.0, -1.0, 1.0)].map(|at| camera.project(at).expect("it lies ahead"));
        ReflectionPair { point, reflection, on: Some("background".to_owned()), name: None }
    });
    file.water = Some(WaterArea { region: Region::Mask("water.png".to_owned()), pairs: pairs.collect() });
    change(&mut file);
    let files = Files::from([
        ("lake.png".to_owned(), encode_png(SIZE, PngPixels::Rgb(shot.picture.pixels())).unwrap()),
        ("water.png".to_owned(), encode_png(SIZE, PngPixels::Gray(shot.water.values())).unwrap()),
    ]);
    let tour = Tour::check(file).unwrap_or_else(|problems| panic!("{problems}"));
    let source = read(&tour, &files);
    (tour, source, files)
}

fn read(tour: &Tour, files: &Files) -> TourSource {
    let read = |file: &RelativePath| files.get(file.as_str()).cloned().ok_or_else(|| "not made".to_owned());
    TourSource::read(tour, &read).unwrap_or_else(|problems| panic!("{problems}"))
}

fn cut(tour: &Tour, source: &TourSource, anew: bool) -> Result<BandedTour, BandError> {
    let options = CutOptions { folder: RelativePath::new("lake.masks").unwrap(), anew };
    cut_bands(tour, source, &options, &|_| true)
}

#[test]
fn two_distances_become_two_bands_as_a_person_marks_them() {
    let (tour, source, mut files) = marked(&two_walls(), |_| {});
    let found = cut(&tour, &source, false).unwrap();
    let background = &found.tour.background;
    assert_eq!((&background.place, background.bands.len()), (&None, 2), "{background:?}");
    for (band, truth) in background.bands.iter().zip([60.0, 150.0]) {
        let BackgroundPlace::Distance(meters) = band.place else { panic!("{:?}", band.place) };
        assert!((meters / truth - 1.0).abs() < 0.03, "{meters} m instead of {truth}");
    }
    assert!(background.bands[0].region.is_some() && background.bands[1].region.is_none());
    assert!(found.tour.sky.as_ref().is_some_and(|sky| sky.region.is_some()), "the sky is one");
    let on: Vec<_> = found.tour.water.iter().flat_map(|water| &water.pairs).map(|pair| &pair.on).collect();
    let names = background.bands.iter().map(|band| Some(band.name.clone())).collect::<Vec<_>>();
    assert_eq!(on, names.iter().collect::<Vec<_>>(), "the pairs are on their bands");

    // The new tour reads with the masks beside it.
    for (path, mask) in &found.masks {
        let png = encode_png(mask.size(), PngPixels::Gray(mask.values())).unwrap();
        assert!(files.insert(path.to_string(), png).is_none(), "{path} is there twice");
    }
    let banded = read(&found.tour, &files);
    assert!(matches!(cut(&found.tour, &banded, false), Err(BandError::HasBands)));
    let again = cut(&found.tour, &banded, true).unwrap();
    assert_eq!(again.tour.background.bands.len(), 2);
}

#[test]
fn one_distance_is_set_and_nothing_is_cut() {
    let (tour, source, _) = marked(&lake(&[(90.0, 60.0, 0.0)]), |_| {});
    let found = cut(&tour, &source, false).unwrap();
    let background = &found.tour.background;
    let Some(BackgroundPlace::Distance(meters)) = background.place else { panic!("{background:?}") };
    assert!((meters / 90.0 - 1.0).abs() < 0.03, "{meters} m instead of 90");
    assert!(background.bands.is_empty() && found.masks.is_empty(), "{background:?}");
    let mut same = found.tour.to_file();
    same.background.place = None;
    assert_eq!(same, tour.to_file(), "only the distance is new");
}

#[test]
fn masks_are_as_large_as_the_picture_before_its_crop() {
    let crop = Crop { left: 40, top: 10, width: 420, height: 250 };
    let (tour, source, _) = marked(&two_walls(), |file| file.picture.crop = Some(crop));
    let found = cut(&tour, &source, false).unwrap();
    assert_eq!(found.tour.background.bands.len(), 2);
    assert!(!found.masks.is_empty());
    for (path, mask) in &found.masks {
        assert_eq!(mask.size(), SIZE, "{path}");
        let bounds = mask.bounds().unwrap();
        assert!(bounds.min.x >= 40 && bounds.min.y >= 10 && bounds.max.x <= 460, "{path}: {bounds:?}");
    }
}

#[test]
fn a_receding_wall_is_written_by_its_contact_line() {
    let lake = receding();
    let crop = Crop { left: 40, top: 10, width: 420, height: 250 };
    let (tour, source, mut files) = marked(&lake, |file| {
        file.picture.crop = Some(crop);
        file.water.iter_mut().for_each(|water| water.pairs.clear());
    });
    let found = cut(&tour, &source, false).unwrap();
    let bands = &found.tour.background.bands;
    let [wall, mountains] = bands.as_slice() else { panic!("{bands:?}") };
    let BackgroundPlace::Contact(line) = &wall.place else { panic!("{:?}", wall.place) };
    assert!(matches!(mountains.place, BackgroundPlace::Distance(_)) && mountains.region.is_none());
    let [far, near] = lake.walls[0].ends;
    let off = |at: DVec3| (near - far).perp().normalize().dot(DVec2::new(at.x, at.z) - far).abs();
    for point in line {
        let ray = lake.camera.ray(*point);
        let foot = ray.at(-ray.origin.y / ray.direction.y);
        assert!(off(foot) < 0.03 * -foot.z, "its foot at {foot} is {} m off the wall", off(foot));
    }
    for (path, mask) in &found.masks {
        files.insert(path.to_string(), encode_png(SIZE, PngPixels::Gray(mask.values())).unwrap());
    }
    let scene = place(&read(&found.tour, &files)).unwrap().scene;
    let placed = scene.components.iter().find(|component| component.name == wall.name).unwrap();
    let Surface::Wall(placed) = placed.surface else { panic!("{:?}", placed.surface) };
    assert!(placed.along.y.abs() > 0.9 * (near - far).normalize().y.abs(), "{placed:?}");
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let rough = Lake { mirror: false, ..two_walls() };
    let (tour, source, _) = marked(&rough, |_| {});
    assert!(matches!(cut(&tour, &source, false), Err(BandError::NoMirror)));

    let lake = two_walls();
    let (tour, source, _) = marked(&lake, |file| {
        file.water = None;
        file.camera.scale = Some(Scale::HeightAboveGround(2.0));
        file.ground = Some(crate::tour::GroundArea {
            region: Region::Mask("water.png".to_owned()),
            height_above_water: 0.0,
        });
    });
    assert!(matches!(cut(&tour, &source, false), Err(BandError::NoWater)));

    let (tour, source, _) = marked(&lake, |_| {});
    let options = CutOptions { folder: RelativePath::new("m").unwrap(), anew: false };
    let stopped = cut_bands(&tour, &source, &options, &|share| share < 0.1);
    assert!(matches!(stopped, Err(BandError::Depth(DepthError::Cancelled))));
}

#[test]
fn hints_find_the_band_that_stands_wrong() {
    let (tour, source, mut files) = marked(&two_walls(), |_| {});
    let found = cut(&tour, &source, false).unwrap();
    for (path, mask) in &found.masks {
        files.insert(path.to_string(), encode_png(mask.size(), PngPixels::Gray(mask.values())).unwrap());
    }
    let mut file = found.tour.to_file();
    file.background.bands[0].place = BackgroundPlace::Distance(90.0);
    let source = read(&Tour::check(file).unwrap(), &files);
    let scene = place(&source).unwrap().scene;
    let map = measure_depth(&source, &scene.camera, &|_| true).unwrap().unwrap();
    let hints = hints(&source, &scene, &map);
    let verdicts: Vec<Agreement> = hints.standing.iter().map(|hint| hint.by_mirror.agreement).collect();
    assert_eq!(verdicts, [Agreement::WrongFoot, Agreement::Agrees], "{:?}", hints.standing);
    let by = hints.by_pairs.expect("there are pairs enough").parameters;
    assert!((by.pitch.to_degrees() + 2.0).abs() < 0.1 && by.roll.to_degrees().abs() < 0.1, "{by:?}");
}

#[test]
fn on_the_open_sea_the_sky_closes_the_scene() {
    let sea = lake(&[]);
    let (tour, source, mut files) = marked(&sea, |_| {});
    let land = source.water.as_ref().unwrap().values().iter().map(|&water| 255 - water).collect::<Vec<u8>>();
    files.insert("sky.png".to_owned(), encode_png(SIZE, PngPixels::Gray(&land)).unwrap());
    let mut file = tour.to_file();
    file.sky = Some(Sky { region: Some(Region::Mask("sky.png".to_owned())), drift: None });
    let open = place(&read(&Tour::check(file.clone()).unwrap(), &files)).unwrap();
    assert_eq!(open.scene.components.len(), 1, "{:?}", open.scene.components);
    assert_eq!(open.scene.last_layer().surface, Surface::Infinity);
    let report = &open.solution.report;
    assert!(report.parameter("background_distance").is_none() && report.remarks.is_empty(), "{report:?}");
    // A fifth of the sky is land, of which nothing tells the distance.
    let shore = land.iter().enumerate().map(|(i, &land)| if i % SIZE.x as usize > 384 { 0 } else { land });
    let shore: Vec<u8> = shore.collect();
    files.insert("sky.png".to_owned(), encode_png(SIZE, PngPixels::Gray(&shore)).unwrap());
    let closed = place(&read(&Tour::check(file).unwrap(), &files)).unwrap();
    assert!(closed.scene.components.iter().any(|component| component.name == "background"));
    let remarks = &closed.solution.report.remarks;
    assert!(remarks.iter().any(|remark| remark.contains("are assumed")), "{remarks:?}");
}

#[test]
fn a_large_picture_is_measured_at_a_smaller_size() {
    let (_, source, _) = marked(&two_walls(), |_| {});
    let pixels = f64::from(SIZE.x * SIZE.y);
    let [whole, small] = [pixels, 0.6 * pixels].map(|most| measured_bands(&source, most, &|_| true).unwrap());
    assert_eq!(whole.len(), small.len(), "{small:?}");
    for (whole, small) in whole.iter().zip(&small) {
        assert_eq!(small.mask.size(), SIZE);
        let is_near =
            small.distance == whole.distance || (small.distance / whole.distance - 1.0).abs() < 0.03;
        assert!(is_near, "{} m instead of {}", small.distance, whole.distance);
        for (a, b) in whole.contact.iter().flatten().zip(small.contact.iter().flatten()) {
            assert!((a.y() - b.y()).abs() < 0.5 && (a.x() - b.x()).abs() < 10.0, "{b:?} instead of {a:?}");
        }
        let pairs = whole.mask.values().iter().zip(small.mask.values());
        let other = pairs.filter(|(a, b)| (**a > 127) != (**b > 127)).count();
        assert!((other as f64) < 0.02 * pixels, "{other} pixels go elsewhere");
    }
}
