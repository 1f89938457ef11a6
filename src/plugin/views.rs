//! Once a frame: which camera sees each tour from where, and in which order its parts are drawn.
//!
//! One order serves drawing, the water's shader and (the same function) the reference tracer: architecture.md,
//! decision 6. Poses go from the game's world to the tour's in f64.

use bevy::camera::visibility::RenderLayers;
use bevy::math::{DAffine3, DMat4, DVec3};
use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::render::extract_resource::ExtractResource;

use super::camera::TourCameraState;
use super::motion::{TourMotion, shown_ripples};
use super::records::{MAX_VIEWS, ViewRecord};
use super::spawn::{DepthPass, ShownTour, SolvedTour, TourPart};
use crate::scene::MAX_COMPONENTS;
use crate::scene::TourScene;
use crate::scene::{Arrangement, Placement, Surface};
use crate::wind::{CloudCopy, SwayRecord};

/// Per camera: the sort distance of each part's mesh, view depth as Bevy counts it (nearer is greater).
#[derive(Resource, ExtractResource, Clone, Debug, Default)]
pub(super) struct DrawOrder(pub HashMap<Entity, HashMap<Entity, f32>>);

/// Writes every tour's records and the draw order.
pub(super) fn look_at_tours(
    mut tours: Query<(
        Entity,
        &GlobalTransform,
        &SolvedTour,
        &mut ShownTour,
        Option<&mut TourMotion>,
        Option<&RenderLayers>,
    )>,
    cameras: Query<
        (Entity, &Camera, &GlobalTransform, Option<&TourCameraState>, Option<&RenderLayers>),
        With<Camera3d>,
    >,
    parts: Query<&TourPart>,
    depths: Query<(), With<DepthPass>>,
    children: Query<&Children>,
    mut images: ResMut<Assets<Image>>,
    mut order: ResMut<DrawOrder>,
) {
    // The layer of whatever has no layers of its own.
    let everything_else = RenderLayers::default();
    let mut new_order: HashMap<Entity, HashMap<Entity, f32>> = HashMap::default();
    for (root, tour_transform, solved, mut shown, mut motion, layers) in &mut tours {
        let layers = layers.cloned().unwrap_or_default();
        let tour_from_world = affine(tour_transform).inverse();
        let moment =
            motion.as_ref().filter(|motion| !motion.still).map(|motion| motion.simulation().moment());
        let (moved, mirrored) = moment
            .map_or_else(Default::default, |moment| (moment.placements.clone(), moment.mirrored.clone()));
        let mut views = Vec::new();
        for (camera, settings, transform, state, seen) in &cameras {
            if !settings.is_active || !seen.unwrap_or(&everything_else).intersects(&layers) {
                continue;
            }
            if views.len() == MAX_VIEWS {
                warn_once!(
                    "a tour is drawn rightly by {MAX_VIEWS} cameras at most; the others see it from elsewhere"
                );
                break;
            }
            // A camera that flies this tour knows its pose exactly; the game's f32 world would round it.
            let exact = state.and_then(|state| state.pose_in(root));
            let tour_from_view = exact.unwrap_or_else(|| tour_from_world * affine(transform));
            if !tour_from_view.is_finite() {
                continue;
            }
            let Arrangement { placements, near_to_far } =
                solved.scene.arranged_for(tour_from_view.translation, &moved);
            let distances = new_order.entry(camera).or_default();
            let scale =
                (affine(transform).matrix3.inverse() * affine(tour_transform).matrix3).x_axis.length();
            let ranks = sort_distances(&solved.scene, &tour_from_view, &near_to_far, scale);
            for &entity in &shown.parts {
                if let Ok(part) = parts.get(entity) {
                    distances.insert(entity, ranks.of(*part));
                }
                for &child in children.get(entity).into_iter().flatten() {
                    if depths.contains(child) {
                        distances.insert(child, ranks.depth);
                    }
                }
            }
            views.push(ViewRecord {
                world_from_view: transform.to_matrix(),
                tour_from_view,
                walls_near_to_far: solved.scene.walls_of(&near_to_far).collect(),
                ground: solved.scene.ground(),
                placements: at_rest_unless_placed(&solved.scene, placements),
                mirrored: mirrored.clone(),
            });
        }
        let shown = shown.bypass_change_detection();
        let has_moved = motion.as_mut().is_some_and(|motion| motion.bypass_change_detection().take_changed());
        if let Some(motion) = motion.as_mut().filter(|_| has_moved) {
            let motion = motion.bypass_change_detection();
            if motion.still {
                shown.records.set_sways(&[SwayRecord::default(); MAX_COMPONENTS]);
                shown.records.set_water(None, None);
                shown.records.set_clouds(&CloudCopy::STILL);
            } else {
                let moment = motion.simulation().moment();
                shown.records.set_sways(&moment.sways);
                shown.records.set_clouds(&moment.clouds);
                let ripples = shown_ripples(motion.simulation().ripples());
                shown.records.set_water(motion.simulation().sea(), ripples);
                if let Some(bytes) =
                    images.get_mut(&shown.waves).as_mut().and_then(|image| image.data.as_mut())
                {
                    motion.write_waves(bytes);
                }
            }
        }
        if has_moved || views != shown.views {
            shown.records.set_views(&views);
            if let Some(mut image) = images.get_mut(&shown.image) {
                image.data = Some(shown.records.bytes());
            }
            shown.views = views;
        }
    }
    order.0 = new_order;
}

