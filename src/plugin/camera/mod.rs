//! Cameras that look at a tour: a visitor's, one on rails, or one flown freely.
//!
//! A tour camera's pose is kept in the tour's space in f64; its `Transform` follows. Cameras without [`TourCamera`] see
//! tours too and are never touched.

mod input;
mod projection;

pub use projection::TourProjection;

use bevy::camera::Viewport;
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::math::{DAffine3, DQuat};
use bevy::prelude::*;
use bevy::transform::helper::TransformHelper;

use super::SolvedTour;
use super::stir::Stirring;
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
    /// The pose in the tour's space, meters; `None` until the tour is ready.
    pub pose: Option<CameraPose>,
    /// Seconds along the path.
    pub path_seconds: f64,
    tour: Option<Entity>,
    visitor: Visitor,
    wish: VisitorWish,
    guide: Guide,
    /// Where another guide has left the camera, and the seconds since: the new one takes over gently.
    left: Option<(CameraPose, f64)>,
    /// The viewport that the letterbox has set; a game's own is left alone.
    letterbox: Option<(UVec2, UVec2)>,
}

/// Distance of the near plane, as a share of the height the picture was taken from.
const NEAR: f64 = 0.03;

/// Seconds in which a guide takes over from where another has left the camera.
const TAKE_OVER: f64 = 1.2;

impl TourCameraState {
    /// The exact view of `tour`, if this camera flies there by its own pose.
    pub(super) fn pose_in(&self, tour: Entity) -> Option<DAffine3> {
        let pose = self.pose.filter(|_| self.tour == Some(tour) && self.guide != Guide::Free)?;
        Some(DAffine3::from_rotation_translation(pose.rotation, pose.position))
    }

    /// The tour it looks at, once that is ready.
    #[must_use]
    pub fn tour(&self) -> Option<Entity> {
        self.tour
    }

    /// Goes to a guide's pose, gently while it takes over from another one.
    fn take_over(&mut self, pose: CameraPose, seconds: f64) {
        self.left =
            self.left.map(|(from, since)| (from, since + seconds)).filter(|(_, since)| *since < TAKE_OVER);
        self.pose = Some(self.left.map_or(pose, |(from, since)| {
            let share = since / TAKE_OVER;
            let share = share * share * (3.0 - 2.0 * share);
            CameraPose {
                position: from.position.lerp(pose.position, share),
                rotation: from.rotation.slerp(pose.rotation, share),
            }
        }));
    }

    /// Glides back to where the painter stood, as the key `Home` does.
    pub fn go_home(&mut self) {
        self.wish.go_home = true;
    }
}

/// Reads the devices into each visitor's wish.
pub(super) fn read_devices(
    devices: input::Devices,
    stirring: Res<Stirring>,
    time: Res<Time>,
    mut cameras: Query<(&TourCamera, &mut TourCameraState)>,
) {
    let seen = input::wish(&devices, stirring.is_active(), time.delta_secs_f64());
    for (camera, mut state) in &mut cameras {
        let asked = state.wish.go_home;
        state.wish = if camera.listens { seen } else { VisitorWish::default() };
        state.wish.go_home |= asked;
    }
}

/// Moves the cameras and lends them the picture's projection.
pub(super) fn move_cameras(
    mut cameras: Query<(&TourCamera, &mut TourCameraState, &mut Projection, &mut Camera)>,
    tours: Query<(Entity, Ref<SolvedTour>)>,
    paths: Query<&TourPath>,
    time: Res<Time>,
) {
    let seconds = time.delta_secs_f64();
    for (camera, mut state, mut projection, mut settings) in &mut cameras {
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
            state.left = None;
            state.guide = camera.guide;
        }
        state.tour = Some(tour);
        let look_limit = camera.visitor.look_limit.min(solved.scene.bounds.look);
        let manner = VisitorSettings { scale: solved.scene.bounds.nearest, look_limit, ..camera.visitor };
        if state.guide != camera.guide {
            state.left = state.pose.map(|pose| (pose, 0.0));
            // A visitor goes on from where somebody else has brought the camera.
            if let Some(pose) = state.pose.filter(|_| camera.guide == Guide::Visitor) {
                state.visitor = Visitor::at(&pose, &manner, &home, bounds);
            }
            state.guide = camera.guide;
        }
        let roll = if camera.guide == Guide::Free { home.angles().2 } else { 0.0 };
        let letterboxed = letterbox(&mut settings, &mut state, &solved, camera.fit);
        // Inside its letterbox the picture covers the viewport but for less than a pixel.
        let fit = if letterboxed { Fit::Cover } else { camera.fit };
        if arrived || solved.is_changed() || !fits(&projection, fit, roll) {
            let mut lens = TourProjection::new(solved.scene.camera.intrinsics, fit);
            lens.near = NEAR * home.position.y.abs().max(1e-3);
            lens.roll = roll;
            *projection = Projection::custom(lens);
        }
        let wish = std::mem::take(&mut state.wish);
        match camera.guide {
            Guide::Visitor => {
                state.visitor = state.visitor.step(&manner, &home, bounds, &wish, seconds);
                let pose = state.visitor.pose(&manner, &home, bounds);
                state.take_over(pose, seconds);
            }
            Guide::Path => {
                state.path_seconds += seconds;
                let path = paths.get(tour).ok();
                let pose = path.map_or(home, |path| path.0.at(state.path_seconds));
                state.take_over(pose, seconds);
            }
            Guide::Free | Guide::Still => {}
        }
    }
}

