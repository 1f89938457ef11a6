//! Whether a picture shows a reflection at all, about which axis, and which points are seen twice.
//!
//! Two witnesses are heard: the picture as a whole (strips that mirror about one axis, notes §2.2 step 2) and single
//! corners (steps 4–6). Either is enough: ripples drown corners but not strips; boats, banks and a receding shore break
//! strips but not corners. Neither of them speaking is an answer too: [`NoReflection`].

use glam::DVec2;
use rayon::prelude::*;

use super::gray::{Gray, Turn};
use super::matching::{self, Match, PATCH, SMALL_PATCH};
use super::nadir::Nadir;
use super::parts::{SAME_AXIS, agreeing, commonest_axis, parts};
use super::patches::Patches;
use super::symmetry::{self, MirrorAxis, Whole};
use crate::picture::{Picture, PicturePoint};

/// Rows of the picture that symmetry is measured in, at most (notes §2.2).
const WORK_ROWS: usize = 400;
/// Pixels of the largest picture in which matches are found.
const MOST_PIXELS: f64 = 9e6;
/// Rows in which corners are sought, about.
const SMALL_ROWS: usize = 200;
/// What the picture as a whole must reach, and be ahead of its best rival (notes §2.2, step 2).
const WHOLE_SCORE: f64 = 0.6;
const WHOLE_LEAD: f64 = 0.1;
/// Fewest agreeing corners that make a reflection, and how much of the picture's width they must span.
const FEWEST: usize = 8;
const SPAN: f64 = 0.2;
/// Only images this far from their point count, share of the height: windows and roofs mirror in themselves.
const LONG: f64 = 0.1;
/// They must be at least this share of all corners that think they are mirrored: in a picture without water some do.
const AGREEING: f64 = 0.35;
/// How far beside its line an image may lie, share of the height.
const SIDEWAYS: f64 = 0.0025;
/// A roll that is worth turning the picture for, radians (0.6°), and rolls that are tried where level finds nothing.
const ROLLED: f64 = 0.01;
const ROLLS: [f64; 4] = [-3.0, 3.0, -6.0, 6.0];

/// A picture's reflection.
#[derive(Clone, Debug)]
pub struct Reflection {
    /// The axis about which most of the picture, or most of what was matched, mirrors.
    pub axis: MirrorAxis,
    /// Points that are seen twice, not yet chosen among.
    pub(super) matches: Vec<Match>,
    pub(super) turn: Turn,
}

/// No reflection was found: the picture shows no water, or water too rough to mirror anything.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "no reflection here: only {agreeing} of {tried} details agree with a mirror axis, and the picture as a whole mirrors by {score:.2} where chance gives {runner_up:.2}"
)]
pub struct NoReflection {
    /// Details of the picture that were looked for upside down.
    pub tried: usize,
    /// How many of them were found and agree with each other.
    pub agreeing: usize,
    /// Mean correlation of the picture's strips about the best axis, −1 to 1.
    pub score: f64,
    /// The same for the best other axis.
    pub runner_up: f64,
}

/// A picture at the sizes in which it is searched.
struct Levels {
    small: Gray,
    work: Gray,
    full: Gray,
    /// The pixels of `full` in one of `work`.
    factor: usize,
    /// And in one of `small`.
    small_factor: usize,
}

/// What was found with the picture turned by one angle.
struct Attempt {
    turn: Turn,
    found: Vec<[(isize, isize); 2]>,
    tried: usize,
    agreeing: Vec<Match>,
    nadir: Nadir,
}

