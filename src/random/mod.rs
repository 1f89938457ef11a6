//! Seeded numbers (splitmix64), the same on every platform.
//!
//! They depend on what is asked for, not on who asks first: every purpose has its own stream, so threads cannot disturb
//! each other's draws.

use std::f64::consts::TAU;

/// A stream of numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Random(u64);

impl Random {
    /// The stream of one purpose of a seed: a number of its own, or a cell's index.
    pub(crate) fn new(seed: u64, purpose: u64) -> Self {
        let mut stream = Self(seed ^ purpose.wrapping_mul(0xD6E8_FEB8_6659_FD93));
        stream.next();
        stream
    }

    /// The next 64 bits.
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^ (bits >> 31)
    }

    /// A number from 0 to below `limit`, which is above zero and below 2³².
    pub(crate) fn below(&mut self, limit: usize) -> usize {
        (((self.next() >> 32) * limit as u64) >> 32) as usize
    }

    /// An angle from 0 to below 2π.
    pub(crate) fn angle(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64 * TAU
    }
}
