//! A body's way over the water (notes §7.4): where it is at any time, in any order of times.
//!
//! A closed course runs round and round at one speed. An open one starts and stops gently, and then returns, or stays.

use glam::{DVec2, DVec3};

use super::super::rounds::{MOST_HASTE, haste_of_whole_rounds};
use super::curve::Curve;
use super::number;
use super::pose::{Berth, BodyPose, Facing, facing};
use crate::tour::Course;

/// Steepest change of speed where a body starts or stops, m/s².
const GENTLE: f64 = 0.5;

/// Time to turn about at an end, seconds.
const TURN_SECONDS: f64 = 6.0;

/// Fastest course, m/s.
const FASTEST: f64 = 30.0;

/// Farthest that a waypoint may lie, meters.
const FARTHEST: f64 = 1e5;

/// What a body does at the end of an open course.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AtEnd {
    /// It turns and goes back, again and again.
    #[default]
    Return,
    /// It stays.
    Stop,
}

/// Why a course cannot be sailed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CourseError {
    /// A course needs two points.
    #[error("a course needs two points or more, this one has {0}; add points (x, z) on the water, in meters")]
    TooFewPoints(usize),
    /// A point that is none.
    #[error(
        "waypoint {index} is at {point}, which is no place on the water; write two numbers (x, z) within 100 km"
    )]
    NoPoint {
        /// Its index, from 0.
        index: usize,
        /// Its coordinates.
        point: DVec2,
    },
    /// Neighbors at the same place.
    #[error("waypoints {0} and {1} are the same point; leave out the second")]
    SamePoint(usize, usize),
    /// A speed that no body has.
    #[error("the course's speed is {0} m/s; it must be above 0 and at most 30 m/s")]
    Speed(f64),
    /// No whole number of rounds fits a loop.
    #[error(
        "a round takes {round_seconds:.1} s, which fits no loop of {loop_seconds} s; make the loop at least {least_seconds:.1} s long"
    )]
    LoopTooShort {
        /// Time of a round as written.
        round_seconds: f64,
        /// The loop asked for.
        loop_seconds: f64,
        /// The shortest loop that would do.
        least_seconds: f64,
    },
    /// A course that stops at its end has no rounds.
    #[error("a course that stops at its end does not repeat; let it return, or close it")]
    NoRounds,
}

/// A body on its course at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sailing {
    /// The waterline's center (x, z), meters.
    pub center: DVec2,
    /// Where the bow points, radians; it goes on counting around the course.
    pub heading: f64,
    /// Meters per second, not below 0.
    pub speed: f64,
}

/// A course with its timing.
#[derive(Clone, Debug, PartialEq)]
pub struct SailedCourse {
    curve: Curve,
    timing: Timing,
    speed: f64,
    /// How much faster time runs than it should, to fit a loop.
    haste: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Timing {
    Round,
    /// Seconds to get up to speed, and from one end to the other.
    Between {
        ramp: f64,
        leg: f64,
        at_end: AtEnd,
    },
}

impl SailedCourse {
    /// The course of a body; `contact_length` (meters) is its length where the course has none. `at_end` is for an open
    /// course. A closed one of two points goes there and back.
    ///
    /// # Errors
    ///
    /// When there are fewer than two points, a point is not finite or too far, neighbors are the same point, or the speed
    /// is out of its range.
    pub fn new(course: &Course, contact_length: f64, at_end: AtEnd) -> Result<Self, CourseError> {
        let points: Vec<DVec2> = course.waypoints.iter().map(|waypoint| waypoint.0).collect();
        if points.len() < 2 {
            return Err(CourseError::TooFewPoints(points.len()));
        }
        let sound = |point: &DVec2| point.is_finite() && point.abs().max_element() <= FARTHEST;
        if let Some(index) = points.iter().position(|point| !sound(point)) {
            return Err(CourseError::NoPoint { index, point: points[index] });
        }
        let closed = course.closed && points.len() > 2;
        let last = points.len() - 1;
        let pairs = (0..last).map(|i| (i, i + 1)).chain(closed.then_some((last, 0)));
        for (i, j) in pairs {
            // Nearer ones would make the curve's table run into rounding.
            if points[i].distance(points[j]) < 1e-6 {
                return Err(CourseError::SamePoint(i, j));
            }
        }
        let speed = course.speed;
        if !(speed > 0.0 && speed <= FASTEST) {
            return Err(CourseError::Speed(speed));
        }
        let hull = number(course.length, number(Some(contact_length), 4.0, 0.1, 400.0), 0.1, 400.0);
        let curve = Curve::new(&points, closed, hull);
        let cruise = curve.length() / speed;
        // The speed grows as a smooth step, which is 1.5 times as steep in its middle as in the mean.
        let ramp = (1.5 * speed / GENTLE).min(cruise);
        let at_end = if course.closed { AtEnd::Return } else { at_end };
        let timing =
            if closed { Timing::Round } else { Timing::Between { ramp, leg: cruise + ramp, at_end } };
        Ok(Self { curve, timing, speed, haste: 1.0 })
    }

