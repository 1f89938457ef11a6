//! Facts about depth from mirror images, on lakes with known distances.

mod bands;
mod hints;
pub(crate) mod world;

use glam::{DVec2, UVec2};

use self::world::{Lake, Shot, Wall, camera, frontal};
use super::{DepthError, DepthMap, DepthOptions, measure, paint};
use crate::camera::{CameraPose, PinholeCamera};
use crate::picture::{Mask, Picture};

const GREEN: [f64; 3] = [90.0, 110.0, 70.0];
const GRAY: [f64; 3] = [130.0, 135.0, 145.0];

/// A shore at 60 m and mountains at 150 m, 2 m above still water.
fn hills(pitch: f64, roll: f64) -> Lake {
    Lake {
        camera: camera(2.0, pitch, roll),
        walls: vec![frontal(60.0, 5.0, 4.0, GREEN), frontal(150.0, 20.0, 10.0, GRAY)],
        slope: 0.0,
        clouds: true,
        mirror: true,
    }
}

fn map_of(shot: &Shot, camera: &PinholeCamera) -> DepthMap {
    measure(&shot.picture, &shot.water, camera, camera.pose.position.y, &DepthOptions::default(), &|_| true)
        .expect("a sound camera")
}

/// How good a map is, over what is at a distance.
#[derive(Debug)]
struct Quality {
    /// Part that is known.
    known: f64,
    /// Median of the relative errors.
    median: f64,
    /// Part of the known within 10 %.
    within_tenth: f64,
    /// Part of the known within one and within three of the deviations that are claimed.
    within_one: f64,
    within_three: f64,
}

fn quality(shot: &Shot, map: &DepthMap) -> Quality {
    let solid: Vec<usize> = (0..shot.distance.len()).filter(|&i| shot.distance[i].is_finite()).collect();
    let known: Vec<usize> = solid.iter().copied().filter(|&i| map.is_known(i)).collect();
    let off = |i: usize| (f64::from(map.distance[i]) - shot.distance[i]).abs();
    let mut errors: Vec<f64> = known.iter().map(|&i| off(i) / shot.distance[i]).collect();
    errors.sort_by(f64::total_cmp);
    let share = |is: &dyn Fn(usize) -> bool| {
        known.iter().filter(|&&i| is(i)).count() as f64 / known.len().max(1) as f64
    };
    let within = |k: f64| share(&|i| off(i) <= k * f64::from(map.deviation[i]));
    Quality {
        known: known.len() as f64 / solid.len().max(1) as f64,
        median: errors.get(errors.len() / 2).copied().unwrap_or(f64::NAN),
        within_tenth: share(&|i| off(i) <= 0.1 * shot.distance[i]),
        within_one: within(1.0),
        within_three: within(3.0),
    }
}

#[test]
fn still_water_tells_distances() {
    for (pitch, roll) in [(0.0, 0.0), (-6.0, 3.0)] {
        let lake = hills(pitch, roll);
        let shot = lake.shot();
        let quality = quality(&shot, &map_of(&shot, &lake.camera));
        assert!(quality.known > 0.7, "pitch {pitch}°, roll {roll}°: {quality:?}");
        assert!(
            quality.median < 0.01 && quality.within_tenth > 0.93,
            "pitch {pitch}°, roll {roll}°: {quality:?}"
        );
        assert!(quality.within_one > 0.6, "pitch {pitch}°, roll {roll}°: {quality:?}");
    }
}

#[test]
fn what_the_water_hides_behind_a_shore_is_not_drawn_to_the_shore() {
    // Above the shore's outline stand mountains whose mirror image the shore's own hides.
    let lake = hills(-2.0, 0.0);
    let shot = lake.shot();
    let map = map_of(&shot, &lake.camera);
    let (width, height) = (map.size.x as usize, map.size.y as usize);
    let (mut known, mut drawn) = (0, 0);
    for x in 0..width {
        let far = |row: usize| shot.distance[row * width + x] > 100.0;
        let outline = (1..height).find(|&row| far(row - 1) && !far(row));
        // Their shifts differ by 28 − 11.2 pixels; the last rows may show some of both.
        let Some(outline) = outline.filter(|&row| row > 14) else { continue };
        for pixel in (outline - 14..outline - 1).map(|row| row * width + x) {
            let at = shot.distance[pixel];
            if at.is_finite() && map.is_known(pixel) {
                known += 1;
                drawn += usize::from(f64::from(map.distance[pixel]) < 0.75 * at);
            }
        }
    }
    assert!(known > 2000 && drawn * 20 < known, "{drawn} of {known} pixels were drawn to the shore");
}

