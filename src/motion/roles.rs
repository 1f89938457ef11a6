//! Which object moves how, as the tour's file says it and as a game changes it.

use super::Simulation;
use crate::scene::Role;
use crate::scene::Surface;
use crate::scene::Wall;
use crate::tour::Motion;
use crate::tour::Object;
use crate::water::body::BodyPose;

impl Simulation {
    /// An object of this name: its component, its wall, and what the tour says of it.
    pub(super) fn object(&self, name: &str) -> Option<(usize, Wall, &Object)> {
        let object = self.tour.objects.iter().find(|object| object.name == name)?;
        self.scene.components.iter().enumerate().find_map(|(index, component)| {
            let Surface::Wall(wall) = component.surface else { return None };
            (component.role == Role::Billboard && component.name == name).then_some((index, wall, object))
        })
    }

    /// How the tour's file says that an object moves; `None` where no object of this name is in the scene.
    #[must_use]
    pub fn motion_of(&self, name: &str) -> Option<&Motion> {
        self.object(name).map(|(_, _, object)| &object.motion)
    }

    /// Lets a component move as an object does.
    pub(super) fn cast(&mut self, component: usize, object: &Object) -> Result<(), String> {
        let Surface::Wall(wall) = self.scene.components[component].surface else { return Ok(()) };
        let around = (&self.scene, &self.tour.wind, &self.recordings);
        self.movers.set((component, &wall), object, around, self.loop_seconds)
    }

    /// Lets an object move in another way from now on, whatever the tour's file says; waves that break at what is
    /// [`Motion::Static`] stay those of the file, and poses must be among its recordings.
    ///
    /// # Errors
    ///
    /// In words, when there is no object of this name, or it cannot move so; it then rests.
    pub fn set_motion(&mut self, name: &str, motion: &Motion) -> Result<(), String> {
        let (component, object) = self
            .object(name)
            .map(|(component, _, object)| (component, Object { motion: motion.clone(), ..object.clone() }))
            .ok_or_else(|| format!("the tour has no object \"{name}\" that could move"))?;
        self.touched = true;
        self.moment.rest(component);
        let set = self.cast(component, &object);
        self.show();
        set
    }

    /// Puts an object where somebody else says that it is, until it is told otherwise. Says `false` when there is no object
    /// of this name, or the pose is no finite one.
    pub fn lead(&mut self, name: &str, pose: BodyPose) -> bool {
        let Some((component, wall, _)) = self.object(name).filter(|_| pose.is_finite()) else { return false };
        self.touched = true;
        self.moment.rest(component);
        self.movers.lead(component, &wall, pose);
        self.show();
        true
    }
}
