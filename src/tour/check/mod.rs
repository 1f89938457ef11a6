//! Finds every problem of a document, not the first.
//!
//! Each check reports and goes on; one that needs sound values to make sense is silent when they are not, since their own
//! check has reported them.

mod annotation;
mod object;
mod weather;

pub(super) use annotation::{crop_problem, dry_reflections};

use std::fmt::Display;
use std::ops::RangeInclusive;

use crate::picture::PicturePoint;

use super::annotation::Region;
use super::file::{TourFile, VERSION};
use super::geometry::{self, HorizonLine};
use super::problem::{Problem, Problems};
use super::relative_path::RelativePath;

/// Corners that a polygon may have: finding crossings takes time with their square.
const MOST_CORNERS: usize = 4096;

/// Picture points may lie outside the frame, but not further than this, pixels.
const FARTHEST: f64 = 1e6;

/// Names that mean something else than an object.
const RESERVED: [&str; 4] = ["water", "ground", "background", "sky"];

/// Every problem of a document.
pub(super) fn problems(file: &TourFile) -> Vec<Problem> {
    let horizon = file.camera.horizon.and_then(HorizonLine::through);
    let mut check = Check { file, horizon, problems: Vec::new() };
    check.version();
    check.picture();
    check.camera();
    check.water();
    check.ground();
    check.background();
    check.sky();
    check.names();
    check.objects();
    check.wind();
    check.waves();
    check.journey();
    let unsafe_paths = file.files().into_iter().filter_map(|(place, path)| safe_path(&place, &path).err());
    check.problems.into_iter().chain(unsafe_paths.flat_map(|Problems(problems)| problems)).collect()
}

/// A path that stays in the tour's folder.
pub(super) fn safe_path(place: &str, text: &str) -> Result<RelativePath, Problems> {
    RelativePath::new(text).map_err(|why| {
        let advice = "write a path below the tour's folder with forward slashes, as \"masks/boat.png\"";
        Problem::new(place, format!("{text:?}"), why.to_string(), advice).into()
    })
}

/// The document under check and what was found.
struct Check<'a> {
    file: &'a TourFile,
    /// The horizon, when one is given and sound.
    horizon: Option<HorizonLine>,
    problems: Vec<Problem>,
}

impl Check<'_> {
    fn report(
        &mut self,
        path: impl Into<String>,
        value: impl Display,
        message: impl Into<String>,
        advice: impl Into<String>,
    ) {
        self.problems.push(Problem::new(path, value, message, advice));
    }

    fn version(&mut self) {
        let version = self.file.version;
        if version == 0 {
            self.report(
                "version",
                "",
                "the version of the format is missing",
                format!("write `version: {VERSION}`"),
            );
        } else if version > VERSION {
            let message = format!("the document is of a newer version ({version} > {VERSION})");
            self.report("version", version, message, "update the program to open it");
        }
    }

    /// Whether a number is finite and in its range.
    fn number(
        &mut self,
        path: impl Into<String>,
        value: f64,
        range: RangeInclusive<f64>,
        unit: &str,
    ) -> bool {
        let good = range.contains(&value);
        if !good {
            let message =
                if value.is_finite() { "the number is out of range" } else { "this is no finite number" };
            let space = if unit.is_empty() { "" } else { " " };
            let advice = format!("write a number from {} to {}{space}{unit}", range.start(), range.end());
            self.report(path, value, message, advice);
        }
        good
    }

    /// Checks the numbers of a section that are there.
    fn numbers(&mut self, path: &str, values: &[(&str, Option<f64>, RangeInclusive<f64>, &str)]) {
        for (name, value, range, unit) in values {
            if let Some(value) = value {
                self.number(format!("{path}.{name}"), *value, range.clone(), unit);
            }
        }
    }

    /// Whether a point is finite and not absurdly far from the picture.
    fn point(&mut self, path: impl Into<String>, point: PicturePoint) -> bool {
        let good = point.0.abs().max_element() <= FARTHEST && point.0.is_finite();
        if !good {
            self.report(
                path,
                point,
                "this is no point near the picture",
                "write two finite numbers, pixels from the top left corner",
            );
        }
        good
    }

    /// Whether a point that rests on water or ground lies below the horizon.
    fn below_horizon(&mut self, path: impl Into<String>, point: PicturePoint, what: &str) -> bool {
        let above = self.horizon.map_or(-1.0, |horizon| -horizon.below(point));
        if above >= 0.0 {
            let message = format!(
                "{what} lies {above:.1} px above the horizon, where there is neither water nor ground"
            );
            self.report(path, point, message, "mark it below the horizon, or correct `camera.horizon`");
        }
        above < 0.0
    }

    /// Whether a line on water or ground has enough points, all good.
    fn contact_line(&mut self, path: &str, points: &[PicturePoint], what: &str) -> bool {
        if points.len() < 2 {
            let message = format!("a contact line needs two points or more, this one has {}", points.len());
            self.report(path, "", message, "mark at least its left and right end");
            return false;
        }
        let mut good = true;
        for (i, point) in points.iter().enumerate() {
            let path = format!("{path}[{i}]");
            good &= self.point(path.as_str(), *point) && self.below_horizon(path, *point, what);
        }
        good
    }

    fn region(&mut self, path: &str, region: &Region<String>) {
        match region {
            // Paths are checked all together.
            Region::Mask(_) => {}
            Region::Polygon(corners) => self.polygon(path, corners),
        }
    }

    fn polygon(&mut self, path: &str, corners: &[PicturePoint]) {
        let n = corners.len();
        if n > MOST_CORNERS {
            let message = format!("the polygon has {n} corners, more than {MOST_CORNERS}");
            self.report(path, "", message, "name a `Mask(\"file.png\")` instead");
            return;
        }
        let mut sound = true;
        for (i, corner) in corners.iter().enumerate() {
            sound &= self.point(format!("{path}.Polygon[{i}]"), *corner);
        }
        if n < 3 {
            self.report(
                path,
                "",
                format!("a polygon needs three corners or more, this one has {n}"),
                "add corners, or name a `Mask(\"file.png\")`",
            );
        } else if sound && let Some((i, j)) = geometry::crossing(corners) {
            let message = format!("the polygon crosses itself: the sides after corners {i} and {j}");
            self.report(
                format!("{path}.Polygon[{j}]"),
                corners[j],
                message,
                "put its corners in order around the region",
            );
        } else if sound && geometry::area(corners) < 1.0 {
            self.report(path, "", "the polygon has no area", "spread its corners around the region");
        }
    }
}
