//! The few upright planes that measured shifts belong to: frontal ones, and such as recede along the picture.
//!
//! A vertical plane's shift is a line along the leveled picture, a + b·u, that of a frontal one is the same everywhere. A
//! receding plane, which frontal ones would cut into steps, is taken only where it says clearly more than they do.

use super::cluster::{GAIN, WORTH, cluster};
use super::receding::receding_plane;

/// A measured shift, pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// Leveled column, pixels.
    pub(super) across: f64,
    pub(super) shift: f64,
    pub(super) variance: f64,
}

/// An upright plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    /// Shift at the leveled column 0, pixels.
    pub(super) at_zero: f64,
    /// Pixels of shift a column; 0 is frontal.
    pub(super) slope: f64,
    /// From which leveled column to which it was measured.
    pub(super) reach: [f64; 2],
}

/// A receding plane counts as so many frontal ones: it has a slope, and ends.
const RECEDING: f64 = 3.0;
/// Samples are no farther from their plane than so many of their deviations, if that is more than a step.
const DEVIATIONS: f64 = 3.0;
/// Receding planes that are looked for.
const MOST_RECEDING: usize = 3;
/// A plane may be seen beyond where it was measured, by this part of its length to each side.
const BEYOND: f64 = 0.25;
/// A plane's shift is nowhere less than this part of the least, or more than its inverse times the most, that was
/// measured of it.
const LEAST_SHIFT: f64 = 0.6;

impl Plane {
    pub(super) fn frontal(shift: f64) -> Self {
        Self { at_zero: shift, slope: 0.0, reach: [f64::NEG_INFINITY, f64::INFINITY] }
    }

    pub(super) fn recedes(&self) -> bool {
        self.slope != 0.0
    }

    pub(super) fn shift(&self, across: f64) -> f64 {
        self.at_zero + self.slope * across
    }

    /// How far a shift is from the plane's, pixels; infinite beyond where it was measured.
    pub(super) fn off(&self, across: f64, shift: f64) -> f64 {
        let is_there = (self.reach[0]..=self.reach[1]).contains(&across);
        if is_there { (shift - self.shift(across)).abs() } else { f64::INFINITY }
    }

    /// Its distance in the middle of its contact line, in distances at which a shift is one pixel.
    fn distance(&self) -> f64 {
        let [left, right] = self.reach.map(|end| 1.0 / self.shift(end));
        0.5 * (left + right)
    }

    /// The leveled columns in which the plane may be seen.
    pub(super) fn bounds(&self) -> [f64; 2] {
        if !self.recedes() {
            return self.reach;
        }
        let [left, right] = self.reach;
        let beyond = BEYOND * (right - left);
        let ends = self.reach.map(|end| self.shift(end));
        let (low, high) = (ends[0].min(ends[1]) * LEAST_SHIFT, ends[0].max(ends[1]) / LEAST_SHIFT);
        let columns = [low, high].map(|shift| (shift - self.at_zero) / self.slope);
        let (first, last) = (columns[0].min(columns[1]), columns[0].max(columns[1]));
        [(left - beyond).max(first), (right + beyond).min(last)]
    }

    /// The best line through some samples.
    pub(super) fn through(samples: &[Sample], reach: [f64; 2]) -> Option<Self> {
        let count = samples.len() as f64;
        let mean = |of: &dyn Fn(&Sample) -> f64| samples.iter().map(of).sum::<f64>() / count;
        let (across, shift) = (mean(&|s| s.across), mean(&|s| s.shift));
        let product = mean(&|s| (s.across - across) * (s.shift - shift));
        let square = mean(&|s| (s.across - across).powi(2));
        let slope = product / square;
        slope.is_finite().then_some(Self { at_zero: shift - slope * across, slope, reach })
    }
}

