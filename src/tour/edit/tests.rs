//! Facts about edits and histories, on random documents and on small ones that are known.

mod random;

use std::sync::{Arc, Weak};

use glam::UVec2;

use super::*;
use crate::picture::{Mask, PicturePoint, PixelRect};
use crate::tour::{Motion, Object, ReflectionPair, Region, Scale, Support, TourFile, Wind};
use random::Random;

fn point(x: f64, y: f64) -> PicturePoint {
    PicturePoint::new(x, y)
}

fn boat() -> Object<String> {
    Object {
        name: "boat".into(),
        support: Support::Water,
        outline: Region::Polygon(vec![point(1.0, 1.0), point(9.0, 1.0), point(5.0, 8.0)]),
        contact: [point(1.0, 8.0), point(9.0, 8.0)],
        turns_to_camera: false,
        motion: Motion::Static,
    }
}

fn pair(on: Option<&str>) -> ReflectionPair {
    ReflectionPair { point: point(4.0, 2.0), reflection: point(4.0, 9.0), on: on.map(Into::into), name: None }
}

/// A draft with a boat, a pair on it, a length on it and a mask.
fn draft() -> Draft {
    let mut draft = Draft::new(TourFile::new("lake.png".into()));
    let length = Scale::Length { on: "boat".into(), from: point(1.0, 8.0), to: point(9.0, 8.0), meters: 4.0 };
    let edits = [
        Edit::Objects(ListEdit::Insert(0, boat())),
        Edit::Pairs(ListEdit::Insert(0, pair(Some("boat")))),
        Edit::Scale(Some(length)),
        Edit::Mask { name: "masks/boat.png".into(), mask: Some(PackedMask::new(&mask(0))) },
    ];
    Edit::Many(edits.into()).apply(&mut draft).unwrap();
    draft
}

fn mask(value: u8) -> Mask {
    Mask::new(UVec2::new(16, 8), vec![value; 128]).unwrap()
}

fn patch(value: u8) -> MaskPatch {
    let rect = PixelRect { min: UVec2::new(2, 3), max: UVec2::new(6, 5) };
    MaskPatch::new(rect, &[value; 8]).unwrap()
}

#[test]
fn every_edit_is_taken_back_exactly_and_a_refused_one_changes_nothing() {
    let (mut done, mut refused) = (0, 0);
    for seed in 0..300 {
        let mut random = Random(seed);
        let mut draft = random.draft();
        for _ in 0..40 {
            let before = draft.clone();
            let edit = random.edit(&draft);
            match edit.apply(&mut draft) {
                Ok(inverse) => {
                    let after = draft.clone();
                    let again = inverse.apply(&mut draft).unwrap();
                    assert_eq!(draft, before, "seed {seed}: {edit:?} was not taken back");
                    again.apply(&mut draft).unwrap();
                    assert_eq!(draft, after, "seed {seed}: {edit:?} was not done again");
                    done += 1;
                }
                Err(error) => {
                    assert_eq!(draft, before, "seed {seed}: refused ({error}), yet changed by {edit:?}");
                    refused += 1;
                }
            }
        }
    }
    assert!(done > 5000 && refused > 500, "the edits are too tame: {done} done, {refused} refused");
}

#[test]
fn a_history_with_gestures_goes_all_the_way_back_and_forth() {
    for seed in 1000..1100 {
        let mut random = Random(seed);
        let mut draft = random.draft();
        let mut history = History::new(true);
        let mut states = vec![draft.clone()];
        for _ in 0..15 {
            history.begin_gesture();
            for _ in 0..random.below(12) {
                let _refused = history.apply(&random.edit(&draft), &mut draft);
            }
            if random.below(4) == 0 {
                history.cancel_gesture(&mut draft).unwrap();
                assert_eq!(&draft, states.last().unwrap(), "seed {seed}: a gesture was not cancelled");
            }
            history.end_gesture();
            if history.past().count() == states.len() {
                states.push(draft.clone());
            }
        }
        for state in states.iter().rev().skip(1) {
            assert!(history.undo(&mut draft).unwrap().is_some());
            assert_eq!(&draft, state, "seed {seed}: undone wrongly");
        }
        assert!(!history.can_undo() && history.is_saved());
        for state in states.iter().skip(1) {
            assert!(history.redo(&mut draft).unwrap().is_some());
            assert_eq!(&draft, state, "seed {seed}: redone wrongly");
        }
        assert!(!history.can_redo());
    }
}

