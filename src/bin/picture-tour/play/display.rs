//! Whether there is a display to open a window on, and a graphics card to draw with.

use bevy_picture_tour::headless::adapter_exists;

/// What keeps a window from being opened, in words; `None` where nothing does.
///
/// The window library panics then, so it is asked for beforehand.
pub(crate) fn missing() -> Option<&'static str> {
    if !exists() {
        return Some("there is no display");
    }
    (!adapter_exists()).then_some("there is no graphics adapter")
}

/// Whether there is a display; where X is spoken, whether its server answers.
fn exists() -> bool {
    let is_x = cfg!(all(unix, not(any(target_os = "macos", target_os = "android", target_os = "ios"))));
    !is_x || std::env::var("DISPLAY").is_ok_and(|display| answers(&display))
}

/// Whether an X server listens at a display like `:1`, `:1.0` or `host:1`.
#[cfg(unix)]
fn answers(display: &str) -> bool {
    let Some((host, number)) = display.rsplit_once(':') else { return false };
    let Ok(number) = number.split('.').next().unwrap_or_default().parse::<u16>() else { return false };
    if host.is_empty() || host == "unix" {
        std::os::unix::net::UnixStream::connect(format!("/tmp/.X11-unix/X{number}")).is_ok()
    } else {
        std::net::TcpStream::connect((host, 6000_u16.saturating_add(number))).is_ok()
    }
}

#[cfg(not(unix))]
fn answers(_display: &str) -> bool {
    true
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_display_that_nobody_serves_is_none() {
        for display in ["", ":", "nonsense", ":65000", ":7.x.y:z"] {
            assert!(!answers(display), "{display:?} was taken for a display");
        }
    }
}
