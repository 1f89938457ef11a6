//! What the solver must get right, on pictures whose answer is known.
//!
//! [`Picture`] makes annotations as a person would mark them: exact or with clicks that scatter, from a fixed seed.

mod evidence;
mod facts;
mod noise;
mod paper;
mod worlds;

use glam::DVec3;
use glam::UVec2;

use super::AnnotatedPair;
use super::AnnotatedPlane;
use super::Annotations;
use super::BackgroundHint;
use super::FocalLength;
use super::Method;
use super::PairPlane;
use super::Scale;
use super::SceneParameters;
use super::Support;
use crate::picture::PicturePoint;

/// A small generator of random numbers, the same in every run (xorshift64*).
pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// Evenly distributed between two numbers.
    pub(super) fn between(&mut self, least: f64, most: f64) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        least + (most - least) * bits as f64 / (1_u64 << 53) as f64
    }

    /// Normally distributed around 0.
    pub(super) fn normal(&mut self, deviation: f64) -> f64 {
        let radius = (-2.0 * (1.0 - self.between(0.0, 1.0)).ln()).sqrt();
        deviation * radius * self.between(0.0, std::f64::consts::TAU).cos()
    }

    fn jiggled(&mut self, point: PicturePoint, deviation: f64) -> PicturePoint {
        PicturePoint::new(point.x() + self.normal(deviation), point.y() + self.normal(deviation))
    }
}

/// What the pairs of a made picture lie on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Any depths, nothing else known.
    Free,
    /// All on one plane across the view, 60 m away.
    Wall,
    /// Objects that stand in the water, each with a visible foot.
    Standing,
}

/// A picture of 1600×1200 px from 2 m above the water, focal length 1500 px.
pub(super) struct Picture {
    pub(super) truth: SceneParameters,
    pub(super) click_px: f64,
    pub(super) horizon_px: f64,
    pub(super) pairs: usize,
    pub(super) kind: Kind,
}

pub(super) const SIZE: UVec2 = UVec2::new(1600, 1200);

impl Picture {
    /// Exact clicks, ten free pairs; pitch and roll in degrees.
    pub(super) fn new(pitch: f64, roll: f64) -> Self {
        let truth = SceneParameters {
            focal_px: 1500.0,
            principal: PicturePoint::new(800.0, 600.0),
            pitch: pitch.to_radians(),
            roll: roll.to_radians(),
            height: 2.0,
            ground_height: 0.0,
            background_distance: 120.0,
        };
        Self { truth, click_px: 0.0, horizon_px: 0.0, pairs: 10, kind: Kind::Free }
    }

    pub(super) fn annotations(&self, seed: u64) -> Annotations {
        let mut random = Random::new(seed);
        let camera = self.truth.camera(SIZE);
        let [left, right] = camera.horizon().unwrap();
        // An error in the middle and one from the middle to a border, as in the notes' table.
        let (middle, tilt) = (random.normal(self.horizon_px), random.normal(self.horizon_px));
        let horizon = [
            PicturePoint::new(left.x(), left.y() + middle - tilt),
            PicturePoint::new(right.x(), right.y() + middle + tilt),
        ];
        let mut annotations = Annotations {
            size: SIZE,
            uncropped_size: SIZE,
            principal: PicturePoint::new(800.0, 600.0),
            principal_deviation_px: 0.0,
            horizon: Some(horizon),
            horizon_deviation_px: self.horizon_px.max(0.5) * std::f64::consts::SQRT_2,
            focal: FocalLength::Unknown,
            scale: Scale::HeightAboveWater { meters: 2.0, assumed: false },
            planes: Vec::new(),
            background: BackgroundHint::Distance(120.0),
            ground_height: None,
            ground_contact: Vec::new(),
            pairs: Vec::new(),
            method: Method::Full,
        };
        let inside = |p: PicturePoint| p.x() > 0.0 && p.x() < 1600.0 && p.y() > 0.0 && p.y() < 1200.0;
        while annotations.pairs.len() < self.pairs {
            let seen = PicturePoint::new(random.between(0.0, 1600.0), random.between(0.0, 1200.0));
            let any_depth = 15.0 * 8.0_f64.powf(random.between(0.0, 1.0));
            let depth = if self.kind == Kind::Wall { 60.0 } else { any_depth };
            let ray = camera.ray(seen);
            let point = ray.at(depth / -ray.direction.z);
            let Some(reflection) = camera.project(point * DVec3::new(1.0, -1.0, 1.0)) else {
                continue;
            };
            if point.y <= 0.0 || !inside(reflection) || reflection.0.distance(seen.0) < 100.0 {
                continue;
            }
            let mut on = if self.kind == Kind::Wall { PairPlane::Background } else { PairPlane::Free };
            if self.kind == Kind::Standing {
                let foot = |x: f64| camera.project(DVec3::new(point.x + x, 0.0, point.z)).unwrap();
                let feet = [-0.02 * depth, 0.02 * depth].map(|x| random.jiggled(foot(x), self.click_px));
                on = PairPlane::Plane(annotations.planes.len());
                let name = format!("object {}", annotations.planes.len());
                annotations.planes.push(AnnotatedPlane { name, support: Support::Water, contact: feet });
            }
            let deviation = self.click_px.max(0.5);
            annotations.pairs.push(AnnotatedPair {
                point_deviation_px: deviation,
                reflection_deviation_px: [deviation; 2],
                ..AnnotatedPair::new(
                    format!("pair {}", annotations.pairs.len()),
                    random.jiggled(seen, self.click_px),
                    random.jiggled(reflection, self.click_px),
                    on,
                )
            });
        }
        annotations
    }
}
