//! Steps of the history in words: what was done to what.

use crate::tour::edit::{Action, Thing, Title};

use super::{Text, texts, with};

texts! {
    /// Actions with `{}` for the thing, and things.
    Titles, TITLES {
        set: "set {}",
        clear: "clear {}",
        add: "add {}",
        remove: "remove {}",
        replace: "change {}",
        reorder: "reorder {}",
        rename: "rename {}",
        moved: "move {}",
        paint: "paint {}",
        restore: "restore {}",
        picture: "the picture",
        medium: "how the picture was made",
        crop: "the crop",
        horizon: "the horizon",
        principal_point: "the optical middle",
        focal_length: "the focal length",
        scale: "the scale",
        method: "the method",
        water: "the water",
        water_region: "the water's outline",
        pair: "a pair",
        pair_point: "a pair's point",
        reflection: "a reflection",
        carrier: "what a pair lies on",
        ground: "the ground",
        ground_region: "the ground's outline",
        ground_height: "the ground's height",
        background: "the background's place",
        band: "a band",
        band_region: "a band's outline",
        band_place: "a band's place",
        sky: "the sky",
        sky_region: "the sky's outline",
        drift: "the clouds' drift",
        object: "an object",
        outline: "an outline",
        support: "what an object stands on",
        contact: "a contact line",
        turns_to_camera: "turning to the camera",
        motion: "a motion",
        sway_axis: "a sway's axis",
        wind: "the wind",
        waves: "the waves",
        path: "the camera's path",
        keyframe: "a keyframe",
        path_loop: "the path's loop",
        mask: "a mask",
        several: "several things",
    }
}

/// A step's title in words, with the name of what it is about.
pub(in super::super) fn title_words(title: &Title, t: &Text) -> String {
    let Title { action, thing, name } = title;
    let words = with(action_words(*action, &t.title), thing_words(*thing, &t.title));
    match name {
        Some(name) => format!("{words} (“{name}”)"),
        None => words,
    }
}

fn action_words(action: Action, t: &Titles) -> &'static str {
    match action {
        Action::Set => t.set,
        Action::Clear => t.clear,
        Action::Add => t.add,
        Action::Remove => t.remove,
        Action::Replace => t.replace,
        Action::Reorder => t.reorder,
        Action::Rename => t.rename,
        Action::Move => t.moved,
        Action::Paint => t.paint,
        Action::Restore => t.restore,
    }
}

fn thing_words(thing: Thing, t: &Titles) -> &'static str {
    match thing {
        Thing::Picture => t.picture,
        Thing::Medium => t.medium,
        Thing::Crop => t.crop,
        Thing::Horizon => t.horizon,
        Thing::PrincipalPoint => t.principal_point,
        Thing::FocalLength => t.focal_length,
        Thing::Scale => t.scale,
        Thing::Method => t.method,
        Thing::Water => t.water,
        Thing::WaterRegion => t.water_region,
        Thing::Pair => t.pair,
        Thing::PairPoint => t.pair_point,
        Thing::Reflection => t.reflection,
        Thing::Carrier => t.carrier,
        Thing::Ground => t.ground,
        Thing::GroundRegion => t.ground_region,
        Thing::GroundHeight => t.ground_height,
        Thing::Background => t.background,
        Thing::Band => t.band,
        Thing::BandRegion => t.band_region,
        Thing::BandPlace => t.band_place,
        Thing::Sky => t.sky,
        Thing::SkyRegion => t.sky_region,
        Thing::Drift => t.drift,
        Thing::Object => t.object,
        Thing::Outline => t.outline,
        Thing::Support => t.support,
        Thing::Contact => t.contact,
        Thing::TurnsToCamera => t.turns_to_camera,
        Thing::Motion => t.motion,
        Thing::SwayAxis => t.sway_axis,
        Thing::Wind => t.wind,
        Thing::Waves => t.waves,
        Thing::Path => t.path,
        Thing::Keyframe => t.keyframe,
        Thing::PathLoop => t.path_loop,
        Thing::Mask => t.mask,
        Thing::Several => t.several,
    }
}
