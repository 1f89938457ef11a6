//! Two rendered worlds whose cameras are known: a level one of flat cut-outs, and one of real bodies.
//!
//! Points are those a person would mark; they were computed from the worlds, so they are exact.

use glam::UVec2;

use crate::picture::PicturePoint;
use crate::solve::AnnotatedPair;
use crate::solve::AnnotatedPlane;
use crate::solve::Annotations;
use crate::solve::BackgroundHint;
use crate::solve::FocalLength;
use crate::solve::Label;
use crate::solve::Method;
use crate::solve::PairPlane;
use crate::solve::Scale;
use crate::solve::Support;
use crate::solve::solve;

/// x, y of a point, x, y of its reflection, index of its plane, depth in meters.
type Pair = ([f64; 4], Option<usize>, f64);
/// Name, whether it stands in water, left and right foot.
type Plane = (&'static str, bool, [f64; 4]);

const A1_PLANES: [Plane; 4] = [
    ("house", false, [693.3333, 291.3333, 810.6667, 291.3333]),
    ("tree", false, [35.5556, 295.3968, 226.0317, 295.3968]),
    ("rock", true, [684.4444, 358.8889, 826.6667, 358.8889]),
    ("boat", true, [320.0000, 403.3333, 560.0000, 403.3333]),
];

const A1_PAIRS: [Pair; 12] = [
    ([702.6374, 253.4622, 702.6374, 329.2045], Some(0), 75.000),
    ([802.2337, 268.0542, 802.2337, 314.6125], Some(0), 75.000),
    ([84.7150, 95.2712, 84.7150, 495.5224], Some(1), 63.000),
    ([199.4967, 120.7739, 199.4967, 470.0197], Some(1), 63.000),
    ([751.9599, 300.6556, 751.9599, 417.1222], Some(2), 18.000),
    ([800.1617, 319.2203, 800.1617, 398.5574], Some(2), 18.000),
    ([470.4410, 294.3933, 470.4410, 512.2734], Some(3), 12.000),
    ([327.6172, 358.3590, 327.6172, 448.3077], Some(3), 12.000),
    ([596.1649, 237.2820, 596.1649, 329.3847], None, 120.000),
    ([142.2528, 249.5334, 142.2528, 317.1333], None, 120.000),
    ([833.4106, 141.4592, 833.4106, 425.2075], None, 120.000),
    ([669.7084, 128.2228, 669.7084, 438.4438], None, 120.000),
];

const B1_PLANES: [Plane; 3] = [
    ("rowing boat", true, [428.0096, 371.4203, 660.5223, 371.4203]),
    ("headland conifers", false, [-22.2469, 271.2902, 178.6519, 271.2902]),
    ("rocks in water", true, [721.1649, 316.9061, 846.9900, 316.9061]),
];

const B1_PAIRS: [Pair; 12] = [
    ([944.4205, 6.0570, 935.2221, 476.3648], None, 672.287),
    ([36.5582, 165.2431, 39.9785, 347.1633], None, 97.223),
    ([508.3285, 358.9630, 508.2735, 404.3884], Some(0), 10.468),
    ([288.0187, 152.9621, 289.5653, 343.0734], None, 209.935),
    ([165.0420, 264.4493, 165.7034, 313.7721], Some(1), 30.872),
    ([764.4266, 309.0479, 764.1072, 335.3684], Some(2), 18.215),
    ([613.1932, 71.4820, 611.2744, 412.6175], None, 768.709),
    ([434.2706, 126.3183, 434.7642, 381.3588], None, 112.184),
    ([637.5027, 356.7846, 637.2881, 388.6480], Some(0), 11.187),
    ([905.5986, 248.9038, 905.3069, 265.0162], None, 94.681),
    ([129.7080, 47.8931, 136.7586, 524.9987], Some(1), 31.045),
    ([814.2786, 304.5275, 813.8551, 334.2367], Some(2), 18.877),
];

fn annotations(planes: &[Plane], pairs: &[Pair], horizon_y: f64, height: f64) -> Annotations {
    let size = UVec2::new(960, 540);
    let plane = |&(name, in_water, [xl, yl, xr, yr]): &Plane| AnnotatedPlane {
        name: name.to_owned(),
        support: if in_water { Support::Water } else { Support::Ground },
        contact: [PicturePoint::new(xl, yl), PicturePoint::new(xr, yr)],
    };
    let pair = |(index, &([x, y, xr, yr], on, _)): (usize, &Pair)| {
        let on = on.map_or(PairPlane::Free, PairPlane::Plane);
        AnnotatedPair::new(format!("pair {index}"), PicturePoint::new(x, y), PicturePoint::new(xr, yr), on)
    };
    Annotations {
        size,
        uncropped_size: size,
        principal: PicturePoint::new(480.0, 270.0),
        principal_deviation_px: Annotations::PRINCIPAL_DEVIATION * 960.0,
        horizon: Some([PicturePoint::new(0.0, horizon_y), PicturePoint::new(960.0, horizon_y)]),
        horizon_deviation_px: Annotations::HORIZON_DEVIATION_PX,
        focal: FocalLength::Unknown,
        scale: Scale::HeightAboveWater { meters: height, assumed: false },
        planes: planes.iter().map(plane).collect(),
        background: BackgroundHint::FromPairs,
        ground_height: None,
        ground_contact: Vec::new(),
        pairs: pairs.iter().enumerate().map(pair).collect(),
        method: Method::Full,
    }
}

fn a1() -> Annotations {
    annotations(&A1_PLANES, &A1_PAIRS, 270.0, 2.0)
}

fn b1() -> Annotations {
    Annotations { focal: FocalLength::Known(820.0), ..annotations(&B1_PLANES, &B1_PAIRS, 241.365, 1.8) }
}

#[test]
fn a_level_world_comes_out_level_at_its_distances() {
    let solution = solve(&Annotations { focal: FocalLength::Known(800.0), ..a1() }).unwrap();
    let found = solution.parameters;
    assert!(found.pitch.to_degrees().abs() < 0.01, "pitch is {} deg, not 0", found.pitch.to_degrees());
    assert!(
        (found.background_distance - 120.0).abs() < 1.2,
        "the background is at {} m",
        found.background_distance
    );
    assert!(
        found.ground_height.abs() < 0.05,
        "the ground is {} m above the water, not 0",
        found.ground_height
    );
    assert!(solution.report.pairs.iter().all(|pair| pair.kept), "{:?}", solution.report.pairs);
    let unknown = solve(&a1()).unwrap();
    assert_eq!(unknown.report.parameter("focal_px").unwrap().label, Label::Assumed);
}

#[test]
fn a_painter_s_liberties_are_named_and_the_rest_is_kept() {
    for (focal, horizon_shift) in
        [(FocalLength::Unknown, 10.8), (FocalLength::Unknown, -10.8), (FocalLength::Known(800.0), 10.8)]
    {
        let mut painted = Annotations { focal, ..a1() };
        for end in painted.horizon.iter_mut().flatten() {
            end.0.y += horizon_shift;
        }
        // The boat's reflections: a tenth too short, and 5 px to the side.
        for pair in painted.pairs.iter_mut().filter(|pair| pair.on == PairPlane::Plane(3)) {
            pair.reflection.0.y = 403.3333 + 0.9 * (pair.reflection.0.y - 403.3333);
            pair.reflection.0.x += 5.0;
        }
        painted.pairs.remove(9);
        let report = solve(&painted).unwrap().report;
        let (mut unaltered, mut kept) = (0, 0);
        for (pair, judged) in painted.pairs.iter().zip(&report.pairs) {
            if pair.on == PairPlane::Plane(3) {
                let remark = judged.remark.as_deref().unwrap_or("no remark");
                assert!(!judged.kept && remark.contains(" px"), "{} was moved: {remark}", judged.name);
                assert!(
                    (judged.sideways_px - 5.0).abs() < 1.5,
                    "moved by 5 px, {} px are reported",
                    judged.sideways_px
                );
            } else {
                unaltered += 1;
                kept += usize::from(judged.kept);
            }
        }
        assert!(
            10 * kept >= 9 * unaltered,
            "{kept} of {unaltered} unaltered pairs were kept: {:?}",
            report.pairs
        );
    }
}

#[test]
fn real_bodies_are_kept_and_do_not_bend_the_camera() {
    let solution = solve(&b1()).unwrap();
    let pitch = solution.parameters.pitch.to_degrees();
    assert!((pitch + 2.0).abs() < 0.1, "pitch is {pitch} deg, not -2");
    for (judged, &(_, on, depth)) in solution.report.pairs.iter().zip(&B1_PAIRS) {
        assert!(judged.kept, "{judged:?} was left out");
        if on.is_none() {
            let found = judged.depth.unwrap();
            assert!((found / depth - 1.0).abs() < 0.05, "{}: {found:.1} m, not {depth:.1} m", judged.name);
        }
    }
    let ground = solution.parameters.ground_height;
    assert!((ground - (1.8 - 1.1314)).abs() < 0.1, "the ground is {ground:.2} m above the water, not 0.67 m");
    // Without a marked horizon the pairs alone place it.
    let solution = solve(&Annotations { horizon: None, ..b1() }).unwrap();
    let pitch = solution.parameters.pitch.to_degrees();
    assert!((pitch + 2.0).abs() < 0.1, "pitch is {pitch} deg, not -2");
}

#[test]
#[expect(clippy::print_stderr, reason = "shown by `cargo test -- --nocapture` for the record")]
fn solving_repeats_to_the_bit() {
    let first = solve(&b1()).unwrap();
    let started = std::time::Instant::now();
    for _ in 0..200 {
        assert_eq!(solve(&b1()).unwrap(), first);
    }
    eprintln!("{:?} per solution of B1, 12 pairs", started.elapsed() / 200);
    let started = std::time::Instant::now();
    for _ in 0..200 {
        assert_eq!(solve(&a1()).unwrap(), solve(&a1()).unwrap());
    }
    eprintln!("{:?} per solution of A1, 12 pairs", started.elapsed() / 400);
}
