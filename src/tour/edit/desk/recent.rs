//! The files that were opened last, newest first.
//!
//! A small RON list in a folder of the program's settings. It is a convenience: a list that is missing or broken is an
//! empty one.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::tour::write_whole;

/// How many files are remembered.
pub const MOST_RECENT: usize = 12;

const NAME: &str = "recent.ron";

/// The list in a folder.
#[derive(Clone, Debug)]
pub struct Recent {
    folder: PathBuf,
}

impl Recent {
    /// The list that is kept in `folder`, which need not be there yet.
    #[must_use]
    pub fn in_folder(folder: &Path) -> Self {
        Self { folder: folder.to_owned() }
    }

    /// The files that are still there, newest first, at most [`MOST_RECENT`].
    #[must_use]
    pub fn files(&self) -> Vec<PathBuf> {
        let mut files = self.all();
        files.retain(|file| file.is_file());
        files
    }

    /// Puts a file first and writes the list.
    ///
    /// # Errors
    /// When the folder cannot be made or written to; the list is then as it was.
    pub fn add(&self, file: &Path) -> io::Result<()> {
        // Another window may have written meanwhile, so the list is read anew.
        let file = file.canonicalize()?;
        let mut files = self.all();
        files.retain(|other| *other != file);
        files.insert(0, file);
        files.truncate(MOST_RECENT);
        // A path that is no Unicode text cannot stand in a text file.
        let names: Vec<&str> = files.iter().filter_map(|file| file.to_str()).collect();
        let text =
            ron::ser::to_string_pretty(&names, ron::ser::PrettyConfig::new()).map_err(io::Error::other)?;
        fs::create_dir_all(&self.folder)?;
        write_whole(&self.folder.join(NAME), text.as_bytes())
    }

    fn all(&self) -> Vec<PathBuf> {
        let text = fs::read_to_string(self.folder.join(NAME)).unwrap_or_default();
        ron::from_str(&text).unwrap_or_default()
    }
}
