//! What the water shows: the mirrored ray and the reflection maps it reads. Twin of `water.wgsl`.

use glam::{DVec2, DVec3, Vec4};

use super::{Accumulated, Look, OPAQUE, Reference, cross_faded};
use crate::camera::Ray;
use crate::maps::MIP_LEVELS;
use crate::maps::Mipmapped;
use crate::picture::PicturePoint;
use crate::scene::Role;
use crate::scene::Surface;
use crate::scene::mirror;

/// A mirrored ray climbs at least this steeply; steep waves would send it under the water (notes §8.2).
const LEAST_CLIMB: f64 = 1e-5;

/// Upright blur (notes §8.4): looks above and below the middle one, how far they are apart in standard deviations, texels of a
/// mip level for each deviation, and deviations that count, texels.
const LOOKS: i32 = 2;
const APART: f64 = 0.85;
const BLUR_TEXELS: f64 = 0.6;
const LEAST_BLUR: f64 = 0.1;
const MOST_BLUR: f64 = 24.0;
/// The same across, where grazing waves hardly blur.
const ACROSS_TEXELS: f64 = 1.5;

/// A mirrored ray.
struct Up {
    /// Its direction is of unit length.
    ray: Ray,
    /// Sine of the angle between the camera's ray and the surface.
    grazing: f32,
    /// Meters from the camera to the water.
    to_water: f64,
    /// Standard deviation of the slopes that the pixel does not resolve.
    blur: f64,
}

/// How unresolved waves blur what lies behind them.
#[derive(Clone, Copy)]
struct Blur {
    /// Mip level.
    level: f32,
    /// Standard deviation upwards and downwards, picture pixels; 0 for none.
    upright: f64,
}

impl Blur {
    /// A map at a picture point, blurred upright: looks one above the other, each weighing as much as it covers.
    fn sample(self, at: PicturePoint, map: impl Fn(PicturePoint, f32) -> [f32; 4]) -> [f32; 4] {
        let looks = if self.upright > 0.0 { LOOKS } else { 0 };
        let (mut sum, mut weights) = (Vec4::ZERO, 0.0);
        for i in -looks..=looks {
            let away = APART * f64::from(i);
            let weight = (-0.5 * away * away).exp() as f32;
            let texel = Vec4::from(map(PicturePoint(at.0 + away * self.upright * DVec2::Y), self.level));
            sum += weight * (texel.w * texel).with_w(texel.w);
            weights += weight;
        }
        (sum / sum.w.max(1e-6)).with_w(sum.w / weights).to_array()
    }
}