/// Looks for a reflection.
///
/// # Errors
///
/// [`NoReflection`] where nothing mirrors clearly enough.
pub fn find_reflection(picture: &Picture) -> Result<Reflection, NoReflection> {
    let size = picture.size().as_dvec2();
    // Beyond some size pixels show no more than the lens did.
    let fine = (size.x * size.y / MOST_PIXELS).sqrt().ceil().max(1.0);
    let full = Gray::of(picture).shrunk(fine as usize);
    let factor = full.height.div_ceil(WORK_ROWS);
    let work = full.shrunk(factor).blurred(1.0);
    let small_factor = ((full.height + SMALL_ROWS / 2) / SMALL_ROWS).max(factor);
    let small = full.shrunk(small_factor).blurred(0.6);
    let levels = Levels { small, work, full: full.blurred(0.7), factor, small_factor };

    let (mut attempt, whole) = rayon::join(|| levels.attempt(0.0), || levels.whole());
    if attempt.agreeing.len() < 2 * FEWEST {
        let whole_tilt = whole.as_ref().map_or(0.0, |whole| whole.tilt.to_degrees());
        let others: Vec<Attempt> = ROLLS
            .par_iter()
            .chain(&[whole_tilt])
            .map(|&degrees| levels.attempt(degrees.to_radians()))
            .collect();
        for other in others {
            // Turned pictures must be clearly better, for they had several chances.
            if other.agreeing.len() > attempt.agreeing.len() + FEWEST / 2 {
                attempt = other;
            }
        }
    }
    if attempt.nadir.tan_roll.abs() > ROLLED && attempt.agreeing.len() >= FEWEST {
        let tilt = attempt.turn.tilt + attempt.nadir.tan_roll.atan();
        let again = levels.attempt(tilt);
        if 4 * again.agreeing.len() >= 3 * attempt.agreeing.len() {
            attempt = again;
        }
    }

    let by_corners = levels.speaks(&attempt);
    let by_whole = whole
        .as_ref()
        .filter(|whole| whole.score > WHOLE_SCORE && whole.score - whole.runner_up > WHOLE_LEAD);
    let refused = NoReflection {
        tried: attempt.tried,
        agreeing: attempt.agreeing.len(),
        score: whole.as_ref().map_or(0.0, |whole| whole.score),
        runner_up: whole.as_ref().map_or(0.0, |whole| whole.runner_up),
    };
    if let Some(whole) = by_whole.filter(|_| !by_corners) {
        attempt = levels.attempt(whole.tilt);
    }
    if !by_corners && by_whole.is_none() {
        return Err(refused);
    }

    let factor = levels.factor as f64;
    let row = match by_whole {
        Some(whole) if !by_corners || (whole.tilt - attempt.turn.tilt).abs() < ROLLED => whole.row,
        _ => commonest_axis(&attempt.agreeing, SAME_AXIS * levels.full.height as f64) / factor,
    };
    let mut axes = parts(&attempt.agreeing, SAME_AXIS * levels.full.height as f64);
    axes.push(row * factor);
    let (matches, nadir) = levels.guided(&attempt, &axes);
    if by_whole.is_none() && !levels.enough(&matches) {
        return Err(NoReflection { agreeing: matches.len(), ..refused });
    }
    // A picture that was turned once can be turned exactly; a level one stays level.
    let tilted = attempt.turn.tilt != 0.0 && matches.len() >= FEWEST && by_corners;
    let more = if tilted { nadir.tan_roll.atan() } else { 0.0 };
    let turn = Turn { tilt: attempt.turn.tilt + more, ..attempt.turn };
    let matches: Vec<Match> = matches.iter().map(|m| m.turned(attempt.turn, turn)).collect();
    let row = match by_whole {
        Some(_) if !tilted => row,
        _ => commonest_axis(&matches, SAME_AXIS * levels.full.height as f64) / factor,
    };
    let measured =
        symmetry::axis_at(&levels.work, turn.scaled(1.0 / factor), row, factor * fine).ok_or(refused)?;
    let by_matches = (matches.len() as f64 / 40.0).min(1.0);
    let by_strips = by_whole.map_or(0.0, |whole| ((whole.score - 0.5) / 0.4).clamp(0.0, 1.0));
    let confidence = 0.5 + 0.49 * by_matches.max(by_strips);
    // Shrinking cuts off what does not fill a pixel; the axis goes on to the border.
    let ends = [0.0, size.x].map(|x| PicturePoint::new(x, measured.y_at(x)));
    let axis = MirrorAxis { ends, confidence, matches: matches.len(), ..measured };
    let matches = matches.iter().map(|m| m.scaled(fine)).collect();
    Ok(Reflection { axis, matches, turn: turn.scaled(fine) })
}

impl Levels {
    fn whole(&self) -> Option<Whole> {
        symmetry::whole(&self.work)
    }

    /// Everything about the picture leveled by `tilt` radians.
    fn attempt(&self, tilt: f64) -> Attempt {
        let scale = self.small_factor as f64;
        let turn = self.full.turn(tilt);
        let small = self.small.leveled(turn.scaled(1.0 / scale));
        let votes = matching::votes(&small);
        let coarse: Vec<Match> =
            votes.matches.iter().map(|&found| matching::unrefined(found, scale)).collect();
        // Small pixels are coarse, so the tolerance is theirs.
        let nadir = Nadir::of(&coarse, turn.center, scale);
        let size = DVec2::new(self.full.width as f64, self.full.height as f64);
        let agreeing = agreeing(&coarse, nadir, 1.5 * scale, size);
        Attempt { turn, found: votes.matches, tried: votes.corners, agreeing, nadir }
    }

