//! Outlines of objects with the machine's help: the person points, the pixels are found here.
//!
//! Everything is a function of picture, marks and earlier masks; the same input gives the same bits on any number of
//! cores. Points are picture points, masks have the picture's size. Nothing here is certain: each result is a
//! suggestion that can be mended with the [`Brush`] or taken over as a polygon that stays editable ([`polygon_of`]).

mod brush;
mod contact;
mod cost;
mod grabcut;
mod grid;
mod grow;
mod guided;
mod hints;
mod livewire;
mod max_flow;
mod mend;
mod mixture;
mod parts;
mod scaled;
mod search;
mod stroke;
mod trace;

pub use brush::{Brush, BrushMode};
pub use contact::{ContactLine, contact_line};
pub use grabcut::{Cutout, grab_cut};
pub use grow::{GrowOptions, grow};
pub use hints::{Bound, ObjectHints};
pub use livewire::LiveWire;
pub use stroke::{Side, Stroke};
pub use trace::{TracedOutline, outlines_of, polygon_of, simplified_line};

use glam::UVec2;

/// Why no outline was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// No mark says where the object is.
    #[error("no mark says where it is; draw a stroke on it, or a box around it")]
    NothingMarked,
    /// The marks lie on the other side of the line that the region does not cross.
    #[error("the mark lies on the other side of the horizon; draw on this side, or move the horizon")]
    BeyondBound,
    /// The marks leave one side without a pixel.
    #[error("nothing here differs from its surroundings; draw a stroke on the object and one beside it")]
    NothingStandsOut,
    /// The earlier mask is that of another picture.
    #[error("the mask is {} x {} pixels, the picture {} x {}; scale the mask to the picture", mask.x, mask.y, picture.x, picture.y)]
    WrongSize {
        /// Size of the mask, pixels.
        mask: UVec2,
        /// Size of the picture, pixels.
        picture: UVec2,
    },
    /// `progress` asked to stop.
    #[error("cancelled")]
    Cancelled,
}
