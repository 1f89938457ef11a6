//! Points and where the water shows them: patches of the leveled picture looked for upside down further below.
//!
//! Notes §2.2, steps 4 and 6. Corners that stand well apart are taken from a small picture; each is compared with every
//! place below it in a cone that leaves room for a tilted camera (reflections then lean towards the nadir). A match must be clearly the best place, and looking back up from
//! it must lead to the corner again; then it is found again at working size and at full size.

use glam::DVec2;
use rayon::prelude::*;

use super::gray::{Gray, Turn};
use super::patches::{Patches, Template};

/// A point and its mirror image in the leveled picture, pixels of the size they were last refined at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Match {
    pub(super) point: DVec2,
    pub(super) image: DVec2,
    /// Correlation of the two patches, −1 to 1.
    pub(super) score: f64,
    /// Standard deviation of the image sideways and along the reflection, pixels.
    pub(super) deviation: DVec2,
}

impl Match {
    /// The mirror axis of this match alone.
    pub(super) fn axis(&self) -> f64 {
        (self.point.y + self.image.y) / 2.0
    }

    /// The same match, leveled by another turn.
    pub(super) fn turned(&self, from: Turn, to: Turn) -> Self {
        let [point, image] = [self.point, self.image].map(|at| to.level(from.picture(at)));
        Self { point, image, ..*self }
    }

    /// The same match in a picture `factor` times as large.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        let [point, image, deviation] = [self.point, self.image, self.deviation].map(|at| at * factor);
        Self { point, image, deviation, ..*self }
    }

    pub(super) fn length(&self) -> f64 {
        self.image.y - self.point.y
    }
}

/// Half widths and half heights of patches: in the small picture, and in the others.
pub(super) const SMALL_PATCH: [usize; 2] = [5, 8];
pub(super) const PATCH: [usize; 2] = [7, 11];
/// Corners sought, each the best of a cell of this many small pixels.
const CELL: usize = 8;
/// Contrast that a corner's patch needs, and its image, which water dims; gray levels.
const CONTRAST: f32 = 3.0;
const DIMMED_CONTRAST: f32 = 1.2;
/// How far beside the corner its image may lie: pixels of the small picture, and a share of the way between them (pitch
/// 10° at the border of a usual lens' picture, or 4° of roll).
const LEAN: (f64, f64) = (2.0, 0.07);
/// Images nearer than this to their corner are the corner's own symmetry, small pixels.
const NEAREST: isize = 6;
/// Correlations that a match needs in the small picture and in the last one.
const SMALL_SCORE: f32 = 0.6;
const SCORE: f32 = 0.7;
/// Distinctness: 1 − correlation of the next best place is at least this many times that of the best.
const RATIO: f32 = 1.15;
/// How far from the corner looking back may end, pixels.
const RETURN: f64 = 1.0;

/// Corners of a gray picture, strongest of each cell, as pixels.
pub(super) fn corners(gray: &Gray) -> Vec<(usize, usize)> {
    let (width, height) = (gray.width, gray.height);
    let reach = 3;
    let [mx, my] = SMALL_PATCH.map(|m| m.max(reach + 1));
    if width <= 2 * mx || height <= 2 * my {
        return Vec::new();
    }
    let slope = |x: usize, y: usize| {
        let v = |x: usize, y: usize| gray.values[y * width + x];
        [(v(x + 1, y) - v(x - 1, y)) / 2.0, (v(x, y + 1) - v(x, y - 1)) / 2.0]
    };
    let strength = |x: usize, y: usize| {
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for j in y - reach..=y + reach {
            for i in x - reach..=x + reach {
                let [gx, gy] = slope(i, j);
                xx += gx * gx;
                xy += gx * gy;
                yy += gy * gy;
            }
        }
        // The smaller eigenvalue (Shi and Tomasi 1994); edges across count half, for ripples blur them away.
        let (xy, yy) = (std::f32::consts::FRAC_1_SQRT_2 * xy, 0.5 * yy);
        0.5 * (xx + yy - ((xx - yy).powi(2) + 4.0 * xy * xy).sqrt())
    };
    let cells: Vec<(usize, usize)> = (my..height - my)
        .step_by(CELL)
        .flat_map(|y| (mx..width - mx).step_by(CELL).map(move |x| (x, y)))
        .collect();
    cells
        .into_par_iter()
        .filter_map(|(left, top)| {
            let inside = (top..(top + CELL).min(height - my))
                .flat_map(|y| (left..(left + CELL).min(width - mx)).map(move |x| (x, y)));
            let best = inside.map(|(x, y)| (strength(x, y), (x, y))).max_by(|a, b| a.0.total_cmp(&b.0))?;
            let pixels = (2 * reach + 1).pow(2) as f32;
            (best.0 > 0.5 * pixels).then_some(best.1)
        })
        .collect()
}

