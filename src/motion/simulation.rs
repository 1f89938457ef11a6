//! The tour's clock: what one step does.

use glam::DVec2;

use super::looped::{self, LoopError};
use super::movers::Movers;
use super::near_water::{self, NearWater};
use super::shore::Shore;
use super::{Moment, Moves, Recordings, STEP_SECONDS};
use crate::picture::Mask;
use crate::scene::Surface;
use crate::scene::TourScene;
use crate::tour::Drift;
use crate::tour::RecordedSea;
use crate::tour::Sea;
use crate::tour::Tour;
use crate::tour::Wind;
use crate::water::ripples::Ripples;
use crate::water::sea::SeaSurface;
use crate::water::{MovingWater, WaterPoint, WaterSurface};
use crate::wind::ChangingWeather;
use crate::wind::Weather;
use crate::wind::cloud_copies;
use crate::wind::drift_of_wind;

/// How the clouds drift.
#[derive(Clone, Copy, Debug)]
enum Clouds {
    Still,
    Drifting(Drift),
    WithWind,
}

/// A tour that moves.
#[derive(Clone, Debug)]
pub struct Simulation {
    pub(super) tour: Tour,
    pub(super) scene: TourScene,
    pub(super) recordings: Recordings,
    pub(super) loop_seconds: Option<f64>,
    /// The step at which water and bodies rested last.
    pub(super) rested_at: u64,
    pub(super) steps: u64,
    /// How much of the last step is still to come in what is shown, 0 to below 1.
    pub(super) lag: f64,
    /// Whether anything was done to it that [`Simulation::go_to`] forgets.
    pub(super) touched: bool,
    pub(super) weather: ChangingWeather,
    clouds: Clouds,
    pub(super) movers: Movers,
    pub(super) sea: Option<SeaSurface>,
    pub(super) near: Option<NearWater>,
    pub(super) moment: Moment,
}

impl Simulation {
    /// A tour at its start. `tour` must be in pixels of the scene's picture, as
    /// [`TourSource::tour`](crate::assemble::TourSource::tour) is; `recordings` are those that it names. The remarks say what
    /// does not move, and why.
    ///
    /// `land` says where the picture shows land, as [`AssembledTour::land`](crate::assemble::AssembledTour::land) does:
    /// ripples end there and come back. Without it there is water everywhere.
    ///
    /// Clouds move in a tour with a sky: as it says, in any wind, or else with the wind. An open course is sailed to and fro.
    #[must_use]
    pub fn new(
        tour: &Tour,
        scene: &TourScene,
        land: Option<&Mask>,
        recordings: &Recordings,
    ) -> (Self, Vec<String>) {
        let shore = land.map(|land| Shore::new(&scene.camera, land, &near_water::grid(&scene.camera)));
        let (simulation, resting, mut remarks) =
            Self::start(tour.clone(), scene.clone(), shore.unwrap_or_default(), recordings.clone(), None);
        let rests = |(name, reason): (String, String)| format!("\"{name}\" rests: {reason}");
        remarks.extend(resting.into_iter().map(rests));
        (simulation, remarks)
    }

    /// The same tour from its start, in its present weather, repeating after so many seconds. Periods become whole parts of
    /// them and courses and recordings take whole rounds; what was [led](Self::lead) is not.
    ///
    /// # Errors
    ///
    /// For loops under 8 s or over an hour, and where a course or a recording would have to run at more than twice or less
    /// than half its speed, or poses do not start over.
    pub fn looped(&self, seconds: f64) -> Result<Self, LoopError> {
        let tour = looped::with_whole_periods(&self.tour, seconds)?;
        let shore = self.near.as_ref().map(|near| near.shore().clone()).unwrap_or_default();
        let (mut simulation, resting, _) =
            Self::start(tour, self.scene.clone(), shore, self.recordings.clone(), Some(seconds));
        if let Some(sea) = &mut simulation.sea {
            sea.fit_rounds(seconds).map_err(|error| {
                let (name, reason) = ("sea".to_owned(), error.to_string());
                LoopError::Mover { name, seconds, reason }
            })?;
        }
        let sails_here =
            |name: &str| self.object(name).is_some_and(|(index, ..)| self.movers.moves(index).returns);
        if let Some((name, reason)) = resting.into_iter().find(|(name, _)| sails_here(name)) {
            return Err(LoopError::Mover { name, seconds, reason });
        }
        let target = self.weather.target();
        simulation.set_weather(&target);
        simulation.go_to(0.0);
        Ok(simulation)
    }

