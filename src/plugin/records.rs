//! The small float texture that tells the shaders about views and components.
//!
//! Rows 0 to 7 belong to views and say where each finds the components, row 8 says what the components are, row 9 how they
//! sway, row 10 what water and clouds do; the layout stands in `material/tour.wgsl` and `material/waves.wgsl`. It is written in place each frame that anything changed, so no material is touched.

use bevy::asset::RenderAssetUsages;
use bevy::image::Image;
use bevy::math::{DAffine3, DVec2, Mat4, Vec4};
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};

use super::atlas::Place;
use crate::maps::Layer;
use crate::scene::MAX_COMPONENTS;
use crate::scene::Placement;
use crate::scene::Surface;
use crate::water::ripples::Ripples;
use crate::water::sea::SeaSurface;
use crate::wind::CloudCopy;
use crate::wind::SwayRecord;

/// How many cameras can look at one tour in one frame.
pub(super) const MAX_VIEWS: usize = 8;

const TEXELS_PER_COMPONENT: usize = 5;
/// Where a view's row begins to say where the components are, and how many texels each takes.
const FIRST_PLACEMENT: usize = 8 + MAX_COMPONENTS / 4;
const TEXELS_PER_PLACEMENT: usize = 3;
const TEXELS_PER_SWAY: usize = 8;
const WIDTH: usize = MAX_COMPONENTS * TEXELS_PER_SWAY;
const _: () = assert!(FIRST_PLACEMENT + MAX_COMPONENTS * TEXELS_PER_PLACEMENT <= WIDTH);
const COMPONENT_ROW: usize = MAX_VIEWS;
const SWAY_ROW: usize = MAX_VIEWS + 1;
const WATER_ROW: usize = MAX_VIEWS + 2;
/// First of the two texels of the water's row that are the clouds'.
const CLOUDS: usize = 6;
const HEIGHT: usize = MAX_VIEWS + 3;

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
    /// Where each wall is, by component.
    pub placements: Vec<Option<Placement>>,
    /// Share of the mirrored copy, by component; it may be shorter.
    pub mirrored: Vec<f32>,
}

/// The texture's values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Records(Vec<Vec4>);

impl Records {
    /// Records without any view.
    pub(super) fn new() -> Self {
        let mut records = Self(vec![Vec4::ZERO; WIDTH * HEIGHT]);
        records.set_views(&[]);
        records.set_clouds(&CloudCopy::STILL);
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
            let placements = texels[FIRST_PLACEMENT..].chunks_exact_mut(TEXELS_PER_PLACEMENT);
            for (index, (texels, placement)) in placements.zip(&view.placements).enumerate() {
                if let Some(Placement { origin, along, up }) = placement {
                    texels.copy_from_slice(&[origin, along, up].map(|vector| vector.as_vec3().extend(0.0)));
                    texels[0].w = view.mirrored.get(index).copied().unwrap_or(0.0);
                }
            }
        }
    }

    /// Writes one component: its plane, and where its reflection map lies.
    pub(super) fn set_component(&mut self, index: usize, surface: &Surface, map: Option<(&Layer, Place)>) {
        let first = COMPONENT_ROW * WIDTH + index * TEXELS_PER_COMPONENT;
        let texels = &mut self.0[first..first + TEXELS_PER_COMPONENT];
        let extent = |along: [f64; 2], up: [f64; 2]| {
            Vec4::new(along[0] as f32, along[1] as f32, up[0] as f32, up[1] as f32)
        };
        match surface {
            Surface::Wall(wall) => {
                let [foot, along] = [wall.foot, wall.along].map(DVec2::as_vec2);
                texels[0] = Vec4::ZERO;
                texels[1] = Vec4::new(foot.x, foot.y, along.x, along.y);
                texels[2] = extent(wall.span, wall.rise);
            }
            Surface::Level(level) => {
                let (low, high) = (level.low, level.high);
                texels[0] = Vec4::new(1.0, level.height as f32, 0.0, 0.0);
                texels[2] = extent([low.x, high.x], [low.y, high.y]);
            }
            Surface::Infinity => texels[0] = Vec4::new(2.0, 0.0, 0.0, 0.0),
        }
        if let Some((layer, place)) = map {
            let (origin, size) = (layer.origin.as_vec2(), layer.size.as_vec2());
            texels[3] = Vec4::new(origin.x, origin.y, size.x, size.y);
            texels[4] = Vec4::new(place.at.x as f32, place.at.y as f32, place.scale, 1.0);
        }
    }

    /// Writes how the components sway.
    pub(super) fn set_sways(&mut self, sways: &[SwayRecord]) {
        let row = &mut self.0[SWAY_ROW * WIDTH..(SWAY_ROW + 1) * WIDTH];
        for (texels, sway) in row.chunks_exact_mut(TEXELS_PER_SWAY).zip(sways) {
            texels.copy_from_slice(&sway.rows());
        }
    }

    /// Writes what the water does.
    pub(super) fn set_water(&mut self, sea: Option<&SeaSurface>, ripples: Option<&Ripples>) {
        let texels = &mut self.0[WATER_ROW * WIDTH..(WATER_ROW + 1) * WIDTH];
        texels[..CLOUDS].fill(Vec4::ZERO);
        if let Some(sea) = sea.filter(|sea| sea.present_gain() > 0.0) {
            // Variance in any one direction is half of the whole.
            let half = 0.5 * sea.present_gain().powi(2);
            let [large, small] = sea.tiles().each_ref().map(|tile| tile.size().as_vec2());
            texels[0] = Vec4::new(large.x, large.y, small.x, small.y);
            for (side, tile) in sea.tiles().iter().enumerate() {
                for (level, lost) in tile.lost_by_level().iter().enumerate() {
                    texels[2 + 2 * side + level / 4][level % 4] = (half * lost.total()) as f32;
                }
            }
            texels[1].w = (half * sea.hidden_covariance().total()) as f32;
        }
        if let Some(ripples) = ripples {
            let grid = ripples.grid();
            let origin = grid.origin.as_vec2();
            texels[1] = Vec4::new(origin.x, origin.y, grid.cell as f32, texels[1].w);
        }
    }

    /// Writes where the clouds are.
    pub(super) fn set_clouds(&mut self, clouds: &[CloudCopy; 2]) {
        for (texel, copy) in self.0[WATER_ROW * WIDTH + CLOUDS..].iter_mut().zip(clouds) {
            *texel = copy.offset_px.as_vec2().extend(copy.weight as f32).extend(0.0);
        }
    }

    /// The texture's bytes.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let numbers: Vec<[f32; 4]> = self.0.iter().map(Vec4::to_array).collect();
        bytemuck::cast_slice(&numbers).to_vec()
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
