//! Facts about how smoothly everything moves, when the wind changes and after a year.

use glam::Vec2;

use super::*;

/// The most by which anything changed in each of `steps` steps: tips of plants and walls, and the water (meters).
fn most_changes(
    simulation: &mut Simulation,
    steps: usize,
    mut between: impl FnMut(&mut Simulation, usize),
) -> [f64; 3] {
    let mut most = [0.0_f64; 3];
    let state = |simulation: &Simulation| {
        let moment = simulation.moment();
        let tips = moment.sways.iter().filter(|sway| sway.size.z != 0.0).map(|sway| {
            let tip = Vec2::new(sway.stem.x + 0.3, sway.stem.y + 0.9 * sway.size.x);
            sway.displacement(tip).as_dvec2().extend(0.0)
        });
        let walls = moment.placements.iter().flatten().map(|placement| placement.origin + 2.0 * placement.up);
        let water = places().map(|xz| DVec3::new(0.0, simulation.water_at(xz).height, 0.0));
        [tips.collect::<Vec<_>>(), walls.collect(), water.collect()]
    };
    let mut before = state(simulation);
    for step in 0..steps {
        between(simulation, step);
        simulation.step();
        let now = state(simulation);
        for (most, (before, now)) in most.iter_mut().zip(before.iter().zip(&now)) {
            // What is still at one end has nothing to compare.
            let changes = before.iter().zip(now).map(|(a, b)| a.distance(*b));
            *most = changes.fold(*most, f64::max);
        }
        before = now;
    }
    most
}

#[test]
fn a_change_of_wind_makes_nothing_jump() {
    let all = [BOAT, ROCK, TREE];
    let steady = most_changes(&mut started(10.0, &all, SEA), 900, |_, _| {});
    let mut simulation = started(2.0, &all, SEA);
    // Waves keep the length of the tour's own wind, so those of 2 m/s are what the changing ones can be compared with.
    let own = most_changes(&mut started(2.0, &all, SEA), 900, |_, _| {});
    let changing = most_changes(&mut simulation, 900, |simulation, step| match step {
        300 => simulation.set_weather(&Wind { direction_deg: -120.0, ..wind(10.0) }.into()),
        600 => simulation.set_weather(&wind(0.0).into()),
        _ => {}
    });
    assert!(steady[0] > 1e-4, "the tree hardly moves");
    assert!(changing[0] < 1.5 * steady[0], "tips change by {} m, steadily by {}", changing[0], steady[0]);
    let highest = simulation.sea().unwrap().gain(10.0);
    for i in [1, 2] {
        assert!(changing[i] < 1.5 * highest * own[i], "{changing:?} against {own:?} times {highest}");
    }
}

#[test]
fn the_sea_turns_with_the_wind_and_is_back_with_it() {
    let mut simulation = started(5.0, &[], SEA);
    let own = simulation.weather_to_come();
    let turned = Weather { wind: Wind { direction_deg: 130.0, ..own.wind }, ..own };
    // Where the waves run: for one that runs along c, η_t = −c·∇η.
    let run = |simulation: &mut Simulation| {
        let before = simulation.sea().unwrap().tiles().clone();
        simulation.step();
        let tiles = before.iter().zip(simulation.sea().unwrap().tiles());
        let texels = tiles.flat_map(|(a, b)| a.texels()[..128 * 128].iter().zip(b.texels()));
        -texels.map(|(a, b)| (b[0] - a[0]) * Vec2::new(a[1] + b[1], a[2] + b[2])).sum::<Vec2>()
    };
    for (weather, degrees) in [(turned, 130.0_f32), (own, 40.0)] {
        simulation.set_weather(&weather);
        for _ in 0..1500 {
            simulation.step();
        }
        let to = Vec2::new(degrees.to_radians().cos(), -degrees.to_radians().sin());
        let off = run(&mut simulation).angle_to(to).to_degrees();
        assert!(off.abs() < 12.0, "{off}° from {degrees}°");
        let mut jumped = started(5.0, &[], SEA);
        jumped.set_weather(&weather);
        jumped.go_to(simulation.seconds());
        assert_same(&mut simulation, &mut jumped, "after the change");
    }
    let mut never = started(5.0, &[], SEA);
    never.go_to(simulation.seconds());
    assert_same(&mut simulation, &mut never, "back at the tour's own wind");
}

