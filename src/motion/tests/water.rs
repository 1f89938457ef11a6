//! Facts about the near water and what is in it.

use super::*;

#[test]
fn a_touch_moves_the_water_near_it_until_it_rests_again() {
    let mut simulation = started(0.0, &[BOAT, ROCK], "");
    let (touched, far) = (DVec2::new(-2.0, -12.0), DVec2::new(-2.0, -30.0));
    assert!(simulation.touch(touched, 0.6, -0.8));
    assert!(!simulation.is_still());
    let mut most = [0.0_f64; 3];
    for _ in 0..60 {
        simulation.step();
        for (most, xz) in most.iter_mut().zip([touched, touched + DVec2::new(1.5, 0.0), far]) {
            *most = most.max(simulation.water_at(xz).height.abs());
        }
    }
    assert!((0.01..0.5).contains(&most[0]), "{most:?} m at, near and far from the touch within a second");
    assert!(most[1] > 0.001 && most[2] < 0.1 * most[1], "{most:?} m at, near and far from the touch");
    assert!(simulation.moment().placements.iter().any(Option::is_some), "the boat did not feel the touch");
    for _ in 0..100 * 60 {
        simulation.step();
        if simulation.is_still() {
            break;
        }
    }
    assert!(simulation.is_still(), "something still moves after 100 s");
    assert!(simulation.moment().placements.iter().all(Option::is_none), "the boat came to rest elsewhere");
}

#[test]
fn a_floating_boat_follows_long_waves() {
    let (tour, scene) = lake(5.0, &[BOAT], "sea: Octaves(max_height: 0.2, wavelength: 20, octaves: 1)");
    let (index, wall) = wall(&scene, "boat");
    let (mut simulation, _) = Simulation::new(&tour, &scene, None, &Recordings::default());
    let (mut heights, mut heaves, mut errors, mut turned) = (0.0, 0.0, 0.0, 0.0_f64);
    for step in 0..1200 {
        simulation.step();
        let placement = simulation.moment().placements[index].unwrap();
        assert!(
            (placement.along.length() - 1.0).abs() < 1e-12 && placement.along.dot(placement.up).abs() < 1e-12
        );
        assert!((placement.origin - wall.point(0.0, 0.0)).with_y(0.0).length() < 1e-12, "it left its anchor");
        // Not while it is let go from its rest.
        if step >= 300 {
            let height = simulation.sea().unwrap().sample(wall.foot).height;
            heights += f64::from(height).powi(2);
            heaves += placement.origin.y.powi(2);
            errors += (placement.origin.y - f64::from(height)).powi(2);
            turned = turned.max(placement.along.y.abs());
        }
    }
    let off = (errors / heights).sqrt();
    let swing = (heaves / heights).sqrt();
    // By itself it swings 1.11 times as high at a period of 3.58 s, 1.17 s being its own, and lags by 0.11 rad.
    assert!((1.05..1.2).contains(&swing), "it heaves {swing} times as high as the waves");
    assert!(off < 0.25, "the boat's height is {:.0} % of the waves' off", 100.0 * off);
    assert!((0.005..0.2).contains(&turned), "it pitched to {turned} m/m");
}

#[test]
fn a_course_moves_its_wall_and_leaves_a_wake() {
    let (tour, scene) = lake(0.0, &[FERRY], "");
    let (index, _) = wall(&scene, "ferry");
    let (mut simulation, _) = Simulation::new(&tour, &scene, None, &Recordings::default());
    assert!(!simulation.is_still());
    let start = simulation.moment().placements[index].unwrap().origin;
    assert!(start.distance(DVec3::new(-5.5, 0.0, -16.0)) < 1e-9, "it starts at {start}");
    let mut way = 0.0;
    let mut mirrored = [1.0_f32, 0.0];
    let mut before = start;
    for _ in 0..60 * 26 {
        simulation.step();
        let now = simulation.moment().placements[index].unwrap();
        way += (now.origin - before).with_y(0.0).length();
        before = now.origin;
        let share = simulation.moment().mirrored[index];
        mirrored = [mirrored[0].min(share), mirrored[1].max(share)];
        assert!(now.origin.y.abs() < 0.3 && now.up.y > 0.9, "it sits {} m high, {}", now.origin.y, now.up);
    }
    assert!((way - 1.5 * 26.0).abs() < 0.2, "{way} m in 26 s at 1.5 m/s");
    assert_eq!(mirrored, [0.0, 1.0], "it comes back mirrored");
    let highest = places().map(|xz| simulation.water_at(xz).height.abs()).fold(0.0, f64::max);
    assert!((0.003..0.3).contains(&highest), "its waves are {highest} m high");
}

#[test]
fn a_rock_throws_the_sea_back_and_is_no_water() {
    let (tour, scene) = lake(5.0, &[ROCK], SEA);
    let (_, rock) = wall(&scene, "rock");
    let (mut walled, _) = Simulation::new(&tour, &scene, None, &Recordings::default());
    walled.go_to(5.0);
    // Its footprint lies behind the contact line.
    let inside = rock.foot + DVec2::new(0.0, -0.3);
    assert!(!walled.touch(inside, 0.5, 1.0), "the rock is touched");
    let before = rock.foot + DVec2::new(0.0, 1.0);
    let ripple = walled.ripples().unwrap().height_at(before).abs();
    assert!(ripple > 1e-4, "{ripple} m thrown back");
    let mut open = started(5.0, &[], SEA);
    open.go_to(5.0);
    assert!(open.ripples().unwrap().is_still(), "a sea alone is no ripple");
}

#[test]
fn ripples_begin_at_the_nearest_water_of_the_picture() {
    let simulation = started(0.0, &[], "");
    let grid = simulation.ripples().unwrap().grid();
    // The lowest row sees the water 2 · 800 / 270 = 5.926 m away; from there to 8 times as far all is shown.
    let (near, fade) = (5.925_926, 0.1 * grid.side());
    assert!((grid.cell - 7.0 * near / 204.8).abs() < 1e-6, "cells of {} m", grid.cell);
    assert!((grid.origin.y + grid.side() - fade + near).abs() < 1e-6, "{grid:?}");
    assert!((grid.origin.y + fade + 8.0 * near).abs() < 1e-6, "{grid:?}");
    assert!((grid.origin.x + 0.5 * grid.side()).abs() < 1e-6, "{grid:?}");
}
