//! Of what a tour was baked: a hash over everything that its maps depend on, without decoding any of it.

use serde::Serialize;

use super::header::FORMAT_VERSION;
use crate::maps::MapOptions;
use crate::tour::RelativePath;
use crate::tour::Tour;

/// A hash over everything that baked maps depend on; the same for the same tour, files, options and program.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Fingerprint(pub(super) [u8; 32]);

impl std::fmt::Display for Fingerprint {
    /// 64 hexadecimal digits.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&blake3::Hash::from_bytes(self.0).to_hex())
    }
}

impl std::fmt::Debug for Fingerprint {
    /// As it is displayed.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Fingerprint({self})")
    }
}

/// The fingerprint of a tour as its file says it; `read` gets a path relative to the tour's folder.
///
/// Wind, waves, the camera's path and how objects move are left out: a tour need not be baked again when only they
/// change. Which objects move at all is not.
///
/// # Errors
///
/// The first file that cannot be read, with its name and `read`'s reason.
pub fn fingerprint(
    tour: &Tour,
    options: &MapOptions,
    read: &dyn Fn(&RelativePath) -> Result<Vec<u8>, String>,
) -> Result<Fingerprint, String> {
    let mut parts = Parts(blake3::Hasher::new());
    parts.add(&FORMAT_VERSION.to_le_bytes());
    parts.add(env!("CARGO_PKG_VERSION").as_bytes());
    parts.add_value(options)?;
    parts.add_value(&tour.still())?;
    parts.add_value(&tour.movers())?;
    for (_, file) in tour.map_files() {
        let bytes = read(&file).map_err(|error| format!("{file} cannot be read: {error}"))?;
        parts.add(file.as_str().as_bytes());
        parts.add(&bytes);
    }
    Ok(Fingerprint(*parts.0.finalize().as_bytes()))
}

/// A hash over parts, each with its length, so that none can pass for the end of another.
struct Parts(blake3::Hasher);

impl Parts {
    fn add(&mut self, part: &[u8]) {
        self.0.update(&(part.len() as u64).to_le_bytes());
        self.0.update(part);
    }

    fn add_value(&mut self, value: &impl Serialize) -> Result<(), String> {
        let text = ron::to_string(value).map_err(|error| error.to_string())?;
        self.add(text.as_bytes());
        Ok(())
    }
}
