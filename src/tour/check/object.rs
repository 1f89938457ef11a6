//! Checks of names, objects and their motions.

use std::collections::HashMap;

use super::super::object::{Course, Floating, Motion, Object, Support, Sway};
use super::{Check, RESERVED};

impl Check<'_> {
    /// Names of objects and bands: there, unlike each other, not reserved.
    pub(super) fn names(&mut self) {
        let file = self.file;
        let objects =
            file.objects.iter().enumerate().map(|(i, object)| (format!("objects[{i}].name"), &object.name));
        let bands = file
            .background
            .bands
            .iter()
            .enumerate()
            .map(|(i, band)| (format!("background.bands[{i}].name"), &band.name));
        let mut seen: HashMap<&str, String> = HashMap::new();
        for (path, name) in objects.chain(bands) {
            if name.trim().is_empty() {
                self.report(
                    path.as_str(),
                    format!("{name:?}"),
                    "the name is empty",
                    "write a name, as \"boat\"",
                );
            } else if RESERVED.contains(&name.as_str()) {
                let message = "the name is taken by a part of every tour";
                self.report(path.as_str(), format!("{name:?}"), message, "write another name");
            } else if let Some(first) = seen.get(name.as_str()) {
                let message = format!("{first} has the same name");
                self.report(
                    path.as_str(),
                    format!("{name:?}"),
                    message,
                    "write a name that nothing else has",
                );
            }
            seen.entry(name).or_insert(path);
        }
    }

    pub(super) fn objects(&mut self) {
        for (i, object) in self.file.objects.iter().enumerate() {
            let path = format!("objects[{i}]");
            self.support(&path, object);
            self.region(&format!("{path}.outline"), &object.outline);
            self.feet(&format!("{path}.contact"), object);
            let motion = format!("{path}.motion");
            match &object.motion {
                Motion::Sway(sway) => self.sway(&motion, sway),
                Motion::Floating(floating) => self.floating(&motion, floating),
                Motion::Course(course) => self.course(&motion, course),
                Motion::Static | Motion::Recorded(_) => {}
            }
            let afloat = matches!(object.motion, Motion::Floating(_) | Motion::Course(_));
            if afloat && object.support == Support::Ground {
                self.report(
                    motion,
                    "",
                    "what stands on the ground cannot float",
                    "write `support: Water`, or another motion",
                );
            }
        }
    }

    fn support(&mut self, path: &str, object: &Object<String>) {
        let (missing, what) = match object.support {
            Support::Water => (self.file.water.is_none(), "water"),
            Support::Ground => (self.file.ground.is_none(), "ground"),
        };
        if missing {
            let message = format!("\"{}\" stands on {what}, but there is no `{what}`", object.name);
            let advice = format!("mark the {what}, or write the other support");
            self.report(format!("{path}.support"), format!("{:?}", object.support), message, advice);
        }
    }

    fn feet(&mut self, path: &str, object: &Object<String>) {
        let what = format!("the foot of \"{}\"", object.name);
        let [left, right] = object.contact;
        if self.contact_line(path, &object.contact, &what) && left.x() >= right.x() {
            let value = format!("({left}, {right})");
            let message = "the left foot is not to the left of the right one";
            self.report(path, value, message, "write the left foot first, and the two apart");
        }
    }

    fn sway(&mut self, path: &str, sway: &Sway) {
        let mut sound = true;
        for (name, point) in [("root", sway.root), ("tip", sway.tip)] {
            if let Some(point) = point {
                sound &= self.point(format!("{path}.{name}"), point);
            }
        }
        if sound && sway.root.is_some() && sway.root == sway.tip {
            self.report(
                format!("{path}.tip"),
                "",
                "root and tip are the same point",
                "mark the tip at the far end",
            );
        }
        self.numbers(
            path,
            &[
                ("frequency_hz", sway.frequency_hz, 0.02..=10.0, "hertz"),
                ("damping", sway.damping, 0.01..=1.0, ""),
                ("amplitude", sway.amplitude, 0.0..=0.2, "of the length"),
                ("period_seconds", sway.period_seconds, 4.0..=120.0, "seconds"),
            ],
        );
    }

    fn floating(&mut self, path: &str, floating: &Floating) {
        self.numbers(
            path,
            &[
                ("draft", Some(floating.draft), 0.01..=20.0, "meters"),
                ("length", floating.length, 0.1..=400.0, "meters"),
                ("beam", floating.beam, 0.1..=100.0, "meters"),
                ("mass", floating.mass, 0.1..=1e9, "kilograms"),
                ("heave_damping", floating.heave_damping, 0.01..=2.0, ""),
                ("roll_damping", floating.roll_damping, 0.01..=2.0, ""),
                ("heave_period_seconds", floating.heave_period_seconds, 0.2..=60.0, "seconds"),
                ("roll_period_seconds", floating.roll_period_seconds, 0.2..=60.0, "seconds"),
            ],
        );
    }

    fn course(&mut self, path: &str, course: &Course) {
        self.numbers(
            path,
            &[
                ("speed", Some(course.speed), 0.01..=30.0, "m/s"),
                ("draft", Some(course.draft), 0.01..=20.0, "meters"),
                ("length", course.length, 0.1..=400.0, "meters"),
            ],
        );
        let place = format!("{path}.waypoints");
        if course.waypoints.len() < 2 {
            let message =
                format!("a course needs two points or more, this one has {}", course.waypoints.len());
            self.report(place.as_str(), "", message, "add points (x, z) on the water, in meters");
        }
        for (i, point) in course.waypoints.iter().enumerate() {
            let good = point.0.is_finite() && point.0.abs().max_element() <= 1e5;
            if !good {
                let message = "this is no point on the water";
                self.report(
                    format!("{place}[{i}]"),
                    point.0,
                    message,
                    "write two finite numbers (x, z), in meters",
                );
            } else if i > 0 && course.waypoints[i - 1] == *point {
                let message = "the course stays on one point";
                self.report(
                    format!("{place}[{i}]"),
                    point.0,
                    message,
                    "leave out the second of two like points",
                );
            }
        }
    }
}
