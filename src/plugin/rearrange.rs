//! New marks on a tour that is shown: its planes go to where the marks put them at once, its maps stay until they are built
//! anew. The first view stays the picture, for maps are in the picture's pixels.

use std::sync::Arc;

use bevy::prelude::*;

use super::material::TourMaterial;
use super::motion::TourMotion;
use super::spawn::{ShownTour, SolvedTour, corners, quad};
use crate::assemble::{AssembledTour, PlacedTour};
use crate::scene::TourScene;
use crate::tour::Tour;

/// What a rearrangement needs.
#[derive(bevy::ecs::system::SystemParam)]
pub(crate) struct Rearranging<'w, 's> {
    commands: Commands<'w, 's>,
    meshes: ResMut<'w, Assets<Mesh>>,
    materials: ResMut<'w, Assets<TourMaterial>>,
    tours: Query<'w, 's, (&'static mut ShownTour, &'static mut SolvedTour)>,
}

impl Rearranging<'_, '_> {
    /// The planes of a tour that is shown.
    pub(crate) fn scene(&self, tour: Entity) -> Option<&TourScene> {
        self.tours.get(tour).ok().map(|(_, solved)| &solved.scene)
    }

    /// Whether another tour, other planes or other maps have come since this was asked last.
    pub(crate) fn have_changed(&mut self) -> bool {
        self.tours.iter_mut().any(|(_, solved)| solved.is_changed())
    }

    /// Lets the water, the clouds and everything else of a shown tour begin to move anew, as a document says.
    pub(crate) fn move_anew(&mut self, entity: Entity, tour: &Tour) {
        if let Ok((_, solved)) = self.tours.get(entity) {
            self.commands.entity(entity).try_insert(TourMotion::new(tour, solved));
        }
    }

    /// Moves the planes of a tour that is shown; says whether it did: marks that make other components need other maps.
    pub(crate) fn place(&mut self, tour: Entity, placed: &PlacedTour) -> bool {
        let Ok((mut shown, mut solved)) = self.tours.get_mut(tour) else { return false };
        let scene = &placed.scene;
        if solved.scene == *scene || !has_same_components(&solved.scene, scene) {
            return false;
        }
        for (index, component) in scene.components.iter().enumerate() {
            shown.records.set_component(index, &component.surface, None);
            // It was made here, so the handle is its own.
            let _ = self.meshes.insert(&shown.meshes[index], quad(corners(&component.surface)));
        }
        for handle in shown.materials.iter().flatten() {
            if let Some(mut material) = self.materials.get_mut(handle) {
                material.tour = material.tour.taken_by(&scene.camera);
            }
        }
        // What the views saw is no longer so.
        shown.views.clear();
        solved.0 = Arc::new(AssembledTour {
            solution: placed.solution.clone(),
            plan: placed.plan.clone(),
            scene: scene.clone(),
            remarks: placed.remarks.clone(),
            maps: Arc::clone(&solved.maps),
            recordings: solved.recordings.clone(),
        });
        true
    }
}

/// Whether the maps of one scene fit the other's components.
fn has_same_components(old: &TourScene, new: &TourScene) -> bool {
    let kinds = |scene: &TourScene| -> Vec<_> {
        let surface = |component: &crate::scene::SceneComponent| std::mem::discriminant(&component.surface);
        scene.components.iter().map(|c| (c.name.clone(), c.role, surface(c))).collect()
    };
    old.water == new.water
        && old.camera.intrinsics.size == new.camera.intrinsics.size
        && kinds(old) == kinds(new)
}
