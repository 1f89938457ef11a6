//! Whether all numbers of a value are finite, and its picture points within reach of the picture.
//!
//! Every field is named here, so that a new one cannot be forgotten. Ranges are the document's checks
//! ([`Tour::check`](crate::tour::Tour::check)); while editing a number may be out of its range.

use glam::{DVec2, DVec3};

use crate::picture::PicturePoint;
use crate::tour::{
    BackgroundPlace, Band, CameraPath, Course, Drift, Floating, FocalLength, GroundArea, Jonswap, Keyframe,
    Motion, Object, Octaves, Recorded, RecordedSea, ReflectionPair, Region, Scale, Sea, Sky, Sway, WaterArea,
    Waves, Waypoint, Wind,
};

/// Picture points may lie outside the frame, but not further than this, pixels: the limit of the document's checks.
const FARTHEST: f64 = 1e6;

/// A value with numbers in it.
pub(super) trait Finite {
    fn is_sound(&self) -> bool;
}

impl Finite for f64 {
    fn is_sound(&self) -> bool {
        self.is_finite()
    }
}

impl Finite for PicturePoint {
    fn is_sound(&self) -> bool {
        self.0.is_finite() && self.0.abs().max_element() <= FARTHEST
    }
}

impl Finite for DVec2 {
    fn is_sound(&self) -> bool {
        self.is_finite()
    }
}

impl Finite for DVec3 {
    fn is_sound(&self) -> bool {
        self.is_finite()
    }
}

impl Finite for Waypoint {
    fn is_sound(&self) -> bool {
        self.0.is_finite()
    }
}

impl<T: Finite> Finite for Option<T> {
    fn is_sound(&self) -> bool {
        self.as_ref().is_none_or(T::is_sound)
    }
}

impl<T: Finite> Finite for [T] {
    fn is_sound(&self) -> bool {
        self.iter().all(T::is_sound)
    }
}

impl<T: Finite> Finite for Vec<T> {
    fn is_sound(&self) -> bool {
        self.as_slice().is_sound()
    }
}

impl<T: Finite, const N: usize> Finite for [T; N] {
    fn is_sound(&self) -> bool {
        self.as_slice().is_sound()
    }
}

impl Finite for FocalLength {
    fn is_sound(&self) -> bool {
        match self {
            Self::Known(focal) => focal.is_sound(),
            Self::Between(least, most) => [*least, *most].is_sound(),
            Self::Exif | Self::Unknown => true,
        }
    }
}

impl Finite for Scale {
    fn is_sound(&self) -> bool {
        match self {
            Self::HeightAboveWater(meters) | Self::HeightAboveGround(meters) => meters.is_sound(),
            Self::Length { on: _, from, to, meters } => [*from, *to].is_sound() && meters.is_sound(),
        }
    }
}

impl Finite for Region<String> {
    fn is_sound(&self) -> bool {
        match self {
            Self::Polygon(corners) => corners.is_sound(),
            Self::Mask(_) => true,
        }
    }
}

impl Finite for ReflectionPair {
    fn is_sound(&self) -> bool {
        let Self { point, reflection, on: _, name: _ } = self;
        [*point, *reflection].is_sound()
    }
}

impl Finite for WaterArea<String> {
    fn is_sound(&self) -> bool {
        let Self { region, pairs } = self;
        region.is_sound() && pairs.is_sound()
    }
}

impl Finite for GroundArea<String> {
    fn is_sound(&self) -> bool {
        let Self { region, height_above_water } = self;
        region.is_sound() && height_above_water.is_sound()
    }
}

impl Finite for BackgroundPlace {
    fn is_sound(&self) -> bool {
        match self {
            Self::Distance(meters) => meters.is_sound(),
            Self::Contact(points) => points.is_sound(),
            Self::Infinity => true,
        }
    }
}

impl Finite for Band<String> {
    fn is_sound(&self) -> bool {
        let Self { name: _, region, place } = self;
        region.is_sound() && place.is_sound()
    }
}

impl Finite for Drift {
    fn is_sound(&self) -> bool {
        let Self { speed, direction_deg } = *self;
        [speed, direction_deg].is_sound()
    }
}

impl Finite for Sky<String> {
    fn is_sound(&self) -> bool {
        let Self { region, drift } = self;
        region.is_sound() && drift.is_sound()
    }
}

impl Finite for Object<String> {
    fn is_sound(&self) -> bool {
        let Self { name: _, support: _, outline, contact, turns_to_camera: _, motion } = self;
        outline.is_sound() && contact.is_sound() && motion.is_sound()
    }
}

impl Finite for Motion<String> {
    fn is_sound(&self) -> bool {
        match self {
            Self::Sway(sway) => sway.is_sound(),
            Self::Floating(floating) => floating.is_sound(),
            Self::Course(course) => course.is_sound(),
            Self::Static | Self::Recorded(Recorded { poses: _, looped: _ }) => true,
        }
    }
}

impl Finite for Sway {
    fn is_sound(&self) -> bool {
        let Self { kind: _, root, tip, frequency_hz, damping, amplitude, period_seconds, seed: _ } = self;
        [*root, *tip].is_sound() && [*frequency_hz, *damping, *amplitude, *period_seconds].is_sound()
    }
}

impl Finite for Floating {
    fn is_sound(&self) -> bool {
        let Self { draft, length, beam, mass, heave_damping, roll_damping, .. } = *self;
        let Self { heave_period_seconds, roll_period_seconds, .. } = *self;
        let periods = [heave_period_seconds, roll_period_seconds];
        draft.is_sound() && [length, beam, mass, heave_damping, roll_damping].is_sound() && periods.is_sound()
    }
}

impl Finite for Course {
    fn is_sound(&self) -> bool {
        let Self { waypoints, speed, draft, length, closed: _ } = self;
        waypoints.is_sound() && [Some(*speed), Some(*draft), *length].is_sound()
    }
}

impl Finite for Wind {
    fn is_sound(&self) -> bool {
        let Self { speed, direction_deg, gusts, seed: _, period_seconds } = *self;
        [speed, direction_deg, gusts, period_seconds].is_sound()
    }
}

impl Finite for Waves<String> {
    fn is_sound(&self) -> bool {
        let Self { sea, ripples: _ } = self;
        match sea {
            Sea::Calm => true,
            Sea::Octaves(Octaves { max_height, wavelength, octaves: _, speed_factor, direction_deg }) => {
                [*max_height, *wavelength, Some(*speed_factor), *direction_deg].is_sound()
            }
            Sea::Jonswap(Jonswap { max_height, peak_period_seconds, depth, spreading, direction_deg }) => {
                let given = [Some(*depth), Some(*spreading)];
                [*max_height, *peak_period_seconds, *direction_deg].is_sound() && given.is_sound()
            }
            Sea::Recorded(RecordedSea { first: _, count: _, frames_per_second, height, area }) => {
                [*frames_per_second, *height, area.0, area.1].is_sound()
            }
        }
    }
}

impl Finite for Keyframe {
    fn is_sound(&self) -> bool {
        let Self { position, yaw_deg, pitch_deg, roll_deg, seconds, hold, easing: _ } = *self;
        position.is_sound() && [yaw_deg, pitch_deg, roll_deg, seconds, hold].is_sound()
    }
}

impl Finite for CameraPath {
    fn is_sound(&self) -> bool {
        let Self { keyframes, looped: _ } = self;
        keyframes.is_sound()
    }
}
