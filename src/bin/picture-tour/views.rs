//! The JSON file of `--views`: a list of places to look from.

use std::collections::HashMap;
use std::path::Path;

use bevy_picture_tour::camera::CameraPose;
use glam::DVec3;
use serde::Deserialize;
use serde_json::Value;

use crate::failure::Failure;

/// Longest file name that is made of a view's name, characters.
const LONGEST_NAME: usize = 100;

/// One view of the file, as it is written there.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ViewEntry {
    name: String,
    /// Meters, world space.
    position: [f64; 3],
    #[serde(default)]
    yaw_deg: f64,
    #[serde(default)]
    pitch_deg: f64,
    #[serde(default)]
    roll_deg: f64,
}

/// A place to look from, and what its frame is called.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct View {
    /// A safe file name without its ending; no two views of a file have the same.
    pub(crate) name: String,
    /// Where the camera stands and looks.
    pub(crate) pose: CameraPose,
}

/// Reads the views of a file.
pub(crate) fn read(path: &Path) -> Result<Vec<View>, Failure> {
    let place = path.display();
    let text = std::fs::read_to_string(path).map_err(|error| {
        Failure::CannotRun(format!("the views {place} cannot be read ({error}); check the path"))
    })?;
    parse(&text).map_err(|reason| Failure::CannotRun(format!("{place}: {reason}")))
}

/// Reads the views of a file's text; errors name the entry by its index from 0.
fn parse(text: &str) -> Result<Vec<View>, String> {
    let entries: Vec<Value> = serde_json::from_str(text.trim_start_matches('\u{feff}')).map_err(|error| {
        format!(
            "this is no JSON list of views ({error}); write [{{\"name\": \"left\", \"position\": [-1, 1.8, 0]}}]"
        )
    })?;
    if entries.is_empty() {
        return Err("the list holds no view; write one, or leave out --views".to_owned());
    }
    let mut taken = HashMap::new();
    let views = entries.into_iter().enumerate().map(|(index, entry)| {
        let view = view(entry).map_err(|reason| format!("views[{index}]: {reason}"))?;
        // Some file systems take no notice of case.
        match taken.insert(view.name.to_lowercase(), index) {
            None => Ok(view),
            Some(other) => Err(format!(
                "views[{index}] and views[{other}] would both be written to {}.png; give one another name",
                view.name
            )),
        }
    });
    views.collect()
}

fn view(entry: Value) -> Result<View, String> {
    let entry: ViewEntry = serde_json::from_value(entry)
        .map_err(|error| format!("{error}; a view has `name`, `position` and, if not 0, the three angles"))?;
    let name = file_name(&entry.name)
        .ok_or_else(|| format!("the name {:?} makes no file name; use letters or digits", entry.name))?;
    let position = DVec3::from(entry.position);
    let angles = [entry.yaw_deg, entry.pitch_deg, entry.roll_deg];
    if !position.is_finite() || !angles.iter().all(|angle| angle.is_finite()) {
        return Err("a position or an angle is not a finite number; write meters and degrees".to_owned());
    }
    if position.y <= 0.0 {
        return Err(format!(
            "position[1] is {}; write the camera's height above the water, above 0",
            position.y
        ));
    }
    let [yaw, pitch, roll] = angles.map(f64::to_radians);
    Ok(View { name, pose: CameraPose::from_angles(position, yaw, pitch, roll) })
}

/// A file name made of `name`, without ending; `None` when nothing of it can be used.
fn file_name(name: &str) -> Option<String> {
    let name = name.trim();
    let name = name.strip_suffix(".png").unwrap_or(name);
    let safe = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    let safe: String = name.chars().map(safe).take(LONGEST_NAME).collect();
    // A leading dot would hide the file.
    let safe = safe.trim_matches('.');
    safe.contains(char::is_alphanumeric).then(|| safe.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_that_are_left_out_are_zero() {
        let views = parse(r#"[{"name": "a b.png", "position": [1, 2, -3]}]"#).unwrap();
        let pose = CameraPose::from_angles(DVec3::new(1.0, 2.0, -3.0), 0.0, 0.0, 0.0);
        assert_eq!(views, [View { name: "a_b".to_owned(), pose }]);
    }

    #[test]
    fn a_name_cannot_leave_the_folder() {
        assert_eq!(file_name("../../etc/passwd").as_deref(), Some("_.._etc_passwd"));
        assert_eq!(file_name(".."), None);
        assert_eq!(file_name(" "), None);
        assert_eq!(file_name("вид 1").as_deref(), Some("вид_1"));
    }

    #[test]
    fn what_is_wrong_is_told_with_its_index() {
        let good = r#"{"name": "a", "position": [0, 1, 0]}"#;
        for (text, told) in [
            ("[", "no JSON list"),
            ("{}", "no JSON list"),
            (r#"[{"name": "a", "position": [NaN, 1, 0]}]"#, "no JSON list"),
            ("[]", "holds no view"),
            (&format!("[{good}, {good}]"), "views[1] and views[0]"),
            (&format!(r#"[{good}, {{"name": "A!", "position": [0, 1]}}]"#), "views[1]: "),
            (r#"[{"name": "a", "position": [0, 1, 0], "yaw": 3}]"#, "unknown field `yaw`"),
            (r#"[{"name": "a", "position": [0, -1, 0]}]"#, "above 0"),
            (r#"[{"name": "a", "position": [0, 1, 1e999]}]"#, "out of range"),
        ] {
            let error = parse(text).unwrap_err();
            assert!(error.contains(told), "{text} gave {error:?}, which lacks {told:?}");
        }
    }
}
