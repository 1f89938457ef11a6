//! Facts about how plants are bent, and that the shader's text is the twin's.

use glam::{DVec2, Vec2};

use super::*;
use crate::tour::{Sway, SwayKind, Wind};

const KINDS: [(SwayKind, f64); 4] =
    [(SwayKind::Trunk, 14.0), (SwayKind::Branch, 3.0), (SwayKind::Reed, 1.8), (SwayKind::Grass, 0.5)];

fn sway(kind: SwayKind) -> Sway {
    Sway {
        kind,
        root: None,
        tip: None,
        frequency_hz: None,
        damping: None,
        amplitude: None,
        period_seconds: None,
        seed: None,
    }
}

fn wind(speed: f64) -> Wind {
    Wind { speed, gusts: 0.0, ..Wind::default() }
}

fn stand(length: f64) -> Stand {
    let root = DVec2::new(1.5, 0.2);
    Stand { root, tip: root + length * DVec2::new(0.1, 1.0), place: DVec2::new(4.0, -20.0), along: DVec2::X }
}

fn plants(sway: &Sway, length: f64, seed: u64) -> Plants {
    let plant = Plant::new(stand(length), sway, &Wind::default(), seed).unwrap();
    Plants::new(vec![plant], &Wind::default())
}

/// Points over a plant and around it.
fn places(length: f64) -> impl Iterator<Item = Vec2> {
    (0..18 * 26).map(move |i| {
        let (i, j) = (i % 18, i / 18);
        Vec2::new(
            1.5 + (i as f32 / 17.0 - 0.5) * length as f32,
            0.2 + (j as f32 / 20.0 - 0.1) * length as f32,
        )
    })
}

#[test]
fn the_tip_moves_as_much_as_asked_at_5_meters_per_second() {
    for (kind, length) in KINDS {
        for seed in 0..6 {
            let wanted = length * [0.004, 0.01, 0.03, 0.03][KINDS.iter().position(|k| k.0 == kind).unwrap()];
            let mut plants = plants(&sway(kind), length, seed);
            let tip = stand(length).tip.as_vec2();
            let squares: f64 = (0..2000)
                .map(|i| {
                    let moved = plants.update(f64::from(i) * 0.01, &wind(5.0))[0].displacement(tip);
                    // The stem leans by a tenth; sideways is nearly along x.
                    f64::from(moved.dot(Vec2::new(1.0, -0.1).normalize())).powi(2)
                })
                .sum();
            let rms = (squares / 2000.0).sqrt();
            let off = rms / (wanted * 1.01_f64.sqrt()) - 1.0;
            assert!(off.abs() < 0.05, "{kind:?}, seed {seed}: rms {rms} m is {:.1} % off", 100.0 * off);
        }
    }
}

#[test]
fn nothing_moves_at_the_root_or_in_a_calm() {
    for (kind, length) in KINDS {
        let mut plants = plants(&sway(kind), length, 1);
        let blown = plants.update(7.0, &wind(12.0))[0];
        let still = plants.update(7.0, &wind(0.0))[0];
        for place in places(length) {
            assert_eq!(still.displacement(place), Vec2::ZERO);
            let rest = still.rest_point(place);
            assert_eq!(rest.to_array().map(f32::to_bits), place.to_array().map(f32::to_bits));
            let below = place.with_y(0.2 - place.y.abs()) - 0.1 * Vec2::new(0.0, (place.x - 1.5).abs());
            assert_eq!(blown.displacement(below), Vec2::ZERO, "{kind:?} moves at {below}, below its root");
        }
        assert_eq!(blown.displacement(Vec2::new(1.5, 0.2)), Vec2::ZERO);
    }
}

#[test]
fn no_storm_tears_a_plant() {
    let wild = |kind| Sway { amplitude: Some(0.2), ..sway(kind) };
    let storm = Wind { speed: 60.0, gusts: 1.0, ..Wind::default() };
    let mut steepest = 0.0_f32;
    for (kind, length) in KINDS {
        for sway in [sway(kind), wild(kind)] {
            let mut plants = plants(&sway, length, 11);
            for frame in 0..120 {
                let record = plants.update(f64::from(frame) * 0.17, &storm)[0];
                let step = 1e-3 * length as f32;
                for place in places(length) {
                    let here = record.displacement(place);
                    let [across, up] =
                        [Vec2::X, Vec2::Y].map(|way| (record.displacement(place + step * way) - here) / step);
                    // The norm of the gradient, by its columns.
                    let (p, q, r) = (across.length_squared(), up.length_squared(), across.dot(up));
                    let norm = (0.5 * (p + q + ((p - q).powi(2) + 4.0 * r * r).sqrt())).sqrt();
                    steepest = steepest.max(norm);
                    assert!(norm <= 0.4, "{kind:?}: {norm} m/m at {place}, frame {frame}");
                }
            }
        }
    }
    assert!(steepest > 0.2, "the limit is far from reached: {steepest} m/m");
}

