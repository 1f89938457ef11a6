//! The reference ray tracer: the definition of right, and image comparison.
//!
//! The paper's rendering (its section on rendering; notes §8.1): billboards near to far, ground, backdrops, water
//! last; at the water the ray is mirrored and reads reflection maps instead of texture maps. Soft masks are composited
//! in linear light; whatever a ray misses, it ends in the last layer, at infinity. Needs no engine and no GPU.

pub mod compare;
mod eye;
mod mirrored;

use eye::Eye;

use glam::{DVec2, DVec3, UVec2};
use rayon::prelude::*;

use crate::camera::PinholeCamera;
use crate::camera::Ray;
use crate::maps::Maps;
use crate::maps::Mipmapped;
use crate::maps::mip_level;
use crate::picture::Picture;
use crate::picture::PicturePoint;
use crate::picture::color::srgb_from_linear3;
use crate::scene::Arrangement;
use crate::scene::Meeting;
use crate::scene::Placement;
use crate::scene::Surface;
use crate::scene::TourScene;
use crate::water::{StillWater, WaterSurface};
use crate::wind::SwayRecord;

/// Less light than this is left behind a layer: half a display code cannot change any more.
const OPAQUE: f32 = 1.0 / 8192.0;

/// A scene with its maps, ready to be looked at.
pub struct Reference<'a> {
    scene: &'a TourScene,
    maps: &'a Maps,
    water: &'a dyn WaterSurface,
    moved: &'a [Option<Placement>],
    sways: &'a [SwayRecord],
    eye: Eye,
}

impl std::fmt::Debug for Reference<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Reference").field("scene", self.scene).finish_non_exhaustive()
    }
}

impl<'a> Reference<'a> {
    /// A reference in which nothing moves.
    #[must_use]
    pub fn new(scene: &'a TourScene, maps: &'a Maps) -> Self {
        let eye = Eye::of(&scene.camera);
        Self { scene, maps, water: &StillWater, moved: &[], sways: &[], eye }
    }

    /// The same with moving water.
    #[must_use]
    pub fn with_water(self, water: &'a dyn WaterSurface) -> Self {
        Self { water, ..self }
    }

    /// The same with walls elsewhere than they rest and plants that sway, both by component; they may be shorter.
    #[must_use]
    pub fn with_motion(self, moved: &'a [Option<Placement>], sways: &'a [SwayRecord]) -> Self {
        Self { moved, sways, ..self }
    }

    /// Renders what `camera` sees, `samples` rays a pixel (at least 1; one goes through the pixel's center), on all
    /// cores. Samples are averaged in linear light.
    #[must_use]
    pub fn render(&self, camera: &PinholeCamera, samples: u32) -> Picture {
        let size = camera.intrinsics.size.max(UVec2::ONE);
        let offsets = sample_offsets(samples);
        let look = Look::of(camera, self.scene.arranged_for(camera.pose.position, self.moved));
        let mut pixels = vec![[0_u8; 3]; size.x as usize * size.y as usize];
        pixels.par_chunks_mut(size.x as usize).enumerate().for_each(|(row, pixels)| {
            for (column, pixel) in pixels.iter_mut().enumerate() {
                let corner = DVec2::new(column as f64, row as f64);
                let mut sum = [0.0_f32; 3];
                for &offset in &offsets {
                    let color = self.look(camera.ray(PicturePoint(corner + offset)), &look);
                    for c in 0..3 {
                        sum[c] += color[c];
                    }
                }
                *pixel = srgb_from_linear3(sum.map(|x| x / offsets.len() as f32));
            }
        });
        // The size is that of the pixels by construction.
        Picture::new(size, pixels).unwrap_or_else(|_| unreachable!("rows of `size.x` pixels"))
    }

