//! The tour's material, for what is seen directly and for the water; WGSL lies beside.
//!
//! It reads the picture's sRGB codes and writes them back unlit; where things are comes from the records texture.

use bevy::asset::{AssetPath, embedded_asset, embedded_path};
use bevy::mesh::MeshVertexBufferLayoutRef;
use bevy::pbr::{MaterialPipeline, MaterialPipelineKey};
use bevy::prelude::*;
use bevy::render::render_resource::{
    AsBindGroup, ColorWrites, RenderPipelineDescriptor, ShaderType, SpecializedMeshPipelineError,
};
use bevy::shader::{ShaderRef, load_shader_library};

use crate::camera::PinholeCamera;
use crate::maps::Layer;
use crate::maps::Tint;
use crate::motion::Moves;
use crate::scene::Surface;
use crate::scene::TourScene;

/// Whether the picture keeps its codes or follows the game's grading.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Reflect)]
#[reflect(Component, Default, Clone)]
pub enum ColorPolicy {
    /// The picture's codes are shown as they are. On a camera with `Hdr` this needs `Tonemapping::None`: there the
    /// camera's tonemapping runs over the whole image afterwards.
    #[default]
    Exact,
    /// The camera's tonemapping and color grading apply to the picture as to everything else.
    Graded,
}

/// Which pipeline a tour's mesh needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct TourPass {
    /// Follows the game's grading.
    graded: bool,
    /// Writes depth and no color.
    depth_only: bool,
    /// Is the water.
    water: bool,
    moves: Moves,
}

/// Mirrors `TourUniform` of `tour.wgsl`.
#[derive(ShaderType, Clone, Copy, Debug, PartialEq)]
pub(super) struct TourUniform {
    picture_from_x: Vec4,
    picture_from_y: Vec4,
    picture_from_z: Vec4,
    eye: Vec4,
    layer: Vec4,
    flags: Vec4,
    water: Vec4,
    ripples: Vec4,
}

impl TourUniform {
    /// The uniform of component `index` with its texture map and the map's texels per picture pixel; the water has none.
    pub(super) fn new(scene: &TourScene, tint: &Tint, index: usize, map: Option<(&Layer, f32)>) -> Self {
        let infinite = map.is_some() && scene.components[index].surface == Surface::Infinity;
        let (layer, scale) = map.map_or((Vec4::ZERO, 1.0), |(layer, scale)| {
            let (origin, size) = (layer.origin.as_vec2(), layer.size.as_vec2());
            (Vec4::new(origin.x, origin.y, size.x, size.y), scale)
        });
        let uniform = Self {
            picture_from_x: Vec4::ZERO,
            picture_from_y: Vec4::ZERO,
            picture_from_z: Vec4::ZERO,
            eye: Vec3::ZERO.extend(index as f32),
            layer,
            flags: Vec4::new(f32::from(u8::from(infinite)), 0.0, scale, 0.0),
            water: Vec3::from(tint.own_color()).extend(tint.strength),
            ripples: Vec4::new(tint.slope, 0.0, 0.0, 0.0),
        };
        uniform.taken_by(&scene.camera)
    }

    /// The same for a picture that another camera took.
    pub(super) fn taken_by(mut self, camera: &PinholeCamera) -> Self {
        let matrix = camera.picture_from_world_direction();
        [self.picture_from_x, self.picture_from_y, self.picture_from_z] =
            [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.as_vec3().extend(0.0));
        self.eye = camera.pose.position.as_vec3().extend(self.eye.w);
        self.flags.w = camera.intrinsics.focal_px as f32;
        self
    }
}

/// A part of a tour: a component seen directly, or the water.
#[derive(Asset, AsBindGroup, TypePath, Clone, Debug)]
#[bind_group_data(TourPass)]
pub(super) struct TourMaterial {
    #[uniform(0)]
    pub(super) tour: TourUniform,
    #[texture(1, sample_type = "float", filterable = false, visibility(vertex, fragment))]
    pub(super) records: Handle<Image>,
    /// The component's texture map, or all reflection maps in one.
    #[texture(2)]
    #[sampler(3)]
    pub(super) map: Handle<Image>,
    /// The moving water; only the water's part reads it.
    #[texture(4, sample_type = "float", filterable = false)]
    pub(super) waves: Handle<Image>,
    pub(super) policy: ColorPolicy,
    pub(super) depth_only: bool,
    pub(super) water: bool,
    /// What can move in it; the rest costs nothing.
    pub(super) moves: Moves,
}

impl TourMaterial {
    /// The same part in the pass that writes depth only.
    pub(super) fn depth_only(&self) -> Self {
        Self { depth_only: true, ..self.clone() }
    }
}

impl From<&TourMaterial> for TourPass {
    fn from(material: &TourMaterial) -> Self {
        Self {
            graded: material.policy == ColorPolicy::Graded,
            depth_only: material.depth_only,
            water: material.water,
            moves: material.moves,
        }
    }
}

fn shader() -> ShaderRef {
    ShaderRef::Path(AssetPath::from_path_buf(embedded_path!("part.wgsl")).with_source("embedded"))
}

impl Material for TourMaterial {
    fn vertex_shader() -> ShaderRef {
        shader()
    }

    fn fragment_shader() -> ShaderRef {
        shader()
    }

    fn alpha_mode(&self) -> AlphaMode {
        AlphaMode::Blend
    }

    fn enable_prepass() -> bool {
        false
    }

    fn enable_shadows() -> bool {
        false
    }

    fn specialize(
        _pipeline: &MaterialPipeline,
        descriptor: &mut RenderPipelineDescriptor,
        layout: &MeshVertexBufferLayoutRef,
        key: MaterialPipelineKey<Self>,
    ) -> Result<(), SpecializedMeshPipelineError> {
        let pass = key.bind_group_data;
        descriptor.vertex.buffers =
            vec![layout.0.get_layout(&[Mesh::ATTRIBUTE_POSITION.at_shader_location(0)])?];
        descriptor.primitive.cull_mode = None;
        if let Some(depth) = &mut descriptor.depth_stencil {
            depth.depth_write_enabled = Some(pass.depth_only);
        }
        if let Some(fragment) = &mut descriptor.fragment {
            if pass.graded {
                fragment.shader_defs.push("TOUR_GRADED".into());
            }
            if pass.water {
                descriptor.vertex.shader_defs.push("TOUR_WATER".into());
            }
            let moves = pass.moves;
            let defs = [
                (pass.water, "TOUR_WATER"),
                (pass.depth_only, "TOUR_DEPTH_ONLY"),
                (moves.sways, "TOUR_SWAYS"),
                (moves.returns, "TOUR_RETURNS"),
                (moves.drifts, "TOUR_DRIFTS"),
            ];
            fragment
                .shader_defs
                .extend(defs.into_iter().filter(|(is_so, _)| *is_so).map(|(_, def)| def.into()));
            if pass.depth_only {
                for target in fragment.targets.iter_mut().flatten() {
                    target.write_mask = ColorWrites::empty();
                }
            }
        }
        Ok(())
    }
}

/// Registers the material and its shaders.
pub(super) fn plugin(app: &mut App) {
    load_shader_library!(app, "sway.wgsl");
    load_shader_library!(app, "tour.wgsl");
    load_shader_library!(app, "waves.wgsl");
    load_shader_library!(app, "vertex.wgsl");
    load_shader_library!(app, "finish.wgsl");
    load_shader_library!(app, "water.wgsl");
    embedded_asset!(app, "part.wgsl");
    app.add_plugins(MaterialPlugin::<TourMaterial>::default());
}

#[cfg(test)]
mod layout_tests;
