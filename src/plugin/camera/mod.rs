//! Cameras that look at a tour: a visitor's, one on rails, or one flown freely.
//!
//! A tour camera's pose is kept in the tour's space in f64; its `Transform` follows. Cameras without [`TourCamera`] see
//! tours too and are never touched.

mod input;
mod projection;

pub use projection::TourProjection;

use bevy::camera::Viewport;
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::math::DAffine3;
use bevy::prelude::*;
use bevy::transform::helper::TransformHelper;

use super::SolvedTour;
use crate::camera::CameraPath;
use crate::camera::CameraPose;
use crate::camera::Fit;
use crate::camera::Visitor;
use crate::camera::VisitorSettings;
use crate::camera::VisitorWish;
use crate::camera::fitted;

/// Who moves a [`TourCamera`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Guide {
    /// A visitor: drag to look and lean, wheel or pinch to step in, keys, gamepad; `Home` glides back.
    #[default]
    Visitor,
    /// The tour's own keyframed path, or the painter's place when it has none.
    Path,
    /// Somebody else: the camera's `Transform` is read, not written (Bevy's `FreeCamera`, say).
    Free,
    /// Nobody: it stands at [`TourCameraState::pose`], which a program sets.
    Still,
}

/// A camera that looks at a tour through the picture's own lens. Settings only; what changes each frame is in
/// [`TourCameraState`].
#[derive(Component, Clone, Debug)]
#[require(Camera3d, Tonemapping = Tonemapping::None, DebandDither = DebandDither::Disabled, TourCameraState)]
pub struct TourCamera {
    /// The tour to look at; the first one that is ready when `None`.
    pub tour: Option<Entity>,
    /// How the picture fills a viewport of another shape.
    pub fit: Fit,
    /// Who moves it.
    pub guide: Guide,
    /// Whether it listens to mouse, touch, keys and gamepad; switch it off while something else has them.
    pub listens: bool,
    /// How a visitor moves; its scale is replaced by the distance of the scene's nearest billboard.
    pub visitor: VisitorSettings,
}

impl Default for TourCamera {
    fn default() -> Self {
        Self {
            tour: None,
            fit: Fit::Contain,
            guide: Guide::default(),
            listens: true,
            visitor: VisitorSettings::default(),
        }
    }
}

/// Where a [`TourCamera`] is.
#[derive(Component, Clone, Debug, Default)]
pub struct TourCameraState {
    /// The pose in the tour's space; `None` until the tour is ready.
    pub pose: Option<CameraPose>,
    /// Seconds along the path.
    pub path_seconds: f64,
    tour: Option<Entity>,
    visitor: Visitor,
    wish: VisitorWish,
    free: bool,
}

impl TourCameraState {
    /// The exact view of `tour`, if this camera flies there by its own pose.
    pub(super) fn pose_in(&self, tour: Entity) -> Option<DAffine3> {
        let pose = self.pose.filter(|_| self.tour == Some(tour) && !self.free)?;
        Some(DAffine3::from_rotation_translation(pose.rotation, pose.position))
    }

    /// The tour it looks at, once that is ready.
    #[must_use]
    pub fn tour(&self) -> Option<Entity> {
        self.tour
    }

    /// Glides back to where the painter stood, as the key `Home` does.
    pub fn go_home(&mut self) {
        self.wish.go_home = true;
    }
}

/// Reads the devices into each visitor's wish.
pub(super) fn read_devices(
    devices: input::Devices,
    time: Res<Time>,
    mut cameras: Query<(&TourCamera, &mut TourCameraState)>,
) {
    let seen = input::wish(&devices, time.delta_secs_f64());
    for (camera, mut state) in &mut cameras {
        let asked = state.wish.go_home;
        state.wish = if camera.listens { seen } else { VisitorWish::default() };
        state.wish.go_home |= asked;
    }
}

