//! Which wall stands in front of which, from a point on the ground.
//!
//! Sorting walls by the distance of their centers fails for walls at an angle; sorting by who hides whom does not. The
//! reflected view has the same ground point as the direct one, so one order serves both.

use glam::DVec2;

use super::Wall;

/// Sorts walls near to far as seen from `eye`, an (x, z) point in meters; returns their indices.
///
/// A wall comes before every wall that it hides. Where walls hide each other in a circle (they cross, or lie in one
/// line), the one whose contact line comes nearest to `eye` goes first.
#[must_use]
pub fn near_to_far(walls: &[(usize, Wall)], eye: DVec2) -> Vec<usize> {
    let mut rest: Vec<&(usize, Wall)> = walls.iter().collect();
    rest.sort_by(|a, b| distance(&a.1, eye).total_cmp(&distance(&b.1, eye)));
    let mut order = Vec::with_capacity(rest.len());
    while !rest.is_empty() {
        let first = (0..rest.len())
            .find(|&i| (0..rest.len()).all(|j| j == i || !hides(&rest[j].1, &rest[i].1, eye)))
            .unwrap_or(0);
        order.push(rest.remove(first).0);
    }
    order
}

/// Whether `front` stands between `eye` and `back`, where their directions from `eye` overlap.
fn hides(front: &Wall, back: &Wall, eye: DVec2) -> bool {
    if !directions_overlap(front, back, eye) {
        return false;
    }
    let side = |wall: &Wall, point: DVec2| wall.normal().dot(point - wall.foot);
    // Walls that touch share end points, so a point almost on the line counts for neither side.
    let slack = 1e-6 * (1.0 + front.foot.distance(eye));
    let eye_of_front = side(front, eye);
    let back_is_beyond = back.ends().iter().all(|&end| side(front, end) * eye_of_front.signum() <= slack);
    let eye_of_back = side(back, eye);
    let front_is_before = front.ends().iter().all(|&end| side(back, end) * eye_of_back.signum() >= -slack);
    back_is_beyond || front_is_before
}

/// Whether some direction from `eye` meets both contact lines.
fn directions_overlap(a: &Wall, b: &Wall, eye: DVec2) -> bool {
    let [a, b] = [a, b].map(|wall| {
        let [left, right] = wall.ends().map(|end| end - eye);
        // Angles relative to −z, unwrapped so that the wall covers less than half a turn.
        let left = left.x.atan2(-left.y);
        let mut right = right.x.atan2(-right.y);
        if right - left > std::f64::consts::PI {
            right -= std::f64::consts::TAU;
        } else if left - right > std::f64::consts::PI {
            right += std::f64::consts::TAU;
        }
        [left.min(right), left.max(right)]
    });
    [-std::f64::consts::TAU, 0.0, std::f64::consts::TAU]
        .iter()
        .any(|turn| a[0] + turn < b[1] && b[0] < a[1] + turn)
}

/// Distance from `eye` to the nearest point of the contact line, meters.
fn distance(wall: &Wall, eye: DVec2) -> f64 {
    let s = (eye - wall.foot).dot(wall.along).clamp(wall.span[0], wall.span[1]);
    (wall.foot + s * wall.along).distance(eye)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall(from: DVec2, to: DVec2) -> Wall {
        let along = (to - from).normalize();
        Wall { foot: from, along, span: [0.0, from.distance(to)], rise: [0.0, 3.0] }
    }

    #[test]
    fn a_receding_wall_and_what_stands_before_it_sort_by_who_hides_whom() {
        // The quay runs from 5 m to 60 m; the boat at 20 m lies on the open side, its center farther than the quay's
        // near end, the house at 30 m stands behind the quay's line.
        let quay = wall(DVec2::new(4.0, -5.0), DVec2::new(20.0, -60.0));
        let boat = wall(DVec2::new(4.0, -20.0), DVec2::new(7.0, -20.0));
        let house = wall(DVec2::new(14.0, -30.0), DVec2::new(22.0, -30.0));
        let walls = [(0, quay), (1, boat), (2, house)];
        assert_eq!(near_to_far(&walls, DVec2::ZERO), [1, 0, 2]);
        let shuffled = [(2, house), (0, quay), (1, boat)];
        assert_eq!(near_to_far(&shuffled, DVec2::ZERO), [1, 0, 2]);
    }

    #[test]
    fn frontal_walls_sort_by_depth_and_crossing_ones_end() {
        let near = wall(DVec2::new(-1.0, -5.0), DVec2::new(1.0, -5.0));
        let far = wall(DVec2::new(-2.0, -9.0), DVec2::new(2.0, -9.0));
        assert_eq!(near_to_far(&[(0, far), (1, near)], DVec2::ZERO), [1, 0]);
        let a = wall(DVec2::new(-1.0, -5.0), DVec2::new(1.0, -7.0));
        let b = wall(DVec2::new(-1.0, -7.0), DVec2::new(1.0, -5.0));
        assert_eq!(near_to_far(&[(0, a), (1, b)], DVec2::ZERO).len(), 2);
    }
}
