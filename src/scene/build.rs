//! From what was solved and marked to planes in meters.
//!
//! Every component gets a place, whatever was marked: what cannot be placed (a foot at the horizon) goes to just in
//! front of the background, with a remark.

use glam::{DVec2, DVec3, IVec2, UVec2};
use serde::{Deserialize, Serialize};

use super::backdrop::{self, BackdropPlan};
use super::{CameraBounds, Level, Role, SceneComponent, Surface, TourScene, Wall};
use crate::camera::PinholeCamera;
use crate::camera::Ray;
use crate::picture::PicturePoint;
use crate::tour::Support;

/// The most components a tour may have: what one row of the water's records holds.
pub const MAX_COMPONENTS: usize = 64;

/// Contact lines whose ends differ less than this in depth stand frontally (notes §5.2): marks are not finer.
const FRONTAL_WITHIN: f64 = 0.05;

/// How far inside the background's distance a component is kept, as a share of it.
const BEFORE_BACKGROUND: f64 = 0.98;

/// Margin of a billboard's rectangle around its mask's box, per pixel of picture width.
const MARGIN: f64 = 0.035;

/// By how many pixels a billboard's rectangle is wider than its mask's box: room for its mirror image, which is that of
/// a body and not of a flat mask.
#[must_use]
pub fn margin_px(picture: UVec2) -> i32 {
    (MARGIN * f64::from(picture.x)).ceil() as i32
}

/// Where no backdrop is at a finite distance, things stand at most this far, meters.
const FARTHEST: f64 = 1e4;

/// A billboard to be placed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BillboardPlan {
    /// Its name in the tour file.
    pub name: String,
    /// What its contact line lies on.
    pub support: Support,
    /// Left and right foot in the picture.
    pub contact: [PicturePoint; 2],
    /// Whether it turns towards a camera that moves around it.
    pub turns_to_camera: bool,
    /// The mask's box in pixels, low corner and high corner (exclusive).
    pub mask_box: [IVec2; 2],
}

/// Everything [`build`] needs to know.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScenePlan {
    /// The camera that took the picture, at (0, h, 0).
    pub camera: PinholeCamera,
    /// Whether there is water at y = 0.
    pub water: bool,
    /// Height of the ground above the water, meters, if there is ground.
    pub ground_height: Option<f64>,
    /// What closes the scene, in the tour's order; the farthest becomes the last layer. Without any, the last layer is
    /// at infinity.
    pub backdrops: Vec<BackdropPlan>,
    /// What stands in the scene, at most [`MAX_COMPONENTS`] with backdrops and ground.
    pub billboards: Vec<BillboardPlan>,
}

/// Places every plane; the remarks say what had to be moved.
#[must_use]
pub fn build(plan: &ScenePlan) -> (TourScene, Vec<String>) {
    let mut remarks = Vec::new();
    let backdrops = backdrop::place_all(&plan.camera, &plan.backdrops, &mut remarks);
    let component = |name: &str, role, surface| SceneComponent {
        name: name.to_owned(),
        role,
        surface,
        turns_to_camera: false,
    };
    let last = &backdrops[0];
    let nearest = backdrops.iter().map(|placed| placed.distance).fold(f64::INFINITY, f64::min);
    let mut components = vec![component(&last.name, Role::LastLayer, last.surface)];
    if let Some(height) = plan.ground_height {
        let level = Surface::Level(ground_level(&plan.camera, height, nearest));
        components.push(component("ground", Role::Ground, level));
    }
    for band in backdrops.iter().skip(1).take(MAX_COMPONENTS - 2) {
        components.push(component(&band.name, Role::Band, band.surface));
    }
    let distance = last.distance;
    for billboard in &plan.billboards {
        if components.len() == MAX_COMPONENTS {
            remarks.push(format!(
                "\"{}\" and what follows is left out: a scene holds at most {MAX_COMPONENTS} planes",
                billboard.name
            ));
            break;
        }
        let height = match billboard.support {
            Support::Water => 0.0,
            Support::Ground => plan.ground_height.unwrap_or(0.0),
        };
        let wall = billboard_wall(&plan.camera, billboard, height, [nearest, distance], &mut remarks);
        components.push(SceneComponent {
            turns_to_camera: billboard.turns_to_camera,
            ..component(&billboard.name, Role::Billboard, Surface::Wall(wall))
        });
    }
    let bounds = CameraBounds::of(&plan.camera, plan.ground_height, &components);
    (TourScene { camera: plan.camera, water: plan.water, components, bounds }, remarks)
}

