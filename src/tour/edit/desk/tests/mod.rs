//! Facts about desks and files, each in a folder of its own.

mod crashes;
mod places;

use std::fs;
use std::path::{Path, PathBuf};

use glam::UVec2;
use tempfile::TempDir;

use super::*;
use crate::picture::{Mask, Picture, PicturePoint, PixelRect, PngPixels, encode_png, save_png};
use crate::tour::edit::{ListEdit, MaskPatch, PackedMask, RegionAt};
use crate::tour::{Object, Region, Support, Tour, Wind};

const SIZE: UVec2 = UVec2::new(40, 20);

/// A folder with a picture `lake.png`.
fn lake() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("lake.png");
    let picture = Picture::new(SIZE, vec![[90, 120, 150]; 800]).unwrap();
    save_png(&file, SIZE, PngPixels::Rgb(picture.pixels())).unwrap();
    (folder, file)
}

fn wind(speed: f64) -> Edit {
    Edit::Wind(Wind { speed, ..Wind::default() })
}

fn opened(path: &Path) -> Desk {
    let opened = Desk::open(path).unwrap();
    assert!(opened.problems.is_empty(), "{:?}", opened.problems);
    opened.desk
}

/// Marks a boat with a painted mask, gray as given.
fn mark_boat(desk: &mut Desk, gray: u8) {
    let name = desk.free_mask_name("boat");
    let mask = Mask::new(SIZE, vec![gray; 800]).unwrap();
    let boat = Object {
        name: "boat".into(),
        support: Support::Water,
        outline: Region::Mask(name.clone()),
        contact: [PicturePoint::new(5.0, 15.0), PicturePoint::new(9.0, 15.0)],
        turns_to_camera: false,
        motion: crate::tour::Motion::Static,
    };
    let mask = Edit::Mask { name, mask: Some(PackedMask::new(&mask)) };
    desk.apply(&Edit::Many(vec![mask, Edit::Objects(ListEdit::Insert(0, boat))])).unwrap();
}

fn paint_boat(desk: &mut Desk, gray: u8) {
    let Some(Region::Mask(name)) = RegionAt::Object(0).get(desk.tour()).cloned() else { panic!("no mask") };
    let rect = PixelRect { min: UVec2::ZERO, max: UVec2::new(2, 1) };
    desk.apply(&Edit::Paint { name, patch: MaskPatch::new(rect, &[gray; 2]).unwrap() }).unwrap();
}

fn boat_mask(desk: &Desk) -> &Mask {
    let Some(Region::Mask(name)) = RegionAt::Object(0).get(desk.tour()) else { panic!("no mask") };
    desk.draft().masks.get(name).unwrap()
}