    /// Whether an attempt's corners are witness enough.
    fn speaks(&self, attempt: &Attempt) -> bool {
        self.enough(&attempt.agreeing)
            && attempt.agreeing.len() as f64 > AGREEING * attempt.found.len() as f64
    }

    fn enough(&self, matches: &[Match]) -> bool {
        let long = matches.iter().filter(|m| m.length() > LONG * self.full.height as f64);
        let columns = long.map(|m| m.point.x);
        let (count, left, right) =
            columns.fold((0, f64::MAX, f64::MIN), |(count, l, r), x| (count + 1, l.min(x), r.max(x)));
        count >= FEWEST && right - left > SPAN * self.full.width as f64
    }

    /// Matches at full size: those of an attempt, and more that the axes and the nadir lead to.
    fn guided(&self, attempt: &Attempt, axes: &[f64]) -> (Vec<Match>, Nadir) {
        let factor = self.factor as f64;
        let scale = self.small_factor as f64;
        let small = self.small.leveled(attempt.turn.scaled(1.0 / scale));
        let patches = Patches::new(&small, SMALL_PATCH);
        let nadir = attempt.nadir;
        let expected = |corner: (usize, usize), axis: f64| {
            let point = DVec2::new(corner.0 as f64 + 0.5, corner.1 as f64 + 0.5) * scale;
            let row = 2.0 * axis - point.y;
            (row > point.y).then(|| DVec2::new(nadir.column(point, row), row) / scale)
        };
        let mut found: Vec<[(isize, isize); 2]> = matching::corners(&small)
            .into_par_iter()
            .filter_map(|corner| {
                let places = axes.iter().filter_map(|&axis| expected(corner, axis));
                matching::guided(&patches, corner, places)
            })
            .collect();
        found.extend(attempt.found.iter().copied());
        found.sort_unstable();
        found.dedup();

        let mut larger =
            vec![(Patches::new(&self.work.leveled(attempt.turn.scaled(1.0 / factor)), PATCH), factor)];
        if self.factor > 1 {
            larger.push((Patches::new(&self.full.leveled(attempt.turn), PATCH), 1.0));
        }
        let mut matches = matching::refined(&found, scale, &larger);
        // One corner may have come twice.
        matches.sort_by(|a, b| {
            (a.point.x, a.point.y)
                .partial_cmp(&(b.point.x, b.point.y))
                .unwrap_or(std::cmp::Ordering::Equal)
                .then(b.score.total_cmp(&a.score))
        });
        matches.dedup_by(|b, a| a.point.distance(b.point) < 2.0);
        let size = DVec2::new(self.full.width as f64, self.full.height as f64);
        let tolerance = (SIDEWAYS * size.y).max(1.0);
        let nadir = Nadir::of(&matches, attempt.turn.center, tolerance);
        (agreeing(&matches, nadir, tolerance, size), nadir)
    }
}

impl Reflection {
    /// How far a point of the picture may be seen mirrored: the row of the axis of its highest part, at column `x`.
    #[must_use]
    pub fn highest_axis(&self, x: f64) -> f64 {
        let mut axes: Vec<f64> = self.matches.iter().map(Match::axis).collect();
        axes.sort_by(f64::total_cmp);
        // A tenth may be wrong.
        let leveled = axes.get(axes.len() / 10).copied();
        leveled.map_or_else(
            || self.axis.y_at(x),
            |row| {
                let at = self.turn.picture(DVec2::new(x, row));
                at.y + (x - at.x) * self.axis.slope()
            },
        )
    }

    /// Axes of the parts that mirror, in the leveled picture, the strongest first.
    pub(super) fn axes(&self) -> Vec<f64> {
        let axes = parts(&self.matches, SAME_AXIS * self.turn.center.y * 2.0);
        if axes.is_empty() {
            vec![self.turn.level(DVec2::new(self.turn.center.x, self.axis.y_at(self.turn.center.x))).y]
        } else {
            axes
        }
    }

    /// Where the images lean to.
    pub(super) fn nadir(&self) -> Nadir {
        Nadir::of(&self.matches, self.turn.center, (SIDEWAYS * self.turn.center.y * 2.0).max(1.0))
    }

    /// A match's point and image in the picture itself.
    pub(super) fn in_picture(&self, m: &Match) -> [PicturePoint; 2] {
        [m.point, m.image].map(|leveled| PicturePoint(self.turn.picture(leveled)))
    }
}
