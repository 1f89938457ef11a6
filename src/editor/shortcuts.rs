//! Keys that work everywhere in the studio. While a text or number is typed, only those of files do, and end the typing;
//! while a question is asked, none does.

use super::egui::{Key, Memory, Modifiers, Ui};
use super::{Out, Request, Step, Studio, top_bar};

/// The keys of the six steps.
const STEPS: [Key; 6] = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6];

/// Acts on the keys pressed this frame. What it returns is to be asked for at the frame's end, after all edits.
pub(super) fn act(ui: &Ui, studio: &mut Studio, has_draft: bool, out: &mut Out) -> Vec<Request> {
    let is_typing = ui.ctx().text_edit_focused();
    let mut requests = Vec::new();
    for (shortcut, request) in top_bar::shortcuts() {
        let is_for_text = is_typing && matches!(request, Request::Undo | Request::Redo);
        if !is_for_text && ui.input_mut(|i| i.consume_shortcut(&shortcut)) {
            requests.push(request);
        }
    }
    requests.retain(|request| has_draft || *request == Request::OpenDialog);
    // What is dragged is taken back first, and is what there is to undo.
    let steps_back = |request: &Request| matches!(request, Request::Undo | Request::Redo);
    if requests.iter().any(steps_back) && out.cancel() {
        requests.retain(|request| *request != Request::Undo);
    }
    if is_typing {
        if !requests.is_empty() {
            // What is typed so far counts, so that it is saved.
            ui.memory_mut(Memory::stop_text_input);
        }
        return requests;
    }
    for (key, step) in STEPS.into_iter().zip(Step::ALL) {
        if ui.input_mut(|i| i.consume_key(Modifiers::NONE, key)) {
            studio.go_to(step);
        }
    }
    // Escape lets go of one thing after the other: the drag, then drawing, tool and selection.
    if ui.input(|i| i.key_pressed(Key::Escape)) && !out.cancel() {
        studio.canvas.let_go();
    }
    // A letter alone may also fly the tour.
    if !studio.pointer_was_over_tour && ui.input_mut(|i| i.consume_key(Modifiers::NONE, Key::F)) {
        studio.canvas.fit();
    }
    let switches = studio.canvas.tool.has_width() && !studio.pointer_was_over_tour;
    if switches && ui.input_mut(|i| i.consume_key(Modifiers::NONE, Key::X)) {
        studio.brush.inside = !studio.brush.inside;
    }
    requests
}
