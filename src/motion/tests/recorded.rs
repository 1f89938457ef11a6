//! Facts about what another simulator's recordings drive.

use super::*;
use crate::picture::{PngPixels, encode_png};
use crate::tour::RelativePath;
use crate::water::WaterSurface;

const SHIP: &str = r#"(name: "ship", support: Water, outline: Polygon([(420, 340), (540, 340), (480, 400)]),
    contact: ((420, 390), (540, 390)), motion: Recorded(poses: "ship.json", looped: true)),"#;

/// Forward and up, then back, in 6 s.
const POSES: &str = r#"[{"seconds": 0, "position": [0, 0, 0]},
    {"seconds": 2, "position": [1, 0.5, -3], "yaw_deg": 20, "pitch_deg": 4, "roll_deg": -6},
    {"seconds": 6, "position": [0, 0, 0]}]"#;

const FRAMES: &str =
    "sea: Recorded(first: \"sea/08.png\", count: 3, frames_per_second: 2, height: 0.5, area: (12, 6))";

/// Bytes of a tour's file: poses, and frames that rise evenly from black to two thirds.
fn file(path: &RelativePath) -> Result<Vec<u8>, String> {
    let gray = |code: u8| encode_png(UVec2::new(16, 8), PngPixels::Gray(&[code; 128])).unwrap();
    match path.as_str() {
        "ship.json" => Ok(POSES.into()),
        "sea/08.png" => Ok(gray(0)),
        "sea/09.png" => Ok(gray(85)),
        "sea/10.png" => Ok(gray(170)),
        other => Err(format!("{other} was not asked for")),
    }
}

fn recorded(wind: f64, objects: &[&str], waves: &str) -> Simulation {
    let (tour, scene) = lake(wind, objects, waves);
    let recordings = Recordings::read(&tour, &file).unwrap_or_else(|problems| panic!("{problems}"));
    let (simulation, remarks) = Simulation::new(&tour, &scene, None, &recordings);
    assert!(remarks.is_empty(), "{remarks:?}");
    simulation
}

#[test]
fn poses_bring_a_wall_where_they_say() {
    let mut simulation = recorded(0.0, &[SHIP], "");
    let (index, wall) = wall(&simulation.scene, "ship");
    assert!(!simulation.is_still() && simulation.moves(index).returns);
    assert_eq!(simulation.moment().placements[index], None, "the first pose is its rest");
    // Its bow rests to the right. Half way to the second pose, and again two rounds later.
    for seconds in [1.0, 13.0] {
        simulation.go_to(seconds);
        let placement = simulation.moment().placements[index].unwrap();
        // A billboard turns by sin(2δ)/2 for a heading δ off its rest; the rest of the turn tilts it as its keel is tilted.
        let (heading, pitch, roll) = (10_f64.to_radians(), 2_f64.to_radians(), -3_f64.to_radians());
        let yaw = 0.5 * (2.0 * heading).sin();
        let (sin, cos) = (heading - yaw).sin_cos();
        let (shown_pitch, shown_roll) = (pitch * cos - roll * sin, pitch * sin + roll * cos);
        let along = DVec3::new(wall.along.x, 0.0, wall.along.y);
        let turned = glam::DQuat::from_rotation_y(yaw)
            * glam::DQuat::from_axis_angle(DVec3::new(-along.z, 0.0, along.x), shown_pitch)
            * glam::DQuat::from_axis_angle(along, shown_roll);
        let expected = turned * along;
        assert!((placement.along - expected).length() < 1e-9, "{} instead of {expected}", placement.along);
        let middle = wall.point(0.0, 0.0) + DVec3::new(0.5, 0.25, -1.5);
        let off = (placement.origin - middle).length();
        let arm = (wall.resting().origin - wall.point(0.0, 0.0)).length();
        assert!(off <= arm + 1e-9, "its middle is {off} m off, {arm} m at most");
    }
}

