//! Facts about the way along edges.

use super::*;

/// A picture of gray levels 60 and 180 with an antialiased edge where `off`, pixels, is 0, and a little texture.
fn edge(size: UVec2, off: impl Fn(DVec2) -> f64) -> Picture {
    let pixels = (0..size.x * size.y).map(|i| {
        let at = DVec2::new(f64::from(i % size.x) + 0.5, f64::from(i / size.x) + 0.5);
        let noise = f64::from((i.wrapping_mul(2_654_435_761) >> 28) % 5) - 2.0;
        [(120.0 + 120.0 * off(at).clamp(-0.5, 0.5) + noise) as u8; 3]
    });
    Picture::new(size, pixels.collect()).unwrap()
}

/// The farthest that a path is off an edge, pixels, its ends left out.
fn worst(path: &[PicturePoint], off: impl Fn(DVec2) -> f64) -> f64 {
    assert!(path.len() > 40, "a path of {} points", path.len());
    path[8..path.len() - 8].iter().map(|at| off(at.0).abs()).fold(0.0, f64::max)
}

/// What the way from the anchor to a point costs at full size: 1–255 for each of its links.
fn cost_to(wire: &mut LiveWire, at: PicturePoint) -> Option<u32> {
    assert!(!wire.path_to(at).is_empty());
    let at = wire.pixel(at)?;
    wire.anchor.as_mut()?.searches[0].as_mut()?.expand_to(at)
}

#[test]
fn a_path_stays_on_a_step_within_half_a_pixel() {
    let size = UVec2::new(200, 160);
    let upright = |p: DVec2| p.x - 100.0;
    let level = |p: DVec2| p.y - 80.25;
    let slanted = |p: DVec2| (p - DVec2::new(100.3, 80.1)).dot(DVec2::from_angle(0.4));
    let round = |p: DVec2| p.distance(DVec2::new(100.0, 80.0)) - 60.0;
    let check = |name: &str, off: &dyn Fn(DVec2) -> f64, from: [f64; 2], to: [f64; 2]| {
        let mut wire = LiveWire::new(&edge(size, off));
        wire.anchor(PicturePoint(from.into()));
        let off = worst(&wire.path_to(PicturePoint(to.into())), off);
        assert!(off <= 0.5 + 1e-9, "{name}: {off} px");
    };
    check("upright", &upright, [99.0, 10.0], [102.0, 150.0]);
    check("level", &level, [10.0, 79.0], [190.0, 82.0]);
    check("slanted", &slanted, [128.0, 15.0], [72.0, 147.0]);
    check("round", &round, [40.0, 80.0], [160.0, 80.0]);
}

#[test]
fn the_way_back_costs_the_same() {
    let size = UVec2::new(160, 120);
    let mut wire = LiveWire::new(&edge(size, |p| (p.x * 0.11).sin() * 8.0 + p.y - 60.0));
    let points =
        [(5.0, 60.0), (150.0, 70.0), (80.0, 3.0), (33.0, 110.0)].map(|(x, y)| PicturePoint::new(x, y));
    for a in points {
        for b in points {
            wire.anchor(a);
            let there = cost_to(&mut wire, b);
            wire.anchor(b);
            assert_eq!(there, cost_to(&mut wire, a), "{a} to {b}");
            assert!(there.is_some());
        }
    }
}

#[test]
fn going_on_finds_what_a_new_search_finds() {
    let picture = edge(UVec2::new(180, 140), |p| p.x + p.y * 0.5 - 130.0);
    let mut going = LiveWire::new(&picture);
    let anchor = PicturePoint::new(125.0, 8.0);
    going.anchor(anchor);
    for step in 0..30 {
        let at = PicturePoint::new(120.0 - f64::from(step), 12.0 + f64::from(step * 4));
        let mut fresh = LiveWire::new(&picture);
        fresh.anchor(anchor);
        assert_eq!(cost_to(&mut going, at), cost_to(&mut fresh, at), "move {step}");
        assert_eq!(going.path_to(at), fresh.path_to(at), "move {step}");
    }
}

#[test]
fn far_paths_follow_the_edge_at_full_size() {
    let size = UVec2::new(1500, 700);
    let off = |p: DVec2| p.y - 350.0 - 60.0 * (p.x * 0.008).sin();
    let mut wire = LiveWire::new(&edge(size, off));
    wire.anchor(PicturePoint::new(30.0, 364.0));
    let path = wire.path_to(PicturePoint::new(1470.0, 350.0 + 60.0 * 11.76_f64.sin()));
    // Neighboring pixels, each moved by half a pixel at most: no link is left out.
    assert!(path.windows(2).all(|ends| (ends[1].0 - ends[0].0).abs().max_element() <= 2.0));
    let off = worst(&path, off);
    assert!(off <= 0.5, "{off} px along y");
}

#[test]
fn what_was_learned_prefers_the_weaker_edge() {
    // Two level edges, a weak one at row 40 and a strong one at row 60; a straight way lies between them.
    let pixels = (0..200 * 100).map(|i| {
        let y = i / 200;
        [if y < 40 {
            90
        } else if y < 60 {
            110
        } else {
            220
        }; 3]
    });
    let mut wire = LiveWire::new(&Picture::new(UVec2::new(200, 100), pixels.collect()).unwrap());
    let cost_along = |wire: &mut LiveWire, y: f64| {
        wire.anchor(PicturePoint::new(10.0, y));
        cost_to(wire, PicturePoint::new(190.0, y)).unwrap()
    };
    let weak: Vec<_> = (20..120).map(|x| PicturePoint::new(f64::from(x) + 0.5, 39.5)).collect();
    assert!(cost_along(&mut wire, 39.5) > cost_along(&mut wire, 59.5));
    wire.learn_from(&weak);
    assert!(cost_along(&mut wire, 39.5) < cost_along(&mut wire, 59.5));
    wire.forget();
    assert!(cost_along(&mut wire, 39.5) > cost_along(&mut wire, 59.5));
}

#[test]
fn bad_points_are_refused_and_far_ones_clamped() {
    let mut wire = LiveWire::new(&edge(UVec2::new(50, 40), |p| p.x - 25.0));
    assert!(wire.path_to(PicturePoint::new(5.0, 5.0)).is_empty(), "no anchor yet");
    wire.anchor(PicturePoint::new(f64::NAN, 5.0));
    assert!(wire.path_to(PicturePoint::new(5.0, 5.0)).is_empty(), "still none");
    wire.anchor(PicturePoint::new(-1e9, 5.0));
    assert!(wire.path_to(PicturePoint::new(f64::INFINITY, 5.0)).is_empty());
    let path = wire.path_to(PicturePoint::new(1e9, 1e9));
    assert_eq!(path.first(), Some(&PicturePoint::new(0.5, 5.5)));
    assert_eq!(path.last(), Some(&PicturePoint::new(49.5, 39.5)));
    let mut tiny = LiveWire::new(&Picture::new(UVec2::ONE, vec![[3; 3]]).unwrap());
    tiny.anchor(PicturePoint::new(0.5, 0.5));
    assert_eq!(tiny.path_to(PicturePoint::new(0.5, 0.5)), [PicturePoint::new(0.5, 0.5)]);
}
