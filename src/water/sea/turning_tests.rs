//! A sea that turns keeps its statistics and its loop, and no crest of it jumps.

use super::tests::{both, measured, run, wind};
use super::*;

/// Degrees: on the rays of the octaves, between them, behind, around.
const TURNS: [f64; 9] = [0.0, 3.0, 12.5, 25.0, 37.5, -90.0, 167.5, 180.0, -170.0];

fn texels(sea: &SeaSurface) -> Vec<[f32; 4]> {
    sea.tiles().iter().flat_map(|tile| tile.texels().to_vec()).collect()
}

#[test]
fn a_turned_sea_is_as_high_and_as_steep() {
    for mut sea in both(&wind(4.0, 3)) {
        let height = sea.waves().unwrap().significant_height();
        let slope = sea.waves().unwrap().slope_covariance().total().sqrt();
        for turn in TURNS {
            sea.turn(turn);
            sea.update(2.1, 1.0);
            let [m0, m2] = measured(&sea);
            assert!((4.0 * m0.sqrt() / height - 1.0).abs() < 0.03, "{turn}°: {} m", 4.0 * m0.sqrt());
            // With the waves too short for the tiles, of which there are more in some directions.
            let found = (m2 + sea.hidden_covariance().total()).sqrt();
            assert!((found / slope - 1.0).abs() < 0.05, "{turn}°: slope {found} instead of {slope}");
            let tiles = sea.tiles().iter();
            let lost: f64 = tiles.map(|tile| tile.lost_by_level()[LEVELS - 1].total()).sum();
            assert!((lost / m2 - 1.0).abs() < 0.03, "{turn}°: {lost} of {m2} vanish in the mean");
        }
    }
}

#[test]
fn a_turned_sea_is_the_sum_of_its_waves_and_repeats() {
    for mut sea in both(&wind(4.0, 3)) {
        let period = sea.waves().unwrap().period();
        for turn in TURNS {
            sea.turn(turn);
            sea.update(3.21, 1.0);
            let found = sea.sample(DVec2::ZERO);
            let truth = sea.waves().unwrap().exact(DVec2::ZERO, 3.21);
            assert!((found.height - truth.height).abs() < 1e-6, "{turn}°: {found:?} {truth:?}");
            assert!((found.slope - truth.slope).length() < 1e-5, "{turn}°: {found:?} {truth:?}");
            assert!(
                (found.displacement - truth.displacement).length() < 1e-6,
                "{turn}°: {found:?} {truth:?}"
            );
            assert!((found.potential - truth.potential).abs() < 1e-6, "{turn}°: {found:?} {truth:?}");
            let first = texels(&sea);
            sea.update(3.21 + 3.0 * period, 1.0);
            let gap = first.iter().zip(texels(&sea)).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f32::max);
            assert!(gap < 1e-6, "{turn}°: a gap of {gap} m");
        }
    }
}

#[test]
fn a_turned_sea_runs_where_it_is_turned_to() {
    for mut sea in both(&wind(4.0, 2)) {
        for turn in TURNS {
            sea.turn(turn);
            let angle = (30.0 + turn).to_radians() as f32;
            let off = run(&mut sea).angle_to(Vec2::new(angle.cos(), -angle.sin())).to_degrees();
            assert!(off.abs() < 10.0, "{off}° from {turn}°");
        }
    }
}

#[test]
fn turning_moves_the_water_gently_near_and_far() {
    for mut sea in both(&wind(4.0, 2)) {
        let height = sea.waves().unwrap().significant_height() as f32;
        for turn in TURNS {
            sea.turn(turn);
            sea.update(5.0, 1.0);
            let before = sea.clone();
            sea.turn(turn + 0.1);
            sea.update(5.0, 1.0);
            // A sea turned about one point would have moved by 17 m at 10 km from it.
            for far in [0.0, 100.0, 10_000.0] {
                let places =
                    (0..400).map(|i| DVec2::new(far + 0.37 * f64::from(i), -far - 0.11 * f64::from(i)));
                let most = places
                    .map(|xz| (sea.sample(xz).height - before.sample(xz).height).abs())
                    .fold(0.0, f32::max);
                assert!(most < 0.02 * height, "{turn}°, {far} m away: {most} m of {height} m");
            }
        }
    }
}

#[test]
fn a_sea_that_is_back_is_the_same_to_the_bit() {
    for mut sea in both(&wind(4.0, 2)) {
        sea.update(5.0, 1.0);
        let own = texels(&sea);
        for back in [0.0, 360.0, -720.0, f64::NAN, f64::INFINITY] {
            sea.turn(70.0);
            sea.update(1.0, 1.0);
            sea.turn(back);
            sea.update(5.0, 1.0);
            assert!(texels(&sea) == own, "another sea after a turn by {back}°");
        }
    }
}
