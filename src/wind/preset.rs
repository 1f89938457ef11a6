//! What a kind of plant is like: natural frequencies, damping, amplitude and how they differ over the plant.
//!
//! Numbers are those of notes §6.2, tuned by eye; a tour file may write others.

use crate::tour::SwayKind;

/// One of a plant's motions: the bending of the whole, that of its branches, or that of its leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ModePreset {
    /// Natural frequency in units of the plant's.
    pub frequency: f64,
    /// Damping ratio in units of the plant's.
    pub damping: f64,
    /// Share of the amplitude; shares count by their squares.
    pub share: f64,
    /// Root mean square by which the phase differs between places, radians.
    pub disorder: f64,
    /// Size over which places move alike, in plant lengths.
    pub cell: f64,
    /// Lag of the tip behind the root, radians.
    pub lag: f64,
    /// Steepest displacement that the mode is held to, meters per meter. A plant's modes share 0.385:
    /// with what bending shortens, 0.4.
    pub steepest: f64,
}

/// A kind of plant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Preset {
    /// Natural frequency of the bending, hertz.
    pub frequency_hz: f64,
    /// Its damping ratio.
    pub damping: f64,
    /// Root mean square of the tip's way as a fraction of the length, at 5 m/s.
    pub amplitude: f64,
    /// Bending, branches, leaves.
    pub(super) modes: [ModePreset; 3],
}

/// A mode that a kind has not.
const NONE: ModePreset = ModePreset {
    frequency: 1.0,
    damping: 1.0,
    share: 0.0,
    disorder: 0.0,
    cell: 1.0,
    lag: 0.0,
    steepest: 0.0,
};

/// The preset of a kind.
pub(crate) fn preset(kind: SwayKind) -> Preset {
    match kind {
        SwayKind::Trunk => Preset {
            frequency_hz: 0.3,
            damping: 0.1,
            amplitude: 0.004,
            modes: [
                ModePreset { share: 0.85, steepest: 0.19, ..NONE },
                ModePreset {
                    frequency: 2.5,
                    damping: 0.8,
                    share: 0.45,
                    disorder: 0.8,
                    cell: 0.3,
                    lag: 0.5,
                    steepest: 0.11,
                },
                ModePreset {
                    frequency: 8.0,
                    damping: 1.3,
                    share: 0.27,
                    disorder: 0.8,
                    cell: 0.25,
                    lag: 0.5,
                    steepest: 0.085,
                },
            ],
        },
        SwayKind::Branch => Preset {
            frequency_hz: 0.8,
            damping: 0.08,
            amplitude: 0.01,
            modes: [
                ModePreset { share: 0.9, lag: 0.2, steepest: 0.2, ..NONE },
                ModePreset {
                    frequency: 1.8,
                    damping: 1.0,
                    share: 0.35,
                    disorder: 0.6,
                    cell: 0.3,
                    lag: 0.5,
                    steepest: 0.1,
                },
                ModePreset {
                    frequency: 3.5,
                    damping: 1.5,
                    share: 0.2,
                    disorder: 0.6,
                    cell: 0.2,
                    lag: 0.5,
                    steepest: 0.085,
                },
            ],
        },
        SwayKind::Reed => Preset {
            frequency_hz: 1.2,
            damping: 0.12,
            amplitude: 0.03,
            modes: [
                ModePreset { share: 1.0, disorder: 0.15, cell: 0.3, lag: 0.2, steepest: 0.335, ..NONE },
                ModePreset {
                    frequency: 2.5,
                    damping: 1.2,
                    share: 0.05,
                    disorder: 0.5,
                    cell: 0.2,
                    lag: 0.5,
                    steepest: 0.05,
                },
                NONE,
            ],
        },
        SwayKind::Grass => Preset {
            frequency_hz: 2.0,
            damping: 0.15,
            amplitude: 0.03,
            modes: [
                ModePreset { share: 1.0, disorder: 0.15, cell: 0.3, lag: 0.2, steepest: 0.385, ..NONE },
                NONE,
                NONE,
            ],
        },
    }
}
