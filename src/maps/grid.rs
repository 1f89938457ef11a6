//! Images in the picture's own pixel grid.
//!
//! Cell (0, 0) of a grid is the picture's pixel `origin`; a grid may reach beyond the picture. Nothing here resamples:
//! a cell is a pixel.

use glam::{DVec2, IVec2, UVec2, Vec2, Vec4};
use rayon::prelude::*;

use crate::picture::PicturePoint;
use crate::picture::color::linear_from_srgb;

/// Cells of one kind in the picture's pixel grid, row by row, top left first.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<T> {
    /// The picture pixel of the first cell; may lie outside the picture.
    pub origin: IVec2,
    /// Width and height in cells.
    pub size: UVec2,
    /// `size.x · size.y` cells.
    pub cells: Vec<T>,
}

/// A texture, or reflection map: sRGB codes with straight coverage, 0–255.
pub type Layer = Grid<[u8; 4]>;

impl<T: Copy + Send + Sync> Grid<T> {
    /// A grid of equal cells.
    #[must_use]
    pub fn filled(origin: IVec2, size: UVec2, value: T) -> Self {
        Self { origin, size, cells: vec![value; size.x as usize * size.y as usize] }
    }

    /// A grid whose cells are made from their picture pixels, on all cores.
    #[must_use]
    pub fn from_fn(origin: IVec2, size: UVec2, make: impl Fn(IVec2) -> T + Sync) -> Self {
        let width = size.x as usize;
        let cells = (0..width * size.y as usize)
            .into_par_iter()
            .with_min_len(4096)
            .map(|index| {
                make(origin + IVec2::new((index % width.max(1)) as i32, (index / width.max(1)) as i32))
            })
            .collect();
        Self { origin, size, cells }
    }

    /// The index of a picture pixel's cell, `None` outside.
    #[must_use]
    pub fn index(&self, pixel: IVec2) -> Option<usize> {
        let cell = pixel - self.origin;
        (cell.cmpge(IVec2::ZERO).all() && cell.cmplt(self.size.as_ivec2()).all())
            .then(|| cell.y as usize * self.size.x as usize + cell.x as usize)
    }

    /// The cell of a picture pixel, `None` outside.
    #[must_use]
    pub fn get(&self, pixel: IVec2) -> Option<T> {
        self.index(pixel).map(|index| self.cells[index])
    }

    /// The picture pixel of a cell.
    #[must_use]
    pub fn pixel(&self, index: usize) -> IVec2 {
        let width = self.size.x as usize;
        self.origin + IVec2::new((index % width) as i32, (index / width) as i32)
    }

    /// The cell nearest to a pixel; the border's for pixels outside.
    #[must_use]
    fn clamped(&self, cell: IVec2) -> T {
        let cell = cell.clamp(IVec2::ZERO, self.size.as_ivec2() - 1);
        self.cells[cell.y as usize * self.size.x as usize + cell.x as usize]
    }

    /// The four cells around a point and their bilinear weights; the border is prolonged.
    #[must_use]
    fn around(&self, point: PicturePoint) -> [(T, f32); 4] {
        let limit = self.size.as_dvec2();
        let at = (point.0 - self.origin.as_dvec2()).clamp(DVec2::splat(0.5), limit - 0.5) - 0.5;
        let floor = at.floor();
        let part = (at - floor).as_vec2();
        let cell = floor.as_ivec2();
        [
            (self.clamped(cell), (1.0 - part.x) * (1.0 - part.y)),
            (self.clamped(cell + IVec2::X), part.x * (1.0 - part.y)),
            (self.clamped(cell + IVec2::Y), (1.0 - part.x) * part.y),
            (self.clamped(cell + IVec2::ONE), part.x * part.y),
        ]
    }
}

