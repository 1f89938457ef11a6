//! Facts about what moves, on a small lake with a boat, a ferry, a rock and a tree.

mod jump;
mod recorded;
mod roles;
mod shore;
mod water;
mod weather;

use glam::{DVec2, DVec3, IVec2, UVec2};

use super::*;
use crate::camera::{CameraPose, Intrinsics, PinholeCamera};
use crate::picture::PicturePoint;
use crate::scene::{self, BackdropPlace, BackdropPlan, BillboardPlan, ScenePlan, Surface, TourScene, Wall};
use crate::tour::{Tour, Wind};
use crate::wind::Weather;

const BOAT: &str = r#"(name: "boat", support: Water, outline: Polygon([(420, 340), (540, 340), (480, 400)]),
    contact: ((420, 390), (540, 390)), motion: Floating(draft: 0.2)),"#;

const FERRY: &str = r#"(name: "ferry", support: Water, outline: Polygon([(200, 330), (320, 330), (260, 380)]),
    contact: ((200, 370), (320, 370)),
    motion: Course(waypoints: [(-5.5, -16), (4, -17), (4, -28), (-6, -26)], speed: 1.5, draft: 0.3, closed: true)),"#;

const ROCK: &str = r#"(name: "rock", support: Water, outline: Polygon([(640, 350), (760, 350), (700, 385)]),
    contact: ((640, 380), (760, 380))),"#;

const TREE: &str = r#"(name: "tree", support: Water, outline: Polygon([(60, 100), (160, 100), (110, 330)]),
    contact: ((100, 330), (120, 330)), motion: Sway(kind: Trunk)),"#;

const SEA: &str = "sea: Octaves(max_height: 0.12, wavelength: 9)";

/// A lake in a wind (m/s) with these objects and waves, seen by a level camera 2 m above it.
fn lake(wind: f64, objects: &[&str], waves: &str) -> (Tour, TourScene) {
    let text = format!(
        r#"(version: 1, picture: (file: "lake.png", size: (960, 540)),
        camera: (horizon: ((0, 270), (960, 270)), focal_length: Known(800), scale: HeightAboveWater(2)),
        water: (region: Polygon([(0, 280), (960, 280), (960, 540), (0, 540)])),
        background: (place: Distance(120)), sky: (), objects: [{}],
        wind: (speed: {wind:?}, direction_deg: 40, seed: 3), waves: ({waves}))"#,
        objects.concat()
    );
    let tour = Tour::read(&text).unwrap_or_else(|problems| panic!("{problems}"));
    let camera = PinholeCamera {
        intrinsics: Intrinsics {
            focal_px: 800.0,
            principal: PicturePoint::new(480.0, 270.0),
            size: UVec2::new(960, 540),
        },
        pose: CameraPose::from_angles(DVec3::new(0.0, 2.0, 0.0), 0.0, 0.0, 0.0),
    };
    let billboards = tour.objects.iter().map(|object| BillboardPlan {
        name: object.name.clone(),
        support: object.support,
        contact: object.contact,
        turns_to_camera: false,
        mask_box: [IVec2::new(object.contact[0].x() as i32, 100), object.contact[1].0.as_ivec2() + 10],
    });
    let plan = ScenePlan {
        camera,
        water: true,
        ground_height: None,
        backdrops: vec![BackdropPlan { name: "background".into(), place: BackdropPlace::Distance(120.0) }],
        billboards: billboards.collect(),
    };
    let (scene, remarks) = scene::build(&plan);
    assert!(remarks.is_empty(), "{remarks:?}");
    (tour, scene)
}

fn started(wind: f64, objects: &[&str], waves: &str) -> Simulation {
    let (tour, scene) = lake(wind, objects, waves);
    let (simulation, remarks) = Simulation::new(&tour, &scene, None, &Recordings::default());
    assert!(remarks.is_empty(), "{remarks:?}");
    simulation
}

fn wall(scene: &TourScene, name: &str) -> (usize, Wall) {
    let index = scene.components.iter().position(|component| component.name == name).unwrap();
    let Surface::Wall(wall) = scene.components[index].surface else { panic!("{name} is no wall") };
    (index, wall)
}

fn wind(speed: f64) -> Wind {
    Wind { speed, direction_deg: 40.0, ..Wind::default() }
}

/// Places all over the water, near and far.
fn places() -> impl Iterator<Item = DVec2> {
    (0..400).map(|i| DVec2::new(f64::from(i % 20) - 9.7, -5.3 - 1.7 * f64::from(i / 20)))
}

/// Everything that two simulations show is the same, to the bit.
fn assert_same(a: &mut Simulation, b: &mut Simulation, when: &str) {
    assert_eq!(a.steps(), b.steps(), "{when}");
    assert_eq!(a.moment(), b.moment(), "{when}");
    let bits = |simulation: &mut Simulation| -> Vec<u32> {
        simulation.ripple_texels().unwrap().iter().flatten().map(|number| number.to_bits()).collect()
    };
    assert!(bits(a) == bits(b), "ripples differ {when}");
    for xz in places() {
        assert_eq!(a.water_at(xz), b.water_at(xz), "water at {xz} {when}");
    }
}

