//! From waves to tiles: six inverse Fourier transforms a moment, two real fields in each.
//!
//! With H(k, t) the heights' spectrum, slopes are those of i·k·H and displacements those of i·k/|k|·H, never
//! differences of heights. The potential is that of linear waves.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::{IVec2, Vec2};
use rustfft::FftDirection;
use rustfft::num_complex::{Complex32, Complex64};

use super::super::fft::SquareFft;
use super::tile::SeaTile;
use super::waves::{Wave, Waves};
use super::{FINEST, TEXELS};

/// A wave vector, its opposite, and what runs along either.
#[derive(Clone, Copy, Debug)]
struct Pair {
    /// Where the wave vector and its opposite lie in a spectrum.
    places: [u32; 2],
    wave_vector: Vec2,
    along: Vec2,
    /// Half the amplitudes, with their phases.
    forward: Complex32,
    backward: Complex32,
    harmonic: u32,
    /// Potential per height, m/s.
    potential: f32,
}

/// Where a wave stands among the pairs of its tile.
#[derive(Clone, Copy, Debug, Default)]
struct Slot {
    pair: usize,
    is_forward: bool,
}

/// What it takes to compute the tiles of any moment.
#[derive(Clone, Debug)]
pub(super) struct Synthesis {
    /// Those of the large and of the small tile.
    pairs: [Vec<Pair>; 2],
    /// That of each wave.
    slots: Vec<Slot>,
    /// e^(−iωt) of every multiple of the loop's frequency.
    turns: Vec<Complex32>,
    transform: SquareFft,
    /// Height and slope along x, of each tile.
    heights: [Vec<Complex32>; 2],
    /// Slope along z, of both tiles.
    slopes: Vec<Complex32>,
    /// Potential, of both tiles.
    potentials: Vec<Complex32>,
    /// Displacement along x and z, of each tile.
    displacements: [Vec<Complex32>; 2],
    room: Vec<Complex32>,
}

impl Synthesis {
    pub(super) fn new(waves: &Waves) -> Self {
        let last = waves.waves.iter().map(|wave| wave.harmonic).max().unwrap_or(0);
        let empty = vec![Complex32::ZERO; TEXELS * TEXELS];
        let mut slots = vec![Slot::default(); waves.waves.len()];
        let pairs = [0, 1].map(|tile| pairs(waves, tile, &mut slots));
        let mut synthesis = Self {
            pairs,
            slots,
            turns: vec![Complex32::ONE; last as usize + 1],
            transform: SquareFft::new(TEXELS, FftDirection::Inverse),
            heights: [empty.clone(), empty.clone()],
            slopes: empty.clone(),
            potentials: empty.clone(),
            displacements: [empty.clone(), empty.clone()],
            room: empty,
        };
        synthesis.take_amplitudes(waves);
        synthesis
    }

    /// Takes over amplitudes that have changed. Allocates nothing.
    pub(super) fn take_amplitudes(&mut self, waves: &Waves) {
        for pair in self.pairs.iter_mut().flatten() {
            (pair.forward, pair.backward) = (Complex32::ZERO, Complex32::ZERO);
        }
        for (wave, slot) in waves.waves.iter().zip(&self.slots) {
            let pair = &mut self.pairs[wave.tile][slot.pair];
            let half = Complex64::from_polar(0.5 * wave.amplitude, wave.phase);
            let half = Complex32::new(half.re as f32, half.im as f32);
            *(if slot.is_forward { &mut pair.forward } else { &mut pair.backward }) += half;
        }
    }