/// The ground from the picture's foreground to the background.
fn ground_level(camera: &PinholeCamera, height: f64, background_distance: f64) -> Level {
    let far = if background_distance.is_finite() { background_distance } else { FARTHEST };
    let size = camera.intrinsics.size.as_dvec2();
    // The lowest ray of the picture says where the ground comes into sight; it is kept from there a bit nearer.
    let nearest = [0.0, size.x]
        .into_iter()
        .filter_map(|x| Some(-camera.on_level(PicturePoint::new(x, size.y), height)?.z))
        .fold(far, f64::min);
    let reach = far * size.x / camera.intrinsics.focal_px;
    Level { height, low: DVec2::new(-reach, -far), high: DVec2::new(reach, -0.25 * nearest) }
}

/// The upright rectangle through a contact line that covers the mask's whole box (architecture.md, decision 6).
fn billboard_wall(
    camera: &PinholeCamera,
    plan: &BillboardPlan,
    height: f64,
    backdrops: [f64; 2],
    remarks: &mut Vec<String>,
) -> Wall {
    // What has a place stands before the farthest backdrop; what has none, before the nearest.
    let [fallback, farthest] =
        backdrops.map(|distance| if distance.is_finite() { BEFORE_BACKGROUND * distance } else { FARTHEST });
    let feet = plan.contact.map(|foot| {
        let ray = camera.ray(foot);
        let t = (height - ray.origin.y) / ray.direction.y;
        let depth = -(ray.at(t).z - camera.pose.position.z);
        let placed = if t.is_finite() && t > 0.0 && depth > 0.0 && depth <= farthest {
            t
        } else {
            remarks.push(format!(
                "\"{}\" would stand at or beyond the background: its foot {foot} is moved to {fallback:.1} m; \
                 lower its contact line or mark the background farther away",
                plan.name
            ));
            fallback / (-ray.direction.z).max(1e-3)
        };
        let point = ray.at(placed);
        DVec2::new(point.x, point.z)
    });
    let [left, right] = feet;
    let mean = 0.5 * (left.y + right.y);
    let yawed = ((left.y - right.y) / mean).abs() > FRONTAL_WITHIN && left.distance(right) > 1e-6;
    let foot = DVec2::new(0.5 * (left.x + right.x), mean);
    let along = if yawed { (right - left).normalize() } else { DVec2::X };
    let unbounded = [f64::NEG_INFINITY, f64::INFINITY];
    let plane = Wall { foot, along, span: unbounded, rise: unbounded };
    let [low, high] = [plan.mask_box[0].as_dvec2(), plan.mask_box[1].as_dvec2()];
    let mut span = [f64::INFINITY, f64::NEG_INFINITY];
    let mut rise = span;
    let margin = f64::from(margin_px(camera.intrinsics.size));
    for x in [low.x - margin, high.x + margin] {
        for y in [low.y - margin, high.y + margin] {
            if let Some(point) = meet_within(&plane, camera.ray(PicturePoint::new(x, y)), farthest) {
                let s = plane.along_of(point);
                span = [span[0].min(s), span[1].max(s)];
                rise = [rise[0].min(point.y), rise[1].max(point.y)];
            }
        }
    }
    if plan.support == Support::Water {
        // What returns on a course shows its mirrored copy in the same rectangle.
        let reach = span[1].max(-span[0]);
        span = [-reach, reach];
    }
    Wall { foot, along, span, rise }
}

