#![doc = include_str!("README.md")]

mod annotations;
mod check;
mod convergence;
mod error;
mod fit;
mod full;
mod judge;
mod level;
mod metric;
mod observability;
mod pair;
mod paper;
mod parameters;
mod remarks;
mod report;
mod residual;
mod summary;
#[cfg(test)]
mod tests;

pub use crate::tour::Method;
pub use crate::tour::Support;
pub use annotations::AnnotatedPair;
pub use annotations::AnnotatedPlane;
pub use annotations::Annotations;
pub use annotations::BackgroundHint;
pub use annotations::FocalLength;
pub use annotations::PairPlane;
pub use annotations::Scale;
pub use error::SolveError;
pub use paper::paper_objective;
pub use paper::paper_residual;
pub use parameters::SceneParameters;
pub use report::Label;
pub use report::PairReport;
pub use report::ParameterReport;
pub use report::SolveReport;

use serde::Serialize;

/// A solved picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solution {
    /// The numbers themselves.
    pub parameters: SceneParameters,
    /// How sure they are, and what disagrees.
    pub report: SolveReport,
}

/// Finds the camera and the distances of a picture from what was marked in it.
///
/// The same annotations give the same solution, to the bit.
///
/// # Errors
///
/// [`SolveError`] when the annotations contradict themselves (an index that is not there, a negative length), or when
/// neither a horizon nor two agreeing reflection pairs are marked.
pub fn solve(annotations: &Annotations) -> Result<Solution, SolveError> {
    annotations.check()?;
    match annotations.method {
        Method::Paper => paper::solve(annotations),
        Method::Full => full::solve(annotations, full::Guesses::Used),
    }
}
