//! What can go wrong with picture and mask files. Each message names the file, what is wrong and what to do.

use std::path::PathBuf;

use glam::UVec2;

use super::decode::{MAX_PIXELS, MAX_SIDE};

/// A picture or mask that cannot be used, or could not be written.
///
/// `name` is whatever the caller called the file, most often its path.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The bytes are no picture, or of a format that is not read.
    #[error("{name} is {found}, which cannot be read here; save it as PNG, JPEG, TIFF or WebP")]
    UnknownFormat {
        /// The file.
        name: String,
        /// What the bytes look like, with an article: "a GIF".
        found: &'static str,
    },
    /// The format is known, but not this kind of it.
    #[error("{name} is {found}, which cannot be read here; {advice}")]
    UnknownKind {
        /// The file.
        name: String,
        /// What it is, with an article: "a CMYK JPEG".
        found: String,
        /// What to do, as an imperative.
        advice: &'static str,
    },
    /// The file ends too early or contradicts itself.
    #[error(
        "{name} is a damaged {format} ({reason}); copy it again from its source, or open it elsewhere and save it anew"
    )]
    Damaged {
        /// The file.
        name: String,
        /// The format its first bytes promise.
        format: &'static str,
        /// What the decoder said.
        reason: String,
    },
    /// A side is 0 pixels long.
    #[error("{name} is {} x {} pixels, so there is nothing in it; save the picture again", size.x, size.y)]
    Empty {
        /// The file.
        name: String,
        /// Width and height, in pixels.
        size: UVec2,
    },
    /// More pixels than are decoded. Told before any memory is taken.
    #[error(
        "{name} is {} x {} pixels; at most {MAX_SIDE} on a side and {} million in all are read: scale it down",
        size.x, size.y, MAX_PIXELS / 1_000_000
    )]
    TooLarge {
        /// The file.
        name: String,
        /// Width and height, in pixels.
        size: UVec2,
    },
    /// A height field with a side out of bounds.
    #[error(
        "{name} is {} x {} pixels; write height fields of {least} to {most} pixels a side", size.x, size.y
    )]
    SideRange {
        /// The file.
        name: String,
        /// Width and height, in pixels.
        size: UVec2,
        /// The shortest side, in pixels.
        least: u32,
        /// The longest side, in pixels.
        most: u32,
    },
    /// A mask of another shape than its picture.
    #[error(
        "mask {name} is {} x {} pixels, but its picture is {} x {}; make the mask as large as the picture, or scale \
         both sides alike",
        found.x, found.y, expected.x, expected.y
    )]
    MaskSize {
        /// The mask's file.
        name: String,
        /// The mask's size, in pixels, turned as its orientation says.
        found: UVec2,
        /// The picture's size, in pixels.
        expected: UVec2,
    },
    /// Pixels were handed over that do not fill the size that came with them.
    #[error("{} x {} pixels were announced, but {count} were given; give one value a pixel, none for no picture", size.x, size.y)]
    WrongCount {
        /// Width and height, in pixels.
        size: UVec2,
        /// How many values came.
        count: usize,
    },
    /// A file could not be written. What stood there before is untouched.
    #[error("{} could not be written ({source}); check that its folder exists, may be written to and has room", path.display())]
    Write {
        /// Where it should have gone.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}
