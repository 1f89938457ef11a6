//! Picture points turned level: the picture a camera at the same place without pitch and roll would have taken.
//!
//! In leveled coordinates the paper's equations hold exactly (README, "Leveled coordinates").

use glam::{DMat2, DMat3, DQuat, DVec2, DVec3, EulerRot};

use crate::picture::PicturePoint;

/// A lens with its tilt; knows no height.
#[derive(Clone, Copy, Debug)]
pub(super) struct TiltedLens {
    pub(super) focal_px: f64,
    pub(super) principal: DVec2,
    world_from_view: DMat3,
}

/// Smallest cosine between a ray and the level direction ahead that is told from zero.
const LEAST_AHEAD: f64 = 1e-3;

impl TiltedLens {
    pub(super) fn new(focal_px: f64, principal: PicturePoint, pitch: f64, roll: f64) -> Self {
        let rotation = DQuat::from_euler(EulerRot::YXZ, 0.0, pitch, roll);
        Self { focal_px, principal: principal.0, world_from_view: DMat3::from_quat(rotation) }
    }

    /// (X, Y, depth) of the ray through `point`; the depth is that along −z.
    fn ray(&self, point: PicturePoint) -> DVec3 {
        let offset = (point.0 - self.principal) / self.focal_px;
        let ray = self.world_from_view * DVec3::new(offset.x, -offset.y, -1.0);
        DVec3::new(ray.x, ray.y, (-ray.z).max(LEAST_AHEAD))
    }

    /// The point's leveled coordinates: x to the right and y up, both at depth 1.
    pub(super) fn level(&self, point: PicturePoint) -> DVec2 {
        let ray = self.ray(point);
        ray.truncate() / ray.z
    }

    /// The same, with its derivative by picture x (first column) and picture y (second column), per pixel.
    pub(super) fn level_with_derivative(&self, point: PicturePoint) -> (DVec2, DMat2) {
        let ray = self.ray(point);
        let level = ray.truncate() / ray.z;
        // d(X/D) = (dX − x·dD)/D with D = −Z; picture y points down, so its column is negated.
        let by = |column: DVec3| (column.truncate() + level * column.z) / (ray.z * self.focal_px);
        let derivative = DMat2::from_cols(by(self.world_from_view.x_axis), -by(self.world_from_view.y_axis));
        (level, derivative)
    }

    /// Where leveled coordinates are seen.
    pub(super) fn picture(&self, level: DVec2) -> PicturePoint {
        let view = self.world_from_view.transpose() * level.extend(-1.0);
        let scale = self.focal_px / (-view.z).max(LEAST_AHEAD);
        PicturePoint(self.principal + DVec2::new(view.x, -view.y) * scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leveling_is_undone_and_its_derivative_is_the_difference_quotient() {
        let lens = TiltedLens::new(900.0, PicturePoint::new(470.0, 260.0), -0.1, 0.05);
        let point = PicturePoint::new(700.0, 500.0);
        let (level, derivative) = lens.level_with_derivative(point);
        let back = lens.picture(level);
        assert!(back.0.distance(point.0) < 1e-9, "{point} came back as {back}");
        for (axis, column) in [(DVec2::X, derivative.x_axis), (DVec2::Y, derivative.y_axis)] {
            let step = lens.level(PicturePoint(point.0 + 1e-4 * axis))
                - lens.level(PicturePoint(point.0 - 1e-4 * axis));
            assert!((step / 2e-4).distance(column) < 1e-9, "{} is not {column}", step / 2e-4);
        }
    }
}
