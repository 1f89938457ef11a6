//! A picture whose mirror image is smeared by ripples: their slope is found, and what was not seen is smeared alike.

use std::sync::Arc;

use bevy_picture_tour::assemble::{TourSource, assemble};
use bevy_picture_tour::maps::{MapOptions, Maps};
use bevy_picture_tour::picture::color::{linear_from_srgb3, srgb_from_linear3};
use bevy_picture_tour::picture::{Picture, PicturePoint};
use glam::UVec2;

use crate::support::made_scene::{self, DISTANCE, FOCAL_PX, SIZE};

/// The made scene, the wall's mirror image smeared along columns as ripples of this slope do (notes §8.4).
fn smeared(slope: f64) -> Arc<Maps> {
    let still = made_scene::source();
    let water = still.water.as_ref().expect("the made scene has water");
    let camera = made_scene::camera();
    let is_water = |x: u32, y: i64| (0..i64::from(SIZE.y)).contains(&y) && water.get(x, y as u32) == 255;
    let mut pixels = Vec::new();
    for y in 0..SIZE.y {
        for x in 0..SIZE.x {
            let own = still.picture.pixel(x, y);
            let ray = camera.ray(PicturePoint::pixel_center(x.into(), y.into()));
            let to_water = -ray.origin.y / ray.direction.y;
            let behind = 1.0 + to_water * ray.direction.z / DISTANCE;
            let deviation = 2.0 * FOCAL_PX * slope * behind;
            if water.get(x, y) < 255 || deviation < 0.1 {
                pixels.push(own);
                continue;
            }
            let (mut sum, mut weights) = ([0.0_f32; 3], 0.0_f32);
            for up in -40_i64..=40 {
                let row = i64::from(y) + up;
                if is_water(x, row) {
                    let weight = (-0.5 * (up as f64 / deviation).powi(2)).exp() as f32;
                    let color = linear_from_srgb3(still.picture.pixel(x, row as u32));
                    (0..3).for_each(|c| sum[c] += weight * color[c]);
                    weights += weight;
                }
            }
            pixels.push(srgb_from_linear3(sum.map(|x| x / weights)));
        }
    }
    let picture = Picture::new(UVec2::new(SIZE.x, SIZE.y), pixels).unwrap();
    let source = TourSource { picture, ..(*still).clone() };
    assemble(&source, &MapOptions::PREVIEW, &|_, _| true).unwrap().maps
}

#[test]
fn the_slope_of_ripples_is_found_and_still_water_has_none() {
    assert_eq!(smeared(0.0).tint.slope, 0.0);
    // The boat and its mirror image are smeared as if they stood at the wall: their edges look too sharp for the slope.
    let found = f64::from(smeared(0.008).tint.slope);
    assert!((found / 0.008 - 1.0).abs() < 0.4, "{found} instead of 0.008");
}