    /// Computes both tiles at `turn` of the loop (0 to 1), with heights `gain` times.
    pub(super) fn run(&mut self, turn: f64, gain: f32, tiles: &mut [SeaTile; 2]) {
        let once = Complex64::cis(-TAU * turn);
        let mut power = Complex64::new(f64::from(gain), 0.0);
        for turned in &mut self.turns {
            *turned = Complex32::new(power.re as f32, power.im as f32);
            power *= once;
        }
        self.fill_spectra();
        let pairs = self.heights.iter_mut().chain(&mut self.displacements);
        for spectrum in pairs.chain([&mut self.slopes, &mut self.potentials]) {
            self.transform.process_low_rows(FINEST as usize, spectrum, &mut self.room);
            std::mem::swap(spectrum, &mut self.room);
        }
        for (index, tile) in tiles.iter_mut().enumerate() {
            let shared = self.slopes.iter().zip(&self.potentials);
            let shared = shared.map(|(z, p)| if index == 0 { [z.re, p.re] } else { [z.im, p.im] });
            let fields = self.heights[index].iter().zip(shared).zip(&self.displacements[index]);
            tile.refill(fields.map(|((height, [z, potential]), moved)| {
                ([height.re, height.im, z, potential], [moved.re, moved.im])
            }));
        }
    }

    /// Writes the spectra of the six transforms. Two real fields f and g with spectra F and G go into F + iG.
    fn fill_spectra(&mut self) {
        let i = Complex32::I;
        self.slopes.fill(Complex32::ZERO);
        self.potentials.fill(Complex32::ZERO);
        for (index, pairs) in self.pairs.iter().enumerate() {
            let heights = &mut self.heights[index];
            let displacements = &mut self.displacements[index];
            heights.fill(Complex32::ZERO);
            displacements.fill(Complex32::ZERO);
            for pair in pairs {
                let turned = self.turns[pair.harmonic as usize];
                let [forward, backward] = [pair.forward * turned, (pair.backward * turned).conj()];
                let height = forward + backward;
                let opposite = height.conj();
                let [here, there] = pair.places.map(|place| place as usize);
                heights[here] = height * (1.0 - pair.wave_vector.x);
                heights[there] = opposite * (1.0 + pair.wave_vector.x);
                let carried = Complex32::new(-pair.along.y, pair.along.x);
                displacements[here] = height * carried;
                displacements[there] = -(opposite * carried);
                let slope = i * height * pair.wave_vector.y;
                // The large tile's is the real part.
                let part = if index == 0 { Complex32::ONE } else { i };
                self.slopes[here] += part * slope;
                self.slopes[there] += part * slope.conj();
                let potential = i * (backward - forward) * pair.potential;
                self.potentials[here] += part * potential;
                self.potentials[there] += part * potential.conj();
            }
        }
    }
}

/// A tile's waves, opposite ones together, still flat; `slots` are told where each wave comes to stand.
fn pairs(waves: &Waves, tile: usize, slots: &mut [Slot]) -> Vec<Pair> {
    let forward = |wave: &Wave| (wave.cycles.y, wave.cycles.x) > (0, 0);
    let mut by_place: BTreeMap<(i32, i32), Vec<usize>> = BTreeMap::new();
    for (index, wave) in waves.waves.iter().enumerate().filter(|(_, wave)| wave.tile == tile) {
        let cycles = if forward(wave) { wave.cycles } else { -wave.cycles };
        by_place.entry((cycles.y, cycles.x)).or_default().push(index);
    }
    let mut pairs = Vec::with_capacity(by_place.len());
    for ((z, x), members) in by_place {
        for &index in &members {
            slots[index] = Slot { pair: pairs.len(), is_forward: forward(&waves.waves[index]) };
        }
        let first = &waves.waves[members[0]];
        let cycles = IVec2::new(x, z);
        let wave_vector = waves.wave_vector(first).as_vec2() * if forward(first) { 1.0 } else { -1.0 };
        pairs.push(Pair {
            places: [place(cycles), place(-cycles)],
            wave_vector,
            along: wave_vector.normalize_or_zero(),
            forward: Complex32::ZERO,
            backward: Complex32::ZERO,
            harmonic: first.harmonic,
            potential: waves.potential(first) as f32,
        });
    }
    pairs
}

/// Where a wave vector lies in a spectrum. Rows run along z, since the transform transposes.
fn place(cycles: IVec2) -> u32 {
    let size = TEXELS as i32;
    (cycles.x.rem_euclid(size) * size + cycles.y.rem_euclid(size)) as u32
}
