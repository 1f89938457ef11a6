//! Which parts of a draft an edit may change: those are copied before it does.

use super::address::ListEdit;
use super::part::Key;
use super::{Edit, LineAt, Named, PointAt, RegionAt};

impl Edit {
    /// The parts of the document that the edit may change.
    pub(super) fn touched(&self) -> Vec<Key> {
        match self {
            Self::Picture(_) | Self::Medium(_) | Self::Crop(_) => vec![Key::Picture],
            Self::Horizon(_)
            | Self::PrincipalPoint(_)
            | Self::FocalLength(_)
            | Self::Scale(_)
            | Self::Method(_) => vec![Key::Camera],
            Self::Region { at, .. } => vec![region_key(*at)],
            Self::MovePoint { at, .. } => vec![point_key(*at)],
            Self::InsertPoint { line, .. } | Self::RemovePoint { line, .. } => vec![line_key(*line)],
            Self::Water(_) | Self::Pairs(_) | Self::PairOn { .. } => vec![Key::Water],
            Self::Ground(_) | Self::GroundHeight(_) => vec![Key::Ground],
            Self::Place { .. } => vec![Key::Background],
            Self::Sky(_) | Self::Drift(_) => vec![Key::Sky],
            Self::Support { object, .. }
            | Self::Contact { object, .. }
            | Self::TurnsToCamera { object, .. }
            | Self::Motion { object, .. } => vec![Key::Object(*object)],
            // References follow names.
            Self::Objects(ListEdit::Replace(index, _)) | Self::Rename { what: Named::Object(index), .. } => {
                vec![Key::Object(*index), Key::Water, Key::Camera]
            }
            Self::Objects(_) => vec![Key::Objects, Key::Water, Key::Camera],
            Self::Bands(_) | Self::Rename { what: Named::Band(_), .. } => {
                vec![Key::Background, Key::Water, Key::Camera]
            }
            Self::Wind(_) => vec![Key::Wind],
            Self::Waves(_) => vec![Key::Waves],
            Self::Path(_) | Self::Keyframes(_) | Self::LoopPath(_) => vec![Key::Path],
            Self::Mask { .. } | Self::Paint { .. } | Self::Many(_) | Self::Restore(_) => Vec::new(),
        }
    }
}

fn region_key(at: RegionAt) -> Key {
    match at {
        RegionAt::Water => Key::Water,
        RegionAt::Ground => Key::Ground,
        RegionAt::Sky => Key::Sky,
        RegionAt::Band(_) => Key::Background,
        RegionAt::Object(object) => Key::Object(object),
    }
}

fn line_key(line: LineAt) -> Key {
    match line {
        LineAt::Region(at) => region_key(at),
        LineAt::Place(_) => Key::Background,
    }
}

fn point_key(at: PointAt) -> Key {
    match at {
        PointAt::Horizon(_) | PointAt::PrincipalPoint | PointAt::Scale(_) => Key::Camera,
        PointAt::Pair(_) | PointAt::Reflection(_) => Key::Water,
        PointAt::On(line, _) => line_key(line),
        PointAt::Foot(object, _) | PointAt::SwayRoot(object) | PointAt::SwayTip(object) => {
            Key::Object(object)
        }
    }
}
