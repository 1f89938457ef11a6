//! Work in the background: what it is called, how far it is, and what is done with its outcome.

use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, Mutex};

use bevy::tasks::futures::check_ready;

use super::Session;
use crate::editor::Task;
use crate::plugin::background::{Task as Running, begin};

/// What to do with the session once the work is done.
pub(super) type Finish = Box<dyn FnOnce(&mut Session) + Send>;

/// What a piece of work sees of whoever waits for it.
#[derive(Clone, Debug)]
pub(super) struct Progress {
    wanted: Arc<AtomicBool>,
    /// Thousandths.
    done: Arc<AtomicU32>,
    title: Arc<Mutex<String>>,
}

impl Progress {
    /// Says how far the work is, 0 to 1, and hears whether to go on.
    pub(super) fn at(&self, share: f32) -> bool {
        self.done.store((1000.0 * share.clamp(0.0, 1.0)) as u32, Ordering::Relaxed);
        self.wanted.load(Ordering::Relaxed)
    }

    /// The same, and says what is being done.
    pub(super) fn doing(&self, share: f32, what: &str) -> bool {
        if let Ok(mut title) = self.title.lock()
            && *title != what
        {
            what.clone_into(&mut title);
        }
        self.at(share)
    }
}

/// A piece of work; dropped, it stops at its next step.
#[derive(Debug)]
pub(super) struct Job {
    id: u64,
    progress: Progress,
    running: Running<Finish>,
    /// Whether it finds an outline, which the next such work begins with.
    is_refinement: bool,
}

impl Job {
    pub(super) fn is_refinement(&self) -> bool {
        self.is_refinement
    }

    pub(super) fn mark_refinement(&mut self) {
        self.is_refinement = true;
    }
}

impl std::fmt::Debug for Session {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Session").field("studio", &self.studio).finish_non_exhaustive()
    }
}

impl Drop for Job {
    fn drop(&mut self) {
        self.progress.wanted.store(false, Ordering::Relaxed);
    }
}

impl Session {
    /// Starts work; its outcome is dropped when other files are open by then.
    pub(super) fn start(&mut self, title: &str, work: impl FnOnce(&Progress) -> Finish + Send + 'static) {
        let progress = Progress {
            wanted: Arc::new(AtomicBool::new(true)),
            done: Arc::new(AtomicU32::new(0)),
            title: Arc::new(Mutex::new(title.to_owned())),
        };
        let told = progress.clone();
        let running = begin(move || work(&told));
        let id = self.new_id();
        self.jobs.push(Job { id, progress, running, is_refinement: false });
    }

    /// Stops the work of this number, and forgets it.
    pub(super) fn cancel(&mut self, id: u64) {
        self.jobs.retain(|job| job.id != id);
    }

    /// Takes what is done.
    pub(super) fn take_finished(&mut self) {
        // What the machine finds is no part of what the hand is doing.
        if self.desk.as_ref().is_some_and(|desk| desk.history().in_gesture()) {
            return;
        }
        let mut finished = Vec::new();
        self.jobs.retain_mut(|job| match check_ready(&mut job.running) {
            Some(finish) => {
                finished.push(finish);
                false
            }
            None => true,
        });
        for finish in finished {
            finish(self);
        }
        self.refine_next();
    }

    /// The work as the studio shows it.
    pub(super) fn tasks(&self) -> Vec<Task> {
        let task = |job: &Job| Task {
            id: job.id,
            title: job.progress.title.lock().map(|title| title.clone()).unwrap_or_default(),
            done: Some(job.progress.done.load(Ordering::Relaxed) as f32 / 1000.0),
            can_cancel: true,
        };
        self.jobs.iter().map(task).collect()
    }
}