/// A wall of houses that recedes to the left before mountains.
pub(crate) fn receding() -> Lake {
    let ends = [DVec2::new(-30.0, -120.0), DVec2::new(14.0, -18.0)];
    let wall = Wall { ends, height: 9.0, jagged: 2.0, grain: 2.0, color: [150.0, 120.0, 90.0] };
    Lake { walls: vec![wall, frontal(200.0, 40.0, 20.0, GRAY)], ..hills(-2.0, 0.0) }
}

#[test]
fn a_receding_wall_has_a_distance_of_its_own_in_every_column() {
    let lake = receding();
    let shot = lake.shot();
    let map = map_of(&shot, &lake.camera);
    let quality = quality(&shot, &map);
    assert!(quality.known > 0.7 && quality.within_tenth > 0.95 && quality.median < 0.01, "{quality:?}");
    let row = 118;
    let at = |x: usize| map.distance[row * 480 + x];
    assert!(at(250) > 1.3 * at(330) && at(330) > 1.3 * at(450), "{} {} {} m", at(250), at(330), at(450));
}

#[test]
fn hills_in_haze_are_known_by_their_faint_texture() {
    let mut lake = hills(-2.0, 0.0);
    lake.clouds = false;
    let mut shot = lake.shot();
    // Haze leaves a tenth of the contrast of land and water.
    let hazy = |c: [u8; 3]| c.map(|c| (160.0 + 0.1 * (f64::from(c) - 160.0)).round() as u8);
    let land = |i: usize| !shot.distance[i].is_infinite();
    let pixels = shot.picture.pixels().iter().enumerate();
    let pixels = pixels.map(|(i, &c)| if land(i) { hazy(c) } else { c }).collect();
    shot.picture = Picture::new(shot.picture.size(), pixels).unwrap();
    let quality = quality(&shot, &map_of(&shot, &lake.camera));
    assert!(quality.known > 0.7 && quality.within_tenth > 0.75, "{quality:?}");
}

#[test]
fn ripples_leave_less_but_hardly_anything_wrong() {
    for (slope, known, median) in [(0.003, 0.6, 0.03), (0.006, 0.3, 0.04)] {
        let lake = Lake { slope, ..hills(-2.0, 0.0) };
        let shot = lake.shot();
        let quality = quality(&shot, &map_of(&shot, &lake.camera));
        assert!(quality.known > known && quality.median < median, "slope {slope}: {quality:?}");
        assert!(quality.within_three > 0.85, "slope {slope}: {quality:?}");
    }
}

#[test]
fn pictures_without_a_mirror_image_say_so() {
    let rough = Lake { mirror: false, ..hills(-2.0, 0.0) };
    let other = Lake { mirror: false, walls: vec![frontal(30.0, 12.0, 6.0, GRAY)], ..hills(0.0, 0.0) };
    let empty = Lake { walls: Vec::new(), clouds: false, ..hills(-2.0, 0.0) };
    for (name, lake) in [("rough water", rough), ("another", other), ("sea and sky", empty)] {
        let shot = lake.shot();
        let map = map_of(&shot, &lake.camera);
        assert!(!map.has_mirror, "{name} has none");
        assert!(
            (0..map.distance.len()).all(|i| !map.is_known(i) && map.distance[i].is_nan()),
            "{name} is unknown"
        );
    }
    let camera = camera(2.0, 0.0, 0.0);
    let size = camera.intrinsics.size;
    let even = Shot {
        picture: Picture::new(size, vec![[120; 3]; 480 * 270]).unwrap(),
        water: Mask::new(size, (0..480 * 270).map(|i| if i < 480 * 150 { 0 } else { 255 }).collect())
            .unwrap(),
        distance: Vec::new(),
    };
    assert!(!map_of(&even, &camera).has_mirror, "an even picture has none");
}

