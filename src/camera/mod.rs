//! The pinhole camera: where it stands, how it projects, how it moves.
//!
//! World: meters, x right, y up, −z into the picture; resting water at y = 0. View: x right, y up, −z ahead.
//! Pictures are undistorted and have square pixels.

mod fit;
mod path;
mod pose;
mod visitor;

pub use fit::{Fit, FittedView, fitted};
pub use path::{CameraPath, Easing, Keyframe};
pub use pose::CameraPose;
pub use visitor::{Visitor, VisitorSettings, VisitorWish};

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, UVec2};
use serde::{Deserialize, Serialize};

use crate::picture::PicturePoint;

/// A ray: points `origin + t · direction`, t ≥ 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts, meters.
    pub origin: DVec3,
    /// Where it goes; need not be of unit length, then t is in units of its length.
    pub direction: DVec3,
}

impl Ray {
    /// The point at parameter `t`.
    #[must_use]
    pub fn at(self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }
}

/// What the lens and the frame are: focal length, principal point and size, all in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Intrinsics {
    /// Focal length in pixels, above 0.
    pub focal_px: f64,
    /// Where the optical axis meets the picture; may lie off-center (a crop, a shift lens).
    pub principal: PicturePoint,
    /// Width and height in pixels.
    pub size: UVec2,
}

impl Intrinsics {
    /// The direction in view space of the ray through `point`, scaled so that its z is −1.
    #[must_use]
    pub fn direction_in_view(&self, point: PicturePoint) -> DVec3 {
        let offset = (point.0 - self.principal.0) / self.focal_px;
        DVec3::new(offset.x, -offset.y, -1.0)
    }

    /// Where a point or direction of view space is seen; `None` behind the camera.
    #[must_use]
    pub fn project_view(&self, in_view: DVec3) -> Option<PicturePoint> {
        (in_view.z < 0.0).then(|| {
            let offset = DVec2::new(in_view.x, -in_view.y) * (self.focal_px / -in_view.z);
            PicturePoint(self.principal.0 + offset)
        })
    }

    /// The projection into Bevy's clip space that shows what the picture shows: reverse-z, the far plane at infinity.
    ///
    /// `near` is the view depth of the near plane in meters, above 0.
    #[must_use]
    pub fn clip_from_view(&self, near: f64) -> DMat4 {
        let (size, c) = (self.size.as_dvec2(), self.principal.0);
        let f = 2.0 * self.focal_px / size;
        DMat4::from_cols(
            DVec4::new(f.x, 0.0, 0.0, 0.0),
            DVec4::new(0.0, f.y, 0.0, 0.0),
            DVec4::new(1.0 - 2.0 * c.x / size.x, 2.0 * c.y / size.y - 1.0, 0.0, -1.0),
            DVec4::new(0.0, 0.0, near, 0.0),
        )
    }

    /// The same lens when the frame is scaled to `size`: focal length by height, principal point by each side.
    #[must_use]
    pub fn scaled_to(&self, size: UVec2) -> Self {
        let ratio = size.as_dvec2() / self.size.as_dvec2();
        Self { focal_px: self.focal_px * ratio.y, principal: PicturePoint(self.principal.0 * ratio), size }
    }
}

/// A camera without distortion, with square pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PinholeCamera {
    /// Lens and frame.
    pub intrinsics: Intrinsics,
    /// Where it stands and looks.
    pub pose: CameraPose,
}

impl PinholeCamera {
    /// Where a point of the world is seen; `None` when it lies behind the camera.
    #[must_use]
    pub fn project(&self, point: DVec3) -> Option<PicturePoint> {
        self.intrinsics.project_view(self.pose.rotation.inverse() * (point - self.pose.position))
    }

    /// The ray of the world through a picture point; its direction has view depth 1.
    #[must_use]
    pub fn ray(&self, point: PicturePoint) -> Ray {
        Ray {
            origin: self.pose.position,
            direction: self.pose.rotation * self.intrinsics.direction_in_view(point),
        }
    }

    /// What a picture point shows, if that lies `height` meters above the resting water; `None` where the ray through it never
    /// comes to that height.
    #[must_use]
    pub fn on_level(&self, point: PicturePoint, height: f64) -> Option<DVec3> {
        let ray = self.ray(point);
        let t = (height - ray.origin.y) / ray.direction.y;
        let place = ray.at(t);
        (t > 0.0 && place.is_finite()).then_some(place)
    }

