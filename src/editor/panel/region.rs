//! Drawing a region: outline, growing, brush; for objects also a box and strokes.

use crate::tour::Region;
use crate::tour::edit::{Edit, LineAt, RegionAt};

use super::super::canvas::{Tool, is_drawn, region_name};
use super::super::egui::Ui;
use super::super::field::{self, Number};
use super::super::text::with;
use super::super::work::Work;
use super::super::{Out, Request, Studio};
use super::tool_button;

/// The tools of a region, and what it is now.
pub(super) fn region_ui(ui: &mut Ui, at: RegionAt, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    ui.horizontal_wrapped(|ui| {
        let is_drawn = is_drawn(at, work);
        let name = if is_drawn { t.region.draw_again } else { t.region.draw };
        tool_button(ui, studio, Tool::Region(at), name);
        match at {
            RegionAt::Object(object) => {
                tool_button(ui, studio, Tool::Box(object), t.region.boxed);
                tool_button(ui, studio, Tool::Stroke(at), t.region.strokes);
            }
            _ => {
                let name = if is_drawn { t.region.strokes } else { t.region.grow };
                tool_button(ui, studio, Tool::Stroke(at), name);
            }
        }
        if is_drawn {
            tool_button(ui, studio, Tool::Brush(at), t.region.brush);
        }
        let can_go = matches!(at, RegionAt::Band(_) | RegionAt::Sky);
        if is_drawn && can_go && ui.button(t.region.clear).clicked() {
            out.edit(Edit::Region { at, region: None });
        }
    });
    match at.get(work.tour) {
        Some(Region::Polygon(corners)) if !corners.is_empty() => {
            ui.weak(with(t.region.corners, corners.len()));
        }
        Some(Region::Mask(name)) => {
            // In a row of its own, which stays: whoever clicks twice must not hit what moves up.
            ui.horizontal_wrapped(|ui| {
                ui.weak(with(t.region.mask, name));
                if at.is_guess(work.tour) && ui.button(t.region.is_right).clicked() {
                    out.request(Request::TakeGuess(at));
                }
            });
        }
        _ => {
            ui.weak(t.region.none);
        }
    }
    tool_settings_ui(ui, at, studio, work);
}

/// What the tool in hand can be told, if it draws this region.
fn tool_settings_ui(ui: &mut Ui, at: RegionAt, studio: &mut Studio, work: &Work<'_>) {
    let t = work.text;
    match studio.canvas.tool {
        Tool::Region(held) if held == at => live_wire_ui(ui, studio, work),
        Tool::Stroke(held) | Tool::Brush(held) if held == at => brush_ui(ui, at, studio, work),
        Tool::Box(object) if at == RegionAt::Object(object) => {
            ui.weak(with(t.region.box_around, region_name(at, work)));
        }
        _ => {}
    }
}

/// The switch for outlines that cling to edges.
pub(super) fn live_wire_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>) {
    if let Some(wanted) = field::tick(ui, work.text.region.live_wire, studio.live_wire) {
        studio.live_wire = wanted;
    }
}

fn brush_ui(ui: &mut Ui, at: RegionAt, studio: &mut Studio, work: &Work<'_>) {
    let t = work.text;
    let is_brush = matches!(studio.canvas.tool, Tool::Brush(_));
    let (inside, outside) =
        if is_brush { (t.region.paint, t.region.erase) } else { (t.region.inside, t.region.outside) };
    // Nothing can be taken from what is not there.
    if is_drawn(at, work) {
        ui.horizontal(|ui| {
            ui.radio_value(&mut studio.brush.inside, true, inside);
            ui.radio_value(&mut studio.brush.inside, false, outside);
        });
    }
    let most = (f64::from(work.size.max_element()) / 10.0).max(20.0);
    let radius = Number::new(t.region.radius, 0.5..=most).logarithmic().unit(" px").decimals(1);
    if let Some(wanted) = radius.slide(ui, studio.brush.radius) {
        studio.brush.radius = wanted;
    }
    if is_brush
        && let Some(wanted) = Number::new(t.region.hardness, 0.0..=1.0).slide(ui, studio.brush.hardness)
    {
        studio.brush.hardness = wanted;
    }
}

/// Whether a line has corners.
pub(super) fn has_corners(line: LineAt, work: &Work<'_>) -> bool {
    line.get(work.tour).is_some_and(|points| !points.is_empty())
}
