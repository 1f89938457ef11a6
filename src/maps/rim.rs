//! The rim of what moves: water beside its mirror image that shows parts of its body, or mixes it with what is behind.
//!
//! Taken for what is behind, they would stay there as a fringe of the old place when it leaves. So nothing behind takes its
//! texels from them: to it they are holes, and the lift gives what is left of them to what moves. Pixels that what is
//! behind explains by itself stay its own, so that no water is carried along that need not be. What rests has no rim.
//!
//! Beside the direct image the fringe of all outlines is enough: there is no second body, and no ripple, to see around it;
//! more would be carried along as specks of the old water.

use glam::IVec2;

use super::Grid;
use super::coverage::{Coverage, TourMasks, grow};
use super::cutout::OUTLINED;
use super::mirror::{Mirrored, mirrored};
use super::reflection::{linear, tolerance};
use super::softness::blur_px;
use super::tint::Tint;
use super::zones::{Zone, Zones};
use crate::picture::Picture;
use crate::picture::PicturePoint;
use crate::picture::color::srgb_from_linear;
use crate::scene::Role;
use crate::scene::TourScene;
use crate::scene::margin_px;

/// How far a mirror image is smeared up and down, in standard deviations of the blur by ripples.
const SMEARED: f32 = 2.0;

/// What decides who a pixel of a rim belongs to.
struct Rims<'a> {
    scene: &'a TourScene,
    picture: &'a Picture,
    tint: &'a Tint,
    coverage: &'a Coverage,
    /// How far a rim reaches beyond the fringe that components have anyway, pixels.
    width: i32,
    /// By how many codes what is behind may miss a pixel that it explains: half of what the fit may miss, for a fringe is a
    /// line, and lines are seen sooner.
    explained: u8,
}

/// Gives the rims of all billboards that move to them, as far as `coverage`, `zones` and `owner` (as
/// [`seen_owner`](super::zones::seen_owner)) say who shows where. Without any nothing changes.
pub(super) fn give_rims(
    scene: &TourScene,
    picture: &Picture,
    masks: &TourMasks,
    tint: &Tint,
    coverage: &Coverage,
    zones: &mut Zones,
    owner: &mut Grid<u8>,
) {
    let width = (OUTLINED * picture.size().x as f32).round().max(1.0) as i32;
    let rims = Rims { scene, picture, tint, coverage, width, explained: tolerance(tint) / 2 };
    let billboards =
        (0..scene.components.len()).filter(|&index| scene.components[index].role == Role::Billboard);
    for (index, _) in billboards.zip(&masks.moving).filter(|(_, moves)| **moves) {
        if let Some(zone) = &mut zones[index] {
            rims.give(index, zone, owner);
        }
    }
}

