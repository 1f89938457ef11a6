//! What a depth map says of everything else: objects against their feet, reflection pairs for the solver, the water's
//! edge.

mod object;
mod pairs;
mod waterline;

pub use object::{Agreement, ObjectDepth, object_depth};
pub use pairs::{DepthPair, pairs};
pub use waterline::{Waterline, waterline};

/// Median of values; `None` of none. Reorders them.
fn median(values: &mut [f64]) -> Option<f64> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}
