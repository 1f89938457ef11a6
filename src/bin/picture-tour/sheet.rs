//! A sheet to judge a tour by: the picture, what stands behind everything, and what is seen from four other places.
//!
//! Drawn by the reference tracer, so it needs no graphics card.

use std::path::Path;

use bevy_picture_tour::assemble::AssembledTour;
use bevy_picture_tour::camera::PinholeCamera;
use bevy_picture_tour::maps::Maps;
use bevy_picture_tour::picture::{PicturePoint, PngPixels, save_png};
use bevy_picture_tour::scene::BEYOND_BORDER;
use bevy_picture_tour::scene::Role;
use bevy_picture_tour::scene::TourScene;
use bevy_picture_tour::trace::Reference;
use glam::{DVec2, DVec3, UVec2};

use crate::failure::Failure;

/// Widest view of a sheet, pixels.
const WIDEST: u32 = 960;
/// Between views, pixels.
const GAP: u32 = 8;
const COLUMNS: u32 = 3;
/// Rays a pixel.
const SAMPLES: u32 = 4;
/// How far the other views go, as a share of how far a visitor may.
const REACH: f64 = 0.7;

/// Draws the sheet of a tour into a PNG file.
///
/// # Errors
///
/// [`Failure::CannotRun`] when the file cannot be written.
pub(crate) fn save(tour: &AssembledTour, path: &Path) -> Result<(), Failure> {
    let AssembledTour { scene, maps, .. } = tour;
    let own = scene.camera;
    let size = own.intrinsics.size;
    let scale = f64::from(WIDEST.min(size.x)) / f64::from(size.x);
    let own = framed(own, DVec2::ZERO, scale);
    let (behind, behind_maps) = backdrops(scene, maps);
    let wide = framed(scene.camera, size.as_dvec2() * BEYOND_BORDER, scale / (1.0 + 2.0 * BEYOND_BORDER));
    let low = scene.bounds.low - own.pose.position;
    let high = scene.bounds.high - own.pose.position;
    let moves = [DVec3::new(low.x, 0.0, 0.0), DVec3::new(high.x, 0.0, 0.0), low.with_x(0.0).with_y(0.0), {
        high.with_x(0.0).with_z(0.0)
    }];
    let views = Reference::new(scene, maps);
    let mut tiles =
        vec![views.render(&own, SAMPLES), Reference::new(&behind, &behind_maps).render(&wide, SAMPLES)];
    tiles.extend(moves.map(|by| {
        let mut camera = own;
        camera.pose.position += REACH * by;
        views.render(&camera, SAMPLES)
    }));

    let tile = own.intrinsics.size;
    let rows = (tiles.len() as u32).div_ceil(COLUMNS);
    let sheet = UVec2::new(COLUMNS, rows) * (tile + GAP) - GAP;
    let mut pixels = vec![[255; 3]; sheet.x as usize * sheet.y as usize];
    for (place, view) in (0..).zip(&tiles) {
        let at = UVec2::new(place % COLUMNS, place / COLUMNS) * (tile + GAP);
        for (row, view) in (at.y..).zip(view.rows()) {
            let start = row as usize * sheet.x as usize + at.x as usize;
            let width = view.len().min(tile.x as usize);
            pixels[start..start + width].copy_from_slice(&view[..width]);
        }
    }
    save_png(path, sheet, PngPixels::Rgb(&pixels))
        .map_err(|error| Failure::CannotRun(format!("{} cannot be written: {error}", path.display())))
}

/// A camera at another scale that sees `margin` pixels more on each side.
fn framed(camera: PinholeCamera, margin: DVec2, scale: f64) -> PinholeCamera {
    let mut framed = camera;
    let lens = camera.intrinsics;
    framed.intrinsics.focal_px = lens.focal_px * scale;
    framed.intrinsics.principal = PicturePoint((lens.principal.0 + margin) * scale);
    framed.intrinsics.size =
        ((lens.size.as_dvec2() + 2.0 * margin) * scale).round().as_uvec2().max(UVec2::ONE);
    framed
}

/// The scene without what stands in it.
fn backdrops(scene: &TourScene, maps: &Maps) -> (TourScene, Maps) {
    let kept = |index: usize| scene.components[index].role != Role::Billboard;
    let (mut scene_left, mut maps_left) = (scene.clone(), maps.clone());
    let mut index = 0..;
    scene_left.components.retain(|_| kept(index.next().unwrap_or(0)));
    let mut index = 0..;
    maps_left.components.retain(|_| kept(index.next().unwrap_or(0)));
    (scene_left, maps_left)
}
