//! Controls found by their labels yield the right edits and requests.

use egui_kittest::kittest::NodeT as _;

use super::*;
use crate::editor::egui::accesskit::Role;
use crate::editor::egui::{Event, Key, Modifiers};
use crate::tour::edit::{ListEdit, RegionAt};
use crate::tour::{Floating, FocalLength, Jonswap, Octaves, Region, Scale, Sea, Sway, SwayKind};
use crate::water::body::Hull;
use crate::water::sea::fetch;

/// Types a number into the field with this name.
fn type_number(harness: &mut Harness<'_, Bench>, name: &str, number: &str) {
    harness.get_by_role_and_label(Role::SpinButton, name).scroll_to_me();
    harness.run_steps(30);
    harness.get_by_role_and_label(Role::SpinButton, name).click();
    harness.run_steps(3);
    for key in [Key::Backspace; 12] {
        harness.key_press(key);
        harness.key_press(Key::Delete);
    }
    harness.run_steps(2);
    harness.event(Event::Text(number.into()));
    harness.run_steps(2);
    assert!(harness.state().out.text_has_focus, "nothing is typed into");
    harness.key_press(Key::Enter);
    harness.run_steps(3);
}

#[test]
fn the_scale_is_picked_and_typed() {
    let mut harness = small(Bench::at(Step::Horizon));
    choose(&mut harness, "Set by", "Height above water");
    type_number(&mut harness, "Height", "2.35");
    let edits = harness.state().edits();
    assert_eq!(
        edits,
        [1.7, 2.35]
            .map(|meters| Edit::Scale(Some(Scale::HeightAboveWater(meters))))
            .iter()
            .collect::<Vec<_>>()
    );
}

#[test]
fn a_first_guess_is_taken_for_right_once() {
    let mut bench = Bench::at(Step::Water);
    let mut tour = pond();
    tour.water.as_mut().unwrap().region = Region::Mask("masks/draft/water.png".into());
    bench.draft = Some(Draft::new(tour));
    let mut harness = small(bench);
    press(&mut harness, "It is right");
    assert_eq!(harness.state().log, [Request::TakeGuess(RegionAt::Water)]);
    // What somebody has drawn is no guess.
    let harness = small(Bench::at(Step::Water));
    assert!(harness.query_by_label("It is right").is_none());
}

#[test]
fn the_focal_length_is_locked_and_typed_in_millimeters_or_as_a_field_of_view() {
    let mut harness = small(Bench::at(Step::Pairs));
    choose(&mut harness, "Focal length", "Locked to a value");
    let focal = |harness: &Harness<'_, Bench>| match harness.state().tour().camera.focal_length {
        FocalLength::Known(focal) => focal,
        other => panic!("{other:?}"),
    };
    assert_eq!(focal(&harness), 900.0);
    type_number(&mut harness, "Millimeters", "36");
    assert!((focal(&harness) - 1000.0).abs() < 1e-6, "{}", focal(&harness));
    type_number(&mut harness, "Field of view", "90");
    assert!((focal(&harness) - 500.0).abs() < 1e-6, "{}", focal(&harness));
}

#[test]
fn the_report_tells_value_and_trust_of_every_parameter() {
    let harness = small(Bench::at(Step::Pairs));
    for words in ["measured", "weak", "assumed"] {
        assert!(harness.query_all_by_label(words).next().is_some(), "nothing is {words}");
    }
    harness.get_by_label_contains("40.0 ± 9.0 m");
    harness.get_by_label("The picture looks level: its focal length cannot be seen in it.");
    for name in ["Looks up by", "Tilted by", "Height above the water", "Background at"] {
        harness.get_by_label(name);
    }
}

#[test]
fn a_pair_can_be_told_what_it_lies_on_and_removed() {
    let mut harness = small(Bench::at(Step::Pairs));
    press(&mut harness, "Pair 2");
    choose(&mut harness, "Lies on", "boat");
    assert_eq!(harness.state().edits(), [&Edit::PairOn { pair: 1, on: Some("boat".into()) }]);
    press(&mut harness, "Remove the pair");
    assert_eq!(harness.state().edits().last(), Some(&&Edit::Pairs(ListEdit::Remove(1))));
}

#[test]
fn an_object_is_renamed_by_typing() {
    let mut harness = small(Bench::at(Step::Objects));
    press(&mut harness, "boat");
    harness.get_by_role_and_label(Role::TextInput, "Object's name").click();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run_steps(2);
    harness.event(Event::Text("ferry".into()));
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    let what = crate::tour::edit::Named::Object(0);
    assert_eq!(harness.state().edits(), [&Edit::Rename { what, to: "ferry".into() }]);
}

