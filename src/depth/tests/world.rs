//! Made-up lakes with known distances: upright walls with a texture of their own, water still or rippled, a sky.
//!
//! Rendered ray by ray, the same every time.

use glam::{DVec2, DVec3, UVec2};

use crate::camera::{CameraPose, Intrinsics, PinholeCamera};
use crate::picture::{Mask, Picture, PicturePoint};

/// An upright wall over a line on the water.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall {
    /// Its two ends, (x, z) in meters.
    pub(crate) ends: [DVec2; 2],
    /// Height, meters.
    pub(crate) height: f64,
    /// How much its top goes up and down, meters.
    pub(crate) jagged: f64,
    /// Size of its texture's coarsest parts, meters.
    pub(crate) grain: f64,
    /// Mean color.
    pub(crate) color: [f64; 3],
}

/// A lake.
#[derive(Clone, Debug)]
pub(crate) struct Lake {
    pub(crate) camera: PinholeCamera,
    pub(crate) walls: Vec<Wall>,
    /// Root mean square of the water's slope along the view; 0 is still.
    pub(crate) slope: f64,
    /// Whether the sky has clouds.
    pub(crate) clouds: bool,
    /// What the water is: a mirror, or something with a texture of its own.
    pub(crate) mirror: bool,
}

/// A lake's picture, water, and true distances along −z; infinite for the sky, NaN for the water.
pub(crate) struct Shot {
    pub(crate) picture: Picture,
    pub(crate) water: Mask,
    pub(crate) distance: Vec<f64>,
}

/// A camera of 480 × 270 pixels, 40° high in the picture's width, `height` meters above the water; angles in degrees.
pub(crate) fn camera(height: f64, pitch: f64, roll: f64) -> PinholeCamera {
    PinholeCamera {
        intrinsics: Intrinsics {
            focal_px: 420.0,
            principal: PicturePoint::new(240.0, 135.0),
            size: UVec2::new(480, 270),
        },
        pose: CameraPose::from_angles(
            DVec3::new(0.0, height, 0.0),
            0.0,
            pitch.to_radians(),
            roll.to_radians(),
        ),
    }
}

/// A frontal wall as wide as any picture.
pub(crate) fn frontal(distance: f64, height: f64, jagged: f64, color: [f64; 3]) -> Wall {
    let x = 2.0 * distance;
    let ends = [DVec2::new(-x, -distance), DVec2::new(x, -distance)];
    Wall { ends, height, jagged, grain: distance / 40.0, color }
}

impl Lake {
    pub(crate) fn shot(&self) -> Shot {
        let size = self.camera.intrinsics.size;
        let count = (size.x * size.y) as usize;
        let (mut pixels, mut water, mut distance) = (Vec::new(), Vec::new(), Vec::new());
        // Two rows and columns of rays a pixel, and more of rows where ripples smear.
        let rows = if self.slope > 0.0 { 4 } else { 2 };
        for pixel in 0..count {
            let (i, j) = ((pixel % size.x as usize) as f64, (pixel / size.x as usize) as f64);
            let mut sum = DVec3::ZERO;
            for k in 0..2 * rows {
                let (x, y) =
                    (i + 0.25 + 0.5 * f64::from(k % 2), j + (f64::from(k / 2) + 0.5) / f64::from(rows));
                sum += self.color(PicturePoint::new(x, y));
            }
            let noise = 4.0 * (random(pixel as u64, 77) - 0.5);
            let codes = sum / f64::from(2 * rows) + noise;
            pixels.push(codes.to_array().map(|c| c.round().clamp(0.0, 255.0) as u8));
            let ray = self.camera.ray(PicturePoint::new(i + 0.5, j + 0.5));
            let hit = self.hit(ray.origin, ray.direction);
            let on_water =
                ray.direction.y < 0.0 && hit.is_none_or(|(t, _)| t > -ray.origin.y / ray.direction.y);
            water.push(if on_water { 255 } else { 0 });
            distance.push(match hit {
                _ if on_water => f64::NAN,
                Some((t, _)) => -ray.at(t).z,
                None => f64::INFINITY,
            });
        }
        Shot {
            picture: Picture::new(size, pixels).expect("one code for each pixel"),
            water: Mask::new(size, water).expect("one value for each pixel"),
            distance,
        }
    }