/// Parts samples among `most` planes at most, far to near by what was measured of them; none without samples.
/// Neighboring frontal planes are at least `apart` pixels from each other. Without a sky behind, the farthest is frontal:
/// what closes the scene has no end.
pub(super) fn planes(samples: &[Sample], most: usize, apart: f64, has_sky: bool) -> Vec<Plane> {
    let shifts = |samples: &[Sample]| -> Vec<(f64, f64)> {
        samples.iter().map(|sample| (sample.shift, sample.variance)).collect()
    };
    let frontal = cluster(&shifts(samples), most, apart, 0.0);
    let (all, noise) = (frontal.all, frontal.noise);
    // Fewer parameters must be paid for in what they leave, by the rule of the frontal ones alone.
    let score = |left: f64, parameters: f64| {
        (left - noise).max(WORTH * all).max(f64::MIN_POSITIVE).ln() - parameters * (1.0 - GAIN).ln()
    };
    let mut best = score(frontal.left, frontal.centers.len() as f64);
    let mut found: Vec<(f64, Plane)> = frontal.centers.iter().map(|&s| (s, Plane::frontal(s))).collect();
    let mut steps = frontal.centers;
    let (mut receding, mut left) = (Vec::new(), 0.0);
    let mut rest = samples.to_vec();
    for _ in 0..MOST_RECEDING.min(most.saturating_sub(1)) {
        let Some(plane) = receding_plane(&rest, &steps, apart) else { break };
        let (own, others): (Vec<Sample>, Vec<Sample>) =
            rest.iter().partition(|sample| is_near(&plane, sample, apart));
        left += own.iter().map(|s| (s.shift - plane.shift(s.across)).powi(2)).sum::<f64>();
        receding.push((own.iter().map(|s| s.shift).sum::<f64>() / own.len() as f64, plane));
        rest = others;
        let others = cluster(&shifts(&rest), most - receding.len(), apart, all);
        let parameters = RECEDING * receding.len() as f64 + others.centers.len() as f64;
        let now = score(left + others.left, parameters);
        steps.clone_from(&others.centers);
        let farthest = receding.iter().map(|(_, plane)| plane.distance()).fold(0.0, f64::max);
        let is_closed = has_sky || steps.first().is_some_and(|step| 1.0 / step > farthest);
        if now < best && is_closed {
            best = now;
            let others = others.centers.iter().map(|&s| (s, Plane::frontal(s)));
            found = receding.iter().copied().chain(others).collect();
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, plane)| plane).collect()
}

/// Whether a sample is of a receding plane.
pub(super) fn is_near(plane: &Plane, sample: &Sample, apart: f64) -> bool {
    plane.off(sample.across, sample.shift) <= tolerance(sample, apart)
}

/// How far a sample may be from its plane, pixels.
pub(super) fn tolerance(sample: &Sample, apart: f64) -> f64 {
    apart.max(DEVIATIONS * sample.variance.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plane's samples in every column of a part of a picture 800 pixels wide, known to 0.3 px.
    fn seen(columns: std::ops::Range<usize>, rows: usize, shift: impl Fn(f64) -> f64) -> Vec<Sample> {
        let sample = |column: usize, row: usize| {
            let across = column as f64 - 400.0;
            // Errors of three pixels by turns, the mean of whose squares is the variance.
            let off = 0.3 * 1.5_f64.sqrt() * ((column + row) % 3) as f64 - 0.3 * 1.5_f64.sqrt();
            Sample { across, shift: shift(across) + off, variance: 0.09 }
        };
        columns
            .flat_map(|column| (0..rows).map(move |row| (column, row)))
            .map(|(c, r)| sample(c, r))
            .collect()
    }

    fn found(samples: &[Sample]) -> Vec<Plane> {
        planes(samples, 8, 1.5, false)
    }

    #[test]
    fn a_quay_before_a_shore_is_one_plane_that_recedes() {
        let quay = |across: f64| 30.0 - 0.1 * across;
        let all = [seen(80..420, 10, quay), seen(0..800, 20, |_| 12.0)].concat();
        let found = found(&all);
        let [shore, wall] = found.as_slice() else { panic!("{found:?}") };
        assert!(!shore.recedes() && (shore.at_zero - 12.0).abs() < 0.1, "{shore:?}");
        assert!((wall.slope + 0.1).abs() < 0.002 && (wall.at_zero - 30.0).abs() < 0.3, "{wall:?}");
        assert!((wall.reach[0] + 320.0).abs() < 12.0 && (wall.reach[1] - 20.0).abs() < 12.0, "{wall:?}");
        // Not past where its shift would be nothing, and not far beyond what was measured.
        let [left, right] = wall.bounds();
        assert!(left < -380.0 && left > -440.0 && right > 80.0 && right < 120.0, "{left} to {right}");
    }

    #[test]
    fn walls_one_behind_the_other_stay_frontal() {
        let houses = (0..3).flat_map(|i| seen(200 * i..200 * i + 180, 10, move |_| 15.0 + 9.0 * i as f64));
        let found = found(&houses.collect::<Vec<_>>());
        assert!(found.len() == 3 && found.iter().all(|plane| !plane.recedes()), "{found:?}");
    }

    #[test]
    fn what_closes_the_scene_is_frontal_without_a_sky() {
        let quay = seen(0..800, 10, |across| 30.0 - 0.05 * across);
        assert!(found(&quay).iter().all(|plane| !plane.recedes()), "{:?}", found(&quay));
        let before_sky = planes(&quay, 8, 1.5, true);
        assert!(before_sky.len() == 1 && before_sky[0].recedes(), "{before_sky:?}");
    }

    #[test]
    fn a_tree_before_a_quay_does_not_part_it() {
        let quay = |across: f64| 40.0 + 0.08 * across;
        let all = [seen(0..300, 10, quay), seen(380..800, 10, quay), seen(300..380, 10, |_| 90.0)].concat();
        let found = planes(&all, 8, 1.5, true);
        let receding = found.iter().filter(|plane| plane.recedes()).count();
        assert!(found.len() == 2 && receding == 1, "{found:?}");
    }
}
