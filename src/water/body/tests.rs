//! Facts about floating bodies and poses; the others stand in `wake_tests.rs`, `course_tests.rs` and `coupling_tests.rs`.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, Vec4};

use super::*;
use crate::tour::Floating;
use crate::water::ripples::RippleGrid;

fn boat() -> Floating {
    Floating {
        draft: 0.4,
        length: Some(5.0),
        beam: Some(1.6),
        mass: None,
        heave_damping: None,
        roll_damping: None,
        heave_period_seconds: None,
        roll_period_seconds: None,
    }
}

const DT: f64 = FloatingBody::DT;

#[test]
fn an_oscillation_decays_as_its_closed_form() {
    for (damping, period) in [(0.05, 1.7), (0.15, 2.0), (0.6, 0.9), (0.99, 2.0)] {
        let oscillation = Oscillation::new(period, damping, DT);
        let (natural, decay) = (TAU / period, damping * TAU / period);
        let damped = natural * (1.0_f64 - damping * damping).sqrt();
        let mut state = [0.3, 0.0];
        for i in 1..=600 {
            state = oscillation.step(state, 0.0);
            let t = f64::from(i) * DT;
            let truth = 0.3 * (-decay * t).exp() * ((damped * t).cos() + decay / damped * (damped * t).sin());
            assert!((state[0] - truth).abs() < 1e-10, "{} instead of {truth} at {t} s", state[0]);
        }
    }
}

#[test]
fn an_overdamped_oscillation_creeps_home() {
    for damping in [1.0, 1.0 + 1e-9, 1.3, 2.0, 1e6] {
        let oscillation = Oscillation::new(1.5, damping, DT);
        let natural = TAU / 1.5;
        let mut state = [1.0, 0.0];
        for _ in 0..90 {
            state = oscillation.step(state, 0.0);
        }
        let root = natural * (damping * damping - 1.0_f64).max(0.0).sqrt();
        let [slow, fast] = [natural * natural / (damping * natural + root), damping * natural + root];
        let truth = if root < 1e-2 {
            (1.0 + natural * 1.5) * (-natural * 1.5).exp()
        } else {
            (fast * (-slow * 1.5).exp() - slow * (-fast * 1.5).exp()) / (fast - slow)
        };
        assert!((state[0] - truth).abs() < 1e-6, "damping {damping}: {} instead of {truth}", state[0]);
    }
}

/// Lets a body that a step in the water has lifted ring down; gives period and damping ratio by its peaks.
fn ring_down(values: &[f64]) -> (f64, f64) {
    let peaks: Vec<(f64, f64)> = (1..values.len() - 1)
        .filter(|&i| values[i] > values[i - 1] && values[i] >= values[i + 1])
        .map(|i| {
            let (a, b, c) = (values[i - 1], values[i], values[i + 1]);
            let off = 0.5 * (a - c) / (a - 2.0 * b + c);
            (i as f64 + off, b - 0.25 * (a - c) * off)
        })
        .collect();
    let (first, last) = (peaks[0], peaks[3]);
    let decrement = (first.1 / last.1).ln() / 3.0;
    ((last.0 - first.0) / 3.0 * DT, decrement / (TAU * TAU + decrement * decrement).sqrt())
}

#[test]
fn a_boat_rings_with_its_periods_and_dampings() {
    let hull = Hull::new(&boat(), 4.0);
    let mut body = FloatingBody::new(hull);
    // The water was raised and tilted, then lies still.
    for _ in 0..300 {
        body.step(&|at: DVec2| 0.1 + 0.05 * at.y, DVec2::ZERO, 0.0);
    }
    let poses: Vec<BodyPose> = (0..900)
        .map(|_| {
            body.step(&|_| 0.0, DVec2::ZERO, 0.0);
            body.pose()
        })
        .collect();
    let heaves: Vec<f64> = poses.iter().map(|pose| pose.position.y).collect();
    let rolls: Vec<f64> = poses.iter().map(|pose| pose.roll).collect();
    for (values, period, damping) in
        [(heaves, hull.heave_period, hull.heave_damping), (rolls, hull.roll_period, hull.roll_damping)]
    {
        let damped = period / (1.0 - damping * damping).sqrt();
        let found = ring_down(&values);
        assert!((found.0 / damped - 1.0).abs() < 0.03, "period {} s instead of {damped} s", found.0);
        assert!((found.1 / damping - 1.0).abs() < 0.03, "damping {} instead of {damping}", found.1);
    }
    // By hand: 2π √(1.7 · 0.4 m / g), and 2π · 0.64 m / √(g · 0.4 m).
    assert!((hull.heave_period - 1.654).abs() < 0.01, "{} s", hull.heave_period);
    assert!((hull.roll_period - 2.030).abs() < 0.01, "{} s", hull.roll_period);
}

