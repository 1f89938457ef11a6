//! Pointer and finger on the water: a drag that begins there stirs it, any other one looks around.

use bevy::camera::RenderTarget;
use bevy::input::touch::Touches;
use bevy::math::DVec2;
use bevy::prelude::*;
use bevy::window::PrimaryWindow;

use super::SolvedTour;
use super::camera::{TourCamera, TourCameraState};
use super::motion::{TouchWater, TourMotion};
use super::views::affine;
use crate::camera::Ray;
use crate::scene::Placement;
use crate::scene::TourScene;

/// Where the pointer is over the image that a [`TourCamera`] draws into, for cameras that draw into no window: a game that
/// shows that image somewhere knows. `None` while it is elsewhere.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct TourPointer(
    /// From the image's upper left corner, in its pixels.
    pub Option<Vec2>,
);

/// What is being stirred; while it is, that pointer turns no camera.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub(super) struct Stirring(Option<Stir>);

#[derive(Clone, Copy, Debug)]
struct Stir {
    camera: Entity,
    pointer: Pointer,
    /// Where it was last, (x, z) of the tour, meters.
    at: DVec2,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pointer {
    Mouse,
    Finger(u64),
}

/// How far around a finger the water is moved, as a share of its distance, and at least, meters.
const RADIUS: f64 = 0.02;
const LEAST_RADIUS: f64 = 0.2;
/// Speed given to the water by a touch, m/s, and for each m/s at which the pointer moves over it.
const TAP: f64 = -0.4;
const STROKE: f64 = -0.12;
/// Hardest stroke, m/s.
const HARDEST: f64 = -0.6;
/// A pointer that moved less than this share of its distance rests.
const RESTS: f64 = 2e-3;

impl Stirring {
    pub(super) fn is_active(&self) -> bool {
        self.0.is_some()
    }
}

/// Begins, goes on with, and ends stirring.
pub(super) fn stir(
    mut stirring: ResMut<Stirring>,
    buttons: Option<Res<ButtonInput<MouseButton>>>,
    fingers: Option<Res<Touches>>,
    windows: Query<&Window, With<PrimaryWindow>>,
    cameras: Query<(
        (Entity, &TourCamera, &TourCameraState),
        (&Camera, &GlobalTransform, Option<&RenderTarget>, Option<&TourPointer>),
    )>,
    tours: Query<(&SolvedTour, &TourMotion, &GlobalTransform)>,
    mut touches: MessageWriter<TouchWater>,
    time: Res<Time>,
) {
    let mouse = buttons.as_ref().filter(|buttons| buttons.pressed(MouseButton::Left));
    let cursor = mouse.and_then(|_| windows.iter().next()?.cursor_position());
    let finger = fingers.as_ref().and_then(|fingers| {
        let mut all = fingers.iter();
        // Two fingers pinch.
        all.next().filter(|_| all.next().is_none())
    });
    let pointer = finger
        .map(|finger| (Pointer::Finger(finger.id()), finger.position()))
        .or(cursor.map(|cursor| (Pointer::Mouse, cursor)));
    let Some((pointer, position)) = pointer else {
        stirring.0 = None;
        return;
    };
    let begins = match pointer {
        Pointer::Mouse => mouse.is_some_and(|buttons| buttons.just_pressed(MouseButton::Left)),
        Pointer::Finger(id) => fingers.as_ref().is_some_and(|fingers| fingers.just_pressed(id)),
    };
    if stirring.0.is_some_and(|stir| stir.pointer != pointer) {
        stirring.0 = None;
    }
    for ((entity, camera, state), (settings, view, target, own)) in &cameras {
        let goes_on = stirring.0.filter(|stir| stir.camera == entity);
        if !camera.listens || !(begins || goes_on.is_some()) {
            continue;
        }
        let in_window = matches!(target, None | Some(RenderTarget::Window(_))).then_some(position);
        let Some(position) = own.map_or(in_window, |own| own.0) else { continue };
        let Some(tour) = state.tour() else { continue };
        let Ok((solved, motion, place)) = tours.get(tour) else { continue };
        let Ok(ray) = settings.viewport_to_world(view, position) else { continue };
        let tour_from_world = affine(place).inverse();
        let ray = Ray {
            origin: tour_from_world.transform_point3(ray.origin.as_dvec3()),
            direction: tour_from_world.transform_vector3(ray.direction.as_dvec3()),
        };
        let moved = &motion.simulation().moment().placements;
        let ripples = motion.simulation().ripples().filter(|_| !motion.still);
        let under = water_under(solved, moved, ray);
        let Some(at) = under.filter(|&at| ripples.is_some_and(|ripples| ripples.is_water(at))) else {
            continue;
        };
        let distance = at.distance(DVec2::new(ray.origin.x, ray.origin.z));
        let impulse = match goes_on {
            None => TAP,
            Some(stir) if stir.at.distance(at) < RESTS * distance => continue,
            Some(stir) => {
                let speed = stir.at.distance(at) / time.delta_secs_f64().max(1e-3);
                (STROKE * speed).max(HARDEST)
            }
        };
        let radius = (RADIUS * distance).max(LEAST_RADIUS) as f32;
        touches.write(TouchWater { tour, at: at.as_vec2(), radius, impulse: impulse as f32 });
        stirring.0 = Some(Stir { camera: entity, pointer, at });
        return;
    }
}

/// Where a ray meets the resting water, unless something stands before it.
fn water_under(tour: &SolvedTour, moved: &[Option<Placement>], ray: Ray) -> Option<DVec2> {
    let scene: &TourScene = &tour.scene;
    let to_water = -ray.origin.y / ray.direction.y;
    if !(scene.water && to_water > 0.0 && to_water.is_finite()) {
        return None;
    }
    let arrangement = scene.arranged_for(ray.origin, moved);
    let hidden = arrangement.near_to_far.iter().any(|&index| {
        let met = arrangement.meet(scene, index, ray).filter(|met| met.t < to_water);
        let seen = met.and_then(|met| scene.camera.project(met.rest.0));
        seen.is_some_and(|at| tour.maps.components[index].texture.layer.sample(at)[3] > 0.5)
    });
    let at = ray.at(to_water);
    (!hidden).then_some(DVec2::new(at.x, at.z))
}
