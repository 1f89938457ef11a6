//! The mirror axis of a picture with water: the line about which its upper part and its lower part look alike.
//!
//! Notes §2.2, steps 1–3: in tiles as wide as a tenth of the picture every row loses its mean (so that skies that only
//! grow brighter downward match nothing), then the rows above a candidate axis are correlated with those below it. The
//! axis may be tilted by a few degrees, as cameras are held. Points are picture points of the whole picture.

use glam::DVec2;
use rayon::prelude::*;

use super::gray::{Gray, Turn};
use crate::picture::PicturePoint;

/// Tilts that are tried, degrees: on a tie the picture is level. Then those near the best.
const TILTS: [f64; 11] = [0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0, 4.0, -4.0, 5.0, -5.0];
const FINE_TILTS: [f64; 7] = [0.0, 0.25, -0.25, 0.5, -0.5, 0.75, -0.75];
/// Rows on each side that are compared at most, as a share of the picture's height (notes: 160 of 400).
const BAND: f64 = 0.4;
/// Rows on each side that an axis needs, as a share: fewer agree by chance (notes: 24 of 400).
const LEAST_BAND: f64 = 0.15;
/// Contrast that a tile needs above the axis, and below it where water dims it, gray levels.
const CONTRAST: f32 = 4.0;
const DIMMED_CONTRAST: f32 = 1.5;
/// The share of tiles, best first, whose mean is an axis' score: boats, banks and frames cover the rest.
const SHARE: f64 = 0.75;
/// Tiles with contrast that an axis needs, as a share of all.
const LEAST_TILES: f64 = 0.4;
/// An axis' rival stands at least this far from it, as a share of the height (notes: 8 of 400).
const APART: f64 = 0.02;
/// A tile agrees with an axis from this correlation on.
const AGREES: f32 = 0.5;

/// How one upright strip of the picture mirrors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MirrorTile {
    /// Where the strip's own axis crosses its middle.
    pub at: PicturePoint,
    /// Correlation about the strip's own axis, −1 to 1.
    pub score: f64,
    /// Whether it mirrors about the common axis too.
    pub agrees: bool,
}

/// The line about which most of a picture mirrors.
#[derive(Clone, Debug, PartialEq)]
pub struct MirrorAxis {
    /// Where it meets the picture's left and right border, y down.
    pub ends: [PicturePoint; 2],
    /// Mean correlation of the best three quarters of the tiles, −1 to 1.
    pub score: f64,
    /// The score of the best other axis.
    pub runner_up: f64,
    /// How sure it is that there is a reflection about it, 0–1.
    pub confidence: f64,
    /// Details of the picture that were found again upside down, about this axis or about one of a nearer part.
    pub matches: usize,
    /// The strips that have contrast, from the left to the right.
    pub tiles: Vec<MirrorTile>,
}

impl MirrorAxis {
    /// The axis' y at column `x`, pixels.
    #[must_use]
    pub fn y_at(&self, x: f64) -> f64 {
        let [left, right] = self.ends;
        left.y() + (right.y() - left.y()) * (x - left.x()) / (right.x() - left.x())
    }

    /// Its rise in y (down) for each pixel to the right.
    #[must_use]
    pub fn slope(&self) -> f64 {
        let [left, right] = self.ends;
        (right.y() - left.y()) / (right.x() - left.x())
    }
}

/// What the picture as a whole says.
#[derive(Clone, Copy, Debug)]
pub(super) struct Whole {
    /// Radians, as [`Turn`].
    pub(super) tilt: f64,
    /// Row of the leveled gray picture.
    pub(super) row: f64,
    pub(super) score: f64,
    pub(super) runner_up: f64,
}