impl Reference<'_> {
    /// What the water shows to a ray that goes down to it.
    pub(super) fn mirrored(&self, ray: Ray, look: &Look) -> [f32; 3] {
        let incoming = ray.direction.normalize();
        let to = |height: f64| Ray { direction: incoming, ..ray }.at((height - ray.origin.y) / incoming.y);
        let mut at = to(0.0);
        // Along the view a pixel covers this many meters of the water.
        let footprint = at.distance(ray.origin) / (look.focal_px * -incoming.y);
        let mut water = self.water.at(DVec2::new(at.x, at.z), footprint);
        if water.height != 0.0 {
            // One step towards where the ray meets the displaced surface (notes §8.3).
            at = to(water.height.min(0.5 * ray.origin.y));
            water = self.water.at(DVec2::new(at.x, at.z), footprint);
        }
        let normal = water.normal();
        let mut direction = incoming - 2.0 * incoming.dot(normal) * normal;
        direction.y = direction.y.max(LEAST_CLIMB);
        let up = Up {
            ray: Ray { origin: at, direction },
            grazing: -incoming.dot(normal) as f32,
            to_water: at.distance(ray.origin),
            // The picture's own ripples are in its maps already.
            blur: (water.roughness - f64::from(self.maps.tint.slope).powi(2)).max(0.0).sqrt(),
        };

        let mut light = Accumulated::default();
        // The ground is level: which walls it hides depends on the ray.
        let mut ground = self.scene.ground().and_then(|index| self.mirror_hit(index, &up, look));
        for index in self.scene.walls_of(&look.arrangement.near_to_far) {
            let Some((t, texel)) = self.mirror_hit(index, &up, look) else { continue };
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
            surface => surface.meet(up.ray).map(|t| (t, mirror(up.ray.at(t)))),
        };
        let [r, g, b, _] = match met {
            Some((t, point)) => self.read_mirrored(last, look, &up, t, point, point, None),
            None => {
                let away = mirror(up.ray.direction);
                let (at, depth) = self.eye.see_far(away);
                let blur = self.blur(&up, 1.0, look.level(self.scene, away, depth));
                // In the water clouds that rise sink.
                let sinking = DVec2::new(1.0, -1.0);
                let sky = blur.sample(at, |at, level| self.drifted(last, at, level, sinking));
                self.at_angle(sky, up.ray.direction, up.grazing)
            }
        };
        light.add([r, g, b, 1.0]);
        light.color
    }

    /// Where a mirrored ray meets a component above the water, and the texel of its reflection map there.
    fn mirror_hit(&self, index: usize, up: &Up, look: &Look) -> Option<(f64, [f32; 4])> {
        let map = self.maps.components[index].reflection.as_ref()?;
        let component = &self.scene.components[index];
        debug_assert!(component.role != Role::LastLayer, "the last layer is met by all rays");
        let met = self.meet(look, index, up.ray)?;
        (met.point.y >= 0.0).then(|| {
            let copy = self.mirrored_copy(index, met.rest.0).map(|(copy, share)| (mirror(copy), share));
            let [point, rest] = [met.point, met.rest.0].map(mirror);
            (met.t, self.read_mirrored(map, look, up, met.t, point, rest, copy))
        })
    }

    /// A reflection map at the mirror image `rest` that is seen at `point`, `t` meters behind the water; `copy` is what a
    /// mirrored copy shows there, with its share.
    fn read_mirrored(
        &self,
        map: &Mipmapped,
        look: &Look,
        up: &Up,
        t: f64,
        point: DVec3,
        rest: DVec3,
        copy: Option<(DVec3, f32)>,
    ) -> [f32; 4] {
        let (at, depth) = self.eye.see(rest);
        let behind = t / (t + up.to_water);
        let blur = self.blur(up, behind, look.level(self.scene, point - look.position, depth));
        let sample = |at: PicturePoint| blur.sample(at, |at, level| map.sample(at, level));
        let texel = sample(at);
        let texel = match copy {
            Some((copy, share)) => cross_faded(texel, sample(self.eye.see(copy).0), share),
            None => texel,
        };
        self.at_angle(texel, self.scene.camera.pose.position - rest, up.grazing)
    }

    /// How what lies `behind` the water by this share of the way is blurred, where pixels see it at a mip level anyway.
    fn blur(&self, up: &Up, behind: f64, seen: f32) -> Blur {
        let deviation = (2.0 * self.scene.camera.intrinsics.focal_px * up.blur * behind).min(MOST_BLUR);
        if deviation < LEAST_BLUR {
            return Blur { level: seen, upright: 0.0 };
        }
        let texels = BLUR_TEXELS.max(ACROSS_TEXELS * f64::from(up.grazing)) * deviation;
        // From a deviation of one texel on the coarser levels are read, which cost one fetch each.
        let level = texels.max(1.0).log2().max(deviation.min(1.0)) as f32;
        Blur { level: seen.max(level).min(MIP_LEVELS as f32), upright: deviation }
    }

    /// A texel of the water, from which `was` goes up to the picture's camera, for another grazing angle (its sine).
    fn at_angle(&self, [r, g, b, alpha]: [f32; 4], was: DVec3, grazing: f32) -> [f32; 4] {
        let [r, g, b] = self.maps.tint.at_angle([r, g, b], (was.y / was.length()) as f32, grazing);
        [r, g, b, alpha]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blur_spreads_upright_alone_and_weighs_by_coverage() {
        let blur = Blur { level: 2.0, upright: 3.0 };
        let at = PicturePoint::new(10.0, 20.0);
        let off = |point: PicturePoint| point.0 - at.0;
        // Means of x, of y and of the square of y where all is covered: the mip level makes up for what looks leave out.
        let [x, y, squares, coverage] = blur.sample(at, |point, level| {
            assert_eq!(level, 2.0);
            let off = off(point).as_vec2();
            [off.x, off.y, off.y * off.y, 1.0]
        });
        assert!(x == 0.0 && y.abs() < 1e-6 && (coverage - 1.0).abs() < 1e-6, "{x} {y} {coverage}");
        assert!((0.8 * 9.0..9.0).contains(&squares), "variance {squares} px² of 9");
        // Above the place all is covered and bright, below nothing: dark colors of nothing do not count.
        let [light, .., coverage] =
            blur.sample(at, |point, _| if off(point).y < 0.0 { [1.0; 4] } else { [0.0; 4] });
        assert!((light - 1.0).abs() < 1e-6 && (0.2..0.5).contains(&coverage), "{light} {coverage}");
        // Still water looks once.
        let still = Blur { level: 0.0, upright: 0.0 };
        let texel = [0.3, 0.2, 0.1, 0.5];
        let found = still.sample(at, |_, _| texel);
        assert!((0..4).all(|c| (found[c] - texel[c]).abs() < 1e-7), "{found:?}");
    }
}
