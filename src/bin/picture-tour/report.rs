//! What `check` has to say, as values: the JSON form is written as it is, `check` makes tables of it.
//!
//! Lengths are in meters, angles in degrees, shares 0 to 1.

use bevy_picture_tour::assemble::AssembledTour;
use bevy_picture_tour::maps::OriginShares;
use bevy_picture_tour::solve::Label;
use bevy_picture_tour::solve::Method;
use bevy_picture_tour::solve::PairReport;
use bevy_picture_tour::solve::ParameterReport;
use bevy_picture_tour::tour::Problem;
use bevy_picture_tour::tour::Problems;
use serde::Serialize;

use crate::depth::MirrorImage;

/// Everything that `check` found out.
#[derive(Debug, Serialize)]
pub(crate) struct Report {
    /// What the tour is called.
    pub(crate) tour: String,
    /// What is wrong with it; the rest is there when nothing is.
    pub(crate) problems: Vec<ProblemLine>,
    /// What was found out of a tour without problems.
    #[serde(flatten)]
    pub(crate) findings: Option<Findings>,
}

/// What was found out about a sound tour.
#[derive(Debug, Serialize)]
pub(crate) struct Findings {
    pub(crate) method: Method,
    pub(crate) parameters: Vec<Parameter>,
    pub(crate) pairs: Vec<PairReport>,
    /// Sentences: disagreements, and what had to be moved or guessed.
    pub(crate) remarks: Vec<String>,
    pub(crate) components: Vec<Component>,
    /// None without water.
    pub(crate) water: Option<Water>,
    /// None without water, and for a tour that was baked.
    pub(crate) mirror_image: Option<MirrorImage>,
    pub(crate) bounds: Bounds,
}

/// What the picture's water does to what it mirrors.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Water {
    /// Median difference between what it shows and what is predicted, sRGB codes.
    pub(crate) error_codes: f32,
    /// How closely its reflectance follows Fresnel's law as the camera's height changes, 0 to 1.
    pub(crate) fresnel_strength: f32,
    /// Root mean square slope of its ripples, 0 when it is still.
    pub(crate) ripple_slope: f32,
}

/// One solved number.
#[derive(Debug, Serialize)]
pub(crate) struct Parameter {
    pub(crate) name: &'static str,
    pub(crate) value: f64,
    /// `px`, `deg` or `m`.
    pub(crate) unit: &'static str,
    /// Standard deviation in the same unit; 0 for what was given, none where nothing bounds it.
    pub(crate) deviation: Option<f64>,
    pub(crate) label: Label,
    pub(crate) from: Vec<&'static str>,
}

/// One component and its maps.
#[derive(Debug, Serialize)]
pub(crate) struct Component {
    pub(crate) name: String,
    /// Where its reflection map's texels came from; none when nothing of it can be mirrored.
    pub(crate) reflection: Option<OriginShares>,
    /// How much coverage the alpha lift added.
    pub(crate) mean_lift: f32,
}

/// How far the camera may go from where the picture was taken, meters.
#[derive(Debug, Serialize)]
pub(crate) struct Bounds {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) forward: f64,
    pub(crate) back: f64,
    pub(crate) up: f64,
    pub(crate) down: f64,
}

/// One problem, taken apart.
#[derive(Debug, Serialize)]
pub(crate) struct ProblemLine {
    pub(crate) file: Option<String>,
    pub(crate) line: Option<usize>,
    pub(crate) column: Option<usize>,
    /// The way to the value, like `objects[2].contact[0]`.
    pub(crate) path: String,
    pub(crate) value: String,
    pub(crate) message: String,
    pub(crate) advice: String,
}

impl Report {
    /// The report on a tour with problems.
    pub(crate) fn of_problems(tour: String, problems: &Problems) -> Self {
        let line = |problem: &Problem| ProblemLine {
            file: problem.place.file.clone(),
            line: problem.place.line,
            column: problem.place.column,
            path: problem.place.path.clone(),
            value: problem.value.clone(),
            message: problem.message.clone(),
            advice: problem.advice.clone(),
        };
        Self { tour, problems: problems.0.iter().map(line).collect(), findings: None }
    }

    /// The report on a sound tour.
    pub(crate) fn of(tour: String, assembled: &AssembledTour, mirror_image: Option<MirrorImage>) -> Self {
        Self { tour, problems: Vec::new(), findings: Some(Findings::of(assembled, mirror_image)) }
    }
}

impl Findings {
    fn of(assembled: &AssembledTour, mirror_image: Option<MirrorImage>) -> Self {
        let AssembledTour { solution, scene, maps, remarks, .. } = assembled;
        let mut all_remarks = solution.report.remarks.clone();
        all_remarks
            .extend(remarks.iter().filter(|remark| !solution.report.remarks.contains(remark)).cloned());
        let components = scene.components.iter().zip(&maps.components);
        let (at, low, high) = (scene.camera.pose.position, scene.bounds.low, scene.bounds.high);
        Self {
            method: solution.report.method,
            parameters: solution.report.parameters.iter().map(Parameter::of).collect(),
            pairs: solution.report.pairs.clone(),
            remarks: all_remarks,
            components: components
                .map(|(component, maps)| Component {
                    name: component.name.clone(),
                    reflection: maps.reflection.as_ref().map(|_| maps.shares),
                    mean_lift: maps.mean_lift,
                })
                .collect(),
            water: scene.water.then_some(Water {
                error_codes: maps.tint.error_codes,
                fresnel_strength: maps.tint.strength,
                ripple_slope: maps.tint.slope,
            }),
            mirror_image,
            bounds: Bounds {
                left: at.x - low.x,
                right: high.x - at.x,
                forward: at.z - low.z,
                back: high.z - at.z,
                up: high.y - at.y,
                down: at.y - low.y,
            },
        }
    }
}

impl Parameter {
    fn of(report: &ParameterReport) -> Self {
        let (unit, factor) = match report.name {
            "focal_px" => ("px", 1.0),
            "pitch" | "roll" => ("deg", 1.0_f64.to_degrees()),
            _ => ("m", 1.0),
        };
        Self {
            name: report.name,
            value: report.value * factor,
            unit,
            deviation: report.deviation.map(|deviation| deviation * factor),
            label: report.label,
            from: report.from.clone(),
        }
    }
}
