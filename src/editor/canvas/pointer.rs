//! What pointer and keys do to the canvas: zoom, pan, handles, drawing.

use glam::DVec2;

use crate::picture::PicturePoint;
use crate::tour::Motion;
use crate::tour::edit::{LineAt, snap};

use super::super::egui::{Key, Modifiers, PointerButton, Pos2, Response, Ui};
use super::super::work::Work;
use super::super::{Out, Request, Step, Studio};
use super::edge::{self, OnEdge, Owner};
use super::frame::{Eye, Frame};
use super::handle::{self, Handle};
use super::tool::{Takes, Tool};

/// Reach of a handle, points from its middle: targets are never smaller than 24 points.
pub(super) const REACH: f32 = 14.0;
/// Reach of an edge and of snapping, points.
const EDGE_REACH: f32 = 8.0;
/// Drawn points closer than this are one, points.
const SAME: f32 = 5.0;

/// What is being dragged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Drag {
    /// The picture itself.
    Pan,
    /// A handle, at its distance from the pointer; `from` is where it was.
    Handle { handle: Handle, off: DVec2, from: PicturePoint },
    /// Points are drawn with the tool.
    Draw,
}

/// Zooms and pans by wheel, pinch, middle or right button, space bar or two fingers.
pub(super) fn look(ui: &Ui, response: &Response, frame: Frame, size: DVec2, is_panning: bool) -> Option<Eye> {
    let mut eye = None;
    let mut frame = frame;
    let mut set = |frame: &mut Frame, new: Eye| {
        frame.eye = new;
        eye = Some(new);
    };
    if let Some(at) = response.hover_pos() {
        let (touch, pinch, wheel) =
            ui.input(|i| (i.multi_touch(), f64::from(i.zoom_delta()), f64::from(i.smooth_scroll_delta().y)));
        if let Some(touch) = touch {
            let zoomed = frame.zoomed(touch.zoom_delta.into(), touch.center_pos, size);
            set(&mut frame, zoomed);
            let panned = frame.panned(touch.translation_delta, size);
            set(&mut frame, panned);
        } else if pinch != 1.0 || wheel != 0.0 {
            // One notch of a wheel is about 50 points: a quarter nearer.
            let zoomed = frame.zoomed(pinch * (wheel * 0.0045).exp(), at, size);
            set(&mut frame, zoomed);
        }
    }
    if ui.input(|i| i.multi_touch().is_some()) {
        return eye;
    }
    let other = [PointerButton::Middle, PointerButton::Secondary].iter().any(|b| response.dragged_by(*b));
    if other || is_panning && response.dragged() {
        let panned = frame.panned(response.drag_delta(), size);
        set(&mut frame, panned);
    }
    eye
}

/// The handle nearest to a place on the screen, within reach.
pub(super) fn handle_near(at: Pos2, frame: Frame, handles: &[(Handle, PicturePoint)]) -> Option<Handle> {
    handles
        .iter()
        .map(|(handle, point)| (frame.to_screen(*point).distance(at), *handle))
        .filter(|(distance, _)| *distance <= REACH)
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, handle)| handle)
}

/// The edge of this step's lines nearest to a place on the screen, within reach.
pub(super) fn edge_near(at: Pos2, frame: Frame, studio: &Studio, work: &Work<'_>) -> Option<OnEdge> {
    let (point, reach) = (frame.to_picture(at), frame.pixels(EDGE_REACH));
    let lines = handle::lines(studio.step, studio.object, work).into_iter().filter_map(|line| {
        let is_closed = matches!(line, LineAt::Region(_));
        edge::nearest(Owner::Line(line), line.get(work.tour)?, is_closed, point, reach)
    });
    let course = studio.object.filter(|_| studio.step == Step::Motion).and_then(|object| {
        let Motion::Course(course) = &work.tour.objects.get(object)?.motion else { return None };
        let way: Option<Vec<_>> = course.waypoints.iter().map(|point| work.seen_at(*point)).collect();
        edge::nearest(Owner::Course(object), &way?, course.closed, point, reach)
    });
    lines.chain(course).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, edge)| edge)
}

