//! Hints agree with what is known to be true, and disagree with what is not.

use glam::{DVec2, DVec3};

use super::world::{Lake, Wall, frontal};
use super::{GRAY, hills, map_of};
use crate::depth::{Agreement, object_depth, pairs, waterline};
use crate::picture::{Mask, PicturePoint};

#[test]
fn pairs_lie_where_the_truth_puts_them_within_what_they_claim() {
    let lake = hills(-4.0, 1.5);
    let shot = lake.shot();
    let map = map_of(&shot, &lake.camera);
    let found = pairs(&shot.picture, &shot.water, &lake.camera, &map, 200);
    assert!(found.len() >= 40, "only {} pairs", found.len());
    let (mut near, mut within) = (0, 0);
    for pair in &found {
        let pixel = pair.point.y() as usize * 480 + pair.point.x() as usize;
        let ray = lake.camera.ray(pair.point);
        let at = ray.at(shot.distance[pixel] / -ray.direction.z);
        let Some(mirrored) = lake.camera.project(at * DVec3::new(1.0, -1.0, 1.0)) else { continue };
        let off = (pair.reflection.0 - mirrored.0).abs();
        near += usize::from(off.max_element() < 1.0);
        within += usize::from(off.cmplt(2.0 * DVec2::from_array(pair.deviation_px)).all());
    }
    let part = |count: usize| count as f64 / found.len() as f64;
    assert!(part(near) > 0.9, "{:.2} are within a pixel", part(near));
    assert!(part(within) > 0.8, "{:.2} are within two deviations", part(within));
}

#[test]
fn a_wrong_foot_is_found_and_a_right_one_is_not() {
    // A wall of its own before the others: an object.
    let ends = [DVec2::new(-4.0, -30.0), DVec2::new(4.0, -30.0)];
    let hut = Wall { ends, height: 4.0, jagged: 0.0, grain: 1.0, color: [170.0, 90.0, 70.0] };
    let lake = Lake { walls: vec![hut, frontal(120.0, 18.0, 6.0, GRAY)], ..hills(-2.0, 0.0) };
    let shot = lake.shot();
    let map = map_of(&shot, &lake.camera);
    let covered = shot.distance.iter().map(|z| if (z - 30.0).abs() < 0.1 { 255 } else { 0 });
    let mask = Mask::new(shot.picture.size(), covered.collect()).unwrap();
    let feet = ends.map(|end| lake.camera.project(DVec3::new(end.x, 0.0, end.y)).unwrap());
    let at = |depth: f64| object_depth(&map, &mask, feet.map(|foot| (foot, depth)));
    let right = at(30.0);
    assert_eq!(right.agreement, Agreement::Agrees, "{right:?}");
    assert!((right.ratio - 1.0).abs() < 0.02, "{right:?}");
    let wrong = at(60.0);
    assert_eq!(wrong.agreement, Agreement::WrongFoot, "{wrong:?}");
    assert!((wrong.ratio - 0.5).abs() < 0.02, "{wrong:?}");
    let nowhere = object_depth(&map, &mask, feet.map(|foot| (foot, f64::NAN)));
    assert_eq!(nowhere.agreement, Agreement::Unknown);
    let all = Mask::new(shot.picture.size(), shot.water.values().iter().map(|&w| 255 - w).collect()).unwrap();
    let both = object_depth(&map, &all, feet.map(|foot| (foot, 120.0)));
    assert_ne!(both.agreement, Agreement::WrongFoot, "{both:?}");
}

#[test]
fn the_waterline_of_a_frontal_shore_is_level_where_it_stands() {
    for roll in [0.0, 3.0] {
        let lake = Lake { walls: vec![frontal(60.0, 12.0, 4.0, GRAY)], ..hills(-2.0, roll) };
        let shot = lake.shot();
        let map = map_of(&shot, &lake.camera);
        let line = waterline(&map, &shot.water, &lake.camera).expect("most of the shore is known");
        assert!(line.tilt.abs() < 0.2_f64.to_radians(), "{}°", line.tilt.to_degrees());
        let truth = |point: &PicturePoint| {
            let ray = lake.camera.ray(*point);
            let foot =
                lake.camera.project(ray.at(60.0 / -ray.direction.z) * DVec3::new(1.0, 0.0, 1.0)).unwrap();
            point.0.distance(foot.0)
        };
        let mut off: Vec<f64> = line.points.iter().map(truth).collect();
        off.sort_by(f64::total_cmp);
        assert!(off[off.len() / 2] < 0.5, "{} px off", off[off.len() / 2]);
    }
}
