//! What another simulator made of a tour's water and bodies: frames of heights, and poses by time.

use crate::picture::HeightSamples;
use crate::picture::decode_heights;
use crate::tour::Motion;
use crate::tour::Problem;
use crate::tour::Problems;
use crate::tour::Recorded;
use crate::tour::RecordedSea;
use crate::tour::RelativePath;
use crate::tour::Sea;
use crate::tour::Tour;
use crate::water::body::RecordedPoses;
use crate::water::sea::{FRAME_SIDES, SeaFrames};

/// Frames whose problems are told one by one.
const MOST_TOLD: usize = 5;

/// The recordings that a tour names, read. Without any for most tours, and for baked ones without their document.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recordings {
    /// The frames of the sea; a clone shares them.
    pub sea: Option<SeaFrames>,
    /// The poses of each recorded motion.
    pub poses: Vec<(Recorded, RecordedPoses)>,
    /// What will be seen of how they were made, in words.
    pub notes: Vec<String>,
}

impl Recordings {
    /// Reads what a tour names; `read` gets a path relative to the tour's folder.
    ///
    /// # Errors
    ///
    /// All problems at once: files that are missing or do not read, frames of other sizes or that are none, poses that
    /// cannot be used.
    pub fn read(
        tour: &Tour,
        read: &dyn Fn(&RelativePath) -> Result<Vec<u8>, String>,
    ) -> Result<Self, Problems> {
        let mut reader = RecordingsReader::new(tour);
        while let Some((_, file)) = reader.wanted() {
            let bytes = read(&file);
            reader.take(bytes);
        }
        reader.finish()
    }

    /// The poses of a recorded motion.
    #[must_use]
    pub fn poses_of(&self, recorded: &Recorded) -> Option<&RecordedPoses> {
        self.poses.iter().find(|(of, _)| of == recorded).map(|(_, poses)| poses)
    }
}

/// Reads recordings file by file, so that no two files need be held at once.
#[derive(Debug)]
pub struct RecordingsReader {
    /// What is left to read, last first.
    files: Vec<(RelativePath, Part)>,
    scale: f32,
    read: Recordings,
    frames: Option<SeaFrames>,
    coarse_frames: usize,
    problems: Vec<Problem>,
    bad_frames: usize,
}

/// What a file is for.
#[derive(Debug)]
enum Part {
    Frame,
    Poses { place: String, motion: Recorded },
}

impl Part {
    /// Where the tour names it.
    fn place(&self) -> &str {
        match self {
            Self::Frame => "waves.sea.first",
            Self::Poses { place, .. } => place,
        }
    }
}

impl RecordingsReader {
    /// Begins with the files that a tour names.
    #[must_use]
    pub fn new(tour: &Tour) -> Self {
        let mut files = Vec::new();
        let (mut frames, mut scale) = (None, 1.0);
        if let Sea::Recorded(sea) = &tour.waves.sea {
            let RecordedSea { count, frames_per_second, height, area, .. } = sea;
            frames = Some(SeaFrames::new((*area).into(), *frames_per_second));
            scale = *height as f32;
            // A checked tour's names do count so far.
            files.extend((0..*count).filter_map(|index| Some((sea.frame(index)?, Part::Frame))));
        }
        for (index, object) in tour.objects.iter().enumerate() {
            if let Motion::Recorded(motion) = &object.motion {
                let place = format!("objects[{index}].motion.poses");
                files.push((motion.poses.clone(), Part::Poses { place, motion: motion.clone() }));
            }
        }
        files.reverse();
        Self {
            files,
            scale,
            read: Recordings::default(),
            frames,
            coarse_frames: 0,
            problems: Vec::new(),
            bad_frames: 0,
        }
    }

    /// The file that is to be [taken](Self::take) next, and where the tour names it.
    #[must_use]
    pub fn wanted(&self) -> Option<(String, RelativePath)> {
        self.files.last().map(|(file, part)| (part.place().to_owned(), file.clone()))
    }

    /// Takes the bytes of the file that was wanted, or why it cannot be read.
    pub fn take(&mut self, bytes: Result<Vec<u8>, String>) {
        let Some((file, part)) = self.files.pop() else { return };
        let bytes = bytes.map_err(|error| {
            let advice =
                "put the file beside the tour, or write the path it has, relative to the tour's folder";
            (format!("the file cannot be read: {error}"), advice.to_owned())
        });
        let place = part.place().to_owned();
        match part {
            Part::Frame => {
                if let Err((message, advice)) = bytes.and_then(|bytes| self.frame(&bytes, file.as_str())) {
                    self.bad_frames += 1;
                    if self.bad_frames <= MOST_TOLD {
                        self.problems.push(problem(&place, &file, message, advice));
                    }
                }
            }
            Part::Poses { motion, .. } => {
                let poses = bytes.and_then(|bytes| {
                    let text = String::from_utf8(bytes).map_err(|_| {
                        ("the poses are not text".to_owned(), "write a JSON list of them".to_owned())
                    })?;
                    RecordedPoses::from_json(&text, motion.looped)
                        .map_err(|error| message_and_advice(&error.to_string()))
                });
                match poses {
                    Ok(poses) => self.read.poses.push((motion, poses)),
                    Err((message, advice)) => {
                        self.problems.push(problem(&place, &file, message, advice));
                    }
                }
            }
        }
    }

    /// What was read.
    ///
    /// # Errors
    ///
    /// All problems.
    pub fn finish(mut self) -> Result<Recordings, Problems> {
        let untold = self.bad_frames.saturating_sub(MOST_TOLD);
        if untold > 0 {
            let message = format!("{untold} more frames cannot be used either");
            let advice = "see to the first ones; `count` says how many frames are read";
            self.problems.push(Problem::new("waves.sea.first", "", message, advice));
        }
        if !self.problems.is_empty() {
            return Err(Problems(self.problems));
        }
        if self.coarse_frames > 0 {
            self.read.notes.push(format!(
                "{} frames of the recorded sea have 8 bits: the water will show 256 steps of height; record 16 bits or OpenEXR",
                self.coarse_frames
            ));
        }
        self.read.sea = self.frames;
        Ok(self.read)
    }

    fn frame(&mut self, bytes: &[u8], name: &str) -> Result<(), (String, String)> {
        let field = decode_heights(bytes, name, FRAME_SIDES);
        let field = field.map_err(|error| message_and_advice(&error.to_string()))?;
        self.coarse_frames += usize::from(field.samples == HeightSamples::Eight);
        let heights = field.values.iter().map(|value| self.scale * value).collect();
        let Some(frames) = &mut self.frames else { return Ok(()) };
        frames.push(field.size, heights).map_err(|error| message_and_advice(&error.to_string()))
    }
}

fn problem(place: &str, file: &RelativePath, message: String, advice: String) -> Problem {
    Problem::new(place, format!("\"{file}\""), message, advice)
}

/// An error's sentence, which ends with what to do.
fn message_and_advice(said: &str) -> (String, String) {
    let (message, advice) = said.rsplit_once("; ").unwrap_or((said, ""));
    (message.to_owned(), advice.to_owned())
}
