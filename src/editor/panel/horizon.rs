//! Step 1: the horizon, the picture's optical middle, and the one length that sets the scale.

use crate::picture::PicturePoint;
use crate::tour::edit::{Edit, PointAt};
use crate::tour::{Medium, Scale};

use super::super::canvas::Tool;
use super::super::egui::Ui;
use super::super::field::{self, Number};
use super::super::text::with;
use super::super::work::Work;
use super::super::{Out, Studio};
use super::{point_ui, tool_button};

/// Shows the step.
pub(super) fn horizon_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    ui.horizontal_wrapped(|ui| {
        let name = if work.tour.camera.horizon.is_some() { t.horizon.draw_again } else { t.horizon.draw };
        tool_button(ui, studio, Tool::Horizon, name);
        if work.tour.camera.horizon.is_some() && ui.button(t.horizon.clear).clicked() {
            out.edit(Edit::Horizon(None));
        }
        let solved = work.camera().and_then(|camera| camera.horizon());
        if let Some(ends) = solved
            && ui.button(t.horizon.take_solved).on_hover_text(t.horizon.take_solved_hint).clicked()
        {
            out.edit(Edit::Horizon(Some(ends)));
        }
    });
    if let Some(horizon) = work.tour.camera.horizon {
        field::card(ui, |ui| {
            point_ui(ui, t.horizon.left_end, PointAt::Horizon(0), work, out);
            point_ui(ui, t.horizon.right_end, PointAt::Horizon(1), work, out);
            let tilt = (horizon[1].0 - horizon[0].0).to_angle().to_degrees();
            let wanted = Number::new(t.horizon.tilt, -40.0..=40.0).unit("°").speed(0.05).show(ui, tilt);
            if let Some(degrees) = wanted {
                out.edit(Edit::Horizon(Some(tilted(horizon, degrees))));
            }
        });
    }
    scale_ui(ui, studio, work, out);
    field::title(ui, t.horizon.picture);
    field::card(ui, |ui| {
        let media = [
            (Medium::Photograph, t.horizon.photograph),
            (Medium::Painting, t.horizon.painting),
            (Medium::Print, t.horizon.print),
        ];
        let medium = work.tour.picture.medium;
        if let Some(wanted) = field::choice(ui, "medium", t.horizon.medium, medium, &media) {
            out.edit(Edit::Medium(wanted));
        }
        let is_own = work.tour.camera.principal_point.is_some();
        if let Some(wanted) = field::tick(ui, t.horizon.own_principal, is_own) {
            let middle = PicturePoint(work.size.as_dvec2() / 2.0);
            out.edit(Edit::PrincipalPoint(wanted.then_some(middle)));
        }
        point_ui(ui, t.mark.principal_point, PointAt::PrincipalPoint, work, out);
    });
}

/// The horizon turned about its middle to an angle in degrees.
fn tilted([a, b]: [PicturePoint; 2], degrees: f64) -> [PicturePoint; 2] {
    let middle = (a.0 + b.0) / 2.0;
    let half = glam::DVec2::from_angle(degrees.to_radians()) * (a.0.distance(b.0) / 2.0);
    [PicturePoint(middle - half), PicturePoint(middle + half)]
}

/// What sets the scale.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Assumed,
    AboveWater,
    AboveGround,
    Length,
}

fn scale_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let scale = &work.tour.camera.scale;
    let kind = match scale {
        None => Kind::Assumed,
        Some(Scale::HeightAboveWater(_)) => Kind::AboveWater,
        Some(Scale::HeightAboveGround(_)) => Kind::AboveGround,
        Some(Scale::Length { .. }) => Kind::Length,
    };
    field::title(ui, t.horizon.scale);
    field::card(ui, |ui| {
        let (assumed, _) = work.tour.scale();
        let height = match assumed {
            Scale::HeightAboveWater(meters) | Scale::HeightAboveGround(meters) => meters,
            Scale::Length { .. } => crate::tour::ASSUMED_HEIGHT,
        };
        let kinds = [
            (Kind::Assumed, t.horizon.scale_assumed),
            (Kind::AboveWater, t.horizon.above_water),
            (Kind::AboveGround, t.horizon.above_ground),
            (Kind::Length, t.horizon.known_length),
        ];
        match field::choice(ui, "scale", t.horizon.scale_by, kind, &kinds) {
            Some(Kind::Assumed) => out.edit(Edit::Scale(None)),
            Some(Kind::AboveWater) => out.edit(Edit::Scale(Some(Scale::HeightAboveWater(height)))),
            Some(Kind::AboveGround) => out.edit(Edit::Scale(Some(Scale::HeightAboveGround(height)))),
            // The length itself is drawn on the picture.
            Some(Kind::Length) if !work.tour.objects.is_empty() => studio.take(Tool::Length(0)),
            Some(Kind::Length) | None => {}
        }
        let meters = Number::new(t.horizon.height, 0.05..=500.0).unit(" m").speed(0.01);
        match scale {
            None => {
                ui.weak(with(t.horizon.height_assumed, format!("{height:.2}")));
            }
            Some(Scale::HeightAboveWater(value)) => {
                if let Some(wanted) = meters.show(ui, *value) {
                    out.edit(Edit::Scale(Some(Scale::HeightAboveWater(wanted))));
                }
            }
            Some(Scale::HeightAboveGround(value)) => {
                if let Some(wanted) = meters.show(ui, *value) {
                    out.edit(Edit::Scale(Some(Scale::HeightAboveGround(wanted))));
                }
            }
            Some(Scale::Length { on, from, to, meters: value }) => {
                ui.weak(with(t.horizon.length_on, on));
                let length = Number::new(t.horizon.length, 0.01..=1000.0).unit(" m").speed(0.01);
                if let Some(meters) = length.show(ui, *value) {
                    let (on, from, to) = (on.clone(), *from, *to);
                    out.edit(Edit::Scale(Some(Scale::Length { on, from, to, meters })));
                }
            }
        }
        if work.tour.objects.is_empty() {
            ui.weak(t.horizon.length_needs_object);
        } else {
            ui.label(t.horizon.draw_length);
            ui.horizontal_wrapped(|ui| {
                for (index, object) in work.tour.objects.iter().enumerate() {
                    tool_button(ui, studio, Tool::Length(index), &object.name);
                }
            });
        }
    });
}
