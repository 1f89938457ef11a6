//! Facts of exact and disturbed pictures (notes/algorithms.md §1.6).

use super::Kind;
use super::Picture;
use super::SIZE;
use crate::picture::PicturePoint;
use crate::solve::Annotations;
use crate::solve::FocalLength;
use crate::solve::Label;
use crate::solve::Solution;
use crate::solve::full;
use crate::solve::solve;
use glam::DVec3;
use glam::UVec2;

fn solved(annotations: &Annotations) -> Solution {
    full::solve(annotations, full::Guesses::Dropped).unwrap()
}

#[test]
fn exact_annotations_give_the_exact_camera() {
    for kind in [Kind::Free, Kind::Wall, Kind::Standing] {
        for (pitch, roll) in [(-3.0, 1.0), (-8.0, -2.0), (6.0, -1.5), (-1.0, 0.0)] {
            let found = solved(&Picture { kind, ..Picture::new(pitch, roll) }.annotations(3)).parameters;
            let ratio = found.focal_px / 1500.0;
            let (pitch_found, roll_found) = (found.pitch.to_degrees(), found.roll.to_degrees());
            assert!((ratio - 1.0).abs() < 1e-6, "{pitch}, {roll} deg: f is {} px, not 1500", found.focal_px);
            assert!((pitch_found - pitch).abs() < 1e-6, "pitch is {pitch_found} deg, not {pitch}");
            assert!((roll_found - roll).abs() < 1e-6, "roll is {roll_found} deg, not {roll}");
        }
    }
}

#[test]
fn a_level_picture_stretched_in_depth_is_the_same_picture() {
    // Depths and focal length scaled together leave every pixel where it is, so no solver can tell them apart.
    let picture = Picture::new(0.0, 0.0);
    let mut stretched = picture.truth;
    stretched.focal_px *= 1.3;
    for point in [DVec3::new(-9.0, 7.0, -30.0), DVec3::new(4.0, -1.0, -17.0)] {
        let seen = picture.truth.camera(SIZE).project(point).unwrap();
        let same = stretched.camera(SIZE).project(point * DVec3::new(1.0, 1.0, 1.3)).unwrap();
        assert!(seen.0.distance(same.0) < 1e-9, "{seen} became {same}");
    }
    let mut annotations = picture.annotations(4);
    annotations.focal = FocalLength::Known(1500.0);
    let usual = solved(&annotations);
    annotations.focal = FocalLength::Known(1950.0);
    let other = solved(&annotations);
    for (a, b) in usual.report.pairs.iter().zip(&other.report.pairs) {
        assert!(
            (a.residual_px - b.residual_px).abs() < 1e-6,
            "{} px became {} px",
            a.residual_px,
            b.residual_px
        );
        let ratio = b.depth.unwrap() / a.depth.unwrap();
        assert!((ratio - 1.3).abs() < 1e-6, "the depth scaled by {ratio}, not 1.3");
    }
}

#[test]
fn a_level_picture_says_so() {
    let solution =
        solve(&Picture { click_px: 1.0, horizon_px: 2.0, ..Picture::new(0.0, 0.3) }.annotations(2)).unwrap();
    let focal = solution.report.parameter("focal_px").unwrap();
    assert_eq!(focal.label, Label::Assumed, "{focal:?}");
    assert_eq!(focal.from, ["guess"]);
    assert!(
        solution.report.remarks.iter().any(|remark| remark.contains("looks level")),
        "{:?}",
        solution.report.remarks
    );
}

#[test]
fn exchanging_points_and_reflections_changes_nothing() {
    let mut annotations =
        Picture { click_px: 1.0, horizon_px: 2.0, ..Picture::new(-5.0, 1.0) }.annotations(6);
    let before = solved(&annotations).parameters;
    for pair in &mut annotations.pairs {
        std::mem::swap(&mut pair.point, &mut pair.reflection);
    }
    let after = solved(&annotations).parameters;
    assert!(
        (after.focal_px - before.focal_px).abs() < 1e-4,
        "{} px became {} px",
        before.focal_px,
        after.focal_px
    );
    assert!((after.pitch - before.pitch).abs() < 1e-8, "{} became {}", before.pitch, after.pitch);
}

