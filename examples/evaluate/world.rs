//! A world with known answers: `scene.json` and the files beside it, as a careful person would mark them.

use std::path::{Path, PathBuf};

use bevy_picture_tour::camera::CameraPose;
use bevy_picture_tour::picture::{Mask, Picture, PicturePoint, decode_mask, decode_picture};
use bevy_picture_tour::tour::{
    Background, BackgroundPlace, Band, Document, FocalLength, GroundArea, Motion, Object, ReflectionPair,
    Region, Scale, Support, Tour, WaterArea,
};
use glam::{DVec3, UVec2};
use serde_json::Value;

use super::Failure;

/// A rendering of the truth.
pub(super) struct View {
    pub file: String,
    pub water_mask: Option<String>,
    pub pose: CameraPose,
}

impl View {
    /// The file's name without folder and ending.
    pub(super) fn name(&self) -> String {
        Path::new(&self.file).file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
    }
}

pub(super) struct World {
    pub name: String,
    pub views: Vec<View>,
    folder: PathBuf,
    scene: Value,
    height: f64,
}

impl World {
    pub(super) fn open(folder: &Path) -> Result<Self, Failure> {
        let path = folder.join("scene.json");
        let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let scene: Value = serde_json::from_str(&text)?;
        let height = number(&scene["camera"]["height_above_water"])?;
        let mut views = Vec::new();
        for view in list(&scene["views"]) {
            views.push(View {
                file: text_of(&view["file"])?,
                water_mask: view["water_mask"].as_str().map(str::to_owned),
                pose: pose(view, height)?,
            });
        }
        let name = scene["name"].as_str().unwrap_or("world").to_owned();
        Ok(Self { name, views, folder: folder.to_owned(), scene, height })
    }

