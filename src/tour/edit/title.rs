//! What an edit is called in the history list: an action and a thing. The words are the editor's.

use crate::tour::TourFile;

use super::{Edit, LineAt, ListEdit, Named, PlaceAt, PointAt, RegionAt};

/// What a step does, for the history list and the undo button.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Title {
    /// What is done.
    pub action: Action,
    /// To what.
    pub thing: Thing,
    /// The name of the object, band, pair or mask, if it has one.
    pub name: Option<String>,
}

/// What is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the words say it")]
pub enum Action {
    Set,
    Clear,
    Add,
    Remove,
    Replace,
    Reorder,
    Rename,
    Move,
    Paint,
    Restore,
}

/// What is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the words say it")]
pub enum Thing {
    Picture,
    Medium,
    Crop,
    Horizon,
    PrincipalPoint,
    FocalLength,
    Scale,
    Method,
    Water,
    WaterRegion,
    Pair,
    PairPoint,
    Reflection,
    Carrier,
    Ground,
    GroundRegion,
    GroundHeight,
    Background,
    Band,
    BandRegion,
    BandPlace,
    Sky,
    SkyRegion,
    Drift,
    Object,
    Outline,
    Support,
    Contact,
    TurnsToCamera,
    Motion,
    SwayAxis,
    Wind,
    Waves,
    Path,
    Keyframe,
    PathLoop,
    Mask,
    /// Several things at once.
    Several,
}

impl Edit {
    /// What the edit is called, told before it is applied to the document.
    #[must_use]
    pub fn title(&self, tour: &TourFile) -> Title {
        let set = |is_set: bool| if is_set { Action::Set } else { Action::Clear };
        let (action, thing, name) = match self {
            Self::Picture(_) => (Action::Set, Thing::Picture, None),
            Self::Medium(_) => (Action::Set, Thing::Medium, None),
            Self::Crop(crop) => (set(crop.is_some()), Thing::Crop, None),
            Self::Horizon(horizon) => (set(horizon.is_some()), Thing::Horizon, None),
            Self::PrincipalPoint(point) => (set(point.is_some()), Thing::PrincipalPoint, None),
            Self::FocalLength(_) => (Action::Set, Thing::FocalLength, None),
            Self::Scale(scale) => (set(scale.is_some()), Thing::Scale, None),
            Self::Method(_) => (Action::Set, Thing::Method, None),
            Self::Region { at, region } => (set(region.is_some()), region_thing(*at), region_name(*at, tour)),
            Self::MovePoint { at, .. } => {
                let (thing, name) = point_thing(*at, tour);
                (Action::Move, thing, name)
            }
            Self::InsertPoint { line, .. } => (Action::Add, line_thing(*line), line_name(*line, tour)),
            Self::RemovePoint { line, .. } => (Action::Remove, line_thing(*line), line_name(*line, tour)),
            Self::Water(water) => (set(water.is_some()), Thing::Water, None),
            Self::Pairs(list) => {
                let pairs = tour.water.as_ref().map_or(&[][..], |water| &water.pairs);
                (list_action(list), Thing::Pair, list_name(list, pairs, |pair| pair.name.clone()))
            }
            Self::PairOn { pair, .. } => (Action::Set, Thing::Carrier, pair_name(*pair, tour)),
            Self::Ground(ground) => (set(ground.is_some()), Thing::Ground, None),
            Self::GroundHeight(_) => (Action::Set, Thing::GroundHeight, None),
            Self::Place { at, place } => (set(place.is_some()), place_thing(*at), place_name(*at, tour)),
            Self::Bands(list) => {
                let name = list_name(list, &tour.background.bands, |band| Some(band.name.clone()));
                (list_action(list), Thing::Band, name)
            }
            Self::Sky(sky) => (set(sky.is_some()), Thing::Sky, None),
            Self::Drift(drift) => (set(drift.is_some()), Thing::Drift, None),
            Self::Objects(list) => {
                let name = list_name(list, &tour.objects, |object| Some(object.name.clone()));
                (list_action(list), Thing::Object, name)
            }
            Self::Rename { what: Named::Object(index), .. } => {
                (Action::Rename, Thing::Object, object_name(*index, tour))
            }
            Self::Rename { what: Named::Band(index), .. } => {
                (Action::Rename, Thing::Band, band_name(*index, tour))
            }
            Self::Support { object, .. } => (Action::Set, Thing::Support, object_name(*object, tour)),
            Self::Contact { object, .. } => (Action::Set, Thing::Contact, object_name(*object, tour)),
            Self::TurnsToCamera { object, .. } => {
                (Action::Set, Thing::TurnsToCamera, object_name(*object, tour))
            }
            Self::Motion { object, .. } => (Action::Set, Thing::Motion, object_name(*object, tour)),
            Self::Wind(_) => (Action::Set, Thing::Wind, None),
            Self::Waves(_) => (Action::Set, Thing::Waves, None),
            Self::Path(path) => (set(path.is_some()), Thing::Path, None),
            Self::Keyframes(list) => (list_action(list), Thing::Keyframe, None),
            Self::LoopPath(_) => (Action::Set, Thing::PathLoop, None),
            Self::Mask { name, mask } => (set(mask.is_some()), Thing::Mask, Some(name.clone())),
            Self::Paint { name, .. } => (Action::Paint, Thing::Mask, Some(name.clone())),
            Self::Many(edits) => {
                // A new mask goes with what it is for.
                let is_help = |edit: &&Self| matches!(edit, Self::Mask { .. } | Self::Paint { .. });
                let mut told = edits.iter().filter(|edit| edits.len() == 1 || !is_help(edit));
                match (told.next(), told.next()) {
                    (Some(only), None) => return only.title(tour),
                    _ => (Action::Set, Thing::Several, None),
                }
            }
            Self::Restore(_) => (Action::Restore, Thing::Several, None),
        };
        Title { action, thing, name }
    }
}

