//! A draft with all that is known of it this frame, as every panel reads it.

use glam::{DVec2, DVec3, UVec2};

use crate::camera::PinholeCamera;
use crate::picture::PicturePoint;
use crate::solve::{Solution, SolveError};
use crate::tour::TourFile;
use crate::tour::Waypoint;
use crate::tour::edit::{Draft, History};

use super::text::Text;
use super::{DeskView, View};

/// The draft at work and what was found out about it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Work<'a> {
    pub(super) view: &'a View<'a>,
    pub(super) draft: &'a Draft,
    pub(super) tour: &'a TourFile,
    pub(super) history: &'a History,
    pub(super) text: &'static Text,
    /// The picture's size in the document's pixels; at least 1 × 1.
    pub(super) size: UVec2,
}

impl<'a> Work<'a> {
    pub(super) fn new(view: &'a View<'a>, desk: DeskView<'a>, text: &'static Text) -> Self {
        let DeskView { draft, history, .. } = desk;
        let shown = view.picture.map(|picture| picture.size);
        let size = shown.or(draft.tour.picture.size).unwrap_or(UVec2::ONE).max(UVec2::ONE);
        Self { view, draft, tour: &draft.tour, history, text, size }
    }

    pub(super) fn solution(&self) -> Option<&'a Solution> {
        self.view.solved.and_then(Result::ok)
    }

    pub(super) fn solve_error(&self) -> Option<&'a SolveError> {
        self.view.solved.and_then(Result::err)
    }

    /// The camera that took the picture, once it is solved.
    pub(super) fn camera(&self) -> Option<PinholeCamera> {
        self.solution().map(|solution| solution.parameters.camera(self.size))
    }

    /// The point of the resting water that a picture point shows; `None` on and above the horizon.
    pub(super) fn water_at(&self, point: PicturePoint) -> Option<Waypoint> {
        let hit = self.camera()?.on_level(point, 0.0)?;
        Some(Waypoint(DVec2::new(hit.x, hit.z)))
    }

    /// Where a point of the resting water is seen.
    pub(super) fn seen_at(&self, Waypoint(xz): Waypoint) -> Option<PicturePoint> {
        self.camera()?.project(DVec3::new(xz.x, 0.0, xz.y))
    }
}
