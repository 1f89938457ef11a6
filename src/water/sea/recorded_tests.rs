//! Facts about recorded seas, on frames of a running sine.

use std::f64::consts::TAU;

use glam::UVec2;

use super::*;

/// Meters along x and z.
const AREA: DVec2 = DVec2::new(40.0, 25.0);
/// Waves across the area.
const CYCLES: DVec2 = DVec2::new(3.0, -2.0);
const AMPLITUDE: f64 = 0.3;
const FRAMES_PER_SECOND: f64 = 25.0;
/// In a second and a third the wave runs on by one of its lengths.
const SECONDS: f64 = 4.0 / 3.0;

fn phase(xz: DVec2, seconds: f64) -> f64 {
    TAU * ((CYCLES * xz / AREA).element_sum() - seconds / SECONDS)
}

fn height(xz: DVec2, seconds: f64) -> f64 {
    AMPLITUDE * phase(xz, seconds).cos()
}

fn slope(xz: DVec2, seconds: f64) -> DVec2 {
    -AMPLITUDE * phase(xz, seconds).sin() * TAU * CYCLES / AREA
}

/// What a frame of a map of the water shows, as the documentation says that it lies.
fn frame(size: UVec2, height: impl Fn(DVec2) -> f64) -> Vec<f32> {
    let pixels = (0..size.y).flat_map(|row| (0..size.x).map(move |column| UVec2::new(column, row)));
    pixels
        .map(|pixel| {
            let place = (pixel.as_dvec2() + 0.5) / size.as_dvec2();
            height((place - DVec2::new(0.5, 1.0)) * AREA) as f32
        })
        .collect()
}

/// The running sine for as many whole rounds as fit 100 frames: 4 s.
fn sine(size: UVec2) -> SeaFrames {
    let mut frames = SeaFrames::new(AREA, FRAMES_PER_SECOND);
    for index in 0..100 {
        let seconds = f64::from(index) / FRAMES_PER_SECOND;
        frames.push(size, frame(size, |xz| height(xz, seconds))).unwrap();
    }
    frames
}

fn places() -> impl Iterator<Item = DVec2> {
    (0..300).map(|i| DVec2::new(-57.0 + 0.377 * f64::from(i), 13.0 - 0.291 * f64::from(i)))
}

/// The largest errors of height and slope, over the largest height and slope there are.
fn errors(sea: &SeaSurface, seconds: f64) -> [f64; 2] {
    let steepest = AMPLITUDE * (TAU * CYCLES / AREA).length();
    places().fold([0.0, 0.0], |[worst, worst_slope], xz| {
        let found = sea.sample(xz);
        let off = (f64::from(found.height) - height(xz, seconds)).abs() / AMPLITUDE;
        let slope_off = (found.slope.as_dvec2() - slope(xz, seconds)).length() / steepest;
        [worst.max(off), worst_slope.max(slope_off)]
    })
}

#[test]
fn a_running_sine_is_where_and_when_its_formula_says() {
    // Finer, otherwise shaped and coarser than the tile: 16 pixels a wave.
    let sizes = [(UVec2::new(256, 160), 0.01), (UVec2::new(128, 128), 0.01), (UVec2::new(48, 64), 0.015)];
    for (size, most) in sizes {
        let mut sea = SeaSurface::recorded(sine(size)).unwrap();
        // At frames, between frames, in later rounds, before the start.
        for seconds in [0.0, 1.24, 1.26, 4.0 + 0.52, -0.4] {
            sea.update(seconds, 1.0);
            let [height, slope] = errors(&sea, seconds);
            assert!(height < most && slope < most, "{size} at {seconds} s: {height}, {slope} off");
        }
    }
}

#[test]
fn frames_start_over_to_the_bit_and_fit_loops() {
    let mut sea = SeaSurface::recorded(sine(UVec2::new(64, 40))).unwrap();
    let mut again = sea.clone();
    sea.update(1.25, 1.0);
    again.update(1.25 + 4.0 * 65536.0, 1.0);
    assert!(sea.tiles()[0].texels() == again.tiles()[0].texels(), "it does not repeat after a round");
    // Two rounds of 4 s fit 10 s at 0.8 times their speed, three at 1.2 times.
    for (loop_seconds, haste) in [(10.0, 1.2), (9.0, 8.0 / 9.0)] {
        let mut looped = sea.clone();
        looped.fit_rounds(loop_seconds).unwrap();
        looped.update(1.5, 1.0);
        let [off, _] = errors(&looped, 1.5 * haste);
        assert!(off < 0.015, "in a loop of {loop_seconds} s it is {off} off");
        let first = looped.tiles()[0].texels().to_vec();
        looped.update(1.5 + loop_seconds, 1.0);
        let gap = first
            .iter()
            .zip(looped.tiles()[0].texels())
            .map(|(a, b)| (a[0] - b[0]).abs())
            .fold(0.0, f32::max);
        assert!(gap < 1e-6, "a loop of {loop_seconds} s is {gap} m off its start");
    }
    let error = sea.fit_rounds(1.9).unwrap_err().to_string();
    assert!(error.contains("4.0 s") && error.contains("at least 2.0 s"), "{error}");
}

