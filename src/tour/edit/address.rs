//! Where in a document something is: typed addresses, none of which can name a wrong kind of thing.
//!
//! Indices count from 0. An address may name nothing (a corner that is gone); the edit is then refused.

use crate::picture::PicturePoint;
use crate::tour::{BackgroundPlace, Motion, Region, Scale, TourFile};

use super::{EditError, Masks};

/// A region of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RegionAt {
    /// Where water is visible.
    Water,
    /// Where ground is visible.
    Ground,
    /// Where the sky is visible.
    Sky,
    /// Where the band of this index is visible.
    Band(usize),
    /// The outline of the object of this index.
    Object(usize),
}

/// Where a plane of the background stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PlaceAt {
    /// The background as a whole.
    Background,
    /// The band of this index.
    Band(usize),
}

/// A line of points that can be longer or shorter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LineAt {
    /// The corners of a region that is a polygon.
    Region(RegionAt),
    /// The contact line of a background plane that has one.
    Place(PlaceAt),
}

/// One point of the picture that can be moved: a handle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PointAt {
    /// An end of the horizon, 0 or 1.
    Horizon(usize),
    /// Where the optical axis meets the picture.
    PrincipalPoint,
    /// An end of the known length that sets the scale, 0 or 1.
    Scale(usize),
    /// The point of the pair of this index.
    Pair(usize),
    /// The reflection of the pair of this index.
    Reflection(usize),
    /// A point of a polygon or a background's contact line.
    On(LineAt, usize),
    /// A foot of an object: (object, 0 for the left or 1 for the right).
    Foot(usize, usize),
    /// Where a swaying object is fixed.
    SwayRoot(usize),
    /// The far end of a swaying object.
    SwayTip(usize),
}

/// What has a name that pairs refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Named {
    /// The object of this index.
    Object(usize),
    /// The background band of this index.
    Band(usize),
}

/// One change of a list.
#[derive(Clone, Debug, PartialEq)]
pub enum ListEdit<T> {
    /// Puts a value before the one at an index; the list's length puts it last.
    Insert(usize, T),
    /// Takes out the value at an index.
    Remove(usize),
    /// Puts a value in the place of the one at an index.
    Replace(usize, T),
    /// Takes the value at `from` out and puts it in so that it stands at `to`.
    Move {
        /// Where it stands.
        from: usize,
        /// Where it shall stand.
        to: usize,
    },
}

impl<T: Clone> ListEdit<T> {
    /// Changes the list, or refuses an index that is not there.
    pub(super) fn apply(&self, list: &mut Vec<T>, what: &'static str) -> Result<(), EditError> {
        let most = match self {
            Self::Insert(..) => list.len() + 1,
            _ => list.len(),
        };
        let in_list = |index: usize| (index < most).then_some(()).ok_or(EditError::NoSuch { what, index });
        match self {
            Self::Insert(index, value) => {
                in_list(*index)?;
                list.insert(*index, value.clone());
            }
            Self::Remove(index) => {
                in_list(*index)?;
                list.remove(*index);
            }
            Self::Replace(index, value) => {
                in_list(*index)?;
                list[*index] = value.clone();
            }
            Self::Move { from, to } => {
                in_list(*from)?;
                in_list(*to)?;
                let value = list.remove(*from);
                list.insert(*to, value);
            }
        }
        Ok(())
    }

    /// The value that comes into the list, if one does.
    pub(super) fn value(&self) -> Option<&T> {
        match self {
            Self::Insert(_, value) | Self::Replace(_, value) => Some(value),
            Self::Remove(_) | Self::Move { .. } => None,
        }
    }
}

impl RegionAt {
    /// The region, if it is marked.
    #[must_use]
    pub fn get(self, tour: &TourFile) -> Option<&Region<String>> {
        match self {
            Self::Water => tour.water.as_ref().map(|water| &water.region),
            Self::Ground => tour.ground.as_ref().map(|ground| &ground.region),
            Self::Sky => tour.sky.as_ref()?.region.as_ref(),
            Self::Band(index) => tour.background.bands.get(index)?.region.as_ref(),
            Self::Object(index) => tour.objects.get(index).map(|object| &object.outline),
        }
    }

    /// Whether it is a mask by the machine that nobody has looked at yet. Bands are not guessed but measured.
    #[must_use]
    pub fn is_guess(self, tour: &TourFile) -> bool {
        !matches!(self, Self::Band(_))
            && matches!(self.get(tour), Some(Region::Mask(name)) if Masks::is_guess(name))
    }

