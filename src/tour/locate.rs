//! Line and column of a value, from the way to it.
//!
//! RON's reader forgets positions once a value is read. So the text is read again by a seed that follows the way and fails
//! where it ends: the reader's error then carries the position. Where a step does not exist, the last value reached counts.

use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

/// Line and column (from 1) of the value at `path`, or of the nearest value around it; `None` when the text does not
/// read that far.
pub(super) fn locate(text: &str, path: &str) -> Option<(usize, usize)> {
    let steps = steps(path);
    // The nearest ancestor that exists is found by leaving out the last steps.
    (0..=steps.len()).rev().find_map(|count| {
        let error = super::read::options().from_str_seed(text, Follow(&steps[..count])).err()?;
        let found = matches!(&error.code, ron::Error::Message(message) if message == HERE);
        found.then_some((error.span.end.line, error.span.end.col))
    })
}

/// The message of the error that marks the place.
const HERE: &str = "the place that was looked for";

enum Step<'a> {
    Field(&'a str),
    Index(usize),
}

/// `objects[2].contact` as steps.
fn steps(path: &str) -> Vec<Step<'_>> {
    path.split(['.', '['])
        .filter(|step| !step.is_empty())
        .map(|step| match step.strip_suffix(']').and_then(|index| index.parse().ok()) {
            Some(index) => Step::Index(index),
            None => Step::Field(step),
        })
        .collect()
}

/// Follows the steps and fails at their end; succeeds when they lead nowhere.
struct Follow<'a>(&'a [Step<'a>]);

impl<'de> DeserializeSeed<'de> for Follow<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        if self.0.is_empty() {
            return Err(D::Error::custom(HERE));
        }
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Follow<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("any value")
    }

    fn visit_some<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        self.deserialize(deserializer)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<String>()? {
            match self.0 {
                [Step::Field(field), rest @ ..] if *field == key => map.next_value_seed(Follow(rest))?,
                _ => drop(map.next_value::<IgnoredAny>()?),
            }
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<(), A::Error> {
        // The reader shows a variant such as `Polygon([…])` as a sequence of one; its name is a step of the way.
        let (wanted, rest) = match self.0 {
            [Step::Index(index), rest @ ..] => (Some(*index), rest),
            [Step::Field(variant), rest @ ..] if variant.starts_with(char::is_uppercase) => (Some(0), rest),
            rest => (None, rest),
        };
        let mut index = 0;
        loop {
            let more = if wanted == Some(index) {
                seq.next_element_seed(Follow(rest))?.is_some()
            } else {
                seq.next_element::<IgnoredAny>()?.is_some()
            };
            if !more {
                return Ok(());
            }
            index += 1;
        }
    }

    fn visit_bool<E>(self, _: bool) -> Result<(), E> {
        Ok(())
    }

    fn visit_i64<E>(self, _: i64) -> Result<(), E> {
        Ok(())
    }

    fn visit_u64<E>(self, _: u64) -> Result<(), E> {
        Ok(())
    }

    fn visit_f64<E>(self, _: f64) -> Result<(), E> {
        Ok(())
    }

    fn visit_str<E>(self, _: &str) -> Result<(), E> {
        Ok(())
    }

    fn visit_unit<E>(self) -> Result<(), E> {
        Ok(())
    }

    fn visit_none<E>(self) -> Result<(), E> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "// a tour\n(\n  a: 1,\n  list: [\n    (x: (1, 2)),\n    (x: Some((3,\n      inf))),\n  ],\n  shape: Polygon([\n    (1, 2),\n    (3, NaN),\n  ]),\n  way: Course(speed: 0),\n)\n";

    #[test]
    fn values_are_found_where_they_stand() {
        for (path, place) in [
            ("a", (3, 6)),
            ("list", (4, 9)),
            ("list[0].x", (5, 9)),
            ("list[1].x[1]", (7, 7)),
            ("shape.Polygon[1]", (11, 5)),
            ("way.speed", (13, 22)),
        ] {
            assert_eq!(locate(TEXT, path), Some(place), "{path}");
        }
    }

    #[test]
    fn what_is_missing_is_where_its_parent_stands() {
        assert_eq!(locate(TEXT, "list[1].y"), Some((6, 5)));
        assert_eq!(locate(TEXT, "b.c.d"), Some((2, 1)));
        assert_eq!(locate("(a: 1", "b"), Some((1, 1)));
    }
}
