//! A visitor's way of looking around in a picture: one controller for mouse, touch, gamepad and keyboard.
//!
//! The camera never leaves its bounds, never rolls, and comes home to exactly where the painter stood. It is a function
//! of its arguments; two half steps are one whole step (where it walks while the wanted yaw turns: nearly so).

use std::array;
use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::CameraPose;

/// How a visitor moves. Lengths are shares of `scale`, so that a pond and a fjord feel alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VisitorSettings {
    /// Meters that are near in this scene, such as the distance of its nearest object; above 0.
    pub scale: f64,
    /// Speed sideways and up at a full wish, in scales per second, at least 0.
    pub lean_speed: f64,
    /// Speed forward and back at a full wish, in scales per second, at least 0.
    pub step_speed: f64,
    /// How far the camera shifts with each radian that it looks aside, in scales, so that looking shows parallax.
    pub sway: f64,
    /// Time constant of all motion but going home, in seconds, above 0: short is crisp, long is floating.
    pub glide: f64,
    /// Time constant of going home, in seconds, above 0.
    pub home_glide: f64,
    /// The farthest turns of yaw and pitch to either side of the painter's view, in radians, at least 0.
    pub look_limit: DVec2,
    /// Share of the bounds that may be used, from 0 (turns only) to 1.
    pub reach: f64,
}

impl Default for VisitorSettings {
    fn default() -> Self {
        Self {
            scale: 10.0,
            lean_speed: 0.15,
            step_speed: 0.25,
            sway: 0.08,
            glide: 0.12,
            home_glide: 0.5,
            look_limit: DVec2::new(35.0_f64.to_radians(), 20.0_f64.to_radians()),
            reach: 1.0,
        }
    }
}

/// What a visitor wants during one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VisitorWish {
    /// To go sideways (right > 0) and up, each −1 to 1: held keys, a stick.
    pub lean: DVec2,
    /// To go forward (> 0) or back, −1 to 1: held keys, a stick.
    pub step: f64,
    /// How far to come forward in this frame, in scales: a wheel's notches, a pinch.
    pub advance: f64,
    /// How far to turn in this frame, yaw (left > 0) and pitch (up > 0) in radians: a drag, a stick times the frame.
    pub look: DVec2,
    /// To glide home, until any other wish comes. Goes before what else is wished in this frame.
    pub go_home: bool,
}

/// Where a visitor is, relative to the home pose, and how fast. The default is at rest at home.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Visitor {
    /// Meters along the world's x, y and z; yaw and pitch in radians; all before they are softened at their limits.
    axes: [Glide; 5],
    homing: bool,
}

/// One axis: it follows what is wanted as a critically damped spring does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Glide {
    wanted: f64,
    now: f64,
    speed: f64,
}

/// Share of an axis' reach in which it is slowed; before that, it is free.
const SOFT: f64 = 0.25;
/// How far beyond its reach an axis may be wanted, as a share of it: enough to come close to the limit, so little that
/// turning back answers at once.
const BEYOND: f64 = 1.25;
/// Nearer to home than this, in meters and radians, one is at home.
const ARRIVED: f64 = 1e-4;
/// Steepest view in radians, so that no home's own pitch brings a visitor to stand on the head.
const STEEPEST: f64 = 1.5;

impl Visitor {
    /// The visitor `delta_seconds` later.
    ///
    /// `bounds` are the lowest and the highest corner of where the camera may be.
    #[must_use]
    pub fn step(
        &self,
        settings: &VisitorSettings,
        home: &CameraPose,
        bounds: [DVec3; 2],
        wish: &VisitorWish,
        delta_seconds: f64,
    ) -> Self {
        // Not 0, for a wish in a frame without time still counts; not a number, or over an hour, is a clock's fault.
        let seconds = known(delta_seconds).clamp(1e-6, 3600.0);
        let rests = VisitorWish { go_home: false, ..*wish } == VisitorWish::default();
        let homing = wish.go_home || (self.homing && rests);
        let glide = if homing { settings.home_glide } else { settings.glide };
        let glide = known(glide).clamp(1e-3, 1e3);
        let axes = match (homing, self.homing) {
            (true, _) => self.axes.map(|axis| Glide { wanted: 0.0, ..axis }),
            // Called off on the way home: runs out from here.
            (false, true) => self.axes.map(|axis| Glide { wanted: axis.now + glide * axis.speed, ..axis }),
            (false, false) => self.axes,
        };
        let limits = limits(settings, home, bounds);
        let rates = if homing { [0.0; 5] } else { rates(&axes, &limits, settings, home, wish, seconds) };
        let axes = array::from_fn(|i| axes[i].toward(rates[i], limits[i], glide, seconds));
        let next = Self { axes, homing };
        if homing && next.arrives(settings, home, bounds) { Self::default() } else { next }
    }