fn list_action<T>(list: &ListEdit<T>) -> Action {
    match list {
        ListEdit::Insert(..) => Action::Add,
        ListEdit::Remove(_) => Action::Remove,
        ListEdit::Replace(..) => Action::Replace,
        ListEdit::Move { .. } => Action::Reorder,
    }
}

fn list_name<T>(list: &ListEdit<T>, there: &[T], name: impl Fn(&T) -> Option<String>) -> Option<String> {
    match list {
        ListEdit::Insert(_, value) => name(value),
        ListEdit::Remove(index) | ListEdit::Replace(index, _) | ListEdit::Move { from: index, .. } => {
            there.get(*index).and_then(name)
        }
    }
}

fn object_name(index: usize, tour: &TourFile) -> Option<String> {
    tour.objects.get(index).map(|object| object.name.clone())
}

fn band_name(index: usize, tour: &TourFile) -> Option<String> {
    tour.background.bands.get(index).map(|band| band.name.clone())
}

fn pair_name(index: usize, tour: &TourFile) -> Option<String> {
    tour.water.as_ref()?.pairs.get(index)?.name.clone()
}

fn region_thing(at: RegionAt) -> Thing {
    match at {
        RegionAt::Water => Thing::WaterRegion,
        RegionAt::Ground => Thing::GroundRegion,
        RegionAt::Sky => Thing::SkyRegion,
        RegionAt::Band(_) => Thing::BandRegion,
        RegionAt::Object(_) => Thing::Outline,
    }
}

fn region_name(at: RegionAt, tour: &TourFile) -> Option<String> {
    match at {
        RegionAt::Water | RegionAt::Ground | RegionAt::Sky => None,
        RegionAt::Band(index) => band_name(index, tour),
        RegionAt::Object(index) => object_name(index, tour),
    }
}

fn place_thing(at: PlaceAt) -> Thing {
    match at {
        PlaceAt::Background => Thing::Background,
        PlaceAt::Band(_) => Thing::BandPlace,
    }
}

fn place_name(at: PlaceAt, tour: &TourFile) -> Option<String> {
    match at {
        PlaceAt::Background => None,
        PlaceAt::Band(index) => band_name(index, tour),
    }
}

fn line_thing(line: LineAt) -> Thing {
    match line {
        LineAt::Region(at) => region_thing(at),
        LineAt::Place(at) => place_thing(at),
    }
}

fn line_name(line: LineAt, tour: &TourFile) -> Option<String> {
    match line {
        LineAt::Region(at) => region_name(at, tour),
        LineAt::Place(at) => place_name(at, tour),
    }
}

fn point_thing(at: PointAt, tour: &TourFile) -> (Thing, Option<String>) {
    match at {
        PointAt::Horizon(_) => (Thing::Horizon, None),
        PointAt::PrincipalPoint => (Thing::PrincipalPoint, None),
        PointAt::Scale(_) => (Thing::Scale, None),
        PointAt::Pair(index) => (Thing::PairPoint, pair_name(index, tour)),
        PointAt::Reflection(index) => (Thing::Reflection, pair_name(index, tour)),
        PointAt::On(line, _) => (line_thing(line), line_name(line, tour)),
        PointAt::Foot(object, _) => (Thing::Contact, object_name(object, tour)),
        PointAt::SwayRoot(object) | PointAt::SwayTip(object) => (Thing::SwayAxis, object_name(object, tour)),
    }
}