#[test]
fn after_a_year_it_moves_as_smoothly_as_at_the_start() {
    let all = [BOAT, FERRY, ROCK, TREE];
    let year = 3.15e7;
    let (mut young, mut old) = (started(5.0, &all, SEA), started(5.0, &all, SEA));
    old.go_to(year);
    assert_eq!(old.steps(), 1_890_000_000);
    // A whole number of loops of 20 s: plants, clouds and sea are as at the start.
    for (a, b) in young.moment().sways.iter().zip(&old.moment().sways) {
        for (a, b) in a.rows().iter().zip(b.rows()) {
            assert!((*a - b).abs().max_element() < 1e-6, "{a} at the start, {b} after a year");
        }
    }
    for xz in places() {
        let [a, b] = [&young, &old].map(|simulation| simulation.sea().unwrap().sample(xz).height);
        assert!((a - b).abs() < 1e-5, "{a} m at the start, {b} m after a year");
    }
    young.go_to(20.0);
    let [young, old] = [&mut young, &mut old].map(|simulation| most_changes(simulation, 240, |_, _| {}));
    for i in 0..3 {
        assert!(old[i] < 1.25 * young[i] && old[i] > 0.5 * young[i], "{young:?} then {old:?}");
    }
}

#[test]
fn a_plant_stands_where_the_picture_shows_it() {
    let masked = TREE.replace("Polygon([(60, 100), (160, 100), (110, 330)])", "Mask(\"tree.png\")");
    let marked = TREE.replace("kind: Trunk", "kind: Trunk, root: (115, 320), tip: (130, 110)");
    // At 2 · 800 / 60 = 26.67 m, where a pixel is 1/30 m; from the foot in the middle at (110, 330).
    let meters = 1.0 / 30.0;
    for (tree, root, tip) in [
        (TREE, DVec2::ZERO, DVec2::new(0.0, 230.0)),
        (&masked, DVec2::ZERO, DVec2::new(0.0, 230.0)),
        (&marked, DVec2::new(5.0, 10.0), DVec2::new(20.0, 220.0)),
    ] {
        let (tour, scene) = lake(4.0, &[tree], "");
        let (index, _) = wall(&scene, "tree");
        let (simulation, remarks) = Simulation::new(&tour, &scene, None, &Recordings::default());
        assert!(remarks.is_empty(), "{remarks:?}");
        let record = simulation.moment().sways[index];
        let stem = record.stem.as_dvec4();
        let found = (stem.truncate().truncate(), f64::from(record.size.x) * DVec2::new(stem.z, stem.w));
        assert!(found.0.distance(meters * root) < 1e-4, "rooted at {} m", found.0);
        assert!(found.1.distance(meters * (tip - root)) < 1e-4, "{} m from root to tip", found.1);
        assert_eq!(record.size.z, 1.0, "it sways");
    }
}

#[test]
fn clouds_follow_the_wind_unless_the_tour_says_how() {
    let (tour, mut scene) = lake(4.0, &[], "");
    assert!(
        !Simulation::new(&tour, &scene, None, &Recordings::default()).0.moves(0).drifts,
        "what is 120 m away is no sky"
    );
    scene.components[0].surface = Surface::Infinity;
    assert!(
        !Simulation::new(&tour, &scene, None, &Recordings::default()).0.moves(0).drifts,
        "mountains may be as far"
    );
    scene.components[0].name = "sky".to_owned();
    let at_2_s = |tour: &Tour| {
        let (mut simulation, _) = Simulation::new(tour, &scene, None, &Recordings::default());
        simulation.go_to(2.0);
        simulation.moment().clouds[0].offset_px
    };
    let drift = crate::wind::drift_of_wind(&tour.wind, 800.0);
    let followed = at_2_s(&tour);
    assert!((followed.length() - 2.0 * drift.speed).abs() < 1e-9 && followed.x > 0.5, "{followed} px in 2 s");
    let mut file = tour.to_file();
    file.sky.as_mut().unwrap().drift = Some(crate::tour::Drift { speed: 3.0, direction_deg: 90.0 });
    let said = at_2_s(&Tour::check(file.clone()).unwrap());
    assert!(said.distance(DVec2::new(0.0, -6.0)) < 1e-9, "{said} px in 2 s, 6 px up were asked for");
    file.sky = None;
    assert_eq!(at_2_s(&Tour::check(file).unwrap()), DVec2::ZERO, "no sky, no clouds");
}
