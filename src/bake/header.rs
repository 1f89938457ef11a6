//! What stands before the layers: the preamble of fixed length, then the header.
//!
//! A header may claim anything. Nothing is reserved for what it says before [`Header::check_sizes`] has held
//! that against the bytes that are there.

use glam::{IVec2, UVec2};
use serde::{Deserialize, Serialize};

use super::BakeError;
use super::Fingerprint;
use crate::maps::MIP_LEVELS;
use crate::maps::Mipmapped;
use crate::maps::OriginShares;
use crate::maps::Tint;
use crate::maps::mip_size;
use crate::scene::MAX_COMPONENTS;
use crate::scene::ScenePlan;
use crate::solve::Annotations;

/// The version of the file's format; one more whenever older files would read wrong, or maps be built
/// differently by the same version of the crate.
pub const FORMAT_VERSION: u32 = 7;

const MAGIC: [u8; 8] = *b"\x89PTB\r\n\x1a\n";

/// Length of what the preamble's hash covers besides the header: magic, version, fingerprint, the header's
/// length.
const HASHED: usize = 8 + 4 + 32 + 8;
/// Length of the preamble in bytes.
pub(super) const PREAMBLE: usize = HASHED + 32;

/// Longest header, bytes: over a thousand times the demo's.
const LONGEST_HEADER: usize = 1 << 24;
/// Longest side of a layer, and how far its corner may lie from the picture's, pixels.
const LONGEST_SIDE: u32 = 65_535;
/// Most bytes of all layers together, decoded.
const MOST_BYTES: u64 = 2 << 30;
/// A byte of LZ4 stands for less than this many bytes.
const MOST_PACKED: u64 = 255;

/// Everything but the layers' cells.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Header {
    /// The tour as its file says it.
    pub tour: String,
    /// What the solver was given.
    pub annotations: Annotations,
    /// What the scene was built from.
    pub plan: ScenePlan,
    /// What had to be moved or guessed.
    pub remarks: Vec<String>,
    pub tint: Tint,
    /// In the scene's order.
    pub components: Vec<ComponentEntry>,
}

/// A component's maps but for their cells.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct ComponentEntry {
    pub texture: LayerEntry,
    pub reflection: Option<LayerEntry>,
    pub shares: OriginShares,
    pub mean_lift: f32,
}

/// A layer but for its cells.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct LayerEntry {
    pub origin: IVec2,
    pub size: UVec2,
    /// Bytes in the file.
    pub packed: u64,
    /// BLAKE3 of these bytes.
    pub hash: [u8; 32],
}

impl Header {
    /// All layers in the file's order.
    fn layers(&self) -> impl Iterator<Item = &LayerEntry> {
        self.components.iter().flat_map(|entry| [Some(&entry.texture), entry.reflection.as_ref()]).flatten()
    }

    /// Holds all numbers against each other and against the `found` bytes that follow the header.
    pub(super) fn check_sizes(&self, found: u64) -> Result<(), BakeError> {
        let Annotations { size, uncropped_size, .. } = self.annotations;
        let planned = self.plan.camera.intrinsics.size;
        if size.min_element() == 0 || size.cmpgt(uncropped_size).any() || size != planned {
            let sizes = format!("{size} pixels of {uncropped_size} are marked, {planned} are used");
            return Err(BakeError::Sizes(sizes));
        }
        if self.components.len() > MAX_COMPONENTS {
            return Err(BakeError::Sizes(format!("it has {} components", self.components.len())));
        }
        check_layers(self.layers().map(|layer| (layer.origin, layer.size))).map_err(BakeError::Sizes)?;
        let too_tight = |layer: &&LayerEntry| bytes_of(layer.size) / MOST_PACKED > layer.packed;
        if let Some(layer) = self.layers().find(too_tight) {
            let (size, packed) = (layer.size, layer.packed);
            return Err(BakeError::Sizes(format!("a layer of {size} pixels cannot fit into {packed} bytes")));
        }
        let needed = self.layers().fold(0, |sum: u64, layer| sum.saturating_add(layer.packed));
        match needed {
            _ if found < needed => Err(BakeError::Truncated { found, needed }),
            _ if found > needed => Err(BakeError::Damaged(format!("{} bytes too many", found - needed))),
            _ => Ok(()),
        }
    }
}

/// Bytes of a layer's cells with all its mip levels.
fn bytes_of(size: UVec2) -> u64 {
    (0..=MIP_LEVELS)
        .map(|level| mip_size(size, level))
        .map(|size| 4 * u64::from(size.x) * u64::from(size.y))
        .sum()
}

