//! A whole first draft of a tour from a picture alone, and how far each part of it may be trusted.
//!
//! The draft passes [`Tour::check`], and one can fly through it: over water that mirrors where a reflection was found,
//! else over a level ground below a horizon that is only usual.

use super::advice::{Advice, advise};
use super::horizon::{SuggestedHorizon, suggest_horizon, usual_horizon};
use super::pairs::{SuggestedPairs, agree_with, suggest_pairs};
use super::reflection::{NoReflection, Reflection, find_reflection};
use super::regions::{SuggestedRegion, SuggestedRegions, suggest_regions};
use crate::picture::{Lens, Mask, Picture, PicturePoint};
use crate::solve::Label;
use crate::tour::{
    BackgroundPlace, FocalLength, GroundArea, Problem, Problems, Region, RelativePath, Sky, Tour, TourFile,
    WaterArea,
};

/// A tour to start from.
#[derive(Clone, Debug)]
pub struct Draft {
    /// The tour.
    pub file: TourFile,
    /// The masks that it names, to be written as gray PNG beside it.
    pub masks: Vec<(RelativePath, Mask)>,
    /// What to think of each part.
    pub trust: Vec<Remark>,
    /// The reflection that all of it rests on, if there is one.
    pub reflection: Option<Reflection>,
    /// Where to mark one more pair.
    pub advice: Option<Advice>,
}

/// What a remark is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Whether the picture mirrors, and about which line.
    Axis,
    /// The horizon.
    Horizon,
    /// The reflection pairs.
    Pairs,
    /// The focal length.
    FocalLength,
    /// The length that sets the scale.
    Scale,
    /// The water's region.
    Water,
    /// The sky's region.
    Sky,
    /// The ground's region.
    Ground,
    /// Where the background stands.
    Background,
    /// What a draft never has.
    Objects,
}

impl std::fmt::Display for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Axis => "reflection",
            Self::Horizon => "horizon",
            Self::Pairs => "pairs",
            Self::FocalLength => "focal length",
            Self::Scale => "scale",
            Self::Water => "water",
            Self::Sky => "sky",
            Self::Ground => "ground",
            Self::Background => "background",
            Self::Objects => "objects",
        })
    }
}

/// What to think of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// Of which.
    pub part: Part,
    /// How far it may be trusted, 0–1.
    pub confidence: f64,
    /// Why, and what to do, one sentence without a full stop.
    pub sentence: String,
}

