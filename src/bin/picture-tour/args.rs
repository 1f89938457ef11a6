//! The command line.

use std::ops::Range;
use std::path::PathBuf;

use bevy_picture_tour::motion::LONGEST_LOOP;
use bevy_picture_tour::motion::LoopError;
use bevy_picture_tour::motion::SHORTEST_LOOP;
use clap::Args;
use clap::Parser;
use clap::Subcommand;
use glam::UVec2;

/// Longest side of a frame, pixels.
pub(crate) const MAX_SIDE: u32 = 16_384;

/// Step into a picture that has water in it.
///
/// Without a command this opens a window on the tour, or on a demo that the program brings along.
/// A tour is a text file beside its picture; `picture-tour new PICTURE` writes one to start from.
#[derive(Debug, Parser)]
#[command(
    version,
    args_conflicts_with_subcommands = true,
    after_help = "Exit status: 0 done, 1 problems found in the tour, 2 could not run."
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
    /// The tour to open: a file that ends in .tour.ron or .tour.baked; the demo if left out
    pub(crate) tour: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Open a window and fly through the tour (H shows the keys)
    Play {
        /// The tour to open; the demo if left out
        tour: Option<PathBuf>,
    },
    /// Mark a picture and fly into it while you do: the studio
    Edit {
        /// The picture or tour to open
        file: Option<PathBuf>,
    },
    /// Write views or a film of the tour, as PNG frames or through ffmpeg, without a window
    Render(RenderArguments),
    /// Tell what is wrong with a tour, and how well its picture is solved
    ///
    /// Problems go to stderr, each with its line; the report goes to stdout. With --json both go to stdout.
    Check {
        /// The tour to check; the demo if left out
        tour: Option<PathBuf>,
        /// Write the report for machines, as JSON
        #[arg(long)]
        json: bool,
        /// Also draw a sheet to judge the tour by: the picture, what is behind everything, four other views
        #[arg(long, value_name = "FILE.png")]
        sheet: Option<PathBuf>,
        /// Also draw the distances that the water's mirror image tells, near red, far blue, with a scale in meters
        #[arg(long, value_name = "FILE.png")]
        depth: Option<PathBuf>,
    },
    /// Cut the background into bands at the distances that the water's mirror image tells
    ///
    /// NAME.tour.ron gets NAME.bands.tour.ron beside it, and a folder with the masks. A background at one distance stays
    /// whole and gets that distance. The old tour stays as it is.
    Bands(BandsArguments),
    /// Write a tour file to start from, with comments that tell what to fill in
    New(NewArguments),
    /// Build all layers of a tour once, so that it opens at once from then on
    ///
    /// NAME.tour.ron gets NAME.tour.baked beside it. It is used as long as picture, masks, marks and program stay the
    /// same; a game can load it alone.
    Bake {
        /// The tour to bake
        tour: PathBuf,
        /// Bake again though the baked file is fresh
        #[arg(long)]
        force: bool,
    },
}

#[derive(Debug, Args)]
pub(crate) struct BandsArguments {
    /// The tour whose background to cut
    pub(crate) tour: PathBuf,
    /// Where to write the new tour; in the folder of the old one
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Cut anew a background that has bands already
    #[arg(long)]
    pub(crate) anew: bool,
    /// Replace a tour file that is already there
    ///
    /// Masks that were made for it go too, unless somebody has changed them or another tour names them.
    #[arg(long)]
    pub(crate) force: bool,
}

#[derive(Debug, Args)]
pub(crate) struct NewArguments {
    /// The picture: PNG, JPEG, TIFF or WebP
    pub(crate) picture: PathBuf,
    /// Where to write the tour; in the picture's folder or above it
    ///
    /// Left out, it is written beside the picture: lake.png gets lake.tour.ron.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Let the machine find horizon, reflection pairs, water, sky and distances, and tell what of it to trust
    #[arg(long)]
    pub(crate) auto: bool,
    /// Replace a tour file that is already there
    ///
    /// Masks that were made for it go too, unless somebody has changed them or another tour names them.
    #[arg(long)]
    pub(crate) force: bool,
}

#[derive(Debug, Args)]
pub(crate) struct RenderArguments {
    /// The tour to render; the demo if left out
    pub(crate) tour: Option<PathBuf>,
    /// Folder for the frames, made if it is not there; or FILE.png for one frame, FILE.mp4 or FILE.webm for a film (needs ffmpeg)
    #[arg(long, value_name = "DIR|FILE")]
    pub(crate) out: PathBuf,
    /// Render these views: a JSON list of `{"name", "position": [x, y, z], "yaw_deg", "pitch_deg", "roll_deg"}`
    ///
    /// Meters: x right, y above the water, -z into the picture. Angles left out are 0. Each view becomes NAME.png.
    #[arg(long, value_name = "FILE.json", conflicts_with_all = ["path", "at", "loop_seconds"])]
    pub(crate) views: Option<PathBuf>,
    /// Render the tour's camera path, as `frame_00000.png` and so on
    #[arg(long, conflicts_with = "at")]
    pub(crate) path: bool,
    /// Render a film that begins anew after this many seconds (8 to 3600) without a seam
    ///
    /// Waves, wind and courses are fitted to it. The camera stays where the picture was taken, or goes whole rounds of the
    /// tour's path with --path.
    #[arg(long = "loop", value_name = "SECONDS", value_parser = parse_loop, conflicts_with_all = ["at", "still"])]
    pub(crate) loop_seconds: Option<f64>,
    /// Only these frames of the path or loop: from A up to, not including, B (either may be left out)
    #[arg(long, value_name = "A..B", value_parser = parse_frames, conflicts_with_all = ["views", "at"])]
    pub(crate) frames: Option<Frames>,
    /// Render one frame this many seconds after the start, from where the path's camera is then
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
    pub(crate) at: Option<f64>,
    /// Size of the frames in pixels, like 1280x720; the picture's if left out
    ///
    /// In another shape than the picture's, two of its sides are cropped.
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(crate) size: Option<UVec2>,
    /// Rays per pixel, averaged; more make edges smoother. On the graphics card a square number: 1, 4, 9, 16 ...
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=256))]
    pub(crate) samples: u32,
    /// Use the reference ray tracer on the processor instead of the graphics card
    #[arg(long)]
    pub(crate) reference: bool,
    /// Without motion: no wind, no waves, as in the picture
    #[arg(long)]
    pub(crate) still: bool,
    /// Frames a second of the path or loop
    #[arg(long, value_name = "N", default_value_t = 30,
        value_parser = clap::value_parser!(u32).range(1..=240))]
    pub(crate) fps: u32,
}

