//! Checks of picture, camera, water, ground, background and sky.

use glam::UVec2;

use crate::picture::PicturePoint;

use super::super::annotation::{BackgroundPlace, Crop, FocalLength, ReflectionPair, Region, Scale};
use super::super::geometry;
use super::super::problem::{Problem, nearest};
use super::Check;

/// The largest side of a picture, pixels.
const LARGEST_SIDE: u32 = 65_535;

/// Focal lengths beyond these are slips, pixels.
const FOCAL_PX: std::ops::RangeInclusive<f64> = 1.0..=1e6;

/// Lengths that set the scale, meters.
const SCALE_METERS: std::ops::RangeInclusive<f64> = 1e-3..=1e5;

/// More bands than depths can be told apart by.
const MOST_BANDS: usize = 16;

impl Check<'_> {
    pub(super) fn picture(&mut self) {
        let picture = &self.file.picture;
        let sound = |size: &UVec2| size.min_element() > 0 && size.max_element() <= LARGEST_SIDE;
        if let Some(size) = picture.size.filter(|size| !sound(size)) {
            let advice =
                format!("write the picture's width and height in pixels, each from 1 to {LARGEST_SIDE}");
            let value = format!("({}, {})", size.x, size.y);
            self.report("picture.size", value, "no picture has this size", advice);
        }
        self.problems.extend(crop_problem(picture.crop, picture.size.filter(sound)));
    }

    pub(super) fn camera(&mut self) {
        let camera = &self.file.camera;
        if let Some(ends) = camera.horizon {
            let mut sound = true;
            for (i, end) in ends.iter().enumerate() {
                sound &= self.point(format!("camera.horizon[{i}]"), *end);
            }
            if sound && self.horizon.is_none() {
                let [a, b] = ends;
                let message = if a == b {
                    "the horizon's two points are the same"
                } else {
                    "the horizon is nearly vertical"
                };
                self.report(
                    "camera.horizon",
                    format!("({a}, {b})"),
                    message,
                    "mark one point at the left and one at the right",
                );
            }
        } else if self.file.water.as_ref().is_none_or(|water| water.pairs.len() < 2) {
            let message = "there are neither a horizon nor two reflection pairs, so nothing tells how the camera looked";
            self.report(
                "camera.horizon",
                "",
                message,
                "mark the horizon, as `horizon: ((0, 480), (1920, 480))`",
            );
        }
        if let Some(point) = camera.principal_point {
            self.point("camera.principal_point", point);
        }
        match camera.focal_length {
            FocalLength::Known(focal) => {
                self.number("camera.focal_length.Known", focal, FOCAL_PX, "pixels");
            }
            FocalLength::Between(least, most) => {
                let sound = self.number("camera.focal_length", least, FOCAL_PX, "pixels")
                    & self.number("camera.focal_length", most, FOCAL_PX, "pixels");
                if sound && least >= most {
                    let value = format!("Between({least}, {most})");
                    self.report(
                        "camera.focal_length",
                        value,
                        "the first number is not below the second",
                        format!("write `Between({most}, {least})` or `Known({most})`"),
                    );
                }
            }
            FocalLength::Exif | FocalLength::Unknown => {}
        }
        self.scale();
    }

    fn scale(&mut self) {
        match &self.file.camera.scale {
            None => {}
            Some(Scale::HeightAboveWater(meters)) => {
                let sound = self.number("camera.scale", *meters, SCALE_METERS, "meters");
                if self.file.water.is_none() {
                    self.report(
                        "camera.scale",
                        meters,
                        "the scale is a height above water, but there is no `water`",
                        "write `HeightAboveGround(…)`, or mark the water",
                    );
                } else if sound
                    && let Some(ground) = &self.file.ground
                    && ground.height_above_water >= *meters
                {
                    let message = format!(
                        "the ground lies {} m above the water, the camera only {meters} m: it would be buried",
                        ground.height_above_water
                    );
                    self.report(
                        "ground.height_above_water",
                        ground.height_above_water,
                        message,
                        "write the ground's height above the water, less than the camera's",
                    );
                }
            }
            Some(Scale::HeightAboveGround(meters)) => {
                self.number("camera.scale", *meters, SCALE_METERS, "meters");
            }
            Some(Scale::Length { on, from, to, meters }) => {
                self.number("camera.scale.meters", *meters, SCALE_METERS, "meters");
                let sound = self.point("camera.scale.from", *from) & self.point("camera.scale.to", *to);
                if sound && from == to {
                    self.report(
                        "camera.scale.to",
                        to,
                        "both ends of the length are the same point",
                        "mark the two ends of something whose length is known",
                    );
                }
                let names: Vec<&str> = self.file.objects.iter().map(|object| object.name.as_str()).collect();
                self.name("camera.scale.on", on, &names, "object");
            }
        }
    }

    /// Checks that a name is one of those known.
    fn name(&mut self, path: impl Into<String>, name: &str, known: &[&str], what: &str) {
        if known.contains(&name) {
            return;
        }
        let advice = match nearest(name, known.iter().copied()) {
            Some(meant) => format!("write \"{meant}\", the nearest known name"),
            None if known.is_empty() => "leave it out, or add the object".to_owned(),
            None => format!(
                "write one of {}",
                known.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")
            ),
        };
        self.report(path, format!("{name:?}"), format!("there is no {what} of this name"), advice);
    }

    pub(super) fn water(&mut self) {
        let Some(water) = &self.file.water else {
            if self.file.ground.is_none() {
                self.report(
                    "",
                    "",
                    "there is neither water nor ground to stand on",
                    "mark the water: `water: (region: Polygon([…]))` or `Mask(\"masks/water.png\")`",
                );
            }
            return;
        };
        self.region("water.region", &water.region);
        let names = self.file.objects.iter().map(|object| object.name.as_str());
        let bands = self.file.background.bands.iter().map(|band| band.name.as_str());
        let carriers: Vec<&str> = names.chain(bands).chain(["background"]).collect();
        for (i, pair) in water.pairs.iter().enumerate() {
            let path = format!("water.pairs[{i}]");
            if let Some(on) = &pair.on {
                self.name(format!("{path}.on"), on, &carriers, "object or background band");
            }
            if self.point(format!("{path}.point"), pair.point)
                & self.point(format!("{path}.reflection"), pair.reflection)
            {
                self.pair(&path, pair);
            }
        }
        if let Region::Polygon(corners) = &water.region
            && corners.len() >= 3
        {
            let wet = |point| if geometry::contains(corners, point) { 1.0 } else { 0.0 };
            for problem in dry_reflections(&water.pairs, &wet) {
                // A reflection in the sky is not also told to be on dry land.
                if !self.problems.iter().any(|other| other.place.path == problem.place.path) {
                    self.problems.push(problem);
                }
            }
        }
    }

    fn pair(&mut self, path: &str, pair: &ReflectionPair) {
        let ReflectionPair { point, reflection, .. } = pair;
        let place = format!("{path}.reflection");
        if !self.below_horizon(place.as_str(), *reflection, "the reflection") {
            return;
        }
        let lower = match self.horizon {
            Some(horizon) => horizon.below(*reflection) - horizon.below(*point),
            None => reflection.y() - point.y(),
        };
        if lower <= 0.0 {
            let message = format!("the reflection lies {:.1} px above its point {point}", -lower);
            self.report(
                place,
                reflection,
                message,
                "exchange `point` and `reflection`, or mark the reflection again",
            );
        }
    }

    pub(super) fn ground(&mut self) {
        if let Some(ground) = &self.file.ground {
            self.region("ground.region", &ground.region);
            self.number("ground.height_above_water", ground.height_above_water, 0.0..=1e4, "meters");
        } else if matches!(self.file.camera.scale, Some(Scale::HeightAboveGround(_))) {
            self.report(
                "camera.scale",
                "",
                "the scale is a height above the ground, but there is no `ground`",
                "write `HeightAboveWater(…)`, or mark the ground",
            );
        }
    }

    pub(super) fn background(&mut self) {
        let background = &self.file.background;
        if let Some(place) = &background.place {
            self.background_place("background.place", place);
        }
        if background.bands.len() > MOST_BANDS {
            self.report(
                "background.bands",
                background.bands.len(),
                "these are more bands than a background can be cut into",
                format!("join some; {MOST_BANDS} at most"),
            );
        }
        let mut rest: Option<&str> = None;
        for (i, band) in background.bands.iter().enumerate() {
            let path = format!("background.bands[{i}]");
            match (&band.region, rest) {
                (Some(region), _) => self.region(&format!("{path}.region"), region),
                (None, None) => rest = Some(&band.name),
                (None, Some(first)) => {
                    let message = format!(
                        "two bands have no region, this one and \"{first}\"; only one can be the rest"
                    );
                    self.report(
                        path.as_str(),
                        format!("{:?}", band.name),
                        message,
                        "give one of them a `region`",
                    );
                }
            }
            self.background_place(&format!("{path}.place"), &band.place);
        }
    }

    fn background_place(&mut self, path: &str, place: &BackgroundPlace) {
        match place {
            BackgroundPlace::Distance(meters) => {
                self.number(path, *meters, 0.01..=1e6, "meters");
            }
            BackgroundPlace::Contact(points) => {
                self.contact_line(&format!("{path}.Contact"), points, "the contact line");
            }
            BackgroundPlace::Infinity => {}
        }
    }

    pub(super) fn sky(&mut self) {
        let Some(sky) = &self.file.sky else { return };
        if let Some(region) = &sky.region {
            self.region("sky.region", region);
        }
        if let Some(drift) = sky.drift {
            self.number("sky.drift.speed", drift.speed, 0.0..=100.0, "pixels per second");
            self.number("sky.drift.direction_deg", drift.direction_deg, -360.0..=360.0, "degrees");
        }
    }
}