#[test]
fn every_kind_of_motion_can_be_picked() {
    for (name, is_right) in [
        (
            "Tree with a trunk",
            (|motion| matches!(motion, Motion::Sway(sway) if sway.kind == SwayKind::Trunk))
                as fn(&Motion<String>) -> bool,
        ),
        (
            "Crown, branches, bush",
            |motion| matches!(motion, Motion::Sway(sway) if sway.kind == SwayKind::Branch),
        ),
        ("Reeds", |motion| matches!(motion, Motion::Sway(sway) if sway.kind == SwayKind::Reed)),
        ("Grass", |motion| matches!(motion, Motion::Sway(sway) if sway.kind == SwayKind::Grass)),
        ("Boat at anchor", |motion| matches!(motion, Motion::Floating(_))),
        ("Boat under way", |motion| matches!(motion, Motion::Course(course) if course.waypoints.len() == 2)),
    ] {
        let mut harness = small(Bench::at(Step::Motion));
        press(&mut harness, "boat");
        choose(&mut harness, "Moves as", name);
        let bench = harness.state();
        assert!(is_right(&bench.tour().objects[0].motion), "{name}: {:?}", bench.tour().objects[0].motion);
        assert!(Tour::check(bench.tour().clone()).is_ok(), "{name} makes a tour that is not sound");
    }
}

#[test]
fn numbers_that_no_slider_reaches_are_shown_and_stay() {
    let course = crate::tour::Course {
        waypoints: vec![crate::tour::Waypoint(glam::DVec2::new(0.123, -9.876)); 2],
        speed: 1.2345,
        draft: 0.1251,
        length: Some(3.333),
        closed: true,
    };
    let sway = Sway { amplitude: Some(0.0045), damping: Some(0.123_4), ..Sway::of_kind(SwayKind::Reed) };
    let floating = Floating { roll_damping: Some(0.005), ..Floating::of_draft(0.125) };
    let octaves = Octaves { wavelength: Some(3.234_56), speed_factor: 7.0, ..Octaves::default() };
    let jonswap = Jonswap { depth: 12.345, spreading: 4.44, ..Jonswap::default() };
    for (motion, sea) in [
        (Motion::Sway(sway), Sea::Octaves(octaves)),
        (Motion::Floating(floating), Sea::Jonswap(jonswap)),
        (Motion::Course(course), Sea::Calm),
    ] {
        let mut tour = pond();
        tour.objects[0].motion = motion;
        tour.wind.speed = 3.23;
        tour.wind.direction_deg = -270.0;
        tour.waves.sea = sea;
        let drift = crate::tour::Drift { speed: 0.123, direction_deg: -190.0 };
        tour.sky = Some(crate::tour::Sky { region: None, drift: Some(drift) });
        let mut bench = Bench::at(Step::Motion);
        bench.studio.object = Some(0);
        bench.draft = Some(Draft::new(tour.clone()));
        let mut harness = small(bench);
        assert_eq!((harness.state().steps(), harness.state().tour()), (0, &tour));
        // A number that is clicked into and left is not changed either.
        harness.get_all_by_role(Role::SpinButton).next().unwrap().scroll_to_me();
        harness.run_steps(30);
        harness.get_all_by_role(Role::SpinButton).next().unwrap().click();
        harness.run_steps(3);
        assert!(harness.state().out.text_has_focus, "nothing is typed into");
        harness.key_press(Key::Enter);
        harness.run_steps(3);
        assert_eq!((harness.state().steps(), harness.state().tour()), (0, &tour));
    }
}

#[test]
fn numbers_left_out_are_shown_as_they_are_used() {
    let mut tour = pond();
    let floating = Floating::of_draft(0.2);
    tour.objects[0].motion = Motion::Floating(floating.clone());
    tour.wind.direction_deg = 20.0;
    tour.waves.sea = Sea::Jonswap(Jonswap::default());
    let (wave_height, peak_period) = fetch::of_jonswap(&Jonswap::default(), &tour.wind);
    let mut bench = Bench::at(Step::Motion);
    bench.studio.object = Some(0);
    bench.draft = Some(Draft::new(tour));
    let length = bench.with_work(|work| {
        let [left, right] = work.tour.objects[0].contact.map(|foot| work.water_at(foot).unwrap().0);
        left.distance(right)
    });
    let hull = Hull::new(&floating, length);
    let harness = small(bench);
    let slider = |name: &str| {
        let found = harness.get_all_by_role_and_label(Role::Slider, name).last().unwrap();
        found.accesskit_node().numeric_value().unwrap()
    };
    for (name, used) in [
        ("Length", length),
        ("Heave damping", 0.15),
        ("Roll damping", 0.08),
        ("Heave period", hull.heave_period),
        ("Roll period", hull.roll_period),
        ("Height", wave_height),
        ("Period", peak_period),
        // That of the waves, below the wind's.
        ("Blows to", 20.0),
    ] {
        assert!((slider(name) - used).abs() < 1e-9, "{name} is {} and not {used}", slider(name));
    }
}

