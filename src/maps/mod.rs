//! Texture maps, masks and reflection maps, all in the picture's own pixel grid.
//!
//! For a point P of a component the texture is read at project(P), the reflection map at project(mirror(P)): nothing is
//! resampled when maps are built, so the first view is the picture itself whatever the solve said (architecture.md,
//! decision 1). Laid over each other far to near, the layers show the picture to the code.

mod beyond;
mod bodies;
mod coverage;
mod cutout;
mod fill;
mod grid;
mod holes;
mod inpaint;
mod lift;
mod matte;
mod mipmaps;
mod mirror;
mod paper;
mod reflection;
mod rim;
mod seam;
mod skyline;
mod softness;
mod texture;
mod tint;
mod visible;
mod zones;

pub use coverage::{Edge, TourMasks};
pub use grid::{Grid, Layer, snap};
pub use mipmaps::{GUTTER, MIP_LEVELS, Mipmapped, mip_level, mip_size};
pub use reflection::Origin;
pub use tint::{Tint, fresnel};

use coverage::Coverage;
use holes::HoleInput;
use reflection::ReflectionInput;

use serde::{Deserialize, Serialize};

use crate::picture::Picture;
use crate::scene::TourScene;

/// A mean lift above this promises a halo: the fill behind does not match (notes §3.4).
pub const HALO_LIFT: f32 = 0.15;

/// How maps are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MapOptions {
    /// How holes are filled.
    pub fill: Fill,
    /// What reflection maps are made of.
    pub method: Method,
    /// Whether what lies beyond the picture's border is made up of the picture's own matter, or goes on smoothly.
    pub paint_beyond: bool,
}

/// What reflection maps are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Method {
    /// What the water shows; what it does not show is predicted from the direct view, and the other way round.
    Ours,
    /// The picture's water, filled where something stands before it, or a random place of it outside the picture: the
    /// paper's, to compare with.
    Paper,
}

/// How holes are filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Fill {
    /// By a smooth mean of what is around: at once, and blurred.
    Smooth,
    /// By patches of what the same component shows elsewhere: seconds, and sharp.
    Patches,
}

impl Default for MapOptions {
    fn default() -> Self {
        Self { fill: Fill::Patches, method: Method::Ours, paint_beyond: true }
    }
}

impl MapOptions {
    /// The fastest: for previews.
    pub const PREVIEW: Self = Self { fill: Fill::Smooth, method: Method::Ours, paint_beyond: false };
}

/// The maps of one component.
#[derive(Clone, Debug, PartialEq)]
pub struct ComponentMaps {
    /// What it shows directly, with its coverage.
    pub texture: Mipmapped,
    /// What the water shows of it, with its coverage; `None` when nothing of it can be mirrored.
    pub reflection: Option<Mipmapped>,
    /// Where the reflection map's texels came from.
    pub shares: OriginShares,
    /// How much coverage the alpha lift added, mean 0–1; above [`HALO_LIFT`] a halo will show when the camera moves.
    pub mean_lift: f32,
}

/// Shares of a reflection map's part inside the picture by origin, 0–1; they sum to 1, or to 0 for an empty map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OriginShares {
    /// The picture's water shows it.
    pub seen: f32,
    /// Made from the component's own texture by the fitted water.
    pub predicted: f32,
    /// Neither was in the picture.
    pub missing: f32,
}

/// Every image that the scene's components need, in the scene's order.
#[derive(Clone, Debug, PartialEq)]
pub struct Maps {
    /// One entry a component.
    pub components: Vec<ComponentMaps>,
    /// What the picture's water does to what it mirrors.
    pub tint: Tint,
}

