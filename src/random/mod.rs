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

    /// A number from 0 to below 1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// An angle from 0 to below 2π.
    pub(crate) fn angle(&mut self) -> f64 {
        self.unit() * TAU
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_purpose_of_a_seed_has_its_own_stream_and_always_the_same() {
        let draw = |seed, purpose| {
            let mut stream = Random::new(seed, purpose);
            [stream.next(), stream.next(), stream.next()]
        };
        assert_eq!(draw(3, 5), draw(3, 5));
        assert_ne!(draw(3, 5), draw(3, 6));
        assert_ne!(draw(3, 5), draw(4, 5));
    }

    #[test]
    fn numbers_are_even_and_stay_below_their_limits() {
        let mut stream = Random::new(1, 2);
        let (mut counts, mut sum) = ([0_u32; 7], 0.0);
        for _ in 0..70_000 {
            counts[stream.below(7)] += 1;
            let unit = stream.unit();
            assert!((0.0..1.0).contains(&unit));
            assert!((0.0..TAU).contains(&stream.angle()));
            sum += unit;
        }
        // Four standard deviations of 10 000 in 70 000 draws, and of a mean of as many.
        assert!(counts.iter().all(|count| count.abs_diff(10_000) < 370), "{counts:?}");
        assert!((sum / 70_000.0 - 0.5).abs() < 0.0044, "{sum}");
    }
}
