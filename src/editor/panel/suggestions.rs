//! What the machine proposes for a step: cards to take, mend or refuse, with how sure it is.

use crate::tour::edit::{Edit, LineAt, ListEdit, PointAt, RegionAt};

use super::super::canvas::Handle;
use super::super::egui::{Button, Color32, Label, ProgressBar, RichText, Ui};
use super::super::text::with;
use super::super::work::Work;
use super::super::{Out, Request, Step, Studio, SuggestWhat, Suggestion, field, theme};

/// Shows the step's suggestions, and a button to ask for new ones.
pub(super) fn suggestions_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let step = studio.step;
    for suggestion in work.view.suggestions.iter().filter(|suggestion| suggestion.step == step) {
        ui.push_id(suggestion.id, |ui| {
            field::card(ui, |ui| suggestion_ui(ui, suggestion, studio, work, out));
        });
    }
    let what = match studio.step {
        Step::Horizon => Some((SuggestWhat::Horizon, t.suggest.horizon)),
        Step::Water | Step::Ground => Some((SuggestWhat::Regions, t.suggest.regions)),
        Step::Pairs => Some((SuggestWhat::Pairs, t.suggest.pairs)),
        Step::Objects | Step::Motion => None,
    };
    if let Some((what, name)) = what
        && ui.button(name).clicked()
    {
        out.request(Request::Suggest(what));
    }
}

fn suggestion_ui(ui: &mut Ui, suggestion: &Suggestion, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let Suggestion { id, title, reason, confidence, edits, .. } = suggestion;
    ui.add(Label::new(RichText::new(title).strong()).wrap());
    ui.add(Label::new(RichText::new(reason).color(theme::DIM)).wrap());
    let sure = confidence.clamp(0.0, 1.0);
    let text = with(t.suggest.sure, format!("{:.0}", sure * 100.0));
    let bar = ProgressBar::new(sure as f32).text(RichText::new(text).small()).fill(color(sure));
    ui.add(bar.desired_height(16.0));
    let take = |out: &mut Out| {
        out.edit(Edit::Many(edits.clone()));
        out.request(Request::DropSuggestion(*id));
    };
    ui.horizontal_wrapped(|ui| {
        let can_take = !edits.is_empty();
        if ui.add_enabled(can_take, Button::new(t.suggest.take)).clicked() {
            take(out);
        }
        // To mend is to take and go on by hand, with its handles shown.
        if ui.add_enabled(can_take, Button::new(t.suggest.mend)).clicked() {
            take(out);
            studio.canvas.let_go();
            studio.canvas.selected = first_handle(edits);
            if let Some(Handle::Mark(
                PointAt::Foot(object, _) | PointAt::On(LineAt::Region(RegionAt::Object(object)), _),
            )) = studio.canvas.selected
            {
                studio.object = Some(object);
            }
        }
        if ui.button(t.suggest.refuse).clicked() {
            out.request(Request::DropSuggestion(*id));
        }
    });
}

/// A handle of what a suggestion sets, so that mending can begin at once.
fn first_handle(edits: &[Edit]) -> Option<Handle> {
    edits.iter().find_map(|edit| {
        let at = match edit {
            Edit::Horizon(Some(_)) => PointAt::Horizon(0),
            Edit::Region { at, region: Some(_) } => PointAt::On(LineAt::Region(*at), 0),
            Edit::Pairs(ListEdit::Insert(index, _)) => PointAt::Reflection(*index),
            Edit::Contact { object, .. } => PointAt::Foot(*object, 0),
            _ => return None,
        };
        Some(Handle::Mark(at))
    })
}

fn color(sure: f64) -> Color32 {
    let color = match sure {
        0.75.. => theme::GOOD,
        0.4.. => theme::ROUGH,
        _ => theme::BAD,
    };
    color.gamma_multiply(0.55)
}
