//! The report of the full method: labels, deviations, and remarks in words.

use super::Annotations;
use super::BackgroundHint;
use super::Label;
use super::Method;
use super::PairReport;
use super::ParameterReport;
use super::Scale;
use super::SceneParameters;
use super::SolveReport;
use super::metric;
use super::metric::BackgroundSource;
use super::observability::Gradient;
use super::observability::Observability;
use super::remarks;
use super::residual::Evidence;
use super::residual::LN_FOCAL;
use super::residual::LN_HEIGHT_RATIO;
use super::residual::PITCH;
use super::residual::PITCH_DEVIATION;
use super::residual::ROLL;
use super::residual::ROLL_DEVIATION;
use super::residual::Unknowns;

/// A ratio is measured, or weak, up to these relative deviations.
pub(super) const MEASURED_RATIO: f64 = 0.1;
const WEAK_RATIO: f64 = 0.35;
/// An angle is measured, or weak, up to these deviations in radians (0.5° and 2°).
const MEASURED_ANGLE: f64 = 0.008_73;
const WEAK_ANGLE: f64 = 0.034_9;

/// Labels a value by its deviation from observation alone and by everything; `guess` is how well it was guessed.
fn label(observed: Option<f64>, all: Option<f64>, [measured, weak]: [f64; 2], guess: Option<f64>) -> Label {
    let narrowed = all.zip(guess).is_some_and(|(all, guess)| 2.0 * all <= guess);
    match observed {
        Some(deviation) if deviation <= measured => Label::Measured,
        Some(deviation) if deviation <= weak => Label::Weak,
        _ if narrowed => Label::Weak,
        _ => Label::Assumed,
    }
}

/// A value that nobody had to find.
pub(super) fn given(name: &'static str, value: f64) -> ParameterReport {
    ParameterReport { name, value, deviation: Some(0.0), label: Label::Measured, from: vec!["given"] }
}

/// A value that nothing supports.
pub(super) fn assumed(name: &'static str, value: f64) -> ParameterReport {
    ParameterReport { name, value, deviation: None, label: Label::Assumed, from: vec!["guess"] }
}

struct Summary<'a> {
    evidence: &'a Evidence<'a>,
    annotations: &'a Annotations,
    unknowns: &'a Unknowns,
    parameters: &'a SceneParameters,
    observability: Observability,
}

/// The report on `unknowns`, which became `parameters`.
pub(super) fn report(
    evidence: &Evidence<'_>,
    unknowns: &Unknowns,
    parameters: &SceneParameters,
    pairs: Vec<PairReport>,
) -> SolveReport {
    let observability = Observability::new(evidence, unknowns);
    let summary =
        Summary { evidence, annotations: evidence.annotations, unknowns, parameters, observability };
    let mut parameters = vec![
        summary.focal(),
        summary.angle("pitch", PITCH, PITCH_DEVIATION),
        summary.angle("roll", ROLL, ROLL_DEVIATION),
        summary.height(),
        summary.ground_height(),
    ];
    if evidence.annotations.background != BackgroundHint::Open {
        parameters.push(summary.background());
    }
    let remarks = remarks::remarks(evidence, unknowns, summary.parameters, parameters[0].label);
    SolveReport { method: Method::Full, parameters, pairs, remarks }
}

