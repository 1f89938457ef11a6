//! First drafts of water, sky and ground.
//!
//! Water is what mirrors about one of the axes, and what looks like that and is joined to it; sky is what looks like
//! the picture's upper border and is joined to it; ground is what is left below the horizon and runs out of the frame.
//! All is judged in a small picture and brought to the edges of the full one. No learning: a person mends what is wrong.

use glam::{DVec2, Vec3};
use rayon::prelude::*;

use super::colors::{Colors, nearest};
use super::dimming::Dimming;
use super::gray::Gray;
use super::guide::Guide;
use super::patches::Patches;
use super::reflection::Reflection;
use super::spread::{Evidence, spread};
use super::thin::without_thin;
use crate::picture::{Mask, Picture, PicturePoint};

/// Rows of the small picture, at most.
const ROWS: usize = 240;
/// Patches in which mirroring is looked for.
const PATCH: [usize; 2] = [5, 5];
/// Correlations from which a place mirrors, and below which it does not.
const MIRRORS: f32 = 0.65;
const DIFFERS: f32 = 0.5;
/// Contrast that says anything, gray levels.
const CONTRAST: f32 = 2.0;
/// A region smaller than this share of the picture is none.
const LEAST: f64 = 0.005;

/// What the color that a mirror image should have is worth as evidence, and a patch that does not mirror.
const COLOR: f32 = 0.08;
const UNLIKE: f32 = 0.4;

/// What one place below the horizon has to do with those it could mirror.
enum Mirrored {
    /// It lies above every axis.
    Never,
    /// It is the image of this pixel, with this correlation.
    Well(usize, f32),
    /// It could be the image of one of these, but does not look it; by how much its correlation is too low.
    Perhaps(Vec<usize>, f32),
}

/// A region to propose.
#[derive(Clone, Debug)]
pub struct SuggestedRegion {
    /// Its coverage, of the picture's size.
    pub mask: Mask,
    /// How sure it is on the whole, 0–1.
    pub confidence: f64,
    /// Where it comes from, one sentence.
    pub reason: String,
}

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct SuggestedRegions {
    /// Visible water; never without a reflection.
    pub water: Option<SuggestedRegion>,
    /// Visible sky.
    pub sky: Option<SuggestedRegion>,
    /// Visible ground.
    pub ground: Option<SuggestedRegion>,
}

/// The picture as regions are judged in, and what was found so far.
struct Judge<'a> {
    picture: &'a Picture,
    colors: Colors,
    rough: Vec<f32>,
    factor: usize,
    /// Row of the horizon in each column of the small picture.
    horizon: Vec<f64>,
}

/// Proposes regions for a picture with a horizon through `ends`.
#[must_use]
pub fn suggest_regions(
    picture: &Picture,
    reflection: Option<&Reflection>,
    ends: [PicturePoint; 2],
) -> SuggestedRegions {
    let factor = (picture.size().y as usize).div_ceil(ROWS);
    let colors = Colors::of(picture, factor);
    let [left, right] = ends;
    let slope = (right.y() - left.y()) / (right.x() - left.x()).abs().max(1.0);
    let row = |x: usize| (left.y() + slope * ((x as f64 + 0.5) * factor as f64 - left.x())) / factor as f64;
    let horizon = (0..colors.width).map(row).collect();
    let rough = colors.roughness();
    let judge = Judge { picture, colors, rough, factor, horizon };
    let (water, sky) = rayon::join(|| reflection.map(|found| judge.water(found)), || judge.sky());
    let ground = judge.ground(water.as_deref());
    let guide = Guide::new(picture, factor);
    let region = |values: Option<Vec<f32>>, reason: &str, most: f64| {
        let values = values?;
        let share = values.iter().filter(|value| **value > 0.0).count() as f64 / values.len() as f64;
        let sure: f64 = values.iter().map(|value| f64::from(value.abs())).sum::<f64>() / values.len() as f64;
        let mask = guide.mask([judge.colors.width, judge.colors.height], &values)?;
        (share > LEAST).then(|| SuggestedRegion { mask, confidence: most * sure, reason: reason.to_owned() })
    };
    let trust = reflection.map_or(0.0, |found| found.axis.confidence);
    let ground_reason = if reflection.is_some() {
        "what is left below the horizon and runs out of the frame"
    } else {
        "all that lies below the horizon, for no water was found"
    };
    SuggestedRegions {
        water: region(
            water,
            "where the picture mirrors what stands above it, and what looks like that",
            trust,
        ),
        sky: region(sky, "what looks like the upper border and is joined to it", 0.9)
            .map(|sky| SuggestedRegion { mask: without_thin(picture, sky.mask), ..sky }),
        ground: region(Some(ground), ground_reason, if reflection.is_some() { 0.6 } else { 0.3 }),
    }
}

