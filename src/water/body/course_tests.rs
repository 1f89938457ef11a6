//! Facts about courses and recorded poses.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::*;
use crate::tour::{Course, Waypoint};

fn course(points: &[(f64, f64)], speed: f64, closed: bool) -> Course {
    let waypoints = points.iter().map(|&(x, z)| Waypoint(DVec2::new(x, z))).collect();
    Course { waypoints, speed, draft: 0.4, length: Some(4.0), closed }
}

fn circle() -> Course {
    let points: Vec<(f64, f64)> = (0..16)
        .map(|i| {
            let way = ahead(TAU * f64::from(i) / 16.0);
            (20.0 * way.x, -50.0 + 20.0 * way.y)
        })
        .collect();
    course(&points, 2.0, true)
}

#[test]
fn a_round_is_sailed_at_one_speed() {
    let sailed = SailedCourse::new(&circle(), 4.0, AtEnd::Return).unwrap();
    let round = sailed.round_seconds().unwrap();
    assert!((round / (TAU * 20.0 / 2.0) - 1.0).abs() < 0.005, "a round of {round} s");
    let mut previous = sailed.at(0.0);
    for i in 1..8000 {
        let now = sailed.at(f64::from(i) / 60.0);
        let speed = now.center.distance(previous.center) * 60.0;
        assert!((speed / 2.0 - 1.0).abs() < 0.002, "{speed} m/s at frame {i}");
        let radius = now.center.distance(DVec2::new(0.0, -50.0));
        assert!((radius - 20.0).abs() < 0.05, "{radius} m from the middle");
        let tangent = ahead(now.heading);
        let moved = (now.center - previous.center).normalize();
        assert!(tangent.dot(moved) > 0.999, "heads {tangent}, moves {moved}");
        assert!(wrapped(now.heading - previous.heading).abs() < 0.005, "the heading jumps at frame {i}");
        previous = now;
    }
}

#[test]
fn uneven_points_do_not_change_the_speed() {
    let uneven =
        course(&[(0.0, -10.0), (3.0, -10.0), (40.0, -30.0), (42.0, -34.0), (10.0, -60.0)], 3.0, true);
    let sailed = SailedCourse::new(&uneven, 1.0, AtEnd::Return).unwrap();
    for i in 0..3000 {
        let [here, there] = [i, i + 1].map(|i| sailed.at(f64::from(i) / 60.0).center);
        let speed = here.distance(there) * 60.0;
        assert!((speed / 3.0 - 1.0).abs() < 2e-3, "{speed} m/s at frame {i}");
    }
}

#[test]
fn rounds_close_and_come_in_any_order() {
    let sailed = SailedCourse::new(&circle(), 4.0, AtEnd::Return).unwrap();
    let round = sailed.round_seconds().unwrap();
    for seconds in [0.0, 3.7, 11.1, round - 1e-9] {
        let (now, later) = (sailed.at(seconds), sailed.at(seconds + 1000.0 * round));
        assert!(now.center.distance(later.center) < 1e-6, "{} and {}", now.center, later.center);
        assert!(wrapped(now.heading - later.heading).abs() < 1e-6);
    }
    let (end, start) = (sailed.at(round - 1e-7), sailed.at(0.0));
    assert!(end.center.distance(start.center) < 1e-5 && wrapped(end.heading - start.heading).abs() < 1e-5);
}

#[test]
fn whole_rounds_fit_a_loop() {
    let sailed = SailedCourse::new(&circle(), 4.0, AtEnd::Return).unwrap();
    for seconds in [50.0, 60.0, 120.0, 137.0] {
        let fitted = sailed.with_whole_rounds(seconds).unwrap();
        for start in [0.0, 7.3] {
            let gap = fitted.at(start).center.distance(fitted.at(start + seconds).center);
            assert!(gap < 1e-9, "{gap} m between the ends of a loop of {seconds} s");
        }
        let rounds = seconds / fitted.round_seconds().unwrap();
        assert!((rounds - rounds.round()).abs() < 1e-12, "{rounds} rounds");
    }
    assert!(matches!(sailed.with_whole_rounds(10.0), Err(CourseError::LoopTooShort { .. })));
    assert!(matches!(sailed.with_whole_rounds(f64::NAN), Err(CourseError::LoopTooShort { .. })));
    let stopping =
        SailedCourse::new(&course(&[(0.0, -9.0), (9.0, -9.0)], 1.0, false), 4.0, AtEnd::Stop).unwrap();
    assert!(matches!(stopping.with_whole_rounds(60.0), Err(CourseError::NoRounds)));
}

