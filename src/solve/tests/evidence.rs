//! What each kind of evidence gives, alone and against others.

use glam::{DVec3, UVec2};

use super::Kind;
use super::Picture;
use super::Random;
use super::SIZE;
use crate::picture::Lens;
use crate::picture::PicturePoint;
use crate::solve::AnnotatedPlane;
use crate::solve::Annotations;
use crate::solve::BackgroundHint;
use crate::solve::FocalLength;
use crate::solve::Label;
use crate::solve::Method;
use crate::solve::PairPlane;
use crate::solve::Scale;
use crate::solve::SceneParameters;
use crate::solve::Solution;
use crate::solve::SolveError;
use crate::solve::Support;
use crate::solve::full;
use crate::solve::solve;

fn solved(annotations: &Annotations) -> Solution {
    full::solve(annotations, full::Guesses::Dropped).unwrap()
}

#[test]
fn a_known_focal_length_and_pairs_give_the_horizon() {
    let mut annotations = Picture { click_px: 1.0, ..Picture::new(-5.0, 1.0) }.annotations(12);
    annotations.horizon = None;
    annotations.focal = FocalLength::Known(1500.0);
    let solution = solve(&annotations).unwrap();
    let pitch = solution.parameters.pitch.to_degrees();
    assert!((pitch + 5.0).abs() < 0.4, "pitch is {pitch} deg, not -5");
    assert_eq!(solution.report.parameter("pitch").unwrap().label, Label::Measured);
    annotations.focal = FocalLength::Unknown;
    let solution = solve(&annotations).unwrap();
    let pitch = solution.report.parameter("pitch").unwrap();
    assert_eq!(pitch.label, Label::Weak, "without focal length the horizon is weak: {pitch:?}");
}

#[test]
fn a_horizon_alone_is_enough_and_nothing_is_not() {
    let mut annotations = Picture::new(-4.0, 1.0).annotations(1);
    annotations.pairs.clear();
    annotations.focal = FocalLength::Known(1500.0);
    let solution = solve(&annotations).unwrap();
    let (pitch, roll) = (solution.parameters.pitch.to_degrees(), solution.parameters.roll.to_degrees());
    assert!((pitch + 4.0).abs() < 1e-6 && (roll - 1.0).abs() < 1e-6, "{pitch}, {roll} deg are not -4, 1");
    annotations.focal = FocalLength::Unknown;
    annotations.background = BackgroundHint::FromPairs;
    let report = solve(&annotations).unwrap().report;
    assert_eq!(report.parameter("focal_px").unwrap().label, Label::Assumed);
    assert_eq!(report.parameter("background_distance").unwrap().label, Label::Assumed);
    annotations.horizon = None;
    assert_eq!(solve(&annotations), Err(SolveError::NothingToSolveFrom { found: 0 }));
}

#[test]
fn a_lens_tells_the_focal_length_of_whole_frames_only() {
    let lens = |whole_frame| Some(Lens { focal_35mm: 36.0, whole_frame });
    let size = UVec2::new(3000, 2000);
    let FocalLength::Prior { px, .. } = FocalLength::of_lens(lens(true), size) else {
        panic!("nothing is known of a whole frame");
    };
    assert!((px - 3000.0).abs() < 1e-9, "{px} px");
    assert_eq!(FocalLength::of_lens(lens(false), size), FocalLength::Unknown);
    assert_eq!(FocalLength::of_lens(None, size), FocalLength::Unknown);
}

#[test]
fn a_known_length_sets_the_scale() {
    let picture = Picture { kind: Kind::Standing, ..Picture::new(-5.0, 1.0) };
    let mut annotations = picture.annotations(8);
    let pair = annotations.pairs[2].clone();
    let [left, right] = annotations.planes[2].contact;
    let ends = [left, right].map(|foot| picture.truth.camera(SIZE).on_level(foot, 0.0).unwrap());
    let meters = ends[0].distance(ends[1]);
    annotations.scale = Scale::Length { on: 2, from: left, to: right, meters };
    let solution = solved(&annotations);
    let height = solution.parameters.height;
    assert!((height - 2.0).abs() < 1e-5, "the camera is {height} m high, not 2");
    assert_eq!(solution.report.parameter("height").unwrap().label, Label::Measured);
    assert_eq!(pair.on, PairPlane::Plane(2));
}

#[test]
fn depths_on_water_and_on_a_level_are_those_of_the_ray() {
    let truth = Picture::new(-5.0, 2.0).truth;
    for (point, level) in [(DVec3::new(3.0, 0.0, -25.0), 0.0), (DVec3::new(-8.0, 0.7, -40.0), 0.7)] {
        let seen = truth.camera(SIZE).project(point).unwrap();
        let depth = truth.depth_on_level(seen, level).unwrap();
        assert!((depth + point.z).abs() < 1e-9, "{depth} m is not {} m", -point.z);
    }
    assert_eq!(truth.depth_on_water(PicturePoint::new(800.0, 10.0)), None);
}

