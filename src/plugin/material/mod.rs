//! The tour's materials: one for what is seen directly, one for the water; WGSL lies beside.
//!
//! Both read the picture's sRGB codes and write them back unlit; where things are comes from the records texture.

use bevy::asset::{AssetPath, embedded_asset, embedded_path};
use bevy::mesh::MeshVertexBufferLayoutRef;
use bevy::pbr::{MaterialPipeline, MaterialPipelineKey};
use bevy::prelude::*;
use bevy::render::render_resource::{
    AsBindGroup, ColorWrites, RenderPipelineDescriptor, ShaderType, SpecializedMeshPipelineError,
};
use bevy::shader::{ShaderRef, load_shader_library};

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
}

/// Coverage up to this is dropped in a depth pass.
const SOLID: f32 = 0.5;

impl TourUniform {
    /// The uniform of component `index`, whose texture map starts at `layer.xy` and has size `layer.zw` (picture
    /// pixels).
    pub(super) fn new(scene: &TourScene, index: usize, layer: Vec4, infinite: bool) -> Self {
        let camera = &scene.camera;
        let matrix = camera.picture_from_world_direction();
        let eye = camera.pose.position.as_vec3();
        Self {
            picture_from_x: matrix.x_axis.as_vec3().extend(0.0),
            picture_from_y: matrix.y_axis.as_vec3().extend(0.0),
            picture_from_z: matrix.z_axis.as_vec3().extend(0.0),
            eye: eye.extend(index as f32),
            layer,
            flags: Vec4::new(f32::from(u8::from(infinite)), -1.0, 0.0, 0.0),
        }
    }

    /// The same for the pass that writes depth only.
    pub(super) fn depth_only(mut self) -> Self {
        self.flags.y = SOLID;
        self
    }
}

/// A component seen directly.
#[derive(Asset, AsBindGroup, TypePath, Clone, Debug)]
#[bind_group_data(TourPass)]
pub(super) struct TourSurfaceMaterial {
    #[uniform(0)]
    pub(super) tour: TourUniform,
    #[texture(1, sample_type = "float", filterable = false, visibility(vertex, fragment))]
    pub(super) records: Handle<Image>,
    #[texture(2)]
    #[sampler(3)]
    pub(super) texture_map: Handle<Image>,
    pub(super) policy: ColorPolicy,
    pub(super) depth_only: bool,
}

/// The water.
#[derive(Asset, AsBindGroup, TypePath, Clone, Debug)]
#[bind_group_data(TourPass)]
pub(super) struct TourWaterMaterial {
    #[uniform(0)]
    pub(super) tour: TourUniform,
    #[texture(1, sample_type = "float", filterable = false, visibility(vertex, fragment))]
    pub(super) records: Handle<Image>,
    #[texture(2)]
    #[sampler(3)]
    pub(super) atlas: Handle<Image>,
    pub(super) policy: ColorPolicy,
    pub(super) depth_only: bool,
}

impl From<&TourSurfaceMaterial> for TourPass {
    fn from(material: &TourSurfaceMaterial) -> Self {
        Self { graded: material.policy == ColorPolicy::Graded, depth_only: material.depth_only }
    }
}

impl From<&TourWaterMaterial> for TourPass {
    fn from(material: &TourWaterMaterial) -> Self {
        Self { graded: material.policy == ColorPolicy::Graded, depth_only: material.depth_only }
    }
}

/// What both materials ask of their pipelines.
fn specialize(
    descriptor: &mut RenderPipelineDescriptor,
    layout: &MeshVertexBufferLayoutRef,
    pass: TourPass,
) -> Result<(), SpecializedMeshPipelineError> {
    descriptor.vertex.buffers = vec![layout.0.get_layout(&[Mesh::ATTRIBUTE_POSITION.at_shader_location(0)])?];
    descriptor.primitive.cull_mode = None;
    if let Some(depth) = &mut descriptor.depth_stencil {
        depth.depth_write_enabled = Some(pass.depth_only);
    }
    if let Some(fragment) = &mut descriptor.fragment {
        if pass.graded {
            fragment.shader_defs.push("TOUR_GRADED".into());
        }
        if pass.depth_only {
            for target in fragment.targets.iter_mut().flatten() {
                target.write_mask = ColorWrites::empty();
            }
        }
    }
    Ok(())
}

fn shader(path: std::path::PathBuf) -> ShaderRef {
    ShaderRef::Path(AssetPath::from_path_buf(path).with_source("embedded"))
}

impl Material for TourSurfaceMaterial {
    fn vertex_shader() -> ShaderRef {
        shader(embedded_path!("surface.wgsl"))
    }

    fn fragment_shader() -> ShaderRef {
        shader(embedded_path!("surface.wgsl"))
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
        specialize(descriptor, layout, key.bind_group_data)
    }
}

impl Material for TourWaterMaterial {
    fn vertex_shader() -> ShaderRef {
        shader(embedded_path!("water.wgsl"))
    }

    fn fragment_shader() -> ShaderRef {
        shader(embedded_path!("water.wgsl"))
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
        specialize(descriptor, layout, key.bind_group_data)
    }
}

/// Registers the materials and their shaders.
pub(super) fn plugin(app: &mut App) {
    load_shader_library!(app, "tour.wgsl");
    load_shader_library!(app, "vertex.wgsl");
    load_shader_library!(app, "finish.wgsl");
    embedded_asset!(app, "surface.wgsl");
    embedded_asset!(app, "water.wgsl");
    app.add_plugins((
        MaterialPlugin::<TourSurfaceMaterial>::default(),
        MaterialPlugin::<TourWaterMaterial>::default(),
    ));
}

#[cfg(test)]
mod layout_tests;