    /// Seconds after which it repeats; `None` for a course that stops at its end.
    #[must_use]
    pub fn round_seconds(&self) -> Option<f64> {
        self.unhurried_round().map(|seconds| seconds / self.haste)
    }

    /// The same course with a speed so near its own that a whole number of rounds takes `loop_seconds`.
    ///
    /// # Errors
    ///
    /// When it does not repeat, or would have to run at more than twice or less than half its speed, or faster than 30 m/s.
    pub fn with_whole_rounds(&self, loop_seconds: f64) -> Result<Self, CourseError> {
        let round = self.unhurried_round().ok_or(CourseError::NoRounds)?;
        let most = MOST_HASTE.min(FASTEST / self.speed);
        match haste_of_whole_rounds(round, loop_seconds, most) {
            Ok(haste) => Ok(Self { haste, ..self.clone() }),
            Err(least_seconds) => {
                Err(CourseError::LoopTooShort { round_seconds: round, loop_seconds, least_seconds })
            }
        }
    }

    /// Where the body is at a time; what is no number counts as 0.
    #[must_use]
    pub fn at(&self, seconds: f64) -> Sailing {
        let seconds = if seconds.is_finite() { seconds } else { 0.0 };
        let time = match self.round_seconds() {
            // Reduced by the round itself, so that loops close to the bit.
            Some(round) => seconds.rem_euclid(round) * self.haste,
            None => seconds,
        };
        let (way, speed, turn) = match self.timing {
            Timing::Round => ((time * self.speed).min(self.curve.length()), self.speed, 0.0),
            Timing::Between { ramp, leg, at_end } => {
                let out = self.way_and_speed(time, ramp, leg);
                let back = self.way_and_speed(time - leg - TURN_SECONDS, ramp, leg);
                let half_turn = |since: f64| std::f64::consts::PI * smooth(since / TURN_SECONDS);
                match at_end {
                    AtEnd::Stop => (out.0, out.1, 0.0),
                    AtEnd::Return if time < leg + TURN_SECONDS => (out.0, out.1, half_turn(time - leg)),
                    AtEnd::Return => {
                        let turn = half_turn(TURN_SECONDS) + half_turn(time - 2.0 * leg - TURN_SECONDS);
                        (self.curve.length() - back.0, back.1, turn)
                    }
                }
            }
        };
        let (center, heading) = self.curve.at(way);
        Sailing { center, heading: heading + turn, speed: speed * self.haste }
    }

    fn unhurried_round(&self) -> Option<f64> {
        match self.timing {
            Timing::Round => Some(self.curve.length() / self.speed),
            Timing::Between { leg, at_end: AtEnd::Return, .. } => Some(2.0 * (leg + TURN_SECONDS)),
            Timing::Between { at_end: AtEnd::Stop, .. } => None,
        }
    }

    /// Way and speed `time` seconds after setting out from one end, until the body rests at the other.
    fn way_and_speed(&self, time: f64, ramp: f64, leg: f64) -> (f64, f64) {
        let time = time.clamp(0.0, leg);
        let length = self.curve.length();
        // The way while the speed grows as a smooth step: its integral.
        let starting = |time: f64| {
            let part = time / ramp;
            self.speed * ramp * part * part * part * (1.0 - 0.5 * part)
        };
        let way = if time < ramp {
            starting(time)
        } else if time > leg - ramp {
            length - starting(leg - time)
        } else {
            self.speed * (time - 0.5 * ramp)
        };
        (way.clamp(0.0, length), self.speed * smooth(time.min(leg - time) / ramp))
    }
}

impl Sailing {
    /// How far this is from a body's rest, as its billboard shows it.
    #[must_use]
    pub fn pose(&self, berth: &Berth) -> BodyPose {
        let Facing { yaw, mirrored_share } = facing(self.heading, berth.heading);
        let position = DVec3::new(self.center.x - berth.center.x, 0.0, self.center.y - berth.center.z);
        BodyPose { position, yaw, mirrored_share, ..BodyPose::default() }
    }

    /// The same on waves: `afloat` is the pose of the [`FloatingBody`](super::FloatingBody) that steps along the course.
    #[must_use]
    pub fn pose_on_waves(&self, berth: &Berth, afloat: &BodyPose) -> BodyPose {
        let pose = self.pose(berth);
        pose.with_waves(afloat, self.heading - berth.heading - pose.yaw)
    }
}

/// From 0 to 1 without a jump in speed.
fn smooth(part: f64) -> f64 {
    let part = part.clamp(0.0, 1.0);
    part * part * (3.0 - 2.0 * part)
}
