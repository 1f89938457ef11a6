//! Reflection pairs for the solver, found where the depth is known and the picture has corners.

use glam::{DMat2, DVec2};
use rayon::prelude::*;

use crate::camera::PinholeCamera;
use crate::depth::frame::{Level, luma};
use crate::depth::map::DepthMap;
use crate::picture::{Mask, Picture, PicturePoint};

/// Half side of the patches that are compared, pixels.
const REACH: i32 = 8;
const ROUNDS: usize = 6;
/// Patches that correlate less, or that move by more pixels from where the depth puts them, are no pair.
const LEAST_CORRELATION: f64 = 0.75;
const FARTHEST: f64 = 3.0;
/// Confidence of the depth from which a pair is tried.
const SURE: f32 = 0.6;
/// Distances in a patch that differ by more than this part belong to two surfaces.
const ONE_SURFACE: f32 = 0.1;
/// Neighboring gray values tell the same: so many of them count as one.
const ALIKE: f64 = 9.0;
/// No patch is placed better than this, pixels: sideways and lengthwise, where uneven depth moves it too.
const LEAST_DEVIATION: [f64; 2] = [0.25, 0.5];
/// Brightness that changes less over a patch, codes, is even.
const EVEN: f64 = 4.0;

/// A point and where the water shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthPair {
    /// The point itself: a pixel's center.
    pub point: PicturePoint,
    /// Its reflection.
    pub reflection: PicturePoint,
    /// Standard deviation of the reflection's place against the point, pixels: sideways and lengthwise.
    pub deviation_px: [f64; 2],
    /// Meters along −z.
    pub distance: f64,
}

/// Reflection pairs spread over the picture, at most `most`, in no particular order; the same input gives the same
/// pairs. Their patches do not overlap, so their errors are their own.
///
/// None without a mirror image, or where sizes differ.
#[must_use]
pub fn pairs(
    picture: &Picture,
    water: &Mask,
    camera: &PinholeCamera,
    map: &DepthMap,
    most: usize,
) -> Vec<DepthPair> {
    let size = picture.size();
    if !map.has_mirror || map.size != size || water.size() != size || camera.intrinsics.size != size {
        return Vec::new();
    }
    let gray: Vec<f64> = picture.pixels().iter().map(|c| f64::from(luma(c.map(f32::from)))).collect();
    let shown = Shown { width: size.x as i32, height: size.y as i32, gray, water, level: Level::of(camera) };
    let side = (2 * REACH + 1) as usize;
    let (columns, rows) = (size.x as usize / side, size.y as usize / side);
    let mut found: Vec<DepthPair> = (0..columns * rows)
        .into_par_iter()
        .filter_map(|block| {
            let (x, y) = (block % columns * side, block / columns * side);
            let pixels = (0..side * side).map(|i| (y + i / side) * size.x as usize + x + i % side);
            let corner = pixels
                .filter(|&pixel| map.confidence[pixel] >= SURE && shown.is_one_surface(map, pixel))
                .max_by(|&a, &b| shown.corner(a).total_cmp(&shown.corner(b)).then(b.cmp(&a)))?;
            shown.pair(map, corner)
        })
        .collect();
    // The best placed ones, lengthwise and sideways alike.
    found.sort_by(|a, b| {
        a.deviation_px[0].max(a.deviation_px[1]).total_cmp(&b.deviation_px[0].max(b.deviation_px[1]))
    });
    found.truncate(most);
    found
}

/// The picture, to be read anywhere.
struct Shown<'a> {
    width: i32,
    height: i32,
    gray: Vec<f64>,
    water: &'a Mask,
    level: Level<'a>,
}

