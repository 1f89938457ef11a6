//! Minimum cuts of a grid in which every cell is linked to its eight neighbors (Boykov & Kolmogorov 2004).
//!
//! Two trees grow from source and sink until they meet; the path through the meeting link is saturated and the trees
//! are mended. The grid's links are implicit. Capacities are integers, so the cut is exactly a least one.

use std::collections::VecDeque;

/// Steps to the eight neighbors; each is followed or preceded by its opposite.
pub(super) const STEPS: [[i32; 2]; 8] = super::cost::STEPS;

/// What `parent` holds when it is no step.
const TERMINAL: u8 = 8;
const ORPHAN: u8 = 9;
const NONE: u8 = 10;

/// Paths between two looks at whether to go on.
const PATHS_A_LOOK: u32 = 1 << 12;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tree {
    Source,
    Sink,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    /// What still fits through the links to the neighbors.
    links: [i32; 8],
    /// What still fits from the source, above 0, or to the sink, below.
    terminal: i32,
    /// Steps to the terminal, true as of `stamp`.
    distance: u32,
    stamp: u32,
    /// Of no meaning while `parent` is `NONE`.
    tree: Tree,
    /// Step towards the terminal.
    parent: u8,
    queued: bool,
}

/// A grid with capacities, cut once.
#[derive(Debug)]
pub(super) struct GridCut {
    width: usize,
    /// Cells in a row, with a frame of one cell that nothing flows through.
    stride: usize,
    nodes: Vec<Node>,
    offsets: [isize; 8],
    active: VecDeque<u32>,
    orphans: VecDeque<u32>,
    time: u32,
    flow: i64,
}

impl GridCut {
    /// A grid in which nothing flows yet.
    pub(super) fn new(width: usize, height: usize) -> Self {
        let stride = width + 2;
        let node = Node {
            links: [0; 8],
            terminal: 0,
            distance: 0,
            stamp: 0,
            tree: Tree::Sink,
            parent: NONE,
            queued: false,
        };
        Self {
            width,
            stride,
            nodes: vec![node; stride * (height + 2)],
            offsets: STEPS.map(|[dx, dy]| dy as isize * stride as isize + dx as isize),
            active: VecDeque::new(),
            orphans: VecDeque::new(),
            time: 0,
            flow: 0,
        }
    }

    /// Gives a cell this much from the source, above 0, or to the sink, below.
    pub(super) fn set_terminal(&mut self, cell: usize, capacity: i32) {
        let node = self.index(cell);
        self.nodes[node].terminal = capacity;
    }

    /// Joins a cell to its neighbor, which is in the grid, both ways; `capacity` is at least 0 and below 2³⁰.
    pub(super) fn set_link(&mut self, cell: usize, step: usize, capacity: i32) {
        let node = self.index(cell);
        let next = self.neighbor(node, step);
        self.nodes[node].links[step] = capacity;
        self.nodes[next].links[step ^ 1] = capacity;
    }

    /// Finds a least cut and returns what it cuts; `None` when `go_on` said no.
    pub(super) fn cut(&mut self, go_on: &dyn Fn() -> bool) -> Option<i64> {
        for index in 0..self.nodes.len() {
            let node = &mut self.nodes[index];
            if node.terminal != 0 {
                node.tree = if node.terminal > 0 { Tree::Source } else { Tree::Sink };
                node.parent = TERMINAL;
                node.distance = 1;
                self.activate(index);
            }
        }
        let mut paths = 0_u32;
        while let Some(node) = self.active.pop_front() {
            let node = node as usize;
            self.nodes[node].queued = false;
            // A cell goes on growing where it stopped until nothing is left around it.
            while self.nodes[node].parent != NONE {
                let Some((from, step)) = self.grow(node) else { break };
                self.time += 1;
                self.augment(from, step);
                while let Some(orphan) = self.orphans.pop_front() {
                    self.adopt(orphan as usize);
                }
                paths += 1;
                if paths.is_multiple_of(PATHS_A_LOOK) && !go_on() {
                    return None;
                }
            }
        }
        Some(self.flow)
    }

    /// Whether a cell is on the source's side of the cut.
    pub(super) fn is_with_source(&self, cell: usize) -> bool {
        let node = &self.nodes[self.index(cell)];
        node.parent != NONE && node.tree == Tree::Source
    }

    fn index(&self, cell: usize) -> usize {
        (cell / self.width + 1) * self.stride + cell % self.width + 1
    }

    fn neighbor(&self, node: usize, step: usize) -> usize {
        node.wrapping_add_signed(self.offsets[step])
    }

    fn activate(&mut self, node: usize) {
        if !self.nodes[node].queued {
            self.nodes[node].queued = true;
            self.active.push_back(node as u32);
        }
    }

    /// What still fits along the link towards a tree's root: from `next` over to `node` in the source's tree, the other
    /// way in the sink's. `step` leads from `node` to `next`.
    fn inflow(&self, tree: Tree, node: usize, step: usize, next: usize) -> i32 {
        match tree {
            Tree::Source => self.nodes[next].links[step ^ 1],
            Tree::Sink => self.nodes[node].links[step],
        }
    }

