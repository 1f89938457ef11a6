//! The seam: what the fill is off by at the hole's rim is taken from it there, fading out inward.
//!
//! Only a ring inside the rim changes. The correction is a membrane (Laplace's equation) from the rim to the
//! ring's end.

use std::collections::BTreeMap;

use super::Cell;
use super::code_from_linear;
use super::level::Level;
use super::linear_from_code;

/// Width of the ring, in cells.
const RING: usize = 16;

/// Steps of relaxation; the guess is a linear fade already, so few are needed.
const STEPS: usize = 48;

/// Largest correction, in 8-bit codes: more is another structure, not another light, and must not be smeared.
const LARGEST: f32 = 20.0;

/// Cells with the correction at each, outward first.
pub(super) struct Ring {
    cells: Vec<u32>,
    corrections: Vec<[f32; 3]>,
}

/// For each of the four steps from a cell to one beside it, the hole's cells from which it leads to a source.
pub(super) fn steps_out(level: &Level) -> [(isize, Vec<u32>); 4] {
    steps(level.width).map(|step| {
        let leads_out = |cell: &u32| level.cells[(*cell as usize).wrapping_add_signed(step)] == Cell::Source;
        (step, level.holes.iter().copied().filter(leads_out).collect())
    })
}

/// The rim, and what the fill would be off by there.
///
/// A seam is a step, the hole's cells that it leads out of, and how their fill continues: colors, times the
/// share that is known, and that share.
pub(super) fn rim(colors: &[[f32; 3]], seams: &[(isize, &[u32], Vec<[f32; 4]>)]) -> Ring {
    let mut off = BTreeMap::new();
    for (step, inside, continued) in seams {
        for (cell, [r, g, b, share]) in inside.iter().zip(continued) {
            let outside = (*cell as usize).wrapping_add_signed(*step);
            let (sum, count) = off.entry(outside as u32).or_insert(([0.0; 3], 0.0));
            if *share > 0.5 {
                let copied = [r / share, g / share, b / share];
                *count += 1.0;
                for ((sum, known), copied) in sum.iter_mut().zip(colors[outside]).zip(copied) {
                    *sum += (code_from_linear(known) - code_from_linear(copied)).clamp(-LARGEST, LARGEST);
                }
            }
        }
    }
    let (cells, corrections) = off
        .into_iter()
        .map(|(cell, (sum, count)): (u32, ([f32; 3], f32))| (cell, sum.map(|sum| sum / count.max(1.0))))
        .unzip();
    Ring { cells, corrections }
}

/// Corrects the filled `colors` inside the rim.
pub(super) fn blend(level: &Level, colors: &mut [[f32; 3]], mut ring: Ring) {
    let rim = ring.cells.len();
    let slots = spread(level, &mut ring);
    relax(level, &slots, rim, &mut ring);
    for (cell, correction) in ring.cells.iter().zip(&ring.corrections).skip(rim) {
        let color = &mut colors[*cell as usize];
        for (value, correction) in color.iter_mut().zip(correction) {
            *value = linear_from_code((code_from_linear(*value) + correction).clamp(0.0, 255.0));
        }
    }
}

/// Grows the ring inward from its rim with a linear fade; returns each cell's index in the ring.
fn spread(level: &Level, ring: &mut Ring) -> Vec<u32> {
    let mut slots = vec![u32::MAX; level.cells.len()];
    for (slot, cell) in ring.cells.iter().enumerate() {
        slots[*cell as usize] = slot as u32;
    }
    let mut grown = 0;
    for depth in 1..=RING {
        let (first, end) = (grown, ring.cells.len());
        grown = end;
        for slot in first..end {
            for cell in neighbors(level.width, ring.cells[slot] as usize) {
                if level.cells[cell] == Cell::Hole && slots[cell] == u32::MAX {
                    slots[cell] = ring.cells.len() as u32;
                    ring.cells.push(cell as u32);
                    let fade = (RING + 1 - depth) as f32 / (RING + 2 - depth) as f32;
                    ring.corrections.push(ring.corrections[slot].map(|correction| fade * correction));
                }
            }
        }
    }
    slots
}

/// Jacobi's relaxation of the ring inside its rim; the hole beyond the ring counts as zero, what is no hole
/// not at all.
fn relax(level: &Level, slots: &[u32], rim: usize, ring: &mut Ring) {
    let inner = &ring.cells[rim..];
    let around: Vec<Vec<u32>> = inner
        .iter()
        .map(|cell| {
            neighbors(level.width, *cell as usize)
                .into_iter()
                .filter(|cell| level.cells[*cell] == Cell::Hole || slots[*cell] != u32::MAX)
                .map(|cell| slots[cell])
                .collect()
        })
        .collect();
    for _ in 0..STEPS {
        let relaxed: Vec<[f32; 3]> = around
            .iter()
            .map(|around| {
                let corrections = around.iter().filter_map(|slot| ring.corrections.get(*slot as usize));
                let sum = corrections.fold([0.0; 3], |sum, c| [sum[0] + c[0], sum[1] + c[1], sum[2] + c[2]]);
                sum.map(|sum| sum / around.len().max(1) as f32)
            })
            .collect();
        ring.corrections[rim..].copy_from_slice(&relaxed);
    }
}

/// The cells beside an inner cell.
fn neighbors(width: usize, cell: usize) -> [usize; 4] {
    steps(width).map(|step| cell.wrapping_add_signed(step))
}

fn steps(width: usize) -> [isize; 4] {
    let row = width.cast_signed();
    [-1, 1, -row, row]
}
