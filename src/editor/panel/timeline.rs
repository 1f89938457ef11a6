//! The time line of the camera's path: keyframes that can be dragged in time, a play head, play and loop.

use crate::tour::edit::{Edit, ListEdit};
use crate::tour::{CameraPath, Easing, Keyframe};

use super::super::egui::{
    Align2, Button, CursorIcon, FontId, Key, Rect, Sense, Shape, Stroke, Ui, WidgetInfo, WidgetType, pos2,
    vec2,
};
use super::super::text::with;
use super::super::work::Work;
use super::super::{Out, Request, Studio, field, theme};

/// Height of the strip, points.
const HEIGHT: f32 = 46.0;
/// Shortest time that dragging leaves between two keyframes, seconds.
const SHORTEST: f64 = 0.1;

/// When each keyframe is reached and left, seconds from the start, and when all is over.
fn times(path: &CameraPath) -> (Vec<[f64; 2]>, f64) {
    let mut now = 0.0;
    let spans = path.keyframes.iter().enumerate().map(|(index, keyframe)| {
        // The first keyframe's time is that of closing a loop.
        now += if index > 0 { keyframe.seconds } else { 0.0 };
        let reached = now;
        now += keyframe.hold;
        [reached, now]
    });
    let spans: Vec<_> = spans.collect();
    let closing = path.keyframes.first().filter(|_| path.looped).map_or(0.0, |first| first.seconds);
    (spans, now + closing)
}

/// Shows the time line.
pub(in super::super) fn timeline_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let playing = work.view.tour.playing;
    if let Some(seconds) = playing {
        studio.path_seconds = seconds;
    }
    let Some(path) = &work.tour.path else {
        ui.weak(t.path.none);
        return;
    };
    let (spans, duration) = times(path);
    ui.horizontal(|ui| {
        let name = if playing.is_some() { t.path.stop } else { t.path.play };
        if ui.add_enabled(path.keyframes.len() > 1, Button::new(name)).clicked() {
            out.request(Request::PlayPath(playing.is_none()));
        }
        if let Some(looped) = field::tick(ui, t.path.looped, path.looped) {
            out.edit(Edit::LoopPath(looped));
        }
        ui.weak(format!("{:.1} / {duration:.1} s", studio.path_seconds));
    });
    let (strip, response) =
        ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::slider(true, studio.path_seconds, t.path.timeline));
    let scale = Scale::new(strip, duration);
    draw_strip(ui, strip, scale, path, &spans, studio.path_seconds);
    for (index, (keyframe, [reached, _])) in path.keyframes.iter().zip(&spans).enumerate() {
        let before = index.checked_sub(1).map(|before| spans[before][1]);
        keyframe_ui(ui, strip, scale, index, keyframe, *reached, before, work, out);
    }
    // Keyframes lie above the strip, so what comes here is for the play head.
    if (response.dragged() || response.clicked())
        && let Some(at) = response.interact_pointer_pos()
    {
        studio.path_seconds = scale.seconds(at.x).clamp(0.0, duration);
        out.request(Request::ShowPathAt(studio.path_seconds));
    }
}

/// Where on the strip a time is.
#[derive(Clone, Copy)]
struct Scale {
    left: f32,
    points_per_second: f64,
}

impl Scale {
    fn new(strip: Rect, duration: f64) -> Self {
        let inside = strip.shrink2(vec2(16.0, 0.0));
        // A quarter more than there is, so that the last keyframe can be moved on.
        let seconds = (duration * 1.25).max(4.0);
        Self { left: inside.left(), points_per_second: f64::from(inside.width()) / seconds }
    }

    fn x(self, seconds: f64) -> f32 {
        self.left + (seconds * self.points_per_second) as f32
    }

    fn seconds(self, x: f32) -> f64 {
        f64::from(x - self.left) / self.points_per_second
    }
}

