//! The sea has the height, slope and loop that its spectrum asks for.

use std::f64::consts::TAU;

use super::super::GRAVITY;
use super::spectrum::Spectrum;
use super::*;
use crate::tour::{Jonswap, Octaves};

const SEEDS: [u64; 3] = [0, 7, 1_000_003];

pub(super) fn wind(speed: f64, seed: u64) -> Wind {
    Wind { speed, seed, direction_deg: 30.0, ..Wind::default() }
}

fn octaves(octaves: Octaves, wind: &Wind) -> SeaSurface {
    SeaSurface::new(&tour::Sea::<()>::Octaves(octaves), wind).unwrap()
}

fn jonswap(jonswap: Jonswap, wind: &Wind) -> SeaSurface {
    SeaSurface::new(&tour::Sea::<()>::Jonswap(jonswap), wind).unwrap()
}

pub(super) fn both(wind: &Wind) -> [SeaSurface; 2] {
    [octaves(Octaves::default(), wind), jonswap(Jonswap::default(), wind)]
}

/// Mean square of the heights and of the whole slopes, summed over both tiles.
pub(super) fn measured(sea: &SeaSurface) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for texel in sea.tiles().iter().flat_map(|tile| &tile.texels()[..TEXELS * TEXELS]) {
        let [height, x, z, _] = texel.map(f64::from);
        sums[0] += height * height;
        sums[1] += x * x + z * z;
    }
    sums.map(|sum| sum / (TEXELS * TEXELS) as f64)
}

#[test]
fn tiles_show_the_sum_of_their_waves() {
    for mut sea in both(&wind(4.0, 3)) {
        for seconds in [0.0, 3.21, 19.9] {
            sea.update(seconds, 1.0);
            // Where the two tiles have texels in common: at the origin. Elsewhere one of them is interpolated.
            let found = sea.sample(DVec2::ZERO);
            let truth = sea.waves().unwrap().exact(DVec2::ZERO, seconds);
            assert!((found.height - truth.height).abs() < 1e-6, "{found:?} {truth:?}");
            assert!((found.slope - truth.slope).length() < 1e-5, "{found:?} {truth:?}");
            assert!((found.displacement - truth.displacement).length() < 1e-6, "{found:?} {truth:?}");
            assert!((found.potential - truth.potential).abs() < 1e-6, "{found:?} {truth:?}");
        }
    }
}

#[test]
fn the_large_tile_alone_is_exact_at_every_texel() {
    let wind = wind(4.0, 5);
    // Three octaves fill the large tile and leave the small one empty.
    let mut sea = octaves(Octaves { octaves: 3, ..Octaves::default() }, &wind);
    sea.update(7.7, 1.0);
    let tile = &sea.tiles()[0];
    for (column, row) in [(0, 0), (1, 0), (0, 1), (37, 90), (127, 127)] {
        let xz = DVec2::new(column as f64, row as f64) * tile.size() / TEXELS as f64;
        let truth = sea.waves().unwrap().exact(xz, 7.7);
        let [height, x, z, _] = tile.texels()[row * TEXELS + column];
        assert!((height - truth.height).abs() < 1e-6, "{column} {row}: {height} {truth:?}");
        assert!((Vec2::new(x, z) - truth.slope).length() < 1e-5, "{column} {row}: {x} {z} {truth:?}");
        // One tile size farther, on either side, it is the same.
        let far = sea.sample(xz - DVec2::new(3.0, -5.0) * tile.size());
        assert!((far.height - truth.height).abs() < 1e-5, "{column} {row}: {far:?}");
    }
}

#[test]
fn slopes_are_those_of_the_heights() {
    for sea in both(&wind(4.0, 9)) {
        let xz = DVec2::new(12.3, -45.6);
        let step = 2e-3;
        let height =
            |dx: f64, dz: f64| f64::from(sea.waves().unwrap().exact(xz + DVec2::new(dx, dz), 2.0).height);
        let x = (height(step, 0.0) - height(-step, 0.0)) / (2.0 * step);
        let z = (height(0.0, step) - height(0.0, -step)) / (2.0 * step);
        let slope = sea.waves().unwrap().exact(xz, 2.0).slope.as_dvec2();
        assert!((slope - DVec2::new(x, z)).length() < 1e-3, "{slope} instead of {x}, {z}");
    }
}

