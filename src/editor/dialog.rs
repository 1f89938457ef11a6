//! Questions that must be answered: unsaved work, recovered marks; and messages that stay until they are read.

use super::egui::{Frame, Id, Label, Modal, RichText, Ui};
use super::text::{Text, with};
use super::top_bar::short_name;
use super::{Message, Out, Question, Request, field, report_words, theme};

/// Asks what must be answered.
pub(super) fn question_ui(ui: &Ui, question: &Question, t: &Text, out: &mut Out) {
    match question {
        Question::Unsaved => {
            let answers = [
                (t.dialog.save_and_close, Request::SaveAndClose),
                (t.dialog.close_unsaved, Request::CloseUnsaved),
                (t.dialog.stay, Request::Stay),
            ];
            modal_ui(ui, t.dialog.closing, t.dialog.closing_detail, answers, Some(Request::Stay), out);
        }
        Question::Recovery { name, age } => {
            let (title, detail) = (with(t.dialog.recovery, name), with(t.dialog.recovery_detail, age));
            let answers =
                [(t.dialog.recover, Request::Recover), (t.dialog.discard, Request::DiscardRecovery)];
            // Escape answers nothing here: marks are not thrown away by accident.
            modal_ui(ui, &title, &detail, answers, None, out);
        }
        Question::ChangedOnDisk { name } => {
            let answers = [
                (t.dialog.save_over, Request::SaveOver),
                (t.bar.save_as, Request::SaveAs),
                (t.dialog.not_now, Request::Stay),
            ];
            let title = with(t.dialog.changed, name);
            modal_ui(ui, &title, t.dialog.changed_detail, answers, Some(Request::Stay), out);
        }
        Question::ExistingTour { file } => {
            let answers =
                [(t.dialog.open_existing, Request::Open(file.clone())), (t.dialog.start_new, Request::Stay)];
            let title = with(t.dialog.existing, short_name(file));
            modal_ui(ui, &title, t.dialog.existing_detail, answers, Some(Request::Stay), out);
        }
    }
}

fn modal_ui<const N: usize>(
    ui: &Ui,
    title: &str,
    detail: &str,
    answers: [(&str, Request); N],
    escape: Option<Request>,
    out: &mut Out,
) {
    let modal = Modal::new(Id::new("studio question")).show(ui.ctx(), |ui| {
        ui.set_max_width(440.0);
        ui.heading(title);
        ui.add(Label::new(detail).wrap());
        ui.add_space(10.0);
        ui.horizontal_wrapped(|ui| {
            for (name, request) in answers {
                if ui.button(name).clicked() {
                    out.request(request);
                }
            }
        });
    });
    if let Some(request) = escape
        && out.requests.is_empty()
        && modal.should_close()
    {
        out.request(request);
    }
}

/// A message in a bar of its own, above everything else.
pub(super) fn message_ui(ui: &mut Ui, message: &Message, t: &Text, out: &mut Out) {
    let Message { what, advice, is_error } = message;
    let color = if *is_error { theme::BAD } else { theme::ACCENT };
    Frame::new().inner_margin(4.0).show(ui, |ui| {
        ui.horizontal(|ui| {
            if ui.button(t.dialog.dismiss).clicked() {
                out.request(Request::DismissMessage);
            }
            ui.vertical(|ui| {
                ui.add(Label::new(RichText::new(report_words::sentence(what)).color(color)).wrap());
                if !advice.is_empty() {
                    ui.add(Label::new(report_words::sentence(advice)).wrap());
                }
            });
        });
    });
}

/// What stands where the picture should be when it is not found.
pub(super) fn picture_lost_ui(ui: &mut Ui, t: &Text, out: &mut Out) {
    field::card(ui, |ui| {
        ui.colored_label(theme::BAD, t.dialog.picture_lost);
        if ui.button(t.bar.find_picture).clicked() {
            out.request(Request::FindPicture);
        }
    });
}
