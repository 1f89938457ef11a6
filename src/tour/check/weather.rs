//! Checks of wind, waves and the camera's path.

use super::super::relative_path::RelativePath;
use super::super::weather::{MOST_FRAMES, Sea, counted_up};
use super::Check;

impl Check<'_> {
    pub(super) fn wind(&mut self) {
        let wind = self.file.wind;
        self.numbers(
            "wind",
            &[
                ("speed", Some(wind.speed), 0.0..=60.0, "m/s"),
                ("direction_deg", Some(wind.direction_deg), -360.0..=360.0, "degrees"),
                ("gusts", Some(wind.gusts), 0.0..=1.0, ""),
                ("period_seconds", Some(wind.period_seconds), 4.0..=120.0, "seconds"),
            ],
        );
    }

    pub(super) fn waves(&mut self) {
        let path = "waves.sea";
        match &self.file.waves.sea {
            Sea::Calm => {}
            Sea::Octaves(octaves) => self.numbers(
                path,
                &[
                    ("max_height", octaves.max_height, 0.0..=10.0, "meters"),
                    ("wavelength", octaves.wavelength, 0.1..=300.0, "meters"),
                    ("octaves", Some(f64::from(octaves.octaves)), 1.0..=12.0, ""),
                    ("speed_factor", Some(octaves.speed_factor), 0.0..=4.0, ""),
                    ("direction_deg", octaves.direction_deg, -360.0..=360.0, "degrees"),
                ],
            ),
            Sea::Jonswap(jonswap) => self.numbers(
                path,
                &[
                    ("max_height", jonswap.max_height, 0.0..=10.0, "meters"),
                    ("peak_period_seconds", jonswap.peak_period_seconds, 0.3..=20.0, "seconds"),
                    ("depth", Some(jonswap.depth), 0.05..=10_000.0, "meters"),
                    ("spreading", Some(jonswap.spreading), 1.0..=30.0, ""),
                    ("direction_deg", jonswap.direction_deg, -360.0..=360.0, "degrees"),
                ],
            ),
            Sea::Recorded(frames) => {
                self.numbers(
                    path,
                    &[
                        ("count", Some(f64::from(frames.count)), 1.0..=f64::from(MOST_FRAMES), "frames"),
                        ("frames_per_second", Some(frames.frames_per_second), 1.0..=240.0, ""),
                        ("height", Some(frames.height), 1e-4..=100.0, "meters"),
                        ("area[0]", Some(frames.area.0), 0.1..=1e5, "meters"),
                        ("area[1]", Some(frames.area.1), 0.1..=1e5, "meters"),
                    ],
                );
                let is_path = RelativePath::new(&frames.first).is_ok();
                if is_path && counted_up(&frames.first, frames.count.saturating_sub(1)).is_none() {
                    self.report(
                        "waves.sea.first",
                        format!("\"{}\"", frames.first),
                        "the file's name has no digits that count up",
                        "write the first frame's file, as \"sea/0001.png\"",
                    );
                }
            }
        }
    }

    pub(super) fn journey(&mut self) {
        let Some(path) = &self.file.path else { return };
        if path.keyframes.is_empty() {
            let advice = "add `(position: (0, 1.7, 0), seconds: 0)`, or leave out `path`";
            self.report("path.keyframes", "", "the path has no keyframes", advice);
        }
        for (i, key) in path.keyframes.iter().enumerate() {
            let place = format!("path.keyframes[{i}]");
            let position = format!("{place}.position");
            if !key.position.is_finite() || key.position.abs().max_element() > 1e5 {
                self.report(
                    position,
                    key.position,
                    "this is no position",
                    "write three finite numbers (x, y, z), in meters",
                );
            } else if key.position.y <= 0.0 {
                self.report(
                    position,
                    key.position,
                    "the camera would be under water",
                    "write y above 0, the height above the water in meters",
                );
            }
            self.numbers(
                &place,
                &[
                    ("yaw_deg", Some(key.yaw_deg), -3600.0..=3600.0, "degrees"),
                    ("pitch_deg", Some(key.pitch_deg), -90.0..=90.0, "degrees"),
                    ("roll_deg", Some(key.roll_deg), -360.0..=360.0, "degrees"),
                    ("seconds", Some(key.seconds), 0.0..=3600.0, "seconds"),
                    ("hold", Some(key.hold), 0.0..=3600.0, "seconds"),
                ],
            );
        }
    }
}
