//! What cannot be: a thing whose mirror image would hide what the water shows there.
//!
//! Supports reach over outlines, and votes carry the shift of a tree to what is seen between its branches. Where the
//! mirror image of something farther off was matched, nothing nearer is mirrored: the water shows the nearest thing
//! there is. The other way round says nothing: what is farther off may well be hidden by what is matched.

use rayon::prelude::*;

use super::levels::{Shifts, TRUSTED};
use super::view::View;

/// Shifts differ when they do by more than this many pixels and this part of the larger: a slope, or an error, may be
/// as much.
const SAME_PX: f32 = 1.0;
const SAME_PART: f32 = 0.1;

/// Takes the confidence from voted shifts whose mirror image would hide something that was `matched` there.
pub(super) fn without_hiding(view: &View, matched: &Shifts, mut voted: Shifts) -> Shifts {
    let seen = seen_in_water(view, matched);
    let Shifts { shift, confidence, .. } = &mut voted;
    confidence.par_iter_mut().enumerate().for_each(|(cell, confidence)| {
        let shift = shift[cell];
        // Where nothing was matched there is NaN, which is not less.
        let hides = |mirrored: usize| seen[mirrored] < shift * (1.0 - SAME_PART) - SAME_PX;
        if mirror(view, cell, shift).is_some_and(hides) {
            *confidence = 0.0;
        }
    });
    voted
}

/// The shift of what each pixel of the water was matched with, that of the nearest if of several; NaN where there is none.
fn seen_in_water(view: &View, matched: &Shifts) -> Vec<f32> {
    let mut seen = vec![f32::NAN; view.kinds.len()];
    for (cell, (&shift, &confidence)) in matched.shift.iter().zip(&matched.confidence).enumerate() {
        if confidence >= TRUSTED
            && let Some(mirrored) = mirror(view, cell, shift)
        {
            // Of a number and NaN this is the number.
            seen[mirrored] = seen[mirrored].max(shift);
        }
    }
    seen
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

    fn confidence(matched: &[((usize, f32), f32)], voted: (usize, f32)) -> f32 {
        let found = without_hiding(&view(), &shifts(matched), shifts(&[(voted, 0.8)]));
        assert_eq!(found.shift[voted.0 * WIDTH + 1], voted.1, "only the confidence changes");
        found.confidence[voted.0 * WIDTH + 1]
    }

    #[test]
    fn nothing_hides_what_the_water_shows() {
        assert_eq!(confidence(&[(FAR, 0.9)], NEAR), 0.0);
        assert_eq!(confidence(&[(FAR, 0.3)], NEAR), 0.8, "what may be chance is no sight");
        assert_eq!(confidence(&[(FAR, 0.9), (NEAR, 0.9)], NEAR), 0.8, "the nearer of two is seen");
    }

    #[test]
    fn what_is_hidden_itself_may_be_true() {
        assert_eq!(confidence(&[(NEAR, 0.9)], FAR), 0.8);
        assert_eq!(confidence(&[], FAR), 0.8, "nothing was seen there");
    }

    #[test]
    fn a_slope_hides_nothing() {
        // One row and one pixel of shift farther: 39 − 15 + 9 is the same row of the water.
        assert_eq!(confidence(&[((15, 9.0), 0.9)], NEAR), 0.8);
        assert_eq!(confidence(&[((14, 8.0), 0.9)], NEAR), 0.8, "as much as is let pass");
        assert_eq!(confidence(&[((13, 7.0), 0.9)], NEAR), 0.0);
    }

    #[test]
    fn what_has_no_place_in_the_picture_is_left_alone() {
        assert_eq!(confidence(&[(FAR, 0.9)], (16, 1e9)), 0.8);
        assert_eq!(confidence(&[((3, -1e9), 0.9)], NEAR), 0.8);
    }
}
