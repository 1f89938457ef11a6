//! What annotations must fulfil before any solving; the rest of the module relies on it.
//!
//! Every number is finite, lengths are above 0, and every index names a plane.

use super::AnnotatedPair;
use super::Annotations;
use super::BackgroundHint;
use super::FocalLength;
use super::PairPlane;
use super::Scale;
use super::SolveError;
use crate::picture::PicturePoint;

impl Annotations {
    /// Finds the first annotation that no solver could use.
    pub(super) fn check(&self) -> Result<(), SolveError> {
        above_zero("the picture's width in pixels", f64::from(self.size.x))?;
        above_zero("the picture's height in pixels", f64::from(self.size.y))?;
        above_zero("the uncropped picture's width in pixels", f64::from(self.uncropped_size.x))?;
        finite("the principal point", self.principal)?;
        not_below_zero("the principal point's deviation", self.principal_deviation_px)?;
        above_zero("the horizon's deviation", self.horizon_deviation_px)?;
        if let Some([left, right]) = self.horizon {
            finite("the horizon", left)?;
            finite("the horizon", right)?;
            let across = (left.0 - right.0).abs();
            if across.x < across.y.max(1.0) {
                return Err(SolveError::HorizonTooSteep { left, right });
            }
        }
        self.check_focal()?;
        self.check_scale()?;
        for plane in &self.planes {
            finite(&format!("the contact line of {:?}", plane.name), plane.contact[0])?;
            finite(&format!("the contact line of {:?}", plane.name), plane.contact[1])?;
        }
        match &self.background {
            BackgroundHint::Distance(meters) => above_zero("the background's distance", *meters)?,
            BackgroundHint::Contact(points) => {
                points.iter().try_for_each(|&point| finite("the background's contact line", point))?;
            }
            BackgroundHint::FromPairs | BackgroundHint::Open => {}
        }
        self.ground_contact
            .iter()
            .try_for_each(|&point| finite("the background's line on the ground", point))?;
        self.pairs.iter().try_for_each(|pair| self.check_pair(pair))
    }

    fn check_focal(&self) -> Result<(), SolveError> {
        match self.focal {
            FocalLength::Known(px) => above_zero("the focal length", px),
            FocalLength::Between(min, max) => {
                above_zero("the shortest focal length", min)?;
                above_zero("the longest focal length less the shortest", max - min)
            }
            FocalLength::Prior { px, ln_deviation } => {
                above_zero("the focal length", px)?;
                above_zero("the focal length's deviation", ln_deviation)
            }
            FocalLength::Unknown => Ok(()),
        }
    }

    fn check_scale(&self) -> Result<(), SolveError> {
        if let Some(meters) = self.ground_height {
            not_below_zero("the ground's height above the water", meters)?;
        }
        match self.scale {
            Scale::HeightAboveWater { meters, .. } => {
                above_zero("the camera's height above the water", meters)?;
                let above_ground = meters - self.ground_height.unwrap_or(0.0);
                above_zero("the camera's height above the ground", above_ground)
            }
            Scale::HeightAboveGround(meters) => above_zero("the camera's height above the ground", meters),
            Scale::Length { on, from, to, meters } => {
                self.check_plane("the known length", on)?;
                finite("the known length", from)?;
                finite("the known length", to)?;
                above_zero("the known length", meters)
            }
        }
    }

    fn check_pair(&self, pair: &AnnotatedPair) -> Result<(), SolveError> {
        let name = &pair.name;
        finite(&format!("pair {name:?}"), pair.point)?;
        finite(&format!("the reflection of pair {name:?}"), pair.reflection)?;
        for deviation in
            [pair.point_deviation_px, pair.reflection_deviation_px[0], pair.reflection_deviation_px[1]]
        {
            above_zero(&format!("a deviation of pair {name:?}"), deviation)?;
        }
        match pair.on {
            PairPlane::Plane(index) => self.check_plane(&format!("pair {name:?}"), index),
            PairPlane::Free | PairPlane::Background => Ok(()),
        }
    }

    fn check_plane(&self, what: &str, index: usize) -> Result<(), SolveError> {
        if index < self.planes.len() {
            return Ok(());
        }
        Err(SolveError::UnknownPlane { what: what.to_owned(), index, planes: self.planes.len() })
    }
}

fn finite(what: &str, point: PicturePoint) -> Result<(), SolveError> {
    if point.0.is_finite() {
        return Ok(());
    }
    let value = if point.x().is_finite() { point.y() } else { point.x() };
    Err(SolveError::OutOfRange { what: what.to_owned(), value, must_be: "finite" })
}

fn above_zero(what: &str, value: f64) -> Result<(), SolveError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(SolveError::OutOfRange { what: what.to_owned(), value, must_be: "above 0" })
}

fn not_below_zero(what: &str, value: f64) -> Result<(), SolveError> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(SolveError::OutOfRange { what: what.to_owned(), value, must_be: "0 or more" })
}
