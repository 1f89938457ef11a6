//! The leveled frame: the picture as a camera without pitch and roll would have taken it.
//!
//! In it a point and its mirror image stand in the same column, and rows count from the horizon: the row `horizon`
//! begins just below it. Flipping the frame about the horizon takes pixel centers to pixel centers.

use glam::{DMat3, DQuat, DVec2, DVec3, IVec2, Vec3};
use rayon::prelude::*;

use super::DepthError;
use super::view::{Kind, View};
use crate::camera::PinholeCamera;
use crate::picture::{Mask, Picture, PicturePoint};

/// Leveling spreads strongly tilted pictures; more than this of the picture's own sides is cut off.
const SPREAD: f64 = 2.0;
/// Rays nearer to the vertical than this have no place in the frame, radians (60°).
const STEEPEST: f64 = 1.047;

/// Where the leveled pixels lie in the picture.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub(super) width: usize,
    pub(super) height: usize,
    /// The first row below the horizon; may lie outside.
    pub(super) horizon: isize,
    /// Focal length, in leveled pixels.
    pub(super) focal: f64,
    /// Leveled x of the left border, in leveled pixels from the camera's heading.
    left: f64,
    camera: PinholeCamera,
    view_from_level: DMat3,
}

impl Frame {
    /// The frame of a camera's picture with about `pixels` pixels at most; its rows are counted in `blocks` from the
    /// horizon, so that it can be halved.
    pub(super) fn new(camera: &PinholeCamera, pixels: f64, block: usize) -> Result<Self, DepthError> {
        let lens = &camera.intrinsics;
        let sound = lens.focal_px > 0.0
            && lens.focal_px.is_finite()
            && lens.principal.0.is_finite()
            && camera.pose.rotation.is_finite()
            && camera.pose.rotation.is_normalized();
        if !sound {
            return Err(DepthError::Camera);
        }
        let size = lens.size.as_dvec2();
        let view_from_level = view_from_level(camera);
        let level_from_view = view_from_level.transpose();
        // The border's rays bound the frame.
        let steps = 32;
        let border = (0..=steps).flat_map(|i| {
            let t = f64::from(i) / f64::from(steps);
            [
                DVec2::new(t * size.x, 0.0),
                DVec2::new(t * size.x, size.y),
                DVec2::new(0.0, t * size.y),
                DVec2::new(size.x, t * size.y),
            ]
        });
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for point in border {
            let ray = level_from_view * lens.direction_in_view(PicturePoint(point));
            if ray.z < -STEEPEST.cos() * ray.length() {
                let at = DVec2::new(ray.x, ray.y) / -ray.z;
                (low, high) = (low.min(at), high.max(at));
            }
        }
        if !(low.is_finite() && high.is_finite()) {
            return Err(DepthError::Camera);
        }
        let reach = SPREAD * size / lens.focal_px;
        let middle = 0.5 * (low + high);
        (low, high) = (low.max(middle - 0.5 * reach), high.min(middle + 0.5 * reach));
        let scale = (pixels / (size.x * size.y)).sqrt().min(1.0);
        let focal = lens.focal_px * scale;
        let whole = |rows: f64| (rows / block as f64).ceil() as isize * block as isize;
        let (above, below) = (whole(high.y * focal), whole(-low.y * focal));
        let width = whole((high.x - low.x) * focal).max(block as isize) as usize;
        Ok(Self {
            width,
            height: (above + below).max(block as isize) as usize,
            horizon: above,
            focal,
            left: low.x * focal,
            camera: *camera,
            view_from_level,
        })
    }

    /// Where the picture shows the leveled point `x` pixels from the left border and `y` from the top one.
    pub(super) fn picture_point(&self, x: f64, y: f64) -> Option<PicturePoint> {
        let in_level = DVec3::new(self.left + x, self.horizon as f64 - y, -self.focal);
        self.camera.intrinsics.project_view(self.view_from_level * in_level)
    }

    /// The leveled point, from the left and top border, that the picture shows at `point`.
    pub(super) fn place(&self, point: PicturePoint) -> Option<DVec2> {
        let ray = self.view_from_level.transpose() * self.camera.intrinsics.direction_in_view(point);
        let at = DVec2::new(ray.x, ray.y) * (self.focal / -ray.z);
        (ray.z < 0.0).then(|| DVec2::new(at.x - self.left, self.horizon as f64 - at.y))
    }

    /// The leveled pixel that shows a picture point, by its index.
    pub(super) fn cell(&self, point: PicturePoint) -> Option<usize> {
        let at = self.place(point)?;
        let inside = at.cmpge(DVec2::ZERO).all() && at.x < self.width as f64 && at.y < self.height as f64;
        inside.then(|| at.y as usize * self.width + at.x as usize)
    }

