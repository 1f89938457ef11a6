//! Visitors in a box around a painter who looks a little aside and down, with a roll.

use super::*;

const BOUNDS: [DVec3; 2] = [DVec3::new(-3.0, 0.6, -7.0), DVec3::new(4.0, 4.0, 1.0)];

fn home() -> CameraPose {
    CameraPose::from_angles(DVec3::new(0.3, 1.8, 0.2), 0.1, -0.05, 0.03)
}

fn step(visitor: Visitor, wish: VisitorWish, seconds: f64) -> Visitor {
    visitor.step(&VisitorSettings::default(), &home(), BOUNDS, &wish, seconds)
}

fn pose(visitor: &Visitor) -> CameraPose {
    visitor.pose(&VisitorSettings::default(), &home(), BOUNDS)
}

fn wish() -> VisitorWish {
    VisitorWish { lean: DVec2::new(0.6, -0.3), step: 0.8, ..VisitorWish::default() }
}

fn look(yaw: f64, pitch: f64) -> VisitorWish {
    VisitorWish { look: DVec2::new(yaw, pitch), ..VisitorWish::default() }
}

/// Steps of 1/60 s with the same wish in each.
fn frames(visitor: Visitor, wish: VisitorWish, count: usize) -> Visitor {
    (0..count).fold(visitor, |visitor, _| step(visitor, wish, 1.0 / 60.0))
}

fn assert_same(a: &Visitor, b: &Visitor) {
    for (a, b) in a.axes.iter().zip(&b.axes) {
        for (a, b) in [(a.wanted, b.wanted), (a.now, b.now), (a.speed, b.speed)] {
            assert!((a - b).abs() < 1e-9, "{a} is not {b}");
        }
    }
}

fn assert_inside(visitor: &Visitor) {
    let position = pose(visitor).position;
    let inside = position.cmpge(BOUNDS[0]).all() && position.cmple(BOUNDS[1]).all();
    assert!(inside, "{position} is outside of {BOUNDS:?}");
    let (yaw, pitch, roll) = pose(visitor).angles();
    assert!((yaw - 0.1).abs() <= 35.0_f64.to_radians() + 1e-12, "yaw {yaw} rad");
    assert!((pitch + 0.05).abs() <= 20.0_f64.to_radians() + 1e-12, "pitch {pitch} rad");
    assert!((roll - 0.03).abs() < 1e-12, "roll {roll} rad");
}

#[test]
fn a_visitor_at_rest_sees_the_picture_itself() {
    let visitor = frames(Visitor::default(), VisitorWish::default(), 100);
    assert_eq!(visitor, Visitor::default());
    assert_eq!(pose(&visitor), home());
}

#[test]
fn two_half_steps_are_one_step() {
    let start = frames(frames(Visitor::default(), look(0.01, -0.004), 20), wish(), 20);
    let half = |wish: VisitorWish| VisitorWish { look: wish.look / 2.0, advance: wish.advance / 2.0, ..wish };
    let near = VisitorWish { advance: 0.1, ..wish() };
    let home = VisitorWish { go_home: true, ..VisitorWish::default() };
    for wish in [VisitorWish::default(), wish(), near, look(-0.2, 0.1), look(-3.0, 2.0), home] {
        // The longest runs into the limits within the step.
        for seconds in [1.0 / 240.0, 0.1, 0.9, 20.0] {
            let whole = step(start, wish, seconds);
            assert_same(&step(step(start, half(wish), seconds / 2.0), half(wish), seconds / 2.0), &whole);
        }
    }
}

#[test]
fn walking_while_turning_depends_little_on_the_frame_rate() {
    let turn = |rate: f64| VisitorWish { look: DVec2::new(0.5 / rate, 0.0), ..wish() };
    let [slow, fast] = [30.0, 240.0].map(|rate: f64| {
        (0..rate as usize).fold(Visitor::default(), |visitor, _| step(visitor, turn(rate), 1.0 / rate))
    });
    let apart = pose(&slow).position.distance(pose(&fast).position);
    assert!(apart < 1e-4, "{apart} m apart");
}

#[test]
fn a_drag_looks_and_leans() {
    let visitor = frames(step(Visitor::default(), look(-0.2, 0.1), 0.01), VisitorWish::default(), 120);
    let (yaw, pitch, _) = pose(&visitor).angles();
    assert!((yaw + 0.1).abs() < 1e-4 && (pitch - 0.05).abs() < 1e-4, "yaw {yaw}, pitch {pitch} rad");
    let [_, right] = level(0.1);
    let shift = pose(&visitor).position - home().position;
    let expected = right * 0.16 + DVec3::Y * 0.08;
    assert!(shift.distance(expected) < 1e-3, "shifted by {shift}, not {expected}");
}

#[test]
fn a_notch_of_the_wheel_goes_where_one_looks() {
    let turned = frames(step(Visitor::default(), look(0.3, 0.2), 0.01), VisitorWish::default(), 120);
    let notch = VisitorWish { advance: 0.1, ..VisitorWish::default() };
    let moved = frames(step(turned, notch, 0.01), VisitorWish::default(), 120);
    let way = pose(&moved).position - pose(&turned).position;
    let expected = level(0.4)[0];
    assert!(way.distance(expected) < 1e-3, "went by {way} m, not {expected}");
}

