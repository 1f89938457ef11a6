//! Painting and erasing on a mask.
//!
//! A stroke covers by the distance to its polyline, not by dabs, so it shows no beads, and going over the same place
//! again changes nothing: a stroke painted piece by piece as the pointer moves is the stroke painted at once.

use glam::UVec2;

use super::stroke::{block_near_line, for_each_near};
use crate::picture::{Mask, PicturePoint, PixelRect};
use crate::tour::edit::MaskPatch;

/// What a brush does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BrushMode {
    /// Adds coverage.
    Paint,
    /// Takes coverage away.
    Erase,
}

/// A round brush.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    /// Where its effect ends, pixels from its middle; used as 0.5–4096, 0.5 when not finite.
    pub radius: f64,
    /// Share of the radius with full effect, 0–1; beyond it the effect falls smoothly. Even the hardest brush has an edge
    /// of one pixel. 1 when not finite.
    pub hardness: f64,
    /// What it does.
    pub mode: BrushMode,
}

impl Brush {
    /// The radius as it is used, pixels.
    fn reach(&self) -> f64 {
        if self.radius.is_finite() { self.radius.clamp(0.5, 4096.0) } else { 0.5 }
    }

    /// Effect at a distance from the middle of the stroke, 0–255.
    fn effect(&self, distance: f64) -> u8 {
        let hardness = if self.hardness.is_finite() { self.hardness.clamp(0.0, 1.0) } else { 1.0 };
        let reach = self.reach();
        // Falls to one half at the middle of the soft rim; the rim of the hardest brush is a pixel wide around the radius.
        let soft = (reach * (1.0 - hardness)).max(1.0);
        let end = reach.max(reach * hardness + 0.5);
        let share = ((end - distance) / soft).clamp(0.0, 1.0);
        (share * share * (3.0 - 2.0 * share) * 255.0).round() as u8
    }
    /// Draws along a polyline (one point: a dab): what the mask shows afterwards in the smallest block that changes, pixels;
    /// `None` when nothing does. Points that are not finite are left out.
    ///
    /// Takes time and memory for the block around the polyline alone, however large the mask.
    #[must_use]
    pub fn draw(&self, mask: &Mask, points: &[PicturePoint]) -> Option<MaskPatch> {
        let reach = self.reach() + 1.0;
        let block = block_near_line(mask.size(), points, reach)?;
        let (mut drawn, width) = (mask.block(block)?, block.size().x);
        let mut changed: Option<PixelRect> = None;
        for_each_near(mask.size(), points, reach, |x, y, distance| {
            let pixel = UVec2::new(x, y) - block.min;
            let value = &mut drawn[(pixel.y * width + pixel.x) as usize];
            let effect = self.effect(distance);
            let new = match self.mode {
                BrushMode::Paint => (*value).max(effect),
                BrushMode::Erase => (*value).min(255 - effect),
            };
            if new != *value {
                *value = new;
                let rect = changed.get_or_insert(PixelRect { min: pixel, max: pixel + 1 });
                (rect.min, rect.max) = (rect.min.min(pixel), rect.max.max(pixel + 1));
            }
        });
        let changed = changed?;
        let values = Mask::new(block.size(), drawn).ok()?.block(changed)?;
        MaskPatch::new(PixelRect { min: block.min + changed.min, max: block.min + changed.max }, &values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tour::TourFile;
    use crate::tour::edit::{Draft, Edit};

    const SIZE: UVec2 = UVec2::new(120, 80);

    /// A draft's mask that is painted on, as the studio does.
    #[derive(Clone, PartialEq)]
    struct Canvas(Draft);

    impl Canvas {
        fn mask(&self) -> &Mask {
            self.0.masks.get("mask.png").unwrap()
        }

        fn values(&self) -> &[u8] {
            self.mask().values()
        }

        /// Draws, and gives the block that was told to change.
        fn draw(&mut self, brush: &Brush, points: &[PicturePoint]) -> Option<PixelRect> {
            let patch = brush.draw(self.mask(), points)?;
            let rect = patch.rect();
            Edit::Paint { name: "mask.png".into(), patch }.apply(&mut self.0).unwrap();
            Some(rect)
        }
    }

    fn canvas(value: u8) -> Canvas {
        let mut draft = Draft::new(TourFile::new("lake.png".into()));
        draft.masks.load("mask.png", Mask::new(SIZE, vec![value; 9600]).unwrap());
        Canvas(draft)
    }

    fn points(points: &[(f64, f64)]) -> Vec<PicturePoint> {
        points.iter().map(|(x, y)| PicturePoint::new(*x, *y)).collect()
    }

    const SOFT: Brush = Brush { radius: 9.0, hardness: 0.4, mode: BrushMode::Paint };

    #[test]
    fn a_stroke_has_no_beads() {
        let mut canvas = canvas(0);
        canvas.draw(&SOFT, &points(&[(15.0, 40.0), (40.0, 40.0), (41.0, 40.0), (105.0, 40.0)]));
        for y in 0..80 {
            let row: Vec<u8> = (15..105).map(|x| canvas.values()[y * 120 + x]).collect();
            assert!(row.iter().all(|value| *value == row[0]), "row {y} is uneven: {row:?}");
        }
        assert_eq!(canvas.values()[40 * 120 + 60], 255);
        assert!((1..255).contains(&canvas.values()[46 * 120 + 60]));
        assert_eq!(canvas.values()[50 * 120 + 60], 0);
    }

    #[test]
    fn piece_by_piece_is_at_once() {
        let line = points(&[(10.0, 10.0), (50.0, 33.0), (55.0, 60.0), (90.0, 20.0)]);
        let [mut whole, mut pieces] = [canvas(0), canvas(0)];
        whole.draw(&SOFT, &line);
        for piece in line.windows(2) {
            pieces.draw(&SOFT, piece);
        }
        assert!(whole == pieces);
    }

    #[test]
    fn a_stroke_tells_the_smallest_block_that_changed() {
        let before = canvas(180);
        let mut canvas = before.clone();
        let erase = Brush { radius: 6.0, hardness: 1.0, mode: BrushMode::Erase };
        let stroke = points(&[(30.0, 30.0), (60.0, 40.0), (40.0, 45.0)]);
        let rect = canvas.draw(&erase, &stroke).unwrap();
        let changed: Vec<UVec2> = (0..SIZE.element_product())
            .filter(|i| canvas.values()[*i as usize] != before.values()[*i as usize])
            .map(|i| UVec2::new(i % SIZE.x, i / SIZE.x))
            .collect();
        let min = changed.iter().copied().reduce(UVec2::min).unwrap();
        let max = changed.iter().copied().reduce(UVec2::max).unwrap() + 1;
        assert_eq!((rect.min, rect.max), (min, max));
        assert!(min.cmpge(UVec2::new(23, 23)).all() && max.cmple(UVec2::new(67, 52)).all(), "{rect:?}");
        assert_eq!(canvas.draw(&erase, &stroke), None, "nothing is left to erase there");
    }

    #[test]
    fn a_hard_dab_has_its_radius_and_bad_numbers_do_no_harm() {
        let mut canvas = canvas(0);
        let hard = Brush { radius: 20.0, hardness: 1.0, mode: BrushMode::Paint };
        canvas.draw(&hard, &points(&[(60.0, 40.0)]));
        let area = canvas.values().iter().map(|value| f64::from(*value) / 255.0).sum::<f64>();
        let disc = std::f64::consts::PI * 400.0;
        assert!((area - disc).abs() < 0.01 * disc, "{area} against {disc}");
        assert!(canvas.draw(&hard, &points(&[(f64::NAN, 3.0), (1e300, 1e300)])).is_none());
        let odd = Brush { radius: f64::NAN, hardness: f64::INFINITY, mode: BrushMode::Erase };
        assert!(canvas.draw(&odd, &points(&[(60.0, 40.0)])).is_some());
    }
}
