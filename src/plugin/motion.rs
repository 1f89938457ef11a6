//! What moves in a shown tour: its simulation, stepped in game time, and the texture that tells the water's shader.
//!
//! A step is always the same; a frame takes as many as have become due, four at most. What is due beyond that is dropped:
//! the tour's clock then runs slower than the game's.

use bevy::asset::RenderAssetUsages;
use bevy::image::Image;
use bevy::math::DVec2;
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};

use crate::motion::{MEMORY_STEPS, STEP_SECONDS, Simulation};
use crate::scene::TourScene;
use crate::tour::{Tour, Wind};
use crate::water::WaterPoint;
use crate::water::ripples::Ripples;

/// Most steps that are taken rather than start over.
const ONWARD: f64 = 240.0;

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
    /// Whether anything was done to it that [`go_to`](Self::go_to) forgets.
    touched: bool,
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
    pub(super) fn new(tour: &Tour, scene: &TourScene) -> Self {
        let (simulation, remarks) = Simulation::new(tour, scene);
        for remark in remarks {
            info!("{remark}");
        }
        Self {
            simulation,
            due: 0.0,
            paused: false,
            still: false,
            dropped_seconds: 0.0,
            touched: false,
            changed: true,
            shows_still: false,
        }
    }

    /// The wind towards which it changes.
    #[must_use]
    pub fn wind(&self) -> Wind {
        self.simulation.wind_to_come()
    }

    /// Lets the wind change to this one, within a few seconds.
    pub fn set_wind(&mut self, wind: &Wind) {
        self.simulation.set_wind(wind);
        self.touched = true;
    }

    /// Seconds since the tour's start.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.simulation.seconds()
    }

    /// Jumps to a time since the tour's start, as if nothing had been touched.
    pub fn go_to(&mut self, seconds: f64) {
        // Within what is remembered going on and starting over are the same.
        let step = (seconds / STEP_SECONDS).round();
        let ahead = step - self.simulation.steps() as f64;
        if !self.touched && step <= MEMORY_STEPS as f64 && (0.0..=ONWARD).contains(&ahead) {
            (0..ahead as u32).for_each(|_| self.simulation.step());
        } else {
            self.simulation.go_to(seconds);
            self.touched = false;
        }
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

/// Stirs what is asked for and steps all tours.
pub(super) fn advance(
    mut tours: Query<&mut TourMotion>,
    mut touches: MessageReader<TouchWater>,
    time: Res<Time>,
) {
    for touch in touches.read() {
        if let Ok(mut motion) = tours.get_mut(touch.tour) {
            let at = touch.at.as_dvec2();
            motion.touched |= motion.simulation.touch(at, f64::from(touch.radius), f64::from(touch.impulse));
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
