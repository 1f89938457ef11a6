//! What a solution says of itself: how sure each number is, and which annotations disagree.

use serde::Serialize;

use super::Method;

/// How far a number can be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Label {
    /// Given by the user, or found from the picture to 10 % (angles: 0.5°).
    Measured,
    /// Found from the picture to 35 % (angles: 2°), or at least twice as well as it was guessed.
    Weak,
    /// A guess that the picture neither confirms nor refutes.
    Assumed,
}

/// One number of [`super::SceneParameters`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterReport {
    /// The field's name.
    pub name: &'static str,
    /// Its value, in the field's unit.
    pub value: f64,
    /// Standard deviation after everything was taken into account, in the same unit; 0 for what was given, `None` when
    /// nothing bounds it.
    pub deviation: Option<f64>,
    /// How far it can be trusted.
    pub label: Label,
    /// Which evidence contributed: each would, left out, raise the deviation by 5 % or more.
    pub from: Vec<&'static str>,
}

/// What became of one reflection pair.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PairReport {
    /// The pair's name.
    pub name: String,
    /// How far the reflection lies from where the solution puts it, pixels.
    pub residual_px: f64,
    /// The part of it across the direction in which reflections run: real bodies have none.
    pub sideways_px: f64,
    /// The pair's own depth, meters along −z; `None` when it is too far to tell.
    pub depth: Option<f64>,
    /// Whether it took part in the solution.
    pub kept: bool,
    /// What to tell the user about it.
    pub remark: Option<String>,
}

/// What a solution says of itself.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SolveReport {
    /// How it was solved.
    pub method: Method,
    /// `focal_px`, `pitch`, `roll`, `height`, `ground_height`, `background_distance`, in this order; the last is missing
    /// where there is no background.
    pub parameters: Vec<ParameterReport>,
    /// In the order of the annotations.
    pub pairs: Vec<PairReport>,
    /// Sentences for the user: disagreements, in pixels, and what could not be told.
    pub remarks: Vec<String>,
}

impl SolveReport {
    /// The report on the parameter `name`.
    #[must_use]
    pub fn parameter(&self, name: &str) -> Option<&ParameterReport> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }
}
