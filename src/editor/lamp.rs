//! The lamp of each step, and what the step still needs: a function of the document, its problems and the solution.

use crate::picture::PicturePoint;
use crate::solve::{Label, Solution};
use crate::tour::edit::RegionAt;
use crate::tour::{BackgroundPlace, Problem, Region, Support, TourFile};

use super::Step;
use super::egui::Color32;
use super::text::{Text, with};

/// Agreeing pairs that place a camera well.
const ENOUGH_PAIRS: usize = 4;
/// Least spread of the pairs, as part of the picture's width.
const ENOUGH_SPREAD: f64 = 0.4;
/// The marked horizon agrees with the solved one within this, pixels of a picture 1000 pixels wide.
const HORIZON_AGREES: f64 = 4.0;

/// How far a step has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Lamp {
    /// Nothing of use is marked.
    Missing,
    /// It can be flown through, and could be better.
    Rough,
    /// Nothing is left to do.
    Good,
}

/// Something that a step still needs.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the texts say what they are")]
pub enum Need {
    Horizon,
    HorizonUnsure,
    /// The marked horizon is so many pixels from the solved one.
    HorizonOff(f64),
    Water,
    /// This region is a first guess that nobody has looked at.
    Guess(RegionAt),
    Background,
    BackgroundUnsure,
    BackgroundPairs,
    Objects,
    Outline(String),
    /// This object's contact line is not below the horizon.
    Contact(String),
    WaterFirst,
    /// So many more pairs.
    Pairs(usize),
    /// So many pairs disagree with the others.
    PairsOff(usize),
    PairsSpread,
    FocalLength,
    Motion,
    Path,
    /// What the check says: what is wrong and what to do.
    Problem(String),
}

/// Lamp and needs of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct StepState {
    /// How far it is.
    pub lamp: Lamp,
    /// What is left to do, most important first.
    pub needs: Vec<Need>,
}

/// What a step looks like. `width` is the picture's, pixels; without a solution only marks count.
#[must_use]
pub fn step_state(
    step: Step,
    tour: &TourFile,
    problems: &[Problem],
    solution: Option<&Solution>,
    width: u32,
) -> StepState {
    let width = f64::from(width.max(1));
    let (lamp, mut needs) = match step {
        Step::Horizon => horizon(tour, solution, width),
        Step::Water => match &tour.water {
            Some(water) if is_drawn(&water.region) => looked_at(Lamp::Good, tour, &[RegionAt::Water]),
            _ => (Lamp::Missing, vec![Need::Water]),
        },
        Step::Ground => {
            let (lamp, mut needs) = background(tour, solution);
            let (lamp, guesses) = looked_at(lamp, tour, &[RegionAt::Ground, RegionAt::Sky]);
            needs.extend(guesses);
            (lamp, needs)
        }
        Step::Objects => objects(tour, solution),
        Step::Pairs => pairs(tour, solution, width),
        Step::Motion => motion(tour),
    };
    let found = problems.iter().filter(|problem| step_of(&problem.place.path) == step);
    let before = needs.len();
    // What is missing altogether is said already.
    if lamp != Lamp::Missing {
        needs.extend(found.map(|problem| Need::Problem(sentence(problem))));
    }
    let lamp = if needs.len() > before { lamp.min(Lamp::Rough) } else { lamp };
    StepState { lamp, needs }
}

/// What is wrong and what to do. Advice in backquotes is for those who write the file by hand.
fn sentence(problem: &Problem) -> String {
    let Problem { message, advice, .. } = problem;
    if advice.is_empty() || advice.contains('`') { message.clone() } else { format!("{message}; {advice}") }
}

/// The step in which the value at a place of the document is marked.
fn step_of(path: &str) -> Step {
    let starts = |prefix: &str| path.starts_with(prefix);
    if starts("water.pairs") {
        Step::Pairs
    } else if starts("water") || path.is_empty() {
        // Of the document as a whole: it has neither water nor ground.
        Step::Water
    } else if starts("ground") || starts("background") || starts("sky") {
        Step::Ground
    } else if starts("objects") && !path.contains(".motion") {
        Step::Objects
    } else if starts("objects") || starts("wind") || starts("waves") || starts("path") {
        Step::Motion
    } else {
        Step::Horizon
    }
}

