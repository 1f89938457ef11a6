//! Pieces of a label in which nothing was measured at its distance are none of it.

/// Pieces belong together over gaps upwards of one part in so many of the picture's width: what is above stands on what
/// is below.
const GAP: usize = 40;

/// Gives pieces of a label without a seed of it to the label beside them that costs them least.
///
/// `cost` is that of a label at a pixel.
pub(super) fn join_pieces(
    width: usize,
    seeds: &[Option<u8>],
    cost: &dyn Fn(usize, usize) -> f32,
    labels: &mut [Option<u8>],
) {
    let gap = (width / GAP).max(1) as isize;
    let height = labels.len() / width;
    let mut seen = vec![false; labels.len()];
    let mut piece = Vec::new();
    for start in 0..labels.len() {
        let Some(own) = labels[start].filter(|_| !seen[start]) else { continue };
        seen[start] = true;
        piece.clear();
        piece.push(start);
        let mut beside: Vec<u8> = Vec::new();
        let mut next = 0;
        while let Some(&cell) = piece.get(next) {
            next += 1;
            let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
            for (dx, dy) in around.chain([(0, -gap), (0, gap)]) {
                let x = (cell % width).checked_add_signed(dx).filter(|&x| x < width);
                let y = (cell / width).checked_add_signed(dy).filter(|&y| y < height);
                let Some(other) = x.zip(y).map(|(x, y)| y * width + x) else { continue };
                let is_near = dx.abs().max(dy.abs()) == 1;
                match labels[other] {
                    Some(label) if label == own && !seen[other] => {
                        seen[other] = true;
                        piece.push(other);
                    }
                    Some(label) if label != own && is_near && !beside.contains(&label) => beside.push(label),
                    _ => {}
                }
            }
        }
        if piece.iter().any(|&cell| seeds[cell] == Some(own)) {
            continue;
        }
        let total = |label: u8| piece.iter().map(|&cell| f64::from(cost(cell, label.into()))).sum::<f64>();
        if let Some(best) = beside.into_iter().min_by(|&a, &b| total(a).total_cmp(&total(b))) {
            piece.iter().for_each(|&cell| labels[cell] = Some(best));
        }
    }
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
}