impl Maps {
    /// Builds all maps; `progress` is told the share done and a word for the step, and stops the work by returning
    /// `false`, in which case there is no result.
    ///
    /// The masks must have the picture's size, and `masks.billboards` the scene's billboards in their order.
    #[must_use]
    pub fn build(
        scene: &TourScene,
        picture: &Picture,
        masks: &TourMasks,
        options: &MapOptions,
        progress: &dyn Fn(f32, &str) -> bool,
    ) -> Option<Self> {
        let step = |share: f32, what: &str| progress(share, what).then_some(());
        step(0.0, "cutting out")?;
        let cut_out = cutout::cut_out(scene, picture, masks, &|share, what| progress(0.05 * share, what))?;
        let masks = &TourMasks { billboards: cut_out.masks.iter().collect(), ..masks.clone() };
        step(0.05, "who covers what")?;
        let mut coverage = Coverage::of(scene, masks);
        step(0.1, "what the water mirrors")?;
        let mut zones = zones::zones(scene, &coverage);
        let mut owner = bodies::take_in_bodies(scene, picture, &mut coverage, &mut zones);
        let tint = reflection::fit_water(scene, picture, &coverage, &owner);
        rim::give_rims(scene, picture, masks, &tint, &coverage, &mut zones, &mut owner);
        let count = scene.components.len();
        let input = HoleInput {
            scene,
            picture,
            coverage: &coverage,
            cut_out: &cut_out.colors,
            owner: &owner,
            tint: &tint,
            options,
        };
        let direct = (0..count)
            .map(|index| {
                let what = format!("what is behind and beyond: {}", scene.components[index].name);
                let share = |share: f32| 0.15 + 0.55 * (index as f32 + share) / count as f32;
                step(share(0.0), &what)?;
                holes::filled_colors(&input, index, &|done| progress(share(done), &what))
            })
            .collect::<Option<Vec<_>>>()?;
        let by_body = bodies::by_body(scene, &coverage, &zones);
        step(0.7, "reflection maps")?;
        let mut reflections = Vec::with_capacity(count);
        let mut origins = Vec::with_capacity(count);
        for index in 0..count {
            let mirrored = scene.water && (index == 0 || zones[index].is_some());
            let input = ReflectionInput {
                scene,
                picture,
                coverage: &coverage,
                zones: &zones,
                owner: &owner,
                tint: &tint,
                by_body: &by_body,
                direct: &direct[index],
                options,
            };
            let what = format!("what the water shows of: {}", scene.components[index].name);
            let share = |share: f32| 0.7 + 0.2 * (index as f32 + share) / count as f32;
            step(share(0.0), &what)?;
            let map = match mirrored {
                true => {
                    Some(reflection::reflection_map(&input, index, &|done| progress(share(done), &what))?)
                }
                false => None,
            };
            let (layer, origin) = map.unzip();
            reflections.push(layer);
            origins.push(origin.unwrap_or_default());
        }
        step(0.9, "laying the layers over each other")?;
        reflection::lift_reflections(scene, picture, &coverage, &zones, &mut reflections);
        seam::prolong_reflections(scene, &mut reflections);
        let mut textures: Vec<_> = (0..count)
            .map(|index| texture::texture_map(scene, picture, &coverage, &direct[index], index))
            .collect();
        seam::prolong_textures(scene, picture, &coverage, &mut textures);
        texture::lift_textures(scene, picture, &coverage, &zones, &mut textures, &reflections);
        seam::prolong_ground(scene, &mut textures);
        let components = textures
            .into_iter()
            .zip(reflections)
            .zip(origins)
            .enumerate()
            .map(|(index, ((texture, reflection), origin))| ComponentMaps {
                shares: shares(reflection.as_ref(), &origin, picture),
                mean_lift: texture::mean_lift(&texture, &coverage.alpha[index]),
                texture: seam::texture_levels(scene, picture, &coverage, index, &texture),
                reflection: reflection.map(|map| seam::reflection_levels(scene, index, &map)),
            })
            .collect();
        step(1.0, "done")?;
        Some(Self { components, tint })
    }
}

fn shares(layer: Option<&Layer>, origins: &[Origin], picture: &Picture) -> OriginShares {
    let Some(layer) = layer else { return OriginShares::default() };
    let mut counts = [0.0_f32; 3];
    let size = picture.size().as_ivec2();
    for (cell, (texel, origin)) in layer.cells.iter().zip(origins).enumerate() {
        let pixel = layer.pixel(cell);
        let inside = pixel.cmpge(glam::IVec2::ZERO).all() && pixel.cmplt(size).all();
        if inside && texel[3] >= 128 {
            counts[*origin as usize] += 1.0;
        }
    }
    let sum = counts.iter().sum::<f32>().max(1.0);
    OriginShares { seen: counts[0] / sum, predicted: counts[1] / sum, missing: counts[2] / sum }
}
