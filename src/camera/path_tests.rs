//! Paths whose times, stops and ends are known.

use super::*;

fn keyframe(position: [f64; 3], yaw: f64, arrive: f64, hold: f64, easing: Easing) -> Keyframe {
    let pose = CameraPose::from_angles(DVec3::from(position), yaw, -0.1 * yaw, 0.05);
    Keyframe { pose, arrive, hold, easing }
}

/// Uneven times, one stop at keyframe 2, yaw across ±π.
fn keyframes() -> Vec<Keyframe> {
    vec![
        keyframe([0.0, 1.8, 0.0], 3.0, 2.5, 0.0, Easing::Smooth),
        keyframe([2.0, 1.6, -3.0], -3.0, 4.0, 0.0, Easing::Smooth),
        keyframe([-1.0, 1.2, -4.0], -2.6, 1.5, 2.0, Easing::Smooth),
        keyframe([-1.5, 1.9, -9.0], 2.9, 3.0, 0.0, Easing::Smooth),
        keyframe([0.5, 2.0, -6.0], 2.8, 0.7, 0.0, Easing::Smooth),
    ]
}

/// When each of `keyframes()` is reached.
const ARRIVALS: [f64; 5] = [0.0, 4.0, 5.5, 10.5, 11.2];

fn path(looped: bool) -> CameraPath {
    CameraPath::new(keyframes(), looped).unwrap()
}

/// Meters and radians between two poses.
fn apart(a: &CameraPose, b: &CameraPose) -> f64 {
    let turn = 2.0 * (a.rotation.inverse() * b.rotation).xyz().length();
    a.position.distance(b.position).max(turn)
}

#[test]
fn a_path_passes_its_keyframes_at_their_times() {
    for looped in [false, true] {
        let path = path(looped);
        for (keyframe, arrival) in keyframes().iter().zip(ARRIVALS) {
            for time in [arrival, arrival + keyframe.hold, arrival - 1e-9 * f64::from(arrival > 0.0)] {
                let off = apart(&path.at(time), &keyframe.pose);
                assert!(off < 1e-7, "{off} m or rad off at {time} s");
            }
        }
        let duration = if looped { 11.2 + 2.5 } else { 11.2 };
        assert!((path.duration() - duration).abs() < 1e-12, "{} s is not {duration} s", path.duration());
    }
}

#[test]
fn speed_has_no_jump() {
    let mut mixed = keyframes();
    mixed[1].easing = Easing::In;
    mixed[2].easing = Easing::Out;
    mixed[3].easing = Easing::Linear;
    let mixed = CameraPath::new(mixed, true).unwrap();
    let h = 1e-5;
    for (path, times) in
        [(path(true), &ARRIVALS[..]), (mixed, &ARRIVALS[1..3]), (path(false), &ARRIVALS[1..])]
    {
        for &time in times {
            let [before, at, after] = [-h, 0.0, h].map(|offset| path.at(time + offset));
            let jump = ((after.position - at.position) - (at.position - before.position)).length() / h;
            assert!(jump < 1e-3, "{jump} m/s at {time} s");
            let turn = |a: CameraPose, b: CameraPose| {
                // A rotation is two quaternions; the one nearer to none tells the turn.
                let turn = a.rotation.inverse() * b.rotation;
                2.0 * turn.w.signum() * turn.xyz()
            };
            let jump = (turn(at, after) - turn(before, at)).length() / h;
            assert!(jump < 1e-3, "{jump} rad/s at {time} s");
        }
    }
}

#[test]
fn a_held_camera_stands_still() {
    for time in [5.5, 6.0, 7.3, 7.5] {
        assert_eq!(path(false).at(time), keyframes()[2].pose, "at {time} s");
    }
}

#[test]
fn yaw_turns_the_shortest_way() {
    let path = path(false);
    for step in 0..=100 {
        let (yaw, ..) = path.at(f64::from(step) * 0.04).angles();
        assert!(yaw.abs() > 2.9, "yaw {yaw} rad lies on the long way");
    }
}

