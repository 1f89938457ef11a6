//! Paths that cannot leave the tour's folder.
//!
//! A [`RelativePath`] that exists is safe to join to the folder on every platform: forward slashes only, no `..`, no
//! root, drive or scheme.

use serde::{Serialize, Serializer};

/// A path below the tour's folder, with forward slashes.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RelativePath(String);

/// Why a text is no path below the tour's folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UnsafePath {
    /// Nothing is named.
    #[error("the path is empty")]
    Empty,
    /// It has `..` in it.
    #[error("the path leaves the tour's folder")]
    Leaves,
    /// It starts at a root or drive.
    #[error("the path is absolute")]
    Absolute,
    /// It names another source, as `https://` does.
    #[error("the path names another source than the tour's folder")]
    Source,
    /// It has a backslash, which only Windows takes for a separator.
    #[error("the path has a backslash")]
    Backslash,
    /// It ends in a slash or has a step that is empty, `.`, or holds a control character.
    #[error("the path does not name a file")]
    Step,
}

impl RelativePath {
    /// Takes a path below the tour's folder.
    ///
    /// # Errors
    /// This returns an error when `text` is empty, absolute, has a drive, a scheme or an asset source, a backslash, a
    /// step `..`, `.` or an empty step, or a control character.
    pub fn new(text: &str) -> Result<Self, UnsafePath> {
        if text.trim().is_empty() {
            return Err(UnsafePath::Empty);
        }
        if text.contains("://") {
            return Err(UnsafePath::Source);
        }
        if text.starts_with(['/', '\\', '~']) || text.as_bytes().get(1) == Some(&b':') {
            return Err(UnsafePath::Absolute);
        }
        if text.split(['/', '\\']).any(|step| step.trim() == "..") {
            return Err(UnsafePath::Leaves);
        }
        if text.contains('\\') {
            return Err(UnsafePath::Backslash);
        }
        // A colon is a stream on Windows; `#` is an asset's label in Bevy.
        if text.contains([':', '#']) {
            return Err(UnsafePath::Source);
        }
        if text.split('/').any(|step| step.is_empty() || step.trim() == ".")
            || text.contains(char::is_control)
        {
            return Err(UnsafePath::Step);
        }
        Ok(Self(text.to_owned()))
    }

    /// The path as written.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The path below `folder`.
    #[must_use]
    pub fn in_folder(&self, folder: &std::path::Path) -> std::path::PathBuf {
        folder.join(&self.0)
    }
}

impl std::fmt::Display for RelativePath {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl Serialize for RelativePath {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_paths_below_the_folder_are_taken() {
        for good in ["lake.png", "masks/boat.png", "a..b.png", "Mühle am Bach.jpg", ".hidden/x.png"] {
            assert!(RelativePath::new(good).is_ok(), "{good} was refused");
        }
        let bad = [
            ("", UnsafePath::Empty),
            ("  ", UnsafePath::Empty),
            ("../lake.png", UnsafePath::Leaves),
            ("masks/../../x.png", UnsafePath::Leaves),
            ("masks\\..\\x.png", UnsafePath::Leaves),
            ("/etc/passwd", UnsafePath::Absolute),
            ("\\\\server\\x.png", UnsafePath::Absolute),
            ("C:\\x.png", UnsafePath::Absolute),
            ("c:x.png", UnsafePath::Absolute),
            ("https://example.org/x.png", UnsafePath::Source),
            ("embedded://x.png", UnsafePath::Source),
            ("x.png:stream", UnsafePath::Source),
            ("x.gltf#Mesh0", UnsafePath::Source),
            ("masks\\x.png", UnsafePath::Backslash),
            ("masks/", UnsafePath::Step),
            ("masks//x.png", UnsafePath::Step),
            ("./x.png", UnsafePath::Step),
            ("x\0.png", UnsafePath::Step),
        ];
        for (text, why) in bad {
            assert_eq!(RelativePath::new(text), Err(why), "{text}");
        }
    }
}
