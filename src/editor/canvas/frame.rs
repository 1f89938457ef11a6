//! How the picture lies on the screen: zoom about a point, pan, fit.
//!
//! Screen positions are egui points. The canvas may show what lies outside the picture, since marks may lie there, but
//! the picture can never be pushed out of reach.

use glam::DVec2;

use crate::picture::PicturePoint;

use crate::editor::egui::{Pos2, Rect, Vec2, pos2};

/// Least and greatest zoom, as screen points per picture pixel.
const ZOOMS: [f64; 2] = [0.01, 64.0];
/// Part of the canvas that a fitted picture leaves free at each side.
const MARGIN: f64 = 0.03;

/// What the canvas looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Eye {
    /// What is in the middle of the canvas, picture pixels.
    pub(super) center: DVec2,
    /// Screen points per picture pixel, above 0.
    pub(super) zoom: f64,
}

/// The canvas on the screen, and what it looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) screen: Rect,
    pub(super) eye: Eye,
}

impl Eye {
    /// Shows everything between two corners.
    pub(super) fn fit(screen: Rect, min: DVec2, max: DVec2) -> Self {
        let size = (max - min).max(DVec2::ONE);
        let room = DVec2::new(f64::from(screen.width()), f64::from(screen.height())) * (1.0 - 2.0 * MARGIN);
        Self { center: (min + max) / 2.0, zoom: (room / size).min_element().clamp(ZOOMS[0], ZOOMS[1]) }
    }

    /// Keeps the middle of the canvas within one picture's size of the picture.
    fn kept_near(self, size: DVec2) -> Self {
        Self { center: self.center.clamp(-size, 2.0 * size), ..self }
    }
}

impl Frame {
    pub(super) fn to_screen(self, point: PicturePoint) -> Pos2 {
        let off = (point.0 - self.eye.center) * self.eye.zoom;
        self.screen.center() + Vec2::new(off.x as f32, off.y as f32)
    }

    pub(super) fn to_picture(self, at: Pos2) -> PicturePoint {
        let off = at - self.screen.center();
        PicturePoint(self.eye.center + DVec2::new(off.x.into(), off.y.into()) / self.eye.zoom)
    }

    /// A length on the screen in picture pixels.
    pub(super) fn pixels(self, points: f32) -> f64 {
        f64::from(points) / self.eye.zoom
    }

    /// The picture's rectangle on the screen.
    pub(super) fn picture_rect(self, size: DVec2) -> Rect {
        Rect::from_two_pos(self.to_screen(PicturePoint(DVec2::ZERO)), self.to_screen(PicturePoint(size)))
    }

    /// The eye after zooming by a factor, what lies under `about` staying there.
    pub(super) fn zoomed(self, factor: f64, about: Pos2, size: DVec2) -> Eye {
        let zoom = (self.eye.zoom * factor).clamp(ZOOMS[0], ZOOMS[1]);
        let under = self.to_picture(about).0;
        Eye { center: under + (self.eye.center - under) * (self.eye.zoom / zoom), zoom }.kept_near(size)
    }

    /// The eye after the picture was moved by a way on the screen.
    pub(super) fn panned(self, by: Vec2, size: DVec2) -> Eye {
        let by = DVec2::new(by.x.into(), by.y.into()) / self.eye.zoom;
        Eye { center: self.eye.center - by, ..self.eye }.kept_near(size)
    }
}

/// The part of a texture that shows a part of the picture, and where on the screen, for a square magnifier.
///
/// `None` when the picture is not in it at all.
pub(super) fn magnified(at: PicturePoint, half_pixels: f64, lens: Rect, size: DVec2) -> Option<(Rect, Rect)> {
    let (low, high) = (at.0 - half_pixels, at.0 + half_pixels);
    let (from, to) = (low.max(DVec2::ZERO), high.min(size));
    if (from.cmpge(to)).any() {
        return None;
    }
    let on_lens = |point: DVec2| {
        let part = (point - low) / (high - low);
        pos2(lens.left() + lens.width() * part.x as f32, lens.top() + lens.height() * part.y as f32)
    };
    let on_texture = |point: DVec2| pos2((point.x / size.x) as f32, (point.y / size.y) as f32);
    let rect = |f: &dyn Fn(DVec2) -> Pos2| Rect::from_min_max(f(from), f(to));
    Some((rect(&on_lens), rect(&on_texture)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: DVec2 = DVec2::new(1000.0, 500.0);

    fn frame() -> Frame {
        let screen = Rect::from_min_max(pos2(100.0, 50.0), pos2(900.0, 650.0));
        Frame { screen, eye: Eye::fit(screen, DVec2::ZERO, SIZE) }
    }

    #[test]
    fn a_fitted_picture_is_whole_and_in_the_middle() {
        let frame = frame();
        let rect = frame.picture_rect(SIZE);
        assert!(frame.screen.contains_rect(rect), "{rect} is not in {}", frame.screen);
        assert!((rect.center() - frame.screen.center()).length() < 1e-3);
        assert!(rect.width() > 0.9 * frame.screen.width());
    }

    #[test]
    fn zooming_keeps_what_is_under_the_pointer() {
        let mut frame = frame();
        let about = pos2(220.0, 300.0);
        let before = frame.to_picture(about);
        for factor in [1.3, 2.0, 0.7] {
            frame.eye = frame.zoomed(factor, about, SIZE);
            let after = frame.to_picture(about);
            assert!(after.0.distance(before.0) < 1e-3, "{before} became {after}");
        }
    }

    #[test]
    fn the_picture_cannot_be_lost() {
        let mut frame = frame();
        for _ in 0..100 {
            frame.eye = frame.panned(Vec2::new(500.0, -300.0), SIZE);
        }
        frame.eye = frame.zoomed(1e9, frame.screen.center(), SIZE);
        assert!(frame.eye.center.abs().max_element() <= 2000.0 && frame.eye.zoom <= 64.0, "{:?}", frame.eye);
    }

    #[test]
    fn the_magnifier_shows_only_the_picture() {
        let lens = Rect::from_min_max(pos2(0.0, 0.0), pos2(100.0, 100.0));
        let (on_lens, uv) = magnified(PicturePoint::new(0.0, 250.0), 10.0, lens, SIZE).unwrap();
        assert_eq!(on_lens, Rect::from_min_max(pos2(50.0, 0.0), pos2(100.0, 100.0)));
        assert_eq!(uv.left(), 0.0);
        assert!((uv.right() - 0.01).abs() < 1e-6);
        assert_eq!(magnified(PicturePoint::new(-20.0, 0.0), 10.0, lens, SIZE), None);
    }
}
