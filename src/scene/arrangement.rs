//! Where the components are for one eye, and in which order they hide each other.
//!
//! A wall that moved is met where it is now, and its maps are read for the point of the resting wall that came there
//! (architecture.md, decision 1). For the camera that took the picture everything rests.

use glam::{DQuat, DVec2, DVec3};

use super::{Role, Surface, TourScene, Wall, near_to_far};
use crate::camera::Ray;

/// A wall turns at most this far, radians: turned more, its flat mask shows too much of what a body hides.
const MOST_TURN: f64 = std::f64::consts::PI / 6.0;

/// A point of a resting component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestPoint(pub DVec3);

/// Where a wall is now: the point `s` along and `y` high lies at `origin + s·along + y·up`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Where the wall's `foot` is, meters.
    pub origin: DVec3,
    /// Unit vector along the contact line.
    pub along: DVec3,
    /// Unit vector up the wall, at right angles to `along`.
    pub up: DVec3,
}

/// Where a ray meets a component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// The ray's parameter; infinite for what is infinitely far.
    pub t: f64,
    /// Where that is.
    pub point: DVec3,
    /// The point of the resting component that is there.
    pub rest: RestPoint,
}

/// All components as one eye finds them.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrangement {
    /// Walls that do not rest; `None` for the others.
    pub placements: Vec<Option<Placement>>,
    /// All components in the order of drawing.
    pub near_to_far: Vec<usize>,
}

impl Wall {
    /// Where the wall is when nothing moves.
    #[must_use]
    pub fn resting(&self) -> Placement {
        Placement { origin: self.point(0.0, 0.0), along: along3(self.along), up: DVec3::Y }
    }

    /// The angle about the vertical through its `foot` by which the wall is seen from elsewhere than from `picture`, radians to
    /// the left, at most 30° (notes §9.3).
    fn turn(&self, eye: DVec3, picture: DVec3) -> f64 {
        let bearing = |from: DVec3| {
            let to = self.foot - DVec2::new(from.x, from.z);
            to.x.atan2(-to.y)
        };
        let mut turn = bearing(picture) - bearing(eye);
        turn -= std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
        MOST_TURN * (turn / MOST_TURN).tanh()
    }
}

fn along3(along: DVec2) -> DVec3 {
    DVec3::new(along.x, 0.0, along.y)
}

impl Placement {
    /// This turned about the vertical through its origin, radians to the left.
    fn turned(&self, turn: f64) -> Self {
        let turn = DQuat::from_rotation_y(turn);
        Self { origin: self.origin, along: turn * self.along, up: turn * self.up }
    }

    /// The resting wall moved to where this one's contact line is; as far as the order of walls goes.
    fn contact(&self, wall: &Wall) -> Wall {
        let along = DVec2::new(self.along.x, self.along.z).normalize_or(wall.along);
        Wall { foot: DVec2::new(self.origin.x, self.origin.z), along, ..*wall }
    }

    /// Where a ray meets the wall that is here, inside its rectangle.
    #[must_use]
    pub fn meet(&self, wall: &Wall, ray: Ray) -> Option<Meeting> {
        let normal = self.along.cross(self.up);
        let t = normal.dot(self.origin - ray.origin) / normal.dot(ray.direction);
        if !(t.is_finite() && t > 0.0) {
            return None;
        }
        let point = ray.at(t);
        let from = point - self.origin;
        let rest = wall.point(from.dot(self.along), from.dot(self.up));
        wall.contains(rest).then_some(Meeting { t, point, rest: RestPoint(rest) })
    }
}

impl Arrangement {
    /// Where a ray meets a component of the scene that is arranged so.
    #[must_use]
    pub fn meet(&self, scene: &TourScene, index: usize, ray: Ray) -> Option<Meeting> {
        let surface = &scene.components[index].surface;
        match (surface, &self.placements[index]) {
            (Surface::Wall(wall), Some(placement)) => placement.meet(wall, ray),
            _ => surface.meet(ray).map(|t| {
                let point = ray.at(t);
                Meeting { t, point, rest: RestPoint(point) }
            }),
        }
    }
}

impl TourScene {
    /// The scene as seen from `eye`: what turns to the camera is turned. `moved` says where walls are that do not rest, by
    /// component; it may be shorter.
    ///
    /// The ground ends where the first band stands, so it comes just before that; the last layer is last.
    #[must_use]
    pub fn arranged_for(&self, eye: DVec3, moved: &[Option<Placement>]) -> Arrangement {
        let mut placements = vec![None; self.components.len()];
        let mut walls = Vec::with_capacity(self.components.len());
        for (index, component) in self.components.iter().enumerate() {
            let (Role::Billboard | Role::Band, Surface::Wall(wall)) = (component.role, &component.surface)
            else {
                continue;
            };
            let mut placement = moved.get(index).copied().flatten();
            if component.turns_to_camera {
                let turn = wall.turn(eye, self.camera.pose.position);
                placement = Some(placement.unwrap_or(wall.resting()).turned(turn));
            }
            walls.push((index, placement.map_or(*wall, |placement| placement.contact(wall))));
            placements[index] = placement;
        }
        let mut order = near_to_far(&walls, DVec2::new(eye.x, eye.z));
        if let Some(ground) = self.ground() {
            let first_band = order.iter().position(|&index| self.components[index].role == Role::Band);
            order.insert(first_band.unwrap_or(order.len()), ground);
        }
        order.push(0);
        Arrangement { placements, near_to_far: order }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall() -> Wall {
        Wall { foot: DVec2::new(1.0, -10.0), along: DVec2::X, span: [-2.0, 2.0], rise: [-0.2, 3.0] }
    }

    #[test]
    fn a_wall_turns_to_who_walks_around_it_and_rests_for_the_picture_s_camera() {
        let picture = DVec3::new(0.0, 1.8, 0.0);
        assert_eq!(wall().turn(picture, picture), 0.0);
        assert_eq!(wall().resting().turned(0.0), wall().resting());
        let turned = wall().resting().turned(wall().turn(DVec3::new(2.0, 1.8, 0.0), picture));
        // Seen from 2 m to the right, a turn of 2 · atan(0.1) = 11.42°, a bit less for the limit at 30°.
        let degrees = turned.along.z.atan2(turned.along.x).to_degrees();
        assert!((degrees + 10.9).abs() < 0.1, "turned by {degrees}°: its right end goes away below 0");
        assert!(wall().turn(DVec3::new(30.0, 1.8, -10.0), picture).abs() <= MOST_TURN);
    }

    #[test]
    fn a_turned_wall_reads_the_points_of_the_resting_one() {
        let turn = wall().turn(DVec3::new(3.0, 1.8, 0.0), DVec3::new(0.0, 1.8, 0.0));
        let turned = wall().resting().turned(turn);
        let aim = turned.origin + 1.5 * turned.along + 2.0 * turned.up;
        let origin = DVec3::new(3.0, 1.8, 0.0);
        let met = turned.meet(&wall(), Ray { origin, direction: aim - origin }).unwrap();
        assert!(met.point.distance(aim) < 1e-12 && (met.t - 1.0).abs() < 1e-12);
        assert!(met.rest.0.distance(wall().point(1.5, 2.0)) < 1e-12, "{:?}", met.rest);
    }
}
