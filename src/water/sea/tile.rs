//! One rectangle of the sea, repeated over the water: texels for the shader, and the same by interpolation.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, Vec2};

use super::covariance::SlopeCovariance;
use super::waves::Waves;
use super::{FINEST, TEXELS, WaveSample};

/// Mip levels of a tile, down to one texel.
pub const LEVELS: usize = TEXELS.ilog2() as usize + 1;

/// A rectangle of the sea that repeats along x and z; of waves of the wind a square.
///
/// Texel (column i, row j) of level l, at index l's start + j·(128 >> l) + i, is the mean over the block of 2ˡ·2ˡ texels of
/// level 0, whose texel (i, j) lies at (x, z) = (i, j)·size/128 plus any multiple of the size. A texture is
/// therefore read at uv = xz/size + 0.5/128.
#[derive(Clone, Debug)]
pub struct SeaTile {
    size: DVec2,
    texels: Vec<[f32; 4]>,
    displacements: Vec<[f32; 2]>,
    lost: [SlopeCovariance; LEVELS],
}

impl SeaTile {
    /// The still tile `index` of a sea.
    pub(super) fn new(waves: &Waves, index: usize) -> Self {
        let mut tile = Self::flat(DVec2::splat(waves.sizes[index]));
        tile.tabulate_lost(waves, index);
        tile
    }

    /// Takes over how the waves of tile `index` run now: what averaging takes from their slopes.
    pub(super) fn tabulate_lost(&mut self, waves: &Waves, index: usize) {
        // What is left of waves that fit so many times along one axis in the mean of two neighbors of a level.
        let mut pairs = [[1.0; FINEST as usize + 1]; LEVELS];
        for (level, pairs) in pairs.iter_mut().enumerate().skip(1) {
            let half = PI / TEXELS as f64 * f64::from(1 << (level - 1));
            for (cycles, kept) in pairs.iter_mut().enumerate() {
                *kept = (half * cycles as f64).cos();
            }
        }
        self.lost = Default::default();
        for wave in waves.waves.iter().filter(|wave| wave.tile == index) {
            let mut whole = SlopeCovariance::default();
            whole.add_wave(waves.wave_vector(wave), wave.amplitude);
            let [x, z] = wave.cycles.abs().to_array().map(|cycles| cycles as usize);
            let mut kept = 1.0;
            for (lost, pairs) in self.lost.iter_mut().zip(&pairs) {
                kept *= pairs[x] * pairs[z];
                *lost += whole * (1.0 - kept * kept);
            }
        }
    }

    /// Still water of `size` meters along x and z.
    pub(super) fn flat(size: DVec2) -> Self {
        let count = (0..LEVELS).map(|level| (TEXELS >> level).pow(2)).sum();
        Self {
            size,
            texels: vec![[0.0; 4]; count],
            displacements: vec![[0.0; 2]; TEXELS * TEXELS],
            lost: Default::default(),
        }
    }

    /// Its sides along x and z, meters.
    #[must_use]
    pub fn size(&self) -> DVec2 {
        self.size
    }

    /// The shorter side of a texel of level 0, meters: a mip level is as fine as it must be not to shimmer along either.
    #[must_use]
    pub fn texel(&self) -> f64 {
        self.size.min_element() / TEXELS as f64
    }

    /// A texel by interpolation at (x, z) in meters and between two mip levels; level 0 at most, the coarsest at least. Twin
    /// of `sea_mean` in `waves.wgsl`.
    #[must_use]
    pub fn mean(&self, xz: DVec2, level: f32) -> [f32; 4] {
        let level = level.clamp(0.0, (LEVELS - 1) as f32);
        let (low, high) = (level.floor() as usize, level.ceil() as usize);
        let share = level.fract();
        let [low, high] = [low, high].map(|level| self.mean_of_level(xz, level));
        std::array::from_fn(|i| low[i] + share * (high[i] - low[i]))
    }

    fn mean_of_level(&self, xz: DVec2, level: usize) -> [f32; 4] {
        let count = TEXELS >> level;
        let start: usize = (0..level).map(|level| (TEXELS >> level).pow(2)).sum();
        // Centers: see the layout above.
        let place = (xz / self.size).map(|turns| turns.rem_euclid(1.0)) * count as f64
            + 0.5 / f64::from(1_u32 << level)
            - 0.5;
        let corner = place.floor();
        let part = (place - corner).as_vec2();
        let texel = |dx: i64, dz: i64| {
            let [column, row] =
                [corner.x as i64 + dx, corner.y as i64 + dz].map(|i| i.rem_euclid(count as i64) as usize);
            self.texels[start + row * count + column]
        };
        let mix = |a: [f32; 4], b: [f32; 4], t: f32| std::array::from_fn(|i| a[i] + t * (b[i] - a[i]));
        mix(mix(texel(0, 0), texel(1, 0), part.x), mix(texel(0, 1), texel(1, 1), part.x), part.y)
    }

