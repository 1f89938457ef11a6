//! Opening, saving, recovering and closing, with the questions that go with it.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use egui_file_dialog::FileDialog;

use super::Session;
use crate::editor::text::with;
use crate::editor::{Message, Question, egui};
use crate::tour::edit::desk::{Desk, DeskError, Opened, Replace, Saved};

/// Seconds between two writes of the recovery file.
const AUTOSAVE_SECONDS: f64 = 4.0;

/// Endings of pictures.
const PICTURES: [&str; 6] = ["png", "jpg", "jpeg", "tif", "tiff", "webp"];

/// What a file is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Asked {
    Open,
    SaveAs,
    FindPicture,
}

impl Session {
    /// Opens a picture or tour in place of what is open; what is not saved stays in its recovery file.
    pub fn open(&mut self, path: &Path) {
        match Desk::open(path) {
            Ok(opened) => self.take_opened(path, opened),
            Err(error) => self.fail(&error),
        }
    }

    fn take_opened(&mut self, path: &Path, opened: Opened) {
        let Opened { desk, recovered, existing_tour, notes, problems } = opened;
        (self.message, self.question, self.dialog) = (None, None, None);
        self.close_desk(false);
        self.desk = Some(desk);
        self.studio.begin();
        self.another = true;
        (self.recovered, self.existing) = (recovered, existing_tour);
        self.exit = false;
        // A list of files that cannot be written is not worth a message.
        let _ = self.recent.add(path);
        self.recent_files = self.recent.files();
        if let Some(note) = notes.first() {
            let told = with(self.studio.language.text().session.notes, note);
            self.tell(&told, "");
        }
        for problem in &problems {
            self.fail(problem);
        }
        self.begin();
        self.list_versions();
    }

    /// Asks what is to be asked of what was opened, and drafts a new tour.
    fn begin(&mut self) {
        self.ask_about_recovered();
        if self.question.is_some() {
            return;
        }
        if let Some(file) = self.existing.take() {
            self.question = Some(Question::ExistingTour { file });
        } else if self.desk.as_ref().is_some_and(|desk| desk.is_new() && desk.is_saved()) {
            self.begin_with_a_draft();
        }
    }

    /// Goes on after a question was answered.
    pub(super) fn stay(&mut self) {
        self.leaves = false;
        let began_anew = matches!(self.question, Some(Question::ExistingTour { .. }));
        self.question = None;
        if began_anew {
            self.begin_with_a_draft();
        }
    }

    fn ask_about_recovered(&mut self) {
        let Some(newest) = self.recovered.first() else { return };
        let age = self.ago(newest.modified);
        let name = self.desk.as_ref().map(|desk| desk.path().display().to_string()).unwrap_or_default();
        self.question = Some(Question::Recovery { name, age });
    }

    /// Takes what a crash left, or refuses it.
    pub(super) fn recover(&mut self, take: bool) {
        self.question = None;
        if self.recovered.is_empty() {
            return;
        }
        let newest = self.recovered.remove(0);
        let outcome = match &mut self.desk {
            Some(desk) if take => desk.recover(newest).map_err(DeskError::from),
            _ => newest.discard(),
        };
        if let Err(error) = outcome {
            self.fail(&error);
        }
        if take {
            self.recovered.clear();
        }
        self.begin();
    }

    /// Writes the tour; says whether all is saved then.
    pub(super) fn save(&mut self, replace: Replace) -> bool {
        let Some(desk) = &mut self.desk else { return true };
        let saved = desk.save(replace);
        self.after_save(saved)
    }

    fn after_save(&mut self, saved: Result<Saved, DeskError>) -> bool {
        let Some(desk) = &self.desk else { return true };
        let name = desk.path().display().to_string();
        let words = self.studio.language.text().session;
        match saved {
            Ok(saved) => {
                let path = desk.path().to_owned();
                let left = saved.left_behind.join(", ");
                let advice = if left.is_empty() { left } else { with(words.left_behind, left) };
                self.tell(&with(words.saved, name), &advice);
                let _ = self.recent.add(&path);
                self.recent_files = self.recent.files();
                self.list_versions();
                if std::mem::take(&mut self.leaves) {
                    self.leave(false);
                }
                true
            }
            Err(DeskError::ChangedOnDisk { .. }) => {
                self.question = Some(Question::ChangedOnDisk { name });
                false
            }
            Err(error) => {
                self.fail(&error);
                false
            }
        }
    }

    /// Wants to leave: at once when all is saved, else after a question.
    pub fn close(&mut self) {
        let has_work = self.desk.as_ref().is_some_and(|desk| !desk.is_saved());
        if has_work {
            self.question = Some(Question::Unsaved);
        } else {
            self.leave(false);
        }
    }

    pub(super) fn save_and_leave(&mut self) {
        self.question = None;
        self.leaves = !self.save(Replace::Never);
        if !self.leaves {
            self.leave(false);
        }
    }

