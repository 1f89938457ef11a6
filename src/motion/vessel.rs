//! A body of the tour that floats, sails or is led, and where it brings its wall.
//!
//! One at anchor and the water act on each other. One on a course presses its wake into the water and follows the waves,
//! its own wake's too, but does not press as a floating one does: nothing then feeds waves that travel with it. One that is
//! led, by a game or by another simulator's poses, is where it is said to be; the water does not feel it.

use glam::{DVec2, DVec3};

use crate::picture::PicturePoint;
use crate::scene::Placement;
use crate::scene::TourScene;
use crate::scene::Wall;
use crate::tour::Course;
use crate::tour::Floating;
use crate::tour::Object;
use crate::water::RoundError;
use crate::water::body::AtEnd;
use crate::water::body::Berth;
use crate::water::body::BodyPose;
use crate::water::body::CourseError;
use crate::water::body::FloatingBody;
use crate::water::body::Hull;
use crate::water::body::PressurePatch;
use crate::water::body::RecordedPoses;
use crate::water::body::SailedCourse;
use crate::water::body::Sailing;
use crate::water::body::Wake;
use crate::water::body::WaterHeight;
use crate::water::body::rest_heading;
use crate::water::ripples::Ripples;

/// Share of the water's answer that a body at anchor presses on it.
///
/// The rest swings along with the hull already, as its added mass and damping (notes §7.3). With all of it a hull on waves
/// four times as long swings 1.3 times as high as it does by itself, for it feels its own waves as a softer spring; with a
/// quarter, 1.1 times. With any share the two calm each other down: it only scales the energy of the body's waves.
const ANSWER: f64 = 0.25;

/// A body and its wall.
#[derive(Clone, Debug)]
pub(super) struct Vessel {
    /// Its component in the scene.
    pub(super) component: usize,
    wall: Wall,
    berth: Berth,
    body: FloatingBody,
    way: Way,
    wake: Wake,
}

/// What brings a body from its place.
#[derive(Clone, Debug)]
enum Way {
    Anchored,
    Course(SailedCourse),
    Recorded(RecordedPoses),
    Led(BodyPose),
}

impl Vessel {
    /// A body at anchor where the picture shows it.
    pub(super) fn anchored(
        component: usize,
        object: &Object,
        floating: &Floating,
        scene: &TourScene,
        wall: &Wall,
    ) -> Self {
        let hull = Hull::new(floating, contact_length(object, scene, wall));
        Self::new(component, wall, hull, Way::Anchored)
    }

    /// A body on a course, which comes back on it; whole rounds of it fit a loop of so many seconds.
    pub(super) fn sailing(
        component: usize,
        object: &Object,
        course: &Course,
        scene: &TourScene,
        wall: &Wall,
        loop_seconds: Option<f64>,
    ) -> Result<Self, CourseError> {
        let length = contact_length(object, scene, wall);
        let mut sailed = SailedCourse::new(course, length, AtEnd::default())?;
        if let Some(seconds) = loop_seconds {
            sailed = sailed.with_whole_rounds(seconds)?;
        }
        Ok(Self::new(component, wall, Hull::of_course(course, length), Way::Course(sailed)))
    }

    /// A body that is where its poses say, which are of the body itself: its billboard shows them as [`BodyPose::faced`].
    /// Whole rounds of them fit a loop of so many seconds.
    pub(super) fn recorded(
        component: usize,
        wall: &Wall,
        poses: &RecordedPoses,
        loop_seconds: Option<f64>,
    ) -> Result<Self, RoundError> {
        let poses = loop_seconds.map_or(Ok(poses.clone()), |seconds| poses.with_whole_rounds(seconds))?;
        Ok(Self::new(component, wall, unused_hull(), Way::Recorded(poses)))
    }

    /// A body that is where `pose` says.
    pub(super) fn led(component: usize, wall: &Wall, pose: BodyPose) -> Self {
        Self::new(component, wall, unused_hull(), Way::Led(pose))
    }

    fn new(component: usize, wall: &Wall, hull: Hull, way: Way) -> Self {
        let first_heading = if let Way::Course(course) = &way { course.at(0.0).heading } else { 0.0 };
        let berth = Berth { center: wall.point(0.0, 0.0), heading: rest_heading(wall.along, first_heading) };
        Self { component, wall: *wall, berth, wake: Wake::new(&hull), body: FloatingBody::new(hull), way }
    }

