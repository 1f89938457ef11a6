//! `.tour.ron` as a Bevy asset: the tour with its picture and masks, decoded.
//!
//! Every path is checked before it is read: Bevy does not keep an asset loader from reading outside its folder. Files
//! are read as bytes, so that a change of picture or mask reloads the tour.

use std::collections::HashMap;
use std::sync::Arc;

use bevy::asset::io::Reader;
use bevy::asset::{AssetLoader, AssetPath, LoadContext};
use bevy::prelude::*;

use crate::assemble::TourSource;
use crate::tour::Problem;
use crate::tour::Problems;
use crate::tour::Region;
use crate::tour::RelativePath;
use crate::tour::Tour;

/// A tour with the pixels it speaks of. Build one in code with [`TourSource::read`], or load a `.tour.ron`.
#[derive(Asset, TypePath, Clone, Debug)]
pub struct TourAsset(pub Arc<TourSource>);

/// Loads [`TourAsset`]s.
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

impl AssetLoader for TourLoader {
    type Asset = TourAsset;
    type Settings = ();
    type Error = TourLoadError;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        _settings: &(),
        context: &mut LoadContext<'_>,
    ) -> Result<TourAsset, TourLoadError> {
        let mut bytes = Vec::new();
        reader.read_to_end(&mut bytes).await?;
        let name = context.path().to_string();
        let text = String::from_utf8(bytes).map_err(|_| TourLoadError::NotText(name.clone()))?;
        let tour = Tour::read(&text).map_err(|problems| problems.with_file(&name))?;
        let mut files = HashMap::new();
        for (place, file) in maps_of(&tour) {
            let read = read_beside(context, &place, &file)
                .await
                .map_err(|problem| Problems::from(problem).located_in(&text).with_file(&name))?;
            files.insert(file.as_str().to_owned(), read);
        }
        let lookup = |file: &RelativePath| match files.get(file.as_str()) {
            Some(Ok(bytes)) => Ok(bytes.clone()),
            Some(Err(error)) => Err(error.clone()),
            None => Err("it was not read".to_owned()),
        };
        let source = TourSource::read(&tour, &lookup)
            .map_err(|problems| problems.located_in(&text).with_file(&name))?;
        Ok(TourAsset(Arc::new(source)))
    }

    fn extensions(&self) -> &[&str] {
        &["tour.ron"]
    }
}

/// The picture and the masks that maps are built from, with the places that name them.
fn maps_of(tour: &Tour) -> Vec<(String, RelativePath)> {
    let mut files = vec![("picture.file".to_owned(), tour.picture.file.clone())];
    let mut mask = |place: String, region: &Region| {
        if let Region::Mask(file) = region {
            files.push((place, file.clone()));
        }
    };
    if let Some(water) = &tour.water {
        mask("water.region".to_owned(), &water.region);
    }
    if let Some(ground) = &tour.ground {
        mask("ground.region".to_owned(), &ground.region);
    }
    for (i, band) in tour.background.bands.iter().enumerate() {
        if let Some(region) = &band.region {
            mask(format!("background.bands[{i}].region"), region);
        }
    }
    if let Some(region) = tour.sky.as_ref().and_then(|sky| sky.region.as_ref()) {
        mask("sky.region".to_owned(), region);
    }
    for (i, object) in tour.objects.iter().enumerate() {
        mask(format!("objects[{i}].outline"), &object.outline);
    }
    files
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