/// A place where a point may go: snapped to other handles and to the picture's corners and borders.
pub(super) fn snapped(
    to: PicturePoint,
    but: Option<Handle>,
    frame: Frame,
    handles: &[(Handle, PicturePoint)],
    size: DVec2,
) -> PicturePoint {
    let reach = frame.pixels(EDGE_REACH);
    let others = handles.iter().filter(|(handle, _)| Some(*handle) != but).map(|(_, point)| *point);
    let corners = [DVec2::ZERO, DVec2::new(size.x, 0.0), DVec2::new(0.0, size.y), size].map(PicturePoint);
    if let Some(point) = snap(to, others.chain(corners), reach) {
        return point;
    }
    let (x, y) = (to.x(), to.y());
    let borders = [(0.0, y), (size.x, y), (x, 0.0), (x, size.y)].map(|(x, y)| PicturePoint::new(x, y));
    snap(to, borders, reach).unwrap_or(to)
}

/// Begins a drag of the primary button (or a finger) where it was pressed.
pub(super) fn begin(
    at: Pos2,
    frame: Frame,
    studio: &mut Studio,
    work: &Work<'_>,
    out: &mut Out,
    handles: &[(Handle, PicturePoint)],
) -> Drag {
    if studio.canvas.tool != Tool::Select {
        let sketch = &mut studio.canvas.sketch;
        // A click with a trembling hand, or a long one, comes as a drag: it adds to what is drawn.
        let goes_on = match studio.canvas.tool.takes() {
            Some(Takes::Many { .. }) => true,
            Some(Takes::Two) => sketch.len() == 1,
            Some(Takes::One | Takes::Stroke | Takes::Pieces) | None => false,
        };
        if !goes_on {
            *sketch = vec![frame.to_picture(at)];
        }
        return Drag::Draw;
    }
    if let Some(handle) = handle_near(at, frame, handles)
        && let Some(from) = handle.at(work)
    {
        studio.canvas.selected = Some(handle);
        return Drag::Handle { handle, off: from.0 - frame.to_picture(at).0, from };
    }
    if let Some(edge) = edge_near(at, frame, studio, work)
        && let Some(edit) = edge.insert(work)
    {
        out.edit(edit);
        let handle = edge.handle();
        studio.canvas.selected = Some(handle);
        return Drag::Handle { handle, off: edge.at.0 - frame.to_picture(at).0, from: edge.at };
    }
    Drag::Pan
}

/// Where a dragged handle goes: with the pointer, level or plumb with Shift, snapped without Alt.
pub(super) fn target(
    pointer: Pos2,
    (handle, off, from): (Handle, DVec2, PicturePoint),
    frame: Frame,
    modifiers: Modifiers,
    snaps: bool,
    handles: &[(Handle, PicturePoint)],
    size: DVec2,
) -> PicturePoint {
    let mut to = PicturePoint(frame.to_picture(pointer).0 + off);
    if snaps && !modifiers.alt {
        to = snapped(to, Some(handle), frame, handles, size);
    }
    if modifiers.shift {
        let way = to.0 - from.0;
        let keep = if way.x.abs() >= way.y.abs() { DVec2::X } else { DVec2::Y };
        to = PicturePoint(from.0 + way * keep);
    }
    to
}

