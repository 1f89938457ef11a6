//! What each edit does to a draft.
//!
//! The parts that an edit touches are copied first; they are the inverse, and what a refusal puts back.

use crate::picture::PicturePoint;
use crate::tour::{
    CameraPath, GroundArea, Motion, Object, Region, RelativePath, Scale, Sea, Sky, Sway, TourFile, WaterArea,
};

use super::address::ListEdit;
use super::finite::Finite;
use super::part::Part;
use super::{
    Draft, Edit, EditError, LineAt, Masks, Named, PackedMask, PlaceAt, PointAt, RegionAt, Restored, names,
};

impl Edit {
    /// Changes the draft and gives the edit that takes it back exactly.
    ///
    /// # Errors
    /// A number that is not finite, an address or a name that means nothing, a name that is taken, a mask that is not
    /// there: see [`EditError`]. The draft is then as it was.
    pub fn apply(&self, draft: &mut Draft) -> Result<Self, EditError> {
        self.change(draft).map(Self::Restore)
    }

    fn change(&self, draft: &mut Draft) -> Result<Restored, EditError> {
        match self {
            Self::Many(edits) => {
                let mut back = Restored::default();
                for edit in edits {
                    match edit.change(draft) {
                        Ok(more) => back.keep_all(more),
                        Err(error) => {
                            back.put_back(draft)?;
                            return Err(error);
                        }
                    }
                }
                Ok(back)
            }
            Self::Restore(parts) => parts.put_back(draft),
            Self::Mask { name, mask } => set_mask(draft, name, mask.as_ref()),
            Self::Paint { name, patch } => {
                let before = draft.masks.paint(name, patch)?;
                Ok(Restored(vec![Part::Patch(name.clone(), before)]))
            }
            _ => {
                let parts = self.touched().into_iter().map(|key| key.copy(draft));
                let back = Restored(parts.collect::<Result<_, _>>()?);
                let Draft { tour, masks } = draft;
                match self.change_tour(tour, masks) {
                    Ok(()) => Ok(back),
                    Err(error) => {
                        back.put_back(draft)?;
                        Err(error)
                    }
                }
            }
        }
    }

