//! What a file is, told from its bytes alone; a file's extension says nothing here.
//!
//! Reads only what stands in front of the pixels and takes no memory, so it may be asked before any limit is checked.

use glam::UVec2;
use image::ImageFormat;

/// One of the formats that are read, and what its header tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Header {
    pub(super) format: ImageFormat,
    /// Width and height in pixels, where they can be told without a decoder (PNG and JPEG).
    pub(super) size: Option<UVec2>,
    /// A JPEG in four inks. Its decoder would make RGB of it, with the wrong inks.
    pub(super) is_cmyk: bool,
    /// Whether the file is known to end before its pixels do. Decoders fill the rest of a JPEG with gray.
    pub(super) is_cut_off: bool,
}

/// The header of a PNG, JPEG, TIFF or WebP; else what the bytes look like instead, with an article.
pub(super) fn read_header(bytes: &[u8]) -> Result<Header, &'static str> {
    let format = image::guess_format(bytes).ok();
    let header = |format| Header { format, size: None, is_cmyk: false, is_cut_off: false };
    match format {
        Some(format @ ImageFormat::Png) => Ok(Header { size: png_size(bytes), ..header(format) }),
        Some(format @ ImageFormat::Jpeg) => {
            let jpeg = walk_jpeg(bytes);
            Ok(Header {
                format,
                size: jpeg.frame.map(|(size, _)| size),
                is_cmyk: jpeg.frame.is_some_and(|(_, components)| components == 4),
                is_cut_off: !jpeg.has_end,
            })
        }
        Some(format @ (ImageFormat::Tiff | ImageFormat::WebP)) => Ok(header(format)),
        other => Err(describe(bytes, other)),
    }
}

/// The format's name as people write it.
pub(super) fn format_name(format: ImageFormat) -> &'static str {
    match format {
        ImageFormat::Png => "PNG",
        ImageFormat::Jpeg => "JPEG",
        ImageFormat::Tiff => "TIFF",
        ImageFormat::WebP => "WebP",
        _ => "picture",
    }
}

/// Names a file that is none of the four formats.
fn describe(bytes: &[u8], format: Option<ImageFormat>) -> &'static str {
    let brand = bytes.get(4..12).unwrap_or_default();
    if bytes.is_empty() {
        "an empty file"
    } else if brand.starts_with(b"ftyp") {
        match &brand[4..] {
            b"avif" | b"avis" => "an AVIF",
            b"heic" | b"heix" | b"heim" | b"heis" | b"hevc" | b"mif1" | b"msf1" => "a HEIC (or HEIF)",
            b"crx " => "a raw photograph",
            _ => "a film",
        }
    } else if bytes.starts_with(b"8BPS") {
        "a Photoshop document"
    } else if bytes.starts_with(b"gimp xcf") {
        "a GIMP document"
    } else if bytes.starts_with(b"%PDF") {
        "a PDF"
    } else if bytes.starts_with(&[0xff, 0x0a]) || bytes.starts_with(b"\0\0\0\x0cJXL ") {
        "a JPEG XL"
    } else if bytes.starts_with(b"\0\0\0\x0cjP  ") {
        "a JPEG 2000"
    } else if is_text(bytes) {
        // Before the formats below: some of them are told by two letters.
        "a text file"
    } else {
        match format {
            Some(ImageFormat::Gif) => "a GIF",
            Some(ImageFormat::Bmp) => "a BMP",
            Some(ImageFormat::Ico) => "an icon",
            Some(ImageFormat::Hdr | ImageFormat::OpenExr) => "a high-dynamic-range picture",
            Some(_) => "a picture in a rare format",
            None => "no picture of a known format",
        }
    }
}

/// Whether the first bytes are printable UTF-8.
fn is_text(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(512)];
    let valid = match std::str::from_utf8(start) {
        Ok(text) => text,
        // The cut may have split a letter; anything else is no text.
        Err(error) if error.error_len().is_none() => {
            std::str::from_utf8(&start[..error.valid_up_to()]).unwrap_or("")
        }
        Err(_) => return false,
    };
    !valid.is_empty() && valid.chars().all(|letter| !letter.is_control() || letter.is_whitespace())
}