    /// Height (meters), slope along x, slope along z, potential at the surface (m²/s): all mip levels one after the other, 128 × 128 texels first,
    /// in rows along x.
    #[must_use]
    pub fn texels(&self) -> &[[f32; 4]] {
        &self.texels
    }

    /// How far each point of level 0 is carried along x and z, meters, in rows along x.
    #[must_use]
    pub fn displacements(&self) -> &[[f32; 2]] {
        &self.displacements
    }

    /// For each mip level the slope covariance that its averaging has taken away, at a gain of 1; grows with its square.
    #[must_use]
    pub fn lost_by_level(&self) -> &[SlopeCovariance; LEVELS] {
        &self.lost
    }

    /// Makes it flat.
    pub(super) fn flatten(&mut self) {
        self.texels.fill([0.0; 4]);
        self.displacements.fill([0.0; 2]);
    }

    /// Takes new texels, each with its displacement, of level 0 and averages them for the others.
    pub(super) fn refill(&mut self, values: impl Iterator<Item = ([f32; 4], [f32; 2])>) {
        let places = self.texels.iter_mut().zip(&mut self.displacements);
        for ((texel, displacement), (value, carried)) in places.zip(values) {
            *texel = value;
            *displacement = carried;
        }
        let mut above = &mut self.texels[..];
        let mut size = TEXELS;
        while size > 1 {
            let (fine, rest) = above.split_at_mut(size * size);
            let rows = fine.chunks_exact(2 * size).map(|rows| rows.split_at(size));
            for ((upper, lower), means) in rows.zip(rest.chunks_exact_mut(size / 2)) {
                let (upper, lower) = (upper.as_chunks::<2>().0, lower.as_chunks::<2>().0);
                for ((mean, [a, b]), [c, d]) in means.iter_mut().zip(upper).zip(lower) {
                    *mean = std::array::from_fn(|i| 0.25 * (a[i] + b[i] + c[i] + d[i]));
                }
            }
            above = rest;
            size /= 2;
        }
    }

    /// Measures what each level's averaging takes away of the slopes that are in it, at a gain of `gain`.
    pub(super) fn measure_lost(&mut self, gain: f64) {
        let mut rest = &self.texels[..];
        let mut whole = None;
        for (level, lost) in self.lost.iter_mut().enumerate() {
            let (texels, coarser) = rest.split_at((TEXELS >> level).pow(2));
            let mut left = SlopeCovariance::default();
            for [_, x, z, _] in texels.iter().map(|texel| texel.map(f64::from)) {
                left += SlopeCovariance { xx: x * x, xz: x * z, zz: z * z };
            }
            left *= 1.0 / (gain * gain * texels.len() as f64);
            let whole = *whole.get_or_insert(left);
            *lost = whole;
            *lost += left * -1.0;
            rest = coarser;
        }
    }

    /// Height, slope and displacement by bilinear interpolation.
    pub(super) fn sample(&self, xz: DVec2) -> WaveSample {
        let place = (xz / self.size).map(|turns| turns.rem_euclid(1.0)) * TEXELS as f64;
        let corner = place.floor();
        let share = (place - corner).as_vec2();
        let mut sample = WaveSample::default();
        for (dx, dz) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            // A remainder may round up to 1, and NaN becomes 0: the mask keeps both inside.
            let column = (corner.x as usize + dx) & (TEXELS - 1);
            let row = (corner.y as usize + dz) & (TEXELS - 1);
            let [height, x, z, potential] = self.texels[row * TEXELS + column];
            let weight = (if dx == 0 { 1.0 - share.x } else { share.x })
                * (if dz == 0 { 1.0 - share.y } else { share.y });
            sample.height += weight * height;
            sample.slope += weight * Vec2::new(x, z);
            sample.potential += weight * potential;
            sample.displacement += weight * Vec2::from(self.displacements[row * TEXELS + column]);
        }
        sample
    }
}

/// The share of a wave's amplitude that is left of its mean over a rectangle of `footprint` meters.
pub(super) fn kept_by_mean(wave_vector: DVec2, footprint: DVec2) -> f64 {
    let sinc = |half: f64| if half.abs() < 1e-6 { 1.0 } else { half.sin() / half };
    // Beyond the first zero there is nothing: the sidelobes are a rectangle's, not a pixel's. Nor is there for a footprint
    // without end, times 0 or not.
    let kept = |phase: f64| if phase.abs() < TAU { sinc(0.5 * phase) } else { 0.0 };
    kept(wave_vector.x * footprint.x) * kept(wave_vector.y * footprint.y)
}
