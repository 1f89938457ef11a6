//! Facts about signals, gusts, clouds and changes; those about the warp of a plant stand in `sway_tests.rs`.

use std::f64::consts::TAU;

use glam::DVec2;

use super::*;
use crate::tour::{Drift, Wind};

const OSCILLATORS: [Oscillator; 4] = [
    Oscillator { frequency_hz: 0.3, damping: 0.1 },
    Oscillator { frequency_hz: 1.2, damping: 0.12 },
    Oscillator { frequency_hz: 2.0, damping: 0.15 },
    Oscillator { frequency_hz: 2.4, damping: 0.13 },
];

fn breeze(speed: f64) -> Wind {
    Wind { speed, gusts: 0.0, ..Wind::default() }
}

/// Energy of a signal at each multiple of its base frequency, from its samples over one loop.
fn energies(signal: &LoopedSignal, count: usize) -> Vec<f64> {
    let samples: Vec<f64> =
        (0..1024).map(|i| signal.at(f64::from(i) / 1024.0 / signal.base_hz()).x).collect();
    (0..count)
        .map(|j| {
            let sum: DVec2 = samples
                .iter()
                .enumerate()
                .map(|(i, &x)| x * DVec2::from_angle(-TAU * (i * j % 1024) as f64 / 1024.0))
                .sum();
            sum.length_squared()
        })
        .collect()
}

#[test]
fn a_plant_moves_most_at_its_damped_resonance() {
    for oscillator in OSCILLATORS {
        // Long enough that the loop's harmonics lie close beside the peak.
        let signal = LoopedSignal::new(oscillator, 40.0 / oscillator.frequency_hz, 7);
        let energies = energies(&signal, 110);
        let most = (1..energies.len()).max_by(|&a, &b| energies[a].total_cmp(&energies[b])).unwrap();
        // The top of the parabola through the three highest.
        let [a, b, c] = [most - 1, most, most + 1].map(|j| energies[j]);
        let found = (most as f64 + 0.5 * (a - c) / (a - 2.0 * b + c)) * signal.base_hz();
        let damped = oscillator.frequency_hz * (1.0 - 2.0 * oscillator.damping.powi(2)).sqrt();
        let off = found / damped - 1.0;
        assert!(off.abs() < 0.02, "peak at {found} Hz, resonance at {damped} Hz: {:.2} % off", 100.0 * off);
        assert!(energies[0] < 1e-12 * b, "a mean lean of {}", energies[0]);
    }
}

#[test]
fn a_signal_has_the_wanted_size() {
    for (i, oscillator) in OSCILLATORS.into_iter().enumerate() {
        for seed in 0..8 {
            let signal = LoopedSignal::new(oscillator, 20.0, 100 * i as u64 + seed);
            let samples: Vec<f64> = (0..4000).map(|i| signal.at(f64::from(i) * 0.005).x).collect();
            let rms = (samples.iter().map(|x| x * x).sum::<f64>() / samples.len() as f64).sqrt();
            let most = samples.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            assert!((rms - 1.0).abs() < 1e-3, "rms {rms} instead of 1");
            assert!((1.7..3.6).contains(&most), "{most} rms at most, about 3 expected");
            assert!(most <= 1.02 * signal.crest(), "{most} is beyond the crest {}", signal.crest());
        }
    }
}

#[test]
fn a_signal_repeats_without_a_seam() {
    for period in [4.0, 20.0, 120.0] {
        let signal = LoopedSignal::new(OSCILLATORS[3], period, 3);
        for seconds in [0.0, 0.3, 3.9] {
            let gap = signal.at(seconds).distance(signal.at(seconds + period));
            assert!(gap < 1e-9, "after {period} s it is {gap} rms off");
        }
    }
}

#[test]
fn a_year_later_the_motion_is_as_smooth() {
    let signal = LoopedSignal::new(OSCILLATORS[3], 20.0, 5);
    let year = 20.0 * (365.25 * 86_400.0_f64 / 20.0).round();
    for i in 0..2000 {
        let seconds = f64::from(i) / 60.0;
        let gap = signal.at(seconds).distance(signal.at(seconds + year));
        // A year's f64 step of 4 ns, at some 20 rms a second.
        assert!(gap < 1e-6, "frame {i} is {gap} rms off a year later");
    }
}

