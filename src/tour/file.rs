//! The document as a whole, and what its paths are.
//!
//! One set of types serves twice: [`TourFile`] is anything that reads, its paths plain text; [`Document`] with its
//! default parameter is what a checked [`Tour`](super::Tour) holds, its paths safe.

use std::convert::Infallible;

use serde::{Deserialize, Serialize};

use super::annotation::{
    Background, Band, CameraNotes, GroundArea, Medium, PictureSource, Region, Scale, Sky, WaterArea,
};
use super::journey::CameraPath;
use super::object::{Motion, Object, Recorded};
use super::relative_path::RelativePath;
use super::weather::{RecordedSea, Sea, Waves, Wind};

/// The version of the format that this program writes.
pub const VERSION: u32 = 1;

/// What a tour file's name ends in.
pub const TOUR_ENDING: &str = ".tour.ron";

/// The camera's height above the water (or ground) when the document does not say: an adult's eyes, meters.
pub const ASSUMED_HEIGHT: f64 = 1.7;

/// The document as written: it reads, and nothing more is known of it.
pub type TourFile = Document<String>;

/// All that a tour's file says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Tour")]
pub struct Document<P = RelativePath> {
    /// The format's version, [`VERSION`]; 0 stands for a file that does not say.
    #[serde(default)]
    pub version: u32,
    /// The picture.
    pub picture: PictureSource<P>,
    /// What is known of the camera.
    #[serde(default, skip_serializing_if = "is_default")]
    pub camera: CameraNotes,
    /// The water, if there is any.
    #[serde(default = "none", skip_serializing_if = "Option::is_none")]
    pub water: Option<WaterArea<P>>,
    /// The ground, if there is any.
    #[serde(default = "none", skip_serializing_if = "Option::is_none")]
    pub ground: Option<GroundArea<P>>,
    /// What closes the scene.
    #[serde(default, skip_serializing_if = "Background::is_empty")]
    pub background: Background<P>,
    /// The sky, if it is a layer of its own.
    #[serde(default = "none", skip_serializing_if = "Option::is_none")]
    pub sky: Option<Sky<P>>,
    /// What stands in the scene.
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    pub objects: Vec<Object<P>>,
    /// The wind.
    #[serde(default, skip_serializing_if = "is_default")]
    pub wind: Wind,
    /// The waves.
    #[serde(default, skip_serializing_if = "Waves::is_default")]
    pub waves: Waves<P>,
    /// The camera's path, if it has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path: Option<CameraPath>,
}

/// Takes a path of the old kind, at a place of the document, to one of the new kind.
type PathMap<'a, P, Q, E> = dyn FnMut(&str, P) -> Result<Q, E> + 'a;

impl<P> Document<P> {
    /// An empty document about a picture: it still needs a horizon and water or ground.
    #[must_use]
    pub fn new(picture: P) -> Self {
        Self {
            version: VERSION,
            picture: PictureSource { file: picture, size: None, medium: Medium::default(), crop: None },
            camera: CameraNotes::default(),
            water: None,
            ground: None,
            background: Background::default(),
            sky: None,
            objects: Vec::new(),
            wind: Wind::default(),
            waves: Waves::default(),
            path: None,
        }
    }

    /// The length that sets the scale, and whether it is only assumed.
    #[must_use]
    pub fn scale(&self) -> (Scale, bool) {
        match &self.camera.scale {
            Some(scale) => (scale.clone(), false),
            None if self.water.is_some() => (Scale::HeightAboveWater(ASSUMED_HEIGHT), true),
            None => (Scale::HeightAboveGround(ASSUMED_HEIGHT), true),
        }
    }

    /// Every file that the document names, with the way to the place where it does.
    #[must_use]
    pub fn files(&self) -> Vec<(String, P)>
    where
        P: Clone,
    {
        let mut files = Vec::new();
        let Ok(_) = self.clone().map_paths(&mut |place, path| {
            files.push((place.to_owned(), path));
            Ok::<(), Infallible>(())
        });
        files
    }

    /// Which objects can leave their place, however they move, in the document's order. What only a game moves is not known
    /// here.
    #[must_use]
    pub fn movers(&self) -> Vec<bool> {
        self.objects.iter().map(|object| !object.motion.is_static()).collect()
    }