impl Summary<'_> {
    /// A report by relative deviations, `value` being a positive function of the unknowns.
    fn ratio(
        &self,
        name: &'static str,
        value: f64,
        gradient: &Gradient,
        more: f64,
        guess: Option<f64>,
    ) -> ParameterReport {
        let add = |deviation: f64| deviation.hypot(more.sqrt());
        let observed = self.observability.observed_deviation(gradient).map(add);
        let all = self.observability.deviation(gradient).map(add);
        ParameterReport {
            name,
            value,
            deviation: all.map(|deviation| deviation * value),
            label: label(observed, all, [MEASURED_RATIO, WEAK_RATIO], guess),
            from: self.observability.contributors(gradient),
        }
    }

    fn focal(&self) -> ParameterReport {
        if !self.evidence.fitted[LN_FOCAL] {
            return given("focal_px", self.parameters.focal_px);
        }
        let gradient = self.observability.gradient(self.unknowns, |unknowns| unknowns[LN_FOCAL]);
        let guess = self.evidence.focal_prior.map(|prior| prior.deviation);
        self.ratio("focal_px", self.parameters.focal_px, &gradient, 0.0, guess)
    }

    fn angle(&self, name: &'static str, index: usize, guess: f64) -> ParameterReport {
        let gradient = self.observability.gradient(self.unknowns, |unknowns| unknowns[index]);
        let all = self.observability.deviation(&gradient);
        let observed = self.observability.observed_deviation(&gradient);
        ParameterReport {
            name,
            value: self.unknowns[index],
            deviation: all,
            label: label(observed, all, [MEASURED_ANGLE, WEAK_ANGLE], Some(guess)),
            from: self.observability.contributors(&gradient),
        }
    }

    fn ground_known(&self) -> bool {
        self.annotations.ground_height.is_some() || self.evidence.fitted[LN_HEIGHT_RATIO]
    }

    /// The solved parameters as a function of the unknowns; not a number where they cannot be had.
    fn value(&self, unknowns: &Unknowns, of: impl Fn(&SceneParameters) -> f64) -> f64 {
        metric::parameters(self.annotations, unknowns, &self.evidence.kept).map_or(f64::NAN, |p| of(&p))
    }

    fn height(&self) -> ParameterReport {
        let height = self.parameters.height;
        match self.annotations.scale {
            Scale::HeightAboveWater { assumed: true, .. } => return assumed("height", height),
            Scale::HeightAboveWater { .. } => return given("height", height),
            Scale::HeightAboveGround(_) if self.annotations.ground_height.is_some() => {
                return given("height", height);
            }
            Scale::HeightAboveGround(_) | Scale::Length { .. } => {}
        }
        let gradient =
            self.observability.gradient(self.unknowns, |unknowns| self.value(unknowns, |p| p.height.ln()));
        let mut report = self.ratio("height", height, &gradient, 0.0, None);
        report.from.insert(0, "given length");
        if matches!(self.annotations.scale, Scale::HeightAboveGround(_)) && !self.ground_known() {
            report.label = Label::Weak;
            report.deviation = None;
            report.from.push("guess");
        }
        report
    }

    fn ground_height(&self) -> ParameterReport {
        let value = self.parameters.ground_height;
        if self.annotations.ground_height.is_some() {
            return given("ground_height", value);
        }
        if !self.ground_known() {
            return assumed("ground_height", value);
        }
        let gradient =
            self.observability.gradient(self.unknowns, |unknowns| self.value(unknowns, |p| p.ground_height));
        let all = self.observability.deviation(&gradient);
        let observed = self.observability.observed_deviation(&gradient);
        let limits = [MEASURED_RATIO, WEAK_RATIO].map(|part| part * self.parameters.height);
        ParameterReport {
            name: "ground_height",
            value,
            deviation: all,
            label: label(observed, all, limits, None),
            from: self.observability.contributors(&gradient),
        }
    }

    fn background(&self) -> ParameterReport {
        let distance = self.parameters.background_distance;
        let lens = metric::lens(self.annotations, self.unknowns);
        let (dip, source) =
            metric::seen_background_dip(self.annotations, &lens, self.unknowns, &self.evidence.kept);
        let clicks = metric::background_click_variance(self.annotations, &lens, dip, source);
        let from = match source {
            BackgroundSource::Given => return given("background_distance", distance),
            BackgroundSource::Assumed => return assumed("background_distance", distance),
            BackgroundSource::Contact(_) => "background contact",
            BackgroundSource::Pairs | BackgroundSource::FreePairs(_) | BackgroundSource::FarPairs(_) => {
                "reflection pairs"
            }
        };
        let gradient = self
            .observability
            .gradient(self.unknowns, |unknowns| self.value(unknowns, |p| p.background_distance.ln()));
        let mut report = self.ratio("background_distance", distance, &gradient, clicks, None);
        report.from.retain(|name| *name != from);
        report.from.insert(0, from);
        if matches!(source, BackgroundSource::FarPairs(_)) && report.label == Label::Measured {
            report.label = Label::Weak;
        }
        report
    }
}
