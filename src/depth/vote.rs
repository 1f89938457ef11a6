//! Shifts that keep to the picture's edges: every pixel asks its neighbors of like color.
//!
//! Supports reach over silhouettes, so that a strip of sky around a tree moves with the tree, and leave gaps. Neighbors
//! count as much as they are alike, near, trusted, and as they have texture of their own: a smooth pixel beside a strong
//! edge was matched by that edge, which is not its. Votes for what the water rules out at a pixel are void, and likes that
//! were not matched have a say as well: with a shift that the water rules out for them they do not agree.

use std::f32::consts::TAU;

use rayon::prelude::*;

use super::levels::Shifts;
use super::plane::box_sum;
use super::view::{Kind, View};
use super::visibility::{Seen, Sight};

/// How far neighbors are asked, pixels, and how many. Beside an outline what is farther off is hidden in the water as
/// far as the shifts on both sides differ, and the few that speak there were matched by the outline: voters must reach
/// beyond it.
const REACH: f32 = 40.0;
const ASKED: usize = 128;
/// What the pixel itself counts, as a multiple of what one beside it does.
const OWN: f32 = 2.0;
/// Colors this far apart, in codes, are not alike.
const ALIKE: f32 = 32.0;
/// Half side of what a pixel's match was made with.
const WITH: usize = 6;
/// Brightness farther off than this, in codes, is something else.
const LIKE: f32 = 20.0;
/// As part of what a pixel was matched with, this much texture of its own counts half.
const LITTLE: f32 = 0.1;
/// Standard deviation of a pixel's noise against those next to it, codes. Lower than what contrasts are held against: where
/// more is taken for noise, nothing in haze has a say but its edge, which then speaks for what lies behind it too.
const NOISE: f32 = 1.0;
/// Votes that make up full confidence; one is a trusted neighbor of the same color.
const ENOUGH: f32 = 0.6;

/// What a like that was not matched counts, as a part of one that was, where the water says nothing of it: hardly
/// anything, most often there is just nothing to match.
const SILENT: f32 = 0.02;

/// Bins of shifts: fine near 0, in proportion farther off.
const BINS: usize = 220;
const LINEAR: f32 = 3.0;
const PER_E: f32 = 32.0;
const ZERO: f32 = 36.0;
/// Bins to each side that vote together, a tenth of a shift: so no border parts what belongs together.
const TOGETHER: usize = 3;
/// Groups of votes that are held against each other.
const CANDIDATES: usize = 2;

/// Takes the shift on which most of a pixel's likes agree, `seen` in the water or hidden there.
pub(super) fn vote(view: &View, shifts: &Shifts, seen: &Seen) -> Shifts {
    let evidence = evidence(view);
    let others = (1..ASKED).map(|i| {
        // A sunflower's pattern covers the disk evenly.
        let part = (i as f32 / ASKED as f32).sqrt();
        let angle = TAU * 0.618_034 * i as f32;
        let (x, y) = (part * REACH * angle.cos(), part * REACH * angle.sin());
        (x.round() as isize, y.round() as isize, 1.0 - 0.75 * part * part)
    });
    let asked = std::iter::once((0, 0, OWN)).chain(others).collect();
    let polls = Polls { view, shifts, seen, evidence, asked };
    let voted: Vec<(f32, f32, f32)> = (0..view.kinds.len())
        .into_par_iter()
        .map_init(Vec::new, |silent, cell| match view.kinds[cell] {
            Kind::Direct => polls.elect(cell, silent),
            _ => NONE,
        })
        .collect();
    Shifts {
        shift: voted.iter().map(|v| v.0).collect(),
        deviation: voted.iter().map(|v| v.1).collect(),
        confidence: voted.iter().map(|v| v.2).collect(),
    }
}

/// The part of what a pixel was matched with that is its own texture, 0–1.
fn evidence(view: &View) -> Vec<f32> {
    let sums = |power: i32| {
        let of = |(g, kind): (&f32, &Kind)| if *kind == Kind::Direct { (g - 128.0).powi(power) } else { 0.0 };
        let values: Vec<f32> = view.gray.par_iter().zip(&view.kinds).map(of).collect();
        box_sum(view.width, &values, WITH, WITH)
    };
    let (count, sum, squares) = (sums(0), sums(1), sums(2));
    let noise = NOISE * NOISE;
    (0..count.len())
        .into_par_iter()
        .map(|cell| {
            let count = count[cell].max(1.0);
            let with = (squares[cell] / count - (sum[cell] / count).powi(2)).max(0.0);
            let part = (own_variance(view, cell) - noise * 0.5).max(0.0) / (with + noise);
            part / (part + LITTLE)
        })
        .collect()
}

/// Variance of brightness among a pixel and those next to it that are like it: an edge to something else is no texture.
fn own_variance(view: &View, cell: usize) -> f32 {
    let (row, x) = (cell / view.width, cell % view.width);
    let own = view.gray[cell];
    let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for y in row.saturating_sub(1)..=(row + 1).min(view.height - 1) {
        for column in x.saturating_sub(1)..=(x + 1).min(view.width - 1) {
            let off = view.gray[y * view.width + column] - own;
            if off.abs() <= LIKE {
                count += 1.0;
                sum += off;
                squares += off * off;
            }
        }
    }
    squares / count - (sum / count) * (sum / count)
}

/// Neither shift nor deviation, and no confidence.
const NONE: (f32, f32, f32) = (f32::NAN, f32::NAN, 0.0);

/// Votes for nearly the same shift.
#[derive(Clone, Copy, Default)]
struct Votes {
    /// What they weigh by likeness and evidence.
    all: f32,
    /// The same times their confidence, its sum with their shifts and with the squares of these.
    count: f32,
    sum: f32,
    squares: f32,
}

