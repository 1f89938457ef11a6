//! Pieces of a label in which nothing was measured at its distance are none of it.

/// Pieces belong together over gaps upwards of one part in so many of the picture's width: what is above stands on what
/// is below.
const GAP: usize = 40;

/// Gives pieces of a label without a seed of it to the label beside them that costs them least, of those that have one;
/// where there is none beside them, of all.
///
/// `cost` is that of a label at a pixel.
pub(super) fn join_pieces(
    width: usize,
    seeds: &[Option<u8>],
    cost: &dyn Fn(usize, usize) -> f32,
    labels: &mut [Option<u8>],
) {
    let (measured, mut open): (Vec<_>, Vec<_>) = pieces(width, labels)
        .into_iter()
        .partition(|piece| piece.iter().any(|&cell| seeds[cell].is_some() && seeds[cell] == labels[cell]));
    let mut is_measured = vec![false; labels.len()];
    measured.iter().flatten().for_each(|&cell| is_measured[cell] = true);
    let mut all: Vec<u8> = measured.iter().filter_map(|piece| labels[piece[0]]).collect();
    all.sort_unstable();
    all.dedup();
    while !open.is_empty() {
        let before = open.len();
        open.retain(|piece| {
            let mut beside: Vec<u8> = Vec::new();
            for &cell in piece {
                for other in around(width, labels.len() / width, cell).filter(|&other| is_measured[other]) {
                    beside.extend(labels[other].filter(|label| !beside.contains(label)));
                }
            }
            let best = cheapest(piece, &beside, cost);
            if let Some(best) = best {
                piece.iter().for_each(|&cell| (labels[cell], is_measured[cell]) = (Some(best), true));
            }
            best.is_none()
        });
        if open.len() == before {
            break;
        }
    }
    for piece in open {
        if let Some(best) = cheapest(&piece, &all, cost) {
            piece.iter().for_each(|&cell| labels[cell] = Some(best));
        }
    }
}

/// The label that costs the cells of a piece least.
fn cheapest(piece: &[usize], labels: &[u8], cost: &dyn Fn(usize, usize) -> f32) -> Option<u8> {
    let total = |label: u8| piece.iter().map(|&cell| f64::from(cost(cell, label.into()))).sum::<f64>();
    labels.iter().copied().min_by(|&a, &b| total(a).total_cmp(&total(b)))
}

/// The cells of each piece: those of one label that touch, or lie above each other over no more than a gap.
fn pieces(width: usize, labels: &[Option<u8>]) -> Vec<Vec<usize>> {
    let (height, gap) = (labels.len() / width, (width / GAP).max(1));
    let mut seen = vec![false; labels.len()];
    let mut found = Vec::new();
    for start in 0..labels.len() {
        let Some(own) = labels[start].filter(|_| !seen[start]) else { continue };
        seen[start] = true;
        let mut piece = vec![start];
        let mut next = 0;
        while let Some(&cell) = piece.get(next) {
            next += 1;
            let is_own = |other: &usize| labels[*other] == Some(own);
            let above = (1..=gap).map_while(|by| cell.checked_sub(by * width)).find(is_own);
            let below =
                (1..=gap).map(|by| cell + by * width).take_while(|&other| other < labels.len()).find(is_own);
            for other in around(width, height, cell).filter(is_own).chain(above).chain(below) {
                if !std::mem::replace(&mut seen[other], true) {
                    piece.push(other);
                }
            }
        }
        found.push(piece);
    }
    found
}

/// The eight cells around one.
fn around(width: usize, height: usize, cell: usize) -> impl Iterator<Item = usize> {
    (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))).filter_map(move |(dx, dy)| {
        let x = (cell % width).checked_add_signed(dx).filter(|&x| x < width)?;
        let y = (cell / width).checked_add_signed(dy).filter(|&y| y < height)?;
        Some(y * width + x)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_in_which_nothing_was_measured_goes_to_its_neighbor() {
        // Two pieces of label 1 in label 0; the lower one was measured. A wide gap parts them, then a narrow one.
        for (rows, joined) in [([2..4, 12..14], true), ([9..11, 12..14], false)] {
            let is_in = |cell: usize| rows.iter().any(|rows| rows.contains(&(cell / 80))) && cell % 80 > 15;
            let mut labels: Vec<Option<u8>> = (0..20 * 80).map(|cell| Some(u8::from(is_in(cell)))).collect();
            let mut seeds = vec![None; 20 * 80];
            (seeds[0], seeds[13 * 80 + 18]) = (Some(0), Some(1));
            let before = labels.clone();
            join_pieces(80, &seeds, &|_, label| label as f32, &mut labels);
            assert!((labels != before) == joined, "over rows {rows:?}");
            assert_eq!(labels[13 * 80 + 18], Some(1), "what was measured stays");
        }
    }

    /// Labels from rows of digits, `.` being none, stretched to 80 columns a character so that a gap may be of two rows.
    fn labels(rows: &[&str]) -> Vec<Option<u8>> {
        let of = |c: char| c.to_digit(10).map(|digit| digit as u8);
        rows.iter().flat_map(|row| row.chars().flat_map(move |c| std::iter::repeat_n(of(c), 20))).collect()
    }

    #[test]
    fn low_pieces_are_joined_over_every_gap_up_to_the_widest() {
        // A crown of one row above a stump of one row, which was measured; a row or two lie between, three are too many.
        for (between, stays) in [(1, true), (2, false), (3, false)] {
            let rows: Vec<&str> =
                ["0000", "0110"].into_iter().chain(vec!["0000"; between]).chain(["0110", "0000"]).collect();
            let mut found = labels(&rows);
            let mut seeds = vec![None; found.len()];
            (seeds[0], seeds[80 * (between + 2) + 30]) = (Some(0), Some(1));
            join_pieces(80, &seeds, &|_, label| label as f32, &mut found);
            assert_eq!(found[80 + 30] == Some(1), stays, "{between} rows between");
        }
    }

    #[test]
    fn no_label_stays_of_which_nothing_was_measured() {
        // 2 has a neighbor that itself has to give way; 3 is an island.
        let mut found = labels(&["0122", "0122", "....", ".33."]);
        let mut seeds = vec![None; found.len()];
        seeds[0] = Some(0);
        join_pieces(80, &seeds, &|_, label| -(label as f32), &mut found);
        assert!(found.iter().flatten().all(|&label| label == 0), "{found:?}");
        assert_eq!(found.iter().flatten().count(), 80 * 2 + 40);
    }
}
