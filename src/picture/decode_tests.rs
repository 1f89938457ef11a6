//! Files as people have them and as they should not be, made here byte by byte.

use exif::{Tag, Value};
use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::codecs::tiff::TiffEncoder;
use image::codecs::webp::WebPEncoder;
use image::{ExtendedColorType, ImageEncoder};
use moxcms::ColorProfile;

use super::*;
use crate::picture::lens::tests::exif_bytes;

fn png(pixels: &[u8], size: (u32, u32), color: ExtendedColorType) -> Vec<u8> {
    png_with(pixels, size, color, None)
}

fn png_with(pixels: &[u8], size: (u32, u32), color: ExtendedColorType, icc: Option<Vec<u8>>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = PngEncoder::new(&mut bytes);
    if let Some(icc) = icc {
        encoder.set_icc_profile(icc).unwrap();
    }
    encoder.write_image(pixels, size.0, size.1, color).unwrap();
    bytes
}

fn pixels(bytes: &[u8]) -> Vec<[u8; 3]> {
    decode_picture(bytes, "test").unwrap().picture.pixels().to_vec()
}

fn error(bytes: &[u8], name: &str) -> String {
    decode_picture(bytes, name).unwrap_err().to_string()
}

/// Samples of 16 bits as the encoders want them.
fn native(samples: &[u16]) -> Vec<u8> {
    samples.iter().flat_map(|sample| sample.to_ne_bytes()).collect()
}

/// A chunk of a PNG file with its checksum.
fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let body = [kind.as_slice(), data].concat();
    let crc = body.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(
            crc ^ u32::from(*byte),
            |crc, _| {
                if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 }
            },
        )
    });
    [&(data.len() as u32).to_be_bytes(), body.as_slice(), &(!crc).to_be_bytes()].concat()
}

/// A PNG that says how large it is, and nothing more.
fn png_header(width: u32, height: u32) -> Vec<u8> {
    let data = [&width.to_be_bytes(), &height.to_be_bytes(), [8, 2, 0, 0, 0].as_slice()].concat();
    [b"\x89PNG\r\n\x1a\n".as_slice(), &chunk(b"IHDR", &data), &chunk(b"IEND", &[])].concat()
}

#[test]
fn every_depth_and_kind_of_png_is_read() {
    use ExtendedColorType::{L8, L16, La8, Rgb8, Rgb16, Rgba8};
    assert_eq!(pixels(&png(&[1, 2, 3, 4, 5, 6], (2, 1), Rgb8)), [[1, 2, 3], [4, 5, 6]]);
    assert_eq!(pixels(&png(&[7, 200], (1, 2), L8)), [[7; 3], [200; 3]]);
    // 128 · 257 + 128 is the last value nearer to code 128 than to 129.
    assert_eq!(pixels(&png(&native(&[33_024, 33_025, 65_535]), (3, 1), L16)), [[128; 3], [129; 3], [255; 3]]);
    assert_eq!(pixels(&png(&native(&[0, 257, 514]), (1, 1), Rgb16)), [[0, 1, 2]]);
    // Alpha: full, none, and a fifth.
    assert_eq!(pixels(&png(&[9, 8, 7, 255, 9, 8, 7, 0], (2, 1), Rgba8)), [[9, 8, 7], [255; 3]]);
    assert_eq!(pixels(&png(&[0, 51], (1, 1), La8)), [[204; 3]]);
}

#[test]
fn a_palette_is_looked_up() {
    let header = [&2_u32.to_be_bytes(), &1_u32.to_be_bytes(), [8, 3, 0, 0, 0].as_slice()].concat();
    // One row: filter 0, entries 1 and 0, in an uncompressed deflate block, then its Adler-32.
    let data = b"\x78\x01\x01\x03\x00\xfc\xff\x00\x01\x00\x00\x05\x00\x02";
    let chunks = [chunk(b"IHDR", &header), chunk(b"PLTE", &[10, 20, 30, 40, 50, 60]), chunk(b"IDAT", data)];
    let file = [b"\x89PNG\r\n\x1a\n".as_slice(), &chunks.concat(), &chunk(b"IEND", &[])].concat();
    assert_eq!(pixels(&file), [[40, 50, 60], [10, 20, 30]]);
}

