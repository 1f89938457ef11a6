//! The whole module on composites whose alpha and colors are known.

use rayon::ThreadPoolBuilder;

use super::*;

const SIDE: usize = 160;

/// A composite in linear light.
struct Made {
    alpha: Vec<f32>,
    front: Vec<[f32; 3]>,
    colors: Vec<[f32; 3]>,
}

/// Deterministic noise, 0–1.
fn noise(seed: usize) -> f32 {
    ((seed as u32).wrapping_mul(2_654_435_761) >> 16) as f32 / 65536.0
}

/// A reddish object of this alpha before blueish stripes, both with texture and grain.
fn composite(alpha: impl Fn(f32, f32) -> f32) -> Made {
    let mut made = Made { alpha: Vec::new(), front: Vec::new(), colors: Vec::new() };
    for i in 0..SIDE * SIDE {
        let (x, y) = ((i % SIDE) as f32 + 0.5, (i / SIDE) as f32 + 0.5);
        let a = alpha(x, y);
        let waves = (0.3 * x).sin() * (0.23 * y).cos();
        let front = [0.5 + 0.15 * waves, 0.2 + 0.08 * waves, 0.08];
        let stripes = (0.2 * x + 0.35 * y).sin();
        let back = [0.1 + 0.05 * stripes, 0.25 + 0.12 * stripes, 0.45 + 0.1 * stripes];
        let grain = 0.004 * (noise(i) - 0.5);
        made.colors.push(std::array::from_fn(|c| a * front[c] + (1.0 - a) * back[c] + grain));
        made.front.push(front);
        made.alpha.push(a);
    }
    made
}

/// Distance of a cell's center from the disc's.
fn from_center(cell: usize) -> f32 {
    ((cell % SIDE) as f32 - 79.8).hypot((cell / SIDE) as f32 - 79.1)
}

/// How much of a disc with an edge this soft covers a place.
fn disc(x: f32, y: f32, radius: f32, softness: f32) -> f32 {
    (0.5 + (radius - (x - 80.3).hypot(y - 79.6)) / softness).clamp(0.0, 1.0)
}

/// The mask a disc would give with its center moved.
fn moved_disc(radius: f32, by: f32) -> Vec<u8> {
    (0..SIDE * SIDE)
        .map(|i| disc((i % SIDE) as f32 + 0.5 - by, (i / SIDE) as f32 + 0.5, radius, 0.01))
        .map(|a| if a > 0.5 { 255 } else { 0 })
        .collect()
}

fn binary(alpha: &[f32]) -> Vec<u8> {
    alpha.iter().map(|&a| if a > 0.5 { 255 } else { 0 }).collect()
}

fn input<'a>(colors: &'a [[f32; 3]], mask: &'a [u8], radius: f32) -> MatteInput<'a> {
    MatteInput { width: SIDE, colors, mask, inside: radius, outside: radius, foreign: None }
}

fn found(input: &MatteInput) -> Matte {
    matte(input, &|_| true).expect("nobody cancels")
}

/// Mean absolute error over the cells of a band.
fn error(truth: &[f32], coverage: &[u8], band: impl Fn(usize) -> bool) -> f32 {
    let cells: Vec<usize> = (0..truth.len()).filter(|&i| band(i)).collect();
    let sum: f32 = cells.iter().map(|&i| (truth[i] - f32::from(coverage[i]) / 255.0).abs()).sum();
    sum / cells.len() as f32
}

#[test]
fn a_soft_disc_is_found_from_a_mask_two_pixels_off() {
    let made = composite(|x, y| disc(x, y, 50.0, 6.0));
    let mask = moved_disc(50.0, 2.0);
    let found = found(&input(&made.colors, &mask, 7.0));
    let near = |i: usize| (43.0..57.0).contains(&from_center(i));
    let (ours, masks) = (error(&made.alpha, &found.alpha, near), error(&made.alpha, &mask, near));
    assert!(ours < 0.035 && ours < 0.25 * masks, "{ours} is not much less than {masks}");

    let mut colors_error = 0.0;
    let visible: Vec<usize> = (0..SIDE * SIDE).filter(|&i| near(i) && made.alpha[i] > 0.3).collect();
    for &i in &visible {
        colors_error += (0..3).map(|c| (found.foreground[i][c] - made.front[i][c]).abs()).sum::<f32>() / 3.0;
    }
    colors_error /= visible.len() as f32;
    assert!(colors_error < 0.02, "colors are off by {colors_error}");
}

#[test]
fn a_hard_edge_stays_within_half_a_pixel() {
    let made = composite(|x, y| disc(x, y, 50.0, 1.0));
    let found = found(&input(&made.colors, &moved_disc(50.0, -1.5), 4.0));
    // Along each row the covered length is where the two edges are.
    for y in 40..120 {
        let row = y * SIDE..(y + 1) * SIDE;
        let truth: f32 = made.alpha[row.clone()][..80].iter().sum();
        let ours: f32 = found.alpha[row][..80].iter().map(|&a| f32::from(a) / 255.0).sum();
        assert!((truth - ours).abs() < 0.5, "row {y}: the left edge is {} pixels off", truth - ours);
    }
}