#[test]
fn a_rest_point_leads_back_to_where_it_is_seen() {
    // In pixels, for a plant 560 pixels high.
    let mut worst = [0.0_f32; 2];
    for (kind, length) in KINDS {
        let mut plants = plants(&sway(kind), length, 5);
        for frame in 0..60 {
            for (speed, worst) in [5.0, 60.0].into_iter().zip(&mut worst) {
                let record = plants.update(f64::from(frame) * 0.31, &wind(speed))[0];
                for place in places(length) {
                    let rest = record.rest_point(place);
                    let off = (rest + record.displacement(rest)).distance(place) / length as f32 * 560.0;
                    *worst = worst.max(off);
                }
            }
        }
    }
    assert!(worst[0] < 0.05, "{} px off in a breeze", worst[0]);
    assert!(worst[1] < 0.25, "{} px off in a storm", worst[1]);
}

#[test]
fn twice_the_amplitude_is_twice_the_way() {
    let with = |amplitude| Sway { amplitude: Some(amplitude), ..sway(SwayKind::Trunk) };
    let ways = [0.001, 0.002].map(|amplitude| {
        plants(&with(amplitude), 14.0, 2).update(3.0, &wind(5.0))[0].displacement(Vec2::new(2.5, 12.0)).x
    });
    assert!((ways[1] / ways[0] - 2.0).abs() < 0.01, "{} m became {} m", ways[0], ways[1]);
}

#[test]
fn a_change_of_wind_makes_no_jump() {
    for (kind, length) in KINDS {
        let mut plants = plants(&sway(kind), length, 9);
        let place = stand(length).tip.as_vec2();
        let mut weather = ChangingWeather::steady(wind(3.0).into());
        let storm = Wind { speed: 15.0, direction_deg: 130.0, gusts: 0.6, ..Wind::default() };
        assert!(weather.change(5.0, storm.into()));
        let mut previous = plants.update(4.9, &weather.at(4.9).wind)[0].displacement(place);
        for i in 1..600 {
            let seconds = 4.9 + f64::from(i) / 240.0;
            let now = plants.update(seconds, &weather.at(seconds).wind)[0].displacement(place);
            // Some 0.25 lengths at most at some 2.4 Hz.
            let most = 0.25 * length as f32 * 15.0 / 240.0;
            assert!(
                now.distance(previous) < most,
                "{kind:?} jumped by {} at {seconds} s",
                now.distance(previous)
            );
            previous = now;
        }
    }
}

#[test]
fn waves_over_reeds_run_with_the_wind() {
    // A few centimeters downwind the same motion comes later by the phase that the record says.
    let record = |degrees| {
        let blows = Wind { direction_deg: degrees, ..wind(5.0) };
        plants(&sway(SwayKind::Reed), 1.8, 4).update(2.0, &blows)[0].bending.motion.z
    };
    assert!(record(0.0) > 0.1, "{} rad/m along the wind", record(0.0));
    assert!((record(180.0) + record(0.0)).abs() < 1e-6);
    assert!(record(90.0).abs() < 1e-6);

    // What comes by here is what comes by a step downwind somewhat later, not earlier.
    let mut reeds = plants(&sway(SwayKind::Reed), 1.8, 4);
    let step = Vec2::new(0.9, 0.0);
    let later = f64::from(record(0.0) * step.x) / (std::f64::consts::TAU * 1.2);
    let mut at = |seconds: f64, place: Vec2| reeds.update(seconds, &wind(5.0))[0].displacement(place).x;
    let [mut with, mut against] = [0.0; 2];
    for i in 0..400 {
        let (seconds, here) = (f64::from(i) * 0.05, Vec2::new(1.5, 1.8));
        let now = at(seconds, here);
        with += now * at(seconds + later, here + step);
        against += now * at(seconds - later, here + step);
    }
    assert!(with > 1.1 * against, "alike by {with} downwind, by {against} upwind");
}

