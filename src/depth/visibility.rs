//! What the water shows, and what that rules out: a thing whose mirror image would hide what is seen there.
//!
//! Supports reach over outlines, and carry the shift of a tree to what is seen between its branches. Where the mirror
//! image of something farther off was matched, nothing nearer is mirrored: the water shows the nearest thing there is.
//! The other way round says little: what is farther off than what was matched there is hidden by it.

use super::levels::{Shifts, TRUSTED};
use super::view::View;

/// Shifts differ when they do by more than this many pixels and this part of the larger: a slope, or an error, may be
/// as much.
const SAME_PX: f32 = 1.0;
const SAME_PART: f32 = 0.1;

/// What the water says of a pixel and a shift.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sight {
    /// Nothing against it: the water shows that shift there, or what it shows was not matched.
    Open,
    /// Something nearer hides its mirror image.
    Hidden,
    /// Its mirror image would hide something that is seen there.
    Hiding,
}

/// The shift of what each pixel of the water was matched with.
#[derive(Debug)]
pub(super) struct Seen<'a> {
    view: &'a View,
    /// That of the nearest if of several; NaN where there is none.
    shift: Vec<f32>,
}

impl<'a> Seen<'a> {
    /// What was `matched` more likely than not.
    pub(super) fn of(view: &'a View, matched: &Shifts) -> Self {
        let mut seen = vec![f32::NAN; view.kinds.len()];
        for (cell, (&shift, &confidence)) in matched.shift.iter().zip(&matched.confidence).enumerate() {
            if confidence >= TRUSTED
                && let Some(mirrored) = mirror(view, cell, shift)
            {
                // Of a number and NaN this is the number.
                seen[mirrored] = seen[mirrored].max(shift);
            }
        }
        Self { view, shift: seen }
    }

    /// What is seen where a pixel's mirror image would stand for a shift.
    pub(super) fn sight(&self, cell: usize, shift: f32) -> Sight {
        let Some(mirrored) = mirror(self.view, cell, shift) else { return Sight::Open };
        // Where nothing was matched there is NaN, which is neither less nor more.
        let seen = self.shift[mirrored];
        if seen < shift * (1.0 - SAME_PART) - SAME_PX {
            Sight::Hiding
        } else if shift < seen * (1.0 - SAME_PART) - SAME_PX {
            Sight::Hidden
        } else {
            Sight::Open
        }
    }
}

/// The pixel in which a pixel's mirror image stands for a shift.
fn mirror(view: &View, cell: usize, shift: f32) -> Option<usize> {
    if shift.is_nan() {
        return None;
    }
    let row = usize::try_from(view.mirror_row(cell / view.width, shift.round() as isize)).ok()?;
    (row < view.height).then(|| row * view.width + cell % view.width)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::depth::view::Kind;

    const WIDTH: usize = 3;
    /// A row, and with its shift the row 39 − 16 + 10 = 39 − 10 + 4 that mirrors both.
    const NEAR: (usize, f32) = (16, 10.0);
    const FAR: (usize, f32) = (10, 4.0);

    /// Forty rows, the horizon in the middle.
    fn view() -> View {
        let count = WIDTH * 40;
        let kind = |cell: usize| if cell < count / 2 { Kind::Direct } else { Kind::Water };
        View {
            width: WIDTH,
            height: 40,
            horizon: 20,
            gray: vec![100.0; count],
            channels: std::array::from_fn(|_| vec![100.0; count]),
            kinds: (0..count).map(kind).collect(),
        }
    }

    /// Shifts that are known in the middle column alone.
    fn shifts(known: &[((usize, f32), f32)]) -> Shifts {
        let mut shifts = Shifts {
            shift: vec![f32::NAN; WIDTH * 40],
            deviation: vec![0.2; WIDTH * 40],
            confidence: vec![0.0; WIDTH * 40],
        };
        for &((row, shift), confidence) in known {
            shifts.shift[row * WIDTH + 1] = shift;
            shifts.confidence[row * WIDTH + 1] = confidence;
        }
        shifts
    }

    fn sight(matched: &[((usize, f32), f32)], (row, shift): (usize, f32)) -> Sight {
        Seen::of(&view(), &shifts(matched)).sight(row * WIDTH + 1, shift)
    }

    #[test]
    fn nothing_hides_what_the_water_shows() {
        assert_eq!(sight(&[(FAR, 0.9)], NEAR), Sight::Hiding);
        assert_eq!(sight(&[(FAR, 0.3)], NEAR), Sight::Open, "what may be chance is no sight");
        assert_eq!(sight(&[(FAR, 0.9), (NEAR, 0.9)], NEAR), Sight::Open, "the nearer of two is seen");
    }

    #[test]
    fn what_is_farther_is_hidden() {
        assert_eq!(sight(&[(NEAR, 0.9)], FAR), Sight::Hidden);
        assert_eq!(sight(&[], FAR), Sight::Open, "nothing was seen there");
    }

    #[test]
    fn a_slope_hides_nothing() {
        // One row and one pixel of shift farther: 39 − 15 + 9 is the same row of the water.
        assert_eq!(sight(&[((15, 9.0), 0.9)], NEAR), Sight::Open);
        assert_eq!(sight(&[((14, 8.0), 0.9)], NEAR), Sight::Open, "as much as is let pass");
        assert_eq!(sight(&[((13, 7.0), 0.9)], NEAR), Sight::Hiding);
        assert_eq!(sight(&[(NEAR, 0.9)], (14, 8.0)), Sight::Open);
        assert_eq!(sight(&[(NEAR, 0.9)], (13, 7.0)), Sight::Hidden);
    }

    #[test]
    fn what_has_no_place_in_the_picture_is_left_alone() {
        assert_eq!(sight(&[(FAR, 0.9)], (16, 1e9)), Sight::Open);
        assert_eq!(sight(&[((3, -1e9), 0.9)], NEAR), Sight::Open);
        assert_eq!(sight(&[(FAR, 0.9)], (16, f32::NAN)), Sight::Open);
    }
}
