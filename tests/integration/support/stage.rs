//! An app without a window in which a test spawns tours, cameras and other things, waits, and reads pixels back.

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use bevy::asset::AssetPlugin;
use bevy::camera::RenderTarget;
use bevy::prelude::*;
use bevy::render::settings::WgpuSettings;
use bevy_picture_tour::assemble::TourSource;
use bevy_picture_tour::camera::{CameraPose, Fit};
use bevy_picture_tour::headless;
use bevy_picture_tour::maps::MapOptions;
use bevy_picture_tour::picture::Picture;
use bevy_picture_tour::plugin::{
    Guide, PictureTour, PictureTourPlugin, SolvedTour, TourAsset, TourCamera, TourCameraState, TourFailed,
    TourReady,
};

/// What the plugin has told.
#[derive(Resource, Default)]
pub(crate) struct Heard {
    /// Tours of which a preview was shown, in order.
    pub(crate) previews: Vec<Entity>,
    /// Tours that became ready for good, in order.
    pub(crate) ready: Vec<Entity>,
    /// Tours that failed, and why.
    pub(crate) failed: Vec<(Entity, String)>,
}

/// An app with the plugin.
pub(crate) struct Stage {
    /// The app; its first update is the test's.
    pub(crate) app: App,
}

/// How long a test waits for anything.
const PATIENCE: Duration = Duration::from_secs(60);

impl Stage {
    /// A stage whose assets come from this crate's folder.
    pub(crate) fn new() -> Self {
        Self::of(AssetPlugin::default())
    }

    /// A stage whose assets come from `folder`; changes are loaded when they are asked for.
    pub(crate) fn with_assets_of(folder: &Path) -> Self {
        let file_path = folder.to_string_lossy().into_owned();
        Self::of(AssetPlugin { file_path, watch_for_changes_override: Some(false), ..default() })
    }

    fn of(assets: AssetPlugin) -> Self {
        let mut app = headless::headless_app_with(assets, WgpuSettings::default())
            .unwrap_or_else(|error| panic!("{error}"));
        app.add_plugins(PictureTourPlugin).init_resource::<Heard>();
        app.add_observer(|ready: On<TourReady>, mut heard: ResMut<Heard>| {
            let list = if ready.preview { &mut heard.previews } else { &mut heard.ready };
            list.push(ready.entity);
        });
        app.add_observer(|failed: On<TourFailed>, mut heard: ResMut<Heard>| {
            heard.failed.push((failed.entity, failed.error.clone()));
        });
        headless::finish(&mut app);
        Self { app }
    }

    /// Spawns a tour made in code.
    pub(crate) fn tour(&mut self, source: Arc<TourSource>, place: Transform) -> Entity {
        let asset = self
            .app
            .world_mut()
            .resource_mut::<Assets<TourAsset>>()
            .add(TourAsset::Source(source, MapOptions::PREVIEW));
        self.app.world_mut().spawn((PictureTour(asset), place)).id()
    }

    /// Spawns a tour of a file.
    pub(crate) fn tour_of(&mut self, file: &'static str) -> Entity {
        let asset = self.app.world().resource::<AssetServer>().load::<TourAsset>(file);
        self.app.world_mut().spawn(PictureTour(asset)).id()
    }

    /// An image to render into.
    pub(crate) fn target(&mut self, size: UVec2) -> Handle<Image> {
        self.app.world_mut().resource_mut::<Assets<Image>>().add(headless::target_image(size))
    }

    /// Spawns a camera that stands where the picture was taken, with more components, and what it renders into.
    pub(crate) fn camera(&mut self, tour: Entity, size: UVec2, more: impl Bundle) -> Handle<Image> {
        let target = self.target(size);
        let looks = TourCamera {
            tour: Some(tour),
            fit: Fit::Cover,
            guide: Guide::Visitor,
            listens: false,
            ..default()
        };
        self.app.world_mut().spawn((looks, RenderTarget::from(target.clone()), more));
        target
    }

    /// Sets all cameras of tours to a pose, and lets nobody move them.
    pub(crate) fn look_from(&mut self, pose: CameraPose) {
        let world = self.app.world_mut();
        let mut cameras = world.query::<(&mut TourCamera, &mut TourCameraState)>();
        for (mut camera, mut state) in cameras.iter_mut(world) {
            camera.guide = Guide::Still;
            state.pose = Some(pose);
        }
    }

    /// What the plugin has told so far.
    pub(crate) fn heard(&self) -> &Heard {
        self.app.world().resource::<Heard>()
    }

    /// What was solved of a tour that is shown.
    pub(crate) fn solved(&self, tour: Entity) -> Option<&SolvedTour> {
        self.app.world().get::<SolvedTour>(tour)
    }

    /// Updates until `done`, or fails and says what it waited for.
    pub(crate) fn wait(&mut self, what: &str, done: impl Fn(&Self) -> bool) {
        let begun = Instant::now();
        while !done(self) {
            assert!(begun.elapsed() < PATIENCE, "{what} did not happen within {PATIENCE:?}");
            self.app.update();
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// Updates until everything that was asked for is on the GPU.
    pub(crate) fn settle(&mut self) {
        // What was just spawned asks for its pipelines in the next updates, and shaders arrive from another thread.
        for _ in 0..4 {
            self.app.update();
        }
        self.wait("the shaders' loading", |stage| {
            headless::pipelines_ready(&stage.app).unwrap_or_else(|error| panic!("{error}"))
        });
        for _ in 0..2 {
            self.app.update();
        }
    }

    /// What a target shows once everything has settled.
    pub(crate) fn shot(&mut self, target: &Handle<Image>, size: UVec2) -> Picture {
        self.settle();
        headless::read(&self.app, target, size).unwrap_or_else(|error| panic!("{error}"))
    }

    /// The names of an entity's children, in order.
    pub(crate) fn child_names(&self, parent: Entity) -> Vec<String> {
        let world = self.app.world();
        let children = world.get::<Children>(parent).map_or(&[][..], |children| &**children);
        children.iter().filter_map(|child| world.get::<Name>(*child)).map(ToString::to_string).collect()
    }

    /// All children, grandchildren and so on.
    pub(crate) fn descendants(&self, parent: Entity) -> Vec<Entity> {
        let children = self.app.world().get::<Children>(parent).map_or(&[][..], |children| &**children);
        children.iter().flat_map(|child| [vec![*child], self.descendants(*child)].concat()).collect()
    }

    /// How many entities, meshes and images there are. Materials hold images, so one that stays shows in these.
    pub(crate) fn counts(&self) -> [usize; 3] {
        let world = self.app.world();
        let images = world.resource::<Assets<Image>>().len();
        let meshes = world.resource::<Assets<Mesh>>().len();
        [world.entities().count_spawned() as usize, meshes, images]
    }
}