#[test]
fn a_loop_ends_where_it_starts_even_after_a_year() {
    let path = path(true);
    let duration = path.duration();
    assert_eq!(path.at(duration), path.at(0.0));
    assert!(apart(&path.at(duration - 1e-9), &path.at(0.0)) < 1e-7);
    let year = 365.25 * 86_400.0;
    let frames =
        (0..=(duration * 60.0) as u32).map(|i| path.at(year + f64::from(i) / 60.0)).collect::<Vec<_>>();
    let early = (0..=(duration * 60.0) as u32)
        .map(|i| path.at(year.rem_euclid(duration) + f64::from(i) / 60.0))
        .collect::<Vec<_>>();
    for (late, early) in frames.iter().zip(&early) {
        assert!(apart(late, early) < 1e-6, "{late:?} is not {early:?}");
    }
}

#[test]
fn an_open_path_stays_at_its_ends() {
    let path = path(false);
    for time in [-1e9, -0.1, f64::NEG_INFINITY, f64::NAN] {
        assert_eq!(path.at(time), keyframes()[0].pose, "at {time} s");
    }
    for time in [11.2 + 1e-9, 1e9, f64::INFINITY] {
        assert!(apart(&path.at(time), &keyframes()[4].pose) < 1e-12, "at {time} s");
    }
}

#[test]
fn a_single_keyframe_is_a_place() {
    for looped in [false, true] {
        for keyframe in [keyframes()[0], Keyframe { arrive: 0.0, ..keyframes()[0] }] {
            let path = CameraPath::new(vec![keyframe], looped).unwrap();
            for time in [-3.0, 0.0, 1.0, 1e9] {
                assert!(apart(&path.at(time), &keyframe.pose) < 1e-12, "at {time} s");
            }
        }
    }
}

#[test]
fn a_cut_jumps_and_rests_on_both_sides() {
    let mut keyframes = keyframes();
    for seconds in [0.0, f64::MIN_POSITIVE, 1e-7] {
        keyframes[1].arrive = seconds;
        let path = CameraPath::new(keyframes.clone(), false).unwrap();
        assert_eq!(path.at(-1e-9), keyframes[0].pose);
        assert!(apart(&path.at(seconds), &keyframes[1].pose) < 1e-12, "a cut of {seconds} s");
        assert!(apart(&path.at(1e-4), &keyframes[1].pose) < 1e-6, "a cut of {seconds} s");
    }
}

#[test]
fn easing_between_two_rests_is_what_its_name_says() {
    for (easing, share) in
        [(Easing::Smooth, 0.15625), (Easing::Linear, 0.25), (Easing::In, 0.0625), (Easing::Out, 0.4375)]
    {
        let ends = [0.0, 8.0].map(|x| keyframe([x, 1.8, 0.0], 0.0, 4.0, 0.0, easing));
        let x = CameraPath::new(ends.to_vec(), false).unwrap().at(1.0).position.x;
        assert!((x - 8.0 * share).abs() < 1e-12, "{easing:?} is at {x} m, not at {} m", 8.0 * share);
    }
}

#[test]
fn a_fast_leg_does_not_swing_far_beyond_its_keyframe() {
    let way = [(0.0, 0.0), (10.0, 1.0), (11.0, 10.0)];
    let keyframes = way.map(|(x, arrive)| keyframe([x, 1.8, 0.0], 0.0, arrive, 0.0, Easing::Smooth));
    let path = CameraPath::new(keyframes.to_vec(), false).unwrap();
    let far = (0..1100).map(|i| path.at(f64::from(i) * 0.01).position.x).fold(0.0, f64::max);
    assert!(far < 11.0 + 1e-9, "swings to {far} m");
}

#[test]
fn what_is_no_path_is_refused() {
    assert_eq!(CameraPath::new(Vec::new(), true), None);
    let good = keyframes()[0];
    for bad in [
        Keyframe { hold: f64::NAN, ..good },
        Keyframe { hold: f64::INFINITY, ..good },
        Keyframe { arrive: -1.0, ..good },
        Keyframe { arrive: f64::INFINITY, ..good },
        Keyframe { pose: CameraPose { position: DVec3::NAN, ..good.pose }, ..good },
    ] {
        assert_eq!(CameraPath::new(vec![good, bad], false), None, "{bad:?}");
    }
}