fn is_drawn(region: &Region<String>) -> bool {
    match region {
        Region::Polygon(corners) => corners.len() >= 3,
        Region::Mask(_) => true,
    }
}

/// A lamp that is not good while one of these regions is a first guess.
fn looked_at(lamp: Lamp, tour: &TourFile, regions: &[RegionAt]) -> (Lamp, Vec<Need>) {
    let needs: Vec<Need> = regions.iter().copied().filter(|at| at.is_guess(tour)).map(Need::Guess).collect();
    (if needs.is_empty() { lamp } else { lamp.min(Lamp::Rough) }, needs)
}

fn label(solution: Option<&Solution>, name: &str) -> Option<Label> {
    solution?.report.parameter(name).map(|parameter| parameter.label)
}

fn horizon(tour: &TourFile, solution: Option<&Solution>, width: f64) -> (Lamp, Vec<Need>) {
    let pitch = label(solution, "pitch");
    let Some(marked) = tour.camera.horizon else {
        return match pitch {
            Some(Label::Measured) => (Lamp::Good, Vec::new()),
            Some(_) => (Lamp::Rough, vec![Need::Horizon]),
            None => (Lamp::Missing, vec![Need::Horizon]),
        };
    };
    let Some(solution) = solution else { return (Lamp::Rough, vec![Need::HorizonUnsure]) };
    let camera = solution.parameters.camera(glam::UVec2::new(width as u32, 1));
    let off = camera.horizon().map(|ends| distance_below(ends, marked)).unwrap_or_default();
    if off > HORIZON_AGREES * width / 1000.0 {
        return (Lamp::Rough, vec![Need::HorizonOff(off)]);
    }
    match pitch {
        Some(Label::Measured) => (Lamp::Good, Vec::new()),
        _ => (Lamp::Rough, vec![Need::HorizonUnsure]),
    }
}

/// The greater distance of two points from the line through two others, measured up and down.
fn distance_below([a, b]: [PicturePoint; 2], points: [PicturePoint; 2]) -> f64 {
    let slope = (b.y() - a.y()) / (b.x() - a.x());
    points
        .map(|point| (point.y() - a.y() - slope * (point.x() - a.x())).abs())
        .into_iter()
        .fold(0.0, f64::max)
}

fn background(tour: &TourFile, solution: Option<&Solution>) -> (Lamp, Vec<Need>) {
    let is_marked = tour.background.place.is_some() || !tour.background.bands.is_empty();
    let has_foot = matches!(tour.background.place, Some(BackgroundPlace::Contact(_)));
    let unsure = if has_foot { Need::BackgroundPairs } else { Need::BackgroundUnsure };
    match label(solution, "background_distance") {
        Some(Label::Measured) => (Lamp::Good, Vec::new()),
        Some(Label::Weak) => (Lamp::Rough, vec![unsure]),
        // On the open sea there is none.
        None if solution.is_some() => (Lamp::Good, Vec::new()),
        Some(Label::Assumed) | None if is_marked => (Lamp::Rough, vec![unsure]),
        Some(Label::Assumed) | None => (Lamp::Missing, vec![Need::Background]),
    }
}

fn objects(tour: &TourFile, solution: Option<&Solution>) -> (Lamp, Vec<Need>) {
    if tour.objects.is_empty() {
        return (Lamp::Missing, vec![Need::Objects]);
    }
    let mut needs = Vec::new();
    for object in &tour.objects {
        let stands = |parameters: &crate::solve::SceneParameters| {
            let level = match object.support {
                Support::Water => 0.0,
                Support::Ground => parameters.ground_height,
            };
            object.contact.iter().all(|foot| parameters.depth_on_level(*foot, level).is_some())
        };
        if !is_drawn(&object.outline) {
            needs.push(Need::Outline(object.name.clone()));
        } else if solution.is_some_and(|solution| !stands(&solution.parameters)) {
            needs.push(Need::Contact(object.name.clone()));
        }
    }
    (if needs.is_empty() { Lamp::Good } else { Lamp::Rough }, needs)
}