/// Width and height from a PNG's first chunk.
fn png_size(bytes: &[u8]) -> Option<UVec2> {
    let side = |at: usize| Some(u32::from_be_bytes(*bytes.get(at..)?.first_chunk()?));
    (bytes.get(12..16)? == b"IHDR").then_some(())?;
    Some(UVec2::new(side(16)?, side(20)?))
}

#[derive(Default)]
struct Jpeg {
    /// Size and number of components of the frame.
    frame: Option<(UVec2, u8)>,
    /// Whether the end marker was found.
    has_end: bool,
}

/// Follows a JPEG's segments, thumbnails inside them left out, up to its end marker.
fn walk_jpeg(bytes: &[u8]) -> Jpeg {
    let mut jpeg = Jpeg::default();
    let mut at = 2;
    // A marker is 0xff and a byte that is neither 0 (a data byte 0xff) nor 0xff (padding); between segments and in the
    // entropy-coded data after a scan's header, everything else is skipped.
    while let Some([first, marker]) = bytes.get(at..at + 2).and_then(|pair| pair.first_chunk()) {
        match (*first, *marker) {
            (0xff, 0xd9) => {
                jpeg.has_end = true;
                break;
            }
            // Restart marks, start, temporary: no length follows.
            (0xff, 0x01 | 0xd0..=0xd8) | (0xff, 0x00) => at += 2,
            (0xff, 0xff) | (0..=0xfe, _) => at += 1,
            (0xff, marker) => {
                let segment = bytes.get(at + 2..).unwrap_or_default();
                // Start of frame; c4, c8 and cc are tables and an extension.
                let is_frame = matches!(marker, 0xc0..=0xcf) && !matches!(marker, 0xc4 | 0xc8 | 0xcc);
                if is_frame && let Some([_, _, _, h0, h1, w0, w1, components]) = segment.first_chunk() {
                    let side = |high: &u8, low: &u8| u32::from(u16::from_be_bytes([*high, *low]));
                    jpeg.frame = Some((UVec2::new(side(w0, w1), side(h0, h1)), *components));
                }
                let length = segment.first_chunk().map_or(2, |length| u16::from_be_bytes(*length).max(2));
                at += 2 + usize::from(length);
            }
        }
    }
    jpeg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_are_not_read_have_names() {
        let found = |bytes: &[u8]| read_header(bytes).unwrap_err();
        assert_eq!(found(b""), "an empty file");
        assert_eq!(found(b"GIF89a\x01\0\x01\0\x80\0"), "a GIF");
        assert_eq!(found(b"\0\0\0\x18ftypheic\0\0\0\0"), "a HEIC (or HEIF)");
        assert_eq!(found(b"\0\0\0\x20ftypavif\0\0\0\0"), "an AVIF");
        assert_eq!(found(b"8BPS\0\x01\0\0"), "a Photoshop document");
        assert_eq!(found("BMW and Märchen\n".as_bytes()), "a text file");
        assert_eq!(found(b"BM\x36\0\0\0\0\0"), "a BMP");
        assert_eq!(found(b"\x01\x02\x03\x04\xff"), "no picture of a known format");
    }

    #[test]
    fn a_letter_split_at_the_end_of_the_look_is_still_text() {
        let text = "ä".repeat(400);
        assert!(is_text(format!("x{text}").as_bytes()));
    }

    #[test]
    fn a_jpeg_is_whole_only_with_its_own_end_marker() {
        // An APP1 segment that holds a thumbnail's end marker, then a frame of 5 x 3 in four components, then a scan.
        let mut bytes = b"\xff\xd8\xff\xe1\0\x04\xff\xd9".to_vec();
        bytes.extend(b"\xff\xc2\0\x14\x08\0\x03\0\x05\x04............");
        bytes.extend(b"\xff\xda\0\x02\x12\xff\0\x34\xff\xd0\x56");
        let cut = read_header(&bytes).unwrap();
        assert_eq!((cut.size, cut.is_cmyk, cut.is_cut_off), (Some(UVec2::new(5, 3)), true, true));
        bytes.extend(b"\xff\xd9");
        assert!(!read_header(&bytes).unwrap().is_cut_off);
    }
}
