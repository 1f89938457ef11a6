//! Facts about desks and files, each in a folder of its own.

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
fn after_a_crash_marks_and_masks_are_offered() {
    let (folder, picture) = lake();
    let tour = folder.path().join("lake.tour.ron");
    let recovery = folder.path().join(".lake.tour.ron.recovery");
    let mut desk = opened(&picture);
    mark_boat(&mut desk, 10);
    desk.save(Replace::Never).unwrap();

    assert!(!desk.autosave(0.0, 5.0).unwrap(), "nothing has changed");
    paint_boat(&mut desk, 99);
    assert!(desk.autosave(10.0, 5.0).unwrap());
    desk.apply(&wind(7.0)).unwrap();
    assert!(!desk.autosave(14.9, 5.0).unwrap(), "too early");
    assert!(!desk.is_kept(), "a crash would lose the wind");
    assert!(desk.autosave(15.0, 5.0).unwrap());
    assert!(desk.is_kept());
    assert!(!desk.autosave(30.0, 5.0).unwrap(), "nothing new");
    let before = desk.draft().clone();
    drop(desk); // A crash.

    let Opened { mut desk, mut recovered, .. } = Desk::open(&tour).unwrap();
    assert_eq!((desk.tour().wind.speed, boat_mask(&desk).get(0, 0)), (0.0, 10), "as it was saved");
    desk.recover(recovered.pop().unwrap()).unwrap();
    assert_eq!(desk.draft(), &before);
    assert!(!desk.is_saved() && recovery.exists());
    desk.undo().unwrap();
    assert!(desk.is_saved());
    desk.redo().unwrap();
    desk.save(Replace::Never).unwrap();
    assert!(!recovery.exists(), "all is saved");
    assert_eq!(opened(&tour).draft(), &before);
}

#[test]
fn a_new_tour_is_recovered_too_and_a_refusal_or_a_close_ends_it() {
    let (folder, picture) = lake();
    let recovery = folder.path().join(".lake.tour.ron.recovery");
    let mut desk = opened(&picture);
    desk.apply(&wind(7.0)).unwrap();
    desk.autosave(0.0, 5.0).unwrap();
    drop(desk); // A crash before the first save.
    let Opened { desk, recovered, .. } = Desk::open(&picture).unwrap();
    assert_eq!((recovered[0].tour.wind.speed, recovered.len()), (7.0, 1));
    for left in recovered {
        left.discard().unwrap();
    }
    assert!(!recovery.exists());
    drop(desk);

    let mut desk = opened(&picture);
    desk.apply(&wind(8.0)).unwrap();
    desk.autosave(0.0, 5.0).unwrap();
    assert!(recovery.exists());
    desk.close();
    assert!(!recovery.exists());
}

