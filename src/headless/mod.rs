//! A tour without a window: an `App` that renders frames into memory, one for each pose that is asked for.
//!
//! A frame is handed out only after all its shaders are compiled and its assets are on the GPU, so no frame is black.

mod capture;

pub use capture::read;

use std::sync::Arc;
use std::time::Duration;

use bevy::app::PluginsState;
use bevy::asset::RenderAssetUsages;
use bevy::camera::RenderTarget;
use bevy::prelude::*;
use bevy::render::render_resource::{
    CachedPipeline, CachedPipelineState, Extent3d, PipelineCache, PipelineDescriptor, TextureDimension,
    TextureFormat, TextureUsages,
};
use bevy::render::settings::WgpuSettings;
use bevy::render::{RenderApp, RenderPlugin};
use bevy::time::TimeUpdateStrategy;
use bevy::window::{ExitCondition, WindowPlugin};

use crate::assemble::assemble;
use crate::camera::Fit;
use crate::camera::PinholeCamera;
use crate::motion::LoopError;
use crate::picture::Picture;
use crate::plugin::Guide;
use crate::plugin::PictureTour;
use crate::plugin::PictureTourPlugin;
use crate::plugin::PictureTourSystems;
use crate::plugin::SolvedTour;
use crate::plugin::TourAsset;
use crate::plugin::TourCamera;
use crate::plugin::TourCameraState;
use crate::plugin::TourFailed;
use crate::plugin::TourMotion;
use crate::plugin::TourProjection;
use crate::plugin::TourReady;

/// Why no frame can be rendered.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HeadlessError {
    /// There is no graphics adapter, not even a software one.
    #[error(
        "no graphics adapter was found; install a Vulkan driver (on Debian: mesa-vulkan-drivers) or render with --reference"
    )]
    NoAdapter,
    /// The tour could not be solved or built.
    #[error("{0}")]
    Tour(String),
    /// A shader did not compile, or the device failed.
    #[error("the GPU could not render the tour: {0}")]
    Gpu(String),
}

/// An app without a window that shows one tour.
pub struct HeadlessTour {
    app: App,
    camera: Entity,
    target: Handle<Image>,
    size: UVec2,
}

impl std::fmt::Debug for HeadlessTour {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("HeadlessTour").field("size", &self.size).finish_non_exhaustive()
    }
}

/// Updates that a tour gets to be shown: shaders come from a loading thread that may be slow.
const PATIENCE: u32 = 10_000;

impl HeadlessTour {
    /// Starts an app, solves the tour and waits until it is shown; `place` is the tour's transform in the game's world.
    ///
    /// # Errors
    ///
    /// This returns an error without an adapter, when the tour cannot be solved, or when a shader does not compile.
    pub fn new(tour: impl Into<TourAsset>, size: UVec2, place: Transform) -> Result<Self, HeadlessError> {
        Self::in_app(headless_app()?, tour, size, place)
    }

