//! Which frames `render` writes: what each is called, and where its camera stands.

use bevy_picture_tour::camera::CameraPath;
use bevy_picture_tour::camera::CameraPose;
use bevy_picture_tour::tour;
use bevy_picture_tour::tour::Tour;

use crate::args::RenderArguments;
use crate::failure::Failure;
use crate::views;

/// One picture to write.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Frame {
    /// Its file's name.
    pub(crate) file: String,
    /// Where the camera stands and looks; `None` where the picture was taken from.
    pub(crate) pose: Option<CameraPose>,
    /// How long after the tour's start it is; `None` for the still picture.
    pub(crate) seconds: Option<f64>,
}

/// The frames that the arguments ask for; never none.
pub(crate) fn planned(arguments: &RenderArguments, tour: &Tour) -> Result<Vec<Frame>, Failure> {
    let path = tour.path.as_ref().and_then(tour::CameraPath::way);
    let moving = |seconds: f64| (!arguments.still).then_some(seconds);
    if let Some(file) = &arguments.views {
        let views = views::read(file)?.into_iter();
        return Ok(views
            .map(|view| Frame { file: format!("{}.png", view.name), pose: Some(view.pose), seconds: None })
            .collect());
    }
    if let Some(seconds) = arguments.at {
        let pose = path.map(|path| path.at(seconds));
        return Ok(vec![Frame { file: format!("at_{seconds:.3}s.png"), pose, seconds: moving(seconds) }]);
    }
    if !arguments.path {
        return Ok(vec![Frame { file: "first_view.png".to_owned(), pose: None, seconds: None }]);
    }
    let Some(path) = path else {
        return Err(Failure::CannotRun(
            "the tour has no camera path; add `path: (keyframes: [...])` to it, or use --views".to_owned(),
        ));
    };
    let count = count(&path, arguments.fps);
    let range = arguments.frames.map_or(Some(0..count), |frames| frames.of(count)).ok_or_else(|| {
        Failure::CannotRun(format!(
            "the path has {count} frames at {} a second, so --frames begins beyond its end; ask for frames from \
             0..{count}",
            arguments.fps
        ))
    })?;
    let frame = |index: u32| {
        let seconds = f64::from(index) / f64::from(arguments.fps);
        Frame {
            file: format!("frame_{index:05}.png"),
            pose: Some(path.at(seconds)),
            seconds: moving(seconds),
        }
    };
    Ok(range.map(frame).collect())
}

/// Frames of a path: an open one has a frame at its end, a looped one goes on with its first instead.
fn count(path: &CameraPath, fps: u32) -> u32 {
    // A rounding error must not cost the last frame.
    let steps = path.duration() * f64::from(fps) + 1e-6;
    if path.is_looped() { (steps as u32).max(1) } else { (steps as u32).saturating_add(1) }
}

#[cfg(test)]
mod tests {
    use bevy_picture_tour::camera::Easing;
    use bevy_picture_tour::camera::Keyframe;
    use glam::DVec3;

    use super::*;

    #[test]
    fn a_looped_path_does_not_show_its_first_frame_twice() {
        let station = |x: f64| Keyframe {
            pose: CameraPose::from_angles(DVec3::new(x, 1.8, 0.0), 0.0, 0.0, 0.0),
            arrive: 0.1,
            hold: 0.0,
            easing: Easing::Smooth,
        };
        let path = |looped| CameraPath::new(vec![station(0.0), station(1.0)], looped).unwrap();

        // 0.2 s around, 0.1 s there.
        assert_eq!(count(&path(true), 30), 6);
        assert_eq!(count(&path(false), 30), 4);
    }
}
