//! Connected parts of a set of cells (through all eight neighbors).

/// The number of each cell's part, from 1 on in the order of their first cells, 0 outside the set; and each part's
/// count of cells, that of part 0 being 0.
pub(super) fn parts(width: usize, is_member: impl Fn(usize) -> bool, cells: usize) -> (Vec<u32>, Vec<usize>) {
    let height = cells / width;
    let mut part_of = vec![0; cells];
    let mut counts = vec![0];
    let mut stack = Vec::new();
    for first in 0..cells {
        if part_of[first] != 0 || !is_member(first) {
            continue;
        }
        let part = counts.len() as u32;
        counts.push(0);
        part_of[first] = part;
        stack.push(first);
        while let Some(cell) = stack.pop() {
            counts[part as usize] += 1;
            let (x, y) = (cell % width, cell / width);
            for row in y.saturating_sub(1)..(y + 2).min(height) {
                for column in x.saturating_sub(1)..(x + 2).min(width) {
                    let next = row * width + column;
                    if part_of[next] == 0 && is_member(next) {
                        part_of[next] = part;
                        stack.push(next);
                    }
                }
            }
        }
    }
    (part_of, counts)
}

/// Adds to a set all holes of at most `most` cells that it encloses.
pub(super) fn fill_holes(width: usize, inside: &mut [bool], most: usize) {
    let (part_of, counts) = parts(width, |cell| !inside[cell], inside.len());
    let height = inside.len() / width;
    let mut is_open = vec![false; counts.len()];
    for (cell, part) in part_of.iter().enumerate() {
        let (x, y) = (cell % width, cell / width);
        if x == 0 || y == 0 || x + 1 == width || y + 1 == height {
            is_open[*part as usize] = true;
        }
    }
    for (inside, part) in inside.iter_mut().zip(part_of) {
        let part = part as usize;
        *inside |= part != 0 && !is_open[part] && counts[part] <= most;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_touch_at_corners_and_small_holes_are_filled() {
        let rows = ["#..####", ".#.#..#", "...#..#", "...####", "##....."];
        let mut inside: Vec<bool> = rows.concat().bytes().map(|b| b == b'#').collect();
        let (part_of, counts) = parts(7, |cell| inside[cell], 35);
        assert_eq!(counts, [0, 2, 12, 2]);
        assert_eq!((part_of[0], part_of[8], part_of[3], part_of[28]), (1, 1, 2, 3));
        fill_holes(7, &mut inside, 3);
        assert!(!inside[11], "a hole of 4 cells");
        fill_holes(7, &mut inside, 4);
        assert!(inside[11] && inside[19] && !inside[1]);
    }
}
