//! Footprints: closed, of the right area, rasterized to the right share of cells.

use std::f64::consts::FRAC_PI_2;

use super::*;

const PAINTER: DVec2 = DVec2::ZERO;

/// An arc of a circle of 2 m around (1, −10), bulging to the painter, over so many radians.
fn arc(angle: f64) -> Vec<DVec2> {
    let points = (0..=200).map(|step| {
        let turn = FRAC_PI_2 + angle * (f64::from(step) / 200.0 - 0.5);
        DVec2::new(1.0, -10.0) + 2.0 * DVec2::from_angle(turn)
    });
    points.collect()
}

fn crosses(a: [DVec2; 2], b: [DVec2; 2]) -> bool {
    let side = |line: [DVec2; 2], point: DVec2| (line[1] - line[0]).perp_dot(point - line[0]);
    side(a, b[0]) * side(a, b[1]) < 0.0 && side(b, a[0]) * side(b, a[1]) < 0.0
}

#[test]
fn an_arc_is_mirrored_over_its_chord() {
    let angle = 2.0;
    let footprint = Footprint::from_contact(&arc(angle), PAINTER, 0.2).unwrap();
    // Twice the segment of the circle.
    let truth = 4.0 * (angle - angle.sin());
    assert!((footprint.area() / truth - 1.0).abs() < 2e-3, "{} instead of {truth} m²", footprint.area());
    let chord = -10.0 + 2.0 * (0.5 * angle).cos();
    assert!((footprint.centroid() - DVec2::new(1.0, chord)).length() < 5e-3, "{}", footprint.centroid());
}

#[test]
fn a_straight_contact_gets_a_far_side() {
    for (start, end) in [((-1.0, -5.0), (3.0, -5.0)), ((3.0, -5.0), (-1.0, -5.0)), ((2.0, -3.0), (4.0, -7.0))]
    {
        let contact = [DVec2::from(start), DVec2::from(end)];
        let footprint = Footprint::from_contact(&contact, PAINTER, 0.2).unwrap();
        let chord = contact[0].distance(contact[1]);
        let truth = 0.4 / PI * chord * chord;
        assert!((footprint.area() / truth - 1.0).abs() < 2e-3, "{} instead of {truth} m²", footprint.area());
        let middle = 0.5 * (contact[0] + contact[1]);
        assert!(footprint.centroid().length() > middle.length(), "it lies before the contact line");
    }
}

#[test]
fn a_wavy_contact_does_not_cross_its_far_side() {
    let wavy = (0..=40).map(|step| {
        let share = f64::from(step) / 40.0;
        DVec2::new(4.0 * share, -8.0 + 0.2 * (3.0 * PI * share).sin())
    });
    let footprint = Footprint::from_contact(&wavy.collect::<Vec<_>>(), PAINTER, 0.2).unwrap();
    let edges: Vec<_> = edges(footprint.outline()).map(|(a, b)| [a, b]).collect();
    for (index, edge) in edges.iter().enumerate() {
        assert!(
            !edges[index + 1..].iter().any(|other| crosses(*edge, *other)),
            "edge {index} crosses another"
        );
    }
}

#[test]
fn cells_are_covered_by_their_share() {
    let grid = RippleGrid { origin: DVec2::new(-3.0, -13.0), cell: 0.11, size: 64 };
    let footprint = Footprint::from_contact(&arc(2.0), PAINTER, 0.2).unwrap();
    for turn in [0.0, 0.7, -2.0] {
        let moved = footprint.moved(footprint.centroid(), turn, DVec2::new(0.2, -0.5));
        assert!((moved.area() - footprint.area()).abs() < 1e-9);
        assert!((moved.centroid() - footprint.centroid() - DVec2::new(0.2, -0.5)).length() < 1e-9);
        let covered = moved.cover(&grid);
        let area = f64::from(covered.total()) * grid.cell * grid.cell;
        assert!((area / moved.area() - 1.0).abs() < 0.01, "{area} instead of {} m²", moved.area());
        let sum: DVec2 = covered
            .iter()
            .map(|(cell, weight)| grid.center(cell % grid.size, cell / grid.size) * f64::from(weight))
            .sum();
        let center = sum / f64::from(covered.total());
        assert!((center - moved.centroid()).length() < 0.02, "{center} instead of {}", moved.centroid());
    }
}

#[test]
fn a_square_of_whole_cells_covers_them_wholly() {
    let grid = RippleGrid { origin: DVec2::ZERO, cell: 0.5, size: 16 };
    let square = [(1.0, 1.0), (3.25, 1.0), (3.25, 2.0), (1.0, 2.0)].map(DVec2::from);
    let covered = Footprint::from_outline(square.to_vec()).unwrap().cover(&grid);
    let cells: Vec<_> = covered.iter().collect();
    let row = |row: usize| (2..6).map(move |column| (row * 16 + column, 1.0)).chain([(row * 16 + 6, 0.5)]);
    assert_eq!(cells, row(2).chain(row(3)).collect::<Vec<_>>());
    let mut mask = vec![1.0; 256];
    covered.cut_from(&mut mask);
    assert_eq!((mask[34], mask[38], mask[39]), (0.0, 0.5, 1.0));
}

#[test]
fn what_lies_outside_the_grid_is_left_out() {
    let grid = RippleGrid { origin: DVec2::ZERO, cell: 0.5, size: 16 };
    let square = |low: f64, high: f64| {
        let corners = [(low, low), (high, low), (high, high), (low, high)].map(DVec2::from);
        Footprint::from_outline(corners.to_vec()).unwrap().cover(&grid)
    };
    assert_eq!(square(-1e9, 1e9).total(), 256.0);
    assert_eq!(square(-2.0, 0.5).total(), 1.0);
    assert!(square(-9.0, -1.0).is_empty() && square(8.0, 1e9).is_empty());
}

#[test]
fn what_encloses_nothing_is_refused() {
    let point = DVec2::new(1.0, -4.0);
    assert_eq!(Footprint::from_contact(&[], PAINTER, 0.2), Err(FootprintError::Empty));
    assert_eq!(Footprint::from_contact(&[point], PAINTER, 0.2), Err(FootprintError::Empty));
    assert_eq!(Footprint::from_contact(&[point, point], PAINTER, 0.2), Err(FootprintError::Empty));
    assert_eq!(Footprint::from_contact(&[point, DVec2::NAN], PAINTER, 0.2), Err(FootprintError::NotFinite));
    assert_eq!(Footprint::from_outline(vec![point, 2.0 * point]), Err(FootprintError::Empty));
    assert_eq!(Footprint::from_outline(vec![DVec2::INFINITY]), Err(FootprintError::NotFinite));
}
