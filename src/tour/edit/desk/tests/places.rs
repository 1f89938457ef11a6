//! Pictures that move, other folders, and files that cannot be read or written.

use super::*;

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
