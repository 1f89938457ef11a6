//! Intelligent scissors: a line that snaps to edges while the pointer goes along (Mortensen & Barrett 1995; notes §3.1).
//!
//! Near the anchor the path is the cheapest one at full size. Farther away it is sought at the finest level of a
//! pyramid whose window reaches the pointer, and then refined level by level within a corridor around it, so an
//! answer takes milliseconds at any picture size. As long as the pointer stays at one level, each answer continues the
//! search of the last one.

use glam::{DVec2, UVec2};

use super::cost::{Feature, Prices, crest_offset, features, halved};
use super::search::Search;
use crate::picture::{Picture, PicturePoint};

/// Cells from the anchor to a window's border: what one search may cost.
const REACH: u32 = 224;

/// Half the corridor's width, cells of the level that is refined.
const CORRIDOR: u32 = 6;

/// A path whose box has more cells than this at a level stays at the level above: its corridor's memory.
const MOST_CELLS: u64 = 1 << 22;

/// Pixels of the accepted line from which contrast is learned.
const TRAINING: usize = 64;

/// A picture's features at one size.
#[derive(Clone, Debug)]
struct Level {
    size: UVec2,
    features: Vec<Feature>,
}

/// A line from an anchor to wherever the pointer is, along edges.
#[derive(Clone, Debug)]
pub struct LiveWire {
    /// Each half as wide as the one before.
    levels: Vec<Level>,
    prices: Prices,
    anchor: Option<Anchor>,
}

/// Where the line begins, and what has been searched from there.
#[derive(Clone, Debug)]
struct Anchor {
    at: UVec2,
    prices: Prices,
    /// One for each level; `None` until asked for.
    searches: Vec<Option<Search>>,
}

impl LiveWire {
    /// Prepares a picture: about a third of a second for 2 megapixels on two cores.
    #[must_use]
    pub fn new(picture: &Picture) -> Self {
        let mut size = picture.size();
        let mut levels = vec![Level { size, features: features(size.x as usize, picture.pixels()) }];
        let mut pixels = picture.pixels().to_vec();
        // The coarsest level's window reaches every pixel from any anchor.
        while size.max_element() > REACH {
            let (width, smaller) = halved(size.x as usize, &pixels);
            size = UVec2::new(width as u32, (smaller.len() / width) as u32);
            levels.push(Level { size, features: features(width, &smaller) });
            pixels = smaller;
        }
        Self { levels, prices: Prices::plain(), anchor: None }
    }

    /// Begins a line at the pixel nearest to `at`. A point that is not finite changes nothing.
    pub fn anchor(&mut self, at: PicturePoint) {
        if let Some(at) = self.pixel(at) {
            let searches = self.levels.iter().map(|_| None).collect();
            self.anchor = Some(Anchor { at, prices: self.prices.clone(), searches });
        }
    }

    /// The line from the anchor to the pixel nearest to `at`, as a point for each of neighboring pixels (a few
    /// pixels apart where a line across a very large picture stays coarse): on the crest of the edge where one is within half a
    /// pixel, else the center. Empty without an anchor or for a point that is
    /// not finite.
    #[must_use]
    pub fn path_to(&mut self, at: PicturePoint) -> Vec<PicturePoint> {
        let path = self.pixels_to(at).unwrap_or_default();
        let last = path.len().saturating_sub(1);
        let level = &self.levels[0];
        let point = |(index, at): (usize, &UVec2)| {
            let is_end = index == 0 || index == last;
            let offset = if is_end { DVec2::ZERO } else { crest_offset(level.feature(*at)) };
            PicturePoint(at.as_dvec2() + 0.5 + offset)
        };
        path.iter().enumerate().map(point).collect()
    }

    /// Learns from the last 64 points of an accepted line which contrasts the object's edge has; holds from the next
    /// anchor on. Fewer than 16 points teach nothing.
    pub fn learn_from(&mut self, accepted: &[PicturePoint]) {
        let last = &accepted[accepted.len().saturating_sub(TRAINING)..];
        let level = &self.levels[0];
        let pixels = last.iter().filter_map(|at| self.pixel(*at));
        let seen: Vec<_> = pixels.map(|at| level.feature(at)).collect();
        if seen.len() >= TRAINING / 4 {
            self.prices = Prices::trained(&seen);
        }
    }

