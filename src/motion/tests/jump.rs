//! Facts about jumping to times: any order, few steps, and between them.

use super::*;

const ALL: [&str; 4] = [BOAT, FERRY, ROCK, TREE];

/// Frames of a film at 24 frames a second around a border of two blocks.
fn frames() -> [f64; 25] {
    std::array::from_fn(|frame| (516 + frame) as f64 / 24.0)
}

#[test]
fn a_films_frames_are_the_same_in_any_order() {
    let mut there = started(5.0, &ALL, SEA);
    let shown = frames().map(|seconds| {
        there.go_to(seconds);
        assert!((there.seconds() - seconds).abs() < 1e-9, "{} s instead of {seconds} s", there.seconds());
        there.clone()
    });
    let mut back = started(5.0, &ALL, SEA);
    for (seconds, mut shown) in frames().into_iter().zip(shown).rev().step_by(6) {
        back.go_to(seconds);
        assert_same(&mut back, &mut shown, &format!("at {seconds} s"));
    }
}

#[test]
fn one_time_after_the_other_is_stepped_to() {
    let mut simulation = started(5.0, &ALL, SEA);
    let mut rests = Vec::new();
    for seconds in frames() {
        simulation.go_to(seconds);
        let simulated = simulation.steps - simulation.rested_at;
        assert!((MEMORY_STEPS - BLOCK_STEPS..=MEMORY_STEPS).contains(&simulated), "{simulated} steps");
        rests.push(simulation.rested_at);
    }
    rests.dedup();
    assert_eq!(rests, [120, 240], "the steps at which the water rested");
}

#[test]
fn the_water_does_not_jump_from_block_to_block() {
    let mut simulation = started(5.0, &ALL, SEA);
    let mut state = |step: u64| -> [Vec<f64>; 2] {
        simulation.go_to(step as f64 * STEP_SECONDS);
        let walls = simulation.moment().placements.iter().flatten().map(|wall| wall.origin.y + wall.up.z);
        let ripples = places().map(|xz| f64::from(simulation.ripples().unwrap().height_at(xz)));
        [ripples.collect(), walls.collect()]
    };
    let states: Vec<_> = (1317..=1323).map(&mut state).collect();
    let change = |pair: &[[Vec<f64>; 2]], what: usize| {
        let squares = pair[0][what].iter().zip(&pair[1][what]).map(|(a, b)| (a - b).powi(2));
        squares.sum::<f64>().sqrt()
    };
    for what in [0, 1] {
        let changes: Vec<f64> = states.windows(2).map(|pair| change(pair, what)).collect();
        // Step 1320 is the last one of its block.
        assert!(changes[3] < 1.5 * changes[2], "{changes:?}");
    }
}

#[test]
fn between_two_steps_everything_is_between() {
    let [mut before, mut between, mut after] = [0; 3].map(|_| started(5.0, &ALL, SEA));
    let half = 90.5 * STEP_SECONDS;
    before.go_to(90.0 * STEP_SECONDS);
    between.go_to(half);
    after.go_to(91.0 * STEP_SECONDS);
    let mut most = 0.0_f32;
    for xz in places() {
        let [a, b, c] = [&before, &between, &after].map(|at| at.ripples().unwrap().height_at(xz));
        assert!((0.5 * (a + c) - b).abs() < 1e-7, "{a} m, {b} m, {c} m at {xz}");
        most = most.max((c - a).abs());
    }
    assert!(most > 1e-5, "the ripples move by {most} m");
    let sea = between.sea().unwrap();
    let exact = sea.waves().unwrap().exact(DVec2::ZERO, half).height;
    assert!((sea.sample(DVec2::ZERO).height - exact).abs() < 1e-6, "the sea is of another time");
    for component in [1, 2] {
        let [a, b, c] =
            [&before, &between, &after].map(|at| at.moment().placements[component].unwrap().origin);
        assert!((0.5 * (a + c)).distance(b) < 0.05 * a.distance(c) + 2e-5, "{a}, {b}, {c}");
    }
    // What is shown between does not change what follows.
    between.step();
    after.step();
    between.go_to(half);
    between.step();
    before.go_to(91.0 * STEP_SECONDS);
    before.step();
    assert_same(&mut between, &mut after, "a step later");
    assert_same(&mut before, &mut after, "a step later");
}
