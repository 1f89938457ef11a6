//! A tour with its files read: picture and masks decoded, checked against each other, cropped.

use std::path::{Path, PathBuf};

use glam::{DVec2, UVec2};

use crate::motion::Recordings;
use crate::picture::DecodedPicture;
use crate::picture::Lens;
use crate::picture::Mask;
use crate::picture::Picture;
use crate::picture::PictureError;
use crate::picture::PicturePoint;
use crate::picture::PixelRect;
use crate::picture::decode_mask;
use crate::picture::decode_picture;
use crate::tour::Problem;
use crate::tour::Problems;
use crate::tour::Region;
use crate::tour::RelativePath;
use crate::tour::Tour;

/// The most pixels that maps are built from: each takes some hundred bytes while they are.
const MOST_PIXELS: u64 = 64_000_000;

/// How far beside the water a reflection may be marked, as a share of the picture's width.
const MARK_SHARE: f64 = 0.002;

/// A tour and the pixels it speaks of; picture, masks and numbers all refer to the part that is used.
#[derive(Clone, Debug)]
pub struct TourSource {
    /// The tour in pixels of [`Self::picture`].
    pub tour: Tour,
    /// The picture, cropped.
    pub picture: Picture,
    /// Its size before the crop.
    pub uncropped_size: UVec2,
    /// What the file says about the lens.
    pub lens: Option<Lens>,
    /// Visible water.
    pub water: Option<Mask>,
    /// Visible ground.
    pub ground: Option<Mask>,
    /// Visible coverage of each object, in the tour's order.
    pub objects: Vec<Mask>,
    /// Visible coverage of each of the background's bands that has a region, in the tour's order.
    pub bands: Vec<Option<Mask>>,
    /// The visible sky, if it has a region.
    pub sky: Option<Mask>,
    /// Frames and poses that drive water and bodies.
    pub recordings: Recordings,
    /// What was put right while reading (a broken color profile, say).
    pub notes: Vec<String>,
}

impl TourSource {
    /// Reads and checks the files of a tour; `read` gets a path relative to the tour's folder.
    ///
    /// # Errors
    ///
    /// All problems at once: files that cannot be read or decoded, masks of another size or without any coverage, a
    /// picture of another shape than the tour says, reflections on dry land, recordings that cannot be used.
    pub fn read(
        tour: &Tour,
        read: &dyn Fn(&RelativePath) -> Result<Vec<u8>, String>,
    ) -> Result<Self, Problems> {
        Self::with_recordings(tour, Recordings::read(tour, read), read)
    }

    /// The same with recordings that were read before; `read` is asked for the [other files](crate::tour::Document::map_files) only.
    ///
    /// # Errors
    ///
    /// As [`read`](Self::read), the recordings' problems last.
    pub fn with_recordings(
        tour: &Tour,
        recordings: Result<Recordings, Problems>,
        read: &dyn Fn(&RelativePath) -> Result<Vec<u8>, String>,
    ) -> Result<Self, Problems> {
        match (Self::read_maps(tour, read), recordings) {
            (Ok(mut source), Ok(recordings)) => {
                source.notes.extend(recordings.notes.iter().cloned());
                Ok(Self { recordings, ..source })
            }
            (Err(problems), Ok(_)) | (Ok(_), Err(problems)) => Err(problems),
            (Err(Problems(mut problems)), Err(more)) => {
                problems.extend(more.0);
                Err(Problems(problems))
            }
        }
    }

    /// The same without recordings.
    fn read_maps(
        tour: &Tour,
        read: &dyn Fn(&RelativePath) -> Result<Vec<u8>, String>,
    ) -> Result<Self, Problems> {
        let load = |place: &str, file: &RelativePath| {
            read(file).map_err(|error| {
                Box::new(Problem::new(
                    place,
                    format!("\"{}\"", file.as_str()),
                    format!("the file cannot be read: {error}"),
                    "put the file beside the tour, or write the path it has, relative to the tour's folder",
                ))
            })
        };
        let file = &tour.picture.file;
        let bytes = load("picture.file", file).map_err(|problem| *problem)?;
        let decoded = decode_picture(&bytes, file.as_str())
            .map_err(|error| from_picture_error("picture.file", file.as_str(), &error))?;
        let size = decoded.picture.size();
        Self::of(tour, decoded, &|place, file| {
            let bytes = load(place, file)?;
            decode_mask(&bytes, file.as_str(), size)
                .map_err(|error| Box::new(from_picture_error(place, file.as_str(), &error)))
        })
    }

