//! Facts about outlines found in boxes and by strokes.

use glam::{DVec2, UVec2};

use super::*;
use crate::picture::PicturePoint;
use crate::suggest::outline::{Bound, Stroke};

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

/// The disc as it is found in a box, and those polygons.
fn disc_and(polygons: &[Vec<PicturePoint>]) -> Mask {
    let boxed = ObjectHints { corners: loose_box(SIZE), ..Default::default() };
    let disc = grab_cut(&picture(SIZE), &boxed, &|_, _| true).unwrap().mask;
    polygons.iter().fold(disc, |all, corners| {
        let polygon = Mask::from_polygon(SIZE, corners).unwrap();
        let both = all.values().iter().zip(polygon.values()).map(|(&a, &b)| a.max(b));
        Mask::new(SIZE, both.collect()).unwrap()
    })
}

#[test]
fn a_stroke_changes_only_what_it_touches() {
    // Two squares that are not the disc: the stroke speaks of the left one.
    let square = |x: f64| line(&[(x, 10.0), (x + 30.0, 10.0), (x + 30.0, 40.0), (x, 40.0)]);
    let earlier = disc_and(&[square(10.0), square(180.0)]);
    let strokes = [Stroke::outside(vec![PicturePoint::new(18.0, 25.0), PicturePoint::new(32.0, 25.0)], 4.0)];
    let hints = ObjectHints { strokes: &strokes, earlier: Some(&earlier), ..Default::default() };
    let cut = grab_cut(&picture(SIZE), &hints, &|_, _| true).unwrap();
    for (x, y, pixel) in (0..SIZE.y).flat_map(|y| (0..SIZE.x).map(move |x| (x, y, y * SIZE.x + x))) {
        let (then, now) = (earlier.values()[pixel as usize], cut.mask.get(x, y));
        if x < 60 && y < 60 {
            assert!(now < 10, "{now} is left at {x}, {y}");
        } else {
            assert_eq!(then, now, "at {x}, {y}");
        }
    }
}

#[test]
fn a_leak_is_taken_back_and_the_piece_it_leaked_from_stays() {
    // A stripe runs from a second piece of the disc's colors; only the disc is stroked inside.
    let mut pixels = picture(SIZE).pixels().to_vec();
    for (x, y) in (40..150_u32).flat_map(|y| (185..215_u32).map(move |x| (x, y))) {
        pixels[(y * SIZE.x + x) as usize] = picture(SIZE).pixel(110, y);
    }
    let two = Picture::new(SIZE, pixels).unwrap();
    let piece = line(&[(185.0, 40.0), (215.0, 40.0), (215.0, 150.0), (185.0, 150.0)]);
    let leak = line(&[(165.0, 20.0), (215.0, 20.0), (215.0, 40.0), (165.0, 40.0)]);
    let earlier = disc_and(&[piece, leak]);
    let strokes = [
        Stroke::inside(line(&[(110.0, 80.0), (110.0, 100.0)]), 4.0),
        Stroke::outside(line(&[(175.0, 28.0), (205.0, 28.0)]), 4.0),
    ];
    let hints = ObjectHints { strokes: &strokes, earlier: Some(&earlier), ..Default::default() };
    let cut = grab_cut(&two, &hints, &|_, _| true).unwrap();
    assert_eq!([(190, 28), (200, 95), (110, 90)].map(|(x, y)| cut.mask.get(x, y)), [0, 255, 255]);
}

#[test]
fn nothing_crosses_a_bound() {
    let at = |x: f64, y: f64| PicturePoint::new(x, y);
    let strokes = [Stroke::inside(vec![at(110.0, 94.0), at(110.0, 130.0)], 4.0)];
    let cut = |y: f64, is_above| {
        let bound = Some(Bound { line: [at(0.0, y), at(1.0, y)], is_above });
        let hints = ObjectHints { strokes: &strokes, bound, ..Default::default() };
        grab_cut(&picture(SIZE), &hints, &|_, _| true)
    };
    let mask = cut(90.0, false).unwrap().mask;
    assert!((0..SIZE.x).all(|x| mask.get(x, 89) == 0), "the line is crossed");
    assert_eq!((mask.get(90, 92), mask.get(110, 125), mask.get(20, 125)), (255, 255, 0));
    assert_eq!(cut(-5.0, true), Err(OutlineError::BeyondBound), "nothing of the picture is on that side");
}