impl Judge<'_> {
    fn below(&self, i: usize) -> f64 {
        let (x, y) = (i % self.colors.width, i / self.colors.width);
        y as f64 + 0.5 - self.horizon[x]
    }

    /// Where water is likely (above 0) or not.
    fn water(&self, reflection: &Reflection) -> Vec<f32> {
        let gray = Gray::of(self.picture).shrunk(self.factor);
        let turn = reflection.turn.scaled(1.0 / self.factor as f64);
        let patches = Patches::new(&gray, PATCH);
        let axes: Vec<f64> = reflection.axes().iter().map(|axis| axis / self.factor as f64).collect();
        let nadir = reflection.nadir();
        // The highest axis that many matches share bounds the water.
        let top = axes.iter().copied().fold(f64::INFINITY, f64::min);
        let width = self.colors.width;
        let scale = self.factor as f64;
        let judged: Vec<Mirrored> = (0..self.colors.values.len())
            .into_par_iter()
            .map(|i| {
                let (x, y) = (i % width, i / width);
                let level = turn.level(DVec2::new(x as f64 + 0.5, y as f64 + 0.5));
                if self.below(i) < 0.5 || level.y < top + 1.0 {
                    return Mirrored::Never;
                }
                let sources: Vec<(isize, isize)> = axes
                    .iter()
                    .filter(|axis| level.y - **axis > 1.5)
                    .map(|axis| {
                        let row = 2.0 * axis - level.y;
                        let column = nadir.column(level * scale, row * scale) / scale;
                        let place = turn.picture(DVec2::new(column, row));
                        (place.x.floor() as isize, place.y.floor() as isize)
                    })
                    .collect();
                let template = patches.template(x as isize, y as isize, true, CONTRAST);
                let peaks = template.iter().flat_map(|template| {
                    sources.iter().filter_map(|&source| patches.peak(template, source, 2, CONTRAST))
                });
                // What it shows may lie above the frame.
                let unseen = sources.iter().any(|&(_, y)| y < PATCH[1] as isize);
                let best = peaks.max_by(|a, b| a.score.total_cmp(&b.score));
                let inside = |&(x, y): &(isize, isize)| {
                    let inside = x >= 0 && y >= 0 && x < width as isize && y < self.colors.height as isize;
                    inside.then(|| y as usize * width + x as usize)
                };
                match best {
                    Some(peak) if peak.score > MIRRORS => inside(&peak.pixel)
                        .map_or(Mirrored::Perhaps(Vec::new(), 0.0), |source| {
                            Mirrored::Well(source, peak.score)
                        }),
                    _ if unseen => Mirrored::Perhaps(Vec::new(), 0.0),
                    best => {
                        let off = best.map_or(0.0, |peak| (DIFFERS - peak.score).max(0.0));
                        Mirrored::Perhaps(sources.iter().filter_map(inside).collect(), off)
                    }
                }
            })
            .collect();
        let values = &self.colors.values;
        let row = |i: usize| (i / width) as f64 / self.colors.height as f64;
        let seed = |source: usize, i: usize| (values[source], values[i], row(i));
        let seeds = judged.iter().enumerate().filter_map(|(i, mirrored)| match mirrored {
            Mirrored::Well(source, _) => Some(seed(*source, i)),
            _ => None,
        });
        let dimming = Dimming::of(&seeds.collect::<Vec<_>>());
        let evidence: Vec<Evidence> = judged
            .iter()
            .enumerate()
            .map(|(i, mirrored)| match mirrored {
                Mirrored::Never => Evidence { value: -1.0, weight: 1.0 },
                Mirrored::Well(_, score) => Evidence { value: 1.0, weight: score - MIRRORS },
                Mirrored::Perhaps(sources, off) => {
                    let misses = sources.iter().map(|&source| dimming.miss(seed(source, i)));
                    let miss = misses.fold(f32::INFINITY, f32::min);
                    let like = if miss.is_finite() { (1.0 - miss / 2.5).clamp(-1.0, 1.0) } else { 0.0 };
                    let weight = COLOR * like.abs() + off * UNLIKE;
                    Evidence { value: (COLOR * like - off * UNLIKE) / weight.max(1e-6), weight }
                }
            })
            .collect();
        let mut evidence = evidence;
        for m in &reflection.matches {
            let at = turn.picture(m.image / scale);
            let (x, y) = (at.x as usize, at.y as usize);
            if x < width && y < self.colors.height && evidence[y * width + x].value > -1.0 {
                evidence[y * width + x] = Evidence { value: 1.0, weight: 1.0 };
            }
        }
        spread(&self.colors, &evidence)
    }

    /// Where sky is likely; `None` where the upper border does not look like any.
    fn sky(&self) -> Option<Vec<f32>> {
        let Colors { width, height, ref values } = self.colors;
        let strip = (height / 16).max(1) * width;
        let smooth: Vec<usize> =
            (0..strip).filter(|&i| self.rough[i] < SMOOTH && self.below(i) < 0.0).collect();
        let bright = smooth.iter().filter(|&&i| looks_like_sky(values[i])).count();
        if smooth.len() * 4 < strip || bright * 3 < smooth.len() * 2 {
            return None;
        }
        // A mountain may reach the upper border beside the sky.
        let border = self.colors.palette(&smooth, 6);
        let best = border.iter().map(|color| skyness(*color)).fold(f32::MIN, f32::max);
        let (skies, mut others): (Vec<Vec3>, Vec<Vec3>) =
            border.into_iter().partition(|color| skyness(*color) > best - SKY_RANGE);
        let far = |palette: &[Vec3], color: Vec3| nearest(palette, color).map_or(200.0, |(_, off)| off);
        let near_horizon = |i: &usize| (-0.02..0.06).contains(&(-self.below(*i) / height as f64));
        let land: Vec<usize> = (0..values.len()).filter(near_horizon).collect();
        others.extend(self.colors.palette(&land, 5).into_iter().filter(|color| far(&skies, *color) > 25.0));
        let evidence: Vec<Evidence> = (0..values.len())
            .map(|i| {
                if self.below(i) > 0.0 {
                    return Evidence { value: -1.0, weight: 1.0 };
                }
                let (sky, other) = (far(&skies, values[i]), far(&others, values[i]));
                let value = (2.0 * (other - sky) / (other + sky + 6.0)).clamp(-1.0, 1.0);
                let rough = if self.rough[i] > SMOOTH { 0.2 } else { 1.0 };
                Evidence { value, weight: 0.12 * value.abs() * if value > 0.0 { rough } else { 1.0 } }
            })
            .collect();
        let mut found = joined(spread(&self.colors, &evidence), width, |i| i < width);
        // Clouds and gaps in the sky that reach neither land nor border are sky.
        let rest: Vec<f32> = found.iter().map(|value| if *value > 0.0 { -1.0 } else { 1.0 }).collect();
        let outside = joined(rest, width, |i| i / width + 1 == height);
        let holes = found.iter_mut().zip(&outside).filter(|(sky, outside)| **sky <= 0.0 && **outside < 0.0);
        holes.for_each(|(sky, _)| *sky = 0.5);
        Some(found)
    }

    /// Ground: below the horizon, not water, running out of the frame.
    fn ground(&self, water: Option<&[f32]>) -> Vec<f32> {
        let Colors { width, height, ref values } = self.colors;
        // A far shore's strip is part of the background.
        let margin = if water.is_some() { 0.06 * height as f64 } else { 0.0 };
        let dry = |i: usize| {
            let low = ((self.below(i) - margin) / 2.0).clamp(-1.0, 1.0) as f32;
            water.map_or(low, |water| low.min(-water[i]))
        };
        let border = |i: usize| i.is_multiple_of(width) || i % width + 1 == width || i / width + 1 == height;
        joined((0..values.len()).map(dry).collect(), width, border)
    }
}

