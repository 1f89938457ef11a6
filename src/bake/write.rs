//! From an assembled tour to a file.

use std::io;
use std::path::Path;

use rayon::prelude::*;

use super::BakeError;
use super::Fingerprint;
use super::header::{ComponentEntry, Header, LayerEntry, check_fits, write_header};
use crate::assemble::AssembledTour;
use crate::assemble::TourSource;
use crate::assemble::annotations;
use crate::maps::ComponentMaps;
use crate::maps::Layer;
use crate::maps::MIP_LEVELS;
use crate::maps::Mipmapped;
use crate::tour::Tour;
use crate::tour::write_whole;

/// A component's entry and the bytes of its layers.
type Packed = (ComponentEntry, Vec<u8>, Option<Vec<u8>>);

/// A baked tour's bytes: `built` must have been assembled from `source`, and that read for `tour`, which is
/// the tour as its file says it. `fingerprint` is that of the same tour and the options of the maps.
///
/// # Errors
///
/// [`BakeError::OtherTour`] when `source` was not read for `tour`; [`BakeError::TooLarge`] for layers of more
/// than 2 GiB, or one of more than 65535 pixels along a side.
pub fn encode(
    tour: &Tour,
    source: &TourSource,
    built: &AssembledTour,
    fingerprint: Fingerprint,
) -> Result<Vec<u8>, BakeError> {
    if tour.in_pixels_of(source.uncropped_size) != source.tour {
        return Err(BakeError::OtherTour);
    }
    let maps = &built.maps.components;
    check_fits(maps.iter().flat_map(|maps| [Some(&maps.texture), maps.reflection.as_ref()]).flatten())?;
    let packed: Vec<Packed> = maps.par_iter().map(pack_component).collect();
    let header = Header {
        tour: tour.write(),
        annotations: annotations(source),
        plan: built.plan.clone(),
        remarks: built.remarks.clone(),
        tint: built.maps.tint,
        components: packed.iter().map(|(entry, ..)| entry.clone()).collect(),
    };
    let mut bytes = write_header(fingerprint, &header)?;
    for (_, texture, reflection) in packed {
        bytes.extend(texture);
        bytes.extend(reflection.unwrap_or_default());
    }
    Ok(bytes)
}

fn pack_component(maps: &ComponentMaps) -> Packed {
    let (texture, reflection) = rayon::join(|| pack(&maps.texture), || maps.reflection.as_ref().map(pack));
    let (reflection_entry, reflection) = reflection.unzip();
    let entry = ComponentEntry {
        texture: texture.0,
        reflection: reflection_entry,
        shares: maps.shares,
        mean_lift: maps.mean_lift,
    };
    (entry, texture.1, reflection)
}

pub(super) fn pack(map: &Mipmapped) -> (LayerEntry, Vec<u8>) {
    let cells: Vec<[u8; 4]> =
        (0..=MIP_LEVELS).flat_map(|level| map.level(level).cells.iter().copied()).collect();
    let bytes = lz4_flex::block::compress(cells.as_flattened());
    let hash = *blake3::hash(&bytes).as_bytes();
    let Layer { origin, size, .. } = map.layer;
    let entry = LayerEntry { origin, size, packed: bytes.len() as u64, hash };
    (entry, bytes)
}

/// Writes a baked tour's file, usually at [`baked_path`](super::baked_path), whole or not at all. For the
/// rest see [`encode`].
///
/// # Errors
///
/// A [`BakeError`] of [`encode`] as an error of kind [`io::ErrorKind::Other`]; or a folder that cannot be
/// written to, or a full disk. An older file then stays as it was.
pub fn save(
    path: &Path,
    tour: &Tour,
    source: &TourSource,
    built: &AssembledTour,
    fingerprint: Fingerprint,
) -> io::Result<()> {
    write_whole(path, &encode(tour, source, built, fingerprint).map_err(io::Error::other)?)
}