#[test]
fn a_slider_acts_at_once_and_is_one_step() {
    let mut harness = small(Bench::at(Step::Motion));
    let slider = harness.get_by_role_and_label(Role::Slider, "Wind speed").rect();
    let at = |part: f32| slider.left_center() + Vec2::new(slider.width() * part, 0.0);
    harness.hover_at(at(0.05));
    harness.step();
    harness.drag_at(at(0.05));
    harness.step();
    for part in [0.1, 0.2, 0.3] {
        harness.hover_at(at(part));
        harness.step();
    }
    let during = harness.state().tour().wind.speed;
    assert!(during > 0.0, "nothing happened before the button was let go");
    harness.drop_at(at(0.3));
    harness.run_steps(3);
    let bench = harness.state();
    assert!(bench.edits().len() >= 2 && bench.steps() == 1, "{:?}", bench.log);
}

#[test]
fn keyframes_are_taken_from_the_flown_view_and_the_path_is_played() {
    let mut harness = small(Bench::at(Step::Motion));
    for _ in 0..2 {
        let take = harness.get_by_label("Take a keyframe");
        take.scroll_to_me();
        harness.run_steps(6);
        press(&mut harness, "Take a keyframe");
    }
    let path = harness.state().tour().path.clone().unwrap();
    assert_eq!(path.keyframes.len(), 2);
    assert_eq!(path.keyframes[0].position, DVec3::new(1.0, 2.0, -3.0));
    assert!((path.keyframes[0].yaw_deg - 0.5_f64.to_degrees()).abs() < 1e-9);
    assert_eq!((path.keyframes[0].seconds, path.keyframes[1].seconds), (0.0, 4.0));
    press(&mut harness, "Play");
    assert_eq!(harness.state().log.last(), Some(&Request::PlayPath(true)));
    press(&mut harness, "Loop");
    assert!(harness.state().tour().path.as_ref().unwrap().looped);
}

#[test]
fn a_keyframe_is_moved_in_time_on_the_time_line() {
    let mut bench = Bench::at(Step::Motion);
    let keyframe = |seconds: f64| crate::tour::Keyframe {
        position: DVec3::Y,
        yaw_deg: 0.0,
        pitch_deg: 0.0,
        roll_deg: 0.0,
        seconds,
        hold: 0.0,
        easing: crate::tour::Easing::Smooth,
    };
    let mut tour = pond();
    tour.path = Some(crate::tour::CameraPath { keyframes: [0.0, 4.0].map(keyframe).to_vec(), looped: false });
    bench.draft = Some(Draft::new(tour));
    let mut harness = small(bench);
    let strip = harness.get_by_label("Time line").rect();
    let from = harness
        .get_all_by_role_and_label(Role::Button, "Keyframe 2")
        .map(|node| node.rect())
        .find(|rect| strip.contains(rect.center()))
        .unwrap()
        .center();
    harness.hover_at(from);
    harness.step();
    harness.drag_at(from);
    harness.step();
    for x in [-20.0, -60.0, -100.0] {
        harness.hover_at(from + Vec2::new(x, 0.0));
        harness.step();
    }
    harness.drop_at(from - Vec2::new(100.0, 0.0));
    harness.run_steps(3);
    let bench = harness.state();
    let seconds = bench.tour().path.as_ref().unwrap().keyframes[1].seconds;
    assert!(seconds > 0.5 && seconds < 4.0, "{seconds} s");
    assert_eq!(bench.steps(), 1, "{:?}", bench.log);
}

#[test]
fn the_ground_is_outlined_and_the_background_put_at_a_distance() {
    let mut harness = small(Bench::at(Step::Ground));
    choose(&mut harness, "Stands", "At a distance");
    let place = Some(crate::tour::BackgroundPlace::Distance(40.0));
    let at = crate::tour::edit::PlaceAt::Background;
    assert_eq!(harness.state().edits(), [&Edit::Place { at, place }]);
    press(&mut harness, "Draw the outline");
    assert_eq!(harness.state().studio.canvas.tool, Tool::Region(RegionAt::Ground));
}
