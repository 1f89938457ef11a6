//! Mending an earlier mask: a stroke speaks of the pieces that it touches, the rest stays as it was.
//!
//! A cut judges all of a region by what its colors are like, and errs where the region has colors of its surroundings, as
//! water does wherever something is mirrored. Nobody who strokes one bank means the other one.

use super::grid::Grid;
use super::guided::upsampled;
use super::parts::parts;
use crate::picture::{Mask, Picture, distances};

/// How far around what has changed the mask is made anew, cells: as far as its border is soft.
const SOFT: f32 = 3.0;

/// The earlier mask, of the picture's size, with those changes of a cut (`inside`, a label for each cell of the grid) that
/// hang together with a stroke on their side.
pub(super) fn mended(picture: &Picture, grid: &Grid, earlier: &Mask, inside: &[bool]) -> Mask {
    let Grid { scaled, known, is_stroked, .. } = grid;
    let was = |cell: usize| {
        let pixel = scaled.pixel(cell);
        earlier.get(pixel.x, pixel.y) >= 128
    };
    let mut is_changed = vec![false; inside.len()];
    for side in [false, true] {
        let changes = |cell: usize| inside[cell] == side && was(cell) != side;
        let (part_of, counts) = parts(scaled.width, changes, inside.len());
        let mut is_meant = vec![false; counts.len()];
        for (cell, &part) in part_of.iter().enumerate() {
            is_meant[part as usize] |= part != 0 && is_stroked[cell] && known[cell] == Some(side);
        }
        for (is_changed, part) in is_changed.iter_mut().zip(part_of) {
            *is_changed |= is_meant[part as usize];
        }
    }
    let labels: Vec<bool> =
        is_changed.iter().enumerate().map(|(cell, is_changed)| was(cell) != *is_changed).collect();
    let anew = upsampled(picture, scaled, &labels);
    let far = distances(scaled.width, scaled.height, |cell| is_changed[cell]);
    let mut values = earlier.values().to_vec();
    let width = picture.size().x as usize;
    for (y, row) in values.chunks_mut(width).enumerate() {
        for (x, value) in row.iter_mut().enumerate() {
            let [x, y] = [x as u32, y as u32];
            if scaled.cell(x, y).is_some_and(|cell| far[cell] <= SOFT) {
                *value = anew.get(x, y);
            }
        }
    }
    // As many as before.
    Mask::new(earlier.size(), values).unwrap_or_else(|_| earlier.clone())
}