#[test]
fn a_fifth_of_gross_outliers_is_named_and_moves_nothing() {
    // 20 pairs are tried two by two, 40 are sampled.
    for (pairs, seed) in [20, 40].into_iter().flat_map(|pairs| (0..20).map(move |seed| (pairs, seed))) {
        let picture = Picture { click_px: 1.0, horizon_px: 2.0, pairs, ..Picture::new(-5.0, 0.7) };
        let mut annotations = picture.annotations(seed);
        let clean = solved(&annotations);
        for (index, pair) in annotations.pairs.iter_mut().step_by(5).enumerate() {
            pair.reflection.0.x += [60.0, -45.0, 80.0, 50.0][index % 4];
        }
        let solution = solved(&annotations);
        let deviation = clean.report.parameter("focal_px").unwrap().deviation.unwrap();
        let moved = solution.parameters.focal_px - clean.parameters.focal_px;
        assert!(
            moved.abs() < 2.0 * deviation,
            "seed {seed}: f moved by {moved:.1} px, deviation {deviation:.1} px"
        );
        for (index, pair) in solution.report.pairs.iter().enumerate().step_by(5) {
            let remark = pair.remark.as_deref().unwrap_or("");
            assert!(!pair.kept && remark.contains(" px"), "seed {seed}, pair {index}: {pair:?}");
        }
        let (kept, good) = (solution.report.pairs.iter().filter(|pair| pair.kept).count(), pairs * 4 / 5);
        assert!(kept + 1 >= good, "seed {seed}: only {kept} of {good} good pairs were kept");
    }
}

#[test]
fn a_reflection_of_the_wrong_length_is_named_where_a_plane_shows_it() {
    let picture = Picture { click_px: 1.0, horizon_px: 2.0, kind: Kind::Standing, ..Picture::new(-5.0, 0.7) };
    for seed in 0..20 {
        let mut annotations = picture.annotations(seed);
        annotations.pairs[4].reflection.0.y += 120.0;
        let report = solved(&annotations).report;
        let remark = report.pairs[4].remark.as_deref().unwrap_or("");
        let off = report.pairs[4].residual_px;
        assert!(!report.pairs[4].kept && remark.contains(" px"), "seed {seed}: {:?}", report.pairs[4]);
        assert!((off - 120.0).abs() < 15.0, "seed {seed}: moved by 120 px, {off:.0} px are reported");
        let kept = report.pairs.iter().filter(|pair| pair.kept).count();
        assert!(kept >= 8, "seed {seed}: {kept} of 9 good pairs were kept");
    }
}

#[test]
fn a_picture_extended_to_one_side_has_the_same_camera() {
    let mut annotations =
        Picture { click_px: 1.0, horizon_px: 2.0, ..Picture::new(-5.0, 1.0) }.annotations(9);
    let before = solved(&annotations).parameters;
    let shift = glam::DVec2::new(300.0, 120.0);
    annotations.size += UVec2::new(300, 120);
    let mut move_all = |point: &mut PicturePoint| point.0 += shift;
    move_all(&mut annotations.principal);
    annotations.horizon.iter_mut().flatten().for_each(&mut move_all);
    annotations.pairs.iter_mut().for_each(|pair| {
        move_all(&mut pair.point);
        move_all(&mut pair.reflection);
    });
    let after = solved(&annotations).parameters;
    assert!(
        (after.focal_px - before.focal_px).abs() < 1e-4,
        "f {} became {} px",
        before.focal_px,
        after.focal_px
    );
    let center = after.principal.0 - before.principal.0;
    assert!(center.distance(shift) < 1e-6, "the principal point moved by {center}, not {shift}");
}

#[test]
fn the_paper_s_frame_and_ours_give_the_same_pixels() {
    // Paper: z ahead, pitch θ > 0 looks down; up is (sin φ cos θ, cos φ cos θ, −sin θ) in its camera frame.
    let (pitch, roll) = (-0.12_f64, 0.04_f64);
    let truth = Picture::new(pitch.to_degrees(), roll.to_degrees()).truth;
    let theta = -pitch;
    let up = DVec3::new(roll.sin() * theta.cos(), roll.cos() * theta.cos(), -theta.sin());
    let ahead = (DVec3::Z - up.z * up).normalize();
    // The frame is left-handed: right = up × ahead by the component formula.
    let right = up.cross(ahead);
    let mut random = super::Random::new(11);
    for _ in 0..1000 {
        let p =
            DVec3::new(random.between(-20.0, 20.0), random.between(-2.0, 20.0), random.between(15.0, 90.0));
        let in_camera = right * p.x + up * p.y + ahead * p.z;
        let theirs = [800.0 + 1500.0 * in_camera.x / in_camera.z, 600.0 - 1500.0 * in_camera.y / in_camera.z];
        let ours = truth.camera(SIZE).project(DVec3::new(p.x, p.y + truth.height, -p.z)).unwrap();
        let off = ours.0.distance(theirs.into());
        assert!(off < 1e-8, "{ours} is {off} px from {theirs:?}");
    }
}
