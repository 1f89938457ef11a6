//! The tour's clock: what one step does, and how to get to any time.

use glam::DVec2;

use super::near_water::NearWater;
use super::stand;
use super::vessel::Vessel;
use super::{Moment, STEP_SECONDS};
use crate::scene::Role;
use crate::scene::Surface;
use crate::scene::TourScene;
use crate::tour::Drift;
use crate::tour::Motion;
use crate::tour::Sea;
use crate::tour::Tour;
use crate::tour::Wind;
use crate::water::ripples::Ripples;
use crate::water::sea::SeaSurface;
use crate::water::{MovingWater, WaterPoint, WaterSurface};
use crate::wind::ChangingWind;
use crate::wind::Plants;
use crate::wind::cloud_copies;
use crate::wind::drift_of_wind;

/// Steps after which water and bodies have forgotten what was: 20 s, four half-lives of ripples.
pub const MEMORY_STEPS: u64 = 1200;

/// The last step that is counted; at some ten thousand years, steps are still whole numbers in f64.
const LAST_STEP: f64 = (1_u64 << 44) as f64;

/// How the clouds drift.
#[derive(Clone, Copy, Debug)]
enum Clouds {
    Drifting(Drift),
    WithWind,
}

/// A tour that moves.
#[derive(Clone, Debug)]
pub struct Simulation {
    steps: u64,
    wind: ChangingWind,
    clouds: Clouds,
    focal_px: f64,
    plants: Plants,
    /// The component of each plant.
    plant_components: Vec<usize>,
    sea: Option<SeaSurface>,
    near: Option<NearWater>,
    vessels: Vec<Vessel>,
    moment: Moment,
}

impl Simulation {
    /// A tour at its start. `tour` must be in pixels of the scene's picture, as
    /// [`TourSource::tour`](crate::assemble::TourSource::tour) is. The remarks say what does not move, and why.
    ///
    /// Clouds move in a tour with a sky: as it says, in any wind, or else with the wind. An open course is sailed to and fro.
    #[must_use]
    pub fn new(tour: &Tour, scene: &TourScene) -> (Self, Vec<String>) {
        let mut remarks = Vec::new();
        let (mut plants, mut plant_components, mut vessels) = (Vec::new(), Vec::new(), Vec::new());
        for object in &tour.objects {
            let place = scene.components.iter().enumerate().find_map(|(index, component)| {
                let is_it = component.role == Role::Billboard && component.name == object.name;
                let Surface::Wall(wall) = &component.surface else { return None };
                is_it.then_some((index, wall))
            });
            // What has no place was left out of the scene, which says so.
            let Some((index, wall)) = place else { continue };
            let mut rests = |reason: &str| remarks.push(format!("\"{}\" rests: {reason}", object.name));
            match &object.motion {
                Motion::Static => {}
                Motion::Sway(sway) => match stand::plant(object, sway, &tour.wind, scene, wall) {
                    Ok(plant) => {
                        plants.push(plant);
                        plant_components.push(index);
                    }
                    Err(reason) => rests(&reason),
                },
                Motion::Floating(floating) => {
                    vessels.push(Vessel::anchored(index, object, floating, scene, wall));
                }
                Motion::Course(course) => match Vessel::sailing(index, object, course, scene, wall) {
                    Ok(vessel) => vessels.push(vessel),
                    Err(error) => rests(&error.to_string()),
                },
                Motion::Recorded(_) => rests("recorded poses are not drawn yet"),
            }
        }
        if let Sea::Recorded(_) = tour.waves.sea {
            remarks.push("the sea rests: recorded seas are not drawn yet".to_owned());
        }
        let sea = scene.water.then(|| SeaSurface::new(&tour.waves.sea, &tour.wind)).flatten();
        let still = Drift { speed: 0.0, direction_deg: 0.0 };
        let mut simulation = Self {
            steps: 0,
            wind: ChangingWind::steady(tour.wind),
            clouds: match &tour.sky {
                None => Clouds::Drifting(still),
                Some(sky) => sky.drift.map_or(Clouds::WithWind, Clouds::Drifting),
            },
            focal_px: scene.camera.intrinsics.focal_px,
            plants: Plants::new(plants, &tour.wind),
            plant_components,
            sea,
            near: NearWater::new(tour, scene, &mut remarks),
            vessels,
            moment: Moment::still(scene.components.len()),
        };
        simulation.raise_sea();
        simulation.show();
        (simulation, remarks)
    }

    /// Whether nothing can move unless it is touched or the wind is changed.
    #[must_use]
    pub fn is_still(&self) -> bool {
        let wind = self.wind();
        let calm = wind.speed == 0.0 && self.wind.target().speed == 0.0;
        let at_rest = self.ripples().is_none_or(Ripples::is_still)
            && self.vessels.iter().all(|vessel| !vessel.sails() && vessel.is_at_rest());
        calm && at_rest && self.drift(&wind).speed == 0.0
    }

