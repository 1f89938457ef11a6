//! What closes the scene: upright planes across the whole view, a far shore before mountains before the sky.
//!
//! However they are marked, every one gets a place; they come out far to near, the last layer first.

use glam::{DMat2, DVec2};
use serde::{Deserialize, Serialize};

use super::{Surface, Wall};
use crate::camera::PinholeCamera;
use crate::picture::PicturePoint;

/// Frontal walls reach this many of their distances to each side and up: past any sensible view.
const REACH: f64 = 60.0;

/// A receding contact line is prolonged by this many of its lengths to each side.
const PROLONGED: f64 = 0.5;

/// Contact lines whose depth changes less than this over their length stand frontally: far shores wind, and are marked
/// where the horizon is near.
const FRONTAL_WITHIN: f64 = 0.2;

/// Backdrops are kept between these distances, meters.
const DISTANCES: [f64; 2] = [0.1, 1e5];

/// Where a backdrop stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum BackdropPlace {
    /// This far along −z, meters.
    Distance(f64),
    /// Through these picture points of the water, left to right; their depths may differ.
    Contact(Vec<PicturePoint>),
    /// So far that moving shows no parallax.
    Infinity,
}

/// A backdrop to be placed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BackdropPlan {
    /// Its name in the tour file.
    pub name: String,
    /// Where it stands.
    pub place: BackdropPlace,
}

/// A backdrop with its plane.
pub(super) struct PlacedBackdrop {
    pub name: String,
    pub surface: Surface,
    /// Along −z at the middle of the view, meters.
    pub distance: f64,
}

/// Places all backdrops, far to near; at least one, at infinity if there is none.
pub(super) fn place_all(
    camera: &PinholeCamera,
    plans: &[BackdropPlan],
    remarks: &mut Vec<String>,
) -> Vec<PlacedBackdrop> {
    let mut placed: Vec<PlacedBackdrop> = plans
        .iter()
        .map(|plan| {
            let surface = match &plan.place {
                BackdropPlace::Distance(distance) if distance.is_finite() => Surface::Wall(frontal(*distance)),
                BackdropPlace::Distance(_) | BackdropPlace::Infinity => Surface::Infinity,
                BackdropPlace::Contact(points) => match contact_wall(camera, points) {
                    Some(wall) => Surface::Wall(wall),
                    None => {
                        remarks.push(format!(
                            "\"{}\" meets the water at or above the horizon, so it is set at infinity; lower its \
                             contact line",
                            plan.name
                        ));
                        Surface::Infinity
                    }
                },
            };
            let distance = match surface {
                Surface::Wall(wall) => -(wall.foot + wall.along * 0.5 * (wall.span[0] + wall.span[1])).y,
                Surface::Level(_) | Surface::Infinity => f64::INFINITY,
            };
            PlacedBackdrop { name: plan.name.clone(), surface, distance }
        })
        .collect();
    placed.sort_by(|a, b| b.distance.total_cmp(&a.distance));
    // One layer at infinity is the last; another stands as far before it as can be.
    for other in placed.iter_mut().skip(1).filter(|other| other.surface == Surface::Infinity) {
        other.surface = Surface::Wall(frontal(f64::INFINITY));
    }
    // Rays that miss everything meet the last layer, so it cannot end.
    if let Some(last) = placed.first_mut()
        && let Surface::Wall(wall) = last.surface
        && wall.along != DVec2::X
    {
        last.surface = Surface::Wall(frontal(last.distance));
        remarks.push(format!(
            "\"{}\" is the farthest thing, so it stands frontally though its contact line recedes; mark a sky or \
             mountains behind it",
            last.name
        ));
    }
    if placed.is_empty() {
        let (name, surface) = ("background".to_owned(), Surface::Infinity);
        placed.push(PlacedBackdrop { name, surface, distance: f64::INFINITY });
    }
    placed
}

fn frontal(distance: f64) -> Wall {
    let distance = distance.clamp(DISTANCES[0], DISTANCES[1]);
    let reach = [-REACH * distance, REACH * distance];
    Wall { foot: DVec2::new(0.0, -distance), along: DVec2::X, span: reach, rise: reach }
}

