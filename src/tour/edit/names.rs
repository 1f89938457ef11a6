//! Names: which may be given, and what follows when one changes.
//!
//! Pairs (`on`) and the scale's length (`on`) refer to objects and bands by name. They follow a new name and let go of a
//! thing that is removed.

use crate::tour::{Scale, TourFile};

use super::{EditError, Named};

/// Names that mean something else than an object or a band.
const RESERVED: [&str; 4] = ["water", "ground", "background", "sky"];

/// Whether a thing may get a name; `thing` itself may have it already.
pub(super) fn check_new(tour: &TourFile, name: &str, thing: Option<Named>) -> Result<(), EditError> {
    if name.trim().is_empty() || RESERVED.contains(&name) {
        return Err(EditError::BadName { name: name.to_owned() });
    }
    let taken = named(tour, name).any(|other| Some(other) != thing);
    if taken { Err(EditError::NameTaken { name: name.to_owned() }) } else { Ok(()) }
}

/// Whether a pair's point can be on what this name means.
pub(super) fn check_carrier(tour: &TourFile, on: Option<&str>) -> Result<(), EditError> {
    match on {
        Some(name) if name != "background" && named(tour, name).next().is_none() => {
            Err(EditError::UnknownName { name: name.to_owned() })
        }
        _ => Ok(()),
    }
}

/// Whether an object has this name.
pub(super) fn check_object(tour: &TourFile, name: &str) -> Result<(), EditError> {
    let known = tour.objects.iter().any(|object| object.name == name);
    if known { Ok(()) } else { Err(EditError::UnknownName { name: name.to_owned() }) }
}

/// Gives a thing a name that may be given; references follow.
pub(super) fn rename(tour: &mut TourFile, thing: Named, to: &str) -> Result<(), EditError> {
    check_new(tour, to, Some(thing))?;
    let name = match thing {
        Named::Object(index) => tour.objects.get_mut(index).map(|object| &mut object.name),
        Named::Band(index) => tour.background.bands.get_mut(index).map(|band| &mut band.name),
    };
    let what = if matches!(thing, Named::Object(_)) { "object" } else { "band" };
    let (Named::Object(index) | Named::Band(index)) = thing;
    let name = name.ok_or(EditError::NoSuch { what, index })?;
    let old = std::mem::replace(name, to.to_owned());
    for pair in tour.water.iter_mut().flat_map(|water| &mut water.pairs) {
        if pair.on.as_ref() == Some(&old) {
            pair.on = Some(to.to_owned());
        }
    }
    if let Some(Scale::Length { on, .. }) = &mut tour.camera.scale
        && *on == old
    {
        to.clone_into(on);
    }
    Ok(())
}

/// Lets go of a name that nothing has any more.
pub(super) fn let_go(tour: &mut TourFile, name: &str) {
    if named(tour, name).next().is_some() {
        return;
    }
    for pair in tour.water.iter_mut().flat_map(|water| &mut water.pairs) {
        pair.on.take_if(|on| on == name);
    }
    tour.camera.scale.take_if(|scale| matches!(scale, Scale::Length { on, .. } if on == name));
}

/// The things of a name; of a sound document at most one.
fn named(tour: &TourFile, name: &str) -> impl Iterator<Item = Named> {
    let objects = tour.objects.iter().map(|object| &object.name).enumerate();
    let bands = tour.background.bands.iter().map(|band| &band.name).enumerate();
    let objects = objects.filter(move |(_, other)| *other == name).map(|(index, _)| Named::Object(index));
    objects.chain(bands.filter(move |(_, other)| *other == name).map(|(index, _)| Named::Band(index)))
}