    /// The document without what only moves it (wind, waves, path, drift, motions, turning): all that maps
    /// depend on, besides the [movers](Self::movers).
    #[must_use]
    pub fn still(&self) -> Self
    where
        P: Clone,
    {
        let mut still = self.clone();
        (still.wind, still.waves, still.path) = (Wind::default(), Waves::default(), None);
        if let Some(sky) = &mut still.sky {
            sky.drift = None;
        }
        for object in &mut still.objects {
            (object.turns_to_camera, object.motion) = (false, Motion::Static);
        }
        still
    }

    /// The picture and the masks that maps are built from, each with the way to the place that names it.
    #[must_use]
    pub fn map_files(&self) -> Vec<(String, P)>
    where
        P: Clone,
    {
        self.still().files()
    }

    /// The same document with every path taken through `map`, which is told where the path stands; stops at its first
    /// error.
    pub(super) fn map_paths<Q, E>(self, map: &mut PathMap<'_, P, Q, E>) -> Result<Document<Q>, E> {
        let Self { version, picture, camera, water, ground, background, sky, objects, wind, waves, path } =
            self;
        let PictureSource { file, size, medium, crop } = picture;
        let picture = PictureSource { file: map("picture.file", file)?, size, medium, crop };
        let water = match water {
            Some(WaterArea { region, pairs }) => {
                Some(WaterArea { region: region.map("water.region", map)?, pairs })
            }
            None => None,
        };
        let ground = match ground {
            Some(GroundArea { region, height_above_water }) => {
                Some(GroundArea { region: region.map("ground.region", map)?, height_above_water })
            }
            None => None,
        };
        let mut bands = Vec::new();
        for (i, Band { name, region, place }) in background.bands.into_iter().enumerate() {
            let region =
                region.map(|region| region.map(&format!("background.bands[{i}].region"), map)).transpose()?;
            bands.push(Band { name, region, place });
        }
        let background = Background { place: background.place, bands };
        let sky = match sky {
            Some(Sky { region, drift }) => {
                Some(Sky { region: region.map(|region| region.map("sky.region", map)).transpose()?, drift })
            }
            None => None,
        };
        let mut mapped = Vec::new();
        for (i, object) in objects.into_iter().enumerate() {
            let Object { name, support, outline, contact, turns_to_camera, motion } = object;
            let outline = outline.map(&format!("objects[{i}].outline"), map)?;
            let motion = motion.map(&format!("objects[{i}].motion"), map)?;
            mapped.push(Object { name, support, outline, contact, turns_to_camera, motion });
        }
        let waves = Waves { sea: waves.sea.map("waves.sea", map)?, ripples: waves.ripples };
        Ok(Document {
            version,
            picture,
            camera,
            water,
            ground,
            background,
            sky,
            objects: mapped,
            wind,
            waves,
            path,
        })
    }
}

impl<P> Region<P> {
    fn map<Q, E>(self, place: &str, map: &mut PathMap<'_, P, Q, E>) -> Result<Region<Q>, E> {
        Ok(match self {
            Self::Polygon(corners) => Region::Polygon(corners),
            Self::Mask(file) => Region::Mask(map(place, file)?),
        })
    }
}

impl<P> Motion<P> {
    fn map<Q, E>(self, place: &str, map: &mut PathMap<'_, P, Q, E>) -> Result<Motion<Q>, E> {
        Ok(match self {
            Self::Static => Motion::Static,
            Self::Sway(sway) => Motion::Sway(sway),
            Self::Floating(floating) => Motion::Floating(floating),
            Self::Course(course) => Motion::Course(course),
            Self::Recorded(Recorded { poses, looped }) => {
                Motion::Recorded(Recorded { poses: map(&format!("{place}.poses"), poses)?, looped })
            }
        })
    }
}

impl<P> Sea<P> {
    fn map<Q, E>(self, place: &str, map: &mut PathMap<'_, P, Q, E>) -> Result<Sea<Q>, E> {
        Ok(match self {
            Self::Calm => Sea::Calm,
            Self::Octaves(octaves) => Sea::Octaves(octaves),
            Self::Jonswap(jonswap) => Sea::Jonswap(jonswap),
            Self::Recorded(RecordedSea { first, count, frames_per_second, height, area }) => {
                let first = map(&format!("{place}.first"), first)?;
                Sea::Recorded(RecordedSea { first, count, frames_per_second, height, area })
            }
        })
    }
}

/// Whether a value need not be written.
pub(super) fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// `None`, without asking that `P` has a default.
fn none<T>() -> Option<T> {
    None
}
