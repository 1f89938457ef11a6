//! The studio at work in a Bevy app: it carries out what [`studio_ui`] asks for.
//!
//! One [`Session`] holds the desk and what is known of it; a frame checks it, shows it, and does what was asked, in order.
//! Long work goes on in the background and may be stopped; what it finds becomes edits like any other.

mod check;
mod files;
mod flight;
mod job;
mod marks;
mod outlines;
mod propose;
mod textures;

use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiInput, EguiPreUpdateSet, EguiPrimaryContextPass};
use egui_file_dialog::FileDialog;

use self::check::{Checked, Checking, News};
use self::files::Asked;
use self::flight::Flight;
use self::job::Job;
use self::marks::Tracing;
use self::outlines::{Outlining, Refinement};
use self::textures::Textures;
use super::{
    DeskView, Message, Question, Request, Studio, Suggestion, Task, TourView, View, egui, studio_ui,
};
use crate::plugin::PictureTourSystems;
use crate::tour::Tour;
use crate::tour::edit::desk::{Desk, Recent, Recovered, Replace, Version};
use crate::tour::edit::{Edit, RegionAt};

/// Adds the studio to an app that has Bevy's default plugins, [`PictureTourPlugin`](crate::plugin::PictureTourPlugin) and
/// `EguiPlugin`. It fills the window of the primary egui context while a [`Session`] is there.
#[derive(Clone, Copy, Debug, Default)]
pub struct EditorPlugin;

impl Plugin for EditorPlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<Textures>().add_observer(flight::take_built);
        app.add_systems(
            Update,
            (take_dropped, work).chain().before(PictureTourSystems::Input).run_if(resource_exists::<Session>),
        );
        app.add_systems(
            PreUpdate,
            rest.after(EguiPreUpdateSet::ProcessInput).before(EguiPreUpdateSet::BeginPass),
        );
        app.add_systems(EguiPrimaryContextPass, show_studio.run_if(resource_exists::<Session>));
    }
}

/// How often the studio must be drawn when nobody touches it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pace {
    /// As often as the screen shows: the tour moves.
    #[default]
    Smooth,
    /// Some times a second: work goes on whose progress is shown, or marks wait for the recovery file.
    Watching,
    /// Now and then: nothing changes but the age of what is saved.
    Resting,
}

/// What is on the desk, and what is known of it.
#[derive(Resource)]
pub struct Session {
    studio: Studio,
    desk: Option<Desk>,
    recovered: Vec<Recovered>,
    /// A tour of the picture that was just opened, until the user was asked about it.
    existing: Option<PathBuf>,
    recent: Recent,
    recent_files: Vec<PathBuf>,
    versions: Vec<Version>,
    message: Option<Message>,
    question: Option<Question>,
    dialog: Option<(Asked, FileDialog)>,
    suggestions: Vec<Suggestion>,
    jobs: Vec<Job>,
    /// Strokes on outlines that wait for the one before.
    later: VecDeque<Refinement>,
    last_id: u64,
    checked: Checked,
    checking: Checking,
    tracing: Tracing,
    outlinings: VecDeque<Outlining>,
    /// To be opened once the app runs.
    first: Option<PathBuf>,
    /// Whether another document was opened, and the tour of the one before is still shown.
    another: bool,
    /// Whether to leave as soon as it is saved.
    leaves: bool,
    pace: Pace,
    exit: bool,
}

impl Session {
    /// An empty desk. The list of recent files is kept in `folder`.
    #[must_use]
    pub fn new(folder: &Path) -> Self {
        let recent = Recent::in_folder(folder);
        Self {
            studio: Studio::default(),
            desk: None,
            recovered: Vec::new(),
            existing: None,
            recent_files: recent.files(),
            recent,
            versions: Vec::new(),
            message: None,
            question: None,
            dialog: None,
            suggestions: Vec::new(),
            jobs: Vec::new(),
            later: VecDeque::new(),
            last_id: 0,
            checked: Checked::default(),
            checking: Checking::default(),
            tracing: Tracing::default(),
            outlinings: VecDeque::new(),
            first: None,
            another: false,
            leaves: false,
            pace: Pace::default(),
            exit: false,
        }
    }

