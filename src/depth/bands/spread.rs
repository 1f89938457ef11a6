//! Which label every pixel belongs to, from those where one is measured: every pixel hears along eight paths what is
//! measured there (semi-global, Hirschmüller 2008), and a label changes where colors do.
//!
//! Labels count from far to near. What is measured is evidence, not law: matching oversteps outlines. Things stand on what
//! is below them, so upwards a label rather gives way to a farther one than to a nearer one.

use glam::IVec2;

use super::pieces::join_pieces;

/// The most labels: the sky and eight bands.
const LABELS: usize = 9;
/// What a label costs where another is measured; and over a color that it never has.
const MEASURED: f32 = 1.0;
const STRANGE: f32 = 1.0;
/// And where it may not be.
const NEVER: f32 = 1000.0;
/// What a change of label costs where colors stay, in the costs of so many pixels of a picture 1000 pixels wide; and the
/// least, over any edge.
const EVEN: f32 = 16.0;
const EDGE: f32 = 0.4;
/// What a nearer label above a farther one costs beside that: crowns hang over, but seldom.
const OVERHANG: f32 = 3.2;
/// Changes of color up to this are noise and shading, codes; so much more makes a change e times as cheap.
const NOISE: f32 = 5.0;
const SOFT: f32 = 12.0;
/// Colors are told apart in so many steps a channel.
const SHADES: usize = 16;

type Costs = [f32; LABELS];

/// Gives every pixel of `inside` a label of those that `seeds` has; all stay `None` where there is none. A pixel that
/// `may` not have a label gets it only where it has no other beside it.
pub(super) fn spread(
    width: usize,
    colors: &[[u8; 3]],
    inside: &(dyn Fn(usize) -> bool + Sync),
    may: &(dyn Fn(usize, usize) -> bool + Sync),
    seeds: &[Option<u8>],
) -> Vec<Option<u8>> {
    let most = seeds.iter().flatten().max().map_or(0, |&most| usize::from(most) + 1).min(LABELS);
    if most == 0 {
        return vec![None; seeds.len()];
    }
    let strange = strangeness(colors, seeds, most);
    let field = Field { width, colors, inside, may, seeds, strange, most };
    let (down, up) = rayon::join(|| field.sweep(true), || field.sweep(false));
    let cost = |cell: usize, label: usize| down[cell * most + label] + up[cell * most + label];
    let mut labels: Vec<Option<u8>> = (0..seeds.len())
        .map(|cell| {
            let best = (0..most).min_by(|&a, &b| cost(cell, a).total_cmp(&cost(cell, b)));
            best.map(|label| label as u8).filter(|_| inside(cell))
        })
        .collect();
    join_pieces(width, seeds, &cost, &mut labels);
    labels
}

struct Field<'a> {
    width: usize,
    colors: &'a [[u8; 3]],
    inside: &'a (dyn Fn(usize) -> bool + Sync),
    may: &'a (dyn Fn(usize, usize) -> bool + Sync),
    seeds: &'a [Option<u8>],
    /// By color, what each label costs.
    strange: Vec<Costs>,
    most: usize,
}

impl Field<'_> {
    /// Sums of four paths' costs, `most` a pixel: from beside, and from the three pixels of the row before.
    fn sweep(&self, down: bool) -> Vec<f32> {
        let (width, most) = (self.width, self.most);
        let height = self.seeds.len() / width;
        let mut sums = vec![0.0; self.seeds.len() * most];
        let mut before = vec![[[0.0; LABELS]; 3]; width];
        let mut now = before.clone();
        let back = if down { -1 } else { 1 };
        for step in 0..height {
            let row = if down { step } else { height - 1 - step };
            let mut beside = [0.0; LABELS];
            for step in 0..width {
                let x = if down { step } else { width - 1 - step };
                let cell = row * width + x;
                if !(self.inside)(cell) {
                    continue;
                }
                let own = self.own(cell);
                let at = IVec2::new(x as i32, row as i32);
                beside = match self.cell(at + IVec2::new(back, 0), height) {
                    Some(other) => self.go_on(&own, &beside, self.change(cell, other), [0.0; 2]),
                    None => own,
                };
                let mut paths = [own; 3];
                for (path, aside) in paths.iter_mut().zip([-1, 0, 1]) {
                    let Some(other) = self.cell(at + IVec2::new(aside, back), height) else { continue };
                    let overhang = OVERHANG * self.unit();
                    let overhangs = if down { [0.0, overhang] } else { [overhang, 0.0] };
                    let from = &before[other % width][(aside + 1) as usize];
                    *path = self.go_on(&own, from, self.change(cell, other), overhangs);
                }
                for (label, sum) in sums[cell * most..][..most].iter_mut().enumerate() {
                    *sum = beside[label] + paths.iter().map(|path| path[label]).sum::<f32>();
                }
                now[x] = paths;
            }
            std::mem::swap(&mut before, &mut now);
        }
        sums
    }

    /// A path's costs, one pixel on. A change of label costs `change`, and more when it comes from a farther label, or
    /// from a nearer one.
    fn go_on(&self, own: &Costs, from: &Costs, change: f32, [farther, nearer]: [f32; 2]) -> Costs {
        let least = from[..self.most].iter().copied().fold(f32::INFINITY, f32::min);
        let mut costs = *own;
        let mut least_farther = f32::INFINITY;
        for (cost, &from) in costs[..self.most].iter_mut().zip(from) {
            *cost += from.min(least_farther + change + farther) - least;
            least_farther = least_farther.min(from);
        }
        let mut least_nearer = f32::INFINITY;
        for label in (0..self.most).rev() {
            costs[label] = costs[label].min(own[label] + least_nearer + change + nearer - least);
            least_nearer = least_nearer.min(from[label]);
        }
        costs
    }

    /// What each label costs a pixel by itself.
    fn own(&self, cell: usize) -> Costs {
        let mut costs = self.strange[shade(self.colors[cell])];
        if let Some(seed) = self.seeds[cell] {
            let others = costs.iter_mut().enumerate().filter(|(label, _)| *label != usize::from(seed));
            others.for_each(|(_, cost)| *cost += MEASURED);
        }
        for (label, cost) in costs[..self.most].iter_mut().enumerate() {
            if !(self.may)(cell, label) {
                *cost += NEVER;
            }
        }
        costs
    }

    /// What a change of label between two neighbors costs.
    fn change(&self, a: usize, b: usize) -> f32 {
        let channels = self.colors[a].iter().zip(&self.colors[b]);
        let change = channels.map(|(p, q)| f32::from(p.abs_diff(*q))).fold(0.0_f32, f32::max);
        self.unit() * (EDGE + (EVEN - EDGE) * (-(change - NOISE).max(0.0) / SOFT).exp())
    }

    /// A path through the same things has more pixels in a larger picture.
    fn unit(&self) -> f32 {
        self.width as f32 / 1000.0
    }

    /// The pixel at a place, if it takes part.
    fn cell(&self, at: IVec2, height: usize) -> Option<usize> {
        let is_there =
            at.cmpge(IVec2::ZERO).all() && at.cmplt(IVec2::new(self.width as i32, height as i32)).all();
        let cell = is_there.then(|| at.y as usize * self.width + at.x as usize)?;
        Some(cell).filter(|&cell| (self.inside)(cell))
    }
}