    /// A tour at its start; who rests and why; remarks.
    fn start(
        tour: Tour,
        scene: TourScene,
        shore: Shore,
        recordings: Recordings,
        loop_seconds: Option<f64>,
    ) -> (Self, Vec<(String, String)>, Vec<String>) {
        let mut remarks = Vec::new();
        let sea = match &tour.waves.sea {
            _ if !scene.water => None,
            Sea::Recorded(RecordedSea { first, .. }) => {
                let sea = recordings.sea.clone().and_then(SeaSurface::recorded);
                if sea.is_none() {
                    remarks.push(format!(
                        "the sea rests: its frames \"{first}\" and so on were not read; open the .tour.ron that names them"
                    ));
                }
                sea
            }
            sea => SeaSurface::new(sea, &tour.wind),
        };
        let mut simulation = Self {
            loop_seconds,
            rested_at: 0,
            steps: 0,
            lag: 0.0,
            touched: false,
            weather: ChangingWeather::steady(tour.wind.into()),
            clouds: match &tour.sky {
                // Without a region the sky is a part of the background, mountains and all.
                Some(sky)
                    if scene.last_layer().surface == Surface::Infinity
                        && scene.last_layer().name == "sky" =>
                {
                    sky.drift.map_or(Clouds::WithWind, Clouds::Drifting)
                }
                _ => Clouds::Still,
            },
            movers: Movers::new(&tour.wind),
            sea,
            near: NearWater::new(&tour, &scene, shore, &mut remarks),
            moment: Moment::still(scene.components.len()),
            tour,
            scene,
            recordings,
        };
        let mut resting = Vec::new();
        for object in simulation.tour.objects.clone() {
            // What has no place was left out of the scene, which says so.
            if let Some((component, ..)) = simulation.object(&object.name)
                && let Err(reason) = simulation.cast(component, &object)
            {
                resting.push((object.name, reason));
            }
        }
        simulation.raise_sea();
        simulation.show();
        (simulation, resting, remarks)
    }

    /// Whether nothing can move unless it is touched or the weather is changed.
    #[must_use]
    pub fn is_still(&self) -> bool {
        let wind = self.wind();
        let [now, to_come] = [self.weather.at(self.seconds()), self.weather.target()];
        // A recorded sea runs in still air.
        let runs = self.sea.as_ref().is_some_and(|sea| now.waves.max(to_come.waves) * sea.gain(0.0) > 0.0);
        let calm = wind.speed == 0.0 && to_come.wind.speed == 0.0 && !runs;
        let at_rest = self.ripples().is_none_or(Ripples::is_still) && self.movers.are_at_rest();
        calm && at_rest && self.drift(&wind).speed == 0.0
    }

    /// Seconds from the tour's start.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        (self.steps as f64 - self.lag) * STEP_SECONDS
    }

    /// Steps from the tour's start, the one that a time [gone to](Self::go_to) lies in included.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// One step of [`STEP_SECONDS`]. Allocates nothing.
    pub fn step(&mut self) {
        self.advance();
        self.show();
    }

    /// Lets the weather turn gently to another. Numbers are brought into their ranges; what is no number stays as it was, as
    /// do seed and period of the wind. The sea becomes higher or lower, and turns slowly as far as
    /// the wind does from the tour's own.
    pub fn set_weather(&mut self, weather: &Weather) {
        self.touched |= self.weather.change(self.seconds(), *weather);
    }

    /// The wind of this moment.
    #[must_use]
    pub fn wind(&self) -> Wind {
        self.weather.at(self.seconds()).wind
    }

    /// The weather that was asked for, which it is or turns to.
    #[must_use]
    pub fn weather_to_come(&self) -> Weather {
        self.weather.target()
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
        self.touched = true;
        true
    }

    /// What can ever move in the component of this index.
    #[must_use]
    pub fn moves(&self, component: usize) -> Moves {
        let drifts = component == 0 && !matches!(self.clouds, Clouds::Still);
        Moves { drifts, ..self.movers.moves(component) }
    }

    /// What can ever move in any component, and so in the water.
    #[must_use]
    pub fn all_moves(&self) -> Moves {
        (0..self.scene.components.len()).fold(Moves::default(), |all, index| all.or(self.moves(index)))
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

    /// One step of all that has a memory: weather → sea → what walls throw back → bodies → ripples. Touches act between
    /// steps.
    pub(super) fn advance(&mut self) {
        self.steps += 1;
        self.lag = 0.0;
        if let Some(near) = &mut self.near {
            near.ripples.look_back(0.0);
        }
        self.raise_sea();
        let seconds = self.seconds();
        let sea = self.sea.as_ref();
        if let (Some(near), Some(sea)) = (&mut self.near, sea) {
            near.throw_back(sea);
        }
        let ripples = self.near.as_ref().map(|near| &near.ripples);
        self.movers.step(seconds, &MovingWater { sea, ripples });
        if let Some(near) = &mut self.near {
            self.movers.press(seconds, &mut near.ripples);
            near.ripples.step();
        }
    }

    /// Brings the sea to the present time and weather.
    pub(super) fn raise_sea(&mut self) {
        let seconds = self.seconds();
        let Weather { wind, waves } = self.weather.at(seconds);
        let direction_deg = self.weather.waves_direction_deg(seconds);
        if let Some(sea) = &mut self.sea {
            sea.turn(direction_deg - self.tour.wind.direction_deg);
            sea.update(seconds, waves * sea.gain(wind.speed));
        }
    }

    /// Writes down where everything is.
    pub(super) fn show(&mut self) {
        let (seconds, wind) = (self.seconds(), self.wind());
        let drift = self.drift(&wind);
        self.moment.seconds = seconds;
        self.moment.clouds = cloud_copies(&drift, wind.period_seconds, seconds);
        self.movers.show(seconds, 1.0 - self.lag, &wind, &mut self.moment);
    }

    fn drift(&self, wind: &Wind) -> Drift {
        match self.clouds {
            Clouds::Still => Drift { speed: 0.0, direction_deg: 0.0 },
            Clouds::Drifting(drift) => drift,
            Clouds::WithWind => drift_of_wind(wind, self.scene.camera.intrinsics.focal_px),
        }
    }
}
