//! From the bytes of a file to a [`Picture`] or a [`Mask`]: the one decoder of program, asset loader and tests.
//!
//! Limits are checked on the header, before memory is taken. Whatever cannot be read is refused by name.

use std::io::Cursor;

use glam::UVec2;
use image::metadata::Orientation;
use image::{
    ColorType, DynamicImage, ExtendedColorType, ImageBuffer, ImageDecoder, ImageError, ImageReader, Limits,
    Pixel,
};
use rayon::prelude::*;

use super::format::{Header, format_name, read_header};
use super::lens::read_lens;
use super::profile::{Rgba16, ToSrgb, code8};
use super::{Lens, Mask, Picture, PictureError};

/// The longest side that is decoded, in pixels.
pub const MAX_SIDE: u32 = 30_000;

/// The most pixels that are decoded.
pub const MAX_PIXELS: u64 = 200_000_000;

/// A picture and what its file says besides.
#[derive(Clone, Debug)]
pub struct DecodedPicture {
    /// The pixels, upright and in sRGB.
    pub picture: Picture,
    /// The lens, where the file's EXIF tells it.
    pub lens: Option<Lens>,
    /// What the maker of the picture may want to know, one sentence each, beginning with the file's name.
    pub notes: Vec<String>,
}

/// Decodes a PNG, JPEG, TIFF or WebP of 8 or 16 bits, told apart by content.
///
/// The picture is turned upright as its orientation says and converted to sRGB as its embedded profile says; without
/// one, or with a broken one (see [`DecodedPicture::notes`]), its codes are taken as sRGB. Where it is transparent it
/// is laid over white, as a viewer shows it. Of an animation the first frame is read. `name` stands in messages.
///
/// # Errors
///
/// - [`PictureError::UnknownFormat`] for other formats and for files that are no pictures,
/// - [`PictureError::UnknownKind`] for CMYK, floating-point samples and rare kinds of TIFF,
/// - [`PictureError::Damaged`] for truncated and contradictory files,
/// - [`PictureError::Empty`] and [`PictureError::TooLarge`] for sizes out of bounds, before decoding.
pub fn decode_picture(bytes: &[u8], name: &str) -> Result<DecodedPicture, PictureError> {
    let Loaded { image, icc, stored_size } = load(bytes, name)?;
    let mut notes = Vec::new();
    let is_gray = !image.color().has_color();
    let to_srgb = icc.and_then(|icc| icc.map_or(Ok(None), |icc| ToSrgb::new(&icc, is_gray)));
    let to_srgb = to_srgb.unwrap_or_else(|reason| {
        notes.push(format!(
            "{name}: its color profile cannot be used ({reason}); its colors are taken as sRGB"
        ));
        None
    });
    let size = size_of(&image);
    let pixels = match (&image, &to_srgb) {
        (DynamicImage::ImageRgb8(pixels), None) => pixels.as_raw().as_chunks().0.to_vec(),
        _ => map_rows(&image, |row| {
            if let Some(to_srgb) = &to_srgb {
                to_srgb.convert(row)?;
            }
            Ok(row.iter().copied().map(over_white).collect())
        })
        .map_err(|reason: String| damaged(name, read_header(bytes).ok(), reason))?,
    };
    Ok(DecodedPicture { picture: Picture::new(size, pixels)?, lens: read_lens(bytes, stored_size), notes })
}

