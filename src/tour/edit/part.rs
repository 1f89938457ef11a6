//! The parts of a draft that edits put back.
//!
//! Before an edit changes a part, the part is copied; undoing exchanges the copy with what is there, which leaves what
//! redoing exchanges again. So an inverse is exact by construction, also where the draft was not sound before.

use std::mem::swap;
use std::sync::Arc;

use crate::picture::Mask;
use crate::tour::{
    Background, CameraNotes, CameraPath, GroundArea, Object, PictureSource, Sky, WaterArea, Waves, Wind,
};

use super::{Draft, EditError, MaskPatch, PackedMask};

/// What an edit changed, as it was before, in the order of change.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Restored(pub(super) Vec<Part>);

/// A part of a draft.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Part {
    Picture(PictureSource<String>),
    Camera(CameraNotes),
    Water(Option<WaterArea<String>>),
    Ground(Option<GroundArea<String>>),
    Background(Background<String>),
    Sky(Option<Sky<String>>),
    Objects(Vec<Object<String>>),
    /// One object alone, so that a long history of a picture with many of them stays small.
    Object(usize, Box<Object<String>>),
    Wind(Wind),
    Waves(Waves<String>),
    Path(Option<CameraPath>),
    Mask(String, Option<PackedMask>),
    Patch(String, MaskPatch),
}

/// Which part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Key {
    Picture,
    Camera,
    Water,
    Ground,
    Background,
    Sky,
    Objects,
    Object(usize),
    Wind,
    Waves,
    Path,
}

impl Key {
    /// A copy of the part; an error for an object that is not there.
    pub(super) fn copy(self, draft: &Draft) -> Result<Part, EditError> {
        let tour = &draft.tour;
        Ok(match self {
            Self::Picture => Part::Picture(tour.picture.clone()),
            Self::Camera => Part::Camera(tour.camera.clone()),
            Self::Water => Part::Water(tour.water.clone()),
            Self::Ground => Part::Ground(tour.ground.clone()),
            Self::Background => Part::Background(tour.background.clone()),
            Self::Sky => Part::Sky(tour.sky.clone()),
            Self::Objects => Part::Objects(tour.objects.clone()),
            Self::Object(index) => {
                let object = tour.objects.get(index).ok_or(EditError::NoSuch { what: "object", index })?;
                Part::Object(index, Box::new(object.clone()))
            }
            Self::Wind => Part::Wind(tour.wind),
            Self::Waves => Part::Waves(tour.waves.clone()),
            Self::Path => Part::Path(tour.path.clone()),
        })
    }
}

impl Part {
    /// Which part it is; masks have none, since theirs must all be put back one after the other.
    pub(super) fn key(&self) -> Option<Key> {
        Some(match self {
            Self::Picture(_) => Key::Picture,
            Self::Camera(_) => Key::Camera,
            Self::Water(_) => Key::Water,
            Self::Ground(_) => Key::Ground,
            Self::Background(_) => Key::Background,
            Self::Sky(_) => Key::Sky,
            Self::Objects(_) => Key::Objects,
            Self::Object(index, _) => Key::Object(*index),
            Self::Wind(_) => Key::Wind,
            Self::Waves(_) => Key::Waves,
            Self::Path(_) => Key::Path,
            Self::Mask(..) | Self::Patch(..) => return None,
        })
    }

    /// Exchanges this copy with what the draft has.
    fn exchange(&mut self, draft: &mut Draft) -> Result<(), EditError> {
        let tour = &mut draft.tour;
        match self {
            Self::Picture(part) => swap(part, &mut tour.picture),
            Self::Camera(part) => swap(part, &mut tour.camera),
            Self::Water(part) => swap(part, &mut tour.water),
            Self::Ground(part) => swap(part, &mut tour.ground),
            Self::Background(part) => swap(part, &mut tour.background),
            Self::Sky(part) => swap(part, &mut tour.sky),
            Self::Objects(part) => swap(part, &mut tour.objects),
            Self::Object(index, part) => {
                let there = tour.objects.get_mut(*index);
                swap(part.as_mut(), there.ok_or(EditError::NoSuch { what: "object", index: *index })?);
            }
            Self::Wind(part) => swap(part, &mut tour.wind),
            Self::Waves(part) => swap(part, &mut tour.waves),
            Self::Path(part) => swap(part, &mut tour.path),
            Self::Mask(name, part) => {
                let mask = part.as_ref().map(PackedMask::unpack).transpose()?.map(Arc::new);
                *part = draft.masks.exchange(name, mask).as_deref().map(|mask: &Mask| PackedMask::new(mask));
            }
            Self::Patch(name, part) => *part = draft.masks.paint(name, part)?,
        }
        Ok(())
    }
}

impl Restored {
    /// Keeps a part as it was. Of a part that was kept before, the older copy is enough.
    pub(super) fn keep(&mut self, part: Part) {
        let known = part.key().is_some_and(|key| self.0.iter().any(|kept| kept.key() == Some(key)));
        if !known {
            self.0.push(part);
        }
    }

    /// Keeps all that a later edit of the same step changed.
    pub(super) fn keep_all(&mut self, later: Self) {
        later.0.into_iter().for_each(|part| self.keep(part));
    }

    /// Puts everything back, last change first, and gives what undoes that. On an error nothing has changed.
    pub(super) fn put_back(&self, draft: &mut Draft) -> Result<Self, EditError> {
        let mut undone = Self::default();
        for part in self.0.iter().rev() {
            let mut part = part.clone();
            if let Err(error) = part.exchange(draft) {
                // What was exchanged came from this draft, so exchanging it again cannot fail.
                for mut done in undone.0.into_iter().rev() {
                    done.exchange(draft)?;
                }
                return Err(error);
            }
            undone.0.push(part);
        }
        Ok(undone)
    }

    /// Whether the draft still shows all this, so that nothing has changed.
    pub(super) fn is_shown_by(&self, draft: &Draft) -> bool {
        let shows = |part: &Part| match part {
            Part::Mask(name, mask) => draft.masks.get(name).map(|mask| PackedMask::new(mask)) == *mask,
            Part::Patch(name, patch) => {
                let there = draft.masks.get(name).and_then(|mask| MaskPatch::of(mask, patch.rect()));
                there.as_ref() == Some(patch)
            }
            part => part.key().and_then(|key| key.copy(draft).ok()).as_ref() == Some(part),
        };
        self.0.iter().all(shows)
    }
}
