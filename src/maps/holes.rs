//! Direct colors of a component over its whole layer: what the picture shows, and behind and beyond that what is filled.
//!
//! What the picture shows keeps its bits. First comes what the water shows of what the lens did not see; beside what is
//! known a hole goes on smoothly, and farther in it takes patches of what the same component shows elsewhere: smooth is
//! nearest to the truth over the few pixels that a small move uncovers, and blur where more is seen.

use glam::{IVec2, UVec2};
use rayon::prelude::*;

use super::beyond::frame;
use super::coverage::{ALONE, Coverage, is_above_contact};
use super::fill::{box_mean, push_pull};
use super::inpaint::{Cell, Options, inpaint};
use super::reflection::{backdrop_from_water, linear, tolerance};
use super::texture::layer_alpha;
use super::tint::Tint;
use super::{Fill, Grid, MapOptions, Method};
use crate::picture::color::srgb_from_linear;
use crate::picture::{Picture, distances};
use crate::scene::Role;
use crate::scene::TourScene;

/// Up to so many megapixels patches are searched at full size; above, the last halving only copies what was found.
const FULL_SEARCH: f64 = 3.0;

/// Patches begin at the first of these distances from what is known, and are all there is from the second on; in
/// pixels per pixel of picture width.
const RIM_INSIDE: [f32; 2] = [0.003, 0.0095];
/// The same beyond the picture's border, where what is made up is least like the truth.
const RIM_BEYOND: [f32; 2] = [0.003, 0.013];

/// What is left beyond the border of the patches' differences from the mean around them, which reaches so far (pixels per
/// pixel of picture width): a made-up edge should not catch the eye.
const CONTRAST_BEYOND: f32 = 0.4;
const MEAN_REACH: f32 = 0.012;

/// The water is asked for what is hidden where it agrees with so much of what is seen around.
const AGREEING: f32 = 0.5;

/// Everything that direct colors are made from.
pub(super) struct HoleInput<'a> {
    pub scene: &'a TourScene,
    pub picture: &'a Picture,
    pub coverage: &'a Coverage,
    /// Per component its own colors, where it was cut out.
    pub cut_out: &'a [Option<Grid<[f32; 3]>>],
    pub owner: &'a Grid<u8>,
    pub tint: &'a Tint,
    pub options: &'a MapOptions,
}

/// The direct colors of a component, linear light, filled over its whole layer; `None` if canceled.
pub(super) fn filled_colors(
    input: &HoleInput,
    index: usize,
    progress: &dyn Fn(f32) -> bool,
) -> Option<Grid<[f32; 3]>> {
    let HoleInput { scene, picture, coverage, options, .. } = *input;
    let role = scene.components[index].role;
    let area = &coverage.grown[index];
    let (low, high) = match role {
        Role::LastLayer | Role::Ground => frame(picture.size()),
        Role::Band | Role::Billboard => (area.origin, area.origin + area.size.as_ivec2()),
    };
    let pure = |pixel: IVec2| coverage.is_pure(index, pixel);
    let mut colors = Grid::from_fn(low, (high - low).as_uvec2(), |pixel| {
        if pure(pixel) { linear(picture, pixel) } else { [0.0; 3] }
    });
    let mut known: Vec<f32> = (0..colors.cells.len())
        .into_par_iter()
        .map(|cell| f32::from(u8::from(pure(colors.pixel(cell)))))
        .collect();
    if matches!(role, Role::LastLayer | Role::Band) && scene.water && options.method == Method::Ours {
        fill_from_water(input, index, &mut colors, &mut known);
    }
    let width = colors.size.x as usize;
    push_pull(width, &mut colors.cells, &known);
    if let Some(own) = &input.cut_out[index] {
        for (cell, _) in known.iter().enumerate().filter(|(_, known)| **known < 1.0) {
            if let Some(color) = own.get(colors.pixel(cell)) {
                colors.cells[cell] = color;
            }
        }
    }
    if options.fill == Fill::Smooth {
        return Some(colors);
    }
    let end = picture.size().as_ivec2();
    let is_inside = |pixel: IVec2| pixel.cmpge(IVec2::ZERO).all() && pixel.cmplt(end).all();
    let cells: Vec<Cell> = (0..colors.cells.len())
        .into_par_iter()
        .map(|cell| {
            let pixel = colors.pixel(cell);
            let alpha = layer_alpha(scene, coverage, index, pixel);
            // A billboard's edge takes the color beside it.
            let least = if role == Role::Billboard { ALONE } else { 1 };
            if known[cell] == 1.0 {
                Cell::Source
            } else if alpha >= least && (is_inside(pixel) || options.paint_beyond) {
                Cell::Hole
            } else {
                Cell::Foreign
            }
        })
        .collect();
    patch(&mut colors, &cells, picture.size(), index as u64, progress).then_some(colors)
}

