//! An assembled tour as entities: one named child a component, one for the water, all gone with the root.

use std::borrow::Cow;
use std::sync::Arc;

use bevy::asset::RenderAssetUsages;
use bevy::camera::visibility::{NoFrustumCulling, RenderLayers};
use bevy::image::ImageSampler;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};

use super::atlas::{self, Atlas, Texels};
use super::material::{ColorPolicy, TourMaterial, TourUniform};
use super::motion::{ObjectMotion, waves_image};
use super::records::{Records, ViewRecord};
use crate::assemble::AssembledTour;
use crate::maps::Mipmapped;
use crate::motion::Simulation;
use crate::scene::{Role, Surface};

/// What was solved and built for a tour: parameters, report, scene and maps. On the tour's entity once it is ready.
#[derive(Component, Clone, Debug, Deref)]
pub struct SolvedTour(pub Arc<AssembledTour>);

/// What a tour's child stands for.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
pub enum TourPart {
    /// The water's surface.
    Water,
    /// The component of this index in the scene.
    Component(usize),
}

/// The mesh that writes a part's depth after all parts are drawn.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct DepthPass;

/// What the plugin keeps for a tour that is shown.
#[derive(Component, Debug)]
pub(super) struct ShownTour {
    /// What the records' view rows say.
    pub views: Vec<ViewRecord>,
    pub records: Records,
    pub image: Handle<Image>,
    /// Children, for a clean replacement.
    pub parts: Vec<Entity>,
    /// Per part of `parts` its material, and that of its depth pass; the water's is last.
    pub materials: Vec<[Handle<TourMaterial>; 2]>,
    /// Per part of `parts` its mesh.
    #[cfg_attr(not(feature = "editor"), expect(dead_code, reason = "only the studio moves planes"))]
    pub meshes: Vec<Handle<Mesh>>,
    pub components: usize,
    /// The moving water.
    pub waves: Handle<Image>,
}

impl ShownTour {
    /// Lets materials draw what can move now.
    pub(super) fn follow_moves(&self, motion: &Simulation, materials: &mut Assets<TourMaterial>) {
        for (index, handles) in self.materials.iter().enumerate() {
            // The water is after all components.
            let moves = if index < self.components { motion.moves(index) } else { motion.all_moves() };
            for handle in handles {
                if materials.get(handle).is_some_and(|material| material.moves != moves)
                    && let Some(mut material) = materials.get_mut(handle)
                {
                    material.moves = moves;
                }
            }
        }
    }
}

/// The assets a tour is spawned into.
#[derive(bevy::ecs::system::SystemParam)]
pub(super) struct TourAssets<'w> {
    images: ResMut<'w, Assets<Image>>,
    meshes: ResMut<'w, Assets<Mesh>>,
    materials: ResMut<'w, Assets<TourMaterial>>,
    device: Option<Res<'w, bevy::render::renderer::RenderDevice>>,
}

/// What every device that Bevy runs on can hold.
const SMALLEST_LIMIT: u32 = 2048;

impl TourAssets<'_> {
    /// The largest side of a texture.
    fn largest(&self) -> u32 {
        self.device.as_ref().map_or(SMALLEST_LIMIT, |device| device.limits().max_texture_dimension_2d)
    }
}

