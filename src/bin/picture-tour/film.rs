//! A film made of frames by `ffmpeg`, whole or not at all.

use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};

use bevy_picture_tour::picture::Picture;
use glam::UVec2;
use tempfile::TempPath;

use crate::beside;
use crate::failure::Failure;

/// What a film's file may end in, and how `ffmpeg` makes that: players everywhere take 8-bit 4:2:0.
const FORMATS: [(&str, &[&str]); 2] = [
    ("mp4", &["-f", "mp4", "-c:v", "libx264", "-preset", "slow", "-crf", "16", "-movflags", "+faststart"]),
    ("webm", &["-f", "webm", "-c:v", "libvpx-vp9", "-crf", "22", "-b:v", "0", "-row-mt", "1"]),
];

/// Says in a film what its colors are: the picture's own, as television has them; its sides are made even.
const COLORS: &str =
    "crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";

/// A film that is being made.
pub(crate) struct Film {
    encoder: Child,
    /// `None` once it broke.
    frames: Option<ChildStdin>,
    unfinished: TempPath,
    file: PathBuf,
}

/// Whether a path is to become a film rather than a folder of frames.
pub(crate) fn is_film(path: &Path) -> bool {
    options(path).is_some()
}

fn options(path: &Path) -> Option<&'static [&'static str]> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    FORMATS.iter().find(|(ending, _)| *ending == extension).map(|(_, options)| *options)
}

impl Film {
    /// Starts a film of frames of a size, so many a second.
    pub(crate) fn start(file: &Path, size: UVec2, fps: u32) -> Result<Self, Failure> {
        let folder = beside::folder(file);
        let mut unfinished = tempfile::Builder::new();
        unfinished.prefix(".film-");
        // A temporary file is private; a film is as open as any new file, less what the user's mask takes away.
        #[cfg(unix)]
        unfinished.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let unfinished = std::fs::create_dir_all(folder)
            .and_then(|()| unfinished.tempfile_in(folder))
            .map_err(|error| cannot(file, &format!("{error}; name a file that may be written with --out")))?
            .into_temp_path();
        let mut encoder = Command::new("ffmpeg")
            .args(["-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"])
            .args(["-s", &format!("{}x{}", size.x, size.y), "-r", &fps.to_string(), "-i", "-"])
            .args(["-vf", COLORS, "-colorspace", "bt709", "-color_primaries", "bt709"])
            .args(["-color_trc", "iec61966-2-1"])
            .args(options(file).unwrap_or_default())
            .arg(&unfinished)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| match error.kind() {
                io::ErrorKind::NotFound => Failure::CannotRun(
                    "ffmpeg was not found, which makes films; install it, or name a folder with --out for frames"
                        .to_owned(),
                ),
                _ => cannot(file, &format!("ffmpeg does not start: {error}")),
            })?;
        let frames = encoder.stdin.take();
        Ok(Self { encoder, frames, unfinished, file: file.to_owned() })
    }

    /// Adds a frame.
    pub(crate) fn add(&mut self, picture: &Picture) -> Result<(), Failure> {
        let written = self.frames.as_mut().map(|frames| frames.write_all(picture.pixels().as_flattened()));
        match written {
            Some(Ok(())) => Ok(()),
            // The encoder's own words say more.
            Some(Err(_)) | None => Err(self.failed()),
        }
    }

    /// Ends the film and gives it its name.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        drop(self.frames.take());
        match self.encoder.wait() {
            Ok(status) if status.success() => {
                self.unfinished.persist(&self.file).map_err(|error| cannot(&self.file, &error.to_string()))
            }
            _ => Err(self.failed()),
        }
    }

    fn failed(&mut self) -> Failure {
        drop(self.frames.take());
        let mut words = String::new();
        if let Some(mut said) = self.encoder.stderr.take() {
            // What cannot be read is left out.
            let _ = said.read_to_string(&mut words);
        }
        let _ = self.encoder.wait();
        let words = words.lines().last().unwrap_or("it ended").to_owned();
        cannot(&self.file, &format!("ffmpeg says: {words}; name a folder with --out for frames"))
    }
}

fn cannot(file: &Path, why: &str) -> Failure {
    Failure::CannotRun(format!("{} cannot be written: {why}", file.display()))
}
