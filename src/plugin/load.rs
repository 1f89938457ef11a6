//! From a handle to a tour that is shown: solving and map building, off the main thread, with an answer in the end.
//!
//! A preview is shown as soon as it can be, and refined in place: entities and materials stay. Tours whose
//! assets exist at start-up are shown before the first frame. When a changed file is broken, the last good tour stays.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use bevy::asset::{AssetEvent, AssetLoadFailedEvent};
use bevy::camera::visibility::RenderLayers;
use bevy::prelude::*;
use bevy::tasks::futures::check_ready;

use super::PictureTourSystems;
use super::asset::{BakedTourLoader, TourAsset, TourLoader};
use super::background::{Task, begin};
use super::camera::TourPath;
use super::material::{ColorPolicy, TourMaterial};
use super::motion::{TourMotion, TourWeather};
use super::spawn::{self, ShownTour, TourAssets};
use crate::assemble::AssembleError;
use crate::assemble::AssembledTour;
use crate::assemble::TourSource;
use crate::assemble::assemble;
use crate::maps::{Fill, MapOptions};
use crate::tour::CameraPath;

/// A tour in the game's world: spawn it with any `Transform`; its parts become children. Despawn it to be rid of all.
#[derive(Component, Clone, Debug)]
#[require(Transform, Visibility, ColorPolicy)]
pub struct PictureTour(pub Handle<TourAsset>);

/// A tour is shown from now on, or was refined; on the tour's entity.
#[derive(EntityEvent, Clone, Debug)]
pub struct TourReady {
    /// The tour's entity.
    pub entity: Entity,
    /// Whether this is a preview: finer maps are being built and will take its place, on the same entities.
    pub preview: bool,
}

/// A tour could not be loaded, solved or built; what was shown before stays.
#[derive(EntityEvent, Clone, Debug)]
pub struct TourFailed {
    /// The tour's entity.
    pub entity: Entity,
    /// What is wrong, where, and what to do.
    pub error: String,
}

/// The asset that a tour was built from, or is being built from.
#[derive(Component)]
struct BuiltFrom(AssetId<TourAsset>);

/// A tour being built, on its entity while that goes on; removed (or despawned with the tour), it stops the work at its
/// next step.
#[derive(Component, Debug)]
pub struct TourBuilding {
    task: Task<Result<AssembledTour, AssembleError>>,
    wanted: Arc<AtomicBool>,
    /// Thousandths.
    done: Arc<AtomicU32>,
    stage: Stage,
}

/// What a tour's build is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// To be shown at once, and refined.
    Preview,
    /// To replace a preview, on the same entities.
    Refined,
    /// To be shown as it is.
    Whole,
}

impl Stage {
    /// The first build of a tour whose maps are wanted like this, and how it is made.
    fn first(options: &MapOptions) -> (Self, MapOptions) {
        match options.fill {
            Fill::Patches => {
                (Self::Preview, MapOptions { fill: Fill::Smooth, paint_beyond: false, ..*options })
            }
            Fill::Smooth => (Self::Whole, *options),
        }
    }
}

impl TourBuilding {
    /// The share that is done, 0 to 1.
    #[must_use]
    pub fn share_done(&self) -> f32 {
        self.done.load(Ordering::Relaxed) as f32 / 1000.0
    }

    /// Whether the tour is shown already, and finer maps are made for it.
    #[must_use]
    pub fn is_refining(&self) -> bool {
        self.stage == Stage::Refined
    }

    fn start(source: &Arc<TourSource>, options: MapOptions, stage: Stage) -> Self {
        let source = Arc::clone(source);
        let wanted = Arc::new(AtomicBool::new(true));
        let done = Arc::new(AtomicU32::new(0));
        let (goes_on, told) = (Arc::clone(&wanted), Arc::clone(&done));
        let task = begin(move || {
            let build = || {
                assemble(&source, &options, &|share, _| {
                    told.store((1000.0 * share) as u32, Ordering::Relaxed);
                    goes_on.load(Ordering::Relaxed)
                })
            };
            match unhurried().filter(|_| stage == Stage::Refined) {
                Some(threads) => threads.install(build),
                None => build(),
            }
        });
        Self { task, wanted, done, stage }
    }
}

