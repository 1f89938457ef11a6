//! What a fill promises, on pictures whose hole is known.

use rayon::ThreadPoolBuilder;

use super::*;

/// A made picture with its cells.
struct Made {
    width: usize,
    colors: Vec<[f32; 3]>,
    cells: Vec<Cell>,
}

impl Made {
    fn new(
        width: usize,
        height: usize,
        color: impl Fn(usize, usize) -> [f32; 3],
        cell: impl Fn(usize, usize) -> Cell,
    ) -> Self {
        let at = |index: usize| (index % width, index / width);
        let colors = (0..width * height).map(|i| color(at(i).0, at(i).1)).collect();
        let cells = (0..width * height).map(|i| cell(at(i).0, at(i).1)).collect();
        Self { width, colors, cells }
    }

    /// The colors after the fill; a hole's own colors are spoiled before.
    fn filled(&self, options: &Options) -> Vec<[f32; 3]> {
        let mut colors = self.colors.clone();
        for (color, cell) in colors.iter_mut().zip(&self.cells) {
            if *cell == Cell::Hole {
                *color = [0.0, 1.0, 1.0];
            }
        }
        let finished = inpaint(self.width, &mut colors, &self.cells, options, &|_| true);
        assert!(finished, "nobody canceled");
        colors
    }

    /// PSNR of the colors in the hole against what was there, in dB.
    fn psnr(&self, colors: &[[f32; 3]]) -> f32 {
        let (mut error, mut count) = (0.0, 0);
        for ((color, truth), cell) in colors.iter().zip(&self.colors).zip(&self.cells) {
            if *cell == Cell::Hole {
                error += (0..3).map(|c| (color[c] - truth[c]).powi(2)).sum::<f32>();
                count += 3;
            }
        }
        -10.0 * (error / count as f32).max(1e-12).log10()
    }
}

/// Every picture's cells: a hole in the middle.
fn hole(width: usize, height: usize) -> impl Fn(usize, usize) -> Cell {
    move |x, y| {
        let inside =
            (width * 3 / 8..width * 5 / 8).contains(&x) && (height * 3 / 8..height * 5 / 8).contains(&y);
        if inside { Cell::Hole } else { Cell::Source }
    }
}

/// A number from 0 to below 1 for a place.
fn noise(x: usize, y: usize) -> f32 {
    Random::new(7, (y * 65_536 + x) as u64).below(1 << 16) as f32 / 65_536.0
}

/// Hills, with grain.
fn hills(x: usize, y: usize) -> [f32; 3] {
    let ridge = 70.0 + 20.0 * (x as f32 * 0.05).sin();
    let grain = 0.1 * noise(x, y);
    if (y as f32) < ridge { [0.3 + grain, 0.5 + grain, 0.8 + grain] } else { [0.2 + grain, 0.3 + grain, 0.1] }
}

#[test]
fn everything_but_the_hole_keeps_its_bits() {
    let made = Made::new(160, 120, hills, hole(160, 120));
    let colors = made.filled(&Options::default());
    for (at, cell) in made.cells.iter().enumerate() {
        if *cell != Cell::Hole {
            assert_eq!(colors[at], made.colors[at], "cell {at} changed");
        }
    }
}

#[test]
fn tiles_are_restored() {
    let tile =
        |x: usize, y: usize| [noise(x % 24, y % 24), noise(x % 24 + 99, y % 24), noise(x % 24, y % 24 + 99)];
    let made = Made::new(200, 160, tile, hole(200, 160));
    for finest_level in [0, 1] {
        let psnr = made.psnr(&made.filled(&Options { finest_level, ..Options::default() }));
        assert!(psnr > 45.0, "{psnr} dB with finest level {finest_level}");
    }
}

#[test]
fn a_vertical_ramp_stays_monotone() {
    let made = Made::new(120, 120, |_, y| [0.1 + 0.006 * y as f32; 3], hole(120, 120));
    let colors = made.filled(&Options::default());
    for (above, below) in colors.iter().zip(&colors[120..]) {
        assert!(below[0] >= above[0] - 2e-3, "{} lies above {}", above[0], below[0]);
    }
}

#[test]
fn threads_and_repetition_change_nothing_but_seeds_do() {
    let made = Made::new(200, 150, hills, hole(200, 150));
    let with = |threads: usize, seed: u64| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| made.filled(&Options { seed, ..Options::default() }))
    };
    assert!(with(1, 5) == with(2, 5), "threads show");
    assert!(with(2, 5) != with(2, 6), "seeds do not show");
}

#[test]
fn nothing_foreign_is_copied() {
    // Red stands beside the hole and below it, and in specks all over the picture.
    let is_red = |x: usize, y: usize| x > 130 || y > 110 || (x % 41 == 3 && y % 37 == 5);
    let color = move |x: usize, y: usize| if is_red(x, y) { [1.0, 0.0, 0.0] } else { hills(x, y) };
    let cell = move |x: usize, y: usize| if is_red(x, y) { Cell::Foreign } else { hole(200, 150)(x, y) };
    let made = Made::new(200, 150, color, cell);
    let colors = made.filled(&Options::default());
    for (at, cell) in made.cells.iter().enumerate() {
        if *cell == Cell::Hole {
            assert!(colors[at][0] < 0.5 && colors[at][1] > 0.2, "cell {at} became {:?}", colors[at]);
        }
    }
}

