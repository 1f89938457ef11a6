//! What moves in a shown tour: its simulation, stepped in game time, and the texture that tells the water's shader.
//!
//! A step is always the same; a frame takes as many as have become due, four at most. What is due beyond that is dropped:
//! the tour's clock then runs slower than the game's.

use bevy::asset::RenderAssetUsages;
use bevy::image::Image;
use bevy::math::DVec2;
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};

use super::material::TourMaterial;
use super::spawn::{ShownTour, TourPart};
use crate::assemble::AssembledTour;
use crate::motion::{LoopError, STEP_SECONDS, Simulation};
use crate::tour::{Motion, Tour};
use crate::water::WaterPoint;
use crate::water::body::BodyPose;
use crate::water::ripples::Ripples;
use crate::wind::Weather;

/// Most steps of a frame.
const MOST_STEPS: u32 = 4;

/// Width of the ripples in the waves' texture, which are its upper half; the sea's two tiles share the lower one.
const RIPPLES: usize = 256;
const TILE: usize = RIPPLES / 2;
/// Bytes of a texel.
const TEXEL: usize = 16;

/// What moves in a tour; on the tour's entity from when it is shown.
#[derive(Component, Debug)]
pub struct TourMotion {
    simulation: Simulation,
    /// Game time that has not become a step yet, seconds.
    due: f64,
    /// Whether everything stands still as it is; the water can be stirred all the same when it goes on.
    pub paused: bool,
    /// Whether the picture is shown as it was taken, whatever moves.
    pub still: bool,
    /// Seconds that were dropped because frames were too slow.
    pub dropped_seconds: f64,
    /// Whether what is shown is older than the simulation.
    changed: bool,
    /// Whether the still picture is shown.
    shows_still: bool,
}

/// Asks for the water of a tour to be stirred.
#[derive(Message, Clone, Copy, Debug, PartialEq)]
pub struct TouchWater {
    /// The tour's entity.
    pub tour: Entity,
    /// Where, (x, z) in the tour's space, meters.
    pub at: Vec2,
    /// How far around, meters.
    pub radius: f32,
    /// Meters per second given to the water in the middle, up above 0.
    pub impulse: f32,
}

impl TourMotion {
    /// The motion of a tour from its start.
    pub(super) fn new(tour: &Tour, built: &AssembledTour) -> Self {
        let (simulation, remarks) =
            Simulation::new(tour, &built.scene, built.land(tour).as_ref(), &built.recordings);
        for remark in remarks {
            info!("{remark}");
        }
        Self {
            simulation,
            due: 0.0,
            paused: false,
            still: false,
            dropped_seconds: 0.0,
            changed: true,
            shows_still: false,
        }
    }

    /// Begins anew in another weather than the tour's own.
    pub(super) fn begin_in(&mut self, weather: &Weather) {
        self.simulation.set_weather(weather);
        self.simulation.go_to(0.0);
    }

    /// Seconds since the tour's start.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.simulation.seconds()
    }

    /// Lets the tour begin anew and repeat after so many seconds, without a seam.
    ///
    /// # Errors
    ///
    /// As [`Simulation::looped`]; the tour then goes on as it did.
    pub fn repeat_after(&mut self, seconds: f64) -> Result<(), LoopError> {
        self.simulation = self.simulation.looped(seconds)?;
        (self.due, self.changed) = (0.0, true);
        Ok(())
    }

    /// Jumps to a time since the tour's start, as if nothing had been touched.
    pub fn go_to(&mut self, seconds: f64) {
        self.simulation.go_to(seconds);
        self.due = 0.0;
        self.changed = true;
    }

    /// The water at a point (x, z) of the tour's space: height and slope, for a game's own boats.
    #[must_use]
    pub fn water_at(&self, xz: DVec2) -> WaterPoint {
        self.simulation.water_at(xz)
    }

    /// Everything that moves, as it is now.
    #[must_use]
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// Takes the steps that have become due after so many seconds.
    fn advance(&mut self, seconds: f64) {
        if self.paused {
            return;
        }
        self.due += seconds.max(0.0);
        // A frame's time is not quite a whole number of steps.
        let steps = ((self.due / STEP_SECONDS + 1e-3).floor() as u32).min(MOST_STEPS);
        let was_still = self.simulation.is_still();
        for _ in 0..steps {
            self.simulation.step();
        }
        // What rests is not uploaded again and again.
        self.changed |= steps > 0 && !(was_still && self.simulation.is_still());
        self.due -= f64::from(steps) * STEP_SECONDS;
        if self.due > STEP_SECONDS {
            self.dropped_seconds += self.due;
            self.due = 0.0;
        }
        self.due = self.due.max(0.0);
    }

    /// Whether there is news since this was asked last.
    pub(super) fn take_changed(&mut self) -> bool {
        let turned = self.still != self.shows_still;
        self.shows_still = self.still;
        turned || (std::mem::take(&mut self.changed) && !self.still)
    }

    /// Writes the water as it is now into the bytes of [`waves_image`]; the layout stands in `material/waves.wgsl`.
    pub(super) fn write_waves(&mut self, bytes: &mut [u8]) {
        let (upper, lower) = bytes.split_at_mut(bytes.len() / 2);
        if let Some(ripples) = self.simulation.ripple_texels().map(bytemuck::cast_slice::<_, u8>)
            && ripples.len() == upper.len()
        {
            upper.copy_from_slice(ripples);
        }
        for (side, tile) in self.simulation.sea().iter().flat_map(|sea| sea.tiles()).enumerate() {
            let (mut rest, mut row, mut size) = (tile.texels(), 0, TILE);
            while size > 0 {
                let (level, coarser) = rest.split_at(size * size);
                for (source, row) in level.chunks_exact(size).zip(row..) {
                    let start = TEXEL * (row * RIPPLES + side * TILE);
                    lower[start..start + TEXEL * size].copy_from_slice(bytemuck::cast_slice(source));
                }
                (rest, row, size) = (coarser, row + size, size / 2);
            }
        }
    }
}