#[test]
fn webp_and_tiff_are_read_whatever_they_are_called() {
    let rgb = [1, 2, 3, 4, 5, 6];
    let mut webp = Vec::new();
    WebPEncoder::new_lossless(&mut webp).write_image(&rgb, 2, 1, ExtendedColorType::Rgb8).unwrap();
    let mut tiff = Cursor::new(Vec::new());
    TiffEncoder::new(&mut tiff).write_image(&rgb, 2, 1, ExtendedColorType::Rgb8).unwrap();
    for bytes in [webp, tiff.into_inner()] {
        let decoded = decode_picture(&bytes, "really.jpg").unwrap();
        assert_eq!(decoded.picture.pixels(), [[1, 2, 3], [4, 5, 6]]);
        assert!(decode_picture(&bytes[..bytes.len() * 2 / 3], "cut").is_err());
    }
}

/// A JPEG of 32 x 16, black on the left, white on the right, that is to be turned.
fn turned_jpeg(orientation: u16) -> Vec<u8> {
    let codes: Vec<u8> = (0..16 * 32).map(|i| if i % 32 < 16 { 0 } else { 255 }).collect();
    let mut bytes = Vec::new();
    let mut encoder = JpegEncoder::new_with_quality(&mut bytes, 100);
    let fields = [
        (Tag::Orientation, Value::Short(vec![orientation])),
        (Tag::FocalLengthIn35mmFilm, Value::Short(vec![35])),
        (Tag::PixelXDimension, Value::Long(vec![3200])),
        (Tag::PixelYDimension, Value::Long(vec![1600])),
    ];
    encoder.set_exif_metadata(exif_bytes(&fields)).unwrap();
    encoder.write_image(&codes, 32, 16, ExtendedColorType::L8).unwrap();
    bytes
}

#[test]
fn a_jpeg_is_turned_upright_and_keeps_its_lens() {
    // Orientation 6: turn clockwise, so that left becomes top.
    let decoded = decode_picture(&turned_jpeg(6), "phone.jpg").unwrap();
    assert_eq!(decoded.picture.size(), UVec2::new(16, 32));
    assert!(decoded.picture.pixel(8, 2)[0] < 10, "{:?}", decoded.picture.pixel(8, 2));
    assert!(decoded.picture.pixel(8, 29)[0] > 245, "{:?}", decoded.picture.pixel(8, 29));
    assert_eq!(decoded.lens, Some(Lens { focal_35mm: 35.0, whole_frame: true }));

    let half_turn = decode_picture(&turned_jpeg(3), "phone.jpg").unwrap().picture;
    assert!(half_turn.pixel(2, 8)[0] > 245 && half_turn.pixel(29, 8)[0] < 10);
}

#[test]
fn a_truncated_jpeg_is_refused() {
    let bytes = turned_jpeg(1);
    let message = error(&bytes[..bytes.len() - 20], "half.jpg");
    assert!(message.starts_with("half.jpg is a damaged JPEG (it ends before its pixels do)"), "{message}");
}

#[test]
fn a_cmyk_jpeg_is_refused_by_name() {
    let mut bytes = b"\xff\xd8\xff\xc0\0\x14\x08\0\x03\0\x05\x04............".to_vec();
    bytes.extend(b"\xff\xd9");
    assert_eq!(
        error(&bytes, "print.jpg"),
        "print.jpg is a CMYK JPEG, which cannot be read here; convert it to RGB"
    );
}

#[test]
fn a_wide_gamut_png_becomes_srgb() {
    let p3 = ColorProfile::new_display_p3().encode().unwrap();
    let rgb = [255, 0, 0, 200, 120, 60, 128, 128, 128];
    let decoded =
        decode_picture(&png_with(&rgb, (3, 1), ExtendedColorType::Rgb8, Some(p3.clone())), "p3").unwrap();
    let found = decoded.picture.pixels();
    assert_eq!((found[0], found[2]), ([255, 0, 0], [128, 128, 128]));
    // By hand: linear (0.5776, 0.1878, 0.0452) becomes (0.6653, 0.1714, 0.0235).
    let near = found[1].iter().zip([213, 115, 42]).all(|(found, expected)| found.abs_diff(expected) <= 1);
    assert!(near, "{:?}", found[1]);

    let wide: Vec<u16> = rgb.iter().map(|code| u16::from(*code) * 257).collect();
    let deep = png_with(&native(&wide), (3, 1), ExtendedColorType::Rgb16, Some(p3));
    assert_eq!(pixels(&deep), found, "16 bits");
}

