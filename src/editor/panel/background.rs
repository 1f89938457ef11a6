//! Step 3: the ground, what closes the scene, its bands, and the sky.

use crate::tour::edit::{Edit, LineAt, ListEdit, Named, PlaceAt, RegionAt};
use crate::tour::{BackgroundPlace, Sky};

use super::super::canvas::Tool;
use super::super::egui::{TextEdit, Ui, WidgetInfo};
use super::super::field::{self, Number};
use super::super::text::with;
use super::super::work::Work;
use super::super::{Out, Studio};
use super::region::{has_corners, live_wire_ui, region_ui};
use super::tool_button;

/// Shows the step.
pub(super) fn background_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    field::title(ui, t.mark.ground);
    ui.push_id("ground", |ui| {
        field::card(ui, |ui| {
            region_ui(ui, RegionAt::Ground, studio, work, out);
            if let Some(ground) = &work.tour.ground {
                let height = Number::new(t.background.ground_height, 0.0..=100.0).unit(" m").speed(0.01);
                let height = height.hint(t.background.ground_height_hint);
                if let Some(wanted) = height.show(ui, ground.height_above_water) {
                    out.edit(Edit::GroundHeight(wanted));
                }
                if ui.button(t.background.remove_ground).clicked() {
                    out.edit(Edit::Ground(None));
                }
            }
        });
    });
    field::title(ui, t.mark.background);
    ui.push_id("background", |ui| field::card(ui, |ui| place_ui(ui, PlaceAt::Background, studio, work, out)));
    for index in 0..work.tour.background.bands.len() {
        ui.push_id(("band", index), |ui| field::card(ui, |ui| band_ui(ui, index, studio, work, out)));
    }
    tool_button(ui, studio, Tool::NewBand, t.background.new_band);
    if studio.canvas.tool == Tool::NewBand {
        live_wire_ui(ui, studio, work);
    }
    field::title(ui, t.mark.sky);
    ui.push_id("sky", |ui| field::card(ui, |ui| sky_ui(ui, studio, work, out)));
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Found,
    Distance,
    Contact,
    Infinity,
}

/// Where a plane stands.
fn place_ui(ui: &mut Ui, at: PlaceAt, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let place = at.get(work.tour);
    let kind = match place {
        None => Kind::Found,
        Some(BackgroundPlace::Distance(_)) => Kind::Distance,
        Some(BackgroundPlace::Contact(_)) => Kind::Contact,
        Some(BackgroundPlace::Infinity) => Kind::Infinity,
    };
    let kinds = [
        (Kind::Found, t.background.found),
        (Kind::Distance, t.background.at_distance),
        (Kind::Contact, t.background.by_contact),
        (Kind::Infinity, t.background.at_infinity),
    ];
    // A band always has a place.
    let kinds = if at == PlaceAt::Background { &kinds[..] } else { &kinds[1..] };
    let solved = work.solution().map_or(100.0, |solution| solution.parameters.background_distance);
    match field::choice(ui, ("place", at), t.background.stands, kind, kinds) {
        Some(Kind::Found) => out.edit(Edit::Place { at, place: None }),
        Some(Kind::Distance) => out.edit(Edit::Place { at, place: Some(BackgroundPlace::Distance(solved)) }),
        Some(Kind::Infinity) => out.edit(Edit::Place { at, place: Some(BackgroundPlace::Infinity) }),
        // The contact line is drawn on the picture.
        Some(Kind::Contact) => studio.take(Tool::BackgroundContact(at)),
        None => {}
    }
    if let Some(BackgroundPlace::Distance(meters)) = place {
        let number = Number::new(t.background.distance, 0.5..=100_000.0).unit(" m").speed(meters / 200.0);
        if let Some(wanted) = number.decimals(1).show(ui, *meters) {
            out.edit(Edit::Place { at, place: Some(BackgroundPlace::Distance(wanted)) });
        }
    }
    let name = if has_corners(LineAt::Place(at), work) {
        t.background.draw_contact_again
    } else {
        t.background.draw_contact
    };
    tool_button(ui, studio, Tool::BackgroundContact(at), name);
}

fn band_ui(ui: &mut Ui, index: usize, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let Some(band) = work.tour.background.bands.get(index) else { return };
    ui.horizontal(|ui| {
        if let Some(to) = name_ui(ui, &band.name, t.background.band_name) {
            out.edit(Edit::Rename { what: Named::Band(index), to });
        }
        if ui.button(t.background.remove).on_hover_text(with(t.background.remove_named, &band.name)).clicked()
        {
            out.edit(Edit::Bands(ListEdit::Remove(index)));
        }
    });
    region_ui(ui, RegionAt::Band(index), studio, work, out);
    place_ui(ui, PlaceAt::Band(index), studio, work, out);
}

/// A name to type; gives the new one when it is complete.
pub(super) fn name_ui(ui: &mut Ui, name: &str, hint: &str) -> Option<String> {
    let id = ui.id().with("name");
    // The text while it is typed; the document has the last complete one.
    let mut typed = ui.data_mut(|data| data.get_temp::<String>(id)).unwrap_or_else(|| name.to_owned());
    let response =
        ui.add(TextEdit::singleline(&mut typed).id(id.with("edit")).desired_width(130.0).hint_text(hint));
    response.widget_info(|| {
        let mut info = WidgetInfo::text_edit(true, name, &typed, hint);
        info.label = Some(hint.to_owned());
        info
    });
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, typed));
        return None;
    }
    ui.data_mut(|data| data.remove_temp::<String>(id));
    (response.lost_focus() && typed.trim() != name && !typed.trim().is_empty())
        .then(|| typed.trim().to_owned())
}

fn sky_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let is_layer = work.tour.sky.is_some();
    if let Some(wanted) = field::tick(ui, t.background.sky_layer, is_layer) {
        out.edit(Edit::Sky(wanted.then_some(Sky { region: None, drift: None })));
    }
    if is_layer {
        region_ui(ui, RegionAt::Sky, studio, work, out);
    } else {
        ui.weak(t.background.no_sky);
    }
}
