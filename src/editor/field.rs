//! Rows of a panel: a name at the left, a value that can be dragged or typed at the right.
//!
//! Every function shows a value and gives back the one that was wanted, if any: showing alone asks for nothing, whatever
//! the value. A typed number counts once it is complete; one out of range goes to its nearest end.

use std::fmt::Debug;
use std::hash::Hash;
use std::ops::RangeInclusive;

use crate::picture::PicturePoint;

use super::egui::{
    Align, Checkbox, ComboBox, DragValue, Frame, InnerResponse, Label, Layout, Response, RichText, Slider,
    SliderClamping, Ui, emath, vec2,
};
use super::theme;

/// Part of a row that its name takes.
const NAME: f32 = 0.38;
/// Width of a slider's number, points.
const VALUE: f32 = 66.0;

/// A number of a panel.
#[derive(Clone, Debug)]
pub(super) struct Number<'a> {
    name: &'a str,
    hint: &'a str,
    range: RangeInclusive<f64>,
    unit: &'a str,
    speed: f64,
    decimals: usize,
    logarithmic: bool,
}

impl<'a> Number<'a> {
    pub(super) fn new(name: &'a str, range: RangeInclusive<f64>) -> Self {
        let speed = (range.end() - range.start()) / 400.0;
        Self { name, hint: "", range, unit: "", speed, decimals: 2, logarithmic: false }
    }

    pub(super) fn hint(self, hint: &'a str) -> Self {
        Self { hint, ..self }
    }

    pub(super) fn unit(self, unit: &'a str) -> Self {
        Self { unit, ..self }
    }

    pub(super) fn speed(self, speed: f64) -> Self {
        Self { speed, ..self }
    }

    pub(super) fn decimals(self, decimals: usize) -> Self {
        Self { decimals, ..self }
    }

    pub(super) fn logarithmic(self) -> Self {
        Self { logarithmic: true, ..self }
    }

    fn drag_value(&self, value: &mut f64, ui: &mut Ui) -> Response {
        let value = DragValue::new(value)
            .range(self.range.clone())
            .clamp_existing_to_range(false)
            .speed(self.speed)
            .max_decimals(self.decimals)
            .suffix(self.unit)
            .update_while_editing(false);
        ui.add(value)
    }

    /// What is read where a value is shown.
    fn shown(&self, value: f64) -> f64 {
        emath::round_to_decimals(value, self.decimals)
    }

    /// Whether another value is wanted: to click into a number and out again takes what is read there, and wants nothing.
    fn is_other(&self, wanted: f64, value: f64) -> bool {
        wanted != value && wanted != self.shown(value)
    }

    /// A number to drag or type.
    pub(super) fn show(&self, ui: &mut Ui, value: f64) -> Option<f64> {
        let mut wanted = value;
        let changed = row(ui, self.name, self.hint, |ui| self.drag_value(&mut wanted, ui)).changed();
        (changed && self.is_other(wanted, value)).then_some(wanted)
    }

    /// The same with a slider.
    pub(super) fn slide(&self, ui: &mut Ui, value: f64) -> Option<f64> {
        let mut wanted = value;
        let changed = row(ui, self.name, self.hint, |ui| self.slider(&mut wanted, ui)).changed();
        (changed && self.is_other(wanted, value)).then_some(wanted)
    }

    fn slider(&self, value: &mut f64, ui: &mut Ui) -> Response {
        let room = ui.available_width() - VALUE - ui.spacing().item_spacing.x;
        ui.spacing_mut().slider_width = room.max(40.0);
        ui.spacing_mut().interact_size.x = VALUE;
        let slider = Slider::new(value, self.range.clone())
            // By default egui brings the value into the range, and rounds it, as soon as it is shown.
            .clamping(SliderClamping::Edits)
            .logarithmic(self.logarithmic)
            .smallest_positive(self.range.end() / 1e3)
            .max_decimals(self.decimals)
            .suffix(self.unit)
            .update_while_editing(false);
        ui.add(slider)
    }

