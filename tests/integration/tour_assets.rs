//! Tours of files, through Bevy's asset server: loaded, refused, broken and mended while they are shown.

use std::fs;

use bevy::prelude::*;
use bevy_picture_tour::assemble::{TourOnDisk, assemble};
use bevy_picture_tour::bake;
use bevy_picture_tour::maps::MapOptions;
use bevy_picture_tour::picture::{PngPixels, save_png};
use bevy_picture_tour::plugin::TourMotion;
use bevy_picture_tour::tour::{RecordedSea, Sea, Tour};
use bevy_picture_tour::trace::Reference;
use bevy_picture_tour::trace::compare::Comparison;

use crate::support::stage::Stage;
use crate::support::{adapter, made_scene};

#[test]
fn a_file_becomes_a_tour_that_shows_its_picture() {
    let Some(_gpu) = adapter() else { return };
    let folder = tempfile::tempdir().unwrap();
    made_scene::write_to(&folder.path().join("lakes"));
    let mut stage = Stage::with_assets_of(folder.path());
    let root = stage.tour_of("lakes/lake.tour.ron");
    let target = stage.camera(root, made_scene::SIZE, Msaa::Off);
    stage.wait("the tour's being ready", |stage| !stage.heard().ready.is_empty());
    let found =
        Comparison::of(&stage.shot(&target, made_scene::SIZE), &made_scene::source().picture).unwrap();
    assert!(found.max_code_difference <= 1, "{} codes off at worst", found.max_code_difference);
    assert_eq!(stage.heard().ready, [root], "it was built once");
    assert_eq!(stage.heard().previews, [root], "and shown before as a preview");
}

#[test]
fn a_preview_is_refined_on_the_same_entities() {
    let Some(_gpu) = adapter() else { return };
    let folder = tempfile::tempdir().unwrap();
    made_scene::write_to(folder.path());
    let mut stage = Stage::with_assets_of(folder.path());
    let root = stage.tour_of("lake.tour.ron");
    let target = stage.camera(root, made_scene::SIZE, Msaa::Off);
    stage.wait("the preview", |stage| !stage.heard().previews.is_empty());
    let shown = stage.descendants(root);
    let preview = stage.solved(root).expect("a preview is shown").0.clone();
    stage.wait("the refined tour", |stage| !stage.heard().ready.is_empty());
    stage.settle();
    assert_eq!(stage.descendants(root), shown);
    // What the shaders read now is what was refined: where the picture does not hold, the frame follows the new maps.
    let solved = stage.solved(root).expect("it is shown").0.clone();
    let mut moved = solved.scene.camera;
    moved.pose.position.x += 0.8;
    stage.look_from(moved.pose);
    let frame = stage.shot(&target, made_scene::SIZE);
    let traced = Reference::new(&solved.scene, &solved.maps).render(&moved, 1);
    let found = Comparison::of(&frame, &traced).unwrap();
    assert!(found.share_within(3) > 0.999, "{} of the frame within 3 codes", found.share_within(3));
    let before = Reference::new(&preview.scene, &preview.maps).render(&moved, 1);
    let apart = Comparison::of(&frame, &before).unwrap();
    assert!(apart.share_within(3) < 0.999, "the preview's maps would have passed as well");
}

