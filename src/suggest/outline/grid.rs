//! A block of the picture as a grid to be cut: what is certain, what borders cost, the cut of least energy.

use glam::{DVec2, Vec2, Vec3};
use rayon::prelude::*;

use super::hints::ObjectHints;
use super::max_flow::{GridCut, STEPS};
use super::mixture::{Mixture, PLACE, Sample};
use super::scaled::Scaled;
use crate::picture::{Picture, PixelRect, distances};

/// What a border across even color costs a link (γ of the paper): of a body, and of foliage, which is all border.
const GAMMA: f32 = 50.0;
const LEAF_GAMMA: f32 = 20.0;

/// Steps of energy: capacities are integers.
const SCALE: f32 = 65_536.0;

/// A capacity above all links of a cell together.
const CERTAIN: i32 = 1 << 29;

/// What it costs at most, each cell, to be on the side whose marks are farther away, natural logarithm of a likelihood ratio:
/// colors decide, places where they are undecided.
const LEAN: f32 = 2.0;

/// What strokes weigh against all that is on their side, when they are a small part of it; and a cell of them at most.
const STROKES: f32 = 0.3;
const MOST_WEIGHT: f32 = 30.0;

/// How far from the border of a coarser grid the finer one may run, cells of the coarser.
const BAND: usize = 4;

/// A block of the picture to be cut.
#[derive(Debug)]
pub(super) struct Grid {
    pub scaled: Scaled,
    /// Color and place of each cell.
    pub samples: Vec<Sample>,
    /// Whether a stroke says what a cell is.
    pub is_stroked: Vec<bool>,
    /// What is certain of each cell.
    pub known: Vec<Option<bool>>,
    /// What a border towards the neighbors at the steps 0, 2, 4, 6 costs, in steps of energy.
    links: Vec<[i32; 4]>,
    /// What being inside costs for its place, below 0: being outside.
    lean: Vec<f32>,
}

/// How much a stroked cell counts outside and inside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights([f32; 2]);

impl Weights {
    /// How much a cell labeled `side` counts.
    pub(super) fn of(self, grid: &Grid, cell: usize, side: bool) -> f32 {
        if grid.is_stroked[cell] { self.0[usize::from(side)] } else { 1.0 }
    }
}

impl Grid {
    /// The block `rect` on at most `most` cells (nearly).
    pub(super) fn new(picture: &Picture, hints: &ObjectHints, rect: PixelRect, most: u32) -> Self {
        let scaled = Scaled::new(picture, rect, most);
        let (known, is_stroked) = hints.known(picture.size(), &scaled);
        let samples = samples(&scaled, hints.extent(picture.size(), rect));
        let gamma = if hints.is_solid { GAMMA } else { LEAF_GAMMA };
        Self { links: links(&scaled, gamma), lean: lean(&scaled, &known), samples, is_stroked, known, scaled }
    }

    /// Makes certain what a coarser grid says farther than the band from its border.
    pub(super) fn keep_far_from_border(&mut self, coarse: &Scaled, inside: &[bool]) {
        let (width, height) = (coarse.width, coarse.height);
        // Cells that all within the band around agree with, rows first.
        let all_near = |is: &[bool], step: usize, count: usize| -> Vec<bool> {
            let cells = (0..is.len()).into_par_iter();
            cells
                .map(|cell| {
                    let at = cell / step % count;
                    let (back, on) = (at.min(BAND), (count - 1 - at).min(BAND));
                    (0..=back + on).all(|k| is[cell - back * step + k * step])
                })
                .collect()
        };
        let far_within = |is: &[bool]| all_near(&all_near(is, 1, width), width, height);
        let outside: Vec<bool> = inside.iter().map(|inside| !inside).collect();
        let [outer, inner] = [far_within(&outside), far_within(inside)];
        for (cell, known) in self.known.iter_mut().enumerate() {
            let pixel = self.scaled.pixel(cell);
            let Some(coarse) = coarse.cell(pixel.x, pixel.y) else { continue };
            if known.is_none() && (outer[coarse] || inner[coarse]) {
                *known = Some(inner[coarse]);
            }
        }
    }

    /// How much a stroked cell counts on each side, labeled so.
    pub(super) fn weights(&self, labels: &[Option<bool>]) -> Weights {
        let weight = |side: bool| {
            let all = labels.iter().filter(|label| **label == Some(side)).count() as f32;
            let stroked = self.known.iter().zip(&self.is_stroked);
            let stroked = stroked.filter(|(known, is)| **is && **known == Some(side)).count() as f32;
            (STROKES * all / stroked.max(1.0)).clamp(1.0, MOST_WEIGHT)
        };
        Weights([weight(false), weight(true)])
    }

    /// What each cell costs outside and inside, for its color and its place.
    pub(super) fn costs(&self, mixtures: &[Mixture; 2]) -> Vec<[f32; 2]> {
        let cells = self.samples.par_iter().zip(&self.lean);
        cells
            .map(|(sample, lean)| {
                let [outer, inner] = [0, 1].map(|side| mixtures[side].cheapest(sample).1);
                [outer + (-lean).max(0.0), inner + lean.max(0.0)]
            })
            .collect()
    }

