//! The water's surface as a pixel sees it: what is finer than its footprint is not a slope but roughness.

use glam::{DVec2, DVec3};

use super::body::WaterHeight;
use super::ripples::Ripples;
use super::sea::{SeaSurface, SeaTile};

/// The water's surface at one place, in the mean over a pixel's footprint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WaterPoint {
    /// Meters above the resting water.
    pub height: f64,
    /// ∂height/∂x and ∂height/∂z.
    pub slope: DVec2,
    /// Variance, in any one direction, of the slopes that vanish in the mean (notes §8.4).
    pub roughness: f64,
}

impl WaterPoint {
    /// Unit normal, y up.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        DVec3::new(-self.slope.x, 1.0, -self.slope.y).normalize()
    }
}

/// The water anywhere, at one moment.
pub trait WaterSurface: Sync {
    /// The surface at a point (x, z) of the world, meters, for a pixel that covers `footprint` meters of it.
    fn at(&self, xz: DVec2, footprint: f64) -> WaterPoint;
}

/// Water at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StillWater;

impl WaterSurface for StillWater {
    fn at(&self, _xz: DVec2, _footprint: f64) -> WaterPoint {
        WaterPoint::default()
    }
}

/// The waves of the wind and the ripples over them. Twin of `surface` in `waves.wgsl`.
#[derive(Clone, Copy, Debug, Default)]
pub struct MovingWater<'a> {
    /// The waves of the wind.
    pub sea: Option<&'a SeaSurface>,
    /// What touches and bodies raised.
    pub ripples: Option<&'a Ripples>,
}

impl WaterSurface for MovingWater<'_> {
    fn at(&self, xz: DVec2, footprint: f64) -> WaterPoint {
        let mut point = WaterPoint::default();
        if !xz.is_finite() {
            return point;
        }
        if let Some(sea) = self.sea.filter(|sea| sea.present_gain() > 0.0) {
            for tile in sea.tiles() {
                let level = tile_level(tile, footprint);
                let [height, x, z, _] = tile.mean(xz, level).map(f64::from);
                point.height += height;
                point.slope += DVec2::new(x, z);
            }
            point.roughness = roughness(sea, footprint);
        }
        if let Some(ripples) = self.ripples {
            point.height += f64::from(ripples.height_at(xz));
            point.slope += ripples.slope_at(xz).as_dvec2();
        }
        point
    }
}

impl WaterHeight for MovingWater<'_> {
    fn height(&self, xz: DVec2) -> f64 {
        let wave = self.sea.map_or(0.0, |sea| sea.sample(xz).height);
        f64::from(wave) + self.ripples.map_or(0.0, |ripples| f64::from(ripples.height_at(xz)))
    }
}

/// The mip level of a tile for pixels that cover `footprint` meters of the water.
fn tile_level(tile: &SeaTile, footprint: f64) -> f32 {
    let coarsest = (tile.lost_by_level().len() - 1) as f32;
    ((footprint / tile.texel()).log2() as f32).clamp(0.0, coarsest)
}

/// Variance, in any one direction, of the slopes that a pixel of this footprint does not resolve.
fn roughness(sea: &SeaSurface, footprint: f64) -> f64 {
    let lost = sea.tiles().iter().map(|tile| {
        let level = f64::from(tile_level(tile, footprint));
        let levels = tile.lost_by_level();
        let [low, high] = [level.floor(), level.ceil()].map(|level| levels[level as usize].total());
        low + level.fract() * (high - low)
    });
    0.5 * sea.present_gain().powi(2) * (sea.hidden_covariance().total() + lost.sum::<f64>())
}