fn files(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<String> = names.map(|name| name.into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_picture_becomes_a_tour_that_opens_again_as_it_was() {
    let (folder, picture) = lake();
    let mut desk = opened(&picture);
    assert!(desk.is_new() && desk.is_saved(), "nothing to lose yet");
    assert_eq!(desk.tour().picture.size, Some(SIZE));
    mark_boat(&mut desk, 200);
    desk.apply(&wind(3.0)).unwrap();
    assert!(!desk.is_saved());
    desk.save(Replace::Never).unwrap();
    assert!(desk.is_saved() && !desk.is_new());
    assert_eq!(files(folder.path()), ["lake.png", "lake.tour.ron", "masks"]);

    // The document is incomplete (no horizon, no water), and yet nothing of it is lost.
    let again = opened(&folder.path().join("lake.tour.ron"));
    assert_eq!(again.draft(), desk.draft());
    assert!(again.picture().is_some() && Tour::check(again.tour().clone()).is_err());

    desk.undo().unwrap();
    assert!(!desk.is_saved());
    desk.redo().unwrap();
    assert!(desk.is_saved());
}

#[test]
fn the_last_five_versions_are_kept_with_their_masks() {
    let (folder, picture) = lake();
    let mut desk = opened(&picture);
    mark_boat(&mut desk, 0);
    for gray in 1..=8 {
        paint_boat(&mut desk, gray);
        desk.apply(&wind(f64::from(gray))).unwrap();
        desk.save(Replace::Never).unwrap();
    }
    let versions = desk.versions();
    assert_eq!(versions.iter().map(|version| version.number).collect::<Vec<_>>(), [1, 2, 3, 4, 5]);
    assert_eq!(files(folder.path()), [".lake.tour.ron.versions", "lake.png", "lake.tour.ron", "masks"]);
    // Number 5 is five saves ago: 8 − 5 = 3.
    assert!(desk.take_version(&versions[4]).unwrap().is_empty());
    assert_eq!((desk.tour().wind.speed, boat_mask(&desk).get(1, 0)), (3.0, 3));
    desk.undo().unwrap();
    assert_eq!((desk.tour().wind.speed, boat_mask(&desk).get(1, 0)), (8.0, 8));
}

#[test]
fn a_tour_in_two_windows_loses_nothing() {
    let (folder, picture) = lake();
    let (mut first, mut second) = (opened(&picture), opened(&picture));
    first.apply(&wind(1.0)).unwrap();
    second.apply(&wind(2.0)).unwrap();
    first.autosave(0.0, 1.0).unwrap();
    second.autosave(0.0, 1.0).unwrap();
    let hidden = [".lake.tour.ron.recovery", ".lake.tour.ron.recovery.2"];
    assert_eq!(files(folder.path()), [hidden[0], hidden[1], "lake.png"]);

    first.save(Replace::Never).unwrap();
    let told = second.save(Replace::Never).unwrap_err();
    assert!(matches!(told, DeskError::ChangedOnDisk { .. }), "{told}");
    assert!(folder.path().join(hidden[1]).exists(), "the second window's marks are still safe");
    second.save(Replace::Always).unwrap();
    assert_eq!(opened(second.path()).tour().wind.speed, 2.0);
    let kept = second.versions();
    second.take_version(&kept[0]).unwrap();
    assert_eq!(second.tour().wind.speed, 1.0, "the first window's is a version");
}

#[test]
fn another_tour_of_the_same_picture_has_masks_of_its_own() {
    let (folder, picture) = lake();
    let mut first = opened(&picture);
    mark_boat(&mut first, 50);
    first.save(Replace::Never).unwrap();
    let one = first.path().to_owned();

    // Opening the picture anew makes a second tour; saving as makes a third.
    let again = Desk::open(&picture).unwrap();
    assert_eq!(again.existing_tour.as_deref(), Some(&*one));
    let mut second = again.desk;
    assert_eq!(second.path(), folder.path().join("lake-2.tour.ron"));
    mark_boat(&mut second, 60);
    second.save(Replace::Never).unwrap();
    first.save_as(&folder.path().join("third")).unwrap();
    assert_eq!(first.path(), folder.path().join("third.tour.ron"));
    paint_boat(&mut first, 70);
    first.save(Replace::Never).unwrap();

    let gray = |name: &str| boat_mask(&opened(&folder.path().join(name))).get(0, 0);
    assert_eq!((gray("lake.tour.ron"), gray("lake-2.tour.ron"), gray("third.tour.ron")), (50, 60, 70));
}

#[test]
fn the_last_twelve_files_that_are_still_there_are_remembered() {
    let folder = tempfile::tempdir().unwrap();
    let recent = Recent::in_folder(&folder.path().join("settings"));
    assert!(recent.files().is_empty());
    let names: Vec<PathBuf> =
        (0..14).map(|i| folder.path().canonicalize().unwrap().join(format!("{i}.ron"))).collect();
    for name in &names {
        fs::write(name, "").unwrap();
        recent.add(name).unwrap();
    }
    recent.add(&names[5]).unwrap();
    fs::remove_file(&names[13]).unwrap();
    let expected: Vec<_> = [5, 12, 11, 10, 9, 8, 7, 6, 4, 3, 2].map(|i| names[i].clone()).into();
    assert_eq!(recent.files(), expected);
    fs::write(folder.path().join("settings/recent.ron"), "[[[").unwrap();
    assert!(recent.files().is_empty(), "a broken list is an empty one");
    recent.add(&names[0]).unwrap();
    assert_eq!(recent.files(), [names[0].clone()]);
}