#[test]
fn a_horizon_that_is_far_off_gives_way_to_pairs() {
    for seed in 0..20 {
        let mut annotations =
            Picture { click_px: 1.0, pairs: 20, ..Picture::new(-5.0, 1.0) }.annotations(seed);
        annotations.horizon_deviation_px = 2.0;
        annotations.focal = FocalLength::Known(1500.0);
        annotations.horizon.iter_mut().flatten().for_each(|end| end.0.y += 40.0);
        let solution = solve(&annotations).unwrap();
        let pitch = solution.parameters.pitch.to_degrees();
        assert!((pitch + 5.0).abs() < 0.6, "seed {seed}: pitch is {pitch:.2} deg, not -5");
        let kept = solution.report.pairs.iter().filter(|pair| pair.kept).count();
        assert!(kept >= 18, "seed {seed}: {kept} of 20 pairs were kept");
        let said = solution
            .report
            .remarks
            .iter()
            .any(|remark| remark.contains("px below where the reflections put it"));
        assert!(said, "seed {seed}: {:?}", solution.report.remarks);
    }
}

#[test]
fn the_lines_where_the_background_meets_water_and_ground_give_the_ground_s_height() {
    let picture = Picture::new(-5.0, 1.0);
    let camera = picture.truth.camera(SIZE);
    let at = |y: f64| [-20.0, 0.0, 20.0].map(|x| camera.project(DVec3::new(x, y, -80.0)).unwrap()).to_vec();
    let mut annotations = picture.annotations(5);
    annotations.background = BackgroundHint::Contact(at(0.0));
    annotations.ground_contact = at(0.6);
    let report = solved(&annotations).report;
    let ground = report.parameter("ground_height").unwrap();
    assert!((ground.value - 0.6).abs() < 1e-3, "the ground is {} m high, not 0.6", ground.value);
    assert_eq!(ground.label, Label::Measured, "{ground:?}");
    let distance = report.parameter("background_distance").unwrap();
    assert!((distance.value - 80.0).abs() < 0.1, "the background is {} m away, not 80", distance.value);
    // The other way round: the height above the ground gives that above the water.
    annotations.scale = Scale::HeightAboveGround(1.4);
    let height = solved(&annotations).parameters.height;
    assert!((height - 2.0).abs() < 1e-3, "the camera is {height} m above the water, not 2");
}

#[test]
fn bad_annotations_are_named() {
    let good = Picture::new(-4.0, 1.0).annotations(1);
    let mut bad = good.clone();
    bad.pairs[3].on = PairPlane::Plane(7);
    let what = "pair \"pair 3\"".to_owned();
    assert_eq!(solve(&bad), Err(SolveError::UnknownPlane { what, index: 7, planes: 0 }));
    let mut bad = good.clone();
    bad.focal = FocalLength::Known(-1.0);
    let what = "the focal length".to_owned();
    assert_eq!(solve(&bad), Err(SolveError::OutOfRange { what, value: -1.0, must_be: "above 0" }));
    let mut bad = good;
    let end = PicturePoint::new(5.0, 5.0);
    bad.horizon = Some([end, end]);
    assert_eq!(solve(&bad), Err(SolveError::HorizonTooSteep { left: end, right: end }));
}

#[test]
fn clicks_without_sense_give_finite_numbers_or_an_error() {
    for seed in 0..500 {
        let mut random = Random::new(seed);
        let mut annotations = Picture::new(-4.0, 1.0).annotations(1);
        let mut anywhere =
            || PicturePoint::new(random.between(-200.0, 1800.0), random.between(-200.0, 1400.0));
        annotations.horizon = (seed % 3 > 0).then(|| [anywhere(), anywhere()]);
        annotations.planes = [Support::Water, Support::Ground]
            .map(|support| AnnotatedPlane {
                name: "plane".to_owned(),
                support,
                contact: [anywhere(), anywhere()],
            })
            .to_vec();
        annotations.ground_contact = vec![anywhere()];
        annotations.background = if seed % 2 > 0 {
            BackgroundHint::Contact(vec![anywhere(), anywhere()])
        } else {
            BackgroundHint::FromPairs
        };
        let planes = [PairPlane::Free, PairPlane::Plane(0), PairPlane::Plane(1), PairPlane::Background];
        for (index, pair) in annotations.pairs.iter_mut().enumerate() {
            (pair.point, pair.reflection, pair.on) = (anywhere(), anywhere(), planes[index % 4]);
        }
        annotations.principal_deviation_px = if seed % 5 > 0 { 10.0 } else { 0.0 };
        if seed % 7 == 0 {
            annotations.scale = Scale::Length { on: 0, from: anywhere(), to: anywhere(), meters: 3.0 };
        }
        for method in [Method::Full, Method::Paper] {
            annotations.method = method;
            let Ok(solution) = solve(&annotations) else { continue };
            let numbers =
                solution.report.parameters.iter().flat_map(|p| [Some(p.value), p.deviation]).flatten();
            let sane =
                |p: &SceneParameters| p.focal_px > 0.0 && p.height > 0.0 && p.background_distance > 0.0;
            assert!(
                numbers.clone().all(f64::is_finite),
                "seed {seed}, {method:?}: {:?}",
                solution.report.parameters
            );
            assert!(sane(&solution.parameters), "seed {seed}, {method:?}: {:?}", solution.parameters);
            assert!(solution.parameters.ground_height >= 0.0, "seed {seed}: {:?}", solution.parameters);
            let residuals = solution.report.pairs.iter().map(|pair| pair.residual_px);
            assert!(residuals.clone().all(f64::is_finite), "seed {seed}: {:?}", solution.report.pairs);
        }
    }
}
