#![doc = include_str!("README.md")]

mod annotation;
mod check;
pub mod edit;
mod file;
mod fit;
pub(crate) mod geometry;
mod journey;
mod known_fields;
mod locate;
mod object;
mod problem;
mod read;
mod relative_path;
mod save;
mod template;
mod weather;

pub use crate::camera::Easing;
pub use annotation::{
    Background, BackgroundPlace, Band, CameraNotes, Crop, Drift, FocalLength, GroundArea, Medium, Method,
    PictureSource, ReflectionPair, Region, Scale, Sky, WaterArea,
};
pub use file::{ASSUMED_HEIGHT, Document, TourFile, VERSION};
pub use journey::{CameraPath, Keyframe};
pub use object::{Course, Floating, Motion, Object, Recorded, Support, Sway, SwayKind, Waypoint};
pub use problem::{Place, Problem, Problems};
pub use relative_path::{RelativePath, UnsafePath};
pub(crate) use save::write_whole;
pub use weather::{Jonswap, MOST_FRAMES, Octaves, RecordedSea, Sea, Waves, Wind};

use std::convert::Infallible;
use std::io;
use std::ops::Deref;
use std::path::Path;

use ron::ser::PrettyConfig;

use crate::picture::PicturePoint;

/// A checked document: all its values are sound and its paths stay in its folder.
///
/// It derefs to its [`Document`], so `tour.objects` reads. To change it, take [`to_file`](Self::to_file), change that, and
/// [`check`](Self::check) it.
#[derive(Clone, Debug, PartialEq)]
pub struct Tour(Document);

/// What carries a reflection pair's point, resolved from its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carrier {
    /// The object of this index.
    Object(usize),
    /// The background band of this index.
    Band(usize),
    /// The background as a whole.
    Background,
}

impl Tour {
    /// Reads the text of a tour file.
    ///
    /// # Errors
    /// This returns every problem found, each with its line and column: text that is not RON, a newer version, unknown
    /// fields, values that are wrong or contradict each other, paths that leave the folder. After a value that does not
    /// read at all (a text where a number belongs) nothing further is known of the file.
    pub fn read(text: &str) -> Result<Self, Problems> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let (file, mut problems) = read::read(text);
        match file.map(Self::check) {
            Some(Ok(tour)) if problems.is_empty() => return Ok(tour),
            Some(Err(Problems(more))) => problems.extend(more),
            Some(Ok(_)) | None => {}
        }
        read::locate_all(text, &mut problems);
        Err(Problems(problems))
    }

    /// Checks a document, also one built in code.
    ///
    /// # Errors
    /// This returns every problem found, without lines; see [`read`](Self::read).
    pub fn check(file: TourFile) -> Result<Self, Problems> {
        let problems = check::problems(&file);
        if !problems.is_empty() {
            return Err(Problems(problems));
        }
        file.map_paths(&mut |place, text| check::safe_path(place, &text)).map(Self)
    }

    /// The document as it would be written.
    #[must_use]
    pub fn to_file(&self) -> TourFile {
        let Ok(file) = self.0.clone().map_paths(&mut |_, path| Ok::<_, Infallible>(path.to_string()));
        file
    }

    /// The text of the tour's file; reading it gives an equal tour.
    #[must_use]
    pub fn write(&self) -> String {
        // Every type here has a form in RON, so this does not fail.
        self.text().unwrap_or_default()
    }

    fn text(&self) -> ron::Result<String> {
        let config = PrettyConfig::new().new_line("\n").indentor("  ");
        Ok(read::options().to_string_pretty(&self.0, config)? + "\n")
    }

    /// Writes the tour's file whole or not at all. A link stays a link to the file it names.
    ///
    /// # Errors
    /// This returns an error when the folder cannot be written to or the disk is full; an older file then stays as it was.
    pub fn save(&self, path: &Path) -> io::Result<()> {
        let text = self.text().map_err(io::Error::other)?;
        write_whole(path, text.as_bytes())
    }

    /// What a pair's point is on, if the pair says.
    #[must_use]
    pub fn carrier(&self, pair: &ReflectionPair) -> Option<Carrier> {
        let name = pair.on.as_deref()?;
        let object = self.objects.iter().position(|object| object.name == name).map(Carrier::Object);
        let band = || self.background.bands.iter().position(|band| band.name == name).map(Carrier::Band);
        object.or_else(band).or((name == "background").then_some(Carrier::Background))
    }

    /// The pairs whose reflection is not on water, for a water region that is a mask.
    ///
    /// `coverage` tells how much of a picture point is water, 0 to 1; below 0.5 is dry land. Polygons are checked when the
    /// tour is.
    #[must_use]
    pub fn dry_reflections(&self, coverage: &dyn Fn(PicturePoint) -> f32) -> Vec<Problem> {
        self.water.as_ref().map_or_else(Vec::new, |water| check::dry_reflections(&water.pairs, coverage))
    }
}

impl Deref for Tour {
    type Target = Document;

    fn deref(&self) -> &Document {
        &self.0
    }
}

impl TryFrom<TourFile> for Tour {
    type Error = Problems;

    fn try_from(file: TourFile) -> Result<Self, Problems> {
        Self::check(file)
    }
}

#[cfg(test)]
mod tests;