    /// The two ends of the horizon (vanishing line of the water) at the picture's left and right border.
    ///
    /// `None` when the camera looks straight down or up.
    #[must_use]
    pub fn horizon(&self) -> Option<[PicturePoint; 2]> {
        // A view direction d is level when up·d = 0; up in view space is the second row of the rotation.
        let up = self.pose.rotation.inverse() * DVec3::Y;
        let (f, c) = (self.intrinsics.focal_px, self.intrinsics.principal.0);
        (up.y.abs() > 1e-9).then(|| {
            [0.0, f64::from(self.intrinsics.size.x)].map(|x| {
                // up.x (x−cx)/f − up.y (y−cy)/f − up.z = 0
                PicturePoint::new(x, c.y + (up.x * (x - c.x) - up.z * f) / up.y)
            })
        })
    }

    /// The 3×3 matrix K·R that takes a world direction to homogeneous picture coordinates.
    #[must_use]
    pub fn picture_from_world_direction(&self) -> DMat3 {
        let (f, c) = (self.intrinsics.focal_px, self.intrinsics.principal.0);
        // (x, y, w) = (f·X − cx·Z, −f·Y − cy·Z, −Z)
        let from_view =
            DMat3::from_cols(DVec3::new(f, 0.0, 0.0), DVec3::new(0.0, -f, 0.0), DVec3::new(-c.x, -c.y, -1.0));
        from_view * DMat3::from_quat(self.pose.rotation.inverse())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> PinholeCamera {
        PinholeCamera {
            intrinsics: Intrinsics {
                focal_px: 820.0,
                principal: PicturePoint::new(470.0, 280.0),
                size: UVec2::new(960, 540),
            },
            pose: CameraPose::from_angles(DVec3::new(0.3, 1.8, 0.2), 0.1, -0.05, 0.03),
        }
    }

    #[test]
    fn projecting_a_point_of_a_ray_gives_the_ray_s_pixel() {
        let camera = camera();
        for point in [PicturePoint::new(3.0, 7.0), PicturePoint::new(900.0, 500.0)] {
            let seen = camera.project(camera.ray(point).at(37.0)).unwrap();
            assert!(seen.0.distance(point.0) < 1e-9, "{seen} is not {point}");
            let ray = camera.ray(point);
            let homogeneous = camera.picture_from_world_direction() * ray.direction;
            let seen = homogeneous.truncate() / homogeneous.z;
            assert!(seen.distance(point.0) < 1e-9, "{seen} is not {point}");
        }
    }

    #[test]
    fn a_point_on_a_level_is_seen_where_it_was_looked_for_and_none_above_the_horizon() {
        let camera = camera();
        let [end, _] = camera.horizon().unwrap();
        for height in [0.0, 0.7] {
            let point = PicturePoint::new(0.0, end.y() + 40.0);
            let place = camera.on_level(point, height).unwrap();
            assert!((place.y - height).abs() < 1e-12, "{place} is not {height} m high");
            assert!(camera.project(place).unwrap().0.distance(point.0) < 1e-9);
            assert_eq!(camera.on_level(PicturePoint::new(0.0, end.y() - 40.0), height), None);
        }
    }

    #[test]
    fn the_projection_matrix_shows_a_point_where_the_pinhole_does() {
        let intrinsics = camera().intrinsics;
        let clip_from_view = intrinsics.clip_from_view(0.1);
        for in_view in
            [DVec3::new(0.0, 0.0, -0.1), DVec3::new(-3.0, 2.0, -7.0), DVec3::new(900.0, -40.0, -1e4)]
        {
            let clip = clip_from_view * in_view.extend(1.0);
            let ndc = clip.truncate() / clip.w;
            let seen = (ndc.truncate() * DVec2::new(0.5, -0.5) + 0.5) * intrinsics.size.as_dvec2();
            let expected = intrinsics.project_view(in_view).unwrap();
            assert!(seen.distance(expected.0) < 1e-9, "{seen} is not {expected}");
            assert!((ndc.z - 0.1 / -in_view.z).abs() < 1e-12, "depth {} at {in_view}", ndc.z);
        }
    }

    #[test]
    fn the_horizon_is_where_rays_are_level() {
        let camera = camera();
        for end in camera.horizon().unwrap() {
            assert!(camera.ray(end).direction.y.abs() < 1e-12, "{end} is not level");
        }
    }
}
