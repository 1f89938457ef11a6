//! What the water does to what it mirrors, fitted on the texels where the picture shows both.
//!
//! Two models compete, and the one that explains the picture better is kept. Physical: in linear light a gain times
//! reflectance plus the water's own color (notes §5.4), the reflectance following Fresnel with a strength between 0 (it
//! is the same at all angles) and 1, as the picture supports. Painted: gain and offset in display codes, as paintings
//! and retouched pictures are made.

use crate::picture::color::linear_from_srgb_f32;
use crate::picture::color::srgb_from_linear_f32;

/// Reflectance of water at normal incidence.
const F0: f32 = 0.02;

/// Fewer samples than this say nothing; the water is then taken as a perfect mirror.
const MIN_SAMPLES: usize = 200;

/// Strengths of Fresnel's law that are tried.
const STRENGTHS: [f32; 4] = [0.25, 0.5, 0.75, 1.0];

/// Fresnel's law must lower the error at least to this share of what is left without it.
const SUPPORT: f32 = 0.97;

/// Limits of the ratio of two reflectances (notes §8.2): beyond, the fit is not to be trusted.
const RATIO: [f32; 2] = [0.5, 2.0];

/// A texel that the picture shows twice: directly and in the water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TintSample {
    /// Direct color, linear light.
    pub direct: [f32; 3],
    /// Mirrored color, linear light.
    pub mirrored: [f32; 3],
    /// Sine of the grazing angle at which the water was seen, 0–1.
    pub grazing: f32,
}

/// The fitted water.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Tint {
    model: Model,
    /// Per channel: gain and offset (of the water's own color) in the model's space.
    gain: [f32; 3],
    offset: [f32; 3],
    /// How closely the reflectance follows Fresnel's law as the angle changes, 0–1.
    pub strength: f32,
    /// Reflectance at the middle of the samples.
    middle: f32,
    /// Root mean square slope of the ripples that smear the picture's mirror images, 0 for still water.
    pub slope: f32,
    /// Median error of the fit in sRGB codes, all channels.
    pub error_codes: f32,
    /// Median distance of the mirrored colors from their own median, in sRGB codes: what a constant would miss.
    pub spread_codes: f32,
}

#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
enum Model {
    Physical,
    Painted,
}

/// Schlick's reflectance of water seen at a grazing angle of this sine.
#[must_use]
pub fn fresnel(grazing: f32) -> f32 {
    F0 + (1.0 - F0) * (1.0 - grazing.clamp(0.0, 1.0)).powi(5)
}

impl Tint {
    /// A perfect mirror, and still.
    pub const MIRROR: Self = Self {
        model: Model::Painted,
        gain: [1.0; 3],
        offset: [0.0; 3],
        strength: 0.0,
        middle: 1.0,
        slope: 0.0,
        error_codes: 0.0,
        spread_codes: 0.0,
    };

    /// Fits both models robustly and keeps the better; [`Self::MIRROR`] when there are too few samples.
    #[must_use]
    pub fn fit(samples: &[TintSample]) -> Self {
        if samples.len() < MIN_SAMPLES {
            return Self::MIRROR;
        }
        let constant = fit_model(Model::Physical, 0.0, samples);
        let physical = STRENGTHS
            .into_iter()
            .map(|strength| fit_model(Model::Physical, strength, samples))
            .filter(|fit| fit.error_codes < SUPPORT * constant.error_codes)
            .min_by(|a, b| a.error_codes.total_cmp(&b.error_codes))
            .unwrap_or(constant);
        let painted = fit_model(Model::Painted, 0.0, samples);
        // The physical model is the one to trust away from the samples, so the other must be clearly better.
        if painted.error_codes < 0.8 * physical.error_codes { painted } else { physical }
    }

    /// The mirrored color predicted for a direct one, linear light.
    #[must_use]
    pub fn mirrored(&self, direct: [f32; 3], grazing: f32) -> [f32; 3] {
        std::array::from_fn(|c| match self.model {
            Model::Physical => {
                let f = self.reflectance(grazing);
                (self.gain[c] * f * direct[c] + self.offset[c] * (1.0 - f)).clamp(0.0, 1.0)
            }
            Model::Painted => {
                let code = self.gain[c] * srgb_from_linear_f32(direct[c]) + self.offset[c];
                linear_from_srgb_f32(code.clamp(0.0, 1.0))
            }
        })
    }

