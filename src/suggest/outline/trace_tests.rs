//! Facts about outlines traced around masks.

use glam::UVec2;

use super::*;

const SIZE: UVec2 = UVec2::new(160, 120);

fn polygon(points: &[(f64, f64)]) -> Vec<PicturePoint> {
    points.iter().map(|(x, y)| PicturePoint::new(*x, *y)).collect()
}

fn star() -> Vec<PicturePoint> {
    let corner = |k: i32| {
        let radius = if k % 2 == 0 { 48.0 } else { 25.0 };
        PicturePoint(DVec2::new(80.3, 60.6) + DVec2::from_angle(f64::from(k) * 0.628_318_53 + 0.1) * radius)
    };
    (0..10).map(corner).collect()
}

/// The farthest that a point of `a`'s sides lies off the sides of `b`, pixels.
fn off(a: &[PicturePoint], b: &[PicturePoint]) -> f64 {
    let sides = |p: &[PicturePoint]| -> Vec<(DVec2, DVec2)> {
        p.iter().zip(p.iter().cycle().skip(1)).map(|(a, b)| (a.0, b.0)).collect()
    };
    let points =
        sides(a).into_iter().flat_map(|(from, to)| (0..20).map(move |k| from.lerp(to, f64::from(k) / 20.0)));
    let to = sides(b);
    points
        .map(|p| to.iter().map(|(a, b)| distance_to_segment(p, *a, *b)).fold(f64::MAX, f64::min))
        .fold(0.0, f64::max)
}

fn hausdorff(a: &[PicturePoint], b: &[PicturePoint]) -> f64 {
    off(a, b).max(off(b, a))
}

#[test]
fn a_polygon_comes_back() {
    let star = star();
    let mask = Mask::from_polygon(SIZE, &star).unwrap();
    let whole = polygon_of(&mask, 0.0).unwrap();
    // Marching squares round off corners: of these (about 40° and wider) by at most a pixel.
    assert!(hausdorff(&whole, &star) < 1.1, "{} px", hausdorff(&whole, &star));
    assert!((signed_area(&whole) / signed_area(&star) - 1.0).abs() < 0.002);
    for tolerance in [0.5, 1.0, 2.0] {
        let thin = polygon_of(&mask, tolerance).unwrap();
        let gap = hausdorff(&thin, &whole);
        assert!(gap <= tolerance + 1e-9, "{gap} px at {tolerance}");
        assert!((signed_area(&thin) / signed_area(&star) - 1.0).abs() < 0.02 * tolerance);
        assert!(thin.len() < 40, "{} corners at {tolerance}", thin.len());
        let again = Mask::from_polygon(SIZE, &thin).unwrap();
        let apart: f64 =
            again.values().iter().zip(mask.values()).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
        assert!(apart / 255.0 < 0.06 * signed_area(&star), "{} px² at {tolerance}", apart / 255.0);
    }
}

#[test]
fn a_level_box_is_exact_and_the_frame_closes_what_touches_it() {
    let inner = polygon(&[(20.0, 30.0), (90.0, 30.0), (90.0, 70.0), (20.0, 70.0)]);
    let found = outlines_of(&Mask::from_polygon(SIZE, &inner).unwrap(), 0.0);
    assert_eq!(found.len(), 1);
    assert!(
        (found[0].area - 2800.0).abs() < 1.0,
        "corners are cut by an eighth of a pixel each: {}",
        found[0].area
    );
    let full = Mask::new(SIZE, vec![255; 19_200]).unwrap();
    let frame = polygon(&[(0.0, 0.0), (160.0, 0.0), (160.0, 120.0), (0.0, 120.0)]);
    let whole = polygon_of(&full, 0.4).unwrap();
    assert!(hausdorff(&whole, &frame) < 0.8, "{whole:?}");
}