/// Finds the axis about which `gray` as a whole mirrors best; `None` where nothing has contrast.
pub(super) fn whole(gray: &Gray) -> Option<Whole> {
    let at_tilt = |gray: &Gray, degrees: f64| {
        let profile = Profile::of(&gray.leveled(gray.turn(degrees.to_radians())));
        let peak = profile.peak()?;
        Some(Whole {
            tilt: degrees.to_radians(),
            row: profile.row(peak),
            score: f64::from(profile.scores[peak]),
            runner_up: profile.runner_up(peak),
        })
    };
    let best = |gray: &Gray, tilts: &[f64]| {
        let found: Vec<Whole> = tilts.par_iter().filter_map(|&degrees| at_tilt(gray, degrees)).collect();
        // The first of equals: level comes first.
        found.into_iter().reduce(|best, new| if new.score > best.score + 0.01 { new } else { best })
    };
    let small = gray.shrunk(2);
    let coarse = best(&small, &TILTS)?.tilt.to_degrees();
    let fine = FINE_TILTS.map(|step| coarse + step);
    best(gray, &fine)
}

/// How the picture mirrors about the axis in `row` of the leveled `gray`; `factor` is how many of the picture's pixels
/// one of gray's is wide. `None` where no strip has contrast.
pub(super) fn axis_at(gray: &Gray, turn: Turn, row: f64, factor: f64) -> Option<MirrorAxis> {
    let profile = Profile::of(&gray.leveled(turn));
    profile.axis(row, turn, factor)
}

/// Correlations of all tiles about all axes. Axis `i` lies at y = i / 2: odd ones run through a row's middle.
struct Profile {
    tile_width: usize,
    width: usize,
    height: usize,
    /// Per axis, per tile; NaN where there is too little contrast or room.
    tiles: Vec<Vec<f32>>,
    /// Per axis, −1 where it is none.
    scores: Vec<f32>,
}

impl Profile {
    fn of(gray: &Gray) -> Self {
        let (width, height) = (gray.width, gray.height);
        let tile_width = (width / 12).clamp(8.min(width), 64);
        let count = width / tile_width;
        // Rows without their means, tile by tile, and the sums of their squares so far.
        let plain: Vec<(Vec<f32>, Vec<f64>)> = (0..count)
            .into_par_iter()
            .map(|tile| {
                let mut rows = Vec::with_capacity(tile_width * height);
                let mut sums = vec![0.0];
                let mut sum = 0.0;
                for y in 0..height {
                    let row = gray.span(y, tile * tile_width, tile_width);
                    let mean = row.iter().sum::<f32>() / tile_width as f32;
                    rows.extend(row.iter().map(|value| value - mean));
                    sum += row.iter().map(|value| f64::from((value - mean).powi(2))).sum::<f64>();
                    sums.push(sum);
                }
                (rows, sums)
            })
            .collect();
        let least = ((LEAST_BAND * height as f64) as usize).max(4);
        let most = ((BAND * height as f64) as usize).max(least);
        let tiles: Vec<Vec<f32>> = (0..=2 * height)
            .into_par_iter()
            .map(|axis| {
                // The row just above the axis and the one just below it; one through a row's middle skips that row.
                let (Some(up), down) = ((axis / 2).checked_sub(1), axis.div_ceil(2)) else {
                    return vec![f32::NAN; count];
                };
                let band = most.min(up + 1).min(height.saturating_sub(down));
                if band < least {
                    return vec![f32::NAN; count];
                }
                plain.iter().map(|tile| correlation(tile, tile_width, up, down, band)).collect()
            })
            .collect();
        let scores = tiles.iter().map(|tiles| score(tiles)).collect();
        Self { tile_width, width, height, tiles, scores }
    }

    fn peak(&self) -> Option<usize> {
        let best = (0..self.scores.len()).max_by(|&a, &b| self.scores[a].total_cmp(&self.scores[b]))?;
        (self.scores[best] > -1.0).then_some(best)
    }

    fn apart(&self) -> usize {
        ((2.0 * APART * self.height as f64).ceil() as usize).max(4)
    }

    /// The row of an axis, between half rows.
    fn row(&self, peak: usize) -> f64 {
        vertex(peak, |axis| self.scores.get(axis).copied().filter(|score| *score > -1.0)) / 2.0
    }

    fn runner_up(&self, peak: usize) -> f64 {
        let far = (0..self.scores.len()).filter(|axis| axis.abs_diff(peak) > self.apart());
        f64::from(far.map(|axis| self.scores[axis]).fold(-1.0, f32::max))
    }

