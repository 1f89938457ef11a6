//! Text to [`TourFile`]: syntax, version, types, unknown fields.
//!
//! Every unknown field is reported, and the first thing that does not read at all; RON's reader cannot go on after that.

use ron::Options;
use ron::error::SpannedError;
use ron::extensions::Extensions;
use serde::Deserialize;
use serde::de::IgnoredAny;

use super::file::{TourFile, VERSION};
use super::known_fields;
use super::locate::locate;
use super::problem::{Problem, nearest, one_of};

const START_ANEW: &str = "`picture-tour new PICTURE` writes a file to start from";

/// Problems that get a line: each costs another reading of the text.
const MOST_LOCATED: usize = 100;

/// How tours are read and written: `Some(…)` may be left out, and so may the inner parentheses of `Sway((…))`.
pub(super) fn options() -> Options {
    Options::default().with_default_extension(Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES)
}

/// Reads a document: the file, if it reads at all, and every problem found so far.
pub(super) fn read(text: &str) -> (Option<TourFile>, Vec<Problem>) {
    #[derive(Deserialize)]
    #[serde(rename = "Tour")]
    struct Version {
        version: Option<u64>,
    }
    // A newer file's new fields would drown the one message that helps.
    if let Ok(Version { version: Some(version) }) = options().from_str(text)
        && version > u64::from(VERSION)
    {
        return (None, vec![newer(version)]);
    }

    let mut unknown = Vec::new();
    let read = ron::Deserializer::from_str_with_options(text, &options()).and_then(|mut deserializer| {
        let file = serde_ignored::deserialize(&mut deserializer, |path| unknown.push(path_text(&path)))
            .and_then(|file| deserializer.end().map(|()| file));
        file.map_err(|error| deserializer.span_error(error))
    });
    let mut problems: Vec<Problem> = unknown.iter().map(|path| unknown_field(path)).collect();
    match read {
        Ok(file) => (Some(file), problems),
        Err(error) => {
            problems.push(unreadable(text, &error));
            (None, problems)
        }
    }
}

/// The way to an ignored field as problems write it: `objects[2].contct`.
fn path_text(path: &serde_ignored::Path<'_>) -> String {
    use serde_ignored::Path;
    match path {
        Path::Root => String::new(),
        Path::Seq { parent, index } => format!("{}[{index}]", path_text(parent)),
        Path::Map { parent, key } => match path_text(parent) {
            parent if parent.is_empty() => key.clone(),
            parent => format!("{parent}.{key}"),
        },
        Path::Some { parent } | Path::NewtypeStruct { parent } | Path::NewtypeVariant { parent } => {
            path_text(parent)
        }
    }
}

fn newer(version: u64) -> Problem {
    Problem::new(
        "version",
        version,
        format!("the file was written by a newer version of the program ({version} > {VERSION})"),
        "update the program to open it",
    )
}

/// Gives each problem its line and column, and puts them in the order of the file.
pub(super) fn locate_all(text: &str, problems: &mut [Problem]) {
    for problem in problems.iter_mut().filter(|problem| problem.place.line.is_none()).take(MOST_LOCATED) {
        if let Some((line, column)) = locate(text, &problem.place.path) {
            problem.place.line = Some(line);
            problem.place.column = Some(column);
        }
    }
    problems.sort_by_key(|problem| (problem.place.line.unwrap_or(usize::MAX), problem.place.column));
}

fn unknown_field(path: &str) -> Problem {
    let (parent, field) = path.rsplit_once('.').unwrap_or(("", path));
    let section = known_fields::section_of(parent);
    let known = known_fields::fields_of(&section);
    let advice = if let Some(other) = known_fields::section_with(field) {
        match other {
            "" => format!("move `{field}` to the top of the file"),
            other => format!("move it to `{other}`, which has a field of that name"),
        }
    } else if let Some(meant) = nearest(field, known.iter().copied()) {
        format!("write `{meant}`, the nearest known name")
    } else {
        format!("leave it out; known here: {}", one_of(&known))
    };
    let place = if section.is_empty() { "a tour".to_owned() } else { format!("`{section}`") };
    Problem::new(path, "", format!("{place} has no field `{field}`"), advice)
}

