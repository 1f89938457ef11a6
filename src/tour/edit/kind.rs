//! The kinds of edit.
//!
//! Each is one sentence of the history list ([`Edit::title`]); what it does to the document is in `apply`.

use crate::picture::PicturePoint;
use crate::tour::{
    BackgroundPlace, Band, CameraPath, Crop, Drift, FocalLength, GroundArea, Keyframe, Medium, Method,
    Motion, Object, PictureSource, ReflectionPair, Region, Scale, Sky, Support, WaterArea, Waves, Wind,
};

use super::{LineAt, ListEdit, MaskPatch, Named, PackedMask, PlaceAt, PointAt, RegionAt, Restored};

/// One change of a [`Draft`](super::Draft).
///
/// Points are in picture pixels, lengths in meters, angles in degrees, as in the document.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Names the picture's file and the size the numbers refer to; marks stay.
    Picture(PictureSource<String>),
    /// Tells how the picture was made.
    Medium(Medium),
    /// Uses a part of the picture, or all of it.
    Crop(Option<Crop>),

    /// Sets the horizon, or leaves it to the pairs.
    Horizon(Option<[PicturePoint; 2]>),
    /// Sets the principal point, or leaves it in the center.
    PrincipalPoint(Option<PicturePoint>),
    /// Tells what is known of the focal length; `Known` locks it.
    FocalLength(FocalLength),
    /// Sets the length that sets the scale, or leaves it assumed.
    Scale(Option<Scale>),
    /// Chooses the solver.
    Method(Method),

    /// Sets a region. Water, ground and sky come to be by it; `None` is for a band or the sky, which then take what
    /// is left.
    Region {
        /// Which.
        at: RegionAt,
        /// The region.
        region: Option<Region<String>>,
    },
    /// Moves one point of the picture; sets the principal point, a sway's root or tip where absent.
    MovePoint {
        /// Which.
        at: PointAt,
        /// Where to.
        to: PicturePoint,
    },
    /// Adds a point to a line, before the one at `index`. A contact line or a polygon must be there, if only empty.
    InsertPoint {
        /// Which line.
        line: LineAt,
        /// 0 to the number of points.
        index: usize,
        /// The point.
        point: PicturePoint,
    },
    /// Takes a point out of a line.
    RemovePoint {
        /// Which line.
        line: LineAt,
        /// Which point.
        index: usize,
    },

    /// Replaces the water and its pairs, or takes both away.
    Water(Option<WaterArea<String>>),
    /// Changes the list of pairs. The first pair makes water with an empty polygon where there is none yet.
    Pairs(ListEdit<ReflectionPair>),
    /// Tells what a pair's point is on: an object's or band's name, `"background"`, or unknown.
    PairOn {
        /// Which pair.
        pair: usize,
        /// The carrier's name.
        on: Option<String>,
    },
    /// Replaces the ground, or takes it away.
    Ground(Option<GroundArea<String>>),
    /// Sets the ground's height above the water, meters.
    GroundHeight(f64),
    /// Sets where the background stands, or leaves it to the pairs; a band always has a place.
    Place {
        /// Which.
        at: PlaceAt,
        /// Where it stands.
        place: Option<BackgroundPlace>,
    },
    /// Changes the list of bands. Pairs let go of the name of one that is removed.
    Bands(ListEdit<Band<String>>),
    /// Replaces the sky, or takes it away.
    Sky(Option<Sky<String>>),
    /// Sets the clouds' drift, or leaves it to the wind.
    Drift(Option<Drift>),

    /// Changes the list of objects. Pairs and the scale let go of one that is removed.
    Objects(ListEdit<Object<String>>),
    /// Renames an object or a band; pairs and the scale follow.
    Rename {
        /// Which.
        what: Named,
        /// The new name.
        to: String,
    },
    /// Sets what an object stands on.
    Support {
        /// Which object.
        object: usize,
        /// Its support.
        support: Support,
    },
    /// Sets an object's contact line, left and right foot.
    Contact {
        /// Which object.
        object: usize,
        /// Its feet.
        contact: [PicturePoint; 2],
    },
    /// Sets whether an object turns to the camera.
    TurnsToCamera {
        /// Which object.
        object: usize,
        /// Whether it does.
        turns: bool,
    },
    /// Sets how an object moves.
    Motion {
        /// Which object.
        object: usize,
        /// Its motion.
        motion: Motion<String>,
    },

    /// Sets the wind.
    Wind(Wind),
    /// Sets the waves.
    Waves(Waves<String>),

    /// Replaces the camera's path, or takes it away.
    Path(Option<CameraPath>),
    /// Changes the list of keyframes: adding the first makes the path, removing the last takes it away.
    Keyframes(ListEdit<Keyframe>),
    /// Sets whether the path goes on from its end to its start.
    LoopPath(bool),

    /// Adds or replaces a mask, or takes one away that nothing names.
    Mask {
        /// Its path below the tour's folder.
        name: String,
        /// The mask.
        mask: Option<PackedMask>,
    },
    /// Paints a rectangle of a mask.
    Paint {
        /// The mask's path below the tour's folder.
        name: String,
        /// What it shows there afterwards.
        patch: MaskPatch,
    },

    /// Does several edits as one, all or none.
    Many(Vec<Self>),
    /// Puts back what another edit changed; only [`Edit::apply`] makes these.
    Restore(Restored),
}
