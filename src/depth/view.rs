//! What is matched: leveled gray values, and which of them are seen directly and which in the water.

use rayon::prelude::*;

/// What a leveled pixel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Nothing that can be matched: beyond the picture, or on the edge of the water.
    Outside,
    /// Something seen directly: land, objects, sky.
    Direct,
    /// The water's surface.
    Water,
}

/// A leveled picture, row by row from the top left.
#[derive(Clone, Debug)]
pub(super) struct View {
    pub(super) width: usize,
    pub(super) height: usize,
    /// The first row below the horizon; may lie outside.
    pub(super) horizon: isize,
    /// Brightness as seen, 0–255.
    pub(super) gray: Vec<f32>,
    /// sRGB codes, red, green, blue.
    pub(super) channels: [Vec<f32>; 3],
    pub(super) kinds: Vec<Kind>,
}

/// Standard deviation of what an 8-bit picture adds to its brightness, codes: sensor noise and rounding.
pub(super) const NOISE: f32 = 2.0;

impl View {
    /// The same at half the size: means of two by two pixels.
    pub(super) fn halved(&self) -> Self {
        let (width, height) = (self.width / 2, self.height / 2);
        let cells = (0..width * height).into_par_iter().map(|cell| {
            let corner = cell / width * 2 * self.width + cell % width * 2;
            let four = [corner, corner + 1, corner + self.width, corner + self.width + 1];
            let count = |kind| four.iter().filter(|&&i| self.kinds[i] == kind).count();
            let kind = match (count(Kind::Direct), count(Kind::Water)) {
                (3.., _) => Kind::Direct,
                (_, 3..) => Kind::Water,
                _ => Kind::Outside,
            };
            (0.25 * four.iter().map(|&i| self.gray[i]).sum::<f32>(), kind)
        });
        let (gray, kinds) = cells.unzip();
        let channels = std::array::from_fn(|channel| {
            let values = &self.channels[channel];
            let corner = |cell: usize| cell / width * 2 * self.width + cell % width * 2;
            let mean = |i: usize| {
                0.25 * (values[i] + values[i + 1] + values[i + self.width] + values[i + self.width + 1])
            };
            (0..width * height).into_par_iter().map(|cell| mean(corner(cell))).collect()
        });
        Self { width, height, horizon: self.horizon.div_euclid(2), gray, channels, kinds }
    }

    /// 1 for each pixel of a kind, 0 for others.
    pub(super) fn weights(&self, kind: Kind) -> Vec<f32> {
        self.kinds.iter().map(|&k| f32::from(u8::from(k == kind))).collect()
    }

    /// The row in which the mirror image of `row` stands for shift `s`, in rows: it may lie outside.
    pub(super) fn mirror_row(&self, row: usize, s: isize) -> isize {
        2 * self.horizon - 1 - row as isize + s
    }
}
