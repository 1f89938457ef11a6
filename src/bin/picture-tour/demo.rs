//! The demo that the program brings along: a mountain lake, rendered for this project (`assets/CREDITS.md`).

use bevy_picture_tour::assemble::TourSource;
use bevy_picture_tour::tour::Problems;
use bevy_picture_tour::tour::RelativePath;
use bevy_picture_tour::tour::Tour;

/// What messages call the demo's tour file.
pub(crate) const NAME: &str = "the demo (lake.tour.ron)";

/// The text of the demo's tour file.
pub(crate) const TOUR: &str = include_str!("../../../assets/lake/lake.tour.ron");

/// The files that the demo's tour names.
const FILES: [(&str, &[u8]); 9] = [
    ("lake.png", include_bytes!("../../../assets/lake/lake.png")),
    ("masks/blue_boat.png", include_bytes!("../../../assets/lake/masks/blue_boat.png")),
    ("masks/boat.png", include_bytes!("../../../assets/lake/masks/boat.png")),
    ("masks/conifers.png", include_bytes!("../../../assets/lake/masks/conifers.png")),
    ("masks/farshore.png", include_bytes!("../../../assets/lake/masks/farshore.png")),
    ("masks/ground.png", include_bytes!("../../../assets/lake/masks/ground.png")),
    ("masks/rocks.png", include_bytes!("../../../assets/lake/masks/rocks.png")),
    ("masks/sky.png", include_bytes!("../../../assets/lake/masks/sky.png")),
    ("masks/water.png", include_bytes!("../../../assets/lake/masks/water.png")),
];

/// The demo's bytes of a file that its tour names.
pub(crate) fn file(path: &RelativePath) -> Result<Vec<u8>, String> {
    let found = FILES.iter().find(|(name, _)| *name == path.as_str());
    found.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| "it is not part of the program".to_owned())
}

/// The demo with its files read.
pub(crate) fn source() -> Result<TourSource, Problems> {
    let tour = Tour::read(TOUR).map_err(|problems| problems.with_file(NAME))?;
    TourSource::read(&tour, &file).map_err(|problems| problems.located_in(TOUR).with_file(NAME))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_demo_is_sound_and_its_path_ends_where_the_picture_was_taken() {
        let source = source().unwrap();
        let path = source.tour.path.as_ref().unwrap();

        assert!(path.looped);
        assert_eq!(path.keyframes[0].position, glam::DVec3::new(0.0, 1.8, 0.0));
        assert_eq!(source.objects.len(), 4);
    }
}