    /// Whether it sails, and leaves a wake.
    pub(super) fn sails(&self) -> bool {
        matches!(self.way, Way::Course(_))
    }

    /// Whether nothing moves it but waves.
    pub(super) fn stays(&self) -> bool {
        match &self.way {
            Way::Anchored | Way::Led(_) => true,
            Way::Course(_) => false,
            Way::Recorded(poses) => poses.is_still(),
        }
    }

    /// Whether it may be seen from its other side, as its mirrored copy.
    pub(super) fn returns(&self) -> bool {
        !matches!(self.way, Way::Anchored)
    }

    /// Whether waves do not move it.
    pub(super) fn is_at_rest(&self) -> bool {
        self.body == FloatingBody::new(*self.body.hull())
    }

    /// Ends its motion on the waves.
    pub(super) fn rest(&mut self) {
        self.body = FloatingBody::new(*self.body.hull());
    }

    /// Takes it on by one step, to `seconds`.
    pub(super) fn step(&mut self, seconds: f64, water: &impl WaterHeight) {
        if let Some(Sailing { center, heading, .. }) = self.sailing_at(seconds) {
            self.body.step(water, center, heading);
        }
    }

    /// Presses on the water as it does at `seconds`.
    pub(super) fn press(&self, seconds: f64, ripples: &mut Ripples) {
        let Some(Sailing { center, heading, speed }) = self.sailing_at(seconds) else { return };
        let patch = if self.sails() {
            self.wake.pressure(center, heading, speed)
        } else {
            let whole = self.body.pressure(center, heading);
            PressurePatch { head: ANSWER * whole.head, tilt: ANSWER * whole.tilt, ..whole }
        };
        let grid = *ripples.grid();
        patch.press(&grid, |cell, pressure| ripples.press_cell(cell, pressure));
    }

    /// How far it is from its rest at `seconds`, which is `part` (0 to 1) of the last step, as its wall shows it.
    pub(super) fn pose(&self, seconds: f64, part: f64) -> BodyPose {
        let on_waves = self.body.pose_within_step(part);
        match &self.way {
            Way::Led(pose) => *pose,
            Way::Recorded(poses) => poses.at(seconds).faced(),
            Way::Course(course) => course.at(seconds).pose_on_waves(&self.berth, &on_waves),
            Way::Anchored => self.anchored_at().pose_on_waves(&self.berth, &on_waves),
        }
    }

    /// Where a pose brings the wall; `None` when that is where it rests.
    pub(super) fn placement(&self, pose: &BodyPose) -> Option<Placement> {
        if *pose == BodyPose::default() {
            return None;
        }
        let resting = self.wall.resting();
        let origin = pose.moved(&self.berth, resting.origin);
        let turned = |axis: DVec3| (pose.moved(&self.berth, resting.origin + axis) - origin).normalize();
        Some(Placement { origin, along: turned(resting.along), up: turned(resting.up) })
    }

    /// Its way over the water at a time; `None` for one that the water does not feel.
    fn sailing_at(&self, seconds: f64) -> Option<Sailing> {
        match &self.way {
            Way::Anchored => Some(self.anchored_at()),
            Way::Course(course) => Some(course.at(seconds)),
            Way::Recorded(_) | Way::Led(_) => None,
        }
    }

    fn anchored_at(&self) -> Sailing {
        let Berth { center, heading } = self.berth;
        Sailing { center: DVec2::new(center.x, center.z), heading, speed: 0.0 }
    }
}

/// The hull of a body that the water does not feel.
fn unused_hull() -> Hull {
    Hull::new(&Floating::of_draft(1.0), 1.0)
}

/// Meters from foot to foot along an object's wall; not a number where a foot is not on it.
fn contact_length(object: &Object, scene: &TourScene, wall: &Wall) -> f64 {
    let along = |foot: PicturePoint| {
        let ray = scene.camera.ray(foot);
        wall.meet_plane(ray).map_or(f64::NAN, |t| wall.along_of(ray.at(t)))
    };
    let [left, right] = object.contact.map(along);
    (right - left).abs()
}