#[test]
fn hairs_that_the_mask_swallows_are_found() {
    let hair = |x: f32, y: f32| {
        let hairs: f32 = (0..12)
            .map(|k| {
                let angle = k as f32 * 0.52;
                let (along, across) = (
                    (x - 80.0) * angle.cos() + (y - 80.0) * angle.sin(),
                    (y - 80.0) * angle.cos() - (x - 80.0) * angle.sin(),
                );
                if along > 0.0 && along < 58.0 { (1.2 - across.abs()).clamp(0.0, 1.0) } else { 0.0 }
            })
            .fold(0.0, f32::max);
        hairs.max(disc(x, y, 45.0, 2.0))
    };
    let made = composite(hair);
    let mask = moved_disc(52.0, 0.0);
    let found = found(&input(&made.colors, &mask, 10.0));
    let near = |i: usize| (42.0..60.0).contains(&from_center(i));
    let (ours, masks) = (error(&made.alpha, &found.alpha, near), error(&made.alpha, &mask, near));
    assert!(ours < 0.12 && ours < 0.3 * masks, "{ours} is not much less than {masks}");
}

#[test]
fn a_thin_branch_survives() {
    let made = composite(|x, y| disc(x, y, 20.0, 1.0).max(if (x - 80.0).abs() < 1.0 { 1.0 } else { 0.0 }));
    let found = found(&input(&made.colors, &binary(&made.alpha), 5.0));
    for y in 3..SIDE {
        let best = found.alpha[y * SIDE + 78..y * SIDE + 82].iter().max();
        assert!(best > Some(&180), "row {y} of the branch has {best:?} of 255");
    }
}

#[test]
fn one_color_leaves_the_mask() {
    let mask: Vec<u8> = (0..SIDE * SIDE)
        .map(|i| (255.0 * disc((i % SIDE) as f32, (i / SIDE) as f32, 40.0, 8.0)) as u8)
        .collect();
    for mask in [mask.clone(), mask.iter().map(|&c| if c > 127 { 255 } else { 0 }).collect()] {
        let found = found(&input(&[[0.3, 0.4, 0.5]; SIDE * SIDE], &mask, 6.0));
        let worst = found.alpha.iter().zip(&mask).map(|(a, b)| a.abs_diff(*b)).max();
        assert_eq!(worst, Some(0), "alpha moved by that much of 255");
    }
}

#[test]
fn everything_and_nothing_return_themselves() {
    let made = composite(|x, y| disc(x, y, 50.0, 6.0));
    for coverage in [0, 255] {
        let mask = [coverage; SIDE * SIDE];
        let found = found(&input(&made.colors, &mask, 5.0));
        assert_eq!(found.alpha, mask, "a mask of {coverage} changed");
    }
}

#[test]
fn tiny_pictures_are_no_trouble() {
    for (width, height) in [(0, 0), (1, 1), (1, 7), (7, 1), (2, 2), (3, 3), (5, 2)] {
        let colors: Vec<[f32; 3]> = (0..width * height).map(|i| [noise(i), noise(i + 50), 0.2]).collect();
        for mask in [|_| 255, |i: usize| (i % 2 * 255) as u8, |i: usize| (i * 37 % 256) as u8] {
            let mask: Vec<u8> = (0..width * height).map(mask).collect();
            let input =
                MatteInput { width, colors: &colors, mask: &mask, inside: 3.0, outside: 3.0, foreign: None };
            let found = found(&input);
            assert_eq!(found.alpha.len(), width * height, "{width} × {height}");
            assert!(found.foreground.iter().flatten().all(|c| (0.0..=1.0).contains(c)), "{width} × {height}");
        }
    }
}

#[test]
fn foreign_cells_keep_the_mask() {
    let made = composite(|x, y| disc(x, y, 50.0, 6.0));
    let mask: Vec<u8> = made.alpha.iter().map(|&a| (255.0 * a) as u8).collect();
    let foreign: Vec<bool> = (0..SIDE * SIDE).map(|i| i % SIDE > 100).collect();
    let found = found(&MatteInput { foreign: Some(&foreign), ..input(&made.colors, &mask, 6.0) });
    for i in (0..SIDE * SIDE).filter(|&i| foreign[i]) {
        assert_eq!(found.alpha[i], mask[i], "foreign cell {i} changed");
    }
}

#[test]
fn an_object_at_the_border_stays_there() {
    let made = composite(|x, _| (0.5 + (70.0 - x) / 3.0).clamp(0.0, 1.0));
    let found = found(&input(&made.colors, &binary(&made.alpha), 4.0));
    for y in 0..SIDE {
        assert_eq!(found.alpha[y * SIDE], 255, "the left border is inside, row {y}");
        let sum: f32 = found.alpha[y * SIDE..(y + 1) * SIDE].iter().map(|&a| f32::from(a) / 255.0).sum();
        assert!((sum - 70.0).abs() < 0.5, "row {y} is covered for {sum} pixels instead of 70");
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let made = composite(|x, y| disc(x, y, 50.0, 6.0));
    let mask = moved_disc(50.0, 2.0);
    let run = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads should start");
        pool.install(|| found(&input(&made.colors, &mask, 12.0)))
    };
    let (one, two) = (run(1), run(2));
    assert_eq!(one.alpha, two.alpha, "alpha differs");
    assert_eq!(one.foreground, two.foreground, "colors differ");
}

#[test]
fn it_can_be_cancelled() {
    let made = composite(|x, y| disc(x, y, 50.0, 6.0));
    let mask = moved_disc(50.0, 2.0);
    let input = input(&made.colors, &mask, 5.0);
    assert!(matte(&input, &|_| false).is_none(), "cancelled at once");
    assert!(matte(&input, &|share| share < 0.8).is_none(), "cancelled late");
}
