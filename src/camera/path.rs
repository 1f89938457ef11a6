//! A camera's way through keyframes: where it is at any second, on a smooth curve, with stops and cuts.
//!
//! The way passes every keyframe exactly, and its speed has no jump unless an [`Easing`] asks for one.

use std::array;
use std::f64::consts::TAU;

use glam::{DVec3, EulerRot};
use serde::{Deserialize, Serialize};

use super::CameraPose;

/// How the camera moves on its way to a keyframe.
///
/// It *rests* where it is held, at the two ends of an open path, on either side of a cut, before an `In` and after
/// an `Out`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Easing {
    /// On a curve without a jump in speed; starts and stops gently where the camera rests.
    #[default]
    Smooth,
    /// Straight, at one speed from end to end, and so at once up to speed after a rest.
    Linear,
    /// From rest, faster and faster; where the camera rests next, it stops at once.
    In,
    /// Slower and slower into rest; where the camera rested before, it starts at once.
    Out,
}

/// A pose to pass, and when.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keyframe {
    /// Where the camera stands and looks; it must not look straight up or down.
    pub pose: CameraPose,
    /// Seconds from leaving the keyframe before, at least 0; 0 is a cut.
    ///
    /// The first keyframe's are the seconds that a looped path takes to close; an open path has no use for them.
    pub arrive: f64,
    /// Seconds to stand still here, at least 0.
    pub hold: f64,
    /// How the camera comes here.
    pub easing: Easing,
}

/// A change of position in meters and of yaw, pitch and roll in radians; or that per second.
type Motion = [DVec3; 2];

const REST: Motion = [DVec3::ZERO; 2];

/// How many times faster than on the slower of its two neighboring legs a camera may pass a keyframe.
///
/// Without a limit, a fast leg before a short slow one would swing the camera far beyond the keyframe.
const HASTE: f64 = 1.5;

/// The way from one keyframe to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Leg {
    seconds: f64,
    easing: Easing,
    /// All of its motion; angles go the shortest way.
    moved: Motion,
    /// Velocities at its two ends.
    start: Motion,
    end: Motion,
}

/// A camera's way through keyframes, open or closed. It has a keyframe, and all its numbers are finite.
///
/// Positions run on a Catmull-Rom spline whose tangents respect the keyframes' times, and yaw, pitch and roll likewise,
/// each turning the shortest way.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraPath {
    keyframes: Vec<Keyframe>,
    /// When each keyframe is reached, seconds from the start.
    arrivals: Vec<f64>,
    /// Leg k leads away from keyframe k; an open path's last keyframe has none.
    legs: Vec<Leg>,
    duration: f64,
    looped: bool,
}

impl CameraPath {
    /// A path through `keyframes`; `None` when there is none, or when a number is not finite or a time below 0.
    #[must_use]
    pub fn new(keyframes: Vec<Keyframe>, looped: bool) -> Option<Self> {
        let first = keyframes.first()?;
        let mut duration = 0.0;
        let arrivals = keyframes.iter().enumerate().map(|(k, keyframe)| {
            let arrival = if k > 0 { duration + keyframe.arrive } else { 0.0 };
            duration = arrival + keyframe.hold;
            arrival
        });
        let arrivals = arrivals.collect();
        duration += if looped { first.arrive } else { 0.0 };
        (duration.is_finite() && keyframes.iter().all(is_sound)).then(|| {
            let legs = legs(&keyframes, looped);
            Self { keyframes, arrivals, legs, duration, looped }
        })
    }

    /// Seconds from the start to the end, or once around.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Whether it goes on from its end to its start.
    #[must_use]
    pub fn is_looped(&self) -> bool {
        self.looped
    }

    /// Where the camera is `seconds` after the start: any time around a loop, the nearer end outside of an open path.
    #[must_use]
    pub fn at(&self, seconds: f64) -> CameraPose {
        let time = if self.looped { seconds.rem_euclid(self.duration) } else { seconds };
        // Not finite: never, forever, or once around a loop that takes no time.
        let time = if time.is_nan() { 0.0 } else { time };
        let here = self.arrivals.partition_point(|arrival| *arrival <= time).saturating_sub(1);
        let keyframe = &self.keyframes[here];
        let since = time - self.arrivals[here] - keyframe.hold;
        match self.legs.get(here) {
            Some(leg) if since > 0.0 => leg.after(since, &keyframe.pose),
            _ => keyframe.pose,
        }
    }
}

