//! The live tour beside the picture: it is built from the draft, flown, and shows motion and path.

use std::sync::Arc;

use bevy::camera::RenderTarget;
use bevy::prelude::*;

use super::Session;
use crate::assemble::{PlacedTour, TourSource};
use crate::camera::{CameraPose, Fit};
use crate::editor::text::Text;
use crate::editor::{Request, Task};
use crate::plugin::{
    Guide, ObjectMotion, PictureTour, Rearranging, TourAsset, TourBuilding, TourCamera, TourCameraState,
    TourMotion, TourPart, TourPath, TourPointer, TourReady, TourWeather,
};
use crate::scene::TourScene;
use crate::tour::edit::Edit;
use crate::tour::{CameraPath, Tour};

/// The tour that the studio shows.
#[derive(Component, Debug, Default)]
pub(super) struct Shown {
    /// Whether its planes went to where newer marks put them; what moves still stands at the old place.
    is_rearranged: bool,
}

/// The camera that flies there.
#[derive(Component, Debug)]
pub(super) struct Flying;

/// Frames that are drawn after the last change: new textures and pipelines take some to arrive.
const FRAMES_AFTER: u32 = 12;

/// What the tour's image shows.
#[derive(Debug, Default)]
pub(super) struct Drawn {
    pose: Option<CameraPose>,
    frames_left: u32,
}

