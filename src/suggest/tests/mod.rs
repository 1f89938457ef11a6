//! What is proposed for made pictures whose answers are known.

pub(super) mod made;

use glam::{DVec2, UVec2};

use made::{FOCAL, PITCH, SIZE, error, hit, lake, land, noise, picture, pond};

use super::*;
use crate::assemble::{TourSource, place};
use crate::picture::{Picture, PicturePoint, PngPixels, encode_png};
use crate::tour::{ReflectionPair, Region, RelativePath, Tour};

#[test]
fn the_axis_of_a_still_or_rippled_lake_is_found_within_a_pixel() {
    for (seed, axis, ripple) in [(1, 180.3, 0.0), (2, 201.75, 5.0), (3, 190.5, 10.0), (4, 170.2, 10.0)] {
        let found = find_reflection(&lake(axis, ripple, seed)).unwrap();
        let off = found.axis.y_at(240.0) - axis;
        assert!(off.abs() < 1.0, "ripple {ripple}: off by {off:.2} px");
        assert!(found.axis.slope().abs() < 0.005, "ripple {ripple}: slope {:.4}", found.axis.slope());
        assert!(found.axis.confidence > 0.6, "ripple {ripple}: confidence {:.2}", found.axis.confidence);
    }
}

#[test]
fn upside_down_the_axis_is_where_it_was() {
    let upright = lake(180.25, 0.0, 7);
    // Flipped, the dim side is above: the waterline is no place but a symmetry.
    let flipped: Vec<[u8; 3]> = upright.rows().rev().flatten().copied().collect();
    let flipped = Picture::new(SIZE, flipped).unwrap();
    let (a, b) = (find_reflection(&upright).unwrap().axis, find_reflection(&flipped).unwrap().axis);
    let sum = a.y_at(240.0) + b.y_at(240.0);
    assert!((sum - f64::from(SIZE.y)).abs() < 0.3, "{sum}");
}

#[test]
fn a_rolled_camera_is_leveled() {
    let (axis, roll) = (183.0, 3.0_f64.to_radians());
    let middle = SIZE.as_dvec2() / 2.0;
    let rolled = picture(SIZE, |at| {
        let level = middle + DVec2::from_angle(-roll).rotate(at - middle);
        if level.y < axis {
            land(level, 11)
        } else {
            0.6 * land(DVec2::new(level.x, 2.0 * axis - level.y), 11) + 40.0
        }
    });
    let found = find_reflection(&rolled).unwrap().axis;
    let off = found.slope() - roll.tan();
    assert!(off.abs() < 0.002, "slope {:.4}", found.slope());
    for x in [0.0, 240.0, 480.0] {
        let truth = middle.y + (axis - middle.y) / roll.cos() + (x - middle.x) * roll.tan();
        assert!((found.y_at(x) - truth).abs() < 1.0, "{} is not {truth} at {x}", found.y_at(x));
    }
}

fn refused(picture: &Picture) {
    let none = find_reflection(picture).unwrap_err();
    assert!(none.to_string().starts_with("no reflection here"), "{none}");
    let made = draft(picture, None, "land.png".into(), &folder(), &|_, _| true).unwrap();
    assert!(made.file.water.is_none() && made.advice.is_none());
    let about = |part| made.trust.iter().find(|remark| remark.part == part).unwrap();
    assert_eq!(about(Part::Axis).confidence, 0.0);
    assert!(about(Part::Horizon).confidence < 0.1);
    flyable(&made, picture, "land.png");
}

#[test]
fn gradients_have_no_reflection() {
    refused(&picture(SIZE, |at| 60.0 + 0.4 * at.y + 0.1 * at.x));
    // A sky that mirrors perfectly, but in which nothing can be seen.
    refused(&picture(SIZE, |at| 220.0 - 0.5 * (at.y - 180.0).abs()));
}

