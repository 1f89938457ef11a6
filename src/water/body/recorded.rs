//! Poses made by another simulator: a JSON list of times and poses, joined by straight lines.
//!
//! `[{"seconds": 0, "position": [0, 0, 0], "yaw_deg": 0, "pitch_deg": 0, "roll_deg": 0}, …]`, relative to where the body
//! rests: meters in tour space; yaw to the left, pitch bow up, roll starboard down. Angles left out are 0.

use glam::DVec3;
use serde::Deserialize;

use super::super::rounds::{RoundError, haste_of_recording};
use super::pose::BodyPose;
use super::wrapped;

/// One pose as written.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    seconds: f64,
    position: DVec3,
    #[serde(default)]
    yaw_deg: f64,
    #[serde(default)]
    pitch_deg: f64,
    #[serde(default)]
    roll_deg: f64,
}

/// Why a list of poses cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PosesError {
    /// The file does not read.
    #[error(
        "the poses do not read: {0}; write a list of {{\"seconds\", \"position\": [x, y, z], \"yaw_deg\", \"pitch_deg\", \"roll_deg\"}}"
    )]
    Unreadable(#[from] serde_json::Error),
    /// There is no pose.
    #[error("the list of poses is empty; write at least one")]
    Empty,
    /// A number that is none.
    #[error("pose {index} has a {what} of {value}; write a finite number")]
    NoNumber {
        /// Its index, from 0.
        index: usize,
        /// Which of its numbers.
        what: &'static str,
        /// The number.
        value: f64,
    },
    /// Times must grow.
    #[error("pose {index} is at {seconds} s, not after the one before at {before} s; sort the poses by time")]
    Unsorted {
        /// Its index, from 0.
        index: usize,
        /// Its time.
        seconds: f64,
        /// The time of the pose before.
        before: f64,
    },
}

/// Poses by time: at least one, all finite, times growing.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedPoses {
    poses: Vec<(f64, BodyPose)>,
    looped: bool,
    /// How much faster time runs than it should, to fit a loop.
    haste: f64,
}

impl RecordedPoses {
    /// Reads a JSON list of poses.
    ///
    /// # Errors
    ///
    /// When it does not read, is empty, holds a number that is not finite, or its times do not grow.
    pub fn from_json(json: &str, looped: bool) -> Result<Self, PosesError> {
        let entries: Vec<Entry> = serde_json::from_str(json)?;
        let poses: Vec<(f64, BodyPose)> = entries.iter().map(|entry| (entry.seconds, entry.pose())).collect();
        Self::new(poses, looped)
    }

    /// Poses with their times in seconds. Looped ones go on from the last to the first as to the same moment, so
    /// the two should be alike.
    ///
    /// # Errors
    ///
    /// When there is none, a number is not finite, or times do not grow.
    pub fn new(poses: Vec<(f64, BodyPose)>, looped: bool) -> Result<Self, PosesError> {
        if poses.is_empty() {
            return Err(PosesError::Empty);
        }
        for (index, (seconds, pose)) in poses.iter().enumerate() {
            let numbers = [
                ("time", *seconds),
                ("position x", pose.position.x),
                ("position y", pose.position.y),
                ("position z", pose.position.z),
                ("yaw", pose.yaw),
                ("pitch", pose.pitch),
                ("roll", pose.roll),
                ("mirrored share", pose.mirrored_share),
            ];
            if let Some((what, value)) = numbers.into_iter().find(|(_, value)| !value.is_finite()) {
                return Err(PosesError::NoNumber { index, what, value });
            }
        }
        for (i, pair) in poses.windows(2).enumerate() {
            let [before, seconds] = [pair[0].0, pair[1].0];
            if seconds <= before {
                return Err(PosesError::Unsorted { index: i + 1, seconds, before });
            }
        }
        Ok(Self { poses, looped, haste: 1.0 })
    }

    /// The same poses, so much faster or slower that a whole number of rounds takes `loop_seconds`. A single pose stays.
    ///
    /// # Errors
    ///
    /// When they do not start over, or would have to run more than twice as fast.
    pub fn with_whole_rounds(&self, loop_seconds: f64) -> Result<Self, RoundError> {
        let duration = self.duration();
        if duration == 0.0 {
            return Ok(self.clone());
        }
        if !self.looped {
            return Err(RoundError::NoRounds);
        }
        Ok(Self { haste: haste_of_recording(duration, loop_seconds)?, ..self.clone() })
    }

    /// Whether the pose is the same at any time.
    #[must_use]
    pub fn is_still(&self) -> bool {
        self.poses.iter().all(|(_, pose)| *pose == self.poses[0].1)
    }

    fn duration(&self) -> f64 {
        self.poses[self.poses.len() - 1].0 - self.poses[0].0
    }

    /// The pose at a time: angles turn the shorter way. Outside of the recording the nearer end holds, or it starts over.
    /// For a billboard, see [`BodyPose::faced`].
    #[must_use]
    pub fn at(&self, seconds: f64) -> BodyPose {
        let (start, first) = self.poses[0];
        let (_, last) = self.poses[self.poses.len() - 1];
        let duration = self.duration();
        let time = if self.looped && duration > 0.0 {
            // Reduced by the round itself, so that loops close to the bit.
            let within = seconds.rem_euclid(duration / self.haste) * self.haste;
            start + (within - start).rem_euclid(duration)
        } else {
            seconds
        };
        if time.is_nan() || time <= start {
            return first;
        }
        let next = self.poses.partition_point(|&(at, _)| at <= time);
        let Some(&(to, after)) = self.poses.get(next) else { return last };
        let (from, before) = self.poses[next - 1];
        between(&before, &after, (time - from) / (to - from))
    }
}

impl Entry {
    fn pose(&self) -> BodyPose {
        BodyPose {
            position: self.position,
            yaw: self.yaw_deg.to_radians(),
            pitch: self.pitch_deg.to_radians(),
            roll: self.roll_deg.to_radians(),
            mirrored_share: 0.0,
        }
    }
}

/// The pose a part of the way from one to the other.
fn between(before: &BodyPose, after: &BodyPose, part: f64) -> BodyPose {
    let angle = |from: f64, to: f64| from + part * wrapped(to - from);
    BodyPose {
        position: before.position.lerp(after.position, part),
        yaw: angle(before.yaw, after.yaw),
        roll: angle(before.roll, after.roll),
        pitch: angle(before.pitch, after.pitch),
        mirrored_share: before.mirrored_share + part * (after.mirrored_share - before.mirrored_share),
    }
}
