//! Everything that moves, at one moment: plants, clouds, water and what floats on it, behind one clock of fixed steps.
//!
//! [`Simulation`] is a function of the tour, of the number of steps, and of what was done between them (touches, changes
//! of the wind): never of a clock or a thread. Its [`Moment`] says where everything is that the tour's components show.
//! Without wind, courses, a drift of the clouds and touches all rests exactly, to the bit.
//!
//! Tour space: meters, x right, y up, −z into the picture; resting water is y = 0, and a point of it is (x, z).

mod jump;
mod looped;
mod movers;
mod near_water;
mod recordings;
mod roles;
mod shore;
mod simulation;
mod stand;
#[cfg(test)]
mod tests;
mod vessel;

pub use jump::{BLOCK_STEPS, MEMORY_STEPS};
pub use looped::{LONGEST_LOOP, LoopError, SHORTEST_LOOP};
pub use recordings::{Recordings, RecordingsReader};
pub use simulation::Simulation;

use crate::scene::Placement;
use crate::wind::CloudCopy;
use crate::wind::SwayRecord;

/// Seconds of one step.
pub const STEP_SECONDS: f64 = 1.0 / 60.0;

/// Everything that moves, at one moment. Lists have one entry a component of the scene, in the scene's order.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Time from the tour's start.
    pub seconds: f64,
    /// How plants are bent, in meters (along, up) of their resting wall: what [`Wall::point`](crate::scene::Wall::point)
    /// takes. Still records for what does not sway.
    pub sways: Vec<SwayRecord>,
    /// Where a wall that floats or sails is now; `None` for what rests, where it rests.
    pub placements: Vec<Option<Placement>>,
    /// Share of the mirrored copy in what a wall shows, 0 to 1: of a body that comes back on its course. A point `s` along
    /// shows in the copy what rests at `−s`. 0 for all else.
    pub mirrored: Vec<f32>,
    /// The two copies of the sky; their weights sum to 1. They move what is infinitely far.
    pub clouds: [CloudCopy; 2],
}

impl Moment {
    /// The picture as it was taken, of so many components.
    fn still(components: usize) -> Self {
        Self {
            seconds: 0.0,
            sways: vec![SwayRecord::default(); components],
            placements: vec![None; components],
            mirrored: vec![0.0; components],
            clouds: CloudCopy::STILL,
        }
    }

    /// Puts a component back to where it rests.
    fn rest(&mut self, component: usize) {
        self.sways[component] = SwayRecord::default();
        self.placements[component] = None;
        self.mirrored[component] = 0.0;
    }
}

/// What can ever move in a component, or in what the water mirrors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Moves {
    /// A plant sways.
    pub sways: bool,
    /// A body comes back on its way, as its mirrored copy.
    pub returns: bool,
    /// Clouds drift.
    pub drifts: bool,
}

impl Moves {
    /// What can move in one or the other.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            sways: self.sways || other.sways,
            returns: self.returns || other.returns,
            drifts: self.drifts || other.drifts,
        }
    }
}
