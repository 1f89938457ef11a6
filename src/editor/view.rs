//! The seam to the program around: what is known this frame, and what comes back.

use std::path::{Path, PathBuf};

use glam::UVec2;

use crate::camera::CameraPose;
use crate::picture::PicturePoint;
use crate::scene::TourScene;
use crate::solve::{Solution, SolveError};
use crate::tour::Problem;
use crate::tour::edit::{Draft, Edit, History};

use super::egui::TextureId;
use super::{Out, Step};

/// What the studio is shown each frame, and in `out` what it wants done.
///
/// All but `out` is read. The caller fills it anew for every frame from what it has at that moment: a report that is one
/// revision behind is fine. Requests are to be carried out before the next frame, in their order.
#[derive(Debug, Default)]
pub struct View<'a> {
    /// The draft at work; `None` shows the start page.
    pub desk: Option<DeskView<'a>>,
    /// The picture, once it is decoded.
    pub picture: Option<PictureView>,
    /// Textures of the masks that the draft names: white where coverage is, multiplied by it, alpha as coverage.
    pub masks: &'a [MaskView<'a>],
    /// The live tour.
    pub tour: TourView,
    /// The planes of the live tour, once it is built.
    pub scene: Option<&'a TourScene>,
    /// The latest solution or why there is none; `None` before the first one.
    ///
    /// In the document's pixels: where the picture is cropped, the crop's corner is to be added to the principal point.
    pub solved: Option<Result<&'a Solution, &'a SolveError>>,
    /// What `Tour::check` says of the document.
    pub problems: &'a [Problem],
    /// Proposals that are neither taken nor refused.
    pub suggestions: &'a [Suggestion],
    /// Work in the background.
    pub tasks: &'a [Task],
    /// The answer to [`Request::Trace`](super::Request::Trace): the way along edges, both ends included.
    pub traced: &'a [PicturePoint],
    /// Files that were open before, last one first.
    pub recent: &'a [PathBuf],
    /// A message that stays until it is dismissed.
    pub message: Option<&'a Message>,
    /// What must be answered before anything else.
    pub question: Option<&'a Question>,
    /// Earlier versions of the tour's file in words ("ten minutes ago"), newest first.
    pub versions: &'a [String],
    /// What this frame gives back.
    pub out: Out,
}

/// The draft at work.
#[derive(Clone, Copy, Debug)]
pub struct DeskView<'a> {
    /// The draft itself.
    pub draft: &'a Draft,
    /// Its steps.
    pub history: &'a History,
    /// Its file; `None` for a new tour until it is saved.
    pub file: Option<&'a Path>,
    /// Whether the tour's picture is not where the tour says.
    pub picture_lost: bool,
}

/// A picture that can be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureView {
    /// Its texture, perhaps smaller than the picture.
    pub texture: TextureId,
    /// The size to which the document's numbers refer, pixels.
    pub size: UVec2,
}

/// A mask that can be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MaskView<'a> {
    /// Its path, as in the document.
    pub name: &'a str,
    /// Its texture, of the picture's shape.
    pub texture: TextureId,
}

/// The live tour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TourView {
    /// What it shows, of the size that [`Out::wanted_tour_size`] asked for a frame or more ago.
    pub image: Option<TextureId>,
    /// Where the flying camera is.
    pub flown: Option<CameraPose>,
    /// Seconds from the path's start, while the path is played.
    pub playing: Option<f64>,
}

/// A proposal of the machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Suggestion {
    /// Tells it from all others, also earlier ones.
    pub id: u64,
    /// The step it belongs to.
    pub step: Step,
    /// What is proposed, in a few words.
    pub title: String,
    /// Why, in one sentence.
    pub reason: String,
    /// 0 (a guess) to 1 (certain).
    pub confidence: f64,
    /// What taking it does.
    pub edits: Vec<Edit>,
    /// What it looks like in the picture.
    pub ghosts: Vec<Ghost>,
}

/// A mark that is only proposed.
#[derive(Clone, Debug, PartialEq)]
pub enum Ghost {
    /// A line through points; closed ones are outlines.
    Line {
        /// Its points.
        points: Vec<PicturePoint>,
        /// Whether the last is joined to the first.
        closed: bool,
    },
    /// A point and its reflection.
    Pair(PicturePoint, PicturePoint),
    /// A place to look at, with a radius in picture pixels.
    Place(PicturePoint, f64),
}

/// Work in the background.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// For [`Request::CancelTask`](super::Request::CancelTask).
    pub id: u64,
    /// What is done, in a few words.
    pub title: String,
    /// 0 to 1; `None` while nobody can tell.
    pub done: Option<f32>,
    /// Whether it can be stopped.
    pub can_cancel: bool,
}

/// Something the user must know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// What happened.
    pub what: String,
    /// What can be done; may be empty.
    pub advice: String,
    /// Whether something failed.
    pub is_error: bool,
}

/// A question that the program has; each answer is a [`Request`](super::Request).
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Question {
    /// The window is to close although not all is saved: `SaveAndClose`, `CloseUnsaved` or `Stay`.
    Unsaved,
    /// A crash left marks behind: `Recover` or `DiscardRecovery`.
    Recovery {
        /// The tour's name.
        name: String,
        /// When they were made, in words.
        age: String,
    },
    /// Another window or program has written the file since: `SaveOver`, `SaveAs` or `Stay`.
    ChangedOnDisk {
        /// The file's name.
        name: String,
    },
    /// There is a tour of the picture already: `Open` it, or `Stay` with a new one.
    ExistingTour {
        /// Its file.
        file: PathBuf,
    },
}
