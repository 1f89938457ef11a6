//! Whatever needs a set-up: the whole road on scenes whose answers are known, the plugin in an app, files on disk.
//!
//! Tests read only what is in this repository. Those that render need a graphics adapter, a software one will do; see
//! `support::adapter`.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

mod bad_input;
mod bands;
mod gpu_matches_trace;
mod guest;
mod layers;
mod plugin;
mod program;
mod recover_scene;
mod rippled_picture;
mod tour_assets;
mod tour_files;
