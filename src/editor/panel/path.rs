//! Step 6, last part: the camera's path as a list of keyframes. The time line below the picture shows the same.

use glam::DVec3;

use crate::camera::CameraPose;
use crate::tour::edit::{Edit, ListEdit};
use crate::tour::{Easing, Keyframe};

use super::super::egui::{Button, CollapsingHeader, Ui};
use super::super::field::{self, Number};
use super::super::text::with;
use super::super::work::Work;
use super::super::{Out, Request, Studio};

/// Time to a new keyframe, seconds.
const USUAL_SECONDS: f64 = 4.0;

/// Shows the path.
pub(super) fn path_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    field::title(ui, t.path.title);
    let keyframes = work.tour.path.as_ref().map_or(&[][..], |path| &path.keyframes);
    ui.horizontal_wrapped(|ui| {
        let flown = work.view.tour.flown;
        let take = ui.add_enabled(flown.is_some(), Button::new(t.path.take));
        if let Some(pose) = flown
            && take.on_hover_text(t.path.take_hint).clicked()
        {
            let seconds = if keyframes.is_empty() { 0.0 } else { USUAL_SECONDS };
            let keyframe = keyframe(&pose, seconds, 0.0, Easing::Smooth);
            out.edit(Edit::Keyframes(ListEdit::Insert(keyframes.len(), keyframe)));
        }
        if ui.button(t.path.home).clicked() {
            out.request(Request::FlyHome);
        }
    });
    if let Some(wanted) = field::tick(ui, t.path.safe_volume, studio.safe_volume) {
        studio.safe_volume = wanted;
    }
    for (index, keyframe) in keyframes.iter().enumerate() {
        let header = CollapsingHeader::new(with(t.path.keyframe, index + 1)).id_salt(("keyframe", index));
        header.show(ui, |ui| keyframe_ui(ui, index, keyframe, keyframes.len(), work, out));
    }
    if keyframes.is_empty() {
        ui.weak(t.path.none);
    }
}

/// A keyframe at a pose.
fn keyframe(pose: &CameraPose, seconds: f64, hold: f64, easing: Easing) -> Keyframe {
    let (yaw, pitch, roll) = pose.angles();
    Keyframe {
        position: pose.position,
        yaw_deg: yaw.to_degrees(),
        pitch_deg: pitch.to_degrees(),
        roll_deg: roll.to_degrees(),
        seconds,
        hold,
        easing,
    }
}

fn keyframe_ui(ui: &mut Ui, index: usize, there: &Keyframe, count: usize, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let mut wanted = *there;
    ui.horizontal_wrapped(|ui| {
        if ui.button(t.path.fly_to).clicked() {
            out.request(Request::FlyTo(index));
        }
        let flown = work.view.tour.flown;
        let replace = ui.add_enabled(flown.is_some(), Button::new(t.path.replace));
        if let Some(pose) = flown
            && replace.clicked()
        {
            wanted = keyframe(&pose, there.seconds, there.hold, there.easing);
        }
        let mut go = |ui: &mut Ui, name: &str, to: Option<usize>| {
            let button = ui.add_enabled(to.is_some_and(|to| to < count), Button::new(name));
            if let Some(to) = to
                && button.clicked()
            {
                out.edit(Edit::Keyframes(ListEdit::Move { from: index, to }));
            }
        };
        go(ui, t.path.earlier, index.checked_sub(1));
        go(ui, t.path.later, Some(index + 1));
        if ui.button(t.path.remove).clicked() {
            out.edit(Edit::Keyframes(ListEdit::Remove(index)));
        }
    });
    let seconds = Number::new(t.path.seconds, 0.0..=3600.0).unit(" s").speed(0.05);
    if let Some(seconds) = seconds.hint(t.path.seconds_hint).show(ui, there.seconds) {
        wanted.seconds = seconds;
    }
    if let Some(hold) = Number::new(t.path.hold, 0.0..=3600.0).unit(" s").speed(0.05).show(ui, there.hold) {
        wanted.hold = hold;
    }
    let easings = [
        (Easing::Smooth, t.path.smooth),
        (Easing::Linear, t.path.linear),
        (Easing::In, t.path.ease_in),
        (Easing::Out, t.path.ease_out),
    ];
    if let Some(easing) = field::choice(ui, ("easing", index), t.path.easing, there.easing, &easings) {
        wanted.easing = easing;
    }
    for (axis, name) in [(DVec3::X, t.path.right), (DVec3::Y, t.path.height), (DVec3::Z, t.path.back)] {
        let value = there.position.dot(axis);
        // The camera stays above the water.
        let least = if axis == DVec3::Y { 0.01 } else { -1e5 };
        if let Some(new) = Number::new(name, least..=1e5).unit(" m").speed(0.02).show(ui, value) {
            wanted.position += axis * (new - value);
        }
    }
    let angle = |name, most: f64| Number::new(name, -most..=most).unit("°").speed(0.1).decimals(1);
    for (value, number) in [
        (&mut wanted.yaw_deg, angle(t.path.yaw, 360.0)),
        (&mut wanted.pitch_deg, angle(t.path.pitch, 90.0)),
        (&mut wanted.roll_deg, angle(t.path.roll, 180.0)),
    ] {
        if let Some(new) = number.show(ui, *value) {
            *value = new;
        }
    }
    if wanted != *there {
        out.edit(Edit::Keyframes(ListEdit::Replace(index, wanted)));
    }
}