    fn get_mut(self, tour: &mut TourFile) -> Option<&mut Region<String>> {
        match self {
            Self::Water => tour.water.as_mut().map(|water| &mut water.region),
            Self::Ground => tour.ground.as_mut().map(|ground| &mut ground.region),
            Self::Sky => tour.sky.as_mut()?.region.as_mut(),
            Self::Band(index) => tour.background.bands.get_mut(index)?.region.as_mut(),
            Self::Object(index) => tour.objects.get_mut(index).map(|object| &mut object.outline),
        }
    }
}

impl PlaceAt {
    /// The place, if it is known.
    #[must_use]
    pub fn get(self, tour: &TourFile) -> Option<&BackgroundPlace> {
        match self {
            Self::Background => tour.background.place.as_ref(),
            Self::Band(index) => tour.background.bands.get(index).map(|band| &band.place),
        }
    }

    fn get_mut(self, tour: &mut TourFile) -> Option<&mut BackgroundPlace> {
        match self {
            Self::Background => tour.background.place.as_mut(),
            Self::Band(index) => tour.background.bands.get_mut(index).map(|band| &mut band.place),
        }
    }
}

impl LineAt {
    /// The line's points; `None` when there is none or it is a mask.
    #[must_use]
    pub fn get(self, tour: &TourFile) -> Option<&[PicturePoint]> {
        match self {
            Self::Region(at) => match at.get(tour)? {
                Region::Polygon(corners) => Some(corners),
                Region::Mask(_) => None,
            },
            Self::Place(at) => match at.get(tour)? {
                BackgroundPlace::Contact(points) => Some(points),
                BackgroundPlace::Distance(_) | BackgroundPlace::Infinity => None,
            },
        }
    }

    pub(super) fn get_mut(self, tour: &mut TourFile) -> Option<&mut Vec<PicturePoint>> {
        match self {
            Self::Region(at) => match at.get_mut(tour)? {
                Region::Polygon(corners) => Some(corners),
                Region::Mask(_) => None,
            },
            Self::Place(at) => match at.get_mut(tour)? {
                BackgroundPlace::Contact(points) => Some(points),
                BackgroundPlace::Distance(_) | BackgroundPlace::Infinity => None,
            },
        }
    }
}

impl PointAt {
    /// Where the handle is; `None` when the address names nothing that is marked.
    #[must_use]
    pub fn get(self, tour: &TourFile) -> Option<PicturePoint> {
        match self {
            Self::Horizon(end) => tour.camera.horizon.as_ref()?.get(end).copied(),
            Self::PrincipalPoint => tour.camera.principal_point,
            Self::Scale(end) => match &tour.camera.scale {
                Some(Scale::Length { from, to, .. }) => [*from, *to].get(end).copied(),
                _ => None,
            },
            Self::Pair(index) => tour.water.as_ref()?.pairs.get(index).map(|pair| pair.point),
            Self::Reflection(index) => tour.water.as_ref()?.pairs.get(index).map(|pair| pair.reflection),
            Self::On(line, index) => line.get(tour)?.get(index).copied(),
            Self::Foot(object, end) => tour.objects.get(object)?.contact.get(end).copied(),
            Self::SwayRoot(object) => match &tour.objects.get(object)?.motion {
                Motion::Sway(sway) => sway.root,
                _ => None,
            },
            Self::SwayTip(object) => match &tour.objects.get(object)?.motion {
                Motion::Sway(sway) => sway.tip,
                _ => None,
            },
        }
    }

    pub(super) fn get_mut(self, tour: &mut TourFile) -> Option<&mut PicturePoint> {
        match self {
            Self::Horizon(end) => tour.camera.horizon.as_mut()?.get_mut(end),
            Self::PrincipalPoint => tour.camera.principal_point.as_mut(),
            Self::Scale(end) => match &mut tour.camera.scale {
                Some(Scale::Length { from, to, .. }) => [from, to].into_iter().nth(end),
                _ => None,
            },
            Self::Pair(index) => tour.water.as_mut()?.pairs.get_mut(index).map(|pair| &mut pair.point),
            Self::Reflection(index) => {
                tour.water.as_mut()?.pairs.get_mut(index).map(|pair| &mut pair.reflection)
            }
            Self::On(line, index) => line.get_mut(tour)?.get_mut(index),
            Self::Foot(object, end) => tour.objects.get_mut(object)?.contact.get_mut(end),
            Self::SwayRoot(object) => match &mut tour.objects.get_mut(object)?.motion {
                Motion::Sway(sway) => sway.root.as_mut(),
                _ => None,
            },
            Self::SwayTip(object) => match &mut tour.objects.get_mut(object)?.motion {
                Motion::Sway(sway) => sway.tip.as_mut(),
                _ => None,
            },
        }
    }
}