#[test]
fn potentials_fall_where_the_water_stands_high() {
    for sea in both(&wind(4.0, 9)) {
        let xz = DVec2::new(2.3, 5.6);
        let step = 1e-3;
        let potential = |seconds: f64| f64::from(sea.waves().unwrap().exact(xz, seconds).potential);
        let rate = (potential(3.0 + step) - potential(3.0 - step)) / (2.0 * step);
        let truth = -GRAVITY * f64::from(sea.waves().unwrap().exact(xz, 3.0).height);
        // Surface tension adds to gravity, most in the shortest waves.
        assert!((rate - truth).abs() < 0.01, "{rate} instead of {truth}");
    }
}

#[test]
fn significant_height_is_the_one_asked_for() {
    for seed in SEEDS {
        for seconds in [0.0, 6.5] {
            let wind = wind(5.0, seed);
            let seas = [
                octaves(Octaves { max_height: Some(0.3), ..Octaves::default() }, &wind),
                jonswap(Jonswap { max_height: Some(0.3), ..Jonswap::default() }, &wind),
            ];
            for mut sea in seas {
                sea.update(seconds, 1.0);
                let height = 4.0 * measured(&sea)[0].sqrt();
                assert!((height / 0.3 - 1.0).abs() < 0.03, "seed {seed}, {seconds} s: {height} m");
            }
        }
    }
}

#[test]
fn slopes_are_the_spectrums_integral() {
    for (depth, spreading) in [(20.0, 4.0), (0.4, 12.0)] {
        let (height, peak_period) = (0.04, 1.2);
        let options = Jonswap {
            max_height: Some(height),
            peak_period_seconds: Some(peak_period),
            depth,
            spreading,
            ..Jonswap::default()
        };
        let mut sea = jonswap(options, &wind(4.0, 11));
        sea.update(1.5, 1.0);
        let [m0, slope] = measured(&sea);
        // Over frequencies, whereas the sea was made from wave vectors.
        let spectrum = Spectrum::new(peak_period, depth);
        let bands = waves::bands([sea.tiles()[0].size().x, sea.tiles()[1].size().x]);
        let (low, high): (f64, f64) = (bands[0][0], bands[1][1]);
        let (mut height_sum, mut slope_sum) = (0.0, 0.0);
        let steps = 20_000;
        for step in 0..steps {
            let k = |step: f64| low * (high / low).powf(step / f64::from(steps));
            let omega = |k: f64| super::super::angular_frequency(k, depth);
            let here = k(f64::from(step) + 0.5);
            let width = omega(k(f64::from(step) + 1.0)) - omega(k(f64::from(step)));
            let energy = spectrum.over_frequency(omega(here)) * width;
            height_sum += energy;
            slope_sum += here * here * energy;
        }
        let truth = (slope_sum / height_sum).sqrt() * height / 4.0;
        let ratio = slope.sqrt() / truth;
        assert!((ratio - 1.0).abs() < 0.03, "depth {depth}: rms slope {} instead of {truth}", slope.sqrt());
        let ratio = 4.0 * m0.sqrt() / height;
        assert!((ratio - 1.0).abs() < 0.03, "depth {depth}: {ratio} of the height");
    }
}

#[test]
fn a_calm_lake_has_a_calm_lakes_numbers() {
    for speed in [3.0, 4.0, 5.0] {
        for sea in both(&wind(speed, 1)) {
            let height = sea.waves().unwrap().significant_height();
            let slope = sea.waves().unwrap().slope_covariance().total().sqrt();
            assert!((0.01..=0.1).contains(&height), "{speed} m/s: {height} m");
            assert!((0.02..=0.08).contains(&slope), "{speed} m/s: rms slope {slope}");
        }
        let (_, period) = fetch::height_and_period(speed, None, None, 20.0);
        assert!((0.6..=1.5).contains(&period), "{speed} m/s: {period} s");
    }
}

#[test]
fn given_the_numbers_that_the_wind_would_choose_the_sea_is_the_same() {
    for wind in [wind(4.0, 0), wind(0.0, 1), wind(12.0, 2)] {
        let (height, length) = fetch::of_octaves(&Octaves::default(), &wind);
        let own = Octaves { max_height: Some(height), wavelength: Some(length), ..Octaves::default() };
        let (same_height, period) = fetch::of_jonswap(&Jonswap::default(), &wind);
        let peaked = Jonswap {
            max_height: Some(same_height),
            peak_period_seconds: Some(period),
            ..Jonswap::default()
        };
        assert!(height > 0.0 && (height - same_height).abs() < 1e-12, "{height} {same_height}");
        for (usual, own) in both(&wind).into_iter().zip([octaves(own, &wind), jonswap(peaked, &wind)]) {
            let [usual, own] =
                [&usual, &own].map(|sea| sea.waves().unwrap().exact(DVec2::new(3.0, -8.0), 1.7));
            assert!((usual.height - own.height).abs() < 1e-6, "{usual:?} {own:?}");
        }
        // A wavelength alone fits the height to it: 0.035 of it at most.
        let short = Octaves { wavelength: Some(0.5), ..Octaves::default() };
        let (height, length) = fetch::of_octaves(&short, &wind);
        assert!(length == 0.5 && height <= 0.0175 + 1e-9, "{height} {length}");
    }
}