#[test]
fn names_are_followed_and_let_go() {
    let mut draft = draft();
    let before = draft.clone();
    let rename = Edit::Rename { what: Named::Object(0), to: "ferry".into() };
    let back = rename.apply(&mut draft).unwrap();
    let on = |draft: &Draft| draft.tour.water.as_ref().unwrap().pairs[0].on.clone();
    assert_eq!(on(&draft).as_deref(), Some("ferry"));
    assert!(matches!(&draft.tour.camera.scale, Some(Scale::Length { on, .. }) if on == "ferry"));
    back.apply(&mut draft).unwrap();
    assert_eq!(draft, before);

    // A boat that is replaced by one of another name is renamed.
    let replaced = Object { name: "raft".into(), ..boat() };
    Edit::Objects(ListEdit::Replace(0, replaced)).apply(&mut draft).unwrap();
    assert_eq!(on(&draft).as_deref(), Some("raft"));

    let back = Edit::Objects(ListEdit::Remove(0)).apply(&mut draft).unwrap();
    assert_eq!((on(&draft), &draft.tour.camera.scale), (None, &None));
    back.apply(&mut draft).unwrap();
    assert_eq!(on(&draft).as_deref(), Some("raft"));
}

#[test]
fn what_means_nothing_is_refused_and_told() {
    let mut draft = draft();
    let before = draft.clone();
    let nan = point(f64::NAN, 0.0);
    let named = |name: &str| Edit::Rename { what: Named::Object(0), to: name.into() };
    let mask = |name: &str, mask| Edit::Mask { name: name.into(), mask };
    let region = |name: &str| Some(Region::Mask(name.into()));
    let cases = [
        (Edit::Horizon(Some([point(0.0, 1.0), nan])), "the horizon has a number that is not finite"),
        (Edit::Horizon(Some([point(0.0, 1.0), point(2e6, 0.0)])), "out of reach"),
        (Edit::Wind(Wind { speed: f64::INFINITY, ..Wind::default() }), "the wind has a number"),
        (Edit::MovePoint { at: PointAt::Horizon(0), to: point(1.0, 1.0) }, "this point is not marked yet"),
        (Edit::MovePoint { at: PointAt::Foot(0, 2), to: point(1.0, 1.0) }, "this point is not marked yet"),
        (Edit::Objects(ListEdit::Remove(1)), "there is no object number 2"),
        (Edit::Objects(ListEdit::Insert(1, boat())), "`boat` is taken"),
        (named("water"), "`water` cannot be a name"),
        (named(" "), "cannot be a name"),
        (Edit::PairOn { pair: 0, on: Some("ghost".into()) }, "nothing is called `ghost`"),
        (
            Edit::Region { at: RegionAt::Object(0), region: region("masks/gone.png") },
            "no mask `masks/gone.png`",
        ),
        (Edit::Region { at: RegionAt::Object(0), region: None }, "an object's outline cannot be left out"),
        (mask("../boat.png", Some(PackedMask::new(&self::mask(1)))), "leaves the tour's folder"),
        (mask("masks/gone.png", None), "no mask"),
        (Edit::Paint { name: "masks/gone.png".into(), patch: patch(1) }, "no mask"),
        (Edit::GroundHeight(1.0), "the ground is not marked yet"),
        // All or none.
        (Edit::Many(vec![named("ferry"), Edit::LoopPath(true)]), "the camera's path is not marked yet"),
    ];
    for (edit, message) in cases {
        let told = edit.apply(&mut draft).unwrap_err().to_string();
        assert!(told.contains(message), "{edit:?} was refused with: {told}");
        assert_eq!(draft, before, "{edit:?}");
    }
    let outline = Edit::Region { at: RegionAt::Object(0), region: region("masks/boat.png") };
    outline.apply(&mut draft).unwrap();
    let told = mask("masks/boat.png", None).apply(&mut draft).unwrap_err().to_string();
    assert!(told.contains("still used by objects[0].outline"), "{told}");
}

