//! Made pictures: a lake after notes §2.3, and a pond before walls at known distances.

use glam::{DVec2, UVec2};

use crate::picture::Picture;
use crate::tour::ReflectionPair;

/// A number 0–1 for a lattice point, by splitmix64.
pub(super) fn random(x: i64, y: i64, seed: u64) -> f64 {
    let mut z = seed
        .wrapping_add((x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15))
        .wrapping_add((y as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F))
        .wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Smooth noise, about −1 to 1, `scale` units from bump to bump.
pub(in crate::suggest) fn noise(at: DVec2, scale: f64, seed: u64) -> f64 {
    let p = at / scale;
    let (cell, part) = (p.floor(), p - p.floor());
    let t = part * part * (3.0 - 2.0 * part);
    let corner = |dx: i64, dy: i64| random(cell.x as i64 + dx, cell.y as i64 + dy, seed) * 2.0 - 1.0;
    let row = |dy: i64| corner(0, dy) * (1.0 - t.x) + corner(1, dy) * t.x;
    row(0) * (1.0 - t.y) + row(1) * t.y
}

/// What stands above the water: sky that grows brighter downward, a ridge, and a rough slope.
pub(super) fn land(at: DVec2, seed: u64) -> f64 {
    let ridge = 90.0
        + 40.0 * noise(DVec2::new(at.x, 0.0), 70.0, seed)
        + 12.0 * noise(DVec2::new(at.x, 0.0), 13.0, seed);
    let sky = 150.0 + 0.3 * at.y;
    let slope = 90.0
        + 25.0 * noise(at, 31.0, seed + 1)
        + 25.0 * noise(at, 11.0, seed + 2)
        + 15.0 * noise(at, 5.0, seed + 3);
    let share = ((at.y - ridge) / 2.0 + 0.5).clamp(0.0, 1.0);
    sky + (slope - sky) * share
}

pub(in crate::suggest) fn picture(size: UVec2, value: impl Fn(DVec2) -> f64) -> Picture {
    let pixels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| (x, y))).map(|(x, y)| {
        let code = value(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)).round().clamp(0.0, 255.0) as u8;
        [code; 3]
    });
    Picture::new(size, pixels.collect()).unwrap()
}

pub(super) const SIZE: UVec2 = UVec2::new(480, 360);

/// Notes §2.3: gain 0.6, offset 40, vertical displacement that is alike along rows and grows towards the viewer, up to
/// `ripple` pixels rms at the near edge, blur of as many rows as belong to it, grain of 2.5 levels.
pub(super) fn lake(axis: f64, ripple: f64, seed: u64) -> Picture {
    let height = f64::from(SIZE.y);
    picture(SIZE, |at| {
        let grain = 2.5 * 1.73 * (random((at.x * 2.0) as i64, (at.y * 2.0) as i64, seed + 9) * 2.0 - 1.0);
        if at.y < axis {
            return land(at, seed) + grain;
        }
        let near = (at.y - axis) / (height - axis);
        // Smooth noise of this kind has an rms of about 0.45.
        let wave = noise(DVec2::new(at.x / 6.0, at.y), 4.0 + 10.0 * near, seed + 5) * ripple * near / 0.45;
        let blur = 0.25 * ripple;
        let rows = [-1.5, -0.5, 0.5, 1.5]
            .map(|step| land(DVec2::new(at.x, (2.0 * axis - at.y + wave + step * blur).max(0.0)), seed));
        0.6 * rows.iter().sum::<f64>() / 4.0 + 40.0 + grain
    })
}

/// A pitched camera over water, with frontal walls at several depths; f 420 px, 1.7 m high.
pub(super) const FOCAL: f64 = 420.0;
pub(super) const HEIGHT: f64 = 1.7;
pub(super) const PITCH: f64 = -0.06;

/// Where a ray at view offset (right, up) ends: the wall's own coordinates, its depth, and whether by way of the water.
pub(super) fn hit(at: DVec2) -> (DVec2, usize, bool) {
    let offset = (at - SIZE.as_dvec2() / 2.0) / FOCAL;
    let (sin, cos) = PITCH.sin_cos();
    let (up, ahead) = (-offset.y * cos + sin, offset.y * sin + cos);
    let (right, rise) = (offset.x / ahead, up / ahead);
    for (i, (depth, left, wide, tall)) in WALLS.into_iter().enumerate() {
        let (x, y) = (right * depth, HEIGHT + rise * depth);
        let inside = |y: f64| x > left && x < left + wide && y >= 0.0 && y < tall;
        if inside(y) {
            return (DVec2::new(x, y), i, false);
        }
        if rise < 0.0 && inside(-y) {
            return (DVec2::new(x, -y), i, true);
        }
    }
    (DVec2::new(right, rise.abs()) * 1000.0, WALLS.len(), rise < 0.0)
}

/// Depth, left end, width, height, meters.
pub(super) const WALLS: [(f64, f64, f64, f64); 3] =
    [(12.0, -4.5, 3.0, 2.2), (40.0, 2.0, 14.0, 8.0), (150.0, -200.0, 400.0, 22.0)];

pub(super) fn pond() -> Picture {
    picture(SIZE, |at| {
        let steps = [
            DVec2::new(-0.25, -0.25),
            DVec2::new(0.25, -0.25),
            DVec2::new(-0.25, 0.25),
            DVec2::new(0.25, 0.25),
        ];
        let values = steps.map(|step| {
            let (place, wall, wet) = hit(at + step);
            let depth = WALLS.get(wall).map_or(1000.0, |wall| wall.0);
            // As fine in the picture at every depth.
            let seen = place * FOCAL / depth;
            let seed = 40 + wall as u64;
            let code = if wall == WALLS.len() {
                200.0 - 0.1 * seen.y + 10.0 * noise(seen, 60.0, seed)
            } else {
                100.0
                    + 20.0 * wall as f64
                    + 40.0 * noise(seen, 17.0, seed)
                    + 25.0 * noise(seen, 7.0, seed + 10)
            };
            if wet { 0.7 * code + 20.0 } else { code }
        });
        values.iter().sum::<f64>() / 4.0
    })
}

/// How far a reflection is from where the pond shows it; at edges the better of the walls near it.
pub(super) fn error(pair: &ReflectionPair) -> f64 {
    let (sin, cos) = PITCH.sin_cos();
    let off = |depth: f64| {
        let offset = (pair.point.0 - SIZE.as_dvec2() / 2.0) / FOCAL;
        let (up, ahead) = (-offset.y * cos + sin, offset.y * sin + cos);
        let (x, y) = (offset.x / ahead * depth, -2.0 * HEIGHT - up / ahead * depth);
        let (view_up, view_ahead) = (y * cos - depth * sin, y * sin + depth * cos);
        let seen = SIZE.as_dvec2() / 2.0 + DVec2::new(x, -view_up) * FOCAL / view_ahead;
        seen.distance(pair.reflection.0)
    };
    let (_, own, _) = hit(pair.point.0);
    let near = (-7..=7).flat_map(|y| (-7..=7).map(move |x| DVec2::new(x.into(), y.into())));
    let walls = near.map(|step| hit(pair.point.0 + step).1).chain([own]);
    walls.map(|wall| off(WALLS.get(wall).map_or(1e6, |wall| wall.0))).fold(f64::INFINITY, f64::min)
}