#[test]
fn an_open_course_starts_and_stops_gently() {
    let open = course(&[(0.0, -10.0), (12.0, -14.0), (30.0, -10.0)], 1.5, false);
    let sailed = SailedCourse::new(&open, 4.0, AtEnd::Stop).unwrap();
    assert_eq!(sailed.round_seconds(), None);
    assert_eq!(sailed.at(-5.0).center, DVec2::new(0.0, -10.0));
    assert!(sailed.at(500.0).center.distance(DVec2::new(30.0, -10.0)) < 1e-9);
    assert_eq!(sailed.at(500.0).speed, 0.0);
    let mut previous = (sailed.at(0.0), 0.0);
    let mut fastest = 0.0_f64;
    for i in 1..2400 {
        let now = sailed.at(f64::from(i) / 60.0);
        let speed = now.center.distance(previous.0.center) * 60.0;
        assert!((speed - previous.1).abs() * 60.0 < 0.55, "speed jumps from {} to {speed}", previous.1);
        assert!(
            (speed - 0.5 * (now.speed + previous.0.speed)).abs() < 0.01,
            "{speed} m/s, said {}",
            now.speed
        );
        fastest = fastest.max(speed);
        previous = (now, speed);
    }
    assert!((fastest - 1.5).abs() < 0.005, "{fastest} m/s at most");
}

#[test]
fn a_course_that_returns_turns_and_repeats() {
    // Closed with two points is there and back as well.
    for closed in [false, true] {
        let sailed =
            SailedCourse::new(&course(&[(0.0, -10.0), (20.0, -10.0)], 2.0, closed), 4.0, AtEnd::Return)
                .unwrap();
        let round = sailed.round_seconds().unwrap();
        let mut previous = sailed.at(0.0);
        let mut farthest = 0.0_f64;
        for i in 1..(round * 120.0) as i32 {
            let now = sailed.at(f64::from(i) / 60.0);
            assert!(now.center.distance(previous.center) < 2.01 / 60.0, "the body jumps at frame {i}");
            let turned = wrapped(now.heading - previous.heading).abs();
            assert!(turned < 1.6 * PI / 6.0 / 60.0, "turns by {turned} at frame {i}");
            if now.speed > 0.1 {
                let moved = (now.center - previous.center).normalize();
                assert!(moved.dot(ahead(now.heading)) > 0.999, "sails astern at frame {i}");
            }
            farthest = farthest.max(now.center.x);
            previous = now;
        }
        assert!((farthest - 20.0).abs() < 1e-6, "{farthest} m is the farthest");
    }
}

#[test]
fn a_sharp_corner_does_not_spin_the_hull() {
    let hairpin = course(&[(0.0, -10.0), (20.0, -10.0), (0.0, -10.5), (20.0, -12.0)], 2.0, false);
    let sailed = SailedCourse::new(&hairpin, 4.0, AtEnd::Stop).unwrap();
    let mut previous = sailed.at(0.0);
    for i in 1..2400 {
        let now = sailed.at(f64::from(i) / 60.0);
        // Half a turn, and that of the next corner, within a hull's length, at 2 m/s.
        let most = 1.5 * PI / 4.0 * 2.0 / 60.0;
        assert!((now.heading - previous.heading).abs() < most, "turns by {}", now.heading - previous.heading);
        previous = now;
    }
}

#[test]
fn a_course_moves_a_body_from_its_berth() {
    let berth = Berth { center: DVec3::new(1.0, 0.0, -10.0), heading: 0.0 };
    let sailing = Sailing { center: DVec2::new(4.0, -12.0), heading: 0.2, speed: 1.0 };
    let pose = sailing.pose(&berth);
    assert_eq!(pose.moved(&berth, berth.center), DVec3::new(4.0, 0.0, -12.0));
    assert!((pose.yaw - 0.195).abs() < 0.001 && pose.mirrored_share == 0.0, "{pose:?}");
    let afloat = BodyPose { position: DVec3::new(0.0, 0.2, 0.0), pitch: 0.03, ..BodyPose::default() };
    let pose = sailing.pose_on_waves(&berth, &afloat);
    assert!((pose.position.y - 0.2).abs() < 1e-12 && (pose.pitch - 0.03).abs() < 1e-5, "{pose:?}");
}

