//! The depth map to look at: near red, far blue, with a scale of meters below.

use glam::UVec2;
use rayon::prelude::*;

use super::map::DepthMap;
use crate::picture::Picture;

/// What is seen of the picture where no distance is known.
const DIMMED: f32 = 0.35;
/// The sky, and what cannot be told from it.
const BEYOND: [f32; 3] = [235.0, 235.0, 245.0];
/// How much of the color is the distance's; the rest is the picture's brightness, which keeps edges visible.
const TINT: f32 = 0.75;
/// Distances on the scale, meters, as far as they occur.
const MARKS: [u32; 13] = [2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10_000, 20_000];

/// Paints the known distances of a picture, with a legend below it; the picture and the map must be of one size, else
/// the picture itself comes back.
#[must_use]
pub fn paint(picture: &Picture, map: &DepthMap) -> Picture {
    let size = picture.size();
    if map.size != size {
        return picture.clone();
    }
    let scale = Scale::of(map);
    let is_sky = |pixel: usize| map.sky.as_ref().is_some_and(|sky| sky.values()[pixel] > 127);
    let mut pixels: Vec<[u8; 3]> = picture
        .pixels()
        .par_iter()
        .enumerate()
        .map(|(pixel, codes)| {
            let seen = codes.map(f32::from);
            let gray = super::frame::luma(seen);
            let color = if map.is_known(pixel) {
                scale.color(f64::from(map.distance[pixel]))
            } else if map.is_beyond(pixel) || is_sky(pixel) {
                BEYOND
            } else {
                return [(gray * DIMMED) as u8; 3];
            };
            color.map(|c| (TINT * c + (1.0 - TINT) * gray) as u8)
        })
        .collect();
    let (width, unit) = (size.x as usize, (size.x as usize / 480).max(1));
    let rows = 16 * unit;
    let mut legend = vec![[24_u8; 3]; width * rows];
    let margin = 12 * unit;
    let span = width.saturating_sub(2 * margin).max(1);
    for y in unit..6 * unit {
        for x in 0..span.min(width - margin.min(width)) {
            let meters = scale.meters(x as f64 / span as f64);
            legend[y * width + margin + x] = scale.color(meters).map(|c| c as u8);
        }
    }
    if map.has_mirror {
        for mark in MARKS.into_iter().filter(|&mark| (0.0..=1.0).contains(&scale.part(f64::from(mark)))) {
            let x = margin + (scale.part(f64::from(mark)) * (span - 1) as f64) as usize;
            write(&mut legend, width, &format!("{mark}m"), [x, 8 * unit], unit);
        }
    } else {
        write(&mut legend, width, "-", [width / 2, 8 * unit], unit);
    }
    pixels.extend(legend);
    // The rows were counted above.
    Picture::new(UVec2::new(size.x, size.y + rows as u32), pixels).unwrap_or_else(|_| picture.clone())
}

/// Colors of distances, even in their logarithm.
struct Scale {
    ln_near: f64,
    ln_far: f64,
}

impl Scale {
    fn of(map: &DepthMap) -> Self {
        let known = (0..map.distance.len()).filter(|&pixel| map.is_known(pixel));
        let mut all: Vec<f32> = known.map(|pixel| map.distance[pixel]).collect();
        if all.is_empty() {
            return Self { ln_near: 0.0, ln_far: 1.0 };
        }
        all.sort_unstable_by(f32::total_cmp);
        let at = |part: f64| f64::from(all[((all.len() - 1) as f64 * part) as usize]).ln();
        let (near, far) = (at(0.005), at(0.995));
        // A single distance still needs a scale around it.
        Self { ln_near: near - 0.2, ln_far: far + 0.2 }
    }

    fn part(&self, meters: f64) -> f64 {
        (meters.ln() - self.ln_near) / (self.ln_far - self.ln_near)
    }

    fn meters(&self, part: f64) -> f64 {
        (self.ln_near + part * (self.ln_far - self.ln_near)).exp()
    }

    /// Red, yellow, green, cyan, blue from near to far.
    fn color(&self, meters: f64) -> [f32; 3] {
        let at = 4.0 * self.part(meters).clamp(0.0, 1.0) as f32;
        let hump = |center: f32| (1.5 - (at - center).abs()).clamp(0.0, 1.0) * 255.0;
        [hump(0.5).max(hump(0.0)), hump(2.0), hump(3.5).max(hump(4.0))]
    }
}

/// Digits of three by five dots, a row of dots in three bits, the top row first; then the letter m and a dash.
const GLYPHS: [(char, [u8; 5]); 12] = [
    ('0', [0b111, 0b101, 0b101, 0b101, 0b111]),
    ('1', [0b010, 0b110, 0b010, 0b010, 0b111]),
    ('2', [0b111, 0b001, 0b111, 0b100, 0b111]),
    ('3', [0b111, 0b001, 0b111, 0b001, 0b111]),
    ('4', [0b101, 0b101, 0b111, 0b001, 0b001]),
    ('5', [0b111, 0b100, 0b111, 0b001, 0b111]),
    ('6', [0b111, 0b100, 0b111, 0b101, 0b111]),
    ('7', [0b111, 0b001, 0b010, 0b010, 0b010]),
    ('8', [0b111, 0b101, 0b111, 0b101, 0b111]),
    ('9', [0b111, 0b101, 0b111, 0b001, 0b111]),
    ('m', [0b000, 0b110, 0b111, 0b111, 0b101]),
    ('-', [0b000, 0b000, 0b111, 0b000, 0b000]),
];

/// Writes a line, centered on a column, its top at a row; what does not fit is left out.
fn write(pixels: &mut [[u8; 3]], width: usize, text: &str, [center, top]: [usize; 2], unit: usize) {
    let left = center.saturating_sub(text.len() * 2 * unit);
    for (i, letter) in text.chars().enumerate() {
        let Some((_, glyph)) = GLYPHS.iter().find(|(other, _)| *other == letter) else { continue };
        for dot in 0..15 * unit * unit {
            let (dx, dy) = (dot % (3 * unit), dot / (3 * unit));
            let (x, y) = (left + i * 4 * unit + dx, top + dy);
            let is_set = glyph[dy / unit] >> (2 - dx / unit) & 1 == 1;
            if is_set && x < width && y * width + x < pixels.len() {
                pixels[y * width + x] = [230; 3];
            }
        }
    }
}