impl Rims<'_> {
    /// Gives a component the rim of its mirror image, as wide as ripples smear it.
    fn give(&self, index: usize, zone: &mut Zone, owner: &mut Grid<u8>) {
        let near = grow(&zone.grown, self.width, self.picture.size());
        let is_rim = |pixel: IVec2| {
            let (Some(own), Some(behind)) = (self.mirrored(index, pixel), self.shown(owner, pixel)) else {
                return false;
            };
            let covers = |step: i32| zone.coverage.get(pixel + IVec2::new(0, step)).unwrap_or(0) > 0;
            let is_near = near.get(pixel).unwrap_or(0) > 0
                || (1..=self.smear_px(&own)).any(|step| covers(step) || covers(-step));
            is_near && behind.parameter > own.parameter && self.is_unexplained(owner, pixel)
        };
        let rim = Grid::from_fn(zone.grown.origin, zone.grown.size, |pixel| {
            zone.grown.get(pixel) == Some(0) && is_rim(pixel)
        });
        for (cell, _) in rim.cells.iter().enumerate().filter(|(_, is_rim)| **is_rim) {
            zone.grown.cells[cell] = 1;
            if let Some(at) = owner.index(rim.pixel(cell)) {
                owner.cells[at] = 255;
            }
        }
    }

    /// How far a mirror image is smeared up and down where the water shows `found` of it, pixels.
    fn smear_px(&self, found: &Mirrored) -> i32 {
        let deviation = blur_px(self.scene, self.tint.slope, found.behind);
        ((SMEARED * deviation).ceil() as i32).min(margin_px(self.picture.size()))
    }

    /// What a component shows in the water at a pixel.
    fn mirrored(&self, index: usize, pixel: IVec2) -> Option<Mirrored> {
        let point = PicturePoint::pixel_center(pixel.x.into(), pixel.y.into());
        mirrored(self.scene, &self.scene.components[index].surface, point)
    }

    /// What the owner of a water pixel shows there.
    fn shown(&self, owner: &Grid<u8>, pixel: IVec2) -> Option<Mirrored> {
        let index = owner.get(pixel).filter(|&index| index != 255)?;
        self.mirrored(index.into(), pixel)
    }

    /// Whether a water pixel has an owner that does not explain its color.
    fn is_unexplained(&self, owner: &Grid<u8>, pixel: IVec2) -> bool {
        let Some(found) = self.shown(owner, pixel) else { return false };
        let at = found.direct.0.floor().as_ivec2();
        let is_pure = owner.get(pixel).is_some_and(|index| self.coverage.is_pure(index.into(), at));
        if !is_pure {
            return true;
        }
        let expected = self.tint.mirrored(linear(self.picture, at), found.grazing).map(srgb_from_linear);
        let codes = self.picture.pixel(pixel.x as u32, pixel.y as u32);
        (0..3).any(|c| codes[c].abs_diff(expected[c]) > self.explained)
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, UVec2};

    use super::super::lift::over;
    use super::super::{Edge, MapOptions, Maps};
    use super::*;
    use crate::camera::{CameraPose, Intrinsics, PinholeCamera};
    use crate::picture::Mask;
    use crate::picture::color::linear_from_srgb;
    use crate::scene::{BackdropPlace, BackdropPlan, BillboardPlan, ScenePlan, build};
    use crate::tour::Support;

    const SIZE: UVec2 = UVec2::new(480, 240);
    /// Rows of the horizon, of the far shore 50 m away, and of the boat's contact line 10 m away; its height in pixels.
    const HORIZON: i32 = 100;
    const SHORE: i32 = 116;
    const CONTACT: i32 = 180;
    const HEIGHT: i32 = 32;
    const LIP: [u8; 3] = [250, 240, 220];
    /// The row below the boat's mirror image just beyond the fringe that all components have.
    const LIP_ROW: i32 = CONTACT + HEIGHT + 2;

    fn in_boat(pixel: IVec2) -> bool {
        (200..280).contains(&pixel.x) && (CONTACT - HEIGHT..CONTACT).contains(&pixel.y)
    }

    /// What is seen where no lip is: a smooth backdrop and a dark boat, both in still water.
    fn clean(pixel: IVec2) -> [u8; 3] {
        let direct = |pixel: IVec2| -> [u8; 3] {
            if in_boat(pixel) {
                return [30, 22, 20];
            }
            let [x, y] = [pixel.x, pixel.y].map(|x| f64::from(x) / 100.0);
            [120.0 + 40.0 * x.sin(), 140.0 + 30.0 * (x + y).cos(), 170.0 + 30.0 * y].map(|code| code as u8)
        };
        let in_water =
            |pixel: IVec2| direct(pixel).map(|code| srgb_from_linear(0.7 * linear_from_srgb(code) + 0.01));
        let mirrored = |row: i32| IVec2::new(pixel.x, 2 * row - 1 - pixel.y);
        match pixel.y {
            y if y < SHORE || in_boat(pixel) => direct(pixel),
            _ if in_boat(mirrored(CONTACT)) => in_water(mirrored(CONTACT)),
            _ => in_water(mirrored(SHORE)),
        }
    }

    fn is_lip(pixel: IVec2) -> bool {
        (205..275).contains(&pixel.x) && pixel.y == LIP_ROW
    }

    fn maps(moving: bool) -> Maps {
        let pixels = || (0..SIZE.y as i32).flat_map(|y| (0..SIZE.x as i32).map(move |x| IVec2::new(x, y)));
        let picture = pixels().map(|pixel| if is_lip(pixel) { LIP } else { clean(pixel) }).collect();
        let mask =
            Mask::new(SIZE, pixels().map(|pixel| if in_boat(pixel) { 255 } else { 0 }).collect()).unwrap();
        let point = |x: i32, y: i32| PicturePoint::new(x.into(), y.into());
        let camera = PinholeCamera {
            intrinsics: Intrinsics { focal_px: 400.0, principal: point(240, HORIZON), size: SIZE },
            pose: CameraPose::from_angles(DVec3::new(0.0, 2.0, 0.0), 0.0, 0.0, 0.0),
        };
        let (scene, remarks) = build(&ScenePlan {
            camera,
            water: true,
            ground_height: None,
            backdrops: vec![BackdropPlan { name: "shore".into(), place: BackdropPlace::Distance(50.0) }],
            billboards: vec![BillboardPlan {
                name: "boat".into(),
                support: Support::Water,
                contact: [point(200, CONTACT), point(280, CONTACT)],
                turns_to_camera: false,
                mask_box: [IVec2::new(200, CONTACT - HEIGHT), IVec2::new(280, CONTACT)],
            }],
        });
        assert!(remarks.is_empty(), "{remarks:?}");
        let masks = TourMasks {
            water: None,
            ground: None,
            backdrops: vec![None],
            billboards: vec![&mask],
            edges: vec![Edge::Exact],
            moving: vec![moving],
        };
        let picture = Picture::new(SIZE, picture).unwrap();
        Maps::build(&scene, &picture, &masks, &MapOptions::PREVIEW, &|_, _| true).unwrap()
    }

    /// What the shore's mirror image shows, and what the first view shows, at a water pixel.
    fn shown(maps: &Maps, pixel: IVec2) -> ([u8; 3], [u8; 3]) {
        let [shore, boat] = &maps.components[..] else { panic!("two components") };
        let [r, g, b, _] = shore.reflection.as_ref().unwrap().layer.get(pixel).unwrap();
        let layers = [&boat.reflection.as_ref().unwrap().layer, &boat.texture.layer];
        let first_view = layers
            .iter()
            .filter_map(|layer| layer.get(pixel))
            .fold([r, g, b].map(linear_from_srgb), |behind, texel| over(texel, behind));
        ([r, g, b], first_view.map(srgb_from_linear))
    }

    fn off(a: [u8; 3], b: [u8; 3]) -> u8 {
        (0..3).map(|c| a[c].abs_diff(b[c])).max().unwrap()
    }

    #[test]
    fn nothing_of_a_boat_s_rim_stays_when_it_sails() {
        let (resting, sailing) = (maps(false), maps(true));
        for pixel in (205..275).map(|x| IVec2::new(x, LIP_ROW)) {
            let (stays, first) = shown(&resting, pixel);
            assert_eq!((off(stays, LIP), off(first, LIP)), (0, 0), "at rest, at {pixel}");
            let (stays, first) = shown(&sailing, pixel);
            assert!(off(first, LIP) <= 1, "{first:?} in the first view at {pixel}");
            let expected = clean(pixel);
            assert!(off(stays, expected) <= 8, "{stays:?} instead of {expected:?} stays at {pixel}");
        }
    }

    #[test]
    fn water_that_needs_no_boat_is_not_carried_along() {
        let sailing = maps(true);
        let boat = &sailing.components[1].reflection.as_ref().unwrap().layer;
        // Both lie in the rim, beside the lip and beside the hull.
        let beside_lip = [202, 203, 277, 278].map(|x| IVec2::new(x, LIP_ROW));
        for pixel in beside_lip.into_iter().chain((185..205).map(|y| IVec2::new(197, y))) {
            let carried = boat.get(pixel).map_or(0, |texel| texel[3]);
            assert!(carried <= 2, "{carried} of 255 are carried along at {pixel}");
        }
    }
}