/// What keeps a text from being read, in words.
fn unreadable(text: &str, error: &SpannedError) -> Problem {
    use ron::Error as E;
    let line = error.span.start.line;
    let excerpt = text.lines().nth(line - 1).unwrap_or_default().trim();
    let excerpt: String = excerpt.chars().take(80).collect();
    let problem = |message: String, advice: String| {
        Problem::new("", &excerpt, message, advice).at(error.span.start.line, error.span.start.col)
    };

    let content = text.lines().find(|line| !line.trim().is_empty() && !line.trim_start().starts_with("//"));
    let Some(content) = content else {
        return Problem::new("", "", "the file is empty", START_ANEW).at(1, 1);
    };
    if !content.trim_start().trim_start_matches('\u{feff}').starts_with(['(', '#', '/', 'T']) {
        return problem("this is no tour file: a tour starts with `(`".into(), START_ANEW.into());
    }
    if let Some((line, column)) = truncated(text) {
        let advice = format!("close what is open, restore the file from a copy, or start anew: {START_ANEW}");
        return Problem::new("", &excerpt, "the file ends in the middle of the tour", advice)
            .at(line, column);
    }
    match &error.code {
        E::NoSuchEnumVariant { expected, found, .. } => problem(
            format!("there is no `{found}` here"),
            nearest(found, expected.iter().copied()).map_or_else(
                || format!("write {}", one_of(expected)),
                |meant| format!("write `{meant}`, the nearest known name"),
            ),
        ),
        E::MissingStructField { field, outer } => problem(
            format!("the field `{field}` of {} is missing", outer.as_deref().unwrap_or("this section")),
            format!("add `{field}: …` before this closing parenthesis"),
        ),
        E::DuplicateStructField { field, .. } => {
            problem(format!("the field `{field}` stands here twice"), "keep one of the two".into())
        }
        E::InvalidValueForType { expected, found } => {
            problem(format!("{found} stands where {expected} is expected"), format!("write {expected}"))
        }
        E::ExpectedDifferentLength { expected, found } => {
            problem(format!("{found} values stand where {expected} is expected"), format!("write {expected}"))
        }
        E::TrailingCharacters => problem(
            "the tour ends before this".into(),
            "remove what follows its last `)`, or the `)` too many".into(),
        ),
        E::ExpectedFloat | E::ExpectedInteger | E::InvalidIntegerDigit { .. } | E::UnderscoreAtBeginning => {
            problem("a number is expected here".into(), "write a number such as 12 or 4.5".into())
        }
        E::IntegerOutOfBounds => {
            problem("this whole number is out of range".into(), "write a number from 0 to 4294967295".into())
        }
        E::ExpectedComma => {
            problem("a comma is missing before this".into(), "add `,` after the value before".into())
        }
        E::ExpectedString => {
            problem("a text is expected here".into(), "write it in quotes, as \"lake.png\"".into())
        }
        E::ExpectedBoolean => problem("yes or no is expected here".into(), "write `true` or `false`".into()),
        other => problem(
            format!("this does not read as RON ({other})"),
            format!("compare with the format's description, or start anew: {START_ANEW}"),
        ),
    }
}

/// Where the text ends, if as mere RON it ends too early.
fn truncated(text: &str) -> Option<(usize, usize)> {
    let SpannedError { code, span } = options().from_str::<IgnoredAny>(text).err()?;
    let text = text.trim_end();
    let end = (text.lines().count(), text.lines().last().map_or(0, |line| line.chars().count()));
    // What opens a string or a comment that never ends may stand far above.
    let open = matches!(code, ron::Error::ExpectedStringEnd | ron::Error::UnclosedBlockComment);
    (open || end <= (span.end.line, span.end.col)).then_some((span.start.line, span.start.col))
}