#[test]
fn a_broken_recovery_file_is_told_and_put_aside() {
    let (folder, picture) = lake();
    fs::write(folder.path().join(".lake.tour.ron.recovery"), "(tour: (version: 1, pict").unwrap();
    let Opened { desk, recovered, problems, .. } = Desk::open(&picture).unwrap();
    assert!(recovered.is_empty() && desk.picture().is_some());
    let told = problems[0].to_string();
    assert!(told.contains(".lake.tour.ron.recovery.broken cannot be read as a recovery file"), "{told}");
    assert!(folder.path().join(".lake.tour.ron.recovery.broken").exists());
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
fn a_mask_that_comes_back_by_undoing_is_written_as_it_was_painted() {
    let (folder, picture) = lake();
    let mut desk = opened(&picture);
    mark_boat(&mut desk, 50);
    desk.save(Replace::Never).unwrap();
    paint_boat(&mut desk, 60);
    desk.apply(&Edit::Objects(ListEdit::Remove(0))).unwrap();
    desk.save(Replace::Never).unwrap();
    desk.undo().unwrap();

    // Either way, after a crash or a save.
    desk.autosave(0.0, 1.0).unwrap();
    let tour = folder.path().join("lake.tour.ron");
    let Opened { desk: mut crashed, mut recovered, .. } = Desk::open(&tour).unwrap();
    crashed.recover(recovered.pop().unwrap()).unwrap();
    assert_eq!(boat_mask(&crashed).get(0, 0), 60);
    desk.save(Replace::Never).unwrap();
    assert_eq!(boat_mask(&opened(&tour)).get(0, 0), 60);
}

#[test]
fn a_crash_after_saving_under_another_name_takes_no_other_tours_mask() {
    let (folder, picture) = lake();
    let mut desk = opened(&picture);
    mark_boat(&mut desk, 50);
    desk.save(Replace::Never).unwrap();
    let other = folder.path().join("other.tour.ron");
    desk.save_as(&other).unwrap();
    paint_boat(&mut desk, 60);
    desk.autosave(0.0, 1.0).unwrap();
    drop(desk); // A crash.
    let Opened { mut desk, mut recovered, .. } = Desk::open(&other).unwrap();
    assert_eq!(boat_mask(&desk).get(0, 0), 50);
    desk.recover(recovered.pop().unwrap()).unwrap();
    desk.save(Replace::Never).unwrap();
    let gray = |name: &str| boat_mask(&opened(&folder.path().join(name))).get(0, 0);
    assert_eq!((gray("lake.tour.ron"), gray("other.tour.ron")), (50, 60));
}

#[test]
fn saving_in_another_folder_takes_picture_and_masks_along() {
    let (_folder, picture) = lake();
    let other = tempfile::tempdir().unwrap();
    let mut desk = opened(&picture);
    mark_boat(&mut desk, 50);
    let target = other.path().join("tours/mine.tour.ron");
    desk.save_as(&target).unwrap();
    assert_eq!(files(target.parent().unwrap()), ["lake.png", "masks", "mine.tour.ron"]);
    assert_eq!(boat_mask(&opened(&target)).get(0, 0), 50);

    // A folder above the picture needs no copy.
    let above = tempfile::tempdir().unwrap();
    fs::create_dir(above.path().join("pictures")).unwrap();
    let below = above.path().join("pictures/lake.png");
    fs::copy(&picture, &below).unwrap();
    let mut desk = opened(&below);
    desk.save_as(&above.path().join("a.tour.ron")).unwrap();
    assert_eq!(opened(desk.path()).tour().picture.file, "pictures/lake.png");
    assert_eq!(files(above.path()), ["a.tour.ron", "pictures"]);
}

#[test]
fn a_moved_picture_is_asked_for_and_missing_masks_are_written_again() {
    let (folder, picture) = lake();
    let mut desk = opened(&picture);
    mark_boat(&mut desk, 50);
    desk.save(Replace::Never).unwrap();
    let before = desk.draft().clone();
    let tour = desk.path().to_owned();

    fs::remove_dir_all(folder.path().join("masks")).unwrap();
    desk.save(Replace::Never).unwrap();
    let moved = folder.path().join("see.png");
    fs::rename(&picture, &moved).unwrap();
    let Opened { mut desk, problems, .. } = Desk::open(&tour).unwrap();
    assert!(desk.picture().is_none() && problems.len() == 1, "{problems:?}");
    assert_eq!(desk.draft(), &before, "all marks are there");

    let wrong = folder.path().join("wrong.png");
    fs::write(&wrong, encode_png(UVec2::splat(30), PngPixels::Gray(&[0; 900])).unwrap()).unwrap();
    assert!(matches!(desk.find_picture(&wrong), Err(DeskError::OtherShape { .. })));
    desk.find_picture(&moved).unwrap();
    assert_eq!(desk.tour().picture.file, "see.png");
    desk.save(Replace::Never).unwrap();
    assert_eq!(opened(&tour).tour().objects, before.tour.objects);

    // A mask that is gone: told, and the tour goes on naming it.
    fs::remove_dir_all(folder.path().join("masks")).unwrap();
    let Opened { mut desk, problems, .. } = Desk::open(&tour).unwrap();
    assert!(problems[0].to_string().contains("boat.png could not be read"), "{problems:?}");
    desk.save(Replace::Never).unwrap();
    assert_eq!(desk.tour().objects, before.tour.objects);
}

#[test]
fn masks_follow_the_picture_that_is_found() {
    let (folder, picture) = lake();
    let mut desk = opened(&picture);
    mark_boat(&mut desk, 50);
    let large = folder.path().join("large.png");
    save_png(&large, SIZE * 2, PngPixels::Gray(&[0; 3200])).unwrap();
    let before = desk.draft().clone();
    desk.find_picture(&large).unwrap();
    assert_eq!((boat_mask(&desk).size(), boat_mask(&desk).get(79, 39)), (SIZE * 2, 50));
    assert_eq!(
        desk.tour().picture.size,
        Some(SIZE),
        "the numbers still refer to the size they were marked at"
    );
    let of_desk = |desk: &Desk| desk.picture().unwrap().picture.size();
    desk.undo().unwrap();
    assert_eq!((desk.draft(), of_desk(&desk)), (&before, SIZE), "the picture comes back with its masks");
    desk.redo().unwrap();
    assert_eq!(of_desk(&desk), SIZE * 2);
}

#[cfg(unix)]
#[test]
fn a_picture_that_is_a_link_stays_one() {
    let (_folder, picture) = lake();
    let other = tempfile::tempdir().unwrap();
    let link = other.path().join("view.png");
    std::os::unix::fs::symlink(&picture, &link).unwrap();
    let mut desk = opened(&link);
    desk.save(Replace::Never).unwrap();
    assert_eq!(files(other.path()), ["view.png", "view.tour.ron"]);
    assert_eq!(opened(desk.path()).tour().picture.file, "view.png");
}

#[test]
fn bad_files_are_told_by_name() {
    let (folder, picture) = lake();
    let told = |path: &Path| Desk::open(path).unwrap_err().to_string();
    assert!(told(folder.path()).contains("is a folder; choose a picture or a tour"));
    assert!(told(&folder.path().join("gone.png")).contains("could not be read"));
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    };
    let broken = write("broken.png", &fs::read(&picture).unwrap()[..40]);
    assert!(told(&broken).contains("broken.png"));
    let broken = write("broken.tour.ron", b"(version: 1, pict");
    assert!(told(&broken).contains("broken.tour.ron"));
    let bytes = write("bytes.tour.ron", &[0xff, 0xfe, 0x00]);
    assert!(told(&bytes).contains("no text"));
    let label = write("lake#1.png", &fs::read(&picture).unwrap());
    assert!(told(&label).contains("rename the file"));
}

#[test]
fn what_cannot_be_written_leaves_desk_and_old_file_as_they_were() {
    let (folder, picture) = lake();
    let mut desk = opened(&picture);
    desk.apply(&wind(4.0)).unwrap();
    desk.save(Replace::Never).unwrap();
    let before = fs::read(desk.path()).unwrap();
    desk.apply(&wind(5.0)).unwrap();
    // A file where the versions' folder belongs, as no test can take the rights of the super-user.
    fs::write(folder.path().join(".lake.tour.ron.versions"), "").unwrap();
    let told = desk.save(Replace::Never).unwrap_err().to_string();
    assert!(told.contains("nothing that was marked is lost"), "{told}");
    assert!(!desk.is_saved() && fs::read(desk.path()).unwrap() == before);
    assert!(desk.save_as(&picture.join("below-a-file.tour.ron")).is_err());
    assert!(!desk.is_saved());
    desk.save_as(&folder.path().join("elsewhere.tour.ron")).unwrap();
    assert!(desk.is_saved());
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