fn pairs(tour: &TourFile, solution: Option<&Solution>, width: f64) -> (Lamp, Vec<Need>) {
    let Some(water) = &tour.water else { return (Lamp::Missing, vec![Need::WaterFirst]) };
    let count = water.pairs.len();
    if count == 0 {
        return (Lamp::Missing, vec![Need::Pairs(ENOUGH_PAIRS)]);
    }
    let off = solution.map_or(0, |solution| solution.report.pairs.iter().filter(|pair| !pair.kept).count());
    let mut needs = Vec::new();
    if off > 0 {
        needs.push(Need::PairsOff(off));
    }
    let agreeing = count.saturating_sub(off);
    if agreeing < ENOUGH_PAIRS {
        needs.push(Need::Pairs(ENOUGH_PAIRS - agreeing));
    }
    let xs = water.pairs.iter().map(|pair| pair.point.x());
    let (left, right) =
        xs.fold((f64::INFINITY, f64::NEG_INFINITY), |(left, right), x| (left.min(x), right.max(x)));
    if agreeing >= ENOUGH_PAIRS && right - left < ENOUGH_SPREAD * width {
        needs.push(Need::PairsSpread);
    }
    if label(solution, "focal_px") == Some(Label::Assumed) {
        needs.push(Need::FocalLength);
    }
    (if needs.is_empty() && solution.is_some() { Lamp::Good } else { Lamp::Rough }, needs)
}

fn motion(tour: &TourFile) -> (Lamp, Vec<Need>) {
    let moves = tour.wind.speed > 0.0
        || !tour.waves.sea.is_calm()
        || tour.objects.iter().any(|object| !object.motion.is_static());
    let has_path = tour.path.as_ref().is_some_and(|path| path.keyframes.len() >= 2);
    let mut needs = Vec::new();
    if !moves {
        needs.push(Need::Motion);
    }
    if !has_path {
        needs.push(Need::Path);
    }
    let lamp = match needs.len() {
        0 => Lamp::Good,
        1 => Lamp::Rough,
        _ => Lamp::Missing,
    };
    (lamp, needs)
}

impl Need {
    /// The need in one sentence.
    pub(super) fn sentence(&self, t: &Text) -> String {
        match self {
            Self::Horizon => t.need.horizon.into(),
            Self::HorizonUnsure => t.need.horizon_unsure.into(),
            Self::HorizonOff(pixels) => with(t.need.horizon_off, format!("{pixels:.0}")),
            Self::Water => t.need.water.into(),
            Self::Guess(RegionAt::Sky) => t.need.guessed_sky.into(),
            Self::Guess(RegionAt::Ground) => t.need.guessed_ground.into(),
            Self::Guess(_) => t.need.guessed_water.into(),
            Self::Background => t.need.background.into(),
            Self::BackgroundUnsure => t.need.background_unsure.into(),
            Self::BackgroundPairs => t.need.background_pairs.into(),
            Self::Objects => t.need.objects.into(),
            Self::Outline(name) => with(t.need.outline, name),
            Self::Contact(name) => with(t.need.contact, name),
            Self::WaterFirst => t.need.water_first.into(),
            Self::Pairs(1) => t.need.one_pair.into(),
            Self::Pairs(count) => with(t.need.pairs, count),
            Self::PairsOff(count) => with(t.need.pairs_off, count),
            Self::PairsSpread => t.need.pairs_spread.into(),
            Self::FocalLength => t.need.focal_length.into(),
            Self::Motion => t.need.motion.into(),
            Self::Path => t.need.path.into(),
            Self::Problem(sentence) => super::report_words::sentence(sentence),
        }
    }
}

impl Lamp {
    /// The lamp in a word.
    pub(super) fn word(self, t: &Text) -> &'static str {
        match self {
            Self::Missing => t.need.lamp_missing,
            Self::Rough => t.need.lamp_rough,
            Self::Good => t.need.lamp_good,
        }
    }

    pub(super) fn color(self) -> Color32 {
        match self {
            Self::Missing => super::theme::BAD,
            Self::Rough => super::theme::ROUGH,
            Self::Good => super::theme::GOOD,
        }
    }
}

#[cfg(test)]
#[path = "lamp_tests.rs"]
mod tests;