/// Replaces what is shown of a tour.
pub(super) fn show(
    commands: &mut Commands,
    assets: &mut TourAssets,
    root: Entity,
    tour: Arc<AssembledTour>,
    motion: &Simulation,
    policy: ColorPolicy,
    layers: Option<&RenderLayers>,
    before: Option<&ShownTour>,
) {
    for &part in before.iter().flat_map(|shown| &shown.parts) {
        commands.entity(part).try_despawn();
    }
    let largest = assets.largest();
    let scene = &tour.scene;
    let picture = scene.camera.intrinsics.size;
    let (maps, atlas) = packed(&tour, largest);
    if atlas.scale < 1.0 {
        warn!(
            "the reflection maps are larger than this device's textures ({largest} px): they are scaled to {:.0} %, \
             and the first view is no longer the picture to the code",
            100.0 * atlas.scale
        );
    }
    let mut records = Records::new();
    for (index, component) in scene.components.iter().enumerate() {
        let map = maps[index].as_deref().map(|map| &map.layer).zip(atlas.places[index]);
        records.set_component(index, &component.surface, map);
    }
    let image = assets.images.add(records.image());
    let waves = assets.images.add(waves_image());
    let mut spawner =
        Spawner { commands, root, layers, parts: Vec::new(), materials: Vec::new(), meshes: Vec::new() };

    for (index, component) in scene.components.iter().enumerate() {
        let map = atlas::trimmed(&tour.maps.components[index].texture, picture, largest);
        let infinite = component.surface == Surface::Infinity;
        let (texels, scale) = texels(&map, largest);
        let uniform = TourUniform::new(scene, &tour.maps.tint, index, Some((&map.layer, scale)));
        let map = assets.images.add(image_of(texels));
        let material = TourMaterial {
            tour: uniform,
            records: image.clone(),
            map,
            waves: waves.clone(),
            policy,
            depth_only: false,
            water: false,
            moves: motion.moves(index),
        };
        let mesh = assets.meshes.add(quad(corners(&component.surface)));
        let depth = assets.materials.add(material.depth_only());
        let material = assets.materials.add(material);
        // What turns or moves leaves its mesh's box.
        let unbounded = infinite || component.role == Role::Billboard;
        let part =
            spawner.part(&component.name, TourPart::Component(index), mesh, material, depth, unbounded);
        if let Some(own) = motion.motion_of(&component.name) {
            spawner.commands.entity(part).insert(ObjectMotion::Own(own.clone()));
        }
    }
    if scene.water {
        let map = assets.images.add(image_of(atlas.texture));
        let uniform = TourUniform::new(scene, &tour.maps.tint, 0, None);
        let material = TourMaterial {
            tour: uniform,
            records: image.clone(),
            map,
            waves: waves.clone(),
            policy,
            depth_only: false,
            water: true,
            moves: motion.all_moves(),
        };
        let reach = match scene.last_layer().surface {
            Surface::Wall(wall) => wall.span[1] as f32,
            _ => 1e4,
        };
        let mesh = assets.meshes.add(quad([
            Vec3::new(-reach, 0.0, -reach),
            Vec3::new(reach, 0.0, -reach),
            Vec3::new(-reach, 0.0, reach),
            Vec3::new(reach, 0.0, reach),
        ]));
        let depth = assets.materials.add(material.depth_only());
        let material = assets.materials.add(material);
        spawner.part("water", TourPart::Water, mesh, material, depth, false);
    }
    let components = scene.components.len();
    let Spawner { parts, materials, meshes, .. } = spawner;
    // Somebody may have despawned the root in this very frame; its parts must not outlive it.
    let orphans = parts.clone();
    commands.queue(move |world: &mut World| {
        if world.get_entity(root).is_err() {
            for part in orphans {
                let _ = world.try_despawn(part);
            }
        }
    });
    let shown = ShownTour { views: Vec::new(), records, image, parts, materials, meshes, components, waves };
    commands.entity(root).try_insert((SolvedTour(tour), shown));
}

/// Replaces the maps of a shown tour by finer ones of the same scene; entities and materials stay.
pub(super) fn refine(
    commands: &mut Commands,
    assets: &mut TourAssets,
    root: Entity,
    tour: Arc<AssembledTour>,
    shown: &ShownTour,
) {
    let largest = assets.largest();
    let picture = tour.scene.camera.intrinsics.size;
    let textures = tour.maps.components.iter().map(|maps| {
        let map = atlas::trimmed(&maps.texture, picture, largest);
        image_of(texels(&map, largest).0)
    });
    let water = tour.scene.water.then(|| image_of(packed(&tour, largest).1.texture));
    for (materials, image) in shown.materials.iter().zip(textures.chain(water)) {
        // A new image: of one that stays Bevy would rewrite the finest level only.
        let map = assets.images.add(image);
        for handle in materials {
            if let Some(mut material) = assets.materials.get_mut(handle) {
                material.map = map.clone();
            }
        }
    }
    commands.entity(root).try_insert(SolvedTour(tour));
}

