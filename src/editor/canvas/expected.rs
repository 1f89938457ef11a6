//! Where the solution puts a pair's reflection, so that its residual can be drawn as an arrow.
//!
//! The point is put on the plane that carries it, mirrored in the resting water and projected (notes §1.1).

use glam::{DVec2, DVec3};

use crate::camera::PinholeCamera;
use crate::picture::PicturePoint;
use crate::solve::Solution;
use crate::tour::{BackgroundPlace, ReflectionPair, Support, TourFile};

/// Where the reflection of a pair's point is expected.
///
/// Without a known plane only what lies across the direction of reflections can be told; the nearest point of the line on
/// which the reflection must lie is given then. `None` where the point has no such place.
pub(super) fn expected_reflection(
    pair: &ReflectionPair,
    tour: &TourFile,
    solution: &Solution,
    camera: &PinholeCamera,
) -> Option<PicturePoint> {
    let ray = camera.ray(pair.point);
    let mirrored = |depth: f64| {
        let point = ray.at(depth / -ray.direction.z);
        camera.project(DVec3::new(point.x, -point.y, point.z))
    };
    if let Some(depth) = plane_depth(pair, tour, solution, camera) {
        return mirrored(depth);
    }
    // Reflections of all points of the ray lie on one line of the picture.
    let height = solution.parameters.height;
    let (near, far) = (mirrored(5.0 * height)?.0, mirrored(50.0 * height)?.0);
    let along = (far - near).try_normalize()?;
    Some(PicturePoint(near + along * (pair.reflection.0 - near).dot(along)))
}

/// Depth along −z at which a pair's point lies on the plane that carries it.
fn plane_depth(
    pair: &ReflectionPair,
    tour: &TourFile,
    solution: &Solution,
    camera: &PinholeCamera,
) -> Option<f64> {
    let parameters = &solution.parameters;
    let on = pair.on.as_deref()?;
    if let Some(object) = tour.objects.iter().find(|object| object.name == on) {
        let level = match object.support {
            Support::Water => 0.0,
            Support::Ground => parameters.ground_height,
        };
        let foot = |point: PicturePoint| {
            let ray = camera.ray(point);
            let hit = ray.at(parameters.depth_on_level(point, level)? / -ray.direction.z);
            Some(DVec2::new(hit.x, hit.z))
        };
        let (left, right) = (foot(object.contact[0])?, foot(object.contact[1])?);
        // The vertical plane through both feet.
        let normal = (right - left).perp();
        let ray = camera.ray(pair.point);
        let (origin, direction) =
            (DVec2::new(ray.origin.x, ray.origin.z), DVec2::new(ray.direction.x, ray.direction.z));
        let length = (left - origin).dot(normal) / direction.dot(normal);
        let depth = -ray.at(length).z;
        return (depth > 0.0 && depth.is_finite()).then_some(depth);
    }
    let place = match tour.background.bands.iter().find(|band| band.name == on) {
        Some(band) => Some(&band.place),
        None if on == "background" => return Some(parameters.background_distance),
        None => None,
    };
    match place? {
        BackgroundPlace::Distance(meters) => Some(*meters),
        BackgroundPlace::Infinity => Some(1e7),
        BackgroundPlace::Contact(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::tests::{pond, solved_pond};

    #[test]
    fn a_pair_made_by_the_camera_has_no_residual_and_a_shifted_one_has_its_shift() {
        let (tour, solution, size) = (pond(), solved_pond(), glam::UVec2::new(1000, 600));
        let camera = solution.parameters.camera(size);
        let top = DVec3::new(3.0, 4.0, -solution.parameters.background_distance);
        let point = camera.project(top).unwrap();
        let reflection = camera.project(DVec3::new(top.x, -top.y, top.z)).unwrap();
        for (on, shift, left) in [
            (Some("background"), DVec2::ZERO, DVec2::ZERO),
            (Some("background"), DVec2::new(2.0, 5.0), DVec2::new(2.0, 5.0)),
            (None, DVec2::new(0.0, 9.0), DVec2::ZERO),
        ] {
            let reflection = PicturePoint(reflection.0 + shift);
            let pair = ReflectionPair { point, reflection, on: on.map(str::to_owned), name: None };
            let expected = expected_reflection(&pair, &tour, &solution, &camera).unwrap();
            let residual = reflection.0 - expected.0;
            assert!(residual.distance(left) < 0.2, "{residual} instead of {left} for {on:?}");
        }
    }
}