#[test]
fn painting_changes_its_rectangle_alone() {
    let mut draft = draft();
    let paint = Edit::Paint { name: "masks/boat.png".into(), patch: patch(200) };
    let back = paint.apply(&mut draft).unwrap();
    let painted = draft.masks.get("masks/boat.png").unwrap().clone();
    for (x, y, value) in [(2, 3, 200), (5, 4, 200), (1, 3, 0), (6, 4, 0), (2, 2, 0), (5, 5, 0)] {
        assert_eq!(painted.get(x, y), value, "pixel ({x}, {y})");
    }
    assert_eq!(painted.values().iter().filter(|value| **value == 200).count(), 8);
    back.apply(&mut draft).unwrap();
    assert_eq!(**draft.masks.get("masks/boat.png").unwrap(), mask(0));

    let beyond = PixelRect { min: UVec2::new(14, 0), max: UVec2::new(17, 1) };
    let edit = Edit::Paint { name: "masks/boat.png".into(), patch: MaskPatch::new(beyond, &[1; 3]).unwrap() };
    assert!(matches!(edit.apply(&mut draft), Err(EditError::PatchMisfit { .. })));
    let inside_out = PixelRect { min: UVec2::new(5, 5), max: UVec2::new(2, 2) };
    assert!(MaskPatch::new(inside_out, &[0; 9]).is_none());
}

#[test]
fn a_mask_is_painted_in_place_unless_somebody_holds_it() {
    let (mut draft, mut history) = (draft(), History::new(true));
    let name = "masks/boat.png";
    let there = |draft: &Draft| Arc::clone(draft.masks.get(name).unwrap());
    let pixels = |draft: &Draft| draft.masks.get(name).unwrap().values().as_ptr();
    let paint = |value| Edit::Paint { name: name.into(), patch: patch(value) };

    let (held, place) = (there(&draft), pixels(&draft));
    history.apply(&paint(1), &mut draft).unwrap();
    assert!(*held == mask(0), "what somebody holds has changed");
    assert_ne!(pixels(&draft), place);

    let (seen, place) = (Arc::downgrade(&there(&draft)), pixels(&draft));
    history.begin_gesture();
    (2..9).for_each(|value| assert!(history.apply(&paint(value), &mut draft).unwrap()));
    history.undo(&mut draft).unwrap();
    history.redo(&mut draft).unwrap();
    assert_eq!(pixels(&draft), place, "the mask was copied, though nobody holds it");
    assert!(!Weak::ptr_eq(&seen, &Arc::downgrade(&there(&draft))), "it was painted on, yet is the same");
}

#[test]
fn a_mask_painted_and_removed_in_one_gesture_comes_back() {
    let (mut draft, mut history) = (draft(), History::new(true));
    let before = draft.clone();
    history.begin_gesture();
    for edit in [
        Edit::Paint { name: "masks/boat.png".into(), patch: patch(9) },
        Edit::Mask { name: "masks/boat.png".into(), mask: None },
        Edit::Mask { name: "masks/boat.png".into(), mask: Some(PackedMask::new(&mask(7))) },
        Edit::Paint { name: "masks/boat.png".into(), patch: patch(8) },
        Edit::Mask { name: "masks/boat.png".into(), mask: None },
    ] {
        assert!(history.apply(&edit, &mut draft).unwrap());
    }
    history.undo(&mut draft).unwrap();
    assert_eq!(draft, before);
}