fn draw_strip(ui: &Ui, strip: Rect, scale: Scale, path: &CameraPath, spans: &[[f64; 2]], now: f64) {
    let painter = ui.painter_at(strip);
    painter.rect_filled(strip, 5.0, theme::BACKDROP);
    let middle = strip.center().y + 5.0;
    // A mark every second, or every ten when they would be closer than 6 points.
    let every = [1.0, 10.0, 60.0, 600.0].into_iter().find(|every| every * scale.points_per_second > 6.0);
    let every = every.unwrap_or(3600.0);
    let marks = (scale.seconds(strip.right()) / every).floor() as usize;
    for mark in 0..=marks.min(2000) {
        let x = scale.x(mark as f64 * every);
        let long = mark % 5 == 0;
        let top = strip.top() + if long { 9.0 } else { 5.0 };
        painter.line_segment([pos2(x, strip.top()), pos2(x, top)], Stroke::new(1.0, theme::LINE));
        if long && mark > 0 {
            let text = format!("{:.0}", mark as f64 * every);
            let at = pos2(x + 2.0, strip.top());
            painter.text(at, Align2::LEFT_TOP, text, FontId::proportional(9.5), theme::DIM);
        }
    }
    for (index, span) in spans.iter().enumerate() {
        let hold = [pos2(scale.x(span[0]), middle), pos2(scale.x(span[1]), middle)];
        painter.line_segment(hold, Stroke::new(7.0, theme::ACCENT.gamma_multiply(0.5)));
        if let (Some(next), Some(keyframe)) = (spans.get(index + 1), path.keyframes.get(index + 1)) {
            let way = [hold[1], pos2(scale.x(next[0]), middle)];
            let width = if keyframe.easing == Easing::Linear { 1.0 } else { 2.5 };
            painter.line_segment(way, Stroke::new(width, theme::ACCENT.gamma_multiply(0.7)));
        }
    }
    let x = scale.x(now);
    painter.line_segment([pos2(x, strip.top()), pos2(x, strip.bottom())], Stroke::new(1.5, theme::HORIZON));
}

fn keyframe_ui(
    ui: &Ui,
    strip: Rect,
    scale: Scale,
    index: usize,
    keyframe: &Keyframe,
    reached: f64,
    left_before: Option<f64>,
    work: &Work<'_>,
    out: &mut Out,
) {
    let center = pos2(scale.x(reached), strip.center().y + 5.0);
    let rect = Rect::from_center_size(center, vec2(24.0, 28.0));
    let response = ui.interact(rect, ui.id().with(("keyframe", index)), Sense::click_and_drag());
    let name = with(work.text.path.keyframe, index + 1);
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, &name));
    let radius = if response.hovered() || response.dragged() { 8.0 } else { 6.0 };
    let [up, right] = [vec2(0.0, radius), vec2(radius, 0.0)];
    let diamond = vec![center - up, center + right, center + up, center - right];
    let rim = Stroke::new(1.5, theme::BACKDROP);
    ui.painter().add(Shape::convex_polygon(diamond, theme::ACCENT, rim));
    if response.clicked() {
        out.request(Request::FlyTo(index));
    }
    if ui.memory(|memory| memory.has_focus(response.id)) && ui.input(|i| i.key_pressed(Key::Delete)) {
        out.edit(Edit::Keyframes(ListEdit::Remove(index)));
    }
    if response.dragged()
        && let (Some(at), Some(before)) = (response.interact_pointer_pos(), left_before)
    {
        // A tenth of a second is as fine as a hand is.
        let seconds = ((scale.seconds(at.x) - before) * 10.0).round() / 10.0;
        let seconds = seconds.clamp(SHORTEST, 3600.0);
        if seconds != keyframe.seconds {
            out.edit(Edit::Keyframes(ListEdit::Replace(index, Keyframe { seconds, ..*keyframe })));
        }
    }
    response.on_hover_text(name).on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal);
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn the_time_line_agrees_with_the_path_that_is_flown() {
        let keyframe = |seconds, hold| Keyframe {
            position: DVec3::Y,
            yaw_deg: 0.0,
            pitch_deg: 0.0,
            roll_deg: 0.0,
            seconds,
            hold,
            easing: Easing::Smooth,
        };
        for looped in [false, true] {
            let path = CameraPath { keyframes: vec![keyframe(3.0, 1.0), keyframe(2.0, 0.5)], looped };
            let (spans, duration) = times(&path);
            assert_eq!(spans, [[0.0, 1.0], [3.0, 3.5]]);
            assert_eq!(duration, path.way().unwrap().duration());
        }
    }
}