impl Layer {
    /// Linear-light color and straight coverage at a point: Catmull and Rom's cubic, kept within what the four nearest
    /// texels span, so that nothing rings; texels weigh as much as they cover. The border is prolonged. Twin of `sharpest`
    /// in `tour.wgsl`.
    #[must_use]
    pub fn sample(&self, point: PicturePoint) -> [f32; 4] {
        let inner = self.size.as_dvec2() - 0.5;
        let at = (snap(point).0 - self.origin.as_dvec2()).clamp(DVec2::splat(0.5), inner) - 0.5;
        let (corner, part) = (at.floor().as_ivec2(), at.fract().as_vec2());
        let texel = |x: i32, y: i32| {
            let [r, g, b, a] = self.clamped(corner + IVec2::new(x, y));
            Vec4::new(linear_from_srgb(r), linear_from_srgb(g), linear_from_srgb(b), f32::from(a) / 255.0)
        };
        if part == Vec2::ZERO {
            return texel(0, 0).to_array();
        }
        let (across, down) = (cubic(part.x), cubic(part.y));
        let mut sum = Vec4::ZERO;
        for (y, down) in (-1..).zip(down) {
            for (x, across) in (-1..).zip(across) {
                let texel = texel(x, y);
                sum += across * down * (texel.w * texel).with_w(texel.w);
            }
        }
        let near = [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)];
        let [low, high] = [Vec4::min, Vec4::max].map(|pick| near.into_iter().fold(near[0], pick));
        (sum / sum.w.max(1e-4)).with_w(sum.w).clamp(low, high).to_array()
    }
}

/// Catmull and Rom's weights of the four texels around a place `t`, 0–1, between the middle two.
fn cubic(t: f32) -> [f32; 4] {
    [
        t * (-0.5 + t * (1.0 - 0.5 * t)),
        1.0 + t * t * (-2.5 + 1.5 * t),
        t * (0.5 + t * (2.0 - 1.5 * t)),
        t * t * (-0.5 + 0.5 * t),
    ]
}

impl Grid<[f32; 3]> {
    /// Bilinear value at a point; the border is prolonged.
    #[must_use]
    pub fn sample(&self, point: PicturePoint) -> [f32; 3] {
        let mut sum = [0.0; 3];
        for (value, weight) in self.around(point) {
            for channel in 0..3 {
                sum[channel] += weight * value[channel];
            }
        }
        sum
    }
}

impl Grid<u8> {
    /// Bilinear coverage 0–1 at a point, zero beyond the grid.
    #[must_use]
    pub fn coverage(&self, point: PicturePoint) -> f32 {
        let at = point.0 - self.origin.as_dvec2();
        if at.cmplt(DVec2::splat(-0.5)).any() || at.cmpgt(self.size.as_dvec2() + 0.5).any() {
            return 0.0;
        }
        self.around(point).iter().map(|&(value, weight)| weight * f32::from(value) / 255.0).sum()
    }
}

/// Brings a point within 1/32 pixel of a pixel center to that center, each axis by itself.
///
/// It absorbs the rounding of f32 geometry, so that the first view reads whole texels. Twin of `snap` in `tour.wgsl`.
#[must_use]
pub fn snap(point: PicturePoint) -> PicturePoint {
    let snap = |x: f64| {
        let center = x.floor() + 0.5;
        if (x - center).abs() < 1.0 / 32.0 { center } else { x }
    };
    PicturePoint::new(snap(point.x()), snap(point.y()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texel_center_reads_the_texel_and_the_border_is_prolonged() {
        let layer = Layer::from_fn(IVec2::new(10, 20), UVec2::new(4, 3), |pixel| {
            [pixel.x as u8 * 3, pixel.y as u8 * 5, 7, 200]
        });
        let [r, g, b, a] = layer.sample(PicturePoint::new(12.5 + 0.02, 21.5 - 0.03));
        let expected = [36, 105, 7].map(linear_from_srgb);
        assert_eq!([r, g, b], expected);
        assert!((a - 200.0 / 255.0).abs() < 1e-7);
        assert_eq!(layer.sample(PicturePoint::new(-50.0, 21.5))[0], linear_from_srgb(30));
    }
}
