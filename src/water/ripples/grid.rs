//! Where the cells of the ripples lie, and how a shape covers them.

use glam::DVec2;

/// A square of square cells over the water: columns along x, rows along z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RippleGrid {
    /// Outer corner with the lowest x and z, meters.
    pub origin: DVec2,
    /// Side of a cell, meters.
    pub cell: f64,
    /// Cells along a side, a power of two from 16 to 1024.
    pub size: usize,
}

/// Why there are no ripples.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RippleError {
    /// A size that no transform is planned for.
    #[error("ripples need a power of two from 16 to 1024 cells along a side, not {0}")]
    Size(usize),
    /// A length that means nothing.
    #[error("ripples need finite numbers and cells of 1 mm to 100 m; the grid is {0:?}")]
    Grid(RippleGrid),
    /// An option out of its range.
    #[error("{name} is {value}; it must be {range}")]
    Option {
        /// Which.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What may be.
        range: &'static str,
    },
    /// A mask of another shape than the grid.
    #[error("the mask has {found} cells, the grid {expected}")]
    MaskSize {
        /// Cells of the mask.
        found: usize,
        /// Cells of the grid.
        expected: usize,
    },
    /// A mask with a value that is no share of water.
    #[error("the mask is {value} at cell {cell}; it must be from 0 (wall) to 1 (water)")]
    MaskValue {
        /// Index of the cell, row by row.
        cell: usize,
        /// What stands there.
        value: f32,
    },
}

impl RippleGrid {
    /// A grid of `size` cells of `cell` meters along a side, around a point.
    #[must_use]
    pub fn around(center: DVec2, cell: f64, size: usize) -> Self {
        Self { origin: center - 0.5 * cell * size as f64, cell, size }
    }

    /// Meters along a side.
    #[must_use]
    pub fn side(&self) -> f64 {
        self.cell * self.size as f64
    }

    /// Center of the cell of a column and row, (x, z) in meters.
    #[must_use]
    pub fn center(&self, column: usize, row: usize) -> DVec2 {
        self.origin + self.cell * DVec2::new(column as f64 + 0.5, row as f64 + 0.5)
    }

    /// A point in columns and rows: the center of cell (0, 0) is at zero.
    #[must_use]
    pub fn to_cells(&self, xz: DVec2) -> DVec2 {
        (xz - self.origin) / self.cell - 0.5
    }

    /// How many cells it has.
    pub(super) fn cells(&self) -> usize {
        self.size * self.size
    }

    pub(super) fn check(&self) -> Result<(), RippleError> {
        if !self.size.is_power_of_two() || !(16..=1024).contains(&self.size) {
            return Err(RippleError::Size(self.size));
        }
        if !self.origin.is_finite() || !(1e-3..=100.0).contains(&self.cell) {
            return Err(RippleError::Grid(*self));
        }
        Ok(())
    }
}

/// Cells of a grid, each with the share of it that a shape covers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CellWeights {
    cells: Vec<(u32, f32)>,
}

impl CellWeights {
    /// Index (row by row) and share, above 0 to 1, of every cell that is covered, in order.
    pub fn iter(&self) -> impl Iterator<Item = (usize, f32)> {
        self.cells.iter().map(|&(cell, weight)| (cell as usize, weight))
    }

    /// Cells covered in all.
    #[must_use]
    pub fn total(&self) -> f32 {
        self.cells.iter().map(|(_, weight)| weight).sum()
    }

    /// Whether nothing is covered.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// Makes a wall of what is covered.
    pub fn cut_from(&self, mask: &mut [f32]) {
        for (cell, weight) in self.iter() {
            if let Some(water) = mask.get_mut(cell) {
                *water *= 1.0 - weight;
            }
        }
    }

    pub(super) fn clear(&mut self) {
        self.cells.clear();
    }

    pub(super) fn push(&mut self, cell: usize, weight: f32) {
        self.cells.push((cell as u32, weight));
    }
}
