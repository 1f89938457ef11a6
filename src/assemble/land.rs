//! Where a tour's picture shows land: what neither water is nor stands in it.

use glam::IVec2;
use rayon::prelude::*;

use super::AssembledTour;
use crate::maps::GUTTER;
use crate::maps::Layer;
use crate::picture::Mask;
use crate::scene::Role;
use crate::tour::Tour;

impl AssembledTour {
    /// Coverage of the picture by land and what is behind it: backdrops, ground and its banks, also where objects of `tour`
    /// hide them.
    #[must_use]
    pub fn land(&self, tour: &Tour) -> Option<Mask> {
        let is_object = |name: &str| tour.objects.iter().any(|object| object.name == name);
        let layers: Vec<&Layer> = self
            .scene
            .components
            .iter()
            .zip(&self.maps.components)
            .filter(|(component, _)| component.role != Role::Billboard || !is_object(&component.name))
            .map(|(_, maps)| &maps.texture.layer)
            .collect();
        let size = self.scene.camera.intrinsics.size;
        let values = (0..size.y as usize * size.x as usize)
            .into_par_iter()
            .with_min_len(4096)
            .map(|index| {
                let pixel = IVec2::new(index as i32 % size.x as i32, index as i32 / size.x as i32);
                layers.iter().map(|layer| coverage(layer, pixel)).max().unwrap_or(0)
            })
            .collect();
        Mask::new(size, values).ok()
    }
}

/// A layer's coverage of a pixel; its prolonged border covers nothing.
fn coverage(layer: &Layer, pixel: IVec2) -> u8 {
    let low = layer.origin + GUTTER as i32;
    let high = layer.origin + layer.size.as_ivec2() - GUTTER as i32;
    let is_inside = pixel.cmpge(low).all() && pixel.cmplt(high).all();
    layer.get(pixel).filter(|_| is_inside).map_or(0, |texel| texel[3])
}