#[test]
fn a_boat_follows_long_waves() {
    // Waves 60 boats long, towards the bow of a boat that heads between x and −z.
    let (heading, length) = (0.6, 300.0);
    let bow = ahead(heading);
    let number = TAU / length;
    let frequency = (GRAVITY * number).sqrt();
    let mut body = FloatingBody::new(Hull::new(&boat(), 4.0));
    let center = DVec2::new(7.0, -30.0);
    let mut most = [0.0_f64; 4];
    for i in 0..6000 {
        let t = f64::from(i) * DT;
        let angle = |at: DVec2| number * (at - center).dot(bow) - frequency * t;
        body.step(&|at| 0.5 * angle(at).cos(), center, heading);
        if i > 3000 {
            let pose = body.pose();
            // The water at the step's end.
            let angle = -frequency * (t + DT);
            let slope = -0.5 * number * angle.sin();
            most[0] = most[0].max(pose.position.y.abs());
            most[1] = most[1].max(pose.pitch.abs());
            most[2] = most[2].max((pose.pitch - slope).abs());
            assert!(pose.roll.abs() < 1e-6, "rolls by {} in waves from ahead", pose.roll);
        }
    }
    assert!((most[0] / 0.5 - 1.0).abs() < 0.02, "heaves by {} m in waves of 0.5 m", most[0]);
    let steepest = 0.5 * number;
    assert!((most[1] / steepest - 1.0).abs() < 0.02, "pitches by {} on slopes of {steepest}", most[1]);
    // Bow up where the water rises ahead, and not the other way round.
    assert!(most[2] < 0.1 * steepest, "pitch is {} off the slope", most[2]);
}

#[test]
fn a_boat_leans_with_the_water() {
    // Heading along x, the right-hand side is towards +z.
    let mut body = FloatingBody::new(Hull::new(&boat(), 4.0));
    for _ in 0..6000 {
        body.step(&|at: DVec2| 0.1 * at.x + 0.05 * at.y, DVec2::ZERO, 0.0);
    }
    let pose = body.pose();
    assert!((pose.pitch - 0.1_f64.atan()).abs() < 1e-6, "bow up by {}", pose.pitch);
    assert!((pose.roll + 0.05_f64.atan()).abs() < 1e-6, "starboard down by {}", pose.roll);
}

#[test]
fn a_boat_does_not_feel_ripples() {
    let mut body = FloatingBody::new(Hull::new(&boat(), 4.0));
    let mut most = 0.0_f64;
    for i in 0..3000 {
        let t = f64::from(i) * DT;
        body.step(&|at: DVec2| 0.05 * (TAU / 1.0 * at.x - 7.8 * t).cos(), DVec2::ZERO, 0.0);
        most = most.max(body.pose().position.y.abs());
    }
    assert!(most < 0.005, "heaves by {most} m in ripples of 0.05 m and 1 m");
}

#[test]
fn a_boat_on_still_water_rests_exactly() {
    let mut body = FloatingBody::new(Hull::new(&boat(), 4.0));
    for _ in 0..10_000 {
        body.step(&|_| 0.0, DVec2::new(3.0, -9.0), 1.1);
    }
    assert_eq!(body.pose(), BodyPose::default());
    // Also a while after a wave.
    body.step(&|at: DVec2| 0.1 * at.x, DVec2::ZERO, 0.3);
    for _ in 0..3600 {
        body.step(&|_| 0.0, DVec2::ZERO, 0.3);
    }
    assert_eq!(body.pose(), BodyPose::default());
    let pressure = body.pressure(DVec2::new(3.0, -9.0), 1.1);
    let grid = RippleGrid { origin: DVec2::new(-10.0, -20.0), cell: 0.2, size: 128 };
    pressure.press(&grid, |_, _| panic!("a boat at rest presses on the water"));
}

#[test]
fn a_lifted_boat_draws_the_water_up_and_odd_water_does_not_harm() {
    let mut body = FloatingBody::new(Hull::new(&boat(), 4.0));
    for _ in 0..3000 {
        body.step(&|_| 0.2, DVec2::ZERO, 0.0);
    }
    body.step(&|_| 0.0, DVec2::ZERO, 0.0);
    let pressure = body.pressure(DVec2::ZERO, 0.0).at(DVec2::ZERO);
    assert!((pressure / (-2.0 * 0.2 * GRAVITY * DENSITY) - 1.0).abs() < 0.05, "{pressure} Pa");
    for height in [f64::NAN, f64::INFINITY, -1e300] {
        body.step(&|_| height, DVec2::ZERO, 0.0);
        assert!(body.pose().position.is_finite() && body.pose().roll.is_finite());
    }
}