/// Lets the holes of colors that are filled smoothly take patches from the sources, beyond a rim; whether it came to the
/// end.
pub(super) fn patch(
    colors: &mut Grid<[f32; 3]>,
    cells: &[Cell],
    picture: UVec2,
    seed: u64,
    progress: &dyn Fn(f32) -> bool,
) -> bool {
    let (end, size) = (picture.as_ivec2(), picture.as_dvec2());
    let how = Options {
        seed,
        finest_level: usize::from(size.x * size.y > FULL_SEARCH * 1e6),
        ..Options::default()
    };
    let width = colors.size.x as usize;
    let mut patched = colors.cells.clone();
    if !inpaint(width, &mut patched, cells, &how, progress) {
        return false;
    }
    let rims = [RIM_INSIDE, RIM_BEYOND].map(|rim| rim.map(|share| share * picture.x as f32));
    let from_known = distances(width, colors.size.y as usize, |cell| cells[cell] == Cell::Source);
    let origin = colors.origin;
    let out = |cell: usize| {
        let pixel = origin + IVec2::new((cell % width) as i32, (cell / width) as i32);
        (-pixel).max(pixel + 1 - end).max_element().max(0) as f32
    };
    let smooth = &mut colors.cells;
    smooth.par_iter_mut().zip(patched).zip(from_known).enumerate().for_each(
        |(cell, ((color, patch), far))| {
            let [begin, whole] = if out(cell) == 0.0 { rims[0] } else { rims[1] };
            let share = ((far - begin) / (whole - begin)).clamp(0.0, 1.0);
            *color = std::array::from_fn(|c| color[c] + share * (patch[c] - color[c]));
        },
    );
    let mean = box_mean(width, smooth, (MEAN_REACH * picture.x as f32).round() as usize);
    smooth.par_iter_mut().zip(mean).enumerate().for_each(|(cell, (color, mean))| {
        if cells[cell] == Cell::Hole {
            let contrast = 1.0 - (1.0 - CONTRAST_BEYOND) * (out(cell) / rims[1][1]).min(1.0);
            *color = std::array::from_fn(|c| mean[c] + contrast * (color[c] - mean[c]));
        }
    });
    true
}

/// Fills what is hidden of a backdrop from its mirror image; the fit's local miss is taken out by a membrane, so that no
/// seam shows.
fn fill_from_water(input: &HoleInput, index: usize, colors: &mut Grid<[f32; 3]>, known: &mut [f32]) {
    let HoleInput { scene, picture, coverage, owner, tint, .. } = *input;
    let candidates = Grid::from_fn(colors.origin, colors.size, |pixel| {
        let stands = layer_alpha(scene, coverage, index, pixel) > 0 && is_above_contact(scene, index, pixel);
        stands.then(|| backdrop_from_water(scene, picture, tint, owner, index, pixel)).flatten()
    });
    let tolerance = tolerance(tint);
    let mut misses = vec![[0.0; 3]; known.len()];
    let mut agreement = vec![[0.0]; known.len()];
    let mut both = vec![0.0; known.len()];
    for (cell, candidate) in candidates.cells.iter().enumerate() {
        if let Some(candidate) = candidate
            && known[cell] == 1.0
        {
            let color = colors.cells[cell];
            let agrees = (0..3)
                .all(|c| srgb_from_linear(color[c]).abs_diff(srgb_from_linear(candidate[c])) < tolerance);
            misses[cell] = std::array::from_fn(|c| color[c] - candidate[c]);
            agreement[cell] = [f32::from(u8::from(agrees))];
            both[cell] = 1.0;
        }
    }
    push_pull(colors.size.x as usize, &mut misses, &both);
    push_pull(colors.size.x as usize, &mut agreement, &both);
    for (cell, candidate) in candidates.cells.iter().enumerate() {
        if let Some(candidate) = candidate
            && known[cell] == 0.0
            && agreement[cell][0] > AGREEING
        {
            colors.cells[cell] = std::array::from_fn(|c| (candidate[c] + misses[cell][c]).clamp(0.0, 1.0));
            known[cell] = 1.0;
        }
    }
}
