//! Bands are as many as the depth supports.

use glam::DVec2;

use super::world::{Lake, frontal};
use super::{GRAY, GREEN, hills, map_of, receding};
use crate::depth::{BandOptions, DepthBand, bands};
use crate::picture::Mask;

fn bands_of(lake: &Lake, options: BandOptions) -> (Vec<DepthBand>, Mask) {
    let shot = lake.shot();
    let land: Vec<u8> = shot.water.values().iter().map(|&w| 255 - w).collect();
    let land = Mask::new(shot.picture.size(), land).unwrap();
    let map = map_of(&shot, &lake.camera);
    (bands(&shot.picture, &land, &shot.water, &lake.camera, &map, &options), land)
}

#[test]
fn two_walls_make_two_bands_before_the_sky() {
    let lake = hills(-2.0, 0.0);
    let (found, land) = bands_of(&lake, BandOptions::default());
    let distances: Vec<f64> = found.iter().map(|band| band.distance).collect();
    let standing: Vec<&DepthBand> = found.iter().filter(|band| band.distance.is_finite()).collect();
    assert_eq!(standing.len(), 2, "{distances:?}");
    for (band, truth) in standing.iter().zip([150.0, 60.0]) {
        assert!((band.distance / truth - 1.0).abs() < 0.03, "{} m instead of {truth}", band.distance);
        assert!(
            (band.distance - truth).abs() < 3.0 * band.deviation,
            "{} ± {}",
            band.distance,
            band.deviation
        );
        let [left, right] = band.contact.expect("it stands on the water");
        // The camera's own projection of the plane's foot.
        let ray = lake.camera.ray(left);
        let depth = -ray.at(-ray.origin.y / ray.direction.y).z;
        assert!((depth / band.distance - 1.0).abs() < 0.01 || band.deviation > 1.0, "foot at {depth} m");
        assert!(left.x() < right.x());
    }
    assert!(standing[1].is_real(), "the step is {:?} deviations", standing[1].step);
    for pixel in 0..land.values().len() {
        let sum: u32 = found.iter().map(|band| u32::from(band.mask.values()[pixel])).sum();
        let land = u32::from(land.values()[pixel]);
        assert!(land == 0 || sum.abs_diff(land) <= 4, "masks sum to {sum} at {pixel}");
    }
}

#[test]
fn one_wall_makes_one_band_at_its_distance() {
    let lake = Lake { walls: vec![frontal(90.0, 60.0, 0.0, GRAY)], ..hills(-2.0, 0.0) };
    let (found, _) = bands_of(&lake, BandOptions::default());
    assert_eq!(found.len(), 1, "{:?}", found.iter().map(|band| band.distance).collect::<Vec<_>>());
    assert!((found[0].distance / 90.0 - 1.0).abs() < 0.03, "{} m", found[0].distance);
    assert!(found[0].measured > 0.5, "{}", found[0].measured);
}

#[test]
fn a_receding_wall_is_one_band_along_its_line() {
    let lake = receding();
    let (found, _) = bands_of(&lake, BandOptions::default());
    let standing: Vec<&DepthBand> = found.iter().filter(|band| band.distance.is_finite()).collect();
    let [mountains, wall] = standing.as_slice() else { panic!("{} bands", standing.len()) };
    assert!(wall.recedes && !mountains.recedes);
    let [far, near] = lake.walls[0].ends;
    let normal = (near - far).perp().normalize();
    for point in wall.contact.expect("it stands on the water") {
        let ray = lake.camera.ray(point);
        let foot = ray.at(-ray.origin.y / ray.direction.y);
        let off = normal.dot(DVec2::new(foot.x, foot.z) - far).abs();
        assert!(off < 0.03 * -foot.z, "its foot at {foot} is {off} m off the wall");
    }
}

#[test]
fn there_are_never_more_bands_than_asked_for() {
    let walls = (0..6).map(|i| frontal(20.0 * 1.5_f64.powi(i), 3.0 * 1.7_f64.powi(i), 1.0, GREEN)).collect();
    let lake = Lake { walls, ..hills(-2.0, 0.0) };
    for most in [1, 3, 100] {
        let (found, _) = bands_of(&lake, BandOptions { most, ..BandOptions::default() });
        let standing = found.iter().filter(|band| band.distance.is_finite()).count();
        assert!((1..=most.min(8)).contains(&standing), "{standing} of {most}");
    }
}

#[test]
fn without_a_mirror_image_there_are_no_bands() {
    let lake = Lake { mirror: false, ..hills(-2.0, 0.0) };
    assert!(bands_of(&lake, BandOptions::default()).0.is_empty());
}
