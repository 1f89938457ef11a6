//! What looks like the sky: even, bright, no less blue than red, and at the top.

use glam::{DMat3, DVec3};

use super::view::{Kind, View};

/// Columns and rows are read at every so many pixels.
const STRIDE: usize = 4;
/// Gradients that may bound the sky, codes per sample.
const BOUNDS: [f32; 12] = [4.0, 6.0, 8.0, 11.0, 15.0, 20.0, 26.0, 33.0, 42.0, 53.0, 67.0, 85.0];
/// Less of the direct pixels than this is no sky.
const LEAST_SHARE: f64 = 0.02;
/// Variance of a color that means nothing, squared codes.
const NOISE: f64 = 16.0;
/// How much likelier a color is in the sky than below, as twice a logarithm: mountains in haze are nearly of its color.
const SURELY: f64 = 4.0;
const ROUNDS: usize = 3;

/// Whether each pixel looks like sky: above the first strong edge, and of a color more likely there than below.
pub(super) fn looks_like_sky(view: &View) -> Vec<bool> {
    let ends = ends(view);
    let color = |cell: usize| DVec3::from_array([0, 1, 2].map(|i| f64::from(view.channels[i][cell])));
    let is_direct = |cell: usize| view.kinds[cell] == Kind::Direct;
    let above: Vec<bool> = (0..view.kinds.len())
        .map(|cell| cell / view.width < ends[cell % view.width] && is_direct(cell))
        .collect();
    let mut is_sky = above.clone();
    for _ in 0..ROUNDS {
        let (mut sky, mut ground) = (Region::default(), Region::default());
        for cell in (0..is_sky.len()).step_by(STRIDE + 1).filter(|&cell| is_direct(cell)) {
            if is_sky[cell] { sky.add(color(cell)) } else { ground.add(color(cell)) }
        }
        if sky.count == 0.0 || ground.count == 0.0 {
            break;
        }
        let (sky, ground) = (sky.gaussian(), ground.gaussian());
        is_sky = (0..above.len())
            .map(|cell| above[cell] && sky.unlike(color(cell)) + SURELY < ground.unlike(color(cell)))
            .collect();
    }
    is_sky
}

/// The row at which the sky ends in each column: of all bounds, the one that parts two most even regions (Shen & Wang
/// 2013, "Sky region detection in a single image").
fn ends(view: &View) -> Vec<usize> {
    let none: Vec<usize> = vec![0; view.width];
    let columns = view.width / STRIDE;
    let rows = view.height / STRIDE;
    let cell = |column: usize, row: usize| row * STRIDE * view.width + column * STRIDE;
    let is_direct = |column: usize, row: usize| view.kinds[cell(column, row)] == Kind::Direct;
    let first: Vec<usize> =
        (0..columns).map(|column| (0..rows).find(|&row| is_direct(column, row)).unwrap_or(rows)).collect();
    let contrast = |column: usize, row: usize| {
        let change = |a: usize, b: usize| {
            view.channels.iter().map(|values| (values[a] - values[b]).abs()).fold(0.0_f32, f32::max)
        };
        let own = cell(column, row);
        let aside = if column > 0 { change(own, cell(column - 1, row)) } else { 0.0 };
        change(own, cell(column, row - 1)).max(aside)
    };
    let (mut best, mut best_evenness) = (none.clone(), 0.0);
    for bound in BOUNDS {
        let ends: Vec<usize> = (0..columns)
            .map(|column| {
                let begin = first[column];
                (begin + 1..rows)
                    .find(|&row| !is_direct(column, row) || contrast(column, row) > bound)
                    .unwrap_or(rows)
                    .min(rows)
            })
            .collect();
        let (mut sky, mut ground) = (Region::default(), Region::default());
        for column in 0..columns {
            for row in first[column]..rows {
                if !is_direct(column, row) {
                    continue;
                }
                let color =
                    DVec3::from_array([0, 1, 2].map(|i| f64::from(view.channels[i][cell(column, row)])));
                if row < ends[column] { sky.add(color) } else { ground.add(color) }
            }
        }
        if sky.count < LEAST_SHARE * (sky.count + ground.count) || ground.count == 0.0 {
            continue;
        }
        // A sky is brighter than what stands before it, and no less blue.
        let (above, below) = (sky.mean(), ground.mean());
        if above.element_sum() <= below.element_sum() || above.z < above.x {
            continue;
        }
        let evenness = 1.0 / (2.0 * sky.spread() + ground.spread());
        if evenness > best_evenness {
            best_evenness = evenness;
            best = (0..view.width)
                .map(|x| {
                    let column = (x / STRIDE).min(columns - 1);
                    if ends[column] > first[column] + 1 { (ends[column] - 1) * STRIDE } else { 0 }
                })
                .collect();
        }
    }
    best
}

/// Colors of a region.
#[derive(Default)]
struct Region {
    count: f64,
    sum: DVec3,
    squares: DMat3,
}

impl Region {
    fn add(&mut self, color: DVec3) {
        self.count += 1.0;
        self.sum += color;
        self.squares += DMat3::from_cols(color * color.x, color * color.y, color * color.z);
    }

    fn mean(&self) -> DVec3 {
        self.sum / self.count.max(1.0)
    }

    /// Volume of the colors' spread.
    fn spread(&self) -> f64 {
        let mean = self.mean();
        let of_mean = DMat3::from_cols(mean * mean.x, mean * mean.y, mean * mean.z);
        let covariance = self.squares * (1.0 / self.count.max(1.0)) - of_mean;
        (covariance + DMat3::IDENTITY).determinant().abs()
    }

    fn gaussian(&self) -> Gaussian {
        let mean = self.mean();
        let of_mean = DMat3::from_cols(mean * mean.x, mean * mean.y, mean * mean.z);
        let covariance =
            self.squares * (1.0 / self.count.max(1.0)) - of_mean + DMat3::from_diagonal(DVec3::splat(NOISE));
        Gaussian { mean, inverse: covariance.inverse(), ln_volume: covariance.determinant().ln() }
    }
}

/// Colors as a normal distribution.
struct Gaussian {
    mean: DVec3,
    inverse: DMat3,
    ln_volume: f64,
}

impl Gaussian {
    /// Twice the negative logarithm of a color's likelihood, but for a constant.
    fn unlike(&self, color: DVec3) -> f64 {
        let off = color - self.mean;
        off.dot(self.inverse * off) + self.ln_volume
    }
}