    /// The water's reflectance at a grazing angle of this sine, as far as the picture supports that it changes.
    fn reflectance(&self, grazing: f32) -> f32 {
        self.middle * (fresnel(grazing) / self.middle).powf(self.strength)
    }

    /// The water's own color where it mirrors nothing, linear light; black where no angle changes anything.
    #[must_use]
    pub fn own_color(&self) -> [f32; 3] {
        if self.strength > 0.0 { self.offset.map(|x| x.clamp(0.0, 1.0)) } else { [0.0; 3] }
    }

    /// What the water shows at one angle where it showed `color` at another (sines of the grazing angles; notes §8.2).
    /// Twin of `at_angle` in `water.wgsl`.
    #[must_use]
    pub fn at_angle(&self, color: [f32; 3], was: f32, is: f32) -> [f32; 3] {
        if self.strength <= 0.0 {
            return color;
        }
        let ratio = (fresnel(is) / fresnel(was)).powf(self.strength).clamp(RATIO[0], RATIO[1]);
        let own = self.own_color();
        std::array::from_fn(|c| (own[c] + ratio * (color[c] - own[c])).max(0.0))
    }

    /// Whether the fit explains most of what the water shows.
    #[must_use]
    pub fn explains(&self) -> bool {
        self.error_codes <= 0.4 * self.spread_codes
    }

    /// The direct color for a mirrored one, the inverse of [`Self::mirrored`]; `None` where the water swallows most of
    /// it, or when the fit explains too little of what the water shows.
    #[must_use]
    pub fn direct(&self, mirrored: [f32; 3], grazing: f32) -> Option<[f32; 3]> {
        if !self.explains() {
            return None;
        }
        let mut direct = [0.0; 3];
        for c in 0..3 {
            let (gain, offset) = match self.model {
                Model::Physical => {
                    let f = self.reflectance(grazing);
                    (self.gain[c] * f, self.offset[c] * (1.0 - f))
                }
                Model::Painted => (self.gain[c], self.offset[c]),
            };
            if gain < 0.3 {
                return None;
            }
            direct[c] = match self.model {
                Model::Physical => ((mirrored[c] - offset) / gain).clamp(0.0, 1.0),
                Model::Painted => {
                    let code = (srgb_from_linear_f32(mirrored[c]) - offset) / gain;
                    linear_from_srgb_f32(code.clamp(0.0, 1.0))
                }
            };
        }
        Some(direct)
    }
}

fn fit_model(model: Model, strength: f32, samples: &[TintSample]) -> Tint {
    let middle = median(&mut samples.iter().map(|sample| fresnel(sample.grazing)).collect::<Vec<_>>());
    let mut tint = Tint { model, strength, middle, ..Tint::MIRROR };
    for c in 0..3 {
        // mirrored = gain · a + offset · b
        let rows: Vec<[f32; 3]> = samples
            .iter()
            .map(|sample| match model {
                Model::Physical => {
                    let f = tint.reflectance(sample.grazing);
                    [f * sample.direct[c], 1.0 - f, sample.mirrored[c]]
                }
                Model::Painted => {
                    [srgb_from_linear_f32(sample.direct[c]), 1.0, srgb_from_linear_f32(sample.mirrored[c])]
                }
            })
            .collect();
        let [gain, offset] = robust_line(&rows);
        tint.gain[c] = gain;
        tint.offset[c] = offset;
    }
    let codes = |color: [f32; 3]| color.map(|x| 255.0 * srgb_from_linear_f32(x));
    let mut errors = Vec::with_capacity(3 * samples.len());
    for sample in samples {
        let (seen, said) = (codes(sample.mirrored), codes(tint.mirrored(sample.direct, sample.grazing)));
        errors.extend((0..3).map(|c| (seen[c] - said[c]).abs()));
    }
    tint.error_codes = median(&mut errors);
    let mut spread = Vec::with_capacity(3 * samples.len());
    for c in 0..3 {
        let mut seen: Vec<f32> = samples.iter().map(|sample| codes(sample.mirrored)[c]).collect();
        let middle = median(&mut seen);
        spread.extend(seen.iter().map(|x| (x - middle).abs()));
    }
    tint.spread_codes = median(&mut spread);
    tint
}