/// All reflection maps of a tour, as far as a device's textures hold them, and where they lie in one texture.
fn packed(tour: &AssembledTour, largest: u32) -> (Vec<Option<Cow<'_, Mipmapped>>>, Atlas) {
    let picture = tour.scene.camera.intrinsics.size;
    let maps: Vec<Option<Cow<Mipmapped>>> = tour
        .maps
        .components
        .iter()
        .map(|maps| maps.reflection.as_ref().map(|map| atlas::trimmed(map, picture, largest)))
        .collect();
    let borrowed: Vec<Option<&Mipmapped>> = maps.iter().map(Option::as_deref).collect();
    let atlas = atlas::pack(&borrowed, largest);
    (maps, atlas)
}

struct Spawner<'a, 'w, 's> {
    commands: &'a mut Commands<'w, 's>,
    root: Entity,
    layers: Option<&'a RenderLayers>,
    parts: Vec<Entity>,
    materials: Vec<[Handle<TourMaterial>; 2]>,
    meshes: Vec<Handle<Mesh>>,
}

impl Spawner<'_, '_, '_> {
    fn part(
        &mut self,
        name: &str,
        part: TourPart,
        mesh: Handle<Mesh>,
        material: Handle<TourMaterial>,
        depth: Handle<TourMaterial>,
        unbounded: bool,
    ) -> Entity {
        self.meshes.push(mesh.clone());
        let bundle = (Mesh3d(mesh), Transform::default(), Visibility::default());
        let shown = self
            .commands
            .spawn((
                Name::new(name.to_owned()),
                part,
                bundle.clone(),
                MeshMaterial3d(material.clone()),
                ChildOf(self.root),
            ))
            .id();
        let solid = self
            .commands
            .spawn((
                Name::new(format!("{name} (depth)")),
                DepthPass,
                bundle,
                MeshMaterial3d(depth.clone()),
                ChildOf(shown),
            ))
            .id();
        for entity in [shown, solid] {
            let mut entity = self.commands.entity(entity);
            if let Some(layers) = self.layers {
                entity.insert(layers.clone());
            }
            if unbounded {
                entity.insert(NoFrustumCulling);
            }
        }
        self.parts.push(shown);
        self.materials.push([material, depth]);
        shown
    }
}

/// Two triangles through four corners: low left, low right, high left, high right.
pub(super) fn quad(corners: [Vec3; 4]) -> Mesh {
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, corners.map(|corner| corner.to_array()).to_vec())
        .with_inserted_indices(Indices::U16(vec![0, 1, 2, 2, 1, 3]))
}

/// The corners of a surface in the tour's space; infinity fills the view in clip space.
pub(super) fn corners(surface: &Surface) -> [Vec3; 4] {
    match surface {
        Surface::Wall(wall) => {
            let [[a, b], [c, d]] = wall.rise.map(|y| wall.span.map(|s| wall.point(s, y).as_vec3()));
            [a, b, c, d]
        }
        Surface::Level(level) => {
            let (low, high, y) = (level.low.as_vec2(), level.high.as_vec2(), level.height as f32);
            [
                Vec3::new(low.x, y, low.y),
                Vec3::new(high.x, y, low.y),
                Vec3::new(low.x, y, high.y),
                Vec3::new(high.x, y, high.y),
            ]
        }
        Surface::Infinity => [
            Vec3::new(-1.0, -1.0, 0.0),
            Vec3::new(1.0, -1.0, 0.0),
            Vec3::new(-1.0, 1.0, 0.0),
            Vec3::new(1.0, 1.0, 0.0),
        ],
    }
}

/// A map's texels, scaled down where the device cannot hold it, and texels per picture pixel.
fn texels(map: &Mipmapped, largest: u32) -> (Texels, f32) {
    let (texels, scale) = Texels::of(map, largest);
    if scale < 1.0 {
        warn!(
            "a layer of {} px is scaled to {:.0} %: the device's textures end at {largest} px",
            map.layer.size.max_element(),
            100.0 * scale
        );
    }
    (texels, scale)
}

fn image_of(texels: Texels) -> Image {
    let size = Extent3d { width: texels.size.x, height: texels.size.y, depth_or_array_layers: 1 };
    let format = TextureFormat::Rgba8UnormSrgb;
    let mut image = Image::new_uninit(size, TextureDimension::D2, format, RenderAssetUsages::RENDER_WORLD);
    image.texture_descriptor.mip_level_count = texels.levels.len() as u32;
    image.data = Some(texels.levels.concat().into_flattened());
    image.sampler = ImageSampler::linear();
    image
}