    /// Forgets what was learned; holds from the next anchor on.
    pub fn forget(&mut self) {
        self.prices = Prices::plain();
    }

    /// The pixel nearest to a point; `None` when the point is not finite.
    fn pixel(&self, at: PicturePoint) -> Option<UVec2> {
        let last = (self.levels[0].size - 1).as_dvec2();
        at.0.is_finite().then(|| at.0.floor().clamp(DVec2::ZERO, last).as_uvec2())
    }

    /// Pixels of the cheapest path.
    fn pixels_to(&mut self, at: PicturePoint) -> Option<Vec<UVec2>> {
        let target = self.pixel(at)?;
        let anchor = self.anchor.as_mut()?;
        let off = anchor.at.as_ivec2() - target.as_ivec2();
        let in_reach = |index: &usize| off.abs().max_element() >> *index < REACH as i32;
        let mut index = (0..self.levels.len()).find(in_reach).unwrap_or(self.levels.len() - 1);
        let [from, to] = [anchor.at, target].map(|at| at >> index as u32);
        let level = &self.levels[index];
        let search = anchor.searches[index].get_or_insert_with(|| level.window(from, &anchor.prices));
        search.expand_to(to)?;
        let mut path = search.path(to);
        while index > 0 {
            let level = &self.levels[index - 1];
            let [from, to] = [anchor.at, target].map(|at| at >> (index - 1) as u32);
            let Some(mut corridor) = level.corridor(&path, &anchor.prices) else { break };
            corridor.start(from);
            corridor.expand_to(to)?;
            path = corridor.path(to);
            index -= 1;
        }
        if index > 0 {
            let middle = UVec2::splat(1 << (index - 1));
            path = path.iter().map(|at| (*at << index as u32) + middle).collect();
            // The ends are where they were asked for.
            if let [first, .., last] = &mut path[..] {
                [*first, *last] = [anchor.at, target];
            }
        }
        Some(path)
    }
}

impl Level {
    fn feature(&self, at: UVec2) -> Feature {
        self.features[at.y as usize * self.size.x as usize + at.x as usize]
    }

    fn row(&self, y: u32) -> &[Feature] {
        &self.features[y as usize * self.size.x as usize..][..self.size.x as usize]
    }

    /// A search from `at` over everything around it.
    fn window(&self, at: UVec2, prices: &Prices) -> Search {
        let low = at.saturating_sub(UVec2::splat(REACH));
        let high = (at + REACH + 1).min(self.size);
        let mut search = Search::new(low, high - low, prices.clone());
        for y in low.y..high.y {
            search.admit(y, low.x, high.x, self.row(y));
        }
        search.start(at);
        search
    }

    /// Cells near a path of the next coarser level; `None` when their box is too large.
    fn corridor(&self, path: &[UVec2], prices: &Prices) -> Option<Search> {
        let fine = || path.iter().map(|at| *at * 2);
        let low = fine().reduce(UVec2::min)?.saturating_sub(UVec2::splat(CORRIDOR));
        let high = (fine().reduce(UVec2::max)? + CORRIDOR + 2).min(self.size);
        let size = high - low;
        if u64::from(size.x) * u64::from(size.y) > MOST_CELLS {
            return None;
        }
        // Of each row the corridor's runs, one after the other; they overlap, so only what is new is admitted.
        let mut search = Search::new(low, size, prices.clone());
        let mut rows: Vec<Vec<[u32; 2]>> = vec![Vec::new(); size.y as usize];
        for at in fine() {
            let from = at.x.saturating_sub(CORRIDOR);
            let to = (at.x + CORRIDOR + 2).min(self.size.x);
            for y in at.y.saturating_sub(CORRIDOR)..(at.y + CORRIDOR + 2).min(self.size.y) {
                let runs = &mut rows[(y - low.y) as usize];
                match runs.last_mut() {
                    Some([left, right]) if from <= *right && to >= *left => {
                        [*left, *right] = [from.min(*left), to.max(*right)];
                    }
                    _ => runs.push([from, to]),
                }
            }
        }
        for (y, runs) in (low.y..).zip(rows) {
            for [from, to] in runs {
                search.admit(y, from, to, self.row(y));
            }
        }
        Some(search)
    }
}

#[cfg(test)]
#[path = "livewire_tests.rs"]
mod tests;
