//! How well the evidence bounds the unknowns and what follows from them.
//!
//! The information matrix is Jᵀ J of the rows in standard deviations. A direction that no row resists has no deviation:
//! `None`, never a large number.

use nalgebra::SMatrix;
use nalgebra::SVector;
use nalgebra::SymmetricEigen;

use super::fit::STEP;
use super::residual::Evidence;
use super::residual::Source;
use super::residual::UNKNOWNS;
use super::residual::Unknowns;

type Square = SMatrix<f64, UNKNOWNS, UNKNOWNS>;
/// Change of a value by each unknown.
pub(super) type Gradient = SVector<f64, UNKNOWNS>;

/// Leaving out evidence that contributed raises the deviation by this factor at least.
const CONTRIBUTION: f64 = 1.05;
/// Smallest eigenvalue of the scaled information that is told from zero.
const LEAST_EIGENVALUE: f64 = 1e-10;
/// Part of a gradient that may lie in unresisted directions, squared; above it the value is unbounded.
const UNRESISTED: f64 = 1e-9;

const SOURCES: [Source; 8] = [
    Source::Pairs,
    Source::Contacts,
    Source::Horizon,
    Source::Background,
    Source::FocalInFile,
    Source::Principal,
    Source::Guess,
    Source::Wall,
];

/// Inverts one information matrix.
#[derive(Clone, Debug)]
struct Spread {
    scale: Gradient,
    values: Gradient,
    vectors: Square,
}

impl Spread {
    fn new(information: &Square) -> Self {
        // Scaled to a unit diagonal, so that radians and logarithms are judged alike.
        let scale = information.diagonal().map(|value| if value > 0.0 { value.sqrt().recip() } else { 1.0 });
        let scaled = Square::from_fn(|i, j| information[(i, j)] * scale[i] * scale[j]);
        let eigen = SymmetricEigen::new(scaled);
        Self { scale, values: eigen.eigenvalues, vectors: eigen.eigenvectors }
    }

    fn deviation(&self, gradient: &Gradient) -> Option<f64> {
        let scaled = gradient.component_mul(&self.scale);
        let along = self.vectors.tr_mul(&scaled);
        let mut variance = 0.0;
        for (&part, &value) in along.iter().zip(&self.values) {
            if value > LEAST_EIGENVALUE {
                variance += part * part / value;
            } else if part * part > UNRESISTED * scaled.norm_squared() {
                return None;
            }
        }
        variance.is_finite().then(|| variance.sqrt())
    }
}

/// What the evidence bounds, as a whole and by parts.
#[derive(Clone, Debug)]
pub(super) struct Observability {
    fitted: [bool; UNKNOWNS],
    all: Spread,
    observed: Spread,
    without: Vec<(Source, Spread)>,
}

impl Observability {
    /// Around `unknowns`, without the taming of large rows: what is kept is taken to be right.
    pub(super) fn new(evidence: &Evidence<'_>, unknowns: &Unknowns) -> Self {
        let mut rows: Vec<(Source, Gradient)> = Vec::new();
        evidence.rows(unknowns, |source, _| rows.push((source, Gradient::zeros())));
        for index in (0..UNKNOWNS).filter(|&index| evidence.fitted[index]) {
            for sign in [1.0, -1.0] {
                let mut moved = *unknowns;
                moved[index] += sign * STEP;
                let mut row = 0;
                evidence.rows(&moved, |_, value| {
                    rows[row].1[index] += sign * value / (2.0 * STEP);
                    row += 1;
                });
            }
        }
        let of = |wanted: Source| {
            let own = rows.iter().filter(|(source, _)| *source == wanted);
            own.fold(Square::zeros(), |sum, (_, gradient)| sum + gradient * gradient.transpose())
        };
        let parts: Vec<(Source, Square)> = SOURCES.iter().map(|&source| (source, of(source))).collect();
        let sum = |take: &dyn Fn(Source) -> bool| {
            parts
                .iter()
                .filter(|(source, _)| take(*source))
                .fold(Square::zeros(), |sum, (_, part)| sum + part)
        };
        let present =
            parts.iter().filter(|(source, part)| *source != Source::Wall && *part != Square::zeros());
        Self {
            fitted: evidence.fitted,
            all: Spread::new(&sum(&|_| true)),
            observed: Spread::new(&sum(&Source::is_observed)),
            without: present
                .map(|&(left_out, _)| (left_out, Spread::new(&sum(&|source| source != left_out))))
                .collect(),
        }
    }

    /// The change of `value` by each fitted unknown around `unknowns`.
    pub(super) fn gradient(&self, unknowns: &Unknowns, value: impl Fn(&Unknowns) -> f64) -> Gradient {
        Gradient::from_fn(|index, _| {
            if !self.fitted[index] {
                return 0.0;
            }
            let at = |sign: f64| {
                let mut moved = *unknowns;
                moved[index] += sign * STEP;
                value(&moved)
            };
            (at(1.0) - at(-1.0)) / (2.0 * STEP)
        })
    }

    /// Standard deviation by everything, guesses included.
    pub(super) fn deviation(&self, gradient: &Gradient) -> Option<f64> {
        self.all.deviation(gradient)
    }

    /// Standard deviation by what was observed in or of this picture.
    pub(super) fn observed_deviation(&self, gradient: &Gradient) -> Option<f64> {
        self.observed.deviation(gradient)
    }

    /// Which evidence contributed.
    pub(super) fn contributors(&self, gradient: &Gradient) -> Vec<&'static str> {
        let Some(all) = self.all.deviation(gradient).filter(|deviation| *deviation > 0.0) else {
            return Vec::new();
        };
        let matters =
            |spread: &Spread| spread.deviation(gradient).is_none_or(|left| left > CONTRIBUTION * all);
        self.without.iter().filter(|(_, spread)| matters(spread)).map(|(source, _)| name(*source)).collect()
    }
}

const fn name(source: Source) -> &'static str {
    match source {
        Source::Pairs => "reflection pairs",
        Source::Contacts => "contact lines",
        Source::Horizon => "horizon",
        Source::Background => "background contact",
        Source::FocalInFile => "focal length in the file",
        Source::Principal => "principal point",
        Source::Guess => "guess",
        Source::Wall => "range",
    }
}
