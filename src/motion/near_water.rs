//! The water as it is now, and its near part, where ripples run.
//!
//! The grid of the ripples lies fixed before the picture's camera. What stands in the water is a wall in it, and so is the
//! land around. What floats or sails is no wall: it presses on the water.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::shore::Shore;
use crate::camera::PinholeCamera;
use crate::picture::PicturePoint;
use crate::scene::TourScene;
use crate::tour::Motion;
use crate::tour::Object;
use crate::tour::Sea;
use crate::tour::Support;
use crate::tour::Tour;
use crate::water::ripples::Footprint;
use crate::water::ripples::RippleGrid;
use crate::water::ripples::RippleOptions;
use crate::water::ripples::RippleSolver;
use crate::water::ripples::Ripples;
use crate::water::sea::SeaSurface;

/// Cells along a side of the grid.
const CELLS: usize = 256;

/// Share of the grid's side that shows its ripples wholly; they fade in the rest.
const SHOWN: f64 = 0.8;

/// How many times as far as the nearest water of the picture the ripples reach.
const REACH: f64 = 8.0;

/// Finest and coarsest cells, meters.
const CELL: [f64; 2] = [0.05, 0.5];

/// Nearest and farthest water to begin at, meters.
const NEAREST: [f64; 2] = [0.5, 1e4];

/// Breadth of what stands in the water, per length of its contact line (notes §7.5: rocks).
const BREADTH: f64 = 0.35;

/// The near water.
#[derive(Clone, Debug)]
pub(super) struct NearWater {
    pub(super) ripples: Ripples,
    /// Whether something stands in the water.
    has_walls: bool,
    shore: Shore,
}

impl NearWater {
    /// Still ripples with the tour's walls; remarks name what is none.
    pub(super) fn new(
        tour: &Tour,
        scene: &TourScene,
        shore: Shore,
        remarks: &mut Vec<String>,
    ) -> Option<Self> {
        if !scene.water || !tour.waves.ripples {
            return None;
        }
        let grid = grid(&scene.camera);
        let mut mask = vec![1.0; grid.size * grid.size];
        for object in tour.objects.iter().filter(|object| is_wall(object)) {
            match footprint(object, &scene.camera) {
                Ok(footprint) => footprint.cover(&grid).cut_from(&mut mask),
                Err(reason) => remarks.push(format!("waves pass through \"{}\": {reason}", object.name)),
            }
        }
        let mut options = RippleOptions::default();
        if let Sea::Jonswap(sea) = &tour.waves.sea {
            options.solver = RippleSolver::Dispersive { depth: sea.depth };
        }
        let has_walls = mask.iter().any(|&water| water < 1.0);
        shore.cut_from(&mut mask);
        match Ripples::new(grid, options, &mask) {
            Ok(ripples) => Some(Self { ripples, has_walls, shore }),
            Err(error) => {
                remarks.push(format!("the water makes no ripples: {error}"));
                None
            }
        }
    }

    /// Whether a sea by itself raises ripples here.
    pub(super) fn has_walls(&self) -> bool {
        self.has_walls
    }

    /// The land around.
    pub(super) fn shore(&self) -> &Shore {
        &self.shore
    }

    /// Throws the waves of the sea back from walls.
    ///
    /// The land throws back ripples alone. The sea of a tour is the same all over the water: thrown back by a whole shore it
    /// would run twice as high, or not at all, as far as the ripples reach and no farther.
    pub(super) fn throw_back(&mut self, sea: &SeaSurface) {
        if self.has_walls && sea.present_gain() > 0.0 {
            let (grid, shore) = (*self.ripples.grid(), &self.shore);
            self.ripples.throw_back(|xz| {
                if shore.is_land(&grid, xz) {
                    return [0.0; 2];
                }
                let wave = sea.sample(xz);
                [wave.height, wave.potential]
            });
        }
    }
}

/// The grid before a camera: ripples show wholly from the nearest water of the picture to [`REACH`] times as far, which is
/// where seven eighths of the water's rows lie (a level camera has water as far away as its rows are near the horizon). So
/// cells are 3.4 % as large as the nearest water is away: 0.17 m for eyes at 1.8 m that see the water from 5 m on.
///
/// Its sides run along x and z, its middle lies on the line along which the camera looks.
pub(super) fn grid(camera: &PinholeCamera) -> RippleGrid {
    let size = camera.intrinsics.size.as_dvec2();
    let from = DVec2::new(camera.pose.position.x, camera.pose.position.z);
    let view = camera.ray(PicturePoint(0.5 * size)).direction;
    let ahead = DVec2::new(view.x, view.z).try_normalize().unwrap_or(DVec2::NEG_Y);
    let near = [0.0, 0.5, 1.0]
        .into_iter()
        .filter_map(|share| on_water(camera, PicturePoint::new(share * size.x, size.y)))
        .map(|xz| (xz - from).dot(ahead))
        .fold(f64::INFINITY, f64::min)
        .clamp(NEAREST[0], NEAREST[1]);
    let cell = ((REACH - 1.0) * near / (SHOWN * CELLS as f64)).clamp(CELL[0], CELL[1]);
    let middle = from + (near + 0.5 * SHOWN * CELLS as f64 * cell) * ahead;
    RippleGrid::around(middle, cell, CELLS)
}

/// Where the resting water is that a picture point shows; `None` at and above the horizon.
fn on_water(camera: &PinholeCamera, point: PicturePoint) -> Option<DVec2> {
    camera.on_level(point, 0.0).map(DVec3::xz)
}

/// Whether an object throws waves back.
fn is_wall(object: &Object) -> bool {
    object.support == Support::Water && matches!(object.motion, Motion::Static)
}

/// What an object covers of the water, by its contact points; the error says in words why that is nothing.
fn footprint(object: &Object, camera: &PinholeCamera) -> Result<Footprint, String> {
    let feet = object.contact.map(|foot| on_water(camera, foot));
    let [Some(left), Some(right)] = feet else {
        return Err("its contact line is not below the horizon; lower it".into());
    };
    let seen_from = DVec2::new(camera.pose.position.x, camera.pose.position.z);
    Footprint::from_contact(&[left, right], seen_from, BREADTH).map_err(|error| error.to_string())
}
