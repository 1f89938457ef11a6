//! Which cells are surely inside, surely outside, or to be decided, from a mask that is right to within a few
//! pixels.

use rayon::prelude::*;

use crate::picture::distances;

/// Distances of a mask's edge, by which a cell's place is told.
#[derive(Debug)]
pub(super) struct Trimap {
    /// Distance to the edge in pixels, above 0 inside.
    pub depth: Vec<f32>,
    pub places: Vec<Place>,
}

/// Where a cell is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    Outside,
    Inside,
    /// Near the edge, or partly covered.
    Unknown,
    /// Unknown, and the middle of a part too thin to have an inside.
    Ridge,
}

impl Trimap {
    /// Trimap of coverage 0–255, `width` to a row; cells within `inside` pixels inside and `outside` pixels
    /// outside of the edge (coverage 128) are unknown. Takes the same time whatever the radii.
    pub(super) fn of(width: usize, mask: &[u8], inside: f32, outside: f32) -> Self {
        let height = mask.len() / width;
        let solid = |cell: usize| mask[cell] >= 128;
        let to_solid = distances(width, height, solid);
        let to_empty = distances(width, height, |cell| !solid(cell));
        // The edge runs half a pixel off the centers.
        let depth: Vec<f32> = to_empty
            .par_iter()
            .zip(&to_solid)
            .map(|(inward, outward)| (inward - outward) - 0.5 * (inward - outward).signum())
            .collect();
        let mut places: Vec<Place> = (0..mask.len())
            .into_par_iter()
            .map(|cell| match mask[cell] {
                0 if depth[cell] < -outside => Place::Outside,
                255 if depth[cell] > inside => Place::Inside,
                _ => Place::Unknown,
            })
            .collect();

        // What the insides, grown back, do not reach is thin: its middle stands for an inside.
        let to_inside = distances(width, height, |cell| places[cell] == Place::Inside);
        for cell in 0..mask.len() {
            let thin = solid(cell) && places[cell] == Place::Unknown && to_inside[cell] > inside + 1.5;
            if thin && neighbors(width, height, cell).all(|other| depth[other] <= depth[cell]) {
                places[cell] = Place::Ridge;
            }
        }
        Self { depth, places }
    }
}

/// The up to eight cells around a cell.
fn neighbors(width: usize, height: usize, cell: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (cell % width, cell / width);
    let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
    let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
    rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
        .filter(move |&other| other != cell)
}