    /// Takes in free neighbors. Returns the link where the other tree was met: its cell in the source's tree and the
    /// step to the one in the sink's.
    fn grow(&mut self, node: usize) -> Option<(usize, usize)> {
        let Node { tree, distance, stamp, links, .. } = self.nodes[node];
        for (step, outflow) in links.into_iter().enumerate() {
            let next = self.neighbor(node, step);
            let fits = match tree {
                Tree::Source => outflow,
                Tree::Sink => self.nodes[next].links[step ^ 1],
            };
            if fits == 0 {
                continue;
            }
            let other = &mut self.nodes[next];
            if other.parent == NONE {
                (other.tree, other.parent) = (tree, step as u8 ^ 1);
                (other.distance, other.stamp) = (distance + 1, stamp);
                self.activate(next);
            } else if other.tree != tree {
                return Some(if tree == Tree::Source { (node, step) } else { (next, step ^ 1) });
            } else if other.stamp <= stamp && other.distance > distance + 1 {
                // A shorter way to the terminal.
                other.parent = step as u8 ^ 1;
                (other.distance, other.stamp) = (distance + 1, stamp);
            }
        }
        None
    }

    /// Sends as much as fits along the path through a link between the trees.
    fn augment(&mut self, from: usize, step: usize) {
        let to = self.neighbor(from, step);
        let most = self.nodes[from].links[step];
        let most = self.fits(Tree::Sink, to, self.fits(Tree::Source, from, most));
        self.nodes[from].links[step] -= most;
        self.nodes[to].links[step ^ 1] += most;
        self.send(Tree::Source, from, most);
        self.send(Tree::Sink, to, most);
        self.flow += i64::from(most);
    }

    /// The least of `most` and what fits between a node and its terminal.
    fn fits(&self, tree: Tree, mut node: usize, mut most: i32) -> i32 {
        loop {
            let parent = self.nodes[node].parent;
            if parent == TERMINAL {
                return most.min(self.nodes[node].terminal.abs());
            }
            let next = self.neighbor(node, usize::from(parent));
            most = most.min(self.inflow(tree, node, usize::from(parent), next));
            node = next;
        }
    }

    /// Sends `amount` between a node and its terminal; whoever's link is then full loses its parent.
    fn send(&mut self, tree: Tree, mut node: usize, amount: i32) {
        loop {
            let parent = self.nodes[node].parent;
            if parent == TERMINAL {
                let terminal = &mut self.nodes[node].terminal;
                *terminal -= terminal.signum() * amount;
                if *terminal == 0 {
                    self.disown(node, true);
                }
                return;
            }
            let step = usize::from(parent);
            let next = self.neighbor(node, step);
            let along = if tree == Tree::Source { -amount } else { amount };
            self.nodes[node].links[step] -= along;
            self.nodes[next].links[step ^ 1] += along;
            if self.inflow(tree, node, step, next) == 0 {
                self.disown(node, true);
            }
            node = next;
        }
    }

    fn disown(&mut self, node: usize, first: bool) {
        self.nodes[node].parent = ORPHAN;
        if first {
            self.orphans.push_front(node as u32);
        } else {
            self.orphans.push_back(node as u32);
        }
    }

    /// Finds the nearest new parent of an orphan in its tree, or sets it and its children free.
    fn adopt(&mut self, node: usize) {
        let tree = self.nodes[node].tree;
        let mut best = None;
        for step in 0..8 {
            let next = self.neighbor(node, step);
            let other = &self.nodes[next];
            if other.parent == NONE || other.tree != tree || self.inflow(tree, node, step, next) == 0 {
                continue;
            }
            if let Some(distance) = self.distance(next)
                && best.is_none_or(|(least, _)| distance < least)
            {
                best = Some((distance, step));
            }
        }
        if let Some((distance, step)) = best {
            let time = self.time;
            let node = &mut self.nodes[node];
            (node.parent, node.distance, node.stamp) = (step as u8, distance + 1, time);
            return;
        }
        for step in 0..8 {
            let next = self.neighbor(node, step);
            let other = &self.nodes[next];
            if other.parent == NONE || other.tree != tree {
                continue;
            }
            let is_child = usize::from(other.parent) == step ^ 1;
            if self.inflow(tree, node, step, next) > 0 {
                self.activate(next);
            }
            if is_child {
                self.disown(next, false);
            }
        }
        self.nodes[node].parent = NONE;
    }

    /// Steps from a node to its terminal; `None` when an orphan is on the way. Marks what it learns.
    fn distance(&mut self, node: usize) -> Option<u32> {
        let (mut at, mut steps) = (node, 0);
        let total = loop {
            let Node { parent, distance, stamp, .. } = self.nodes[at];
            if stamp == self.time {
                break steps + distance;
            }
            match parent {
                TERMINAL => break steps + 1,
                ORPHAN => return None,
                step => at = self.neighbor(at, usize::from(step)),
            }
            steps += 1;
        };
        let (mut at, mut left) = (node, total);
        while self.nodes[at].stamp != self.time {
            (self.nodes[at].stamp, self.nodes[at].distance) = (self.time, left);
            left -= 1;
            match self.nodes[at].parent {
                TERMINAL => break,
                step => at = self.neighbor(at, usize::from(step)),
            }
        }
        Some(total)
    }
}

#[cfg(test)]
#[path = "max_flow_tests.rs"]
mod tests;