#[test]
fn a_landscape_without_water_has_no_reflection() {
    for seed in [21, 22, 23] {
        refused(&picture(SIZE, |at| land(at, seed)));
    }
}

#[test]
fn a_facade_that_mirrors_in_itself_has_no_reflection() {
    refused(&picture(SIZE, |at| {
        let window = DVec2::new(at.x.rem_euclid(37.0) - 18.5, at.y.rem_euclid(53.0) - 26.5).abs();
        let wall = 150.0 + 12.0 * noise(at, 9.0, 31);
        if window.x < 9.0 && window.y < 15.0 { 60.0 + 20.0 * noise(at, 17.0, 32) } else { wall }
    }));
}

#[test]
fn pairs_lie_within_a_pixel_and_none_is_refused_by_the_solver() {
    let picture = pond();
    let found = find_reflection(&picture).unwrap();
    let suggested = suggest_pairs(&found, SIZE, None);
    assert!((8..=MOST_PAIRS).contains(&suggested.pairs.len()), "{} pairs", suggested.pairs.len());
    let solution = suggested.solution.unwrap();
    assert!(solution.report.pairs.iter().all(|pair| pair.kept));
    let lean = solution.parameters.pitch.tan() / solution.parameters.focal_px - PITCH.tan() / FOCAL;
    assert!((lean * FOCAL * FOCAL).abs() < 4.0, "the horizon is off by {} px", lean * FOCAL * FOCAL);
    let mut errors: Vec<f64> = suggested.pairs.iter().map(|pair| error(&pair.pair)).collect();
    errors.sort_by(f64::total_cmp);
    assert!(errors[errors.len() / 2] < 0.6, "median {:.2} px of {errors:.1?}", errors[errors.len() / 2]);
    assert!(errors[errors.len() * 9 / 10] < 2.0, "{errors:.1?}");
}

#[test]
fn the_true_horizon_lies_within_two_deviations() {
    let found = find_reflection(&pond()).unwrap();
    let pairs = suggest_pairs(&found, SIZE, None);
    let horizon = suggest_horizon(&found, &pairs, SIZE);
    let truth = 180.0 + FOCAL * PITCH.tan();
    let off = (horizon.ends[0].y() + horizon.ends[1].y()) / 2.0 - truth;
    assert!(off.abs() < 2.0 * horizon.deviation_px, "off by {off:.1} ± {:.1} px", horizon.deviation_px);
    assert!(horizon.deviation_px < 20.0);
}

#[test]
fn water_is_outlined_and_walls_are_not() {
    let picture = pond();
    let found = find_reflection(&picture).unwrap();
    let horizon = 180.0 + FOCAL * PITCH.tan();
    let ends = [0.0, 480.0].map(|x| PicturePoint::new(x, horizon));
    let regions = suggest_regions(&picture, Some(&found), ends);
    let water = regions.water.unwrap().mask;
    let (mut both, mut either) = (0.0, 0.0);
    for y in 0..SIZE.y {
        for x in 0..SIZE.x {
            let wet = hit(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)).2;
            let share = f64::from(water.coverage(x, y));
            both += if wet { share } else { 0.0 };
            either += if wet { 1.0 } else { share };
        }
    }
    assert!(both / either > 0.9, "intersection over union {:.2}", both / either);
}

/// A draft that passes every check, also with its files, and places a camera below whose horizon the world lies.
fn flyable(made: &Draft, picture: &Picture, name: &str) {
    let tour = Tour::check(made.file.clone()).unwrap();
    let source = TourSource::read(&tour, &|file| {
        let png = |size, pixels: PngPixels<'_>| encode_png(size, pixels).map_err(|error| error.to_string());
        if file.as_str() == name {
            return png(picture.size(), PngPixels::Rgb(picture.pixels()));
        }
        let (_, mask) = made.masks.iter().find(|(path, _)| path == file).ok_or("no such mask")?;
        png(mask.size(), PngPixels::Gray(mask.values()))
    })
    .unwrap();
    let placed = place(&source).unwrap();
    assert!(placed.scene.components.len() >= 2);
    let parameters = placed.solution.parameters;
    assert!(parameters.height > 0.0 && parameters.background_distance.is_finite());
    assert!(placed.solution.report.pairs.iter().all(|pair| pair.kept));
}