#[test]
fn a_baked_tour_is_shown_without_its_picture() {
    let Some(_gpu) = adapter() else { return };
    let folder = tempfile::tempdir().unwrap();
    made_scene::write_to(folder.path());
    let ron = folder.path().join("lake.tour.ron");
    let disk = TourOnDisk::open(&ron).unwrap();
    let source = disk.source().unwrap();
    let options = MapOptions::default();
    let built = assemble(&source, &options, &|_, _| true).unwrap();
    let fingerprint = bake::fingerprint(&disk.tour, &options, &|file| disk.read(file)).unwrap();
    bake::save(&bake::baked_path(&ron), &disk.tour, &source, &built, fingerprint).unwrap();

    // Beside its tour it saves the building, and so it does alone.
    for (file, alone) in [("lake.tour.ron", false), ("lake.tour.baked", true)] {
        if alone {
            fs::remove_file(folder.path().join(made_scene::files()[0].0.as_str())).unwrap();
            fs::remove_file(&ron).unwrap();
        }
        let mut stage = Stage::with_assets_of(folder.path());
        let root = stage.tour_of(file);
        stage.wait("the baked tour", |stage| !stage.heard().ready.is_empty());
        assert!(stage.heard().previews.is_empty(), "{file} was built instead of read");
        assert_eq!(*stage.solved(root).expect("it is shown").0, built, "{file}");
    }

    let baked = folder.path().join("lake.tour.baked");
    let mut bytes = fs::read(&baked).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&baked, bytes).unwrap();
    let mut stage = Stage::with_assets_of(folder.path());
    stage.tour_of("lake.tour.baked");
    stage.wait("the failure", |stage| !stage.heard().failed.is_empty());
    let error = &stage.heard().failed[0].1;
    assert!(error.contains("damaged") && error.contains("picture-tour bake"), "{error}");
}

#[test]
fn a_baked_tour_moves_with_the_recordings_beside_it() {
    let Some(_gpu) = adapter() else { return };
    let folder = tempfile::tempdir().unwrap();
    made_scene::write_to(folder.path());
    let ron = folder.path().join("lake.tour.ron");
    let disk = TourOnDisk::open(&ron).unwrap();
    let source = disk.source().unwrap();
    let options = MapOptions::default();
    let built = assemble(&source, &options, &|_, _| true).unwrap();
    let fingerprint = bake::fingerprint(&disk.tour, &options, &|file| disk.read(file)).unwrap();
    bake::save(&bake::baked_path(&ron), &disk.tour, &source, &built, fingerprint).unwrap();
    // What moves may change after a bake. Black is half of the height below the resting water.
    let mut file = disk.tour.to_file();
    file.waves.sea = Sea::Recorded(RecordedSea {
        first: "black.png".into(),
        count: 1,
        frames_per_second: 25.0,
        height: 0.5,
        area: (10.0, 10.0),
    });
    Tour::check(file).unwrap().save(&ron).unwrap();
    let black = folder.path().join("black.png");
    save_png(&black, UVec2::new(8, 8), PngPixels::Gray(&[0; 64])).unwrap();

    let mut stage = Stage::with_assets_of(folder.path());
    let root = stage.tour_of("lake.tour.ron");
    stage.wait("the baked tour", |stage| !stage.heard().ready.is_empty());
    assert!(stage.heard().previews.is_empty(), "it was built instead of read");
    let motion = stage.app.world().get::<TourMotion>(root).expect("it is shown");
    // The sea alone: what stands in the water throws ripples of micrometers back.
    let height = motion.simulation().sea().expect("it has a sea").sample((0.0, -8.0).into()).height;
    assert!((height + 0.25).abs() < 1e-6, "the sea stands at {height} m");
}