impl Shown<'_> {
    fn pixel(&self, x: i32, y: i32) -> f64 {
        let (x, y) = (x.clamp(0, self.width - 1), y.clamp(0, self.height - 1));
        self.gray[(y * self.width + x) as usize]
    }

    /// Brightness at a leveled point; `None` outside the picture, or where it is water and should not be, or not.
    fn at(&self, level: DVec2, in_water: bool) -> Option<f64> {
        let point = self.level.picture_point(level)?;
        let inside = point.0.cmpge(DVec2::splat(0.5)).all()
            && point.x() <= f64::from(self.width) - 0.5
            && point.y() <= f64::from(self.height) - 0.5;
        if !inside || (self.water.sample(point) > 0.5) != in_water {
            return None;
        }
        let at = point.0 - 0.5;
        let (low, part) = (at.floor().as_ivec2(), at - at.floor());
        let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
        let upper = mix(self.pixel(low.x, low.y), self.pixel(low.x + 1, low.y), part.x);
        let lower = mix(self.pixel(low.x, low.y + 1), self.pixel(low.x + 1, low.y + 1), part.x);
        Some(mix(upper, lower, part.y))
    }

    /// Whether a pixel's patch is known and at one distance: at an outline two surfaces move in one patch.
    fn is_one_surface(&self, map: &DepthMap, pixel: usize) -> bool {
        let (x, y) = (pixel as i32 % self.width, pixel as i32 / self.width);
        let around =
            [-REACH, 0, REACH].into_iter().flat_map(|dy| [-REACH, 0, REACH].map(|dx| (x + dx, y + dy)));
        around.into_iter().all(|(x, y)| {
            let inside = (0..self.width).contains(&x) && (0..self.height).contains(&y);
            let other = (y * self.width + x) as usize;
            inside
                && map.is_known(other)
                && (map.distance[other] / map.distance[pixel] - 1.0).abs() < ONE_SURFACE
        })
    }

    /// Shi and Tomasi's corner strength: the lesser eigenvalue of the gradients' second moments.
    fn corner(&self, pixel: usize) -> f64 {
        let (x, y) = (pixel as i32 % self.width, pixel as i32 / self.width);
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for dy in -2..=2 {
            for dx in -2..=2 {
                let gx = self.pixel(x + dx + 1, y + dy) - self.pixel(x + dx - 1, y + dy);
                let gy = self.pixel(x + dx, y + dy + 1) - self.pixel(x + dx, y + dy - 1);
                (xx, xy, yy) = (xx + gx * gx, xy + gx * gy, yy + gy * gy);
            }
        }
        0.5 * (xx + yy) - (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt()
    }

    /// Places the reflection of a pixel by its patch, to a fraction of a pixel (Lucas & Kanade 1981).
    fn pair(&self, map: &DepthMap, pixel: usize) -> Option<DepthPair> {
        let point = PicturePoint::pixel_center(
            (pixel as i32 % self.width).into(),
            (pixel as i32 / self.width).into(),
        );
        let own = self.level.place(point)?;
        let distance = f64::from(map.distance[pixel]);
        // Where the camera's horizon puts it, not the corrected one.
        let shift = map.shift(distance) + 2.0 * map.horizon.offset_px;
        let mut moved = DVec2::ZERO;
        let offsets: Vec<DVec2> = (-REACH..=REACH)
            .flat_map(|dy| (-REACH..=REACH).map(move |dx| DVec2::new(f64::from(dx), f64::from(dy))))
            .collect();
        let direct: Vec<Option<f64>> = offsets.iter().map(|&offset| self.at(own + offset, false)).collect();
        let mut covariance = DMat2::ZERO;
        for _ in 0..ROUNDS {
            let mirror = |offset: DVec2| {
                let at = own + offset;
                self.at(DVec2::new(at.x, -at.y - shift) + moved, true)
            };
            let samples: Vec<(f64, f64, DVec2)> = offsets
                .iter()
                .zip(&direct)
                .filter_map(|(&offset, &direct)| {
                    let reflected = mirror(offset)?;
                    // The mirror image is upside down.
                    let gx = 0.5 * (mirror(offset + DVec2::X)? - mirror(offset - DVec2::X)?);
                    let gy = 0.5 * (mirror(offset - DVec2::Y)? - mirror(offset + DVec2::Y)?);
                    Some((direct?, reflected, DVec2::new(gx, gy)))
                })
                .collect();
            let count = samples.len() as f64;
            if 2 * samples.len() < offsets.len() {
                return None;
            }
            let mean = |of: &dyn Fn(&(f64, f64, DVec2)) -> f64| samples.iter().map(of).sum::<f64>() / count;
            let (a, b) = (mean(&|s| s.0), mean(&|s| s.1));
            let (aa, bb) = (mean(&|s| (s.0 - a).powi(2)), mean(&|s| (s.1 - b).powi(2)));
            let correlation = mean(&|s| (s.0 - a) * (s.1 - b)) / (aa * bb).sqrt().max(EVEN * EVEN);
            if correlation < LEAST_CORRELATION {
                return None;
            }
            let gain = (bb / aa).sqrt();
            let (mut normal, mut right, mut rest) = (DMat2::ZERO, DVec2::ZERO, 0.0);
            let mean_gradient = samples.iter().map(|s| s.2).sum::<DVec2>() / count;
            for (direct, reflected, gradient) in &samples {
                let gradient = *gradient - mean_gradient;
                let off = gain * (direct - a) - (reflected - b);
                normal += DMat2::from_cols(gradient * gradient.x, gradient * gradient.y);
                right += gradient * off;
                rest += off * off;
            }
            if normal.determinant() <= EVEN * EVEN {
                return None;
            }
            let step = normal.inverse() * right;
            moved += step.clamp_length_max(1.0);
            covariance = normal.inverse() * (ALIKE * rest / count);
            if moved.length() > FARTHEST {
                return None;
            }
        }
        let reflection = self.level.picture_point(DVec2::new(own.x, -own.y - shift) + moved)?;
        let deviation_px = [
            covariance.x_axis.x.sqrt().max(LEAST_DEVIATION[0]),
            covariance.y_axis.y.sqrt().max(LEAST_DEVIATION[1]),
        ];
        let sound = reflection.0.is_finite() && deviation_px.iter().all(|d| d.is_finite());
        sound.then_some(DepthPair { point, reflection, deviation_px, distance })
    }
}