#[test]
fn one_color_stays_one_color() {
    let made = Made::new(90, 70, |_, _| [0.25, 0.5, 0.125], hole(90, 70));
    for (color, truth) in made.filled(&Options::default()).iter().zip(&made.colors) {
        assert!((0..3).all(|c| (color[c] - truth[c]).abs() < 1e-6), "{truth:?} became {color:?}");
    }
}

#[test]
fn a_frame_around_the_picture_continues_its_rows() {
    let frame = |x: usize, y: usize| {
        if (30..170).contains(&x) && (20..120).contains(&y) { Cell::Source } else { Cell::Hole }
    };
    let bands = |_: usize, y: usize| if y < 70 { [0.2, 0.4, 0.9] } else { [0.1, 0.5, 0.1] };
    let made = Made::new(200, 140, bands, frame);
    let psnr = made.psnr(&made.filled(&Options::default()));
    assert!(psnr > 30.0, "{psnr} dB");
}

#[test]
fn what_cannot_be_matched_is_filled_smoothly() {
    // Slivers of 5 columns hold no patch.
    let color = |x: usize, _: usize| if x % 10 < 5 { [0.5; 3] } else { [1.0, 0.0, 0.0] };
    let cell = |x: usize, y: usize| match x % 10 {
        _ if y == 20 => Cell::Hole,
        0..5 => Cell::Source,
        _ => Cell::Foreign,
    };
    let made = Made::new(60, 40, color, cell);
    let colors = made.filled(&Options::default());
    for x in 0..60 {
        let [r, g, b] = colors[20 * 60 + x];
        assert!(r == g && g == b && (r - 0.5).abs() < 1e-6, "cell {x} became {:?}", [r, g, b]);
    }
}

#[test]
fn any_size_and_any_cells_are_survived() {
    for (width, height) in [(1, 1), (1, 40), (40, 1), (6, 6), (7, 7), (8, 9), (33, 70)] {
        for kind in 0..6 {
            let cell = |x: usize, y: usize| match kind {
                0 => Cell::Hole,
                2 => Cell::Foreign,
                3 if x + y > 0 => Cell::Hole,
                4 if x > 8 => Cell::Hole,
                5 if (x + y).is_multiple_of(9) => [Cell::Hole, Cell::Foreign][x % 2],
                _ => Cell::Source,
            };
            let made = Made::new(width, height, |x, y| [noise(x, y); 3], cell);
            let colors = made.filled(&Options::default());
            assert!(
                colors.as_flattened().iter().all(|value| (0.0..=1.0).contains(value)),
                "{width} × {height}"
            );
        }
    }
    assert!(inpaint(0, &mut [], &[], &Options::default(), &|_| true), "no cells, no work");
}

#[test]
fn a_canceled_fill_changes_nothing() {
    let made = Made::new(160, 120, hills, hole(160, 120));
    let mut colors = made.colors.clone();
    let finished = inpaint(160, &mut colors, &made.cells, &Options::default(), &|share| share < 0.5);
    assert!(!finished, "the fill went on");
    assert!(colors == made.colors, "colors changed");
}

#[test]
fn progress_goes_up_to_one() {
    let made = Made::new(160, 120, hills, hole(160, 120));
    let last = std::cell::Cell::new(-1.0);
    let rises = |share: f32| {
        assert!(share > last.get() && share <= 1.0, "{share} after {}", last.get());
        last.set(share);
        true
    };
    assert!(inpaint(160, &mut made.colors.clone(), &made.cells, &Options::default(), &rises));
}

#[test]
fn rounds_at_one_size_lower_the_energy() {
    let made = Made::new(200, 150, hills, hole(200, 150));
    let window = Window::around_holes(made.width, &made.cells).unwrap();
    let (colors, cells) = (window.cut(&made.colors, [0.0; 3]), window.cut(&made.cells, Cell::Foreign));
    let features = texture::features(window.cut_width(), &colors, &cells);
    let mut level = Level::new(window.cut_width(), cells, features, 1.0);
    let mut field = peel::fill(&mut level, 3);
    let mut energies = Vec::new();
    for round in 0..8 {
        field.measure(&level);
        for backward in [false, true] {
            field.sweep(&level, Sweep { backward, reach: 200, seed: round });
        }
        let targets = (0..level.cells.len()).filter(|cell| level.is_target[*cell]);
        energies.push(targets.map(|cell| f64::from(field.cost[cell])).sum::<f64>());
        vote::fill(&mut level, &field, Ballot::Mean);
    }
    for pair in energies.windows(2) {
        assert!(pair[1] <= 1.01 * pair[0], "energies {energies:.0?}");
    }
}
