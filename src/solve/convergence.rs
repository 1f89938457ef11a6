//! Where the solver starts: roll and the nadir's inverse distance from the lines that join points to their reflections.
//!
//! These lines all run to the nadir. The condition is linear in two numbers, so two pairs give a candidate and all
//! pairs vote on it; nothing here depends on depths (README, "Convergence"). Coordinates are u to the right and v *up*
//! from the principal point, and angles those of [`crate::camera`].

use glam::DVec2;

use super::AnnotatedPair;
use super::Annotations;

/// One equation: `sideways + tan_roll · upward + nadir · area = 0`, in pixels.
#[derive(Clone, Copy, Debug)]
struct Line {
    point: DVec2,
    reflection: DVec2,
    point_deviation: f64,
    reflection_deviation: DVec2,
}

/// `tan_roll` and `nadir`, which is −tan(pitch) / (f · cos(roll)): one over the nadir's distance, per pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Candidate {
    tan_roll: f64,
    nadir: f64,
}

/// Pitch, roll and focal length to start from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Start {
    pub(super) focal_px: f64,
    pub(super) pitch: f64,
    pub(super) roll: f64,
}

/// A pair farther off than this many deviations does not vote.
const VOTE_LIMIT: f64 = 3.0;
/// Up to this many pairs, every two of them make a candidate.
const EXHAUSTIVE_PAIRS: usize = 32;
/// Beyond it, this many samples are drawn.
const SAMPLES: usize = 500;
/// Tangents of the largest roll (20°) and the largest pitch (60°) that are believed.
const LARGEST_TAN_ROLL: f64 = 0.364;
const LARGEST_TAN_PITCH: f64 = 1.73;

impl Line {
    fn new(annotations: &Annotations, pair: &AnnotatedPair) -> Self {
        let centered =
            |p: DVec2| DVec2::new(p.x - annotations.principal.x(), annotations.principal.y() - p.y);
        Self {
            point: centered(pair.point.0),
            reflection: centered(pair.reflection.0),
            point_deviation: pair.point_deviation_px,
            reflection_deviation: DVec2::from_array(pair.reflection_deviation_px),
        }
    }

    /// Constant term and the two coefficients of the linear equation.
    fn terms(&self) -> [f64; 3] {
        let (p, r) = (self.point, self.reflection);
        [r.x - p.x, p.y - r.y, p.y * r.x - p.x * r.y]
    }

    /// How far the two points are from being in line with the nadir, in standard deviations.
    fn residual(&self, candidate: Candidate) -> f64 {
        let Candidate { tan_roll, nadir } = candidate;
        let [sideways, upward, area] = self.terms();
        let by_point = DVec2::new(-1.0 - nadir * self.reflection.y, tan_roll + nadir * self.reflection.x);
        let by_reflection = DVec2::new(1.0 + nadir * self.point.y, -tan_roll - nadir * self.point.x);
        let variance = (by_point * self.point_deviation).length_squared()
            + (by_reflection * self.reflection_deviation).length_squared();
        (sideways + tan_roll * upward + nadir * area) / variance.sqrt()
    }
}

/// What the horizon says: height above the principal point at u = 0 in pixels, and slope, with their deviations.
struct HorizonLine {
    height: f64,
    slope: f64,
    deviation: f64,
    slope_deviation: f64,
}

fn horizon_line(annotations: &Annotations) -> Option<HorizonLine> {
    let [left, right] = annotations.horizon?;
    let slope = -(right.y() - left.y()) / (right.x() - left.x());
    let height = annotations.principal.y() - left.y() + slope * (annotations.principal.x() - left.x());
    let slope_deviation =
        annotations.horizon_deviation_px * std::f64::consts::SQRT_2 / (right.x() - left.x()).abs();
    Some(HorizonLine { height, slope, deviation: annotations.horizon_deviation_px, slope_deviation })
}