impl RenderArguments {
    /// The tour's path (or its first view) as a small film: what stands in for a window, quick without a graphics card.
    pub(crate) fn small_film(tour: Option<PathBuf>, out: PathBuf, path: bool) -> Self {
        Self {
            tour,
            out,
            views: None,
            path,
            loop_seconds: None,
            frames: None,
            at: None,
            size: Some(UVec2::new(960, 540)),
            samples: 1,
            reference: false,
            still: false,
            fps: 10,
        }
    }
}

/// Frames from `first` up to, not including, `end`; to the last where that is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Frames {
    first: u32,
    end: Option<u32>,
}

impl Frames {
    /// The same of `count` frames; `None` when they have none in common.
    pub(crate) fn of(self, count: u32) -> Option<Range<u32>> {
        let range = self.first..self.end.map_or(count, |end| end.min(count));
        (!range.is_empty()).then_some(range)
    }
}

fn parse_frames(text: &str) -> Result<Frames, String> {
    let number = |text: &str, missing| match text.trim() {
        "" => Ok(missing),
        text => text.parse().map(Some).map_err(|_| format!("`{text}` is no frame number")),
    };
    let (first, end) = text.split_once("..").ok_or("write two frame numbers, like 0..90")?;
    let frames = Frames { first: number(first, Some(0))?.unwrap_or(0), end: number(end, None)? };
    if frames.end.is_some_and(|end| end <= frames.first) {
        return Err("the second number must be above the first".to_owned());
    }
    Ok(frames)
}

fn parse_size(text: &str) -> Result<UVec2, String> {
    let side = |text: &str| {
        let side = text.trim().parse().map_err(|_| format!("`{text}` is no whole number of pixels"))?;
        if (1..=MAX_SIDE).contains(&side) {
            Ok(side)
        } else {
            Err(format!("{side} px is out of range; a side has 1 to {MAX_SIDE} px"))
        }
    };
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or("write width and height, like 1280x720")?;
    Ok(UVec2::new(side(width)?, side(height)?))
}

fn parse_seconds(text: &str) -> Result<f64, String> {
    match text.trim().trim_end_matches('s').parse::<f64>() {
        Ok(seconds) if seconds.is_finite() && seconds >= 0.0 => Ok(seconds),
        _ => Err("write seconds from 0 on, like 12.5".to_owned()),
    }
}

/// Before any frame is planned: a year of them would not fit into memory.
fn parse_loop(text: &str) -> Result<f64, String> {
    let seconds = parse_seconds(text)?;
    if (SHORTEST_LOOP..=LONGEST_LOOP).contains(&seconds) {
        Ok(seconds)
    } else {
        Err(LoopError::Length(seconds).to_string())
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_contradicts_itself_nowhere() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn sizes_are_pixels_within_bounds() {
        assert_eq!(parse_size("1280x720"), Ok(UVec2::new(1280, 720)));
        assert_eq!(parse_size("16384x1"), Ok(UVec2::new(16_384, 1)));
        for bad in ["", "12", "0x5", "16385x2", "-1x4", "ax4", "4x4x4"] {
            assert!(parse_size(bad).is_err(), "{bad:?} was taken for a size");
        }
    }

    #[test]
    fn loops_are_neither_short_nor_endless() {
        assert_eq!(parse_loop("8"), Ok(8.0));
        assert_eq!(parse_loop("3600s"), Ok(3600.0));
        for bad in ["7.9", "3600.1", "1e9", "NaN", "-9", ""] {
            assert!(parse_loop(bad).is_err(), "{bad:?} was taken for the length of a loop");
        }
    }

    #[test]
    fn frames_belong_to_films() {
        let render = |more: &str| {
            Arguments::try_parse_from(
                ["picture-tour", "render", "--out", "o"].into_iter().chain(more.split(' ')),
            )
        };
        assert!(render("--path --frames 0..3").is_ok() && render("--loop 8 --frames 0..3").is_ok());
        assert!(render("--at 3 --frames 0..3").is_err() && render("--views v.json --frames 0..3").is_err());
    }

    #[test]
    fn frames_are_half_open_and_end_with_the_path() {
        assert_eq!(parse_frames("3..9").map(|frames| frames.of(100)), Ok(Some(3..9)));
        assert_eq!(parse_frames("..").map(|frames| frames.of(100)), Ok(Some(0..100)));
        assert_eq!(parse_frames("90..200").map(|frames| frames.of(100)), Ok(Some(90..100)));
        assert_eq!(parse_frames("100..").map(|frames| frames.of(100)), Ok(None));
        for bad in ["", "5", "9..3", "3..3", "a..b"] {
            assert!(parse_frames(bad).is_err(), "{bad:?} was taken for frames");
        }
    }
}