#[test]
fn points_come_back_to_their_rest() {
    let berth = Berth { center: DVec3::new(4.0, 0.0, -18.0), heading: 0.7 };
    let pose = BodyPose {
        position: DVec3::new(0.4, 0.05, -2.0),
        yaw: 0.3,
        roll: 0.1,
        pitch: -0.07,
        mirrored_share: 0.0,
    };
    for rest in [berth.center, DVec3::new(6.0, 1.5, -17.0), DVec3::new(-3.0, 0.2, -19.0)] {
        let moved = pose.moved(&berth, rest);
        assert!(pose.rest_point(&berth, moved).distance(rest) < 1e-12);
        let [x, y, z] = pose.rest_from_tour(&berth).map(|row: Vec4| row.dot(moved.as_vec3().extend(1.0)));
        assert!(
            DVec3::new(x.into(), y.into(), z.into()).distance(rest) < 1e-5,
            "the shader finds ({x}, {y}, {z})"
        );
        // At rest, to the bit.
        assert_eq!(BodyPose::default().moved(&berth, rest), rest);
        assert_eq!(BodyPose::default().rest_point(&berth, rest), rest);
        assert!(berth.mirrored(berth.mirrored(rest)).distance(rest) < 1e-12);
    }
    let identity = [Vec4::X, Vec4::Y, Vec4::Z];
    assert_eq!(BodyPose::default().rest_from_tour(&berth), identity);
}

#[test]
fn angles_turn_as_their_words_say() {
    let berth = Berth { center: DVec3::new(1.0, 0.0, -5.0), heading: 0.9 };
    let bow = ahead(0.9);
    let right = starboard(bow);
    let [bow, right] = [bow, right].map(|way| berth.center + DVec3::new(way.x, 0.0, way.y));
    let up = BodyPose { pitch: 0.1, ..BodyPose::default() }.moved(&berth, bow).y;
    assert!((up - 0.1_f64.sin()).abs() < 1e-12, "the bow is {up} m up");
    let down = BodyPose { roll: 0.1, ..BodyPose::default() }.moved(&berth, right).y;
    assert!((down + 0.1_f64.sin()).abs() < 1e-12, "starboard is {down} m up");
    let turned = BodyPose { yaw: 0.2, ..BodyPose::default() }.moved(&berth, bow) - berth.center;
    assert!(DVec2::new(turned.x, turned.z).distance(ahead(1.1)) < 1e-12, "the bow points to {turned}");
}

#[test]
fn a_boat_that_comes_back_shows_its_mirrored_copy() {
    assert_eq!(facing(0.4, 0.4), Facing { yaw: 0.0, mirrored_share: 0.0 });
    let back = facing(0.4 + PI, 0.4);
    assert!(back.yaw.abs() < 1e-12 && back.mirrored_share == 1.0, "{back:?}");
    let mut before = facing(-4.0, 0.4);
    for i in 1..8000 {
        let heading = -4.0 + f64::from(i) * 1e-3;
        let now = facing(heading, 0.4);
        assert!(now.yaw.abs() <= PI / 6.0, "{now:?}");
        assert!((now.yaw - before.yaw).abs() < 1.1e-3, "from {before:?} to {now:?} at {heading}");
        assert!(
            (now.mirrored_share - before.mirrored_share).abs() < 3e-3,
            "from {before:?} to {now:?} at {heading}"
        );
        before = now;
    }
    assert_eq!(rest_heading(DVec2::X, 0.3), 0.0);
    assert!((rest_heading(DVec2::X, 3.0).abs() - PI).abs() < 1e-12);
}

#[test]
fn waves_tilt_a_billboard_as_they_tilt_the_hull() {
    let afloat =
        BodyPose { position: DVec3::new(0.0, 0.1, 0.0), pitch: 0.05, roll: 0.02, ..BodyPose::default() };
    let back = BodyPose::default().with_waves(&afloat, PI);
    // Coming back, bow up is stern up for the picture's boat.
    assert!((back.pitch + 0.05).abs() < 1e-12 && (back.roll + 0.02).abs() < 1e-12, "{back:?}");
    let side = BodyPose::default().with_waves(&afloat, PI / 2.0);
    assert!((side.pitch + 0.02).abs() < 1e-12 && (side.roll - 0.05).abs() < 1e-12, "{side:?}");
}

#[test]
fn frames_between_steps_are_smooth() {
    let mut body = FloatingBody::new(Hull::new(&boat(), 4.0));
    let mut speeds = vec![];
    let mut previous = 0.0;
    for i in 0..600 {
        let t = f64::from(i) * DT;
        body.step(&|_| 0.2 * (2.0 * t).sin(), DVec2::ZERO, 0.0);
        for quarter in 1..=4 {
            let height = body.pose_within_step(f64::from(quarter) / 4.0).position.y;
            speeds.push((height - previous) * 4.0 / DT);
            previous = height;
        }
    }
    assert_eq!(body.pose_within_step(1.0), body.pose());
    let jolt = speeds.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    // Accelerations of some m/s² over quarters of steps.
    assert!(jolt < 0.02, "the speed changes by {jolt} m/s from frame to frame");
}
