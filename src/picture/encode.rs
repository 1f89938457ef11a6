//! Writes PNG files, whole or not at all.

use std::io::Write;
use std::path::Path;

use glam::UVec2;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

use super::PictureError;
use super::raster::check_count;

/// Pixels to write, row by row from the top left, 8-bit sRGB codes.
#[derive(Clone, Copy, Debug)]
pub enum PngPixels<'a> {
    /// Red, green, blue.
    Rgb(&'a [[u8; 3]]),
    /// Red, green, blue, coverage; not premultiplied.
    Rgba(&'a [[u8; 4]]),
    /// One value a pixel: a mask's coverage.
    Gray(&'a [u8]),
}

/// The bytes of a PNG file of `size` pixels.
///
/// # Errors
///
/// [`PictureError::WrongCount`] when there are not exactly width × height pixels, or none at all.
pub fn encode_png(size: UVec2, pixels: PngPixels<'_>) -> Result<Vec<u8>, PictureError> {
    let (count, bytes, color) = match pixels {
        PngPixels::Rgb(pixels) => (pixels.len(), pixels.as_flattened(), ExtendedColorType::Rgb8),
        PngPixels::Rgba(pixels) => (pixels.len(), pixels.as_flattened(), ExtendedColorType::Rgba8),
        PngPixels::Gray(pixels) => (pixels.len(), pixels, ExtendedColorType::L8),
    };
    check_count(size, count)?;
    let mut png = Vec::new();
    PngEncoder::new(&mut png)
        .write_image(bytes, size.x, size.y, color)
        // The count is right and memory takes every byte, so only a size beyond PNG's own limits ends here.
        .map_err(|_| PictureError::WrongCount { size, count })?;
    Ok(png)
}

/// Writes a PNG file of `size` pixels. A file at `path` is replaced in one step, so that whoever reads it meanwhile, and
/// whatever interrupts this, never leaves half a file there.
///
/// # Errors
///
/// [`PictureError::WrongCount`] as [`encode_png`]; [`PictureError::Write`] when the file cannot be written.
pub fn save_png(path: &Path, size: UVec2, pixels: PngPixels<'_>) -> Result<(), PictureError> {
    let png = encode_png(size, pixels)?;
    write_whole(path, &png).map_err(|source| PictureError::Write { path: path.to_owned(), source })
}

/// The folder of a file; the current one for a mere name.
pub(crate) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Writes beside the file first: a rename is one step only within a folder's file system.
fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".").suffix(".png.part");
    // Temporary files are private by default; a picture gets what the user's umask leaves.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder_of(path))?;
    file.write_all(bytes)?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::decode_picture;

    #[test]
    fn what_was_saved_is_read_back_and_nothing_is_left_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("frame.png");
        std::fs::write(&path, "old").unwrap();
        let pixels = [[1, 2, 3], [4, 5, 6]];

        save_png(&path, UVec2::new(2, 1), PngPixels::Rgb(&pixels)).unwrap();

        let decoded = decode_picture(&std::fs::read(&path).unwrap(), "frame.png").unwrap();
        assert_eq!(decoded.picture.pixels(), pixels);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_missing_folder_is_told_by_its_path() {
        let path = Path::new("/nowhere/at/all/frame.png");
        let error = save_png(path, UVec2::ONE, PngPixels::Gray(&[0])).unwrap_err().to_string();
        assert!(error.starts_with("/nowhere/at/all/frame.png could not be written"), "{error}");
    }

    #[test]
    fn a_path_of_one_name_is_written_here_and_too_few_pixels_nowhere() {
        let error = save_png(Path::new("never.png"), UVec2::new(2, 2), PngPixels::Gray(&[0])).unwrap_err();
        assert!(matches!(error, PictureError::WrongCount { count: 1, .. }));
        assert!(!Path::new("never.png").exists());
    }
}
