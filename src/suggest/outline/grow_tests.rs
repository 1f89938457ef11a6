//! Facts about regions grown from strokes.

use glam::UVec2;

use super::*;
use crate::picture::PicturePoint;

const SIZE: UVec2 = UVec2::new(240, 180);

/// A sky that brightens downwards, a rough ridge below row 100, and a second sky-colored field enclosed by it.
fn picture() -> Picture {
    let pixels = (0..SIZE.x * SIZE.y).map(|i| {
        let (x, y) = (i % SIZE.x, i / SIZE.x);
        let noise = (i.wrapping_mul(2_654_435_761) >> 24) as i32;
        let sky = y < 100 || (x > 150 && x < 200 && y > 130 && y < 160);
        let color = if sky {
            [100 + y as i32 / 2, 140 + y as i32 / 3, 200]
        } else {
            [70, 90, 60].map(|c| c + noise % 64 - 32)
        };
        color.map(|code| (code + if sky { noise % 5 - 2 } else { 0 }) as u8)
    });
    Picture::new(SIZE, pixels.collect()).unwrap()
}

fn is_sky(i: usize) -> bool {
    i / 240 < 100
}

#[test]
fn a_click_on_the_sky_takes_all_of_it_and_no_more() {
    let click = Stroke::inside(vec![PicturePoint::new(60.0, 20.0)], 6.0);
    let found = grow(&picture(), &click, GrowOptions::default()).unwrap();
    let hit = |want: bool| {
        found.values().iter().enumerate().filter(|(i, v)| is_sky(*i) == want && **v > 127).count()
    };
    assert!(hit(true) as f64 > 0.97 * 24_000.0, "{} of 24000", hit(true));
    // Half a texture window along the border at most.
    assert!(hit(false) < 2 * 240, "{} beyond", hit(false));
}

#[test]
fn more_tolerance_never_takes_less() {
    let click = Stroke::inside(vec![PicturePoint::new(60.0, 150.0)], 5.0);
    let area = |tolerance| {
        let found = grow(&picture(), &click, GrowOptions { tolerance, bound: None }).unwrap();
        found.values().iter().filter(|value| **value > 127).count()
    };
    let areas = [0.3, 0.6, 1.0, 2.0, f64::NAN].map(area);
    assert!(areas[0] <= areas[1] && areas[1] <= areas[2] && areas[2] <= areas[3], "{areas:?}");
    assert_eq!(areas[4], areas[2], "NaN is the usual tolerance");
}

#[test]
fn no_pixel_under_the_stroke_is_told() {
    for points in [vec![], vec![PicturePoint::new(f64::NAN, 1.0)], vec![PicturePoint::new(-50.0, -50.0)]] {
        let found = grow(&picture(), &Stroke::inside(points, 4.0), GrowOptions::default());
        assert_eq!(found, Err(OutlineError::NothingMarked));
    }
}

#[test]
fn a_bound_is_not_crossed_whichever_end_comes_first() {
    let click = Stroke::inside(vec![PicturePoint::new(60.0, 20.0)], 6.0);
    let line = [PicturePoint::new(0.0, 50.0), PicturePoint::new(240.0, 50.0)];
    for line in [line, [line[1], line[0]]] {
        let bound = Some(Bound { line, is_above: true });
        let found = grow(&picture(), &click, GrowOptions { bound, ..Default::default() }).unwrap();
        let rows = found.values().chunks(240).map(|row| row.iter().filter(|value| **value > 127).count());
        let rows: Vec<_> = rows.collect();
        assert!(rows[..48].iter().all(|count| *count > 230), "{rows:?}");
        assert!(rows[52..].iter().all(|count| *count == 0), "{rows:?}");
        let bound = Some(Bound { line, is_above: false });
        let refused = grow(&picture(), &click, GrowOptions { bound, ..Default::default() });
        assert_eq!(refused, Err(OutlineError::BeyondBound));
    }
}

#[test]
fn a_stroke_across_two_matters_takes_both_and_no_third() {
    // Three columns, each plain; the stroke crosses the border of the first two.
    let color = |x: u32| [[40_u8, 60, 110], [150, 60, 50], [80, 140, 60]][(x / 80).min(2) as usize];
    let pixels = (0..240 * 100).map(|i| color(i % 240));
    let picture = Picture::new(UVec2::new(240, 100), pixels.collect()).unwrap();
    let points = [30.0, 130.0].map(|x| PicturePoint::new(x, 50.0)).to_vec();
    let mask = grow(&picture, &Stroke::inside(points, 5.0), GrowOptions::default()).unwrap();
    let columns = |range: std::ops::Range<u32>| {
        let cells = range.flat_map(|x| (0..100).map(move |y| (x, y)));
        cells.filter(|&(x, y)| mask.get(x, y) > 127).count()
    };
    // The edge between them is as rough as the third.
    assert!(columns(0..160) > 95 * 160, "{} of 16000", columns(0..160));
    assert!(columns(163..240) < 80, "{} beyond", columns(163..240));
}