#[test]
fn waves_scale_it_and_the_wind_does_not() {
    let mut sea = SeaSurface::recorded(sine(UVec2::new(64, 40))).unwrap();
    assert_eq!((sea.gain(0.0), sea.gain(30.0)), (1.0, 1.0));
    let xz = DVec2::new(3.0, -7.0);
    assert_eq!(sea.sample(xz), WaveSample::default(), "it begins flat");
    sea.update(0.7, 1.0);
    let (once, lost) = (sea.sample(xz), *sea.tiles()[0].lost_by_level());
    sea.update(0.7, 2.0);
    let twice = sea.sample(xz);
    assert!((twice.height - 2.0 * once.height).abs() < 1e-6, "{twice:?} {once:?}");
    assert!((twice.slope - 2.0 * once.slope).length() < 1e-6, "{twice:?} {once:?}");
    let again = sea.tiles()[0].lost_by_level()[5].total();
    assert!((again / lost[5].total() - 1.0).abs() < 1e-4, "what levels lose is told for a gain of 1");
    sea.update(0.7, f64::NAN);
    assert_eq!((sea.present_gain(), sea.sample(xz)), (0.0, WaveSample::default()));
    assert!(SeaSurface::recorded(SeaFrames::new(AREA, 25.0)).is_none(), "a sea without frames");
}

#[test]
fn coarse_levels_lose_the_slopes_that_they_do_not_show() {
    let mut sea = SeaSurface::recorded(sine(UVec2::new(128, 80))).unwrap();
    sea.update(0.3, 1.0);
    let lost = sea.tiles()[0].lost_by_level();
    let whole = 0.5 * (AMPLITUDE * (TAU * CYCLES / AREA).length()).powi(2);
    assert_eq!(lost[0].total(), 0.0);
    assert!(lost.windows(2).all(|pair| pair[1].total() >= pair[0].total()), "{lost:?}");
    let last = lost[LEVELS - 1].total();
    assert!((last / whole - 1.0).abs() < 0.01, "{last} instead of {whole}");
}

#[test]
fn potentials_are_those_of_linear_waves() {
    let mut sea = SeaSurface::recorded(sine(UVec2::new(128, 80))).unwrap();
    // Between two frames growth is what it is in their middle.
    let seconds = 0.8 + 0.5 / FRAMES_PER_SECOND;
    sea.update(seconds, 1.0);
    let number = (TAU * CYCLES / AREA).length();
    let largest = AMPLITUDE * TAU / SECONDS / number;
    for xz in places() {
        let found = f64::from(sea.sample(xz).potential);
        let truth = largest * phase(xz, seconds).sin();
        assert!((found - truth).abs() < 0.02 * largest, "{found} instead of {truth} at {xz}");
    }
}

#[test]
fn frames_that_do_not_repeat_have_no_cliff() {
    // A plane that rises by a meter to the right and half a meter to the upper edge.
    let plane = |xz: DVec2| xz.x / AREA.x - 0.5 * xz.y / AREA.y;
    let size = UVec2::new(200, 100);
    let mut frames = SeaFrames::new(AREA, 1.0);
    frames.push(size, frame(size, plane)).unwrap();
    let mut sea = SeaSurface::recorded(frames).unwrap();
    sea.update(0.0, 1.0);
    let height = |xz: DVec2| f64::from(sea.sample(xz).height);
    // In the middle it is the plane.
    for xz in [DVec2::new(0.0, -12.0), DVec2::new(-14.0, -21.0), DVec2::new(14.0, -4.0)] {
        assert!((height(xz) - plane(xz)).abs() < 2e-3, "{} at {xz}", height(xz));
    }
    // At the seam it is level with the other side; the steepest bend brings half a meter down over 5 m.
    let texel = AREA.x / TEXELS as f64;
    let steepest = (0..2 * TEXELS)
        .map(|i| {
            let x = f64::from(i as u32) * texel;
            (height(DVec2::new(x + texel, -12.0)) - height(DVec2::new(x, -12.0))).abs() / texel
        })
        .fold(0.0, f64::max);
    assert!(steepest < 0.2, "it falls by {steepest} m a meter");
    let steepest_slope =
        sea.tiles()[0].texels()[..TEXELS * TEXELS].iter().map(|[_, x, z, _]| x.hypot(*z)).fold(0.0, f32::max);
    assert!(steepest_slope < 0.3, "slopes of {steepest_slope}");
}

#[test]
fn frames_that_are_none_are_refused() {
    let mut frames = SeaFrames::new(AREA, 25.0);
    let size = UVec2::new(16, 10);
    let flat = vec![0.0; 160];
    assert!(matches!(frames.push(size, vec![0.0; 159]), Err(FrameError::Size { count: 159, .. })));
    assert!(matches!(frames.push(UVec2::new(7, 10), vec![0.0; 70]), Err(FrameError::Size { .. })));
    let mut bad = flat.clone();
    bad[77] = f32::NAN;
    assert!(matches!(frames.push(size, bad), Err(FrameError::NoHeight(height)) if height.is_nan()));
    frames.push(size, flat.clone()).unwrap();
    let other = frames.push(UVec2::new(10, 16), flat.clone());
    assert_eq!(other, Err(FrameError::OtherSize { found: UVec2::new(10, 16), first: size }));
    for _ in 1..tour::MOST_FRAMES {
        frames.push(UVec2::new(16, 10), flat.clone()).unwrap();
    }
    assert_eq!(frames.push(size, flat), Err(FrameError::TooMany));
    assert_eq!(frames.count(), 4096);
}