/// What the corners of a small picture find below themselves.
pub(super) struct Votes {
    /// Corner and image of every match, small pixels.
    pub(super) matches: Vec<[(isize, isize); 2]>,
    /// How many corners there are.
    pub(super) corners: usize,
}

/// Lets the corners of a small leveled picture vote.
pub(super) fn votes(small: &Gray) -> Votes {
    let patches = Patches::new(small, SMALL_PATCH);
    let corners = corners(small);
    let cones: Vec<Cone> = corners.par_iter().filter_map(|&corner| below(&patches, corner)).collect();
    let matches = cones.par_iter().filter_map(|cone| cone.confirmed(&patches)).collect();
    Votes { matches, corners: corners.len() }
}

/// What a corner looks like upside down in the cone below it.
struct Cone {
    corner: (usize, usize),
    best: (isize, isize),
    clear: bool,
}

fn lean(rows: usize) -> isize {
    (LEAN.0 + LEAN.1 * rows as f64) as isize
}

fn below(patches: &Patches, corner: (usize, usize)) -> Option<Cone> {
    let (x, y) = (corner.0 as isize, corner.1 as isize);
    let template = patches.template(x, y, true, CONTRAST)?;
    let places = |row: isize| row - y >= NEAREST;
    let scores = cone(patches, &template, (x, y), places, DIMMED_CONTRAST);
    let (best, clear) = clear_best(&scores)?;
    Some(Cone { corner, best, clear })
}

impl Cone {
    /// Corner and image, if that is the best place by far and looking back finds the corner.
    fn confirmed(&self, patches: &Patches) -> Option<[(isize, isize); 2]> {
        if !self.clear {
            return None;
        }
        let corner = (self.corner.0 as isize, self.corner.1 as isize);
        let template = patches.template(self.best.0, self.best.1, true, DIMMED_CONTRAST)?;
        let y = self.best.1;
        let scores = cone(patches, &template, self.best, |row| y - row >= NEAREST, CONTRAST);
        let (back, clear) = clear_best(&scores)?;
        let near = (back.0 - corner.0).abs().max((back.1 - corner.1).abs()) <= 2;
        (clear && near).then_some([corner, self.best])
    }
}

/// Every place of a cone with its correlation.
fn cone(
    patches: &Patches,
    template: &Template,
    (x, y): (isize, isize),
    rows: impl Fn(isize) -> bool,
    contrast: f32,
) -> Vec<((isize, isize), f32)> {
    let mut scores = Vec::new();
    for row in (0..patches.rows() as isize).filter(|&row| rows(row)) {
        let lean = lean(row.abs_diff(y));
        scores
            .extend((x - lean..=x + lean).map(|at| ((at, row), patches.score(template, at, row, contrast))));
    }
    scores
}

/// The best place of a cone, and whether it is good and no other comes near it.
fn clear_best(scores: &[((isize, isize), f32)]) -> Option<((isize, isize), bool)> {
    let (place, best) = *scores.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let apart = |other: (isize, isize)| (other.0 - place.0).abs().max((other.1 - place.1).abs()) > 3;
    let next = scores.iter().filter(|(other, _)| apart(*other)).map(|(_, score)| *score).fold(-1.0, f32::max);
    (best > -1.0).then_some((place, best > SMALL_SCORE && 1.0 - next > RATIO * (1.0 - best) + 0.02))
}

