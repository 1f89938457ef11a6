//! `.tour.ron` as a Bevy asset: the tour with its picture and masks, decoded.
//!
//! Every path is checked before it is read: Bevy does not keep an asset loader from reading outside its folder. Files
//! are read as bytes, so that a change of picture or mask reloads the tour.

use std::collections::HashMap;
use std::sync::Arc;

use bevy::asset::io::Reader;
use bevy::asset::{AssetLoader, AssetPath, LoadContext};
use bevy::prelude::*;

use crate::assemble::AssembledTour;
use crate::assemble::TourSource;
use crate::bake::{self, BakeError, Baked};
use crate::maps::MapOptions;
use crate::motion::{Recordings, RecordingsReader};
use crate::tour::Problem;
use crate::tour::Problems;
use crate::tour::RelativePath;
use crate::tour::Tour;

/// A tour to be shown. Make one in code from a [`TourSource`], or load a `.tour.ron` (with a fresh `.tour.baked` beside it
/// that is taken instead of building) or a `.tour.baked` alone.
#[derive(Asset, TypePath, Clone, Debug)]
pub enum TourAsset {
    /// With the pixels it speaks of. Where its holes are to be filled with patches, which takes seconds, a preview is
    /// shown first and refined in place.
    Source(Arc<TourSource>, MapOptions),
    /// Solved and built before.
    Built(Box<Tour>, Arc<AssembledTour>),
}

impl TourAsset {
    /// The document, in pixels of the picture that is used.
    #[must_use]
    pub fn tour(&self) -> &Tour {
        match self {
            Self::Source(source, _) => &source.tour,
            Self::Built(tour, _) => tour,
        }
    }
}

impl From<Baked> for TourAsset {
    fn from(baked: Baked) -> Self {
        Self::Built(Box::new(baked.tour), Arc::new(baked.built))
    }
}

impl From<Arc<TourSource>> for TourAsset {
    fn from(source: Arc<TourSource>) -> Self {
        Self::Source(source, MapOptions::default())
    }
}

/// Loads [`TourAsset`]s; its settings say how maps are made.
#[derive(Debug, Default, TypePath)]
pub(super) struct TourLoader;

/// Why a tour could not be loaded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TourLoadError {
    /// The file itself could not be read.
    #[error("the tour cannot be read: {0}")]
    Read(#[from] std::io::Error),
    /// The file is no text.
    #[error("{0} is not text in UTF-8; `picture-tour new PICTURE` writes a tour to start from")]
    NotText(String),
    /// The document or its files have problems.
    #[error("{0}")]
    Problems(#[from] Problems),
}

/// Loads [`TourAsset`]s that were baked, without the files they were baked from.
#[derive(Debug, Default, TypePath)]
pub(super) struct BakedTourLoader;

/// Why a baked tour could not be loaded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BakedTourLoadError {
    /// The file itself could not be read.
    #[error("the baked tour cannot be read: {0}")]
    Read(#[from] std::io::Error),
    /// It is damaged, or of another version.
    #[error("{file}: {error}")]
    Bake {
        /// The file.
        file: String,
        /// What is wrong with it.
        error: BakeError,
    },
}

impl AssetLoader for BakedTourLoader {
    type Asset = TourAsset;
    type Settings = ();
    type Error = BakedTourLoadError;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        _settings: &(),
        context: &mut LoadContext<'_>,
    ) -> Result<TourAsset, BakedTourLoadError> {
        let mut bytes = Vec::new();
        reader.read_to_end(&mut bytes).await?;
        let file = context.path().to_string();
        bake::decode(&bytes).map(TourAsset::from).map_err(|error| BakedTourLoadError::Bake { file, error })
    }

    fn extensions(&self) -> &[&str] {
        &["tour.baked"]
    }
}

impl AssetLoader for TourLoader {
    type Asset = TourAsset;
    type Settings = MapOptions;
    type Error = TourLoadError;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        settings: &MapOptions,
        context: &mut LoadContext<'_>,
    ) -> Result<TourAsset, TourLoadError> {
        let mut bytes = Vec::new();
        reader.read_to_end(&mut bytes).await?;
        let name = context.path().to_string();
        let text = String::from_utf8(bytes).map_err(|_| TourLoadError::NotText(name.clone()))?;
        let tour = Tour::read(&text).map_err(|problems| problems.with_file(&name))?;
        let mut files = HashMap::new();
        for (place, file) in tour.map_files() {
            let read = read_beside(context, &place, &file)
                .await
                .map_err(|problem| Problems::from(problem).located_in(&text).with_file(&name))?;
            files.insert(file.as_str().to_owned(), read);
        }
        let recordings = read_recordings(context, &tour).await;
        let baked = bake::baked_path(context.path().path());
        let baked_name = baked.display().to_string();
        let beside = AssetPath::from_path_buf(baked).with_source(context.path().source().clone_owned());
        let baked = context.read_asset_bytes(beside).await.ok();
        let lookup = |file: &RelativePath| match files.get(file.as_str()) {
            Some(Ok(bytes)) => Ok(bytes.clone()),
            Some(Err(error)) => Err(error.clone()),
            None => Err("it was not read".to_owned()),
        };
        match (baked.map(|bytes| bake::fresh(&bytes, &tour, settings, &lookup)), &recordings) {
            (Some(Ok(baked)), Ok(recordings)) => return Ok(baked.with_recordings(recordings.clone()).into()),
            (Some(Err(reason)), _) => warn!("{baked_name} is not used: {reason}"),
            (Some(Ok(_)), Err(_)) | (None, _) => {}
        }
        let source = TourSource::with_recordings(&tour, recordings, &lookup)
            .map_err(|problems| problems.located_in(&text).with_file(&name))?;
        Ok(TourAsset::Source(Arc::new(source), *settings))
    }

    fn extensions(&self) -> &[&str] {
        &["tour.ron"]
    }
}

/// Reads the recordings that a tour names, file by file.
async fn read_recordings(context: &mut LoadContext<'_>, tour: &Tour) -> Result<Recordings, Problems> {
    let mut reader = RecordingsReader::new(tour);
    while let Some((place, file)) = reader.wanted() {
        let read = read_beside(context, &place, &file).await;
        reader.take(read.unwrap_or_else(|problem| Err(problem.message)));
    }
    reader.finish()
}

/// Reads a file beside the tour; a path that leaves the folder is a problem, a file that is not there an error text.
async fn read_beside(
    context: &mut LoadContext<'_>,
    place: &str,
    file: &RelativePath,
) -> Result<Result<Vec<u8>, String>, Problem> {
    let refused = || {
        Problem::new(
            place,
            format!("\"{}\"", file.as_str()),
            "the path leaves the tour's folder",
            "put the file into the tour's folder or below it",
        )
    };
    let own: AssetPath<'static> = context.path().clone().into_owned();
    let path = own.resolve_embed_str(file.as_str()).map_err(|_| refused())?;
    if path.is_unapproved() || path.source() != own.source() {
        return Err(refused());
    }
    Ok(context.read_asset_bytes(path).await.map_err(|error| error.to_string()))
}