    /// Changes the document alone. After an error it may be changed in part.
    fn change_tour(&self, tour: &mut TourFile, masks: &Masks) -> Result<(), EditError> {
        match self {
            Self::Picture(picture) => {
                safe(&picture.file)?;
                tour.picture = picture.clone();
            }
            Self::Medium(medium) => tour.picture.medium = *medium,
            Self::Crop(crop) => tour.picture.crop = *crop,
            Self::Horizon(horizon) => tour.camera.horizon = sound(*horizon, "the horizon")?,
            Self::PrincipalPoint(point) => {
                tour.camera.principal_point = sound(*point, "the principal point")?;
            }
            Self::FocalLength(focal) => tour.camera.focal_length = sound(*focal, "the focal length")?,
            Self::Scale(scale) => {
                if let Some(Scale::Length { on, .. }) = scale {
                    names::check_object(tour, on)?;
                }
                tour.camera.scale = sound(scale.clone(), "the scale")?;
            }
            Self::Method(method) => tour.camera.method = *method,
            Self::Region { at, region } => set_region(tour, *at, region.clone(), masks)?,
            Self::MovePoint { at, to } => move_point(tour, *at, sound(*to, "the point")?)?,
            Self::InsertPoint { line, index, point } => {
                let point = sound(*point, "the point")?;
                ListEdit::Insert(*index, point).apply(points(tour, *line)?, "point")?;
            }
            Self::RemovePoint { line, index } => {
                ListEdit::Remove(*index).apply(points(tour, *line)?, "point")?;
            }
            Self::Water(water) => {
                if let Some(WaterArea { region, pairs }) = water {
                    check_region(region, masks)?;
                    pairs.iter().try_for_each(|pair| names::check_carrier(tour, pair.on.as_deref()))?;
                }
                tour.water = sound(water.clone(), "the water")?;
            }
            Self::Pairs(list) => {
                if let Some(pair) = list.value() {
                    sound(pair.clone(), "the pair")?;
                    names::check_carrier(tour, pair.on.as_deref())?;
                }
                let unmarked = || WaterArea { region: Region::Polygon(Vec::new()), pairs: Vec::new() };
                list.apply(&mut tour.water.get_or_insert_with(unmarked).pairs, "pair")?;
            }
            Self::PairOn { pair: index, on } => {
                names::check_carrier(tour, on.as_deref())?;
                let pair = tour.water.as_mut().and_then(|water| water.pairs.get_mut(*index));
                pair.ok_or(EditError::NoSuch { what: "pair", index: *index })?.on.clone_from(on);
            }
            Self::Ground(ground) => {
                if let Some(ground) = ground {
                    check_region(&ground.region, masks)?;
                }
                tour.ground = sound(ground.clone(), "the ground")?;
            }
            Self::GroundHeight(meters) => {
                let ground = tour.ground.as_mut().ok_or(EditError::Unmarked { what: "the ground" })?;
                ground.height_above_water = sound(*meters, "the ground's height")?;
            }
            Self::Place { at: PlaceAt::Background, place } => {
                tour.background.place = sound(place.clone(), "the background's place")?;
            }
            Self::Place { at: PlaceAt::Band(index), place } => {
                let band = tour.background.bands.get_mut(*index);
                let band = band.ok_or(EditError::NoSuch { what: "band", index: *index })?;
                let place = place.clone().ok_or(EditError::Needed { what: "a band's place" })?;
                band.place = sound(place, "the band's place")?;
            }
            Self::Bands(list) => {
                if let Some(band) = list.value() {
                    sound(band.clone(), "the band")?;
                    band.region.as_ref().map_or(Ok(()), |region| check_region(region, masks))?;
                }
                change_named(tour, list, |tour| &mut tour.background.bands, |band| &band.name, Named::Band)?;
            }
            Self::Sky(sky) => {
                let region = sky.as_ref().and_then(|sky| sky.region.as_ref());
                region.map_or(Ok(()), |region| check_region(region, masks))?;
                tour.sky = sound(sky.clone(), "the sky")?;
            }
            Self::Drift(drift) => {
                let sky = tour.sky.as_mut().ok_or(EditError::Unmarked { what: "the sky" })?;
                sky.drift = sound(*drift, "the clouds' drift")?;
            }
            Self::Objects(list) => {
                if let Some(object) = list.value() {
                    sound(object.clone(), "the object")?;
                    check_region(&object.outline, masks)?;
                    check_motion(&object.motion)?;
                }
                change_named(tour, list, |tour| &mut tour.objects, |object| &object.name, Named::Object)?;
            }
            Self::Rename { what, to } => names::rename(tour, *what, to)?,
            Self::Support { object, support } => object_mut(tour, *object)?.support = *support,
            Self::Contact { object, contact } => {
                object_mut(tour, *object)?.contact = sound(*contact, "the contact line")?;
            }
            Self::TurnsToCamera { object, turns } => object_mut(tour, *object)?.turns_to_camera = *turns,
            Self::Motion { object, motion } => {
                check_motion(motion)?;
                object_mut(tour, *object)?.motion = sound(motion.clone(), "the motion")?;
            }
            Self::Wind(wind) => tour.wind = sound(*wind, "the wind")?,
            Self::Waves(waves) => {
                if let Sea::Recorded(sea) = &waves.sea {
                    safe(&sea.first)?;
                }
                tour.waves = sound(waves.clone(), "the waves")?;
            }
            Self::Path(path) => tour.path = sound(path.clone(), "the camera's path")?,
            Self::Keyframes(list) => {
                list.value().map_or(Ok(()), |keyframe| sound(*keyframe, "the keyframe").map(drop))?;
                let path = tour.path.get_or_insert_with(CameraPath::default);
                list.apply(&mut path.keyframes, "keyframe")?;
                tour.path.take_if(|path| path.keyframes.is_empty());
            }
            Self::LoopPath(looped) => {
                let path = tour.path.as_mut().ok_or(EditError::Unmarked { what: "the camera's path" })?;
                path.looped = *looped;
            }
            Self::Mask { .. } | Self::Paint { .. } | Self::Many(_) | Self::Restore(_) => {}
        }
        Ok(())
    }
}

/// A value whose numbers are finite and whose points are near the picture.
fn sound<T: Finite>(value: T, what: &'static str) -> Result<T, EditError> {
    if value.is_sound() { Ok(value) } else { Err(EditError::NotFinite { what }) }
}

/// A path below the tour's folder.
fn safe(path: &str) -> Result<(), EditError> {
    RelativePath::new(path).map(drop).map_err(|why| EditError::BadPath { path: path.to_owned(), why })
}

fn object_mut(tour: &mut TourFile, index: usize) -> Result<&mut Object<String>, EditError> {
    tour.objects.get_mut(index).ok_or(EditError::NoSuch { what: "object", index })
}

fn points(tour: &mut TourFile, line: LineAt) -> Result<&mut Vec<PicturePoint>, EditError> {
    line.get_mut(tour).ok_or(EditError::Unmarked { what: "this line" })
}