    /// Seconds from the tour's start.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.steps as f64 * STEP_SECONDS
    }

    /// Steps from the tour's start.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// One step of [`STEP_SECONDS`]. Allocates nothing.
    pub fn step(&mut self) {
        self.advance();
        self.show();
    }

    /// Goes to the step nearest to `seconds` from the tour's start; what is before that, or no number, is the start.
    ///
    /// It starts over: touches are forgotten, and the wind that was [set](Self::set_wind) last counts as having blown from
    /// the start. Nothing else of what was before counts. Of water and bodies only the last 20 s before that time are
    /// simulated, so in the first 20 s of a tour this is what as many steps give, to the bit.
    pub fn go_to(&mut self, seconds: f64) {
        // The cast makes 0 of what is no number.
        let last = (seconds / STEP_SECONDS).round().clamp(0.0, LAST_STEP) as u64;
        self.wind = ChangingWind::steady(self.wind.target());
        self.steps = if self.has_memory() { last.saturating_sub(MEMORY_STEPS) } else { last };
        if let Some(near) = &mut self.near {
            near.ripples.still();
        }
        self.vessels.iter_mut().for_each(Vessel::rest);
        self.raise_sea();
        while self.steps < last {
            self.advance();
        }
        self.show();
    }

    /// Lets the wind turn gently to another one, of which speed, direction and gusts count. Numbers are brought into their
    /// ranges; what is no number stays as it was. The sea becomes higher or lower, but keeps running where it ran.
    pub fn set_wind(&mut self, wind: &Wind) {
        self.wind.change(self.seconds(), *wind);
    }

    /// The wind of this moment.
    #[must_use]
    pub fn wind(&self) -> Wind {
        self.wind.at(self.seconds())
    }

    /// The wind that was asked for, which it is or turns to.
    #[must_use]
    pub fn wind_to_come(&self) -> Wind {
        self.wind.target()
    }

    /// Stirs the water around (x, z), as [`Ripples::touch`] does: `radius` in meters, `impulse` in m/s upwards. Off the near
    /// water or on a wall, with what is no finite number, with no impulse, or without ripples it does nothing and says
    /// `false`.
    pub fn touch(&mut self, at: DVec2, radius: f64, impulse: f64) -> bool {
        let Some(near) = &mut self.near else { return false };
        let is_sound = radius.is_finite() && impulse.is_finite() && impulse != 0.0;
        if !is_sound || !near.ripples.is_water(at) {
            return false;
        }
        near.ripples.touch(at, radius, impulse);
        true
    }

    /// Where everything is.
    #[must_use]
    pub fn moment(&self) -> &Moment {
        &self.moment
    }

    /// The waves of the wind; `None` in a tour without them.
    #[must_use]
    pub fn sea(&self) -> Option<&SeaSurface> {
        self.sea.as_ref()
    }

    /// The ripples of the near water; `None` in a tour without them.
    #[must_use]
    pub fn ripples(&self) -> Option<&Ripples> {
        self.near.as_ref().map(|near| &near.ripples)
    }

    /// The ripples as [`Ripples::texels`].
    pub fn ripple_texels(&mut self) -> Option<&[[f32; 4]]> {
        self.near.as_mut().map(|near| near.ripples.texels())
    }

    /// Waves and ripples together.
    #[must_use]
    pub fn water(&self) -> MovingWater<'_> {
        MovingWater { sea: self.sea.as_ref(), ripples: self.ripples() }
    }

    /// Height and slope of the water at (x, z): waves and ripples together. Resting water where there is none, and where
    /// `xz` is no finite number.
    #[must_use]
    pub fn water_at(&self, xz: DVec2) -> WaterPoint {
        self.water().at(xz, 0.0)
    }

    /// One step of all that has a memory: wind → sea → what walls throw back → bodies → ripples. Touches act between steps.
    fn advance(&mut self) {
        self.steps += 1;
        self.raise_sea();
        let seconds = self.seconds();
        let sea = self.sea.as_ref();
        if let (Some(near), Some(sea)) = (&mut self.near, sea) {
            near.throw_back(sea);
        }
        for vessel in &mut self.vessels {
            // Pressure acts in the ripples' step, so each body sees the water without what the others do in this one.
            let ripples = self.near.as_ref().map(|near| &near.ripples);
            vessel.step(seconds, &MovingWater { sea, ripples });
            if let Some(near) = &mut self.near {
                vessel.press(seconds, &mut near.ripples);
            }
        }
        if let Some(near) = &mut self.near {
            near.ripples.step();
        }
    }

    /// Brings the sea to the present time and wind.
    fn raise_sea(&mut self) {
        let (seconds, speed) = (self.seconds(), self.wind().speed);
        if let Some(sea) = &mut self.sea {
            sea.update(seconds, sea.gain(speed));
        }
    }

    /// Writes down where everything is.
    fn show(&mut self) {
        let (seconds, wind) = (self.seconds(), self.wind());
        let drift = self.drift(&wind);
        let moment = &mut self.moment;
        moment.seconds = seconds;
        moment.clouds = cloud_copies(&drift, wind.period_seconds, seconds);
        let records = self.plants.update(seconds, &wind);
        for (record, &component) in records.iter().zip(&self.plant_components) {
            moment.sways[component] = *record;
        }
        for vessel in &self.vessels {
            let pose = vessel.pose(seconds);
            moment.placements[vessel.component] = vessel.placement(&pose);
            moment.mirrored[vessel.component] = pose.mirrored_share as f32;
        }
    }

    fn drift(&self, wind: &Wind) -> Drift {
        match self.clouds {
            Clouds::Drifting(drift) => drift,
            Clouds::WithWind => drift_of_wind(wind, self.focal_px),
        }
    }

    /// Whether water or bodies can be otherwise than at rest before anything is touched.
    fn has_memory(&self) -> bool {
        let waves = self.sea.as_ref().is_some_and(|sea| sea.gain(self.wind.target().speed) > 0.0);
        let is_walled = self.near.as_ref().is_some_and(NearWater::has_walls);
        self.vessels.iter().any(Vessel::sails) || waves && (is_walled || !self.vessels.is_empty())
    }
}
