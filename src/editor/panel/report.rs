//! The solver's report, alive: each parameter with value, deviation and trust, locks with typed values, and warnings.

use crate::solve::{ParameterReport, Solution};
use crate::tour::edit::{Edit, PlaceAt};
use crate::tour::{BackgroundPlace, FocalLength, Medium, Method, Scale};

use super::super::egui::{Align, Label, Layout, RichText, Ui};
use super::super::field::{self, Number};
use super::super::report_words::{
    field_of_view, focal_of_view, millimeters, name, pixels, sentence, trust, value,
};
use super::super::work::Work;
use super::super::{Out, theme};

/// Shows the report and the locks.
pub(super) fn report_ui(ui: &mut Ui, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    field::title(ui, t.report.title);
    let Some(solution) = work.solution() else {
        ui.weak(t.report.none);
        return;
    };
    field::card(ui, |ui| {
        for parameter in &solution.report.parameters {
            parameter_ui(ui, parameter, work);
        }
    });
    for remark in &solution.report.remarks {
        field::card(ui, |ui| {
            ui.add(Label::new(RichText::new(sentence(remark)).color(theme::ROUGH)).wrap());
        });
    }
    field::title(ui, t.report.locks);
    field::card(ui, |ui| {
        focal_ui(ui, solution, work, out);
        height_ui(ui, solution, work, out);
        distance_ui(ui, solution, work, out);
        let methods = [(Method::Full, t.report.method_full), (Method::Paper, t.report.method_paper)];
        if let Some(method) = field::choice(ui, "method", t.report.method, work.tour.camera.method, &methods)
        {
            out.edit(Edit::Method(method));
        }
    });
}

/// A parameter in a row: name, value with deviation, trust in a word and its color.
fn parameter_ui(ui: &mut Ui, report: &ParameterReport, work: &Work<'_>) {
    let t = work.text;
    let size = work.size.as_dvec2();
    let (word, color) = trust(report, t);
    let response = ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 1.0;
        ui.horizontal(|ui| {
            ui.label(name(report.name, t));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                ui.label(RichText::new(word).color(color).strong());
            });
        });
        ui.label(RichText::new(value(report, size.x, size.y)).monospace().color(theme::DIM));
    });
    if !report.from.is_empty() {
        let from = format!("{} {}", t.report.from, report.from.join(", "));
        response.response.on_hover_text(from);
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Focal {
    Unknown,
    Exif,
    Between,
    Known,
}

/// What is known of the focal length, in millimeters and as a field of view.
fn focal_ui(ui: &mut Ui, solution: &Solution, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let size = work.size.as_dvec2();
    let long = size.max_element();
    let known = work.tour.camera.focal_length;
    let kind = match known {
        FocalLength::Unknown => Focal::Unknown,
        FocalLength::Exif => Focal::Exif,
        FocalLength::Between(..) => Focal::Between,
        FocalLength::Known(_) => Focal::Known,
    };
    let kinds = [
        (Focal::Unknown, t.report.focal_unknown),
        (Focal::Known, t.report.focal_locked),
        (Focal::Between, t.report.focal_between),
        (Focal::Exif, t.report.focal_exif),
    ];
    let is_photograph = work.tour.picture.medium == Medium::Photograph;
    let kinds = if is_photograph { &kinds[..] } else { &kinds[..3] };
    let solved = solution.parameters.focal_px;
    match field::choice(ui, "focal", t.report.focal_length, kind, kinds) {
        Some(Focal::Unknown) => out.edit(Edit::FocalLength(FocalLength::Unknown)),
        Some(Focal::Exif) => out.edit(Edit::FocalLength(FocalLength::Exif)),
        Some(Focal::Between) => {
            out.edit(Edit::FocalLength(FocalLength::Between(solved / 1.3, solved * 1.3)));
        }
        Some(Focal::Known) => out.edit(Edit::FocalLength(FocalLength::Known(solved))),
        None => {}
    }
    let length = |name| Number::new(name, 4.0..=1200.0).unit(" mm").speed(0.2).decimals(1);
    match known {
        FocalLength::Known(focal) => {
            let length = length(t.report.focal_mm).hint(t.report.focal_mm_hint);
            if let Some(mm) = length.show(ui, millimeters(focal, long)) {
                out.edit(Edit::FocalLength(FocalLength::Known(pixels(mm, long))));
            }
            let view = Number::new(t.report.field_of_view, 2.0..=150.0).unit("°").speed(0.1).decimals(1);
            if let Some(degrees) = view.show(ui, field_of_view(focal, size.x)) {
                out.edit(Edit::FocalLength(FocalLength::Known(focal_of_view(degrees, size.x))));
            }
        }
        FocalLength::Between(least, most) => {
            if let Some(mm) = length(t.report.focal_least).show(ui, millimeters(least, long)) {
                out.edit(Edit::FocalLength(FocalLength::Between(pixels(mm, long).min(most), most)));
            }
            if let Some(mm) = length(t.report.focal_most).show(ui, millimeters(most, long)) {
                out.edit(Edit::FocalLength(FocalLength::Between(least, pixels(mm, long).max(least))));
            }
        }
        FocalLength::Exif | FocalLength::Unknown => {}
    }
}

fn height_ui(ui: &mut Ui, solution: &Solution, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let locked = match work.tour.camera.scale {
        Some(Scale::HeightAboveWater(meters)) => Some(meters),
        _ => None,
    };
    if let Some(wanted) = field::tick(ui, t.report.lock_height, locked.is_some()) {
        let height = solution.parameters.height;
        out.edit(Edit::Scale(wanted.then_some(Scale::HeightAboveWater(height))));
    }
    let number = Number::new(t.report.height, 0.05..=500.0).unit(" m").speed(0.01);
    if let Some(meters) = locked
        && let Some(wanted) = number.show(ui, meters)
    {
        out.edit(Edit::Scale(Some(Scale::HeightAboveWater(wanted))));
    }
}

fn distance_ui(ui: &mut Ui, solution: &Solution, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let at = PlaceAt::Background;
    let locked = match at.get(work.tour) {
        Some(BackgroundPlace::Distance(meters)) => Some(*meters),
        _ => None,
    };
    if let Some(wanted) = field::tick(ui, t.report.lock_distance, locked.is_some()) {
        let distance = BackgroundPlace::Distance(solution.parameters.background_distance);
        out.edit(Edit::Place { at, place: wanted.then_some(distance) });
    }
    if let Some(meters) = locked {
        let number = Number::new(t.report.background_distance, 0.5..=100_000.0).unit(" m").decimals(1);
        if let Some(wanted) = number.speed(meters / 200.0).show(ui, meters) {
            out.edit(Edit::Place { at, place: Some(BackgroundPlace::Distance(wanted)) });
        }
    }
}
