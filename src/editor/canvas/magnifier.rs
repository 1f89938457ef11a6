//! The magnifier beside a dragged handle: the picture several times larger, with a cross at the exact point.

use crate::picture::PicturePoint;

use super::super::egui::{
    Align2, Color32, CornerRadius, FontId, Painter, Pos2, Rect, Stroke, StrokeKind, Vec2,
};
use super::super::{PictureView, theme};
use super::frame::{Frame, magnified};

/// Side of the magnifier, points.
const SIDE: f32 = 148.0;
/// How far it stays from the finger or pointer, points.
const AWAY: f32 = 40.0;
/// Least picture pixels from its middle to its side.
const LEAST_PIXELS: f64 = 9.0;

/// Where the magnifier stands: above and left of the pointer, on the other side where there is no room.
fn place(pointer: Pos2, screen: Rect) -> Rect {
    let beside = |at: f32, low: f32, high: f32| {
        let before = at - AWAY - SIDE;
        if before >= low { before } else { (at + AWAY).min(high - SIDE) }
    };
    let min = Pos2::new(
        beside(pointer.x, screen.left(), screen.right()),
        beside(pointer.y, screen.top(), screen.bottom()),
    );
    Rect::from_min_size(min, Vec2::splat(SIDE))
}

/// Draws the surroundings of `at`, which is dragged by the pointer.
pub(super) fn draw(painter: &Painter, frame: Frame, picture: PictureView, at: PicturePoint, pointer: Pos2) {
    let lens = place(pointer, frame.screen);
    // Four times as large as on the canvas, but never so that single pixels fill it.
    let half = (frame.pixels(SIDE) / 8.0).max(LEAST_PIXELS);
    painter.rect_filled(lens, CornerRadius::same(6), theme::BACKDROP);
    if let Some((on_lens, uv)) = magnified(at, half, lens, picture.size.as_dvec2()) {
        painter.image(picture.texture, on_lens, uv, Color32::WHITE);
    }
    let center = lens.center();
    for (from, to) in [(5.0, 18.0), (-18.0, -5.0)] {
        for axis in [Vec2::X, Vec2::Y] {
            let ends = [center + axis * from, center + axis * to];
            painter.line_segment(ends, Stroke::new(3.0, theme::HALO));
            painter.line_segment(ends, Stroke::new(1.0, theme::HORIZON));
        }
    }
    painter.rect_stroke(lens, CornerRadius::same(6), Stroke::new(1.5, theme::LINE), StrokeKind::Outside);
    let text = format!("{:.1}, {:.1}", at.x(), at.y());
    let font = FontId::monospace(11.0);
    let base = lens.center_bottom() - Vec2::new(0.0, 4.0);
    painter.text(base + Vec2::splat(1.0), Align2::CENTER_BOTTOM, &text, font.clone(), theme::BACKDROP);
    painter.text(base, Align2::CENTER_BOTTOM, &text, font, theme::TEXT);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_magnifier_is_on_the_canvas_and_not_under_the_finger() {
        let screen = Rect::from_min_size(Pos2::new(300.0, 80.0), Vec2::new(480.0, 560.0));
        for x in 0..=12 {
            for y in 0..=12 {
                let part = Vec2::new(x as f32, y as f32) / 12.0;
                let pointer = screen.min + screen.size() * part;
                let lens = place(pointer, screen);
                assert!(screen.contains_rect(lens), "{lens} leaves {screen} at {pointer}");
                assert!(lens.distance_to_pos(pointer) >= AWAY - 1.0, "{lens} hides {pointer}");
            }
        }
    }
}