#[test]
fn a_draft_can_be_flown_through() {
    let picture = pond();
    let made = draft(&picture, None, "pictures/pond.png".into(), &folder(), &|_, _| true).unwrap();
    let water = made.file.water.as_ref().unwrap();
    assert!(water.pairs.len() >= 8);
    assert_eq!(water.region, Region::Mask("pond.masks/water.png".into()));
    flyable(&made, &picture, "pictures/pond.png");
    assert!(made.trust.iter().all(|remark| (0.0..=1.0).contains(&remark.confidence)));
    let again = draft(&picture, None, "pictures/pond.png".into(), &folder(), &|_, _| true).unwrap();
    assert!(again.file == made.file && again.masks == made.masks, "two runs differ");
}

#[test]
fn a_rippled_lake_without_pairs_can_be_flown_over() {
    let picture = lake(190.5, 10.0, 3);
    let made = draft(&picture, None, "lake.png".into(), &folder(), &|_, _| true).unwrap();
    assert!(made.file.water.is_some());
    flyable(&made, &picture, "lake.png");
}

#[test]
fn drafts_can_be_cancelled_and_bad_input_is_named() {
    let pond = pond();
    let stopped = draft(&pond, None, "pond.png".into(), &folder(), &|share, _| share < 0.5);
    assert!(matches!(stopped, Err(DraftError::Cancelled)));
    let outside = draft(&pond, None, "../pond.png".into(), &folder(), &|_, _| true);
    assert!(matches!(outside, Err(DraftError::Unsound(_))));
    let tiny = Picture::new(UVec2::new(31, 400), vec![[9; 3]; 31 * 400]).unwrap();
    let error = draft(&tiny, None, "tiny.png".into(), &folder(), &|_, _| true).unwrap_err();
    assert_eq!(error.to_string(), "the picture has 31 x 400 pixels; use one of at least 32 on each side");
    // The least and odd shapes do not fall over.
    for size in [UVec2::splat(LEAST_SIDE), UVec2::new(LEAST_SIDE, 2000), UVec2::new(2000, LEAST_SIDE)] {
        let strip = picture(size, |at| 128.0 + 60.0 * noise(at, 7.0, 51));
        draft(&strip, None, "strip.png".into(), &folder(), &|_, _| true).unwrap();
    }
}

#[test]
fn advice_points_to_where_pairs_are_missing() {
    let pair = |x: f64, length: f64| ReflectionPair {
        point: PicturePoint::new(x, 500.0 - length / 2.0),
        reflection: PicturePoint::new(x, 500.0 + length / 2.0),
        on: None,
        name: None,
    };
    let size = UVec2::new(1200, 1000);
    let left = [pair(50.0, 600.0), pair(120.0, 700.0)];
    let advice = advise(&left, 500.0, size).unwrap();
    assert!(advice.region[0].x() >= 1000.0 && advice.gain > 3.0, "{advice:?}");
    assert!(advice.region[0].y() < 130.0, "long pairs tell more: {advice:?}");
    // Many on both sides leave little to gain.
    let many: Vec<_> =
        (0..12).flat_map(|i| [pair(20.0 + i as f64, 950.0), pair(1180.0 - i as f64, 950.0)]).collect();
    assert_eq!(advise(&many, 500.0, size), None);
    assert_eq!(advise(&[], f64::NAN, size), None);
    assert!(advise(&[], 500.0, size).unwrap().gain.is_infinite());
}

fn folder() -> RelativePath {
    RelativePath::new("pond.masks").unwrap()
}
