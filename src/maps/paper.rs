//! What a reflection map shows where the water does not, the paper's way: filled water, or a random place of it.
//!
//! To compare with; nothing else uses it. (The paper's section on reflection maps: objects are removed, the picture is
//! filled, and the maps are read from it; what lies outside takes a random sample.)

use glam::IVec2;

use super::fill::push_pull;
use super::inpaint::{Cell, Options, inpaint};
use super::reflection::{Origin, ReflectionInput, linear};
use super::{Fill, Grid};

/// Colors for the texels that the water does not show, linear light.
///
/// `None` if canceled.
pub(super) fn unseen_colors(
    input: &ReflectionInput,
    texels: &Grid<([f32; 3], Origin)>,
    progress: &dyn Fn(f32) -> bool,
) -> Option<Vec<[f32; 3]>> {
    let ReflectionInput { picture, options, .. } = input;
    let end = picture.size().as_ivec2();
    let is_inside = |pixel: IVec2| pixel.cmpge(IVec2::ZERO).all() && pixel.cmplt(end).all();
    let is_seen = |cell: &usize| texels.cells[*cell].1 == Origin::Seen;
    let seen: Vec<usize> = (0..texels.cells.len()).filter(is_seen).collect();
    let mut colors = vec![[0.0; 3]; texels.cells.len()];
    let mut cells = vec![Cell::Hole; texels.cells.len()];
    for &cell in &seen {
        colors[cell] = linear(picture, texels.pixel(cell));
        cells[cell] = Cell::Source;
    }
    let known: Vec<f32> = cells.iter().map(|&cell| f32::from(u8::from(cell == Cell::Source))).collect();
    let width = texels.size.x as usize;
    push_pull(width, &mut colors, &known);
    for (cell, kind) in cells.iter_mut().enumerate().filter(|(cell, _)| !is_inside(texels.pixel(*cell))) {
        *kind = Cell::Foreign;
        // Multiplying by a large odd number scatters the places.
        if let Some(&other) = seen.get(cell.wrapping_mul(0x9E37_79B1) % seen.len().max(1)) {
            colors[cell] = linear(picture, texels.pixel(other));
        }
    }
    let smooth = options.fill == Fill::Smooth;
    (smooth || inpaint(width, &mut colors, &cells, &Options::default(), progress)).then_some(colors)
}