#[test]
fn without_wind_everything_rests_to_the_bit() {
    let mut simulation = started(0.0, &[BOAT, ROCK, TREE], SEA);
    assert!(simulation.is_still());
    for _ in 0..120 {
        simulation.step();
    }
    let moment = simulation.moment();
    assert!(moment.sways.iter().all(|sway| sway.size.z == 0.0), "a plant moves");
    assert!(
        moment.placements.iter().all(Option::is_none) && moment.mirrored.iter().all(|share| *share == 0.0)
    );
    assert_eq!((moment.clouds[0].weight, moment.clouds[0].offset_px), (1.0, DVec2::ZERO));
    assert_eq!(simulation.sea().unwrap().present_gain(), 0.0);
    assert!(simulation.ripples().unwrap().is_still() && simulation.is_still());
    for xz in places() {
        assert_eq!(simulation.water_at(xz), Default::default());
    }
}

#[test]
fn steps_and_jumps_lead_to_the_same_bits() {
    let all = [BOAT, FERRY, ROCK, TREE];
    let mut stepped = started(5.0, &all, SEA);
    for _ in 0..200 {
        stepped.step();
    }
    let mut jumped = started(5.0, &all, SEA);
    jumped.touch(DVec2::new(0.0, -9.0), 0.5, 1.0);
    jumped.go_to(200.0 / 60.0);
    assert_same(&mut stepped, &mut jumped, "after 200 steps");
    // Elsewhere and back, with touches between.
    stepped.go_to(31.0);
    stepped.touch(DVec2::new(0.0, -9.0), 0.5, 1.0);
    stepped.step();
    jumped.go_to(0.0);
    jumped.go_to(31.0);
    stepped.go_to(31.0);
    assert_same(&mut stepped, &mut jumped, "at 31 s");
    assert_eq!(stepped.steps(), 1860);
    stepped.go_to(f64::NAN);
    jumped.go_to(-5.0);
    assert_same(&mut stepped, &mut jumped, "at the start");
}

#[test]
fn a_wind_set_at_run_time_stays_when_time_jumps() {
    let mut turned = started(1.0, &[BOAT, TREE], SEA);
    turned.step();
    turned.set_weather(&wind(6.0).into());
    assert_eq!((turned.wind().speed, turned.weather_to_come().wind.speed), (1.0, 6.0));
    turned.go_to(2.0);
    assert_eq!(turned.wind().speed, 6.0);
}

#[test]
fn what_is_no_number_does_nothing() {
    let mut simulation = started(3.0, &[BOAT, ROCK, TREE], SEA);
    let mut same = simulation.clone();
    let at = DVec2::new(0.0, -10.0);
    for (at, radius, impulse) in [
        (DVec2::NAN, 0.5, 1.0),
        (DVec2::splat(f64::INFINITY), 0.5, 1.0),
        (DVec2::splat(1e9), 0.5, 1.0),
        (at, f64::NAN, 1.0),
        (at, 0.5, f64::INFINITY),
        (at, 0.5, 0.0),
    ] {
        assert!(!simulation.touch(at, radius, impulse), "touched at {at} by {radius} m and {impulse} m/s");
    }
    let nan = f64::NAN;
    let wild = Wind { speed: nan, direction_deg: nan, gusts: nan, seed: 9, period_seconds: nan };
    simulation.set_weather(&Weather { wind: wild, waves: nan });
    for _ in 0..30 {
        simulation.step();
        same.step();
    }
    assert_same(&mut simulation, &mut same, "after nothing");
    assert_eq!(simulation.water_at(DVec2::NAN), Default::default());
    simulation.set_weather(&Weather { wind: wind(1e300), waves: 1e300 });
    assert!(simulation.touch(at, 1e300, -1e300));
    for _ in 0..600 {
        simulation.step();
    }
    assert_eq!(simulation.wind().speed, crate::wind::FASTEST_WIND);
    for xz in places() {
        let point = simulation.water_at(xz);
        assert!(point.height.abs() < 3.0 && point.normal().is_normalized(), "{point:?} at {xz}");
    }
    simulation.go_to(f64::INFINITY);
    assert!(
        simulation.seconds().is_finite() && simulation.moment().placements[1].unwrap().origin.is_finite()
    );
}

#[test]
fn remarks_say_what_rests_and_why() {
    let ship = r#"(name: "ship", support: Water, outline: Polygon([(420, 340), (540, 340), (480, 400)]),
        contact: ((420, 390), (540, 390)), motion: Recorded(poses: "ship.json")),"#;
    let reed = r#"(name: "reed", support: Water, outline: Polygon([(60, 330), (160, 330), (110, 340)]),
        contact: ((100, 330), (120, 330)), motion: Sway(kind: Reed)),"#;
    let sea = r#"sea: Recorded(first: "0.png", count: 9, frames_per_second: 25, height: 1, area: (9, 9)), ripples: false"#;
    let (tour, scene) = lake(3.0, &[ship, reed], sea);
    let (mut simulation, remarks) = Simulation::new(&tour, &scene, None, &Recordings::default());
    let expected = [("sea", "0.png"), ("ship", "ship.json"), ("reed", "apart")];
    assert_eq!(remarks.len(), expected.len(), "{remarks:?}");
    for (remark, (name, why)) in remarks.iter().zip(expected) {
        assert!(remark.contains(name) && remark.contains(why), "{remark}");
        assert_eq!(remark.contains(".tour.ron"), name != "reed", "{remark}");
    }
    assert!(simulation.sea().is_none() && simulation.ripple_texels().is_none());
    assert!(!simulation.touch(DVec2::new(0.0, -10.0), 0.5, 1.0));
}
