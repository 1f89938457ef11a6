//! Snapping: a point that is dragged near a candidate goes to it.

use crate::picture::PicturePoint;

/// The candidate nearest to a point, if one is within `radius` picture pixels; of equally near ones the first.
///
/// Candidates that are not finite are passed over; a radius that is not above 0 (or no number) takes none.
#[must_use]
pub fn snap(
    at: PicturePoint,
    candidates: impl IntoIterator<Item = PicturePoint>,
    radius: f64,
) -> Option<PicturePoint> {
    candidates
        .into_iter()
        .map(|candidate| (candidate.0.distance(at.0), candidate))
        // Written so that NaN is too far.
        .filter(|(distance, _)| *distance <= radius && radius > 0.0)
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_candidate_within_reach_is_taken() {
        let point = PicturePoint::new;
        let candidates = [point(f64::NAN, 0.0), point(14.0, 10.0), point(12.0, 10.0), point(8.0, 10.0)];
        let at = point(10.0, 10.0);
        assert_eq!(snap(at, candidates, 3.0), Some(point(12.0, 10.0)), "the first of two equally near");
        assert_eq!(snap(at, candidates, 1.9), None);
        assert_eq!(snap(at, candidates, f64::NAN), None);
        assert_eq!(snap(point(f64::NAN, 1.0), candidates, 100.0), None);
        assert_eq!(snap(at, [at], 0.0), None, "no radius, no snapping");
    }
}