/// What flies.
#[derive(bevy::ecs::system::SystemParam)]
pub(super) struct Flight<'w, 's> {
    commands: Commands<'w, 's>,
    assets: ResMut<'w, Assets<TourAsset>>,
    cameras: Query<'w, 's, (Entity, &'static mut TourCamera, &'static mut TourCameraState), With<Flying>>,
    lenses: Query<'w, 's, &'static mut Camera, With<Flying>>,
    planes: Rearranging<'w, 's>,
    drawn: Local<'s, Drawn>,
    tours: Query<'w, 's, (Entity, &'static PictureTour, &'static mut Shown, Option<&'static TourBuilding>)>,
    motions: Query<'w, 's, (&'static mut TourMotion, &'static mut TourWeather), With<Shown>>,
    parts: Query<'w, 's, (&'static Name, &'static mut ObjectMotion, &'static ChildOf), With<TourPart>>,
}

impl Flight<'_, '_> {
    /// Shows a tour in place of what is shown; the camera stays where it is.
    pub(super) fn show_tour(&mut self, source: Arc<TourSource>) {
        let asset = TourAsset::from(source);
        if let Some((_, shown, ..)) = self.tours.iter().next() {
            // It was made here, so the handle is its own.
            let _ = self.assets.insert(&shown.0, asset);
        } else {
            let handle = self.assets.add(asset);
            self.commands.spawn((PictureTour(handle), Shown::default()));
        }
    }

    /// Moves the planes of what is shown to where newer marks put them; textures follow when all is built anew.
    pub(super) fn rearrange(&mut self, placed: &PlacedTour) {
        for (entity, _, mut shown, _) in &mut self.tours {
            // What is being built has become old.
            self.commands.entity(entity).try_remove::<TourBuilding>();
            shown.is_rearranged |= self.planes.place(entity, placed);
        }
    }

    /// Lets wind, water and path of what is shown be as in a newer draft that looks the same.
    pub(super) fn set_motion(&mut self, source: Arc<TourSource>) {
        let Some((entity, handle)) =
            self.tours.iter().next().map(|(entity, shown, ..)| (entity, shown.0.id()))
        else {
            return;
        };
        let Some(before) = self.assets.get(handle).map(TourAsset::tour) else { return };
        let new = &source.tour;
        let clouds = |tour: &Tour| tour.sky.as_ref().and_then(|sky| sky.drift);
        if before.waves != new.waves || clouds(before) != clouds(new) {
            self.planes.move_anew(entity, new);
        }
        let mut shown = self.commands.entity(entity);
        match new.path.as_ref().and_then(CameraPath::way) {
            Some(way) => shown.try_insert(TourPath(way)),
            None => shown.try_remove::<TourPath>(),
        };
        for (_, mut weather) in &mut self.motions {
            if weather.wind != new.wind {
                weather.wind = new.wind;
            }
        }
        self.move_objects(&source.tour);
        // Nothing is to be built for it.
        if let Some(asset) = self.assets.get_mut_untracked(handle) {
            *asset = TourAsset::from(source);
        }
    }

    /// The planes of what is shown.
    pub(super) fn scene(&self) -> Option<&TourScene> {
        self.tours.iter().find_map(|(entity, ..)| self.planes.scene(entity))
    }

    /// What is still being built.
    pub(super) fn tasks(&self, text: &Text) -> Option<Task> {
        let building = self.tours.iter().find_map(|(.., building)| building)?;
        let words = &text.session;
        let title = if building.is_refining() { words.refining } else { words.building };
        Some(Task { id: 0, title: title.to_owned(), done: Some(building.share_done()), can_cancel: false })
    }

    /// Shows no tour.
    pub(super) fn hide(&mut self) {
        for (entity, ..) in &self.tours {
            self.commands.entity(entity).try_despawn();
        }
    }

    /// Draws into an image from now on.
    pub(super) fn draw_into(&mut self, image: Handle<Image>) {
        let target = RenderTarget::from(image);
        match self.cameras.iter().next() {
            Some((camera, ..)) => {
                self.commands.entity(camera).insert(target);
            }
            None => {
                let looks = TourCamera { fit: Fit::Contain, listens: false, ..default() };
                let background =
                    Camera { order: -1, clear_color: Color::srgb_u8(20, 22, 26).into(), ..default() };
                self.commands.spawn((looks, background, target, Flying));
            }
        }
    }

    /// Draws the tour while it changes, and no longer: a picture that rests costs nothing.
    pub(super) fn draw_while(&mut self, is_busy: bool) {
        let pose = self.flown();
        let moves = self.motions.iter().any(|(motion, _)| !motion.still && !motion.simulation().is_still());
        if is_busy || moves || pose != self.drawn.pose || self.planes.have_changed() {
            (self.drawn.pose, self.drawn.frames_left) = (pose, FRAMES_AFTER);
        }
        let draws = self.drawn.frames_left > 0;
        self.drawn.frames_left = self.drawn.frames_left.saturating_sub(1);
        for mut lens in &mut self.lenses {
            if lens.is_active != draws {
                lens.is_active = draws;
            }
        }
    }

    /// Whether the tour is being drawn.
    pub(super) fn is_drawn(&self) -> bool {
        self.drawn.frames_left > 0
    }

    /// Lets the camera listen or not.
    pub(super) fn listen(&mut self, listens: bool) {
        for (_, mut camera, _) in &mut self.cameras {
            if camera.listens != listens {
                camera.listens = listens;
            }
            // Whoever takes the camera flies on from where it stands.
            if listens && camera.guide == Guide::Still {
                camera.guide = Guide::Visitor;
            }
        }
    }

    /// Lets nothing move, or lets it move unless it would not be where its planes are.
    pub(super) fn hold_still(&mut self, is_wanted: bool) {
        let still = is_wanted || self.tours.iter().any(|(_, _, shown, _)| shown.is_rearranged);
        for (mut motion, _) in &mut self.motions {
            if motion.still != still {
                motion.still = still;
            }
        }
    }

    /// Where the pointer is over the tour's image, in its pixels.
    pub(super) fn point_at(&mut self, at: Option<Vec2>) {
        for (camera, ..) in &self.cameras {
            self.commands.entity(camera).insert(TourPointer(at));
        }
    }

    /// Where the camera is.
    pub(super) fn flown(&self) -> Option<CameraPose> {
        self.cameras.iter().find_map(|(_, _, state)| state.pose)
    }

    /// Seconds along the path, while that is played.
    pub(super) fn playing(&self) -> Option<f64> {
        let (_, camera, state) = self.cameras.iter().next()?;
        (camera.guide == Guide::Path).then_some(state.path_seconds)
    }

    /// Goes round at the end of a path that is a loop, and stops at the end of another one.
    pub(super) fn end_path(&mut self, path: Option<&CameraPath>) {
        let Some((path, way)) = path.and_then(|path| Some((path, path.way()?))) else { return };
        for (_, mut camera, mut state) in &mut self.cameras {
            let is_over = camera.guide == Guide::Path && state.path_seconds >= way.duration();
            if is_over && path.looped {
                state.path_seconds %= way.duration();
            } else if is_over {
                (camera.guide, state.path_seconds) = (Guide::Still, way.duration());
            }
        }
    }

    /// Does what was asked of camera and motion.
    pub(super) fn carry_out(&mut self, request: &Request, path: Option<&CameraPath>) {
        let way = || path.and_then(CameraPath::way);
        match request {
            Request::FlyHome => {
                for (_, mut camera, mut state) in &mut self.cameras {
                    camera.guide = Guide::Visitor;
                    state.go_home();
                }
            }
            Request::FlyTo(index) => {
                let pose = path.and_then(|path| path.keyframes.get(*index)).map(crate::tour::Keyframe::pose);
                self.stand_at(pose);
            }
            Request::ShowPathAt(seconds) => {
                self.stand_at(way().map(|way| way.at(*seconds)));
                for (.., mut state) in &mut self.cameras {
                    state.path_seconds = *seconds;
                }
            }
            Request::PlayPath(plays) => {
                for (entity, shown) in self.tours.iter().map(|(entity, ..)| (entity, way())) {
                    if let Some(way) = shown {
                        self.commands.entity(entity).try_insert(TourPath(way));
                    }
                }
                let end = way().map_or(0.0, |way| way.duration());
                for (_, mut camera, mut state) in &mut self.cameras {
                    camera.guide = if *plays { Guide::Path } else { Guide::Still };
                    if *plays && state.path_seconds >= end {
                        state.path_seconds = 0.0;
                    }
                }
            }
            // Wind and motions act at once; all else waits for the tour to be built anew.
            Request::Edit(Edit::Wind(wind)) => {
                for (_, mut weather) in &mut self.motions {
                    weather.wind = *wind;
                }
            }
            _ => {}
        }
    }

    /// Lets objects move as the draft says, without building anything anew.
    pub(super) fn move_objects(&mut self, tour: &Tour) {
        for (name, mut motion, child) in &mut self.parts {
            let object = tour.objects.iter().find(|object| object.name == name.as_str());
            if let Some(object) = object.filter(|_| self.tours.contains(child.parent())) {
                motion.set_if_neq(ObjectMotion::Own(object.motion.clone()));
            }
        }
    }

    fn stand_at(&mut self, pose: Option<CameraPose>) {
        let Some(pose) = pose else { return };
        for (_, mut camera, mut state) in &mut self.cameras {
            camera.guide = Guide::Still;
            state.pose = Some(pose);
        }
    }
}

/// Notes that the planes are where everything else is, once a tour is built.
pub(super) fn take_built(ready: On<TourReady>, mut tours: Query<&mut Shown>) {
    if let Ok(mut shown) = tours.get_mut(ready.entity) {
        shown.is_rearranged = false;
    }
}

impl Session {
    /// The path that the draft has.
    pub(super) fn path(&self) -> Option<CameraPath> {
        self.desk.as_ref()?.tour().path.clone()
    }
}