/// The start for `annotations`, taking `guessed_focal` where the picture does not show the focal length.
///
/// `free_focal` says whether the focal length may be read off the picture.
pub(super) fn start(annotations: &Annotations, guessed_focal: f64, free_focal: bool) -> Start {
    let lines: Vec<Line> = annotations.pairs.iter().map(|pair| Line::new(annotations, pair)).collect();
    let horizon = horizon_line(annotations);
    let shortest_focal = 0.2 * f64::from(annotations.uncropped_size.x);
    let largest_nadir = LARGEST_TAN_PITCH / shortest_focal;
    // Without pairs the horizon alone decides, without a horizon a level camera is the neutral candidate.
    let fallback = horizon.as_ref().map_or(Candidate { tan_roll: 0.0, nadir: 0.0 }, |line| Candidate {
        tan_roll: -line.slope,
        nadir: line.height / (guessed_focal * guessed_focal),
    });

    let score = |candidate: Candidate| {
        let votes: f64 =
            lines.iter().map(|line| line.residual(candidate).powi(2).min(VOTE_LIMIT.powi(2))).sum();
        let slope =
            horizon.as_ref().map_or(0.0, |line| (candidate.tan_roll + line.slope) / line.slope_deviation);
        votes + slope.powi(2).min(VOTE_LIMIT.powi(2))
    };
    let mut best = (score(fallback), fallback);
    for (first, second) in samples(lines.len()) {
        let Some(candidate) = through(&[lines[first], lines[second]], |_| 1.0) else {
            continue;
        };
        if candidate.tan_roll.abs() > LARGEST_TAN_ROLL || candidate.nadir.abs() > largest_nadir {
            continue;
        }
        let votes = score(candidate);
        if votes < best.0 {
            best = (votes, candidate);
        }
    }

    let agreeing: Vec<Line> =
        lines.iter().copied().filter(|line| line.residual(best.1).abs() < VOTE_LIMIT).collect();
    let candidate =
        through(&agreeing, |line| line.point_deviation.hypot(line.reflection_deviation.x).powi(-2))
            .filter(|refined| score(*refined) < best.0)
            .unwrap_or(best.1);

    closed_form(
        candidate,
        horizon.as_ref(),
        guessed_focal,
        free_focal,
        nadir_deviation(&agreeing),
        shortest_focal,
    )
}

/// `f² = height · cos(roll) / w`, `tan(pitch) = −w·f`, with w = nadir · cos(roll); the focal length is read off only where
/// both are told from zero and agree in sign, else it is the guess.
fn closed_form(
    candidate: Candidate,
    horizon: Option<&HorizonLine>,
    guessed_focal: f64,
    free_focal: bool,
    nadir_deviation: f64,
    shortest_focal: f64,
) -> Start {
    let roll = candidate.tan_roll.atan();
    let w = candidate.nadir * roll.cos();
    let square = horizon.map_or(0.0, |line| line.height * roll.cos() / w);
    let readable = free_focal && square > 0.0 && candidate.nadir.abs() > 2.0 * nadir_deviation;
    let focal_px =
        if readable { square.sqrt().clamp(shortest_focal, 40.0 * shortest_focal) } else { guessed_focal };
    let tangent = match horizon {
        // Pairs place the horizon to nadir_deviation · f²; a marked one that is much better than that is believed first.
        Some(line) if nadir_deviation * focal_px * focal_px > 4.0 * line.deviation => {
            -line.height * roll.cos() / focal_px
        }
        _ => -w * focal_px,
    };
    Start { focal_px, pitch: tangent.atan(), roll }
}

/// Weighted least squares of the linear equations; `None` where they do not tell the two numbers apart.
fn through(lines: &[Line], weight: impl Fn(&Line) -> f64) -> Option<Candidate> {
    let (mut aa, mut ab, mut bb, mut ca, mut cb) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for line in lines {
        let ([c, a, b], w) = (line.terms(), weight(line));
        aa += w * a * a;
        ab += w * a * b;
        bb += w * b * b;
        ca += w * c * a;
        cb += w * c * b;
    }
    let determinant = aa * bb - ab * ab;
    (determinant > 1e-9 * aa * bb).then(|| Candidate {
        tan_roll: (ab * cb - bb * ca) / determinant,
        nadir: (ab * ca - aa * cb) / determinant,
    })
}

/// Standard deviation of `nadir`, the roll being estimated beside it, per pixel.
fn nadir_deviation(lines: &[Line]) -> f64 {
    let (mut aa, mut ab, mut bb) = (0.0, 0.0, 0.0);
    for line in lines {
        let [_, a, b] = line.terms();
        let w = line.point_deviation.hypot(line.reflection_deviation.x).powi(-2);
        aa += w * a * a;
        ab += w * a * b;
        bb += w * b * b;
    }
    let information = bb - ab * ab / aa;
    if information > 0.0 { information.sqrt().recip() } else { f64::INFINITY }
}

/// Index pairs to try: all of them, or a fixed sequence.
fn samples(count: usize) -> Vec<(usize, usize)> {
    if count <= EXHAUSTIVE_PAIRS {
        return (0..count).flat_map(|second| (0..second).map(move |first| (first, second))).collect();
    }
    // Knuth's 64-bit linear congruence; its high bits are random enough to draw pairs, and the same in every run.
    let mut state = 1_u64;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % count
    };
    (0..SAMPLES).map(|_| (draw(), draw())).filter(|(first, second)| first != second).collect()
}
