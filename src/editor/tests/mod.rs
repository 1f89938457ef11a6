//! A bench for the studio: a draft that really changes, and a log of what was asked for.

mod canvas;
mod frame;
mod layout;
mod look;
mod panels;

use std::path::PathBuf;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::{DVec3, UVec2};

use crate::camera::CameraPose;
use crate::picture::PicturePoint;
use crate::solve::{Label, Method, PairReport, ParameterReport, SceneParameters, Solution, SolveReport};
use crate::tour::edit::{Draft, Edit, History};
use crate::tour::{Motion, Object, ReflectionPair, Region, Support, Tour, TourFile, WaterArea};

use super::egui::accesskit::Role;
use super::egui::{Pos2, TextureId, Ui, Vec2};
use super::work::Work;
use super::*;

pub(super) const SIZE: UVec2 = UVec2::new(1000, 600);

/// What most laptops show.
const SMALL: Vec2 = Vec2::new(1280.0, 720.0);

/// A camera 1.7 m above a pond, its horizon at y = 250.
pub(super) fn solved_pond() -> Solution {
    let parameters = SceneParameters {
        focal_px: 900.0,
        principal: PicturePoint(SIZE.as_dvec2() / 2.0),
        pitch: -(50.0_f64 / 900.0).atan(),
        roll: 0.0,
        height: 1.7,
        ground_height: 0.0,
        background_distance: 40.0,
    };
    let report = |name, value, deviation, label| ParameterReport {
        name,
        value,
        deviation,
        label,
        from: vec!["horizon", "reflection pairs"],
    };
    let parameter_reports = vec![
        report("focal_px", 900.0, Some(60.0), Label::Measured),
        report("pitch", parameters.pitch, Some(0.002), Label::Measured),
        report("roll", 0.0, Some(0.002), Label::Measured),
        report("height", 1.7, None, Label::Assumed),
        report("ground_height", 0.0, None, Label::Assumed),
        report("background_distance", 40.0, Some(9.0), Label::Weak),
    ];
    let pair = |name: &str, kept: bool| PairReport {
        name: name.into(),
        residual_px: if kept { 0.4 } else { 31.0 },
        sideways_px: 0.1,
        depth: Some(40.0),
        kept,
        remark: (!kept).then(|| "this reflection does not agree with the others by 31 px".into()),
    };
    let report = SolveReport {
        method: Method::Full,
        parameters: parameter_reports,
        pairs: vec![pair("1", true), pair("2", true)],
        remarks: vec!["the picture looks level: its focal length cannot be seen in it".into()],
    };
    Solution { parameters, report }
}

/// A pond with a boat and two pairs on the far shore.
pub(super) fn pond() -> TourFile {
    let mut tour = TourFile::new("pond.png".into());
    tour.picture.size = Some(SIZE);
    tour.camera.horizon = Some([PicturePoint::new(0.0, 250.0), PicturePoint::new(1000.0, 250.0)]);
    let polygon = |corners: &[(f64, f64)]| {
        Region::Polygon(corners.iter().map(|(x, y)| PicturePoint::new(*x, *y)).collect())
    };
    let camera = solved_pond().parameters.camera(SIZE);
    let pair = |x: f64| {
        let seen = |y: f64| camera.project(DVec3::new(x, y, -40.0)).unwrap();
        ReflectionPair { point: seen(4.0), reflection: seen(-4.0), on: Some("background".into()), name: None }
    };
    tour.water = Some(WaterArea {
        region: polygon(&[(0.0, 290.0), (1000.0, 290.0), (1000.0, 600.0), (0.0, 600.0)]),
        pairs: vec![pair(-12.0), pair(15.0)],
    });
    tour.objects = vec![Object {
        name: "boat".into(),
        support: Support::Water,
        outline: polygon(&[(600.0, 360.0), (700.0, 360.0), (700.0, 420.0), (600.0, 420.0)]),
        contact: [PicturePoint::new(600.0, 420.0), PicturePoint::new(700.0, 420.0)],
        turns_to_camera: false,
        motion: Motion::Static,
    }];
    tour
}

/// The studio with a draft under it.
#[derive(Debug)]
pub(super) struct Bench {
    pub(super) studio: Studio,
    pub(super) draft: Option<Draft>,
    pub(super) history: History,
    pub(super) solution: Option<Solution>,
    pub(super) suggestions: Vec<Suggestion>,
    pub(super) tasks: Vec<Task>,
    pub(super) recent: Vec<PathBuf>,
    pub(super) versions: Vec<String>,
    pub(super) message: Option<Message>,
    pub(super) question: Option<Question>,
    pub(super) traced: Vec<PicturePoint>,
    pub(super) flown: Option<CameraPose>,
    /// Everything asked for so far, but [`Request::Trace`].
    pub(super) log: Vec<Request>,
    pub(super) out: Out,
    pub(super) size: UVec2,
    pub(super) texture: TextureId,
}

impl Bench {
    pub(super) fn pond() -> Self {
        Self {
            studio: Studio::default(),
            draft: Some(Draft::new(pond())),
            history: History::new(true),
            solution: Some(solved_pond()),
            suggestions: Vec::new(),
            tasks: Vec::new(),
            recent: vec![PathBuf::from("/pictures/lake.tour.ron")],
            versions: vec!["ten minutes ago".into()],
            message: None,
            question: None,
            traced: Vec::new(),
            flown: Some(CameraPose::from_angles(DVec3::new(1.0, 2.0, -3.0), 0.5, 0.0, 0.0)),
            log: Vec::new(),
            out: Out::default(),
            size: SIZE,
            texture: TextureId::Managed(0),
        }
    }