impl Votes {
    fn of(several: &[Self]) -> Self {
        several.iter().fold(Self::default(), |a, b| Self {
            all: a.all + b.all,
            count: a.count + b.count,
            sum: a.sum + b.sum,
            squares: a.squares + b.squares,
        })
    }

    fn mean(&self) -> f32 {
        self.sum / self.count
    }
}

/// Who is asked, and what is known of them.
struct Polls<'a> {
    view: &'a View,
    shifts: &'a Shifts,
    seen: &'a Seen<'a>,
    evidence: Vec<f32>,
    /// Columns, rows and weight.
    asked: Vec<(isize, isize, f32)>,
}

impl Polls<'_> {
    /// Shift, deviation and confidence of a pixel; `silent` is room for its likes that were not matched.
    fn elect(&self, cell: usize, silent: &mut Vec<(usize, f32)>) -> (f32, f32, f32) {
        let mut votes = self.votes(cell, silent);
        for votes in votes.iter_mut().filter(|votes| votes.count > 0.0) {
            if self.seen.sight(cell, votes.mean()) == Sight::Hiding {
                *votes = Votes::default();
            }
        }
        let everything = Votes::of(&votes);
        if everything.count <= 0.0 {
            return NONE;
        }
        let near = |bin: usize, reach: usize| &votes[bin - reach..=bin + reach];
        let mut counts = [0.0_f32; BINS];
        for (bin, count) in counts.iter_mut().enumerate().skip(TOGETHER).take(BINS - 2 * TOGETHER) {
            *count = near(bin, TOGETHER).iter().map(|votes| votes.count).sum();
        }
        let mut candidates = [(0_usize, 0.0_f32); CANDIDATES];
        for nth in 0..CANDIDATES {
            let others = candidates;
            let apart = |bin: usize| others[..nth].iter().all(|other| other.0.abs_diff(bin) > 2 * TOGETHER);
            let (best, most) = (TOGETHER..BINS - TOGETHER)
                .filter(|&bin| apart(bin))
                .map(|bin| (bin, counts[bin]))
                .fold((0, 0.0), |a, b| if b.1 > a.1 { b } else { a });
            if most > 0.0 {
                candidates[nth] =
                    (best, self.confidence(&Votes::of(near(best, TOGETHER)), &everything, silent));
            }
        }
        let (best, confidence) = candidates.into_iter().fold((0, 0.0), |a, b| if b.1 > a.1 { b } else { a });
        if confidence <= 0.0 {
            return NONE;
        }
        let own = self.shifts.shift[cell];
        // What the pixel itself found is finer than what its neighbors have in common.
        let (shift, deviation) = if self.shifts.confidence[cell] > 0.0 && bin(own).abs_diff(best) <= TOGETHER
        {
            (own, self.shifts.deviation[cell])
        } else {
            let elected = Votes::of(near(best, TOGETHER));
            let mean = elected.mean();
            let variance = elected.squares / elected.count - mean * mean;
            (mean, variance.max(0.0).sqrt().max(MADE_UP))
        };
        match self.seen.sight(cell, shift) {
            Sight::Hiding => NONE,
            Sight::Open | Sight::Hidden => (shift, deviation, confidence),
        }
    }

    /// The votes of a pixel's likes by shift, and the weights of those that were not matched.
    fn votes(&self, cell: usize, silent: &mut Vec<(usize, f32)>) -> [Votes; BINS] {
        let view = self.view;
        let (row, x) = ((cell / view.width) as isize, (cell % view.width) as isize);
        let color = view.channels.each_ref().map(|values| values[cell]);
        let mut votes = [Votes::default(); BINS];
        silent.clear();
        for &(dx, dy, weight) in &self.asked {
            let (x, y) = (x + dx, row + dy);
            if x < 0 || y < 0 || x as usize >= view.width || y as usize >= view.height {
                continue;
            }
            let other = y as usize * view.width + x as usize;
            let off: f32 =
                view.channels.iter().zip(color).map(|(v, c)| (v[other] - c) * (v[other] - c)).sum();
            let alike = 1.0 - off / (ALIKE * ALIKE);
            if alike <= 0.0 || view.kinds[other] != Kind::Direct {
                continue;
            }
            let weight = weight * alike * alike * self.evidence[other];
            let confidence = self.shifts.confidence[other];
            if confidence > 0.0 {
                let shift = self.shifts.shift[other];
                let votes = &mut votes[bin(shift)];
                votes.all += weight;
                votes.count += weight * confidence;
                votes.sum += weight * confidence * shift;
                votes.squares += weight * confidence * shift * shift;
            } else {
                silent.push((other, weight));
            }
        }
        votes
    }

    /// How far some votes can be trusted among all of them.
    fn confidence(&self, votes: &Votes, everything: &Votes, silent: &[(usize, f32)]) -> f32 {
        let (mut against, mut unknown) = (0.0, 0.0);
        for &(other, weight) in silent {
            match self.seen.sight(other, votes.mean()) {
                Sight::Hiding => against += weight,
                Sight::Open => unknown += weight,
                // Just what is expected of it.
                Sight::Hidden => {}
            }
        }
        let trusted = votes.count / (everything.all + SILENT * unknown);
        let agreeing = votes.count / (everything.count + against);
        trusted * agreeing * (everything.all / ENOUGH).min(1.0)
    }
}

/// Standard deviation, in pixels, of what was only taken over from others, at least.
const MADE_UP: f32 = 0.25;

fn bin(shift: f32) -> usize {
    // In proportion to a shift beyond `LINEAR`, even below.
    let at = (shift / LINEAR).asinh() * PER_E + ZERO;
    (at.max(0.0) as usize).min(BINS - 1)
}