#[test]
fn a_drag_is_one_step() {
    let (mut draft, mut history) = (draft(), History::new(true));
    let before = draft.clone();
    history.begin_gesture();
    for x in 0..500 {
        let at = PointAt::On(LineAt::Region(RegionAt::Object(0)), 1);
        history.apply(&Edit::MovePoint { at, to: point(f64::from(x), 1.0) }, &mut draft).unwrap();
    }
    history.end_gesture();
    let titles: Vec<_> = history.past().cloned().collect();
    let title = Title { action: Action::Move, thing: Thing::Outline, name: Some("boat".into()) };
    assert_eq!((titles, history.revision()), (vec![title], 500));
    history.undo(&mut draft).unwrap();
    assert_eq!((&draft, history.is_saved(), history.can_redo()), (&before, true, true));
}

#[test]
fn of_a_part_that_changes_often_one_copy_is_kept() {
    let mut draft = draft();
    let at = PointAt::On(LineAt::Region(RegionAt::Object(0)), 1);
    let moves = (0..500).map(|x| Edit::MovePoint { at, to: point(f64::from(x), 1.0) });
    let Edit::Restore(back) = Edit::Many(moves.collect()).apply(&mut draft).unwrap() else { panic!() };
    assert_eq!(back.0.len(), 1);
}

#[test]
fn a_mask_and_what_it_is_for_have_one_title() {
    let draft = draft();
    let mask = Edit::Mask { name: "masks/raft.png".into(), mask: Some(PackedMask::new(&mask(1))) };
    let raft = Edit::Objects(ListEdit::Insert(1, Object { name: "raft".into(), ..boat() }));
    let title = Edit::Many(vec![mask.clone(), raft]).title(&draft.tour);
    assert_eq!(title, Title { action: Action::Add, thing: Thing::Object, name: Some("raft".into()) });
    assert_eq!(Edit::Many(vec![mask]).title(&draft.tour).thing, Thing::Mask);
}

#[test]
fn saved_is_a_state_and_not_a_number_of_steps() {
    let (mut draft, mut history) = (draft(), History::new(true));
    let wind = |speed| Edit::Wind(Wind { speed, ..Wind::default() });
    assert!(!history.apply(&wind(0.0), &mut draft).unwrap(), "nothing has changed");
    assert!(history.is_saved() && !history.can_undo());
    history.apply(&wind(1.0), &mut draft).unwrap();
    history.mark_saved();
    history.apply(&wind(2.0), &mut draft).unwrap();
    assert!(!history.is_saved());
    history.undo(&mut draft).unwrap();
    assert!(history.is_saved(), "undone to what is saved");
    history.undo(&mut draft).unwrap();
    assert!(!history.is_saved(), "undone beyond");
    history.apply(&wind(3.0), &mut draft).unwrap();
    assert!(!history.is_saved() && !history.can_redo(), "as many steps, another state");
}

#[test]
fn the_first_pair_makes_water_and_the_last_keyframe_takes_the_path() {
    let mut draft = Draft::new(TourFile::new("lake.png".into()));
    Edit::Pairs(ListEdit::Insert(0, pair(Some("background")))).apply(&mut draft).unwrap();
    assert_eq!(RegionAt::Water.get(&draft.tour), Some(&Region::Polygon(Vec::new())));
    let corner =
        Edit::InsertPoint { line: LineAt::Region(RegionAt::Water), index: 0, point: point(1.0, 2.0) };
    corner.apply(&mut draft).unwrap();
    let at = PointAt::On(LineAt::Region(RegionAt::Water), 0);
    assert_eq!(at.get(&draft.tour), Some(point(1.0, 2.0)));

    let keyframe = Random(1).keyframe();
    Edit::Keyframes(ListEdit::Insert(0, keyframe)).apply(&mut draft).unwrap();
    assert_eq!(draft.tour.path.as_ref().unwrap().keyframes, [keyframe]);
    Edit::Keyframes(ListEdit::Remove(0)).apply(&mut draft).unwrap();
    assert_eq!(draft.tour.path, None);
}

#[test]
fn free_names_are_files() {
    let draft = draft();
    assert_eq!(draft.masks.free_name("Boat"), "masks/Boat-2.png");
    assert_eq!(draft.masks.free_name("a/b:c"), "masks/a-b-c.png");
    assert_eq!(draft.masks.free_name(" "), "masks/mask.png");
}
