//! Round trips, damaged and forged files, fingerprints.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use glam::{IVec2, UVec2};

use super::header::{Header, PREAMBLE, read_header, write_header};
use super::write::pack;
use super::*;
use crate::assemble::{TourSource, assemble};
use crate::maps::{Layer, MapOptions};
use crate::picture::{PicturePoint, PngPixels, encode_png};
use crate::solve::SolveError;
use crate::tour::{
    BackgroundPlace, Band, CameraPath, Crop, Document, Floating, FocalLength, Keyframe, Motion, Object,
    Recorded, ReflectionPair, Region, RelativePath, Scale, Sky, Support, TourFile, WaterArea,
};

/// Of the picture before the crop, pixels.
const SIZE: UVec2 = UVec2::new(96, 54);

/// Names and bytes of all files.
type Files = BTreeMap<&'static str, Vec<u8>>;

/// A boat on water before a shore, under a sky.
fn files() -> Files {
    let is_boat = |x: u32, y: u32| (34..56).contains(&x) && (14..34).contains(&y);
    let cells = || (0..SIZE.y).flat_map(|y| (0..SIZE.x).map(move |x| (x, y)));
    let gray = |value: &dyn Fn(u32, u32) -> bool| {
        let values: Vec<u8> = cells().map(|(x, y)| 255 * u8::from(value(x, y))).collect();
        encode_png(SIZE, PngPixels::Gray(&values)).unwrap()
    };
    let colors: Vec<[u8; 3]> = cells()
        .map(|(x, y)| match (is_boat(x, y), y) {
            (true, _) => [150 + (x % 5) as u8, 40, 30],
            (_, 0..24) => [90 + y as u8, 120 + (x % 7) as u8, 60],
            _ => [60 + (47 - y.min(47)) as u8, 90 + (x % 7) as u8, 70],
        })
        .collect();
    BTreeMap::from([
        ("lake.png", encode_png(SIZE, PngPixels::Rgb(&colors)).unwrap()),
        ("boat.png", gray(&is_boat)),
        ("water.png", gray(&|x, y| y >= 24 && !is_boat(x, y))),
    ])
}

fn polygon<P>(corners: &[(f64, f64)]) -> Region<P> {
    Region::Polygon(points(corners))
}

fn points(at: &[(f64, f64)]) -> Vec<PicturePoint> {
    at.iter().map(|&(x, y)| PicturePoint::new(x, y)).collect()
}

fn document() -> TourFile {
    let point = PicturePoint::new;
    let mut tour: TourFile = Document::new("lake.png".to_owned());
    tour.picture.size = Some(SIZE);
    tour.picture.crop = Some(Crop { left: 4, top: 2, width: 88, height: 50 });
    tour.camera.horizon = Some([point(0.0, 20.0), point(96.0, 20.3)]);
    tour.camera.focal_length = FocalLength::Between(70.0, 95.0);
    tour.camera.scale = Some(Scale::HeightAboveWater(1.6));
    let pair = |up: f64, down: f64, on: &str| {
        let (point, reflection, name) = (point(70.0, up), point(70.0, down), Some("\"crest\"".to_owned()));
        ReflectionPair { point, reflection, on: Some(on.to_owned()), name }
    };
    let pairs = vec![pair(18.0, 28.4, "background"), pair(8.0, 38.4, "background")];
    tour.water = Some(WaterArea { region: Region::Mask("water.png".to_owned()), pairs });
    let place = BackgroundPlace::Contact(points(&[(0.0, 25.0), (50.0, 25.2), (96.0, 25.0)]));
    let region = Some(polygon(&[(0.0, 12.0), (30.0, 16.0), (30.0, 24.0), (0.0, 24.0)]));
    tour.background.bands.push(Band { name: "shore".to_owned(), region, place });
    tour.background.place = Some(BackgroundPlace::Distance(40.0));
    let region = Some(polygon(&[(0.0, 0.0), (96.0, 0.0), (96.0, 6.0), (0.0, 6.0)]));
    tour.sky = Some(Sky { region, drift: None });
    tour.objects.push(Object {
        name: "boat".to_owned(),
        support: Support::Water,
        outline: Region::Mask("boat.png".to_owned()),
        contact: [point(34.0, 34.0), point(56.0, 34.0)],
        turns_to_camera: false,
        motion: Motion::Static,
    });
    tour
}