    /// The color along a ray of the world, linear light.
    fn look(&self, ray: Ray, look: &Look) -> [f32; 3] {
        let mut light = Accumulated::default();
        for &index in &look.arrangement.near_to_far {
            if let Some(met) = self.meet(look, index, ray) {
                // At infinity only the direction counts.
                let texel = if met.t.is_finite() {
                    self.read(&self.maps.components[index].texture, look, met.point, met.rest.0)
                } else {
                    self.read_far(&self.maps.components[index].texture, look, ray.direction)
                };
                light.add(texel);
                if light.left < OPAQUE {
                    return light.color;
                }
            }
        }
        let last = if self.scene.water && ray.direction.y < 0.0 {
            self.mirrored(ray, look)
        } else {
            let [r, g, b, _] = self.read_far(&self.maps.components[0].texture, look, ray.direction);
            [r, g, b]
        };
        light.add([last[0], last[1], last[2], 1.0]);
        light.color
    }

    /// A map at a point `rest` that is seen at `point`.
    fn read(&self, map: &Mipmapped, look: &Look, point: DVec3, rest: DVec3) -> [f32; 4] {
        let (at, depth) = self.eye.see(rest);
        map.sample(at, look.level(self.scene, point - look.position, depth))
    }

    /// A map infinitely far in a direction.
    fn read_far(&self, map: &Mipmapped, look: &Look, direction: DVec3) -> [f32; 4] {
        let (at, depth) = self.eye.see_far(direction);
        map.sample(at, look.level(self.scene, direction, depth))
    }

    /// Where a ray meets a component, and the point that is there when nothing moves.
    fn meet(&self, look: &Look, index: usize, ray: Ray) -> Option<Meeting> {
        let mut met = look.arrangement.meet(self.scene, index, ray)?;
        if let (Surface::Wall(wall), Some(sway)) =
            (&self.scene.components[index].surface, self.sways.get(index))
        {
            let seen = DVec2::new(wall.along_of(met.rest.0), met.rest.0.y).as_vec2();
            let rest = sway.rest_point(seen);
            // What is still keeps its bits.
            if rest != seen {
                met.rest.0 = wall.point(f64::from(rest.x), f64::from(rest.y));
            }
        }
        Some(met)
    }
}

/// A camera that looks at the scene.
struct Look {
    position: DVec3,
    forward: DVec3,
    focal_px: f64,
    arrangement: Arrangement,
}

impl Look {
    fn of(camera: &PinholeCamera, arrangement: Arrangement) -> Self {
        Self {
            position: camera.pose.position,
            forward: camera.pose.rotation * DVec3::NEG_Z,
            focal_px: camera.intrinsics.focal_px,
            arrangement,
        }
    }

    /// The mip level for what lies `away` from this camera and `depth` meters before the picture's. Both maps and
    /// screen are made by pinholes, so a pixel covers about as many texels across as up and down.
    fn level(&self, scene: &TourScene, away: DVec3, depth: f64) -> f32 {
        let texels_per_meter = scene.camera.intrinsics.focal_px / depth;
        mip_level(texels_per_meter * self.forward.dot(away).max(0.0) / self.focal_px)
    }
}

/// Front-to-back compositing in linear light.
struct Accumulated {
    color: [f32; 3],
    left: f32,
}

impl Default for Accumulated {
    fn default() -> Self {
        Self { color: [0.0; 3], left: 1.0 }
    }
}

impl Accumulated {
    /// Adds a straight-alpha texel behind what is there.
    fn add(&mut self, texel: [f32; 4]) {
        let weight = self.left * texel[3];
        for (sum, channel) in self.color.iter_mut().zip(texel) {
            *sum += weight * channel;
        }
        self.left -= weight;
    }
}

/// Offsets in the pixel: its center for one sample, a square grid for square numbers, else Roberts' R2 sequence.
fn sample_offsets(samples: u32) -> Vec<DVec2> {
    let side = f64::from(samples.max(1)).sqrt().round();
    if side * side == f64::from(samples.max(1)) {
        let steps = side as u32;
        return (0..steps * steps)
            .map(|i| DVec2::new(f64::from(i % steps) + 0.5, f64::from(i / steps) + 0.5) / side)
            .collect();
    }
    const PLASTIC: f64 = 1.324_717_957_244_746;
    let step = DVec2::new(1.0 / PLASTIC, 1.0 / (PLASTIC * PLASTIC));
    (0..samples).map(|i| (DVec2::splat(0.5) + step * f64::from(i)).fract()).collect()
}