/// The wall through a contact line on the water: frontal at its median depth, or along the line when that recedes.
fn contact_wall(camera: &PinholeCamera, points: &[PicturePoint]) -> Option<Wall> {
    let feet: Vec<DVec2> = points
        .iter()
        .filter_map(|&point| camera.on_level(point, 0.0))
        .filter(|foot| -foot.z < DISTANCES[1])
        .map(|foot| DVec2::new(foot.x, foot.z))
        .collect();
    let mut depths: Vec<f64> = feet.iter().map(|foot| -foot.y).collect();
    depths.sort_by(f64::total_cmp);
    let depth = *depths.get(depths.len() / 2)?;
    // The direction in which the feet are spread most.
    let mean = feet.iter().sum::<DVec2>() / feet.len() as f64;
    let spread = feet.iter().fold(DMat2::ZERO, |sum, &foot| {
        let off = foot - mean;
        sum + DMat2::from_cols(off * off.x, off * off.y)
    });
    let angle = 0.5 * (2.0 * spread.x_axis.y).atan2(spread.x_axis.x - spread.y_axis.y);
    let along = DVec2::new(angle.cos(), angle.sin());
    let along = if along.x < 0.0 { -along } else { along };
    let [left, right] = feet
        .iter()
        .map(|&foot| (foot - mean).dot(along))
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], s| [low.min(s), high.max(s)]);
    let length = right - left;
    let recedes = (length * along.y).abs() > FRONTAL_WITHIN * depth;
    if !recedes {
        return Some(frontal(depth));
    }
    let reach = REACH * depth.max(length);
    Some(Wall {
        foot: mean,
        along,
        span: [left - PROLONGED * length, right + PROLONGED * length],
        rise: [-reach, reach],
    })
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, UVec2};

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

    fn plan(name: &str, place: BackdropPlace) -> BackdropPlan {
        BackdropPlan { name: name.to_owned(), place }
    }

    /// The picture point at which the water is seen at (x, z).
    fn on_water(x: f64, z: f64) -> PicturePoint {
        camera().project(DVec3::new(x, 0.0, z)).expect("it lies ahead")
    }

    #[test]
    fn backdrops_come_far_to_near_with_the_sky_last_of_all() {
        let mut remarks = Vec::new();
        let shore = BackdropPlace::Contact(vec![on_water(-50.0, -90.0), on_water(40.0, -92.0)]);
        let plans = [
            plan("shore", shore),
            plan("sky", BackdropPlace::Infinity),
            plan("mountains", BackdropPlace::Distance(1000.0)),
        ];
        let placed = place_all(&camera(), &plans, &mut remarks);
        let names: Vec<&str> = placed.iter().map(|placed| placed.name.as_str()).collect();
        assert_eq!(names, ["sky", "mountains", "shore"]);
        assert!((placed[2].distance - 92.0).abs() < 1e-6, "shore at {} m", placed[2].distance);
        assert!(remarks.is_empty(), "{remarks:?}");
    }

    #[test]
    fn a_quay_that_recedes_stands_along_its_own_line() {
        let [near, far] = [DVec2::new(-10.0, -20.0), DVec2::new(5.0, -80.0)];
        let points = [0.0, 0.4, 1.0].map(|t| near.lerp(far, t)).map(|at| on_water(at.x, at.y));
        let wall = contact_wall(&camera(), &points).expect("it lies below the horizon");
        for end in [near, far] {
            let off = wall.normal().dot(end - wall.foot).abs();
            assert!(off < 1e-6, "the line's end is {off} m off the wall");
        }
        assert!(wall.along.x > 0.0, "from left to right, not along {}", wall.along);
        assert!(
            [near, far].iter().all(|&end| wall.contains(DVec3::new(end.x, 1.0, end.y))),
            "{:?}",
            wall.span
        );
        // A line straight away from the viewer has no left end that could be told by x.
        let away = [(5.0, -80.0), (5.05, -20.0), (5.1, -50.0)].map(|(x, z)| on_water(x, z));
        let wall = contact_wall(&camera(), &away).expect("it lies below the horizon");
        assert!(wall.span[1] - wall.span[0] > 60.0, "{:?}", wall.span);
    }

    #[test]
    fn contact_lines_in_the_sky_go_to_infinity_and_say_so() {
        let mut remarks = Vec::new();
        let sky = [PicturePoint::new(0.0, 100.0), PicturePoint::new(900.0, 100.0)];
        let plans =
            [plan("hill", BackdropPlace::Contact(sky.to_vec())), plan("sky", BackdropPlace::Infinity)];
        let placed = place_all(&camera(), &plans, &mut remarks);
        assert!(placed[0].surface == Surface::Infinity && placed[1].surface == Surface::Wall(frontal(1e5)));
        assert_eq!(remarks.len(), 1, "{remarks:?}");
        assert_eq!(place_all(&camera(), &[], &mut remarks)[0].surface, Surface::Infinity);
    }
}
