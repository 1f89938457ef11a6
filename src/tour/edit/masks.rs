//! The masks beside a document, and rectangles of coverage as edits keep them.
//!
//! A mask is known by the path that the document names it by. Its pixels are shared: a clone of the store is cheap, and a
//! mask that was not painted on is the same one ([`Arc::ptr_eq`]). Painting copies a mask only while somebody else holds it,
//! so whoever wants to know no more than whether it is still the same holds a [`Weak`](std::sync::Weak).

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::UVec2;
use lz4_flex::block::{compress, decompress};
use serde::{Deserialize, Serialize};

use crate::picture::{Mask, PixelRect};

use super::EditError;
use super::desk::free_name;

/// Masks by their paths below the tour's folder.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Masks(BTreeMap<String, Arc<Mask>>);

impl Masks {
    /// The mask of this path.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Arc<Mask>> {
        self.0.get(name)
    }

    /// All masks, by path.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Arc<Mask>)> {
        self.0.iter().map(|(name, mask)| (name.as_str(), mask))
    }

    /// Puts in a mask as it is in its file. What a user does is an [`Edit::Mask`](super::Edit::Mask), which can be undone.
    pub fn load(&mut self, name: impl Into<String>, mask: Mask) {
        self.0.insert(name.into(), Arc::new(mask));
    }

    /// Whether a path is that of a first guess, which nobody has looked at yet: the machine's masks are in a folder of their own,
    /// `masks/draft` (`masks/draft-2`, …) where they were drafted on a desk, else `<tour>.masks` (`<tour>.masks_2`, …).
    pub(super) fn is_guess(path: &str) -> bool {
        let Some((folder, _)) = path.rsplit_once('/') else { return false };
        let drafted = folder.strip_prefix("masks/draft");
        drafted.is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
            || folder.ends_with(".masks")
            || folder.rsplit_once(".masks_").is_some_and(|(_, number)| number.parse::<u32>().is_ok())
    }

    /// A path that no mask has yet: `masks/boat.png`, `masks/boat-2.png`, …
    ///
    /// Characters that files had better not have become `-`. With files, ask
    /// [`Desk::free_mask_name`](super::desk::Desk::free_mask_name), which knows those of other tours too.
    #[must_use]
    pub fn free_name(&self, of: &str) -> String {
        self.free_name_besides(of, |_| false)
    }

    /// The same, where other names are taken too.
    pub(super) fn free_name_besides(&self, of: &str, taken: impl Fn(&str) -> bool) -> String {
        let letter = |c: char| if c.is_alphanumeric() || "-_ ".contains(c) { c } else { '-' };
        let stem: String = of.trim().chars().map(letter).collect();
        let stem = if stem.is_empty() { "mask" } else { &stem };
        // Some file systems do not tell letters of different case apart.
        let known = |name: &str| self.0.keys().any(|other| other.to_lowercase() == name.to_lowercase());
        free_name(&format!("masks/{stem}.png"), ".png", |name| known(name) || taken(name))
    }

    /// Exchanges a whole mask for another one or none, and gives the old one.
    pub(super) fn exchange(&mut self, name: &str, mask: Option<Arc<Mask>>) -> Option<Arc<Mask>> {
        match mask {
            Some(mask) => self.0.insert(name.to_owned(), mask),
            None => self.0.remove(name),
        }
    }

    /// Puts a patch's coverage into a mask, and gives the patch that puts back what was there.
    pub(super) fn paint(&mut self, name: &str, patch: &MaskPatch) -> Result<MaskPatch, EditError> {
        let Some(mask) = self.0.get_mut(name) else {
            return Err(EditError::NoMask { name: name.to_owned() });
        };
        let before = MaskPatch::of(mask, patch.rect);
        let before = before.ok_or_else(|| EditError::PatchMisfit { name: name.to_owned() })?;
        let painted = patch.values()?;
        // In place; for those who hold it by a `Weak`, the mask is another one from now on.
        let is_painted = Arc::make_mut(mask).set_block(patch.rect, &painted);
        is_painted.then_some(before).ok_or(EditError::Damaged)
    }
}

/// A whole mask, packed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PackedMask {
    size: UVec2,
    bytes: Vec<u8>,
}

impl PackedMask {
    /// Packs a mask.
    #[must_use]
    pub fn new(mask: &Mask) -> Self {
        Self { size: mask.size(), bytes: compress(mask.values()) }
    }

    /// The mask again.
    ///
    /// # Errors
    /// [`EditError::Damaged`] when the bytes, read from a file, are not a mask's.
    pub fn unpack(&self) -> Result<Mask, EditError> {
        let values = unpack(self.size, &self.bytes)?;
        Mask::new(self.size, values).map_err(|_| EditError::Damaged)
    }
}

/// Coverage in a rectangle of a mask, packed.
#[derive(Clone, PartialEq, Eq)]
pub struct MaskPatch {
    rect: PixelRect,
    bytes: Vec<u8>,
}

impl MaskPatch {
    /// Packs coverage, 0–255, row by row from the rectangle's top left.
    ///
    /// `None` when there is no pixel in the rectangle or not one value for each.
    #[must_use]
    pub fn new(rect: PixelRect, coverage: &[u8]) -> Option<Self> {
        let in_order = rect.min.cmplt(rect.max).all();
        let fits = in_order && rect.size().x as usize * rect.size().y as usize == coverage.len();
        fits.then(|| Self { rect, bytes: compress(coverage) })
    }

    /// What a mask shows in a rectangle; `None` when that is empty or reaches beyond the mask.
    #[must_use]
    pub fn of(mask: &Mask, rect: PixelRect) -> Option<Self> {
        Self::new(rect, &mask.block(rect)?)
    }

    /// Where it lies.
    #[must_use]
    pub const fn rect(&self) -> PixelRect {
        self.rect
    }

    fn values(&self) -> Result<Vec<u8>, EditError> {
        unpack(self.rect.size(), &self.bytes)
    }
}

impl std::fmt::Debug for MaskPatch {
    /// The rectangle alone: nobody reads packed bytes.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MaskPatch").field("rect", &self.rect).finish_non_exhaustive()
    }
}

/// Takes no more memory than the size says, whatever the bytes promise.
fn unpack(size: UVec2, bytes: &[u8]) -> Result<Vec<u8>, EditError> {
    let pixels = u64::from(size.x) * u64::from(size.y);
    if pixels > crate::picture::MAX_PIXELS {
        return Err(EditError::Damaged);
    }
    let values = decompress(bytes, pixels as usize).map_err(|_| EditError::Damaged)?;
    (values.len() as u64 == pixels).then_some(values).ok_or(EditError::Damaged)
}
