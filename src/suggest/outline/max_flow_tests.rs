//! Facts about the largest flow, held against brute force.

use super::*;

/// Numbers below `limit` from a seed (splitmix64).
fn draws(mut state: u64) -> impl FnMut(u64) -> i32 {
    move |limit| {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = state;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((bits ^ (bits >> 31)) % limit) as i32
    }
}

/// A grid's capacities: terminals, and links by cell and step.
struct Problem {
    width: usize,
    height: usize,
    terminals: Vec<i32>,
    links: Vec<(usize, usize, usize, i32)>,
}

impl Problem {
    fn random(width: usize, height: usize, seed: u64) -> Self {
        let mut draw = draws(seed);
        let terminals = (0..width * height).map(|_| draw(41) - 20).collect();
        let mut links = Vec::new();
        for cell in 0..width * height {
            for step in [0, 2, 4, 6] {
                let x = (cell % width) as i32 + STEPS[step][0];
                let y = (cell / width) as i32 + STEPS[step][1];
                if (0..width as i32).contains(&x) && (0..height as i32).contains(&y) {
                    links.push((cell, step, y as usize * width + x as usize, draw(12)));
                }
            }
        }
        Self { width, height, terminals, links }
    }

    fn cut(&self) -> (GridCut, i64) {
        let mut grid = GridCut::new(self.width, self.height);
        for (cell, capacity) in self.terminals.iter().enumerate() {
            grid.set_terminal(cell, *capacity);
        }
        for &(cell, step, _, capacity) in &self.links {
            grid.set_link(cell, step, capacity);
        }
        let flow = grid.cut(&|| true).unwrap();
        (grid, flow)
    }

    /// What a side for each cell cuts.
    fn price(&self, with_source: impl Fn(usize) -> bool) -> i64 {
        let terminals = self.terminals.iter().enumerate();
        let cut = |(cell, capacity): (usize, &i32)| {
            if (*capacity > 0) != with_source(cell) { capacity.abs() } else { 0 }
        };
        let links = self.links.iter().filter(|(a, _, b, _)| with_source(*a) != with_source(*b));
        terminals.map(cut).map(i64::from).sum::<i64>() + links.map(|link| i64::from(link.3)).sum::<i64>()
    }
}

#[test]
fn cuts_of_small_grids_are_least() {
    for seed in 0..60 {
        let (width, height) = [(4, 3), (3, 4), (12, 1), (1, 11), (2, 6)][seed as usize % 5];
        let problem = Problem::random(width, height, seed);
        let least =
            (0..1_u32 << (width * height)).map(|sides| problem.price(|cell| sides >> cell & 1 == 1)).min();
        let (grid, flow) = problem.cut();
        assert_eq!(Some(flow), least, "the flow of grid {seed}");
        assert_eq!(problem.price(|cell| grid.is_with_source(cell)), flow, "the cut of grid {seed}");
    }
}

#[test]
fn a_cut_of_a_large_grid_costs_what_flows() {
    for seed in 0..4 {
        let problem = Problem::random(60, 47, 1000 + seed);
        let (grid, flow) = problem.cut();
        assert_eq!(problem.price(|cell| grid.is_with_source(cell)), flow, "grid {seed}");
    }
}

#[test]
fn a_cut_that_is_stopped_gives_nothing() {
    let problem = Problem::random(200, 200, 5);
    let mut grid = GridCut::new(200, 200);
    problem.terminals.iter().enumerate().for_each(|(cell, c)| grid.set_terminal(cell, *c));
    for &(cell, step, _, capacity) in &problem.links {
        grid.set_link(cell, step, capacity);
    }
    assert_eq!(grid.cut(&|| false), None);
}
