//! Least squares over the unknowns that are fitted.
//!
//! A row r that may be wrong enters as ψ(r) with ψ² = c² ln(1 + r²/c²), the Cauchy loss; the others enter as they are.
//! Derivatives are central differences: the rows are smooth and cheap, and one code for them cannot contradict another.

use levenberg_marquardt::LeastSquaresProblem;
use levenberg_marquardt::LevenbergMarquardt;
use nalgebra::DMatrix;
use nalgebra::DVector;
use nalgebra::Dyn;
use nalgebra::Owned;

use super::residual::Evidence;
use super::residual::UNKNOWNS;
use super::residual::Unknowns;

/// Beyond this many deviations a row that may be wrong hardly pulls.
const CAUCHY: f64 = 2.0;
/// Step of the difference quotients; all unknowns are of the order of 1.
pub(super) const STEP: f64 = 1e-5;

/// ψ of the module's head.
fn tamed(row: f64) -> f64 {
    (CAUCHY * (row / CAUCHY).powi(2).ln_1p().sqrt()).copysign(row)
}

struct Fit<'a> {
    evidence: &'a Evidence<'a>,
    unknowns: Unknowns,
    fitted: Vec<usize>,
    rows: usize,
}

impl Fit<'_> {
    fn write(&self, unknowns: &Unknowns, mut write: impl FnMut(usize, f64)) {
        let mut row = 0;
        self.evidence.rows(unknowns, |source, value| {
            write(row, if source.may_be_wrong() { tamed(value) } else { value });
            row += 1;
        });
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Fit<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        for (&index, &value) in self.fitted.iter().zip(x) {
            self.unknowns[index] = value;
        }
    }

    fn params(&self) -> DVector<f64> {
        DVector::from_iterator(self.fitted.len(), self.fitted.iter().map(|&index| self.unknowns[index]))
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let mut residuals = DVector::zeros(self.rows);
        self.write(&self.unknowns, |row, value| residuals[row] = value);
        residuals.iter().all(|value| value.is_finite()).then_some(residuals)
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let mut jacobian = DMatrix::zeros(self.rows, self.fitted.len());
        for (column, &index) in self.fitted.iter().enumerate() {
            for sign in [1.0, -1.0] {
                let mut moved = self.unknowns;
                moved[index] += sign * STEP;
                self.write(&moved, |row, value| jacobian[(row, column)] += sign * value / (2.0 * STEP));
            }
        }
        jacobian.iter().all(|value: &f64| value.is_finite()).then_some(jacobian)
    }
}

/// The unknowns that fit `evidence` best, searched from `start`.
pub(super) fn fit(evidence: &Evidence<'_>, start: Unknowns) -> Unknowns {
    let fitted: Vec<usize> = (0..UNKNOWNS).filter(|&index| evidence.fitted[index]).collect();
    let mut rows = 0;
    evidence.rows(&start, |_, _| rows += 1);
    let problem = Fit { evidence, unknowns: start, fitted, rows };
    let (problem, _) = LevenbergMarquardt::new().with_tol(1e-12).with_patience(8).minimize(problem);
    problem.unknowns
}
