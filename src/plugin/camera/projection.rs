//! The picture's own projection, in a viewport of any shape.

use bevy::camera::{CameraProjection, SubCameraView};
use bevy::math::{DMat4, DVec2, Mat4, Vec3A, Vec4};

use crate::camera::Fit;
use crate::camera::Intrinsics;

/// A pinhole projection with an off-center principal point; reverse z, no far plane.
#[derive(Clone, Debug)]
pub struct TourProjection {
    /// The picture's lens and size.
    pub picture: Intrinsics,
    /// How the picture fills the viewport.
    pub fit: Fit,
    /// Roll in radians that the camera's transform leaves out: Bevy's `FreeCamera` knows none.
    pub roll: f64,
    /// Distance of the near plane in the game's units, above 0.
    pub near: f64,
    viewport: DVec2,
}

impl TourProjection {
    /// The projection of a picture's lens.
    #[must_use]
    pub fn new(picture: Intrinsics, fit: Fit) -> Self {
        Self { picture, fit, roll: 0.0, near: 0.05, viewport: picture.size.as_dvec2() }
    }
}

impl CameraProjection for TourProjection {
    fn get_clip_from_view(&self) -> Mat4 {
        // The picture's own clip space, enlarged about its center until it covers the viewport or fits in.
        let ratio = self.viewport / self.picture.size.as_dvec2();
        let scale = match self.fit {
            Fit::Cover => ratio.max_element(),
            Fit::Contain => ratio.min_element(),
        };
        let share = scale / ratio;
        let fit = DMat4::from_scale(share.extend(1.0));
        let clip = fit * self.picture.clip_from_view(self.near) * DMat4::from_rotation_z(-self.roll);
        clip.as_mat4()
    }

    fn get_clip_from_view_for_sub(&self, sub: &SubCameraView) -> Mat4 {
        // The part of the full view is brought to fill clip space.
        let full = sub.full_size.as_vec2();
        let scale = full / sub.size.as_vec2();
        let center = (sub.offset + 0.5 * sub.size.as_vec2()) / full;
        let shift = (bevy::math::Vec2::ONE - 2.0 * center) * scale;
        let crop = Mat4::from_cols(
            Vec4::new(scale.x, 0.0, 0.0, 0.0),
            Vec4::new(0.0, scale.y, 0.0, 0.0),
            Vec4::Z,
            Vec4::new(shift.x, -shift.y, 0.0, 1.0),
        );
        crop * self.get_clip_from_view()
    }

    fn update(&mut self, width: f32, height: f32) {
        // In logical pixels, so not always whole.
        self.viewport = DVec2::new(width.into(), height.into()).max(DVec2::splat(1e-3));
    }

    fn far(&self) -> f32 {
        1e6
    }

    fn get_frustum_corners(&self, z_near: f32, z_far: f32) -> [Vec3A; 8] {
        let view_from_clip = self.get_clip_from_view().inverse();
        let corners = [(1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)].map(|(x, y)| {
            let near = view_from_clip.project_point3a(Vec3A::new(x, y, 1.0));
            near / -near.z
        });
        let [a, b, c, d] = corners;
        let [near, far] = [z_near.abs(), z_far.abs()];
        [a * near, b * near, c * near, d * near, a * far, b * far, c * far, d * far]
    }
}

#[cfg(test)]
mod tests {
    use bevy::math::UVec2;

    use super::*;
    use crate::picture::PicturePoint;

    #[test]
    fn a_sub_view_of_everything_is_the_view_and_its_quarter_is_magnified() {
        let picture = Intrinsics {
            focal_px: 820.0,
            principal: PicturePoint::new(470.0, 280.0),
            size: UVec2::new(960, 540),
        };
        let projection = TourProjection::new(picture, Fit::Cover);
        let mut sub = SubCameraView {
            full_size: UVec2::new(960, 540),
            size: UVec2::new(960, 540),
            ..Default::default()
        };
        let full = projection.get_clip_from_view();
        assert!(projection.get_clip_from_view_for_sub(&sub).abs_diff_eq(full, 1e-6));
        // The lower right quarter: its center is seen in the middle of clip space.
        sub.size = UVec2::new(480, 270);
        sub.offset = bevy::math::Vec2::new(480.0, 270.0);
        let direction = picture.direction_in_view(PicturePoint::new(720.0, 405.0)).as_vec3();
        let clip = projection.get_clip_from_view_for_sub(&sub).project_point3(direction);
        assert!(clip.truncate().length() < 1e-5, "{clip} is not the middle");
    }
}