/// Decodes a mask for a picture of `expected` pixels, from the same formats as [`decode_picture`].
///
/// Coverage is the file's alpha where that varies, else its gray level (of colors, the luma): codes as they stand,
/// without profile or gamma. A mask of the picture's proportions, within a pixel of the smaller of the two, is scaled.
///
/// # Errors
///
/// As [`decode_picture`], and [`PictureError::MaskSize`] for a mask of other proportions.
pub fn decode_mask(bytes: &[u8], name: &str, expected: UVec2) -> Result<Mask, PictureError> {
    let image = load(bytes, name)?.image;
    let size = size_of(&image);
    if !is_same_shape(size, expected) {
        return Err(PictureError::MaskSize { name: name.to_owned(), found: size, expected });
    }
    let luma_and_alpha =
        map_rows(&image, |row| Ok(row.iter().map(|pixel| [luma(*pixel), code8(pixel[3])]).collect()))
            .map_err(|reason: String| damaged(name, read_header(bytes).ok(), reason))?;
    let alpha_varies = luma_and_alpha.iter().any(|value| value[1] != luma_and_alpha[0][1]);
    let coverage = luma_and_alpha.iter().map(|value| value[usize::from(alpha_varies)]).collect();
    Ok(Mask::new(size, coverage)?.resized_to(expected))
}

/// A file's pixels, upright but in its own colors.
pub(super) struct Loaded {
    pub(super) image: DynamicImage,
    /// The embedded profile, or why it cannot be had.
    icc: Result<Option<Vec<u8>>, String>,
    /// The size before turning.
    stored_size: UVec2,
}

pub(super) fn load(bytes: &[u8], name: &str) -> Result<Loaded, PictureError> {
    let header =
        read_header(bytes).map_err(|found| PictureError::UnknownFormat { name: name.to_owned(), found })?;
    let fail = |error| refuse(name, header, &error);
    if let Some(size) = header.size {
        check_size(size, name)?;
    }
    if header.is_cmyk {
        return Err(unknown_kind(name, header, "CMYK", "convert it to RGB"));
    }
    if header.is_cut_off {
        return Err(damaged(name, Some(header), "it ends before its pixels do".to_owned()));
    }

    let mut limits = Limits::no_limits();
    // Eight bytes a pixel at most, and room for whatever else stands in the file.
    let pixels = header.size.map_or(MAX_PIXELS, pixel_count);
    limits.max_alloc = Some(8 * pixels + (64 << 20));
    let mut reader = ImageReader::with_format(Cursor::new(bytes), header.format);
    reader.limits(limits);
    let mut decoder = reader.into_decoder().map_err(fail)?;

    let stored_size = UVec2::from(decoder.dimensions());
    check_size(stored_size, name)?;
    if matches!(decoder.original_color_type(), ExtendedColorType::Cmyk8 | ExtendedColorType::Cmyk16) {
        return Err(unknown_kind(name, header, "CMYK", "convert it to RGB"));
    }
    if matches!(decoder.color_type(), ColorType::Rgb32F | ColorType::Rgba32F) {
        return Err(unknown_kind(name, header, "floating-point", "save it with 8 or 16 bits a channel"));
    }
    let icc = decoder.icc_profile().map_err(|error| error.to_string());
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    let mut image = DynamicImage::from_decoder(decoder).map_err(fail)?;
    image.apply_orientation(orientation);
    Ok(Loaded { image, icc, stored_size })
}

fn check_size(size: UVec2, name: &str) -> Result<(), PictureError> {
    let name = || name.to_owned();
    if size.min_element() == 0 {
        Err(PictureError::Empty { name: name(), size })
    } else if size.max_element() > MAX_SIDE || pixel_count(size) > MAX_PIXELS {
        Err(PictureError::TooLarge { name: name(), size })
    } else {
        Ok(())
    }
}

fn pixel_count(size: UVec2) -> u64 {
    u64::from(size.x) * u64::from(size.y)
}

fn size_of(image: &DynamicImage) -> UVec2 {
    UVec2::new(image.width(), image.height())
}

/// Whether one size is the other scaled, give or take one pixel of the smaller one, on either side.
fn is_same_shape(a: UVec2, b: UVec2) -> bool {
    let difference = (u64::from(a.x) * u64::from(b.y)).abs_diff(u64::from(a.y) * u64::from(b.x));
    difference <= u64::from(a.max(b).min_element())
}