/// Where every wall is.
fn at_rest_unless_placed(scene: &TourScene, placements: Vec<Option<Placement>>) -> Vec<Option<Placement>> {
    let resting = scene.components.iter().map(|component| match component.surface {
        Surface::Wall(wall) => Some(wall.resting()),
        Surface::Level(_) | Surface::Infinity => None,
    });
    placements.into_iter().zip(resting).map(|(placed, resting)| placed.or(resting)).collect()
}

/// A transform in f64.
pub(super) fn affine(transform: &GlobalTransform) -> DAffine3 {
    DAffine3::from_mat4(DMat4::from_cols_array(&transform.to_matrix().to_cols_array().map(f64::from)))
}

/// Sort distances in the order of drawing: water, components far to near, then all depths.
struct Ranks {
    water: f32,
    components: Vec<f32>,
    depth: f32,
}

impl Ranks {
    fn of(&self, part: TourPart) -> f32 {
        match part {
            TourPart::Water => self.water,
            TourPart::Component(index) => self.components.get(index).copied().unwrap_or(self.water),
        }
    }
}

fn sort_distances(
    scene: &TourScene,
    tour_from_view: &DAffine3,
    near_to_far: &[usize],
    world_per_tour: f64,
) -> Ranks {
    let forward = -tour_from_view.matrix3.z_axis.normalize_or(DVec3::NEG_Z);
    let depth = |surface: &Surface| match surface {
        Surface::Wall(wall) => {
            let [a, b] = wall.ends();
            let center = DVec3::new(0.5 * (a.x + b.x), tour_from_view.translation.y, 0.5 * (a.y + b.y));
            (center - tour_from_view.translation).dot(forward).max(0.0) * world_per_tour
        }
        // The ground begins at the horizon; where it is drawn follows from the order alone.
        Surface::Level(_) | Surface::Infinity => 1e6,
    };
    // Never nearer than what is drawn before: an item of the game's sorts into the gaps.
    let last_layer = depth(&scene.last_layer().surface);
    let mut last = -last_layer as f32;
    let mut next = |own: f64| {
        last = (-own as f32).max(last + 1e-4 * last.abs().max(1.0));
        last
    };
    let mut components = vec![0.0; scene.components.len()];
    let water = next(last_layer);
    for &index in near_to_far.iter().rev() {
        components[index] = next(depth(&scene.components[index].surface));
    }
    let depth = next(f64::INFINITY);
    Ranks { water, components, depth }
}
