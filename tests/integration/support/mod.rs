//! What several tests need: the made scene, world A1, an app to spawn tours in, and whether there is an adapter.

pub(crate) mod a1;
pub(crate) mod made_scene;
pub(crate) mod stage;

use std::sync::{Mutex, MutexGuard, PoisonError};

use bevy_picture_tour::headless;

/// One app at a time has the GPU: a software one takes all cores as it is.
static GPU: Mutex<()> = Mutex::new(());

/// Takes the GPU for a test; `None` means that there is none and that the test ends here, which it says on stderr.
///
/// With `PICTURE_TOUR_REQUIRE_GPU=1` a missing adapter fails the test instead.
#[must_use]
pub(crate) fn adapter() -> Option<MutexGuard<'static, ()>> {
    let guard = GPU.lock().unwrap_or_else(PoisonError::into_inner);
    if headless::adapter_exists() {
        return Some(guard);
    }
    let required = std::env::var("PICTURE_TOUR_REQUIRE_GPU").is_ok_and(|value| value == "1");
    assert!(!required, "there is no graphics adapter, but PICTURE_TOUR_REQUIRE_GPU=1");
    #[expect(clippy::print_stderr, reason = "a test that does not run says so")]
    {
        eprintln!("skipped: no adapter");
    }
    None
}
