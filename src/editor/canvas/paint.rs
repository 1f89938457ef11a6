//! Everything that the canvas shows, from the picture up to the magnifier; and the handles' names.

use crate::picture::PicturePoint;
use crate::tour::edit::PointAt;

use super::super::egui::{
    Align2, Color32, CursorIcon, FontId, Painter, Pos2, Rect, Response, Sense, Stroke, Ui, Vec2, WidgetInfo,
    WidgetType,
};
use super::super::work::Work;
use super::super::{Studio, theme};
use super::frame::Frame;
use super::handle::Handle;
use super::layers::{self, Emphasis};
use super::magnifier;
use super::pointer::{self, Drag};
use super::tool::Tool;

/// Draws picture, marks, handles and what is being drawn.
pub(super) fn draw(
    ui: &Ui,
    response: &Response,
    frame: Frame,
    studio: &Studio,
    work: &Work<'_>,
    handles: &[(Handle, PicturePoint)],
) {
    let painter = ui.painter_at(frame.screen);
    let Studio { step, object, canvas, .. } = studio;
    painter.rect_filled(frame.screen, 0.0, theme::BACKDROP);
    let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
    let rect = frame.picture_rect(work.size.as_dvec2());
    if let Some(picture) = work.view.picture {
        painter.image(picture.texture, rect, whole, Color32::WHITE);
    } else {
        let font = FontId::proportional(14.0);
        painter.text(rect.center(), Align2::CENTER_CENTER, work.text.mark.no_picture, font, theme::DIM);
    }
    for (name, tint) in layers::masks(*step, *object, work) {
        if let Some(mask) = work.view.masks.iter().find(|mask| mask.name == name) {
            painter.image(mask.texture, rect, whole, tint);
        }
    }
    painter.extend(layers::outlines(frame, *step, *object, work));
    painter.extend(layers::objects(frame, *step, *object, work));
    let times = if studio.residuals_tenfold { 10.0 } else { 1.0 };
    painter.extend(layers::pairs(frame, *step, times, work));
    painter.extend(layers::horizon(frame, *step, work));
    painter.extend(layers::ghosts(frame, *step, work));

    let pointer = response.hover_pos();
    let free = canvas.tool == Tool::Select && canvas.drag.is_none();
    let hovered = pointer.filter(|_| free).and_then(|at| pointer::handle_near(at, frame, handles));
    for (handle, point) in handles {
        let emphasis = match canvas.drag {
            Some(Drag::Handle { handle: held, .. }) if held == *handle => Emphasis::Active,
            _ if canvas.selected == Some(*handle) => Emphasis::Selected,
            _ if hovered == Some(*handle) => Emphasis::Hovered,
            _ => Emphasis::Idle,
        };
        painter.extend(layers::handle(frame.to_screen(*point), color(*handle), emphasis));
    }
    let on_edge = pointer.filter(|_| free && hovered.is_none());
    if let Some(edge) = on_edge.and_then(|at| pointer::edge_near(at, frame, studio, work)) {
        let color = color(edge.handle());
        painter.extend(layers::handle(frame.to_screen(edge.at), color.gamma_multiply(0.6), Emphasis::Idle));
    }
    draw_tool(ui, &painter, frame, studio, work, pointer);
    let cursor = match (canvas.drag, hovered) {
        (Some(Drag::Pan), _) => CursorIcon::Grabbing,
        (Some(Drag::Handle { .. }), _) => CursorIcon::None,
        (_, Some(_)) => CursorIcon::Grab,
        _ if canvas.tool != Tool::Select => CursorIcon::Crosshair,
        _ => CursorIcon::Default,
    };
    response.clone().on_hover_and_drag_cursor(cursor);
}

/// What is being drawn, the brush, and the magnifier.
fn draw_tool(
    ui: &Ui,
    painter: &Painter,
    frame: Frame,
    studio: &Studio,
    work: &Work<'_>,
    pointer: Option<Pos2>,
) {
    let canvas = &studio.canvas;
    let sketch: Vec<_> = canvas.sketch.iter().map(|point| frame.to_screen(*point)).collect();
    let clings = studio.live_wire && canvas.tool.draws_outline() && !sketch.is_empty();
    let traced: &[_] = if clings { work.view.traced } else { &[] };
    let traced: Vec<_> = traced.iter().map(|point| frame.to_screen(*point)).collect();
    painter.extend(layers::sketch(&sketch, pointer, &traced));
    if let (true, Some(at)) = (canvas.tool.has_width(), pointer) {
        let radius = (studio.brush.radius * frame.eye.zoom) as f32;
        let color = if studio.brush.inside { theme::GOOD } else { theme::BAD };
        painter.circle_stroke(at, radius.max(1.0), Stroke::new(1.5, color));
    }
    let at = ui.input(|i| i.pointer.interact_pos());
    if let (Some(Drag::Handle { handle, .. }), Some(at), Some(picture)) = (canvas.drag, at, work.view.picture)
        && let Some(point) = handle.at(work)
    {
        magnifier::draw(painter, frame, picture, point, at);
    }
}

fn color(handle: Handle) -> Color32 {
    match handle {
        Handle::Mark(PointAt::Horizon(_) | PointAt::PrincipalPoint) => theme::HORIZON,
        Handle::Mark(PointAt::Scale(_)) => theme::OBJECT,
        Handle::Mark(PointAt::Pair(_) | PointAt::Reflection(_)) => theme::PAIR,
        Handle::Mark(PointAt::On(line, _)) => layers::line_color(line),
        Handle::Mark(PointAt::Foot(..)) => theme::GROUND,
        Handle::Mark(PointAt::SwayRoot(_) | PointAt::SwayTip(_)) | Handle::Waypoint(..) => theme::ACCENT,
    }
}

/// Tells screen readers (and tests) what the handles are called and where they are.
pub(super) fn name_handles(ui: &Ui, frame: Frame, work: &Work<'_>, handles: &[(Handle, PicturePoint)]) {
    for (handle, point) in handles {
        let rect = Rect::from_center_size(frame.to_screen(*point), Vec2::splat(2.0 * pointer::REACH));
        let response = ui.interact(rect, ui.id().with(handle), Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, handle.name(work)));
    }
}
