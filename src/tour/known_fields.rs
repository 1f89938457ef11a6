//! The fields that each section of the document has, asked of the types themselves.

use serde::Deserialize;
use serde::de::{Deserializer, Visitor, value::Error};
use serde::forward_to_deserialize_any;

use super::annotation::{
    Background, Band, CameraNotes, Crop, Drift, GroundArea, PictureSource, ReflectionPair, Sky, WaterArea,
};
use super::file::TourFile;
use super::journey::{CameraPath, Keyframe};
use super::object::{Course, Floating, Object, Recorded, Sway};
use super::weather::{Jonswap, Octaves, RecordedSea, Waves, Wind};

type Fields = &'static [&'static str];

/// Each section's name and fields. An enum's variants are several entries of one name.
fn sections() -> [(&'static str, Fields); 24] {
    [
        ("", fields::<TourFile>()),
        ("picture", fields::<PictureSource<String>>()),
        ("picture.crop", fields::<Crop>()),
        ("camera", fields::<CameraNotes>()),
        // The only variant with fields; the derive tells them to `struct_variant`, which needs a value to be asked.
        ("camera.scale", &["on", "from", "to", "meters"]),
        ("water", fields::<WaterArea<String>>()),
        ("water.pairs", fields::<ReflectionPair>()),
        ("ground", fields::<GroundArea<String>>()),
        ("background", fields::<Background<String>>()),
        ("background.bands", fields::<Band<String>>()),
        ("sky", fields::<Sky<String>>()),
        ("sky.drift", fields::<Drift>()),
        ("objects", fields::<Object<String>>()),
        ("objects.motion", fields::<Sway>()),
        ("objects.motion", fields::<Floating>()),
        ("objects.motion", fields::<Course>()),
        ("objects.motion", fields::<Recorded<String>>()),
        ("wind", fields::<Wind>()),
        ("waves", fields::<Waves<String>>()),
        ("waves.sea", fields::<Octaves>()),
        ("waves.sea", fields::<Jonswap>()),
        ("waves.sea", fields::<RecordedSea<String>>()),
        ("path", fields::<CameraPath>()),
        ("path.keyframes", fields::<Keyframe>()),
    ]
}

/// The section of a place: `objects[2]` is in `objects`.
pub(super) fn section_of(path: &str) -> String {
    path.split('.').map(|step| step.split('[').next().unwrap_or(step)).collect::<Vec<_>>().join(".")
}

/// All fields that a section may have.
pub(super) fn fields_of(section: &str) -> Vec<&'static str> {
    let mut known: Vec<_> = sections()
        .iter()
        .filter(|(name, _)| *name == section)
        .flat_map(|(_, fields)| fields.iter().copied())
        .collect();
    known.sort_unstable();
    known.dedup();
    known
}

/// The section that has exactly this field.
pub(super) fn section_with(field: &str) -> Option<&'static str> {
    sections().iter().find(|(_, fields)| fields.contains(&field)).map(|(name, _)| *name)
}

/// The field names of a struct, as its `Deserialize` asks for them.
fn fields<'de, T: Deserialize<'de>>() -> Fields {
    struct Capture<'a>(&'a mut Fields);

    impl<'de> Deserializer<'de> for Capture<'_> {
        type Error = Error;

        fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Error> {
            Err(serde::de::Error::custom("only asked for its fields"))
        }

        fn deserialize_struct<V: Visitor<'de>>(
            self,
            _: &'static str,
            fields: Fields,
            visitor: V,
        ) -> Result<V::Value, Error> {
            *self.0 = fields;
            self.deserialize_any(visitor)
        }

        forward_to_deserialize_any! {
            bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf option unit unit_struct
            newtype_struct seq tuple tuple_struct map enum identifier ignored_any
        }
    }

    let mut captured: Fields = &[];
    // The refusal is the expected end: the names came before it.
    let _refused = T::deserialize(Capture(&mut captured)).is_err();
    captured
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_section_tells_its_fields() {
        for (name, fields) in sections() {
            assert!(!fields.is_empty(), "{name} has no fields");
        }
        assert_eq!(fields_of("picture.crop"), ["height", "left", "top", "width"]);
        assert_eq!(section_of("objects[2].motion"), "objects.motion");
    }
}