fn tour(document: TourFile) -> Tour {
    Tour::check(document).unwrap_or_else(|problems| panic!("{problems}"))
}

fn read_from(files: &Files, file: &RelativePath) -> Result<Vec<u8>, String> {
    files.get(file.as_str()).cloned().ok_or_else(|| "not made".to_owned())
}

/// The tour, its pixels, its fingerprint, what it became, and the bytes of all that.
struct Made {
    tour: Tour,
    source: TourSource,
    fingerprint: Fingerprint,
    built: AssembledTour,
    bytes: Vec<u8>,
}

fn made() -> &'static Made {
    static MADE: OnceLock<Made> = OnceLock::new();
    MADE.get_or_init(|| {
        let (tour, files) = (tour(document()), files());
        let read = |file: &RelativePath| read_from(&files, file);
        let source = TourSource::read(&tour, &read).unwrap_or_else(|problems| panic!("{problems}"));
        let built = assemble(&source, &MapOptions::PREVIEW, &|_, _| true).unwrap();
        let fingerprint = fingerprint(&tour, &MapOptions::PREVIEW, &read).unwrap();
        let bytes = encode(&tour, &source, &built, fingerprint).unwrap();
        Made { tour, source, fingerprint, built, bytes }
    })
}

#[test]
fn what_is_read_back_is_what_was_baked() {
    let made = made();
    let baked = decode(&made.bytes).unwrap();
    assert_eq!(baked.built.scene.components.len(), 4, "a scene that tests something");
    assert!(baked.built.maps.components.iter().any(|maps| maps.reflection.is_some()));
    assert_eq!(baked.built.solution, made.built.solution);
    assert_eq!(baked.built.scene, made.built.scene);
    assert_eq!(baked.built.remarks, made.built.remarks);
    assert!(baked.built.maps == made.built.maps, "the maps differ");
    assert_eq!(baked.tour, made.source.tour);
    assert_eq!((baked.picture_size, baked.uncropped_size), (UVec2::new(88, 50), SIZE));
    assert_eq!(baked.fingerprint, made.fingerprint);
    assert_eq!(fingerprint_of(&made.bytes[..44]), Ok(made.fingerprint));
    assert_eq!(encode(&made.tour, &made.source, &made.built, made.fingerprint).unwrap(), made.bytes);
}

#[test]
fn a_baked_tour_shows_the_same_land() {
    let made = made();
    let land = made.built.land(&made.source.tour).unwrap();
    assert_eq!(decode(&made.bytes).unwrap().built.land(&made.source.tour), Some(land.clone()));
    // In the cropped picture: mountains, the shore, water, the boat on it and the boat before the mountains.
    for ((x, y), is_land) in
        [((70, 5), true), ((10, 18), true), ((70, 40), false), ((40, 29), false), ((40, 16), true)]
    {
        assert_eq!(land.get(x, y) >= 128, is_land, "at {x}, {y}: {}", land.get(x, y));
    }
}

#[test]
fn a_source_of_another_tour_is_not_baked() {
    let made = made();
    // Its crop is gone, so it no longer says of which picture it speaks.
    let found = encode(&made.source.tour, &made.source, &made.built, made.fingerprint);
    assert_eq!(found, Err(BakeError::OtherTour));
}

#[test]
fn a_changed_byte_is_found_wherever_it_is() {
    let bytes = &made().bytes;
    let step = bytes.len() / 500;
    for at in (0..300).chain((300..bytes.len()).step_by(step)).chain([bytes.len() - 1]) {
        let mut bytes = bytes.clone();
        bytes[at] ^= 1 << (at % 8);
        assert!(decode(&bytes).is_err(), "byte {at} of {} may change", bytes.len());
    }
}