#[test]
fn a_broken_profile_is_reported_and_the_codes_kept() {
    let file = png_with(&[1, 2, 3], (1, 1), ExtendedColorType::Rgb8, Some(b"not a profile".to_vec()));
    let decoded = decode_picture(&file, "odd.png").unwrap();
    assert_eq!(decoded.picture.pixels(), [[1, 2, 3]]);
    assert!(decoded.notes[0].starts_with("odd.png: its color profile cannot be used"), "{:?}", decoded.notes);
}

#[test]
fn srgb_by_profile_keeps_every_code() {
    let gradient: Vec<u8> = (0..=255).flat_map(|code| [code, 255 - code, code / 2]).collect();
    let srgb = ColorProfile::new_srgb().encode().unwrap();
    let decoded =
        decode_picture(&png_with(&gradient, (256, 1), ExtendedColorType::Rgb8, Some(srgb)), "srgb").unwrap();
    assert_eq!(decoded.picture.pixels().as_flattened(), gradient);
    assert!(decoded.notes.is_empty());
}

#[test]
fn what_is_no_picture_is_named() {
    assert_eq!(
        error(b"Hello, I am a lake.\n", "lake.png"),
        "lake.png is a text file, which cannot be read here; save it as PNG, JPEG, TIFF or WebP"
    );
    assert!(error(b"", "lake.png").contains("an empty file"));
    assert!(error(b"GIF89a\x01\0\x01\0\0\0\0;", "lake.png").contains("a GIF"));
}

#[test]
fn a_truncated_png_is_refused() {
    let noise: Vec<u8> = (0..64 * 64 * 3_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let file = png(&noise, (64, 64), ExtendedColorType::Rgb8);
    for length in [20, 40, file.len() / 2, file.len() - 30] {
        let message = error(&file[..length], "half.png");
        assert!(message.starts_with("half.png is a damaged PNG ("), "{length} bytes: {message}");
    }
}

#[test]
fn sizes_out_of_bounds_are_refused_by_the_header() {
    let message = error(&png_header(60_000, 60_000), "huge.png");
    assert!(
        message.starts_with("huge.png is 60000 x 60000 pixels; at most 30000 on a side and 200 million"),
        "{message}"
    );
    assert!(matches!(decode_picture(&png_header(30_000, 6_667), ""), Err(PictureError::TooLarge { .. })));
    // Within bounds, so that what is missing shows first.
    assert!(matches!(decode_picture(&png_header(30_000, 6_666), ""), Err(PictureError::Damaged { .. })));
    assert!(matches!(decode_picture(&png_header(0, 5), ""), Err(PictureError::Empty { .. })));
    let no_lines = b"\xff\xd8\xff\xc0\0\x0b\x08\0\0\0\x05\x01...\xff\xd9";
    assert!(matches!(decode_picture(no_lines, ""), Err(PictureError::Empty { .. })));
}

/// A little-endian TIFF of 8-bit samples in one strip, of which nothing is there.
fn tiff_header(size: (u32, u32), photometric: u32, samples: u32) -> Vec<u8> {
    const ENTRIES: u32 = 8;
    // The depths of all samples stand behind the directory, where one number has no room for them.
    let depths = if samples == 1 { 8 } else { 8 + 2 + 12 * ENTRIES + 4 };
    let entries = [
        (256, 4, 1, size.0),
        (257, 4, 1, size.1),
        (258, 3, samples, depths),
        (259, 3, 1, 1),
        (262, 3, 1, photometric),
        (273, 4, 1, 8),
        (277, 3, 1, samples),
        (279, 4, 1, size.0.wrapping_mul(size.1)),
    ];
    let mut bytes = b"II*\0\x08\0\0\0\x08\0".to_vec();
    for (tag, kind, count, value) in entries {
        bytes.extend([tag as u16, kind].map(u16::to_le_bytes).as_flattened());
        bytes.extend([count, value].map(u32::to_le_bytes).as_flattened());
    }
    bytes.extend([0; 4]);
    bytes.extend([8, 0].repeat(samples as usize));
    bytes
}

#[test]
fn a_tiff_is_held_to_the_same_limits() {
    let message = error(&tiff_header((60_000, 60_000), 1, 1), "huge.tif");
    assert!(message.starts_with("huge.tif is 60000 x 60000 pixels; at most"), "{message}");
    let message = error(&tiff_header((4, 4), 5, 4), "print.tif");
    assert_eq!(message, "print.tif is a CMYK TIFF, which cannot be read here; convert it to RGB");
    let message = error(&tiff_header((4, 4), 3, 1), "palette.tif");
    assert!(message.starts_with("palette.tif is a TIFF of a rare kind ("), "{message}");
    let message = error(&tiff_header((4000, 4000), 1, 1), "cut.tif");
    assert!(message.starts_with("cut.tif is a damaged TIFF ("), "{message}");
}

#[test]
fn damage_is_an_error_or_a_picture_but_never_a_panic() {
    let codes: Vec<u8> = (0..24 * 16 * 3_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let icc = ColorProfile::new_adobe_rgb().encode().unwrap();
    let mut webp = Vec::new();
    WebPEncoder::new_lossless(&mut webp).write_image(&codes, 24, 16, ExtendedColorType::Rgb8).unwrap();
    let mut tiff = Cursor::new(Vec::new());
    TiffEncoder::new(&mut tiff).write_image(&codes, 24, 16, ExtendedColorType::Rgb8).unwrap();
    let files = [
        png_with(&codes, (24, 16), ExtendedColorType::Rgb8, Some(icc)),
        turned_jpeg(6),
        webp,
        tiff.into_inner(),
    ];
    let mut random = 1_u64;
    let mut next = |below: usize| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) as usize % below
    };
    for file in files {
        for _ in 0..1000 {
            let mut bytes = file.clone();
            for _ in 0..=next(3) {
                // Headers stand in front, so half of the damage goes there.
                let end = if next(2) == 0 { bytes.len() } else { bytes.len().min(400) };
                bytes[next(end)] = next(256) as u8;
            }
            let _ = decode_picture(&bytes, "damaged");
        }
    }
}

