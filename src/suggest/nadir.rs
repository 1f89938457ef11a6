//! Where reflections lean to: all lines from points to their images run to the nadir.
//!
//! Notes §1.3 (A): with u to the right and v up from the picture's middle, `(u'−u) + t·(v−v') + w·(v·u' − u·v') = 0`,
//! t the tangent of the camera's roll and w the inverse distance of the nadir. Two matches make a candidate, all vote.

use glam::DVec2;

use super::matching::Match;

/// Roll and nadir of a leveled picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Nadir {
    center: DVec2,
    pub(super) tan_roll: f64,
    /// Per pixel.
    pub(super) inverse: f64,
}

/// Candidates are made of this many pairs of matches at most.
const SAMPLES: usize = 2000;

impl Nadir {
    /// The equation's constant and its two coefficients, pixels and square pixels.
    fn terms(center: DVec2, point: DVec2, image: DVec2) -> [f64; 3] {
        let up = |p: DVec2| DVec2::new(p.x - center.x, center.y - p.y);
        let (p, r) = (up(point), up(image));
        [r.x - p.x, p.y - r.y, p.y * r.x - p.x * r.y]
    }

    /// How far beside its line to the nadir an image lies, pixels.
    pub(super) fn off(self, point: DVec2, image: DVec2) -> f64 {
        let [sideways, upward, area] = Self::terms(self.center, point, image);
        sideways + self.tan_roll * upward + self.inverse * area
    }

    /// The column at which the image of `point` in `row` is expected.
    pub(super) fn column(self, point: DVec2, row: f64) -> f64 {
        point.x - self.off(point, DVec2::new(point.x, row))
    }

    /// The nadir that most matches agree with, to `tolerance` pixels; straight down where fewer than two do.
    pub(super) fn of(matches: &[Match], center: DVec2, tolerance: f64) -> Self {
        let votes = |candidate: Self| -> f64 {
            let off = |m: &Match| (candidate.off(m.point, m.image) / tolerance).powi(2).min(1.0);
            matches.iter().map(off).sum()
        };
        let straight = Self { center, ..Self::default() };
        let mut best = (votes(straight), straight);
        let count = matches.len();
        let all = count * count.saturating_sub(1) / 2;
        // Every so manieth of all couples, so that few and many matches cost the same.
        let every = all.div_ceil(SAMPLES).max(1);
        let couples = (0..count).flat_map(|b| (0..b).map(move |a| (a, b)));
        for (a, b) in couples.step_by(every) {
            let candidate = Self::fit([matches[a], matches[b]].iter(), center);
            let score = candidate.map_or(f64::INFINITY, votes);
            if let Some(candidate) = candidate.filter(|_| score < best.0) {
                best = (score, candidate);
            }
        }
        for _ in 0..3 {
            let agreeing = matches.iter().filter(|m| best.1.off(m.point, m.image).abs() < tolerance);
            let Some(candidate) = Self::fit(agreeing, center) else { break };
            let score = votes(candidate);
            if score >= best.0 {
                break;
            }
            best = (score, candidate);
        }
        best.1
    }

    /// Least squares; `None` where the matches do not tell the two numbers apart or ask for an absurd camera.
    fn fit<'a>(matches: impl Iterator<Item = &'a Match>, center: DVec2) -> Option<Self> {
        let (mut aa, mut ab, mut bb, mut ca, mut cb) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for m in matches {
            let [c, a, b] = Self::terms(center, m.point, m.image);
            aa += a * a;
            ab += a * b;
            bb += b * b;
            ca += c * a;
            cb += c * b;
        }
        let determinant = aa * bb - ab * ab;
        let found = Self {
            center,
            tan_roll: (ab * cb - bb * ca) / determinant,
            inverse: (ab * ca - aa * cb) / determinant,
        };
        // Roll of 15°; a nadir within a picture's width of the middle.
        let sane = found.tan_roll.abs() < 0.27 && found.inverse.abs() * center.x * 2.0 < 1.0;
        (determinant > 1e-6 * aa * bb && sane).then_some(found)
    }

    /// Standard deviation of `inverse` if each match is `sideways` pixels off: one over the root of ΣL²(u−ū)².
    pub(super) fn deviation(matches: &[Match], sideways: f64) -> f64 {
        let weight = |m: &Match| m.length().powi(2);
        let sum: f64 = matches.iter().map(weight).sum();
        let mean = matches.iter().map(|m| weight(m) * m.point.x).sum::<f64>() / sum;
        let information: f64 = matches.iter().map(|m| weight(m) * (m.point.x - mean).powi(2)).sum();
        if information > 0.0 { sideways * information.sqrt().recip() } else { f64::INFINITY }
    }
}