#[test]
fn the_signal_is_its_sum_of_cosines() {
    // The answer of the oscillator itself: far below resonance 1/ω₀², and a quarter turn behind at resonance.
    let oscillator = Oscillator { frequency_hz: 0.5, damping: 0.1 };
    let stiffness = (TAU * 0.5_f64).powi(2);
    let slow = oscillator.response(1e-4) * stiffness;
    assert!(slow.distance(DVec2::X) < 1e-3, "{slow} instead of 1");
    let resonant = oscillator.response(0.5) * stiffness;
    assert!(resonant.distance(DVec2::new(0.0, -5.0)) < 1e-9, "{resonant} instead of −5i");
    // Of a motion that is a sum of e^(iωt), the real part's energy is that of the imaginary part.
    let signal = LoopedSignal::new(oscillator, 20.0, 1);
    let sums = (0..2000).map(|i| signal.at(f64::from(i) * 0.01).powf(2.0)).sum::<DVec2>() / 2000.0;
    assert!((sums - 1.0).abs().max_element() < 1e-6, "mean squares {sums}");
}

#[test]
fn other_seeds_and_names_move_otherwise() {
    let at = |seed| LoopedSignal::new(OSCILLATORS[0], 20.0, seed).at(3.0);
    assert_eq!(at(4), at(4));
    assert!(at(4).distance(at(5)) > 1e-3);
    assert_eq!(seed_of_name("willow", 1), seed_of_name("willow", 1));
    assert_ne!(seed_of_name("willow", 1), seed_of_name("willow", 2));
    assert_ne!(seed_of_name("willow", 1), seed_of_name("alder", 1));
}

#[test]
fn gusts_travel_downwind_and_keep_the_mean() {
    let gusts = Gusts::new(3, 20.0);
    let squares = (0..2000).map(|i| gusts.at(f64::from(i) * 0.01, 12.0, 0.7).powi(2)).sum::<f64>() / 2000.0;
    assert!((squares - 1.0).abs() < 1e-6, "mean square {squares}");
    for i in 0..50 {
        let seconds = f64::from(i) * 0.4;
        // 16 m downwind at 8 m/s: 2 s later.
        let (here, there) = (gusts.at(seconds, 0.0, 0.7), gusts.at(seconds + 2.0, 16.0, 0.7));
        assert!((here - there).abs() < 1e-9, "{here} became {there} on its way");
        assert!((0.0..=2.0).contains(&here));
        assert_eq!(gusts.at(seconds, 5.0, 0.0), 1.0, "without gusts the wind is steady");
    }
}

#[test]
fn the_wind_s_strength_is_zero_in_a_calm_and_bounded_in_a_storm() {
    assert_eq!(strength(0.0), 0.0);
    assert_eq!(strength(f64::NAN), 0.0);
    assert_eq!(strength(-3.0), 0.0);
    assert!((strength(5.0) - 1.0).abs() < 1e-12);
    assert_eq!(strength(1e9), strength(60.0));
    let mut before = 0.0;
    for i in 1..=600 {
        let now = strength(f64::from(i) * 0.1);
        assert!(now > before && now - before < 0.06, "from {before} to {now} within 0.1 m/s");
        before = now;
    }
}

#[test]
fn clouds_start_in_their_place_and_drift_without_a_seam() {
    let drift = Drift { speed: 1.5, direction_deg: 30.0 };
    let [first, second] = cloud_copies(&drift, 20.0, 0.0);
    assert_eq!((first.offset_px, first.weight, second.weight), (DVec2::ZERO, 1.0, 0.0));
    let step = 1.0 / 60.0;
    let mut before = [first, second];
    for i in 1..4000 {
        let now = cloud_copies(&drift, 20.0, f64::from(i) * step);
        assert!((now[0].weight + now[1].weight - 1.0).abs() < 1e-12);
        for (before, now) in before.iter().zip(now) {
            let moved = now.offset_px - before.offset_px;
            let expected = DVec2::new(30_f64.to_radians().cos(), -0.5) * 1.5 * step;
            // Only what is invisible may jump.
            let visible = now.weight.min(before.weight);
            assert!(
                moved.distance(expected) < 1e-9 || visible < 1e-5,
                "moved {moved} px at weight {visible}"
            );
            assert!((now.weight - before.weight).abs() < 0.01, "weight jumped at frame {i}");
        }
        before = now;
    }
}