    /// Opens a picture or tour as soon as the app runs.
    pub fn open_when_ready(&mut self, path: PathBuf) {
        self.first = Some(path);
    }

    /// Whether the user has left, and nothing is unsaved that was to be saved.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.exit
    }

    /// How often the studio must be drawn from now on, while nobody touches it.
    #[must_use]
    pub fn pace(&self) -> Pace {
        self.pace
    }

    fn new_id(&mut self) -> u64 {
        self.last_id += 1;
        self.last_id
    }

    /// Does an edit.
    fn edit(&mut self, edit: &Edit) {
        if let Some(desk) = &mut self.desk
            && let Err(error) = desk.apply(edit)
        {
            self.fail(&error);
        }
    }

    fn fail(&mut self, error: &dyn std::error::Error) {
        let what = error.to_string();
        match &mut self.message {
            // One error is not worth losing another, which may be its cause.
            Some(before) if before.is_error && !before.what.contains(&what) => {
                before.what = format!("{}\n{what}", before.what);
            }
            message => *message = Some(Message { what, advice: String::new(), is_error: true }),
        }
    }

    fn tell(&mut self, what: &str, advice: &str) {
        self.message = Some(Message { what: what.to_owned(), advice: advice.to_owned(), is_error: false });
    }

    /// Does what the studio asks for, but for what flies.
    fn carry_out(&mut self, request: Request) {
        let Some(desk) = &mut self.desk else {
            return self.carry_out_without_desk(request);
        };
        match request {
            Request::Edit(edit) => self.edit(&edit),
            Request::BeginGesture => desk.begin_gesture(),
            Request::EndGesture => desk.end_gesture(),
            Request::CancelGesture => {
                if let Err(error) = desk.cancel_gesture() {
                    self.fail(&error);
                }
            }
            Request::Undo => {
                if let Err(error) = desk.undo() {
                    self.fail(&error);
                }
            }
            Request::Redo => {
                if let Err(error) = desk.redo() {
                    self.fail(&error);
                }
            }
            Request::Save => {
                self.save(Replace::Never);
            }
            Request::SaveOver => {
                self.question = None;
                self.save(Replace::Always);
            }
            Request::SaveAs => {
                self.question = None;
                self.ask(Asked::SaveAs);
            }
            Request::FindPicture => self.ask(Asked::FindPicture),
            Request::TakeVersion(index) => self.take_version(index),
            Request::Suggest(what) => self.suggest(what),
            Request::DropSuggestion(id) => self.suggestions.retain(|suggestion| suggestion.id != id),
            Request::Trace { from, to } => self.trace(from, to),
            Request::RefineBox { object, corners } => {
                self.refine(RegionAt::Object(object), Some(corners), None);
            }
            Request::TakeGuess(at) => self.take_guess(at),
            Request::RefineStroke { at, stroke } => self.refine(at, None, Some(stroke)),
            Request::Paint { at, stroke, hardness } => self.paint(at, &stroke, hardness),
            other => self.carry_out_without_desk(other),
        }
    }

    fn carry_out_without_desk(&mut self, request: Request) {
        match request {
            Request::OpenDialog => self.ask(Asked::Open),
            Request::Open(path) => self.open(&path),
            Request::Close => self.close(),
            Request::SaveAndClose => self.save_and_leave(),
            Request::CloseUnsaved => self.leave(true),
            Request::Stay => self.stay(),
            Request::Recover => self.recover(true),
            Request::DiscardRecovery => self.recover(false),
            Request::DismissMessage => self.message = None,
            Request::CancelTask(id) => self.cancel(id),
            // What flies is done elsewhere; the rest needs a desk.
            _ => {}
        }
    }
}

/// Lets egui rest: `bevy_egui` tells it in every frame which modifier keys are held, and egui takes whatever it is told for a
/// reason to draw again.
fn rest(mut inputs: Query<&mut EguiInput>, mut held: Local<egui::Modifiers>) {
    for mut input in &mut inputs {
        input.events.retain(|event| match event {
            egui::Event::ModifiersChanged(now) => std::mem::replace(&mut *held, *now) != *now,
            _ => true,
        });
    }
}

