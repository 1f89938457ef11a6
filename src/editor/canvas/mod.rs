//! The picture with its marks: what is drawn, and what pointer and keys do to it.
//!
//! Marks may lie outside the picture. Drawing is pure; all that is remembered is in [`Canvas`].

mod edge;
mod expected;
mod frame;
mod handle;
mod layers;
mod magnifier;
mod make;
mod paint;
mod pointer;
mod tool;

pub use handle::Handle;
pub use tool::Tool;

pub(super) use handle::{is_drawn, region_name};

use glam::DVec2;

use crate::picture::PicturePoint;

use super::egui::{EventFilter, Key, PointerButton, Pos2, Rect, Response, Sense, Ui, WidgetInfo, WidgetType};
use super::work::Work;
use super::{Out, Request, Studio};
use frame::{Eye, Frame};
use pointer::Drag;
use tool::Takes;

/// What the canvas remembers.
#[derive(Debug, Default)]
pub struct Canvas {
    /// What the pointer does.
    pub tool: Tool,
    /// The handle that arrow keys move.
    pub selected: Option<Handle>,
    /// What is looked at; all of the picture when absent.
    eye: Option<Eye>,
    drag: Option<Drag>,
    /// Points drawn so far with the tool.
    sketch: Vec<PicturePoint>,
    /// What a path along edges was asked for last.
    asked: Option<[PicturePoint; 2]>,
    /// Where the canvas was in the last frame.
    screen: Option<Rect>,
}

impl Canvas {
    /// Lets go of tool, selection and what is half drawn.
    pub fn let_go(&mut self) {
        let Self { eye, screen, .. } = *self;
        *self = Self { eye, screen, ..Self::default() };
    }

    /// Whether something is being drawn or held, or a tool is in the hand.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        self.tool != Tool::Select || !self.sketch.is_empty() || self.drag.is_some()
    }

    /// Shows all of the picture.
    pub fn fit(&mut self) {
        self.eye = None;
    }

    /// How many points are drawn with the tool.
    #[must_use]
    pub fn drawn(&self) -> usize {
        self.sketch.len()
    }

    /// Where a picture point was shown in the last frame, in egui points.
    #[must_use]
    pub fn on_screen(&self, point: PicturePoint, size: glam::UVec2) -> Option<Pos2> {
        let screen = self.screen?;
        let eye = self.eye.unwrap_or_else(|| Eye::fit(screen, DVec2::ZERO, size.as_dvec2()));
        Some(Frame { screen, eye }.to_screen(point))
    }
}

/// Shows the picture and its marks in all of the room there is.
pub(super) fn canvas_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let rect = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, work.text.mark.canvas));
    let size = work.size.as_dvec2();
    let eye = studio.canvas.eye.unwrap_or_else(|| Eye::fit(rect, DVec2::ZERO, size));
    let mut frame = Frame { screen: rect, eye };
    studio.canvas.screen = Some(rect);

    let space = ui.input(|i| i.key_down(Key::Space)) && !ui.ctx().text_edit_focused();
    let is_panning = space || studio.canvas.drag == Some(Drag::Pan);
    if let Some(eye) = pointer::look(ui, &response, frame, size, is_panning) {
        frame.eye = eye;
        studio.canvas.eye = Some(eye);
    }
    let handles = handle::handles(studio, work);
    press(ui, &response, space, frame, studio, work, out, &handles);
    if has_keys(ui, &response) && !studio.pointer_was_over_tour && work.view.question.is_none() {
        pointer::keys(ui, studio, work, out);
    }
    ask_for_edges(&response, frame, studio, out);
    paint::draw(ui, &response, frame, studio, work, &handles);
    paint::name_handles(ui, frame, work, &handles);
}