    /// Leaves; what is not saved is given up if the user says so.
    pub(super) fn leave(&mut self, gives_up: bool) {
        self.question = None;
        self.close_desk(gives_up);
        self.exit = true;
    }

    fn close_desk(&mut self, gives_up: bool) {
        self.jobs.clear();
        self.later.clear();
        self.suggestions.clear();
        self.forget_picture();
        (self.checked, self.checking) = Default::default();
        let Some(mut desk) = self.desk.take() else { return };
        if desk.is_saved() || gives_up {
            desk.close();
        } else if let Err(error) = desk.autosave(0.0, 0.0) {
            self.fail(&error);
        }
    }

    /// Writes the recovery file now and then.
    pub(super) fn autosave(&mut self, now: f64) {
        let Some(desk) = &mut self.desk else { return };
        if let Err(error) = desk.autosave(now, AUTOSAVE_SECONDS) {
            self.fail(&error);
        }
    }

    pub(super) fn take_version(&mut self, index: usize) {
        let (Some(desk), Some(version)) = (&mut self.desk, self.versions.get(index)) else { return };
        match desk.take_version(version) {
            Ok(problems) => problems.iter().for_each(|problem| self.fail(problem)),
            Err(error) => self.fail(&error),
        }
    }

    fn list_versions(&mut self) {
        self.versions = self.desk.as_ref().map(Desk::versions).unwrap_or_default();
    }

    /// The versions in words, as old as they are now.
    pub(super) fn versions_in_words(&self) -> Vec<String> {
        self.versions.iter().map(|version| self.ago(version.modified)).collect()
    }

    fn ago(&self, then: Option<SystemTime>) -> String {
        let words = self.studio.language.text().session;
        let Some(age) = then.and_then(|then| then.elapsed().ok()) else {
            return words.some_time_ago.to_owned();
        };
        let seconds = age.as_secs();
        match seconds {
            0..120 => with(words.seconds_ago, seconds),
            120..7200 => with(words.minutes_ago, seconds / 60),
            7200..172_800 => with(words.hours_ago, seconds / 3600),
            _ => with(words.days_ago, seconds / 86_400),
        }
    }

    /// Opens a dialog.
    pub(super) fn ask(&mut self, asked: Asked) {
        let words = self.studio.language.text().session;
        let folder = self.desk.as_ref().and_then(|desk| desk.path().parent().map(Path::to_owned));
        let folder = folder.filter(|folder| folder.is_dir()).or_else(|| std::env::current_dir().ok());
        let is_picture = |path: &Path| {
            let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
            PICTURES.iter().any(|known| ending.eq_ignore_ascii_case(known))
        };
        let is_tour = |path: &Path| path.extension().is_some_and(|ending| ending == "ron");
        let mut dialog = FileDialog::new().initial_directory(folder.unwrap_or_default());
        dialog = match asked {
            Asked::Open => dialog.title(words.open_title).add_file_filter(
                "*.tour.ron, *.png, *.jpg …",
                egui_file_dialog::Filter::new(move |path: &Path| is_picture(path) || is_tour(path)),
            ),
            Asked::FindPicture => dialog
                .title(words.find_title)
                .add_file_filter("*.png, *.jpg …", egui_file_dialog::Filter::new(is_picture)),
            Asked::SaveAs => {
                let name =
                    self.desk.as_ref().and_then(|desk| desk.path().file_name()?.to_str().map(str::to_owned));
                dialog.title(words.save_title).default_file_name(&name.unwrap_or_default())
            }
        };
        match asked {
            Asked::SaveAs => dialog.save_file(),
            Asked::Open | Asked::FindPicture => dialog.pick_file(),
        }
        self.dialog = Some((asked, dialog));
    }

    /// Shows the dialog, if one is open, and does what it was for.
    pub(super) fn show_dialog(&mut self, context: &egui::Context) {
        let Some((asked, dialog)) = &mut self.dialog else { return };
        let asked = *asked;
        dialog.update(context);
        let picked: Option<PathBuf> = dialog.take_picked();
        if picked.is_some() || *dialog.state() != egui_file_dialog::DialogState::Open {
            self.dialog = None;
        }
        let Some(path) = picked else { return };
        match asked {
            Asked::Open => self.open(&path),
            Asked::SaveAs => {
                let Some(desk) = &mut self.desk else { return };
                let file = Desk::file_of(&path);
                // The dialog has asked about the name that was typed only.
                if file != path && file != desk.path() && file.exists() {
                    let what = with(self.studio.language.text().session.taken, file.display());
                    self.message = Some(Message { what, advice: String::new(), is_error: true });
                    return;
                }
                let saved = desk.save_as(&path);
                self.after_save(saved);
            }
            Asked::FindPicture => {
                let Some(desk) = &mut self.desk else { return };
                let found = desk.find_picture(&path);
                match found {
                    Ok(()) => {
                        self.forget_picture();
                        (self.checked, self.checking) = Default::default();
                    }
                    Err(error) => self.fail(&error),
                }
            }
        }
    }
}
