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
use crate::motion::Moment;
use crate::picture::Picture;
use crate::picture::PicturePoint;
use crate::picture::color::srgb_from_linear3;
use crate::scene::Arrangement;
use crate::scene::Meeting;
use crate::scene::Surface;
use crate::scene::TourScene;
use crate::water::{StillWater, WaterSurface};
use crate::wind::CloudCopy;

/// Less light than this is left behind a layer: half a display code cannot change any more.
const OPAQUE: f32 = 1.0 / 8192.0;

/// A scene with its maps, ready to be looked at.
pub struct Reference<'a> {
    scene: &'a TourScene,
    maps: &'a Maps,
    water: &'a dyn WaterSurface,
    moment: Option<&'a Moment>,
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
        Self { scene, maps, water: &StillWater, moment: None, eye }
    }

    /// The same with moving water.
    #[must_use]
    pub fn with_water(self, water: &'a dyn WaterSurface) -> Self {
        Self { water, ..self }
    }

    /// The same at a moment of the scene's motion.
    #[must_use]
    pub fn at_moment(self, moment: &'a Moment) -> Self {
        Self { moment: Some(moment), ..self }
    }

    /// Renders what `camera` sees, `samples` rays a pixel (at least 1; one goes through the pixel's center), on all
    /// cores. Samples are averaged in linear light.
    #[must_use]
    pub fn render(&self, camera: &PinholeCamera, samples: u32) -> Picture {
        let size = camera.intrinsics.size.max(UVec2::ONE);
        let offsets = sample_offsets(samples);
        let moved = self.moment.map_or(&[][..], |moment| &moment.placements);
        let look = Look::of(camera, self.scene.arranged_for(camera.pose.position, moved));
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
                    self.read(index, look, &met)
                } else {
                    self.read_far(look, ray.direction)
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
            let [r, g, b, _] = self.read_far(look, ray.direction);
            [r, g, b]
        };
        light.add([last[0], last[1], last[2], 1.0]);
        light.color
    }

    /// A component's texture map where it is met.
    fn read(&self, index: usize, look: &Look, met: &Meeting) -> [f32; 4] {
        let map = &self.maps.components[index].texture;
        let (at, depth) = self.eye.see(met.rest.0);
        let level = look.level(self.scene, met.point - look.position, depth);
        let texel = map.sample(at, level);
        match self.mirrored_copy(index, met.rest.0) {
            Some((copy, share)) => cross_faded(texel, map.sample(self.eye.see(copy).0, level), share),
            None => texel,
        }
    }

    /// The last layer's texture map infinitely far in a direction.
    fn read_far(&self, look: &Look, direction: DVec3) -> [f32; 4] {
        let (at, depth) = self.eye.see_far(direction);
        let level = look.level(self.scene, direction, depth);
        self.drifted(&self.maps.components[0].texture, at, level, DVec2::ONE)
    }

    /// A map of the sky where its clouds are now; `way` turns their way round, as water does.
    fn drifted(&self, map: &Mipmapped, at: PicturePoint, level: f32, way: DVec2) -> [f32; 4] {
        let copies = self.moment.map_or(CloudCopy::STILL, |moment| moment.clouds);
        let [first, second] = copies.map(|copy| {
            let texel = map.sample(PicturePoint(at.0 - copy.offset_px * way), level);
            texel.map(|channel| copy.weight as f32 * channel)
        });
        std::array::from_fn(|channel| first[channel] + second[channel])
    }

    /// What the mirrored copy of a wall shows where the point `rest` of it is, and the copy's share if it has any.
    fn mirrored_copy(&self, index: usize, rest: DVec3) -> Option<(DVec3, f32)> {
        let share = *self.moment?.mirrored.get(index)?;
        let Surface::Wall(wall) = &self.scene.components[index].surface else { return None };
        (share > 0.0).then(|| (wall.point(-wall.along_of(rest), rest.y), share))
    }

    /// Where a ray meets a component, and the point that is there when nothing moves.
    fn meet(&self, look: &Look, index: usize, ray: Ray) -> Option<Meeting> {
        let mut met = look.arrangement.meet(self.scene, index, ray)?;
        if let (Surface::Wall(wall), Some(sway)) =
            (&self.scene.components[index].surface, self.moment.and_then(|moment| moment.sways.get(index)))
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

/// A texel with coverage and the one that takes its place, by a share. Twin of `cross_faded` in `tour.wgsl`.
fn cross_faded(texel: [f32; 4], other: [f32; 4], share: f32) -> [f32; 4] {
    let between = |a: f32, b: f32| a + share * (b - a);
    let coverage = between(texel[3], other[3]);
    let light = |c: usize| between(texel[3] * texel[c], other[3] * other[c]) / coverage.max(1e-6);
    [light(0), light(1), light(2), coverage]
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
