//! Facts about loops, and about objects that a game sets moving.

use super::*;
use crate::motion::LoopError;
use crate::tour::{Floating, Motion};
use crate::water::body::BodyPose;

const ALL: [&str; 4] = [BOAT, FERRY, ROCK, TREE];

/// How far apart two moments are at most: tips and walls (meters), clouds (pixels), the water (meters).
fn apart(a: &Simulation, b: &Simulation) -> [f64; 3] {
    let walls = a.moment().placements.iter().flatten().zip(b.moment().placements.iter().flatten());
    let walls = walls.map(|(a, b)| a.origin.distance(b.origin).max(a.up.distance(b.up)));
    let tips = a.moment().sways.iter().zip(&b.moment().sways).map(|(a, b)| {
        let tip = glam::Vec2::new(a.stem.x, a.stem.y + 0.9 * a.size.x);
        f64::from(a.displacement(tip).distance(b.displacement(tip)))
    });
    let clouds = a.moment().clouds.iter().zip(&b.moment().clouds).map(|(a, b)| {
        // What is invisible may be anywhere.
        (a.weight * a.offset_px).distance(b.weight * b.offset_px)
    });
    let water = places().map(|xz| (a.water_at(xz).height - b.water_at(xz).height).abs());
    [walls.chain(tips).fold(0.0, f64::max), clouds.fold(0.0, f64::max), water.fold(0.0, f64::max)]
}

#[test]
fn a_loop_ends_where_it_begins() {
    let seconds = 16.0;
    let start = started(5.0, &ALL, SEA).looped(seconds).unwrap();
    let mut last = start.clone();
    let steps = (seconds / STEP_SECONDS) as u32;
    (1..steps).for_each(|_| last.step());
    let before_last = {
        let mut simulation = start.clone();
        (2..steps).for_each(|_| simulation.step());
        simulation
    };
    // The step over the end is no larger than the one before it.
    let (over, usual) = (apart(&last, &start), apart(&before_last, &last));
    for i in 0..3 {
        assert!(over[i] <= 1.2 * usual[i] + 1e-4, "{over:?} over the end, {usual:?} before it");
    }
    // And one more step is the beginning, as far as the water remembers.
    last.step();
    let gap = apart(&last, &start);
    assert!(gap.iter().all(|gap| *gap < 1e-3), "a gap of {gap:?}");
    // In any order, to the bit.
    let mut there = start.clone();
    there.go_to(7.5);
    there.go_to(0.0);
    assert_same(&mut there, &mut start.clone(), "back at the start");
    there.go_to(seconds + 3.0);
    let mut again = start.clone();
    again.go_to(3.0);
    assert_same(&mut there, &mut again, "a round later");
}

#[test]
fn a_loop_that_cannot_be_is_refused() {
    let simulation = started(5.0, &ALL, SEA);
    for seconds in [0.0, 7.9, 3601.0, f64::NAN] {
        assert!(matches!(simulation.looped(seconds), Err(LoopError::Length(_))), "{seconds} s");
    }
    // The ferry's round of 28.5 s would take 10.
    let error = simulation.looped(10.0).unwrap_err().to_string();
    assert!(error.contains("ferry") && error.contains("at least"), "{error}");
}

#[test]
fn a_game_sets_objects_moving_and_leads_them() {
    let mut simulation = started(5.0, &[BOAT, ROCK, TREE], SEA);
    let (_, scene) = lake(5.0, &[BOAT, ROCK, TREE], SEA);
    let (rock, wall) = wall(&scene, "rock");
    for _ in 0..60 {
        simulation.step();
    }
    assert_eq!(simulation.moment().placements[rock], None);

    simulation.set_motion("rock", &Motion::Floating(Floating::of_draft(0.3))).unwrap();
    for _ in 0..60 {
        simulation.step();
    }
    assert!(
        simulation.moment().placements[rock].is_some_and(|place| place.origin.y != 0.0),
        "it does not float"
    );

    let pose = BodyPose { position: DVec3::new(2.0, 0.5, -3.0), ..BodyPose::default() };
    assert!(simulation.lead("rock", pose));
    simulation.step();
    let place = simulation.moment().placements[rock].unwrap();
    assert!(place.origin.distance(wall.point(0.0, 0.0) + pose.position) < 1e-12, "{place:?}");

    simulation.set_motion("rock", &Motion::Static).unwrap();
    simulation.step();
    assert_eq!(simulation.moment().placements[rock], None);

    assert!(simulation.set_motion("whale", &Motion::Static).unwrap_err().contains("whale"));
    assert!(!simulation.lead("rock", BodyPose { yaw: f64::NAN, ..pose }) && !simulation.lead("whale", pose));
}
