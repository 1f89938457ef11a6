//! What is wrong with a document: place, value, what is wrong, what to write instead.

use std::fmt;

/// Where in a document something is.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The file's name as shown to the user, once it is known.
    pub file: Option<String>,
    /// The way to the value, like `objects[2].contact[0]`; empty for the file as a whole.
    pub path: String,
    /// Line, from 1; `None` for a document built in code.
    pub line: Option<usize>,
    /// Column in characters, from 1.
    pub column: Option<usize>,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let file = self.file.as_deref();
        match (self.line, self.column) {
            (Some(line), Some(column)) => write!(f, "{}:{line}:{column}", file.unwrap_or("tour"))?,
            (Some(line), None) => write!(f, "{}:{line}", file.unwrap_or("tour"))?,
            (None, _) => f.write_str(file.unwrap_or("tour"))?,
        }
        if self.path.is_empty() { Ok(()) } else { write!(f, ": {}", self.path) }
    }
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Where.
    pub place: Place,
    /// What stands there; empty when nothing does.
    pub value: String,
    /// What is wrong with it.
    pub message: String,
    /// What to do instead.
    pub advice: String,
}

impl Problem {
    /// A problem at the way `path` of a document.
    #[must_use]
    pub fn new(
        path: impl Into<String>,
        value: impl fmt::Display,
        message: impl Into<String>,
        advice: impl Into<String>,
    ) -> Self {
        Self {
            place: Place { path: path.into(), ..Place::default() },
            value: value.to_string(),
            message: message.into(),
            advice: advice.into(),
        }
    }

    /// The same problem at a line and column, both from 1.
    #[must_use]
    pub fn at(mut self, line: usize, column: usize) -> Self {
        self.place.line = Some(line);
        self.place.column = Some(column);
        self
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.place)?;
        if !self.value.is_empty() {
            f.write_str(if self.place.path.is_empty() { ": " } else { " = " })?;
            f.write_str(&self.value)?;
        }
        write!(f, ": {}", self.message)?;
        // A picture's errors carry their advice in the message.
        if self.advice.is_empty() { Ok(()) } else { write!(f, "; {}", self.advice) }
    }
}

/// Everything that is wrong with a document, in the order of the file; never empty when returned as an error.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Problems(pub Vec<Problem>);

impl Problems {
    /// The same problems with line and column, for those whose place can be found in the document's text.
    #[must_use]
    pub fn located_in(mut self, text: &str) -> Self {
        super::read::locate_all(text, &mut self.0);
        self
    }

    /// The same problems, each with the file's name.
    #[must_use]
    pub fn with_file(mut self, name: &str) -> Self {
        for problem in &mut self.0 {
            problem.place.file = Some(name.to_owned());
        }
        self
    }
}

impl From<Problem> for Problems {
    fn from(problem: Problem) -> Self {
        Self(vec![problem])
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Problems {}

/// The name most like `wanted`, if one is alike enough to be meant.
pub(super) fn nearest<'a>(wanted: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wanted = wanted.to_lowercase();
    names
        .into_iter()
        .map(|name| (strsim::jaro_winkler(&wanted, &name.to_lowercase()), name))
        .filter(|(likeness, _)| *likeness > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}

/// Names as a list in a sentence: "`a`, `b` or `c`".
pub(super) fn one_of(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        Some((only, _)) => only.clone(),
        None => "nothing".to_owned(),
    }
}