#[test]
fn a_cloudy_sky_corrects_the_horizon_and_an_even_one_does_not() {
    let low = vec![frontal(60.0, 4.0, 1.0, GREEN)];
    for clouds in [true, false] {
        let lake = Lake { walls: low.clone(), clouds, ..hills(0.0, 0.0) };
        let shot = lake.shot();
        // The camera is said to look 2 px farther up than it does.
        let wrong = (2.0_f64 / 420.0).atan();
        let pose = CameraPose::from_angles(lake.camera.pose.position, 0.0, wrong, 0.0);
        let map = map_of(&shot, &PinholeCamera { pose, ..lake.camera });
        assert_eq!(map.horizon.measured, clouds);
        let off = map.horizon.offset_px + 2.0;
        if clouds {
            assert!(off.abs() < 0.5, "{:?}", map.horizon);
            let quality = quality(&shot, &map);
            assert!(quality.median < 0.03, "{quality:?}");
        } else {
            assert_eq!(map.horizon.offset_px, 0.0);
            let quality = quality(&shot, &map);
            assert!(quality.within_three > 0.9, "the error is within what is claimed: {quality:?}");
        }
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let lake = hills(-2.0, 1.0);
    let shot = lake.shot();
    let bits = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let map = pool.install(|| map_of(&shot, &lake.camera));
        let values = [map.distance, map.deviation, map.confidence];
        values.concat().into_iter().map(f32::to_bits).collect::<Vec<_>>()
    };
    assert!(bits(1) == bits(3), "one thread and three differ");
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let lake = hills(0.0, 0.0);
    let camera = lake.camera;
    let size = UVec2::new(480, 270);
    let picture = Picture::new(size, vec![[0; 3]; 480 * 270]).unwrap();
    let water = Mask::new(size, vec![255; 480 * 270]).unwrap();
    let try_with = |camera: &PinholeCamera, water: &Mask, height: f64, options: DepthOptions| {
        measure(&picture, water, camera, height, &options, &|_| true)
    };
    let usual = DepthOptions::default();
    let mut blind = camera;
    blind.intrinsics.focal_px = f64::NAN;
    assert_eq!(try_with(&blind, &water, 2.0, usual).unwrap_err(), DepthError::Camera);
    let down =
        PinholeCamera { pose: CameraPose::from_angles(camera.pose.position, 0.0, -1.57, 0.0), ..camera };
    assert_eq!(try_with(&down, &water, 2.0, usual).unwrap_err(), DepthError::Camera);
    assert!(matches!(try_with(&camera, &water, f64::NAN, usual), Err(DepthError::Height(_))));
    assert_eq!(try_with(&camera, &water, 0.0, usual).unwrap_err(), DepthError::Height(0.0));
    let unsure = DepthOptions { horizon_deviation_px: 0.0, ..usual };
    assert_eq!(try_with(&camera, &water, 2.0, unsure).unwrap_err(), DepthError::Horizon(0.0));
    let small = Mask::new(UVec2::ONE, vec![0]).unwrap();
    assert_eq!(try_with(&camera, &small, 2.0, usual).unwrap_err(), DepthError::Size);
    let cancelled = measure(&picture, &water, &camera, 2.0, &usual, &|share| share < 0.1);
    assert_eq!(cancelled.unwrap_err(), DepthError::Cancelled);
    assert!(!try_with(&camera, &water, 2.0, usual).unwrap().has_mirror, "nothing but water");
}

#[test]
fn odd_sizes_are_measured_too() {
    for size in [UVec2::new(1, 1), UVec2::new(3, 200), UVec2::new(97, 5)] {
        let mut camera = camera(2.0, -2.0, 0.0);
        camera.intrinsics.size = size;
        camera.intrinsics.principal.0 = 0.5 * size.as_dvec2();
        let count = (size.x * size.y) as usize;
        let picture = Picture::new(size, (0..count).map(|i| [(i * 37 % 251) as u8; 3]).collect()).unwrap();
        let water =
            Mask::new(size, (0..count).map(|i| if 2 * i > count { 255 } else { 0 }).collect()).unwrap();
        let map = measure(&picture, &water, &camera, 2.0, &DepthOptions::default(), &|_| true).unwrap();
        assert_eq!(map.distance.len(), count);
    }
}

#[test]
fn the_depth_picture_shows_near_red_far_blue_and_a_scale() {
    let lake = hills(-2.0, 0.0);
    let shot = lake.shot();
    let map = map_of(&shot, &lake.camera);
    let painted = paint(&shot.picture, &map);
    assert!(painted.size().y > shot.picture.size().y, "there is a legend");
    let mean = |is: &dyn Fn(f64) -> bool| {
        let pixels: Vec<[u8; 3]> = (0..map.distance.len())
            .filter(|&i| map.is_known(i) && is(shot.distance[i]))
            .map(|i| painted.pixels()[i])
            .collect();
        [0, 2].map(|c| pixels.iter().map(|p| f64::from(p[c])).sum::<f64>() / pixels.len() as f64)
    };
    let ([near_red, near_blue], [far_red, far_blue]) =
        (mean(&|z| z < 70.0), mean(&|z| z > 140.0 && z < 200.0));
    assert!(near_red > near_blue + 50.0, "near is red: {near_red} {near_blue}");
    assert!(far_blue > far_red + 50.0, "far is blue: {far_red} {far_blue}");
}