#[test]
fn holes_and_parts_are_told_apart() {
    let values = (0..19_200).map(|i| {
        let p = DVec2::new(f64::from(i % 160) + 0.5, f64::from(i / 160) + 0.5);
        let ring = (p.distance(DVec2::new(60.0, 60.0)) - 30.0).abs() < 10.0;
        let dot = p.distance(DVec2::new(130.0, 60.0)) < 12.5;
        if ring || dot { 255 } else { 0 }
    });
    let mask = Mask::new(SIZE, values.collect()).unwrap();
    let found = outlines_of(&mask, 0.5);
    let kinds: Vec<_> =
        found.iter().map(|outline| (outline.is_hole, (outline.area / 100.0).round())).collect();
    // π·40², π·20², π·12.5².
    assert_eq!(kinds, [(false, 50.0), (true, 13.0), (false, 5.0)]);
    assert_eq!(polygon_of(&mask, 0.5).unwrap(), found[0].corners);
}

#[test]
fn corners_that_touch_make_no_crossing() {
    // A checkerboard of soft squares has nothing but saddles.
    let values = (0..19_200).map(|i| if (i % 160 / 3 + i / 160 / 3) % 2 == 0 { 220 } else { 35 });
    let mask = Mask::new(SIZE, values.collect()).unwrap();
    for outline in outlines_of(&mask, 0.7) {
        assert_eq!(geometry::crossing(&outline.corners), None);
    }
}

#[test]
fn thinning_never_makes_a_polygon_cross_itself() {
    // A comb whose teeth are as narrow as the tolerance.
    let mut corners = vec![(0.0, 0.0)];
    for tooth in 0..30 {
        let x = f64::from(tooth) * 2.0;
        corners.extend([(x, 30.0 + (x * 7.0) % 5.0), (x + 1.0, 2.0 + (x * 3.0) % 2.5)]);
    }
    corners.extend([(60.0, 1.0), (61.0, 0.4), (30.0, 1.9), (10.0, 0.1)]);
    let comb = polygon(&corners);
    for tolerance in [0.5, 1.5, 3.0, 10.0, 100.0] {
        let thin = simplified(&comb, tolerance);
        let was = geometry::crossing(&comb).is_some();
        assert!(was || geometry::crossing(&thin).is_none(), "at {tolerance}");
    }
}

#[test]
fn a_thinned_line_keeps_its_ends_and_its_order() {
    let straight: Vec<_> = (0..=100).map(|x| PicturePoint::pixel_center(x, 40)).collect();
    assert_eq!(simplified_line(&straight, 1.0), [straight[0], straight[100]]);
    // Pixel by pixel along an S whose start is farthest from its middle, then its end, then a loop over its own chord.
    let way = |f: &dyn Fn(f64) -> DVec2| -> Vec<PicturePoint> {
        (0..=400).map(|k| PicturePoint(f(f64::from(k) / 400.0).round() + 0.5)).collect()
    };
    let sine = way(&|t| DVec2::new(150.0 * t * t, 60.0 + 40.0 * (6.3 * t).sin()));
    let back = sine.iter().rev().copied().collect();
    let loops = way(&|t| DVec2::new(120.0 * t - 60.0 * (9.5 * t).sin(), 60.0 + 50.0 * (6.3 * t).cos()));
    for line in [sine, back, loops] {
        for tolerance in [1.0, 3.0] {
            let thin = simplified_line(&line, tolerance);
            assert_eq!((thin.first(), thin.last()), (line.first(), line.last()));
            assert!(thin.len() < 60, "{} of {} points at {tolerance}", thin.len(), line.len());
            let mut rest = line.iter();
            assert!(thin.iter().all(|point| rest.any(|other| other == point)), "in another order");
            let near = |p: DVec2| {
                let sides = thin.windows(2).map(|ends| distance_to_segment(p, ends[0].0, ends[1].0));
                sides.fold(f64::MAX, f64::min)
            };
            let gap = line.iter().map(|point| near(point.0)).fold(0.0, f64::max);
            assert!(gap <= tolerance + 1e-9, "{gap} px at {tolerance}");
        }
    }
    assert_eq!(simplified_line(&straight, f64::NAN), straight);
    assert_eq!(simplified_line(&straight[..1], 1.0), straight[..1]);
}

#[test]
fn nothing_has_no_outline_and_bad_numbers_change_nothing() {
    assert_eq!(polygon_of(&Mask::new(SIZE, vec![0; 19_200]).unwrap(), 1.0), None);
    let star = star();
    assert_eq!(simplified(&star, f64::NAN), star);
    assert_eq!(simplified(&star, -1.0), star);
    assert_eq!(simplified(&star[..2], 1.0), star[..2]);
}
