//! What a crash leaves is offered, taken or refused, and never another tour's.

use super::*;

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