/// The problem of a crop that does not fit a picture of this size, if it is known.
pub(in crate::tour) fn crop_problem(crop: Option<Crop>, size: Option<UVec2>) -> Option<Problem> {
    let crop = crop?;
    let value = format!("left {}, top {}, width {}, height {}", crop.left, crop.top, crop.width, crop.height);
    if crop.width == 0 || crop.height == 0 {
        return Some(Problem::new(
            "picture.crop",
            value,
            "the crop keeps nothing",
            "write a width and height above 0",
        ));
    }
    let size = size?;
    let outside = u64::from(crop.left) + u64::from(crop.width) > u64::from(size.x)
        || u64::from(crop.top) + u64::from(crop.height) > u64::from(size.y);
    outside.then(|| {
        let message = format!("the crop reaches beyond the picture's {} × {} pixels", size.x, size.y);
        Problem::new(
            "picture.crop",
            value,
            message,
            "write left + width and top + height within the picture's size",
        )
    })
}

/// The pairs whose reflection is not on water; `coverage` tells how much of a point is water, 0 to 1.
pub(in crate::tour) fn dry_reflections(
    pairs: &[ReflectionPair],
    coverage: &dyn Fn(PicturePoint) -> f32,
) -> Vec<Problem> {
    let dry = |(i, pair): (usize, &ReflectionPair)| {
        (coverage(pair.reflection) < 0.5).then(|| {
            Problem::new(
                format!("water.pairs[{i}].reflection"),
                pair.reflection,
                "the reflection lies on dry land, outside the water region",
                "mark it where the water shows it, or correct `water.region`",
            )
        })
    };
    pairs.iter().enumerate().filter_map(dry).collect()
}