/// Where a ray meets a wall's plane; past `farthest` (or never) the ray's point at that depth is brought to the plane,
/// which only happens to walls that recede to their own vanishing point.
fn meet_within(plane: &Wall, ray: Ray, farthest: f64) -> Option<DVec3> {
    let limit = 2.0 * farthest / (-ray.direction.z).max(1e-3);
    let t = plane.meet_plane(ray).unwrap_or(limit).min(limit);
    let point = ray.at(t);
    point.is_finite().then(|| plane.point(plane.along_of(point), point.y))
}

#[cfg(test)]
mod tests {
    use super::super::BackdropPlace;
    use super::*;
    use crate::camera::{CameraPose, Intrinsics};

    fn camera() -> PinholeCamera {
        PinholeCamera {
            intrinsics: Intrinsics {
                focal_px: 800.0,
                principal: PicturePoint::new(480.0, 270.0),
                size: UVec2::new(960, 540),
            },
            pose: CameraPose::from_angles(DVec3::new(0.0, 2.0, 0.0), 0.0, 0.0, 0.0),
        }
    }

    fn plan(contact: [PicturePoint; 2]) -> ScenePlan {
        ScenePlan {
            camera: camera(),
            water: true,
            ground_height: Some(0.5),
            backdrops: vec![BackdropPlan {
                name: "background".into(),
                place: BackdropPlace::Distance(120.0),
            }],
            billboards: vec![BillboardPlan {
                name: "boat".into(),
                support: Support::Water,
                contact,
                turns_to_camera: false,
                mask_box: [IVec2::new(320, 290), IVec2::new(560, 410)],
            }],
        }
    }

    #[test]
    fn a_foot_on_the_water_is_where_its_ray_meets_the_water() {
        let (scene, remarks) =
            build(&plan([PicturePoint::new(320.0, 403.333_333), PicturePoint::new(560.0, 403.333_333)]));
        assert!(remarks.is_empty(), "{remarks:?}");
        let Surface::Wall(wall) = scene.components[2].surface else { panic!("a billboard is a wall") };
        assert!((wall.foot.y + 12.0).abs() < 1e-4, "boat at {} m instead of 12", -wall.foot.y);
        // The box's bottom row lies 6.7 px under the contact line and has 34 px of margin; at 12 m and 800 px: 0.6 m.
        assert!((wall.rise[0] + 40.667 * 12.0 / 800.0).abs() < 0.001, "bottom at {} m", wall.rise[0]);
        assert!((wall.span[1] - wall.span[0] - 308.0 * 12.0 / 800.0).abs() < 1e-6, "{:?}", wall.span);
    }

    #[test]
    fn a_foot_above_the_horizon_goes_before_the_background_and_says_so() {
        let (scene, remarks) =
            build(&plan([PicturePoint::new(320.0, 250.0), PicturePoint::new(560.0, 250.0)]));
        let Surface::Wall(wall) = scene.components[2].surface else { panic!("a billboard is a wall") };
        assert!((wall.foot.y + 117.6).abs() < 1e-9, "{} m", wall.foot.y);
        assert!(remarks[0].contains("boat"), "{remarks:?}");
    }

    #[test]
    fn feet_at_different_depths_make_a_yawed_wall() {
        let (scene, _) =
            build(&plan([PicturePoint::new(320.0, 403.333_333), PicturePoint::new(560.0, 350.0)]));
        let Surface::Wall(wall) = scene.components[2].surface else { panic!("a billboard is a wall") };
        let ends = [-12.0, -20.0];
        let half = 0.5 * DVec2::new(4.4, 8.0).length() * wall.along;
        let (left, right) = (wall.foot - half, wall.foot + half);
        assert!((left.y - ends[0]).abs() < 1e-4 && (right.y - ends[1]).abs() < 1e-3, "{left} to {right}");
    }
}
