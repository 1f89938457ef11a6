//! Masks against areas and values known by hand.

use super::*;

fn polygon(size: UVec2, corners: &[(f64, f64)]) -> Mask {
    let corners: Vec<_> = corners.iter().map(|(x, y)| PicturePoint::new(*x, *y)).collect();
    Mask::from_polygon(size, &corners).unwrap()
}

/// Covered area, in pixels.
fn area(mask: &Mask) -> f64 {
    mask.values().iter().map(|value| f64::from(*value) / 255.0).sum()
}

fn assert_area(mask: &Mask, expected: f64) {
    let found = area(mask);
    assert!((found - expected).abs() <= 0.002 * expected, "{found} px instead of {expected} px");
}

/// 255 where `covered` says so.
fn mask_of(width: u32, height: u32, covered: impl Fn(u32, u32) -> bool) -> Mask {
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Mask::new(UVec2::new(width, height), pixels.map(|(x, y)| if covered(x, y) { 255 } else { 0 }).collect())
        .unwrap()
}

#[test]
fn a_triangle_covers_its_area() {
    let triangle = polygon(UVec2::new(100, 80), &[(10.3, 5.7), (90.1, 30.2), (25.6, 71.9)]);
    // Half the cross product of two sides.
    assert_area(&triangle, 0.5 * (79.8 * 66.2 - 24.5 * 15.3));
}

#[test]
fn a_box_on_quarter_pixels_is_exact() {
    let square = polygon(UVec2::new(4, 3), &[(0.5, 0.25), (2.75, 0.25), (2.75, 2.0), (0.5, 2.0)]);
    let row = |y| [0, 1, 2, 3].map(|x| square.get(x, y));
    // 255 times 0.75 · 0.5, 0.75 and 0.75 · 0.75.
    assert_eq!(row(0), [96, 191, 143, 0]);
    assert_eq!(row(1), [128, 255, 191, 0]);
    assert_eq!(row(2), [0; 4]);
}

#[test]
fn corners_may_lie_far_outside() {
    let half_plane = polygon(UVec2::new(20, 10), &[(-1e6, 4.5), (1e6, 4.5), (1e6, 1e6), (-1e6, 1e6)]);
    assert_area(&half_plane, 20.0 * 5.5);
    let beside = polygon(UVec2::new(20, 10), &[(30.0, 0.0), (40.0, 0.0), (40.0, 10.0)]);
    assert_eq!(beside.bounds(), None);
}

#[test]
fn what_a_polygon_covers_twice_is_outside() {
    // A pentagram through the corners of a pentagon: the pentagon in its middle is covered twice.
    let corner = |i: f64| {
        (
            50.0 + 40.0 * (i * 1.6 * std::f64::consts::PI).sin(),
            50.0 - 40.0 * (i * 1.6 * std::f64::consts::PI).cos(),
        )
    };
    let star = polygon(UVec2::splat(100), &[0.0, 1.0, 2.0, 3.0, 4.0].map(|i| corner(i / 2.0)));
    assert_eq!(star.get(50, 50), 0);
    assert!(star.get(50, 20) > 0);
}

#[test]
fn two_corners_or_a_nan_are_no_polygon() {
    assert_eq!(area(&polygon(UVec2::splat(9), &[(0.0, 0.0), (9.0, 9.0)])), 0.0);
    assert_eq!(area(&polygon(UVec2::splat(9), &[(0.0, 0.0), (9.0, 9.0), (f64::NAN, 3.0)])), 0.0);
    assert!(Mask::from_polygon(UVec2::new(0, 4), &[]).is_err());
}

#[test]
fn samples_are_linear_between_centers_and_zero_outside() {
    let mask = Mask::new(UVec2::new(2, 2), vec![0, 255, 0, 51]).unwrap();
    let at = |x, y| mask.sample(PicturePoint::new(x, y));
    let assert_near = |found: f32, expected: f32| {
        assert!((found - expected).abs() < 1e-6, "{found} for {expected}");
    };
    assert_near(at(1.5, 0.5), 1.0);
    assert_near(at(1.0, 0.5), 0.5);
    assert_near(at(1.5, 1.0), 0.6);
    assert_near(at(2.0, 0.0), 1.0);
    assert_eq!([at(2.01, 0.5), at(1.5, -0.01), at(f64::NAN, 0.5)], [0.0; 3]);
}

#[test]
fn bounds_hold_all_coverage() {
    let mask = mask_of(9, 7, |x, y| (x, y) == (2, 5) || (x, y) == (6, 1));
    assert_eq!(mask.bounds(), Some(PixelRect { min: UVec2::new(2, 1), max: UVec2::new(7, 6) }));
    assert_eq!(mask_of(9, 7, |_, _| false).bounds(), None);
}

#[test]
fn resizing_keeps_the_covered_share() {
    let disc = mask_of(60, 40, |x, y| x.abs_diff(30).pow(2) + y.abs_diff(20).pow(2) < 225);
    for size in [UVec2::new(30, 20), UVec2::new(120, 80)] {
        let share = area(&disc.clone().resized_to(size)) / (f64::from(size.x) * f64::from(size.y));
        let expected = area(&disc) / 2400.0;
        assert!((share - expected).abs() < 0.01 * expected, "{share} instead of {expected} at {size}");
    }
}

#[test]
fn a_block_is_read_and_written_where_it_lies() {
    let mut mask = Mask::new(UVec2::new(4, 3), (0..12).collect()).unwrap();
    let block = PixelRect { min: UVec2::new(1, 1), max: UVec2::new(3, 3) };
    assert_eq!(mask.block(block), Some(vec![5, 6, 9, 10]));
    assert!(mask.set_block(block, &[50, 60, 90, 100]));
    assert_eq!(mask.values(), [0, 1, 2, 3, 4, 50, 60, 7, 8, 90, 100, 11]);

    let before = mask.clone();
    let beyond = PixelRect { min: UVec2::new(3, 1), max: UVec2::new(5, 2) };
    let empty = PixelRect { min: UVec2::new(2, 1), max: UVec2::new(2, 2) };
    let inside_out = PixelRect { min: UVec2::new(3, 2), max: UVec2::new(1, 1) };
    for (block, values) in [(beyond, &[1; 2][..]), (empty, &[]), (inside_out, &[1; 2]), (block, &[1; 3])] {
        assert!(!mask.set_block(block, values), "{block:?} took {} values", values.len());
    }
    assert_eq!([beyond, empty, inside_out].map(|block| mask.block(block)), [None, None, None]);
    assert!(mask == before);
}
