//! The whole window: bars at top and bottom, the rail, the open step's panel, picture and tour side by side.

use glam::UVec2;

use super::canvas::canvas_ui;
use super::egui::load::SizedTexture;
use super::egui::{
    Align2, CentralPanel, FontId, Frame, Image, Key, Margin, Memory, Panel, Rect, Sense, Ui, UiBuilder,
    WidgetInfo, WidgetType,
};
use super::work::Work;
use super::{
    Layout, Out, Step, Studio, View, apply_theme, dialog, panel, rail, shortcuts, status, theme, top_bar,
};

/// Width of the step's panel, points.
const PANEL_WIDTH: f32 = 344.0;

/// Shows the studio in all of `ui`, and writes into `view.out` what the user wants.
///
/// See [`View`] for what is to be given each frame, and [`Request`](super::Request) for what comes back.
pub fn studio_ui(ui: &mut Ui, studio: &mut Studio, view: &mut View<'_>) {
    if !studio.is_themed {
        apply_theme(ui.ctx());
        studio.is_themed = true;
        ui.ctx().request_repaint();
    }
    let held = ui.input(|i| {
        let arrows = [Key::ArrowLeft, Key::ArrowRight, Key::ArrowUp, Key::ArrowDown];
        i.pointer.any_down() || arrows.iter().any(|key| i.key_down(*key))
    });
    let mut out = Out::begin(held, studio.in_gesture, studio.gesture_canceled);
    let t = studio.language.text();
    let view_now: &View<'_> = view;
    let work = view_now.desk.map(|desk| Work::new(view_now, desk, t));
    // What must be answered comes before anything else; its keys are the question's own.
    let by_key = match view_now.question {
        Some(_) => Vec::new(),
        None => shortcuts::act(ui, studio, work.is_some(), &mut out),
    };

    let bar = Frame::new().fill(theme::PANEL).inner_margin(Margin::symmetric(10, 5));
    Panel::top("studio bar").frame(bar).show(ui, |ui| {
        top_bar::top_bar_ui(ui, studio, view_now, work.as_ref(), t, &mut out);
    });
    if let Some(message) = view_now.message {
        Panel::top("studio message").frame(bar.fill(theme::CARD)).show(ui, |ui| {
            dialog::message_ui(ui, message, t, &mut out);
        });
    }
    if let Some(work) = &work {
        Panel::top("studio rail").frame(bar).show(ui, |ui| rail::rail_ui(ui, studio, work));
    }
    Panel::bottom("studio status").frame(bar).show(ui, |ui| {
        status::status_ui(ui, studio, view_now, work.as_ref(), t, &mut out);
    });
    match &work {
        Some(work) => desk_ui(ui, studio, work, &mut out),
        None => {
            CentralPanel::default().show(ui, |ui| top_bar::start_ui(ui, view_now, t, &mut out));
        }
    }
    if let Some(question) = view_now.question {
        dialog::question_ui(ui, question, t, &mut out);
    }

    by_key.into_iter().for_each(|request| out.request(request));
    out.text_has_focus = ui.ctx().text_edit_focused();
    studio.pointer_was_over_tour = out.pointer_over_tour;
    (studio.in_gesture, studio.gesture_canceled) = out.end();
    view.out = out;
}

/// The draft at work: panel, picture, tour, time line.
fn desk_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let width = PANEL_WIDTH.min(ui.available_width() * 0.45);
    let frame = Frame::new().fill(theme::PANEL).inner_margin(Margin::symmetric(10, 4));
    Panel::left("studio panel").frame(frame).default_size(width).size_range(240.0..=width.max(520.0)).show(
        ui,
        |ui| {
            panel::panel_ui(ui, studio, work, out);
        },
    );
    if studio.step == Step::Motion {
        Panel::bottom("studio time line").frame(frame).show(ui, |ui| {
            panel::timeline_ui(ui, studio, work, out);
        });
    }
    CentralPanel::default().frame(Frame::new().fill(theme::BACKDROP)).show(ui, |ui| {
        if work.view.desk.is_some_and(|desk| desk.picture_lost) {
            dialog::picture_lost_ui(ui, work.text, out);
        }
        let rect = ui.available_rect_before_wrap();
        let [picture, tour] = halves(rect, studio.layout);
        if let Some(rect) = picture {
            ui.scope_builder(UiBuilder::new().id_salt("picture").max_rect(rect), |ui| {
                canvas_ui(ui, studio, work, out);
            });
        }
        if let Some(rect) = tour {
            ui.scope_builder(UiBuilder::new().id_salt("tour").max_rect(rect), |ui| {
                tour_ui(ui, work, out);
                if studio.step == Step::Motion && studio.safe_volume {
                    panel::plan_ui(ui, rect, work);
                }
            });
        }
        ui.advance_cursor_after_rect(rect);
    });
}

/// Where picture and tour are shown: side by side, or one above the other in a room that is higher than wide.
fn halves(rect: Rect, layout: Layout) -> [Option<Rect>; 2] {
    match layout {
        Layout::Picture => [Some(rect), None],
        Layout::Tour => [None, Some(rect)],
        Layout::Split => {
            let gap = 3.0;
            let center = rect.center();
            let (first, second) = if rect.width() >= 0.8 * rect.height() {
                (rect.with_max_x(center.x - gap), rect.with_min_x(center.x + gap))
            } else {
                (rect.with_max_y(center.y - gap), rect.with_min_y(center.y + gap))
            };
            [Some(first), Some(second)]
        }
    }
}

/// The live tour: an image as large as there is room.
fn tour_ui(ui: &mut Ui, work: &Work<'_>, out: &mut Out) {
    let rect = ui.available_rect_before_wrap();
    let scale = ui.ctx().pixels_per_point();
    out.wanted_tour_size = UVec2::new((rect.width() * scale) as u32, (rect.height() * scale) as u32);
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, work.text.mark.tour));
    if response.clicked() || response.drag_started() {
        // Whatever was typed in before is done, so that the keys fly.
        ui.memory_mut(Memory::stop_text_input);
    }
    out.pointer_over_tour = response.contains_pointer() || response.dragged();
    let pointer = ui.ctx().pointer_latest_pos().filter(|_| out.pointer_over_tour);
    out.tour_pointer = pointer.map(|at| {
        let at = (at - rect.min) * scale;
        glam::Vec2::new(at.x, at.y)
    });
    match work.view.tour.image {
        Some(texture) => Image::new(SizedTexture::new(texture, rect.size())).paint_at(ui, rect),
        None => {
            let font = FontId::proportional(14.0);
            let words =
                if work.view.tasks.is_empty() { work.text.mark.no_tour } else { work.text.mark.tour_comes };
            ui.painter().text(rect.center(), Align2::CENTER_CENTER, words, font, theme::DIM);
        }
    }
}