    /// The same in an app of [`headless_app_with`] that nobody has finished yet.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    pub fn in_app(
        mut app: App,
        tour: impl Into<TourAsset>,
        size: UVec2,
        place: Transform,
    ) -> Result<Self, HeadlessError> {
        app.add_plugins(PictureTourPlugin);
        // Frames are of the finished tour, never of a preview.
        let tour = match tour.into() {
            TourAsset::Source(source, options) => {
                let built = assemble(&source, &options, &|_, _| true)
                    .map_err(|error| HeadlessError::Tour(error.to_string()))?;
                TourAsset::Built(Box::new(source.tour.clone()), Arc::new(built))
            }
            built @ TourAsset::Built(..) => built,
        };
        let asset = app.world_mut().resource_mut::<Assets<TourAsset>>().add(tour);
        let target = app.world_mut().resource_mut::<Assets<Image>>().add(target_image(size));
        app.world_mut().spawn((PictureTour(asset), place));
        let camera = app
            .world_mut()
            .spawn((
                TourCamera { guide: Guide::Still, listens: false, fit: Fit::Cover, ..default() },
                RenderTarget::from(target.clone()),
                Msaa::Off,
            ))
            .id();
        app.add_systems(
            Update,
            lend_own_lens.after(PictureTourSystems::Move).before(PictureTourSystems::Upload),
        );
        app.init_resource::<Failure>();
        app.add_observer(|failed: On<TourFailed>, mut failure: ResMut<Failure>| {
            failure.0 = Some(failed.error.clone());
        });
        finish(&mut app);
        // The tour's clock is set from outside, not run.
        app.add_observer(|ready: On<TourReady>, mut motions: Query<&mut TourMotion>| {
            if let Ok(mut motion) = motions.get_mut(ready.entity) {
                (motion.paused, motion.still) = (true, true);
            }
        });
        let mut tour = Self { app, camera, target, size };
        tour.wait()?;
        Ok(tour)
    }

    /// Shows the tour as it is so many seconds after its start; `None`, and before this is called, as the picture was taken.
    pub fn go_to(&mut self, seconds: Option<f64>) {
        let world = self.app.world_mut();
        for mut motion in world.query::<&mut TourMotion>().iter_mut(world) {
            motion.still = seconds.is_none();
            if let Some(seconds) = seconds {
                motion.go_to(seconds);
            }
        }
    }

    /// Lets the tour begin anew after so many seconds, without a seam, from now on.
    ///
    /// # Errors
    ///
    /// As [`TourMotion::repeat_after`].
    pub fn repeat_after(&mut self, seconds: f64) -> Result<(), LoopError> {
        let world = self.app.world_mut();
        world
            .query::<&mut TourMotion>()
            .iter_mut(world)
            .try_for_each(|mut motion| motion.repeat_after(seconds))
    }

    /// What was solved and built.
    #[must_use]
    pub fn solved(&mut self) -> Option<SolvedTour> {
        let world = self.app.world_mut();
        world.query::<&SolvedTour>().iter(world).next().cloned()
    }

    /// Renders what `camera` sees; its pose is in the tour's space, its size that of this app.
    ///
    /// # Errors
    ///
    /// This returns an error when the device fails.
    pub fn render(&mut self, camera: &PinholeCamera) -> Result<Picture, HeadlessError> {
        if let Some(mut state) = self.app.world_mut().get_mut::<TourCameraState>(self.camera) {
            state.pose = Some(camera.pose);
        }
        let lens = TourProjection::new(camera.intrinsics, Fit::Cover);
        self.app.world_mut().entity_mut(self.camera).insert(OwnLens(lens));
        self.app.update();
        self.check()?;
        read(&self.app, &self.target, self.size).map_err(HeadlessError::Gpu)
    }

    /// Updates until everything is on the GPU.
    fn wait(&mut self) -> Result<(), HeadlessError> {
        for updates in 0..PATIENCE {
            self.app.update();
            if let Some(error) = self.app.world_mut().resource_mut::<Failure>().0.take() {
                return Err(HeadlessError::Tour(error));
            }
            if self.check()? && updates >= 3 {
                return Ok(());
            }
            if updates > 20 {
                std::thread::sleep(Duration::from_millis(1));
            }
        }
        let waiting = waiting_pipelines(&self.app).join(", ");
        Err(HeadlessError::Gpu(format!("the shaders of these pipelines did not load: {waiting}")))
    }

    /// Whether all pipelines are compiled.
    fn check(&self) -> Result<bool, HeadlessError> {
        pipelines_ready(&self.app)
    }
}

/// Whether all pipelines that were asked for so far are compiled.
///
/// # Errors
///
/// This returns an error when a shader does not compile.
pub fn pipelines_ready(app: &App) -> Result<bool, HeadlessError> {
    let cache = app.sub_app(RenderApp).world().resource::<PipelineCache>();
    let mut ready = true;
    for pipeline in cache.pipelines() {
        match &pipeline.state {
            CachedPipelineState::Ok(_) => {}
            CachedPipelineState::Err(error) if !is_waiting(error) => {
                return Err(HeadlessError::Gpu(error.to_string()));
            }
            _ => ready &= is_idle(pipeline),
        }
    }
    Ok(ready)
}

/// The labels of the pipelines that wait for their shaders.
fn waiting_pipelines(app: &App) -> Vec<String> {
    let cache = app.sub_app(RenderApp).world().resource::<PipelineCache>();
    let waiting = cache
        .pipelines()
        .filter(|pipeline| !matches!(pipeline.state, CachedPipelineState::Ok(_)) && !is_idle(pipeline));
    let label = |pipeline: &CachedPipeline| match &pipeline.descriptor {
        PipelineDescriptor::RenderPipelineDescriptor(descriptor) => descriptor.label.clone(),
        PipelineDescriptor::ComputePipelineDescriptor(descriptor) => descriptor.label.clone(),
    };
    waiting
        .map(|pipeline| label(pipeline).map_or_else(|| "unnamed".to_owned(), |label| label.to_string()))
        .collect()
}

