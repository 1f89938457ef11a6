//! The line at the bottom: the file, what the tool in hand wants, work in the background.

use super::egui::{Align, Label, Layout, ProgressBar, RichText, Ui};
use super::text::{Text, with};
use super::work::Work;
use super::{Out, Request, Studio, Task, View, theme, top_bar};

/// Shows the line.
pub(super) fn status_ui(
    ui: &mut Ui,
    studio: &Studio,
    view: &View<'_>,
    work: Option<&Work<'_>>,
    t: &Text,
    out: &mut Out,
) {
    ui.horizontal(|ui| {
        ui.set_min_height(theme::TARGET);
        ui.label(top_bar::name_of(view, t));
        if let Some(work) = work {
            if !work.history.is_saved() {
                ui.colored_label(theme::ROUGH, t.bar.unsaved);
            }
            ui.separator();
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            // The latest task is the one waited for.
            if let Some(task) = view.tasks.last() {
                task_ui(ui, task, t, out);
            }
            if view.tasks.len() > 1 {
                ui.weak(with(t.bar.more_tasks, view.tasks.len() - 1));
            }
            if let Some(work) = work {
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    let hint = studio.canvas.tool.hint(work);
                    ui.add(Label::new(RichText::new(hint).color(theme::DIM)).truncate());
                });
            }
        });
    });
}

fn task_ui(ui: &mut Ui, task: &Task, t: &Text, out: &mut Out) {
    let Task { id, title, done, can_cancel } = task;
    if *can_cancel && ui.button(t.bar.cancel).clicked() {
        out.request(Request::CancelTask(*id));
    }
    match done {
        Some(done) => ui.add(ProgressBar::new(*done).desired_width(110.0).desired_height(10.0)),
        None => ui.spinner(),
    };
    ui.label(title);
}
