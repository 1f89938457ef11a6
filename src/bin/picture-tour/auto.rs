//! `new --auto`: a tour that the machine drafts from the picture alone, and what of it to trust.

use std::io::{self, Write};
use std::path::Path;

use bevy_picture_tour::assemble::{DraftedTour, draft_tour};
use bevy_picture_tour::picture::DecodedPicture;
use bevy_picture_tour::tour::RelativePath;

use crate::beside;
use crate::failure::Failure;
use crate::open;
use crate::table::Table;

/// Drafts a tour of a picture, which stands in `file` from the tour's folder, and writes it with its masks.
pub(crate) fn write(decoded: &DecodedPicture, file: &RelativePath, out: &Path) -> Result<(), Failure> {
    let folder = beside::new_masks_folder(out)?;
    let bar = open::bar("looking for a reflection");
    let drafted =
        draft_tour(&decoded.picture, decoded.lens, file.as_str().to_owned(), &folder, &|share, step| {
            bar.set_message(step.to_owned());
            bar.set_position((100.0 * share) as u64);
            true
        });
    bar.finish_and_clear();
    let drafted = drafted.map_err(|error| Failure::CannotRun(error.to_string()))?;
    let gone = beside::write(&drafted.tour, &drafted.masks, &folder, out)?;
    let mut stdout = io::stdout().lock();
    tell(&drafted, &mut stdout)?;
    beside::tell_gone(&gone, &mut stdout)?;
    Ok(())
}

/// Writes what to trust.
fn tell(drafted: &DraftedTour, out: &mut impl Write) -> io::Result<()> {
    let mut table = Table::new(["", "trust", "why"]);
    for remark in &drafted.trust {
        let trust = match remark.confidence {
            sure if sure >= 0.7 => "good",
            rough if rough >= 0.35 => "rough",
            _ => "none",
        };
        table.row([remark.part.to_string(), trust.to_owned(), remark.sentence.clone()]);
    }
    table.write(out)?;
    if let Some(advice) = &drafted.advice {
        writeln!(out, "most would help: {}", advice.sentence)?;
    }
    Ok(())
}