#[test]
fn what_is_no_course_is_refused() {
    let new =
        |points: &[(f64, f64)], speed| SailedCourse::new(&course(points, speed, true), 4.0, AtEnd::Return);
    assert!(matches!(new(&[(0.0, 0.0)], 1.0), Err(CourseError::TooFewPoints(1))));
    assert!(matches!(new(&[(0.0, 0.0), (0.0, 0.0)], 1.0), Err(CourseError::SamePoint(0, 1))));
    assert!(matches!(new(&[(0.0, 0.0), (5.0, 0.0), (0.0, 0.0)], 1.0), Err(CourseError::SamePoint(2, 0))));
    assert!(matches!(new(&[(0.0, 0.0), (f64::NAN, 0.0)], 1.0), Err(CourseError::NoPoint { index: 1, .. })));
    assert!(matches!(new(&[(0.0, 0.0), (1e9, 0.0)], 1.0), Err(CourseError::NoPoint { index: 1, .. })));
    for speed in [0.0, -1.0, 31.0, f64::NAN] {
        assert!(matches!(new(&[(0.0, 0.0), (5.0, 0.0)], speed), Err(CourseError::Speed(_))), "{speed} m/s");
    }
    let sailed = new(&[(0.0, 0.0), (5.0, 0.0), (5.0, 5.0)], 1.0).unwrap();
    for seconds in [f64::NAN, f64::INFINITY, -1e300] {
        let at = sailed.at(seconds);
        assert!(at.center.is_finite() && at.heading.is_finite() && at.speed.is_finite());
    }
}

const POSES: &str = r#"[
    {"seconds": 1, "position": [0, 0, 0], "yaw_deg": 170},
    {"seconds": 3, "position": [2, 0.5, -1], "yaw_deg": -170, "roll_deg": 4},
    {"seconds": 4, "position": [0, 0, 0], "yaw_deg": 170}
]"#;

#[test]
fn recorded_poses_are_joined_the_shorter_way() {
    let held = RecordedPoses::from_json(POSES, false).unwrap();
    let middle = held.at(2.0);
    assert!(middle.position.distance(DVec3::new(1.0, 0.25, -0.5)) < 1e-12);
    assert!((middle.yaw.to_degrees() - 180.0).abs() < 1e-9, "{}°", middle.yaw.to_degrees());
    assert!((middle.roll.to_degrees() - 2.0).abs() < 1e-9);
    assert_eq!((held.at(-9.0), held.at(f64::NAN)), (held.at(1.0), held.at(1.0)));
    assert_eq!(held.at(99.0), held.at(4.0));
    let looped = RecordedPoses::from_json(POSES, true).unwrap();
    for seconds in [1.0, 2.0, 3.5] {
        assert_eq!(looped.at(seconds + 3.0), looped.at(seconds));
    }
    let back = looped.at(2.0).faced();
    assert!(back.yaw.abs() < 1e-9 && back.mirrored_share == 1.0, "{back:?}");
    assert!(
        (back.roll + looped.at(2.0).roll).abs() < 1e-9,
        "rolls the other way for the mirrored picture: {back:?}"
    );
}

#[test]
fn recordings_that_are_none_are_refused() {
    let error = |json: &str| RecordedPoses::from_json(json, false).unwrap_err();
    assert!(matches!(error("[]"), PosesError::Empty));
    assert!(matches!(error("{"), PosesError::Unreadable(_)));
    let unknown = r#"[{"seconds": 0, "position": [0, 0, 0], "heading": 3}]"#;
    assert!(error(unknown).to_string().contains("heading"), "{}", error(unknown));
    let unsorted = r#"[{"seconds": 1, "position": [0, 0, 0]}, {"seconds": 1, "position": [0, 0, 0]}]"#;
    assert!(matches!(error(unsorted), PosesError::Unsorted { index: 1, .. }));
    let pose = BodyPose { pitch: f64::NAN, ..BodyPose::default() };
    let found = RecordedPoses::new(vec![(0.0, pose)], true).unwrap_err();
    assert!(matches!(found, PosesError::NoNumber { index: 0, what: "pitch", .. }), "{found}");
}
