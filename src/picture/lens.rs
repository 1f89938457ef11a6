//! What EXIF tells about the lens. A prior for the focal length, never a fact: see [`Lens::whole_frame`].

use std::io::Cursor;

use exif::{Exif, In, Tag};
use glam::{DVec2, UVec2};

/// Diagonal of a 36 × 24 mm frame, in mm. CIPA DCG-001 defines the 35-mm equivalent by diagonals.
const FULL_FRAME_DIAGONAL: f64 = 43.266_615_305_567_87;

/// The lens a photograph says it was taken with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// 35-mm-equivalent focal length, in mm; above 0. For the whole frame of the camera, by the diagonal.
    pub focal_35mm: f64,
    /// Whether the file is the whole frame, perhaps scaled: EXIF tells the frame's size in pixels, and the file has
    /// its proportions within a pixel. Where this is false the picture was cropped, or nobody knows, and
    /// [`focal_px`](Self::focal_px) is too short by the crop.
    pub whole_frame: bool,
}

impl Lens {
    /// Focal length in pixels of a picture of `size` pixels that shows the whole frame.
    #[must_use]
    pub fn focal_px(self, size: UVec2) -> f64 {
        self.focal_35mm / FULL_FRAME_DIAGONAL * size.as_dvec2().length()
    }
}

/// The lens that the EXIF of a PNG, JPEG, TIFF or WebP names; `None` where there is none or it cannot be read.
///
/// `stored_size` is the file's size in pixels before any turning, as EXIF's own sizes are.
pub(super) fn read_lens(bytes: &[u8], stored_size: UVec2) -> Option<Lens> {
    let mut reader = exif::Reader::new();
    reader.continue_on_error(true);
    let exif = reader
        .read_from_container(&mut Cursor::new(bytes))
        .or_else(|error| error.distill_partial_result(|_| ()))
        .ok()?;

    let frame = number(&exif, Tag::PixelXDimension).zip(number(&exif, Tag::PixelYDimension));
    let frame = frame.map(DVec2::from);
    let focal_35mm =
        number(&exif, Tag::FocalLengthIn35mmFilm).or_else(|| focal_from_sensor(&exif, frame?))?;
    let stored = stored_size.as_dvec2();
    let whole_frame = frame.is_some_and(|frame| (frame * (stored.x / frame.x) - stored).abs().y <= 1.0);
    Some(Lens { focal_35mm, whole_frame })
}

/// The equivalent from the true focal length and the sensor's pixel pitch: older cameras write only those.
fn focal_from_sensor(exif: &Exif, frame: DVec2) -> Option<f64> {
    let millimeters_per_unit = match number(exif, Tag::FocalPlaneResolutionUnit).unwrap_or(2.0) {
        2.0 => 25.4,
        3.0 => 10.0,
        4.0 => 1.0,
        _ => return None,
    };
    let pixels_per_millimeter = number(exif, Tag::FocalPlaneXResolution)? / millimeters_per_unit;
    let focal_px = number(exif, Tag::FocalLength)? * pixels_per_millimeter;
    Some(focal_px * FULL_FRAME_DIAGONAL / frame.length())
}

/// A tag's first number, if it is one above 0. EXIF writes 0 for "unknown".
fn number(exif: &Exif, tag: Tag) -> Option<f64> {
    let value = &exif.get_field(tag, In::PRIMARY)?.value;
    let number = match value {
        exif::Value::Rational(values) => values.first()?.to_f64(),
        _ => f64::from(value.get_uint(0)?),
    };
    (number.is_finite() && number > 0.0).then_some(number)
}

#[cfg(test)]
pub(super) mod tests {
    use exif::experimental::Writer;
    use exif::{Field, Rational, Value};

    use super::*;

    /// EXIF data, as stands in a PNG's `eXIf` chunk.
    pub(in crate::picture) fn exif_bytes(fields: &[(Tag, Value)]) -> Vec<u8> {
        let fields: Vec<_> = fields
            .iter()
            .map(|(tag, value)| Field { tag: *tag, ifd_num: In::PRIMARY, value: value.clone() })
            .collect();
        let mut writer = Writer::new();
        fields.iter().for_each(|field| writer.push_field(field));
        let mut bytes = Cursor::new(Vec::new());
        writer.write(&mut bytes, /* little_endian= */ true).unwrap();
        bytes.into_inner()
    }

    /// A TIFF container is EXIF data and nothing else.
    fn lens(fields: &[(Tag, Value)], stored_size: UVec2) -> Option<Lens> {
        read_lens(&exif_bytes(fields), stored_size)
    }

    fn frame(width: u32, height: u32) -> [(Tag, Value); 2] {
        [(Tag::PixelXDimension, Value::Long(vec![width])), (Tag::PixelYDimension, Value::Long(vec![height]))]
    }

    #[test]
    fn the_whole_frame_may_be_scaled_but_not_cropped() {
        let mut fields = vec![(Tag::FocalLengthIn35mmFilm, Value::Short(vec![28]))];
        assert_eq!(lens(&fields, UVec2::new(600, 400)), Some(Lens { focal_35mm: 28.0, whole_frame: false }));
        fields.extend(frame(6000, 4000));
        assert_eq!(lens(&fields, UVec2::new(600, 400)), Some(Lens { focal_35mm: 28.0, whole_frame: true }));
        assert_eq!(lens(&fields, UVec2::new(600, 390)), Some(Lens { focal_35mm: 28.0, whole_frame: false }));
    }

    #[test]
    fn a_sensor_of_36_mm_needs_no_equivalent() {
        let rational = |num, denom| Value::Rational(vec![Rational { num, denom }]);
        let mut fields = vec![
            (Tag::FocalLength, rational(50, 1)),
            (Tag::FocalPlaneXResolution, rational(6000, 36)),
            (Tag::FocalPlaneResolutionUnit, Value::Short(vec![4])),
        ];
        fields.extend(frame(6000, 4000));
        let focal = lens(&fields, UVec2::new(6000, 4000)).unwrap().focal_35mm;
        assert!((focal - 50.0).abs() < 1e-9, "{focal} mm");
    }

    #[test]
    fn focal_length_in_pixels_is_by_the_diagonal() {
        // 36 mm lens on a 36 mm wide frame: as many pixels as the frame is wide.
        let focal = Lens { focal_35mm: 36.0, whole_frame: true }.focal_px(UVec2::new(3000, 2000));
        assert!((focal - 3000.0).abs() < 1e-9, "{focal} px");
    }

    #[test]
    fn no_lens_without_exif_or_with_an_unknown_one() {
        assert_eq!(read_lens(b"II*\0nonsense", UVec2::ONE), None);
        assert_eq!(lens(&[(Tag::FocalLengthIn35mmFilm, Value::Short(vec![0]))], UVec2::ONE), None);
    }
}
