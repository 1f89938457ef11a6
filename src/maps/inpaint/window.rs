//! The part of a picture that a fill looks at: the holes and enough around them.
//!
//! What is cut out has a margin of a patch's radius on all sides, so that no patch around an inner cell
//! leaves it.

use super::Cell;
use super::patch::RADIUS;

/// Cells around the holes at least.
const MARGIN: usize = 96;

/// Source cells per hole cell that are worth looking at.
const PLENTY: usize = 6;

/// A rectangle of a picture's cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    picture_width: usize,
    left: usize,
    top: usize,
    width: usize,
    height: usize,
}

impl Window {
    /// The smallest window with all holes and plenty of sources, or all of the picture; `None` without holes.
    pub(super) fn around_holes(width: usize, cells: &[Cell]) -> Option<Self> {
        let height = cells.len().checked_div(width)?;
        let (mut low, mut high, mut holes) = ((width, height), (0, 0), 0);
        for (y, row) in cells.chunks_exact(width).enumerate() {
            for (x, cell) in row.iter().enumerate() {
                if *cell == Cell::Hole {
                    low = (low.0.min(x), low.1.min(y));
                    high = (high.0.max(x + 1), high.1.max(y + 1));
                    holes += 1;
                }
            }
        }
        if holes == 0 {
            return None;
        }
        let mut margin = MARGIN.max((high.0 - low.0).max(high.1 - low.1) / 2);
        loop {
            let (left, top) = (low.0.saturating_sub(margin), low.1.saturating_sub(margin));
            let window = Self {
                picture_width: width,
                left,
                top,
                width: (high.0 + margin).min(width) - left,
                height: (high.1 + margin).min(height) - top,
            };
            let whole = window.width == width && window.height == height;
            let sources =
                || window.cut(cells, Cell::Foreign).iter().filter(|cell| **cell == Cell::Source).count();
            if whole || sources() >= PLENTY * holes {
                return Some(window);
            }
            margin *= 2;
        }
    }

    /// Width of what is cut out.
    pub(super) fn cut_width(self) -> usize {
        self.width + 2 * RADIUS
    }

    /// The window's part of a picture, surrounded by `margin`.
    pub(super) fn cut<T: Copy>(self, picture: &[T], margin: T) -> Vec<T> {
        let mut cut = vec![margin; self.cut_width() * (self.height + 2 * RADIUS)];
        for (y, row) in cut.chunks_exact_mut(self.cut_width()).skip(RADIUS).take(self.height).enumerate() {
            let from = (self.top + y) * self.picture_width + self.left;
            row[RADIUS..RADIUS + self.width].copy_from_slice(&picture[from..from + self.width]);
        }
        cut
    }

    /// Where an inner cell of what was cut out lies in the picture.
    pub(super) fn in_picture(self, cell: usize) -> usize {
        let (x, y) = (cell % self.cut_width() - RADIUS, cell / self.cut_width() - RADIUS);
        (self.top + y) * self.picture_width + self.left + x
    }
}
