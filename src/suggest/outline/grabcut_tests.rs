//! Facts about outlines found in boxes and by strokes.

use glam::{DVec2, UVec2};

use super::*;
use crate::picture::PicturePoint;
use crate::suggest::outline::Stroke;

/// A red-brown disc with an ochre stripe on a noisy blue-green ground, antialiased.
fn picture(size: UVec2) -> Picture {
    let (middle, radius) = (size.as_dvec2() / 2.0, disc_radius(size));
    let pixels = (0..size.x * size.y).map(|i| {
        let at = DVec2::new(f64::from(i % size.x) + 0.5, f64::from(i / size.x) + 0.5);
        let noise = f64::from(i.wrapping_mul(2_654_435_761) >> 27) - 16.0;
        let share = (radius - at.distance(middle) + 0.5).clamp(0.0, 1.0);
        let stripe = (at.y / 11.0).sin() > 0.4;
        let disc = if stripe { [190.0, 150.0, 60.0] } else { [130.0, 60.0, 50.0] };
        let ground = if (at.x / 17.0).sin() > 0.0 { [60.0, 100.0, 120.0] } else { [80.0, 120.0, 90.0] };
        std::array::from_fn(|k| (ground[k] + (disc[k] - ground[k]) * share + noise) as u8)
    });
    Picture::new(size, pixels.collect()).unwrap()
}

fn disc_radius(size: UVec2) -> f64 {
    f64::from(size.min_element()) * 0.3
}

/// Overlap of a mask with the disc: common over all.
fn overlap(mask: &Mask) -> f64 {
    let size = mask.size();
    let (mut common, mut all) = (0.0, 0.0);
    for (i, value) in (0..).zip(mask.values()) {
        let at = DVec2::new(f64::from(i % size.x) + 0.5, f64::from(i / size.x) + 0.5);
        let share = (disc_radius(size) - at.distance(size.as_dvec2() / 2.0) + 0.5).clamp(0.0, 1.0);
        let value = f64::from(*value) / 255.0;
        common += share.min(value);
        all += share.max(value);
    }
    common / all
}

fn loose_box(size: UVec2) -> Option<[PicturePoint; 2]> {
    let (middle, reach) = (size.as_dvec2() / 2.0, disc_radius(size) * 1.3);
    Some([PicturePoint(middle + reach), PicturePoint(middle - reach)])
}

fn assert_never_rises(energies: &[f64]) {
    assert!(!energies.is_empty());
    for pair in energies.windows(2) {
        assert!(pair[1] <= pair[0] + 1e-6 * pair[0].abs(), "{energies:?}");
    }
}

const SIZE: UVec2 = UVec2::new(220, 180);

#[test]
fn a_loose_box_finds_the_disc_and_energy_never_rises() {
    let hints = ObjectHints { corners: loose_box(SIZE), ..Default::default() };
    let cut = grab_cut(&picture(SIZE), &hints, &|_, _| true).unwrap();
    assert!(overlap(&cut.mask) > 0.97, "{}", overlap(&cut.mask));
    assert_eq!(cut.factor, 1);
    assert_never_rises(&cut.energies);
}

#[test]
fn strokes_alone_find_the_disc() {
    let at = |x: f64, y: f64| PicturePoint::new(x, y);
    let strokes = [
        Stroke::inside(vec![at(110.0, 50.0), at(110.0, 130.0)], 4.0),
        Stroke::outside(vec![at(20.0, 20.0), at(200.0, 20.0)], 5.0),
        Stroke::outside(vec![at(20.0, 165.0), at(200.0, 165.0)], 5.0),
    ];
    let hints = ObjectHints { strokes: &strokes, ..Default::default() };
    let cut = grab_cut(&picture(SIZE), &hints, &|_, _| true).unwrap();
    assert!(overlap(&cut.mask) > 0.97, "{}", overlap(&cut.mask));
    assert_never_rises(&cut.energies);
}

