//! The picture's water as a second view: which point a water pixel mirrors, and where that point is seen directly.
//!
//! Mirror and vertical planes commute, so the reflected ray meets a wall where the straight prolongation of the camera
//! ray meets it, turned upside down.

use crate::picture::PicturePoint;
use crate::scene::Surface;
use crate::scene::TourScene;
use crate::scene::mirror;

/// What one component would show at a water pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mirrored {
    /// Parameter along the camera ray's prolongation; it orders components like the reflected ray does.
    pub parameter: f64,
    /// Where the mirrored point is seen directly.
    pub direct: PicturePoint,
    /// Sine of the grazing angle at the water, 0–1.
    pub grazing: f32,
    /// Which share of the way from the camera to what is mirrored lies behind the water, 0–1.
    pub behind: f32,
}

/// What `surface` would show in the water at `pixel`; `None` where no water is seen or the mirrored ray passes it by.
#[must_use]
pub(super) fn mirrored(scene: &TourScene, surface: &Surface, pixel: PicturePoint) -> Option<Mirrored> {
    let ray = scene.camera.ray(pixel);
    if ray.direction.y >= 0.0 {
        return None;
    }
    let to_water = -ray.origin.y / ray.direction.y;
    let grazing = (-ray.direction.y / ray.direction.length()) as f32;
    let (parameter, direct) = match surface {
        Surface::Wall(wall) => {
            let t = wall.meet_plane(ray).filter(|&t| t >= to_water)?;
            let point = mirror(ray.at(t));
            (t, scene.camera.project(point).filter(|_| wall.contains(point))?)
        }
        Surface::Level(level) => {
            let t = (-level.height - ray.origin.y) / ray.direction.y;
            (t, scene.camera.project(mirror(ray.at(t)))?)
        }
        Surface::Infinity => {
            let in_view = scene.camera.pose.rotation.inverse() * mirror(ray.direction);
            (f64::INFINITY, scene.camera.intrinsics.project_view(in_view)?)
        }
    };
    let behind = (1.0 - to_water / parameter).clamp(0.0, 1.0) as f32;
    Some(Mirrored { parameter, direct, grazing, behind })
}

/// Where the point that `surface` shows directly at `pixel` is mirrored in the picture's water.
#[must_use]
pub(super) fn reflection_of(
    scene: &TourScene,
    surface: &Surface,
    pixel: PicturePoint,
) -> Option<PicturePoint> {
    let ray = scene.camera.ray(pixel);
    if *surface == Surface::Infinity {
        let in_view = scene.camera.pose.rotation.inverse() * mirror(ray.direction);
        return scene.camera.intrinsics.project_view(in_view);
    }
    let point = ray.at(surface.meet_plane(ray)?);
    (point.y > 0.0).then(|| scene.camera.project(mirror(point)))?
}
