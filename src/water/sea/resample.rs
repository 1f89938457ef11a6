//! From a frame of any size to a tile's texels, as a picture that repeats.

use super::TEXELS;

/// Share of a side that bends towards the opposite edge.
const STRIP: f64 = 1.0 / 8.0;

/// Steps across the edge, in the steps between neighbors, up to which a frame repeats, and from which it does not.
const FITS: f32 = 1.5;
const BREAKS: f32 = 3.0;

/// Bends strips along the edges so that opposite ones meet. A frame that repeats by itself stays as it is, to the bit.
pub(super) fn close_seams(width: usize, height: usize, values: &mut [f32]) {
    let share = share_of_bend(width, height, |column, row| values[row * width + column]);
    for row in values.chunks_exact_mut(width).filter(|_| share > 0.0) {
        close_seam(width, share, |i| i, row);
    }
    let share = share_of_bend(height, width, |row, column| values[row * width + column]);
    for column in (0..width).filter(|_| share > 0.0) {
        close_seam(height, share, |i| i * width + column, values);
    }
}

/// How much `lines` lines of `count` values need a bend, 0 to 1: none where the step from end to start is like any other.
fn share_of_bend(count: usize, lines: usize, value: impl Fn(usize, usize) -> f32) -> f32 {
    let (mut within, mut across) = (0.0_f32, 0.0_f32);
    for line in 0..lines {
        let mut before = value(count - 1, line);
        for i in 0..count {
            let now = value(i, line);
            *(if i == 0 { &mut across } else { &mut within }) += (now - before) * (now - before);
            before = now;
        }
    }
    let usual = (within / (count - 1) as f32).sqrt();
    // An even frame whose ends are apart has no usual step.
    if across == 0.0 { 0.0 } else { ((across.sqrt() / usual - FITS) / (BREAKS - FITS)).clamp(0.0, 1.0) }
}

/// Closes one line of `count` values; `place` says where each lies.
fn close_seam(count: usize, share: f32, place: impl Fn(usize) -> usize, values: &mut [f32]) {
    // Values belong to the middles of pixels, so edges lie half a pixel further.
    let edge = |last: usize, before: usize| 1.5 * values[place(last)] - 0.5 * values[place(before)];
    let jump = share * (edge(0, 1) - edge(count - 1, count - 2));
    let strip = STRIP * count as f64;
    for i in 0..strip.ceil() as usize {
        let part = ((i as f64 + 0.5) / strip).min(1.0);
        let bend = 0.5 * jump * (1.0 - part * part * (3.0 - 2.0 * part)) as f32;
        values[place(i)] -= bend;
        values[place(count - 1 - i)] += bend;
    }
}

/// The frame at a tile's texels, in rows; `offset` is where the first one lies, in frames along and down.
pub(super) fn resampled(width: usize, height: usize, values: &[f32], offset: [f64; 2]) -> Vec<f32> {
    let [along, down] = [taps(width, offset[0]), taps(height, offset[1])];
    let mut narrow = Vec::with_capacity(TEXELS * height);
    for row in values.chunks_exact(width) {
        narrow.extend(
            along.iter().map(|taps| -> f32 { taps.iter().map(|&(i, weight)| weight * row[i]).sum() }),
        );
    }
    let mut texels = Vec::with_capacity(TEXELS * TEXELS);
    for taps in &down {
        texels.extend((0..TEXELS).map(|column| -> f32 {
            taps.iter().map(|&(row, weight)| weight * narrow[row * TEXELS + column]).sum()
        }));
    }
    texels
}

/// For each texel the pixels that it is made of, with their weights: a cubic that goes through the pixels, widened to a
/// texel where that is larger.
fn taps(count: usize, offset: f64) -> Vec<Vec<(usize, f32)>> {
    let step = count as f64 / TEXELS as f64;
    let reach = step.max(1.0);
    (0..TEXELS)
        .map(|texel| {
            let center = texel as f64 * step + offset * count as f64 - 0.5;
            let [first, last] = [center - 2.0 * reach, center + 2.0 * reach];
            let weights: Vec<(i64, f64)> = (first.ceil() as i64..=last.floor() as i64)
                .map(|pixel| (pixel, cubic((pixel as f64 - center) / reach)))
                .collect();
            let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
            let wrapped = |pixel: i64| pixel.rem_euclid(count as i64) as usize;
            weights.iter().map(|&(pixel, weight)| (wrapped(pixel), (weight / sum) as f32)).collect()
        })
        .collect()
}

/// Catmull and Rom's cubic, 0 from 2 on.
fn cubic(x: f64) -> f64 {
    let x = x.abs();
    if x < 1.0 {
        (1.5 * x - 2.5) * x * x + 1.0
    } else if x < 2.0 {
        ((2.5 - 0.5 * x) * x - 4.0) * x + 2.0
    } else {
        0.0
    }
}
