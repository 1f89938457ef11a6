//! What is known of each cell before matting: certain away from the mask's edge, an estimate with a weight
//! near it.
//!
//! The estimate comes from the mask and from the colors of either side. The weight is small where colors can
//! decide, grows toward the band's rim, and is large where the picture is blank, so alpha stays the mask's
//! there.

use rayon::prelude::*;

use super::MatteInput;
use super::closed_form::Cell;
use super::palette::Palette;
use super::trimap::Place;
use super::trimap::Trimap;

/// Weight of the estimate against a window's errors, where colors tell both sides apart.
const MASK_WEIGHT: f32 = 1e-3;

/// Weight at the rim of the band, where the mask passes from likely to certain.
const RIM_WEIGHT: f32 = 2.0;

/// Weight where the picture is blank, and the contrast (Bhattacharyya's distance) up to which it is.
const BLANK_WEIGHT: f32 = 1e4;
const BLANK_CONTRAST: f32 = 0.01;

/// Weight in the middle of parts that are too thin to be certain anywhere.
const RIDGE_WEIGHT: f32 = 0.3;

/// Distance from the edge, in band widths of that side, that multiplies the odds for the mask's side by e.
const MASK_ERROR: f32 = 0.12;

/// Side of the blocks in which colors are gathered, in widths of the band: large enough for the variety of a
/// side.
const BLOCK: f32 = 4.0;

/// Cells of a picture whose `colors` are those in which alpha is sought.
pub(super) fn cells(input: &MatteInput, colors: &[[f32; 3]]) -> Vec<Cell> {
    let (inside, outside) = (input.inside.max(0.0), input.outside.max(0.0));
    let trimap = Trimap::of(input.width, input.mask, inside, outside);
    let foreign = |cell: usize| input.foreign.is_some_and(|foreign| foreign[cell]);
    // What is far from the edge says little of the colors at the edge.
    let far = BLOCK * (inside + outside);
    let palette = Palette::of(input.width, colors, far.ceil().max(2.0) as usize, |cell| {
        (!foreign(cell) && trimap.depth[cell].abs() <= far).then_some(trimap.depth[cell] > 0.0)
    });
    (0..input.mask.len())
        .into_par_iter()
        .map(|cell| {
            if foreign(cell) {
                return Cell::Foreign;
            }
            let least = match trimap.places[cell] {
                Place::Outside => return Cell::Known(0.0),
                Place::Inside => return Cell::Known(1.0),
                Place::Unknown => MASK_WEIGHT,
                Place::Ridge => RIDGE_WEIGHT,
            };
            let depth = trimap.depth[cell];
            let reach = (depth / if depth > 0.0 { inside } else { outside }).abs().min(1.0);
            let rim = reach.powi(8);
            let signed_reach = reach.copysign(depth);
            let own = f32::from(input.mask[cell]) / 255.0;
            let (x, y) = (cell % input.width, cell / input.width);
            let (alpha, blank) = match palette.opinion(x, y, colors[cell]) {
                Some(opinion) => {
                    let blank = (-opinion.contrast / BLANK_CONTRAST).exp();
                    let chance = 1.0 / (1.0 + (-opinion.log_odds - signed_reach / MASK_ERROR).exp());
                    (own + (1.0 - rim) * (1.0 - blank) * (chance - own), blank)
                }
                None => (own, 1.0),
            };
            Cell::Unknown { alpha, weight: least.max(RIM_WEIGHT * rim) + BLANK_WEIGHT * blank }
        })
        .collect()
}
