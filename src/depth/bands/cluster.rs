//! Which shifts belong together: the best partition of a line into a few intervals.

/// A few shifts that stand for all of them, ascending.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Clusters {
    /// The intervals' means, pixels.
    pub(super) centers: Vec<f64>,
    /// Squared pixels, summed: what the intervals leave, what one would, and what measuring alone makes.
    pub(super) left: f64,
    pub(super) all: f64,
    pub(super) noise: f64,
}

/// Shifts are counted in bins this wide, pixels.
const BIN: f64 = 0.25;
/// So many bins at most; wider ones, if there are more.
const MOST_BINS: usize = 800;
/// A further interval must take away this part of what the intervals before left, and of all there was.
pub(super) const GAIN: f64 = 0.3;
pub(super) const WORTH: f64 = 0.004;

/// Parts shifts, each with its variance, into `most` intervals at most (optimal one-dimensional k-means). Neighboring
/// centers are at least `apart` pixels from each other; there is one interval if nothing more is supported, none
/// without shifts. They may be a part
/// of what was measured, whose spread about one mean is `whole`; else that is 0.
pub(super) fn cluster(shifts: &[(f64, f64)], most: usize, apart: f64, whole: f64) -> Clusters {
    let finite = || shifts.iter().filter(|(shift, variance)| shift.is_finite() && variance.is_finite());
    let (low, high) =
        finite().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (s, _)| (low.min(*s), high.max(*s)));
    if low > high {
        return Clusters { centers: Vec::new(), left: 0.0, all: 0.0, noise: 0.0 };
    }
    let width = BIN.max((high - low) / MOST_BINS as f64);
    let mut bins = vec![[0.0; 4]; ((high - low) / width) as usize + 1];
    for &(shift, variance) in finite() {
        let bin = &mut bins[((shift - low) / width) as usize];
        *bin = [bin[0] + 1.0, bin[1] + shift, bin[2] + shift * shift, bin[3] + variance];
    }
    // Running sums, so that any interval's spread is one subtraction.
    let mut sums = vec![[0.0; 4]];
    for (i, bin) in bins.iter().enumerate() {
        sums.push(std::array::from_fn(|k| sums[i][k] + bin[k]));
    }
    let part = |from: usize, to: usize| -> [f64; 4] { std::array::from_fn(|k| sums[to][k] - sums[from][k]) };
    let spread = |from: usize, to: usize| {
        let [count, sum, squares, _] = part(from, to);
        if count > 0.0 { (squares - sum * sum / count).max(0.0) } else { 0.0 }
    };
    // The spread that measuring alone makes cannot be parted.
    let noise = sums[bins.len()][3];
    let mut chosen = vec![(0, bins.len())];
    let mut left = spread(0, bins.len());
    let all = left;
    let mut before: Vec<f64> = (0..=bins.len()).map(|to| spread(0, to)).collect();
    let mut cuts: Vec<Vec<usize>> = Vec::new();
    for _ in 1..most {
        let (now, cut): (Vec<f64>, Vec<usize>) = (0..=bins.len())
            .map(|to| {
                (0..=to)
                    .map(|from| (before[from] + spread(from, to), from))
                    .min_by(|a, b| a.0.total_cmp(&b.0))
                    .unwrap_or((0.0, 0))
            })
            .unzip();
        before = now;
        cuts.push(cut);
        let next = before[bins.len()];
        let mut to = bins.len();
        let mut intervals = Vec::new();
        for cut in cuts.iter().rev() {
            intervals.push((cut[to], to));
            to = cut[to];
        }
        intervals.push((0, to));
        intervals.reverse();
        let mean = |&(from, to): &(usize, usize)| part(from, to)[1] / part(from, to)[0].max(1.0);
        let empty = intervals.iter().any(|&(from, to)| part(from, to)[0] == 0.0);
        let too_near = intervals.windows(2).any(|pair| mean(&pair[1]) - mean(&pair[0]) < apart);
        let gain = left - next;
        if empty || too_near || gain < GAIN * (left - noise).max(0.0) || gain < WORTH * all.max(whole) {
            break;
        }
        (chosen, left) = (intervals, next);
        if left <= noise {
            break;
        }
    }
    let centers = chosen.iter().map(|&(from, to)| part(from, to)[1] / part(from, to)[0]).collect();
    Clusters { centers, left, all, noise }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// So many shifts, evenly from `low` to `high`, each known to 0.3 px.
    fn shifts(count: usize, low: f64, high: f64) -> Vec<(f64, f64)> {
        (0..count).map(|i| (low + (high - low) * i as f64 / count as f64, 0.09)).collect()
    }

    #[test]
    fn heaps_apart_are_told_apart() {
        let all = [shifts(500, 3.0, 4.0), shifts(300, 14.0, 16.0), shifts(900, 29.5, 30.5)].concat();
        let found = cluster(&all, 8, 1.5, 0.0).centers;
        assert_eq!(found.len(), 3, "{found:?}");
        for (center, truth) in found.iter().zip([3.5, 15.0, 30.0]) {
            assert!((center - truth).abs() < 0.1, "{found:?}");
        }
    }

    #[test]
    fn noise_is_not_cut() {
        assert_eq!(cluster(&shifts(1000, 26.5, 27.5), 8, 1.5, 0.0).centers.len(), 1);
        assert!(cluster(&[], 8, 1.5, 0.0).centers.is_empty());
        assert!(cluster(&[(f64::NAN, 1.0), (3.0, f64::INFINITY)], 8, 1.5, 0.0).centers.is_empty());
    }

    #[test]
    fn a_slope_is_cut_no_finer_than_allowed() {
        let found = cluster(&shifts(5000, 5.0, 45.0), 8, 6.0, 0.0).centers;
        assert!(found.len() > 2 && found.windows(2).all(|pair| pair[1] - pair[0] >= 6.0), "{found:?}");
        assert!(cluster(&shifts(5000, 5.0, 45.0), 2, 1.0, 0.0).centers.len() <= 2);
    }
}