/// Whether a pipeline is never used and so may wait for its shader for ever: Bevy asks for this one also where there
/// are no storage buffers, as on WebGL2.
fn is_idle(pipeline: &CachedPipeline) -> bool {
    let PipelineDescriptor::ComputePipelineDescriptor(descriptor) = &pipeline.descriptor else {
        return false;
    };
    descriptor.label.as_deref() == Some("sparse buffer update pipeline")
}

/// Whether a pipeline only waits for a shader that is still being loaded.
fn is_waiting(error: &bevy::shader::ShaderCacheError) -> bool {
    use bevy::shader::ShaderCacheError as E;
    matches!(error, E::ShaderNotLoaded(_) | E::ShaderImportNotYetAvailable)
}

/// The lens of the frame being rendered; replaces the one that [`TourCamera`] would use.
#[derive(Component)]
struct OwnLens(TourProjection);

fn lend_own_lens(mut cameras: Query<(&OwnLens, &mut Projection)>) {
    for (lens, mut projection) in &mut cameras {
        *projection = Projection::custom(lens.0.clone());
    }
}

/// What went wrong with the tour.
#[derive(Resource, Default)]
struct Failure(Option<String>);

/// Bevy without a window, stepping in lockstep with its renderer; each update is a sixtieth of a second.
///
/// # Errors
///
/// This returns [`HeadlessError::NoAdapter`] when nothing can render.
pub fn headless_app() -> Result<App, HeadlessError> {
    headless_app_with(AssetPlugin::default(), WgpuSettings::default())
}

/// The same with assets from elsewhere, or with a device of other limits.
///
/// # Errors
///
/// This returns [`HeadlessError::NoAdapter`] when nothing can render.
pub fn headless_app_with(assets: AssetPlugin, gpu: WgpuSettings) -> Result<App, HeadlessError> {
    if !adapter_exists() {
        return Err(HeadlessError::NoAdapter);
    }
    let mut app = App::new();
    // The rendering part of Bevy's default plugins; those with a window or pipelined frames stay out, whatever Bevy was
    // built with.
    app.add_plugins((
        (
            TaskPoolPlugin::default(),
            bevy::diagnostic::FrameCountPlugin,
            bevy::time::TimePlugin,
            TransformPlugin,
            bevy::input::InputPlugin,
            WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() },
            assets,
        ),
        (
            RenderPlugin { synchronous_pipeline_compilation: true, render_creation: gpu.into(), ..default() },
            ImagePlugin::default(),
            bevy::mesh::MeshPlugin,
            bevy::camera::CameraPlugin,
            bevy::light::LightPlugin,
            bevy::core_pipeline::CorePipelinePlugin,
            bevy::pbr::PbrPlugin::default(),
        ),
    ));
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_nanos(16_666_667)));
    Ok(app)
}

/// Whether anything can render here; Bevy itself panics without an adapter.
#[must_use]
pub fn adapter_exists() -> bool {
    let backends = WgpuSettings::default().backends;
    let Some(backends) = backends else { return false };
    let descriptor =
        wgpu::InstanceDescriptor { backends, ..wgpu::InstanceDescriptor::new_without_display_handle() };
    let instance = wgpu::Instance::new(descriptor);
    bevy::tasks::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).is_ok()
}

/// Waits for plugins that start in the background, and closes the set-up, as a runner would.
pub fn finish(app: &mut App) {
    while app.plugins_state() == PluginsState::Adding {
        bevy::tasks::tick_global_task_pools_on_main_thread();
    }
    app.finish();
    app.cleanup();
}

/// An image that a camera can render to and that can be read back.
#[must_use]
pub fn target_image(size: UVec2) -> Image {
    let size = Extent3d { width: size.x, height: size.y, depth_or_array_layers: 1 };
    let mut image = Image::new_uninit(
        size,
        TextureDimension::D2,
        TextureFormat::Rgba8UnormSrgb,
        RenderAssetUsages::RENDER_WORLD,
    );
    image.texture_descriptor.usage |= TextureUsages::RENDER_ATTACHMENT;
    image
}
