//! From a tour with its picture to a scene with its maps: all stages in order.

mod annotate;
mod backdrops;
mod bands;
mod bank;
mod drafted;
mod land;
mod measure;
mod source;

pub use annotate::annotations;
pub use bands::{BandError, BandedTour, CutOptions, cut_bands};
pub use drafted::{DraftedTour, draft_tour};
pub use measure::{DepthHints, StandingHint, background_mask, hints, measure_depth, solve_with};
#[cfg(feature = "editor")]
pub(crate) use source::read_beside;
pub use source::{TourOnDisk, TourSource};

use std::sync::Arc;

use glam::UVec2;

use crate::maps::Edge;
use crate::maps::MapOptions;
use crate::maps::Maps;
use crate::maps::TourMasks;
use crate::motion::Recordings;
use crate::picture::Mask;
use crate::scene::BillboardPlan;
use crate::scene::Role;
use crate::scene::ScenePlan;
use crate::scene::TourScene;
use crate::solve::Solution;
use crate::solve::SolveError;
use crate::tour::Region;
use crate::tour::Tour;

/// A tour ready to be looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct AssembledTour {
    /// What was solved, and how surely.
    pub solution: Solution,
    /// What the scene was built from.
    pub plan: ScenePlan,
    /// The planes.
    pub scene: TourScene,
    /// Their maps.
    pub maps: Arc<Maps>,
    /// Frames and poses that drive water and bodies. A baked tour does not hold them; it has them when it was read beside
    /// its document.
    pub recordings: Recordings,
    /// What had to be moved or guessed, in words.
    pub remarks: Vec<String>,
}

impl AssembledTour {
    /// Lets the objects turn to the camera that `tour` says now; maps do not depend on it.
    pub(crate) fn turn_as_marked(&mut self, tour: &Tour) {
        for object in &tour.objects {
            let plans = self.plan.billboards.iter_mut().filter(|plan| plan.name == object.name);
            plans.for_each(|plan| plan.turns_to_camera = object.turns_to_camera);
            let walls = self
                .scene
                .components
                .iter_mut()
                .filter(|component| component.role == Role::Billboard && component.name == object.name);
            walls.for_each(|wall| wall.turns_to_camera = object.turns_to_camera);
        }
    }
}

/// Why there is no [`AssembledTour`].
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AssembleError {
    /// The marks do not fix a camera.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// `progress` asked to stop.
    #[error("cancelled")]
    Cancelled,
}

/// A tour in meters: what is known before any map is built.
#[derive(Clone, Debug)]
pub struct PlacedTour {
    /// What was solved, and how surely.
    pub solution: Solution,
    /// What the scene was built from.
    pub plan: ScenePlan,
    /// The planes.
    pub scene: TourScene,
    /// What had to be moved or guessed, in words.
    pub remarks: Vec<String>,
    /// The ground without its banks.
    level_ground: Option<Mask>,
    /// The ground's banks, which follow the objects among the scene's billboards.
    banks: Vec<Mask>,
}

/// Solves a tour and places its planes.
///
/// # Errors
///
/// This returns an error when the marks do not fix a camera.
pub fn place(source: &TourSource) -> Result<PlacedTour, SolveError> {
    let solution = crate::solve::solve(&annotations(source))?;
    let mut remarks = Vec::new();
    let mut plan = plan(source, &solution, &mut remarks);
    let height = solution.parameters.ground_height;
    let (banks, level_ground) = match (&source.ground, &source.water) {
        (Some(ground), Some(water)) if height > LEAST_BANK => {
            let (banks, level) = bank::banks(&plan.camera, height, ground, water);
            (banks, Some(level))
        }
        (ground, _) => (Vec::new(), ground.clone()),
    };
    let (walls, banks): (Vec<_>, Vec<_>) = banks.into_iter().map(|bank| (bank.plan, bank.mask)).unzip();
    plan.billboards.extend(walls);
    let (scene, more) = crate::scene::build(&plan);
    remarks.extend(more);
    remarks.extend(source.notes.iter().cloned());
    Ok(PlacedTour { solution, plan, scene, remarks, level_ground, banks })
}

/// Ground lower than this above the water has no face worth a wall, meters.
const LEAST_BANK: f64 = 0.05;

impl PlacedTour {
    /// The masks that the tour's maps are built from.
    #[must_use]
    pub fn masks<'a>(&'a self, source: &'a TourSource) -> TourMasks<'a> {
        let objects = source.tour.objects.iter();
        let edges = objects.map(|object| match object.outline {
            Region::Polygon(_) => Edge::Outlined,
            Region::Mask(_) => Edge::Mask,
        });
        let moving = source.tour.movers().into_iter();
        TourMasks {
            water: source.water.as_ref(),
            ground: self.level_ground.as_ref(),
            backdrops: backdrops::masks(source, &self.scene),
            billboards: source.objects.iter().chain(&self.banks).collect(),
            edges: edges.chain(self.banks.iter().map(|_| Edge::Exact)).collect(),
            moving: moving.chain(self.banks.iter().map(|_| false)).collect(),
        }
    }
}

/// Runs all stages; `progress` is told the share done, 0–1, and the step, and stops the work by returning `false`.
///
/// The same source gives the same result, to the bit, whatever the number of cores.
///
/// # Errors
///
/// This returns an error when the picture cannot be solved, or when the work was cancelled.
pub fn assemble(
    source: &TourSource,
    options: &MapOptions,
    progress: &dyn Fn(f32, &str) -> bool,
) -> Result<AssembledTour, AssembleError> {
    if !progress(0.0, "solving") {
        return Err(AssembleError::Cancelled);
    }
    let placed = place(source)?;
    let maps = Maps::build(&placed.scene, &source.picture, &placed.masks(source), options, &|share, step| {
        progress(0.1 + 0.9 * share, step)
    })
    .ok_or(AssembleError::Cancelled)?;
    let PlacedTour { solution, plan, scene, remarks, .. } = placed;
    let recordings = source.recordings.clone();
    Ok(AssembledTour { solution, plan, scene, maps: Arc::new(maps), recordings, remarks })
}

/// What the scene is built from, but for the ground's banks.
fn plan(source: &TourSource, solution: &Solution, remarks: &mut Vec<String>) -> ScenePlan {
    let tour = &source.tour;
    let parameters = &solution.parameters;
    ScenePlan {
        camera: parameters.camera(source.picture.size()),
        water: tour.water.is_some(),
        ground_height: tour.ground.as_ref().map(|_| parameters.ground_height),
        backdrops: backdrops::backdrops(source, solution, remarks),
        billboards: tour
            .objects
            .iter()
            .zip(&source.objects)
            .map(|(object, mask)| {
                // Reading refuses empty masks; one made in code keeps its place among the others.
                let [min, max] =
                    mask.bounds().map_or([UVec2::ZERO, UVec2::ONE], |bounds| [bounds.min, bounds.max]);
                BillboardPlan {
                    name: object.name.clone(),
                    support: object.support,
                    contact: object.contact,
                    turns_to_camera: object.turns_to_camera,
                    mask_box: [min.as_ivec2(), max.as_ivec2()],
                }
            })
            .collect(),
    }
}
