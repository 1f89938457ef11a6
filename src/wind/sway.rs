//! How a plant is bent at one moment: the record that goes to the GPU, and where it puts points.
//!
//! Twin of `sway.wgsl`: same names, same steps. Everything happens in the component's own plane: `a` meters to the
//! right along it, `b` meters up. Nothing moves at or below the root, and a record of a still plant returns every point
//! to the bit. Displacements change by at most 0.4 m a meter (held by [`Plant`](super::Plant)), so a rest point is
//! found by three updates (notes §6.3).

use glam::{Vec2, Vec4};

/// How much lower a bent stem's tip is, in squares of its way sideways per length: half the integral of the mode
/// shape's squared slope, 8/7.
pub(super) const FORESHORTENING: f32 = 4.0 / 7.0;

/// How much branches and leaves move along the stem for each meter across it.
pub(super) const ROUNDNESS: f32 = 0.5;

/// Updates of the fixed point.
const UPDATES: usize = 3;

/// Two directions along which phases differ.
const FIRST_WAVE: Vec2 = Vec2::new(0.8, 0.6);
const SECOND_WAVE: Vec2 = Vec2::new(-0.6, 0.8);

/// Phase of the second wave in units of the first one's.
pub(super) const SECOND_SEED: f32 = 2.4;

/// One of a plant's motions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct SwayMode {
    /// Complex way of the tip, meters (x, y); phase per meter to the right and up (z, w), radians.
    pub motion: Vec4,
    /// Phase noise: amplitude of each of its two waves, radians; their wave number, radians per meter; their phase,
    /// radians; unused.
    pub noise: Vec4,
}

/// A plant at one moment: 8 rows of four numbers, laid out as WGSL has them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct SwayRecord {
    /// Root (a, b), meters; unit vector from root to tip.
    pub stem: Vec4,
    /// Length, meters; half the crown's width, meters; 1 if the plant moves, 0 if it is still; unused.
    pub size: Vec4,
    /// The bending of the whole: a cantilever.
    pub bending: SwayMode,
    /// The motion of its branches, which grows away from root and stem.
    pub branches: SwayMode,
    /// The motion of its leaves, likewise.
    pub leaves: SwayMode,
}

impl SwayRecord {
    /// The record's rows, in WGSL's order.
    #[must_use]
    pub fn rows(&self) -> [Vec4; 8] {
        let [bending, branches, leaves] = [self.bending, self.branches, self.leaves];
        [
            self.stem,
            self.size,
            bending.motion,
            bending.noise,
            branches.motion,
            branches.noise,
            leaves.motion,
            leaves.noise,
        ]
    }

    /// How far the point that rests at `rest` (a, b) is moved, meters.
    #[must_use]
    pub fn displacement(&self, rest: Vec2) -> Vec2 {
        let from_root = rest - self.stem.truncate().truncate();
        let axis = Vec2::new(self.stem.z, self.stem.w);
        let side = Vec2::new(axis.y, -axis.x);
        let q = (from_root.dot(axis) / self.size.x).clamp(0.0, 1.0);
        let off = from_root.dot(side);

        // A uniformly loaded cantilever (notes §6.1).
        let bend = q * q * (q * q - 4.0 * q + 6.0) / 3.0;
        let crown = q * q * (1.0 + 0.5 * off * off / (off * off + self.size.y * self.size.y));

        let bent = bend * mode_motion(&self.bending, from_root).x;
        let swung = crown * (mode_motion(&self.branches, from_root) + mode_motion(&self.leaves, from_root));
        side * (bent + swung.x) + axis * (ROUNDNESS * swung.y - FORESHORTENING * bent * bent / self.size.x)
    }

    /// The rest point (a, b) of what is seen at `moved`: the point whose displacement leads there.
    #[must_use]
    pub fn rest_point(&self, moved: Vec2) -> Vec2 {
        if self.size.z == 0.0 {
            return moved;
        }
        let mut rest = moved;
        for _ in 0..UPDATES {
            rest = moved - self.displacement(rest);
        }
        rest
    }
}

/// A mode's complex way at a place, meters, for a mode shape of 1.
pub(super) fn mode_motion(mode: &SwayMode, from_root: Vec2) -> Vec2 {
    let motion = mode.motion;
    let noise = mode.noise;
    let phase = motion.z * from_root.x
        + motion.w * from_root.y
        + noise.x
            * ((noise.y * from_root.dot(FIRST_WAVE) + noise.z).sin()
                + (noise.y * from_root.dot(SECOND_WAVE) + SECOND_SEED * noise.z).sin());
    let (sin, cos) = phase.sin_cos();
    Vec2::new(motion.x * cos + motion.y * sin, motion.y * cos - motion.x * sin)
}
