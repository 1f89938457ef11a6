//! Moving the grid over the water, for lakes longer than it.

use super::{RippleError, Ripples};

impl Ripples {
    /// Moves the grid by whole columns (along x) and rows (along z) and takes the mask of its new place. The waves stay where
    /// they are on the water, to the bit; water that is new to the grid is still. Allocates: not for every frame.
    ///
    /// # Errors
    ///
    /// A mask that cannot be used, as in [`set_mask`](Self::set_mask); then nothing has moved.
    pub fn follow(&mut self, columns: i32, rows: i32, mask: &[f32]) -> Result<(), RippleError> {
        self.set_mask(mask)?;
        let size = self.grid.size;
        let shift = |field: &[f32]| -> Vec<f32> {
            let old = |place: usize, by: i32| {
                usize::try_from(place as i64 + i64::from(by)).ok().filter(|place| *place < size)
            };
            let moved = (0..size * size).map(|cell| {
                let from = old(cell % size, columns).zip(old(cell / size, rows));
                from.map_or(0.0, |(column, row)| field[row * size + column])
            });
            moved.collect()
        };
        self.height = shift(&self.height);
        self.potential = shift(&self.potential);
        self.before = shift(&self.before);
        self.look_back(0.0);
        self.grid.origin += self.grid.cell * glam::DVec2::new(f64::from(columns), f64::from(rows));
        Ok(())
    }
}
