//! The solver's numbers in words: units that people use, and how sure they are.

use crate::solve::{Label, ParameterReport};

use super::egui::Color32;
use super::text::Text;
use super::theme;

/// Length of the longer side of the frame in which focal lengths are told, millimeters.
const FILM_MM: f64 = 36.0;

/// A focal length in millimeters of a 36 mm wide frame, for a picture whose longer side has so many pixels.
pub(super) fn millimeters(focal_px: f64, long_side: f64) -> f64 {
    focal_px * FILM_MM / long_side
}

/// A focal length in pixels.
pub(super) fn pixels(millimeters: f64, long_side: f64) -> f64 {
    millimeters * long_side / FILM_MM
}

/// The horizontal field of view in degrees of a centered picture.
pub(super) fn field_of_view(focal_px: f64, width: f64) -> f64 {
    2.0 * (width / 2.0 / focal_px).atan().to_degrees()
}

/// The focal length in pixels that has a field of view.
pub(super) fn focal_of_view(degrees: f64, width: f64) -> f64 {
    width / 2.0 / (degrees.to_radians() / 2.0).tan()
}

/// What a parameter is called.
pub(super) fn name(parameter: &str, t: &Text) -> &'static str {
    match parameter {
        "focal_px" => t.report.focal_length,
        "pitch" => t.report.pitch,
        "roll" => t.report.roll,
        "height" => t.report.height,
        "ground_height" => t.report.ground_height,
        "background_distance" => t.report.background_distance,
        _ => t.report.other,
    }
}

/// A parameter's value and deviation with its unit, as `35.2 mm ± 1.4 (63°)`.
pub(super) fn value(report: &ParameterReport, width: f64, height: f64) -> String {
    let (scale, unit) = match report.name {
        "focal_px" => (FILM_MM / width.max(height), "mm"),
        "pitch" | "roll" => (1.0_f64.to_degrees(), "°"),
        _ => (1.0, "m"),
    };
    let space = if unit == "°" { "" } else { " " };
    let value = report.value * scale;
    let deviation = report.deviation.map(|deviation| deviation * scale).filter(|deviation| *deviation > 0.0);
    let decimals = decimals(deviation.unwrap_or(value.abs() / 100.0));
    let mut words = format!("{value:.decimals$}");
    if let Some(deviation) = deviation {
        words += &format!(" ± {deviation:.decimals$}");
    }
    words += space;
    words += unit;
    if report.name == "focal_px" {
        words += &format!("  ({:.0}°)", field_of_view(report.value, width));
    }
    words
}

/// Decimals that show two digits of a deviation.
fn decimals(deviation: f64) -> usize {
    (1.0 - deviation.max(1e-9).log10().floor()).clamp(0.0, 3.0) as usize
}

/// How sure a parameter is, in a word and a color; a given one says so.
pub(super) fn trust(report: &ParameterReport, t: &Text) -> (&'static str, Color32) {
    match report.label {
        _ if report.from.first() == Some(&"given") => (t.report.given, theme::ACCENT),
        Label::Measured => (t.report.measured, theme::GOOD),
        Label::Weak => (t.report.weak, theme::ROUGH),
        Label::Assumed => (t.report.assumed, theme::BAD),
    }
}

/// A remark as a sentence: a capital letter first, a full stop last.
pub(super) fn sentence(remark: &str) -> String {
    let mut letters = remark.chars();
    let Some(first) = letters.next() else { return String::new() };
    let end = if remark.ends_with(['.', '?', '!']) { "" } else { "." };
    first.to_uppercase().chain(letters).collect::<String>() + end
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(name: &'static str, value: f64, deviation: Option<f64>) -> ParameterReport {
        ParameterReport { name, value, deviation, label: Label::Weak, from: Vec::new() }
    }

    #[test]
    fn numbers_have_the_units_people_use_and_no_more_digits_than_they_are_worth() {
        let focal = report("focal_px", 1000.0, Some(50.0));
        assert_eq!(value(&focal, 1000.0, 600.0), "36.0 ± 1.8 mm  (53°)");
        assert_eq!(value(&report("pitch", -0.05, Some(0.001)), 1000.0, 600.0), "-2.865 ± 0.057°");
        assert_eq!(value(&report("height", 1.7, None), 1000.0, 600.0), "1.700 m");
        assert_eq!(value(&report("background_distance", 84.3, Some(12.0)), 1e3, 6e2), "84 ± 12 m");
    }

    #[test]
    fn focal_length_and_field_of_view_are_each_other_s_inverse() {
        for degrees in [20.0, 53.13, 100.0] {
            let back = field_of_view(focal_of_view(degrees, 1920.0), 1920.0);
            assert!((back - degrees).abs() < 1e-9, "{degrees}° came back as {back}°");
        }
        assert!((pixels(millimeters(812.0, 1920.0), 1920.0) - 812.0).abs() < 1e-9);
    }

    #[test]
    fn remarks_become_sentences() {
        assert_eq!(sentence("the picture looks level: type it"), "The picture looks level: type it.");
        assert_eq!(sentence("was it cropped?"), "Was it cropped?");
    }
}
