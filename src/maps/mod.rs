//! Texture maps, masks and reflection maps, all in the picture's own pixel grid.
//!
//! For a point P of a component the texture is read at project(P), the reflection map at project(mirror(P)): nothing is
//! resampled when maps are built, so the first view is the picture itself whatever the solve said (architecture.md,
//! decision 1). Laid over each other far to near, the layers show the picture to the code.

mod beyond;
mod bodies;
mod coverage;
mod fill;
mod grid;
mod lift;
mod mirror;
mod reflection;
mod texture;
mod tint;
mod visible;
mod zones;

pub use coverage::TourMasks;
pub use grid::{Grid, Layer, snap};
pub use reflection::Origin;
pub use tint::{Tint, fresnel};

use coverage::Coverage;
use reflection::ReflectionInput;
use zones::Zone;

use crate::picture::Picture;
use crate::scene::TourScene;

/// A mean lift above this promises a halo: the fill behind does not match (notes §3.4).
pub const HALO_LIFT: f32 = 0.15;

/// The maps of one component.
#[derive(Clone, Debug)]
pub struct ComponentMaps {
    /// What it shows directly, with its coverage.
    pub texture: Layer,
    /// What the water shows of it, with its coverage; `None` when nothing of it can be mirrored.
    pub reflection: Option<Layer>,
    /// Where the reflection map's texels came from.
    pub shares: OriginShares,
    /// How much coverage the alpha lift added, mean 0–1; above [`HALO_LIFT`] a halo will show when the camera moves.
    pub mean_lift: f32,
}

/// Shares of a reflection map's part inside the picture by origin, 0–1; they sum to 1, or to 0 for an empty map.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct OriginShares {
    /// The picture's water shows it.
    pub seen: f32,
    /// Made from the component's own texture by the fitted water.
    pub predicted: f32,
    /// Neither was in the picture.
    pub missing: f32,
}

/// Every image that the scene's components need, in the scene's order.
#[derive(Clone, Debug)]
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
        progress: &dyn Fn(f32, &str) -> bool,
    ) -> Option<Self> {
        let step = |share: f32, what: &str| progress(share, what).then_some(());
        step(0.0, "who covers what")?;
        let mut coverage = Coverage::of(scene, masks);
        step(0.2, "what the water mirrors")?;
        let mut zones = zones::zones(scene, &coverage);
        let owner = bodies::take_in_bodies(scene, picture, &mut coverage, &mut zones);
        let tint = reflection::fit_tint(scene, picture, &coverage, &owner);
        step(0.4, "filling what is hidden")?;
        let count = scene.components.len();
        let direct: Vec<_> = (0..count)
            .map(|index| texture::filled_colors(scene, picture, &coverage, &tint, &owner, index))
            .collect();
        let by_body = bodies::by_body(scene, &coverage, &zones);
        step(0.6, "reflection maps")?;
        let mut reflections = Vec::with_capacity(count);
        let mut origins = Vec::with_capacity(count);
        for index in 0..count {
            let mirrored = scene.water && (index == 0 || zones[index].is_some());
            let (layer, origin) = mirrored
                .then(|| {
                    let input = ReflectionInput {
                        scene,
                        picture,
                        coverage: &coverage,
                        zones: &zones,
                        owner: &owner,
                        tint: &tint,
                        by_body: &by_body,
                        direct: &direct[index],
                    };
                    reflection::reflection_map(&input, index)
                })
                .unzip();
            reflections.push(layer);
            origins.push(origin.unwrap_or_default());
        }
        step(0.8, "laying the layers over each other")?;
        reflection::lift_reflections(scene, picture, &coverage, &zones, &mut reflections);
        let mut textures: Vec<_> = (0..count)
            .map(|index| texture::texture_map(scene, picture, &coverage, &direct[index], index))
            .collect();
        texture::lift_textures(scene, picture, &coverage, &zones, &mut textures, &reflections);
        let components = textures
            .into_iter()
            .zip(reflections)
            .zip(origins)
            .enumerate()
            .map(|(index, ((texture, reflection), origin))| ComponentMaps {
                shares: shares(reflection.as_ref(), &origin, picture),
                mean_lift: texture::mean_lift(&texture, &coverage.alpha[index]),
                texture,
                reflection,
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
