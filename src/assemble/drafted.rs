//! A whole tour from a picture alone: what [`suggest`](crate::suggest) proposes, with the background cut into bands where
//! the mirror image tells distances.

use super::{BandError, CutOptions, TourSource, cut_bands};
use crate::depth::{DepthBand, DepthError};
use crate::motion::Recordings;
use crate::picture::{Lens, Mask, Picture};
use crate::suggest::{Advice, DraftError, Part, Reflection, Remark, draft};
use crate::tour::{Region, RelativePath, Tour};

/// A tour to start from, and how far each part of it may be trusted.
#[derive(Clone, Debug)]
pub struct DraftedTour {
    /// The tour; it passes its check and can be flown through.
    pub tour: Tour,
    /// The masks that it names, to be written beside it, of the picture's size.
    pub masks: Vec<(RelativePath, Mask)>,
    /// What to think of each part.
    pub trust: Vec<Remark>,
    /// The bands of the background, far to near; none where the mirror image tells no distance.
    pub bands: Vec<DepthBand>,
    /// The reflection that all of it rests on, if there is one.
    pub reflection: Option<Reflection>,
    /// Where to mark one more pair.
    pub advice: Option<Advice>,
}

/// Share of the work that is done when the distances' begins.
const DRAFTED: f32 = 0.4;

/// Drafts a tour for `picture`, which stands in `file` (relative to the tour's folder), with masks in `folder`; `lens` is
/// what that file says of the lens. `progress` hears the share done, 0–1, and the step, and cancels with `false`.
///
/// # Errors
///
/// [`DraftError`] when the work was cancelled, the picture is tiny, or `file` is no path that a tour may name.
pub fn draft_tour(
    picture: &Picture,
    lens: Option<Lens>,
    file: String,
    folder: &RelativePath,
    progress: &dyn Fn(f32, &str) -> bool,
) -> Result<DraftedTour, DraftError> {
    let draft = draft(picture, lens, file, folder, &|share, step| progress(DRAFTED * share, step))?;
    let mut drafted = DraftedTour {
        tour: Tour::check(draft.file)?,
        masks: draft.masks,
        trust: draft.trust,
        bands: Vec::new(),
        reflection: draft.reflection,
        advice: draft.advice,
    };
    if drafted.tour.water.is_some() {
        let step = |share: f32| progress(DRAFTED + (1.0 - DRAFTED) * share, "measuring the mirror image");
        drafted.cut(picture, lens, folder, &step)?;
    }
    Ok(drafted)
}

impl DraftedTour {
    /// Cuts the background by its mirror image, or says why not.
    fn cut(
        &mut self,
        picture: &Picture,
        lens: Option<Lens>,
        folder: &RelativePath,
        progress: &dyn Fn(f32) -> bool,
    ) -> Result<(), DraftError> {
        let source = self.source(picture, lens);
        let options = CutOptions { folder: folder.clone(), anew: false };
        let (confidence, sentence) = match cut_bands(&self.tour, &source, &options, progress) {
            Ok(cut) => {
                let distances =
                    cut.bands.iter().map(|band| band.distance).filter(|distance| distance.is_finite());
                let distances: Vec<String> = distances.map(|distance| format!("{distance:.0}")).collect();
                let measured = cut.bands.iter().map(|band| band.measured).fold(0.0, f64::max);
                (self.tour, self.bands) = (cut.tour, cut.bands);
                self.masks.extend(cut.masks);
                (measured.min(0.9), format!("by its mirror image it stands at {} m", distances.join(", ")))
            }
            Err(BandError::Depth(DepthError::Cancelled)) => return Err(DraftError::Cancelled),
            Err(error) => (0.1, format!("it stays one plane: {error}")),
        };
        self.trust.push(Remark { part: Part::Background, confidence, sentence });
        Ok(())
    }

    /// The tour with its picture and masks as if they had been read from files.
    fn source(&self, picture: &Picture, lens: Option<Lens>) -> TourSource {
        let mask = |region: Option<&Region>| match region? {
            Region::Mask(path) => {
                self.masks.iter().find(|(name, _)| name == path).map(|(_, mask)| mask.clone())
            }
            Region::Polygon(corners) => Mask::from_polygon(picture.size(), corners).ok(),
        };
        TourSource {
            picture: picture.clone(),
            uncropped_size: picture.size(),
            lens,
            water: mask(self.tour.water.as_ref().map(|water| &water.region)),
            ground: mask(self.tour.ground.as_ref().map(|ground| &ground.region)),
            objects: Vec::new(),
            bands: Vec::new(),
            sky: mask(self.tour.sky.as_ref().and_then(|sky| sky.region.as_ref())),
            recordings: Recordings::default(),
            notes: Vec::new(),
            tour: self.tour.clone(),
        }
    }
}