/// What each color costs each label: the less, the more of the pixels with that color have the label.
fn strangeness(colors: &[[u8; 3]], seeds: &[Option<u8>], most: usize) -> Vec<Costs> {
    let mut counts = vec![[0.0_f32; LABELS]; SHADES.pow(3)];
    let mut all = [0.0_f32; LABELS];
    for (color, seed) in colors.iter().zip(seeds) {
        if let Some(label) = seed.map(usize::from) {
            counts[shade(*color)][label] += 1.0;
            all[label] += 1.0;
        }
    }
    for counts in &mut counts {
        // A large band is no likelier to have a color than a small one.
        counts.iter_mut().zip(&all).for_each(|(count, all)| *count /= all.max(1.0));
        let sum: f32 = counts[..most].iter().sum();
        // A color that no label has says nothing.
        counts.iter_mut().for_each(|part| *part = STRANGE * if sum > 0.0 { 1.0 - *part / sum } else { 0.5 });
    }
    counts
}

fn shade(color: [u8; 3]) -> usize {
    color.iter().fold(0, |index, &code| index * SHADES + usize::from(code) * SHADES / 256)
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 60;

    /// A picture 60 px wide, 40 px high, by its columns and rows.
    fn painted<T>(of: impl Fn(usize, usize) -> T) -> Vec<T> {
        (0..40 * WIDTH).map(|cell| of(cell % WIDTH, cell / WIDTH)).collect()
    }

    #[test]
    fn labels_keep_to_edges_rather_than_to_the_nearest_seed() {
        let colors = painted(|x, _| if x < 35 { [20; 3] } else { [200; 3] });
        let seeds = painted(|x, _| match x {
            0..5 => Some(1),
            55.. => Some(2),
            _ => None,
        });
        let found = spread(WIDTH, &colors, &|cell| cell / WIDTH < 30, &|_, _| true, &seeds);
        let truth = painted(|x, y| if y >= 30 { None } else { Some(if x < 35 { 1 } else { 2 }) });
        assert!(found == truth);
    }

    #[test]
    fn a_tree_measured_at_its_foot_is_whole_before_the_mountains() {
        // Twelve columns wide, with needles of its own; the mountains are measured up to and over its outline.
        let is_tree = |x: usize, y: usize| (24..36).contains(&x) && y >= 4;
        let colors = painted(|x, y| match (x * 7 + y * 13) % 5 {
            part if is_tree(x, y) => [20 + 9 * part as u8; 3],
            part => [120 + 3 * part as u8; 3],
        });
        let seeds = painted(|x, y| match () {
            () if is_tree(x, y) && y >= 30 => Some(2),
            () if !(26..34).contains(&x) => Some(1),
            () => None,
        });
        let found = spread(WIDTH, &colors, &|_| true, &|_, _| true, &seeds);
        let wrong = painted(|x, y| found[y * WIDTH + x] != Some(if is_tree(x, y) { 2 } else { 1 }));
        let wrong = wrong.iter().filter(|&&wrong| wrong).count();
        // Of the tree's 432 pixels 144 were measured as mountains.
        assert!(wrong <= 50, "{wrong} pixels are not where they belong");
    }

    #[test]
    fn without_seeds_there_are_no_labels() {
        let found = spread(WIDTH, &painted(|_, _| [9; 3]), &|_| true, &|_, _| true, &painted(|_, _| None));
        assert!(found.iter().all(Option::is_none));
    }
}