    /// Where the visitor's camera stands and looks: in the bounds, or where `home` is on an axis on which that lies
    /// outside; with `home`'s roll.
    #[must_use]
    pub fn pose(&self, settings: &VisitorSettings, home: &CameraPose, bounds: [DVec3; 2]) -> CameraPose {
        let now = self.axes.map(|axis| axis.now);
        if now == [0.0; 5] {
            return *home;
        }
        let limits = limits(settings, home, bounds);
        let [turn, tilt] = [3, 4].map(|i| soften(now[i], limits[i]));
        let (yaw, pitch, roll) = home.angles();
        let sway = sway(settings, yaw, turn, tilt);
        let position = DVec3::from_array(array::from_fn(|i| {
            let (home, offset) = (home.position[i], soften(now[i] + sway[i], limits[i]));
            // Rounding must not lead out.
            (home + offset).max(bounds[0][i].min(home)).min(bounds[1][i].max(home))
        }));
        let pitch = (pitch + tilt).max(pitch.min(-STEEPEST)).min(pitch.max(STEEPEST));
        CameraPose::from_angles(position, yaw + turn, pitch, roll)
    }

    /// The visitor who rests at a camera's pose, or as near to it as the bounds let one come; roll is `home`'s.
    #[must_use]
    pub fn at(
        camera: &CameraPose,
        settings: &VisitorSettings,
        home: &CameraPose,
        bounds: [DVec3; 2],
    ) -> Self {
        let limits = limits(settings, home, bounds);
        let ((yaw, pitch, _), (home_yaw, home_pitch, _)) = (camera.angles(), home.angles());
        let turn = (yaw - home_yaw + PI).rem_euclid(2.0 * PI) - PI;
        let angles = [turn, pitch - home_pitch];
        let [turn, tilt] = array::from_fn(|i| angles[i].max(-limits[3 + i][0]).min(limits[3 + i][1]));
        let sway = sway(settings, home_yaw, turn, tilt);
        let offset = camera.position - home.position;
        let axes = array::from_fn(|i| {
            let now = match i {
                0..3 => harden(offset[i], limits[i]) - sway[i],
                3 => harden(turn, limits[3]),
                _ => harden(tilt, limits[4]),
            };
            Glide { wanted: known(now), now: known(now), speed: 0.0 }
        });
        Self { axes, homing: false }
    }

    /// Whether the visitor is on the way home.
    #[must_use]
    pub fn is_homing(&self) -> bool {
        self.homing
    }

    /// Whether one would not see it if the visitor were at rest at home.
    fn arrives(&self, settings: &VisitorSettings, home: &CameraPose, bounds: [DVec3; 2]) -> bool {
        let rests = |axis: &Glide| axis.now.abs().max(axis.speed.abs() * settings.home_glide) < ARRIVED;
        self.axes.iter().all(rests)
            && self.pose(settings, home, bounds).position.distance(home.position) < ARRIVED
    }
}

impl Glide {
    /// This axis `seconds` later, while what is wanted moves at `rate` until it stops at its limit.
    fn toward(self, rate: f64, [down, up]: [f64; 2], glide: f64, seconds: f64) -> Self {
        let (low, high) = (-BEYOND * down, BEYOND * up);
        let from = Self { wanted: self.wanted.max(low).min(high), ..self };
        let limit = if rate > 0.0 { high } else { low };
        let moving = if rate == 0.0 { 0.0 } else { ((limit - from.wanted) / rate).min(seconds) };
        let next = from.after(rate, glide, moving).after(0.0, glide, seconds - moving);
        Self { wanted: next.wanted.max(low).min(high), ..next }
    }

