//! One wind for trees, clouds and water, and the waves it raises.
//!
//! Directions are compass-like on the water: 0 towards +x (right), 90 towards −z (into the picture). The default is the
//! still picture.

use serde::{Deserialize, Serialize};

use super::relative_path::RelativePath;

/// The most frames of a recorded sea: in memory they take 256 MiB.
pub const MOST_FRAMES: u32 = 4096;

/// The wind over the whole tour.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Wind {
    /// Meters per second, 0 to 60; 0 is the still picture.
    pub speed: f64,
    /// Where it blows to, degrees: 0 to the right, 90 into the picture.
    pub direction_deg: f64,
    /// How much it varies, 0 (steady) to 1.
    pub gusts: f64,
    /// Seed of every random choice.
    pub seed: u64,
    /// Time after which waves and plants repeat, 4 to 120 seconds. Short shows the repetition, long costs memory.
    pub period_seconds: f64,
}

impl Default for Wind {
    fn default() -> Self {
        Self { speed: 0.0, direction_deg: 0.0, gusts: 0.3, seed: 0, period_seconds: 20.0 }
    }
}

/// What moves the water besides bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Waves<P = RelativePath> {
    /// The waves of the wind.
    #[serde(default, skip_serializing_if = "Sea::is_calm")]
    pub sea: Sea<P>,
    /// Whether touches and bodies make ripples.
    #[serde(default = "yes")]
    pub ripples: bool,
}

impl<P> Default for Waves<P> {
    fn default() -> Self {
        Self { sea: Sea::Calm, ripples: true }
    }
}

impl<P> Waves<P> {
    /// Whether this is the default: no waves of the wind, ripples on.
    #[must_use]
    pub fn is_default(&self) -> bool {
        self.sea.is_calm() && self.ripples
    }
}

/// The waves of the wind.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Sea<P = RelativePath> {
    /// None.
    #[default]
    Calm,
    /// A few octaves of sines.
    Octaves(Octaves),
    /// A sea of many waves with the JONSWAP spectrum.
    Jonswap(Jonswap),
    /// Height fields made by another simulator.
    Recorded(RecordedSea<P>),
}

impl<P> Sea<P> {
    /// Whether there are no waves of the wind.
    #[must_use]
    pub fn is_calm(&self) -> bool {
        matches!(self, Self::Calm)
    }
}

/// Waves as octaves of sines.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Octaves {
    /// Significant height, 0 to 10 meters; from the wind when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_height: Option<f64>,
    /// Longest wavelength, 0.1 to 300 meters; from the wind when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wavelength: Option<f64>,
    /// How many octaves, 1 to 12.
    pub octaves: u32,
    /// How fast they run compared with water waves, 0 to 4.
    pub speed_factor: f64,
    /// Where they run to; with the wind when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction_deg: Option<f64>,
}

impl Default for Octaves {
    fn default() -> Self {
        Self { max_height: None, wavelength: None, octaves: 5, speed_factor: 1.0, direction_deg: None }
    }
}

/// Waves with the JONSWAP spectrum over water of finite depth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Jonswap {
    /// Significant height, 0 to 10 meters; from the wind when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_height: Option<f64>,
    /// Period of the highest waves, 0.3 to 20 seconds; from the wind when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_period_seconds: Option<f64>,
    /// Depth of the water, 0.05 to 10 000 meters.
    pub depth: f64,
    /// How closely waves keep to their direction, 1 (wide) to 30 (narrow).
    pub spreading: f64,
    /// Where they run to; with the wind when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction_deg: Option<f64>,
}

impl Default for Jonswap {
    fn default() -> Self {
        Self { max_height: None, peak_period_seconds: None, depth: 20.0, spreading: 4.0, direction_deg: None }
    }
}

/// Height fields made by another simulator, one 16-bit gray picture a frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordedSea<P = RelativePath> {
    /// The first frame's file; the last digits of its name count up by one a frame. Gray of 16 bits, or OpenEXR.
    pub first: P,
    /// How many frames, 1 to 4096.
    pub count: u32,
    /// 1 to 240.
    pub frames_per_second: f64,
    /// Meters between black and white, above 0; middle gray is the resting water. Of OpenEXR, meters that 1 stands for.
    pub height: f64,
    /// Width (x) and depth (z) of the water that a frame covers, meters: from x = −width/2 to width/2, and from z = 0 at its
    /// lower edge to −depth at its upper one. It repeats beyond.
    pub area: (f64, f64),
}

impl RecordedSea {
    /// The file of a frame, from 0; `None` where `first` has no digits that count so far.
    #[must_use]
    pub fn frame(&self, index: u32) -> Option<RelativePath> {
        RelativePath::new(&counted_up(self.first.as_str(), index)?).ok()
    }
}

/// A path with the last digits of its file's name counted up, none of them lost; by 0 any path is itself.
pub(super) fn counted_up(path: &str, by: u32) -> Option<String> {
    if by == 0 {
        return Some(path.to_owned());
    }
    let name = path.rfind('/').map_or(0, |slash| slash + 1);
    let stem_end = path[name..].rfind('.').map_or(path.len(), |dot| name + dot);
    let end =
        path[name..stem_end].rfind(|letter: char| letter.is_ascii_digit()).map(|last| name + last + 1)?;
    let start = path[name..end].rfind(|letter: char| !letter.is_ascii_digit());
    let start =
        start.map_or(name, |last| name + last + path[name + last..].chars().next().map_or(1, char::len_utf8));
    let digits = &path[start..end];
    let number = digits.parse::<u64>().ok()?.checked_add(by.into())?;
    Some(format!("{}{number:0width$}{}", &path[..start], &path[end..], width = digits.len()))
}

fn yes() -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_digits_of_a_file_s_name_count_up() {
        for (first, by, expected) in [
            ("sea/0001.png", 1, Some("sea/0002.png")),
            ("sea/0001.png", 299, Some("sea/0300.png")),
            ("sea/98.png", 3, Some("sea/101.png")),
            ("v2/wave_09_half.exr", 1, Some("v2/wave_10_half.exr")),
            ("Höhe7ü3.png", 8, Some("Höhe7ü11.png")),
            ("a.b/7", 2, Some("a.b/9")),
            ("take2/sea.png", 0, Some("take2/sea.png")),
            ("take2/sea.png", 1, None),
            ("sea.mp4", 1, None),
            ("99999999999999999999.png", 1, None),
        ] {
            assert_eq!(counted_up(first, by).as_deref(), expected, "{first} by {by}");
        }
    }
}
