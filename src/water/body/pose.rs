//! How far a body is from its rest, and where that brings its points.
//!
//! Rest points come back by undoing turn and tilt about the waterline's center; sway and mirroring follow after that
//! (architecture.md, decision 1). A body at rest maps every point to itself, to the bit.

use std::f64::consts::PI;

use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3, Vec4};

use super::{ahead, starboard, wrapped};

/// Half the range of the heading's cosine over which a body changes for its mirrored copy: 20° before and after it
/// points straight at the viewer, or away.
const CROSS_FADE: f64 = 0.35;

/// Where a body rests in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Berth {
    /// The waterline's center, meters.
    pub center: DVec3,
    /// Where its bow points, radians; it lies in the billboard's plane.
    pub heading: f64,
}

/// How far a body is from its rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyPose {
    /// Way of the waterline's center, meters.
    pub position: DVec3,
    /// Turn to the left about the vertical, radians.
    pub yaw: f64,
    /// Starboard side down, radians.
    pub roll: f64,
    /// Bow up, radians.
    pub pitch: f64,
    /// Share of the billboard's mirrored copy (see [`Berth::mirrored`]) in what is drawn, 0 to 1.
    pub mirrored_share: f64,
}

/// How a billboard shows a heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facing {
    /// Turn of the billboard, radians, at most 30° either way.
    pub yaw: f64,
    /// Share of the mirrored copy, 0 to 1.
    pub mirrored_share: f64,
}

/// How a billboard that rests at `rest_heading` shows a body that points to `heading` (radians).
///
/// The billboard turns by sin(2δ)/2 for a heading δ off its rest: as the body does near its plane, never more than 28.6°, and
/// back to 0 where the body points at the viewer or away. There it becomes its mirrored copy, which then turns likewise.
/// Both numbers are smooth in the heading, all the way round.
#[must_use]
pub fn facing(heading: f64, rest_heading: f64) -> Facing {
    let off = wrapped(heading - rest_heading);
    let off = if off.is_finite() { off } else { 0.0 };
    let part = (0.5 - 0.5 * off.cos() / CROSS_FADE).clamp(0.0, 1.0);
    Facing { yaw: 0.5 * (2.0 * off).sin(), mirrored_share: part * part * (3.0 - 2.0 * part) }
}

/// The heading along a billboard, one way or the other, that is nearer to `heading`. `along` is a vector (x, z) in its plane.
#[must_use]
pub fn rest_heading(along: DVec2, heading: f64) -> f64 {
    let right = (-along.y).atan2(along.x);
    if wrapped(heading - right).abs() <= PI / 2.0 { right } else { wrapped(right + PI) }
}

impl Berth {
    /// The point of the picture that a mirrored copy shows at a rest point: that as far on the other side of the center,
    /// along the billboard.
    #[must_use]
    pub fn mirrored(&self, rest: DVec3) -> DVec3 {
        let along = ahead(self.heading);
        let along = DVec3::new(along.x, 0.0, along.y);
        rest - 2.0 * (rest - self.center).dot(along) * along
    }
}

impl BodyPose {
    /// The same body as a billboard shows it: turned as by [`facing`], mirrored where it comes back, and tilted in its own plane
    /// as its keel is. For poses whose yaw is that of the body itself.
    #[must_use]
    pub fn faced(self) -> Self {
        let Facing { yaw, mirrored_share } = facing(self.yaw, 0.0);
        let upright = Self { position: self.position, yaw, mirrored_share, ..Self::default() };
        upright.with_waves(&Self { position: DVec3::ZERO, ..self }, self.yaw - yaw)
    }

    /// This pose, with what waves do to it. `afloat` is the body's own motion, pitched and rolled about a keel that points
    /// `turned` (radians) to the left of the billboard.
    #[must_use]
    pub fn with_waves(self, afloat: &Self, turned: f64) -> Self {
        let (sin, cos) = turned.sin_cos();
        Self {
            position: self.position + afloat.position,
            pitch: self.pitch + afloat.pitch * cos - afloat.roll * sin,
            roll: self.roll + afloat.pitch * sin + afloat.roll * cos,
            ..self
        }
    }

    /// Whether all its numbers are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.position.is_finite()
            && [self.yaw, self.roll, self.pitch, self.mirrored_share].iter().all(|number| number.is_finite())
    }

    /// Where a rest point is now.
    #[must_use]
    pub fn moved(&self, berth: &Berth, rest: DVec3) -> DVec3 {
        berth.center + self.position + self.rotation(berth) * (rest - berth.center)
    }

    /// The rest point of what is at `point` now.
    #[must_use]
    pub fn rest_point(&self, berth: &Berth, point: DVec3) -> DVec3 {
        self.rest_from_world(berth).transform_point3(point)
    }

    /// The same as rows of a 3×4 matrix for the shader: coordinate i of the rest point is `rows[i] · (point, 1)`.
    #[must_use]
    pub fn rest_from_tour(&self, berth: &Berth) -> [Vec4; 3] {
        let rest = self.rest_from_world(berth);
        let rows = rest.matrix3.transpose();
        [
            rows.x_axis.extend(rest.translation.x).as_vec4(),
            rows.y_axis.extend(rest.translation.y).as_vec4(),
            rows.z_axis.extend(rest.translation.z).as_vec4(),
        ]
    }

    fn rest_from_world(&self, berth: &Berth) -> DAffine3 {
        let back = self.rotation(berth).transpose();
        DAffine3 { matrix3: back, translation: berth.center - back * (berth.center + self.position) }
    }

    /// Turns the body as it rests to how it is now: roll first, then pitch, then yaw.
    fn rotation(&self, berth: &Berth) -> DMat3 {
        let bow = ahead(berth.heading);
        let right = starboard(bow);
        let about = |axis: DVec2, angle| DQuat::from_axis_angle(DVec3::new(axis.x, 0.0, axis.y), angle);
        DMat3::from_quat(DQuat::from_rotation_y(self.yaw) * about(right, self.pitch) * about(bow, self.roll))
    }
}