fn fits(projection: &Projection, fit: Fit, roll: f64) -> bool {
    let Projection::Custom(custom) = projection else { return false };
    custom.get::<TourProjection>().is_some_and(|lens| lens.fit == fit && lens.roll == roll)
}

/// Gives a camera that contains the picture a viewport of the picture's shape, and takes it away again; a viewport that
/// the game has set stays. Says whether the picture fills the viewport by this.
fn letterbox(camera: &mut Mut<Camera>, state: &mut TourCameraState, tour: &SolvedTour, fit: Fit) -> bool {
    let current = camera.viewport.as_ref().map(|view| (view.physical_position, view.physical_size));
    if current.is_some() && current != state.letterbox {
        return false;
    }
    let target = camera.physical_target_size().filter(|size| size.min_element() > 0);
    let wanted = target.filter(|_| fit == Fit::Contain).and_then(|target| {
        let view = fitted(&tour.scene.camera.intrinsics, target, fit);
        (view.viewport_size != target).then_some((view.viewport_min, view.viewport_size))
    });
    if current != wanted {
        camera.viewport = wanted.map(|(physical_position, physical_size)| Viewport {
            physical_position,
            physical_size,
            ..default()
        });
        state.letterbox = wanted;
    }
    wanted.is_some()
}

/// Writes each camera's `Transform` from its pose in the tour's space, or reads it when somebody else flies.
pub(super) fn place_cameras(
    mut cameras: Query<(Entity, &mut TourCameraState, &Projection)>,
    mut commands: Commands,
    transforms: TransformHelper,
    parents: Query<&ChildOf>,
    current: Query<&Transform>,
) {
    for (entity, mut state, projection) in &mut cameras {
        let (Some(tour), Some(pose)) = (state.tour, state.pose) else { continue };
        let Ok(world_from_tour) = transforms.compute_global_transform(tour) else { continue };
        let free = state.guide == Guide::Free;
        // What the projection rolls, the transform does not.
        let kept = match projection {
            Projection::Custom(custom) if free => {
                custom.get::<TourProjection>().map_or(0.0, |lens| lens.roll)
            }
            _ => 0.0,
        };
        if free && current.get(entity).is_ok_and(|transform| *transform != Transform::default()) {
            if let Ok(world_from_view) = transforms.compute_global_transform(entity) {
                let view = world_from_view.reparented_to(&world_from_tour);
                state.pose = Some(CameraPose {
                    position: view.translation.as_dvec3(),
                    rotation: view.rotation.as_dquat() * DQuat::from_rotation_z(kept),
                });
            }
            continue;
        }
        let rotation = pose.rotation * DQuat::from_rotation_z(-kept);
        let local = Transform::from_translation(pose.position.as_vec3()).with_rotation(rotation.as_quat());
        let world = world_from_tour * local;
        let parent = parents
            .get(entity)
            .ok()
            .and_then(|parent| transforms.compute_global_transform(parent.parent()).ok());
        let placed = parent.map_or_else(|| world.compute_transform(), |parent| world.reparented_to(&parent));
        let placed = Transform { scale: Vec3::ONE, ..placed };
        if current.get(entity).is_ok_and(|transform| *transform != placed) {
            commands.entity(entity).try_insert(placed);
        }
    }
}

/// The tour's keyframed path, on its entity if the file has one.
#[derive(Component, Clone, Debug)]
pub struct TourPath(pub CameraPath);