fn unknown_kind(name: &str, header: Header, kind: &str, advice: &'static str) -> PictureError {
    PictureError::UnknownKind {
        name: name.to_owned(),
        found: format!("a {kind} {}", format_name(header.format)),
        advice,
    }
}

fn damaged(name: &str, header: Option<Header>, reason: String) -> PictureError {
    let format = header.map_or("picture", |header| format_name(header.format));
    PictureError::Damaged { name: name.to_owned(), format, reason }
}

fn refuse(name: &str, header: Header, error: &ImageError) -> PictureError {
    // The decoders' own words; the wrapper only repeats the format.
    let source = std::error::Error::source(error).map_or_else(|| error.to_string(), ToString::to_string);
    match error {
        ImageError::Unsupported(_) => PictureError::UnknownKind {
            name: name.to_owned(),
            found: format!("a {} of a rare kind ({error})", format_name(header.format)),
            advice: "save it as PNG, or as RGB with 8 bits a channel",
        },
        _ => damaged(name, Some(header), source),
    }
}

/// Maps an image row by row, on all cores, whatever its samples are.
fn map_rows<T: Send>(
    image: &DynamicImage,
    map: impl Fn(&mut [Rgba16]) -> Result<Vec<T>, String> + Sync,
) -> Result<Vec<T>, String> {
    let rows = (0..image.height()).into_par_iter().map(|y| map(&mut row16(image, y)));
    let rows: Vec<Vec<T>> = rows.collect::<Result<_, _>>()?;
    Ok(rows.into_iter().flatten().collect())
}

fn row16(image: &DynamicImage, y: u32) -> Vec<Rgba16> {
    fn row<P: Pixel>(
        image: &ImageBuffer<P, Vec<P::Subpixel>>,
        y: u32,
        wide: fn(P::Subpixel) -> u16,
    ) -> Vec<Rgba16> {
        (0..image.width()).map(|x| image.get_pixel(x, y).to_rgba().0.map(wide)).collect()
    }
    // 257 takes 255 to 65535, so 8-bit codes come back as they were.
    let from8 = |code: u8| u16::from(code) * 257;
    match image {
        DynamicImage::ImageLuma8(image) => row(image, y, from8),
        DynamicImage::ImageLumaA8(image) => row(image, y, from8),
        DynamicImage::ImageRgb8(image) => row(image, y, from8),
        DynamicImage::ImageRgba8(image) => row(image, y, from8),
        DynamicImage::ImageLuma16(image) => row(image, y, |code| code),
        DynamicImage::ImageLumaA16(image) => row(image, y, |code| code),
        DynamicImage::ImageRgb16(image) => row(image, y, |code| code),
        DynamicImage::ImageRgba16(image) => row(image, y, |code| code),
        // Floating-point files were refused; `DynamicImage` may grow.
        other => row(&other.to_rgba16(), y, |code| code),
    }
}

/// Blends codes, not light: so do browsers and viewers, and what they show is what the picture's maker saw.
fn over_white([r, g, b, alpha]: Rgba16) -> [u8; 3] {
    const WHITE: u32 = 65_535;
    let alpha = u32::from(alpha);
    [r, g, b]
        .map(|code| code8(((u32::from(code) * alpha + WHITE * (WHITE - alpha) + WHITE / 2) / WHITE) as u16))
}

/// Rec. 709 luma of codes, as an 8-bit code.
fn luma(pixel: Rgba16) -> u8 {
    code8(luma16(pixel))
}

fn luma16([r, g, b, _]: Rgba16) -> u16 {
    ((u32::from(r) * 2126 + u32::from(g) * 7152 + u32::from(b) * 722 + 5000) / 10_000) as u16
}

/// An image's luma, as 16-bit codes in rows.
pub(super) fn gray16(image: &DynamicImage) -> Vec<u16> {
    (0..image.height()).flat_map(|y| row16(image, y)).map(luma16).collect()
}

#[cfg(test)]
#[path = "decode_tests.rs"]
mod tests;