    fn color(&self, point: PicturePoint) -> DVec3 {
        let ray = self.camera.ray(point);
        let to_water = -ray.origin.y / ray.direction.y;
        let hit = self.hit(ray.origin, ray.direction);
        if to_water > 0.0 && hit.is_none_or(|(t, _)| t > to_water) {
            let at = ray.at(to_water);
            if !self.mirror {
                let waves = texture(DVec2::new(at.x, at.z), -at.z / 30.0, 5);
                return DVec3::new(60.0, 90.0, 110.0) + 80.0 * waves;
            }
            let tilt = self.slope * waves(at.x, at.z);
            let d = ray.direction;
            let mirrored = DVec3::new(d.x, -d.y + 2.0 * tilt * -d.z, d.z);
            let seen = self
                .hit(DVec3::new(at.x, 0.0, at.z), mirrored)
                .map_or_else(|| self.sky(mirrored), |hit| hit.1);
            return 0.6 * seen + DVec3::new(12.0, 22.0, 30.0);
        }
        hit.map_or_else(|| self.sky(ray.direction), |hit| hit.1)
    }

    /// The first wall on a ray: parameter and color.
    fn hit(&self, origin: DVec3, direction: DVec3) -> Option<(f64, DVec3)> {
        let mut nearest: Option<(f64, DVec3)> = None;
        for (number, wall) in self.walls.iter().enumerate() {
            let [a, b] = wall.ends;
            let (along, o, d) = (b - a, DVec2::new(origin.x, origin.z), DVec2::new(direction.x, direction.z));
            let normal = along.perp();
            let t = normal.dot(a - o) / normal.dot(d);
            if t.is_nan() || t <= 1e-9 || nearest.is_some_and(|(other, _)| other < t) {
                continue;
            }
            let at = origin + t * direction;
            let s = (DVec2::new(at.x, at.z) - a).dot(along) / along.length();
            let top = wall.height
                + wall.jagged * 2.0 * texture(DVec2::new(s, 3.0 * number as f64), wall.grain * 4.0, 4);
            if (0.0..=along.length()).contains(&s) && at.y >= 0.0 && at.y <= top {
                let shade = texture(DVec2::new(s + 1000.0 * number as f64, at.y), wall.grain, 5);
                let tint = texture(DVec2::new(s, at.y + 500.0), wall.grain * 2.0, 2);
                let color =
                    DVec3::from_array(wall.color) + 90.0 * shade + DVec3::new(30.0, 0.0, -30.0) * tint;
                nearest = Some((t, color));
            }
        }
        nearest
    }

    fn sky(&self, direction: DVec3) -> DVec3 {
        let d = direction.normalize();
        let clear = DVec3::new(150.0, 185.0, 225.0) - 60.0 * d.y.clamp(0.0, 1.0);
        if self.clouds { clear + 60.0 * texture(DVec2::new(d.x / -d.z, d.y / -d.z), 0.12, 4) } else { clear }
    }
}

/// Slope of the ripples at a place, root mean square 1: many small waves, mostly along the view.
fn waves(x: f64, z: f64) -> f64 {
    let count = 16;
    let sum: f64 = (0..count)
        .map(|i| {
            let length = 0.15 + 0.9 * random(i, 1).powi(2);
            let angle = 0.9 * (random(i, 2) - 0.5);
            let (kx, kz) = (angle.sin() / length, angle.cos() / length);
            (std::f64::consts::TAU * (kx * x + kz * z + random(i, 3))).sin()
        })
        .sum();
    sum / (0.5 * count as f64).sqrt()
}

/// Noise of about −½ … ½ whose coarsest parts are `size` wide.
fn texture(at: DVec2, size: f64, octaves: u32) -> f64 {
    let mut sum = 0.0;
    let mut weight = 0.5;
    for octave in 0..octaves {
        let p = at / size * f64::from(1 << octave);
        let (low, part) = (p.floor(), p - p.floor());
        let smooth = part * part * (3.0 - 2.0 * part);
        let value = |dx: f64, dy: f64| {
            let cell =
                ((low.x + dx) as i64 as u64).wrapping_mul(0x9e37_79b9) ^ ((low.y + dy) as i64 as u64) << 32;
            random(cell, u64::from(octave) + 10) - 0.5
        };
        let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
        sum += weight
            * 1.6
            * mix(
                mix(value(0.0, 0.0), value(1.0, 0.0), smooth.x),
                mix(value(0.0, 1.0), value(1.0, 1.0), smooth.x),
                smooth.y,
            );
        weight *= 0.65;
    }
    sum
}

/// A number 0–1 for every index and seed (splitmix64).
fn random(index: u64, seed: u64) -> f64 {
    let mut z =
        index.wrapping_mul(0x2545_f491_4f6c_dd1d).wrapping_add(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}