#[test]
fn a_file_that_ends_early_or_late_is_found() {
    let bytes = &made().bytes;
    let step = bytes.len() / 300;
    for length in (1..300).chain((300..bytes.len()).step_by(step)).chain([bytes.len() - 1]) {
        let found = decode(&bytes[..length]).map(drop).unwrap_err();
        assert!(matches!(found, BakeError::Truncated { .. }), "{length} bytes: {found}");
    }
    let longer = [bytes.as_slice(), &[0]].concat();
    assert!(matches!(decode(&longer), Err(BakeError::Damaged(_))));
    assert_eq!(decode(&[]), Err(BakeError::NotBaked));
}

#[test]
fn random_bytes_give_errors() {
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 56) as u8
    };
    for round in 0..2000 {
        let kept = [0, 12, 44, 52, PREAMBLE][round % 5];
        let mut bytes = made().bytes[..kept].to_vec();
        bytes.extend((0..round % 200).map(|_| random()));
        assert!(decode(&bytes).is_err(), "{bytes:?} was read");
    }
}

#[test]
fn an_older_program_says_so() {
    let mut bytes = made().bytes.clone();
    bytes[8] = FORMAT_VERSION as u8 + 1;
    let found = decode(&bytes).map(drop).unwrap_err();
    assert_eq!(found, BakeError::OtherVersion { found: FORMAT_VERSION + 1, readable: FORMAT_VERSION });
    assert!(found.to_string().contains("picture-tour bake"), "{found}");
}

/// What a file gives whose header was `changed` and then hashed as it should be.
fn forged(change: impl FnOnce(&mut Header)) -> BakeError {
    let (fingerprint, mut header, layers) = read_header(&made().bytes).unwrap();
    change(&mut header);
    let mut bytes = write_header(fingerprint, &header).unwrap();
    bytes.extend(layers);
    decode(&bytes).map(drop).unwrap_err()
}

#[test]
fn a_header_that_claims_too_much_is_not_believed() {
    let sizes: [&dyn Fn(&mut Header); 9] = [
        &|header| header.components[0].texture.size = UVec2::splat(u32::MAX),
        &|header| header.components[0].texture.size = UVec2::splat(65_535),
        &|header| header.components[0].texture.size = UVec2::splat(20_000),
        &|header| header.components[0].texture.size.x += 1,
        &|header| header.components[0].texture.size.x -= 1,
        &|header| header.components[0].texture.origin = IVec2::MIN,
        &|header| header.plan.billboards.clear(),
        &|header| header.plan.camera.intrinsics.size = UVec2::ZERO,
        &|header| header.annotations.uncropped_size = UVec2::new(97, 54),
    ];
    for (index, change) in sizes.into_iter().enumerate() {
        let found = forged(change);
        assert!(matches!(found, BakeError::Sizes(_)), "change {index}: {found}");
    }
    let found = forged(|header| header.components[1].texture.packed = u64::MAX);
    assert!(matches!(found, BakeError::Truncated { .. }), "{found}");
    let found = forged(|header| header.tour.push('x'));
    assert!(matches!(found, BakeError::Header(_)), "{found}");
}

#[test]
fn marks_that_no_longer_solve_are_an_error() {
    let found = forged(|header| {
        header.annotations.horizon = None;
        header.annotations.pairs.clear();
    });
    assert_eq!(found, BakeError::Solve(SolveError::NothingToSolveFrom { found: 0 }));
}

#[test]
fn a_layer_that_is_no_lz4_is_an_error() {
    let (fingerprint, mut header, layers) = read_header(&made().bytes).unwrap();
    let mut layers = layers.to_vec();
    let entry = &mut header.components[0].texture;
    let own = &mut layers[..entry.packed as usize];
    own.fill(0xff);
    entry.hash = *blake3::hash(own).as_bytes();
    let bytes = [write_header(fingerprint, &header).unwrap(), layers].concat();
    assert!(matches!(decode(&bytes), Err(BakeError::Sizes(_))));
    let empty = Layer::filled(IVec2::ZERO, UVec2::new(0, 3), [0; 4]);
    assert_eq!(pack(&empty.into()).0.size.x, 0);
}