    pub(super) fn at(step: Step) -> Self {
        let mut bench = Self::pond();
        bench.studio.step = step;
        bench
    }

    pub(super) fn tour(&self) -> &TourFile {
        &self.draft.as_ref().unwrap().tour
    }

    /// What panels see of the draft.
    pub(super) fn with_work<R>(&self, f: impl FnOnce(&Work<'_>) -> R) -> R {
        let view = self.view(&[]);
        f(&Work::new(&view, view.desk.unwrap(), Language::English.text()))
    }

    fn view<'a>(&'a self, problems: &'a [crate::tour::Problem]) -> View<'a> {
        let Self { texture, size, .. } = *self;
        View {
            desk: self.draft.as_ref().map(|draft| DeskView {
                draft,
                history: &self.history,
                file: None,
                picture_lost: false,
            }),
            picture: Some(PictureView { texture, size }),
            masks: &[],
            tour: TourView { image: Some(texture), flown: self.flown, playing: None },
            scene: None,
            solved: self.solution.as_ref().map(Ok),
            problems,
            suggestions: &self.suggestions,
            tasks: &self.tasks,
            traced: &self.traced,
            recent: &self.recent,
            message: self.message.as_ref(),
            question: self.question.as_ref(),
            versions: &self.versions,
            out: Out::default(),
        }
    }

    /// One frame, and what it asked for.
    pub(super) fn frame(&mut self, ui: &mut Ui) {
        let checked = self.draft.as_ref().map(|draft| Tour::check(draft.tour.clone()));
        let problems = checked.and_then(Result::err).unwrap_or_default().0;
        let mut studio = std::mem::take(&mut self.studio);
        let out = {
            let mut view = self.view(&problems);
            studio_ui(ui, &mut studio, &mut view);
            view.out
        };
        self.studio = studio;
        for request in &out.requests {
            let Some(draft) = &mut self.draft else { break };
            match request {
                Request::Edit(edit) => {
                    self.history.apply(edit, draft).unwrap();
                }
                Request::BeginGesture => self.history.begin_gesture(),
                // To save ends a gesture, as on a desk.
                Request::EndGesture | Request::Save => self.history.end_gesture(),
                Request::CancelGesture => self.history.cancel_gesture(draft).unwrap(),
                Request::Undo => drop(self.history.undo(draft).unwrap()),
                Request::Redo => drop(self.history.redo(draft).unwrap()),
                Request::DropSuggestion(id) => self.suggestions.retain(|suggestion| suggestion.id != *id),
                _ => {}
            }
        }
        self.log
            .extend(out.requests.iter().filter(|request| !matches!(request, Request::Trace { .. })).cloned());
        self.out = out;
    }

    pub(super) fn edits<'a>(&'a self) -> Vec<&'a Edit> {
        let edit = |request: &'a Request| match request {
            Request::Edit(edit) => Some(edit),
            _ => None,
        };
        self.log.iter().filter_map(edit).collect()
    }

    pub(super) fn steps(&self) -> usize {
        self.history.past().count()
    }
}

/// The studio in a window of 1280 × 720.
pub(super) fn small<'a>(bench: Bench) -> Harness<'a, Bench> {
    sized(bench, SMALL)
}

pub(super) fn sized<'a>(bench: Bench, size: Vec2) -> Harness<'a, Bench> {
    let mut harness =
        Harness::builder().with_size(size).build_ui_state(|ui, bench: &mut Bench| bench.frame(ui), bench);
    harness.run_steps(4);
    harness.state_mut().log.clear();
    harness
}

/// Where a picture point is on the screen.
pub(super) fn seen(harness: &Harness<'_, Bench>, x: f64, y: f64) -> Pos2 {
    harness.state().studio.canvas.on_screen(PicturePoint::new(x, y), SIZE).unwrap()
}

/// Drags from one picture point to another, in a few pieces.
pub(super) fn drag(harness: &mut Harness<'_, Bench>, from: (f64, f64), to: (f64, f64)) {
    let (from, to) = (seen(harness, from.0, from.1), seen(harness, to.0, to.1));
    harness.hover_at(from);
    harness.step();
    harness.drag_at(from);
    harness.step();
    for part in 1..=4 {
        harness.hover_at(from + (to - from) * (part as f32 / 4.0));
        harness.step();
    }
    harness.drop_at(to);
    harness.run_steps(2);
}

/// Clicks a picture point, long enough after the click before that the two are no double click.
pub(super) fn click(harness: &mut Harness<'_, Bench>, at: (f64, f64)) {
    let at = seen(harness, at.0, at.1);
    harness.hover_at(at);
    harness.step();
    harness.drag_at(at);
    harness.step();
    harness.drop_at(at);
    harness.run_steps(8);
}

/// Clicks what has this label.
pub(super) fn press(harness: &mut Harness<'_, Bench>, label: &str) {
    harness.get_by_label(label).click();
    harness.run_steps(3);
}

/// Opens the box of choices with this name, and picks one.
pub(super) fn choose(harness: &mut Harness<'_, Bench>, name: &str, value: &str) {
    harness.get_by_role_and_label(Role::ComboBox, name).scroll_to_me();
    harness.run_steps(30);
    harness.get_by_role_and_label(Role::ComboBox, name).click();
    harness.run_steps(4);
    press(harness, value);
}