    /// The same of a picture and masks that are in memory, without recordings; `mask` gets the place in the document and the mask's path.
    ///
    /// # Errors
    ///
    /// As [`read`](Self::read), and what `mask` says.
    pub fn of(
        tour: &Tour,
        decoded: DecodedPicture,
        mask: &dyn Fn(&str, &RelativePath) -> Result<Mask, Box<Problem>>,
    ) -> Result<Self, Problems> {
        let file = &tour.picture.file;
        let size = decoded.picture.size();
        tour.check_size(size)?;

        if u64::from(size.x) * u64::from(size.y) > MOST_PIXELS {
            return Err(Problem::new(
                "picture.file",
                format!("\"{}\"", file.as_str()),
                format!("{} × {} pixels are more than a tour is built from", size.x, size.y),
                format!(
                    "scale it down to {} megapixels at most; the tour's numbers may stay",
                    MOST_PIXELS / 1_000_000
                ),
            )
            .into());
        }
        let crop = tour.crop_in(size);
        let low = UVec2::new(crop.left, crop.top);
        let rect = PixelRect { min: low, max: low + UVec2::new(crop.width, crop.height) };
        let used = tour.in_pixels_of(size);
        let mut problems = Vec::new();
        let mut region = |place: &str, whole: &Region, used: &Region| match (whole, used) {
            (Region::Mask(file), _) => {
                let mask = mask(place, file);
                // One that was drawn on the same picture at another size.
                let mask = mask.map(|mask| if mask.size() == size { mask } else { mask.resized_to(size) });
                mask.map(|mask| cropped(&mask, rect)).map_err(|problem| problems.push(*problem)).ok()
            }
            (_, Region::Polygon(corners)) => Mask::from_polygon(rect.size(), corners)
                .map_err(|error| problems.push(from_picture_error(place, "the polygon", &error)))
                .ok(),
            (Region::Polygon(_), Region::Mask(_)) => None,
        };
        let water = tour.water.as_ref().zip(used.water.as_ref());
        let water = water.and_then(|(whole, used)| region("water.region", &whole.region, &used.region));
        let ground = tour.ground.as_ref().zip(used.ground.as_ref());
        let ground = ground.and_then(|(whole, used)| region("ground.region", &whole.region, &used.region));
        let objects: Vec<Option<Mask>> = tour
            .objects
            .iter()
            .zip(&used.objects)
            .enumerate()
            .map(|(i, (whole, used))| region(&format!("objects[{i}].outline"), &whole.outline, &used.outline))
            .collect();
        let bands: Vec<Option<Mask>> = tour
            .background
            .bands
            .iter()
            .zip(&used.background.bands)
            .enumerate()
            .map(|(i, (whole, used))| {
                let (whole, used) = whole.region.as_ref().zip(used.region.as_ref())?;
                region(&format!("background.bands[{i}].region"), whole, used)
            })
            .collect();
        let sky = tour.sky.as_ref().zip(used.sky.as_ref()).and_then(|(whole, used)| {
            let (whole, used) = whole.region.as_ref().zip(used.region.as_ref())?;
            region("sky.region", whole, used)
        });
        for (i, mask) in objects.iter().enumerate() {
            if mask.as_ref().is_some_and(|mask| mask.bounds().is_none()) {
                problems.push(Problem::new(
                    format!("objects[{i}].outline"),
                    format!("\"{}\"", tour.objects[i].name),
                    "the outline covers nothing of the picture",
                    "draw it around the object, or check that the mask is light where the object is",
                ));
            }
        }
        if let Some(mask) = &water {
            // A mark may be off by a pixel or two of a picture of usual size.
            let off = (MARK_SHARE * f64::from(rect.size().x)).round() as i32;
            let wet = |point: PicturePoint| {
                let around =
                    (-off..=off).flat_map(|y| (-off..=off).map(move |x| DVec2::new(x.into(), y.into())));
                around.map(|step| mask.sample(PicturePoint(point.0 + step))).fold(0.0, f32::max)
            };
            problems.extend(used.dry_reflections(&wet));
        }
        if !problems.is_empty() {
            return Err(Problems(problems));
        }
        let outside = || {
            Problem::new(
                "picture.crop",
                format!("{crop:?}"),
                "it lies outside the picture",
                "write one inside",
            )
        };
        let picture = decoded.picture.crop(rect).ok_or_else(outside)?;
        Ok(Self {
            picture,
            tour: used,
            uncropped_size: size,
            lens: decoded.lens,
            water,
            ground,
            objects: objects.into_iter().flatten().collect(),
            bands,
            sky,
            recordings: Recordings::default(),
            notes: decoded.notes,
        })
    }

