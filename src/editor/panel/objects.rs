//! Step 4: what stands in the scene. Drawing an outline makes an object; its feet say where it stands.

use crate::tour::Support;
use crate::tour::edit::{Edit, ListEdit, Named, PointAt, RegionAt};

use super::super::canvas::Tool;
use super::super::egui::{Button, Ui};
use super::super::field;
use super::super::work::Work;
use super::super::{Out, Request, Studio, SuggestWhat};
use super::background::name_ui;
use super::region::{live_wire_ui, region_ui};
use super::{point_ui, tool_button};

/// Shows the step.
pub(super) fn objects_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    tool_button(ui, studio, Tool::NewObject, t.objects.draw_new);
    if studio.canvas.tool == Tool::NewObject {
        live_wire_ui(ui, studio, work);
    }
    list_ui(ui, studio, work);
    if let Some(index) = studio.object
        && index < work.tour.objects.len()
    {
        ui.push_id(("object", index), |ui| field::card(ui, |ui| object_ui(ui, index, studio, work, out)));
    }
}

/// The objects by name; one can be selected.
pub(super) fn list_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>) {
    ui.horizontal_wrapped(|ui| {
        for (index, object) in work.tour.objects.iter().enumerate() {
            let is_selected = studio.object == Some(index);
            if ui
                .add(
                    Button::selectable(is_selected, object.name.as_str())
                        .frame_when_inactive(true)
                        .truncate(),
                )
                .clicked()
            {
                studio.canvas.let_go();
                studio.object = Some(index);
            }
        }
    });
}

fn object_ui(ui: &mut Ui, index: usize, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let object = &work.tour.objects[index];
    ui.horizontal(|ui| {
        if let Some(to) = name_ui(ui, &object.name, t.objects.name) {
            out.edit(Edit::Rename { what: Named::Object(index), to });
        }
        if ui.button(t.objects.remove).clicked() {
            out.edit(Edit::Objects(ListEdit::Remove(index)));
            studio.object = None;
            studio.canvas.let_go();
        }
    });
    ui.label(t.objects.outline);
    region_ui(ui, RegionAt::Object(index), studio, work, out);
    let supports = [(Support::Water, t.objects.in_water), (Support::Ground, t.objects.on_ground)];
    if let Some(support) = field::choice(ui, "support", t.objects.stands, object.support, &supports) {
        out.edit(Edit::Support { object: index, support });
    }
    ui.horizontal_wrapped(|ui| {
        tool_button(ui, studio, Tool::Contact(index), t.objects.draw_contact);
        if ui.button(t.objects.propose_contact).on_hover_text(t.objects.propose_contact_hint).clicked() {
            out.request(Request::Suggest(SuggestWhat::Contact(index)));
        }
    });
    point_ui(ui, t.objects.left_foot, PointAt::Foot(index, 0), work, out);
    point_ui(ui, t.objects.right_foot, PointAt::Foot(index, 1), work, out);
    if let Some(turns) = field::tick(ui, t.objects.turns, object.turns_to_camera) {
        out.edit(Edit::TurnsToCamera { object: index, turns });
    }
}
