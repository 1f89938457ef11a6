//! The planes that components lie on, and where rays meet them.

use glam::{DVec2, DVec3};

use crate::camera::Ray;

/// A vertical rectangle through a contact line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// The middle of the contact line, or another point of its prolongation, (x, z) in meters.
    pub foot: DVec2,
    /// Unit vector (x, z) along the contact line, from its left to its right end as the picture shows it.
    pub along: DVec2,
    /// Extent along the contact line from `foot`, meters, low to high.
    pub span: [f64; 2],
    /// Extent of height, meters above the resting water, low to high. Below 0 is what hangs under the contact line.
    pub rise: [f64; 2],
}

/// A level rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Meters above the resting water.
    pub height: f64,
    /// Corner with the lowest x and z.
    pub low: DVec2,
    /// Corner with the highest x and z.
    pub high: DVec2,
}

/// Where a component is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// A vertical plane.
    Wall(Wall),
    /// A level plane.
    Level(Level),
    /// So far away that moving shows no parallax: only the direction of a ray counts.
    Infinity,
}

/// A point or direction reflected in the resting water.
#[must_use]
pub fn mirror(point: DVec3) -> DVec3 {
    DVec3::new(point.x, -point.y, point.z)
}

impl Wall {
    /// The wall's unit normal in the (x, z) plane.
    #[must_use]
    pub fn normal(&self) -> DVec2 {
        DVec2::new(-self.along.y, self.along.x)
    }

    /// The two ends of the contact line, (x, z) in meters.
    #[must_use]
    pub fn ends(&self) -> [DVec2; 2] {
        self.span.map(|s| self.foot + s * self.along)
    }

    /// The point `s` meters along and `y` meters high.
    #[must_use]
    pub fn point(&self, s: f64, y: f64) -> DVec3 {
        let ground = self.foot + s * self.along;
        DVec3::new(ground.x, y, ground.y)
    }

    /// How far along the contact line a point of the plane lies, meters from `foot`.
    #[must_use]
    pub fn along_of(&self, point: DVec3) -> f64 {
        (DVec2::new(point.x, point.z) - self.foot).dot(self.along)
    }

    /// Ray parameter at which the (unbounded) plane is met.
    #[must_use]
    pub fn meet_plane(&self, ray: Ray) -> Option<f64> {
        let normal = self.normal();
        let across = normal.dot(DVec2::new(ray.direction.x, ray.direction.z));
        let t = normal.dot(self.foot - DVec2::new(ray.origin.x, ray.origin.z)) / across;
        (t.is_finite() && t > 0.0).then_some(t)
    }

    /// Whether a point of the plane lies in the rectangle.
    #[must_use]
    pub fn contains(&self, point: DVec3) -> bool {
        let s = self.along_of(point);
        s >= self.span[0] && s <= self.span[1] && point.y >= self.rise[0] && point.y <= self.rise[1]
    }
}

impl Level {
    /// Ray parameter at which the (unbounded) plane is met, from either side.
    #[must_use]
    pub fn meet_plane(&self, ray: Ray) -> Option<f64> {
        let t = (self.height - ray.origin.y) / ray.direction.y;
        (t.is_finite() && t > 0.0).then_some(t)
    }

    /// Whether a point of the plane lies in the rectangle.
    #[must_use]
    pub fn contains(&self, point: DVec3) -> bool {
        let ground = DVec2::new(point.x, point.z);
        ground.cmpge(self.low).all() && ground.cmple(self.high).all()
    }
}

impl Surface {
    /// Ray parameter at which the rectangle is met, `None` for a miss; infinity is met at `f64::INFINITY`.
    #[must_use]
    pub fn meet(&self, ray: Ray) -> Option<f64> {
        match self {
            Self::Wall(wall) => wall.meet_plane(ray).filter(|&t| wall.contains(ray.at(t))),
            Self::Level(level) => level.meet_plane(ray).filter(|&t| level.contains(ray.at(t))),
            Self::Infinity => Some(f64::INFINITY),
        }
    }

    /// Ray parameter at which the surface's unbounded plane is met.
    #[must_use]
    pub fn meet_plane(&self, ray: Ray) -> Option<f64> {
        match self {
            Self::Wall(wall) => wall.meet_plane(ray),
            Self::Level(level) => level.meet_plane(ray),
            Self::Infinity => Some(f64::INFINITY),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_yawed_wall_is_met_where_its_line_is() {
        let along = DVec2::new(1.0, -1.0).normalize();
        let wall = Wall { foot: DVec2::new(2.0, -10.0), along, span: [-5.0, 5.0], rise: [-1.0, 4.0] };
        let ray = Ray { origin: DVec3::new(0.0, 1.8, 0.0), direction: DVec3::new(0.2, -0.05, -1.0) };
        let hit = ray.at(Surface::Wall(wall).meet(ray).unwrap());
        let back = wall.point(wall.along_of(hit), hit.y);
        assert!(hit.distance(back) < 1e-12, "{hit} is not on the wall ({back})");
        assert!((hit.x - 2.0 + hit.z + 10.0).abs() < 1e-12, "{hit} is off the line");
    }

    #[test]
    fn what_lies_behind_a_ray_is_not_met() {
        let wall = Wall { foot: DVec2::new(0.0, 5.0), along: DVec2::X, span: [-9.0, 9.0], rise: [-9.0, 9.0] };
        let ray = Ray { origin: DVec3::ZERO, direction: DVec3::NEG_Z };
        assert_eq!(Surface::Wall(wall).meet(ray), None);
        let water = Level { height: 0.0, low: DVec2::splat(-9.0), high: DVec2::splat(9.0) };
        assert_eq!(Surface::Level(water).meet(ray), None, "a level ray along the plane meets nothing");
    }
}
