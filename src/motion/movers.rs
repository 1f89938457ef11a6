//! Who moves: the plants that sway and the bodies that float, sail or are led by a game.

use super::Moment;
use super::Moves;
use super::Recordings;
use super::stand;
use super::vessel::Vessel;
use crate::scene::TourScene;
use crate::scene::Wall;
use crate::tour::Motion;
use crate::tour::Object;
use crate::tour::Wind;
use crate::water::MovingWater;
use crate::water::body::BodyPose;
use crate::water::ripples::Ripples;
use crate::wind::Plants;

/// All that moves in a scene, each with its component.
#[derive(Clone, Debug)]
pub(super) struct Movers {
    plants: Plants,
    /// The component of each plant.
    plant_components: Vec<usize>,
    vessels: Vec<Vessel>,
}

impl Movers {
    /// Nobody yet. Seed and period of `wind` make the gusts.
    pub(super) fn new(wind: &Wind) -> Self {
        Self { plants: Plants::new(Vec::new(), wind), plant_components: Vec::new(), vessels: Vec::new() }
    }

    /// Lets an object move this way from now on, whatever it did before; `wall` is that of its component. With a loop of so
    /// many seconds its course or its poses take whole rounds. The error says in words why it rests.
    pub(super) fn set(
        &mut self,
        (component, wall): (usize, &Wall),
        object: &Object,
        (scene, wind, recordings): (&TourScene, &Wind, &Recordings),
        loop_seconds: Option<f64>,
    ) -> Result<(), String> {
        self.stop(component);
        match &object.motion {
            Motion::Static => {}
            Motion::Sway(sway) => {
                self.plants.push(stand::plant(object, sway, wind, scene, wall)?);
                self.plant_components.push(component);
            }
            Motion::Floating(floating) => {
                self.vessels.push(Vessel::anchored(component, object, floating, scene, wall));
            }
            Motion::Course(course) => {
                let vessel = Vessel::sailing(component, object, course, scene, wall, loop_seconds);
                self.vessels.push(vessel.map_err(|error| error.to_string())?);
            }
            Motion::Recorded(recorded) => {
                let poses = recordings.poses_of(recorded).ok_or_else(|| {
                    format!(
                        "its poses \"{}\" were not read; open the .tour.ron that names them",
                        recorded.poses
                    )
                })?;
                let vessel = Vessel::recorded(component, wall, poses, loop_seconds);
                self.vessels.push(vessel.map_err(|error| error.to_string())?);
            }
        }
        Ok(())
    }

    /// Puts a wall where somebody else says that its body is.
    pub(super) fn lead(&mut self, component: usize, wall: &Wall, pose: BodyPose) {
        self.stop(component);
        self.vessels.push(Vessel::led(component, wall, pose));
    }

    fn stop(&mut self, component: usize) {
        self.vessels.retain(|vessel| vessel.component != component);
        if let Some(plant) = self.plant_components.iter().position(|&other| other == component) {
            self.plant_components.remove(plant);
            self.plants.remove(plant);
        }
    }

    /// What can ever move in a component.
    pub(super) fn moves(&self, component: usize) -> Moves {
        Moves {
            sways: self.plant_components.contains(&component),
            returns: self.vessels.iter().any(|vessel| vessel.component == component && vessel.returns()),
            drifts: false,
        }
    }

    /// Whether somebody is in the water.
    pub(super) fn swim(&self) -> bool {
        !self.vessels.is_empty()
    }

    /// Whether somebody leaves a wake.
    pub(super) fn sail(&self) -> bool {
        self.vessels.iter().any(Vessel::sails)
    }

    /// Whether nobody moves unless wind or water does.
    pub(super) fn are_at_rest(&self) -> bool {
        self.vessels.iter().all(|vessel| vessel.stays() && vessel.is_at_rest())
    }

    /// Ends everybody's motion on the waves.
    pub(super) fn rest(&mut self) {
        self.vessels.iter_mut().for_each(Vessel::rest);
    }

    /// Takes everybody on by one step, to `seconds`.
    pub(super) fn step(&mut self, seconds: f64, water: &MovingWater) {
        for vessel in &mut self.vessels {
            vessel.step(seconds, water);
        }
    }

    /// Presses on the water as everybody does at `seconds`.
    pub(super) fn press(&self, seconds: f64, ripples: &mut Ripples) {
        for vessel in &self.vessels {
            vessel.press(seconds, ripples);
        }
    }

    /// Writes down where everybody is at `seconds`, which is `part` (0 to 1) of the last step.
    pub(super) fn show(&mut self, seconds: f64, part: f64, wind: &Wind, moment: &mut Moment) {
        let records = self.plants.update(seconds, wind);
        for (record, &component) in records.iter().zip(&self.plant_components) {
            moment.sways[component] = *record;
        }
        for vessel in &self.vessels {
            let pose = vessel.pose(seconds, part);
            moment.placements[vessel.component] = vessel.placement(&pose);
            moment.mirrored[vessel.component] = pose.mirrored_share as f32;
        }
    }
}