#[test]
fn the_sea_repeats_without_a_gap() {
    for mut sea in both(&wind(4.0, 2)) {
        let period = sea.waves().unwrap().period();
        for seconds in [0.0, 4.44] {
            let heights = |sea: &SeaSurface| -> Vec<f32> {
                sea.tiles().iter().flat_map(|tile| tile.texels().iter().map(|texel| texel[0])).collect()
            };
            sea.update(seconds, 1.0);
            let first = heights(&sea);
            for loops in [-1.0, 1.0, 1_577_880.0] {
                sea.update(seconds + loops * period, 1.0);
                let gap = heights(&sea).iter().zip(&first).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
                assert!(gap < 1e-6, "{loops} loops later: {gap} m");
            }
        }
    }
}

#[test]
fn a_years_old_sea_moves_as_smoothly_as_a_new_one() {
    let year = 31_557_600.0;
    let xz = DVec2::new(3.0, -8.0);
    for mut sea in both(&wind(4.0, 2)) {
        let mut roughest = |start: f64| -> f32 {
            let heights: Vec<f32> = (0..120)
                .map(|frame| {
                    sea.update(start + f64::from(frame) / 60.0, 1.0);
                    sea.sample(xz).height
                })
                .collect();
            heights.windows(3).map(|h| (h[0] - 2.0 * h[1] + h[2]).abs()).fold(0.0, f32::max)
        };
        let (young, old) = (roughest(0.0), roughest(year));
        assert!((old - young).abs() < 1e-6, "second differences up to {old} m instead of {young} m");
    }
}

#[test]
fn wind_scales_heights_and_leaves_phases() {
    for mut sea in both(&wind(4.0, 2)) {
        assert_eq!(sea.gain(0.0), 0.0);
        assert_eq!(sea.gain(f64::NAN), 0.0);
        assert_eq!(sea.gain(-3.0), 0.0);
        assert!((sea.gain(4.0) - 1.0).abs() < 1e-12);
        assert!(sea.gain(60.0) <= (BREAKING / sea.waves().unwrap().slope_covariance().total()).sqrt());
        sea.update(5.0, 1.0);
        let full = sea.tiles()[0].texels().to_vec();
        sea.update(5.0, 0.25);
        for (quarter, full) in sea.tiles()[0].texels().iter().zip(&full) {
            assert!((4.0 * quarter[0] - full[0]).abs() < 1e-6, "{quarter:?} {full:?}");
        }
        for gain in [0.0, f64::NAN, -1.0] {
            sea.update(6.0, 0.5);
            sea.update(6.0, gain);
            assert!(sea.tiles().iter().all(|tile| tile.texels().iter().all(|texel| *texel == [0.0; 4])));
            assert_eq!(sea.sample(DVec2::new(1.0, 2.0)), WaveSample::default());
        }
    }
}

/// Where the waves run on the whole: for one that runs along c, `η_t = −c·∇η`.
pub(super) fn run(sea: &mut SeaSurface) -> Vec2 {
    let step = 0.01;
    sea.update(3.0 - step, 1.0);
    let before = sea.tiles().clone();
    sea.update(3.0 + step, 1.0);
    let texels = before
        .iter()
        .zip(sea.tiles())
        .flat_map(|(before, after)| before.texels().iter().zip(after.texels()).take(TEXELS * TEXELS));
    -texels.map(|(a, b)| (b[0] - a[0]) * Vec2::new(a[1] + b[1], a[2] + b[2])).sum::<Vec2>()
}

#[test]
fn waves_run_with_the_wind() {
    for (degrees, along) in [(0.0, Vec2::X), (90.0, Vec2::NEG_Y), (200.0, Vec2::new(-0.940, 0.342))] {
        let wind = Wind { direction_deg: degrees, ..wind(4.0, 2) };
        for mut sea in both(&wind) {
            let off = run(&mut sea).angle_to(along).to_degrees();
            assert!(off.abs() < 10.0, "{off}° from {degrees}°");
        }
    }
}