    /// Pixels of the picture for one of the frame, near the picture's middle.
    pub(super) fn picture_scale(&self) -> f64 {
        self.camera.intrinsics.focal_px / self.focal
    }

    /// The picture's colors, and what is water, in this frame.
    pub(super) fn view(&self, picture: &Picture, water: &Mask) -> View {
        // Averaged where the frame is coarser than the picture, read between pixels where it is not.
        let samples = if self.picture_scale() > 1.3 { 2 } else { 1 };
        let cells: Vec<([f32; 3], Kind)> = (0..self.width * self.height)
            .into_par_iter()
            .map(|cell| self.cell_of(picture, water, cell, samples).unwrap_or(([0.0; 3], Kind::Outside)))
            .collect();
        let channel = |i: usize| cells.par_iter().map(|(color, _)| color[i]).collect();
        View {
            width: self.width,
            height: self.height,
            horizon: self.horizon,
            gray: cells.par_iter().map(|(color, _)| luma(*color)).collect(),
            channels: std::array::from_fn(channel),
            kinds: cells.iter().map(|(_, kind)| *kind).collect(),
        }
    }

    /// The mean color of a leveled pixel, and what it shows; `None` when it reaches beyond the picture.
    fn cell_of(
        &self,
        picture: &Picture,
        water: &Mask,
        cell: usize,
        samples: usize,
    ) -> Option<([f32; 3], Kind)> {
        let size = picture.size().as_ivec2();
        let corner = DVec2::new((cell % self.width) as f64, (cell / self.width) as f64);
        let (mut sum, mut wet) = (Vec3::ZERO, 0.0);
        for i in 0..samples * samples {
            let part = DVec2::new((i % samples) as f64 + 0.5, (i / samples) as f64 + 0.5) / samples as f64;
            let point = self.picture_point(corner.x + part.x, corner.y + part.y)?;
            if point.0.cmplt(DVec2::ZERO).any() || point.0.cmpgt(size.as_dvec2()).any() {
                return None;
            }
            let at = point.0 - 0.5;
            let (low, part) = (at.floor().as_ivec2(), at.fract_gl().as_vec2());
            let read = |dx: i32, dy: i32| {
                let at = (low + IVec2::new(dx, dy)).clamp(IVec2::ZERO, size - 1).as_uvec2();
                Vec3::from_array(picture.pixel(at.x, at.y).map(f32::from))
            };
            let upper = read(0, 0).lerp(read(1, 0), part.x);
            let lower = read(0, 1).lerp(read(1, 1), part.x);
            sum += upper.lerp(lower, part.y);
            wet += water.sample(point);
        }
        let count = (samples * samples) as f32;
        let kind = match wet / count {
            0.0..=0.25 => Kind::Direct,
            0.75.. => Kind::Water,
            _ => Kind::Outside,
        };
        Some(((sum / count).to_array(), kind))
    }
}

/// A leveled picture of the same scale: pixels from the camera's heading, to the right and up from the horizon.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level<'a> {
    camera: &'a PinholeCamera,
    view_from_level: DMat3,
}

impl<'a> Level<'a> {
    pub(super) fn of(camera: &'a PinholeCamera) -> Self {
        Self { camera, view_from_level: view_from_level(camera) }
    }

    /// The leveled point that the picture shows at `point`.
    pub(super) fn place(&self, point: PicturePoint) -> Option<DVec2> {
        let ray = self.view_from_level.transpose() * self.camera.intrinsics.direction_in_view(point);
        let at = DVec2::new(ray.x, ray.y) * (self.camera.intrinsics.focal_px / -ray.z);
        (ray.z < 0.0).then_some(at)
    }

    /// Where the picture shows a leveled point.
    pub(super) fn picture_point(&self, at: DVec2) -> Option<PicturePoint> {
        let in_level = DVec3::new(at.x, at.y, -self.camera.intrinsics.focal_px);
        self.camera.intrinsics.project_view(self.view_from_level * in_level)
    }
}

/// Turns directions of a leveled camera with the same heading into those of the camera.
fn view_from_level(camera: &PinholeCamera) -> DMat3 {
    let (yaw, ..) = camera.pose.angles();
    DMat3::from_quat(camera.pose.rotation.inverse()) * DMat3::from_quat(DQuat::from_rotation_y(yaw))
}

/// Brightness of sRGB codes as seen, 0–255.
pub(super) fn luma([r, g, b]: [f32; 3]) -> f32 {
    0.299 * r + 0.587 * g + 0.114 * b
}