    /// Opens a tour file of the file system.
    ///
    /// # Errors
    ///
    /// All problems of the document, or else all of its files; each names the file.
    pub fn open(path: &Path) -> Result<Self, Problems> {
        TourOnDisk::open(path)?.source()
    }
}

/// A tour file of the file system, read and checked; its picture, masks and recordings are not read yet.
#[derive(Clone, Debug)]
pub struct TourOnDisk {
    /// The tour as its file says it.
    pub tour: Tour,
    name: String,
    text: String,
    folder: PathBuf,
}

impl TourOnDisk {
    /// Reads and checks the document.
    ///
    /// # Errors
    ///
    /// All problems of the document; each names the file.
    pub fn open(path: &Path) -> Result<Self, Problems> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|error| {
            Problems::from(Problem::new(
                "",
                "",
                format!("the tour cannot be read: {error}"),
                "check the path; `picture-tour new PICTURE` writes a tour to start from",
            ))
            .with_file(&name)
        })?;
        let tour = Tour::read(&text).map_err(|problems| problems.with_file(&name))?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        Ok(Self { tour, name, text, folder })
    }

    /// The bytes of a file that the tour names.
    ///
    /// # Errors
    ///
    /// Why it cannot be read, with its path.
    pub fn read(&self, file: &RelativePath) -> Result<Vec<u8>, String> {
        read_beside(&self.folder, file)
    }

    /// The tour with its picture, masks and recordings.
    ///
    /// # Errors
    ///
    /// All problems of its files; each names the tour's file.
    pub fn source(&self) -> Result<TourSource, Problems> {
        TourSource::read(&self.tour, &|file| self.read(file)).map_err(|problems| self.placed(problems))
    }

    /// Its recordings alone, for a tour whose maps are baked.
    ///
    /// # Errors
    ///
    /// All problems of their files; each names the tour's file.
    pub fn recordings(&self) -> Result<Recordings, Problems> {
        Recordings::read(&self.tour, &|file| self.read(file)).map_err(|problems| self.placed(problems))
    }

    fn placed(&self, problems: Problems) -> Problems {
        problems.located_in(&self.text).with_file(&self.name)
    }
}

/// The bytes of a file that a tour in `folder` names.
pub(crate) fn read_beside(folder: &Path, file: &RelativePath) -> Result<Vec<u8>, String> {
    let path = file.in_folder(folder);
    read_inside(folder, &path).map_err(|error| format!("{}: {error}", path.display()))
}

/// Reads a file unless links lead it out of the folder.
fn read_inside(folder: &Path, path: &Path) -> std::io::Result<Vec<u8>> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let (folder, path) = (folder.canonicalize()?, path.canonicalize()?);
    if !path.starts_with(folder) {
        return Err(std::io::Error::other("a link leads it out of the tour's folder"));
    }
    std::fs::read(path)
}

fn from_picture_error(place: &str, file: &str, error: &PictureError) -> Problem {
    Problem::new(place, format!("\"{file}\""), error.to_string(), "")
}

/// The part of a mask inside `rect`.
fn cropped(mask: &Mask, rect: PixelRect) -> Mask {
    let values = (rect.min.y..rect.max.y)
        .flat_map(|y| (rect.min.x..rect.max.x).map(move |x| (x, y)))
        .map(|(x, y)| mask.get(x, y))
        .collect();
    // The count is right by construction.
    Mask::new(rect.size(), values).unwrap_or_else(|_| mask.clone())
}