/// Why there is no draft.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DraftError {
    /// `progress` asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// A side of the picture is shorter than this many pixels.
    #[error("the picture has {width} x {height} pixels; use one of at least {LEAST_SIDE} on each side")]
    TooSmall {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The picture's file cannot stand in a tour.
    #[error(transparent)]
    Unsound(#[from] Problems),
}

/// Pictures with a shorter side are refused.
pub const LEAST_SIDE: u32 = 32;
/// A horizon that is known better than this share of the height is written down; else the pairs alone decide.
const SURE_HORIZON: f64 = 0.012;
/// Fewest pairs that place camera and background by themselves.
const ENOUGH_PAIRS: usize = 4;

/// Drafts a tour for `picture`, which stands in `file` (relative to the tour's folder), with masks in `folder`; `lens` is
/// what that file says of the lens. `progress` is told the share done, 0–1, and the step, and stops the work by returning `false`.
///
/// The same picture gives the same draft, to the bit, whatever the number of cores.
///
/// # Errors
///
/// [`DraftError`] when the work was cancelled, the picture is tiny, or `file` is no path that a tour may name.
pub fn draft(
    picture: &Picture,
    lens: Option<Lens>,
    file: String,
    folder: &RelativePath,
    progress: &dyn Fn(f32, &str) -> bool,
) -> Result<Draft, DraftError> {
    let size = picture.size();
    if size.min_element() < LEAST_SIDE {
        return Err(DraftError::TooSmall { width: size.x, height: size.y });
    }
    let step =
        |share: f32, name: &str| if progress(share, name) { Ok(()) } else { Err(DraftError::Cancelled) };
    step(0.0, "looking for a reflection")?;
    let found = find_reflection(picture);
    step(0.5, "choosing reflection pairs")?;
    let reflection = found.as_ref().ok();
    let pairs = reflection.map(|reflection| suggest_pairs(reflection, size, lens));
    let horizon = match (reflection, &pairs) {
        (Some(reflection), Some(pairs)) => suggest_horizon(reflection, pairs, size),
        _ => usual_horizon(size),
    };
    step(0.6, "outlining water and sky")?;
    let regions = suggest_regions(picture, reflection, horizon.ends);
    step(0.95, "writing it down")?;

    let mut draft = Draft {
        file: TourFile::new(file),
        masks: Vec::new(),
        trust: Vec::new(),
        reflection: None,
        advice: None,
    };
    draft.file.picture.size = Some(size);
    if lens.is_some() {
        draft.file.camera.focal_length = FocalLength::Exif;
    }
    draft.axis(&found);
    let pairs = draft.water(&regions, pairs, &horizon, folder)?;
    draft.camera(&horizon, pairs.as_ref(), lens);
    draft.land(regions, &horizon, reflection, folder)?;
    let axis = reflection.map(|reflection| reflection.axis.y_at(size.as_dvec2().x / 2.0));
    let marked = draft.file.water.as_ref().map_or(&[][..], |water| &water.pairs);
    draft.advice = axis.and_then(|axis| advise(marked, axis, size));
    draft.reflection = found.ok();
    draft.remark(
        Part::Objects,
        0.0,
        "objects are not found by themselves: outline the boats, trees and rocks that stand before the rest",
    );
    Tour::check(draft.file.clone())?;
    step(1.0, "done")?;
    Ok(draft)
}

impl Draft {
    fn remark(&mut self, part: Part, confidence: f64, sentence: impl Into<String>) {
        self.trust.push(Remark { part, confidence: confidence.clamp(0.0, 1.0), sentence: sentence.into() });
    }

    /// Keeps a mask under a name of its own in a folder.
    fn mask(
        &mut self,
        name: &str,
        region: &SuggestedRegion,
        folder: &RelativePath,
    ) -> Result<Region<String>, Problems> {
        let path = format!("{folder}/{name}.png");
        let known = RelativePath::new(&path).map_err(|error| {
            Problem::new("picture.file", path.clone(), error.to_string(), "give the tour another name")
        })?;
        self.masks.push((known, region.mask.clone()));
        Ok(Region::Mask(path))
    }

    fn axis(&mut self, found: &Result<Reflection, NoReflection>) {
        match found {
            Ok(Reflection { axis, .. }) => {
                let sentence = if axis.matches > 0 {
                    format!(
                        "{} details were found again upside down, most of them about y = {:.1}",
                        axis.matches,
                        f64::midpoint(axis.ends[0].y(), axis.ends[1].y())
                    )
                } else {
                    format!("the picture as a whole mirrors, by {:.2} of 1", axis.score)
                };
                self.remark(Part::Axis, axis.confidence, sentence);
            }
            Err(none) => self.remark(Part::Axis, 0.0, none.to_string()),
        }
    }

    /// Writes the water and those pairs that lie on it below the horizon.
    fn water(
        &mut self,
        regions: &SuggestedRegions,
        pairs: Option<SuggestedPairs>,
        horizon: &SuggestedHorizon,
        folder: &RelativePath,
    ) -> Result<Option<SuggestedPairs>, Problems> {
        let Some(region) = &regions.water else {
            self.remark(
                Part::Water,
                0.0,
                "no water was found; where there is some, mark it and a few points with their reflections",
            );
            return Ok(None);
        };
        let Some(mut pairs) = pairs else { return Ok(None) };
        let on_water = |point: PicturePoint| region.mask.sample(point) >= 0.5 && below(horizon, point);
        pairs.pairs.retain(|pair| on_water(pair.pair.reflection));
        self.remark(Part::Water, region.confidence, region.reason.clone());
        let count = pairs.pairs.len();
        let mean = pairs.pairs.iter().map(|pair| pair.score).sum::<f64>() / count.max(1) as f64;
        let sentence = match count {
            0 => "no single point could be matched with its reflection: mark three or more".to_owned(),
            _ => format!("{count} points and their reflections that agree with each other"),
        };
        self.remark(Part::Pairs, mean * (count as f64 / 8.0).min(1.0), sentence);
        let marked = pairs.pairs.iter().map(|pair| pair.pair.clone()).collect();
        let region = self.mask("water", region, folder)?;
        self.file.water = Some(WaterArea { region, pairs: marked });
        Ok(Some(pairs))
    }

    fn camera(&mut self, horizon: &SuggestedHorizon, pairs: Option<&SuggestedPairs>, lens: Option<Lens>) {
        let size = self.file.picture.size.unwrap_or_default();
        let enough = pairs.filter(|pairs| pairs.pairs.len() >= ENOUGH_PAIRS);
        let unsure = horizon.deviation_px > SURE_HORIZON * f64::from(size.y);
        let mut sentence = horizon.reason.clone();
        // A line that costs a pair would be worse than none.
        if enough.is_some_and(|pairs| unsure || !agree_with(horizon.ends, size, lens, &pairs.pairs)) {
            sentence += "; it is left to the reflection pairs until you mark it";
        } else {
            self.file.camera.horizon = Some(horizon.ends);
        }
        self.remark(Part::Horizon, horizon.confidence, sentence);
        let focal = pairs.and_then(|pairs| pairs.solution.as_ref()?.report.parameter("focal_px"));
        let (confidence, sentence) = match focal.map(|focal| (focal.label, focal.value)) {
            Some((Label::Measured, px)) => {
                (0.9, format!("{px:.0} px, by the picture's file or its reflections"))
            }
            Some((Label::Weak, px)) => (0.5, format!("about {px:.0} px: type it if you know it")),
            _ => {
                (0.1, "a usual lens is assumed; turning the head may swim: type it if you know it".to_owned())
            }
        };
        self.remark(Part::FocalLength, confidence, sentence);
        let meters = crate::tour::ASSUMED_HEIGHT;
        self.remark(
            Part::Scale,
            0.1,
            format!("the camera is taken to be {meters} m high; type its height, or a known length"),
        );
    }

    /// Writes sky, ground and, where pairs do not place it, the background.
    fn land(
        &mut self,
        regions: SuggestedRegions,
        horizon: &SuggestedHorizon,
        reflection: Option<&Reflection>,
        folder: &RelativePath,
    ) -> Result<(), Problems> {
        if let Some(sky) = &regions.sky {
            let region = self.mask("sky", sky, folder)?;
            self.file.sky = Some(Sky { region: Some(region), drift: None });
            self.remark(Part::Sky, sky.confidence, sky.reason.clone());
        } else {
            self.remark(Part::Sky, 0.0, "no sky was found; it stays a part of the background");
        }
        let size = self.file.picture.size.unwrap_or_default().as_dvec2();
        if let Some(water) = &self.file.water {
            if water.pairs.len() < ENOUGH_PAIRS
                && let Some(reflection) =
                    reflection.filter(|found| found.axis.ends.iter().all(|&end| below(horizon, end)))
            {
                // The axis of what is farthest is where that would meet the water.
                self.file.background.place = Some(BackgroundPlace::Contact(reflection.axis.ends.to_vec()));
            }
            if let Some(ground) = &regions.ground {
                let region = self.mask("ground", ground, folder)?;
                self.file.ground = Some(GroundArea { region, height_above_water: 0.0 });
                self.remark(Part::Ground, ground.confidence, ground.reason.clone());
            }
            return Ok(());
        }
        let [left, right] = horizon.ends.map(|end| end.y().clamp(0.0, 0.9 * size.y) + 1.0);
        let corner = PicturePoint::new;
        let corners =
            vec![corner(0.0, left), corner(size.x, right), corner(size.x, size.y), corner(0.0, size.y)];
        self.file.ground = Some(GroundArea { region: Region::Polygon(corners), height_above_water: 0.0 });
        self.remark(
            Part::Ground,
            0.1,
            "all below the horizon is taken for level ground, for no water was found",
        );
        Ok(())
    }
}

/// Whether a point lies below the horizon, by more than a hair.
fn below(horizon: &SuggestedHorizon, point: PicturePoint) -> bool {
    let [left, right] = horizon.ends;
    let share = (point.x() - left.x()) / (right.x() - left.x());
    point.y() > left.y() + share * (right.y() - left.y()) + 0.01
}