    pub(super) fn read(&self, file: &str) -> Result<Vec<u8>, String> {
        let path = self.folder.join(file);
        std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))
    }

    pub(super) fn picture(&self, file: &str) -> Result<Picture, Failure> {
        Ok(decode_picture(&self.read(file)?, file)?.picture)
    }

    pub(super) fn mask(&self, file: &str, size: UVec2) -> Result<Mask, Failure> {
        Ok(decode_mask(&self.read(file)?, file, size)?)
    }

    /// The true value of a solver's parameter.
    pub(super) fn truth(&self, parameter: &str) -> Option<f64> {
        let scene = &self.scene;
        match parameter {
            "focal_px" => scene["intrinsics"]["focal_px"].as_f64(),
            "pitch" => scene["camera"]["pitch_deg"].as_f64().map(f64::to_radians),
            "roll" => scene["camera"]["roll_deg"].as_f64().map(f64::to_radians),
            "height" => Some(self.height),
            "ground_height" => scene["height_above_ground"].as_f64().map(|above| self.height - above),
            "background_distance" => scene["background"]["distance"].as_f64(),
            _ => None,
        }
    }

    /// The tour that the annotations make, with one background or with its bands.
    pub(super) fn tour(&self, known_focal: bool, bands: bool) -> Result<Tour, Failure> {
        let scene = &self.scene;
        let picture = &scene["picture"];
        let mut tour = Document::new(text_of(&picture["file"])?);
        let [width, height] = [number(&picture["width"])?, number(&picture["height"])?];
        tour.picture.size = Some(UVec2::new(width as u32, height as u32));
        if let [left, right] = list(&scene["horizon"]) {
            tour.camera.horizon = Some([point(left)?, point(right)?]);
        }
        if known_focal {
            let lens = &scene["intrinsics"];
            tour.camera.focal_length = FocalLength::Known(number(&lens["focal_px"])?);
            tour.camera.principal_point = Some(PicturePoint::new(number(&lens["cx"])?, number(&lens["cy"])?));
        }
        tour.camera.scale = Some(match region(&scene["regions"]["water"]) {
            Some(_) => Scale::HeightAboveWater(self.height),
            None => Scale::HeightAboveGround(scene["height_above_ground"].as_f64().unwrap_or(self.height)),
        });
        // Family B tells where the background's bands stand; its pairs without an object lie on any of them.
        let banded = !list(&scene["background"]["bands"]).is_empty();
        if let Some(region) = region(&scene["regions"]["water"]) {
            let mut pairs = Vec::new();
            for (i, pair) in list(&scene["pairs"]).iter().enumerate() {
                let on = pair["on"].as_str().map(str::to_owned);
                let behind = !banded && pair["object"].as_str().is_none_or(|object| object == "background");
                pairs.push(ReflectionPair {
                    point: point(&pair["point"])?,
                    reflection: point(&pair["reflection"])?,
                    on: on.or_else(|| behind.then(|| "background".to_owned())),
                    name: pair["object"].as_str().map(|object| format!("pair {} ({object})", i + 1)),
                });
            }
            tour.water = Some(WaterArea { region, pairs });
        }
        // What stands on a ground that the picture does not show stands on it all the same: its region lies outside.
        let unseen = || {
            let corners = [(-9.0, -9.0), (-5.0, -9.0), (-5.0, -5.0)].map(|(x, y)| PicturePoint::new(x, y));
            let needed = list(&scene["objects"]).iter().any(|object| object["support"] == "ground");
            needed.then(|| Region::Polygon(corners.into()))
        };
        if let Some(region) = region(&scene["regions"]["ground"]).or_else(unseen) {
            let above = scene["height_above_ground"].as_f64().unwrap_or(self.height);
            tour.ground = Some(GroundArea { region, height_above_water: (self.height - above).max(0.0) });
        }
        let no_pair_behind = !list(&scene["pairs"]).iter().any(|pair| pair["on"].is_null());
        if banded || no_pair_behind {
            let foot = list(&scene["background"]["foot_image_line"]);
            let line = if foot.len() >= 2 { foot } else { list(&scene["waterline"]) };
            let mut shore = line.iter().map(point).collect::<Result<Vec<_>, _>>()?;
            if let Some([a, b]) = tour.camera.horizon {
                // What reaches up to the horizon tells no distance.
                let rise = (b.y() - a.y()) / (b.x() - a.x());
                shore.retain(|point| point.y() > a.y() + rise * (point.x() - a.x()) + 1.0);
            }
            if shore.len() >= 2 {
                tour.background.place = Some(BackgroundPlace::Contact(shore));
            }
        }
        if bands {
            self.bands(&mut tour.background)?;
        }
        for object in list(&scene["objects"]) {
            let contact = list(&object["contact"]);
            let [left, right] = contact else { return Err("an object's contact needs two points".into()) };
            tour.objects.push(Object {
                name: text_of(&object["name"])?,
                support: if object["support"] == "ground" { Support::Ground } else { Support::Water },
                outline: Region::Mask(text_of(&object["mask"])?),
                contact: [point(left)?, point(right)?],
                turns_to_camera: false,
                motion: Motion::Static,
            });
        }
        Ok(Tour::check(tour)?)
    }

    /// The background's bands: those with a mask, and the nearest of the others for all that remains (mountains under
    /// a sky that no mask tells apart).
    fn bands(&self, background: &mut Background<String>) -> Result<(), Failure> {
        let bands = list(&self.scene["background"]["bands"]);
        let place = |band: &Value| {
            band["distance"].as_f64().map_or(BackgroundPlace::Infinity, BackgroundPlace::Distance)
        };
        let masked = |band: &&Value| band["mask"].is_string();
        let named = |band: &Value, region| -> Result<Band<String>, Failure> {
            Ok(Band { name: text_of(&band["name"])?, region, place: place(band) })
        };
        for band in bands.iter().filter(masked) {
            let mask = text_of(&band["mask"])?;
            background.bands.push(named(band, Some(Region::Mask(mask)))?);
        }
        if background.bands.is_empty() {
            return Ok(());
        }
        if let Some(rest) = bands.iter().find(|band| !masked(band)) {
            background.bands.push(named(rest, None)?);
        }
        background.place = None;
        Ok(())
    }
}

/// A region's mask, unless it is empty.
fn region(value: &Value) -> Option<Region<String>> {
    let empty = value["empty"].as_bool().unwrap_or(false);
    value["mask"].as_str().filter(|_| !empty).map(|mask| Region::Mask(mask.to_owned()))
}

fn pose(value: &Value, height: f64) -> Result<CameraPose, Failure> {
    let [x, y, z] = list(&value["position"]) else { return Err("a position needs three numbers".into()) };
    // The world's origin is the camera; ours is the water below it.
    let position = DVec3::new(number(x)?, number(y)? + height, number(z)?);
    let angle = |name: &str| number(&value[name]).map(f64::to_radians);
    Ok(CameraPose::from_angles(position, angle("yaw_deg")?, angle("pitch_deg")?, angle("roll_deg")?))
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn number(value: &Value) -> Result<f64, Failure> {
    value.as_f64().ok_or_else(|| format!("{value} should be a number").into())
}

fn text_of(value: &Value) -> Result<String, Failure> {
    value.as_str().map(str::to_owned).ok_or_else(|| format!("{value} should be a text").into())
}

fn point(value: &Value) -> Result<PicturePoint, Failure> {
    match list(value) {
        [x, y] => Ok(PicturePoint::new(number(x)?, number(y)?)),
        _ => Err(format!("{value} should be a point").into()),
    }
}
