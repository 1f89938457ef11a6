//! A band's upper border behind something wide: it goes on from one side to the other, or level where only one side is
//! seen.

use glam::IVec2;

use super::Grid;
use super::visible::HIDDEN;

/// A side's border is the median of so many columns' nearest to what hides it, as a part of the width.
const COLUMNS: usize = 60;

/// Covers what `hidden` hides of a band below its border, over runs of more than `least` columns that do not show that
/// border. Where such a run shows the band to be missing, it ended somewhere behind, and nothing is covered.
///
/// `own` is what is seen of the band; `whole`, with what is guessed of it, has the picture's box.
pub(super) fn prolong(
    whole: &mut Grid<u8>,
    own: &Grid<u8>,
    hidden: &Grid<u8>,
    least: i32,
    is_above: impl Fn(IVec2) -> bool,
) {
    let size = whole.size.as_ivec2();
    let is_known = |pixel: IVec2| hidden.get(pixel).is_some_and(|hidden| u32::from(hidden) < HIDDEN);
    let is_shown = |pixel: IVec2| own.get(pixel).is_some_and(|own| own > 127);
    // Where a column shows where the band begins, with what is above it.
    let tops: Vec<Option<i32>> = (0..size.x)
        .map(|x| {
            let pixel = |y: i32| IVec2::new(x, y);
            let first = (0..size.y).find(|&y| is_known(pixel(y)) && is_shown(pixel(y)));
            first.filter(|&y| y == 0 || is_known(pixel(y - 1)))
        })
        .collect();
    let mut begin = 0;
    while begin < size.x {
        if tops[begin as usize].is_some() {
            begin += 1;
            continue;
        }
        let run = tops[begin as usize..].iter().take_while(|top| top.is_none()).count();
        let end = begin + run as i32;
        let left = border(tops[..begin as usize].iter().rev(), size.x);
        let right = border(tops[end as usize..].iter(), size.x);
        let sides = left.or(right).zip(right.or(left)).filter(|_| end - begin > least);
        if let Some((left, right)) = sides {
            let top = |x: i32| left + (right - left) * (x - begin) as f32 / (end - begin) as f32;
            // Neither a jagged border nor water before a foot that is known roughly reaches the third quarter.
            let is_missing = |x: i32| {
                let foot = (0..size.y).rev().find(|&y| is_above(IVec2::new(x, y))).unwrap_or(-1) as f32;
                let [from, to] = [0.5, 0.75].map(|part| (top(x) + part * (foot - top(x))).round() as i32);
                (from.max(0)..=to).map(|y| IVec2::new(x, y)).any(|at| is_known(at) && !is_shown(at))
            };
            if !(begin..end).any(is_missing) {
                cover(whole, begin..end, &top, |pixel| !is_known(pixel) && is_above(pixel));
            }
        }
        begin = end;
    }
}

/// The row at which a side's border stands, by its nearest columns.
fn border<'a>(tops: impl Iterator<Item = &'a Option<i32>>, width: i32) -> Option<f32> {
    let most = (width as usize / COLUMNS).max(1);
    let mut rows: Vec<i32> = tops.flatten().copied().take(most).collect();
    rows.sort_unstable();
    rows.get(rows.len() / 2).map(|&row| row as f32)
}

/// Covers columns from `top` down, wherever `may` says so.
fn cover(
    whole: &mut Grid<u8>,
    columns: std::ops::Range<i32>,
    top: &dyn Fn(i32) -> f32,
    may: impl Fn(IVec2) -> bool,
) {
    for x in columns {
        let top = top(x);
        for y in (top.floor() as i32).max(0)..whole.size.y as i32 {
            let pixel = IVec2::new(x, y);
            let Some(cell) = whole.index(pixel).filter(|_| may(pixel)) else { continue };
            let covered = (255.0 * (y as f32 + 1.0 - top).clamp(0.0, 1.0)).round() as u8;
            whole.cells[cell] = whole.cells[cell].max(covered);
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::UVec2;

    use super::*;

    const SIZE: UVec2 = UVec2::new(200, 60);

    /// A band over rows 20 to 39, its border 10 rows lower from column 120 on, of which columns 40 to 139 are hidden;
    /// what is covered behind that in a column, as its first and last row.
    fn covered(
        is_hidden: impl Fn(IVec2) -> bool + Sync,
        is_band: impl Fn(IVec2) -> bool + Sync,
    ) -> impl Fn(i32) -> [i32; 2] {
        let hidden = Grid::from_fn(IVec2::ZERO, SIZE, |pixel| if is_hidden(pixel) { 255 } else { 0 });
        let own = |pixel: IVec2| !is_hidden(pixel) && is_band(pixel);
        let own = Grid::from_fn(IVec2::ZERO, SIZE, |pixel| if own(pixel) { 255 } else { 0 });
        let mut whole = own.clone();
        prolong(&mut whole, &own, &hidden, 64, |pixel| pixel.y < 40);
        move |x| {
            let is = |y: &i32| whole.get(IVec2::new(x, *y)).is_some_and(|covered| covered > 127);
            [(0..60).find(is).unwrap_or(-1), (0..60).rev().find(is).unwrap_or(-1)]
        }
    }

    fn band(pixel: IVec2) -> bool {
        pixel.y < 40 && pixel.y >= if pixel.x < 120 { 20 } else { 30 }
    }

    #[test]
    fn behind_something_wide_a_border_goes_on_from_side_to_side() {
        let found = covered(|pixel| (40..140).contains(&pixel.x) && pixel.y > 5, band);
        assert_eq!([40, 90, 139].map(&found), [[20, 39], [25, 39], [30, 39]]);
        assert_eq!([10, 170].map(&found), [[20, 39], [30, 39]], "what is seen stays");
    }

    #[test]
    fn seen_at_one_side_a_border_goes_on_level() {
        let found = covered(|pixel| pixel.x < 100, band);
        assert_eq!([0, 50, 99].map(&found), [[20, 39]; 3]);
    }

    #[test]
    fn what_is_seen_to_end_is_not_prolonged() {
        let found = covered(|pixel| (40..140).contains(&pixel.x), |pixel| band(pixel) && pixel.x < 90);
        assert_eq!([50, 100, 160].map(&found), [[-1, -1]; 3]);
    }
}