#[test]
fn what_averaging_takes_from_slopes_is_known() {
    for mut sea in both(&wind(4.0, 2)) {
        sea.update(1.0, 1.0);
        let present = |tile: &SeaTile, level: usize| -> [f64; 2] {
            let start: usize = (0..level).map(|level| (TEXELS >> level).pow(2)).sum();
            let count = (TEXELS >> level).pow(2);
            let sum = tile.texels()[start..start + count].iter().fold([0.0; 2], |sum, texel| {
                [sum[0] + f64::from(texel[1]).powi(2), sum[1] + f64::from(texel[2]).powi(2)]
            });
            sum.map(|sum| sum / count as f64)
        };
        for tile in sea.tiles() {
            let whole = present(tile, 0);
            for level in 1..LEVELS {
                let left = present(tile, level);
                let lost = tile.lost_by_level()[level];
                let total = whole[0] + whole[1];
                assert!((whole[0] - left[0] - lost.xx).abs() < 0.03 * total, "level {level}: {lost:?}");
                assert!((whole[1] - left[1] - lost.zz).abs() < 0.03 * total, "level {level}: {lost:?}");
            }
        }
        let whole = sea.waves().unwrap().slope_covariance().total();
        let hidden = sea.hidden_covariance().total();
        assert!(
            (sea.waves().unwrap().unresolved_covariance(DVec2::ZERO).total() - hidden).abs() < 1e-9 * whole
        );
        let mut last = hidden;
        for footprint in [0.02, 0.1, 0.5, 2.0, 50.0] {
            let now =
                sea.waves().unwrap().unresolved_covariance(DVec2::new(0.1 * footprint, footprint)).total();
            assert!(now >= last && now <= whole, "{footprint} m: {now} after {last}");
            last = now;
        }
        assert!(last > 0.95 * whole);
    }
}

#[test]
fn no_option_of_a_checked_tour_breaks_it() {
    for (speed, period_seconds) in [(0.0, 4.0), (0.01, 20.0), (60.0, 120.0)] {
        let wind = Wind { period_seconds, ..wind(speed, 1) };
        let mut seas = both(&wind).to_vec();
        for (height, length, count, speed_factor) in
            [(0.0, 0.1, 1, 0.0), (10.0, 0.1, 12, 4.0), (10.0, 300.0, 12, 4.0)]
        {
            let options = Octaves {
                max_height: Some(height),
                wavelength: Some(length),
                octaves: count,
                speed_factor,
                direction_deg: Some(-720.0),
            };
            seas.push(octaves(options, &wind));
        }
        for (peak_period, depth, spreading) in
            [(0.3, 0.05, 1.0), (20.0, 0.05, 30.0), (20.0, 1e4, 1.0), (0.3, 1e4, 30.0)]
        {
            let options = Jonswap {
                max_height: Some(10.0),
                peak_period_seconds: Some(peak_period),
                depth,
                spreading,
                direction_deg: None,
            };
            seas.push(jonswap(options, &wind));
        }
        for mut sea in seas {
            for seconds in [0.0, 1e9, f64::NAN, f64::INFINITY] {
                sea.update(seconds, sea.gain(speed.max(1.0)));
                assert!(sea.tiles().iter().all(|tile| tile.texels().iter().flatten().all(|v| v.is_finite())));
                let [_, slope] = measured(&sea);
                assert!(slope < 2.0 * BREAKING, "mean square slope {slope}");
            }
            for xz in [DVec2::NAN, DVec2::INFINITY, DVec2::splat(1e300), DVec2::splat(-1e-300)] {
                assert!(sea.sample(xz).height.is_finite());
            }
        }
    }
    assert!(SeaSurface::new(&tour::Sea::<()>::Calm, &wind(4.0, 0)).is_none());
}

#[test]
fn displacement_gathers_water_at_the_crests() {
    let mut sea = jonswap(Jonswap::default(), &wind(4.0, 4));
    sea.update(1.0, 1.0);
    // Where the height is great the displacement converges: η and −∂d/∂x have the same sign on the whole.
    for tile in sea.tiles() {
        let step = (TAU / TEXELS as f64) as f32;
        let mut sum = 0.0;
        for row in 0..TEXELS {
            for column in 0..TEXELS {
                let at = |column: usize, row: usize| (row % TEXELS) * TEXELS + column % TEXELS;
                let [x, _] = tile.displacements()[at(column + 1, row)];
                let [left, _] = tile.displacements()[at(column + TEXELS - 1, row)];
                let [_, z] = tile.displacements()[at(column, row + 1)];
                let [_, above] = tile.displacements()[at(column, row + TEXELS - 1)];
                sum -= tile.texels()[at(column, row)][0] * (x - left + z - above) / step;
            }
        }
        assert!(sum > 0.0);
    }
}