    /// The labels of least energy, given what each cell costs outside and inside; `None` when `go_on` said no.
    pub(super) fn cut(&self, costs: &[[f32; 2]], go_on: &dyn Fn() -> bool) -> Option<Vec<bool>> {
        let mut grid = GridCut::new(self.scaled.width, self.scaled.height);
        for (cell, known) in self.known.iter().enumerate() {
            let [outer, inner] = costs[cell];
            let capacity = match known {
                Some(true) => CERTAIN,
                Some(false) => -CERTAIN,
                // Kept below certainty; beyond a thousand nothing changes.
                None => ((outer - inner).clamp(-1000.0, 1000.0) * SCALE) as i32,
            };
            grid.set_terminal(cell, capacity);
            for (half, capacity) in self.links[cell].iter().enumerate() {
                if *capacity > 0 {
                    grid.set_link(cell, 2 * half, *capacity);
                }
            }
        }
        grid.cut(go_on)?;
        Some((0..costs.len()).map(|cell| grid.is_with_source(cell)).collect())
    }

    /// Share of the cells that are not certain which labels put inside.
    pub(super) fn share_of_free(&self, inside: &[bool]) -> f64 {
        let free = || self.known.iter().zip(inside).filter(|(known, _)| known.is_none());
        free().filter(|(_, inside)| **inside).count() as f64 / free().count().max(1) as f64
    }

    /// What labels cost, data and border together.
    pub(super) fn energy(&self, costs: &[[f32; 2]], inside: &[bool]) -> f64 {
        let width = self.scaled.width as isize;
        let mut energy = 0.0;
        for (cell, label) in inside.iter().enumerate() {
            energy += f64::from(costs[cell][usize::from(*label)]);
            for (half, capacity) in self.links[cell].iter().enumerate() {
                let [dx, dy] = STEPS[2 * half];
                let next = cell.wrapping_add_signed(dy as isize * width + dx as isize);
                if *capacity > 0 && inside[next] != *label {
                    energy += f64::from(*capacity) / f64::from(SCALE);
                }
            }
        }
        energy
    }
}

/// What a border between a cell and its neighbors at the steps 0, 2, 4, 6 costs, in steps of energy; 0 beyond the block.
fn links(scaled: &Scaled, gamma: f32) -> Vec<[i32; 4]> {
    let (width, height) = (scaled.width, scaled.height);
    let neighbor = |cell: usize, step: usize| {
        let x = cell % width + 1;
        let x = x.wrapping_add_signed(STEPS[step][0] as isize);
        let y = cell / width + STEPS[step][1] as usize;
        (x >= 1 && x <= width && y < height).then(|| y * width + x - 1)
    };
    let contrast = |a: usize, b: usize| scaled.colors[a].distance_squared(scaled.colors[b]);
    // Row by row in order, so that the sum does not depend on the number of cores.
    let rows: Vec<[f64; 2]> = (0..height)
        .into_par_iter()
        .map(|y| {
            let mut sums = [0.0; 2];
            for cell in y * width..(y + 1) * width {
                for step in [0, 2, 4, 6] {
                    if let Some(next) = neighbor(cell, step) {
                        sums[0] += f64::from(contrast(cell, next));
                        sums[1] += 1.0;
                    }
                }
            }
            sums
        })
        .collect();
    let [sum, count] = rows.iter().fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
    // An even picture has no contrast to compare with.
    let beta = if sum > 0.0 { (count / (2.0 * sum)) as f32 } else { 0.0 };
    (0..width * height)
        .into_par_iter()
        .map(|cell| {
            [0, 2, 4, 6].map(|step| {
                neighbor(cell, step).map_or(0, |next| {
                    let length = if step < 4 { 1.0 } else { std::f32::consts::SQRT_2 };
                    (SCALE * gamma * (-beta * contrast(cell, next)).exp() / length) as i32
                })
            })
        })
        .collect()
}

/// Color and place of each cell, the place as a share of `extent`, pixels.
fn samples(scaled: &Scaled, extent: DVec2) -> Vec<Sample> {
    let step = (f64::from(scaled.factor) / extent).as_vec2() * PLACE;
    let sample = |(cell, color): (usize, &Vec3)| {
        let at = (Vec2::new((cell % scaled.width) as f32, (cell / scaled.width) as f32) + 0.5) * step;
        [at.x, at.y, color.x, color.y, color.z]
    };
    scaled.colors.par_iter().enumerate().map(sample).collect()
}

/// By how much nearer each cell is to what is certainly outside than to what is certainly inside, as a cost; nothing where
/// one of them is missing.
fn lean(scaled: &Scaled, known: &[Option<bool>]) -> Vec<f32> {
    if !known.contains(&Some(true)) || !known.contains(&Some(false)) {
        return vec![0.0; known.len()];
    }
    let [to_outer, to_inner] =
        [false, true].map(|side| distances(scaled.width, scaled.height, |cell| known[cell] == Some(side)));
    let share = |(outer, inner): (&f32, &f32)| LEAN * (inner - outer) / (inner + outer).max(1.0);
    to_outer.iter().zip(&to_inner).map(share).collect()
}