#[test]
fn a_broken_file_is_told_and_what_was_shown_stays() {
    let Some(_gpu) = adapter() else { return };
    let folder = tempfile::tempdir().unwrap();
    made_scene::write_to(folder.path());
    let mut stage = Stage::with_assets_of(folder.path());
    let root = stage.tour_of("lake.tour.ron");
    stage.wait("the tour's being ready", |stage| !stage.heard().ready.is_empty());
    stage.settle();
    let shown = stage.descendants(root);

    let path = folder.path().join("lake.tour.ron");
    let sound = fs::read_to_string(&path).unwrap();
    fs::write(&path, sound.replace("version: 1", "version: 1, colour: Red")).unwrap();
    stage.app.world().resource::<AssetServer>().reload("lake.tour.ron");
    stage.wait("the failure", |stage| !stage.heard().failed.is_empty());
    let (entity, error) = stage.heard().failed[0].clone();
    assert_eq!(entity, root);
    for word in ["lake.tour.ron:2:", "colour", "no field", "leave it out"] {
        assert!(error.contains(word), "{word:?} is not in: {error}");
    }
    for _ in 0..5 {
        stage.app.update();
    }
    assert_eq!(stage.descendants(root), shown, "what was shown before stays");
    assert_eq!(stage.heard().ready, [root]);

    fs::write(&path, sound.replace("HeightAboveWater(1.6)", "HeightAboveWater(3.2)")).unwrap();
    stage.app.world().resource::<AssetServer>().reload("lake.tour.ron");
    stage.wait("the mended tour's being ready", |stage| stage.heard().ready.len() > 1);
    stage.settle();
    let height = stage.solved(root).expect("it is shown").solution.parameters.height;
    assert_eq!(height, 3.2, "meters of the mended file");
    let now = stage.descendants(root);
    assert_eq!(now.len(), shown.len(), "the new parts replace the old ones");
    assert!(shown.iter().all(|part| !now.contains(part)), "old parts stayed");
}

#[test]
fn a_broken_mask_is_told_with_the_tour_s_place() {
    let Some(_gpu) = adapter() else { return };
    let folder = tempfile::tempdir().unwrap();
    made_scene::write_to(folder.path());
    fs::write(folder.path().join("masks/boat.png"), "a text").unwrap();
    fs::remove_file(folder.path().join("masks/water.png")).unwrap();
    let mut stage = Stage::with_assets_of(folder.path());
    stage.tour_of("lake.tour.ron");
    stage.wait("the failure", |stage| !stage.heard().failed.is_empty());
    let error = &stage.heard().failed[0].1;
    for word in ["lake.tour.ron:", "objects[1].outline", "masks/boat.png", "water.region", "masks/water.png"]
    {
        assert!(error.contains(word), "{word:?} is not in: {error}");
    }
    assert!(stage.heard().ready.is_empty(), "nothing is shown of it");
}

#[test]
fn a_tour_may_not_read_outside_its_folder() {
    let Some(_gpu) = adapter() else { return };
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("tour");
    made_scene::write_to(folder.path());
    made_scene::write_to(&inside);
    let path = inside.join("lake.tour.ron");
    let sound = fs::read_to_string(&path).unwrap();
    assert_eq!(sound.matches("\"lake.png\"").count(), 1, "{sound}");
    for (leaving, why) in [
        ("../lake.png", "leaves"),
        ("masks/../../lake.png", "leaves"),
        ("/etc/hostname", "absolute"),
        ("embedded://lake.png", "another source"),
    ] {
        fs::write(&path, sound.replace("\"lake.png\"", &format!("{leaving:?}"))).unwrap();
        // The whole folder is the asset server's, so Bevy itself would not object.
        let mut stage = Stage::with_assets_of(folder.path());
        stage.tour_of("tour/lake.tour.ron");
        stage
            .wait("the refusal", |stage| !stage.heard().failed.is_empty() || !stage.heard().ready.is_empty());
        assert!(stage.heard().ready.is_empty(), "{leaving} was read");
        let error = &stage.heard().failed[0].1;
        for word in ["tour/lake.tour.ron:", "picture.file", leaving, why] {
            assert!(error.contains(word), "{word:?} is not in: {error}");
        }
    }
}

#[test]
fn a_tour_that_is_not_there_fails_by_name() {
    let Some(_gpu) = adapter() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut stage = Stage::with_assets_of(folder.path());
    let root = stage.tour_of("none.tour.ron");
    stage.wait("the failure", |stage| !stage.heard().failed.is_empty());
    let (entity, error) = &stage.heard().failed[0];
    assert_eq!(*entity, root);
    assert!(error.contains("none.tour.ron"), "{error}");
}