    /// The same without limits: the exact motion of a critically damped spring behind an evenly moving goal.
    fn after(self, rate: f64, glide: f64, seconds: f64) -> Self {
        // It settles to running two time constants behind the goal; `off` is how far it is from that.
        let off = self.now - (self.wanted - 2.0 * glide * rate);
        let pull = self.speed - rate + off / glide;
        let kept = (-seconds / glide).exp();
        let wanted = self.wanted + rate * seconds;
        Self {
            wanted,
            now: wanted - 2.0 * glide * rate + (off + pull * seconds) * kept,
            speed: rate + (pull - (off + pull * seconds) / glide) * kept,
        }
    }
}

/// How far each axis goes to its lower and to its upper side, both at least 0.
fn limits(settings: &VisitorSettings, home: &CameraPose, [low, high]: [DVec3; 2]) -> [[f64; 2]; 5] {
    let share = known(settings.reach).clamp(0.0, 1.0);
    array::from_fn(|i| match i {
        0..3 => [home.position[i] - low[i], high[i] - home.position[i]].map(|reach| share * reach.max(0.0)),
        _ => [settings.look_limit[i - 3].max(0.0); 2],
    })
}

/// How fast what is wanted moves on each axis.
fn rates(
    axes: &[Glide; 5],
    limits: &[[f64; 2]; 5],
    settings: &VisitorSettings,
    home: &CameraPose,
    wish: &VisitorWish,
    seconds: f64,
) -> [f64; 5] {
    let within = |x: f64, most: f64| known(x).clamp(-most, most);
    let [aside, up] = wish.lean.to_array().map(|lean| settings.lean_speed * within(lean, 1.0));
    let ahead = settings.step_speed * within(wish.step, 1.0) + within(wish.advance, 10.0) / seconds;
    let look = wish.look.to_array().map(|look| within(look, 10.0) / seconds);
    // Where one wants to look, not where one looks yet: a step goes to what was just turned to. Level, for the water
    // is below. Half of this frame's turn makes half steps agree.
    let (yaw, ..) = home.angles();
    let [forward, right] = level(yaw + soften(axes[3].wanted + 0.5 * look[0] * seconds, limits[3]));
    let walk = settings.scale * (forward * ahead + right * aside + DVec3::Y * up);
    [walk.x, walk.y, walk.z, look[0], look[1]].map(|rate| within(rate, 1e12))
}

/// How far a look aside and up shifts the camera of a visitor whose home looks along `yaw`.
fn sway(settings: &VisitorSettings, yaw: f64, turn: f64, tilt: f64) -> DVec3 {
    let [_, right] = level(yaw);
    let sway = settings.sway * settings.scale * (DVec3::Y * tilt - right * turn);
    if sway.is_finite() { sway } else { DVec3::ZERO }
}

/// `x`, and 0 for what is no number.
fn known(x: f64) -> f64 {
    if x.is_nan() { 0.0 } else { x }
}

/// The level directions forward and right at `yaw`.
fn level(yaw: f64) -> [DVec3; 2] {
    let (sin, cos) = yaw.sin_cos();
    [DVec3::new(-sin, 0.0, -cos), DVec3::new(cos, 0.0, -sin)]
}

/// `x` as it is well inside its limits, and slowed toward them so that it never passes one.
fn soften(x: f64, [down, up]: [f64; 2]) -> f64 {
    let reach = if x < 0.0 { down } else { up };
    let (free, soft) = ((1.0 - SOFT) * reach, SOFT * reach);
    let over = x.abs() - free;
    if over > 0.0 { (free + soft * (1.0 - (-over / soft).exp())).copysign(x) } else { x }
}

/// What [`soften`] makes to `y`; nearly the limit for what lies beyond it.
fn harden(y: f64, [down, up]: [f64; 2]) -> f64 {
    let reach = if y < 0.0 { down } else { up };
    let (free, soft) = ((1.0 - SOFT) * reach, SOFT * reach);
    let over = (y.abs() - free) / soft.max(1e-12);
    if over > 0.0 { (free - soft * (1.0 - over).max(1e-3).ln()).copysign(y) } else { y }
}

#[cfg(test)]
#[path = "visitor_tests.rs"]
mod tests;