/// How bright and blue a color is, codes.
fn skyness(color: Vec3) -> f32 {
    color.element_sum() / 6.0 + 0.7 * (color.z - color.x)
}

/// A sky's colors are at most this much less bright and blue than its best one: white clouds beside blue.
const SKY_RANGE: f32 = 45.0;
/// Roughness that skies have, codes.
const SMOOTH: f32 = 14.0;

/// Bluish or bright and pale: not leaves, earth or night.
fn looks_like_sky(color: Vec3) -> bool {
    let pale = color.max_element() - color.min_element() < 60.0 && color.element_sum() > 270.0;
    pale || (color.z >= color.y && color.z > color.x + 8.0 && color.element_sum() > 180.0)
}

/// Leaves above 0 only what is joined to a pixel above 0 for which `from` holds.
fn joined(mut values: Vec<f32>, width: usize, from: impl Fn(usize) -> bool) -> Vec<f32> {
    let mut reached = vec![false; values.len()];
    let mut open: Vec<usize> = (0..values.len()).filter(|&i| values[i] > 0.0 && from(i)).collect();
    open.iter().for_each(|&i| reached[i] = true);
    while let Some(i) = open.pop() {
        let x = i % width;
        let sides = [
            (x > 0).then(|| i - 1),
            (x + 1 < width).then_some(i + 1),
            i.checked_sub(width),
            Some(i + width).filter(|&below| below < values.len()),
        ];
        for next in sides.into_iter().flatten() {
            if values[next] > 0.0 && !reached[next] {
                reached[next] = true;
                open.push(next);
            }
        }
    }
    for (value, reached) in values.iter_mut().zip(reached) {
        if *value > 0.0 && !reached {
            *value = -0.5;
        }
    }
    values
}