#[test]
fn poses_and_frames_take_whole_rounds_of_a_loop() {
    let simulation = recorded(0.0, &[SHIP], FRAMES);
    let mut looped = simulation.looped(8.0).unwrap();
    let at = |simulation: &mut Simulation, seconds: f64| {
        simulation.go_to(seconds);
        let heights: Vec<_> = places().map(|xz| simulation.water_at(xz)).collect();
        (simulation.moment().placements.clone(), heights)
    };
    let (first, last) = (at(&mut looped, 0.75), at(&mut looped, 8.75));
    assert!(first == last, "a loop of 8 s does not close");
    // One round of 6 s in 8 s: at three quarters of its speed.
    let mut free = simulation.clone();
    free.go_to(1.5);
    looped.go_to(2.0);
    let [a, b] = [&free, &looped].map(|simulation| simulation.moment().placements[1].unwrap().origin);
    assert!((a - b).length() < 1e-9, "{a} {b}");

    let stops = SHIP.replace(", looped: true", "");
    let error = recorded(0.0, &[&stops], "").looped(8.0).unwrap_err().to_string();
    assert!(error.contains("\"ship\"") && error.contains("looped: true"), "{error}");
}

#[test]
fn frames_raise_the_water_in_any_wind_and_fade_with_the_waves() {
    let mut simulation = recorded(0.0, &[BOAT], FRAMES);
    assert!(!simulation.is_still(), "the sea runs without wind");
    // Black is a quarter of a meter below; after half a second a third of half a meter higher.
    for (seconds, expected) in [(0.0, -0.25), (0.25, -1.0 / 6.0), (0.5, -1.0 / 12.0), (1.5, -0.25)] {
        simulation.go_to(seconds);
        let MovingSea { height, slope } = MovingSea::of(&simulation);
        assert!((height - expected).abs() < 1e-5 && slope < 1e-5, "{height} m, slope {slope} at {seconds} s");
    }
    simulation.set_weather(&Weather { waves: 0.0, ..simulation.weather_to_come() });
    simulation.go_to(0.5);
    assert_eq!(MovingSea::of(&simulation).height, 0.0);
    assert_eq!(simulation.sea().unwrap().tiles()[0].size(), DVec2::new(12.0, 6.0));
}

/// The sea without ripples, where it is even.
struct MovingSea {
    height: f64,
    slope: f64,
}

impl MovingSea {
    fn of(simulation: &Simulation) -> Self {
        let sea = crate::water::MovingWater { sea: simulation.sea(), ripples: None };
        let point = sea.at(DVec2::new(2.0, -9.0), 0.0);
        Self { height: point.height, slope: point.slope.length() }
    }
}

#[test]
fn problems_of_recordings_are_told_together() {
    let (tour, _) = lake(0.0, &[SHIP], FRAMES);
    let read = |path: &RelativePath| match path.as_str() {
        "sea/09.png" => Err("it is gone".to_owned()),
        "sea/10.png" => Ok(encode_png(UVec2::new(8, 16), PngPixels::Gray(&[9; 128])).unwrap()),
        "ship.json" => Ok(br#"[{"seconds": 0, "position": [0, 0]}]"#.to_vec()),
        _ => file(path),
    };
    let said = Recordings::read(&tour, &read).unwrap_err().to_string();
    let lines: Vec<&str> = said.lines().collect();
    let expected = [
        ["waves.sea.first = \"sea/09.png\"", "it is gone", "put the file"],
        ["waves.sea.first = \"sea/10.png\"", "8 x 16", "one size"],
        ["objects[0].motion.poses = \"ship.json\"", "do not read", "write a list"],
    ];
    assert_eq!(lines.len(), expected.len(), "{said}");
    for (line, words) in lines.iter().zip(expected) {
        for word in words {
            assert!(line.contains(word), "{word:?} is not in: {line}");
        }
    }
    // Of many only the first are told one by one.
    let many = FRAMES.replace("count: 3", "count: 90");
    let (tour, _) = lake(0.0, &[], &many);
    let said = Recordings::read(&tour, &|_| Err("it is gone".to_owned())).unwrap_err();
    assert_eq!(said.0.len(), 6, "{said}");
    assert!(
        said.to_string().ends_with("says how many frames are read") && said.to_string().contains("85 more"),
        "{said}"
    );
    // What will be seen is a note.
    let (tour, _) = lake(0.0, &[], FRAMES);
    let notes = Recordings::read(&tour, &file).unwrap().notes;
    assert!(notes.len() == 1 && notes[0].contains("3 frames") && notes[0].contains("16 bits"), "{notes:?}");
}
