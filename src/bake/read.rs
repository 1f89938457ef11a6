//! From a file to an assembled tour.

use std::sync::Arc;

use glam::UVec2;
use rayon::prelude::*;

use super::BakeError;
use super::Baked;
use super::header::{ComponentEntry, LayerEntry, read_header};
use crate::assemble::AssembledTour;
use crate::maps::ComponentMaps;
use crate::maps::Layer;
use crate::maps::MIP_LEVELS;
use crate::maps::Maps;
use crate::maps::Mipmapped;
use crate::maps::mip_size;
use crate::motion::Recordings;
use crate::scene;
use crate::solve::solve;
use crate::tour::Tour;

/// Reads a baked tour back, its layers on all cores.
///
/// # Errors
///
/// Every [`BakeError`] that a file may give: any byte that is not as it was written is found. Layers reserve
/// at most 255 times the file's own length, and at most 2 GiB.
pub fn decode(bytes: &[u8]) -> Result<Baked, BakeError> {
    let (fingerprint, header, layers) = read_header(bytes)?;
    header.check_sizes(layers.len() as u64)?;
    let tour = Tour::read(&header.tour).map_err(|problems| BakeError::Header(problems.to_string()))?;
    let (size, uncropped_size) = (header.annotations.size, header.annotations.uncropped_size);
    let tour = tour.in_pixels_of(uncropped_size);
    if tour.picture.size != Some(size) {
        return Err(BakeError::Sizes(format!("the tour does not use {size} pixels of {uncropped_size}")));
    }
    let solution = solve(&header.annotations)?;
    // Its remarks are among the header's.
    let (scene, _) = scene::build(&header.plan);
    if scene.components.len() != header.components.len() {
        let (planes, maps) = (scene.components.len(), header.components.len());
        return Err(BakeError::Sizes(format!("maps for {maps} of {planes} components")));
    }
    let mut rest = layers;
    let mut blobs = Vec::with_capacity(header.components.len());
    for entry in &header.components {
        let texture = take(&mut rest, &entry.texture)?;
        let reflection = entry.reflection.as_ref().map(|layer| take(&mut rest, layer)).transpose()?;
        blobs.push((texture, reflection));
    }
    let components = header
        .components
        .par_iter()
        .zip(blobs)
        .map(|(entry, (texture, reflection))| unpack_component(entry, texture, reflection))
        .collect::<Result<_, _>>()?;
    let maps = Maps { components, tint: header.tint };
    Ok(Baked {
        fingerprint,
        tour,
        built: AssembledTour {
            solution,
            plan: header.plan,
            scene,
            maps: Arc::new(maps),
            recordings: Recordings::default(),
            remarks: header.remarks,
        },
        picture_size: size,
        uncropped_size,
    })
}

/// The next layer's bytes.
fn take<'a>(rest: &mut &'a [u8], layer: &LayerEntry) -> Result<&'a [u8], BakeError> {
    let found = rest.len() as u64;
    let packed = usize::try_from(layer.packed).ok().and_then(|packed| rest.split_at_checked(packed));
    let (own, after) = packed.ok_or(BakeError::Truncated { found, needed: layer.packed })?;
    *rest = after;
    Ok(own)
}

fn unpack_component(
    entry: &ComponentEntry,
    texture: &[u8],
    reflection: Option<&[u8]>,
) -> Result<ComponentMaps, BakeError> {
    let (texture, reflection) = rayon::join(
        || unpack(&entry.texture, texture),
        || entry.reflection.as_ref().zip(reflection).map(|(layer, bytes)| unpack(layer, bytes)).transpose(),
    );
    Ok(ComponentMaps {
        texture: texture?,
        reflection: reflection?,
        shares: entry.shares,
        mean_lift: entry.mean_lift,
    })
}

fn unpack(entry: &LayerEntry, bytes: &[u8]) -> Result<Mipmapped, BakeError> {
    let LayerEntry { origin, size, hash, .. } = *entry;
    if *blake3::hash(bytes).as_bytes() != hash {
        return Err(BakeError::Damaged(format!("in a layer of {size} pixels")));
    }
    let mut cells = vec![[0; 4]; (0..=MIP_LEVELS).map(|level| count(mip_size(size, level))).sum()];
    let wrong = |what: String| BakeError::Sizes(format!("a layer of {size} pixels unpacks to {what}"));
    match lz4_flex::block::decompress_into(bytes, cells.as_flattened_mut()) {
        Ok(unpacked) if unpacked == 4 * cells.len() => (),
        Ok(unpacked) => return Err(wrong(format!("{unpacked} bytes"))),
        Err(error) => return Err(wrong(error.to_string())),
    }
    let mut coarser: Vec<Layer> = (1..=MIP_LEVELS)
        .rev()
        .map(|level| {
            let size = mip_size(size, level);
            Layer { origin, size, cells: cells.split_off(cells.len() - count(size)) }
        })
        .collect();
    coarser.reverse();
    Ok(Mipmapped { layer: Layer { origin, size, cells }, coarser })
}

fn count(size: UVec2) -> usize {
    size.x as usize * size.y as usize
}
