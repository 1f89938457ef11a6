//! Where the tour's plants stand: root and tip in meters of their wall.

use crate::picture::PicturePoint;
use crate::scene::TourScene;
use crate::scene::Wall;
use crate::scene::margin_px;
use crate::tour::Object;
use crate::tour::Region;
use crate::tour::Sway;
use crate::tour::Wind;
use crate::wind::Plant;
use crate::wind::Stand;
use crate::wind::seed_of_name;

use glam::DVec2;

/// The plant that an object is; the error says in words why it cannot sway.
pub(super) fn plant(
    object: &Object,
    sway: &Sway,
    wind: &Wind,
    scene: &TourScene,
    wall: &Wall,
) -> Result<Plant, String> {
    let nowhere = || "its root or tip lies behind the camera or beside its wall; mark both on it".to_owned();
    let stand = stand(object, sway, scene, wall).ok_or_else(nowhere)?;
    let seed = seed_of_name(&object.name, wind.seed);
    Plant::new(stand, sway, wind, seed).map_err(|error| error.to_string())
}

/// Root and tip on the wall's plane; `None` where their rays do not meet it.
///
/// A root left out is the middle of the contact line, a tip left out the outline's top above the root. Of an outline that
/// is a mask, the top is that of the wall's rectangle less its margin.
fn stand(object: &Object, sway: &Sway, scene: &TourScene, wall: &Wall) -> Option<Stand> {
    let on_wall = |point: PicturePoint| {
        let ray = scene.camera.ray(point);
        let point = ray.at(wall.meet_plane(ray)?);
        Some(DVec2::new(wall.along_of(point), point.y))
    };
    let [left, right] = object.contact;
    let foot = sway.root.unwrap_or(PicturePoint(0.5 * (left.0 + right.0)));
    let root = on_wall(foot)?;
    let tip = match (sway.tip, &object.outline) {
        (Some(tip), _) => tip,
        (None, Region::Polygon(corners)) => {
            let top = corners.iter().map(|corner| corner.y()).fold(f64::INFINITY, f64::min);
            PicturePoint::new(foot.x(), top)
        }
        (None, Region::Mask(_)) => {
            let edge = scene.camera.project(wall.point(root.x, wall.rise[1]))?;
            let margin = f64::from(margin_px(scene.camera.intrinsics.size));
            PicturePoint::new(foot.x(), edge.y() + margin)
        }
    };
    let place = wall.foot + root.x * wall.along;
    Some(Stand { root, tip: on_wall(tip)?, place, along: wall.along })
}