/// A click, or the end of a short drag, with a drawing tool.
pub(super) fn draw_click(
    at: Pos2,
    is_double: bool,
    frame: Frame,
    studio: &mut Studio,
    work: &Work<'_>,
    out: &mut Out,
    handles: &[(Handle, PicturePoint)],
) {
    let Some(takes) = studio.canvas.tool.takes() else { return };
    let size = work.size.as_dvec2();
    let mut point = frame.to_picture(at);
    if studio.snapping && !studio.canvas.tool.has_width() {
        point = snapped(point, None, frame, handles, size);
    }
    let near = |other: &PicturePoint| frame.to_screen(*other).distance(at) <= SAME;
    match takes {
        Takes::Many { least } => {
            let sketch = &mut studio.canvas.sketch;
            let closes = sketch.len() >= least && sketch.first().is_some_and(near);
            if is_double || closes {
                finish(studio, work, out);
                return;
            }
            // The way along edges, when it leads to where was clicked.
            let traced = work.view.traced;
            let leads_here = studio.live_wire
                && studio.canvas.tool.draws_outline()
                && sketch
                    .last()
                    .zip(traced.first())
                    .is_some_and(|(last, first)| last.0.distance(first.0) < 2.0)
                && traced.last().is_some_and(near);
            if leads_here {
                sketch.extend(&traced[1..]);
            } else if !sketch.last().is_some_and(near) {
                sketch.push(point);
            }
        }
        Takes::Two => {
            let sketch = &mut studio.canvas.sketch;
            // Where the first point is, it was only clicked once more, or long.
            if !sketch.last().is_some_and(near) {
                sketch.push(point);
            }
            if sketch.len() >= 2 {
                finish(studio, work, out);
            }
        }
        Takes::One | Takes::Stroke | Takes::Pieces => {
            studio.canvas.sketch = vec![point];
            finish(studio, work, out);
        }
    }
}

/// Makes what the drawn points ask for, and lays the tool down unless it stays.
pub(super) fn finish(studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let tool = studio.canvas.tool;
    let Some(request) = tool.finish(&studio.canvas.sketch, &studio.brush, work) else { return };
    studio.canvas.sketch.clear();
    if matches!(tool, Tool::NewObject) {
        studio.object = Some(work.tour.objects.len());
    }
    if !tool.stays() {
        studio.canvas.tool = Tool::Select;
    }
    match request {
        Request::Edit(edit) => out.edit(edit),
        Request::Paint { .. } => out.held_request(request),
        request => out.request(request),
    }
}

/// Arrow keys move the selected handle (1 px, with Shift 10, with Alt a tenth), Delete removes it, Enter ends an outline.
pub(super) fn keys(ui: &Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    if ui.input(|i| i.key_pressed(Key::Enter)) {
        finish(studio, work, out);
    }
    if ui.input(|i| i.key_pressed(Key::Backspace)) && studio.canvas.sketch.pop().is_some() {
        return;
    }
    let Some(handle) = studio.canvas.selected else { return };
    let Some(at) = handle.at(work) else { return };
    let presses = |key| ui.input(|i| i.num_presses(key)) as f64;
    let way = DVec2::new(
        presses(Key::ArrowRight) - presses(Key::ArrowLeft),
        presses(Key::ArrowDown) - presses(Key::ArrowUp),
    );
    if way != DVec2::ZERO {
        let modifiers = ui.input(|i| i.modifiers);
        let step = match (modifiers.shift, modifiers.alt) {
            (true, _) => 10.0,
            (_, true) => 0.1,
            _ => 1.0,
        };
        if let Some(edit) = handle.moved(PicturePoint(at.0 + way * step), work) {
            out.edit(edit);
        }
    }
    if ui.input(|i| i.key_pressed(Key::Delete) || i.key_pressed(Key::Backspace))
        && let Some(edit) = handle.removed(work)
    {
        out.edit(edit);
        studio.canvas.selected = None;
    }
}

/// A click without a tool: selects a handle, else the object under it.
pub(super) fn select(
    at: Pos2,
    frame: Frame,
    studio: &mut Studio,
    work: &Work<'_>,
    handles: &[(Handle, PicturePoint)],
) {
    studio.canvas.selected = handle_near(at, frame, handles);
    if studio.canvas.selected.is_none() && matches!(studio.step, Step::Objects | Step::Motion) {
        studio.object = handle::object_at(frame.to_picture(at), work).or(studio.object);
    }
}
