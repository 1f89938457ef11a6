//! What ripples show: heights and slopes, at points and as texels.
//!
//! All fades to 0 in the last tenth of the grid, so that ripples have no visible border.

use glam::{DVec2, Vec2};

use super::Ripples;

/// Share of the grid's side over which ripples fade, on either side.
const FADE: f32 = 0.1;

/// How much is shown at each place along a side: 0 at the border, 1 inside.
pub(super) fn fade(size: usize) -> Vec<f32> {
    let shown = (0..size).map(|place| {
        let inside = place.min(size - 1 - place) as f32 / (FADE * size as f32);
        let inside = inside.min(1.0);
        inside * inside * (3.0 - 2.0 * inside)
    });
    shown.collect()
}

impl Ripples {
    /// Shows the water as it was so much of a step before the last one's end, 0 to 1, until the next: for frames that come
    /// between steps. Heights and slopes are joined by straight lines.
    pub fn look_back(&mut self, part_of_step: f64) {
        let lag = if part_of_step > 0.0 { part_of_step.min(1.0) as f32 } else { 0.0 };
        if lag == self.lag {
            return;
        }
        self.lag = lag;
        let ends = self.height.iter().zip(&self.before);
        for (between, (now, before)) in self.between.iter_mut().zip(ends) {
            *between = now + lag * (before - now);
        }
        self.texels_are_old = true;
    }

    /// The heights that are shown.
    fn shown(&self) -> &[f32] {
        if self.lag > 0.0 { &self.between } else { &self.height }
    }

    /// Height of the ripples at (x, z), meters; 0 outside the grid.
    #[must_use]
    pub fn height_at(&self, xz: DVec2) -> f32 {
        let heights = self.shown();
        self.interpolate(xz, |cell, shown| shown * heights[cell])
    }

    /// ∂height/∂x and ∂height/∂z of the ripples at (x, z); 0 outside the grid.
    #[must_use]
    pub fn slope_at(&self, xz: DVec2) -> Vec2 {
        self.interpolate(xz, |cell, shown| shown * self.slope(cell))
    }

    /// Whether there is water in the cell at (x, z); false outside the grid and for what is no number.
    #[must_use]
    pub fn is_water(&self, xz: DVec2) -> bool {
        let place = (self.grid.to_cells(xz) + 0.5).floor();
        let side = self.grid.size as f64;
        let is_inside = (0.0..side).contains(&place.x) && (0.0..side).contains(&place.y);
        is_inside && self.mask[place.y as usize * self.grid.size + place.x as usize] > 0.0
    }

    /// Height (meters), slope along x, slope along z, mask, of every cell, in rows along x. Computed when asked for, and kept
    /// until something moves.
    pub fn texels(&mut self) -> &[[f32; 4]] {
        if self.texels_are_old {
            self.texels_are_old = false;
            let mut texels = std::mem::take(&mut self.texels);
            self.fill_texels(&mut texels);
            self.texels = texels;
        }
        &self.texels
    }

    fn fill_texels(&self, texels: &mut [[f32; 4]]) {
        let (size, heights) = (self.grid.size, self.shown());
        if self.is_still {
            for (texel, mask) in texels.iter_mut().zip(&self.mask) {
                *texel = [0.0, 0.0, 0.0, *mask];
            }
            return;
        }
        let across = 0.5 / self.grid.cell as f32;
        for row in 0..size {
            let texels = &mut texels[row * size..][..size];
            // The border shows nothing, so that any neighbor will do for it.
            let at = |row: usize| row * size..(row + 1) * size;
            let (above, below) = (row.saturating_sub(1), (row + 1).min(size - 1));
            let [up, here, down] = [above, row, below].map(|row| &heights[at(row)]);
            let [up_mask, mask, down_mask] = [above, row, below].map(|row| &self.mask[at(row)]);
            let fade = &self.fade[..size];
            for i in 1..size - 1 {
                let height = here[i];
                let x = mask[i + 1] * (here[i + 1] - height) - mask[i - 1] * (here[i - 1] - height);
                let z = down_mask[i] * (down[i] - height) - up_mask[i] * (up[i] - height);
                let shown = fade[i] * self.fade[row];
                let steepness = shown * across;
                texels[i] = [shown * height, steepness * x, steepness * z, mask[i]];
            }
            for border in [0, size - 1] {
                texels[border] = [0.0, 0.0, 0.0, mask[border]];
            }
        }
    }

    /// The slope of a cell: half the difference of its neighbors. A wall is as high as the water before it.
    fn slope(&self, cell: usize) -> Vec2 {
        let (size, heights) = (self.grid.size, self.shown());
        let height = heights[cell];
        let rise = |next: Option<usize>| {
            next.filter(|next| *next < self.mask.len())
                .map_or(0.0, |next| self.mask[next] * (heights[next] - height))
        };
        // In the border's cells, which show nothing, the neighbor may be of another row.
        let x = rise(cell.checked_add(1)) - rise(cell.checked_sub(1));
        let z = rise(cell.checked_add(size)) - rise(cell.checked_sub(size));
        0.5 / self.grid.cell as f32 * Vec2::new(x, z)
    }

    /// A bilinear mean of what `value` says of a cell and of how much it shows.
    fn interpolate<T>(&self, xz: DVec2, value: impl Fn(usize, f32) -> T) -> T
    where
        T: Default + std::ops::Add<Output = T> + std::ops::Mul<f32, Output = T>,
    {
        let size = self.grid.size;
        let place = self.grid.to_cells(xz);
        let last = (size - 1) as f64;
        // False for what is not a number, too.
        let is_inside = (0.0..last).contains(&place.x) && (0.0..last).contains(&place.y);
        if self.is_still || !is_inside {
            return T::default();
        }
        let corner = place.floor();
        let share = (place - corner).as_vec2();
        let (column, row) = (corner.x as usize, corner.y as usize);
        let mut mean = T::default();
        for (dx, across) in [(0, 1.0 - share.x), (1, share.x)] {
            for (dz, along) in [(0, 1.0 - share.y), (1, share.y)] {
                let shown = self.fade[column + dx] * self.fade[row + dz];
                mean = mean + value((row + dz) * size + column + dx, shown) * (across * along);
            }
        }
        mean
    }
}
