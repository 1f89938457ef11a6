//! Facts about contact lines: where feet are found, and where none are.

use glam::UVec2;

use super::*;

const SIZE: UVec2 = UVec2::new(320, 240);

fn mask(polygons: &[&[(f64, f64)]]) -> Mask {
    let mut values = vec![0; 76_800];
    for polygon in polygons {
        let corners: Vec<_> = polygon.iter().map(|(x, y)| PicturePoint::new(*x, *y)).collect();
        let one = Mask::from_polygon(SIZE, &corners).unwrap();
        values.iter_mut().zip(one.values()).for_each(|(value, other)| *value = (*other).max(*value));
    }
    Mask::new(SIZE, values).unwrap()
}

fn assert_feet(mask: &Mask, feet: [(f64, f64); 2], within: f64) -> f64 {
    let found = contact_line(mask).unwrap();
    for (found, (x, y)) in found.feet.iter().zip(feet) {
        let off = found.0.distance(DVec2::new(x, y));
        assert!(off <= within, "{found} is {off} px off ({x}, {y})");
    }
    found.confidence
}

const HOUSE: &[(f64, f64)] = &[(60.0, 180.3), (60.0, 100.0), (130.0, 50.0), (200.0, 100.0), (200.0, 180.3)];

#[test]
fn a_house_stands_on_its_lower_edge() {
    assert!(assert_feet(&mask(&[HOUSE]), [(60.0, 180.3), (200.0, 180.3)], 0.6) > 0.95);
}

#[test]
fn a_wall_at_an_angle_keeps_its_slope() {
    let wall: &[(f64, f64)] = &[(40.0, 120.0), (280.0, 90.0), (280.0, 150.0), (40.0, 214.0)];
    assert!(assert_feet(&mask(&[wall]), [(40.0, 214.0), (280.0, 150.0)], 1.0) > 0.95);
}

#[test]
fn eaves_and_a_step_do_not_lift_the_line() {
    let eaves: &[(f64, f64)] = &[(45.0, 110.0), (215.0, 110.0), (215.0, 96.0), (45.0, 96.0)];
    let step: &[(f64, f64)] = &[(120.0, 170.0), (130.0, 170.0), (130.0, 188.0), (120.0, 188.0)];
    let found = contact_line(&mask(&[HOUSE, eaves, step])).unwrap();
    assert!(found.feet.iter().all(|foot| (foot.y() - 180.3).abs() < 1.0), "{found:?}");
}

#[test]
fn a_trunk_gives_a_level_line_at_its_foot_with_less_confidence() {
    let crown: &[(f64, f64)] = &[(60.0, 120.0), (100.0, 30.0), (180.0, 25.0), (230.0, 90.0), (170.0, 140.0)];
    let trunk: &[(f64, f64)] = &[(138.0, 120.0), (150.0, 120.0), (151.0, 200.0), (137.0, 200.0)];
    let confidence = assert_feet(&mask(&[crown, trunk]), [(137.0, 200.0), (151.0, 200.0)], 1.0);
    assert!(confidence < 0.4, "{confidence}");
}

#[test]
fn holes_specks_and_a_mirror_image_below_change_nothing() {
    let plain = contact_line(&mask(&[HOUSE])).unwrap();
    let image: &[(f64, f64)] = &[(60.0, 184.0), (60.0, 230.0), (200.0, 230.0), (200.0, 184.0)];
    let speck: &[(f64, f64)] = &[(100.0, 232.0), (104.0, 232.0), (104.0, 236.0), (100.0, 236.0)];
    assert_eq!(contact_line(&mask(&[HOUSE, image, speck])), Some(plain));
    let mut holed = mask(&[HOUSE]).values().to_vec();
    (150..170).for_each(|y| holed[y * 320 + 90..y * 320 + 140].fill(0));
    assert_eq!(contact_line(&Mask::new(SIZE, holed).unwrap()), Some(plain));
}

#[test]
fn the_frame_lowers_confidence_and_nothing_has_no_line() {
    let cut_off: &[(f64, f64)] = &[(60.0, 300.0), (60.0, 100.0), (200.0, 100.0), (200.0, 300.0)];
    assert!(contact_line(&mask(&[cut_off])).unwrap().confidence <= 0.5);
    assert_eq!(contact_line(&mask(&[])), None);
    let one = contact_line(&Mask::new(UVec2::ONE, vec![255]).unwrap()).unwrap();
    assert!(one.feet.iter().all(|foot| foot.0.is_finite()), "{one:?}");
}