/// Threads for work that nobody waits for: one core is left to what is shown. `None` where there are no threads.
fn unhurried() -> Option<rayon::ThreadPool> {
    let cores = std::thread::available_parallelism().ok()?.get();
    rayon::ThreadPoolBuilder::new().num_threads(cores.saturating_sub(1).max(1)).build().ok()
}

impl Drop for TourBuilding {
    fn drop(&mut self) {
        self.wanted.store(false, Ordering::Relaxed);
    }
}

pub(super) fn plugin(app: &mut App) {
    app.init_asset::<TourAsset>().init_asset_loader::<TourLoader>().init_asset_loader::<BakedTourLoader>();
    app.add_systems(PostStartup, build_now);
    app.add_systems(Update, (start_building, finish_building).chain().in_set(PictureTourSystems::Input));
    app.add_systems(Update, report_failures.in_set(PictureTourSystems::Input));
    app.add_systems(Update, (follow_root, follow_policy).in_set(PictureTourSystems::Upload));
}

/// What a tour's root is asked for when it is shown.
type Root = (
    Entity,
    &'static PictureTour,
    &'static ColorPolicy,
    Option<&'static RenderLayers>,
    Option<&'static ShownTour>,
    Option<&'static TourWeather>,
);

/// Start-up: builds the tours that exist.
fn build_now(
    mut commands: Commands,
    tours: Query<Root>,
    sources: Res<Assets<TourAsset>>,
    mut assets: TourAssets,
) {
    for root in &tours {
        let Some(asset) = sources.get(&root.1.0) else { continue };
        commands.entity(root.0).try_insert(BuiltFrom(root.1.0.id()));
        let (stage, built) = match asset {
            TourAsset::Built(_, built) => (Stage::Whole, Ok(Arc::clone(built))),
            TourAsset::Source(source, options) => {
                let (stage, options) = Stage::first(options);
                (stage, assemble(source, &options, &|_, _| true).map(Arc::new))
            }
        };
        finish(&mut commands, &mut assets, root, asset, stage, built);
    }
}

/// Later: builds tours in the background when they are new or their asset has changed.
fn start_building(
    mut commands: Commands,
    tours: Query<(Entity, &PictureTour, Option<&BuiltFrom>)>,
    roots: Query<Root>,
    sources: Res<Assets<TourAsset>>,
    mut assets: TourAssets,
    mut events: MessageReader<AssetEvent<TourAsset>>,
) {
    let changed: Vec<AssetId<TourAsset>> = events
        .read()
        .filter_map(|event| match event {
            AssetEvent::Modified { id } => Some(*id),
            _ => None,
        })
        .collect();
    for (entity, tour, built) in &tours {
        let id = tour.0.id();
        // An asset's first event comes after the frame that could already build it, so it tells nothing.
        let is_new = built.is_none_or(|built| built.0 != id) || changed.contains(&id);
        let Some(asset) = sources.get(id).filter(|_| is_new) else { continue };
        commands.entity(entity).try_insert(BuiltFrom(id));
        match asset {
            TourAsset::Source(source, options) => {
                let (stage, options) = Stage::first(options);
                commands.entity(entity).try_insert(TourBuilding::start(source, options, stage));
            }
            TourAsset::Built(_, built) => {
                commands.entity(entity).try_remove::<TourBuilding>();
                if let Ok(root) = roots.get(entity) {
                    finish(&mut commands, &mut assets, root, asset, Stage::Whole, Ok(Arc::clone(built)));
                }
            }
        }
    }
}

fn finish_building(
    mut commands: Commands,
    mut building: Query<(Entity, &mut TourBuilding)>,
    tours: Query<Root>,
    sources: Res<Assets<TourAsset>>,
    mut assets: TourAssets,
) {
    for (entity, mut building) in &mut building {
        let Some(built) = check_ready(&mut building.task) else { continue };
        commands.entity(entity).try_remove::<TourBuilding>();
        if let Ok(root) = tours.get(entity)
            && let Some(asset) = sources.get(&root.1.0)
        {
            finish(&mut commands, &mut assets, root, asset, building.stage, built.map(Arc::new));
        }
    }
}

