//! Height fields as other programs write them: gray pictures of 16 bits, and OpenEXR.
//!
//! Unlike [`decode_picture`](super::decode_picture), codes are taken as they stand: no profile, no gamma.

use std::io::Cursor;
use std::ops::RangeInclusive;

use exr::error::Error as ExrError;
use exr::meta::MetaData;
use exr::prelude::{ReadChannels, ReadLayers};
use glam::UVec2;

use super::PictureError;
use super::decode::{gray16, load};
use super::format::read_header;

/// What an OpenEXR file begins with.
const EXR_MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// The most channels that are unpacked to find the one with heights.
const MOST_CHANNELS: usize = 16;

/// How finely a file tells heights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeightSamples {
    /// 256 steps.
    Eight,
    /// 65 536 steps.
    Sixteen,
    /// Floating-point numbers.
    Float,
}

/// A height field.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightField {
    /// Width and height in pixels.
    pub size: UVec2,
    /// In rows from the top. Of gray pictures −0.5 (black) to 0.5 (white), exactly between them 0; of OpenEXR the numbers of
    /// the file.
    pub values: Vec<f32>,
    /// How finely they are told.
    pub samples: HeightSamples,
}

/// Decodes a height field from OpenEXR (its channel `Y`, else `R`, or the only one) or from what
/// [`decode_picture`](super::decode_picture) reads, told apart by content; of colors the luma is taken. `sides` bounds both
/// sides, in pixels. `name` stands in messages.
///
/// # Errors
///
/// As [`decode_picture`](super::decode_picture), and
/// - [`PictureError::SideRange`] for sides out of bounds, before decoding where the header tells them,
/// - [`PictureError::UnknownKind`] for an OpenEXR file that does not say which channel has the heights,
/// - [`PictureError::Damaged`] for numbers that are not finite.
pub fn decode_heights(
    bytes: &[u8],
    name: &str,
    sides: RangeInclusive<u32>,
) -> Result<HeightField, PictureError> {
    let check = |size: UVec2| {
        if sides.contains(&size.x) && sides.contains(&size.y) {
            return Ok(());
        }
        let (least, most) = (*sides.start(), *sides.end());
        Err(PictureError::SideRange { name: name.to_owned(), size, least, most })
    };
    if bytes.starts_with(&EXR_MAGIC) {
        return decode_exr(bytes, name, &check);
    }
    if let Some(size) = read_header(bytes).ok().and_then(|header| header.size) {
        check(size)?;
    }
    let image = load(bytes, name)?.image;
    let size = UVec2::new(image.width(), image.height());
    check(size)?;
    let samples = match image.color().bytes_per_pixel() / image.color().channel_count() {
        1 => HeightSamples::Eight,
        _ => HeightSamples::Sixteen,
    };
    let values = gray16(&image).into_iter().map(|code| (f32::from(code) - 32_767.5) / 65_535.0).collect();
    Ok(HeightField { size, values, samples })
}

fn decode_exr(
    bytes: &[u8],
    name: &str,
    check: &dyn Fn(UVec2) -> Result<(), PictureError>,
) -> Result<HeightField, PictureError> {
    let damaged =
        |reason: String| PictureError::Damaged { name: name.to_owned(), format: "OpenEXR file", reason };
    let fail = |error: ExrError| match error {
        ExrError::NotSupported(what) => PictureError::UnknownKind {
            name: name.to_owned(),
            found: format!("an OpenEXR file of a rare kind ({what})"),
            advice: "save one layer of plain pixels, uncompressed or with ZIP",
        },
        error => damaged(error.to_string()),
    };
    // Limits first: what follows takes as much memory as the header says.
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(fail)?;
    for header in &meta.headers {
        check(pixels(header.layer_size))?;
        if header.channels.list.len() > MOST_CHANNELS {
            return Err(which_channel(name, header.channels.list.len()));
        }
    }
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(fail)?;
    let layer = image.layer_data;
    let size = pixels(layer.size);
    let channels = layer.channel_data.list;
    let named = |wanted: &str| channels.iter().find(|channel| channel.name.eq(wanted));
    let only = if let [only] = channels.as_slice() { Some(only) } else { None };
    let found = only.or_else(|| named("Y")).or_else(|| named("R"));
    let samples = &found.ok_or_else(|| which_channel(name, channels.len()))?.sample_data;
    let values: Vec<f32> = samples.values_as_f32().collect();
    if values.len() != size.x as usize * size.y as usize {
        return Err(damaged("its channel has another size than its layer".to_owned()));
    }
    if let Some(index) = values.iter().position(|value| !value.is_finite()) {
        let (column, row) = (index % size.x as usize, index / size.x as usize);
        return Err(damaged(format!("the pixel in column {column}, row {row} is {}", values[index])));
    }
    Ok(HeightField { size, values, samples: HeightSamples::Float })
}