/// Moves the cameras and lends them the picture's projection.
pub(super) fn move_cameras(
    mut cameras: Query<(Entity, &TourCamera, &mut TourCameraState, &mut Projection, &mut Camera)>,
    tours: Query<(Entity, Ref<SolvedTour>)>,
    paths: Query<&TourPath>,
    time: Res<Time>,
) {
    let seconds = time.delta_secs_f64();
    for (_, camera, mut state, mut projection, mut settings) in &mut cameras {
        let found = match camera.tour {
            Some(tour) => tours.get(tour).ok(),
            None => state.tour.and_then(|tour| tours.get(tour).ok()).or_else(|| tours.iter().next()),
        };
        let Some((tour, solved)) = found else {
            state.pose = None;
            state.tour = None;
            continue;
        };
        let home = solved.scene.camera.pose;
        let bounds = [solved.scene.bounds.low, solved.scene.bounds.high];
        let arrived = state.tour != Some(tour) || state.pose.is_none();
        if arrived {
            state.visitor = Visitor::default();
            state.path_seconds = 0.0;
            state.pose = Some(home);
        }
        state.tour = Some(tour);
        state.free = camera.guide == Guide::Free;
        let roll = if state.free { home.angles().2 } else { 0.0 };
        if arrived || solved.is_changed() || !fits(&projection, camera.fit, roll) {
            let mut lens = TourProjection::new(solved.scene.camera.intrinsics, camera.fit);
            lens.roll = roll;
            *projection = Projection::custom(lens);
        }
        letterbox(&mut settings, &solved, camera.fit);
        let wish = std::mem::take(&mut state.wish);
        match camera.guide {
            Guide::Visitor => {
                let look_limit = camera.visitor.look_limit.min(solved.scene.bounds.look);
                let scale = solved.scene.bounds.nearest;
                let manner = VisitorSettings { scale, look_limit, ..camera.visitor };
                let visitor = state.visitor.step(&manner, &home, bounds, &wish, seconds);
                if visitor != state.visitor || state.pose != Some(home) {
                    state.pose = Some(visitor.pose(&manner, &home, bounds));
                    state.visitor = visitor;
                }
            }
            Guide::Path => {
                state.path_seconds += seconds;
                let path = paths.get(tour).ok();
                state.pose = Some(path.map_or(home, |path| path.0.at(state.path_seconds)));
            }
            Guide::Free | Guide::Still => {}
        }
    }
}

fn fits(projection: &Projection, fit: Fit, roll: f64) -> bool {
    let Projection::Custom(custom) = projection else { return false };
    custom.get::<TourProjection>().is_some_and(|lens| lens.fit == fit && lens.roll == roll)
}

/// Gives a camera that contains the picture the viewport of the picture's shape; others keep theirs.
fn letterbox(camera: &mut Mut<Camera>, tour: &SolvedTour, fit: Fit) {
    if fit != Fit::Contain {
        return;
    }
    let Some(target) = camera.physical_target_size().filter(|size| size.min_element() > 0) else { return };
    let view = fitted(&tour.scene.camera.intrinsics, target, fit);
    let wanted = (view.viewport_size != target).then(|| Viewport {
        physical_position: view.viewport_min,
        physical_size: view.viewport_size,
        ..default()
    });
    let same = match (&camera.viewport, &wanted) {
        (None, None) => true,
        (Some(a), Some(b)) => {
            a.physical_position == b.physical_position && a.physical_size == b.physical_size
        }
        _ => false,
    };
    if !same {
        camera.viewport = wanted;
    }
}

/// Writes each camera's `Transform` from its pose in the tour's space, or reads it when somebody else flies.
pub(super) fn place_cameras(
    cameras: Query<(Entity, &TourCameraState)>,
    mut commands: Commands,
    transforms: TransformHelper,
    parents: Query<&ChildOf>,
    current: Query<&Transform>,
) {
    for (entity, state) in &cameras {
        let (Some(tour), Some(pose)) = (state.tour, state.pose) else { continue };
        if state.free && current.get(entity).is_ok_and(|transform| *transform != Transform::default()) {
            continue;
        }
        let Ok(world_from_tour) = transforms.compute_global_transform(tour) else { continue };
        let local =
            Transform::from_translation(pose.position.as_vec3()).with_rotation(pose.rotation.as_quat());
        let world = world_from_tour * local;
        let parent = parents
            .get(entity)
            .ok()
            .and_then(|parent| transforms.compute_global_transform(parent.parent()).ok());
        let placed = parent.map_or_else(|| world.compute_transform(), |parent| world.reparented_to(&parent));
        let placed = Transform { scale: Vec3::ONE, ..placed };
        if current.get(entity).is_ok_and(|transform| *transform != placed) {
            commands.entity(entity).insert(placed);
        }
    }
}

/// The tour's keyframed path, on its entity if the file has one.
#[derive(Component, Clone, Debug)]
pub struct TourPath(pub CameraPath);