fn finish(
    commands: &mut Commands,
    assets: &mut TourAssets,
    (entity, _, policy, layers, before, weather): (
        Entity,
        &PictureTour,
        &ColorPolicy,
        Option<&RenderLayers>,
        Option<&ShownTour>,
        Option<&TourWeather>,
    ),
    asset: &TourAsset,
    stage: Stage,
    built: Result<Arc<AssembledTour>, AssembleError>,
) {
    let built = match built {
        Ok(built) => built,
        Err(error) => {
            error!("{error}");
            commands.trigger(TourFailed { entity, error: error.to_string() });
            return;
        }
    };
    let preview = stage == Stage::Preview;
    match before {
        Some(shown) if stage == Stage::Refined => spawn::refine(commands, assets, entity, built, shown),
        _ => {
            for remark in built.remarks.iter().chain(&built.solution.report.remarks) {
                info!("{remark}");
            }
            let mut motion = TourMotion::new(asset.tour(), &built);
            if let Some(weather) = weather.filter(|_| before.is_none()) {
                motion.begin_in(weather);
            }
            spawn::show(commands, assets, entity, built, motion.simulation(), *policy, layers, before);
            let weather = TourWeather(motion.simulation().weather_to_come());
            commands.entity(entity).try_insert((motion, weather));
            match asset.tour().path.as_ref().and_then(CameraPath::way) {
                Some(path) => commands.entity(entity).try_insert(TourPath(path)),
                None => commands.entity(entity).try_remove::<TourPath>(),
            };
        }
    }
    if let TourAsset::Source(source, options) = asset
        && preview
    {
        commands.entity(entity).try_insert(TourBuilding::start(source, *options, Stage::Refined));
    }
    commands.trigger(TourReady { entity, preview });
}

/// Passes on what the asset loader found.
fn report_failures(
    mut commands: Commands,
    tours: Query<(Entity, &PictureTour)>,
    mut failures: MessageReader<AssetLoadFailedEvent<TourAsset>>,
) {
    for failure in failures.read() {
        for (entity, tour) in &tours {
            if tour.0.id() == failure.id {
                commands.trigger(TourFailed { entity, error: failure.error.to_string() });
            }
        }
    }
}

/// A tour's own parts, with the meshes below them that write depth; never what a game has parented to it.
fn parts<'a>(shown: &'a ShownTour, children: &'a Query<&Children>) -> impl Iterator<Item = Entity> + 'a {
    shown.parts.iter().flat_map(|&part| children.iter_descendants(part).chain([part]))
}

/// Parts follow the root's render layers, which Bevy does not inherit.
fn follow_root(
    mut commands: Commands,
    tours: Query<(&ShownTour, &RenderLayers), Changed<RenderLayers>>,
    without: Query<&ShownTour, Without<RenderLayers>>,
    mut removed: RemovedComponents<RenderLayers>,
    children: Query<&Children>,
) {
    for shown in removed.read().filter_map(|root| without.get(root).ok()) {
        for part in parts(shown, &children) {
            commands.entity(part).try_remove::<RenderLayers>();
        }
    }
    for (shown, layers) in &tours {
        for part in parts(shown, &children) {
            commands.entity(part).try_insert(layers.clone());
        }
    }
}

/// Materials follow the root's color policy.
fn follow_policy(
    tours: Query<(&ShownTour, &ColorPolicy), Changed<ColorPolicy>>,
    children: Query<&Children>,
    handles: Query<&MeshMaterial3d<TourMaterial>>,
    mut materials: ResMut<Assets<TourMaterial>>,
) {
    for (shown, policy) in &tours {
        for child in parts(shown, &children) {
            if let Some(mut material) = handles.get(child).ok().and_then(|handle| materials.get_mut(handle)) {
                material.policy = *policy;
            }
        }
    }
}
