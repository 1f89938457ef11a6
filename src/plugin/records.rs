//! The small float texture that tells the shaders about views and components.
//!
//! Rows 0 to 7 belong to views, row 8 to the components; the layout stands in `material/tour.wgsl`. It is written in
//! place each frame that anything changed, so no material is touched.

use bevy::asset::RenderAssetUsages;
use bevy::image::Image;
use bevy::math::{DAffine3, Mat4, Vec4};
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};

use super::atlas::Place;
use crate::maps::Layer;
use crate::scene::MAX_COMPONENTS;
use crate::scene::Surface;

/// How many cameras can look at one tour in one frame.
pub(super) const MAX_VIEWS: usize = 8;

const TEXELS_PER_COMPONENT: usize = 4;
const WIDTH: usize = MAX_COMPONENTS * TEXELS_PER_COMPONENT;
const HEIGHT: usize = MAX_VIEWS + 1;

/// One camera's look at a tour.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ViewRecord {
    /// The camera's world-from-view as the shader knows it; by it a fragment finds its row.
    pub world_from_view: Mat4,
    /// The same camera in the tour's space, computed in f64.
    pub tour_from_view: DAffine3,
    /// Billboards and bands near to far.
    pub walls_near_to_far: Vec<usize>,
    /// The ground's index.
    pub ground: Option<usize>,
}

/// The texture's values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Records(Vec<Vec4>);

impl Records {
    /// Records without any view.
    pub(super) fn new() -> Self {
        let mut records = Self(vec![Vec4::ZERO; WIDTH * HEIGHT]);
        records.set_views(&[]);
        records
    }

    /// Writes the views' rows; those beyond [`MAX_VIEWS`] are left out.
    pub(super) fn set_views(&mut self, views: &[ViewRecord]) {
        for row in 0..MAX_VIEWS {
            let texels = &mut self.0[row * WIDTH..(row + 1) * WIDTH];
            let Some(view) = views.get(row) else {
                texels[5].w = -1.0;
                continue;
            };
            for (texel, axis) in texels.iter_mut().zip(view.world_from_view.to_cols_array_2d()) {
                *texel = Vec4::from(axis);
            }
            let ground = view.ground.map_or(-1.0, |index| index as f32);
            let to = view.tour_from_view;
            texels[4] = to.matrix3.x_axis.as_vec3().extend(0.0);
            texels[5] = to.matrix3.y_axis.as_vec3().extend(view.walls_near_to_far.len() as f32);
            texels[6] = to.matrix3.z_axis.as_vec3().extend(ground);
            texels[7] = to.translation.as_vec3().extend(0.0);
            for (place, &index) in view.walls_near_to_far.iter().enumerate() {
                texels[8 + place / 4][place % 4] = index as f32;
            }
        }
    }

    /// Writes one component: its plane, and where its reflection map lies.
    pub(super) fn set_component(&mut self, index: usize, surface: &Surface, map: Option<(&Layer, Place)>) {
        let first = MAX_VIEWS * WIDTH + index * TEXELS_PER_COMPONENT;
        let texels = &mut self.0[first..first + TEXELS_PER_COMPONENT];
        match surface {
            Surface::Wall(wall) => {
                let normal = wall.normal();
                let along_of_foot = wall.foot.dot(wall.along);
                let span = wall.span.map(|s| s + along_of_foot);
                texels[0] = Vec4::new(0.0, normal.x as f32, normal.y as f32, normal.dot(wall.foot) as f32);
                texels[1] =
                    Vec4::new(span[0] as f32, span[1] as f32, wall.rise[0] as f32, wall.rise[1] as f32);
            }
            Surface::Level(level) => {
                texels[0] = Vec4::new(1.0, 0.0, 0.0, level.height as f32);
                texels[1] = Vec4::new(
                    level.low.x as f32,
                    level.high.x as f32,
                    level.low.y as f32,
                    level.high.y as f32,
                );
            }
            Surface::Infinity => {
                texels[0] = Vec4::new(2.0, 0.0, 1.0, 0.0);
                texels[1] = Vec4::ZERO;
            }
        }
        if let Some((layer, place)) = map {
            let (origin, size) = (layer.origin.as_vec2(), layer.size.as_vec2());
            texels[2] = Vec4::new(origin.x, origin.y, size.x, size.y);
            texels[3] = Vec4::new(place.at.x as f32, place.at.y as f32, place.scale, 1.0);
        }
    }

    /// The texture's bytes.
    pub(super) fn bytes(&self) -> Vec<u8> {
        self.0.iter().flat_map(Vec4::to_array).flat_map(f32::to_le_bytes).collect()
    }

    /// A texture that holds these records.
    pub(super) fn image(&self) -> Image {
        let size = Extent3d { width: WIDTH as u32, height: HEIGHT as u32, depth_or_array_layers: 1 };
        Image::new(
            size,
            TextureDimension::D2,
            self.bytes(),
            TextureFormat::Rgba32Float,
            RenderAssetUsages::RENDER_WORLD | RenderAssetUsages::MAIN_WORLD,
        )
    }
}

#[cfg(test)]
mod tests {
    use bevy::math::DVec2;

    use super::*;
    use crate::scene::Wall;

    #[test]
    fn a_wall_s_record_says_where_its_points_are() {
        let along = DVec2::new(3.0, -4.0) / 5.0;
        let wall = Wall { foot: DVec2::new(2.0, -10.0), along, span: [-1.0, 5.0], rise: [-0.5, 4.0] };
        let mut records = Records::new();
        records.set_component(3, &Surface::Wall(wall), None);
        let first = MAX_VIEWS * WIDTH + 3 * TEXELS_PER_COMPONENT;
        let (plane, extent) = (records.0[first], records.0[first + 1]);
        let point = wall.point(5.0, 1.0).as_vec3();
        // The shader's own formulas: normal · (x, z) = offset, and along = (normal.y, −normal.x).
        let off = plane.y * point.x + plane.z * point.z - plane.w;
        assert!(off.abs() < 1e-5, "{off} m off the plane");
        let s = plane.z * point.x - plane.y * point.z;
        assert!((s - extent.y).abs() < 1e-5, "{s} instead of {} m along", extent.y);
    }
}
