//! Where the picture still holds: how far a camera may go before what it shows is mostly made up.

use glam::{DVec2, DVec3};

use super::{Role, SceneComponent, Surface};
use crate::camera::PinholeCamera;

/// A box in the world that keeps a visitor's camera where the picture still holds.
///
/// It grows with the distance of the nearest billboard: parallax uncovers what the picture never saw in proportion to
/// the move over that distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraBounds {
    /// Lowest corner, meters.
    pub low: DVec3,
    /// Highest corner, meters.
    pub high: DVec3,
    /// Distance of the nearest billboard, meters, above 0: the length by which moves in this scene are measured.
    pub nearest: f64,
    /// How far a visitor may turn from the picture's own view, yaw and pitch in radians: maps end beyond.
    pub look: DVec2,
}

/// How far maps reach beyond the picture's left, right and upper border, as a share of its width and height.
pub const BEYOND_BORDER: f64 = 0.15;

/// Share of what lies beyond the border that turning may show; leaning shows some more.
const LOOK: f64 = 0.8;

/// Share of the nearest billboard's distance that a camera may go sideways.
const SIDEWAYS: f64 = 0.35;
/// Share of it that it may go forward: nearer, a billboard is seen to be flat.
const FORWARD: f64 = 0.6;
/// Share of it that it may go back: the frame's border comes into sight.
const BACK: f64 = 0.1;
/// Lowest and highest camera, as shares of the height the picture was taken from.
const HEIGHT: [f64; 2] = [0.35, 2.2];
/// Without billboards, the share of the nearest backdrop's distance that stands for the nearest one.
const EMPTY_SCENE: f64 = 0.15;
/// Meters at which a scene without any upright plane is taken to stand.
const NOWHERE: f64 = 100.0;

impl CameraBounds {
    /// The bounds of a scene's components.
    pub(super) fn of(
        camera: &PinholeCamera,
        ground_height: Option<f64>,
        components: &[SceneComponent],
    ) -> Self {
        let at = camera.pose.position;
        let nearest_end = |billboards: bool| {
            components
                .iter()
                .filter(|component| (component.role == Role::Billboard) == billboards)
                .filter_map(|component| match &component.surface {
                    Surface::Wall(wall) if billboards => {
                        wall.ends().iter().map(|end| at.z - end.y).min_by(f64::total_cmp)
                    }
                    // Bands are prolonged beyond what is seen, so their middle counts.
                    Surface::Wall(wall) => {
                        let middle = wall.foot + wall.along * 0.5 * (wall.span[0] + wall.span[1]);
                        Some(at.z - middle.y)
                    }
                    Surface::Level(_) | Surface::Infinity => None,
                })
                .min_by(f64::total_cmp)
        };
        let backdrop = EMPTY_SCENE * nearest_end(false).unwrap_or(NOWHERE);
        let nearest = nearest_end(true).unwrap_or(backdrop).min(backdrop).max(0.5);
        let ground = ground_height.unwrap_or(0.0);
        let low = ground + HEIGHT[0] * (at.y - ground);
        let lens = &camera.intrinsics;
        Self {
            nearest,
            look: lens.size.as_dvec2() * (LOOK * BEYOND_BORDER / lens.focal_px),
            low: DVec3::new(at.x - SIDEWAYS * nearest, low, at.z - FORWARD * nearest),
            high: DVec3::new(at.x + SIDEWAYS * nearest, HEIGHT[1] * at.y, at.z + BACK * nearest),
        }
    }
}
