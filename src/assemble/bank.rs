//! The vertical face of ground that stands above the water: a bank of earth or stones, a quay.
//!
//! Where ground meets the water below it, what is seen between the waterline and the ground's own edge is no part of the
//! level ground. It becomes walls along the waterline, each with its share of the ground's mask.

use glam::UVec2;

use crate::camera::PinholeCamera;
use crate::picture::Mask;
use crate::picture::PicturePoint;
use crate::scene::BillboardPlan;
use crate::tour::Support;

/// Walls follow the waterline within so many pixels per pixel of picture width at first, and half as many again until
/// there are few enough.
const TOLERANCE: f64 = 0.004;

/// The most walls that a bank is cut into.
const MOST_WALLS: usize = 6;

/// A face lower than this in the picture is not seen, pixels per pixel of picture width.
const LEAST_HEIGHT: f64 = 0.003;

/// Water below the ground within so many pixels makes its end a waterline.
const GAP: u32 = 3;

/// A waterline shorter than this share of the picture's width is a gap between stones.
const SHORTEST: f64 = 0.01;

/// A wall of the ground's edge.
pub(super) struct Bank {
    pub plan: BillboardPlan,
    pub mask: Mask,
}

/// The walls of the ground's edge, left to right, and the ground without them.
pub(super) fn banks(
    camera: &PinholeCamera,
    ground_height: f64,
    ground: &Mask,
    water: &Mask,
) -> (Vec<Bank>, Mask) {
    let size = ground.size();
    let feet: Vec<Option<f64>> = (0..size.x)
        .map(|x| foot(ground, water, x).filter(|&y| face_px(camera, ground_height, x, y) > least(size)))
        .collect();
    let mut corners = waterlines(&feet, TOLERANCE * f64::from(size.x));
    let mut tolerance = TOLERANCE * f64::from(size.x);
    while corners.len() > MOST_WALLS {
        tolerance *= 1.5;
        corners = waterlines(&feet, tolerance);
        if tolerance > f64::from(size.x) {
            // So many gaps: the longest pieces count.
            corners.sort_by(|a, b| (b[1].x() - b[0].x()).total_cmp(&(a[1].x() - a[0].x())));
            corners.truncate(MOST_WALLS);
            corners.sort_by(|a, b| a[0].x().total_cmp(&b[0].x()));
        }
    }
    let mut level = ground.values().to_vec();
    let banks = corners
        .into_iter()
        .enumerate()
        .filter_map(|(place, contact)| {
            let mask = cut(camera, ground_height, ground, &mut level, contact)?;
            let bounds = mask.bounds()?;
            let plan = BillboardPlan {
                name: format!("ground's bank {}", place + 1),
                support: Support::Water,
                contact,
                turns_to_camera: false,
                mask_box: [bounds.min.as_ivec2(), bounds.max.as_ivec2()],
            };
            Some(Bank { plan, mask })
        })
        .collect();
    // The count is right by construction.
    (banks, Mask::new(size, level).unwrap_or_else(|_| ground.clone()))
}

fn least(size: UVec2) -> f64 {
    LEAST_HEIGHT * f64::from(size.x)
}

/// Where the lowest ground of a column ends above water, its lower edge in pixels.
fn foot(ground: &Mask, water: &Mask, x: u32) -> Option<f64> {
    let last = (0..ground.size().y).rev().find(|&y| ground.get(x, y) >= 128)?;
    let below = (last + 1..=last + GAP).filter(|&y| y < ground.size().y);
    below.into_iter().any(|y| water.get(x, y) >= 128).then(|| f64::from(last) + 1.0)
}

/// How far above a point of the waterline the ground's edge is seen, pixels.
fn face_px(camera: &PinholeCamera, ground_height: f64, x: u32, foot: f64) -> f64 {
    edge_above(camera, ground_height, PicturePoint::new(f64::from(x) + 0.5, foot))
        .map_or(0.0, |edge| foot - edge.y())
}

/// The picture's point straight above a point of the waterline at the ground's height.
fn edge_above(camera: &PinholeCamera, ground_height: f64, foot: PicturePoint) -> Option<PicturePoint> {
    let at_water = camera.on_level(foot, 0.0)?;
    camera.project(at_water.with_y(ground_height))
}

/// Runs of the waterline as straight pieces, each from its left to its right end (Ramer, Douglas and Peucker). Straight
/// in the picture is straight on the water.
fn waterlines(feet: &[Option<f64>], tolerance: f64) -> Vec<[PicturePoint; 2]> {
    let shortest = (SHORTEST * feet.len() as f64).max(4.0) as usize;
    let mut pieces = Vec::new();
    let mut run: Vec<PicturePoint> = Vec::new();
    for (x, foot) in feet.iter().enumerate().map(|(x, foot)| (x, *foot)).chain([(feet.len(), None)]) {
        if let Some(y) = foot {
            run.push(PicturePoint::new(x as f64 + 0.5, y));
            continue;
        }
        if run.len() >= shortest {
            split(&run, tolerance, &mut pieces);
        }
        run.clear();
    }
    pieces
}

