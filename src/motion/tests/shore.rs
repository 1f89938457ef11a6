//! Facts about the land around the water.

use super::*;
use crate::picture::Mask;

/// The lake's picture with land where `is_land` says (column, row).
fn land(is_land: impl Fn(u32, u32) -> bool) -> Mask {
    let size = UVec2::new(960, 540);
    let pixels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| (x, y)));
    Mask::new(size, pixels.map(|(x, y)| 255 * u8::from(is_land(x, y))).collect()).unwrap()
}

/// A lake that ends at z = −20 m: 80 pixels below the horizon, which is 2 m under the eye at a focal length of 800.
fn walled(wind: f64, objects: &[&str], waves: &str) -> Simulation {
    let (tour, scene) = lake(wind, objects, waves);
    let land = land(|_, y| y < 350);
    Simulation::new(&tour, &scene, Some(&land), &Recordings::default()).0
}

#[test]
fn a_pulse_does_not_arrive_on_land_and_comes_back() {
    let (mut walled, mut open) = (walled(0.0, &[], ""), started(0.0, &[], ""));
    let at = DVec2::new(0.0, -19.0);
    let land: Vec<DVec2> = places().map(|xz| xz - DVec2::new(0.0, 15.0)).filter(|xz| xz.y < -20.5).collect();
    assert!(!walled.touch(land[0], 0.6, -0.8), "the land is touched");
    for simulation in [&mut walled, &mut open] {
        assert!(simulation.touch(at, 0.6, -0.8));
    }
    let mut passed = 0.0_f64;
    for _ in 0..360 {
        walled.step();
        open.step();
        for &xz in &land {
            assert_eq!(walled.water_at(xz).height, 0.0, "a wave on land at {xz}");
        }
        passed = passed.max(open.water_at(DVec2::new(0.0, -21.0)).height.abs());
    }
    assert!(passed > 1e-3, "the pulse would only be {passed} m high there");
    // What would have gone on is on this side now.
    let this_side = |simulation: &Simulation| -> f64 {
        let places = (0..200).flat_map(|x| (0..200).map(move |z| DVec2::new(f64::from(x), f64::from(z))));
        let places = places.map(|place| DVec2::new(-15.0, -20.0) + 0.15 * place * DVec2::new(1.0, 0.45));
        places.map(|xz| simulation.water_at(xz).height.powi(2)).sum()
    };
    let ratio = this_side(&walled) / this_side(&open);
    assert!((1.4..2.6).contains(&ratio), "{ratio} times the waves before the shore");
}

#[test]
fn the_shore_lies_where_the_picture_shows_it_and_goes_on_beyond() {
    let mut simulation = walled(0.0, &[], "");
    let grid = *simulation.ripples().unwrap().grid();
    let texels = simulation.ripple_texels().unwrap().to_vec();
    for row in 0..grid.size {
        // In every column, also in those beyond the picture's sides.
        for column in [0, 40, 128, 255] {
            let z = grid.center(column, row).y;
            let water = texels[row * grid.size + column][3];
            let expected = if z < -20.0 { 0.0 } else { 1.0 };
            assert!(water == expected || (z + 20.0).abs() < grid.cell, "{water} of water at z = {z} m");
        }
    }
    // A tongue of land that ends in the picture, in cells of which it covers a part.
    let (tour, scene) = lake(0.0, &[], "");
    let tongue = land(|x, y| x < 400 && y < 350);
    let (mut simulation, _) = Simulation::new(&tour, &scene, Some(&tongue), &Recordings::default());
    let shares: Vec<f32> = simulation.ripple_texels().unwrap().iter().map(|texel| texel[3]).collect();
    assert!(shares.contains(&0.0) && shares.contains(&1.0), "land and water");
    assert!(shares.iter().any(|share| (0.1..0.9).contains(share)), "no cell is partly land");
    assert!(simulation.looped(8.0).unwrap().ripple_texels().unwrap().iter().map(|texel| texel[3]).eq(shares));
    // A mask of another picture says nothing.
    let small = Mask::new(UVec2::new(2, 2), vec![255; 4]).unwrap();
    let (simulation, _) = Simulation::new(&tour, &scene, Some(&small), &Recordings::default());
    assert!(simulation.ripples().unwrap().is_water(DVec2::new(0.0, -20.0)));
}

#[test]
fn a_shore_alone_leaves_the_sea_as_it_is() {
    let mut simulation = walled(5.0, &[], SEA);
    simulation.go_to(5.0);
    assert!(simulation.ripples().unwrap().is_still(), "the shore throws the sea back");
    let mut walled = walled(5.0, &[ROCK], SEA);
    walled.go_to(5.0);
    assert!(!walled.ripples().unwrap().is_still(), "the rock does not");
}
