//! The bar at the top: file menu, undo and redo with what they do, and what is shown.

use std::path::Path;

use super::egui::{Button, Key, KeyboardShortcut, MenuBar, Modifiers, Ui};
use super::text::{Text, title_words, with};
use super::work::Work;
use super::{Layout, Out, Request, Studio, SuggestWhat, View, theme};

/// A shortcut with what it asks for.
type Entry = (KeyboardShortcut, Request);

/// The shortcuts of the file menu and of undo and redo.
pub(super) fn shortcuts() -> [Entry; 6] {
    let key = |modifiers: Modifiers, key| KeyboardShortcut::new(modifiers, key);
    let (command, shift) = (Modifiers::COMMAND, Modifiers::COMMAND | Modifiers::SHIFT);
    // The longer combination of a key stands before the shorter one.
    [
        (key(command, Key::O), Request::OpenDialog),
        (key(shift, Key::S), Request::SaveAs),
        (key(command, Key::S), Request::Save),
        (key(shift, Key::Z), Request::Redo),
        (key(command, Key::Z), Request::Undo),
        (key(command, Key::Y), Request::Redo),
    ]
}

/// Shows the bar; without a draft only what can be done then.
pub(super) fn top_bar_ui(
    ui: &mut Ui,
    studio: &mut Studio,
    view: &View<'_>,
    work: Option<&Work<'_>>,
    t: &Text,
    out: &mut Out,
) {
    MenuBar::new().ui(ui, |ui| {
        ui.menu_button(t.bar.file, |ui| file_menu_ui(ui, view, work, t, out));
        let Some(work) = work else { return };
        let (undo, redo) = (work.history.undo_title(), work.history.redo_title());
        let words = |name, title| match title {
            Some(title) => with(name, title_words(title, t)),
            None => String::new(),
        };
        let button = ui.add_enabled(undo.is_some(), Button::new(t.bar.undo));
        if button.on_hover_text(words(t.bar.undo_what, undo)).clicked() {
            out.request(Request::Undo);
        }
        let button = ui.add_enabled(redo.is_some(), Button::new(t.bar.redo));
        if button.on_hover_text(words(t.bar.redo_what, redo)).clicked() {
            out.request(Request::Redo);
        }
        ui.separator();
        let layouts = [
            (Layout::Split, t.bar.split),
            (Layout::Picture, t.bar.picture_only),
            (Layout::Tour, t.bar.tour_only),
        ];
        for (layout, name) in layouts {
            ui.selectable_value(&mut studio.layout, layout, name);
        }
        ui.separator();
        if ui.button(t.bar.fit).on_hover_text(t.bar.fit_hint).clicked() {
            studio.canvas.fit();
        }
        ui.toggle_value(&mut studio.snapping, t.bar.snap).on_hover_text(t.bar.snap_hint);
        if ui.button(t.bar.suggest).on_hover_text(t.bar.suggest_hint).clicked() {
            out.request(Request::Suggest(SuggestWhat::Everything));
        }
    });
}

fn file_menu_ui(ui: &mut Ui, view: &View<'_>, work: Option<&Work<'_>>, t: &Text, out: &mut Out) {
    ui.set_min_width(210.0);
    let is_open = work.is_some();
    entry_ui(ui, t.bar.open, Request::OpenDialog, true, out);
    if !view.recent.is_empty() {
        ui.menu_button(t.bar.recent, |ui| {
            for path in view.recent {
                let button = ui.button(short_name(path)).on_hover_text(path.display().to_string());
                if button.clicked() {
                    out.request(Request::Open(path.clone()));
                    ui.close();
                }
            }
        });
    }
    ui.separator();
    entry_ui(ui, t.bar.save, Request::Save, is_open, out);
    entry_ui(ui, t.bar.save_as, Request::SaveAs, is_open, out);
    ui.separator();
    if !view.versions.is_empty() {
        ui.menu_button(t.bar.versions, |ui| {
            for (index, version) in view.versions.iter().enumerate() {
                if ui.button(version).clicked() {
                    out.request(Request::TakeVersion(index));
                    ui.close();
                }
            }
        });
    }
    entry_ui(ui, t.bar.find_picture, Request::FindPicture, is_open, out);
    ui.separator();
    entry_ui(ui, t.bar.close, Request::Close, true, out);
}

/// A line of the menu, with its shortcut if it has one.
fn entry_ui(ui: &mut Ui, name: &str, request: Request, enabled: bool, out: &mut Out) {
    let shortcut = shortcuts().into_iter().find(|(_, other)| *other == request);
    let mut button = Button::new(name);
    if let Some((shortcut, _)) = shortcut {
        button = button.shortcut_text(ui.ctx().format_shortcut(&shortcut));
    }
    if ui.add_enabled(enabled, button).clicked() {
        out.request(request);
        ui.close();
    }
}

/// A file's name without its folder.
pub(super) fn short_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// The title of the window: the tour's name, marked while not all is saved.
#[must_use]
pub(super) fn name_of(view: &View<'_>, t: &Text) -> String {
    let Some(desk) = &view.desk else { return t.bar.program.to_owned() };
    let name = desk.file.map_or_else(|| t.bar.untitled.to_owned(), short_name);
    if desk.history.is_saved() { name } else { format!("{name} •") }
}

/// What one sees before anything is open.
pub(super) fn start_ui(ui: &mut Ui, view: &View<'_>, t: &Text, out: &mut Out) {
    ui.vertical_centered(|ui| {
        ui.add_space((ui.available_height() * 0.25).max(20.0));
        ui.heading(t.bar.start);
        ui.add_space(6.0);
        ui.colored_label(theme::DIM, t.bar.start_hint);
        ui.add_space(14.0);
        if ui.button(t.bar.open_picture).clicked() {
            out.request(Request::OpenDialog);
        }
        ui.add_space(14.0);
        for path in view.recent.iter().take(8) {
            if ui.link(short_name(path)).on_hover_text(path.display().to_string()).clicked() {
                out.request(Request::Open(path.clone()));
            }
        }
    });
}
