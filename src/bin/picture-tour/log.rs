//! What a window writes to the terminal: what concerns the tour. `RUST_LOG=info` tells all.

use bevy::log::LogPlugin;
use bevy::prelude::default;

/// Bevy's log without what nobody can do anything about: every machine has its own list of adapters and missing settings. That
/// there is no graphics card but software is told.
pub(crate) fn of_the_tour() -> LogPlugin {
    let filter = "error,bevy_render::renderer=warn,bevy_picture_tour=info,picture_tour=info".to_owned();
    LogPlugin { filter, ..default() }
}