fn split(run: &[PicturePoint], tolerance: f64, pieces: &mut Vec<[PicturePoint; 2]>) {
    let (Some(&first), Some(&last)) = (run.first(), run.last()) else { return };
    let off = |point: &PicturePoint| {
        let t = (point.x() - first.x()) / (last.x() - first.x()).max(1.0);
        (point.y() - (first.y() + t * (last.y() - first.y()))).abs()
    };
    let worst = (0..run.len()).max_by(|&a, &b| off(&run[a]).total_cmp(&off(&run[b]))).unwrap_or(0);
    if off(&run[worst]) <= tolerance || worst == 0 || worst + 1 == run.len() {
        pieces.push([first, last]);
    } else {
        split(&run[..=worst], tolerance, pieces);
        split(&run[worst..], tolerance, pieces);
    }
}

/// Takes a wall's pixels from the ground: those of its columns that lie below the ground's edge there.
fn cut(
    camera: &PinholeCamera,
    ground_height: f64,
    ground: &Mask,
    level: &mut [u8],
    [left, right]: [PicturePoint; 2],
) -> Option<Mask> {
    let size = ground.size();
    let mut values = vec![0; level.len()];
    let mut rest = level.to_vec();
    let columns = left.x().floor() as u32..(right.x().ceil() as u32).min(size.x);
    for x in columns {
        let t = (f64::from(x) + 0.5 - left.x()) / (right.x() - left.x()).max(1.0);
        let foot = PicturePoint::new(f64::from(x) + 0.5, left.y() + t * (right.y() - left.y()));
        let edge = edge_above(camera, ground_height, foot)?.y();
        for y in 0..size.y {
            // The share of the pixel that lies below the edge.
            let below = (f64::from(y) + 1.0 - edge).clamp(0.0, 1.0);
            let cell = y as usize * size.x as usize + x as usize;
            let covered = f64::from(ground.get(x, y));
            values[cell] = (below * covered).round() as u8;
            rest[cell] = rest[cell].min(((1.0 - below) * covered).round() as u8);
        }
    }
    let mask = Mask::new(size, values).ok().filter(|mask| mask.bounds().is_some())?;
    level.copy_from_slice(&rest);
    Some(mask)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::camera::{CameraPose, Intrinsics};

    #[test]
    fn a_quay_s_face_is_cut_from_the_ground_and_stands_at_the_waterline() {
        let size = UVec2::new(400, 300);
        let camera = PinholeCamera {
            intrinsics: Intrinsics { focal_px: 400.0, principal: PicturePoint::new(200.0, 150.0), size },
            pose: CameraPose::from_angles(DVec3::new(0.0, 2.0, 0.0), 0.0, 0.0, 0.0),
        };
        // Ground 1 m above the water from 10 m on: its edge is seen at row 190, the water below it from row 230 on.
        let mask = |rows: std::ops::Range<u32>| {
            let values = (0..size.y)
                .flat_map(|y| (0..size.x).map(move |_| y))
                .map(|y| if rows.contains(&y) { 255 } else { 0 });
            Mask::new(size, values.collect()).expect("the size is right")
        };
        let (banks, level) = banks(&camera, 1.0, &mask(170..230), &mask(230..300));
        let [bank] = banks.as_slice() else { panic!("one wall instead of {}", banks.len()) };
        assert_eq!(
            (bank.mask.get(200, 189), bank.mask.get(200, 190), bank.mask.get(200, 229)),
            (0, 255, 255)
        );
        assert_eq!((level.get(200, 189), level.get(200, 190)), (255, 0));
        let depth = -camera.on_level(bank.plan.contact[0], 0.0).expect("the foot is seen").z;
        assert!((depth - 10.0).abs() < 0.01, "the wall stands at {depth} m instead of 10 m");
    }

    #[test]
    fn ground_without_water_below_it_has_no_bank() {
        let size = UVec2::new(100, 80);
        let camera = PinholeCamera {
            intrinsics: Intrinsics { focal_px: 100.0, principal: PicturePoint::new(50.0, 40.0), size },
            pose: CameraPose::from_angles(DVec3::new(0.0, 2.0, 0.0), 0.0, 0.0, 0.0),
        };
        let whole = Mask::new(size, vec![255; 8000]).expect("the size is right");
        let none = Mask::new(size, vec![0; 8000]).expect("the size is right");
        let (found, level) = banks(&camera, 1.0, &whole, &none);
        assert!(found.is_empty());
        assert_eq!(level, whole);
    }
}
