//! From a tour with its picture to a scene with its maps: all stages in order.

mod annotate;
mod backdrops;
mod source;

pub use annotate::annotations;
pub use source::TourSource;

use crate::scene::BackdropPlan;

use crate::maps::Maps;
use crate::scene::BillboardPlan;
use crate::scene::ScenePlan;
use crate::scene::TourScene;
use crate::solve::Solution;
use crate::solve::SolveError;

/// A tour ready to be looked at.
#[derive(Clone, Debug)]
pub struct AssembledTour {
    /// What was solved, and how surely.
    pub solution: Solution,
    /// The planes.
    pub scene: TourScene,
    /// Their maps.
    pub maps: Maps,
    /// What had to be moved or guessed, in words.
    pub remarks: Vec<String>,
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

/// Runs all stages; `progress` is told the share done, 0–1, and the step, and stops the work by returning `false`.
///
/// The same source gives the same result, to the bit, whatever the number of cores.
///
/// # Errors
///
/// This returns an error when the picture cannot be solved, or when the work was cancelled.
pub fn assemble(
    source: &TourSource,
    progress: &dyn Fn(f32, &str) -> bool,
) -> Result<AssembledTour, AssembleError> {
    if !progress(0.0, "solving") {
        return Err(AssembleError::Cancelled);
    }
    let solution = crate::solve::solve(&annotations(source))?;
    let mut remarks = Vec::new();
    let backdrops = backdrops::backdrops(source, &solution.parameters, &mut remarks);
    let plan = plan(source, &solution, backdrops);
    let (scene, more) = crate::scene::build(&plan);
    remarks.extend(more);
    remarks.extend(source.notes.iter().cloned());
    let maps = Maps::build(&scene, &source.picture, &source.masks(&scene), &|share, step| {
        progress(0.1 + 0.9 * share, step)
    })
    .ok_or(AssembleError::Cancelled)?;
    Ok(AssembledTour { solution, scene, maps, remarks })
}

/// What the scene is built from.
fn plan(source: &TourSource, solution: &Solution, backdrops: Vec<BackdropPlan>) -> ScenePlan {
    let tour = &source.tour;
    let parameters = &solution.parameters;
    ScenePlan {
        camera: parameters.camera(source.picture.size()),
        water: tour.water.is_some(),
        ground_height: tour.ground.as_ref().map(|_| parameters.ground_height),
        backdrops,
        billboards: tour
            .objects
            .iter()
            .zip(&source.objects)
            .filter_map(|(object, mask)| {
                let bounds = mask.bounds()?;
                Some(BillboardPlan {
                    name: object.name.clone(),
                    support: object.support,
                    contact: object.contact,
                    mask_box: [bounds.min.as_ivec2(), bounds.max.as_ivec2()],
                })
            })
            .collect(),
    }
}
