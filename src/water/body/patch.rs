//! A pressure on the water under a hull, and how it reaches a grid's cells.

use glam::DVec2;

use super::{DENSITY, GRAVITY, starboard};
use crate::water::ripples::RippleGrid;

/// Where a patch ends, in units of its reach; what lies beyond is 0.03 % of its peak.
const CUT: f64 = 4.0;

/// Least reach of a patch on a grid, in cells: a finer one would fall between them.
const FINEST: f64 = 0.7;

/// A pressure with the shape of a Gaussian, elongated along a hull. Its center and unit vector are finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressurePatch {
    /// Its middle (x, z), meters.
    pub center: DVec2,
    /// Unit vector (x, z) to the bow.
    pub ahead: DVec2,
    /// Standard deviation along and across the hull, meters, above 0.
    pub reach: DVec2,
    /// Pressure in the middle, in meters of water. Above 0 it pushes the water down.
    pub head: f64,
    /// How the pressure grows ahead and to starboard, meters of water per meter.
    pub tilt: DVec2,
}

impl PressurePatch {
    /// The pressure at a point (x, z), pascals.
    #[must_use]
    pub fn at(&self, xz: DVec2) -> f64 {
        DENSITY * GRAVITY * self.water_head(self.local(xz))
    }

    /// Gives every cell that the patch reaches its index and pressure (pascals). A patch without pressure gives none.
    pub fn press(&self, grid: &RippleGrid, mut give: impl FnMut(usize, f64)) {
        if self.head != 0.0 || self.tilt != DVec2::ZERO {
            let wide = self.no_finer_than(FINEST * grid.cell);
            wide.cells(grid, |index, local| give(index, DENSITY * GRAVITY * wide.water_head(local)));
        }
    }

    /// Gives every cell that the patch reaches its index and the speed (m/s) at which its water rises when the patch
    /// moves ahead at `speed` (m/s) as a body that displaces `head`: up before the bow, down behind the stern. The
    /// sum over all cells is 0.
    ///
    /// For water that takes no pressure. The patch's tilt does not count.
    pub fn displace(&self, grid: &RippleGrid, speed: f64, mut give: impl FnMut(usize, f64)) {
        if speed == 0.0 || self.head == 0.0 {
            return;
        }
        // The change in time of a Gaussian that moves. On cells, and where the grid ends, its sum is not quite 0;
        // the rest is taken away where the patch is.
        let wide = self.no_finer_than(FINEST * grid.cell);
        let rate = |local: DVec2| speed * wide.head * local.x / wide.reach.x.powi(2) * wide.shape(local);
        let (mut sum, mut weights) = (0.0, 0.0);
        wide.cells(grid, |_, local| {
            sum += rate(local);
            weights += wide.shape(local);
        });
        wide.cells(grid, |index, local| give(index, rate(local) - sum / weights * wide.shape(local)));
    }

    /// This patch, with a reach of at least `least` (meters) and the same force.
    fn no_finer_than(&self, least: f64) -> Self {
        let reach = self.reach.max(DVec2::splat(least));
        let thinned = self.reach.element_product() / reach.element_product();
        Self { reach, head: thinned * self.head, tilt: thinned * self.tilt, ..*self }
    }

    /// A point as the hull sees it: meters ahead and to starboard.
    fn local(&self, xz: DVec2) -> DVec2 {
        let from = xz - self.center;
        DVec2::new(from.dot(self.ahead), from.dot(starboard(self.ahead)))
    }

    fn shape(&self, local: DVec2) -> f64 {
        (-0.5 * (local / self.reach).length_squared()).exp()
    }

    fn water_head(&self, local: DVec2) -> f64 {
        (self.head + self.tilt.dot(local)) * self.shape(local)
    }

    /// Visits the cells within reach with their index and their center as the hull sees it, row by row.
    fn cells(&self, grid: &RippleGrid, mut visit: impl FnMut(usize, DVec2)) {
        // The box around the turned ellipse.
        let right = starboard(self.ahead);
        let (along, across) = (self.ahead * self.reach.x, right * self.reach.y);
        let half = CUT * (along * along + across * across).powf(0.5);
        let low = ((self.center - half - grid.origin) / grid.cell).floor();
        let high = ((self.center + half - grid.origin) / grid.cell).ceil();
        let size = DVec2::splat(grid.size as f64);
        // Casts saturate, and what is no number becomes 0.
        let low = low.clamp(DVec2::ZERO, size).as_uvec2();
        let high = high.clamp(DVec2::ZERO, size).as_uvec2();
        for j in low.y..high.y {
            for i in low.x..high.x {
                let center = grid.center(i as usize, j as usize);
                let local = self.local(center);
                if (local / self.reach).length_squared() <= CUT * CUT {
                    visit(j as usize * grid.size + i as usize, local);
                }
            }
        }
    }
}
