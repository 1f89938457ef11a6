//! Long work beside the frames, on threads of its own.
//!
//! Bevy's pool for asynchronous work has a single thread on two cores, and pipelines are compiled there: while a tour was built
//! in it, the window stayed black.

#[cfg(not(target_arch = "wasm32"))]
pub(crate) use blocking::{Task, unblock as begin};

#[cfg(target_arch = "wasm32")]
pub(crate) use bevy::tasks::Task;

/// Where there are no threads the work is done between two frames.
#[cfg(target_arch = "wasm32")]
pub(crate) fn begin<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Task<T> {
    bevy::tasks::AsyncComputeTaskPool::get().spawn(async move { work() })
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;
    use std::time::Duration;

    use bevy::tasks::{AsyncComputeTaskPool, TaskPool, block_on};

    use super::begin;

    #[test]
    fn short_tasks_go_on_beside_long_work() {
        let pool = AsyncComputeTaskPool::get_or_init(TaskPool::default);
        let (works, ends): (Vec<_>, Vec<_>) = (0..=pool.thread_num())
            .map(|_| {
                let (end, ended) = channel();
                (begin(move || ended.recv_timeout(Duration::from_secs(20)).is_ok()), end)
            })
            .unzip();
        let short = pool.spawn(async move { ends.into_iter().all(|end| end.send(()).is_ok()) });
        assert!(works.into_iter().all(block_on), "a short task waited for the long ones");
        assert!(block_on(short));
    }
}