#[test]
fn motion_has_no_jerk_at_its_start_and_end() {
    let mut visitor = Visitor::default();
    let mut last = DVec3::ZERO;
    for frame in 0..360 {
        let wish = if frame < 120 { wish() } else { VisitorWish::default() };
        let before = pose(&visitor).position;
        visitor = step(visitor, wish, 1.0 / 60.0);
        let speed = (pose(&visitor).position - before) * 60.0;
        // At most the full speed over the time constant, twice that at a limit, for a sixtieth of a second.
        assert!(speed.distance(last) < 0.5, "speed jumps from {last} to {speed} m/s in frame {frame}");
        last = speed;
    }
    assert!(last.length() < 1e-3, "still moves at {last} m/s");
}

#[test]
fn nothing_leads_out_of_the_bounds() {
    for (aside, ahead) in [(1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)] {
        let wish = VisitorWish {
            lean: DVec2::new(aside, ahead),
            step: ahead,
            look: DVec2::new(aside, -ahead),
            ..VisitorWish::default()
        };
        let mut visitor = Visitor::default();
        for seconds in [0.01, 0.5, 3.0, 3600.0, 1e9, f64::INFINITY, f64::NAN, -5.0, 0.0, 0.01] {
            visitor = step(visitor, wish, seconds);
            assert_inside(&visitor);
        }
        let before = pose(&visitor).position;
        let back =
            pose(&frames(visitor, VisitorWish { step: -ahead, ..VisitorWish::default() }, 60)).position;
        assert!((back.z - before.z) * ahead > 0.3, "turning back hardly moves: {before} to {back}");
    }
}

#[test]
fn numbers_that_are_none_do_no_harm() {
    let mad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300];
    let mut visitor = Visitor::default();
    for bad in mad {
        let wish = VisitorWish {
            lean: DVec2::splat(bad),
            step: bad,
            advance: bad,
            look: DVec2::splat(bad),
            go_home: false,
        };
        for seconds in [0.0, 0.016, 3.0] {
            visitor = step(visitor, wish, seconds);
            assert_inside(&visitor);
        }
        let settings =
            VisitorSettings { scale: bad, glide: bad, sway: bad, reach: bad, ..VisitorSettings::default() };
        let strange = visitor.step(&settings, &home(), BOUNDS, &self::wish(), 0.1);
        assert_inside(&strange);
        assert!(strange.pose(&settings, &home(), BOUNDS).position.is_finite());
    }
}

#[test]
fn going_home_arrives_exactly() {
    let far = frames(frames(Visitor::default(), look(0.02, -0.01), 30), wish(), 200);
    let mut visitor = step(far, VisitorWish { go_home: true, ..VisitorWish::default() }, 1.0 / 60.0);
    let mut count = 0;
    while visitor.is_homing() {
        let before = pose(&visitor).position;
        visitor = step(visitor, VisitorWish::default(), 1.0 / 60.0);
        let moved = pose(&visitor).position.distance(before);
        assert!(moved < 0.15, "leaps by {moved} m");
        count += 1;
        assert!(count < 600, "not home after 10 s: {visitor:?}");
    }
    assert_eq!(visitor, Visitor::default());
    assert_eq!(pose(&visitor), home());
}

#[test]
fn any_wish_calls_going_home_off() {
    let far = frames(Visitor::default(), wish(), 200);
    let homing = frames(far, VisitorWish { go_home: true, ..VisitorWish::default() }, 30);
    let stayed = step(homing, look(1e-6, 0.0), 1.0 / 60.0);
    assert!(homing.is_homing() && !stayed.is_homing());
    let later = frames(stayed, VisitorWish::default(), 300);
    let run = pose(&later).position.distance(pose(&stayed).position);
    assert!(run > 0.01 && run < 0.6, "runs on by {run} m");
    assert!(pose(&later).position.distance(home().position) > 0.5, "came home all the same");
}

#[test]
fn a_home_at_or_beyond_the_bounds_is_still_home() {
    let bounds = [DVec3::new(0.3, 2.0, -7.0), DVec3::new(4.0, 4.0, 0.2)];
    let settings = VisitorSettings::default();
    let mut visitor = Visitor::default();
    assert_eq!(visitor.pose(&settings, &home(), bounds), home());
    let out = VisitorWish { lean: DVec2::new(-1.0, -1.0), step: -1.0, ..VisitorWish::default() };
    for _ in 0..100 {
        visitor = visitor.step(&settings, &home(), bounds, &out, 0.1);
        let position = visitor.pose(&settings, &home(), bounds).position;
        assert!(position.x >= 0.3 && position.y >= 1.8 && position.z <= 0.2, "{position} is outside");
    }
}

#[test]
fn a_visitor_who_takes_over_stands_where_the_camera_stood() {
    let settings = VisitorSettings::default();
    let poses = [
        pose(&frames(Visitor::default(), wish(), 90)),
        pose(&frames(frames(Visitor::default(), look(0.02, -0.01), 200), wish(), 300)),
        CameraPose::from_angles(DVec3::new(-1.2, 2.2, -3.0), -0.2, 0.1, 0.03),
    ];
    for there in poses {
        let found = pose(&Visitor::at(&there, &settings, &home(), BOUNDS));
        assert!(
            found.position.distance(there.position) < 1e-3,
            "{} is not {}",
            found.position,
            there.position
        );
        assert!(found.rotation.angle_between(there.rotation) < 1e-3, "it looks elsewhere");
    }
    assert_eq!(Visitor::at(&home(), &settings, &home(), BOUNDS), Visitor::default());
    let outside = CameraPose::from_angles(DVec3::new(50.0, -3.0, f64::NAN), 2.0, -1.0, 0.0);
    assert_inside(&Visitor::at(&outside, &settings, &home(), BOUNDS));
}
