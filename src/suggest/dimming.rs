//! What color water shows of a source.

use glam::{DMat3, DVec3, Vec3};

/// How water dims what it shows: `image = (gain + change · row) · source + tint` in each channel, sRGB codes. Near
/// water shows more of itself and less of the sky (Fresnel), so the gain changes with the row, 0 at the picture's top
/// and 1 at its bottom.
pub(super) struct Dimming {
    channels: [DVec3; 3],
    /// How far off half of all images are, codes.
    usual: f32,
}

/// A source's color, its image's color, and the image's row, 0–1.
pub(super) type Seed = (Vec3, Vec3, f64);

impl Dimming {
    /// Fits the images of sources.
    pub(super) fn of(seeds: &[Seed]) -> Self {
        let channels = std::array::from_fn(|channel| {
            // Least squares, held a little to a gain of one half that does not change.
            let (mut square, mut right) = (DMat3::from_diagonal(DVec3::new(2e4, 2e4, 1.0)), DVec3::X * 1e4);
            for (source, image, row) in seeds {
                let terms = Self::terms(f64::from(source[channel]), *row);
                square += DMat3::from_cols(terms * terms.x, terms * terms.y, terms * terms.z);
                right += terms * f64::from(image[channel]);
            }
            square.inverse() * right
        });
        let mut dimming = Self { channels, usual: 1.0 };
        let mut off: Vec<f32> = seeds.iter().map(|seed| dimming.miss(*seed)).collect();
        off.sort_by(f32::total_cmp);
        dimming.usual = off.get(off.len() / 2).copied().unwrap_or(20.0).clamp(8.0, 30.0);
        dimming
    }

    fn terms(source: f64, row: f64) -> DVec3 {
        DVec3::new(source, source * row, 1.0)
    }

    /// How far a color is from what the water would show of a source, in usual deviations.
    pub(super) fn miss(&self, (source, image, row): Seed) -> f32 {
        let expected = |channel: usize| {
            let source = f64::from(source[channel]);
            self.channels[channel].dot(Self::terms(source, row)).clamp(0.0, 255.0) as f32
        };
        Vec3::from_array(std::array::from_fn(expected)).distance(image) / self.usual
    }
}
