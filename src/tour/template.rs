//! The file that `picture-tour new` writes: a tour to start from, with comments that tell what to fill in.

use glam::UVec2;

use super::Tour;

impl Tour {
    /// A tour file for a picture of `size` pixels: a guessed horizon and water, the rest as comments.
    ///
    /// It reads as it is when `picture_file` is a safe path and both sides are at least 20 pixels long.
    #[must_use]
    pub fn template(picture_file: &str, size: UVec2) -> String {
        let (width, height) = (f64::from(size.x), f64::from(size.y));
        let at = |x: f64, y: f64| format!("({:.0}, {:.0})", x * width, y * height);
        let text = include_str!("template.ron");
        let values = [
            ("$FILE", format!("{picture_file:?}")),
            ("$SIZE", format!("({}, {})", size.x, size.y)),
            ("$HORIZON_LEFT", at(0.0, 0.45)),
            ("$HORIZON_RIGHT", at(1.0, 0.45)),
            ("$SHORE_LEFT", at(0.0, 0.55)),
            ("$SHORE_RIGHT", at(1.0, 0.55)),
            ("$BOTTOM_LEFT", at(0.0, 1.0)),
            ("$BOTTOM_RIGHT", at(1.0, 1.0)),
            ("$FOCAL", format!("{:.0}", 0.9 * width.max(height))),
            ("$POINT", at(0.5, 0.40)),
            ("$REFLECTION", at(0.5, 0.65)),
            ("$FOOT_LEFT", at(0.4, 0.7)),
            ("$FOOT_RIGHT", at(0.6, 0.7)),
        ];
        values.iter().fold(text.to_owned(), |text, (name, value)| text.replace(name, value))
    }
}
