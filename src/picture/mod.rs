//! The one still picture: its pixels, its space, its masks, and the files that hold them.
//!
//! A [`Picture`] is 8-bit sRGB and never empty; [`decode_picture`] turns every file that can be read into one, so
//! nothing behind this module knows of formats, profiles, orientations or bit depths.

pub mod color;
mod decode;
mod distance;
mod encode;
mod error;
mod format;
mod heights;
mod lens;
mod mask;
mod profile;
mod raster;
mod scale;
mod space;

pub use decode::{DecodedPicture, MAX_PIXELS, MAX_SIDE, decode_mask, decode_picture};
pub(crate) use distance::distances;
pub(crate) use encode::folder_of;
pub use encode::{PngPixels, encode_png, save_png};
pub use error::PictureError;
pub use heights::{HeightField, HeightSamples, decode_heights};
pub use lens::Lens;
pub use mask::Mask;
pub use raster::{Picture, PixelRect};
pub use space::PicturePoint;
