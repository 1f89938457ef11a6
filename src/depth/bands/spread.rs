//! Labels from where they are known to where they are not: every pixel takes the one that is nearest, where colors that
//! change are far, and so are colors that a label hardly ever has.

use rayon::prelude::*;

/// What one step costs beside the change of color, in codes: even regions are crossed easily, but not for nothing.
const STEP: f32 = 0.2;
/// Changes of color up to this are noise and shading, codes.
const NOISE: f32 = 5.0;
/// Sweeps down and up; paths that turn more often are not found, which matters little.
const SWEEPS: usize = 4;
/// Colors are told apart in so many steps a channel.
const SHADES: usize = 16;
/// What a step costs over a color that a label never has, in codes; over one that only it has nothing.
const STRANGE: f32 = 2.0;

/// Gives every pixel of `inside` the label of the nearest labeled one; `None` stays where none can be reached.
pub(super) fn spread(
    width: usize,
    colors: &[[u8; 3]],
    inside: &(dyn Fn(usize) -> bool + Sync),
    labels: &[Option<u8>],
) -> Vec<Option<u8>> {
    let most = labels.iter().flatten().max().map_or(0, |&most| usize::from(most) + 1);
    let strange = strangeness(colors, labels, most);
    let far: Vec<Vec<f32>> = (0..most)
        .into_par_iter()
        .map(|label| distances(width, colors, inside, labels, label as u8, &strange[label]))
        .collect();
    let nearest = |cell: usize| {
        let reached = (0..most).filter(|&label| far[label][cell].is_finite());
        let least = reached.min_by(|&a, &b| far[a][cell].total_cmp(&far[b][cell]));
        labels[cell].or(least.map(|label| label as u8))
    };
    (0..labels.len()).into_par_iter().map(nearest).collect()
}

/// How far every pixel is from those of one label; those of others are not crossed.
fn distances(
    width: usize,
    colors: &[[u8; 3]],
    inside: &(dyn Fn(usize) -> bool + Sync),
    labels: &[Option<u8>],
    label: u8,
    strange: &[f32],
) -> Vec<f32> {
    let height = labels.len() / width;
    let mut far: Vec<f32> =
        labels.iter().map(|&own| if own == Some(label) { 0.0 } else { f32::INFINITY }).collect();
    let change = |a: usize, b: usize| {
        colors[a].iter().zip(&colors[b]).map(|(p, q)| f32::from(p.abs_diff(*q))).fold(0.0_f32, f32::max)
    };
    for sweep in 0..2 * SWEEPS {
        let down = sweep % 2 == 0;
        for step in 0..labels.len() {
            let cell = if down { step } else { labels.len() - 1 - step };
            if !inside(cell) || labels[cell].is_some() {
                continue;
            }
            let (row, x) = (cell / width, cell % width);
            // Those that this sweep came from.
            let (behind, side) =
                if down { (row.checked_sub(1), -1) } else { (Some(row + 1).filter(|&r| r < height), 1) };
            let beside = x.checked_add_signed(side).filter(|&x| x < width).map(|x| (row, x));
            let before = (-1..=1).filter_map(|aside: isize| {
                let x = x.checked_add_signed(aside).filter(|&x| x < width)?;
                Some((behind?, x))
            });
            let own = STEP + strange[shade(colors[cell])];
            let mut least = far[cell];
            for (row, x) in before.chain(beside) {
                let other = row * width + x;
                if inside(other) && far[other] + own < least {
                    least = least.min(far[other] + own + (change(cell, other) - NOISE).max(0.0));
                }
            }
            far[cell] = least;
        }
    }
    far
}

/// What a step onto each color costs for each label: the less, the more of the pixels with that color have the label.
fn strangeness(colors: &[[u8; 3]], labels: &[Option<u8>], most: usize) -> Vec<Vec<f32>> {
    let mut counts = vec![vec![0.0_f32; SHADES.pow(3)]; most];
    let mut all = vec![0.0_f32; most];
    for (color, label) in colors.iter().zip(labels) {
        if let Some(label) = label.map(usize::from) {
            counts[label][shade(*color)] += 1.0;
            all[label] += 1.0;
        }
    }
    // A large band is no likelier to have a color than a small one.
    for (counts, all) in counts.iter_mut().zip(&all) {
        counts.iter_mut().for_each(|count| *count /= all.max(1.0));
    }
    (0..most)
        .map(|label| {
            (0..SHADES.pow(3))
                .map(|shade| {
                    let sum: f32 = counts.iter().map(|counts| counts[shade]).sum();
                    // A color that no label has says nothing.
                    if sum > 0.0 { STRANGE * (1.0 - counts[label][shade] / sum) } else { 0.5 * STRANGE }
                })
                .collect()
        })
        .collect()
}

fn shade(color: [u8; 3]) -> usize {
    color.iter().fold(0, |index, &code| index * SHADES + usize::from(code) * SHADES / 256)
}
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_keep_to_edges_rather_than_to_the_nearest_seed() {
        // Dark to column 6, bright beyond; the bright seed is at the far right.
        let (width, height) = (12, 3);
        let colors: Vec<[u8; 3]> =
            (0..width * height).map(|i| if i % width < 7 { [20; 3] } else { [200; 3] }).collect();
        let mut labels = vec![None; width * height];
        labels[width] = Some(1);
        labels[2 * width - 1] = Some(2);
        let found = spread(width, &colors, &|i| i / width < 2, &labels);
        for (i, label) in found.iter().enumerate() {
            let truth = if i / width == 2 { None } else { Some(if i % width < 7 { 1 } else { 2 }) };
            assert_eq!(*label, truth, "at {i}");
        }
    }

    #[test]
    fn a_color_that_only_one_label_has_goes_to_it() {
        // Nearly one color, so that no edge parts them; only the two labels' shades differ.
        let colors: Vec<[u8; 3]> = (0..30).map(|x| if x < 5 { [33; 3] } else { [29; 3] }).collect();
        let labels: Vec<Option<u8>> =
            (0..30).map(|x| if x < 5 { Some(0) } else { Some(1).filter(|_| x > 25) }).collect();
        let found = spread(30, &colors, &|_| true, &labels);
        assert!(found[8..].iter().all(|&label| label == Some(1)), "{found:?}");
    }
}