#[test]
fn a_stroke_across_a_slanted_bound_speaks_of_its_own_side() {
    // From the upper left to the lower right corner; the region stays below.
    let bound =
        Some(Bound { line: [PicturePoint::new(0.0, 0.0), PicturePoint(SIZE.as_dvec2())], is_above: false });
    let beyond = line(&[(100.0, 40.0), (150.0, 40.0), (150.0, 70.0), (100.0, 70.0)]);
    let earlier = disc_and(&[beyond]);
    let strokes = [Stroke::inside(line(&[(110.0, 60.0), (110.0, 120.0)]), 4.0)];
    let hints = ObjectHints { strokes: &strokes, earlier: Some(&earlier), bound, ..Default::default() };
    let cut = grab_cut(&picture(SIZE), &hints, &|_, _| true).unwrap().mask;
    assert_eq!((cut.get(110, 60), cut.get(110, 110)), (255, 255), "what was beyond is not erased by it");
    let hints = ObjectHints { earlier: None, ..hints };
    let cut = grab_cut(&picture(SIZE), &hints, &|_, _| true).unwrap().mask;
    assert_eq!((cut.get(110, 60), cut.get(110, 110)), (0, 255));
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

/// How well an object of the world A1 is found (intersection over union of what is at least half covered) in the box
/// around what its true mask at least half covers, grown by a twentieth, with strokes.
fn found_in_a1(mask: &str, strokes: &[Stroke], is_solid: bool) -> f64 {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/a1");
    let bytes = |file: &str| std::fs::read(folder.join(file)).unwrap();
    let picture = crate::picture::decode_picture(&bytes("input.png"), "input.png").unwrap().picture;
    let truth = crate::picture::decode_mask(&bytes(mask), mask, picture.size()).unwrap();
    let solid = truth.values().iter().map(|value| if *value >= 128 { 255 } else { 0 }).collect();
    let bounds = Mask::new(truth.size(), solid).unwrap().bounds().unwrap();
    let grown = bounds.size().as_dvec2() * 0.05;
    let corners = [bounds.min.as_dvec2() - grown, bounds.max.as_dvec2() + grown].map(PicturePoint);
    let hints = ObjectHints { corners: Some(corners), strokes, is_solid, ..Default::default() };
    let cut = grab_cut(&picture, &hints, &|_, _| true).unwrap();
    assert_never_rises(&cut.energies);
    let pairs = || cut.mask.values().iter().zip(truth.values()).map(|(a, b)| [*a >= 128, *b >= 128]);
    pairs().filter(|[a, b]| *a && *b).count() as f64 / pairs().filter(|[a, b]| *a || *b).count() as f64
}

fn line(points: &[(f64, f64)]) -> Vec<PicturePoint> {
    points.iter().map(|(x, y)| PicturePoint::new(*x, *y)).collect()
}

#[test]
fn a_house_takes_a_box_and_two_strokes_along_its_foundation() {
    let strokes = [
        Stroke::inside(line(&[(757.5, 287.5), (753.5, 288.5), (705.5, 288.5), (701.5, 286.5)]), 1.3),
        Stroke::inside(line(&[(802.5, 286.5), (798.5, 288.5), (774.5, 288.5), (772.5, 286.5)]), 1.3),
    ];
    let found = found_in_a1("masks/obj_1_house.png", &strokes, true);
    assert!(found > 0.97, "{found}");
}

#[test]
fn a_rock_over_its_own_mirror_image_takes_a_box_and_a_stroke_beside_it() {
    let beside = Stroke::outside(line(&[(706.5, 321.5), (718.5, 309.5), (731.5, 303.5)]), 5.0);
    let found = found_in_a1("masks/obj_3_rock.png", &[beside], true);
    assert!(found > 0.97, "{found}");
}

#[test]
fn foliage_takes_a_box_and_a_stroke_on_the_trunk_and_one_beside_it() {
    let strokes = [
        Stroke::outside(line(&[(114.5, 262.5), (102.5, 272.5), (62.5, 277.5), (45.5, 284.5)]), 5.0),
        Stroke::inside(line(&[(128.5, 293.5), (131.5, 289.5), (131.5, 257.5), (130.5, 253.5)]), 2.3),
    ];
    let found = found_in_a1("masks/obj_2_tree.png", &strokes, false);
    assert!(found > 0.9, "{found}");
}