/// The best of several places where a corner's image is expected, within [`GUIDED`] pixels.
pub(super) fn guided(
    patches: &Patches,
    (x, y): (usize, usize),
    places: impl Iterator<Item = DVec2>,
) -> Option<[(isize, isize); 2]> {
    let corner = (x as isize, y as isize);
    let template = patches.template(corner.0, corner.1, true, CONTRAST)?;
    let near = places.filter(|place| place.y - y as f64 > NEAREST as f64).filter_map(|place| {
        let pixel = (place.x.floor() as isize, place.y.floor() as isize);
        patches.peak(&template, pixel, GUIDED, DIMMED_CONTRAST)
    });
    let best = near.max_by(|a, b| a.score.total_cmp(&b.score))?;
    (best.score > SMALL_SCORE).then_some([corner, best.pixel])
}

/// How far from where an axis puts it an image is looked for, small pixels.
const GUIDED: isize = 2;

/// A match of the small picture as it is, its pixels `factor` of the full one's wide.
pub(super) fn unrefined(found: [(isize, isize); 2], factor: f64) -> Match {
    let [point, image] = found.map(|(x, y)| DVec2::new(x as f64 + 0.5, y as f64 + 0.5) * factor);
    Match { point, image, score: f64::from(SMALL_SCORE), deviation: DVec2::splat(factor) }
}

/// Finds matches of the small picture again in larger ones: each comes with how many of the *last* one's pixels its own
/// are wide, the small one's `factor` likewise. Results are in pixels of the last, as exact as the largest picture in
/// which the match could still be found; ripples may drown it in the full one.
pub(super) fn refined(found: &[[(isize, isize); 2]], factor: f64, larger: &[(Patches, f64)]) -> Vec<Match> {
    found
        .par_iter()
        .filter_map(|&[corner, image]| {
            let mut found = unrefined([corner, image], factor);
            let mut result = None;
            let mut previous = factor;
            for (patches, own) in larger {
                let reach = (previous / own).ceil() as isize + 1;
                let Some(refined) = refine(patches, found.point / own, found.image / own, reach) else {
                    break;
                };
                found = refined.scaled(*own);
                result = Some(found);
                previous = *own;
            }
            result
        })
        .collect()
}

/// Looks for the image of a point near `image`, and back from there.
pub(super) fn refine(patches: &Patches, point: DVec2, image: DVec2, reach: isize) -> Option<Match> {
    let pixel = |p: DVec2| (p.x.floor() as isize, p.y.floor() as isize);
    let center = |(x, y): (isize, isize)| DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
    let own = pixel(point);
    let template = patches.template(own.0, own.1, true, CONTRAST)?;
    let there = patches.peak(&template, pixel(image), reach, DIMMED_CONTRAST)?;
    let template = patches.template(there.pixel.0, there.pixel.1, true, DIMMED_CONTRAST)?;
    let back = patches.peak(&template, own, reach, CONTRAST)?;
    // Both searches start at whole pixels; mirrored, an image further down belongs to a point further up.
    let expected = center(own) - (there.at - center(there.pixel)) * DVec2::new(1.0, -1.0);
    let off = back.at - expected;
    if there.score < SCORE || off.length() > RETURN {
        return None;
    }
    // How far the peak can move before it sinks by what noise may do to it; a patch holds some ten independent pixels.
    let noise = f64::from(1.0 - there.score).max(1e-3) / 10.0;
    let spread = |bend: f32, off: f64| (noise / f64::from(bend).max(1e-3)).sqrt().hypot(off / 2.0);
    let deviation = DVec2::new(spread(there.bends[0], off.x), spread(there.bends[1], off.y));
    Some(Match { point: center(own), image: there.at, score: f64::from(there.score), deviation })
}