/// Opens what is dropped on the window.
fn take_dropped(mut session: ResMut<Session>, mut drops: MessageReader<FileDragAndDrop>) {
    for drop in drops.read() {
        if let FileDragAndDrop::DroppedFile { path_buf, .. } = drop {
            session.open(path_buf);
        }
    }
}

/// Takes what is done, keeps the check and the recovery file up to date, and the tour in step with the draft.
fn work(mut session: ResMut<Session>, mut flight: Flight, time: Res<Time<Real>>) {
    let now = time.elapsed_secs_f64();
    if let Some(path) = session.first.take() {
        session.open(&path);
    }
    session.take_finished();
    session.autosave(now);
    if std::mem::take(&mut session.another) {
        flight.hide();
    }
    match session.check(now) {
        Some(News::Placed(placed)) => flight.rearrange(&placed),
        Some(News::Moving(source)) => flight.set_motion(source),
        Some(News::Whole(source)) => flight.show_tour(source),
        None => {}
    }
    if session.desk.is_none() {
        flight.hide();
    }
}

/// Shows the studio and does what it asks for.
fn show_studio(
    mut contexts: EguiContexts,
    mut session: ResMut<Session>,
    mut textures: ResMut<Textures>,
    mut images: ResMut<Assets<Image>>,
    mut flight: Flight,
) -> Result {
    textures.follow(&session, &mut images, &mut contexts);
    let context = contexts.ctx_mut()?.clone();
    let mut root = egui::Ui::new(
        context.clone(),
        "studio".into(),
        egui::UiBuilder::new().layer_id(egui::LayerId::background()).max_rect(context.viewport_rect()),
    );
    let mut studio = std::mem::take(&mut session.studio);
    let tasks: Vec<Task> = flight.tasks(studio.language.text()).into_iter().chain(session.tasks()).collect();
    let masks = textures.masks();
    let versions = session.versions_in_words();
    let mut view = View {
        desk: session.desk.as_ref().map(|desk| DeskView {
            draft: desk.draft(),
            history: desk.history(),
            file: (!desk.is_new()).then(|| desk.path()),
            picture_lost: desk.picture().is_none(),
        }),
        picture: textures.picture(&session),
        masks: &masks,
        scene: flight.scene(),
        tour: TourView { image: textures.tour(), flown: flight.flown(), playing: flight.playing() },
        solved: session.checked.solved.as_ref().map(|solved| solved.as_ref()),
        problems: &session.checked.problems,
        suggestions: &session.suggestions,
        tasks: &tasks,
        traced: &session.tracing.way,
        recent: &session.recent_files,
        message: session.message.as_ref(),
        question: session.question.as_ref(),
        versions: &versions,
        ..View::default()
    };
    studio_ui(&mut root, &mut studio, &mut view);
    let out = std::mem::take(&mut view.out);
    session.studio = studio;
    let target = textures.tour_of(out.wanted_tour_size, &mut images, &mut contexts);
    flight.draw_while(target.is_some() || !out.requests.is_empty());
    let is_kept = session.desk.as_ref().is_none_or(Desk::is_kept);
    session.pace = if flight.is_drawn() {
        Pace::Smooth
    } else if tasks.is_empty() && !session.is_checking() && is_kept {
        Pace::Resting
    } else {
        Pace::Watching
    };
    if let Some(image) = target {
        flight.draw_into(image);
    }
    let is_busy = session.question.is_some() || session.dialog.is_some();
    flight.end_path(session.path().as_ref());
    flight.hold_still(!session.studio.motion_preview);
    flight.point_at(out.tour_pointer);
    flight.listen(out.pointer_over_tour && !out.text_has_focus && !is_busy);
    let changes = out.edits().next().is_some();
    for request in out.requests {
        flight.carry_out(&request, session.path().as_ref());
        session.carry_out(request);
    }
    if changes
        && let Some(tour) = session.desk.as_ref().and_then(|desk| Tour::check(desk.tour().clone()).ok())
    {
        flight.move_objects(&tour);
    }
    session.show_dialog(&context);
    Ok(())
}