/// Whether layers, each with its origin and size in pixels, are within what a file may hold; else what is
/// not.
fn check_layers(layers: impl Iterator<Item = (IVec2, UVec2)>) -> Result<(), String> {
    let mut sum = 0;
    for (origin, size) in layers {
        let far = origin.to_array().iter().any(|distance| distance.unsigned_abs() > LONGEST_SIDE);
        if far || size.max_element() > LONGEST_SIDE || size.min_element() == 0 {
            return Err(format!("a layer of {size} pixels at {origin}"));
        }
        sum += bytes_of(size);
        if sum > MOST_BYTES {
            return Err(format!("layers of more than {} MiB", MOST_BYTES >> 20));
        }
    }
    Ok(())
}

/// Whether all these layers can be baked.
pub(super) fn check_fits<'a>(layers: impl Iterator<Item = &'a Mipmapped>) -> Result<(), BakeError> {
    check_layers(layers.map(|map| (map.layer.origin, map.layer.size))).map_err(BakeError::TooLarge)
}

/// Preamble and header as bytes.
pub(super) fn write_header(fingerprint: Fingerprint, header: &Header) -> Result<Vec<u8>, BakeError> {
    let text = ron::to_string(header).map_err(|error| BakeError::Header(error.to_string()))?;
    if text.len() > LONGEST_HEADER {
        return Err(BakeError::TooLarge(format!("a header of {} bytes", text.len())));
    }
    let mut bytes = MAGIC.to_vec();
    bytes.extend(FORMAT_VERSION.to_le_bytes());
    bytes.extend(fingerprint.0);
    bytes.extend((text.len() as u64).to_le_bytes());
    let hash = hash_of(&bytes, text.as_bytes());
    bytes.extend(hash.as_bytes());
    bytes.extend(text.as_bytes());
    Ok(bytes)
}

/// Fingerprint and header of a file, and the layers' bytes.
pub(super) fn read_header(bytes: &[u8]) -> Result<(Fingerprint, Header, &[u8]), BakeError> {
    let fingerprint = fingerprint_of(bytes)?;
    let found = bytes.len() as u64;
    let truncated = |needed: usize| BakeError::Truncated { found, needed: needed as u64 };
    let (preamble, rest) = bytes.split_at_checked(PREAMBLE).ok_or_else(|| truncated(PREAMBLE))?;
    let (hashed, hash) = preamble.split_at(HASHED);
    let (_, length) = hashed.split_last_chunk().unwrap_or((&[], &[0; 8]));
    let length = u64::from_le_bytes(*length);
    let Some(length) = usize::try_from(length).ok().filter(|length| *length <= LONGEST_HEADER) else {
        return Err(BakeError::Damaged(format!("its header is said to have {length} bytes")));
    };
    let (text, layers) = rest.split_at_checked(length).ok_or_else(|| truncated(PREAMBLE + length))?;
    if hash_of(hashed, text).as_bytes() != hash {
        return Err(BakeError::Damaged("in its header".to_owned()));
    }
    let header = ron::de::from_bytes(text).map_err(|error| BakeError::Header(error.to_string()))?;
    Ok((fingerprint, header, layers))
}

fn hash_of(hashed: &[u8], text: &[u8]) -> blake3::Hash {
    blake3::Hasher::new().update(hashed).update(text).finalize()
}

/// The fingerprint of a baked tour's bytes, of which the first 44 are enough: whether it is worth decoding.
///
/// The bytes after it are not looked at; [`decode`](super::decode) finds what is damaged.
///
/// # Errors
///
/// [`BakeError::NotBaked`], [`BakeError::OtherVersion`], or [`BakeError::Truncated`] with fewer than 44
/// bytes.
pub fn fingerprint_of(bytes: &[u8]) -> Result<Fingerprint, BakeError> {
    let found = bytes.len() as u64;
    let truncated = BakeError::Truncated { found, needed: PREAMBLE as u64 };
    if !bytes.starts_with(&MAGIC) {
        let is_start = !bytes.is_empty() && MAGIC.starts_with(bytes);
        return Err(if is_start { truncated } else { BakeError::NotBaked });
    }
    let Some((version, rest)) = bytes[MAGIC.len()..].split_first_chunk() else { return Err(truncated) };
    match u32::from_le_bytes(*version) {
        FORMAT_VERSION => rest.first_chunk().map(|hash| Fingerprint(*hash)).ok_or(truncated),
        found => Err(BakeError::OtherVersion { found, readable: FORMAT_VERSION }),
    }
}