#[test]
fn a_mask_is_its_gray_level_or_its_alpha() {
    use ExtendedColorType::{L8, L16, Rgb8, Rgba8};
    let mask = |bytes: &[u8]| decode_mask(bytes, "mask.png", UVec2::new(2, 1)).unwrap().values().to_vec();
    assert_eq!(mask(&png(&[0, 130], (2, 1), L8)), [0, 130]);
    assert_eq!(mask(&png(&native(&[65_535, 257]), (2, 1), L16)), [255, 1]);
    assert_eq!(mask(&png(&[255, 255, 255, 0, 255, 0], (2, 1), Rgb8)), [255, 182]);
    assert_eq!(mask(&png(&[9, 9, 9, 255, 8, 8, 8, 255], (2, 1), Rgba8)), [9, 8], "alpha says nothing");
    assert_eq!(mask(&png(&[9, 9, 9, 0, 8, 8, 8, 77], (2, 1), Rgba8)), [0, 77], "alpha is the mask");
    // A profile is for colors, not for coverage.
    let gamma = ColorProfile::new_gray_with_gamma(1.0).encode().unwrap();
    assert_eq!(mask(&png_with(&[60, 130], (2, 1), L8, Some(gamma))), [60, 130]);
}

#[test]
fn a_mask_of_another_shape_is_refused_and_one_of_another_scale_fits() {
    let mask = |size: (u32, u32)| png(&vec![255; (size.0 * size.1) as usize], size, ExtendedColorType::L8);
    let expected = UVec2::new(192, 108);
    let message = decode_mask(&mask((192, 100)), "boat.png", expected).unwrap_err().to_string();
    assert!(
        message.starts_with("mask boat.png is 192 x 100 pixels, but its picture is 192 x 108"),
        "{message}"
    );
    assert!(decode_mask(&mask((108, 192)), "boat.png", expected).is_err());
    for size in [(192, 108), (96, 54), (384, 216), (64, 36), (383, 216), (95, 54)] {
        let fitted = decode_mask(&mask(size), "boat.png", expected).unwrap();
        assert_eq!((fitted.size(), fitted.get(191, 107)), (expected, 255), "{size:?}");
    }
}