impl Leg {
    /// The pose `since` seconds after leaving `from`: a cubic Hermite curve.
    fn after(&self, since: f64, from: &CameraPose) -> CameraPose {
        let u = (since / self.seconds).min(1.0);
        let [position, turned]: Motion = array::from_fn(|i| {
            u * u * (3.0 - 2.0 * u) * self.moved[i]
                + self.seconds * u * (1.0 - u) * ((1.0 - u) * self.start[i] - u * self.end[i])
        });
        let [yaw, pitch, roll] = (angles(from) + turned).to_array();
        CameraPose::from_angles(from.position + position, yaw, pitch, roll)
    }

    /// So short that its velocity would mean nothing.
    fn is_cut(&self) -> bool {
        self.seconds < 1e-6
    }

    /// Its motion over its time.
    fn velocity(&self) -> Motion {
        if self.is_cut() { REST } else { self.moved.map(|moved| moved / self.seconds) }
    }
}

fn is_sound(keyframe: &Keyframe) -> bool {
    let CameraPose { position, rotation } = keyframe.pose;
    let times = [keyframe.arrive, keyframe.hold];
    position.is_finite()
        && rotation.is_finite()
        && times.iter().all(|time| (0.0..f64::INFINITY).contains(time))
}

fn angles(pose: &CameraPose) -> DVec3 {
    DVec3::from(pose.rotation.to_euler(EulerRot::YXZ))
}

fn legs(keyframes: &[Keyframe], looped: bool) -> Vec<Leg> {
    let count = keyframes.len();
    let mut legs: Vec<Leg> = (0..if looped { count } else { count - 1 })
        .map(|k| {
            let (from, to) = (&keyframes[k], &keyframes[(k + 1) % count]);
            let turned = angles(&to.pose) - angles(&from.pose);
            let moved = [to.pose.position - from.pose.position, turned - TAU * (turned / TAU).round()];
            Leg { seconds: to.arrive, easing: to.easing, moved, start: REST, end: REST }
        })
        .collect();
    for (k, keyframe) in keyframes.iter().enumerate() {
        let before = if k > 0 { Some(k - 1) } else { looped.then_some(count - 1) };
        let after = (k < legs.len()).then_some(k);
        let passing = match (before, after) {
            (Some(before), Some(after)) if keyframe.hold == 0.0 => passing(&legs[before], &legs[after]),
            _ => None,
        };
        if let Some(before) = before {
            let leg = &mut legs[before];
            leg.end = at_end(leg, Easing::In, passing);
        }
        if let Some(after) = after {
            let leg = &mut legs[after];
            leg.start = at_end(leg, Easing::Out, passing);
        }
    }
    legs
}

/// The velocity of `leg` at one of its ends, where the camera is `passing` with a velocity or rests; `abrupt` is the
/// easing that is at full speed there also next to a rest.
fn at_end(leg: &Leg, abrupt: Easing, passing: Option<Motion>) -> Motion {
    match passing {
        _ if leg.easing == Easing::Linear => leg.velocity(),
        Some(velocity) => velocity,
        // Twice the mean makes the way quadratic in time: evenly faster, or evenly slower.
        None if leg.easing == abrupt => leg.velocity().map(|mean| 2.0 * mean),
        None => REST,
    }
}

/// The velocity at a keyframe between two legs; `None` where the camera rests.
fn passing(before: &Leg, after: &Leg) -> Option<Motion> {
    if before.is_cut() || after.is_cut() || before.easing == Easing::Out || after.easing == Easing::In {
        return None;
    }
    let (arriving, leaving) = (before.velocity(), after.velocity());
    Some(match (before.easing, after.easing) {
        // A straight leg keeps its speed; the curve beside it joins on.
        (Easing::Linear, _) => arriving,
        (_, Easing::Linear) => leaving,
        _ => array::from_fn(|i| {
            // The slope of the parabola through the three keyframes.
            let share = after.seconds / (before.seconds + after.seconds);
            let slope = arriving[i] * share + leaving[i] * (1.0 - share);
            slope.clamp_length_max(HASTE * arriving[i].length().min(leaving[i].length()))
        }),
    })
}

#[cfg(test)]
#[path = "path_tests.rs"]
mod tests;