#[test]
fn a_gust_reaches_plants_downwind_later() {
    let blows = Wind { speed: 3.0, direction_deg: 90.0, gusts: 1.0, ..Wind::default() };
    let gusts = Gusts::new(blows.seed, blows.period_seconds);
    let near = stand(14.0);
    // 24 m into the picture.
    let far = Stand { place: near.place - DVec2::new(0.0, 24.0), ..near };
    let [near, far] =
        [near, far].map(|stand| Plant::new(stand, &sway(SwayKind::Trunk), &Wind::default(), 6).unwrap());
    for i in 0..40 {
        let seconds = f64::from(i) * 0.5;
        let [near, far] = [&near, &far].map(|plant| plant.record(seconds, &blows, &gusts).bending.motion.x);
        let wanted = gusts.at(seconds - 3.0, 20.0, 1.0) / gusts.at(seconds, 20.0, 1.0);
        let found = f64::from(far / near);
        assert!((found / wanted - 1.0).abs() < 1e-3, "{found} instead of {wanted} at {seconds} s");
    }
}

#[test]
fn what_cannot_stand_is_refused() {
    let new = |stand| Plant::new(stand, &sway(SwayKind::Reed), &Wind::default(), 0);
    let good = stand(2.0);
    assert!(matches!(new(Stand { tip: good.root, ..good }), Err(PlantError::TooShort(_))));
    assert!(matches!(new(Stand { place: DVec2::NAN, ..good }), Err(PlantError::NoPlace(_))));
    let odd = Sway {
        frequency_hz: Some(f64::NAN),
        damping: Some(-3.0),
        amplitude: Some(1e9),
        ..sway(SwayKind::Reed)
    };
    let mut plants =
        Plants::new(vec![Plant::new(good, &odd, &Wind::default(), 0).unwrap()], &Wind::default());
    let gale = Wind { speed: f64::INFINITY, direction_deg: f64::NAN, gusts: f64::NAN, ..Wind::default() };
    for seconds in [0.0, f64::NAN, f64::INFINITY, -1e18] {
        let moved = plants.update(seconds, &gale)[0].displacement(Vec2::new(1.6, 1.5));
        assert!(moved.is_finite() && moved.length() < 0.6, "moved {moved} at {seconds} s");
    }
}

#[test]
fn the_shader_reads_the_record_as_it_is_sent() {
    let source = include_str!("../plugin/material/sway.wgsl");
    let plain: String = source.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>().join("\n");
    let module = naga::front::wgsl::parse_str(&plain).expect("the shader should parse");
    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty())
        .validate(&module)
        .expect("the shader should be valid");
    let (_, record) =
        module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some("SwayRecord")).expect("a record");
    let naga::TypeInner::Struct { members, span } = &record.inner else { panic!("not a struct") };
    let found: Vec<(&str, u32)> =
        members.iter().map(|member| (member.name.as_deref().unwrap_or_default(), member.offset)).collect();
    let sent = [
        ("stem", std::mem::offset_of!(SwayRecord, stem) as u32),
        ("size", std::mem::offset_of!(SwayRecord, size) as u32),
        ("bending", std::mem::offset_of!(SwayRecord, bending) as u32),
        ("branches", std::mem::offset_of!(SwayRecord, branches) as u32),
        ("leaves", std::mem::offset_of!(SwayRecord, leaves) as u32),
    ];
    assert_eq!(found, sent);
    assert_eq!(*span as usize, size_of::<SwayRecord>());
    // Constants are the twin's too.
    for (name, value) in [
        ("FORESHORTENING", sway::FORESHORTENING),
        ("ROUNDNESS", sway::ROUNDNESS),
        ("SECOND_SEED", sway::SECOND_SEED),
    ] {
        let written =
            plain.split(&format!("const {name}: f32 = ")).nth(1).and_then(|rest| rest.split(';').next());
        assert_eq!(written.and_then(|number| number.parse().ok()), Some(value), "{name}");
    }
    for function in ["mode_motion", "displacement", "rest_point"] {
        assert!(module.functions.iter().any(|(_, f)| f.name.as_deref() == Some(function)), "no {function}");
    }
}