    fn axis(&self, row: f64, turn: Turn, factor: f64) -> Option<MirrorAxis> {
        let peak = ((2.0 * row).round() as usize).min(self.tiles.len() - 1);
        let place = |x: f64, y: f64| turn.picture(DVec2::new(x, y)) * factor;
        let (left, right) = (place(0.0, row), place(self.width as f64, row));
        // The line through both, at the picture's own borders.
        let slope = (right.y - left.y) / (right.x - left.x);
        let end = |x: f64| PicturePoint::new(x, left.y + slope * (x - left.x));
        let tiles = (0..self.tiles[peak].len()).filter_map(|tile| {
            let of =
                |axis: usize| self.tiles.get(axis).map(|tiles| tiles[tile]).filter(|score| !score.is_nan());
            let shared = of(peak)?;
            let range = peak.saturating_sub(self.apart())..=(peak + self.apart());
            let own = range
                .filter(|&axis| of(axis).is_some())
                .max_by(|&a, &b| of(a).unwrap_or(-1.0).total_cmp(&of(b).unwrap_or(-1.0)))?;
            let middle = (tile as f64 + 0.5) * self.tile_width as f64;
            Some(MirrorTile {
                at: PicturePoint(place(middle, vertex(own, of) / 2.0)),
                score: f64::from(of(own)?),
                agrees: shared >= AGREES,
            })
        });
        let tiles: Vec<MirrorTile> = tiles.collect();
        Some(MirrorAxis {
            ends: [end(0.0), end(self.width as f64 * factor)],
            score: f64::from(self.scores[peak]),
            runner_up: self.runner_up(peak),
            confidence: 0.0,
            matches: 0,
            tiles,
        })
    }
}

/// Correlation of a tile's rows from `up` upward with those from `down` downward; NaN where there is little to see.
fn correlation(
    (rows, sums): &(Vec<f32>, Vec<f64>),
    width: usize,
    up: usize,
    down: usize,
    band: usize,
) -> f32 {
    let above = (sums[up + 1] - sums[up + 1 - band]) as f32;
    let below = (sums[down + band] - sums[down]) as f32;
    let pixels = (width * band) as f32;
    if above < CONTRAST * CONTRAST * pixels || below < DIMMED_CONTRAST * DIMMED_CONTRAST * pixels {
        return f32::NAN;
    }
    let row = |y: usize| &rows[y * width..][..width];
    let products = (0..band).map(|k| dot(row(up - k), row(down + k))).sum::<f32>();
    products / (above * below).sqrt()
}

pub(super) fn dot(a: &[f32], b: &[f32]) -> f32 {
    // Eight sums side by side, which the compiler keeps in one register.
    let mut sums = [0.0; 8];
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    for (a, b) in a.iter().zip(b) {
        for i in 0..8 {
            sums[i] += a[i] * b[i];
        }
    }
    sums.iter().sum::<f32>() + a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum::<f32>()
}

/// Mean of the best of an axis' tiles.
fn score(tiles: &[f32]) -> f32 {
    let mut seen: Vec<f32> = tiles.iter().copied().filter(|score| !score.is_nan()).collect();
    if seen.is_empty() || (seen.len() as f64) < LEAST_TILES * tiles.len() as f64 {
        return -1.0;
    }
    seen.sort_unstable_by(|a, b| b.total_cmp(a));
    seen.truncate((SHARE * seen.len() as f64).ceil() as usize);
    seen.iter().sum::<f32>() / seen.len() as f32
}

/// Where a parabola through a peak and its two neighbors is highest.
pub(super) fn vertex(peak: usize, at: impl Fn(usize) -> Option<f32>) -> f64 {
    let sides = peak.checked_sub(1).and_then(&at).zip(at(peak + 1)).zip(at(peak));
    let step = sides.map_or(0.0, |((left, right), middle)| {
        let bend = left + right - 2.0 * middle;
        if bend < 0.0 { ((left - right) / (2.0 * bend)).clamp(-0.5, 0.5) } else { 0.0 }
    });
    peak as f64 + f64::from(step)
}
