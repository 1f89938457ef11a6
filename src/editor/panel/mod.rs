//! One panel a step: what can be drawn, and numbers for everything that can be dragged.

mod background;
mod horizon;
mod motion;
mod objects;
mod pairs;
mod path;
mod plan;
mod region;
mod report;
mod suggestions;
mod timeline;
mod water;
mod weather;

pub(super) use plan::plan_ui;
pub(super) use timeline::timeline_ui;

use crate::tour::edit::PointAt;

use super::canvas::{Handle, Tool};
use super::egui::{Button, ScrollArea, Ui};
use super::work::Work;
use super::{Out, Step, Studio, field, rail, theme};

/// The panel of the open step.
pub(super) fn panel_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let scroll = ScrollArea::vertical().id_salt(studio.step).auto_shrink([false, false]);
    scroll.show(ui, |ui| {
        // Room for the scroll bar, so that nothing jumps when it comes.
        ui.set_width(ui.available_width() - 4.0);
        ui.add_space(4.0);
        // Each part has an id of its own: a need that is met while a slider is held must not shift the slider's id.
        ui.push_id("head", |ui| rail::step_head_ui(ui, studio.step, work));
        ui.push_id("suggestions", |ui| suggestions::suggestions_ui(ui, studio, work, out));
        ui.push_id("step", |ui| match studio.step {
            Step::Horizon => horizon::horizon_ui(ui, studio, work, out),
            Step::Water => water::water_ui(ui, studio, work, out),
            Step::Ground => background::background_ui(ui, studio, work, out),
            Step::Objects => objects::objects_ui(ui, studio, work, out),
            Step::Pairs => pairs::pairs_ui(ui, studio, work, out),
            Step::Motion => motion::motion_ui(ui, studio, work, out),
        });
        match studio.step {
            Step::Pairs => drop(ui.push_id("report", |ui| report::report_ui(ui, work, out))),
            Step::Motion => {
                ui.push_id("weather", |ui| weather::weather_ui(ui, work, out));
                ui.push_id("path", |ui| path::path_ui(ui, studio, work, out));
            }
            _ => {}
        }
        ui.push_id("selection", |ui| selection_ui(ui, studio, work, out));
        ui.add_space(12.0);
    });
}

/// A button that takes a tool into the hand, and shows whether it is there.
fn tool_button(ui: &mut Ui, studio: &mut Studio, tool: Tool, name: &str) {
    let is_held = studio.canvas.tool == tool;
    if ui.add(Button::selectable(is_held, name).frame_when_inactive(true).truncate()).clicked() {
        studio.take(tool);
    }
}

/// The place of the selected handle in numbers.
fn selection_ui(ui: &mut Ui, studio: &Studio, work: &Work<'_>, out: &mut Out) {
    let Some(handle) = studio.canvas.selected else { return };
    let Some(at) = handle.at(work) else { return };
    field::title(ui, work.text.mark.selected);
    field::card(ui, |ui| {
        ui.colored_label(theme::ACCENT, handle.name(work));
        if let Some(to) = field::point(ui, work.text.mark.place, at)
            && let Some(edit) = handle.moved(to, work)
        {
            out.edit(edit);
        }
    });
}

/// A point of the document in numbers, if it is marked.
fn point_ui(ui: &mut Ui, name: &str, at: PointAt, work: &Work<'_>, out: &mut Out) {
    let handle = Handle::Mark(at);
    if let Some(point) = handle.at(work)
        && let Some(to) = field::point(ui, name, point)
        && let Some(edit) = handle.moved(to, work)
    {
        out.edit(edit);
    }
}
