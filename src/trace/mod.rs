//! The reference ray tracer: the definition of right, and image comparison.
//!
//! The paper's rendering (its section on rendering; notes §8.1): billboards near to far, ground, backdrops, water
//! last; at the water the ray is mirrored and reads reflection maps instead of texture maps. Soft masks are composited
//! in linear light; whatever a ray misses, it ends in the last layer, at infinity. Needs no engine and no GPU.

pub mod compare;
mod eye;
mod water_surface;

pub use water_surface::{StillWater, WaterPoint, WaterSurface};

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
use crate::scene::Role;
use crate::scene::Surface;
use crate::scene::TourScene;
use crate::scene::mirror;

/// Less light than this is left behind a layer: half a display code cannot change any more.
const OPAQUE: f32 = 1.0 / 8192.0;

/// A mirrored ray climbs at least this steeply; steep waves would send it under the water (notes §8.2).
const LEAST_CLIMB: f64 = 1e-5;

/// A scene with its maps, ready to be looked at.
pub struct Reference<'a> {
    scene: &'a TourScene,
    maps: &'a Maps,
    water: &'a dyn WaterSurface,
    eye: Eye,
}

impl std::fmt::Debug for Reference<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Reference").field("scene", self.scene).finish_non_exhaustive()
    }
}

impl<'a> Reference<'a> {
    /// A reference of still water.
    #[must_use]
    pub fn new(scene: &'a TourScene, maps: &'a Maps) -> Self {
        Self::with_water(scene, maps, &StillWater)
    }

    /// A reference whose water has the given heights and normals.
    #[must_use]
    pub fn with_water(scene: &'a TourScene, maps: &'a Maps, water: &'a dyn WaterSurface) -> Self {
        Self { scene, maps, water, eye: Eye::of(&scene.camera) }
    }

    /// Renders what `camera` sees, `samples` rays a pixel (at least 1; one goes through the pixel's center), on all
    /// cores. Samples are averaged in linear light.
    #[must_use]
    pub fn render(&self, camera: &PinholeCamera, samples: u32) -> Picture {
        let size = camera.intrinsics.size.max(UVec2::ONE);
        let offsets = sample_offsets(samples);
        let look = Look::of(camera, self.scene);
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
            if let Some(met) = look.arrangement.meet(self.scene, index, ray) {
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

    /// What the water shows to a ray that goes down to it.
    fn mirrored(&self, ray: Ray, look: &Look) -> [f32; 3] {
        let mut at = ray.at(-ray.origin.y / ray.direction.y);
        let mut water = self.water.at(DVec2::new(at.x, at.z));
        if water.height != 0.0 {
            // One step towards where the ray meets the displaced surface (notes §8.3).
            at = ray.at((water.height - ray.origin.y) / ray.direction.y);
            water = self.water.at(DVec2::new(at.x, at.z));
        }
        let incoming = ray.direction.normalize();
        let mut direction = incoming - 2.0 * incoming.dot(water.normal) * water.normal;
        direction.y = direction.y.max(LEAST_CLIMB);
        let up = Ray { origin: at, direction };

        let mut light = Accumulated::default();
        // The ground is level: which walls it hides depends on the ray.
        let mut ground = self.scene.ground().and_then(|index| self.mirror_hit(index, up, look));
        for index in self.scene.walls_of(&look.arrangement.near_to_far) {
            let Some((t, texel)) = self.mirror_hit(index, up, look) else { continue };
            if let Some((_, texel)) = ground.take_if(|(t_ground, _)| *t_ground < t) {
                light.add(texel);
            }
            light.add(texel);
            if light.left < OPAQUE {
                return light.color;
            }
        }
        if let Some((_, texel)) = ground {
            light.add(texel);
        }
        let Some(last) = &self.maps.components[0].reflection else { return light.color };
        let met = match self.scene.last_layer().surface {
            Surface::Infinity => None,
            surface => surface.meet(up).map(|t| mirror(up.at(t))),
        };
        let [r, g, b, _] = match met {
            Some(point) => self.read_mirrored(last, look, point, point),
            None => {
                self.at_angle(self.read_far(last, look, mirror(up.direction)), up.direction, up.direction)
            }
        };
        light.add([r, g, b, 1.0]);
        light.color
    }

    /// Where a mirrored ray meets a component above the water, and the texel of its reflection map there.
    fn mirror_hit(&self, index: usize, up: Ray, look: &Look) -> Option<(f64, [f32; 4])> {
        let map = self.maps.components[index].reflection.as_ref()?;
        let component = &self.scene.components[index];
        debug_assert!(component.role != Role::LastLayer, "the last layer is met by all rays");
        let met = look.arrangement.meet(self.scene, index, up)?;
        (met.point.y >= 0.0)
            .then(|| (met.t, self.read_mirrored(map, look, mirror(met.point), mirror(met.rest.0))))
    }

    /// A reflection map at the mirror image `rest` that is seen at `point`, for the angle at which it is seen.
    fn read_mirrored(&self, map: &Mipmapped, look: &Look, point: DVec3, rest: DVec3) -> [f32; 4] {
        let was = self.scene.camera.pose.position - rest;
        self.at_angle(self.read(map, look, point, rest), was, look.position - point)
    }

    /// A texel of the water, from which `was` goes up to the picture's camera, for a camera to which `is` goes.
    fn at_angle(&self, [r, g, b, alpha]: [f32; 4], was: DVec3, is: DVec3) -> [f32; 4] {
        let [was, is] = [was, is].map(|up| (up.y / up.length()) as f32);
        let [r, g, b] = self.maps.tint.at_angle([r, g, b], was, is);
        [r, g, b, alpha]
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
    fn of(camera: &PinholeCamera, scene: &TourScene) -> Self {
        Self {
            position: camera.pose.position,
            forward: camera.pose.rotation * DVec3::NEG_Z,
            focal_px: camera.intrinsics.focal_px,
            arrangement: scene.arranged_for(camera.pose.position),
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