#[test]
fn without_wind_the_sky_is_the_picture() {
    let drift = drift_of_wind(&breeze(0.0), 1500.0);
    for seconds in [0.0, 3.3, 17.0] {
        let [first, second] = cloud_copies(&drift, 20.0, seconds);
        assert_eq!((first.offset_px, first.weight, second.weight), (DVec2::ZERO, 1.0, 0.0));
    }
    let right = drift_of_wind(&breeze(5.0), 1000.0);
    assert!((0.2..2.0).contains(&right.speed), "{} px/s", right.speed);
    assert!(
        right.direction_deg.abs() < 1e-9,
        "clouds drift to {}° in a wind to the right",
        right.direction_deg
    );
    let away = drift_of_wind(&Wind { direction_deg: 90.0, ..breeze(5.0) }, 1000.0);
    assert!(
        (away.direction_deg + 90.0).abs() < 1e-9,
        "clouds drift to {}° when blown away",
        away.direction_deg
    );
}

#[test]
fn changed_weather_comes_gently_and_wholly() {
    let mut wind = ChangingWeather::steady(Wind { direction_deg: 350.0, ..breeze(5.0) }.into());
    assert!(wind.change(10.0, Weather { waves: 0.0, ..Wind { direction_deg: 10.0, ..breeze(0.0) }.into() }));
    assert_eq!((wind.at(10.0).wind.speed, wind.at(10.0).waves), (5.0, 1.0));
    assert_eq!(wind.at(16.0), wind.target());
    assert_eq!((wind.at(16.0).wind.speed, wind.at(16.0).waves), (0.0, 0.0));
    for i in 0..360 {
        let [before, now] = [i, i + 1].map(|i| wind.at(10.0 + f64::from(i) / 60.0).wind);
        let turn = wrapped_deg(now.direction_deg - before.direction_deg);
        assert!((before.speed - now.speed) < 0.1 && (-1e-9..0.5).contains(&turn), "{before:?} to {now:?}");
    }
    // A slider that is dragged is followed all the while.
    let mut dragged = ChangingWeather::steady(breeze(0.0).into());
    for i in 0..300 {
        dragged.change(f64::from(i) / 60.0, breeze(f64::from(i) / 60.0).into());
    }
    let speed = dragged.at(5.0).wind.speed;
    assert!((3.5..5.0).contains(&speed), "{speed} m/s while 5 are asked for");
    assert!(!dragged.change(5.0, Wind { speed: f64::NAN, ..breeze(299.0 / 60.0) }.into()));
    assert!(dragged.at(30.0).wind.speed.is_finite());
}

#[test]
fn waves_follow_the_winds_direction_slowly_and_wholly() {
    let to = |direction_deg: f64| Wind { direction_deg, ..breeze(5.0) }.into();
    let mut weather = ChangingWeather::steady(to(350.0));
    assert_eq!(weather.waves_direction_deg(1e9), 350.0);
    // On their way the wind turns again, and then only gets stronger.
    weather.change(10.0, to(30.0));
    weather.change(12.0, to(80.0));
    weather.change(14.0, Wind { direction_deg: 80.0, ..breeze(9.0) }.into());
    let mut last = weather.waves_direction_deg(14.0);
    assert!((5.0..45.0).contains(&wrapped_deg(last)), "{last}° after 2 s towards 30° and 2 s towards 80°");
    for i in 1..=24 * 60 {
        let now = weather.waves_direction_deg(14.0 + f64::from(i) / 60.0);
        assert!((0.0..0.35).contains(&wrapped_deg(now - last)), "from {last}° to {now}° in a step");
        last = now;
    }
    assert_eq!(last, 80.0);
}

fn wrapped_deg(angle: f64) -> f64 {
    (angle + 180.0).rem_euclid(360.0) - 180.0
}