#[test]
fn the_fingerprint_follows_what_maps_depend_on() {
    let of = |document: TourFile, options: &MapOptions, files: &Files| {
        fingerprint(&tour(document), options, &|file| read_from(files, file)).unwrap()
    };
    let same = |change: &dyn Fn(&mut TourFile)| {
        let mut changed = document();
        change(&mut changed);
        of(changed, &MapOptions::PREVIEW, &files()) == made().fingerprint
    };
    assert!(same(&|_| ()));
    assert!(same(&|tour| tour.wind.speed += 1.0));
    let moving = |motion: Motion<String>| {
        let mut changed = document();
        changed.objects[0].motion = motion;
        of(changed, &MapOptions::PREVIEW, &files())
    };
    let floating = moving(Motion::Floating(Floating::of_draft(0.2)));
    assert_ne!(floating, made().fingerprint, "what moves has a rim in the maps");
    let recorded = Motion::Recorded(Recorded { poses: "poses.csv".to_owned(), looped: false });
    assert_eq!(moving(recorded), floating, "maps do not ask how it moves");
    assert!(same(&|tour| tour.objects[0].turns_to_camera = true));
    assert!(!same(&|tour| tour.water.as_mut().unwrap().pairs[0].point.0.x += 0.25));
    assert!(!same(&|tour| tour.objects[0].contact[0].0.x -= 0.5));
    assert!(!same(&|tour| tour.picture.crop = None));
    assert_ne!(of(document(), &MapOptions::default(), &files()), made().fingerprint);
    for name in ["lake.png", "boat.png", "water.png"] {
        let mut changed = files();
        *changed.get_mut(name).unwrap().last_mut().unwrap() ^= 1;
        let found = of(document(), &MapOptions::PREVIEW, &changed);
        assert_ne!(found, made().fingerprint, "{name} may change");
    }
    let lost = fingerprint(&made().tour, &MapOptions::PREVIEW, &|_| Err("gone".to_owned()));
    assert_eq!(lost, Err("lake.png cannot be read: gone".to_owned()));
}

#[test]
fn the_tour_s_newer_path_goes_with_its_old_maps() {
    let mut changed = document();
    let keyframe = Keyframe {
        position: glam::DVec3::new(0.0, 1.6, -1.0),
        yaw_deg: 5.0,
        pitch_deg: 0.0,
        roll_deg: 0.0,
        seconds: 2.0,
        hold: 0.0,
        easing: crate::tour::Easing::default(),
    };
    changed.path = Some(CameraPath { keyframes: vec![keyframe], looped: false });
    changed.wind.speed += 1.0;
    let changed = tour(changed);
    let read = |file: &RelativePath| read_from(&files(), file);
    assert_eq!(fingerprint(&changed, &MapOptions::PREVIEW, &read), Ok(made().fingerprint));
    let baked = decode(&made().bytes).unwrap().with_tour(&changed);
    assert_eq!(baked.tour, changed.in_pixels_of(SIZE));
    assert!(baked.tour.path.is_some() && baked.built == made().built);
}

#[test]
fn a_file_is_saved_whole_or_not_at_all() {
    let made = made();
    let folder = tempfile::tempdir().unwrap();
    let path = baked_path(&folder.path().join("lake.tour.ron"));
    assert!(path.ends_with("lake.tour.baked"));
    std::fs::write(&path, "old").unwrap();
    save(&path, &made.tour, &made.source, &made.built, made.fingerprint).unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), made.bytes);

    let nowhere = folder.path().join("none").join("lake.tour.baked");
    assert!(save(&nowhere, &made.tour, &made.source, &made.built, made.fingerprint).is_err());
    assert!(save(&path, &made.source.tour, &made.source, &made.built, made.fingerprint).is_err());
    assert_eq!(std::fs::read(&path).unwrap(), made.bytes, "the older file stays");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no other file stays behind");
}
