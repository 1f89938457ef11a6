//! Cheapest paths from one cell over a window of a picture, found as far as they are asked for (Dijkstra 1959 with the
//! circular buckets of Dial 1969).
//!
//! Links cost 1–255, so 256 buckets hold everything that waits. A search continues where it stopped: what it has
//! settled stays settled.

use glam::UVec2;

use super::cost::{Feature, Prices, STEPS};

/// A cell still waits for its cheapest path. Cells that are not of the window have none of these bits.
const OPEN: u8 = 0x80;
/// A cell has its cheapest path.
const SETTLED: u8 = 0x40;
/// The step that led to a cell; `START` for the first one.
const STEP: u8 = 0x0f;
const START: u8 = 8;

/// A search in progress.
#[derive(Clone, Debug)]
pub(super) struct Search {
    /// The picture's cell at the window's first cell.
    origin: UVec2,
    size: UVec2,
    /// Cells in a row, with a frame of one cell, so that steps never leave the arrays.
    stride: usize,
    features: Vec<Feature>,
    costs: Vec<u32>,
    marks: Vec<u8>,
    buckets: Vec<Vec<u32>>,
    waiting: usize,
    /// Cost that the search has come to.
    now: u32,
    prices: Prices,
    offsets: [isize; 8],
}

impl Search {
    /// A window without cells at `origin`; [`admit`](Self::admit) opens them, [`start`](Self::start) begins.
    pub(super) fn new(origin: UVec2, size: UVec2, prices: Prices) -> Self {
        let stride = size.x as usize + 2;
        let count = stride * (size.y as usize + 2);
        Self {
            origin,
            size,
            stride,
            // Untouched zeros cost no memory, so a thin corridor through a wide window is cheap.
            features: vec![[0; 3]; count],
            costs: vec![0; count],
            marks: vec![0; count],
            buckets: vec![Vec::new(); 256],
            waiting: 0,
            now: 0,
            prices,
            offsets: STEPS.map(|[dx, dy]| dy as isize * stride as isize + dx as isize),
        }
    }

    /// Opens the cells `from` to `to` (excluded) of a row of the picture, whose features `row` are.
    pub(super) fn admit(&mut self, y: u32, from: u32, to: u32, row: &[Feature]) {
        let [low, high] = [self.origin, self.origin + self.size];
        let [from, to] = [from.max(low.x), to.min(high.x)];
        if y < low.y || y >= high.y || from >= to {
            return;
        }
        let first = self.index(UVec2::new(from, y));
        let count = (to - from) as usize;
        self.features[first..first + count].copy_from_slice(&row[from as usize..to as usize]);
        self.costs[first..first + count].fill(u32::MAX);
        self.marks[first..first + count].fill(OPEN);
    }

    /// Begins at a cell of the picture, which has been admitted.
    pub(super) fn start(&mut self, at: UVec2) {
        let index = self.index(at);
        self.costs[index] = 0;
        self.marks[index] = OPEN | START;
        self.buckets[0].push(index as u32);
        self.waiting = 1;
    }

    /// Whether a cell of the picture lies in the window and is open or settled.
    pub(super) fn holds(&self, at: UVec2) -> bool {
        at.cmpge(self.origin).all()
            && at.cmplt(self.origin + self.size).all()
            && self.marks[self.index(at)] & (OPEN | SETTLED) != 0
    }

    /// Goes on until the cheapest path to `target` is known, and returns its cost; `None` when no path leads there.
    pub(super) fn expand_to(&mut self, target: UVec2) -> Option<u32> {
        if !self.holds(target) {
            return None;
        }
        let target = self.index(target);
        while self.marks[target] & SETTLED == 0 {
            if self.waiting == 0 {
                return None;
            }
            let Some(cell) = self.buckets[(self.now & 255) as usize].pop() else {
                self.now += 1;
                continue;
            };
            self.waiting -= 1;
            let cell = cell as usize;
            // A cell waits once for every path found to it; the cheapest one came first.
            if self.marks[cell] & OPEN != 0 {
                self.settle(cell);
            }
        }
        Some(self.costs[target])
    }

    fn settle(&mut self, cell: usize) {
        self.marks[cell] ^= OPEN | SETTLED;
        let feature = self.features[cell];
        for (step, offset) in self.offsets.into_iter().enumerate() {
            let next = cell.wrapping_add_signed(offset);
            if self.marks[next] & OPEN == 0 {
                continue;
            }
            let cost = self.now + u32::from(self.prices.link(feature, self.features[next], step));
            if cost < self.costs[next] {
                self.costs[next] = cost;
                self.marks[next] = OPEN | step as u8;
                self.buckets[(cost & 255) as usize].push(next as u32);
                self.waiting += 1;
            }
        }
    }

    /// The cells of the picture on the cheapest path to a settled cell, first to last.
    pub(super) fn path(&self, target: UVec2) -> Vec<UVec2> {
        let mut path = vec![target];
        let mut index = self.index(target);
        let mut at = target.as_ivec2();
        while let Some(&[dx, dy]) = STEPS.get(usize::from(self.marks[index] & STEP)) {
            at -= glam::IVec2::new(dx, dy);
            index = index.wrapping_add_signed(-self.offsets[usize::from(self.marks[index] & STEP)]);
            path.push(at.as_uvec2());
        }
        path.reverse();
        path
    }

    fn index(&self, at: UVec2) -> usize {
        let inside = at - self.origin + 1;
        inside.y as usize * self.stride + inside.x as usize
    }
}
