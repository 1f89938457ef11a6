//! Where the land around the near water is, as the picture shows it.
//!
//! A cell of the ripples is land as far as the picture shows land where the resting water would be seen: on it, or behind it.
//! What lies beyond the picture is as its border is.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::camera::PinholeCamera;
use crate::picture::Mask;
use crate::water::ripples::RippleGrid;

/// Samples along the side of a cell that the shore runs through.
const SAMPLES: usize = 4;

/// Coverage from which a pixel is land.
const LAND: u8 = 128;

/// The land around a grid of ripples; a clone shares it.
#[derive(Clone, Debug, Default)]
pub(super) struct Shore {
    /// Share of water in each cell, row by row; empty where there is no land at all.
    water: Arc<[f32]>,
}

impl Shore {
    /// The land that a mask of the camera's picture shows; none when it has another size.
    pub(super) fn new(camera: &PinholeCamera, land: &Mask, grid: &RippleGrid) -> Self {
        let size = camera.intrinsics.size;
        if land.size() != size {
            return Self::default();
        }
        let last = size.as_dvec2() - 1.0;
        let is_land = |place: DVec2| {
            let xz = grid.origin + grid.cell * place;
            camera.project(DVec3::new(xz.x, 0.0, xz.y)).is_some_and(|point| {
                let pixel = point.0.floor().clamp(DVec2::ZERO, last).as_uvec2();
                land.get(pixel.x, pixel.y) >= LAND
            })
        };
        let corners: Vec<Vec<bool>> = (0..=grid.size)
            .map(|row| (0..=grid.size).map(|column| is_land(place(column, row, 0.0, 0.0))).collect())
            .collect();
        let share = |column: usize, row: usize| {
            let around = [&corners[row], &corners[row + 1]].map(|line| [line[column], line[column + 1]]);
            let around = around.as_flattened();
            if around.iter().all(|&land| land == around[0]) {
                return f32::from(u8::from(!around[0]));
            }
            let part = |sample: usize| (sample as f64 + 0.5) / SAMPLES as f64;
            let water = (0..SAMPLES * SAMPLES)
                .filter(|sample| !is_land(place(column, row, part(sample % SAMPLES), part(sample / SAMPLES))))
                .count();
            water as f32 / (SAMPLES * SAMPLES) as f32
        };
        let cells = (0..grid.size * grid.size).map(|cell| share(cell % grid.size, cell / grid.size));
        let water: Vec<f32> = cells.collect();
        if water.iter().all(|&water| water == 1.0) { Self::default() } else { Self { water: water.into() } }
    }

    /// Whether the cell around a point has land in it.
    pub(super) fn is_land(&self, grid: &RippleGrid, xz: DVec2) -> bool {
        let [column, row] = grid.to_cells(xz).round().as_uvec2().to_array().map(|place| place as usize);
        self.water.get(row * grid.size + column).is_some_and(|&water| water < 1.0)
    }

    /// Makes a wall of the land.
    pub(super) fn cut_from(&self, mask: &mut [f32]) {
        for (mask, water) in mask.iter_mut().zip(self.water.iter()) {
            *mask *= water;
        }
    }
}

/// A place in a cell, in columns and rows from the grid's corner.
fn place(column: usize, row: usize, right: f64, down: f64) -> DVec2 {
    DVec2::new(column as f64 + right, row as f64 + down)
}
