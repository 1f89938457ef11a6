//! Lines and polygons of the picture.

use glam::DVec2;

use crate::picture::PicturePoint;

/// The horizon as a line with a side: below is where water and ground can be.
#[derive(Clone, Copy, Debug)]
pub(super) struct HorizonLine {
    point: DVec2,
    /// Of unit length, pointing down in the picture.
    down: DVec2,
}

impl HorizonLine {
    /// The line through two points; `None` when they are not finite or the line is so steep that up and down are
    /// unclear (within about 11° of the vertical).
    pub(super) fn through([a, b]: [PicturePoint; 2]) -> Option<Self> {
        let along = (b.0 - a.0) * (b.0.x - a.0.x).signum();
        let clear = along.is_finite() && along.x.abs() > 0.2 * along.y.abs() && along.length() > 1e-6;
        clear.then(|| Self { point: a.0, down: along.perp().normalize() })
    }

    /// How far a point lies below the horizon, in pixels; above 0 below it.
    pub(super) fn below(self, point: PicturePoint) -> f64 {
        (point.0 - self.point).dot(self.down)
    }
}

/// Whether a point is inside a polygon, by the even-odd rule.
pub(crate) fn contains(corners: &[PicturePoint], point: PicturePoint) -> bool {
    let p = point.0;
    edges(corners)
        .filter(|(a, b)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
        .count()
        % 2
        == 1
}

/// The area inside a polygon, in square pixels.
pub(super) fn area(corners: &[PicturePoint]) -> f64 {
    // Relative to a corner, so that a small polygon far from the origin keeps its digits.
    let origin = corners.first().map_or(DVec2::ZERO, |corner| corner.0);
    edges(corners).map(|(a, b)| (a - origin).perp_dot(b - origin)).sum::<f64>().abs() / 2.0
}

/// The indices of two sides that cross, each named by its first corner, the lower one first. Sides that share a corner do
/// not.
pub(crate) fn crossing(corners: &[PicturePoint]) -> Option<(usize, usize)> {
    let sides: Vec<_> = edges(corners).collect();
    // Sides in the order of their left ends: only those that overlap along x are compared.
    let left = |i: usize| sides[i].0.x.min(sides[i].1.x);
    let mut order: Vec<usize> = (0..sides.len()).collect();
    order.sort_by(|a, b| left(*a).total_cmp(&left(*b)));
    order.iter().enumerate().find_map(|(rank, &i)| {
        let right = sides[i].0.x.max(sides[i].1.x);
        let mut beside = order[rank + 1..].iter().take_while(|j| left(**j) <= right);
        beside.find(|j| cross(sides[i], sides[**j])).map(|&j| (i.min(j), i.max(j)))
    })
}

fn cross((a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2)) -> bool {
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

fn edges(corners: &[PicturePoint]) -> impl Iterator<Item = (DVec2, DVec2)> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| (a.0, b.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(corners: &[(f64, f64)]) -> Vec<PicturePoint> {
        corners.iter().map(|&(x, y)| PicturePoint::new(x, y)).collect()
    }

    #[test]
    fn a_square_is_simple_and_a_bow_tie_is_not() {
        let square = polygon(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
        assert_eq!((area(&square), crossing(&square)), (4.0, None));
        assert!(
            contains(&square, PicturePoint::new(1.9, 0.1)) && !contains(&square, PicturePoint::new(2.1, 0.1))
        );
        let tie = polygon(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]);
        assert_eq!(crossing(&tie), Some((0, 2)));
    }

    #[test]
    fn the_sweep_finds_a_crossing_where_comparing_all_sides_does() {
        let mut state = 1_u64;
        let mut number = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from((state >> 59) as u32)
        };
        let mut crossed = 0;
        for _ in 0..500 {
            let corners: Vec<_> = (0..6).map(|_| PicturePoint::new(number(), number())).collect();
            let sides: Vec<_> = edges(&corners).collect();
            let any = (0..6).any(|i| (i + 1..6).any(|j| cross(sides[i], sides[j])));
            let found = crossing(&corners);
            assert_eq!(found.is_some(), any, "{corners:?}");
            assert!(
                found.is_none_or(|(i, j)| i < j && cross(sides[i], sides[j])),
                "{found:?} of {corners:?}"
            );
            crossed += usize::from(any);
        }
        assert!((100..450).contains(&crossed), "{crossed} of 500 cross, so the test shows little");
    }

    #[test]
    fn below_is_down_whichever_end_comes_first() {
        let (a, b) = (PicturePoint::new(0.0, 10.0), PicturePoint::new(100.0, 20.0));
        for ends in [[a, b], [b, a]] {
            assert!(HorizonLine::through(ends).unwrap().below(PicturePoint::new(50.0, 30.0)) > 0.0);
        }
        assert!(HorizonLine::through([a, PicturePoint::new(1.0, 90.0)]).is_none());
        assert!(HorizonLine::through([a, a]).is_none());
    }
}
