//! Which pixels of a view show what the picture did not, because something stood before it.

use bevy_picture_tour::maps::{Layer, Maps, Mipmapped};
use bevy_picture_tour::picture::{Mask, Picture};
use glam::IVec2;

/// The maps with every texel black that the picture shows, and white that had to be made up inside its border.
pub(super) fn made_up(maps: &Maps, picture: &Picture) -> Maps {
    let mut marked = maps.clone();
    let layers = marked
        .components
        .iter_mut()
        .flat_map(|maps| std::iter::once(&mut maps.texture).chain(&mut maps.reflection));
    for map in layers {
        mark(&mut map.layer, picture);
        *map = Mipmapped::levels_of(map.layer.clone());
    }
    marked
}

fn mark(layer: &mut Layer, picture: &Picture) {
    let end = picture.size().as_ivec2();
    for cell in 0..layer.cells.len() {
        let pixel = layer.pixel(cell);
        let inside = pixel.cmpge(IVec2::ZERO).all() && pixel.cmplt(end).all();
        let [r, g, b, alpha] = layer.cells[cell];
        let shown = !inside || picture.pixel(pixel.x as u32, pixel.y as u32) == [r, g, b];
        let code = if shown { 0 } else { 255 };
        layer.cells[cell] = [code, code, code, alpha];
    }
}

/// The pixels of a view of such maps that show mostly what was made up; `None` when there are none.
pub(super) fn mask(view: &Picture) -> Option<Mask> {
    // 188 is half of all light.
    let values: Vec<u8> = view.pixels().iter().map(|pixel| if pixel[0] > 188 { 255 } else { 0 }).collect();
    Mask::new(view.size(), values).ok().filter(|mask| mask.bounds().is_some())
}