#[test]
fn a_rough_mask_is_mended_and_a_stroke_always_holds() {
    let square =
        [(60.0, 40.0), (160.0, 40.0), (160.0, 140.0), (60.0, 140.0)].map(|(x, y)| PicturePoint::new(x, y));
    let rough = Mask::from_polygon(SIZE, &square).unwrap();
    let hints = ObjectHints { earlier: Some(&rough), ..Default::default() };
    let cut = grab_cut(&picture(SIZE), &hints, &|_, _| true).unwrap();
    assert!(overlap(&cut.mask) > 0.97, "{}", overlap(&cut.mask));
    let strokes =
        [Stroke::outside(vec![PicturePoint::new(100.0, 90.0), PicturePoint::new(120.0, 90.0)], 6.0)];
    let cut = grab_cut(&picture(SIZE), &ObjectHints { strokes: &strokes, ..hints }, &|_, _| true).unwrap();
    assert_eq!((cut.mask.get(110, 90), cut.mask.get(110, 60)), (0, 255));
}

#[test]
fn a_large_picture_is_cut_small_and_followed_at_full_size() {
    let size = UVec2::new(1500, 1200);
    let hints = ObjectHints { corners: loose_box(size), ..Default::default() };
    let cut = grab_cut(&picture(size), &hints, &|_, _| true).unwrap();
    assert_eq!((cut.factor, cut.mask.size()), (2, size));
    assert!(overlap(&cut.mask) > 0.985, "{}", overlap(&cut.mask));
}

#[test]
fn the_same_input_gives_the_same_bits() {
    let hints = ObjectHints { corners: loose_box(SIZE), ..Default::default() };
    let cut = || grab_cut(&picture(SIZE), &hints, &|_, _| true).unwrap();
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(cut);
    assert_eq!(alone, cut());
}

#[test]
fn what_cannot_be_cut_is_told() {
    let picture = picture(SIZE);
    let cut = |hints: ObjectHints| grab_cut(&picture, &hints, &|_, _| true).unwrap_err();
    assert_eq!(cut(ObjectHints::default()), OutlineError::NothingMarked);
    let nan = [PicturePoint::new(f64::NAN, 0.0), PicturePoint::new(10.0, 10.0)];
    assert_eq!(cut(ObjectHints { corners: Some(nan), ..Default::default() }), OutlineError::NothingMarked);
    let other = Mask::new(UVec2::ONE, vec![255]).unwrap();
    assert!(matches!(
        cut(ObjectHints { earlier: Some(&other), ..Default::default() }),
        OutlineError::WrongSize { .. }
    ));
    let whole = [PicturePoint::new(-10.0, -10.0), PicturePoint::new(1e9, 1e9)];
    let all = ObjectHints { corners: Some(whole), ..Default::default() };
    assert_eq!(cut(all), OutlineError::NothingStandsOut, "nothing is left beside the box");
    let boxed = ObjectHints { corners: loose_box(SIZE), ..Default::default() };
    assert_eq!(grab_cut(&picture, &boxed, &|share, _| share < 0.2).unwrap_err(), OutlineError::Cancelled);
}

#[test]
fn progress_only_rises() {
    let last = std::cell::Cell::new(0.0);
    let hints = ObjectHints { corners: loose_box(SIZE), ..Default::default() };
    let told = |share: f32, _: &str| {
        assert!(share >= last.replace(share), "{share} after more");
        true
    };
    grab_cut(&picture(SIZE), &hints, &told).unwrap();
    assert_eq!(last.get(), 1.0);
}

#[test]
fn a_solid_object_has_no_holes() {
    // A ring of the disc's color: its middle shows the ground.
    let whole = picture(SIZE);
    let hole = |x: u32, y: u32| (f64::from(x) - 110.0).hypot(f64::from(y) - 90.0) < 20.0;
    let pixels = (0..SIZE.x * SIZE.y).map(|i| {
        let (x, y) = (i % SIZE.x, i / SIZE.x);
        if hole(x, y) { whole.pixel(x / 6, y / 6) } else { whole.pixel(x, y) }
    });
    let ring = Picture::new(SIZE, pixels.collect()).unwrap();
    let middle = |is_solid| {
        let hints = ObjectHints { corners: loose_box(SIZE), is_solid, ..Default::default() };
        grab_cut(&ring, &hints, &|_, _| true).unwrap().mask.get(110, 90)
    };
    assert_eq!((middle(false), middle(true)), (0, 255));
}