/// The weather of a tour, on its entity from when it is shown: one wind for trees, clouds, water and boats. Change it and
/// everything follows within a few seconds; a wind of 0 is the still picture again. A tour spawned with it has it from the
/// start.
#[derive(Component, Clone, Copy, Debug, PartialEq, Deref, DerefMut)]
pub struct TourWeather(pub Weather);

/// How an object of a tour moves, on its part. Change it, and it moves in another way from now on.
#[derive(Component, Clone, Debug, PartialEq)]
pub enum ObjectMotion {
    /// By itself, as a tour's file could say it: it sways, floats at anchor, sails a course, or stays.
    Own(Motion),
    /// As the game says: so far from where it rests in the picture. Its mirror image and its mask follow; the water does not
    /// feel it.
    Led(BodyPose),
}

/// Passes on the weather that games changed.
pub(super) fn change_weather(mut tours: Query<(&mut TourMotion, &TourWeather), Changed<TourWeather>>) {
    for (mut motion, weather) in &mut tours {
        motion.simulation.set_weather(weather);
    }
}

/// Lets objects move as games say.
pub(super) fn change_objects(
    mut tours: Query<(&mut TourMotion, &ShownTour)>,
    objects: Query<(&ObjectMotion, &Name, &ChildOf, Ref<TourPart>), Changed<ObjectMotion>>,
    mut materials: ResMut<Assets<TourMaterial>>,
) {
    for (object, name, root, part) in &objects {
        // What was just spawned moves as the file says already.
        let (false, Ok((mut motion, shown))) = (part.is_added(), tours.get_mut(root.parent())) else {
            continue;
        };
        let set = match object {
            ObjectMotion::Own(own) => motion.simulation.set_motion(name, own),
            ObjectMotion::Led(pose) if motion.simulation.lead(name, *pose) => Ok(()),
            ObjectMotion::Led(_) => {
                Err("it is no object of its tour, or its pose is no finite one".to_owned())
            }
        };
        if let Err(reason) = set {
            warn!("\"{name}\" cannot move so: {reason}");
        }
        motion.changed = true;
        shown.follow_moves(motion.simulation(), &mut materials);
    }
}

/// Stirs what is asked for and steps all tours.
pub(super) fn advance(
    mut tours: Query<&mut TourMotion>,
    mut touches: MessageReader<TouchWater>,
    time: Res<Time>,
) {
    for touch in touches.read() {
        if let Ok(mut motion) = tours.get_mut(touch.tour) {
            let at = touch.at.as_dvec2();
            motion.simulation.touch(at, f64::from(touch.radius), f64::from(touch.impulse));
        }
    }
    for mut motion in &mut tours {
        motion.advance(time.delta_secs_f64());
    }
}

/// An image for the waves of water at rest.
pub(super) fn waves_image() -> Image {
    let size = Extent3d { width: RIPPLES as u32, height: 2 * RIPPLES as u32, depth_or_array_layers: 1 };
    let usage = RenderAssetUsages::RENDER_WORLD | RenderAssetUsages::MAIN_WORLD;
    let mut image = Image::new_uninit(size, TextureDimension::D2, TextureFormat::Rgba32Float, usage);
    image.data = Some(vec![0; 2 * RIPPLES * RIPPLES * TEXEL]);
    image
}

/// Whether a tour's ripples are those that the shader can show.
pub(super) fn shown_ripples(ripples: Option<&Ripples>) -> Option<&Ripples> {
    ripples.filter(|ripples| ripples.grid().size == RIPPLES)
}