/// What the primary button or a finger does.
fn press(
    ui: &Ui,
    response: &Response,
    space: bool,
    frame: Frame,
    studio: &mut Studio,
    work: &Work<'_>,
    out: &mut Out,
    handles: &[(Handle, PicturePoint)],
) {
    let size = work.size.as_dvec2();
    let (origin, modifiers) = ui.input(|i| (i.pointer.press_origin(), i.modifiers));
    let fingers = ui.input(|i| i.multi_touch().is_some());
    if response.drag_started() || response.clicked() {
        response.request_focus();
    }
    if response.drag_started_by(PointerButton::Primary)
        && let Some(at) = origin
    {
        let drag = if space { Drag::Pan } else { pointer::begin(at, frame, studio, work, out, handles) };
        studio.canvas.drag = Some(drag);
        // A corner that was put in just now is there from the next frame on.
        return;
    }
    if fingers && studio.canvas.drag.take().is_some() {
        // The first of two fingers did not mean what it touched.
        out.cancel();
        if !matches!(studio.canvas.tool.takes(), Some(Takes::Many { .. })) {
            studio.canvas.sketch.clear();
        }
    }
    let here = response.interact_pointer_pos();
    match (studio.canvas.drag, here) {
        (Some(Drag::Handle { handle, off, from }), Some(at)) => {
            let held = (handle, off, from);
            let to = pointer::target(at, held, frame, modifiers, studio.snapping, handles, size);
            let was = handle.at(work);
            if was.is_some_and(|was| was != to)
                && let Some(edit) = handle.moved(to, work)
            {
                out.edit(edit);
            }
        }
        (Some(Drag::Draw), Some(at)) => {
            let point = frame.to_picture(at);
            let sketch = &mut studio.canvas.sketch;
            match studio.canvas.tool.takes() {
                Some(Takes::Two) => sketch.truncate(1),
                Some(Takes::Many { .. } | Takes::One) | None => {}
                Some(Takes::Stroke | Takes::Pieces) => {
                    if sketch.last().is_none_or(|last| frame.to_screen(*last).distance(at) > 2.0) {
                        sketch.push(point);
                    }
                }
            }
            if studio.canvas.tool.takes() == Some(Takes::Pieces) && sketch.len() >= 2 {
                pointer::finish(studio, work, out);
                studio.canvas.sketch = vec![point];
            }
        }
        _ => {}
    }
    if response.drag_stopped() {
        let was = studio.canvas.drag.take();
        if let (Some(Drag::Draw), Some(at)) = (was, here) {
            match studio.canvas.tool.takes() {
                Some(Takes::Stroke) => pointer::finish(studio, work, out),
                Some(Takes::Pieces) => studio.canvas.sketch.clear(),
                Some(_) => pointer::draw_click(at, false, frame, studio, work, out, handles),
                None => {}
            }
        }
    }
    if response.clicked()
        && let Some(at) = here
    {
        if studio.canvas.tool == Tool::Select {
            pointer::select(at, frame, studio, work, handles);
            if response.double_clicked()
                && studio.canvas.selected.is_none()
                && let Some(edge) = pointer::edge_near(at, frame, studio, work)
            {
                studio.canvas.selected = Some(edge.handle());
                edge.insert(work).into_iter().for_each(|edit| out.edit(edit));
            }
        } else {
            pointer::draw_click(at, response.double_clicked(), frame, studio, work, out, handles);
        }
    }
}

/// Whether keys are the canvas's: it has the focus, or nothing has.
fn has_keys(ui: &Ui, response: &Response) -> bool {
    if response.has_focus() {
        let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, escape: true, tab: false };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        return true;
    }
    ui.memory(|memory| memory.focused().is_none())
}

/// Asks for the way along edges from the last drawn corner to the pointer, whenever that moved.
fn ask_for_edges(response: &Response, frame: Frame, studio: &mut Studio, out: &mut Out) {
    let canvas = &mut studio.canvas;
    let wanted = studio.live_wire && canvas.tool.draws_outline();
    let ends = canvas.sketch.last().copied().zip(response.hover_pos().map(|at| frame.to_picture(at)));
    let Some((from, to)) = ends.filter(|_| wanted) else {
        canvas.asked = None;
        return;
    };
    if canvas.asked != Some([from, to]) {
        canvas.asked = Some([from, to]);
        out.request(Request::Trace { from, to });
    }
}
