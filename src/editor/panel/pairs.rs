//! Step 5: points and their reflections, each with what it is off by.

use crate::solve::PairReport;
use crate::tour::ReflectionPair;
use crate::tour::edit::{Edit, ListEdit, PointAt};

use super::super::canvas::{Handle, Tool};
use super::super::egui::{Button, Label, RichText, Ui};
use super::super::text::with;
use super::super::work::Work;
use super::super::{Out, Studio, field, report_words, theme};
use super::{point_ui, tool_button};

/// Shows the pairs.
pub(super) fn pairs_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    ui.horizontal_wrapped(|ui| {
        tool_button(ui, studio, Tool::Pair, t.pairs.mark);
        if let Some(wanted) = field::tick(ui, t.pairs.tenfold, studio.residuals_tenfold) {
            studio.residuals_tenfold = wanted;
        }
    });
    let Some(water) = &work.tour.water else { return };
    let selected = match studio.canvas.selected {
        Some(Handle::Mark(PointAt::Pair(pair) | PointAt::Reflection(pair))) => Some(pair),
        _ => None,
    };
    for (index, pair) in water.pairs.iter().enumerate() {
        let report = work.solution().and_then(|solution| solution.report.pairs.get(index));
        ui.push_id(("pair", index), |ui| {
            ui.horizontal(|ui| {
                let name = pair.name.clone().unwrap_or_else(|| with(t.pairs.number, index + 1));
                let is_open = selected == Some(index);
                if ui.add(Button::selectable(is_open, name).truncate()).clicked() {
                    studio.canvas.let_go();
                    studio.canvas.selected = (!is_open).then_some(Handle::Mark(PointAt::Pair(index)));
                }
                residual_ui(ui, report, work);
            });
            if selected == Some(index) {
                field::card(ui, |ui| pair_ui(ui, index, pair, report, studio, work, out));
            }
        });
    }
}

/// What a pair is off by, in a few words.
fn residual_ui(ui: &mut Ui, report: Option<&PairReport>, work: &Work<'_>) {
    let Some(report) = report else { return };
    let pixels = format!("{:.1} px", report.residual_px);
    if report.kept {
        ui.colored_label(theme::DIM, pixels);
        if let Some(depth) = report.depth {
            ui.colored_label(theme::DIM, format!("{depth:.0} m"));
        }
    } else {
        ui.colored_label(theme::BAD, format!("{pixels} · {}", work.text.pairs.left_out));
    }
}

fn pair_ui(
    ui: &mut Ui,
    index: usize,
    pair: &ReflectionPair,
    report: Option<&PairReport>,
    studio: &mut Studio,
    work: &Work<'_>,
    out: &mut Out,
) {
    let t = work.text;
    if let Some(remark) = report.and_then(|report| report.remark.as_deref()) {
        ui.add(Label::new(RichText::new(report_words::sentence(remark)).color(theme::BAD)).wrap());
    }
    point_ui(ui, t.pairs.point, PointAt::Pair(index), work, out);
    point_ui(ui, t.pairs.reflection, PointAt::Reflection(index), work, out);
    carrier_ui(ui, index, pair, work, out);
    if ui.button(t.pairs.remove).clicked() {
        out.edit(Edit::Pairs(ListEdit::Remove(index)));
        studio.canvas.let_go();
    }
}

/// What the pair's point is on.
fn carrier_ui(ui: &mut Ui, index: usize, pair: &ReflectionPair, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let objects = work.tour.objects.iter().map(|object| object.name.as_str());
    let bands = work.tour.background.bands.iter().map(|band| band.name.as_str());
    let mut carriers: Vec<(Option<&str>, &str)> = vec![(None, t.pairs.unknown)];
    carriers.push((Some("background"), t.mark.background));
    carriers.extend(objects.chain(bands).map(|name| (Some(name), name)));
    if let Some(on) = field::choice(ui, "carrier", t.pairs.on, pair.on.as_deref(), &carriers) {
        out.edit(Edit::PairOn { pair: index, on: on.map(str::to_owned) });
    }
}
