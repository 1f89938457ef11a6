//! The picture, its masks and the live tour as textures that egui draws.

use std::sync::{Arc, Weak};

use bevy::asset::RenderAssetUsages;
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};
use bevy_egui::{EguiContexts, EguiTextureHandle};

use super::Session;
use crate::editor::egui::TextureId;
use crate::editor::{MaskView, PictureView};
use crate::headless::target_image;
use crate::picture::{DecodedPicture, Mask};

/// Longest side of a texture, pixels; more is neither seen nor held by every device.
const LONGEST: u32 = 4096;

/// What egui draws.
#[derive(Resource, Default)]
pub(super) struct Textures {
    picture: Option<(Arc<DecodedPicture>, TextureId, Handle<Image>)>,
    /// Masks are not held, only recognized: one that is held is copied when it is painted on.
    masks: Vec<(String, Weak<Mask>, TextureId, Handle<Image>)>,
    tour: Option<(UVec2, TextureId, Handle<Image>)>,
}

impl Textures {
    /// Brings textures to what is on the desk.
    pub(super) fn follow(
        &mut self,
        session: &Session,
        images: &mut Assets<Image>,
        contexts: &mut EguiContexts,
    ) {
        let desk = session.desk.as_ref();
        let picture = desk.and_then(|desk| desk.picture());
        let same = match (&self.picture, picture) {
            (Some((old, ..)), Some(new)) => Arc::ptr_eq(old, new),
            (None, None) => true,
            _ => false,
        };
        if !same {
            if let Some((.., old)) = self.picture.take() {
                contexts.remove_image(&old);
            }
            self.picture = picture.map(|picture| {
                let of = &picture.picture;
                let image = scaled_image(of.size(), |at| {
                    let [r, g, b] = of.pixel(at.x, at.y);
                    [r, g, b, 255]
                });
                let handle = images.add(image);
                let id = contexts.add_image(EguiTextureHandle::Strong(handle.clone()));
                (Arc::clone(picture), id, handle)
            });
        }
        let drawn = desk.map(|desk| desk.draft().masks.iter()).into_iter().flatten();
        let mut masks = Vec::new();
        for (name, mask) in drawn {
            let old =
                self.masks.iter().position(|(other, ..)| other == name).map(|i| self.masks.swap_remove(i));
            masks.push(match old {
                Some(old) if std::ptr::eq(old.1.as_ptr(), Arc::as_ptr(mask)) => old,
                old => {
                    // White; egui blends colors that are multiplied by their coverage.
                    let image = scaled_image(mask.size(), |at| [mask.get(at.x, at.y); 4]);
                    let (id, handle) = match old {
                        Some((.., id, handle)) => (id, handle),
                        None => {
                            let handle = images.add(image.clone());
                            (contexts.add_image(EguiTextureHandle::Strong(handle.clone())), handle)
                        }
                    };
                    // What stays is another picture of the same name.
                    let _ = images.insert(&handle, image);
                    (name.to_owned(), Arc::downgrade(mask), id, handle)
                }
            });
        }
        for (_, _, _, gone) in std::mem::replace(&mut self.masks, masks) {
            contexts.remove_image(&gone);
        }
    }

    /// The texture that the tour is drawn into, of a size; another one when the size changes.
    pub(super) fn tour_of(
        &mut self,
        size: UVec2,
        images: &mut Assets<Image>,
        contexts: &mut EguiContexts,
    ) -> Option<Handle<Image>> {
        let size = size.min(UVec2::splat(LONGEST));
        if size.min_element() == 0 || self.tour.as_ref().is_some_and(|(old, ..)| *old == size) {
            return None;
        }
        let handle = images.add(target_image(size));
        let id = contexts.add_image(EguiTextureHandle::Strong(handle.clone()));
        if let Some((.., old)) = self.tour.replace((size, id, handle.clone())) {
            contexts.remove_image(&old);
        }
        Some(handle)
    }

    pub(super) fn tour(&self) -> Option<TextureId> {
        self.tour.as_ref().map(|(_, id, _)| *id)
    }

    /// The picture, at the size to which the document's numbers refer.
    pub(super) fn picture(&self, session: &Session) -> Option<PictureView> {
        let (picture, texture, _) = self.picture.as_ref()?;
        let marked = session.desk.as_ref()?.tour().picture.size;
        Some(PictureView { texture: *texture, size: marked.unwrap_or(picture.picture.size()) })
    }

    pub(super) fn masks(&self) -> Vec<MaskView<'_>> {
        self.masks.iter().map(|(name, _, texture, _)| MaskView { name, texture: *texture }).collect()
    }
}

/// An image of a raster, every n-th pixel of one that is too large.
fn scaled_image(size: UVec2, pixel: impl Fn(UVec2) -> [u8; 4]) -> Image {
    let step = size.max_element().div_ceil(LONGEST).max(1);
    let small = size / step;
    // Written out, which takes a sixth of the time of nested iterators: it is done for each piece of a brush stroke.
    let mut data = Vec::with_capacity(4 * small.x as usize * small.y as usize);
    for y in 0..small.y {
        for x in 0..small.x {
            data.extend_from_slice(&pixel(UVec2::new(x, y) * step));
        }
    }
    let extent = Extent3d { width: small.x, height: small.y, depth_or_array_layers: 1 };
    let format = TextureFormat::Rgba8UnormSrgb;
    Image::new(extent, TextureDimension::D2, data, format, RenderAssetUsages::RENDER_WORLD)
}
