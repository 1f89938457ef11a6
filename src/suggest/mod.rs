//! What the machine proposes from the picture alone, without learning: each proposal with an honest confidence and one
//! sentence of reason.
//!
//! [`find_reflection`] says whether and about which axis a picture mirrors; from that come pairs
//! ([`suggest_pairs`]), the horizon ([`suggest_horizon`]), regions ([`suggest_regions`]) and where one more pair
//! would help ([`advise`]). [`draft()`] makes a whole tour of them. Notes §2.

mod advice;
mod colors;
mod dimming;
mod draft;
mod gray;
mod guide;
mod horizon;
mod matching;
mod nadir;
pub mod outline;
mod pairs;
mod parts;
mod patches;
mod reflection;
mod regions;
mod spread;
mod symmetry;
#[cfg(test)]
mod tests;
mod thin;

pub use advice::{Advice, advise};
pub use draft::{Draft, DraftError, LEAST_SIDE, Part, Remark, draft};
pub use horizon::{SuggestedHorizon, suggest_horizon, usual_horizon};
pub use pairs::{MOST_PAIRS, SuggestedPair, SuggestedPairs, suggest_pairs};
pub use reflection::{NoReflection, Reflection, find_reflection};
pub use regions::{SuggestedRegion, SuggestedRegions, suggest_regions};
pub use symmetry::{MirrorAxis, MirrorTile};