    /// A number that may be left out; then `usual` is used, and shown dim. Gives the wanted one, perhaps none: an own
    /// number begins as the one that is shown.
    pub(super) fn optional(&self, ui: &mut Ui, value: Option<f64>, usual: f64) -> Option<Option<f64>> {
        let mut is_own = value.is_some();
        let before = value.unwrap_or(usual);
        let mut wanted = before;
        let mut toggled = false;
        let row = row(ui, self.name, self.hint, |ui| {
            toggled = ui.add(Checkbox::without_text(&mut is_own)).changed();
            ui.add_enabled_ui(is_own, |ui| self.slider(&mut wanted, ui)).inner
        });
        if toggled {
            return Some(is_own.then(|| self.shown(usual).clamp(*self.range.start(), *self.range.end())));
        }
        (is_own && row.changed() && self.is_other(wanted, before)).then_some(Some(wanted))
    }
}

/// A named row; the widget is labelled by the name.
fn row(ui: &mut Ui, name: &str, hint: &str, add: impl FnOnce(&mut Ui) -> Response) -> Response {
    ui.horizontal(|ui| {
        let name = named(ui, name, hint);
        add(ui).labelled_by(name.id)
    })
    .inner
}

/// The name at the left of a row.
fn named(ui: &mut Ui, name: &str, hint: &str) -> Response {
    let size = vec2(ui.available_width() * NAME, theme::TARGET);
    let layout = Layout::left_to_right(Align::Center);
    let InnerResponse { inner, .. } = ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_size(size);
        ui.add(Label::new(name).truncate())
    });
    if hint.is_empty() { inner } else { inner.on_hover_text(hint) }
}

/// A point of the picture: two numbers.
pub(super) fn point(ui: &mut Ui, name: &str, value: PicturePoint) -> Option<PicturePoint> {
    let mut wanted = value;
    let mut changed = false;
    ui.horizontal(|ui| {
        let label = named(ui, name, "");
        let room = (ui.available_width() - ui.spacing().item_spacing.x) / 2.0;
        ui.spacing_mut().interact_size.x = room.min(80.0);
        for (number, prefix) in [(&mut wanted.0.x, "x "), (&mut wanted.0.y, "y ")] {
            let before = *number;
            let value = DragValue::new(number).speed(0.5).max_decimals(1).prefix(prefix).range(-1e6..=1e6);
            let value = value.clamp_existing_to_range(false).update_while_editing(false);
            changed |= ui.add(value).labelled_by(label.id).changed();
            // As for a number: what is read there is not wanted anew.
            if *number == emath::round_to_decimals(before, 1) {
                *number = before;
            }
        }
    });
    (changed && wanted != value).then_some(wanted)
}

/// One of several named values.
pub(super) fn choice<T: Copy + PartialEq>(
    ui: &mut Ui,
    salt: impl Hash + Debug,
    name: &str,
    value: T,
    values: &[(T, &str)],
) -> Option<T> {
    let mut wanted = value;
    row(ui, name, "", |ui| {
        let shown = values.iter().find(|(other, _)| *other == value).map_or("", |(_, word)| *word);
        let width = ui.available_width();
        let combo = ComboBox::from_id_salt(("choice", salt))
            .width(width)
            .height(320.0)
            .truncate()
            .selected_text(shown);
        combo
            .show_ui(ui, |ui| {
                for (other, word) in values {
                    ui.selectable_value(&mut wanted, *other, *word);
                }
            })
            .response
    });
    (wanted != value).then_some(wanted)
}

/// A box to tick.
pub(super) fn tick(ui: &mut Ui, name: &str, value: bool) -> Option<bool> {
    let mut wanted = value;
    ui.checkbox(&mut wanted, name).changed().then_some(wanted)
}

/// A title above a group of rows.
pub(super) fn title(ui: &mut Ui, text: &str) {
    ui.add_space(8.0);
    ui.label(RichText::new(text).strong().color(theme::DIM));
}

/// A group on a ground of its own, as wide as the panel.
pub(super) fn card<R>(ui: &mut Ui, add: impl FnOnce(&mut Ui) -> R) -> R {
    let frame = Frame::new().fill(theme::CARD).corner_radius(6.0).inner_margin(9.0);
    frame
        .show(ui, |ui| {
            ui.set_width(ui.available_width());
            add(ui)
        })
        .inner
}