/// Least squares of `y = p·a + q·b` over rows [a, b, y], iteratively reweighted with Huber's weights at 1.5 robust
/// deviations; a gain that makes no sense falls back to the offset alone.
fn robust_line(rows: &[[f32; 3]]) -> [f32; 2] {
    let mut weights = vec![1.0_f64; rows.len()];
    let mut line = [1.0_f64, 0.0];
    for _ in 0..12 {
        let (mut aa, mut ab, mut bb, mut ay, mut by) = (1e-9, 0.0, 1e-9, 0.0, 0.0);
        for (row, w) in rows.iter().zip(&weights) {
            let [a, b, y] = row.map(f64::from);
            aa += w * a * a;
            ab += w * a * b;
            bb += w * b * b;
            ay += w * a * y;
            by += w * b * y;
        }
        let det = aa * bb - ab * ab;
        if det > 1e-12 * aa * bb {
            line = [(ay * bb - by * ab) / det, (aa * by - ab * ay) / det];
        }
        if !(0.0..4.0).contains(&line[0]) {
            line = [0.0, by / bb];
        }
        let residual = |row: &[f32; 3]| {
            let [a, b, y] = row.map(f64::from);
            (y - line[0] * a - line[1] * b).abs()
        };
        let mut sizes: Vec<f32> = rows.iter().map(|row| residual(row) as f32).collect();
        let scale = 1.5 * 1.48 * f64::from(median(&mut sizes)).max(1e-4);
        for (row, w) in rows.iter().zip(&mut weights) {
            let r = residual(row);
            *w = if r <= scale { 1.0 } else { scale / r };
        }
    }
    line.map(|x| x as f32)
}

/// The median; reorders the values. 0 for none.
fn median(values: &mut [f32]) -> f32 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f32::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples of a known water, one in seven of them spoiled.
    fn samples(water: impl Fn([f32; 3], f32) -> [f32; 3]) -> Vec<TintSample> {
        (0..900)
            .map(|i| {
                let x = i as f32;
                let direct = [(x * 0.37).fract(), (x * 0.11).fract(), (x * 0.77).fract()];
                let grazing = 0.02 + 0.3 * (x * 0.53).fract();
                let mirrored = if i % 7 == 0 { [0.9, 0.1, 0.5] } else { water(direct, grazing) };
                TintSample { direct, mirrored, grazing }
            })
            .collect()
    }

    #[test]
    fn real_water_is_found_in_spite_of_outliers() {
        let water = |d: [f32; 3], s: f32| {
            let f = fresnel(s);
            std::array::from_fn(|c| 0.9 * f * d[c] + (1.0 - f) * [0.02, 0.05, 0.04][c])
        };
        let tint = Tint::fit(&samples(water));
        let (said, truth) = (tint.mirrored([0.5, 0.3, 0.7], 0.1), water([0.5, 0.3, 0.7], 0.1));
        for c in 0..3 {
            assert!((said[c] - truth[c]).abs() < 0.003, "channel {c}: {} instead of {}", said[c], truth[c]);
        }
        assert_eq!(tint.strength, 1.0);
        let steeper = tint.at_angle(truth, 0.1, 0.2);
        let expected = water([0.5, 0.3, 0.7], 0.2);
        assert!((steeper[2] - expected[2]).abs() < 0.005, "{} instead of {}", steeper[2], expected[2]);
        let back = tint.direct(truth, 0.1).unwrap();
        assert!((back[1] - 0.3).abs() < 0.01, "{} instead of 0.3", back[1]);
    }

    #[test]
    fn painted_water_is_found_too() {
        let water =
            |d: [f32; 3], _: f32| d.map(|x| linear_from_srgb_f32(0.75 * srgb_from_linear_f32(x) + 0.06));
        let tint = Tint::fit(&samples(water));
        let (said, truth) = (tint.mirrored([0.5, 0.3, 0.7], 0.1), water([0.5, 0.3, 0.7], 0.1));
        for c in 0..3 {
            assert!((said[c] - truth[c]).abs() < 0.003, "channel {c}: {} instead of {}", said[c], truth[c]);
        }
    }

    #[test]
    fn water_that_knows_no_angle_gets_none() {
        let water = |d: [f32; 3], _: f32| d.map(|x| 0.6 * x + 0.02);
        let tint = Tint::fit(&samples(water));
        assert_eq!(tint.strength, 0.0);
        assert_eq!(tint.at_angle([0.4; 3], 0.05, 0.3), [0.4; 3]);
    }

    #[test]
    fn without_samples_the_water_is_a_mirror() {
        assert_eq!(Tint::fit(&[]), Tint::MIRROR);
    }
}