fn which_channel(name: &str, count: usize) -> PictureError {
    PictureError::UnknownKind {
        name: name.to_owned(),
        found: format!("an OpenEXR file with {count} channels"),
        advice: "save one channel with the heights, or name it Y",
    }
}

fn pixels(size: exr::math::Vec2<usize>) -> UVec2 {
    let side = |side: usize| u32::try_from(side).unwrap_or(u32::MAX);
    UVec2::new(side(size.0), side(size.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{PngPixels, encode_png};

    const SIDES: RangeInclusive<u32> = 2..=8;

    /// Little-endian OpenEXR of these channels, written by the library that reads it.
    fn exr_of(names: &[&str], size: [usize; 2], value: impl Fn(usize) -> f32) -> Vec<u8> {
        use exr::prelude::*;
        let samples = FlatSamples::F32((0..size[0] * size[1]).map(value).collect());
        let channels = names.iter().map(|name| AnyChannel::new(*name, samples.clone()));
        let layer = Layer::new(
            (size[0], size[1]),
            LayerAttributes::named("water"),
            Encoding::SMALL_LOSSLESS,
            AnyChannels::sort(channels.collect()),
        );
        let mut bytes = Cursor::new(Vec::new());
        Image::from_layer(layer).write().to_buffered(&mut bytes).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn gray_levels_are_shares_of_the_height() {
        let codes: Vec<u8> = [0_u8, 64, 128, 255].into();
        let png = encode_png(UVec2::new(2, 2), PngPixels::Gray(&codes)).unwrap();
        let field = decode_heights(&png, "a", SIDES).unwrap();
        assert_eq!((field.size, field.samples), (UVec2::new(2, 2), HeightSamples::Eight));
        for (value, code) in field.values.iter().zip(codes) {
            assert!((value - (f32::from(code) / 255.0 - 0.5)).abs() < 1e-6, "{value} for {code}");
        }
    }

    #[test]
    fn numbers_of_openexr_come_as_they_are() {
        for names in [&["Y"][..], &["height"], &["A", "B", "R"]] {
            let bytes = exr_of(names, [3, 2], |i| i as f32 - 2.25);
            let field = decode_heights(&bytes, "a.exr", SIDES).unwrap();
            assert_eq!((field.size, field.samples), (UVec2::new(3, 2), HeightSamples::Float));
            assert_eq!(field.values, [-2.25, -1.25, -0.25, 0.75, 1.75, 2.75], "{names:?}");
        }
    }

    #[test]
    fn what_cannot_be_read_is_refused_by_name() {
        let good = exr_of(&["Y"], [3, 2], |i| i as f32);
        let said = |bytes: &[u8]| decode_heights(bytes, "a.exr", SIDES).unwrap_err().to_string();
        let cases = [
            (exr_of(&["A", "B"], [3, 2], |_| 0.0), "name it Y"),
            (exr_of(&["Y"], [9, 2], |_| 0.0), "2 to 8"),
            (exr_of(&["Y"], [3, 2], |_| f32::NAN), "NaN"),
            (good[..good.len() - 4].to_vec(), "damaged"),
            (good[..20].to_vec(), "damaged"),
            (encode_png(UVec2::new(1, 2), PngPixels::Gray(&[0; 2])).unwrap(), "2 to 8"),
            (b"8BPS".to_vec(), "Photoshop"),
        ];
        for (bytes, word) in cases {
            let said = said(&bytes);
            assert!(said.starts_with("a.exr is ") && said.contains(word), "{word:?} is not in: {said}");
        }
    }
}