/// A region may name only a mask that is there.
fn check_region(region: &Region<String>, masks: &Masks) -> Result<(), EditError> {
    match region {
        Region::Mask(name) if masks.get(name).is_none() => Err(EditError::NoMask { name: name.clone() }),
        Region::Mask(_) | Region::Polygon(_) => Ok(()),
    }
}

fn check_motion(motion: &Motion<String>) -> Result<(), EditError> {
    match motion {
        Motion::Recorded(recorded) => safe(&recorded.poses),
        _ => Ok(()),
    }
}

fn set_region(
    tour: &mut TourFile,
    at: RegionAt,
    region: Option<Region<String>>,
    masks: &Masks,
) -> Result<(), EditError> {
    let region = sound(region, "the region")?;
    region.as_ref().map_or(Ok(()), |region| check_region(region, masks))?;
    let needed = |region: Option<_>, what| region.ok_or(EditError::Needed { what });
    match at {
        RegionAt::Water => {
            let region = needed(region, "the water's region")?;
            let pairs = tour.water.take().map_or_else(Vec::new, |water| water.pairs);
            tour.water = Some(WaterArea { region, pairs });
        }
        RegionAt::Ground => {
            let region = needed(region, "the ground's region")?;
            let height_above_water = tour.ground.as_ref().map_or(0.0, |ground| ground.height_above_water);
            tour.ground = Some(GroundArea { region, height_above_water });
        }
        RegionAt::Sky => {
            let drift = tour.sky.as_ref().and_then(|sky| sky.drift);
            tour.sky = Some(Sky { region, drift });
        }
        RegionAt::Band(index) => {
            let band = tour.background.bands.get_mut(index);
            band.ok_or(EditError::NoSuch { what: "band", index })?.region = region;
        }
        RegionAt::Object(index) => {
            object_mut(tour, index)?.outline = needed(region, "an object's outline")?;
        }
    }
    Ok(())
}

fn move_point(tour: &mut TourFile, at: PointAt, to: PicturePoint) -> Result<(), EditError> {
    // These may be absent, and then come to be.
    match at {
        PointAt::PrincipalPoint => {
            tour.camera.principal_point = Some(to);
            return Ok(());
        }
        PointAt::SwayRoot(object) | PointAt::SwayTip(object) => {
            let Motion::Sway(Sway { root, tip, .. }) = &mut object_mut(tour, object)?.motion else {
                return Err(EditError::Unmarked { what: "the object's swaying" });
            };
            *(if matches!(at, PointAt::SwayRoot(_)) { root } else { tip }) = Some(to);
            return Ok(());
        }
        _ => {}
    }
    *at.get_mut(tour).ok_or(EditError::Unmarked { what: "this point" })? = to;
    Ok(())
}

/// Changes a list of things that pairs and the scale may name.
fn change_named<T: Clone>(
    tour: &mut TourFile,
    list: &ListEdit<T>,
    things: fn(&mut TourFile) -> &mut Vec<T>,
    name: fn(&T) -> &String,
    named: fn(usize) -> Named,
) -> Result<(), EditError> {
    match list {
        ListEdit::Insert(_, thing) => names::check_new(tour, name(thing), None)?,
        ListEdit::Replace(index, thing) => names::rename(tour, named(*index), name(thing))?,
        ListEdit::Remove(_) | ListEdit::Move { .. } => {}
    }
    let old = match list {
        ListEdit::Remove(index) => things(tour).get(*index).map(|thing| name(thing).clone()),
        _ => None,
    };
    let what = if matches!(named(0), Named::Object(_)) { "object" } else { "band" };
    list.apply(things(tour), what)?;
    if let Some(old) = old {
        names::let_go(tour, &old);
    }
    Ok(())
}

fn set_mask(draft: &mut Draft, name: &str, mask: Option<&PackedMask>) -> Result<Restored, EditError> {
    safe(name)?;
    let mask = mask.map(PackedMask::unpack).transpose()?;
    if mask.is_none() {
        if draft.masks.get(name).is_none() {
            return Err(EditError::NoMask { name: name.to_owned() });
        }
        let user = draft.tour.files().into_iter().find(|(_, path)| path == name);
        if let Some((place, _)) = user {
            return Err(EditError::MaskInUse { name: name.to_owned(), place });
        }
    }
    let old = draft.masks.exchange(name, mask.map(Into::into));
    Ok(Restored(vec![Part::Mask(name.to_owned(), old.map(|old| PackedMask::new(&old)))]))
}
